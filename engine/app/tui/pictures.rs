//! Pictures of the screen: drawn in the background, dropped when the learner moves on.

use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;
use std::time::{Duration, Instant};

use image::{DynamicImage, RgbaImage};
use ratatui::layout::Size;
use ratatui_image::Resize;
use ratatui_image::picker::{Picker, ProtocolType};
use ratatui_image::protocol::halfblocks::Halfblocks;
use ratatui_image::protocol::kitty::Kitty;
use ratatui_image::sliced::SlicedProtocol;
use tutor::Lesson;

use super::probe;
use crate::fingerprints::{Kind, Subject, fingerprint};
use crate::maps::map_spec;

/// Values across a map on the screen, and upwards: an integral can be behind each.
const CELLS: usize = 24;

/// A spinner turns this often.
const TURN: Duration = Duration::from_millis(100);

/// What a picture is: what it shows, and its size in cells.
type Key = (Subject, u16, u16);

/// A picture that was asked for.
enum Job {
    Drawing {
        cancel: Arc<AtomicBool>,
        since: Instant,
    },
    Ready(Drawn),
    Failed(String),
}

/// A picture that was drawn.
pub enum Drawn {
    Pixels(SlicedProtocol),
    /// Rows of letters, where there are no colours.
    Shades(Vec<String>),
}

/// A picture as it is seen.
pub enum State<'a> {
    Drawing { spinner: usize },
    Ready(&'a SlicedProtocol),
    Shades(&'a [String]),
    Failed(&'a str),
}

/// All pictures of the screen.
pub struct Pictures {
    picker: Option<Picker>,
    colours: bool,
    jobs: HashMap<Key, Job>,
    finished: Receiver<(Key, Result<Drawn, String>)>,
    finish: Sender<(Key, Result<Drawn, String>)>,
    /// What was typed while the terminal was asked what it can show.
    typed: Vec<u8>,
}

impl Pictures {
    pub fn new(colours: bool) -> Self {
        let (finish, finished) = mpsc::channel();
        Self {
            picker: None,
            colours,
            jobs: HashMap::new(),
            finished,
            finish,
            typed: Vec::new(),
        }
    }
}

/// Rows that three square panels and the gaps between them fill in `width` columns: a row that
/// they filled in part would show a black bar.
pub fn rows_for(width: u16) -> u16 {
    // What was below 65536 still is.
    (u32::from(width) * 8 / 49).max(3) as u16
}

/// Columns that they take in so many rows, of `width` at most.
pub fn columns_in(rows: u16, width: u16) -> u16 {
    ((u32::from(rows) * 49 + 4) / 8).min(u32::from(width)) as u16
}

/// Columns and rows of a map where there are so many columns.
pub fn map_size(width: u16) -> (u16, u16) {
    let width = width.min(64);
    (width, (width / 4).max(6))
}

impl Pictures {
    /// Has the pictures drawn that are on the screen, and drops the others. The first wish asks
    /// the terminal what it can show, so that the first frame need not wait for its answer.
    pub fn want<'a>(
        &mut self,
        lesson: &Arc<Lesson>,
        wanted: impl Iterator<Item = (&'a Subject, u16, u16)>,
    ) {
        let wanted: Vec<Key> = wanted
            .map(|(subject, width, height)| (subject.clone(), width, height))
            .collect();
        self.jobs.retain(|key, job| {
            let keep = wanted.contains(key);
            if let (false, Job::Drawing { cancel, .. }) = (keep, job) {
                cancel.store(true, Ordering::Relaxed);
            }
            keep
        });
        for key in wanted {
            if !self.jobs.contains_key(&key) {
                let picker = self.picker();
                let finish = self.finish.clone();
                let job = start(
                    key.clone(),
                    Arc::clone(lesson),
                    picker,
                    self.colours,
                    finish,
                );
                self.jobs.insert(key, job);
            }
        }
    }

    /// What the terminal can show; asks it where it was not asked yet.
    pub fn picker(&mut self) -> Picker {
        if let Some(picker) = &self.picker {
            return picker.clone();
        }
        let (picker, typed) = probe::picker();
        self.typed.extend(typed);
        self.picker = Some(picker.clone());
        picker
    }

    /// What was typed while the terminal was asked.
    pub fn typed(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.typed)
    }

    /// Takes what was finished. True where the screen changed.
    pub fn collect(&mut self) -> bool {
        let mut changed = false;
        while let Ok((key, result)) = self.finished.try_recv() {
            if let Some(job) = self.jobs.get_mut(&key) {
                *job = result.map_or_else(Job::Failed, Job::Ready);
                changed = true;
            }
        }
        changed
    }

    /// When the screen has to be drawn again, where a spinner turns.
    pub fn wakes_in(&self) -> Option<Duration> {
        self.jobs
            .values()
            .any(|job| matches!(job, Job::Drawing { .. }))
            .then_some(TURN)
    }

    /// How the picture stands, at whatever size.
    pub fn state(&self, subject: &Subject) -> Option<State<'_>> {
        let (_, job) = self.jobs.iter().find(|(key, _)| key.0 == *subject)?;
        Some(match job {
            Job::Drawing { since, .. } => State::Drawing {
                spinner: (since.elapsed().as_millis() / TURN.as_millis()) as usize,
            },
            Job::Ready(Drawn::Pixels(image)) => State::Ready(image),
            Job::Ready(Drawn::Shades(rows)) => State::Shades(rows),
            Job::Failed(why) => State::Failed(why),
        })
    }
}

fn start(
    key: Key,
    lesson: Arc<Lesson>,
    picker: Picker,
    colours: bool,
    finish: Sender<(Key, Result<Drawn, String>)>,
) -> Job {
    let cancel = Arc::new(AtomicBool::new(false));
    let cancelled = Arc::clone(&cancel);
    thread::spawn(move || {
        // A driver may panic; that is a picture that failed, not the end of the lesson.
        let drawn = std::panic::catch_unwind(|| draw(&key, &lesson, &picker, colours, &cancelled));
        let result = drawn.unwrap_or_else(|_| Err("the drawing broke down".to_owned()));
        // The screen may have moved on.
        let _ = finish.send((key, result));
    });
    Job::Drawing {
        cancel,
        since: Instant::now(),
    }
}

fn draw(
    key: &Key,
    lesson: &Lesson,
    picker: &Picker,
    colours: bool,
    cancel: &AtomicBool,
) -> Result<Drawn, String> {
    let (subject, width, height) = key;
    let cell = match picker.protocol_type() {
        // Half-blocks have two pixels a cell; twice that, to be averaged.
        ProtocolType::Halfblocks => 2,
        _ => u32::from(picker.font_size().width),
    };
    let size = (u32::from(*width) * cell / 3).clamp(64, 1024);
    let area = Size::new(*width, *height);
    let pixels = match &subject.kind {
        Kind::Own(source) => crate::shaders::picture(lesson, &subject.id, source, size)?,
        Kind::Fingerprint => fingerprint_of(lesson, &subject.id, size, cancel)?,
        Kind::Map => {
            let spec = map_spec(lesson, &subject.id, CELLS).ok_or("the lesson has no such map")?;
            if !colours && picker.protocol_type() == ProtocolType::Halfblocks {
                let image = map_of(&spec, u32::from(*width), u32::from(*height))?;
                return Ok(Drawn::Shades(map_shades(&image, spec.scale)));
            }
            let (across, down) = match picker.protocol_type() {
                ProtocolType::Halfblocks => (2, 4),
                _ => {
                    let cell = picker.font_size();
                    (u32::from(cell.width), u32::from(cell.height))
                }
            };
            let (across, down) = (across * u32::from(*width), down * u32::from(*height));
            (across, down, map_of(&spec, across, down)?.into_raw())
        }
    };
    paint(picker, colours, pixels, area)
}

/// The colours of a map.
fn map_of(spec: &renders::MapSpec, width: u32, height: u32) -> Result<RgbaImage, String> {
    let rgba = renders::map_pixels(spec, width, height).map_err(|error| error.to_string())?;
    RgbaImage::from_raw(width, height, rgba).ok_or_else(|| "the map has the wrong size".to_owned())
}

/// A map in letters, one a pixel: brightness, or below and above 1.
fn map_shades(image: &RgbaImage, scale: renders::Scale) -> Vec<String> {
    let letter = |x: u32, y: u32| {
        let [red, green, blue, alpha] = image.get_pixel(x, y).0.map(i32::from);
        match (alpha, scale) {
            (0, _) => ' ',
            (_, renders::Scale::Ratio) => sign(red - blue),
            _ => shade((3 * red + 6 * green + blue) / 10),
        }
    };
    let row = |y| (0..image.width()).map(|x| letter(x, y)).collect();
    (0..image.height()).map(row).collect()
}

/// The letter of a brightness of 0 to 255.
fn shade(brightness: i32) -> char {
    const SHADES: [char; 5] = [' ', '░', '▒', '▓', '█'];
    SHADES[(brightness / 52).clamp(0, 4) as usize]
}

/// The letter of a ratio by its colour, orange or blue.
fn sign(warmth: i32) -> char {
    match warmth {
        30.. => '+',
        ..=-30 => '-',
        _ => '=',
    }
}

/// Pixels (width, height, red green blue alpha) as the terminal shows them in that many cells.
fn paint(
    picker: &Picker,
    colours: bool,
    (columns, rows, rgba): (u32, u32, Vec<u8>),
    area: Size,
) -> Result<Drawn, String> {
    let image = RgbaImage::from_raw(columns, rows, rgba).ok_or("the picture has the wrong size")?;
    if picker.protocol_type() == ProtocolType::Halfblocks {
        return match colours {
            true => half_blocks(&image, area),
            false => Ok(Drawn::Shades(shades(&image, area.width, area.height))),
        };
    }
    SlicedProtocol::new_with_resize(
        picker,
        DynamicImage::ImageRgba8(image),
        area,
        Resize::Scale(None),
    )
    .map(Drawn::Pixels)
    .map_err(|error| error.to_string())
}

/// A picture of two pixels a cell, each the mean of what it covers; no cell is filled in part.
fn half_blocks(image: &RgbaImage, area: Size) -> Result<Drawn, String> {
    let (width, height) = (f64::from(image.width()), f64::from(image.height()));
    let (columns, rows) = (f64::from(area.width), f64::from(area.height));
    let scale = (columns / width).min(2.0 * rows / height);
    let cells = |pixels: f64, most: u16| (pixels.round() as u16).clamp(1, most.max(1));
    let size = Size::new(
        cells(scale * width, area.width),
        cells(scale * height / 2.0, area.height),
    );
    let (columns, rows) = (u32::from(size.width), u32::from(size.height));
    let small = image::imageops::thumbnail(image, columns, 2 * rows);
    Halfblocks::new(DynamicImage::ImageRgba8(small), size)
        .map(|blocks| Drawn::Pixels(SlicedProtocol::Halfblocks(blocks)))
        .map_err(|error| error.to_string())
}

/// The picture on a transparent ground of that size, where it nearly fills it: to be scaled costs
/// more than to be drawn.
fn on_ground(image: RgbaImage, width: u32, height: u32) -> RgbaImage {
    let (columns, rows) = image.dimensions();
    let fills = 10 * columns >= 9 * width || 10 * rows >= 9 * height;
    if columns > width || rows > height || !fills {
        return image;
    }
    let mut ground = RgbaImage::new(width, height);
    let pixels = image.chunks_exact(4 * columns as usize);
    for (to, from) in ground.chunks_exact_mut(4 * width as usize).zip(pixels) {
        to[..from.len()].copy_from_slice(from);
    }
    ground
}

/// [`paint`] for a picture that takes the place of the one before, the `count`th of them. Kitty
/// keeps every picture under its number: here two take turns, so that it keeps no more.
pub fn paint_again(
    picker: &Picker,
    colours: bool,
    pixels: (u32, u32, Vec<u8>),
    area: Size,
    count: u32,
) -> Result<Drawn, String> {
    /// Far from the numbers that are drawn by chance, or at least not likely to meet one.
    const NUMBER: u32 = 0x6c6f_6200;
    if picker.protocol_type() == ProtocolType::Halfblocks {
        return paint(picker, colours, pixels, area);
    }
    let (columns, rows, rgba) = pixels;
    let image = RgbaImage::from_raw(columns, rows, rgba).ok_or("the picture has the wrong size")?;
    let font = picker.font_size();
    let [width, height] = [(area.width, font.width), (area.height, font.height)]
        .map(|(cells, pixels)| u32::from(cells) * u32::from(pixels));
    let image = DynamicImage::ImageRgba8(on_ground(image, width, height));
    let scale = Resize::Scale(None);
    if picker.protocol_type() != ProtocolType::Kitty {
        return SlicedProtocol::new_with_resize(picker, image, area, scale)
            .map(Drawn::Pixels)
            .map_err(|error| error.to_string());
    }
    let image = match (image.width(), image.height()) == (width, height) {
        true => image,
        false => scale.resize(&image, font, area, None),
    };
    Kitty::new(image, area, NUMBER + count % 2, false, false)
        .map(|kitty| Drawn::Pixels(SlicedProtocol::Kitty(kitty)))
        .map_err(|error| error.to_string())
}

/// The panels of one of the lesson's pictures: width, height, pixels.
fn fingerprint_of(
    lesson: &Lesson,
    id: &str,
    size: u32,
    cancel: &AtomicBool,
) -> Result<(u32, u32, Vec<u8>), String> {
    let fingerprint = fingerprint(lesson, id).ok_or("the lesson has no such picture")?;
    // At this size the CPU is done before a driver is loaded, and it writes no messages of its
    // own over the screen.
    let options = renders::Options {
        size,
        backend: renders::Backend::Cpu,
        compact: true,
        ..renders::Options::default()
    };
    let picture =
        renders::render(&fingerprint, &options, cancel).map_err(|error| error.to_string())?;
    Ok((picture.width, picture.height, picture.rgba))
}

/// A picture in letters: brightness in two panels, too dark or too bright in the third.
fn shades(image: &RgbaImage, width: u16, height: u16) -> Vec<String> {
    let (columns, rows) = (u32::from(width), u32::from(height));
    let small = image::imageops::thumbnail(image, columns, rows);
    let letter = |x: u32, y: u32| {
        let [red, green, blue, _] = small.get_pixel(x, y).0.map(i32::from);
        let brightness = (3 * red + 6 * green + blue) / 10;
        match x >= columns * 2 / 3 {
            true if brightness < 50 => ' ',
            true => sign(red - blue),
            false => shade(brightness),
        }
    };
    (0..rows)
        .map(|y| (0..columns).map(|x| letter(x, y)).collect())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_that_nearly_fills_its_ground_is_not_scaled() {
        let grey = image::Rgba([90, 90, 90, 255]);
        let image = || RgbaImage::from_pixel(95, 20, grey);
        let ground = on_ground(image(), 100, 24);
        assert_eq!(ground.dimensions(), (100, 24));
        let covered = ground.enumerate_pixels();
        let covered = covered.filter(|(x, y, pixel)| (*x < 95 && *y < 20) == (**pixel == grey));
        assert_eq!(covered.count(), 100 * 24);
        for (width, height) in [(90, 24), (200, 100)] {
            assert_eq!(on_ground(image(), width, height).dimensions(), (95, 20));
        }
    }

    #[test]
    fn letters_stand_for_brightness_and_for_the_sign_of_the_error() {
        let colours = [[0, 0, 0], [255, 255, 255], [66, 141, 204], [240, 142, 46]];
        let panels = [
            colours[0], colours[1], colours[0], colours[1], colours[2], colours[3],
        ];
        let image = RgbaImage::from_fn(6, 1, |x, _| {
            let [red, green, blue] = panels[x as usize];
            image::Rgba([red, green, blue, 255])
        });
        assert_eq!(shades(&image, 6, 1), [" █ █-+"]);
    }
}
