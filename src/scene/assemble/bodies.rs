//! Bodies: a cable becomes a chain of elements or, where it does not bend, a rod; a rigid body a node.

use super::Builder;
use crate::body::{Frame, Marker};
use crate::elements::cable::{self, Inertia};
use crate::elements::{self, Nodal};
use crate::math::space::{Vector, axis, turned, vector};
use crate::scene::resolved::{BodyReference, Cable, Form, Rigid};
use crate::scene::{CableBody, Error, RigidBody, Strain};
use crate::system::{CableChain, LumpedMass, Rod};

/// A rigid body about its centre of mass: where that is, m, the angle of its frame, rad, mass, kg, and inertia, kg m^2.
struct Lump {
    position: [f64; 3],
    angle: f64,
    mass: f64,
    inertia: f64,
}

impl<const D: usize> Builder<'_, D> {
    pub(super) fn body(&mut self, index: usize) -> Result<(), Error> {
        let first = self.parts.nodes.len();
        let motion = self.resolved.scene.bodies[index].motion();
        let mut arm = [0.0; 3];
        match self.resolved.bodies[index] {
            BodyReference::Cable(cable) => match cable.id.form {
                Form::Chain(_) => self.chain(cable, first)?,
                Form::Rod(_) => arm[0] = self.rod(index, cable.body),
            },
            BodyReference::Rigid(rigid) => {
                if D == 3 && rigid.body.inertia().is_some() {
                    arm = self.frame(rigid);
                } else {
                    self.particle(index, rigid.body);
                }
            }
        }
        let nodes = first..self.parts.nodes.len();
        let has_frame = self
            .parts
            .frames
            .last()
            .is_some_and(|frame| frame.node == first);
        self.motions.push((nodes.clone(), has_frame), motion, arm);
        if let (BodyReference::Cable(cable), Some(field)) =
            (self.resolved.bodies[index], &motion.deformation)
        {
            let mesh = self.resolved.nodes(cable)?;
            self.motions
                .deform(field, &mesh, cable.body.shape.length())?;
        }
        self.parts.bodies.push(nodes);
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
                inertia: rigid.inertia().number(),
            },
        );
    }

    /// A rigid body of space that turns: its principal axes in two nodes. Gives back how far along them from the centre of
    /// all its mass the origin of its frame is, m.
    fn frame(&mut self, rigid: Rigid<'_>) -> [f64; 3] {
        let (solid, body) = (self.resolved.solid(rigid), rigid.body);
        let largest = solid.moments.iter().copied().fold(0.0, f64::max);
        let axes = body.axes() * solid.axes;
        let axis = |k: usize| vector::<D, f64>(axes.column(k).into_owned().into()).into();
        let node = self.parts.nodes.len();
        // What rounding left of the moment of a thin rod about itself is none.
        let rounded = |moment| if moment > 1e-9 * largest { moment } else { 0.0 };
        self.parts.frames.push(Frame {
            node,
            mass: solid.mass,
            moments: solid.moments.map(rounded),
            places: [None; 3],
        });
        let center = vector::<D, f64>(body.point(solid.center.into())).into();
        let nodes = [[center, axis(0)], [axis(1), axis(2)]];
        self.parts.nodes.extend(nodes);
        solid.along([0.0; 3])
    }

    /// A point of a rigid body in its frame, m.
    pub(super) fn point(&self, rigid: Rigid<'_>, point: [f64; 3]) -> Marker {
        let (index, body) = (rigid.id.index(), rigid.body);
        let node = self.parts.bodies[index].start;
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
        let chain = CableChain::new(build_elements(cable, axial, &mesh), first);
        let node = |s: &f64| {
            let ways = [cable.shape.point(*s), cable.shape.tangent(*s)];
            ways.map(|way| vector::<D, f64>(way).into())
        };
        self.parts.nodes.extend(mesh.iter().map(node));
        self.parts.chains.push(chain);
        Ok(())
    }

    /// A cable that does not bend, about its middle; gives back how far along it from there its first end is, m.
    fn rod(&mut self, index: usize, cable: &CableBody) -> f64 {
        let length = cable.shape.length();
        let mass = cable.material.density * cable.section.area * length;
        let [x, y, _] = cable.shape.tangent(0.5);
        self.parts.rods.push(Rod {
            node: self.parts.nodes.len(),
            length,
            mass: self.parts.lumped_masses.len(),
        });
        self.lump(
            index,
            &Lump {
                position: cable.shape.point(0.5),
                angle: y.atan2(x),
                mass,
                inertia: mass * length * length / 12.0,
            },
        );
        -0.5 * length
    }

    fn lump(&mut self, index: usize, lump: &Lump) {
        let node = self.parts.nodes.len();
        let direction: Vector<D> = turned(axis(0), lump.angle.sin_cos());
        let position: Vector<D> = vector(lump.position);
        (self.parts.nodes).push([position.into(), direction.into()]);
        self.parts.rigid.push((node, lump.inertia > 0.0));
        self.parts.lumped_masses.push(LumpedMass {
            marker: Marker::rigid(index, node, [0.0; 2]),
            mass: lump.mass,
            inertia: lump.inertia,
        });
    }

    /// A marker of a cable at a material coordinate in [0, 1].
    pub(super) fn along(&self, cable: Cable<'_>, s: f64) -> Marker {
        let body = cable.id.body;
        match cable.id.form {
            Form::Chain(chain) => {
                let chain = &self.parts.chains[chain];
                Marker::along(body, chain, s * chain.length())
            }
            Form::Rod(rod) => {
                let Rod { node, length, .. } = self.parts.rods[rod];
                Marker::rigid(body, node, [(s - 0.5) * length, 0.0])
            }
        }
    }
}

fn build_elements<const D: usize>(
    body: &CableBody,
    axial_damping_time: f64,
    nodes: &[f64],
) -> Vec<cable::Cable<D>> {
    let (material, section) = (&body.material, &body.section);
    let strain = match body.strain {
        Strain::ThetaPrime => elements::Strain::ThetaPrime,
        Strain::GreenLagrangeFrenetKappa => elements::Strain::GreenLagrangeFrenetKappa,
        Strain::EngStrainFrenetKappa => elements::Strain::EngStrainFrenetKappa,
    };
    let end = |s: f64| [body.shape.point(s), body.shape.tangent(s)].map(vector);
    let build = |s: &[f64]| {
        let parameters = cable::Parameters {
            length: (s[1] - s[0]) * body.shape.length(),
            axial_stiffness: material.youngs_modulus * section.area,
            bending_stiffness: material.youngs_modulus * section.second_moment,
            line_density: material.density * section.area,
            axial_damping_time,
            bending_damping_time: material.damping_time,
            strain,
            inertia: Inertia::Corrected,
        };
        let [a, b]: [[Vector<D>; 2]; 2] = [end(s[0]), end(s[1])];
        let e = Nodal::from_columns(&[a[0], a[1], b[0], b[1]]);
        let curved = (!body.shape.is_straight()).then_some(&e);
        cable::Cable::new(parameters, curved)
    };
    nodes.windows(2).map(build).collect()
}
