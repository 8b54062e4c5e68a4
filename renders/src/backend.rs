//! A [`Canvas`] as a plotters backend: anti-aliased strokes and the bundled font, which
//! plotters' own bitmap backend does not offer.

use crate::canvas::{Align, Canvas, Style};
use crate::colour::Rgb;
use crate::text::{self, Weight};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontStyle, FontTransform,
    text_anchor::{HPos, VPos},
};
use std::convert::Infallible;

/// Backend coordinates in one pixel.
pub(crate) const EIGHTHS: f64 = 8.0;

/// The bundled font first, then what a browser that shows an SVG may have.
pub(crate) const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

/// Draws on a canvas from (`left`, `top`) on.
pub(crate) struct CanvasBackend<'a> {
    canvas: &'a mut Canvas,
    left: f32,
    top: f32,
}

impl<'a> CanvasBackend<'a> {
    pub(crate) fn new(canvas: &'a mut Canvas, left: f64, top: f64) -> Self {
        Self {
            canvas,
            left: left as f32,
            top: top as f32,
        }
    }

    fn pixel(&self, (x, y): BackendCoord) -> (f32, f32) {
        (self.left + pixels(x), self.top + pixels(y))
    }
}

fn pixels(eighths: i32) -> f32 {
    eighths as f32 / EIGHTHS as f32
}

fn rgb(colour: BackendColor) -> (Rgb, f32) {
    (
        [colour.rgb.0, colour.rgb.1, colour.rgb.2],
        colour.alpha as f32,
    )
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

impl DrawingBackend for CanvasBackend<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        let eighths = |size: usize| {
            u32::try_from(size)
                .unwrap_or(u32::MAX)
                .saturating_mul(EIGHTHS as u32)
        };
        (eighths(self.canvas.width()), eighths(self.canvas.height()))
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Drawn {
        let ((x, y), (colour, opacity)) = (self.pixel(point), rgb(color));
        let side = 1.0 / EIGHTHS as f32;
        self.canvas.rect(x, y, side, side, colour, opacity);
        Ok(())
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Drawn {
        self.draw_path([from, to], style)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        let points: Vec<(f32, f32)> = path.into_iter().map(|point| self.pixel(point)).collect();
        let (colour, opacity) = rgb(style.color());
        self.canvas.stroke(
            &points,
            style.stroke_width() as f32 / EIGHTHS as f32,
            colour,
            opacity,
        );
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        upper_left: BackendCoord,
        bottom_right: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Drawn {
        let ((left, top), (right, bottom)) = (self.pixel(upper_left), self.pixel(bottom_right));
        let (colour, opacity) = rgb(style.color());
        if fill {
            self.canvas
                .rect(left, top, right - left, bottom - top, colour, opacity);
        } else {
            let corners = [
                (left, top),
                (right, top),
                (right, bottom),
                (left, bottom),
                (left, top),
            ];
            self.canvas.stroke(
                &corners,
                style.stroke_width() as f32 / EIGHTHS as f32,
                colour,
                opacity,
            );
        }
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        corners: I,
        style: &S,
    ) -> Drawn {
        let corners: Vec<(f32, f32)> = corners.into_iter().map(|point| self.pixel(point)).collect();
        self.canvas.polygon(&corners, rgb(style.color()).0);
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        center: BackendCoord,
        radius: u32,
        style: &S,
        _fill: bool,
    ) -> Drawn {
        let ((x, y), (colour, _)) = (self.pixel(center), rgb(style.color()));
        self.canvas
            .disc(x, y, radius as f32 / EIGHTHS as f32, colour);
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        line: &str,
        style: &S,
        position: BackendCoord,
    ) -> Drawn {
        let (x, y) = self.pixel(position);
        let (colour, _) = rgb(style.color());
        let em = em(style);
        let align = match style.anchor().h_pos {
            HPos::Left => Align::Left,
            HPos::Center => Align::Centre,
            HPos::Right => Align::Right,
        };
        // The same offsets as the SVG backend writes, so that both pictures agree.
        let drop = match style.anchor().v_pos {
            VPos::Top => 0.76 * em,
            VPos::Center => 0.27 * em,
            VPos::Bottom => -0.27 * em,
        };
        let look = Style::new(em, weight(style), align, colour);
        if let FontTransform::Rotate270 = style.transform() {
            self.canvas.text_up(x + drop, y, look, line);
        } else {
            self.canvas.text(x, y + drop, look, line);
        }
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        line: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let em = em(style);
        let eighths = |pixels: f32| (pixels * EIGHTHS as f32).ceil() as u32;
        Ok((eighths(text::width(line, em, weight(style))), eighths(em)))
    }
}

fn em<S: BackendTextStyle>(style: &S) -> f32 {
    (style.size() / 1.24 / EIGHTHS) as f32
}

fn weight<S: BackendTextStyle>(style: &S) -> Weight {
    match style.style() {
        FontStyle::Bold => Weight::Bold,
        _ => Weight::Regular,
    }
}
