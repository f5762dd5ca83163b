//! Quantities that follow from a state.

use std::cell::Cell;

use nalgebra::Vector3;

use crate::bodies::{Marker, NodalMotion, Node, axes_at, combined, completed, spin_at};
use crate::elements::Element;
use crate::math::jet::Number;
use crate::math::rotation::{NO_ROTATION, Quaternion};
use crate::math::space::{Vector, axis};
use crate::system::instant::Instant;
use crate::system::joints::View;
use crate::system::loads::ForceElement as _;
use crate::system::motion::forces::weighted;
use crate::system::{Attachment, DrivenSystem, State, System, Workspace};

/// Coordinates, rates, accelerations and what constraints supply, of all nodes at one state.
#[derive(Clone, Debug)]
pub struct Evaluation<const D: usize = 2, N: Copy = f64> {
    pub(in crate::system) time: N,
    /// Inputs, and their rates.
    pub(in crate::system) inputs: Vec<N>,
    pub(in crate::system) input_rates: Vec<N>,
    /// Coordinates, m.
    pub x: Vec<Node<D, N>>,
    /// Rates, m/s.
    pub v: Vec<Node<D, N>>,
    /// Accelerations, m/s^2.
    pub acceleration: Vec<Node<D, N>>,
    /// Forces that linear constraints supply, N.
    pub(in crate::system) linear_constraint_forces: Vec<Node<D, N>>,
    /// Multipliers of non-linear constraints.
    pub(in crate::system) lambda: Vec<N>,
    /// Angles that are counted, rad.
    pub angles: Vec<N>,
    /// Where slides are, m.
    pub travel: Vec<N>,
    pub(in crate::system) drives: Vec<[N; 3]>,
    /// Frames that the state holds of rigid bodies of space.
    pub(in crate::system) frames: Vec<Quaternion>,
    /// Strains and curvatures at points of surfaces that were asked for since the last change, without and with rates, `[points]`.
    pub(in crate::system) strains: Vec<[SectionStrain<N>; 2]>,
    /// Release state of every joint that can be released.
    pub(in crate::system) released: Vec<bool>,
}

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Storage for a system.
    pub fn new(system: &System<D>) -> Self {
        let zero = N::of(0.0);
        let nodes = vec![[[zero; D]; 2]; system.bodies.reference.len()];
        Self {
            time: zero,
            inputs: Vec::new(),
            input_rates: Vec::new(),
            x: nodes.clone(),
            v: nodes.clone(),
            acceleration: nodes.clone(),
            linear_constraint_forces: nodes,
            lambda: vec![zero; system.constraints.len()],
            angles: vec![zero; system.angles.len()],
            travel: vec![zero; system.slides.len()],
            drives: vec![[zero; 3]; system.drives.len()],
            frames: vec![NO_ROTATION; system.bodies.frame_count()],
            strains: vec![Default::default(); system.bodies.surface_points()],
            released: vec![false; system.releases.len()],
        }
    }
}

/// Membrane strains and changes of curvature at a point of a surface, if they are known.
pub(in crate::system) type SectionStrain<N> = Cell<Option<[[N; 3]; 2]>>;

impl<const D: usize, N: Copy> Evaluation<D, N> {
    /// Forgets what followed from coordinates or rates that have changed.
    pub(in crate::system) fn forget(&self) {
        for strain in self.strains.as_flattened() {
            strain.set(None);
        }
    }
}

impl<const D: usize> Evaluation<D> {
    /// At rest with these nodal coordinates, angles less than half a turn; slides and driven coordinates are at zero.
    pub fn at_rest(system: &System<D>, nodes: &[Node<D>]) -> Self {
        let mut made = Self::new(system);
        made.x.copy_from_slice(nodes);
        for (value, angle) in made.angles.iter_mut().zip(&system.angles) {
            *value = angle.value(nodes, 0.0);
        }
        made
    }

    /// Takes over the inputs and their first and second derivatives, zero where there are none.
    pub fn set_inputs(&mut self, inputs: &[f64], slopes: &[[f64; 2]]) {
        self.inputs.clear();
        self.inputs.extend_from_slice(inputs);
        self.input_rates.clear();
        self.input_rates.extend(slopes.iter().map(|[rate, _]| rate));
        self.input_rates.resize(inputs.len(), 0.0);
    }

    /// Computes coordinates and rates.
    pub fn kinematics(&mut self, system: &System<D>, state: &State, work: &mut Workspace<D>) {
        work.resume(state);
        self.forget();
        self.time = system.now(state.time);
        system.forward_kinematics(state.time, &state.coordinates, Some(&state.rates), work);
        self.x.copy_from_slice(&work.kinematics.x);
        self.v.copy_from_slice(&work.kinematics.v);
        system.bodies.place_derived_rates(&self.x, &mut self.v);
        self.angles.copy_from_slice(&work.kinematics.angles);
        self.travel.copy_from_slice(&work.kinematics.travel);
        self.drives.copy_from_slice(&work.kinematics.drives);
        self.frames.copy_from_slice(&state.frames);
        self.released.copy_from_slice(&work.kinematics.released);
    }

    /// Computes accelerations and what constraints supply, inputs held.
    pub fn dynamics(
        &mut self,
        system: &System<D>,
        state: &State,
        inputs: &[f64],
        work: &mut Workspace<D>,
    ) {
        self.dynamics_moving(system, state, (inputs, &[]), work);
    }

    /// Evaluates the dynamics while inputs move with these first and second derivatives.
    pub fn dynamics_moving(
        &mut self,
        system: &System<D>,
        state: &State,
        (inputs, slopes): (&[f64], &[[f64; 2]]),
        work: &mut Workspace<D>,
    ) {
        self.set_inputs(inputs, slopes);
        let mut model = DrivenSystem::new(system, inputs, work, state).moving(slopes);
        model.accelerate(state.time, &state.coordinates, &state.rates);
        system.linear_constraint_forces(work);
        // An acceleration that is an input acts at once.
        self.drives.copy_from_slice(&work.kinematics.drives);
        self.acceleration.copy_from_slice(&work.scratch.other);
        self.linear_constraint_forces
            .copy_from_slice(&work.forces.linear_constraint_forces);
        self.lambda.copy_from_slice(&work.constraints.lambda);
        self.released.copy_from_slice(&work.kinematics.released);
    }
}

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Axial strain and curvature (1/m) at a marker of a cable; zero elsewhere. At a node they are those just after it,
    /// but at the last end.
    pub fn strain(&self, system: &System<D>, marker: &Marker) -> (N, N) {
        let at = system.bodies.element_after(marker);
        at.map_or((N::of(0.0), N::of(0.0)), |(chain, j, xi)| {
            let by = chain.length_now(&self.drives).by;
            let e = chain.element(j, &self.x) * by;
            let element = &chain.elements()[j];
            let curvature = element.strain(&e, xi).1 * by;
            (element.recovered_strain(&e, None, xi), curvature)
        })
    }

    /// Principal axes of the rigid body of space that a marker belongs to, in global components; the global ones where it
    /// belongs to none.
    pub fn axes(&self, system: &System<D>, marker: &Marker) -> [[N; 3]; 3] {
        if system.bodies.has_axes(marker.nodes[0]) {
            axes_at(marker.nodes[0], &self.x).map(<[N; 3]>::from)
        } else {
            std::array::from_fn(|k| axis::<3, N>(k).into())
        }
    }

    /// Quaternion of the principal axes that the state holds of the body that a marker belongs to: less than half a turn from
    /// the one now.
    pub fn held(&self, system: &System<D>, marker: &Marker) -> Quaternion {
        let index = system.bodies.frame_index(marker.nodes[0]);
        index.map_or(NO_ROTATION, |index| self.frames[index])
    }

    /// Angular velocity at a marker, rad/s: in the plane, its third component, that of the direction; in space that of the rigid
    /// body.
    pub fn spin(&self, system: &System<D>, marker: &Marker) -> [N; 3] {
        let node = marker.nodes[0];
        if !system.bodies.has_axes(node) {
            let spin = Attachment::<D, N>::Body(marker.lift()).spin(&self.x, &self.v);
            return [N::of(0.0), N::of(0.0), spin];
        }
        let spin = spin_at(node, &self.x, &self.v);
        combined(&completed::<D, N>(axes_at(node, &self.x)), &spin).into()
    }

    /// Angular acceleration at a marker, rad/s^2.
    pub fn spin_rate(&self, system: &System<D>, marker: &Marker) -> [N; 3] {
        let (x, v, a) = (&self.x, &self.v, &self.acceleration);
        let node = marker.nodes[0];
        if !system.bodies.has_axes(node) {
            let rate = Attachment::<D, N>::Body(marker.lift()).spin_rate(x, v, a);
            return [N::of(0.0), N::of(0.0), rate];
        }
        // Half the sum of e x e'', of which w x (w x e) gives nothing.
        let (axes, second) = (axes_at(node, x), axes_at(node, a));
        let sum = (0..3).fold(Vector3::zeros(), |sum, k| sum + axes[k].cross(&second[k]));
        (sum * N::of(0.5)).into()
    }

    /// Configuration and rates as bodies see them.
    pub(in crate::system) fn motion(&self) -> NodalMotion<'_, D, N> {
        NodalMotion {
            drives: &self.drives,
            x: &self.x,
            v: &self.v,
            from: None,
        }
    }

    pub(in crate::system) fn instant<'a>(&'a self, system: &'a System<D>) -> Instant<'a, D, N> {
        Instant {
            time: self.time,
            inputs: &self.inputs,
            input_rates: &self.input_rates,
            drives: &self.drives,
            x: &self.x,
            v: &self.v,
            bodies: &system.bodies,
            angles: (&system.angles, &self.angles),
        }
    }

    pub(in crate::system) fn view<'a>(&'a self, system: &'a System<D>) -> View<'a, D, N> {
        View {
            x: &self.x,
            v: &self.v,
            drives: &self.drives,
            bodies: &system.bodies,
            travel: &self.travel,
            angles: &self.angles,
            released: &self.released,
        }
    }

    /// Power that comes in and that is dissipated, W.
    pub fn power(&self, system: &System<D>) -> [N; 2] {
        let multiplied = system.constraints.iter().zip(self.lambda.iter().copied());
        let (at, view) = (self.instant(system), self.view(system));
        let by_bodies = system.bodies.dissipation(self.motion());
        let rate_of = |place: usize| {
            let target = &system.linear[system.driven[place].row].target;
            target.derivatives(&self.drives)[1]
        };
        system.power(
            at,
            &view,
            rate_of,
            (&self.linear_constraint_forces, by_bodies),
            multiplied,
        )
    }

    /// Largest residual of non-linear constraints: of positions, relative to their size, and of
    /// velocities, relative to size over time, 1/s. What roundoff leaves has no derivatives.
    pub fn residuals(&self, system: &System<D>) -> [f64; 2] {
        let view = self.view(system);
        [
            system.position_residual(&view),
            system.velocity_residual(&view),
        ]
    }

    /// Kinetic energy, J.
    pub fn kinetic_energy(&self, system: &System<D>) -> N {
        system.bodies.kinetic(self.motion())
    }

    /// Strain energy, J.
    pub fn strain_energy(&self, system: &System<D>) -> N {
        system.bodies.strain_energy(&self.drives, &self.x)
    }

    /// Energy in springs, J.
    pub fn spring_energy(&self, system: &System<D>) -> N {
        let at = self.instant(system);
        let energies = system.loads.iter().map(|load| load.energy(at));
        energies.fold(N::of(0.0), |sum, energy| sum + energy)
    }

    /// Potential energy of gravity, zero at the origin, and of the centrifugal force in a rotating frame,
    /// J.
    pub fn gravity_energy(&self, system: &System<D>) -> N {
        let falls = system.weight.iter().zip(&self.x);
        let mut fall = falls.fold(N::of(0.0), |sum, (w, x)| sum + weighted(w, x));
        fall += (system.bodies).fall_of_paid_out(system.gravity, &self.drives, &self.x);
        if !system.is_rotating() {
            return -fall;
        }
        -fall - system.bodies.centrifugal(system.rotation, &self.x)
    }

    /// Momentum (kg m/s) and angular momentum about the origin (kg m^2/s), in the plane its third component.
    pub fn momentum(&self, system: &System<D>) -> (Vector<D, N>, [N; 3]) {
        system.bodies.momentum(self.motion())
    }

    /// Center of mass, m.
    pub fn center_of_mass(&self, system: &System<D>) -> Vector<D, N> {
        (system.bodies).center_of_mass(&self.drives, &self.x)
    }
}

impl<const D: usize> System<D> {
    /// Multiplier of a linear row from the forces that rows supply on each node; zero for one that repeats others.
    pub(super) fn row_multiplier<N: Number>(
        &self,
        row: usize,
        supplied: impl Fn(usize) -> Node<D, N>,
    ) -> N {
        match self.holds[row] {
            Some((cluster, k)) => {
                let cluster = &self.elimination.assembly.clusters()[cluster];
                let column = cluster.multipliers.row(k);
                let mut sum = N::of(0.0);
                for (i, node) in cluster.nodes.iter().enumerate() {
                    for (part, f) in supplied(*node).as_flattened().iter().enumerate() {
                        sum += *f * N::of(column[2 * D * i + part]);
                    }
                }
                sum
            }
            None => N::of(0.0),
        }
    }
}
