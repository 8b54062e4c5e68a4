//! Linear values as an OpenEXR file, for whoever wants to measure a picture rather than look.
//!
//! One part, scan lines, no compression, 32-bit floats: the simplest file that every reader
//! takes (OpenEXR file layout, version 2).

use crate::Raw;

/// A channel's name and its values, rows from the top.
type Channel<'a> = (&'a str, &'a [f64]);

impl Raw {
    /// Both panels as the layers `buggy` and `correct` of an OpenEXR file.
    pub fn exr(&self) -> Vec<u8> {
        let channels = self.channels.max(1) as usize;
        let pick = |values: &[f64], channel: usize| -> Vec<f64> {
            values
                .iter()
                .skip(channel)
                .step_by(channels)
                .copied()
                .collect()
        };
        // Channels stand in alphabetical order: the format asks for it.
        let names: &[(&str, usize)] = match channels {
            3 => &[("B", 2), ("G", 1), ("R", 0)],
            _ => &[("Y", 0)],
        };
        let layers = [("buggy", &self.wrong), ("correct", &self.right)];
        let planes: Vec<(String, Vec<f64>)> = layers
            .iter()
            .flat_map(|(layer, values)| {
                let plane = |(name, channel): &(&str, usize)| {
                    (format!("{layer}.{name}"), pick(values, *channel))
                };
                names.iter().map(plane).collect::<Vec<_>>()
            })
            .collect();
        let list: Vec<Channel<'_>> = planes
            .iter()
            .map(|(name, values)| (name.as_str(), values.as_slice()))
            .collect();
        write(self.size as usize, &list)
    }
}

fn write(size: usize, channels: &[Channel<'_>]) -> Vec<u8> {
    let mut file = vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        for text in [name, kind] {
            file.extend_from_slice(text.as_bytes());
            file.push(0);
        }
        file.extend_from_slice(&(value.len() as u32).to_le_bytes());
        file.extend_from_slice(value);
    };
    let mut list = Vec::new();
    for (name, _) in channels {
        list.extend_from_slice(name.as_bytes());
        list.push(0);
        // Kind 2 is a 32-bit float; then "perceptually linear" and padding; then every sample of
        // both axes.
        for number in [2_u32, 0, 1, 1] {
            list.extend_from_slice(&number.to_le_bytes());
        }
    }
    list.push(0);
    let last = (size as u32).saturating_sub(1);
    let window: Vec<u8> = [0, 0, last, last]
        .iter()
        .flat_map(|n: &u32| n.to_le_bytes())
        .collect();
    attribute("channels", "chlist", &list);
    attribute("compression", "compression", &[0]);
    attribute("dataWindow", "box2i", &window);
    attribute("displayWindow", "box2i", &window);
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &1.0_f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1.0_f32.to_le_bytes());
    file.push(0);

    let row_bytes = size * channels.len() * size_of::<f32>();
    let first = file.len() + 8 * size;
    for row in 0..size {
        let offset = (first + row * (8 + row_bytes)) as u64;
        file.extend_from_slice(&offset.to_le_bytes());
    }
    for row in 0..size {
        file.extend_from_slice(&(row as u32).to_le_bytes());
        file.extend_from_slice(&(row_bytes as u32).to_le_bytes());
        for (_, values) in channels {
            for value in &values[row * size..(row + 1) * size] {
                file.extend_from_slice(&(*value as f32).to_le_bytes());
            }
        }
    }
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_row_is_where_its_offset_says() {
        let raw = Raw {
            size: 3,
            channels: 1,
            right: (0..9).map(f64::from).collect(),
            wrong: vec![0.5; 9],
        };
        let file = raw.exr();
        assert!(file.starts_with(&[0x76, 0x2f, 0x31, 0x01]));
        let row_bytes = 3 * 2 * 4;
        let last_row = &file[file.len() - row_bytes..];
        let floats: Vec<f32> = last_row
            .chunks_exact(4)
            .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
            .collect();
        assert_eq!(floats, [0.5, 0.5, 0.5, 6.0, 7.0, 8.0]);
        let table_end = file.len() - 3 * (8 + row_bytes);
        let offset =
            u64::from_le_bytes(file[table_end - 8..table_end].try_into().expect("8 bytes"));
        assert_eq!(offset as usize, file.len() - row_bytes - 8);
    }
}
