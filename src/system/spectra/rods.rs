//! Rods in the linearized equations of motion.

use nalgebra::{SMatrix, SVector};

use super::linearization::Linearization;
use super::probe::{Nodes, Probe};
use crate::bodies::{Node, RodChain, RotationMaps};
use crate::elements::beam::VELOCITIES;
use crate::elements::rod::Tangent;
use crate::math::sparse::Matrix;
use crate::system::{System, Workspace};

/// A matrix over the velocities of an element of a rod.
type Whole = SMatrix<f64, VELOCITIES, VELOCITIES>;

/// Tangents of one element of a rod.
#[derive(Clone, Debug)]
pub(super) struct RodElastic<'a> {
    chain: &'a RodChain,
    element: usize,
    pub stiffness: Whole,
    pub damping: Option<Whole>,
}

impl RodElastic<'_> {
    /// Displacements of the nodes relative to the position of the first.
    pub fn relative<const D: usize>(&self, x: &[Node<D>]) -> SVector<f64, VELOCITIES> {
        self.chain.displacements(self.element, x).into()
    }
}

impl<const D: usize> System<D> {
    /// Adds the geometric stiffness of forces on section axes, which rotate.
    pub(super) fn linearize_carried(&self, work: &Workspace<D>, made: &mut Linearization<'_, D>) {
        if self.bodies.frames.carried().is_empty() {
            return;
        }
        let assembly = &self.elimination.assembly;
        let mut stiffness = Matrix::zeros(assembly.pattern());
        for frame in self.bodies.frames.carried() {
            RotationMaps::geometric_of_carried(
                frame,
                &work.forces.linear_constraint_forces,
                &work.kinematics.x,
                |a, b, block| {
                    assembly.add(a, b, block, &mut stiffness);
                },
            );
        }
        made.stiffness.add_symmetric(1.0, &stiffness);
    }

    /// Adds the contributions of the scene's rotation to the spin inertia of sections.
    pub(super) fn linearize_turning(
        &self,
        work: &Workspace<D>,
        probe: &mut Probe<D>,
        made: &mut Linearization<'_, D>,
    ) {
        if !self.is_turning() || D == 2 {
            return;
        }
        let assembly = &self.elimination.assembly;
        let mut none = |_: usize, _: usize, _: f64| {};
        for chain in &self.bodies.rod_chains {
            for j in 0..chain.count() {
                let force = |x: &Nodes<D>, v: &Nodes<D>, f: &mut Nodes<D>| {
                    let force = chain.turning(j, (x, v), self.rotation, &self.bodies.frames);
                    chain.add_load(j, &force, x, f);
                };
                let nodes = chain.all_nodes(j);
                let blocks = probe.differentiate(&nodes, false, &force);
                let mut blocks = blocks.pulled(&self.bodies.frames, &work.kinematics.x);
                let by_rates = probe.differentiate(&nodes, true, &force);
                blocks.add_turned(
                    &by_rates,
                    &self.bodies.frames,
                    (&work.kinematics.x, &work.kinematics.v),
                );
                blocks.add(assembly, &mut made.stiffness, &mut none);
                let by_rates = by_rates.pulled(&self.bodies.frames, &work.kinematics.x);
                by_rates.add(assembly, &mut made.damping, &mut none);
            }
        }
    }

    /// Bending and torsion of rods, at rest.
    pub(super) fn linearize_rods<'a>(
        &'a self,
        work: &Workspace<D>,
        at_rest: bool,
        made: &mut Linearization<'a, D>,
    ) {
        if self.bodies.rod_chains.is_empty() {
            return;
        }
        let assembly = &self.elimination.assembly;
        let [mut stiffness, mut damping] = [0, 1].map(|_| Matrix::zeros(assembly.pattern()));
        let motion = (&work.kinematics.x[..], &work.kinematics.v[..]);
        for chain in &self.bodies.rod_chains {
            let first = made.rods.len();
            chain.for_each_tangent(motion, &self.bodies.frames, |kind, element, whole| {
                let whole = Whole::from_fn(|r, c| whole[r][c]);
                match kind {
                    Tangent::Stiffness => made.rods.push(RodElastic {
                        chain,
                        element,
                        stiffness: whole,
                        damping: None,
                    }),
                    Tangent::Damping if at_rest => {}
                    Tangent::Damping => made.rods[first + element].damping = Some(whole),
                }
            });
            let matrices = [&mut stiffness, &mut damping];
            chain.add_tangent(motion, &self.bodies.frames, assembly, matrices);
        }
        made.stiffness.add_symmetric(1.0, &stiffness);
        if !at_rest && self.bodies.rod_chains.iter().any(RodChain::is_damped) {
            made.is_damped = true;
            made.damping.add_symmetric(1.0, &damping);
        }
    }
}
