//! Quantities that follow from a state.

use nalgebra::Vector3;

use crate::body::{Marker, Node, RigidBodyFrame, RodChain, axes_at, combined, spin_at};
use crate::elements::{Element, Nodal};
use crate::math::jet::Number;
use crate::math::rotation::{NO_TURN, Quaternion};
use crate::math::space::{Vector, axis, moment};
use crate::system::instant::Instant;
use crate::system::joints::View;
use crate::system::motion::forces::weighted;
use crate::system::{Attachment, DrivenSystem, LineChain, State, System, Workspace};

/// Coordinates, rates, accelerations and what constraints supply, of all nodes at one state.
#[derive(Clone, Debug)]
pub struct Evaluation<const D: usize = 2, N = f64> {
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
    /// Release state of every joint that can be released.
    pub(in crate::system) released: Vec<bool>,
}

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Storage for a system.
    pub fn new(system: &System<D>) -> Self {
        let zero = N::of(0.0);
        let nodes = vec![[[zero; D]; 2]; system.reference.len()];
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
            frames: vec![NO_TURN; system.frames.count()],
            released: vec![false; system.releases.len()],
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
        self.time = system.now(state.time);
        system.forward_kinematics(state.time, &state.coordinates, Some(&state.rates), work);
        self.x.copy_from_slice(&work.kinematics.x);
        self.v.copy_from_slice(&work.kinematics.v);
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
        let at = system.element_after(marker);
        at.map_or((N::of(0.0), N::of(0.0)), |(chain, j, xi)| {
            let by = system.length_now(chain, &self.drives).by;
            let e = chain.element(j, &self.x) * by;
            let element = &chain.elements()[j];
            let curvature = element.strain(&e, xi).1 * by;
            (element.recovered_strain(&e, None, xi), curvature)
        })
    }

    /// Principal axes of the rigid body of space that a marker belongs to, in global components; the global ones where it
    /// belongs to none.
    pub fn axes(&self, system: &System<D>, marker: &Marker) -> [[N; 3]; 3] {
        if system.frames.has_axes(marker.nodes[0]) {
            axes_at(marker.nodes[0], &self.x).map(<[N; 3]>::from)
        } else {
            std::array::from_fn(|k| axis::<3, N>(k).into())
        }
    }

    /// Quaternion of the principal axes that the state holds of the body that a marker belongs to: less than half a turn from
    /// the one now.
    pub fn held(&self, system: &System<D>, marker: &Marker) -> Quaternion {
        let index = system.frames.index_of(marker.nodes[0]);
        index.map_or(NO_TURN, |index| self.frames[index])
    }

    /// Angular velocity at a marker, rad/s: in the plane, its third component, that of the direction; in space that of the rigid
    /// body.
    pub fn spin(&self, system: &System<D>, marker: &Marker) -> [N; 3] {
        let node = marker.nodes[0];
        if !system.frames.has_axes(node) {
            let spin = Attachment::<D, N>::Body(marker.lift()).spin(&self.x, &self.v);
            return [N::of(0.0), N::of(0.0), spin];
        }
        let spin = spin_at(node, &self.x, &self.v);
        combined(&axes_at(node, &self.x), &spin).into()
    }

    /// Angular acceleration at a marker, rad/s^2.
    pub fn spin_rate(&self, system: &System<D>, marker: &Marker) -> [N; 3] {
        let (x, v, a) = (&self.x, &self.v, &self.acceleration);
        let node = marker.nodes[0];
        if !system.frames.has_axes(node) {
            let rate = Attachment::<D, N>::Body(marker.lift()).spin_rate(x, v, a);
            return [N::of(0.0), N::of(0.0), rate];
        }
        // Half the sum of e x e'', of which w x (w x e) gives nothing.
        let (axes, second) = (axes_at(node, x), axes_at(node, a));
        let sum = (0..3).fold(Vector3::zeros(), |sum, k| sum + axes[k].cross(&second[k]));
        (sum * N::of(0.5)).into()
    }

    pub(in crate::system) fn instant<'a>(&'a self, system: &'a System<D>) -> Instant<'a, D, N> {
        Instant {
            time: self.time,
            inputs: &self.inputs,
            input_rates: &self.input_rates,
            drives: &self.drives,
            x: &self.x,
            v: &self.v,
            chains: &system.chains,
            sections: (&system.rod_chains, &system.frames),
            angles: (&system.angles, &self.angles),
            winches: &system.winches,
        }
    }

    pub(in crate::system) fn view<'a>(&'a self, system: &'a System<D>) -> View<'a, D, N> {
        View {
            x: &self.x,
            v: &self.v,
            drives: &self.drives,
            chains: &system.chains,
            travel: &self.travel,
            angles: &self.angles,
            released: &self.released,
        }
    }

    /// Power that comes in and that is dissipated, W.
    pub fn power(&self, system: &System<D>) -> [N; 2] {
        let multiplied = system.constraints.iter().zip(self.lambda.iter().copied());
        let (at, view) = (self.instant(system), self.view(system));
        let powers = (system.chains.iter()).map(|chain| {
            let longer = system.length_now(chain, &self.drives).longer();
            chain.dissipation((&self.x, &self.v), longer)
        });
        let by_rods = system.rod_chains().iter();
        let motion = (&self.x[..], &self.v[..]);
        let by_rods = by_rods.map(|chain| chain.dissipation(motion, &system.frames));
        let by_cables = powers
            .chain(by_rods)
            .fold(N::of(0.0), |sum, power| sum + power);
        let rate_of = |place: usize| {
            let target = &system.linear[system.driven[place].row].target;
            target.derivatives(&self.drives)[1]
        };
        system.power(
            at,
            &view,
            rate_of,
            (&self.linear_constraint_forces, by_cables),
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
        system.kinetic(&self.drives, (&self.x, &self.v))
    }

    /// Strain energy, J.
    pub fn strain_energy(&self, system: &System<D>) -> N {
        let energies = system
            .chains
            .iter()
            .map(|chain| chain.strain_energy(&self.x, system.length_now(chain, &self.drives).by))
            .chain((system.rod_chains().iter()).map(|chain| chain.strain_energy(&self.x)));
        energies.fold(N::of(0.0), |sum, energy| sum + energy)
    }

    /// Energy in springs, J.
    pub fn spring_energy(&self, system: &System<D>) -> N {
        let at = self.instant(system);
        let energies = system.loads.iter().map(|load| load.energy(at));
        energies.fold(N::of(0.0), |sum, energy| sum + energy)
    }

    /// Potential energy of gravity, zero at the origin, and of the centrifugal force in a turning frame,
    /// J.
    pub fn gravity_energy(&self, system: &System<D>) -> N {
        let falls = system.weight.iter().zip(&self.x);
        let mut fall = falls.fold(N::of(0.0), |sum, (w, x)| sum + weighted(w, x));
        for winch in system.winches() {
            let more = N::of(1.0) / winch.now(&self.drives).by - N::of(1.0);
            let sum = self.sum_of(&system.chains[winch.chain]);
            fall += sum.dot(&system.gravity.map(N::of)) * more;
        }
        if !system.is_turning() {
            return -fall;
        }
        -fall - system.centrifugal(&self.x)
    }

    /// Momentum (kg m/s) and angular momentum about the origin (kg m^2/s), in the plane its third component.
    pub fn momentum(&self, system: &System<D>) -> (Vector<D, N>, [N; 3]) {
        let (mut linear, mut angular) = (Vector::zeros(), Vector3::zeros());
        let mut add = |x: Vector<D, N>, p: Vector<D, N>, translates: bool| {
            if translates {
                linear += p;
            }
            angular += Vector3::from(moment(&x, &p));
        };
        for chain in &system.chains {
            let paid_out = system.paid_out(chain, &self.drives);
            for (j, element) in chain.elements().iter().enumerate() {
                let x: Nodal<D, N> = chain.element(j, &self.x);
                let mut p = chain.element(j, &self.v) * element.mass().map(N::of);
                if let Some((winch, now)) = &paid_out {
                    p = p / now.by + winch.passing_momentum(chain, j, &self.x, now);
                }
                for k in 0..4 {
                    add(x.column(k).into(), p.column(k).into(), k % 2 == 0);
                }
            }
        }
        for lump in &system.lumped_masses {
            let marker = lump.marker.lift();
            let (m, j) = (N::of(lump.moved()), N::of(lump.inertia));
            let (x, d) = (marker.position(&self.x), marker.direction(&self.x));
            let (p, s) = (marker.position(&self.v) * m, marker.direction(&self.v) * j);
            add(x, p, true);
            add(d, s, false);
        }
        for (node, part, mass) in system.frames.list().iter().flat_map(RigidBodyFrame::masses) {
            let [x, v] = [&self.x, &self.v].map(|of| Vector::from(of[node][part]));
            add(x, v * N::of(mass), system.is_center(node, part));
        }
        for chain in system.rod_chains() {
            let motion = (&self.x[..], &self.v[..]);
            chain.for_each_momentum(motion, &system.frames, |frame, momentum| {
                angular += combined(&frame.axes(&self.x), &momentum.into());
            });
            if D == 2 {
                angular[2] += chain.planar_momentum(motion, &system.frames);
            }
        }
        (linear, angular.into())
    }

    /// Center of mass, m.
    pub fn center_of_mass(&self, system: &System<D>) -> Vector<D, N> {
        let (mut sum, mut mass) = (Vector::zeros(), N::of(system.mass()));
        for chain in &system.chains {
            let longer = N::of(1.0) / system.length_now(chain, &self.drives).by;
            sum += self.sum_of(chain) * longer;
            mass += (longer - N::of(1.0)) * N::of(chain.mass());
        }
        for lump in &system.lumped_masses {
            sum += lump.marker.lift().position(&self.x) * N::of(lump.mass);
        }
        for frame in system.frames.list() {
            sum += Vector::from(self.x[frame.node][0]) * N::of(frame.mass);
        }
        sum / mass
    }

    /// Sum of the positions of a chain of its reference length, each times its mass, kg m.
    fn sum_of(&self, chain: &LineChain<D>) -> Vector<D, N> {
        let mut sum = Vector::zeros();
        for (j, element) in chain.elements().iter().enumerate() {
            sum += chain.element(j, &self.x) * element.weight().map(N::of);
        }
        sum
    }
}

impl<const D: usize> System<D> {
    /// Whether a vector of a rigid body of space is its centre of mass.
    fn is_center(&self, node: usize, part: usize) -> bool {
        part == 0 && matches!(self.frames.of_node::<D>(node), Some((_, false)))
    }

    /// Chain, element and place inside it of a marker of a cable.
    pub(in crate::system) fn element(
        &self,
        marker: &Marker,
    ) -> Option<(&LineChain<D>, usize, f64)> {
        let first = self.bodies[marker.body].start;
        let chain = self.chains.iter().find(|c| c.nodes(0)[0] == first)?;
        let (j, xi) = match self.sections(chain) {
            Some(sections) if marker.element.is_none() => sections.element_at(marker.nodes[0]),
            _ => marker.element?,
        };
        Some((chain, j, xi))
    }

    /// Bending and torsion of a rod whose line is this chain.
    pub fn sections(&self, chain: &LineChain<D>) -> Option<&RodChain> {
        let first = chain.nodes(0)[0];
        self.rod_chains().iter().find(|rod| rod.line() == first)
    }

    /// Returns the chain, the element and the place inside it of a marker of a cable. At an inner node it is the
    /// element after the node.
    pub(in crate::system) fn element_after(
        &self,
        marker: &Marker,
    ) -> Option<(&LineChain<D>, usize, f64)> {
        let (chain, j, xi) = self.element(marker)?;
        let is_before = xi == 1.0 && j + 1 < chain.elements().len();
        Some(if is_before {
            (chain, j + 1, 0.0)
        } else {
            (chain, j, xi)
        })
    }

    /// Multiplier of a linear row from the forces that rows supply; zero for one that repeats others.
    pub(super) fn row_multiplier<N: Number>(
        &self,
        row: usize,
        linear_constraint_forces: &[Node<D, N>],
    ) -> N {
        match self.holds[row] {
            Some((cluster, k)) => {
                let cluster = &self.elimination.assembly.clusters()[cluster];
                let column = cluster.multipliers.row(k);
                let nodes = cluster.nodes.iter();
                let nodes = nodes.flat_map(|node| linear_constraint_forces[*node].as_flattened());
                let terms = column.iter().zip(nodes);
                terms.fold(N::of(0.0), |sum, (c, f)| sum + *f * N::of(*c))
            }
            None => N::of(0.0),
        }
    }
}
