//! Joints and motions: what they are made of, one file a primitive. What is linear in nodal coordinates becomes rows of
//! `Phi`; the rest becomes constraints with multipliers.

mod clamp;
mod coupler;
mod direction;
mod distance;
mod driven_orientation;
mod driven_rotation;
mod edge;
mod fold;
pub(in crate::system) mod friction;
mod homokinetic;
pub(in crate::system) mod latch;
mod line;
mod linear_constraint;
mod motion;
mod perpendicular;
mod point_on_curve;
mod release;
mod rows;
mod target;
mod unit;

pub use clamp::Clamp;
pub use coupler::Coupler;
pub use direction::AngleBetween;
pub use distance::Distance;
pub use driven_orientation::DrivenOrientation;
pub use driven_rotation::DrivenRotation;
pub use edge::Edge;
pub use fold::Fold;
pub use homokinetic::Homokinetic;
pub use latch::LatchConditions;
pub use line::PointOnLine;
pub use linear_constraint::LinearConstraint;
pub use perpendicular::{Across, Perpendicular};
pub use point_on_curve::PointOnCurve;
pub use release::Release;
use rows::Rows;
pub use target::Target;
pub use unit::UnitLength;

use super::coordinate::Translation;
use super::direction::AxisRotation;
use super::end::{Add, Attachment};
use super::gradient::Gradient;
use crate::bodies::{Bodies, ConnectivityRow, Marker, Node};
use crate::math::jet::Number;
use crate::math::space::Vector;

/// Primitive of joints and motions: a condition on the second end relative to the first.
#[derive(Clone, Debug)]
pub enum Primitive<const D: usize = 2> {
    /// Both ends are at one place.
    Coincident,
    /// The second end is on the line through the first one along this unit vector, given in the axes of the first end.
    Line(Vector<D>),
    /// The direction is at this angle from that of the first end (rad).
    Direction(f64),
    /// The direction of a cable is along this unit vector (first end: ground).
    Clamped(Vector<D>),
    /// A section of a rod or beam is held by rows alone, whatever else of its joint is said (first end: ground).
    Clamp(Clamp),
    /// The distance, m.
    Distance(f64),
    /// A right angle: in space.
    Perpendicular(Perpendicular<D>),
    /// Equal rotation of two shafts: in space.
    Homokinetic(Homokinetic<D>),
    /// The second end is on this chain.
    Curve(usize),
    /// The direction is at a driven angle from that of the first end.
    DrivenDirection(usize),
    /// The angle about an axis in space is driven.
    DrivenRotation(DrivenRotation<D>),
    /// The orientation in space is driven: a marker in the directions of the axes of the body's frame, and the driven
    /// coordinates of a quaternion, scalar first.
    DrivenOrientation([Marker; 3], [usize; 4]),
    /// Coordinates of joints in a linear relation, or one that is driven.
    Coupler(Coupler<D>),
    /// The position has driven coordinates (first end: ground).
    DrivenPosition([usize; D]),
    /// The position along this unit vector is at a driven distance from the first end (ground).
    DrivenDistance(Vector<D>, usize),
    /// A line of a plate or shell is held, whatever else of its joint is said.
    Edge(Edge<D>),
    /// The cable of the second end is paid out there by a driven length: no condition, but it follows that coordinate.
    PaidOut(usize),
}

/// A joint or a motion.
#[derive(Clone, Debug)]
pub struct JointEquations<const D: usize = 2> {
    /// Primitives of the joint.
    pub holds: Vec<Primitive<D>>,
    /// Ends of the joint.
    pub ends: [Attachment<D>; 2],
    /// Index of its spring among the loads.
    pub spring: Option<usize>,
    /// Rotation about the joint's axis in space, if it has an axis.
    pub turn: Option<AxisRotation<D>>,
    /// Displacement of the second end along a line of the first, if the first is fixed or on a rigid body.
    pub way: Option<Translation<D>>,
    /// Time or input of the release, if the joint can be released.
    pub release: Option<Release>,
}

/// A linear constraint of a joint.
#[derive(Clone, Debug)]
pub struct Linear<const D: usize = 2> {
    /// Index of the joint, if it belongs to one.
    pub joint: Option<usize>,
    /// The row of `Phi`.
    pub row: ConnectivityRow<D>,
    /// Right-hand side of the row.
    pub target: Target,
    /// Coefficients on position and direction of both ends.
    pub on_ends: [[Vector<D>; 2]; 2],
}

/// State of a system as constraints see it.
pub struct View<'a, const D: usize, N = f64> {
    /// Nodal coordinates.
    pub x: &'a [Node<D, N>],
    /// Rates of the nodal coordinates.
    pub v: &'a [Node<D, N>],
    /// Driven coordinates with two derivatives.
    pub drives: &'a [[N; 3]],
    /// Bodies.
    pub bodies: &'a Bodies<D>,
    /// Where on their chains slides are, m.
    pub travel: &'a [N],
    /// Angles that the system counts, rad: what angles are nearest to.
    pub angles: &'a [N],
    /// Release state of every joint that can be released.
    pub released: &'a [bool],
}

/// A non-linear constraint `g(x, t) = 0` with the force `-J^T lambda`.
#[derive(Clone, Debug)]
pub struct Constraint<const D: usize = 2> {
    /// Index of the joint, if it belongs to one.
    pub joint: Option<usize>,
    /// Kind of constraint with its parameters.
    pub kind: ConstraintKind<D>,
    /// Right-hand side of `g`: 0, except while the gaps of joints are closed step by step at the start.
    pub offset: f64,
    /// Index of the joint among those that can be released.
    pub release: Option<usize>,
}

/// A scalar equation of a joint or a motion, `g(x, t) = 0`.
///
/// A new kind is one file with its `Equation` and one line among the [`ConstraintKind`]s. Beside these items it has a `gradient` where it
/// joins two ends, or `gradients` where it joins more.
pub trait Equation<const D: usize> {
    /// `g`.
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N;

    /// Returns the derivative of `g` by time alone, 1/s.
    fn rate<N: Number>(&self, _view: &View<'_, D, N>) -> N {
        N::of(0.0)
    }

    /// Returns `d^2 g / dt^2` without the part of accelerations, 1/s^2.
    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N;

    /// Adds the second derivatives times the multiplier, block by block of nodes.
    fn stiffness(&self, _lambda: f64, _view: &View<'_, D>, _add: Add<'_, D>) {}

    /// Whether `stiffness` adds something. What is small beside inertia may stay out.
    fn is_stiff(&self) -> bool {
        false
    }

    /// Returns the size of `g` to measure its residual by: 1 for directions, m for lengths.
    fn size(&self, _bodies: &Bodies<D>) -> f64 {
        1.0
    }

    /// Whether `g` is of directions alone.
    fn is_angle(&self) -> bool {
        false
    }

    /// Returns the ends that are joined.
    fn ends(&self) -> Vec<Attachment<D>>;

    /// Returns the nodes that are tied together.
    fn nodes(&self, _bodies: &Bodies<D>) -> Vec<usize> {
        self.ends().iter().flat_map(Attachment::nodes).collect()
    }
}

/// Declares the kinds of constraint: those that join two ends, then those that join more.
macro_rules! constraints {
    (
        two: {$($(#[$doc:meta])* $kind:ident($of:ty),)*}
        many: {$($(#[$more_doc:meta])* $more:ident($all:ty),)*}
    ) => {
        /// Kinds of non-linear constraints.
        #[derive(Clone, Debug)]
        pub enum ConstraintKind<const D: usize = 2> {
            $($(#[$doc])* $kind($of),)*
            $($(#[$more_doc])* $more($all),)*
        }

        impl<const D: usize> ConstraintKind<D> {
            /// Calls with the forces that a unit multiplier takes from position and direction of two ends, or of two pairs of ends.
            #[inline(always)]
            fn for_each_pair<N: Number>(
                &self,
                view: &View<'_, D, N>,
                mut call: impl FnMut(&Gradient<D, N>),
            ) {
                // Called in one place for what joins two ends, so that it can be compiled into its caller.
                let many: &mut dyn FnMut(&Gradient<D, N>) = &mut call;
                let gradient = match self {
                    $(Self::$kind(of) => of.gradient(view),)*
                    $(Self::$more(of) => return of.gradients(view).for_each(|pair| many(&pair)),)*
                };
                call(&gradient);
            }
        }

        impl<const D: usize> Equation<D> for ConstraintKind<D> {
            fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
                match self {
                    $(Self::$kind(of) => of.value(view),)*
                    $(Self::$more(of) => of.value(view),)*
                }
            }

            fn rate<N: Number>(&self, view: &View<'_, D, N>) -> N {
                match self {
                    $(Self::$kind(of) => of.rate(view),)*
                    $(Self::$more(of) => of.rate(view),)*
                }
            }

            fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
                match self {
                    $(Self::$kind(of) => of.bias(view),)*
                    $(Self::$more(of) => of.bias(view),)*
                }
            }

            fn stiffness(&self, lambda: f64, view: &View<'_, D>, add: Add<'_, D>) {
                match self {
                    $(Self::$kind(of) => of.stiffness(lambda, view, add),)*
                    $(Self::$more(of) => of.stiffness(lambda, view, add),)*
                }
            }

            fn is_stiff(&self) -> bool {
                match self {
                    $(Self::$kind(of) => <$of as Equation<D>>::is_stiff(of),)*
                    $(Self::$more(of) => <$all as Equation<D>>::is_stiff(of),)*
                }
            }

            fn size(&self, bodies: &Bodies<D>) -> f64 {
                match self {
                    $(Self::$kind(of) => of.size(bodies),)*
                    $(Self::$more(of) => of.size(bodies),)*
                }
            }

            fn is_angle(&self) -> bool {
                match self {
                    $(Self::$kind(of) => <$of as Equation<D>>::is_angle(of),)*
                    $(Self::$more(of) => <$all as Equation<D>>::is_angle(of),)*
                }
            }

            fn ends(&self) -> Vec<Attachment<D>> {
                match self {
                    $(Self::$kind(of) => of.ends(),)*
                    $(Self::$more(of) => of.ends(),)*
                }
            }

            fn nodes(&self, bodies: &Bodies<D>) -> Vec<usize> {
                match self {
                    $(Self::$kind(of) => of.nodes(bodies),)*
                    $(Self::$more(of) => of.nodes(bodies),)*
                }
            }
        }
    };
}

constraints! {
    two: {
        /// A rigid body's direction keeps its length.
        UnitLength(UnitLength),
        /// A direction at an angle from another one.
        AngleBetween(AngleBetween<D>),
        /// A distance.
        Distance(Distance<D>),
        /// A point on a line of a body.
        PointOnLine(PointOnLine<D>),
        /// A point on a chain.
        PointOnCurve(PointOnCurve<D>),
        /// A row that is linear in what joints see.
        LinearConstraint(LinearConstraint<D>),
        /// A right angle.
        Perpendicular(Perpendicular<D>),
        /// A driven rotation.
        DrivenRotation(DrivenRotation<D>),
    }
    many: {
        /// One condition of a driven orientation.
        DrivenOrientation(DrivenOrientation),
        /// A relation between coordinates of joints.
        Coupler(Coupler<D>),
        /// Equal rotation of two shafts.
        Homokinetic(Homokinetic<D>),
        /// The angle between two surfaces.
        Fold(Fold),
    }
}

impl<const D: usize> Constraint<D> {
    /// Builds a constraint of the joint with this index.
    pub(super) fn of(joint: usize, kind: ConstraintKind<D>) -> Self {
        Self {
            joint: Some(joint),
            kind,
            offset: 0.0,
            release: None,
        }
    }

    /// `g`.
    pub fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        if self.is_released(view.released) {
            return N::of(0.0);
        }
        self.kind.value(view) - N::of(self.offset)
    }

    /// Calls with the forces that a unit multiplier takes from position and direction of two ends, or of two pairs of ends.
    pub fn for_each_pair<N: Number>(
        &self,
        view: &View<'_, D, N>,
        call: impl FnMut(&Gradient<D, N>),
    ) {
        if !self.is_released(view.released) {
            self.kind.for_each_pair(view, call);
        }
    }

    /// Passes the gradient to `term` as terms over the nodes.
    pub fn for_each<N: Number>(
        &self,
        view: &View<'_, D, N>,
        mut term: impl FnMut(usize, &Node<D, N>),
    ) {
        self.for_each_pair(view, |pair| pair.for_each(&mut term));
    }

    /// Passes the gradient to `term` as terms over the nodes that have coordinates. Of rigid bodies in space that is
    /// the first node.
    pub fn for_each_pulled<N: Number>(
        &self,
        view: &View<'_, D, N>,
        mut term: impl FnMut(usize, &Node<D, N>),
    ) {
        self.for_each_pair(view, |pair| {
            pair.for_each_pulled(view.bodies, view.x, &mut term)
        });
    }

    /// The derivative of `g` along a nodal vector.
    pub fn along<N: Number>(&self, view: &View<'_, D, N>, rates: &[Node<D, N>]) -> N {
        let mut sum = N::of(0.0);
        self.for_each_pair(view, |pair| sum += pair.along(rates));
        sum
    }

    /// Returns the derivative of `g` by time alone, 1/s.
    pub fn rate<N: Number>(&self, view: &View<'_, D, N>) -> N {
        if self.is_released(view.released) {
            N::of(0.0)
        } else {
            self.kind.rate(view)
        }
    }

    /// Returns `d^2 g / dt^2` without the part of accelerations, 1/s^2.
    pub fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        if self.is_released(view.released) {
            N::of(0.0)
        } else {
            self.kind.bias(view)
        }
    }

    /// Adds the second derivatives times the multiplier, block by block of nodes.
    pub fn stiffness(&self, lambda: f64, view: &View<'_, D>, add: Add<'_, D>) {
        if !self.is_released(view.released) {
            self.kind.stiffness(lambda, view, add);
        }
    }

    /// Whether its derivatives are the same in every configuration.
    pub fn is_linear(&self) -> bool {
        let is_constant =
            matches!(&self.kind, ConstraintKind::LinearConstraint(row) if row.is_constant);
        is_constant && self.release.is_none()
    }

    /// Whether it is the first one of a slide along a chain.
    pub fn is_slide(&self) -> bool {
        matches!(&self.kind, ConstraintKind::PointOnCurve(along) if along.normal == 0)
    }

    /// Whether it ties to the ground.
    pub fn is_grounded(&self) -> bool {
        self.kind.ends().iter().any(|end| end.marker().is_none())
    }
}

impl<const D: usize> JointEquations<D> {
    /// Driven coordinates that it follows.
    pub fn drives(&self) -> impl Iterator<Item = usize> {
        self.holds
            .iter()
            .flat_map(|primitive| match primitive {
                Primitive::DrivenDirection(drive)
                | Primitive::DrivenDistance(_, drive)
                | Primitive::PaidOut(drive)
                | Primitive::DrivenRotation(DrivenRotation { drive, .. }) => {
                    std::slice::from_ref(drive)
                }
                Primitive::DrivenPosition(drives) => drives,
                Primitive::DrivenOrientation(_, drives) => drives,
                Primitive::Coupler(related) => related.drive.as_slice(),
                _ => &[],
            })
            .copied()
    }

    /// The distance that it holds, m.
    pub fn length(&self) -> Option<f64> {
        self.holds.iter().find_map(|primitive| match primitive {
            Primitive::Distance(length) => Some(*length),
            _ => None,
        })
    }

    /// The section that it holds by rows alone.
    pub fn clamp(&self) -> Option<&Clamp> {
        self.holds.iter().find_map(|primitive| match primitive {
            Primitive::Clamp(clamp) => Some(clamp),
            _ => None,
        })
    }

    /// The line of a plate or shell that it holds.
    pub fn edge(&self) -> Option<&Edge<D>> {
        self.holds.iter().find_map(|primitive| match primitive {
            Primitive::Edge(edge) => Some(edge),
            _ => None,
        })
    }

    /// Whether it may hold what others hold without a mistake of a person: edges of plates that meet at a corner both hold it.
    pub fn shares_corners(&self) -> bool {
        self.edge().is_some()
    }

    /// Whether it holds one position on the other and nothing else.
    pub fn is_pin(&self) -> bool {
        matches!(self.holds[..], [Primitive::Coincident])
    }

    /// Appends the linear and the non-linear constraints of the joint. `index` is the joint's own index, `nodes` are
    /// the nodal coordinates at the start.
    pub fn constraints(
        &self,
        (index, nodes): (usize, &[Node<D>]),
        linear: &mut Vec<Linear<D>>,
        nonlinear: &mut Vec<Constraint<D>>,
    ) {
        let mut rows = Rows {
            joint: index,
            ends: &self.ends,
            nodes,
            linear,
        };
        for primitive in &self.holds {
            let kind = match primitive {
                Primitive::Coincident => linear_constraint::coincide(&mut rows),
                Primitive::Line(along) => line::hold(&mut rows, *along),
                Primitive::Direction(angle) => direction::hold(&mut rows, *angle),
                Primitive::Clamped(along) => direction::clamp(&mut rows, along),
                Primitive::Clamp(clamp) => {
                    if let Attachment::Ground(point) = &self.ends[0] {
                        rows.linear.extend(clamp.rows(point, nodes));
                    }
                    None
                }
                Primitive::Distance(length) => distance::hold(&rows, *length),
                Primitive::Perpendicular(right) => {
                    Some(ConstraintKind::Perpendicular(right.clone()))
                }
                Primitive::Homokinetic(shafts) => Some(ConstraintKind::Homokinetic(shafts.clone())),
                Primitive::Curve(chain) => {
                    let slide = nonlinear.iter().filter(|c| c.is_slide()).count();
                    let held = point_on_curve::hold(&rows, *chain, slide);
                    nonlinear.extend(held.map(|kind| Constraint::of(index, kind)));
                    None
                }
                Primitive::DrivenDirection(drive) => motion::direction(&mut rows, *drive),
                Primitive::DrivenRotation(driven) => {
                    Some(ConstraintKind::DrivenRotation(driven.clone()))
                }
                Primitive::DrivenOrientation(axes, drives) => {
                    let about = |about| {
                        let (axes, drives) = (*axes, *drives);
                        let driven = DrivenOrientation {
                            axes,
                            drives,
                            about,
                        };
                        Constraint::of(index, ConstraintKind::DrivenOrientation(driven))
                    };
                    nonlinear.extend((0..3).map(about));
                    None
                }
                Primitive::Coupler(related) => Some(ConstraintKind::Coupler(related.clone())),
                Primitive::PaidOut(_) => None,
                Primitive::Edge(edge) => {
                    rows.linear.extend(edge.rows(index));
                    let kinds = edge.constraints.iter().cloned();
                    nonlinear.extend(kinds.map(|kind| Constraint::of(index, kind)));
                    None
                }
                Primitive::DrivenPosition(drives) => motion::position(&mut rows, *drives),
                Primitive::DrivenDistance(along, drive) => {
                    motion::distance(&mut rows, *along, *drive)
                }
            };
            nonlinear.extend(kind.map(|kind| Constraint::of(index, kind)));
        }
    }
}
