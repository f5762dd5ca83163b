//! The image that a scene is drawn into: where its points are in there.

use std::f64::consts::FRAC_PI_6;

use super::labels::Box;
use crate::page::canvas::{Canvas, Point, direction, moved};
use crate::picture::palette::FAINT;
use crate::picture::symbols;
use crate::scene::{Ends, Resolved, ResolvedMarker, Scene};

/// A marker in the image.
#[derive(Clone, Copy)]
pub(super) struct MarkerInImage {
    /// Where it is, pixels.
    pub(super) point: Point,
    /// Direction of the marker, y downwards.
    pub(super) direction: Point,
}

/// A scene that is being drawn.
pub(super) struct Picture<'a> {
    pub(super) resolved: &'a Resolved<'a>,
    pub(super) scene: &'a Scene,
    pub(super) canvas: Canvas,
    /// Pixels a metre.
    scale: f64,
    /// The point of the scene in the middle of the image, m.
    middle: Point,
    /// The middle of the image, pixels.
    centre: Point,
    /// Size of symbols, pixels.
    pub(super) unit: f64,
    /// Whether names are written.
    pub(super) names: bool,
    /// Where something is written.
    pub(super) written: Vec<Box>,
}

impl<'a> Picture<'a> {
    /// An empty image of a scene between two corners, m.
    pub(super) fn new(
        resolved: &'a Resolved<'a>,
        [low, high]: [Point; 2],
        size: Point,
        margin: f64,
        unit: f64,
        names: bool,
    ) -> Self {
        let scene = resolved.scene;
        let room = |axis: usize| (size[axis] - 2.0 * margin) / (high[axis] - low[axis]);
        Self {
            resolved,
            scene,
            canvas: Canvas::new(size[0], size[1]),
            // One extent of a straight line is zero and asks for no room; the other is not.
            scale: room(0).min(room(1)),
            middle: [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])],
            centre: [0.5 * size[0], 0.5 * size[1]],
            unit,
            names,
            // Of gravity, whose arrow is in the upper right corner, and of the axes in the lower left one.
            written: vec![
                [size[0] - 5.0 * unit, 0.0, size[0], 5.2 * unit],
                [0.0, size[1] - 6.0 * unit, 6.0 * unit, size[1]],
            ],
        }
    }

    /// From metres to pixels.
    pub(super) fn at(&self, point: [f64; 3]) -> Point {
        let [across, up] = self.seen(point);
        [
            self.centre[0] + self.scale * (across - self.middle[0]),
            self.centre[1] - self.scale * (up - self.middle[1]),
        ]
    }

    /// A length in the image, pixels.
    pub(super) fn pixels(&self, length: f64) -> f64 {
        self.scale * length
    }

    /// Where a point or a vector is seen, m: as it is in the plane, in an isometric view of space.
    pub(super) fn seen(&self, point: [f64; 3]) -> Point {
        seen(self.scene.dimension, point)
    }

    /// A direction of the scene in the image, y downwards.
    pub(super) fn way(&self, along: [f64; 3]) -> Point {
        let [across, up] = self.seen(along);
        direction([across, -up])
    }

    /// A marker in the image.
    pub(super) fn place(&self, marker: ResolvedMarker<'a>) -> MarkerInImage {
        let [across, up] = self.seen(marker.direction);
        MarkerInImage {
            point: self.at(marker.position),
            direction: [across, -up],
        }
    }

    /// Where the two ends of a joint or spring are.
    pub(super) fn ends(&self, ends: &Ends<'_>) -> [Point; 2] {
        ends.points().map(|point| self.at(point))
    }

    /// An arrow in the upper right corner, where no body is drawn.
    pub(super) fn gravity(&mut self) {
        let gravity = self.scene.gravity.full();
        if gravity == [0.0; 3] {
            return;
        }
        let corner = [self.canvas.width() - 2.6 * self.unit, 2.6 * self.unit];
        let along = self.way(gravity);
        let ends = [-1.7, 1.7].map(|end| moved(corner, along, end * self.unit));
        self.symbol(&symbols::arrow(FAINT), ends, self.unit);
        let side = [-along[1].abs(), along[0].abs()];
        let at = moved(corner, side, 0.8 * self.unit);
        self.canvas.texts(at, side, &[("g", FAINT)]);
    }
}

impl Picture<'_> {
    /// The global axes with their names, in the lower left corner.
    pub(super) fn axes(&mut self) {
        let corner = [2.6 * self.unit, self.canvas.height() - 2.6 * self.unit];
        for (axis, name) in ["x", "y", "z"]
            .iter()
            .enumerate()
            .take(self.scene.dimension)
        {
            let along = self.way(std::array::from_fn(|k| f64::from(u8::from(k == axis))));
            let tip = moved(corner, along, 2.0 * self.unit);
            self.symbol(&symbols::arrow(FAINT), [corner, tip], 0.7 * self.unit);
            let at = moved(corner, along, 2.2 * self.unit);
            self.canvas.texts(at, along, &[(name, FAINT)]);
        }
    }
}

/// Where a point is seen, m: as it is in the plane; in space from the front, the right and above, so that x goes to the
/// right and down, y to the right and up, z up.
pub(super) fn seen(dimension: usize, [x, y, z]: [f64; 3]) -> Point {
    if dimension == 2 {
        return [x, y];
    }
    let (sin, cos) = FRAC_PI_6.sin_cos();
    [(x + y) * cos, (y - x) * sin + z]
}
