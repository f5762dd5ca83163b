//! Equations of a mechanism over the coordinates of its unconnected parts, by differences and dense
//! matrices: `[M C^T; C 0] [x''; lambda] = [F; r]`.

use flexbody::bodies::{Elimination, Tangent};
use flexbody::elements::{Element, Nodal};
use nalgebra::{DMatrix, DVector, Matrix2x4, Rotation2, Vector2};

use crate::laws::mechanism::{Acting, Body, Hold, Kind, Mechanism, Place, Point, left};

/// `T^T K T`, column by column.
pub fn reduced_stiffness<const D: usize>(
    tangent: &mut Tangent<D>,
    elimination: &Elimination<D>,
) -> Vec<Vec<f64>> {
    let n = elimination.coordinates();
    let column = |k: usize| {
        let mut q = vec![0.0; n];
        q[k] = 1.0;
        tangent.apply_stiffness(elimination, &mut q);
        q
    };
    (0..n).map(column).collect()
}

/// Positions and directions of both ends of a hold.
type Ends = [[Vector2<f64>; 2]; 2];

/// What is missing of a hold at a time.
fn gaps(kind: &Kind, t: f64, [[p, d], [q, e]]: Ends) -> Vec<f64> {
    let way = q - p;
    let turned = |angle: f64| (Rotation2::new(angle) * d).perp(&e);
    match kind {
        Kind::Revolute | Kind::Hinge(_) => vec![way.x, way.y],
        Kind::Weld(angle) => vec![way.x, way.y, turned(*angle)],
        Kind::Slider(along) => vec![along.perp(&way)],
        Kind::Orientation(angle) => vec![turned(*angle)],
        Kind::Prismatic(along, angle) => {
            let line = d * along.x + left(d) * along.y;
            vec![line.perp(&way), turned(*angle)]
        }
        Kind::Distance(length) => vec![way.norm_squared() - length * length],
        Kind::Along => vec![d.perp(&way) / d.norm()],
        Kind::DrivenAngle(wave) => vec![turned(wave.value(t))],
        Kind::DrivenPosition([a, b]) => vec![q.x - a.value(t), q.y - b.value(t)],
        Kind::DrivenWay(along, wave) => vec![along.dot(&way) - wave.value(t)],
    }
}

/// Derivative by central differences, extrapolated twice: exact to order 6.
fn slope(step: f64, f: impl Fn(f64) -> DVector<f64>) -> DVector<f64> {
    extrapolate(|h| (f(h) - f(-h)) * (0.5 / h), step)
}

/// Second derivative likewise.
fn bend(step: f64, f: impl Fn(f64) -> DVector<f64>) -> DVector<f64> {
    let middle = f(0.0);
    extrapolate(|h| (f(h) + f(-h) - &middle * 2.0) / (h * h), step)
}

fn extrapolate(f: impl Fn(f64) -> DVector<f64>, step: f64) -> DVector<f64> {
    let [a, b, c] = [step, 0.5 * step, 0.25 * step].map(f);
    let (coarse, fine) = ((&b * 4.0 - a) / 3.0, (c * 4.0 - b) / 3.0);
    (fine * 16.0 - coarse) / 15.0
}

/// `B P = Q R`: orthonormal columns, and the order in which those of `B` were taken.
pub struct Orthogonal {
    pub q: DMatrix<f64>,
    r: DMatrix<f64>,
    order: Vec<usize>,
}

/// The same columns of length 1.
fn scaled(mut b: DMatrix<f64>) -> DMatrix<f64> {
    b.column_iter_mut().for_each(|mut column| {
        column.normalize_mut();
    });
    b
}

/// By Gram and Schmidt, three times over, largest remainder first.
pub fn orthogonal(b: &DMatrix<f64>) -> Orthogonal {
    let mut rest = b.clone();
    let (mut order, mut q): (Vec<usize>, Vec<DVector<f64>>) = (Vec::new(), Vec::new());
    loop {
        let left = (0..b.ncols()).filter(|i| !order.contains(i));
        let next = left.max_by(|i, j| rest.column(*i).norm().total_cmp(&rest.column(*j).norm()));
        let Some(next) = next.filter(|i| rest.column(*i).norm() > 1e-8) else {
            break;
        };
        let mut unit = b.column(next).into_owned();
        for _ in 0..3 {
            q.iter().for_each(|q| unit -= q * q.dot(&unit));
            unit.normalize_mut();
        }
        for mut column in rest.column_iter_mut() {
            let part = unit.dot(&column);
            column -= &unit * part;
        }
        q.push(unit);
        order.push(next);
    }
    let others = (0..b.ncols()).filter(|i| !order.contains(i));
    let others: Vec<usize> = others.collect();
    order.extend(others);
    let q = if q.is_empty() {
        DMatrix::zeros(b.nrows(), 0)
    } else {
        DMatrix::from_columns(&q)
    };
    let r = q.transpose() * b.select_columns(&order);
    Orthogonal { q, r, order }
}

/// Solution of the augmented equations for an acceleration.
pub struct Augmented {
    /// Residual of the forces after inertia and the best multipliers are taken out, and residual of the constraints,
    /// relative to the size of the acceleration.
    pub lack: f64,
    pub gap: f64,
    /// Force and moment of every hold on its second end.
    pub reactions: Vec<(Vector2<f64>, f64)>,
    /// Whether constraints depend on each other.
    pub redundant: bool,
    /// Size of the smallest independent part of a constraint.
    pub weakest: f64,
}

impl Mechanism {
    fn ends(&self, hold: &Hold, x: &DVector<f64>) -> Ends {
        let [first, second] = hold.ends;
        let second = self.end(second, x);
        let first = match hold.kind {
            Kind::Along => Point::On(self.nearest(first, second[0], x)),
            _ => first,
        };
        [self.end(first, x), second]
    }

    /// Returns the gaps of all holds and of the connections inside bodies.
    pub fn missing(&self, t: f64, x: &DVector<f64>) -> DVector<f64> {
        let mut missing = Vec::new();
        for hold in &self.holds {
            missing.extend(gaps(&hold.kind, t, self.ends(hold, x)));
        }
        for (b, body) in self.bodies.iter().enumerate() {
            let first = self.offset(b);
            match body {
                Body::Cable(elements) => {
                    for j in 1..elements.len() {
                        let at = first + 8 * j;
                        missing.extend((0..4).map(|k| x[at + k] - x[at - 4 + k]));
                    }
                }
                Body::Rigid { .. } => {
                    missing.push(0.5 * (x[first + 2].powi(2) + x[first + 3].powi(2) - 1.0));
                }
                Body::Particle { .. } => {
                    let [_, direction] = self.nodes[self.firsts[b]];
                    missing.extend([0, 1].map(|k| x[first + 2 + k] - direction[k]));
                }
            }
        }
        DVector::from_vec(missing)
    }

    /// Rates of what is missing along a motion.
    pub fn missing_rates(&self, t: f64, x: &DVector<f64>, v: &DVector<f64>) -> DVector<f64> {
        slope(5e-3, |s| self.missing(t + s, &(x + v * s)))
    }

    /// Second derivatives of what is missing along a motion with an acceleration.
    pub fn missing_bends(
        &self,
        t: f64,
        x: &DVector<f64>,
        v: &DVector<f64>,
        a: &DVector<f64>,
    ) -> DVector<f64> {
        // Apart, since accelerations may be large beside velocities.
        bend(5e-3, |s| self.missing(t + s, &(x + v * s))) + self.jacobian(t, x) * a
    }

    /// Derivatives of what is missing by all coordinates.
    pub fn jacobian(&self, t: f64, x: &DVector<f64>) -> DMatrix<f64> {
        // Constraints are quadratic but for slides: long steps lose nothing.
        let step = if self.slides() { 0.01 } else { 0.5 };
        let columns: Vec<DVector<f64>> = (0..self.size())
            .map(|i| {
                slope(step, |s| {
                    let mut moved = x.clone();
                    moved[i] += s;
                    self.missing(t, &moved)
                })
            })
            .collect();
        DMatrix::from_columns(&columns)
    }

    /// Derivatives of position and direction of a place by all coordinates.
    fn rows(&self, place: Place) -> [DMatrix<f64>; 2] {
        let mut rows = [0, 1].map(|_| DMatrix::zeros(2, self.size()));
        for i in 0..self.size() {
            let unit = DVector::from_fn(self.size(), |k, _| f64::from(u8::from(k == i)));
            for (row, part) in rows.iter_mut().zip(self.point(place, &unit)) {
                row.set_column(i, &part);
            }
        }
        rows
    }

    /// Mass of all parts.
    pub fn mass(&self) -> DMatrix<f64> {
        let mut mass = DMatrix::zeros(self.size(), self.size());
        for (first, element) in self.elements() {
            let full = element.mass().kronecker(&nalgebra::Matrix2::identity());
            mass.view_mut((first, first), (8, 8)).copy_from(&full);
        }
        for (b, body) in self.bodies.iter().enumerate() {
            let [m, j] = match body {
                Body::Cable(_) => continue,
                Body::Rigid { mass, inertia } => [*mass, *inertia],
                // Its direction is held: any number will do.
                Body::Particle { mass } => [*mass, 1.0],
            };
            for (k, size) in [m, m, j, j].into_iter().enumerate() {
                mass[(self.offset(b) + k, self.offset(b) + k)] = size;
            }
        }
        for (place, sizes) in &self.lumped_masses {
            for (rows, size) in self.rows(*place).iter().zip(sizes) {
                mass += rows.transpose() * rows * *size;
            }
        }
        mass
    }

    fn add_force(&self, end: Point, force: Vector2<f64>, f: &mut DVector<f64>) {
        if let Point::On(place) = end {
            *f += self.rows(place)[0].transpose() * force;
        }
    }

    fn add_moment(&self, end: Point, moment: f64, x: &DVector<f64>, f: &mut DVector<f64>) {
        if let Point::On(place) = end {
            let d = self.point(place, x)[1];
            let turn = left(d) * (moment / d.norm_squared());
            *f += self.rows(place)[1].transpose() * turn;
        }
    }

    fn spin(&self, end: Point, x: &DVector<f64>, v: &DVector<f64>) -> f64 {
        let (d, rate) = (self.end(end, x)[1], self.end_rate(end, v)[1]);
        d.perp(&rate) / d.norm_squared()
    }

    /// All forces but those of holds.
    pub fn force(&self, t: f64, x: &DVector<f64>, v: &DVector<f64>) -> DVector<f64> {
        let mut f = DVector::zeros(self.size());
        for (first, element) in self.elements() {
            let part = |x: &DVector<f64>| Nodal::from_column_slice(&x.as_slice()[first..first + 8]);
            let own: Matrix2x4<f64> = element.force(&part(x), &part(v));
            let own = own + self.gravity * element.weight().transpose();
            f.rows_mut(first, 8).copy_from_slice(own.as_slice());
        }
        for (b, body) in self.bodies.iter().enumerate() {
            if let Body::Rigid { mass, .. } | Body::Particle { mass } = body {
                let weight = self.gravity * *mass;
                let mut at = f.rows_mut(self.offset(b), 2);
                at += weight;
            }
        }
        for (place, [mass, _]) in &self.lumped_masses {
            self.add_force(Point::On(*place), self.gravity * *mass, &mut f);
        }
        for load in &self.loads {
            self.add_load(load, t, (x, v), &mut f);
        }
        for hold in &self.holds {
            if let Kind::Hinge([stiffness, damping, rest]) = hold.kind {
                let [d, e] = hold.ends.map(|end| self.end(end, x)[1]);
                let turn = (Rotation2::new(rest) * d).angle_to(&e);
                let rate = self.spin(hold.ends[1], x, v) - self.spin(hold.ends[0], x, v);
                let moment = -stiffness * turn - damping * rate;
                self.add_moment(hold.ends[1], moment, x, &mut f);
                self.add_moment(hold.ends[0], -moment, x, &mut f);
            }
        }
        if self.rotation != 0.0 {
            let turned = DVector::from_fn(v.len(), |i, _| match i % 2 {
                0 => -v[i + 1],
                _ => v[i - 1],
            });
            let rate = self.rotation;
            f += self.mass() * (x * (rate * rate) - turned * (2.0 * rate));
        }
        f
    }

    fn add_load(
        &self,
        load: &Acting,
        t: f64,
        (x, v): (&DVector<f64>, &DVector<f64>),
        f: &mut DVector<f64>,
    ) {
        match load {
            Acting::Force { at, follower, size } => {
                let [a, b] = size.map(|wave| wave.value(t));
                let along = if *follower {
                    self.point(*at, x)[1].normalize()
                } else {
                    Vector2::x()
                };
                self.add_force(Point::On(*at), along * a + left(along) * b, f);
            }
            Acting::Moment { ends, size } => {
                self.add_moment(ends[1], size.value(t), x, f);
                self.add_moment(ends[0], -size.value(t), x, f);
            }
            Acting::DistributedForce { body, size } => {
                let load = Vector2::from(size.map(|wave| wave.value(t)));
                let count = self.bodies[*body].sizes()[1] / 8;
                let elements: Vec<_> = self.elements().collect();
                let first = self.offset(*body);
                for (at, element) in elements {
                    if (first..first + 8 * count).contains(&at) {
                        // The integral of the shape functions.
                        let l = element.length();
                        let shares = [l / 2.0, l * l / 12.0, l / 2.0, -l * l / 12.0];
                        for (k, share) in shares.into_iter().enumerate() {
                            f[at + 2 * k] += share * load.x;
                            f[at + 2 * k + 1] += share * load.y;
                        }
                    }
                }
            }
            Acting::Spring {
                ends,
                stiffness,
                damping,
                length,
            } => {
                let [p, q] = ends.map(|end| self.end(end, x)[0]);
                let [u, w] = ends.map(|end| self.end_rate(end, v)[0]);
                let (unit, now) = ((q - p).normalize(), (q - p).norm());
                let pull = stiffness * (now - length.value(t)) + damping * unit.dot(&(w - u));
                self.add_force(ends[0], unit * pull, f);
                self.add_force(ends[1], unit * -pull, f);
            }
        }
    }

    /// Part of a nodal displacement that constraints do not ask for, relative to it, in the mass norm.
    pub fn needless(&self, t: f64, x: &DVector<f64>, change: &DVector<f64>) -> f64 {
        let root = self.mass().cholesky().expect("a positive mass").l();
        let whole = root.transpose() * change;
        let b = root.solve_lower_triangular(&self.jacobian(t, x).transpose());
        let q = orthogonal(&scaled(b.expect("a mass"))).q;
        (&whole - &q * (q.transpose() * &whole)).norm() / whole.norm()
    }

    /// How far motions contradict joints: what no rates give constraints.
    pub fn contradiction(&self, t: f64, x: &DVector<f64>) -> f64 {
        let c = self.jacobian(t, x);
        if c.nrows() == 0 {
            return 0.0;
        }
        let r = self.missing_rates(t, x, &DVector::zeros(x.len()));
        let q = orthogonal(&scaled(c.transpose()));
        let sizes: Vec<f64> = c.row_iter().map(|row| row.norm()).collect();
        let sorted = DVector::from_fn(r.len(), |i, _| r[q.order[i]] / sizes[q.order[i]]);
        let rank = q.q.ncols();
        let first = q.r.columns(0, rank).into_owned();
        let step = first.tr_solve_upper_triangular(&sorted.rows(0, rank));
        (q.r.transpose() * step.expect("independent columns") - sorted).amax()
    }

    /// Puts an acceleration into the augmented equations at a state.
    pub fn augmented(
        &self,
        t: f64,
        (x, v): (&DVector<f64>, &DVector<f64>),
        a: &DVector<f64>,
    ) -> Augmented {
        let (mass, force) = (self.mass(), self.force(t, x, v));
        let mut c = self.jacobian(t, x);
        let mut r = -self.missing_bends(t, x, v, &DVector::zeros(v.len()));
        let root = mass.clone().cholesky().expect("a positive mass").l();
        let lower = |b: &DMatrix<f64>| root.solve_lower_triangular(b).expect("a mass");
        let mut sizes = Vec::new();
        for i in 0..c.nrows() {
            let size = lower(&c.rows(i, 1).transpose()).norm();
            sizes.push(size);
            c.row_mut(i).scale_mut(1.0 / size);
            r[i] /= size;
        }
        // Everything in the mass norm: unknowns are root^T a.
        let whole = root.transpose() * a;
        let missing = root.solve_lower_triangular(&force).expect("a mass") - &whole;
        let b = lower(&c.transpose());
        let Orthogonal { q, r: upper, order } = orthogonal(&b);
        let rank = q.ncols();
        let first = upper.columns(0, rank).into_owned();
        let parts = first.solve_upper_triangular(&(q.transpose() * &missing));
        let parts = parts.expect("independent columns");
        let mut lambda = DVector::zeros(c.nrows());
        (0..rank).for_each(|i| lambda[order[i]] = parts[i]);
        let size = 1.0 + whole.norm();
        let mut next = 0;
        let reactions = self.holds.iter().map(|hold| {
            let ends = self.ends(hold, x);
            let count = gaps(&hold.kind, t, ends).len();
            let own = DVector::from_fn(count, |i, _| lambda[next + i] / sizes[next + i]);
            next += count;
            self.reaction(hold, t, (ends, &own), x, v)
        });
        Augmented {
            reactions: reactions.collect(),
            lack: (missing - &b * &lambda).norm() / size,
            gap: (b.transpose() * whole - &r).norm() / size,
            redundant: rank < c.nrows(),
            weakest: first.diagonal().amin(),
        }
    }

    /// Force and moment on the second end from the multipliers of a hold, with a hinge's own moment.
    fn reaction(
        &self,
        hold: &Hold,
        t: f64,
        (ends, lambda): (Ends, &DVector<f64>),
        x: &DVector<f64>,
        v: &DVector<f64>,
    ) -> (Vector2<f64>, f64) {
        let at = |way: Vector2<f64>, turn: f64| {
            let [first, [q, e]] = ends;
            let moved = [q + way, Rotation2::new(turn) * e];
            DVector::from_vec(gaps(&hold.kind, t, [first, moved]))
        };
        let force = [Vector2::x(), Vector2::y()]
            .map(|axis| -lambda.dot(&slope(0.01, |s| at(axis * s, 0.0))));
        let mut moment = -lambda.dot(&slope(0.01, |s| at(Vector2::zeros(), s)));
        if let Kind::Hinge([stiffness, damping, rest]) = hold.kind {
            let [d, e] = [ends[0][1], ends[1][1]];
            let rate = self.spin(hold.ends[1], x, v) - self.spin(hold.ends[0], x, v);
            moment -= stiffness * (Rotation2::new(rest) * d).angle_to(&e) + damping * rate;
        }
        (Vector2::from(force), moment)
    }
}

/// Signed angle between two vectors.
trait AngleTo {
    fn angle_to(&self, other: &Self) -> f64;
}

impl AngleTo for Vector2<f64> {
    fn angle_to(&self, other: &Self) -> f64 {
        self.perp(other).atan2(self.dot(other))
    }
}
