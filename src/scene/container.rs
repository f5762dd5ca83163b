//! Files of reduced models: named arrays in the layout of safetensors, read without trust.
//!
//! The layout: 8 bytes with the length of the header, little-endian; the header in JSON, which gives each array its type, shape and place;
//! the data. Arrays are row-major, in SI, in axes and from an origin that are the file's own. What is read is rotated to the principal axes
//! about the centre of mass.

mod arrays;
#[cfg(test)]
pub(in crate::scene) mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};
use sha2::{Digest, Sha256};

use crate::elements::reduced::{Interface, ReducedModel, Symmetric};
use crate::scene::Inertia;
use arrays::{Arrays, wrong};

/// Text of the key `format` among the metadata.
const FORMAT: &str = "flexbody reduced body";
/// Version of the format that is read.
const VERSION: &str = "1";
/// Most modes of a file.
const MOST_MODES: usize = 200;
/// Most letters of the name of an interface or of a stress.
const MOST_LETTERS: usize = 100;
/// Part of the largest entry by which entries that are equal may differ.
const ROUNDED: f64 = 1e-6;
/// Words that begin names of arrays and are no interfaces.
const SURFACE: &str = "surface";
const STRESS: &str = "stress";

/// A reduced model as a file has it, rotated to its principal axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Container {
    /// Where it comes from, in words.
    pub source: String,
    /// Highest frequency that the mesh resolves, Hz.
    pub highest_frequency: Option<f64>,
    /// All modes, about the centre of mass in principal axes.
    pub model: ReducedModel,
    /// Centre of mass in the file's axes, m.
    pub center: Vector3<f64>,
    /// Principal axes in the file's axes, as columns, right-handed.
    pub axes: Matrix3<f64>,
    /// Arrays that pictures and outputs take beside the model.
    pub details: Details,
    /// The file.
    bytes: Arc<[u8]>,
    /// SHA-256 of the file, hexadecimal.
    digest: String,
}

/// Arrays of a reduced model that its motion does not depend on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Details {
    /// Points on the surface in the file's axes and from its origin, m.
    pub points: Vec<Vector3<f32>>,
    /// Displacements of these points by modes in the file's axes, `[points modes]`.
    pub modes: Vec<Vector3<f32>>,
    /// Triangles by the numbers of their points.
    pub triangles: Vec<[u32; 3]>,
    /// Stresses at these points by modes, `xx yy zz xy xz yz` in the file's axes, `[points modes]`, Pa; empty where the file has none.
    pub point_stresses: Vec<[f32; 6]>,
    /// Stresses by modes and name, `xx yy zz xy xz yz` in the file's axes, `[modes]`, Pa.
    pub stresses: BTreeMap<String, Vec<[f64; 6]>>,
}

impl Container {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that is none of a reduced model: the array, what was expected of it and what was found.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let mut arrays = Arrays::new(bytes)?;
        let (source, highest_frequency) = told(arrays.metadata())?;
        let body = RigidPart::read(&mut arrays)?;
        let mut reader = ModelReader {
            modes: count_of_modes(&arrays)?,
            paired: 0,
            arrays,
            body,
        };
        let model = reader.model()?;
        let details = reader.details()?;
        reader.arrays.finish()?;
        let digest = Sha256::digest(bytes);
        Ok(Self {
            source,
            highest_frequency,
            model,
            center: reader.body.center,
            axes: reader.body.axes,
            details,
            bytes: bytes.into(),
            digest: digest.iter().map(|byte| format!("{byte:02x}")).collect(),
        })
    }

    /// Returns what a scene of the plane takes of the file: the model in the plane of the file's first two axes, along these, with modes
    /// that the plane excites.
    #[must_use]
    pub fn in_plane(&self) -> Self {
        let projected = self.model.in_plane(&self.axes);
        let modes = projected.excited_in_plane();
        let rows = self.details.modes.chunks_exact(self.model.modes());
        let rows = rows.flat_map(|row| modes.iter().map(|mode| row[*mode]));
        let stresses = self.details.stresses.iter().map(|(name, by_modes)| {
            let kept = modes.iter().map(|mode| by_modes[*mode]);
            (name.clone(), kept.collect())
        });
        Self {
            model: projected.of_modes(&modes),
            axes: Matrix3::identity(),
            center: Vector3::new(self.center.x, self.center.y, 0.0),
            details: Details {
                modes: rows.collect(),
                stresses: stresses.collect(),
                ..self.details.clone()
            },
            ..self.clone()
        }
    }

    /// The file.
    pub fn bytes(&self) -> &Arc<[u8]> {
        &self.bytes
    }

    /// SHA-256 of the file, hexadecimal in lower case.
    pub fn digest(&self) -> &str {
        &self.digest
    }

    /// Inertia about the centre of mass in the file's axes, `xx yy zz xy xz yz`, kg m^2.
    pub fn tensor(&self) -> [f64; 6] {
        let moments = Matrix3::from_diagonal(&self.model.moments.into());
        components(&(self.axes * moments * self.axes.transpose()))
    }

    /// Natural frequencies of the free body, Hz.
    pub fn frequencies(&self) -> Vec<f64> {
        let eigenvalues = self.model.eigenvalues.iter();
        eigenvalues
            .map(|eigenvalue| eigenvalue.sqrt() / std::f64::consts::TAU)
            .collect()
    }

    /// A direction or a way in the file's axes along the principal axes.
    pub fn directed(&self, way: [f64; 3]) -> [f64; 3] {
        self.axes.tr_mul(&Vector3::from(way)).into()
    }

    /// Way from the centre of mass to the origin of the file along the principal axes, m.
    pub fn from_center(&self) -> [f64; 3] {
        self.directed((-self.center).into())
    }

    /// Index of an interface.
    pub fn interface(&self, name: &str) -> Option<usize> {
        let mut interfaces = self.model.interfaces.iter();
        interfaces.position(|interface| interface.name == name)
    }

    /// Place of an interface without deformation in the file's axes and from its origin, m.
    pub fn place(&self, interface: usize) -> Vector3<f64> {
        self.center + self.axes * self.model.interfaces[interface].position
    }
}

/// Source and highest frequency among the metadata.
fn told(metadata: &BTreeMap<String, String>) -> Result<(String, Option<f64>), String> {
    let of = |key: &str| metadata.get(key).map(String::as_str);
    for (key, wanted) in [("format", FORMAT), ("version", VERSION)] {
        let found = of(key);
        if found != Some(wanted) {
            let found = found.map_or("nothing".into(), |text| format!("{text:?}"));
            return Err(wrong(
                &format!("__metadata__.{key}"),
                &format!("{wanted:?}"),
                found,
            ));
        }
    }
    let highest = of("highest_frequency").map(|text| match text.trim().parse() {
        Ok(number) if f64::is_finite(number) && number > 0.0 => Ok(number),
        _ => Err(wrong(
            "__metadata__.highest_frequency",
            "a positive number (Hz) as text",
            format!("{text:?}"),
        )),
    });
    Ok((
        of("source").unwrap_or_default().to_owned(),
        highest.transpose()?,
    ))
}

fn count_of_modes(arrays: &Arrays<'_>) -> Result<usize, String> {
    let found = arrays.shape("eigenvalues")?;
    match *found {
        [modes] if (1..=MOST_MODES).contains(&modes) => Ok(modes),
        _ => Err(wrong(
            "eigenvalues",
            &format!("the shape [n], n from 1 to {MOST_MODES}"),
            format!("{found:?}"),
        )),
    }
}

/// Mass, centre and principal axes.
struct RigidPart {
    mass: f64,
    center: Vector3<f64>,
    moments: [f64; 3],
    axes: Matrix3<f64>,
}

impl RigidPart {
    fn read(arrays: &mut Arrays<'_>) -> Result<Self, String> {
        let mass = arrays.numbers("mass", &[1])?[0];
        if mass <= 0.0 {
            return Err(wrong("mass", "a positive number (kg)", mass));
        }
        let center = Vector3::from_column_slice(&arrays.numbers("centre", &[3])?);
        let given = arrays.numbers("inertia", &[6])?;
        let tensor = matrix(&symmetric(&given));
        let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| tensor[(i, j)]));
        let (moments, axes) = Inertia::Tensor(rows).principal();
        let mut sorted = moments;
        sorted.sort_by(f64::total_cmp);
        let [a, b, c] = sorted;
        // Products that spoil the axes, or numbers of which no square is a number, leave no axes.
        let is_positive = a > 0.0 && axes.iter().all(|part| part.is_finite());
        if !is_positive || c > (a + b) * (1.0 + ROUNDED) {
            let wanted = "principal moments of inertia that are positive, none of them more than the sum of the other two";
            return Err(wrong("inertia", wanted, format!("{sorted:?}")));
        }
        Ok(Self {
            mass,
            center,
            moments,
            axes,
        })
    }
}

/// Reads arrays of modes and rotates them to the principal axes.
struct ModelReader<'a> {
    arrays: Arrays<'a>,
    body: RigidPart,
    modes: usize,
    paired: usize,
}

impl ModelReader<'_> {
    fn model(&mut self) -> Result<ReducedModel, String> {
        let n = self.modes;
        let eigenvalues = self.arrays.numbers("eigenvalues", &[n])?;
        check_eigenvalues(&eigenvalues)?;
        let inertia_1 = self.arrays.numbers("inertia_1", &[n, 6])?;
        let inertia_1: Vec<_> = inertia_1
            .chunks_exact(6)
            .map(|of| self.tensor(of))
            .collect();
        let mut inertia_2 = self.arrays.numbers("inertia_2", &[n, n, 6])?;
        mirror("inertia_2", &mut inertia_2, n, 6, 1.0)?;
        let mut coupling = self.arrays.numbers("coupling", &[n, n, 3])?;
        mirror("coupling", &mut coupling, n, 3, -1.0)?;
        let coupling: Vec<_> = coupling.chunks_exact(3).map(|of| self.way(of)).collect();
        // |N_kl| <= 1 by Cauchy and Schwarz.
        if let Some(at) = coupling.iter().position(|of| of.norm() > 1.0 + ROUNDED) {
            let wanted =
                "vectors of length 1 at most, as modes that are orthonormal in the mass have";
            let found = format!("length {} at [{}, {}]", coupling[at].norm(), at / n, at % n);
            return Err(wrong("coupling", wanted, found));
        }
        let cubic = self.cubic()?;
        Ok(ReducedModel {
            mass: self.body.mass,
            moments: self.body.moments,
            eigenvalues,
            inertia_1,
            inertia_2: inertia_2
                .chunks_exact(6)
                .map(|of| self.tensor(of))
                .collect(),
            coupling,
            paired: self.paired,
            cubic,
            interfaces: self.interfaces()?,
            of_file: None,
        })
    }

    /// Cubic terms of the strain energy. They say how many modes are paired.
    fn cubic(&mut self) -> Result<Vec<f64>, String> {
        let n = self.modes;
        let Ok(shape) = self.arrays.shape("cubic") else {
            return Ok(Vec::new());
        };
        let paired = match *shape {
            [modes, a, b] if modes == n && a == b && (1..=n).contains(&a) => a,
            _ => {
                let wanted = format!("the shape [{n}, m, m], m from 1 to {n}");
                return Err(wrong("cubic", &wanted, format!("{shape:?}")));
            }
        };
        self.paired = paired;
        let mut cubic = self.arrays.numbers("cubic", &[n, paired, paired])?;
        for of_mode in cubic.chunks_exact_mut(paired * paired) {
            mirror("cubic", of_mode, paired, 1, 1.0)?;
        }
        Ok(cubic)
    }

    fn interfaces(&mut self) -> Result<Vec<Interface>, String> {
        let names: BTreeSet<String> = (self.arrays.names())
            .filter_map(|name| name.split_once('.'))
            .map(|(interface, _)| interface)
            .filter(|interface| ![SURFACE, STRESS].contains(interface))
            .map(str::to_owned)
            .collect();
        if names.is_empty() {
            let wanted = "at least one interface with NAME.position and NAME.modes";
            return Err(wrong("NAME.position", wanted, "none"));
        }
        names.iter().map(|name| self.interface(name)).collect()
    }

    fn interface(&mut self, name: &str) -> Result<Interface, String> {
        check_name(name)?;
        let at = |key: &str| format!("{name}.{key}");
        let (n, paired) = (self.modes, self.paired);
        let position = self.arrays.numbers(&at("position"), &[3])?;
        let position = self.way(&position) - self.body.axes.tr_mul(&self.body.center);
        let modes = self.arrays.numbers(&at("modes"), &[3, n])?;
        let rotation = self.arrays.optional(&at("rotation"), &[3, n])?;
        let mut second = Vec::new();
        if self.arrays.shape(&at("second")).is_ok() {
            if paired == 0 {
                let wanted = "`cubic` beside second-order displacements";
                return Err(wrong(&at("second"), wanted, "none"));
            }
            second = self.arrays.numbers(&at("second"), &[3, paired, paired])?;
            for of_component in second.chunks_exact_mut(paired * paired) {
                mirror(&at("second"), of_component, paired, 1, 1.0)?;
            }
        }
        Ok(Interface {
            name: name.to_owned(),
            position,
            modes: self.ways(&modes),
            rotation: rotation.map(|rotation| self.ways(&rotation)),
            second: self.ways(&second),
            second_rotation: Vec::new(),
        })
    }

    fn details(&mut self) -> Result<Details, String> {
        let n = self.modes;
        let mut details = Details::default();
        let names: Vec<String> = (self.arrays.names())
            .filter_map(|name| name.strip_prefix("stress."))
            .map(str::to_owned)
            .collect();
        for name in names {
            check_name(&name)?;
            let of = self.arrays.numbers(&format!("{STRESS}.{name}"), &[6, n])?;
            let stress = |k: usize| std::array::from_fn(|c| of[n * c + k]);
            details.stresses.insert(name, (0..n).map(stress).collect());
        }
        let Ok(shape) = self.arrays.shape("surface.points") else {
            return Ok(details);
        };
        let points = shape.first().copied().unwrap_or_default();
        let given = self.arrays.numbers("surface.points", &[points, 3])?;
        let points_of = given.chunks_exact(3);
        details.points = points_of
            .map(|of| Vector3::from_column_slice(of).cast())
            .collect();
        let modes = self.arrays.singles("surface.modes", &[points, 3, n])?;
        for of_point in modes.chunks_exact(3 * n) {
            let mode = |k: usize| Vector3::new(of_point[k], of_point[n + k], of_point[2 * n + k]);
            details.modes.extend((0..n).map(mode));
        }
        if self.arrays.shape("surface.stress").is_ok() {
            let stresses = self.arrays.singles("surface.stress", &[points, 6, n])?;
            for of_point in stresses.chunks_exact(6 * n) {
                let stress = |k: usize| std::array::from_fn(|c| of_point[n * c + k]);
                details.point_stresses.extend((0..n).map(stress));
            }
        }
        if let Ok(shape) = self.arrays.shape("surface.triangles") {
            let count = shape.first().copied().unwrap_or_default();
            let corners = self.arrays.integers("surface.triangles", &[count, 3])?;
            if let Some(found) = corners.iter().find(|corner| **corner as usize >= points) {
                let wanted = format!("numbers of the {points} points");
                return Err(wrong("surface.triangles", &wanted, found));
            }
            let triangles = corners.chunks_exact(3).map(|of| [of[0], of[1], of[2]]);
            details.triangles = triangles.collect();
        }
        Ok(details)
    }

    /// A vector of three numbers in the principal axes.
    fn way(&self, of: &[f64]) -> Vector3<f64> {
        self.body.axes.tr_mul(&Vector3::from_column_slice(of))
    }

    /// The vectors of an array `[3, count]` in the principal axes.
    fn ways(&self, array: &[f64]) -> Vec<Vector3<f64>> {
        let count = array.len() / 3;
        let way = |k: usize| self.way(&[array[k], array[count + k], array[2 * count + k]]);
        (0..count).map(way).collect()
    }

    /// A symmetric tensor in the principal axes.
    fn tensor(&self, of: &[f64]) -> Symmetric {
        components(&(self.body.axes.tr_mul(&matrix(&symmetric(of))) * self.body.axes))
    }
}

/// Components of a tensor that is symmetric but for rounding.
fn components(of: &Matrix3<f64>) -> Symmetric {
    let mean = |i: usize, j: usize| 0.5 * (of[(i, j)] + of[(j, i)]);
    [
        of[(0, 0)],
        of[(1, 1)],
        of[(2, 2)],
        mean(0, 1),
        mean(0, 2),
        mean(1, 2),
    ]
}

fn symmetric(of: &[f64]) -> Symmetric {
    std::array::from_fn(|at| of[at])
}

fn matrix([xx, yy, zz, xy, xz, yz]: &Symmetric) -> Matrix3<f64> {
    Matrix3::new(*xx, *xy, *xz, *xy, *yy, *yz, *xz, *yz, *zz)
}

fn check_eigenvalues(eigenvalues: &[f64]) -> Result<(), String> {
    let wanted = "squares of the natural frequencies (1/s^2), positive and ascending";
    let wanted = format!("{wanted}, without rigid motions");
    let mut before = 0.0;
    for (k, found) in eigenvalues.iter().enumerate() {
        if *found <= 0.0 || *found < before {
            return Err(wrong("eigenvalues", &wanted, format!("{found} at [{k}]")));
        }
        before = *found;
    }
    Ok(())
}

/// Checks the name of an interface or of a stress.
fn check_name(name: &str) -> Result<(), String> {
    let is_fit = |c: char| !c.is_control() && c != '.';
    let letters = name.chars().count();
    if (1..=MOST_LETTERS).contains(&letters) && name.chars().all(is_fit) {
        return Ok(());
    }
    let shown: String = name.chars().take(MOST_LETTERS).collect();
    let wanted =
        format!("a name of 1 to {MOST_LETTERS} characters without a dot before NAME.position");
    Err(format!("expected {wanted}, found {shown:?}"))
}

/// Checks that blocks of so many numbers of a square array are equal to those across the diagonal, times a sign, and takes their mean.
fn mirror(name: &str, array: &mut [f64], n: usize, block: usize, sign: f64) -> Result<(), String> {
    let largest = array.iter().fold(0.0, |most: f64, of| most.max(of.abs()));
    for k in 0..n {
        for l in 0..=k {
            for c in 0..block {
                let [a, b] = [(k, l), (l, k)].map(|(k, l)| block * (n * k + l) + c);
                let off = (array[a] - sign * array[b]).abs();
                if off > ROUNDED * largest {
                    let is = if sign > 0.0 { "" } else { "anti" };
                    let wanted = format!("an array that is {is}symmetric in its modes");
                    let found = format!("{} at [{k}, {l}], {} at [{l}, {k}]", array[a], array[b]);
                    return Err(wrong(name, &wanted, found));
                }
                let mean = 0.5 * (array[a] + sign * array[b]);
                (array[a], array[b]) = (mean, sign * mean);
            }
        }
    }
    Ok(())
}
