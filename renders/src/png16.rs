//! Values as a PNG of 16 bits: what is seen, in steps too fine to see.

use crate::Raw;
use crate::colour::srgb_encode;
use std::io::Write;

impl Raw {
    /// The correct panel and, on its right, the buggy one as a PNG file of 16 bits a channel:
    /// values times `exposure`, cut at white, through the sRGB curve. Grey, or red, green and
    /// blue where the lights have colours.
    pub fn png16(&self, exposure: f64) -> Vec<u8> {
        let (size, channels) = (self.size as usize, self.channels as usize);
        let bytes = rows(size * channels, &self.right, &self.wrong, exposure);
        let mut file = Vec::new();
        // Writing to memory fails only if the buffer and the header disagree, which they cannot.
        let written = header(&mut file, size, channels)
            .and_then(|mut writer| writer.write_image_data(&bytes));
        debug_assert!(written.is_ok(), "{written:?}");
        file
    }
}

/// The start of a file with two panels of `size` side by side.
pub(crate) fn header<W: Write>(
    to: W,
    size: usize,
    channels: usize,
) -> Result<png::Writer<W>, png::EncodingError> {
    let mut encoder = png::Encoder::new(to, 2 * size as u32, size as u32);
    encoder.set_color(match channels {
        3 => png::ColorType::Rgb,
        _ => png::ColorType::Grayscale,
    });
    encoder.set_depth(png::BitDepth::Sixteen);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.write_header()
}

/// As many rows as there are values, `row` in each of both panels.
pub(crate) fn rows(row: usize, right: &[f64], wrong: &[f64], exposure: f64) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(4 * right.len());
    let rows = right.chunks_exact(row).zip(wrong.chunks_exact(row));
    for value in rows.flat_map(|(right, wrong)| right.iter().chain(wrong)) {
        // A NaN becomes 0.
        let signal = srgb_encode((value * exposure).max(0.0));
        bytes.extend_from_slice(&((signal * 65535.0 + 0.5) as u16).to_be_bytes());
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_bits_follow_the_srgb_curve() {
        let raw = Raw {
            size: 2,
            channels: 1,
            right: vec![0.0, 0.25, 0.5, f64::NAN],
            wrong: vec![0.001, 1.0, 7.0, -1.0],
        };
        let file = raw.png16(1.0);
        let mut reader = png::Decoder::new(std::io::Cursor::new(file))
            .read_info()
            .expect("a PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut bytes).expect("a frame");
        let levels: Vec<u16> = bytes
            .chunks_exact(2)
            .map(|b| u16::from_be_bytes([b[0], b[1]]))
            .collect();
        // 0.25 and 0.5 are 0.537099 and 0.735357 of the signal; below 0.0031308 it is 12.92 x.
        assert_eq!(levels, [0, 35199, 847, 65535, 48192, 0, 65535, 0]);
    }
}
