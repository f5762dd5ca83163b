//! Bodies: a cable becomes a chain of elements or, where it does not bend, a rod; a rigid body a node.

use nalgebra::Matrix3;

use super::Builder;
use super::initial::BodyNodes;
use crate::bodies::{
    self, LineChain, LumpedMass, Marker, Node, RigidBodyFrame, RigidRod, RodChain, middle,
    planar_axes, transported_nodes, untwisted,
};
use crate::elements::beam::planar::{self, Planar};
use crate::elements::beam::{self, At, Beam};
use crate::elements::cable::{self, Inertia, LineOf};
use crate::elements::reduced::ReducedModel;
use crate::elements::rod::{self, Rod as RodElement};
use crate::elements::section::{SectionElement, SpinInertia, planar_inertia, rod_at, spin_inertia};
use crate::elements::{self, ElementPolynomial, Nodal};
use crate::math::quadrature::GAUSS_3;
use crate::math::space::{Vector, axis, components, turned, vector};
use crate::scene::resolved::{BodyReference, Cable, Form, Reduced, Rigid};
use crate::scene::{Error, LineBody, LineModel, RigidBody, SectionNumbers, Strain};

/// Rotations an element in which the axes of a rod are transported along a shape that no plane holds.
const STEPS: u32 = 256;

/// A rigid body about its centre of mass: where that is, m, the angle of its frame, rad, mass and that of the fluid which moves along, kg,
/// and inertia of both, kg m^2.
struct Lump {
    position: [f64; 3],
    angle: f64,
    mass: f64,
    added: f64,
    inertia: f64,
}

impl<const D: usize> Builder<'_, D> {
    /// Adds the nodes and parts of a body.
    ///
    /// # Errors
    /// A mesh that is not possible, or an initial motion that cannot be computed.
    pub(super) fn body(&mut self, index: usize) -> Result<(), Error> {
        let first = self.parts.bodies.reference.len();
        let motion = self.resolved.scene.bodies[index].motion();
        let (mut arm, mut axes, mut still, mut reduced) = ([0.0; 3], Vec::new(), None, None);
        match self.resolved.bodies[index] {
            BodyReference::Cable(cable) => match cable.id.form {
                Form::Chain(_) => self.chain(cable, first)?,
                Form::Rod(_) => arm[0] = self.rod(index, cable.body),
                Form::Modal => {
                    let body;
                    (body, arm) = self.modal(cable)?;
                    reduced = Some(body);
                }
            },
            BodyReference::Rigid(rigid) => {
                if D == 3 && rigid.body.inertia().is_some() {
                    arm = self.frame(rigid);
                } else {
                    self.particle(index, rigid.body);
                }
            }
            BodyReference::Plate(plate) => axes = self.patch(plate),
            BodyReference::Reduced(of) if of.body.is_rigid() => arm = self.rigid_model(of),
            BodyReference::Reduced(of) => {
                reduced = Some(self.reduced(of)?);
                arm = of.body.contained().from_center();
            }
        }
        if let Some(body) = reduced {
            axes.extend(body.axes_nodes());
            still = Some(body.inner());
            self.parts.bodies.add_reduced(body);
        }
        let nodes = first..self.parts.bodies.reference.len();
        axes.extend((self.parts.bodies.rigid().last()).map(|frame| frame.node + 1));
        let sections = (self.parts.bodies.all_sections().last()).filter(|rod| rod.line() == first);
        axes.extend(sections.into_iter().flat_map(RodChain::axes_nodes));
        axes.retain(|node| nodes.contains(node));
        let inner = sections.map(|rod| rod.inner().start);
        let angles = inner.unwrap_or(nodes.end);
        let still = still.unwrap_or(angles);
        let of_body = BodyNodes {
            all: nodes.clone(),
            axes,
            still,
            angles,
            are_sections: sections.is_some(),
        };
        self.motions.push(of_body, motion, arm);
        if let (BodyReference::Cable(cable), Some(field)) =
            (self.resolved.bodies[index], &motion.deformation)
        {
            let mesh = self.resolved.nodes(cable)?;
            self.motions
                .deform(field, &mesh, cable.body.shape.length())?;
        }
        if let (BodyReference::Plate(plate), Some(field)) =
            (self.resolved.bodies[index], &motion.deformation)
        {
            let unit = self.patch_of(plate).unit();
            let geometry = plate.body.geometry();
            self.motions.deform_surface(field, &geometry, unit)?;
        }
        self.parts.bodies.ranges.push(nodes);
        Ok(())
    }

    /// A rigid body of the plane, or a particle.
    fn particle(&mut self, index: usize, rigid: &RigidBody) {
        self.lump(
            index,
            &Lump {
                position: rigid.position.full(),
                angle: rigid.angle,
                mass: rigid.mass(),
                added: 0.0,
                inertia: rigid.inertia().number(),
            },
        );
    }

    /// A rigid body of space that rotates: its principal axes in two nodes. Gives back how far along them from the centre of
    /// all its mass the origin of its frame is, m.
    fn frame(&mut self, rigid: Rigid<'_>) -> [f64; 3] {
        let (solid, body) = (self.resolved.solid(rigid), rigid.body);
        let largest = solid.moments.iter().copied().fold(0.0, f64::max);
        // What rounding left of the moment of a thin rod about itself is none.
        let rounded = |moment| if moment > 1e-9 * largest { moment } else { 0.0 };
        let inertia = (solid.mass, solid.moments.map(rounded));
        let center = body.point(solid.center.into());
        self.add_frame(inertia, center, &(body.axes() * solid.axes));
        solid.along([0.0; 3])
    }

    /// A reduced body without modes is a rigid body.
    fn rigid_model(&mut self, reduced: Reduced<'_>) -> [f64; 3] {
        let container = reduced.body.contained();
        let inertia = (container.model.mass, container.model.moments);
        let axes = reduced.body.axes() * container.axes;
        let center = reduced.body.center();
        if D == 2 {
            let lump = Lump {
                position: center,
                angle: axes[(1, 0)].atan2(axes[(0, 0)]),
                mass: container.model.mass,
                added: 0.0,
                inertia: container.model.moments[2],
            };
            self.lump(reduced.id.index(), &lump);
        } else {
            self.add_frame(inertia, center, &axes);
        }
        container.from_center()
    }

    /// Mass (kg) and principal moments (kg m^2) of a rigid body, its centre of mass (m) and, as columns, principal axes at the start.
    fn add_frame(
        &mut self,
        (mass, moments): (f64, [f64; 3]),
        center: [f64; 3],
        axes: &Matrix3<f64>,
    ) {
        let axis = |k: usize| vector::<D, f64>(axes.column(k).into_owned().into()).into();
        let node = self.parts.bodies.reference.len();
        let frame = RigidBodyFrame::new(node, mass, moments);
        self.parts.bodies.add_rigid(frame);
        let nodes = [
            [vector::<D, f64>(center).into(), axis(0)],
            [axis(1), axis(2)],
        ];
        self.parts.bodies.reference.extend(nodes);
    }

    /// A reduced body: its principal axes in two nodes, frames of its interfaces and amplitudes of its modes.
    ///
    /// # Errors
    /// A model whose modes with held interfaces cannot be computed.
    fn reduced(&mut self, reduced: Reduced<'_>) -> Result<bodies::ReducedBody, Error> {
        let container = reduced.body.contained();
        let axes = reduced.body.axes() * container.axes;
        let made = self.resolved.model_of(reduced)?;
        let count = made.0.interfaces.len();
        let body = self.modal_body(made, reduced.body.center(), &axes);
        let interfaces = (0..count).map(|index| body.interface(index)).collect();
        self.interfaces.insert(reduced.id.index(), interfaces);
        Ok(body)
    }

    /// A body of a model with damping ratios of its modes, its centre of mass (m) and, as columns, principal axes at the start, with its nodes.
    pub(super) fn modal_body(
        &mut self,
        (model, ratios): (ReducedModel, Vec<f64>),
        center: [f64; 3],
        axes: &Matrix3<f64>,
    ) -> bodies::ReducedBody {
        let axes = std::array::from_fn(|k| axes.column(k).into_owned());
        let body = bodies::ReducedBody::new::<D>(self.parts.bodies.reference.len(), model, &ratios);
        let nodes = body.reference::<D>(center, &axes);
        self.parts.bodies.reference.extend(nodes);
        body
    }

    /// An interface of a reduced body, with the first of the file's axes as direction.
    pub(super) fn interface(&self, reduced: Reduced<'_>, interface: usize) -> Marker {
        let (index, container) = (reduced.id.index(), reduced.body.contained());
        let direction = container.directed([1.0, 0.0, 0.0]);
        match self.interfaces.get(&index) {
            Some(nodes) => Marker::framed(index, nodes[interface], [0.0; 3], direction),
            None => {
                let node = self.parts.bodies.ranges[index].start;
                let place = container.model.interfaces[interface].position;
                if D == 2 {
                    return Marker::rigid(index, node, [place.x, place.y]);
                }
                Marker::framed(index, node, place.into(), direction)
            }
        }
    }

    /// A point of a rigid body in its frame, m.
    pub(crate) fn point(&self, rigid: Rigid<'_>, point: [f64; 3]) -> Marker {
        let (index, body) = (rigid.id.index(), rigid.body);
        let node = self.parts.bodies.ranges[index].start;
        if D == 2 || !body.inertia().is_some() {
            return Marker::rigid(index, node, [point[0], point[1]]);
        }
        let solid = self.resolved.solid(rigid);
        let first = solid.directed([1.0, 0.0, 0.0]);
        Marker::framed(index, node, solid.along(point), first)
    }

    /// A cable that bends.
    fn chain(&mut self, reference: Cable<'_>, first: usize) -> Result<(), Error> {
        let cable = reference.body;
        let mesh = self.resolved.nodes(reference)?;
        let axial = self.resolved.axial_damping_time(reference);
        let added = |section: &SectionNumbers| self.resolved.added_mass(reference.id.body, section);
        let elements = build_elements(cable, &added, axial, &mesh);
        let chain = LineChain::new(elements, first);
        let node = |s: &f64| {
            let ways = [cable.shape.point(*s), cable.shape.tangent(*s)];
            ways.map(|way| vector::<D, f64>(way).into())
        };
        self.parts.bodies.reference.extend(mesh.iter().map(node));
        self.parts.bodies.add_line(chain);
        if cable.is_rod() {
            self.sections(cable, axial, &mesh, first);
        }
        if cable.is_rod() && D == 2 {
            self.directions(reference.id.body);
        }
        Ok(())
    }

    /// The directions of the sections of the planar beam built last keep their length, and have its rotary inertia.
    fn directions(&mut self, body: usize) {
        let sections = self.parts.bodies.all_sections().last();
        let inertia = sections.into_iter().flat_map(RodChain::planar_inertia);
        for (node, inertia) in inertia.collect::<Vec<_>>() {
            self.parts.rigid.push((node, true));
            self.parts.bodies.add_mass(LumpedMass {
                marker: Marker::rigid(body, node, [0.0; 2]),
                mass: 0.0,
                added: 0.0,
                inertia,
            });
        }
    }

    /// The sections of a rod along its line, whose first node is this one: their frames, and the twist inside elements.
    fn sections(&mut self, rod: &LineBody, axial_time: f64, mesh: &[f64], first: usize) {
        let line = self.parts.bodies.reference[first..].to_vec();
        let twists = mesh.iter().map(|s| rod.sections_about(*s)(*s).1);
        let tangent = |j: usize, part: f64| {
            let s = mesh[j] + part * (mesh[j + 1] - mesh[j]);
            rod.shape.tangent(s)
        };
        let steps = if rod.shape.is_plane() { 1 } else { STEPS };
        let axes = match D {
            2 => line.iter().map(|[_, slope]| [[0.0; D], *slope]).collect(),
            _ => transported_nodes(&line, rod.first_axis(), (tangent, steps), twists),
        };
        let carried = self.parts.bodies.section_count();
        let length_of = |j: usize| (mesh[j + 1] - mesh[j]) * rod.shape.length();
        let elements = mesh.windows(2).enumerate().map(|(j, s)| {
            let length = length_of(j);
            let [[a, u], [b, v]] = [line[j], line[j + 1]].map(|node| node.map(full));
            let shape = At {
                e: [a, u, b, v],
                axes: [j, j + 1].map(|k| section_axes(&axes, k)),
                inner: [0.0; 3],
            };
            let numbers = numbers_along(rod, s);
            if D == 2 {
                return planar_beam(rod, &shape, length, axial_time, &numbers);
            }
            let time = rod.material.damping_time;
            let inertia = spin_inertia(length, |xi| rod.rotary_inertia_of(&numbers(xi)));
            if rod.is_beam() {
                let parameters = beam::Parameters {
                    length,
                    stiffness: GAUSS_3.map(|p| rod.whole_stiffness(&numbers(p.at)).into()),
                    damping_times: [axial_time, time, time, time, time, time],
                };
                let beam = Beam::new(parameters, &shape);
                return (SectionElement::Beam(Box::new(beam)), inertia);
            }
            let axial = rod.is_coupled_axially().then(|| rod::Stretch {
                stiffness: GAUSS_3.map(|point| rod.axial_stiffness_of(&numbers(point.at))),
                coupling: GAUSS_3.map(|point| numbers(point.at).axial_coupling),
                damping_time: axial_time,
            });
            let parameters = rod::Parameters {
                length,
                stiffness: GAUSS_3.map(|point| rod.stiffness(&numbers(point.at)).into()),
                damping_times: [time; 3],
                axial,
            };
            let rod = RodElement::new(parameters, &rod_at(&shape));
            (SectionElement::Rod(Box::new(rod)), inertia)
        });
        let chain = RodChain::new::<D>(elements.collect(), first, carried);
        self.parts.bodies.reference.extend(axes);
        let inner = (0..chain.count()).map(|j| match D {
            2 => middle([&line[j], &line[j + 1]], length_of(j)),
            _ => untwisted(),
        });
        self.parts.bodies.reference.extend(inner);
        self.parts.bodies.add_sections(chain);
    }

    /// A cable that does not bend, about its middle; gives back how far along it from there its first end is, m.
    fn rod(&mut self, index: usize, cable: &LineBody) -> f64 {
        let length = cable.shape.length();
        let section = cable.section_at(0.5);
        let mass = cable.line_density_of(&section) * length;
        let added = self.resolved.added_mass(index, &section) * length;
        let [x, y, _] = cable.shape.tangent(0.5);
        self.parts.bodies.add_rod(RigidRod {
            node: self.parts.bodies.reference.len(),
            length,
            mass: self.parts.bodies.masses().len(),
        });
        self.lump(
            index,
            &Lump {
                position: cable.shape.point(0.5),
                angle: y.atan2(x),
                mass,
                added,
                inertia: (mass + added) * length * length / 12.0,
            },
        );
        -0.5 * length
    }

    fn lump(&mut self, index: usize, lump: &Lump) {
        let node = self.parts.bodies.reference.len();
        let direction: Vector<D> = turned(axis(0), lump.angle.sin_cos());
        let position: Vector<D> = vector(lump.position);
        (self.parts.bodies.reference).push([position.into(), direction.into()]);
        self.parts.rigid.push((node, lump.inertia > 0.0));
        self.parts.bodies.add_mass(LumpedMass {
            marker: Marker::rigid(index, node, [0.0; 2]),
            mass: lump.mass,
            added: lump.added,
            inertia: lump.inertia,
        });
    }

    /// A marker of a cable at a material coordinate in [0, 1].
    pub(crate) fn along(&self, cable: Cable<'_>, s: f64) -> Marker {
        match cable.id.form {
            Form::Chain(chain) => {
                let (chain, marker) =
                    (&self.parts.bodies.lines()[chain], self.on_line_of(cable, s));
                let sections = self.parts.bodies.sections(chain);
                let section = sections.and_then(|rod| rod.section_at(&marker));
                section.unwrap_or(marker)
            }
            Form::Rod(_) | Form::Modal => self.on_line_of(cable, s),
        }
    }

    /// A point of the line of a cable or rod at a material coordinate in [0, 1].
    pub(crate) fn on_line_of(&self, cable: Cable<'_>, s: f64) -> Marker {
        let body = cable.id.body;
        match cable.id.form {
            Form::Chain(chain) => {
                let chain = &self.parts.bodies.lines()[chain];
                Marker::along(body, chain, s * chain.length())
            }
            Form::Rod(rod) => {
                let RigidRod { node, length, .. } = self.parts.bodies.rods()[rod];
                Marker::rigid(body, node, [(s - 0.5) * length, 0.0])
            }
            Form::Modal => self.on_modes(cable, s),
        }
    }
}

/// An element of a planar beam along its unstressed shape, and its inertia.
fn planar_beam(
    beam: &LineBody,
    shape: &At<f64>,
    length: f64,
    axial_time: f64,
    numbers: &dyn Fn(f64) -> SectionNumbers,
) -> (SectionElement, SpinInertia) {
    let time = beam.material.damping_time;
    let ends = [[shape.e[0], shape.e[1]], [shape.e[2], shape.e[3]]];
    let (sin, cos) = middle([&ends[0], &ends[1]], length)[0][0].sin_cos();
    let shape = At {
        inner: [cos, sin, 0.0],
        ..*shape
    };
    let parameters = planar::Parameters {
        length,
        stiffness: GAUSS_3.map(|point| beam.planar_stiffness(&numbers(point.at)).into()),
        damping_times: [axial_time, time, time],
    };
    // Against rotation about the first axis, which is across the plane.
    let inertia = planar_inertia(length, |xi| beam.rotary_inertia_of(&numbers(xi))[(1, 1)]);
    let beam = Planar::new(parameters, &shape);
    (SectionElement::Planar(Box::new(beam)), inertia)
}

/// Axes of the section at a node of a rod or beam, from the nodes that hold them.
fn section_axes<const D: usize>(axes: &[Node<D>], k: usize) -> [[f64; 3]; 3] {
    if D == 2 {
        return planar_axes(&axes[k][1]);
    }
    let [[_, first], [second, third]] = [axes[2 * k], axes[2 * k + 1]];
    [first, second, third].map(full)
}

/// Three components of a vector.
fn full<const D: usize>(v: [f64; D]) -> [f64; 3] {
    components(&Vector::<D>::from(v))
}

/// Numbers of the section at `xi` in [0, 1] between two neighbouring nodes.
fn numbers_along(body: &LineBody, s: &[f64]) -> impl Fn(f64) -> SectionNumbers {
    let (from, to) = (s[0], s[1]);
    let sections = body.sections_about(0.5 * (from + to));
    move |xi| sections(from + xi * (to - from)).0
}

/// The elements of a body, with the mass of the fluid (kg/m) that moves along at a section.
fn build_elements<const D: usize>(
    body: &LineBody,
    added: &dyn Fn(&SectionNumbers) -> f64,
    axial_damping_time: f64,
    nodes: &[f64],
) -> Vec<cable::Cable<D>> {
    let material = &body.material;
    let strain = match body.strain {
        Strain::ThetaPrime => elements::StrainMeasure::ThetaPrime,
        Strain::GreenLagrangeFrenetKappa => elements::StrainMeasure::GreenLagrangeFrenetKappa,
        Strain::EngStrainFrenetKappa => elements::StrainMeasure::EngStrainFrenetKappa,
    };
    let end = |s: f64| [body.shape.point(s), body.shape.tangent(s)].map(vector);
    let build = |s: &[f64]| {
        let [stretching, bending, density] = [
            LineBody::axial_stiffness_of,
            LineBody::bending_stiffness_of,
            LineBody::line_density_of,
        ]
        .map(|number| move |xi: f64| number(body, &numbers_along(body, s)(xi)));
        let parameters = cable::Parameters {
            length: (s[1] - s[0]) * body.shape.length(),
            axial_stiffness: stretching(0.5),
            bending_stiffness: bending(0.5),
            line_of: match body.sections {
                LineModel::Cable => LineOf::Cable,
                LineModel::Kirchhoff if body.is_coupled_axially() => LineOf::Beam,
                LineModel::Kirchhoff => LineOf::Rod,
                LineModel::Reissner => LineOf::Beam,
            },
            line_density: density(0.5),
            axial_damping_time,
            bending_damping_time: material.damping_time,
            strain,
            inertia: Inertia::Corrected,
        };
        let added = |xi: f64| added(&numbers_along(body, s)(xi));
        let mut taper = cable::SectionVariation {
            added: if body.stations.is_empty() {
                ElementPolynomial::from(added(0.5))
            } else {
                ElementPolynomial::through(added)
            },
            ..cable::SectionVariation::default()
        };
        if !body.stations.is_empty() {
            taper.axial = ElementPolynomial::through(|xi| stretching(xi) / stretching(0.5));
            taper.density = ElementPolynomial::through(|xi| density(xi) / density(0.5));
        }
        if !body.stations.is_empty() && bending(0.5) > 0.0 {
            taper.bending = ElementPolynomial::through(|xi| bending(xi) / bending(0.5));
        }
        let [a, b]: [[Vector<D>; 2]; 2] = [end(s[0]), end(s[1])];
        let e = Nodal::from_columns(&[a[0], a[1], b[0], b[1]]);
        let curved = (!body.shape.is_straight()).then_some(&e);
        cable::Cable::tapered(parameters, taper, curved)
    };
    nodes.windows(2).map(build).collect()
}
