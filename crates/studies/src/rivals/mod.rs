//! The formulations that the report argues against, at work in the plane: a floating frame of reference with modes,
//! corotational beams, and beams with large rotations as coordinates. One file a formulation, one trait for all.
//!
//! Every formulation says what is missing in its equations of motion, `M a + h(q, v) + dU/dq - Q`, and its exact
//! derivatives; joints keep multipliers; one implicit and one explicit integrator serve them all
//! (docs/decisions/0033-rival-formulations.md).

#[cfg(test)]
mod agree;
mod band;
mod basis;
mod corotational;
mod frame;
mod increments;
#[cfg(test)]
mod law;
mod march;
mod product;
mod rigid;
mod rotations;
mod scenes;
mod statics;
mod system;
mod table;
#[cfg(test)]
mod tests;

use band::Band;
use flexbody::elements::shape;

pub use increments::stretch_of_a_turn;
pub use march::{Kind, run};
pub use product::{adaptive, converged, energy_turned};
pub use rotations::Interpolation;
pub use scenes::{Choice, Played};
pub use statics::elastica;
pub use table::{Rivals, apart, rivals};

/// A point or vector of the plane.
pub type Vector = [f64; 2];

/// Positions, rates and accelerations of the coordinates of one body.
#[derive(Clone, Copy)]
pub struct Motion<'a> {
    /// Coordinates.
    pub q: &'a [f64],
    /// Rates of the coordinates.
    pub v: &'a [f64],
    /// Accelerations of the coordinates.
    pub a: &'a [f64],
}

/// A place on a body that joints and loads act at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// First end
    Start,
    /// Half-way
    Middle,
    /// Last end
    End,
}

impl Marker {
    /// The marker of a body, by the number of the body.
    pub const fn on(self, body: usize) -> BodyMarker {
        BodyMarker { body, marker: self }
    }
}

/// A marker of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BodyMarker {
    /// Number of the body.
    pub body: usize,
    /// Marker of that body.
    pub marker: Marker,
}

/// Placement of a straight body at the start, with a rigid motion.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// Position of the first end, m.
    pub start: Vector,
    /// Direction of the line, rad.
    pub angle: f64,
    /// Velocity of the first end, m/s.
    pub velocity: Vector,
    /// Angular velocity, rad/s.
    pub spin: f64,
}

/// Where a body adds its part of the tangent.
pub struct Block<'a> {
    band: &'a mut Band,
    offset: usize,
}

impl Block<'_> {
    /// Adds to an entry.
    #[inline(always)]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.band
            .add(self.offset + row, self.offset + column, value);
    }
}

/// Derivatives of a position by the coordinates that move it.
pub type Columns = Vec<(usize, Vector)>;

/// A body in one formulation.
pub trait Body {
    /// Number of coordinates.
    fn coordinates(&self) -> usize;

    /// Largest distance of coordinates that share an entry of the tangent.
    fn half_width(&self) -> usize;

    /// Whether the mass and derivatives of positions never change.
    fn has_constant_mass(&self) -> bool;

    /// Coordinates and rates of the undeformed body.
    fn place(&self, placement: &Placement) -> [Vec<f64>; 2];

    /// Adds `M a + h(q, v) + dU/dq - M g` with gravity `g`, m/s^2.
    fn residual(&self, motion: Motion<'_>, gravity: Vector, r: &mut [f64]);

    /// Adds `w_0 dR/dq + w_1 dR/dv + w_2 dR/da` of that residual.
    fn tangent(&self, motion: Motion<'_>, gravity: Vector, weights: [f64; 3], out: &mut Block<'_>);

    /// Elastic energy, J.
    fn strain_energy(&self, q: &[f64]) -> f64;

    /// Position of a marker, m.
    fn position(&self, marker: Marker, q: &[f64]) -> Vector;

    /// Derivatives of that position.
    fn columns(&self, marker: Marker, q: &[f64], out: &mut Columns);

    /// Acceleration of a marker where coordinates do not accelerate, m/s^2; none where positions are linear.
    fn bias(&self, _marker: Marker, _q: &[f64], _v: &[f64]) -> Vector {
        [0.0; 2]
    }

    /// Adds second derivatives of the position times a force; none where positions are linear.
    fn bend(&self, _marker: Marker, _q: &[f64], _force: Vector, _out: &mut Block<'_>) {}

    /// Direction of a marker, rad: a linear function of coordinates, its terms.
    fn angle(&self, marker: Marker) -> Vec<(usize, f64)>;
}

/// Shape functions of an element of cubic polynomials of length `l` (m) at `x` in [0, 1], differentiated so many times by
/// the length.
fn shape_functions(x: f64, l: f64, times: usize) -> [f64; 4] {
    match times {
        0 => shape::values(x, l),
        1 => shape::slopes(x, l),
        _ => shape::curvatures(x, l),
    }
    .into()
}

/// A node of position and angle: the first of its three coordinates.
#[derive(Clone, Copy)]
struct Node(usize);

impl Node {
    fn position(self, q: &[f64]) -> Vector {
        [q[self.0], q[self.0 + 1]]
    }

    /// Derivatives of the position.
    fn columns(self, out: &mut Columns) {
        out.extend([(self.0, [1.0, 0.0]), (self.0 + 1, [0.0, 1.0])]);
    }

    fn angle(self) -> Vec<(usize, f64)> {
        vec![(self.0 + 2, 1.0)]
    }
}

/// Sum of products.
#[inline(always)]
fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// A quarter of a revolution.
#[inline(always)]
fn quarter(a: Vector) -> Vector {
    [-a[1], a[0]]
}

/// `a + s b`.
#[inline(always)]
fn plus(a: Vector, s: f64, b: Vector) -> Vector {
    [a[0] + s * b[0], a[1] + s * b[1]]
}

/// In axes that are rotated by an angle: cosine and sine.
#[inline(always)]
fn turned([c, s]: Vector, a: Vector) -> Vector {
    [c * a[0] - s * a[1], s * a[0] + c * a[1]]
}

/// The inverse of [`turned`].
#[inline(always)]
fn back([c, s]: Vector, a: Vector) -> Vector {
    [c * a[0] + s * a[1], c * a[1] - s * a[0]]
}
