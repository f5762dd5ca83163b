//! From a validated scene to a system.

mod axes;
mod axial;
mod bodies;
mod coordinates;
mod edge;
mod initial;
mod memory;
mod modal;
mod patch;
mod ports;
mod reduced;
mod solids;
mod stress;

pub use initial::Motions;

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};

use super::resolved::{
    self, BodyReference, CouplingId, DirectionSource, Ends, First, GaugeId, LayerId, LoadId,
    MarkerId, Place, PointId, Resolved,
};
pub use modal::ModalLine;

use super::{Error, OutputKind, PatchBody, Scene};
use crate::bodies::{Bodies, LumpedMass, Marker, Node, Patch, ReducedBody};
use crate::math::rotation::{Quaternion, inverse, product, quaternion};
use crate::math::space::{Vector, vector};
use crate::system::joints::{JointEquations, Primitive};
use crate::system::{
    Angle, Attachment, AxisRotation, BuildError, Gauge, Parts, Release, State, StressLayer,
    StressPoint, System,
};

/// A system and what of its scene is needed beside it.
#[derive(Clone, Debug)]
pub struct Assembled<const D: usize = 2> {
    /// The system.
    pub system: System<D>,
    /// Nodal coordinates as described.
    pub nodes: Vec<Node<D>>,
    /// Rates of the nodes as described.
    pub rates: Vec<Node<D>>,
    /// Error wanted of what is read, relative.
    pub error: f64,
    /// Motions of the bodies at the start.
    pub motions: Motions<D>,
    /// For every marker, itself in the system.
    markers: Vec<Marker>,
    /// For every body, its principal axes in its frame, as columns.
    frames: Vec<Matrix3<f64>>,
    /// For every body, where the centre of all its mass is in its frame, m.
    centers: Vec<Vector3<f64>>,
    /// Quaternions back from these axes.
    stances: Vec<Quaternion>,
    /// For every coupling, its place among the loads of the system.
    couplings: Vec<usize>,
    /// Place there of the first load of the scene: springs of hinges come before.
    first_load: usize,
    /// Points of sections whose stress is read.
    points: Vec<StressPoint>,
    /// Gauges whose stress is read.
    gauges: Vec<Gauge>,
    /// Heights in sections of plates and shells where stress is read.
    layers: Vec<StressLayer>,
    /// Plates and shells as described, patch by patch.
    pub plates: Vec<PatchBody>,
    /// First nodes of the interfaces of reduced bodies, by the index of the body.
    interfaces: BTreeMap<usize, Vec<usize>>,
    /// Lines that are reduced to modes, by the index of the body.
    lines: BTreeMap<usize, ModalLine>,
    /// Bodies of plates and shells, in the order of their patches.
    patches: Vec<usize>,
}

impl<const D: usize> Assembled<D> {
    /// All markers, body by body, in the order of their names.
    pub fn markers(&self) -> &[Marker] {
        &self.markers
    }

    /// The marker of the system that a marker of the scene is.
    pub fn marker(&self, id: MarkerId) -> &Marker {
        &self.markers[id.index()]
    }

    /// Principal axes of a rigid or reduced body of space in its frame, as columns.
    pub fn frame(&self, body: usize) -> &Matrix3<f64> {
        &self.frames[body]
    }

    /// Where the centre of all mass of a rigid or reduced body of space is in its frame, m.
    pub fn center(&self, body: usize) -> &Vector3<f64> {
        &self.centers[body]
    }

    /// Quaternion of the frame of a rigid body of space, from that of its principal axes.
    pub fn held(&self, principal: Quaternion, body: usize) -> Quaternion {
        product(&principal, &self.stances[body])
    }

    /// Chooses the sign of the quaternion of each body's frame at the start of a run, such that its scalar part is not
    /// negative.
    pub fn begin(&self, state: &mut State) {
        let State {
            frames,
            coordinates,
            ..
        } = state;
        let system = &self.system;
        let bodies = system.bodies();
        for (node, held, now) in bodies.quaternions(frames, coordinates) {
            let body = bodies.body_from(node);
            if body.is_some_and(|body| self.held(now, body)[0] < 0.0) {
                *held = held.map(|part| -part);
            }
        }
    }

    /// A line that is reduced to modes and its body, by its place among all bodies; none of another one.
    pub fn modal_line(&self, body: usize) -> Option<(&ModalLine, &ReducedBody)> {
        self.lines.get(&body).zip(self.reduced(body))
    }

    /// The patch of a plate or shell, by its place among all bodies; none of another one.
    pub fn patch(&self, body: usize) -> Option<&Patch> {
        self.system.bodies().patches().get(self.patch_place(body)?)
    }

    /// Index among the patches of a plate or shell, by its place among all bodies; none of another one.
    pub fn patch_place(&self, body: usize) -> Option<usize> {
        self.patches.iter().position(|of| *of == body)
    }

    /// A reduced body, by its place among all bodies; none of another one.
    pub fn reduced(&self, body: usize) -> Option<&ReducedBody> {
        if !self.interfaces.contains_key(&body) && !self.lines.contains_key(&body) {
            return None;
        }
        let index = self.interfaces.range(..body).count() + self.lines.range(..body).count();
        self.system.bodies().reduced().get(index)
    }

    /// A point of a section whose stress is read.
    pub fn point(&self, id: PointId) -> &StressPoint {
        &self.points[id.index()]
    }

    /// A gauge of a reduced body whose stress is read.
    pub fn gauge(&self, id: GaugeId) -> &Gauge {
        &self.gauges[id.index()]
    }

    /// A height in the section of a plate or shell where stress is read.
    pub fn layer(&self, id: LayerId) -> &StressLayer {
        &self.layers[id.index()]
    }

    /// Place among the loads of the system of a load of the scene.
    pub fn load(&self, id: LoadId) -> usize {
        self.first_load + id.index()
    }

    /// Number in the scene of a load of the system; none of springs of hinges.
    pub fn load_number(&self, load: usize) -> Option<usize> {
        load.checked_sub(self.first_load)
    }

    /// Place among the loads of the system of a coupling.
    pub fn coupling(&self, id: CouplingId) -> usize {
        self.couplings[id.index()]
    }
}

/// Builds the system that a scene describes.
///
/// # Errors
/// When the scene is not valid, when a mesh is too coarse for what acts inside its body, when a motion contradicts joints, when a body
/// has no mass.
pub fn assemble<const D: usize>(scene: &Scene) -> Result<Assembled<D>, Error> {
    scene.resolve()?.assemble()
}

impl Resolved<'_> {
    /// Builds the system that the scene describes.
    ///
    /// # Errors
    /// When a mesh is too coarse for what acts inside its body, when a motion contradicts joints, when a
    /// body has no mass, when memory does not suffice.
    pub fn assemble<const D: usize>(&self) -> Result<Assembled<D>, Error> {
        debug_assert_eq!(self.scene.dimension, D);
        self.reserve()?;
        let mut builder = Builder {
            resolved: self,
            motions: Motions::default(),
            markers: Vec::new(),
            couplings: Vec::new(),
            interfaces: BTreeMap::new(),
            lines: BTreeMap::new(),
            patches: Vec::new(),
            parts: self.parts(),
        };
        for index in 0..self.bodies.len() {
            builder.body(index)?;
        }
        builder.markers();
        builder.masses();
        builder.angles();
        builder.joints();
        builder.edges();
        builder.gears();
        builder.latches();
        builder.motions();
        let first_load = builder.parts.loads.len();
        builder.loads()?;
        builder.inputs();
        builder.ports();
        let (points, gauges) = (builder.section_points(), builder.gauges());
        let layers = builder.layers();
        let nodes = builder.parts.bodies.reference.clone();
        let lines = builder.lines;
        let bodies = self.bodies.iter().enumerate();
        let principal = bodies.map(|(index, body)| match lines.get(&index) {
            Some(line) => (line.axes, line.center),
            None => self.principal(body),
        });
        let (frames, centers): (Vec<Matrix3<f64>>, Vec<_>) = principal.unzip();
        let plates = self.bodies.iter().filter_map(|body| match body {
            BodyReference::Plate(plate) => Some(plate.body.clone()),
            BodyReference::Cable(_) | BodyReference::Rigid(_) | BodyReference::Reduced(_) => None,
        });
        let system = System::new(builder.parts).map_err(|error| self.explain(&error))?;
        Ok(Assembled {
            system,
            points,
            gauges,
            layers,
            plates: plates.collect(),
            error: self.scene.error_wanted(),
            rates: builder.motions.rates(&nodes),
            motions: builder.motions,
            nodes,
            markers: builder.markers,
            stances: frames.iter().map(back).collect(),
            frames,
            centers,
            couplings: builder.couplings,
            first_load,
            interfaces: builder.interfaces,
            lines,
            patches: builder.patches,
        })
    }

    /// Nothing but what belongs to the scene as a whole.
    fn parts<const D: usize>(&self) -> Parts<D> {
        let scene = self.scene;
        Parts {
            bodies: Bodies::default(),
            rigid: Vec::new(),
            joints: Vec::new(),
            drives: Vec::new(),
            winches: Vec::new(),
            loads: Vec::new(),
            initial_loads: Vec::new(),
            angles: Vec::new(),
            gravity: vector(scene.gravity.full()),
            rotation: scene.rotation.full(),
            tracks_work: self.outputs.iter().any(|o| o.kind == OutputKind::Work),
        }
    }

    /// Principal axes of a body in its frame, and the centre of all its mass, m; of bodies of the plane that are described their frame.
    fn principal(&self, body: &BodyReference<'_>) -> (Matrix3<f64>, Vector3<f64>) {
        match body {
            BodyReference::Rigid(rigid) if self.scene.dimension == 3 => {
                let solid = self.solid(*rigid);
                (solid.axes, solid.center)
            }
            BodyReference::Reduced(reduced) => {
                let container = reduced.body.contained();
                (container.axes, container.center)
            }
            BodyReference::Cable(_) | BodyReference::Rigid(_) | BodyReference::Plate(_) => {
                (Matrix3::identity(), Vector3::zeros())
            }
        }
    }

    fn explain(&self, error: &BuildError) -> Error {
        match error {
            BuildError::Massless => Error::new("bodies", "expected bodies with mass, found none"),
            BuildError::Determined(joint) => {
                let path = joint.map_or("motions", |joint| &self.holders[joint].path);
                let message = "expected a motion of what joints and other motions leave free, found one of \
                               what they hold already";
                Error::new(path, message)
            }
        }
    }
}

/// A system in the making.
pub struct Builder<'a, const D: usize> {
    pub(super) resolved: &'a Resolved<'a>,
    motions: Motions<D>,
    markers: Vec<Marker>,
    couplings: Vec<usize>,
    /// First nodes of the interfaces of reduced bodies, by the index of the body.
    interfaces: BTreeMap<usize, Vec<usize>>,
    /// Lines that are reduced to modes, by the index of the body.
    lines: BTreeMap<usize, ModalLine>,
    /// Bodies of plates and shells, in the order of their patches.
    patches: Vec<usize>,
    pub(super) parts: Parts<D>,
}

impl<const D: usize> Builder<'_, D> {
    /// Markers as the scene numbers them.
    fn markers(&mut self) {
        for marker in &self.resolved.markers {
            self.markers.push(match marker.place {
                Place::Along(cable, s) => self.along(cable, s),
                Place::Point(rigid, point) => self.point(rigid, point),
                Place::Interface(reduced, index) => self.interface(reduced, index),
                Place::Patch(plate, index) => self.on_patch(plate, index),
            });
        }
    }

    pub(crate) fn marker(&self, marker: resolved::ResolvedMarker<'_>) -> Marker {
        self.markers[marker.id.index()]
    }

    fn masses(&mut self) {
        for mass in &self.resolved.masses {
            let marker = match mass.marker.place {
                // On the line of a rod.
                Place::Along(cable, s) => self.on_line_of(cable, s),
                Place::Point(..) | Place::Interface(..) | Place::Patch(..) => {
                    self.marker(mass.marker)
                }
            };
            // Of a rigid body of space it is in the inertia.
            if marker.is_framed() {
                continue;
            }
            // Of a planar beam its inertia rotates with the section.
            let section = Some(self.marker(mass.marker));
            let section = section.filter(|of| D == 2 && of.nodes != marker.nodes);
            let inertia = if section.is_some() { 0.0 } else { mass.inertia };
            self.parts.bodies.add_mass(LumpedMass {
                marker,
                mass: mass.mass,
                added: 0.0,
                inertia,
            });
            if let Some(of) = section {
                self.parts.bodies.add_mass(LumpedMass {
                    marker: Marker::rigid(of.body, of.nodes[1], [0.0; 2]),
                    mass: 0.0,
                    added: 0.0,
                    inertia: mass.inertia,
                });
            }
        }
    }

    /// The ends of something; the ground where the second one is at the start, or at its point.
    pub(crate) fn ends(&self, ends: Ends<'_>) -> [Attachment<D>; 2] {
        let second = self.marker(ends.second);
        let first = match ends.first {
            First::Ground(point) => {
                let here = second.position(&self.parts.bodies.reference);
                Attachment::Ground(point.map_or(here, vector))
            }
            First::Marker(marker) => Attachment::Body(self.marker(marker)),
            First::Cable(cable) => Attachment::Body(self.along(cable, 0.5)),
        };
        [first, Attachment::Body(second)]
    }

    /// A marker, seen from the ground.
    pub(crate) fn on_marker(&self, marker: resolved::ResolvedMarker<'_>) -> [Attachment<D>; 2] {
        let ground = Attachment::Ground(Vector::zeros());
        [ground, Attachment::Body(self.marker(marker))]
    }

    fn ends_of(&self, source: &DirectionSource<'_>) -> [Attachment<D>; 2] {
        match source {
            DirectionSource::Marker(marker) => self.on_marker(*marker),
            DirectionSource::Pivot(pivot) => self.ends(pivot.ends),
        }
    }

    pub(crate) fn distance_at_start(&self, ends: &[Attachment<D>; 2]) -> f64 {
        let nodes = &self.parts.bodies.reference;
        (ends[1].position(nodes) - ends[0].position(nodes)).norm()
    }

    pub(crate) fn count_angle(
        &mut self,
        ends: [Attachment<D>; 2],
        turn: Option<AxisRotation<D>>,
    ) -> usize {
        self.parts.angles.push(Angle { ends, turn });
        self.parts.angles.len() - 1
    }

    /// Angles that are read, as the scene numbers them; those of hinges and ports follow.
    fn angles(&mut self) {
        for source in &self.resolved.angles {
            self.count_angle(self.ends_of(source), self.axis_turn(source));
        }
    }

    pub(crate) fn hold(&mut self, primitive: Primitive<D>, ends: [Attachment<D>; 2]) {
        self.hold_until(None, primitive, ends);
    }

    /// Adds a joint that can be released where there is a release.
    pub(crate) fn hold_until(
        &mut self,
        release: Option<Release>,
        primitive: Primitive<D>,
        ends: [Attachment<D>; 2],
    ) {
        self.parts.joints.push(JointEquations {
            holds: vec![primitive],
            ends,
            spring: None,
            turn: None,
            way: None,
            release,
        });
    }

    /// From the direction of the first end to that of the second at the start, where none is given.
    pub(crate) fn angle(&self, ends: [Attachment<D>; 2], given: Option<f64>) -> f64 {
        let turn = None;
        given.unwrap_or_else(|| Angle { ends, turn }.value(&self.parts.bodies.reference, 0.0))
    }
}

/// Quaternion of the rotation from a frame's principal axes, as columns, to it.
fn back(principal: &Matrix3<f64>) -> Quaternion {
    let columns = std::array::from_fn(|k| principal.column(k).into_owned());
    inverse(quaternion(&columns))
}

/// The direction as a unit vector.
pub(crate) fn unit<const D: usize>(direction: [f64; 3]) -> Vector<D> {
    vector::<D, f64>(direction).normalize()
}

/// One number for every component of a vector.
pub(super) fn each<T: Clone, const D: usize>(components: &[T]) -> [T; D] {
    std::array::from_fn(|k| components[k].clone())
}
