//! Loads per area on a plate or shell: pressure along its normal, which follows the surface, and dead forces per area of the unstressed
//! surface.

use super::{Add, ForceElement, Instant, LoadedSurface, hold};
use crate::bodies::{Bodies, Node};
use crate::elements::shell::{AREA_PLACES, ElementCorners};
use crate::math::jet::Number;
use crate::system::signal::Signal;

/// Action on an area.
#[derive(Clone, Debug)]
pub enum AreaAction {
    /// Pressure along the normal `r1 x r2`, Pa.
    Pressure(AreaValues),
    /// Force per area of the unstressed surface in global components, N/m^2.
    Force(Box<[AreaValues; 3]>),
}

/// A component of a load on an area.
#[derive(Clone, Debug)]
pub struct AreaValues {
    /// Value all over the area.
    pub uniform: Signal,
    /// Values at the places of quadrature, element by element, added to it; none of a component that is the same all over.
    pub places: Vec<Signal>,
}

/// A load on a plate or shell.
#[derive(Clone, Debug)]
pub struct AreaLoad {
    /// Surface that it acts on.
    pub on: LoadedSurface,
    /// The action.
    pub action: AreaAction,
}

impl AreaAction {
    /// Components of the action.
    fn values(&self) -> &[AreaValues] {
        match self {
            Self::Pressure(pressure) => std::slice::from_ref(pressure),
            Self::Force(load) => load.as_slice(),
        }
    }

    /// Components of the action, to be set.
    pub fn values_mut(&mut self) -> &mut [AreaValues] {
        match self {
            Self::Pressure(pressure) => std::slice::from_mut(pressure),
            Self::Force(load) => load.as_mut_slice(),
        }
    }
}

impl AreaValues {
    /// A value that is the same all over the area.
    pub fn uniform(uniform: Signal) -> Self {
        let places = Vec::new();
        Self { uniform, places }
    }

    /// All its signals.
    pub(super) fn signals(&self) -> impl Iterator<Item = &Signal> {
        std::iter::once(&self.uniform).chain(&self.places)
    }

    /// Values at the places of quadrature of an element.
    fn at<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
    ) -> [N; AREA_PLACES] {
        self.each_place(element, |signal| signal.value(at))
    }

    /// Values or rates, as a signal gives them, at the places of quadrature of an element.
    pub(super) fn each_place<N: Number>(
        &self,
        element: usize,
        of: impl Fn(&Signal) -> N,
    ) -> [N; AREA_PLACES] {
        let uniform = of(&self.uniform);
        let own = self.places.get(AREA_PLACES * element..);
        std::array::from_fn(|place| {
            let own = own.and_then(|own| own.get(place));
            own.map_or(uniform, |own| uniform + of(own))
        })
    }

    /// Holds its values at an instant, times a fraction.
    pub(super) fn hold<const D: usize>(&mut self, at: Instant<'_, D>, fraction: f64) {
        self.uniform = self.uniform.held(at, fraction);
        hold(&mut self.places, at, fraction);
    }
}

impl AreaLoad {
    /// Forces on the corners of an element.
    fn force<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
    ) -> ElementCorners<N> {
        let patch = self.on.patch(at.bodies);
        let of = &patch.elements()[element];
        match &self.action {
            AreaAction::Pressure(pressure) => {
                of.pressure_force(&patch.element(element, at.x), &pressure.at(at, element))
            }
            AreaAction::Force(load) if load.iter().all(|values| values.places.is_empty()) => {
                of.area_force(&load.each_ref().map(|values| values.uniform.value(at)))
            }
            AreaAction::Force(load) => {
                let values = load.each_ref().map(|values| values.at(at, element));
                of.varying_area_force(&std::array::from_fn(|place| values.map(|of| of[place])))
            }
        }
    }

    /// Forces at an instant times a nodal field.
    fn along<const D: usize, N: Number>(&self, at: Instant<'_, D, N>, field: &[Node<D, N>]) -> N {
        let patch = self.on.patch(at.bodies);
        let mut sum = N::of(0.0);
        for element in 0..self.on.count(at.bodies) {
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
        for element in 0..self.on.count(at.bodies) {
            self.add_part(at, element, f);
        }
    }

    /// Of pressure the symmetric part: all of it but at edges that move freely.
    fn add_tangent(&self, at: Instant<'_, D>, add: Add<'_, D>, _damping: Add<'_, D>) {
        let AreaAction::Pressure(pressure) = &self.action else {
            return;
        };
        let patch = self.on.patch(at.bodies);
        for (index, element) in patch.elements().iter().enumerate() {
            let pressure = pressure.at(at, index);
            let blocks = element.pressure_stiffness(&patch.element(index, at.x), &pressure);
            self.on.add_matrix(at.bodies, index, (&blocks, add));
        }
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        [self.along(at, at.v), N::of(0.0)]
    }

    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        self.along(before, after.x) - self.along(before, before.x)
    }

    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        for values in self.action.values_mut() {
            values.hold(at, fraction);
        }
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        let values = self.action.values().iter();
        values.flat_map(AreaValues::signals).for_each(call);
    }

    fn is_conservative(&self) -> bool {
        matches!(self.action, AreaAction::Force(_))
    }

    fn parts(&self, bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        self.on.parts(bodies)
    }

    fn add_part<N: Number>(&self, at: Instant<'_, D, N>, part: usize, f: &mut [Node<D, N>]) {
        let force = self.force(at, part);
        self.on.add(at.bodies, part, (&force, f));
    }
}
