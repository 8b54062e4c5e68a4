//! What is sent to a terminal for a picture, decoded as the terminal would: it has to be the
//! picture.

use std::io::Cursor;

use image::{Rgba, RgbaImage};
use ratatui::buffer::Buffer;
use ratatui::layout::{Rect, Size};
use ratatui::widgets::Widget as _;
use ratatui_image::FontSize;
use ratatui_image::picker::{Picker, ProtocolType};
use ratatui_image::sliced::{SignedPosition, SlicedImage};
use renders::{Preview, Scene};

use super::pictures::{Drawn, paint_again};

/// Cells of 8 by 16 pixels: three panels of 256, and two gaps.
const CELL: (u16, u16) = (8, 16);
const AREA: Size = Size {
    width: 98,
    height: 16,
};
const SIDE: u32 = 256;

fn picture() -> RgbaImage {
    let library = formula::Library::new();
    let parse = |text| formula::parse(text).unwrap_or_else(|error| panic!("{error}"));
    let fingerprint = renders::Fingerprint {
        lesson: "test",
        id: "wire",
        title: String::new(),
        caption: String::new(),
        library: &library,
        right: &parse("d_ggx() * v_ggx() * f_schlick() * n_dot_l"),
        wrong: &parse("d_ggx() * v_ggx() * f_schlick() / (4 * n_dot_v)"),
        scene: Scene::new(0.7, 0.95, 60.0),
    };
    let frame = Preview::new(&fingerprint)
        .and_then(|mut preview| preview.draw(&fingerprint.scene, SIDE, 0.0))
        .unwrap_or_else(|error| panic!("{error}"));
    RgbaImage::from_raw(frame.width, frame.height, frame.rgba).expect("all its pixels")
}

/// The symbols of all cells, as they are sent.
fn sent(kind: ProtocolType, picture: &RgbaImage) -> String {
    // Deprecated in favour of asking a terminal; here is none.
    #[allow(deprecated)]
    let mut picker = Picker::from_fontsize(FontSize::new(CELL.0, CELL.1));
    picker.set_protocol_type(kind);
    let pixels = (picture.width(), picture.height(), picture.as_raw().clone());
    let drawn = paint_again(&picker, true, pixels, AREA, 1);
    let Ok(Drawn::Pixels(image)) = drawn else {
        panic!("no pixels");
    };
    let area = Rect::new(0, 0, AREA.width, AREA.height);
    let mut buffer = Buffer::empty(area);
    SlicedImage::new(&image, SignedPosition::from((0, 0))).render(area, &mut buffer);
    let cells = buffer.content().iter();
    cells.map(|cell| cell.symbol()).collect()
}

/// What stands between each `start` and the `end` after it.
fn between<'a>(text: &'a str, start: &'a str, end: &'a str) -> impl Iterator<Item = &'a str> {
    let parts = text.split(start).skip(1);
    parts.map(move |part| part.split_once(end).expect("an end").0)
}

fn base64(text: &str) -> Vec<u8> {
    let digit = |letter: u8| match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        other => panic!("{other} is not base64"),
    };
    let digits: Vec<u8> = text.trim_end_matches('=').bytes().map(digit).collect();
    let bytes = digits.chunks(4).flat_map(|group| {
        let shifted = group.iter().zip([18, 12, 6, 0]);
        let whole: u32 = shifted.map(|(digit, by)| u32::from(*digit) << by).sum();
        whole.to_be_bytes()[1..group.len()].to_vec()
    });
    bytes.collect()
}

/// Kitty: commands of keys and base64; the pixels come in parts.
fn kitty(text: &str) -> RgbaImage {
    let mut size = (0, 0);
    let mut pixels = Vec::new();
    for command in between(text, "\u{1b}_G", "\u{1b}\\") {
        let (keys, payload) = command.split_once(';').expect("keys and payload");
        for (key, value) in keys.split(',').filter_map(|pair| pair.split_once('=')) {
            match key {
                "s" => size.0 = value.parse().expect("a width"),
                "v" => size.1 = value.parse().expect("a height"),
                "f" => assert_eq!(value, "32"),
                _ => {}
            }
        }
        pixels.extend(base64(payload));
    }
    RgbaImage::from_raw(size.0, size.1, pixels).expect("as many pixels as it says")
}

/// iTerm2: a PNG file for each row of cells.
fn iterm2(text: &str) -> RgbaImage {
    let mut pixels = Vec::new();
    let mut width = 0;
    for file in between(text, "\u{1b}]1337;File=", "\u{7}") {
        let bytes = base64(file.split_once(':').expect("a file").1);
        let decoder = png::Decoder::new(Cursor::new(bytes));
        let mut reader = decoder.read_info().expect("a PNG");
        let mut row = vec![0; reader.output_buffer_size().expect("a size")];
        let frame = reader.next_frame(&mut row).expect("a whole PNG");
        assert_eq!(frame.color_type, png::ColorType::Rgba);
        assert_eq!(frame.height, u32::from(CELL.1));
        width = frame.width;
        pixels.extend_from_slice(&row[..frame.buffer_size()]);
    }
    let height = pixels.len() as u32 / 4 / width;
    RgbaImage::from_raw(width, height, pixels).expect("whole rows")
}

/// Sixel: colours by number, and six rows of pixels at once. What was not painted is transparent.
fn sixel(text: &str) -> RgbaImage {
    let data = between(text, "\u{1b}P", "\u{1b}\\").next().expect("sixels");
    let data = data.split_once('q').expect("a start").1.as_bytes();
    let mut image = RgbaImage::new(
        u32::from(AREA.width * CELL.0),
        u32::from(AREA.height * CELL.1) / 6 * 6,
    );
    let mut colours = vec![Rgba([0; 4]); 256];
    let (mut colour, mut x, mut y, mut repeat) = (0, 0, 0, 1);
    let mut at = 0;
    // Numbers after a command, separated by semicolons.
    let numbers = |at: &mut usize| {
        let start = *at;
        while data
            .get(*at)
            .is_some_and(|b| b.is_ascii_digit() || *b == b';')
        {
            *at += 1;
        }
        let text = std::str::from_utf8(&data[start..*at]).expect("ASCII");
        let numbers = text.split(';').map(|number| number.parse().unwrap_or(0));
        numbers.collect::<Vec<u32>>()
    };
    while let Some(&command) = data.get(at) {
        at += 1;
        match command {
            b'"' => drop(numbers(&mut at)),
            b'#' => {
                let given = numbers(&mut at);
                colour = given[0] as usize;
                if let [_, 2, parts @ ..] = given.as_slice() {
                    let [red, green, blue] = [0, 1, 2].map(|i| ((parts[i] * 255 + 50) / 100) as u8);
                    colours[colour] = Rgba([red, green, blue, 255]);
                }
            }
            b'!' => repeat = numbers(&mut at)[0],
            b'$' => x = 0,
            b'-' => (x, y) = (0, y + 6),
            b'?'..=b'~' => {
                let bits = command - b'?';
                for x in x..x + repeat {
                    for row in (0..6).filter(|row| bits >> row & 1 == 1) {
                        image.put_pixel(x, y + row, colours[colour]);
                    }
                }
                x += repeat;
                repeat = 1;
            }
            other => panic!("{} is no sixel", char::from(other)),
        }
    }
    image
}

/// How far each channel of the decoded picture is from the one that was sent: the mean over all
/// pixels, and the worst mean of a square of eight of them.
#[track_caller]
fn check(kind: ProtocolType, decode: fn(&str) -> RgbaImage, mean: f64, worst: f64) {
    let picture = picture();
    let seen = decode(&sent(kind, &picture));
    assert_eq!(seen.width(), u32::from(AREA.width * CELL.0), "{kind:?}");
    let (columns, rows) = (picture.width(), picture.height().min(seen.height()));
    // A terminal paints whole sixels only: of the last row of cells a part may be missing.
    assert!(rows + 6 > picture.height(), "{kind:?}: {rows} rows");
    let apart = |channel: usize, x: u32, y: u32| {
        let [seen, sent] = [&seen, &picture].map(|image| image.get_pixel(x, y).0[channel]);
        f64::from(seen) - f64::from(sent)
    };
    for channel in 0..4 {
        let all = (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y)));
        let sum: f64 = all.map(|(x, y)| apart(channel, x, y).abs()).sum();
        let found = sum / f64::from(columns * rows);
        assert!(found <= mean, "{kind:?}: {found} apart in the mean");
        let squares = (0..rows / 8).flat_map(|y| (0..columns / 8).map(move |x| (8 * x, 8 * y)));
        for (left, top) in squares {
            let square = (0..64).map(|i| apart(channel, left + i % 8, top + i / 8));
            let found = (square.sum::<f64>() / 64.0).abs();
            assert!(found <= worst, "{kind:?}: {found} apart at {left}, {top}");
        }
    }
}

#[test]
fn a_terminal_gets_the_picture() {
    check(ProtocolType::Kitty, kitty, 0.0, 0.0);
    check(ProtocolType::Iterm2, iterm2, 0.0, 0.0);
    // 256 colours, and between them dots.
    check(ProtocolType::Sixel, sixel, 4.0, 10.0);
}
