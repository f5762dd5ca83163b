//! Checks of shapes of cross sections.

use super::checks::{expected, finite, positive};
use crate::elements::saint_venant::{OutlineFlaw, flaw};
use crate::scene::{Error, Profile, between_parts};

/// Most corners of a polygon, holes included.
const MOST_CORNERS: usize = 200;
/// Largest error of a torsion constant, as part of it.
const TORSION_ERROR: f64 = 1e-3;

impl Profile {
    /// Checks the sizes of a shape.
    ///
    /// # Errors
    /// A length that is not positive, a wall that does not fit, or an outline that is none.
    pub(super) fn validate(&self, place: &str) -> Result<(), Error> {
        for (key, _, length) in self.clone().lengths() {
            positive(&format!("{place}.{key}"), "m", *length)?;
        }
        let below = |key: &str, found: f64, most: f64, wanted: &str| {
            if found < most {
                return Ok(());
            }
            let wanted = format!("less than {most} m, {wanted}");
            Err(expected(
                &format!("{place}.{key}"),
                &wanted,
                format!("{found} m"),
            ))
        };
        match *self {
            Self::Rectangle { .. } | Self::Ellipse { .. } | Self::Circle { .. } => {}
            Self::Tube {
                radius,
                inner_radius,
            } if inner_radius >= radius => {
                let path = format!("{place}.inner_radius");
                return Err(expected(&path, "less than the outer radius", inner_radius));
            }
            Self::Tube { .. } => {}
            Self::HollowEllipse {
                width, inner_width, ..
            } => below("inner_width", inner_width, width, "the width")?,
            Self::Polygon { .. } => self.validate_loops(place)?,
            Self::Box { .. }
            | Self::I { .. }
            | Self::C { .. }
            | Self::T { .. }
            | Self::L { .. } => {
                let [width, height, web, flange] = self.walls().expect("walls of such a shape");
                let (width, of_width) = match self {
                    Self::Box { .. } => (0.5 * width, "half of the width"),
                    _ => (width, "the width"),
                };
                let (height, of_height) = match self {
                    Self::T { .. } | Self::L { .. } => (height, "the height"),
                    _ => (0.5 * height, "half of the height"),
                };
                below("web_thickness", web, width, of_width)?;
                below("flange_thickness", flange, height, of_height)?;
            }
        }
        self.validate_solution(place)
    }

    /// Checks a point at which stress of torsion is read.
    ///
    /// # Errors
    /// A point outside a polygon, or a corner at which stress is unbounded.
    pub(super) fn validate_point(&self, path: &str, [y, z]: [f64; 2]) -> Result<(), Error> {
        let Some(outline) = self.outline() else {
            return Ok(());
        };
        let found = format!("[{y}, {z}]");
        if !self.holds([y, z]) {
            let [low, high] = outline.bounds();
            let wanted = format!(
                "a point of the section, measured from its centroid, where it reaches from {low:?} to {high:?}"
            );
            return Err(expected(path, &wanted, found));
        }
        let corners = outline.loops.concat();
        let size = outline.area.sqrt();
        let is_at = |k: &usize| (corners[*k][0] - y).hypot(corners[*k][1] - z) < 1e-6 * size;
        if outline.reentrant(1e-3).iter().any(is_at) {
            let wanted = "a point apart from corners that the material reaches around, where stress of torsion is unbounded";
            return Err(expected(path, wanted, found));
        }
        Ok(())
    }

    /// Checks the polygons that finite elements solve between this one and another.
    ///
    /// # Errors
    /// A polygon between both that is none.
    pub(super) fn validate_between(&self, last: &Self, place: &str) -> Result<(), Error> {
        let size = signed_area(self);
        for part in between_parts() {
            let Some(shape) = self.between(last, part) else {
                continue;
            };
            let refused = |found: &str| {
                let wanted = "corners that lead from those of the station before through polygons";
                expected(place, wanted, format!("at {part:.3} of the way: {found}"))
            };
            // One that is turned over has passed a line.
            if signed_area(&shape) / size < 1e-6 {
                return Err(refused("one without area"));
            }
            let checked = shape.validate(place);
            checked.map_err(|error| refused(&error.message))?;
        }
        Ok(())
    }

    /// Torsion and flexure are solved well enough.
    fn validate_solution(&self, place: &str) -> Result<(), Error> {
        let shear = self.shear();
        if shear.is_some_and(|found| found.error <= TORSION_ERROR) {
            return Ok(());
        }
        let wanted = format!(
            "a shape whose torsion constant is found to {TORSION_ERROR:e}, with walls that are not so thin"
        );
        let found = match shear {
            Some(found) => format!("one that is found to {:.1e}", found.error),
            None => "one that has no triangles".into(),
        };
        Err(expected(place, &wanted, found))
    }

    /// Checks the corners of a polygon.
    fn validate_loops(&self, place: &str) -> Result<(), Error> {
        let loops = self.loops().unwrap_or_default();
        let name = |number: usize| match number {
            0 => format!("{place}.outline"),
            hole => format!("{place}.holes[{}]", hole - 1),
        };
        for (number, corners) in loops.iter().enumerate() {
            for (k, corner) in corners.iter().enumerate() {
                for (axis, way) in corner.iter().enumerate() {
                    finite(&format!("{}[{k}][{axis}]", name(number)), *way)?;
                }
            }
        }
        let count: usize = loops.iter().map(Vec::len).sum();
        if count > MOST_CORNERS {
            let wanted = format!("at most {MOST_CORNERS} corners, those of holes included");
            return Err(expected(place, &wanted, count));
        }
        let Some(flaw) = flaw(&loops) else {
            return Ok(());
        };
        let corner = |number: usize, k: usize| {
            let [y, z] = loops[number][k % loops[number].len()];
            format!("[{y}, {z}]")
        };
        let edge = |(number, k): (usize, usize)| {
            format!("from {} to {}", corner(number, k), corner(number, k + 1))
        };
        Err(match flaw {
            OutlineFlaw::Few(number) => {
                expected(&name(number), "three corners or more", loops[number].len())
            }
            OutlineFlaw::Repeated(number, k) => {
                let path = format!("{}[{k}]", name(number));
                expected(&path, "another corner than the next one", corner(number, k))
            }
            OutlineFlaw::Meeting([first, second]) => {
                let path = format!("{}[{}]", name(first.0), first.1);
                let wanted = "an edge that meets no other";
                let found = format!(
                    "the one {}, which meets that {} of {}",
                    edge(first),
                    edge(second),
                    name(second.0)
                );
                expected(&path, wanted, found)
            }
            OutlineFlaw::Apart(number) => {
                let wanted = "a hole inside the outline and outside of other holes";
                expected(
                    &name(number),
                    wanted,
                    format!("one at {}", corner(number, 0)),
                )
            }
        })
    }
}

/// Area inside the outline of a polygon, m^2: positive if its corners are counter-clockwise.
fn signed_area(shape: &Profile) -> f64 {
    let corners = shape.loops().unwrap_or_default();
    let corners = corners.first().map_or(&[][..], Vec::as_slice);
    let next = |k: usize| corners[(k + 1) % corners.len()];
    let sizes = corners.iter().enumerate();
    let sizes = sizes.map(|(k, [y, z])| 0.5 * (y * next(k)[1] - next(k)[0] * z));
    sizes.sum()
}
