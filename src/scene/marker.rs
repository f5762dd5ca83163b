//! Bodies and markers: how they are found by name, and where they are at the start.

use nalgebra::{Matrix3, Vector3};

use super::resolved::{
    BodyReference, Cable, ConstraintOwnerId, DirectionSource, Ends, First, Form, JointCoordinate,
    LineId, MarkerId, Pivot, Place, Plate, PlateId, Reduced, ReducedId, Resolved, ResolvedMarker,
    Rigid, RigidId, Slider,
};
use super::unit::{METRE, RADIAN, Unit};
use super::{Body, FileBody, LineBody, Model, PatchBody, RigidBody, Scene};
use crate::math::rotation::{NO_ROTATION, Quaternion, quaternion};
use crate::math::vector::{dot, norm};

/// From a point to another.
pub(super) fn difference(to: [f64; 3], from: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| to[k] - from[k])
}
/// Length of a vector.
pub(super) fn length(of: [f64; 3]) -> f64 {
    norm(&of)
}
/// Name of the ground in references to markers.
pub(super) const GROUND: &str = "ground";

impl<'a> Resolved<'a> {
    /// A scene with its bodies and their markers, and nothing else so far.
    pub(super) fn bare(scene: &'a Scene) -> Self {
        let mut resolved = Self {
            scene,
            bodies: Vec::new(),
            markers: Vec::new(),
            masses: Vec::new(),
            joints: Vec::new(),
            edges: Vec::new(),
            gears: Vec::new(),
            latches: Vec::new(),
            motions: Vec::new(),
            loads: Vec::new(),
            initial_loads: Vec::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
            ports: Vec::new(),
            holders: Vec::new(),
            angles: Vec::new(),
            points: Vec::new(),
            gauges: Vec::new(),
            layers: Vec::new(),
            couplings: 0,
            numbers: 0,
            bodies_by_name: Default::default(),
            markers_by_name: Default::default(),
        };
        let (mut chains, mut rods) = (0, 0);
        let next = |count: &mut usize| {
            *count += 1;
            *count - 1
        };
        for (body, described) in scene.bodies.iter().enumerate() {
            let reference = match described {
                Body::Cable(described)
                | Body::Rod(described)
                | Body::Beam(described)
                | Body::Auto(described) => {
                    let form = match described.model {
                        Model::Rigid => Form::Rod(next(&mut rods)),
                        Model::Modal => Form::Modal,
                        Model::Auto | Model::Flexible => Form::Chain(next(&mut chains)),
                    };
                    BodyReference::Cable(Cable {
                        id: LineId { body, form },
                        body: described,
                    })
                }
                Body::Rigid(described) => BodyReference::Rigid(Rigid {
                    id: RigidId(body),
                    body: described,
                }),
                Body::Reduced(described) => BodyReference::Reduced(Reduced {
                    id: ReducedId(body),
                    body: described,
                }),
                Body::Plate(described) | Body::Shell(described) => BodyReference::Plate(Plate {
                    id: PlateId(body),
                    body: described,
                }),
            };
            resolved.bodies.push(reference);
            resolved.bodies_by_name.insert(described.name(), reference);
            for (name, place) in reference.places() {
                let id = MarkerId(resolved.markers.len());
                resolved.markers.push(ResolvedMarker {
                    id,
                    name,
                    place,
                    position: place.position(),
                    direction: place.direction(),
                });
                let key = (described.name(), name);
                resolved.markers_by_name.insert(key, id);
            }
        }
        resolved
    }

    /// Finds a marker by `body.marker`.
    pub(super) fn marker(&self, name: &'a str) -> Option<ResolvedMarker<'a>> {
        let id = self.markers_by_name.get(&name.split_once('.')?)?;
        let marker = self.markers[id.0];
        Some(ResolvedMarker { name, ..marker })
    }
}

impl Scene {
    /// A cable.
    pub fn cable(&self, id: LineId) -> &LineBody {
        let cable = self.bodies[id.body].cable();
        cable.unwrap_or_else(|| unreachable!("a number of a cable is that of a cable"))
    }

    /// Returns mutable access to a line body.
    pub fn cable_mut(&mut self, id: LineId) -> &mut LineBody {
        let cable = self.bodies[id.body].cable_mut();
        cable.unwrap_or_else(|| unreachable!("a number of a cable is that of a cable"))
    }

    /// A reduced body, to be changed.
    pub fn reduced_mut(&mut self, id: ReducedId) -> &mut FileBody {
        let reduced = self.bodies[id.0].reduced_mut();
        reduced
            .unwrap_or_else(|| unreachable!("a number of a reduced body is that of a reduced body"))
    }

    /// A plate or shell, to be changed.
    pub fn patch_mut(&mut self, id: PlateId) -> &mut PatchBody {
        let patch = self.bodies[id.0].patch_mut();
        patch.unwrap_or_else(|| unreachable!("a number of a plate is that of a plate or shell"))
    }

    /// A rigid body, to be changed.
    pub fn rigid_mut(&mut self, id: RigidId) -> &mut RigidBody {
        let rigid = self.bodies[id.0].rigid_mut();
        rigid.unwrap_or_else(|| unreachable!("a number of a rigid body is that of a rigid body"))
    }
}

impl Cable<'_> {
    /// Whether it neither bends nor stretches.
    pub fn is_rigid(&self) -> bool {
        matches!(self.id.form, Form::Rod(_))
    }

    /// Whether it is reduced to modes.
    pub fn is_modal(&self) -> bool {
        self.id.form == Form::Modal
    }
}

impl<'a> BodyReference<'a> {
    /// Name of the body.
    pub fn name(self) -> &'a str {
        match self {
            Self::Cable(cable) => &cable.body.name,
            Self::Rigid(rigid) => &rigid.body.name,
            Self::Reduced(reduced) => &reduced.body.name,
            Self::Plate(plate) => &plate.body.name,
        }
    }

    /// Lists the markers of the body: name and place, in alphabetical order.
    fn places(self) -> Vec<(&'a str, Place<'a>)> {
        match self {
            Self::Cable(cable) => (cable.body.markers.iter())
                .map(|(name, s)| (name.as_str(), Place::Along(cable, *s)))
                .collect(),
            Self::Rigid(rigid) => (rigid.body.markers.iter())
                .map(|(name, point)| (name.as_str(), Place::Point(rigid, point.full())))
                .collect(),
            Self::Reduced(reduced) => (reduced.body.markers.iter())
                .filter_map(|(name, interface)| {
                    let index = reduced.body.contained().interface(interface)?;
                    Some((name.as_str(), Place::Interface(reduced, index)))
                })
                .collect(),
            Self::Plate(plate) => (plate.body.markers.keys().enumerate())
                .map(|(index, name)| (name.as_str(), Place::Patch(plate, index)))
                .collect(),
        }
    }
}

impl<'a> Place<'a> {
    /// The body.
    pub fn body(self) -> BodyReference<'a> {
        match self {
            Self::Along(cable, _) => BodyReference::Cable(cable),
            Self::Point(rigid, _) => BodyReference::Rigid(rigid),
            Self::Interface(reduced, _) => BodyReference::Reduced(reduced),
            Self::Patch(plate, _) => BodyReference::Plate(plate),
        }
    }

    /// Index of the body.
    pub(super) fn body_index(self) -> usize {
        match self {
            Self::Along(cable, _) => cable.id.body,
            Self::Point(rigid, _) => rigid.id.0,
            Self::Interface(reduced, _) => reduced.id.0,
            Self::Patch(plate, _) => plate.id.0,
        }
    }

    /// Whether it has a direction: on a cable, a plate or a shell, on a rigid body that has inertia, or at an interface with rotations.
    pub(super) fn turns(self) -> bool {
        match self {
            Self::Along(..) | Self::Patch(..) => true,
            Self::Point(rigid, _) => rigid.body.inertia().is_some(),
            Self::Interface(..) => self.point_interface().is_none(),
        }
    }

    /// Name of the interface without rotations that it is.
    pub(super) fn point_interface(self) -> Option<&'a str> {
        let Self::Interface(reduced, index) = self else {
            return None;
        };
        let interface = &reduced.body.contained().model.interfaces[index];
        (interface.rotation.is_none()).then_some(interface.name.as_str())
    }

    /// Whether it has axes, in space: on a rigid body that has inertia, on a rod, a plate or a shell, or at an interface with rotations.
    pub(super) fn is_framed(self) -> bool {
        match self {
            Self::Point(..) | Self::Interface(..) | Self::Patch(..) => self.turns(),
            Self::Along(cable, _) => cable.body.is_rod(),
        }
    }

    /// Quaternion of the frame of a rigid or reduced body of space as described, or of a marker of a plate or shell, scalar first and not negative.
    pub fn quaternion(self) -> Quaternion {
        let axes = match self {
            Self::Along(..) => return NO_ROTATION,
            Self::Point(rigid, _) => rigid.body.axes(),
            Self::Interface(reduced, _) => reduced.body.axes(),
            Self::Patch(plate, index) => return quaternion(&plate.axes(index)),
        };
        quaternion(&std::array::from_fn(|k| axes.column(k).into_owned()))
    }

    /// Where it is as described, m.
    fn position(self) -> [f64; 3] {
        match self {
            Self::Along(cable, s) => cable.body.shape.point(s),
            Self::Point(rigid, point) => rigid.body.point(point),
            Self::Interface(reduced, index) => reduced.body.place(index),
            Self::Patch(plate, index) => plate.position(index),
        }
    }

    /// Returns the direction at the place as described.
    fn direction(self) -> [f64; 3] {
        match self {
            Self::Along(cable, s) => cable.body.shape.tangent(s),
            Self::Point(rigid, _) => rigid.body.directed([1.0, 0.0, 0.0]),
            Self::Interface(reduced, _) => reduced.body.directed([1.0, 0.0, 0.0]),
            Self::Patch(plate, index) => plate.axes(index)[0].into(),
        }
    }
}

impl Plate<'_> {
    /// Where a marker is as described, m.
    pub fn position(&self, index: usize) -> [f64; 3] {
        self.body.geometry().position(self.body.marker_at(index))
    }

    /// Material coordinates of a marker, in [0, 1].
    pub fn place(&self, index: usize) -> [f64; 2] {
        let marker = self.body.marker_at(index);
        self.body.geometry().point(marker).at
    }

    /// Axes of a marker as described: along the lines along `s1`, across them in the surface, and the normal.
    pub fn axes(&self, index: usize) -> [Vector3<f64>; 3] {
        self.body.geometry().axes(self.body.marker_at(index))
    }

    /// A direction in the axes of a marker, in global components at the start.
    pub fn directed(&self, index: usize, way: [f64; 3]) -> [f64; 3] {
        let axes = Matrix3::from_columns(&self.axes(index));
        (axes * Vector3::from(way)).into()
    }
}

impl RigidBody {
    /// Where a point of the body's frame is at the start, m.
    pub fn point(&self, point: [f64; 3]) -> [f64; 3] {
        let way = self.directed(point);
        std::array::from_fn(|k| self.position[k] + way[k])
    }

    /// Points that show how far the body extends: those of its shape, or its markers and its centre, in its frame, m.
    pub fn extent(&self) -> Vec<[f64; 3]> {
        if let Some(shape) = self.shape {
            return shape.points();
        }
        let markers = self.markers.values().map(super::SceneVector::full);
        markers.chain([[0.0; 3]]).collect()
    }

    /// A direction or a way in the body's frame, in global components at the start.
    pub fn directed(&self, way: [f64; 3]) -> [f64; 3] {
        if self.orientation.is_some() {
            return (self.axes() * Vector3::from(way)).into();
        }
        let (sin, cos) = self.angle.sin_cos();
        [
            cos * way[0] - sin * way[1],
            sin * way[0] + cos * way[1],
            way[2],
        ]
    }

    /// The axes of the body's frame at the start in space, in global components, as columns.
    pub fn axes(&self) -> Matrix3<f64> {
        let given = self.orientation.and_then(|orientation| orientation.axes());
        given.unwrap_or_else(Matrix3::identity)
    }
}

impl<'a> Ends<'a> {
    /// Where both ends are as described, m.
    pub fn points(&self) -> [[f64; 3]; 2] {
        let second = self.second.position;
        let first = match self.first {
            First::Ground(point) => point.unwrap_or(second),
            First::Marker(marker) => marker.position,
            First::Cable(_) => second,
        };
        [first, second]
    }

    /// Distance between the ends as described, m.
    pub fn distance(&self) -> f64 {
        let [a, b] = self.points();
        length(difference(b, a))
    }

    /// Direction of the second end less that of the first as described, from -pi to pi, rad.
    pub fn angle(&self) -> f64 {
        let a = match self.first {
            First::Ground(_) | First::Cable(_) => [1.0, 0.0, 0.0],
            First::Marker(marker) => marker.direction,
        };
        let b = self.second.direction;
        (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
    }

    /// The point of the ground, where one is given, m.
    pub fn point(&self) -> Option<[f64; 3]> {
        match self.first {
            First::Ground(point) => point,
            First::Marker(_) | First::Cable(_) => None,
        }
    }

    /// Whether the first end is the ground.
    pub fn is_grounded(&self) -> bool {
        matches!(self.first, First::Ground(_))
    }

    /// Name of the first end.
    pub fn first_name(&self) -> &'a str {
        match self.first {
            First::Ground(_) => GROUND,
            First::Marker(marker) => marker.name,
            First::Cable(cable) => &cable.body.name,
        }
    }

    /// Indices of the bodies of both ends, among all bodies.
    pub(super) fn bodies(&self) -> Vec<usize> {
        let first = match self.first {
            First::Ground(_) => None,
            First::Marker(marker) => Some(marker.place.body_index()),
            First::Cable(cable) => Some(cable.id.body_index()),
        };
        let second = self.second.place.body_index();
        first.into_iter().chain([second]).collect()
    }

    /// The markers of both ends.
    pub(super) fn markers(&self) -> Vec<ResolvedMarker<'a>> {
        match self.first {
            First::Ground(_) | First::Cable(_) => vec![self.second],
            First::Marker(first) => vec![first, self.second],
        }
    }
}

impl<'a> Slider<'a> {
    /// The way as described, m.
    pub(super) fn start(&self) -> f64 {
        let [first, second] = self.ends.points();
        dot(&difference(second, first), &self.along)
    }
}

impl<'a> JointCoordinate<'a> {
    /// Name of the joint.
    pub fn name(&self) -> &'a str {
        match self {
            Self::Displacement(slider) => slider.name,
            Self::Angle(pivot) => pivot.name,
        }
    }

    /// Returns the two ends of the joint.
    pub fn ends(&self) -> Ends<'a> {
        match self {
            Self::Displacement(slider) => slider.ends,
            Self::Angle(pivot) => pivot.ends,
        }
    }

    /// Which holder the joint is.
    pub fn joint(&self) -> ConstraintOwnerId {
        match self {
            Self::Displacement(slider) => slider.joint,
            Self::Angle(pivot) => pivot.joint,
        }
    }

    /// Whether it is an angle.
    pub fn is_angle(&self) -> bool {
        matches!(self, Self::Angle(_))
    }

    /// Returns its unit.
    pub(super) fn unit(&self) -> Unit {
        if self.is_angle() { RADIAN } else { METRE }
    }

    /// Returns a stiffness against it as one against displacements, N/m, and one against rotations, N m/rad.
    pub(super) fn stiffness(&self, value: f64) -> [f64; 2] {
        if self.is_angle() {
            [0.0, value]
        } else {
            [value, 0.0]
        }
    }
}

impl<'a> DirectionSource<'a> {
    /// Name of the marker or joint.
    pub fn name(&self) -> &'a str {
        match self {
            Self::Marker(marker) => marker.name,
            Self::Pivot(Pivot { name, .. }) => name,
        }
    }

    /// The marker, or the second one of the joint.
    pub fn marker(&self) -> ResolvedMarker<'a> {
        match self {
            Self::Marker(marker) => *marker,
            Self::Pivot(pivot) => pivot.ends.second,
        }
    }
}
