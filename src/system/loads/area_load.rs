//! Loads per area on a plate or shell: pressure along its normal, which follows the surface, and dead forces per area of the unstressed
//! surface.

use super::{Add, ForceElement, Instant};
use crate::bodies::{Bodies, Node, Patch, no_block};
use crate::elements::shell::{AREA_PLACES, ElementCorners};
use crate::math::jet::Number;
use crate::system::signal::Signal;

/// Numbers per area: the same everywhere, or known at [`AREA_PLACES`] places of each element.
#[derive(Clone, Debug)]
pub struct AreaValues<const K: usize> {
    /// Components that are the same everywhere; zero of those that change.
    pub uniform: [Signal; K],
    /// Components that change, at the places of every element in turn; empty of those that do not.
    pub along: [Vec<Signal>; K],
}

impl<const K: usize> AreaValues<K> {
    /// Values at all places of an element.
    fn at<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
    ) -> [[N; K]; AREA_PLACES] {
        let uniform = self.uniform.each_ref().map(|signal| signal.value(at));
        std::array::from_fn(|place| {
            std::array::from_fn(|k| {
                let here = self.along[k].get(AREA_PLACES * element + place);
                here.map_or(uniform[k], |signal| signal.value(at))
            })
        })
    }

    fn signals(&self) -> impl Iterator<Item = &Signal> {
        self.uniform.iter().chain(self.along.iter().flatten())
    }

    fn hold<const D: usize>(&mut self, at: Instant<'_, D>, fraction: f64) {
        let along = self.along.iter_mut().flatten();
        for signal in self.uniform.iter_mut().chain(along) {
            *signal = signal.held(at, fraction);
        }
    }
}

/// Action on an area.
#[derive(Clone, Debug)]
pub enum AreaAction {
    /// Pressure along the normal `r1 x r2`, Pa.
    Pressure(AreaValues<1>),
    /// Force per area of the unstressed surface in global components, N/m^2.
    Force(Box<AreaValues<3>>),
}

/// A load on a plate or shell.
#[derive(Clone, Debug)]
pub struct AreaLoad {
    /// Index among the plates and shells.
    pub patch: usize,
    /// The action.
    pub action: AreaAction,
}

impl AreaLoad {
    fn of<'a, const D: usize>(&self, bodies: &'a Bodies<D>) -> &'a Patch {
        &bodies.patches()[self.patch]
    }

    /// Forces on the corners of an element.
    fn force<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
    ) -> ElementCorners<N> {
        let patch = self.of(at.bodies);
        let of = &patch.elements()[element];
        match &self.action {
            AreaAction::Pressure(values) => {
                let pressures = values.at(at, element).map(|[pressure]| pressure);
                of.pressure_force(&patch.element(element, at.x), &pressures)
            }
            AreaAction::Force(values) => of.area_force(&values.at(at, element)),
        }
    }

    /// Forces at an instant times a nodal field.
    fn along<const D: usize, N: Number>(&self, at: Instant<'_, D, N>, field: &[Node<D, N>]) -> N {
        let patch = self.of(at.bodies);
        let mut sum = N::of(0.0);
        for element in 0..patch.elements().len() {
            let (force, field) = (self.force(at, element), patch.element(element, field));
            let pairs = force.as_flattened().iter().zip(field.as_flattened());
            for (force, field) in pairs {
                for (force, field) in force.iter().zip(field) {
                    sum += *force * *field;
                }
            }
        }
        sum
    }
}

impl<const D: usize> ForceElement<D> for AreaLoad {
    fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        for element in 0..self.of(at.bodies).elements().len() {
            self.add_part(at, element, f);
        }
    }

    /// Of pressure the symmetric part: all of it but at edges that move freely.
    fn add_tangent(&self, at: Instant<'_, D>, add: Add<'_, D>, _damping: Add<'_, D>) {
        let AreaAction::Pressure(values) = &self.action else {
            return;
        };
        let patch = self.of(at.bodies);
        for (index, element) in patch.elements().iter().enumerate() {
            let pressures = values.at(at, index).map(|[pressure]| pressure);
            let blocks = element.pressure_stiffness(&patch.element(index, at.x), &pressures);
            let nodes = patch.element_nodes(index);
            for (i, a) in nodes.iter().enumerate() {
                for (j, b) in nodes.iter().enumerate().take(i + 1) {
                    let mut block = no_block::<D>();
                    for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                        let part = &blocks[2 * i + p][2 * j + q];
                        for (r, c) in (0..D).flat_map(|r| (0..D).map(move |c| (r, c))) {
                            block[p][r][q][c] = part[(r, c)];
                        }
                    }
                    add(*a, *b, &block);
                }
            }
        }
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        [self.along(at, at.v), N::of(0.0)]
    }

    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        self.along(before, after.x) - self.along(before, before.x)
    }

    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        match &mut self.action {
            AreaAction::Pressure(values) => values.hold(at, fraction),
            AreaAction::Force(values) => values.hold(at, fraction),
        }
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        match &self.action {
            AreaAction::Pressure(values) => values.signals().for_each(call),
            AreaAction::Force(values) => values.signals().for_each(call),
        }
    }

    fn is_conservative(&self) -> bool {
        matches!(self.action, AreaAction::Force(_))
    }

    fn parts(&self, bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        let patch = self.of(bodies);
        let elements = 0..patch.elements().len();
        elements
            .map(|element| patch.element_nodes(element).to_vec())
            .collect()
    }

    fn add_part<N: Number>(&self, at: Instant<'_, D, N>, part: usize, f: &mut [Node<D, N>]) {
        let force = self.force(at, part);
        self.of(at.bodies).add_to(part, &force, f);
    }
}
