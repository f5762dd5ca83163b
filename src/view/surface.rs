//! Surfaces of bodies for other programs: of cables, rods and beams rings of points along their lines, of rigid bodies their shape, of
//! reduced bodies the surface of their files.

use nalgebra::{UnitQuaternion, Vector3};

use super::header::mesh;
use super::recording::Recording;
use super::sections::{has_corners, sections};
use super::sheets::largest_von_mises;
use super::skins::{MovingStress, seen_modes};
use crate::elements::shape;
use crate::math::rotation::{self, Quaternion};
use crate::picture::Skin;
use crate::scene::{BodyReference, FileBody, PatchBody, RigidBody, Solid};
use crate::simulation::Pose;

/// Points around what is round, and fewest sections along a body.
const AROUND: u32 = 16;
const ALONG: usize = 48;
/// Half of what stands for a body without a shape, in sizes of the scene.
const BAR: f64 = 0.006;

/// A point with axes: the first along a line or that of a frame.
#[derive(Clone, Copy)]
pub(super) struct PointWithAxes {
    pub point: Vector3<f64>,
    pub axes: [Vector3<f64>; 3],
}

impl PointWithAxes {
    /// A point given along the axes.
    pub fn at(&self, local: &[f64; 3]) -> Vector3<f64> {
        let [a, b, c] = &self.axes;
        self.point + a * local[0] + b * local[1] + c * local[2]
    }

    /// The axes as a quaternion, scalar first, of both the one that is nearer to another.
    pub fn quaternion(&self, near: &Quaternion) -> Quaternion {
        rotation::quaternion_near(&self.axes, near)
    }
}

/// A place along the line of a body.
#[derive(Clone, Copy)]
struct LineStation {
    element: usize,
    /// Part of the element in [0, 1].
    xi: f64,
}

/// The surface of a body: points, each along the axes of one of the places that move, and polygons between points.
pub(super) struct BodySurface {
    pub name: String,
    /// Place of every point, and its coordinates there, m.
    pub points: Vec<(usize, [f64; 3])>,
    pub faces: Vec<Vec<usize>>,
    /// Modes that move points of a reduced body: their places in the file, and displacements of all points, m.
    pub modes: Vec<(usize, Vec<[f64; 3]>)>,
    /// Stress of von Mises at all points of a reduced body whose file has stresses, and of a plate or shell the larger one of both faces, frame
    /// by frame, Pa; else none.
    pub stresses: Vec<Vec<f64>>,
    /// Where every place is; none of a rigid body, which has one place.
    stations: Vec<LineStation>,
    lengths: Vec<f64>,
    body: usize,
}

impl BodySurface {
    /// Where its places are in a frame.
    pub fn places(&self, recording: &Recording, frame: usize) -> Vec<PointWithAxes> {
        let pose = &recording.poses[frame][self.body];
        if self.stations.is_empty() {
            return vec![rigid_place(pose, recording.scene.dimension)];
        }
        let mut places: Vec<PointWithAxes> = Vec::new();
        for station in &self.stations {
            let before = places.last().map(|place| place.axes[1]);
            places.push(self.section(pose, *station, recording.scene.dimension, before));
        }
        places
    }

    /// Coordinates of a point in a frame along the axes of its place, m.
    pub fn local(&self, point: usize, recording: &Recording, frame: usize) -> [f64; 3] {
        let amplitudes = &recording.poses[frame][self.body].amplitudes;
        let modes = self.modes.iter();
        modes.fold(self.points[point].1, |at, (mode, ways)| {
            std::array::from_fn(|k| at[k] + amplitudes[*mode] * ways[point][k])
        })
    }

    fn section(
        &self,
        pose: &Pose,
        LineStation { element, xi }: LineStation,
        dimension: usize,
        before: Option<Vector3<f64>>,
    ) -> PointWithAxes {
        let length = self.lengths[element];
        let weighted = |weights: [f64; 4]| {
            let ends = [element, element + 1].map(|node| pose.nodes[node].map(Vector3::from));
            let [[p, u], [q, v]] = ends;
            p * weights[0] + u * weights[1] + q * weights[2] + v * weights[3]
        };
        let point = weighted(shape::values(xi, length).into());
        let mut along = weighted(shape::slopes(xi, length).into()).normalize();
        let axes_of = |node: usize| pose.axes.get(node).map(|axes| axes.map(Vector3::from));
        let second = match (axes_of(element), axes_of(element + 1)) {
            (Some(a), Some(b)) if dimension == 2 => {
                along = a[0].lerp(&b[0], xi).normalize();
                Vector3::z()
            }
            (Some(a), Some(b)) => {
                let turn = |axes: &[Vector3<f64>; 3]| {
                    let [w, x, y, z] = rotation::quaternion(axes);
                    UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z))
                };
                turn(&a).nlerp(&turn(&b), xi) * Vector3::y()
            }
            _ if dimension == 2 => Vector3::z(),
            _ => before.unwrap_or_else(|| Vector3::ith(along.iamin(), 1.0)),
        };
        let second = (second - along * along.dot(&second)).normalize();
        PointWithAxes {
            point,
            axes: [along, second, along.cross(&second)],
        }
    }
}

fn rigid_place(pose: &Pose, dimension: usize) -> PointWithAxes {
    let [point, first] = pose.nodes[0].map(Vector3::from);
    let axes = match pose.axes.first() {
        Some(axes) => axes.map(Vector3::from),
        None if dimension == 2 => {
            let first = first.normalize();
            [first, Vector3::z().cross(&first), Vector3::z()]
        }
        None => [Vector3::x(), Vector3::y(), Vector3::z()],
    };
    PointWithAxes { point, axes }
}

/// Surfaces of all bodies.
pub(super) fn surfaces(recording: &Recording) -> Vec<BodySurface> {
    let resolved = recording.scene.resolved();
    let size = extent(recording);
    let bodies = resolved.bodies.iter().enumerate();
    bodies
        .map(|(body, reference)| match reference {
            BodyReference::Cable(cable) => {
                let mesh = mesh(&resolved, *cable);
                let whole = cable.body.shape.length();
                let lengths = mesh.windows(2).map(|ends| (ends[1] - ends[0]) * whole);
                let sections = sections(cable.body, &mesh);
                let name = &cable.body.name;
                chain(
                    name,
                    body,
                    lengths.collect(),
                    &sections,
                    has_corners(cable.body),
                )
            }
            BodyReference::Rigid(rigid) => solid(rigid.body, body, size),
            BodyReference::Reduced(reduced) => deforming(recording, reduced.body, body)
                .unwrap_or_else(|| star(reduced.body, body, size)),
            BodyReference::Plate(plate) => sheet(recording, plate.body, body),
        })
        .collect()
}

/// Largest distance of two nodes along an axis in the first frame, m.
fn extent(recording: &Recording) -> f64 {
    let nodes = || recording.poses[0].iter().flat_map(|pose| &pose.nodes);
    let ends = |axis: usize| {
        let values = nodes().map(move |node| node[0][axis]);
        let (low, high) = (
            values.clone().fold(f64::INFINITY, f64::min),
            values.fold(f64::NEG_INFINITY, f64::max),
        );
        high - low
    };
    let largest = (0..3).map(ends).fold(0.0, f64::max);
    if largest > 0.0 { largest } else { 1.0 }
}

fn chain(
    name: &str,
    body: usize,
    lengths: Vec<f64>,
    sections: &[[[f64; 2]; 2]],
    corners: bool,
) -> BodySurface {
    let parts = ALONG.div_ceil(lengths.len());
    let count = parts * lengths.len();
    let stations: Vec<LineStation> = (0..=count)
        .map(|ring| {
            let element = (ring / parts).min(lengths.len() - 1);
            let xi = (ring - element * parts) as f64 / parts as f64;
            LineStation { element, xi }
        })
        .collect();
    let rim: Vec<[f64; 2]> = if corners {
        vec![[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]
    } else {
        circle(1.0)
    };
    let width = rim.len();
    let mut points = Vec::new();
    for (ring, LineStation { element, xi }) in stations.iter().enumerate() {
        let [a, b] = sections[*element];
        let half = |k: usize| a[k] + (b[k] - a[k]) * xi;
        points.extend(
            rim.iter()
                .map(|[y, z]| (ring, [0.0, y * half(0), z * half(1)])),
        );
    }
    let mut faces = vec![
        (0..width).rev().collect(),
        (count * width..(count + 1) * width).collect(),
    ];
    for ring in 0..count {
        for k in 0..width {
            let next = (k + 1) % width;
            let at = |ring: usize, k: usize| ring * width + k;
            faces.push(vec![
                at(ring, k),
                at(ring, next),
                at(ring + 1, next),
                at(ring + 1, k),
            ]);
        }
    }
    BodySurface {
        name: name.into(),
        points,
        faces,
        modes: Vec::new(),
        stresses: Vec::new(),
        stations,
        lengths,
        body,
    }
}

fn circle(radius: f64) -> Vec<[f64; 2]> {
    let angle = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(AROUND);
    (0..AROUND)
        .map(|k| [radius * angle(k).cos(), radius * angle(k).sin()])
        .collect()
}

/// Points and polygons so far.
#[derive(Default)]
struct Built {
    points: Vec<[f64; 3]>,
    faces: Vec<Vec<usize>>,
}

impl Built {
    /// A surface around an axis through rings of half width and place along it; closed where it comes back to the first.
    fn around(&mut self, axis: [f64; 3], rings: &[[f64; 2]], is_closed: bool) {
        let axis = Vector3::from(axis).normalize();
        let across = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
        let beside = axis.cross(&across);
        let (width, mut starts) = (AROUND as usize, Vec::new());
        for [radius, along] in rings {
            starts.push(self.points.len());
            // All of a ring without width is one point.
            let points = if *radius > 0.0 { width } else { 1 };
            let ring = circle(*radius).into_iter().take(points);
            self.points.extend(
                ring.map(|[y, z]| <[f64; 3]>::from(axis * *along + across * y + beside * z)),
            );
        }
        let at = |ring: usize, k: usize| {
            if rings[ring][0] > 0.0 {
                starts[ring] + k % width
            } else {
                starts[ring]
            }
        };
        let count = if is_closed {
            rings.len()
        } else {
            rings.len() - 1
        };
        for ring in 0..count {
            let next = (ring + 1) % rings.len();
            for k in 0..width {
                let mut face = vec![at(ring, k), at(ring, k + 1), at(next, k + 1), at(next, k)];
                face.dedup();
                self.faces.push(face);
            }
        }
    }

    fn brick(&mut self, centre: Vector3<f64>, halves: [Vector3<f64>; 3]) {
        let first = self.points.len();
        for corner in 0..8_usize {
            let side = |k: usize| if corner >> k & 1 == 1 { 1.0 } else { -1.0 };
            let way = (0..3).map(|k| halves[k] * side(k)).sum::<Vector3<f64>>();
            self.points.push((centre + way).into());
        }
        let sides = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        self.faces
            .extend(sides.map(|side| side.map(|corner| first + corner).to_vec()));
    }

    /// A block about a centre, and bars from there to points that are further away.
    fn star(&mut self, center: Vector3<f64>, ends: impl Iterator<Item = Vector3<f64>>, half: f64) {
        self.brick(center, [0, 1, 2].map(|k| Vector3::ith(k, 1.5 * half)));
        for end in ends {
            let way = end - center;
            if way.norm() > half {
                let along = way.normalize();
                let across = along.cross(&Vector3::ith(along.iamin(), 1.0)).normalize();
                self.brick(
                    center + 0.5 * way,
                    [0.5 * way, across * half, along.cross(&across) * half],
                );
            }
        }
    }

    /// The surface of a body that moves with one frame.
    fn rigid(self, name: &str, body: usize) -> BodySurface {
        BodySurface {
            name: name.to_owned(),
            points: self.points.into_iter().map(|point| (0, point)).collect(),
            faces: self.faces,
            modes: Vec::new(),
            stresses: Vec::new(),
            stations: Vec::new(),
            lengths: Vec::new(),
            body,
        }
    }
}

fn solid(rigid: &RigidBody, body: usize, size: f64) -> BodySurface {
    let mut built = Built::default();
    match rigid.shape {
        Some(Solid::Box { size }) => {
            let half = |k: usize| Vector3::ith(k, 0.5 * size[k]);
            built.brick(Vector3::zeros(), [half(0), half(1), half(2)]);
        }
        Some(Solid::Sphere { radius }) => {
            let angle = |k: u32| std::f64::consts::PI * f64::from(k) / f64::from(AROUND / 2);
            let rings =
                (0..=AROUND / 2).map(|k| [radius * angle(k).sin(), -radius * angle(k).cos()]);
            built.around([0.0, 0.0, 1.0], &Vec::from_iter(rings), false);
        }
        Some(Solid::Cylinder {
            radius,
            length,
            axis,
        }) => {
            let [low, high] = [-0.5 * length, 0.5 * length];
            built.around(
                axis,
                &[[0.0, low], [radius, low], [radius, high], [0.0, high]],
                false,
            );
        }
        Some(Solid::Tube {
            radius,
            inner_radius,
            length,
            axis,
        }) => {
            let [low, high] = [-0.5 * length, 0.5 * length];
            let rings = [
                [inner_radius, low],
                [radius, low],
                [radius, high],
                [inner_radius, high],
            ];
            built.around(axis, &rings, true);
        }
        None => {
            let ends = rigid.markers.values().map(|marker| marker.full().into());
            built.star(Vector3::zeros(), ends, BAR * size);
        }
    }
    built.rigid(&rigid.name, body)
}

/// Bars from the centre of mass of a reduced body to its interfaces, which move with its axes.
fn star(reduced: &FileBody, body: usize, size: f64) -> BodySurface {
    let (mut built, container) = (Built::default(), reduced.contained());
    let interfaces = 0..container.model.interfaces.len();
    let ends = interfaces.map(|index| container.place(index));
    built.star(container.center, ends, BAR * size);
    built.rigid(&reduced.name, body)
}

/// A plate or shell with the modes of its run.
fn sheet(recording: &Recording, patch: &PatchBody, body: usize) -> BodySurface {
    let mut built = Built::default();
    let quads = patch.grid().quads().into_iter();
    built.faces = quads.map(|corners| corners.to_vec()).collect();
    let sheet = recording.sheets[body].as_ref();
    let points = sheet.map_or(&[][..], |sheet| &sheet.points);
    built.points = points.iter().map(|point| (*point).into()).collect();
    let modes = sheet.map_or(&[][..], |sheet| &sheet.modes);
    let ways = |of: &Vec<Vector3<f64>>| of.iter().map(|way| (*way).into()).collect();
    let modes = modes.iter().map(ways).enumerate().collect();
    let frames = recording.stresses.iter().map(|bodies| &bodies[body]);
    let frames = frames.filter(|points| !points.is_empty());
    let stresses = frames.map(|points| points.iter().map(largest_von_mises).collect());
    BodySurface {
        modes,
        stresses: stresses.collect(),
        ..built.rigid(&patch.name, body)
    }
}

/// The surface of a reduced body whose file has one.
fn deforming(recording: &Recording, reduced: &FileBody, body: usize) -> Option<BodySurface> {
    let skin = Skin::whole(reduced.contained())?;
    let points = 0..skin.points.len();
    let built = Built {
        points: points
            .clone()
            .map(|point| skin.place(point).into())
            .collect(),
        faces: skin
            .triangles
            .iter()
            .map(|corners| corners.to_vec())
            .collect(),
    };
    let ways = |mode: usize| {
        let ways = points.clone().map(|point| skin.mode(point, mode).into());
        (mode, ways.collect())
    };
    let modes = seen_modes(recording, body, &skin).into_iter().map(ways);
    let modes = modes.collect();
    let stress = MovingStress::of(recording, body, &skin, usize::MAX);
    let stresses = stress.map_or_else(Vec::new, |stress| {
        let strains = recording.poses.iter().map(|poses| &poses[body].strains);
        let frame = |strains: &Vec<f64>| {
            let points = points.clone();
            points
                .map(|point| stress.at(&skin, point, strains))
                .collect()
        };
        strains.map(frame).collect()
    });
    Some(BodySurface {
        modes,
        stresses,
        ..built.rigid(&reduced.name, body)
    })
}
