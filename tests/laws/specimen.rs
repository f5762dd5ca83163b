//! Random cables: material, size, unstressed shape, deformed state and rates.

use flexbody::elements::cable::{Cable, Inertia, Parameters};
use flexbody::elements::{Nodal, StrainMeasure};
use nalgebra::{SMatrix, SVector};
use proptest::array::uniform12;
use proptest::prelude::*;

/// A cable in a state.
#[derive(Clone, Debug)]
pub struct Specimen<const D: usize> {
    pub cable: Cable<D>,
    pub parameters: Parameters,
    /// Coordinates without stress.
    pub unstressed: Nodal<D>,
    pub e: Nodal<D>,
    pub rate: Nodal<D>,
    /// Two random directions in coordinate space, positions in lengths of the element.
    pub directions: [Nodal<D>; 2],
}

impl<const D: usize> Specimen<D> {
    /// Size of its energy, J: allowed errors are fractions of it.
    pub fn energy_scale(&self) -> f64 {
        let p = &self.parameters;
        p.axial_stiffness * p.length + p.bending_stiffness / p.length
    }

    /// Whether the axial strain is sampled at Lobatto points.
    pub fn is_slender(&self) -> bool {
        let p = &self.parameters;
        p.axial_stiffness * p.length * p.length > 200.0 * p.bending_stiffness
    }
}

/// Exponentially distributed between two powers of ten.
pub fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..=high).prop_map(|exponent| 10.0_f64.powf(exponent))
}

/// Random coordinates in (-1, 1).
pub fn noise<const D: usize>() -> impl Strategy<Value = Nodal<D>> {
    uniform12(-1.0..1.0).prop_map(|x: [f64; 12]| Nodal::from_fn(|axis, k| x[4 * axis + k]))
}

/// Strain measures.
pub fn strains() -> impl Strategy<Value = StrainMeasure> {
    prop_oneof![
        Just(StrainMeasure::ThetaPrime),
        Just(StrainMeasure::GreenLagrangeFrenetKappa),
        Just(StrainMeasure::EngStrainFrenetKappa),
    ]
}

/// A straight element along the first axis, disturbed; slopes stay away from zero everywhere.
fn disturbed<const D: usize>(length: f64, noise: &Nodal<D>) -> Nodal<D> {
    let mut e = Nodal::<D>::zeros();
    e[(0, 1)] = 1.0;
    e[(0, 2)] = length;
    e[(0, 3)] = 1.0;
    for (column, size) in [(0, 0.15 * length), (1, 0.3), (2, 0.15 * length), (3, 0.3)] {
        let value = e.column(column) + noise.column(column) * size;
        e.set_column(column, &value);
    }
    e
}

/// Random material on a random length, slender or short; damped alike or not in both strains, or in one alone.
fn parameters() -> impl Strategy<Value = Parameters> {
    let time = || prop_oneof![Just(0.0), decades(-3.0, 0.0)];
    let damping = [time(), time()];
    let sizes = (decades(-2.0, 1.0), decades(-2.0, 5.0), decades(-2.0, 4.0));
    (sizes, decades(-3.0, 3.0), damping, strains()).prop_map(
        |((length, slenderness, bending_stiffness), line_density, damping, strain)| Parameters {
            inertia: Inertia::Corrected,
            length,
            axial_stiffness: slenderness * bending_stiffness / (length * length),
            bending_stiffness,
            line_of: flexbody::elements::cable::LineOf::Cable,
            line_density,
            axial_damping_time: damping[0],
            bending_damping_time: damping[1],
            strain,
        },
    )
}

fn specimen<const D: usize>(curved: BoxedStrategy<bool>) -> impl Strategy<Value = Specimen<D>> {
    let noises = (noise(), noise(), noise(), noise(), noise());
    (parameters(), curved, noises).prop_map(|(parameters, curved, noises)| {
        let length = parameters.length;
        let (natural, state, rate, first, second) = noises;
        let unstressed = if curved {
            disturbed(length, &natural)
        } else {
            disturbed(length, &Nodal::zeros())
        };
        let direction = |x: &Nodal<D>| super::differences::scaled(x, length);
        Specimen {
            cable: Cable::new(parameters, curved.then_some(&unstressed)),
            parameters,
            unstressed,
            e: disturbed(length, &state),
            rate: direction(&rate),
            directions: [direction(&first), direction(&second)],
        }
    })
}

/// Planar cables: straight and curved, with and without damping, all strain measures.
pub fn planar() -> impl Strategy<Value = Specimen<2>> {
    specimen(any::<bool>().boxed())
}

/// Spatial cables: straight, with and without damping.
pub fn spatial() -> impl Strategy<Value = Specimen<3>> {
    specimen(Just(false).boxed())
}

/// A rigid motion of space with its rates.
#[derive(Clone, Debug)]
pub struct RigidMotion<const D: usize> {
    pub rotation: SMatrix<f64, D, D>,
    pub translation: SVector<f64, D>,
    pub velocity: SVector<f64, D>,
    /// Antisymmetric.
    pub spin: SMatrix<f64, D, D>,
}

impl<const D: usize> RigidMotion<D> {
    /// Coordinates after the motion.
    pub fn place(&self, e: &Nodal<D>) -> Nodal<D> {
        let mut moved = self.rotation * e;
        for column in [0, 2] {
            let position = moved.column(column) + self.translation;
            moved.set_column(column, &position);
        }
        moved
    }

    /// Rates after the motion, of coordinates with these rates before it.
    pub fn rate(&self, e: &Nodal<D>, rate: &Nodal<D>) -> Nodal<D> {
        let mut moved = self.rotation * rate + self.spin * self.rotation * e;
        for column in [0, 2] {
            let velocity = moved.column(column) + self.velocity;
            moved.set_column(column, &velocity);
        }
        moved
    }
}

/// Random rigid motions; translations of the size of `length`.
pub fn rigid_motion<const D: usize>() -> impl Strategy<Value = RigidMotion<D>> {
    uniform12(-1.0..1.0).prop_map(|x: [f64; 12]| {
        let mut rotation = SMatrix::<f64, D, D>::identity();
        let mut spin = SMatrix::<f64, D, D>::zeros();
        let mut next = 0;
        for i in 0..D {
            for j in i + 1..D {
                let (sin, cos) = (4.0 * x[next]).sin_cos();
                let mut turn = SMatrix::<f64, D, D>::identity();
                turn[(i, i)] = cos;
                turn[(j, j)] = cos;
                turn[(i, j)] = -sin;
                turn[(j, i)] = sin;
                rotation = turn * rotation;
                spin[(j, i)] = x[next + 3];
                spin[(i, j)] = -x[next + 3];
                next += 1;
            }
        }
        RigidMotion {
            rotation,
            translation: SVector::from_fn(|i, _| x[6 + i]),
            velocity: SVector::from_fn(|i, _| x[9 + i]),
            spin,
        }
    })
}
