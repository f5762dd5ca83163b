//! A minimal writer of SVG: plain shapes with presentation attributes, pixels to one decimal, so
//! that any renderer reads it and equal scenes give equal bytes.

use std::fmt::Write;

use crate::picture::{Style, palette};

/// A point or a direction in pixels, y downwards.
pub type Point = [f64; 2];

/// From one line of text to the next, pixels.
pub const LINE: f64 = 16.0;

/// Height of a letter, and its mean width in the fonts that pages are read with, pixels.
const LETTER: [f64; 2] = [13.0, 7.6];

/// An SVG image in the making.
pub struct Canvas {
    width: f64,
    height: f64,
    body: String,
}

impl Canvas {
    /// An empty image of this size in pixels.
    pub fn new(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            body: String::new(),
        }
    }

    /// Height in pixels.
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Width in pixels.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// The image as a document.
    pub fn finish(self, title: &str) -> String {
        let (width, height) = (pixels(self.width), pixels(self.height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
            escape(title),
            self.body
        )
    }

    /// An open line; a closed one where it has an inside.
    pub fn polyline(&mut self, points: &[Point], style: Style) {
        let mut data = String::new();
        for (index, point) in points.iter().enumerate() {
            let letter = if index == 0 { "M" } else { " L" };
            write(&mut data, format_args!("{letter}{}", pair(*point)));
        }
        if style.is_filled() {
            data.push_str(" Z");
        }
        let shape = format!("path d=\"{data}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"");
        self.shape(&shape, style);
    }

    /// Triangles as one shape, with what they cover of each other.
    pub fn triangles(&mut self, triangles: &[[Point; 3]], style: Style) {
        let mut data = String::new();
        for [a, b, c] in triangles {
            let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            // All go round alike, so that none is a hole in another one.
            let [b, c] = if turn < 0.0 { [c, b] } else { [b, c] };
            let [a, b, c] = [a, b, c].map(|point| pair(*point));
            write(&mut data, format_args!("M{a} L{b} L{c} Z"));
        }
        self.shape(&format!("path d=\"{data}\""), style);
    }

    /// Lines between pairs of points, as one shape.
    pub fn segments(&mut self, ends: &[[Point; 2]], style: Style) {
        let mut data = String::new();
        for [a, b] in ends {
            write(&mut data, format_args!("M{} L{}", pair(*a), pair(*b)));
        }
        let shape = format!("path d=\"{data}\" stroke-linecap=\"round\"");
        self.shape(&shape, style);
    }

    /// A circle.
    pub fn circle(&mut self, centre: Point, radius: f64, style: Style) {
        let [x, y] = centre.map(pixels);
        self.shape(
            &format!("circle cx=\"{x}\" cy=\"{y}\" r=\"{}\"", pixels(radius)),
            style,
        );
    }

    /// Lines of text with their colours, beside the point `at` and away from it towards `side`.
    pub fn texts(&mut self, at: Point, side: Point, lines: &[(&str, &str)]) {
        let (anchor, above) = anchor(side);
        let last = lines.len() as f64 - 1.0;
        for (number, (text, colour)) in lines.iter().enumerate() {
            // A third of its size lower, a letter is centred on the line.
            let y = at[1] + LINE * (number as f64 - above * last) + 4.5;
            let (x, y, text) = (pixels(at[0]), pixels(y), escape(text));
            // A halo keeps it legible on lines.
            let line = format_args!(
                "  <text x=\"{x}\" y=\"{y}\" font-family=\"sans-serif\" font-size=\"13\" text-anchor=\"{anchor}\" fill=\"{colour}\" \
                 stroke=\"{}\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\">{text}</text>\n",
                palette::PAPER
            );
            write(&mut self.body, line);
        }
    }

    fn shape(&mut self, shape: &str, style: Style) {
        let Style {
            stroke,
            width,
            fill,
        } = style;
        let line = if width > 0.0 {
            format!("stroke=\"{stroke}\" stroke-width=\"{}\"", pixels(width))
        } else {
            "stroke=\"none\"".into()
        };
        write(
            &mut self.body,
            format_args!("  <{shape} {line} fill=\"{fill}\"/>\n"),
        );
    }
}

/// Which end of the lines of a text is at its point, and how much of their height is above it: the block ends, begins or is centred there, as
/// it lies above, below or beside.
fn anchor(side: Point) -> (&'static str, f64) {
    match side {
        [x, _] if x > 0.5 => ("start", 0.5),
        [x, _] if x < -0.5 => ("end", 0.5),
        [_, y] if y < 0.0 => ("middle", 1.0),
        _ => ("middle", 0.0),
    }
}

/// Edges of what [`Canvas::texts`] writes, about: left, upper, right, lower, pixels.
pub fn text_box(at: Point, side: Point, lines: &[(&str, &str)]) -> [f64; 4] {
    let (anchor, above) = anchor(side);
    let letters = lines.iter().map(|(text, _)| text.chars().count()).max();
    let width = LETTER[1] * letters.unwrap_or(0) as f64;
    let left = match anchor {
        "start" => at[0],
        "end" => at[0] - width,
        _ => at[0] - 0.5 * width,
    };
    let height = LINE * lines.len().saturating_sub(1) as f64;
    let upper = at[1] - above * height - 0.5 * LETTER[0];
    [left, upper, left + width, upper + height + LETTER[0]]
}

/// `point` moved by `distance` along `direction`.
pub fn moved(point: Point, direction: Point, distance: f64) -> Point {
    [
        point[0] + distance * direction[0],
        point[1] + distance * direction[1],
    ]
}

/// The vector with length one; downwards if it has none.
pub fn direction(vector: Point) -> Point {
    let length = vector[0].hypot(vector[1]);
    if length > 0.0 {
        vector.map(|component| component / length)
    } else {
        [0.0, 1.0]
    }
}

/// Text for XML and HTML.
pub fn escape(text: &str) -> String {
    quick_xml::escape::escape(text).into_owned()
}

fn write(target: &mut String, text: std::fmt::Arguments<'_>) {
    target
        .write_fmt(text)
        .expect("writing into memory cannot fail");
}

/// One decimal, without a negative zero.
fn pixels(value: f64) -> String {
    format!("{:.1}", (10.0 * value).round() / 10.0 + 0.0)
}

fn pair(point: Point) -> String {
    format!("{} {}", pixels(point[0]), pixels(point[1]))
}
