//! The rigid motion from the drawn shape of a flexible body that fits its present shape best.
//!
//! It makes the integral of the squared distance along the reference length smallest. In the plane its angle is that of the sums of
//! cross and scalar products; in space its rotation is the orthogonal factor of `B = integral r d^T ds`, of places `r` now and `d` as
//! drawn about their means.
//!
//! Source: B. K. P. Horn, H. M. Hilden, S. Negahdaripour, Closed-form solution of absolute orientation using orthonormal matrices,
//! J. Opt. Soc. Am. A 5 (1988) 1127-1135.

use nalgebra::{Matrix3, Vector3, Vector4};

use crate::bodies::{LineChain, Marker, Node, Patch, axes_at};
use crate::elements::{Element, shape};
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::rotation::axes;
use crate::math::space::{Vector, components};
use crate::system::{Evaluation, System};

/// Weight of section frames beside places in the fit of a rod or beam of space: what places leave open, the roll about a straight
/// line, the frames decide, and nothing else noticeably.
const FRAMES: f64 = 1e-6;
/// Squared height over squared length up to which a drawn cable counts as straight: places do not say its roll.
const STRAIGHT: f64 = 1e-12;
/// Newton steps after a rotation that is exact in value; each one makes one more derivative exact.
const STEPS: usize = 2;

/// A rigid motion: where a drawn point has gone, and what the drawn axes have become.
#[derive(Clone, Copy, Debug)]
pub struct RigidFit<N = f64> {
    /// A point as drawn, m.
    drawn: Vector3<N>,
    /// Present position of the point, m.
    now: Vector3<N>,
    /// The global axes as drawn, in global components now.
    axes: [Vector3<N>; 3],
}

impl<N: Number> RigidFit<N> {
    /// Motion of a point as drawn to where it is now, with these axes.
    pub(super) fn new(drawn: Vector3<N>, now: Vector3<N>, axes: [Vector3<N>; 3]) -> Self {
        Self { drawn, now, axes }
    }

    /// Place of a point now less where the rigid motion takes its drawn place, along the moved axes, m.
    pub fn displacement(&self, drawn: &Vector3<N>, now: &Vector3<N>) -> Vector3<N> {
        let (way, from) = (now - self.now, drawn - self.drawn);
        Vector3::from_fn(|k, _| self.axes[k].dot(&way)) - from
    }
}

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Rigid motion of a chain from these drawn nodes that fits it best now. What a winch has paid out lengthens the drawn shape.
    pub fn rigid_fit(
        &self,
        system: &System<D>,
        chain: &LineChain<D>,
        drawn: &[Node<D>],
    ) -> RigidFit<N> {
        let by = chain.length_now(&self.drives).length_ratio();
        let (drawn_mean, mean) = self.means(chain, drawn);
        let mut moments = Matrix3::<N>::zeros();
        let mut inertia = Matrix3::<f64>::zeros();
        for_each_point(chain, |j, values, weight| {
            let d = place(chain, j, drawn, values) - drawn_mean;
            let r = place(chain, j, &self.x, values.map(N::of)) - mean;
            moments += r * d.map(N::of).transpose() * N::of(weight);
            inertia += d * d.transpose() * weight;
        });
        let axes = match D {
            2 => planar(&moments),
            _ => self.spatial(system, chain, drawn, (moments, inertia)),
        };
        RigidFit::new(drawn_mean.map(N::of) * by, mean, axes)
    }

    /// Means of the places along a chain, as drawn and now, m.
    fn means(&self, chain: &LineChain<D>, drawn: &[Node<D>]) -> (Vector3<f64>, Vector3<N>) {
        let (mut before, mut now) = (Vector3::zeros(), Vector3::zeros());
        let whole = 1.0 / chain.length();
        for_each_point(chain, |j, values, weight| {
            before += place(chain, j, drawn, values) * (weight * whole);
            now += place(chain, j, &self.x, values.map(N::of)) * N::of(weight * whole);
        });
        (before, now)
    }

    /// Best rotation in space, by moments of places now by places as drawn, and of the latter among themselves.
    fn spatial(
        &self,
        system: &System<D>,
        chain: &LineChain<D>,
        drawn: &[Node<D>],
        (mut moments, inertia): (Matrix3<N>, Matrix3<f64>),
    ) -> [Vector3<N>; 3] {
        if let Some(sections) = system.bodies.sections(chain) {
            let weight = FRAMES * inertia.trace() / chain.length();
            for j in 0..sections.count() {
                let (before, now) = (sections.at(j, drawn).axes, sections.at(j, &self.x).axes);
                let part = N::of(0.5 * chain.element_length(j) * weight);
                for (a, b) in now.as_flattened().iter().zip(before.as_flattened()) {
                    let b = Vector3::from(*b).map(N::of);
                    moments += Vector3::from(*a) * b.transpose() * part;
                }
            }
            return orthogonal(&moments);
        }
        let eigen = inertia.symmetric_eigen();
        let largest = eigen.eigenvalues.imax();
        let across = inertia.trace() - eigen.eigenvalues[largest];
        if across > STRAIGHT * inertia.trace() {
            return orthogonal(&moments);
        }
        let line: Vector3<f64> = eigen.eigenvectors.column(largest).into();
        smallest(&line, &(moments * line.map(N::of)).normalize())
    }
}

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Deflection of a marker: its place less where the drawn body takes it that the frame at another marker carries, along the carried axes,
    /// m. Without another marker a chain is in its best rigid fit, and the mean axes carry a reduced body. Zero of what does not bend, and of a
    /// plate without another marker.
    pub fn deflection(
        &self,
        system: &System<D>,
        drawn: &[Node<D>],
        marker: &Marker,
        from: Option<&Marker>,
    ) -> [N; 3] {
        let line = system.bodies.line(marker.body);
        let mean = system.bodies.mean_axes(marker.body);
        let mut patches = system.bodies.patches().iter();
        let is_patch = patches.any(|patch| patch.all().contains(&marker.nodes[0]));
        if line.is_none() && mean.is_none() && !is_patch {
            return [N::of(0.0); 3];
        }
        let by = line.map_or(N::of(1.0), |chain| {
            chain.length_now(&self.drives).length_ratio()
        });
        let as_drawn = |of: &Marker| full(of.position(drawn)).map(N::of) * by;
        let now = |of: &Marker| full(of.lift().position(&self.x));
        let fit = match (from.or(mean.as_ref()), line) {
            (Some(from), _) => {
                let axes = self.carried_axes(drawn, from);
                RigidFit::new(as_drawn(from), now(from), axes)
            }
            (None, Some(chain)) => self.rigid_fit(system, chain, drawn),
            (None, None) => return [N::of(0.0); 3],
        };
        fit.displacement(&as_drawn(marker), &now(marker)).into()
    }

    /// Returns the global axes after the motion of the frame at a marker of a chain since it was drawn.
    fn carried_axes(&self, drawn: &[Node<D>], marker: &Marker) -> [Vector3<N>; 3] {
        let before = full(marker.direction(drawn)).normalize();
        let now: Vector3<N> = full(marker.lift().direction(&self.x)).normalize();
        if D == 2 {
            return planar(&(now * before.map(N::of).transpose()));
        }
        if !marker.is_framed() {
            return smallest(&before, &now);
        }
        let node = marker.nodes[0];
        let (before, now) = (axes_at(node, drawn), axes_at(node, &self.x));
        let part = |k: usize, axis: usize| now[axis] * N::of(before[axis][k]);
        std::array::from_fn(|k| part(k, 0) + part(k, 1) + part(k, 2))
    }
}

impl<const D: usize> Evaluation<D> {
    /// Largest distance of the nodes of a chain from where its best rigid fit to these drawn nodes takes them, m.
    pub fn elastic_displacement(
        &self,
        system: &System<D>,
        chain: &LineChain<D>,
        drawn: &[Node<D>],
    ) -> f64 {
        let fit = self.rigid_fit(system, chain, drawn);
        let by = chain.length_now(&self.drives).length_ratio();
        let at = |x: &[Node<D>], node: usize| full(Vector::from(x[node][0]));
        let away = chain
            .range()
            .map(|node| fit.displacement(&(at(drawn, node) * by), &at(&self.x, node)));
        away.map(|away| away.norm()).fold(0.0, f64::max)
    }

    /// Largest distance of the mesh nodes of a plate or shell from where the rigid fit of all of them to these drawn nodes takes them, m.
    pub fn surface_elastic_displacement(&self, patch: &Patch, drawn: &[Node<D>]) -> f64 {
        let at = |x: &[Node<D>], node: usize| full(Vector::from(x[node][0]));
        let nodes = || patch.mesh().step_by(2);
        let part = 1.0 / nodes().count() as f64;
        let mean = |x: &[Node<D>]| nodes().map(|node| at(x, node) * part).sum::<Vector3<f64>>();
        let (before, now) = (mean(drawn), mean(&self.x));
        let moments =
            nodes().map(|node| (at(&self.x, node) - now) * (at(drawn, node) - before).transpose());
        let fit = RigidFit::new(before, now, orthogonal(&moments.sum::<Matrix3<f64>>()));
        let away = nodes().map(|node| fit.displacement(&at(drawn, node), &at(&self.x, node)));
        away.map(|away| away.norm()).fold(0.0, f64::max)
    }
}

/// Calls back with points along a chain: element, weights of its coordinates there, and length that the point stands for, m.
fn for_each_point<const D: usize>(
    chain: &LineChain<D>,
    mut each: impl FnMut(usize, Vector4<f64>, f64),
) {
    for (j, element) in chain.elements().iter().enumerate() {
        let length = element.length();
        for point in GAUSS_5 {
            each(j, shape::values(point.at, length), point.weight * length);
        }
    }
}

/// Place along an element, m.
fn place<const D: usize, N: Number>(
    chain: &LineChain<D>,
    j: usize,
    x: &[Node<D, N>],
    values: Vector4<N>,
) -> Vector3<N> {
    full(chain.element(j, x) * values)
}

/// Three components of a vector.
fn full<const D: usize, N: Number>(v: Vector<D, N>) -> Vector3<N> {
    Vector3::from(components(&v))
}

/// Best rotation in the plane.
fn planar<N: Number>(moments: &Matrix3<N>) -> [Vector3<N>; 3] {
    let (zero, one) = (N::of(0.0), N::of(1.0));
    let cosine = moments[(0, 0)] + moments[(1, 1)];
    let sine = moments[(1, 0)] - moments[(0, 1)];
    let square = cosine * cosine + sine * sine;
    let [c, s] = if square > zero {
        [cosine, sine].map(|part| part / square.root())
    } else {
        [one, zero]
    };
    [
        Vector3::new(c, s, zero),
        Vector3::new(-s, c, zero),
        Vector3::new(zero, zero, one),
    ]
}

/// Columns of the rotation `R` with the largest trace of `R^T B`.
fn orthogonal<N: Number>(moments: &Matrix3<N>) -> [Vector3<N>; 3] {
    let svd = moments.map(Number::plain).svd(true, true);
    let (Some(mut u), Some(v)) = (svd.u, svd.v_t) else {
        return std::array::from_fn(|k| crate::math::space::axis(k));
    };
    if (u * v).determinant() < 0.0 {
        let least = svd.singular_values.imin();
        u.column_mut(least).neg_mut();
    }
    let mut rotation = (u * v).map(N::of);
    for _ in 0..STEPS {
        // Trace of `(R exp(w))^T B` to second order in `w`.
        let c = rotation.transpose() * moments;
        let half = N::of(0.5);
        let slope = Vector3::new(
            c[(2, 1)] - c[(1, 2)],
            c[(0, 2)] - c[(2, 0)],
            c[(1, 0)] - c[(0, 1)],
        );
        let curved = Matrix3::from_diagonal_element(c.trace()) - (c + c.transpose()) * half;
        let Some(back) = curved.try_inverse() else {
            break;
        };
        let [x, y, z] = (back * slope * half).into();
        rotation *= Matrix3::from_columns(&axes(&[N::of(1.0), x, y, z]));
    }
    [0, 1, 2].map(|k| rotation.column(k).into_owned())
}

/// The axes after the smallest rotation that takes one unit vector to another; half a turn about any normal between opposite ones.
pub(super) fn smallest<N: Number>(from: &Vector3<f64>, to: &Vector3<N>) -> [Vector3<N>; 3] {
    let (e, one) = (from.map(N::of), N::of(1.0));
    let about = e.cross(to);
    let room = one + e.dot(to);
    std::array::from_fn(|k| {
        let unit: Vector3<N> = crate::math::space::axis(k);
        if room.plain() < 1e-14 {
            let normal: Vector3<f64> = crate::math::space::normal(from, 0);
            let normal = normal.map(N::of);
            return normal * (normal[k] * N::of(2.0)) - unit;
        }
        let once = about.cross(&unit);
        unit + once + about.cross(&once) / room
    })
}
