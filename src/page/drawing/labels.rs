//! Names beside points, none over another.

use super::picture::Picture;
use crate::page::canvas::{Point, moved, text_box};
use crate::picture::Style;
use crate::picture::palette::FAINT;

/// A box in the image: left, upper, right and lower edge, pixels.
pub(super) type Box = [f64; 4];

/// Ways around a point that a name is tried at, from the side that it should be on, rad.
const TURNS: [f64; 8] = [0.0, 0.8, -0.8, 1.6, -1.6, 2.4, -2.4, 3.15];
/// How much further from the point names are tried, one time after the other, units.
const FURTHER: [f64; 8] = [0.0, 0.8, 1.6, 2.8, 4.2, 6.0, 8.0, 11.0];
/// From here on a line leads to a name, units further.
const FAR: f64 = 2.0;
/// Least gap between names, and between a name and the edge of the image, pixels.
const GAP: f64 = 1.5;

fn is_apart(a: &Box, b: &Box) -> bool {
    a[2] + GAP <= b[0] || b[2] + GAP <= a[0] || a[3] + GAP <= b[1] || b[3] + GAP <= a[1]
}

fn turned([x, y]: Point, angle: f64) -> Point {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

impl Picture<'_> {
    /// Writes lines at a distance from a point, on a side of it; elsewhere about it where they would cover what is written already or leave
    /// the image. Where nothing is free they stand where they should.
    pub(super) fn write(
        &mut self,
        point: Point,
        side: Point,
        distance: f64,
        lines: &[(&str, &'static str)],
    ) {
        let unit = self.unit;
        let place = |further: f64, turn: f64| {
            let side = turned(side, turn);
            (moved(point, side, distance + further * unit), side, further)
        };
        let ways = FURTHER.into_iter();
        let mut ways = ways.flat_map(|further| TURNS.map(|turn| place(further, turn)));
        let free = ways.find(|(at, side, _)| self.is_free(&text_box(*at, *side, lines)));
        let (at, side, further) = free.unwrap_or_else(|| place(0.0, 0.0));
        if further >= FAR {
            let ends = [moved(point, side, 0.6 * unit), moved(at, side, -3.0)];
            self.canvas.polyline(&ends, Style::line(FAINT, 0.7));
        }
        self.written.push(text_box(at, side, lines));
        self.canvas.texts(at, side, lines);
    }

    fn is_free(&self, found: &Box) -> bool {
        let [width, height] = [self.canvas.width(), self.canvas.height()];
        let is_inside = found[0] >= GAP
            && found[1] >= GAP
            && found[2] <= width - GAP
            && found[3] <= height - GAP;
        is_inside && self.written.iter().all(|other| is_apart(found, other))
    }
}
