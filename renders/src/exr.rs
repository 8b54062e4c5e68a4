//! Linear values as an OpenEXR file, for whoever wants to measure a picture rather than look.
//!
//! One part, scan lines, no compression, 32-bit floats: the simplest file that every reader
//! takes (OpenEXR file layout, version 2).

use crate::Raw;

impl Raw {
    /// Both panels as the layers `buggy` and `correct` of an OpenEXR file.
    pub fn exr(&self) -> Vec<u8> {
        let (size, channels) = (self.size as usize, self.channels.max(1) as usize);
        let mut file = header(size, channels);
        file.extend(rows(size, channels, 0, &self.right, &self.wrong));
        file
    }
}

/// A layer's channels and where they stand in a pixel, in alphabetical order: the format asks
/// for it.
fn names(channels: usize) -> &'static [(&'static str, usize)] {
    match channels {
        3 => &[("B", 2), ("G", 1), ("R", 0)],
        _ => &[("Y", 0)],
    }
}

fn row_bytes(size: usize, channels: usize) -> usize {
    2 * channels * size * size_of::<f32>()
}

/// All before the first row: what the file holds, and where each row begins.
pub(crate) fn header(size: usize, channels: usize) -> Vec<u8> {
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
    for (layer, (name, _)) in ["buggy", "correct"]
        .iter()
        .flat_map(|layer| names(channels).iter().map(move |name| (layer, name)))
    {
        list.extend_from_slice(format!("{layer}.{name}").as_bytes());
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

    let first = file.len() + 8 * size;
    for row in 0..size {
        let offset = (first + row * (8 + row_bytes(size, channels))) as u64;
        file.extend_from_slice(&offset.to_le_bytes());
    }
    file
}

/// The rows from `first` on, as many as there are values.
pub(crate) fn rows(
    size: usize,
    channels: usize,
    first: usize,
    right: &[f64],
    wrong: &[f64],
) -> Vec<u8> {
    let bytes = row_bytes(size, channels);
    let mut file = Vec::with_capacity((8 + bytes) * (right.len() / size / channels));
    let layers = |start: usize| [&wrong[start..], &right[start..]];
    for (row, start) in (0..right.len()).step_by(size * channels).enumerate() {
        file.extend_from_slice(&((first + row) as u32).to_le_bytes());
        file.extend_from_slice(&(bytes as u32).to_le_bytes());
        for layer in layers(start) {
            for (_, channel) in names(channels) {
                let values = layer[..size * channels].iter().skip(*channel);
                for value in values.step_by(channels) {
                    file.extend_from_slice(&(*value as f32).to_le_bytes());
                }
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
