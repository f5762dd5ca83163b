//! Checks of plates and shells.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::ops::RangeInclusive;

use nalgebra::{Matrix3, Vector3};

use super::checks::{direction, expected, finite, needed, not_negative, positive, vector};
use crate::scene::description::{
    LaminatePly, PatchBody, PatchStiffness, PatchSurface, PatchThickness, SceneVector,
};
use crate::scene::divisions::MOST_DIVISIONS;
use crate::scene::patch::SurfaceMap;
use crate::scene::{Error, PatchMarker};

/// Elements of a plate or shell along each coordinate: factors of finer meshes take gigabytes.
const MESH: RangeInclusive<u32> = 1..=MOST_DIVISIONS;
/// Most plies of a laminate, and most points of a curve or of a row of a grid.
const MOST: usize = 200;
/// Parts along each coordinate between which a surface is looked at.
const PARTS: u32 = 16;
/// Parts along each coordinate between which a thickness is looked at.
const THICKNESSES: u32 = 40;
/// Area of a surface by coordinates, relative to the largest one, below which it collapses.
const COLLAPSED: f64 = 1e-3;
/// Distance from a plane, relative to the size of a surface, up to which it is flat.
const FLAT: f64 = 1e-9;

impl PatchBody {
    /// Checks a plate or a shell on its own; a plate is flat.
    ///
    /// # Errors
    /// A scene of the plane, a key that is missing, out of range or has no place beside another, or a surface that collapses or folds.
    pub(super) fn validate(
        &self,
        path: &str,
        dimension: usize,
        is_plate: bool,
    ) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        if dimension == 2 {
            let wanted = "a body of the plane (plates and shells are of space, \"dimension\": 3)";
            let found = if is_plate { "\"plate\"" } else { "\"shell\"" };
            return Err(expected(&at("element"), wanted, found));
        }
        for (k, count) in self.mesh.counts.iter().enumerate() {
            if !MESH.contains(count) {
                let wanted = format!(
                    "an integer from {} to {} (factors of finer meshes take gigabytes)",
                    MESH.start(),
                    MESH.end()
                );
                return Err(expected(&at(&format!("mesh[{k}]")), &wanted, count));
            }
        }
        self.surface.validate(&at("surface"))?;
        check_map(&at("surface"), &SurfaceMap::new(&self.surface), is_plate)?;
        self.validate_section(path)?;
        for (marker, place) in &self.markers {
            place.validate(&at(&format!("markers.{marker}")))?;
        }
        Ok(())
    }

    /// A material and a thickness, a laminate, or matrices: one of the three.
    fn validate_section(&self, path: &str) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        let is_given = [
            self.material.is_some(),
            !self.laminate.is_empty(),
            self.stiffness.is_some(),
        ];
        let keys = ["material", "laminate", "stiffness"];
        let mut given = keys.into_iter().zip(is_given).filter(|(_, is)| *is);
        let Some((first, _)) = given.next() else {
            let wanted = "a material beside `thickness`, or `laminate` or `stiffness` instead";
            return Err(expected(&at("material"), wanted, "nothing"));
        };
        if let Some((second, _)) = given.next() {
            let wanted = format!("nothing beside `{first}`");
            return Err(expected(&at(second), &wanted, "a value"));
        }
        let beside = [
            ("thickness", self.thickness.is_some(), "material"),
            ("area_density", self.area_density.is_some(), "stiffness"),
        ];
        for (key, is_given, owner) in beside {
            if is_given && owner != first {
                let wanted = format!("nothing beside `{first}`");
                return Err(expected(&at(key), &wanted, "a value"));
            }
        }
        finite(&at("axis_angle"), self.axis_angle)?;
        if let Some(material) = &self.material {
            let thickness = self.thickness.as_ref();
            let thickness = needed(path, "thickness", "a thickness", thickness)?;
            thickness.validate(&at("thickness"))?;
            positive(
                &at("material.youngs_modulus"),
                "Pa",
                material.youngs_modulus,
            )?;
            positive(&at("material.density"), "kg/m^3", material.density)?;
            not_negative(&at("material.damping_time"), "s", material.damping_time)?;
            let ratio = material.poisson_ratio;
            if !(ratio > -1.0 && ratio <= 0.5) {
                let wanted = "a number above -1 and up to 0.5";
                return Err(expected(&at("material.poisson_ratio"), wanted, ratio));
            }
            if let Some(found) = self.damping_time {
                let wanted = "nothing beside `material`, which has one";
                return Err(expected(&at("damping_time"), wanted, found));
            }
            if self.axis_angle != 0.0 {
                let wanted = "0 of an isotropic material, which has no axes";
                return Err(expected(&at("axis_angle"), wanted, self.axis_angle));
            }
        }
        not_negative(
            &at("damping_time"),
            "s",
            self.damping_time.unwrap_or_default(),
        )?;
        if let Some(stiffness) = &self.stiffness {
            let density = "a mass per area (kg/m^2)";
            let density = needed(path, "area_density", density, self.area_density)?;
            positive(&at("area_density"), "kg/m^2", density)?;
            stiffness.validate(&at("stiffness"))?;
        }
        self.validate_laminate(&at("laminate"))?;
        self.validate_numbers(&at(first))
    }

    fn validate_laminate(&self, path: &str) -> Result<(), Error> {
        if self.laminate.len() > MOST {
            let wanted = format!("at most {MOST} plies");
            return Err(expected(path, &wanted, self.laminate.len()));
        }
        for (index, ply) in self.laminate.iter().enumerate() {
            ply.validate(&format!("{path}[{index}]"))?;
        }
        Ok(())
    }

    /// The whole stiffness is finite and positive definite, and so is the mass.
    fn validate_numbers(&self, path: &str) -> Result<(), Error> {
        let section = self.section([0.5; 2]);
        let parts = [section.membrane, section.coupling, section.bending];
        let mut entries = parts.as_flattened().as_flattened().iter();
        if !entries.all(|entry| entry.is_finite()) || !section.area_density.is_normal() {
            let wanted = "values whose stiffness and mass are numbers of the machine";
            return Err(expected(path, wanted, "ones beyond"));
        }
        if !section.is_positive() {
            let wanted =
                "a stiffness that is positive definite: work for every strain and curvature";
            return Err(expected(path, wanted, "one that is not"));
        }
        Ok(())
    }
}

impl PatchThickness {
    fn validate(&self, path: &str) -> Result<(), Error> {
        if let Self::Number(number) = self {
            return positive(path, "m", *number);
        }
        let line = (0..=THICKNESSES).map(|k| f64::from(k) / f64::from(THICKNESSES));
        for place in line.clone().flat_map(|a| line.clone().map(move |b| [a, b])) {
            let found = self.at(place).map_err(|told| Error::new(path, told))?;
            if !found.is_normal() || found < 0.0 {
                let [first, second] = place;
                let wanted = "a positive thickness (m) all over the surface";
                let found = format!("{found} at s1 = {first}, s2 = {second}");
                return Err(expected(path, wanted, found));
            }
        }
        Ok(())
    }
}

impl PatchStiffness {
    fn validate(&self, path: &str) -> Result<(), Error> {
        for (key, rows) in [("A", self.A), ("B", self.B), ("D", self.D)] {
            let place = format!("{path}.{key}");
            for (row, entries) in rows.iter().enumerate() {
                for (column, entry) in entries.iter().enumerate() {
                    finite(&format!("{place}[{row}][{column}]"), *entry)?;
                }
            }
            let matrix = Matrix3::from(rows);
            if (matrix - matrix.transpose()).amax() > 1e-9 * matrix.amax() {
                return Err(expected(&place, "a symmetric matrix", format!("{rows:?}")));
            }
        }
        Ok(())
    }
}

impl LaminatePly {
    fn validate(&self, path: &str) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        let material = &self.material;
        positive(&at("thickness"), "m", self.thickness)?;
        finite(&at("angle"), self.angle)?;
        for (k, modulus) in material.youngs_modulus.into_iter().enumerate() {
            positive(&at(&format!("material.youngs_modulus[{k}]")), "Pa", modulus)?;
        }
        positive(&at("material.shear_modulus"), "Pa", material.shear_modulus)?;
        positive(&at("material.density"), "kg/m^3", material.density)?;
        let ([first, second], ratio) = (material.youngs_modulus, material.poisson_ratio);
        let most = (first / second).sqrt();
        let is_definite = ratio.abs() < most;
        if !is_definite {
            let wanted =
                format!("a number between -{most} and {most} (the root of the ratio of moduli)");
            return Err(expected(&at("material.poisson_ratio"), &wanted, ratio));
        }
        Ok(())
    }
}

impl PatchMarker {
    fn validate(&self, path: &str) -> Result<(), Error> {
        let (at, pad) = match self {
            Self::Point(_) => (path.to_owned(), None),
            Self::Pad(pad) => (format!("{path}.at"), Some(pad.pad)),
        };
        for (k, found) in self.at().into_iter().enumerate() {
            if !(0.0..=1.0).contains(&found) {
                return Err(expected(
                    &format!("{at}[{k}]"),
                    "a number from 0 to 1",
                    found,
                ));
            }
        }
        for (k, found) in pad.into_iter().flatten().enumerate() {
            positive(&format!("{path}.pad[{k}]"), "m", found)?;
        }
        Ok(())
    }
}

impl PatchSurface {
    fn validate(&self, path: &str) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{}.{key}", self.name());
        let each = |key: &str, points: &[SceneVector]| {
            let mut places = points.iter().enumerate();
            places.try_for_each(|(k, point)| vector(&at(&format!("{key}[{k}]")), 3, point))
        };
        match self {
            Self::Rectangle { corner, edges } => {
                vector(&at("corner"), 3, corner)?;
                each("edges", edges)
            }
            Self::Quadrilateral { corners } => each("corners", corners),
            Self::Annulus {
                center,
                normal,
                start,
                radii,
                angle,
            } => {
                vector(&at("center"), 3, center)?;
                about(&at("normal"), normal, &at("start"), start)?;
                ring(&at("radii"), *radii)?;
                if radii[1] <= radii[0] {
                    let wanted = format!("more than the inner radius ({} m)", radii[0]);
                    return Err(expected(&at("radii[1]"), &wanted, radii[1]));
                }
                sector(&at("angle"), *angle)
            }
            Self::Cylinder {
                from,
                to,
                radius,
                start,
                angle,
            } => {
                positive(&at("radius"), "m", *radius)?;
                along([(&at("from"), from), (&at("to"), to)], &at("start"), start)?;
                sector(&at("angle"), *angle)
            }
            Self::Cone {
                from,
                to,
                radii,
                start,
                angle,
            } => {
                ring(&at("radii"), *radii)?;
                along([(&at("from"), from), (&at("to"), to)], &at("start"), start)?;
                sector(&at("angle"), *angle)
            }
            Self::Sphere {
                center,
                radius,
                axis,
                start,
                latitudes,
                angle,
            } => {
                vector(&at("center"), 3, center)?;
                positive(&at("radius"), "m", *radius)?;
                about(&at("axis"), axis, &at("start"), start)?;
                for (k, found) in latitudes.iter().enumerate() {
                    let is_between = found.abs() < FRAC_PI_2;
                    if !is_between {
                        let wanted = "a latitude between the poles (-pi/2 and pi/2 rad)";
                        return Err(expected(&at(&format!("latitudes[{k}]")), wanted, found));
                    }
                }
                if latitudes[1] <= latitudes[0] {
                    let wanted = format!("more than the first latitude ({} rad)", latitudes[0]);
                    return Err(expected(&at("latitudes[1]"), &wanted, latitudes[1]));
                }
                sector(&at("angle"), *angle)
            }
            Self::Ruled { curves } => {
                let mut curves = curves.iter().enumerate();
                curves.try_for_each(|(k, points)| row(&at(&format!("curves[{k}]")), points))
            }
            Self::Points { grid } => check_grid(&at("grid"), grid),
        }
    }
}

/// Points of a curve.
fn row(path: &str, points: &[SceneVector]) -> Result<(), Error> {
    counted(path, points.len())?;
    let mut places = points.iter().enumerate();
    places.try_for_each(|(k, point)| vector(&format!("{path}[{k}]"), 3, point))
}

/// Lists of as many points each.
fn check_grid(path: &str, grid: &[Vec<SceneVector>]) -> Result<(), Error> {
    counted(path, grid.len())?;
    for (k, points) in grid.iter().enumerate() {
        let place = format!("{path}[{k}]");
        counted(&place, points.len())?;
        if points.len() != grid[0].len() {
            let wanted = format!("{} points, as in the first list", grid[0].len());
            return Err(expected(&place, &wanted, points.len()));
        }
        row(&place, points)?;
    }
    Ok(())
}

/// As many points that a curve goes through them.
fn counted(path: &str, found: usize) -> Result<(), Error> {
    if (2..=MOST).contains(&found) {
        return Ok(());
    }
    Err(expected(path, &format!("2 to {MOST} points"), found))
}

/// Radii without a pole.
fn ring(path: &str, radii: [f64; 2]) -> Result<(), Error> {
    let mut places = radii.into_iter().enumerate();
    places.try_for_each(|(k, radius)| positive(&format!("{path}[{k}]"), "m", radius))
}

/// An angle of a sector.
fn sector(path: &str, angle: f64) -> Result<(), Error> {
    if angle > 0.0 && angle <= TAU {
        return Ok(());
    }
    Err(expected(
        path,
        "an angle above 0 and up to 2 pi (rad)",
        angle,
    ))
}

/// Two ends of an axis, and a direction that is not along it.
fn along(ends: [(&str, &SceneVector); 2], path: &str, start: &SceneVector) -> Result<(), Error> {
    for (place, end) in ends {
        vector(place, 3, end)?;
    }
    let [(_, from), (place, to)] = ends;
    let axis = Vector3::from(to.full()) - Vector3::from(from.full());
    if !axis.norm().is_normal() {
        let found = format!("{:?} twice", from.given());
        return Err(expected(place, "another end of the axis", found));
    }
    across(path, start, axis)
}

/// An axis, and a direction that is not along it.
fn about(place: &str, axis: &SceneVector, path: &str, start: &SceneVector) -> Result<(), Error> {
    direction(place, 3, axis)?;
    across(path, start, axis.full().into())
}

fn across(path: &str, start: &SceneVector, axis: Vector3<f64>) -> Result<(), Error> {
    direction(path, 3, start)?;
    let [start, axis] = [start.full().into(), axis].map(|of: Vector3<f64>| of.normalize());
    if axis.cross(&start).norm() > 1e-6 {
        return Ok(());
    }
    Err(expected(
        path,
        "a direction that is not along the axis",
        format!("{:?}", start.as_slice()),
    ))
}

/// A surface that has a normal everywhere, which does not flip, and is flat where it is to be.
fn check_map(path: &str, map: &SurfaceMap, is_plate: bool) -> Result<(), Error> {
    let place = |k: u32| f64::from(k) / f64::from(PARTS);
    let places = || (0..=PARTS).flat_map(|i| (0..=PARTS).map(move |j| [place(i), place(j)]));
    let normal = |at: [f64; 2]| {
        let [_, first, second, _] = map.at(at);
        first.cross(&second)
    };
    let told = |[u, v]: [f64; 2]| format!("[s1, s2] = [{u}, {v}]");
    let largest = places().map(|at| normal(at).norm()).fold(0.0, f64::max);
    let has_normal = |at: &[f64; 2]| normal(*at).norm() > COLLAPSED * largest;
    let collapsed = places().find(|at| !has_normal(at));
    if let Some(at) = collapsed.filter(|_| largest.is_finite()) {
        let wanted = "a surface whose lines along s1 and s2 cross at an angle everywhere";
        return Err(expected(
            path,
            wanted,
            format!("one that collapses at {}", told(at)),
        ));
    }
    if !largest.is_normal() {
        return Err(expected(
            path,
            "a surface with an area of the machine's numbers",
            largest,
        ));
    }
    let [middle, along, ..] = map.at([0.5; 2]);
    let of_middle = normal([0.5; 2]).normalize();
    let size = map.lengths().into_iter().fold(along.norm(), f64::max);
    let height = |at: [f64; 2]| (map.at(at)[0] - middle).dot(&of_middle).abs();
    if is_plate && let Some(at) = places().find(|at| height(*at) > FLAT * size) {
        let wanted = "a flat surface of a plate (\"element\": \"shell\" takes curved ones)";
        let found = format!("{} m off the plane at {}", height(at), told(at));
        return Err(expected(path, wanted, found));
    }
    // Curved surfaces may turn over, but not from one place to the next.
    let folds = |at: &[f64; 2]| {
        let step = f64::from(PARTS).recip();
        let beside = [[at[0] - step, at[1]], [at[0], at[1] - step]];
        let mut beside = beside.into_iter().filter(|of| of[0] >= 0.0 && of[1] >= 0.0);
        let is_alike = |of: [f64; 2]| normal(*at).dot(&normal(of)) > 0.0;
        beside.any(|of| !is_alike(of))
    };
    if let Some(at) = places().find(folds) {
        let wanted = "a surface that does not fold over itself";
        return Err(expected(
            path,
            wanted,
            format!("one that does at {}", told(at)),
        ));
    }
    Ok(())
}
