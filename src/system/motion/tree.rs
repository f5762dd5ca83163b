//! Mechanisms of rigid bodies in space without loops whose joints hold points and rotations: revolute and ball joints, hinges,
//! universal and constant-velocity joints, welds, driven rotations. Their constraints are satisfied by an elimination from the leaves to the roots
//! ([`Articulated`]) instead of one of the multipliers; both solve the same equations.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use crate::bodies::{Articulated, Link, RigidBodyFrame, no_node};
use crate::math::space::{Vector, components, moment};
use crate::system::end::Attachment;
use crate::system::joints::{
    Constraint, ConstraintKind, Equation as _, LinearConstraint, Target, View,
};
use crate::system::workspace::Constraints;
use crate::system::{System, Workspace};

/// The point that a joint holds.
#[derive(Clone, Debug)]
struct Pin<const D: usize> {
    /// Rows of the point, one for each axis. `is_second` tells whether the link is that of the second end.
    rows: [usize; 3],
    ends: [Attachment<D>; 2],
    is_second: bool,
}

/// How constraints make a tree.
#[derive(Clone, Debug)]
pub(in crate::system) struct Tree<const D: usize> {
    links: Vec<Link>,
    /// For every link that a joint holds.
    pins: Vec<Option<Pin<D>>>,
    /// Rows of the rotations that are held.
    turns: Vec<usize>,
}

/// Constraints between two bodies, or between one and the ground.
struct Pair<const D: usize> {
    bodies: [Option<usize>; 2],
    pins: Vec<usize>,
    turns: Vec<usize>,
    ends: Option<[Attachment<D>; 2]>,
}

impl<const D: usize> Tree<D> {
    /// The tree that these constraints make of all that moves; nothing where they make none.
    pub fn of(system: &System<D>) -> Option<Self> {
        let frames = system.bodies.rigid();
        let is_whole = system.coordinates() == 6 * frames.len() && system.driven.is_empty();
        let turns = |frame: &RigidBodyFrame| frame.places.iter().all(Option::is_some);
        if frames.is_empty() || !is_whole || !frames.iter().all(turns) {
            return None;
        }
        let mut pairs = Pairs::of(system)?;
        let mut y = vec![0.0; system.elimination.scratch()];
        let mut tree = Self {
            links: Vec::new(),
            pins: Vec::new(),
            turns: Vec::new(),
        };
        let mut link_of = vec![None; frames.len()];
        tree.grow(system, None, &mut pairs, (&mut link_of, &mut y))?;
        for frame in 0..frames.len() {
            if link_of[frame].is_none() {
                link_of[frame] = Some(tree.links.len());
                tree.links.push(Link {
                    frame,
                    parent: None,
                    arms: None,
                    turns: tree.turns.len()..tree.turns.len(),
                    center: center(system, frame, &mut y)?,
                });
                tree.pins.push(None);
                tree.grow(system, Some(frame), &mut pairs, (&mut link_of, &mut y))?;
            }
        }
        // What is left closes loops.
        pairs.list.iter().all(Option::is_none).then_some(tree)
    }

    /// Adds all that hangs on a body or on the ground.
    fn grow(
        &mut self,
        system: &System<D>,
        from: Option<usize>,
        pairs: &mut Pairs<D>,
        (link_of, y): (&mut [Option<usize>], &mut [f64]),
    ) -> Option<()> {
        let mut open = vec![from];
        while let Some(from) = open.pop() {
            for index in pairs.of_body.remove(&from).unwrap_or_default() {
                let Some(pair) = pairs.list[index].take() else {
                    continue;
                };
                let is_second = pair.bodies[0] == from;
                let frame = pair.bodies[usize::from(is_second)]?;
                if link_of[frame].is_some() {
                    return None;
                }
                link_of[frame] = Some(self.links.len());
                let ends = pair.ends?;
                let [first, second] = ends.map(|end| arm(&end));
                let first_turn = self.turns.len();
                self.turns.extend(pair.turns);
                self.links.push(Link {
                    frame,
                    parent: from.and_then(|from| link_of[from]),
                    arms: Some(if is_second {
                        [second, first]
                    } else {
                        [first, second]
                    }),
                    turns: first_turn..self.turns.len(),
                    center: center(system, frame, y)?,
                });
                self.pins.push(Some(Pin {
                    rows: pair.pins.try_into().ok()?,
                    ends,
                    is_second,
                }));
                open.push(Some(frame));
            }
        }
        Some(())
    }

    /// Scratch for it.
    pub fn scratch(&self) -> Articulated {
        Articulated::new(self.links.clone())
    }
}

/// Where the centre of mass of a body is among the coordinates, and how many of these make a metre.
fn center<const D: usize>(system: &System<D>, frame: usize, y: &mut [f64]) -> Option<(usize, f64)> {
    let frame = &system.bodies.rigid()[frame];
    let mut force = no_node();
    for axis in 0..D {
        force[0][axis] = frame.mass * (1.0 + axis as f64);
    }
    let moved = system.elimination.reduce_node(frame.node, &force, y);
    let (at, scale) = *moved.first()?;
    let is_axis = |(i, q): &(usize, f64)| match i - at {
        axis @ 0..3 => (q - scale * (1.0 + axis as f64)).abs() <= 1e-14 * q.abs(),
        _ => false,
    };
    // Every axis moves with one coordinate, one after the other.
    (moved.len() == D && moved.iter().all(is_axis)).then_some((at, scale))
}

/// Components of a point along the axes of its body, m.
fn arm<const D: usize>(end: &Attachment<D>) -> [f64; 3] {
    end.marker()
        .map_or([0.0; 3], |marker| marker.components()[0].into())
}

/// All constraints, by what they join.
struct Pairs<const D: usize> {
    /// Each until it is in the tree.
    list: Vec<Option<Pair<D>>>,
    /// For every body and the ground, which of them join it.
    of_body: BTreeMap<Option<usize>, Vec<usize>>,
}

impl<const D: usize> Pairs<D> {
    /// Nothing where a constraint is of a kind that no tree has.
    fn of(system: &System<D>) -> Option<Self> {
        let mut of_body: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        let list = pairs(system)?;
        for (index, pair) in list.iter().enumerate() {
            for body in pair.bodies {
                of_body.entry(body).or_default().push(index);
            }
        }
        let list = list.into_iter().map(Some).collect();
        Some(Self { list, of_body })
    }
}

fn pairs<const D: usize>(system: &System<D>) -> Option<Vec<Pair<D>>> {
    let mut pairs: Vec<Pair<D>> = Vec::new();
    let mut known = BTreeMap::new();
    for (row, constraint) in system.constraints.iter().enumerate() {
        let ends = constraint.kind.ends();
        let bodies = [body(system, ends.first()?)?, body(system, ends.get(1)?)?];
        if bodies[0] == bodies[1] || constraint.release.is_some() {
            return None;
        }
        let both = [bodies[0].min(bodies[1]), bodies[0].max(bodies[1])];
        let index = *known.entry(both).or_insert(pairs.len());
        if index == pairs.len() {
            pairs.push(Pair {
                bodies,
                pins: Vec::new(),
                turns: Vec::new(),
                ends: None,
            });
        }
        let pair = &mut pairs[index];
        match &constraint.kind {
            ConstraintKind::LinearConstraint(held) => {
                let goes_on = pair.ends.is_none_or(|ends| ends == held.ends);
                if !goes_on || !holds_point(held, pair.pins.len()) || pair.pins.len() == 3 {
                    return None;
                }
                pair.bodies = bodies;
                pair.ends = Some(held.ends);
                pair.pins.push(row);
            }
            ConstraintKind::Perpendicular(right) if right.is_angle() => pair.turns.push(row),
            ConstraintKind::DrivenRotation(_) | ConstraintKind::Homokinetic(_) => {
                pair.turns.push(row)
            }
            _ => return None,
        }
    }
    let is_joint = |pair: &Pair<D>| pair.pins.len() == 3 && pair.turns.len() <= 3;
    pairs.iter().all(is_joint).then_some(pairs)
}

/// The rigid body that an end is on; of the ground there is none. Nothing where it is something else.
fn body<const D: usize>(system: &System<D>, end: &Attachment<D>) -> Option<Option<usize>> {
    let Some(marker) = end.marker() else {
        return Some(None);
    };
    if !marker.is_framed() {
        return None;
    }
    system.bodies.rigid_at(marker.nodes[0]).map(Some)
}

/// Whether a row holds a point of the second end at that of the first, along this axis.
fn holds_point<const D: usize>(held: &LinearConstraint<D>, axis: usize) -> bool {
    let start = match held.ends[0] {
        Attachment::Ground(point) => point.get(axis).copied(),
        Attachment::Body(_) => Some(0.0),
    };
    let unit = |sign: f64| Vector::<D>::from_fn(|i, _| if i == axis { sign } else { 0.0 });
    let is_fixed = start.is_some_and(|start| held.target == Target::Fixed(start));
    is_fixed
        && held.ends[1].marker().is_some()
        && held.on_ends == [[unit(-1.0), Vector::zeros()], [unit(1.0), Vector::zeros()]]
}

impl<const D: usize> System<D> {
    /// Whether accelerations are found by the elimination of an open tree.
    pub fn is_open_tree(&self) -> bool {
        self.tree.is_some()
    }

    /// The tree that constraints make: none in the plane, which is known when compiling.
    #[inline(always)]
    fn tree(&self) -> Option<&Tree<D>> {
        match D {
            2 => None,
            _ => self.tree.as_ref(),
        }
    }

    /// Factors the tree at the nodal coordinates in `work`, unless it is that already. False where there is no tree, or where
    /// rotations that a joint holds depend on each other: then multipliers are to be used.
    pub(in crate::system) fn factor_tree(&self, work: &mut Workspace<D>) -> bool {
        let Some(tree) = self.tree() else {
            return false;
        };
        let Workspace {
            kinematics,
            constraints,
            ..
        } = work;
        if !constraints.outdates_tree(kinematics) {
            return constraints.is_tree;
        }
        let view = self.view(kinematics);
        let frames = self.bodies.rigid();
        let of_turn = |turn: usize, link: &Link| {
            let node = frames[link.frame].node;
            let mut of_body = Vector3::zeros();
            self.constraints[tree.turns[turn]].for_each_pair(&view, |pair| {
                for (end, [_, direction]) in &pair.ends {
                    if let Some(marker) = end.marker().filter(|marker| marker.nodes[0] == node) {
                        let own: Vector<D> = marker.direction(view.x);
                        of_body += Vector3::from(moment(&own, direction));
                    }
                }
            });
            of_body
        };
        constraints.is_tree = (constraints.articulated).factor(frames, &kinematics.x, of_turn);
        constraints.is_tree
    }

    /// Changes `q` by the least that makes its products with the rows of the Jacobian what `constraints.right` says, with the factors
    /// of the tree.
    pub(in crate::system) fn bring_tree(&self, constraints: &mut Constraints<D>, q: &mut [f64]) {
        let Some(tree) = self.tree() else {
            return;
        };
        let right = &constraints.right;
        constraints.articulated.bring(
            self.bodies.rigid(),
            |turn| right[tree.turns[turn]],
            |link| match &tree.pins[link] {
                Some(pin) => {
                    let sign = if pin.is_second { 1.0 } else { -1.0 };
                    pin.rows.map(|row| sign * right[row])
                }
                None => [0.0; 3],
            },
            q,
        );
    }

    /// Computes the right-hand side of every constraint into `right`. It is minus `of_other` for constraints in
    /// general. For the points that a joint of the tree holds together it is the difference of `of_point` between the
    /// two ends, plus the gap that is still open.
    #[inline(always)]
    pub(in crate::system) fn fill_right(
        &self,
        view: &View<'_, D>,
        right: &mut [f64],
        of_point: impl Fn(&Attachment<D>) -> Vector<D>,
        of_other: impl Fn(&Constraint<D>, &View<'_, D>) -> f64,
        is_position: bool,
    ) {
        let Some(tree) = self.tree() else {
            for (right, constraint) in right.iter_mut().zip(&self.constraints) {
                *right = -of_other(constraint, view);
            }
            return;
        };
        for pin in tree.pins.iter().flatten() {
            let [first, second] = [&pin.ends[0], &pin.ends[1]].map(&of_point);
            let gap: [f64; 3] = components(&(first - second));
            for (row, gap) in pin.rows.iter().zip(gap) {
                let open = if is_position {
                    self.constraints[*row].offset
                } else {
                    0.0
                };
                right[*row] = gap + open;
            }
        }
        for row in &tree.turns {
            right[*row] = -of_other(&self.constraints[*row], view);
        }
    }

    /// Converts free accelerations into constrained ones as [`System::constrain`] does, but for multipliers; false where there is
    /// no tree.
    pub(in crate::system) fn constrain_tree(&self, work: &mut Workspace<D>) -> bool {
        if !self.factor_tree(work) {
            return false;
        }
        self.ask_accelerations(work);
        self.bring_tree(&mut work.constraints, &mut work.acceleration);
        work.constraints.is_without_multipliers = true;
        true
    }
}
