//! Rigid bodies of space in open trees, whose joints each hold one point and some rotates: the least change of `q` that
//! satisfies all of them, `[I J^T; J 0]` eliminated body by body from the leaves to the roots.
//!
//! Once a body and the multipliers of its joint are eliminated, what its parent feels is an inertia again, `I'`, without
//! what the joint leaves free. Ways `s` that are free (six numbers: a rotation, a shift of the point that is held) say that
//! at less cost than multipliers: with `U = I s`, `D = s.U`, the rest is `I' = I - U U^T / D`, way after way. All
//! pivots `D` are positive, and constraints depend on each other nowhere but where two of the rotations that one joint holds
//! do.
//!
//! Sources: R. Featherstone, Rigid Body Dynamics Algorithms (2008), chapter 7 (articulated bodies); D. Baraff, Linear-time
//! dynamics using Lagrange multipliers, SIGGRAPH 96 (the elimination that this is).

use std::ops::Range;

use nalgebra::{Matrix3, Vector3};

use super::connectivity::Node;
use super::frame::{Axes, RigidBodyFrame, combined};

/// Part of the product of their sizes that rotations which a joint holds must span.
const SPAN: f64 = 1e-3;

/// A body and the joint to its parent.
#[derive(Clone, Debug)]
pub struct Link {
    /// Index of the rigid body among the frames.
    pub frame: usize,
    /// Index of the parent link, which is earlier in the list. `None` for a joint to the ground or for a free body.
    pub parent: Option<usize>,
    /// Components of the point that is held along the axes of the body and of its parent, m; nothing where no joint holds
    /// the body.
    pub arms: Option<[[f64; 3]; 2]>,
    /// Where the rotations that are held are among all of them: up to three.
    pub turns: Range<usize>,
    /// Where its centre of mass is among the coordinates `q`, and how many of that make a metre.
    pub center: (usize, f64),
}

/// A rotation and a shift, rad/s^2 and m/s^2; or a moment and a force, N m and N.
#[derive(Clone, Copy, Debug, Default)]
struct Twist {
    turn: Vector3<f64>,
    shift: Vector3<f64>,
}

impl Twist {
    fn dot(&self, other: &Self) -> f64 {
        self.turn.dot(&other.turn) + self.shift.dot(&other.shift)
    }

    fn add(&mut self, factor: f64, other: &Self) {
        self.turn += other.turn * factor;
        self.shift += other.shift * factor;
    }
}

/// Inertia against rotations and shifts of a point: moment `J w + H v`, force `H^T w + M v`.
#[derive(Clone, Copy, Debug, Default)]
struct SpatialInertia {
    j: Matrix3<f64>,
    h: Matrix3<f64>,
    m: Matrix3<f64>,
}

/// `r x` every column.
#[inline(always)]
fn crossed(r: &Vector3<f64>, m: &Matrix3<f64>) -> Matrix3<f64> {
    let column = |k: usize| {
        let [x, y, z] = [m[(0, k)], m[(1, k)], m[(2, k)]];
        [
            r[1] * z - r[2] * y,
            r[2] * x - r[0] * z,
            r[0] * y - r[1] * x,
        ]
    };
    Matrix3::from_columns(&[column(0), column(1), column(2)].map(Vector3::from))
}

impl SpatialInertia {
    /// Returns the inertia of a body about its centre of mass.
    fn of(frame: &RigidBodyFrame, axes: &Axes) -> Self {
        let mut j = Matrix3::zeros();
        for (axis, moment) in axes.iter().zip(frame.moments) {
            j += axis * (axis * moment).transpose();
        }
        Self {
            j,
            h: Matrix3::zeros(),
            m: Matrix3::from_diagonal_element(frame.mass),
        }
    }

    /// About a point that is so far from the one before.
    #[inline(always)]
    fn moved(&self, way: &Vector3<f64>) -> Self {
        let h = self.h - crossed(way, &self.m);
        let one = crossed(way, &self.h.transpose());
        let two = crossed(way, &h.transpose());
        Self {
            j: self.j - one.transpose() - two,
            h,
            m: self.m,
        }
    }

    #[inline(always)]
    fn times(&self, twist: &Twist) -> Twist {
        Twist {
            turn: self.j * twist.turn + self.h * twist.shift,
            shift: self.h.tr_mul(&twist.turn) + self.m * twist.shift,
        }
    }

    /// Without what a free way takes, `U U^T / D`.
    #[inline(always)]
    fn release(&mut self, push: &Twist, inverse: f64) {
        let turn = (push.turn * inverse).transpose();
        let shift = (push.shift * inverse).transpose();
        self.j -= push.turn * turn;
        self.h -= push.turn * shift;
        self.m -= push.shift * shift;
    }

    fn add(&mut self, other: &Self) {
        self.j += other.j;
        self.h += other.h;
        self.m += other.m;
    }
}

/// Direction of motion that a joint leaves free.
#[derive(Clone, Copy, Debug, Default)]
struct Free {
    /// The way `s`, and `U = I s`.
    way: Twist,
    push: Twist,
    /// `1 / D`.
    inverse: f64,
    /// How much of it forces ask for, of the solution under way.
    amount: f64,
}

/// A body in the elimination.
#[derive(Clone, Debug, Default)]
struct TreeBody {
    axes: Axes,
    /// From the centre of mass to the point that is held, of the body and of its parent, m.
    arms: [Vector3<f64>; 2],
    /// About the point that is held, with what hangs on the body.
    inertia: SpatialInertia,
    /// Forces of the solution under way. `asked` holds the demand of the joint, `acceleration` that of the centre of
    /// mass.
    force: Twist,
    asked: Twist,
    acceleration: Twist,
}

/// The bodies of a tree, and the factors of its elimination.
#[derive(Clone, Debug, Default)]
pub struct Articulated {
    links: Vec<Link>,
    parts: Vec<TreeBody>,
    free: Vec<Free>,
    /// Free ways of every link.
    ways: Vec<Range<usize>>,
    /// For every rotation that is held, about what it is, and the rotation that changes it alone.
    normals: Vec<Vector3<f64>>,
    duals: Vec<Vector3<f64>>,
}

impl Articulated {
    /// For these links; parents stand before what hangs on them.
    pub fn new(links: Vec<Link>) -> Self {
        let (mut ways, mut turns, mut count) = (Vec::new(), 0, 0);
        for link in &links {
            let free = match link.arms {
                Some(_) => 3 - link.turns.len(),
                None => 6,
            };
            ways.push(count..count + free);
            (count, turns) = (count + free, turns + link.turns.len());
        }
        Self {
            parts: vec![TreeBody::default(); links.len()],
            free: vec![Free::default(); count],
            ways,
            normals: vec![Vector3::zeros(); turns],
            duals: vec![Vector3::zeros(); turns],
            links,
        }
    }

    /// The links.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// Factors at nodal coordinates. `normal` tells the moment on the body of a link that a unit multiplier of a rotation takes.
    /// False where rotations that a joint holds depend on each other.
    pub fn factor<const D: usize>(
        &mut self,
        frames: &[RigidBodyFrame],
        x: &[Node<D>],
        mut normal: impl FnMut(usize, &Link) -> Vector3<f64>,
    ) -> bool {
        for (part, link) in self.parts.iter_mut().zip(&self.links) {
            part.axes = frames[link.frame].axes(x);
            part.inertia = SpatialInertia::of(&frames[link.frame], &part.axes);
        }
        for index in (0..self.links.len()).rev() {
            let link = &self.links[index];
            for turn in link.turns.clone() {
                self.normals[turn] = normal(turn, link);
            }
            if !self.find_ways(index) {
                return false;
            }
            self.eliminate(index);
        }
        true
    }

    /// Finds the directions that a joint leaves free, from those that it holds.
    fn find_ways(&mut self, index: usize) -> bool {
        let (link, free) = (&self.links[index], &mut self.free[self.ways[index].clone()]);
        let duals = &mut self.duals[link.turns.clone()];
        if link.arms.is_none() {
            for (k, free) in free.iter_mut().enumerate() {
                let unit = Vector3::ith(k % 3, 1.0);
                free.way = Twist::default();
                if k < 3 {
                    free.way.turn = unit
                } else {
                    free.way.shift = unit
                }
            }
            return true;
        }
        match (&self.normals[link.turns.clone()], free) {
            ([], free) => {
                for (k, free) in free.iter_mut().enumerate() {
                    free.way.turn = Vector3::ith(k, 1.0);
                }
            }
            ([n], [a, b]) => {
                let first = n.cross(&Vector3::ith(n.iamin(), 1.0)).normalize();
                (a.way.turn, b.way.turn) = (first, n.cross(&first).normalize());
                duals[0] = n / n.norm_squared();
                return n.norm_squared() > 0.0;
            }
            ([n, m], [a]) => {
                let axis = n.cross(m);
                let square = axis.norm_squared();
                a.way.turn = axis / square.sqrt();
                duals[0] = m.cross(&axis) / square;
                duals[1] = axis.cross(n) / square;
                return square > SPAN * SPAN * n.norm_squared() * m.norm_squared();
            }
            ([n, m, o], _) => {
                let [p, q, r] = [m.cross(o), o.cross(n), n.cross(m)];
                let volume = n.dot(&p);
                (duals[0], duals[1], duals[2]) = (p / volume, q / volume, r / volume);
                let square = n.norm_squared() * m.norm_squared() * o.norm_squared();
                return volume * volume > SPAN * SPAN * square;
            }
            _ => return false,
        }
        true
    }

    /// Eliminates a body and its joint, all that hangs on it being eliminated.
    fn eliminate(&mut self, index: usize) {
        let (before, rest) = self.parts.split_at_mut(index);
        let (part, link) = (&mut rest[0], &self.links[index]);
        let free = &mut self.free[self.ways[index].clone()];
        let Some([own, on_parent]) = link.arms else {
            let mut inertia = part.inertia;
            for free in free {
                free.push = inertia.times(&free.way);
                free.inverse = 1.0 / free.way.dot(&free.push);
                inertia.release(&free.push, free.inverse);
            }
            return;
        };
        part.arms[0] = combined(&part.axes, &own.into());
        part.inertia = part.inertia.moved(&part.arms[0]);
        let mut inertia = part.inertia;
        for free in free {
            let turn = &free.way.turn;
            free.push = Twist {
                turn: inertia.j * turn,
                shift: inertia.h.tr_mul(turn),
            };
            free.inverse = 1.0 / turn.dot(&free.push.turn);
            inertia.release(&free.push, free.inverse);
        }
        if let Some(parent) = link.parent {
            let parent = &mut before[parent];
            part.arms[1] = combined(&parent.axes, &on_parent.into());
            parent.inertia.add(&inertia.moved(&-part.arms[1]));
        }
    }

    /// Changes `q` by the least that makes `J q` what joints ask for: `turn` tells it of every rotation, `shift` of every link
    /// how much more the point of the body than that of the parent is to have.
    pub fn bring(
        &mut self,
        frames: &[RigidBodyFrame],
        turn: impl Fn(usize) -> f64,
        shift: impl Fn(usize) -> [f64; 3],
        q: &mut [f64],
    ) {
        self.take(frames, q);
        for index in (0..self.links.len()).rev() {
            let link = &self.links[index];
            let (before, rest) = self.parts.split_at_mut(index);
            let part = &mut rest[0];
            let mut force = part.force;
            if link.arms.is_some() {
                force.turn -= part.arms[0].cross(&force.shift);
                part.asked = Twist::default();
                for turned in link.turns.clone() {
                    part.asked.turn += self.duals[turned] * turn(turned);
                }
                part.asked.shift = shift(index).into();
                force.add(1.0, &part.inertia.times(&part.asked));
            }
            for free in &mut self.free[self.ways[index].clone()] {
                free.amount = -free.way.dot(&force) * free.inverse;
                force.add(free.amount, &free.push);
            }
            if let Some(parent) = link.parent {
                let parent = &mut before[parent].force;
                parent.turn += force.turn + part.arms[1].cross(&force.shift);
                parent.shift += force.shift;
            }
        }
        for index in 0..self.links.len() {
            self.release(index);
        }
        self.put(frames, q);
    }

    /// Forces that would keep bodies from what `q` says.
    fn take(&mut self, frames: &[RigidBodyFrame], q: &[f64]) {
        for (part, link) in self.parts.iter_mut().zip(&self.links) {
            let frame = &frames[link.frame];
            let (at, scale) = link.center;
            let moment = frame
                .places
                .map(|place| place.map_or(0.0, |(at, scale)| -scale * q[at]));
            part.force = Twist {
                turn: combined(&part.axes, &moment.into()),
                shift: Vector3::new(q[at], q[at + 1], q[at + 2]) * -scale,
            };
        }
    }

    /// The acceleration of a body from that of its parent.
    fn release(&mut self, index: usize) {
        let (before, rest) = self.parts.split_at_mut(index);
        let (part, link) = (&mut rest[0], &self.links[index]);
        let mut own = link.parent.map_or(Twist::default(), |parent| {
            let Twist { turn, shift } = before[parent].acceleration;
            let shift = shift + turn.cross(&part.arms[1]);
            Twist { turn, shift }
        });
        for free in self.free[self.ways[index].clone()].iter().rev() {
            let amount = free.amount - free.push.dot(&own) * free.inverse;
            own.add(amount, &free.way);
        }
        if link.arms.is_some() {
            own.add(1.0, &part.asked);
            own.shift -= own.turn.cross(&part.arms[0]);
        }
        part.acceleration = own;
    }

    /// Accelerations as `q` has them.
    fn put(&self, frames: &[RigidBodyFrame], q: &mut [f64]) {
        for (part, link) in self.parts.iter().zip(&self.links) {
            let Twist { turn, shift } = part.acceleration;
            let (at, scale) = link.center;
            for k in 0..3 {
                q[at + k] = shift[k] * scale;
                if let Some((at, scale)) = frames[link.frame].places[k] {
                    q[at] = part.axes[k].dot(&turn) * scale;
                }
            }
        }
    }
}
