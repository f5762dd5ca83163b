//! Surfaces of the ground and of rigid bodies that bodies touch.

use super::bodies::outline;
use super::picture::Picture;
use crate::page::canvas::Point;
use crate::picture::Style;
use crate::picture::palette::BED;
use crate::scene::{Resolved, Surface};

/// Everything of all surfaces that is told by points around the bodies, m.
fn each(
    resolved: &Resolved<'_>,
    of: impl Fn(&Surface, &[[f64; 3]]) -> Vec<Vec<[f64; 3]>>,
) -> Vec<Vec<[f64; 3]>> {
    let bodies = resolved.bodies.iter();
    let near = bodies.flat_map(|body| outline(*body, resolved.scene.dimension));
    let near: Vec<[f64; 3]> = near.collect();
    let loads = resolved.loads.iter();
    let surfaces = loads.filter_map(|load| load.kind.surface());
    let found = surfaces.map(|(surface, owner)| match owner {
        None => of(surface, &near),
        Some(rigid) => { of(surface, &rigid.body.extent()).into_iter() }
            .map(|line| {
                line.into_iter()
                    .map(|point| rigid.body.point(point))
                    .collect()
            })
            .collect(),
    });
    found.flatten().collect()
}

/// Points of surfaces that the image has to have room for, m.
pub(super) fn outlines(resolved: &Resolved<'_>) -> Vec<[f64; 3]> {
    each(resolved, |surface, near| vec![surface.outline(near)]).concat()
}

impl Picture<'_> {
    pub(super) fn surfaces(&mut self) {
        let style = Style::line(BED, 0.08 * self.unit);
        let dimension = self.scene.dimension;
        for line in each(self.resolved, |surface, near| {
            surface.lines(dimension, near)
        }) {
            let points: Vec<Point> = line.into_iter().map(|point| self.at(point)).collect();
            self.canvas.polyline(&points, style);
        }
    }
}
