//! Loads one by one, on cables and rigid bodies in random states: forces from energies, tangents by
//! differences, power.

use flexbody::bodies::{Marker, Node, NodeBlock};
use flexbody::elements::Element;
use flexbody::math::curve::Curve;
use flexbody::math::function::Function;
use flexbody::math::state_expression::StateExpression;
use flexbody::system::Instant;
use flexbody::system::loads::{
    AppliedLoad, Bushing, BushingMeasure, Contact, ContactLaw, ContactPoint, ContactSurface,
    ForceElement as _, ForceLaw, FromAngle, FromPoint, JointLimit, JointSpring, OneSidedSpring,
    TableSpring,
};
use flexbody::system::{Angle, Attachment, Coordinate, Direction, Signal, Translation};
use nalgebra::{DMatrix, DVector, Vector2};
use proptest::prelude::*;

use crate::laws::differences::{Outcome, check, within};
use crate::laws::frames::{Frame, along, ends, frame, frames, slope, wave};
use crate::laws::mechanism::{Acting, Body, Point, Wave};

const CASES: u32 = 40;

/// A load with the angles that it may count.
struct Acted<'a> {
    frame: &'a Frame,
    load: AppliedLoad,
    angles: Vec<Angle>,
}

impl Acted<'_> {
    fn at<T>(
        &self,
        (x, v, t): (&[Node], &[Node], f64),
        f: impl Fn(&AppliedLoad, Instant<'_, 2>) -> T,
    ) -> T {
        let start = &self.frame.x;
        let hints: Vec<f64> = (self.angles.iter())
            .map(|angle| angle.value(start, 0.4))
            .collect();
        let instant = Instant {
            time: t,
            inputs: &[],
            input_rates: &[],
            drives: &[],
            x,
            v,
            bodies: &self.frame.bodies,
            angles: (&self.angles, &hints),
        };
        f(&self.load, instant)
    }

    fn force(&self, x: &[Node], v: &[Node], t: f64) -> DVector<f64> {
        self.at((x, v, t), |load, at| {
            let mut f = vec![[[0.0; 2]; 2]; x.len()];
            load.add_force(at, &mut f);
            DVector::from_column_slice(f.as_flattened().as_flattened())
        })
    }

    fn energy(&self, x: &[Node], t: f64) -> f64 {
        self.at((x, x, t), |load, at| load.energy(at))
    }

    /// Work from the frame's configuration to another one, all else held.
    fn work(&self, to: &[Node], t: f64) -> f64 {
        let x = &self.frame.x;
        self.at((x, x, t), |load, at| load.work(at, Instant { x: to, ..at }))
    }

    /// Stiffness and damping over all nodes.
    fn tangent(&self, x: &[Node], v: &[Node], t: f64) -> [DMatrix<f64>; 2] {
        let size = 4 * x.len();
        let zero = || std::cell::RefCell::new(DMatrix::zeros(size, size));
        let found = [zero(), zero()];
        let enter = |which: usize, a: usize, b: usize, block: &NodeBlock<2>| {
            let mut matrix = found[which].borrow_mut();
            for (r, row) in block.as_flattened().iter().enumerate() {
                for (c, part) in row.as_flattened().iter().enumerate() {
                    matrix[(4 * a + r, 4 * b + c)] += part;
                    if a != b {
                        matrix[(4 * b + c, 4 * a + r)] += part;
                    }
                }
            }
        };
        self.at((x, v, t), |load, at| {
            load.add_tangent(
                at,
                &mut |a, b, block| enter(0, a, b, block),
                &mut |a, b, block| enter(1, a, b, block),
            );
        });
        found.map(std::cell::RefCell::into_inner)
    }
}

/// Springs, dampers and limits on the angle between two ends and, where the first is rigid, on the way along a line of it.
/// Limits stand where they are passed on both sides.
fn on_coordinates<'a>(frame: &'a Frame, ends: [Attachment; 2]) -> Vec<Acted<'a>> {
    let (made, angle) = (&frame.made, Angle { ends, turn: None });
    let [sin, cos] = [made.noise[23].sin(), made.noise[23].cos()];
    let along = |direction| {
        Coordinate::Translation(Translation {
            ends,
            direction,
            turn: [sin, cos],
        })
    };
    let way = match &ends[0] {
        Attachment::Body(marker) if ends[0].is_rigid() => Some(along(Direction::Of(*marker))),
        Attachment::Ground(_) => Some(along(Direction::Fixed(Vector2::new(cos, sin)))),
        Attachment::Body(_) => None,
    };
    let coordinates = way.into_iter().chain([Coordinate::Angle(angle, 0)]);
    let loads = coordinates.flat_map(|coordinate| {
        let value = coordinate.value(&frame.x, &[angle.value(&frame.x, 0.4)]);
        let spring = AppliedLoad::JointSpring(JointSpring {
            coordinate: Box::new(coordinate.clone()),
            stiffness: 3.0 + made.noise[25],
            damping: 1.0 + made.noise[26],
            rest: 7.0 * made.noise[27],
        });
        let limits = [
            [f64::NEG_INFINITY, value - 0.4],
            [value + 0.3, f64::INFINITY],
            [value - 9.0, value + 9.0],
        ];
        let limited = limits.map(|limits| {
            AppliedLoad::JointLimit(JointLimit {
                coordinate: Box::new(coordinate.clone()),
                limits,
                spring: OneSidedSpring {
                    stiffness: 5.0 + made.noise[24],
                    damping: 0.03,
                },
            })
        });
        limited.into_iter().chain([spring])
    });
    let acted = |load| Acted {
        frame,
        load,
        angles: vec![angle],
    };
    loads.map(acted).collect()
}

/// Contacts of markers and of all cables with a line and with a circle, all of them below it.
fn contacts(frame: &Frame, friction: f64, damping: f64) -> Vec<Acted<'_>> {
    let made = &frame.made;
    let markers = ends(made).into_iter().filter_map(|[_, end]| {
        let Attachment::Body(marker) = made.product_end(end) else {
            return None;
        };
        let weight = 1.0;
        Some(vec![ContactPoint { marker, weight }])
    });
    let cables = frame
        .bodies
        .lines()
        .iter()
        .enumerate()
        .map(|(body, chain)| {
            let elements = chain.elements().iter().enumerate();
            let places = elements.flat_map(|(j, element)| {
                [0.1, 0.6].map(|xi| ContactPoint {
                    marker: Marker::within(body, chain, j, xi),
                    weight: 0.5 * element.length(),
                })
            });
            places.collect::<Vec<_>>()
        });
    let normal = Vector2::new(made.noise[23].cos(), made.noise[23].sin());
    let both = markers.chain(cables).flat_map(|places| {
        let points = places.iter().map(|place| place.marker.position(&frame.x));
        let points: Vec<Vector2<f64>> = points.collect();
        let highest = points.iter().map(|point| normal.dot(point));
        let highest = highest.fold(f64::NEG_INFINITY, f64::max);
        let center = points[0] - normal * 1.3;
        let far = points.iter().map(|point| (point - center).norm());
        let surfaces = [
            ContactSurface::Plane {
                point: normal * (highest + 0.4),
                normal,
            },
            ContactSurface::Round {
                center,
                axis: None,
                radius: far.fold(0.0, f64::max) + 0.3,
            },
        ];
        surfaces.map(|surface| Acted {
            frame,
            load: AppliedLoad::Contact(Box::new(Contact {
                places: places.clone(),
                law: ContactLaw {
                    surface,
                    spring: OneSidedSpring {
                        stiffness: 5.0 + made.noise[24],
                        damping,
                    },
                    friction,
                    slip_velocity: 2.0,
                    sticking: None,
                    radius: 0.0,
                },
                surface_frame: None,
                rolling: None,
                kept: None,
            })),
            angles: Vec::new(),
        })
    });
    both.collect()
}

fn loads(frame: &Frame) -> Vec<Acted<'_>> {
    let made = &frame.made;
    let mut actions = Vec::new();
    let Point::On(at) = made.holds[0].ends[0] else {
        return Vec::new();
    };
    for follower in [false, true] {
        actions.push(Acting::Force {
            at,
            follower,
            size: [wave(made, 11), wave(made, 14)],
        });
    }
    let mut rotational = Vec::new();
    for ends in ends(made) {
        actions.push(Acting::Moment {
            ends,
            size: wave(made, 17),
        });
        actions.push(Acting::Spring {
            ends,
            stiffness: 4.0 + made.noise[20],
            damping: 1.0 + made.noise[21],
            length: wave(made, 22),
        });
        let ends = ends.map(|end| made.product_end(end));
        rotational.extend(on_coordinates(frame, ends));
    }
    for (body, kind) in made.bodies.iter().enumerate() {
        if matches!(kind, Body::Cable(_)) {
            actions.push(Acting::DistributedForce {
                body,
                size: [wave(made, 28), wave(made, 31)],
            });
        }
    }
    let acted = |action: &Acting| Acted {
        frame,
        load: made.load(action),
        angles: Vec::new(),
    };
    let actions = actions.iter().map(acted);
    let contacts = contacts(frame, 0.0, 0.01);
    let actions = actions
        .chain(couplings(frame))
        .chain(by_tables(frame))
        .chain(contacts);
    actions.chain(rotational).collect()
}

/// A number that changes in time, and its rate.
fn moving(wave: Wave) -> [Signal; 2] {
    let Wave {
        amplitude,
        frequency,
        ..
    } = wave;
    let text = format!("{:?}*cos({frequency:?}*t)", amplitude * frequency);
    let rate = Function::expression(&text).expect("an expression");
    [Signal::Function(wave.function()), Signal::Function(rate)]
}

/// A bushing with one stiffness and one damping, along and about all axes.
fn bushing(measure: BushingMeasure, [stiffness, damping]: [f64; 2]) -> AppliedLoad {
    AppliedLoad::Bushing(Box::new(Bushing {
        measure,
        stiffness: [[stiffness; 3]; 2],
        damping: [[damping; 3]; 2],
    }))
}

/// Springs and dampers to a point and an angle that move, and springs alone.
fn couplings(frame: &Frame) -> Vec<Acted<'_>> {
    let made = &frame.made;
    let mut couplings = Vec::new();
    for [_, end] in ends(made) {
        let end = made.product_end(end);
        let Attachment::Body(marker) = end else {
            continue;
        };
        for damping in [0.0, 1.0 + made.noise[35]] {
            let [x, y, turn] = [36, 39, 42].map(|k| moving(wave(made, k)));
            let ([x, vx], [y, vy], [angle, velocity]) = (x, y, turn);
            let ends = [Attachment::Ground(Default::default()), end];
            couplings.push(Acted {
                frame,
                load: bushing(
                    BushingMeasure::Point(FromPoint {
                        marker,
                        position: [x, y],
                        velocity: [vx, vy],
                    }),
                    [3.0 + made.noise[34], damping],
                ),
                angles: Vec::new(),
            });
            couplings.push(Acted {
                frame,
                load: bushing(
                    BushingMeasure::Angle(FromAngle {
                        marker,
                        counted: 0,
                        angle,
                        velocity,
                    }),
                    [3.0 + made.noise[34], damping],
                ),
                angles: vec![Angle { ends, turn: None }],
            });
        }
    }
    couplings
}

/// Springs by tables between the ends, with and without a damper.
fn by_tables(frame: &Frame) -> Vec<Acted<'_>> {
    let made = &frame.made;
    let mut springs = Vec::new();
    for both in ends(made) {
        let ends = both.map(|end| made.product_end(end));
        let [a, b] = ends.map(|end| end.position(&frame.x));
        let length = (b - a).norm();
        if length < 0.1 {
            continue;
        }
        let spring = [-0.7, -0.2, 0.3, 1.1, 1.3].map(|x: f64| [length + x, 4.0 * (x + 0.1).sinh()]);
        let damper = [-1.0, 0.0, 1.0].map(|v| [v, v * (1.0 + made.noise[35])]);
        for damper in [None, Some(damper)] {
            let damper = damper.map(|points| Curve::new(&points).expect("a curve"));
            springs.push(Acted {
                frame,
                load: AppliedLoad::TableSpring(TableSpring {
                    on: Box::new(Coordinate::Length(ends)),
                    spring: Curve::new(&spring).expect("a curve"),
                    damper,
                }),
                angles: Vec::new(),
            });
        }
        let law = StateExpression::new("x^2 - sin(2*x)*t + 0.5*v*(1 + x) + u").expect("a law");
        let control = Signal::Function(Function::constant(made.noise[34]));
        springs.push(Acted {
            frame,
            load: AppliedLoad::ForceLaw(Box::new(ForceLaw::new(
                Coordinate::Length(ends),
                law,
                control,
            ))),
            angles: Vec::new(),
        });
    }
    springs
}

fn law(acted: &Acted<'_>) -> Outcome {
    let (frame, t) = (acted.frame, 0.3);
    let (x, v) = (&frame.x, &frame.v);
    let size = 4 * x.len();
    let rest = vec![[[0.0; 2]; 2]; x.len()];
    let force = acted.force(x, &rest, t);
    let most = 1.0 + force.amax();
    let follower = matches!(&acted.load, AppliedLoad::Force(force) if force.follower);
    let [stiffness, damping] = acted.tangent(x, &rest, t);
    let (mut by_x, mut by_v) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
    for i in 0..size {
        let unit = frame.unit(i);
        // Forces are minus the gradient of the energy, and the work on a short way.
        if !follower {
            let exact = slope(5e-3, |s| acted.work(&along(x, &unit, s), t));
            within("work", (force[i] - exact).abs(), 1e-8 * most)?;
        }
        let conservative = match &acted.load {
            AppliedLoad::Spring(_)
            | AppliedLoad::TableSpring(_)
            | AppliedLoad::JointSpring(_)
            | AppliedLoad::JointLimit(_)
            | AppliedLoad::Contact(_) => true,
            AppliedLoad::Bushing(load) => !load.is_damped(),
            _ => false,
        };
        if conservative {
            let exact = -slope(5e-3, |s| acted.energy(&along(x, &unit, s), t));
            within("gradient", (force[i] - exact).abs(), 1e-8 * most)?;
        }
        for j in 0..size {
            by_x[(j, i)] = -slope(5e-3, |s| acted.force(&along(x, &unit, s), &rest, t)[j]);
            by_v[(j, i)] = -slope(0.5, |s| acted.force(x, &along(v, &unit, s), t)[j]);
        }
    }
    let symmetric = (&by_x + by_x.transpose()) * 0.5;
    let size = 1.0 + symmetric.amax();
    within("stiffness", (&stiffness - &symmetric).amax(), 1e-7 * size)?;
    if !follower {
        within("symmetry", (&by_x - by_x.transpose()).amax(), 1e-7 * size)?;
    }
    within("damping", (&damping - &by_v).amax(), 1e-9)?;
    // Between two places on one rigid body nothing is there to damp, nor at a limit that is not met.
    prop_assert!(acted.load.is_damped() || damping.amax() == 0.0);
    // Power of the forces, with what is stored, is what comes in less what is dissipated.
    let moving = DVector::from_column_slice(v.as_flattened().as_flattened());
    let power = acted.force(x, v, t).dot(&moving);
    let stored = slope(0.005, |s| acted.energy(&along(x, v, s), t + s));
    let [supplied, dissipated] = acted.at((x, v, t), |load, at| load.power(at));
    within(
        "power",
        (power + stored - supplied + dissipated).abs(),
        1e-6,
    )?;
    prop_assert!(dissipated >= 0.0);
    Ok(())
}

#[test]
fn loads_have_the_forces_tangents_and_power_that_they_say() {
    check(CASES, frames(), |made| {
        let frame = frame(made);
        for acted in loads(&frame) {
            law(&acted).map_err(|e| TestCaseError::fail(format!("{e} of {:?}", acted.load)))?;
        }
        Ok(())
    });
}

/// Friction has the damping matrix that it says while points slip, takes energy, and is none at rest.
#[test]
fn friction_slows_what_slips() {
    check(CASES, frames(), |made| {
        let frame = frame(made);
        let (x, v) = (&frame.x, &frame.v);
        let rest = vec![[[0.0; 2]; 2]; x.len()];
        let pairs = contacts(&frame, 0.4, 0.0).into_iter();
        for (rough, smooth) in pairs.zip(contacts(&frame, 0.0, 0.0)) {
            let [_, damping] = rough.tangent(x, v, 0.0);
            for i in 0..damping.ncols() {
                let unit = frame.unit(i);
                for j in 0..damping.nrows() {
                    let by_v = -slope(2e-3, |s| rough.force(x, &along(v, &unit, s), 0.0)[j]);
                    within(
                        "damping",
                        (damping[(j, i)] - by_v).abs(),
                        1e-6 * (1.0 + damping.amax()),
                    )?;
                }
            }
            let difference = |v| rough.force(x, v, 0.0) - smooth.force(x, v, 0.0);
            within("at rest", difference(&rest).amax(), 0.0)?;
            let moving = DVector::from_column_slice(v.as_flattened().as_flattened());
            let [_, dissipated] = rough.at((x, v, 0.0), |load, at| load.power(at));
            let power = difference(v).dot(&moving);
            within(
                "power",
                (power + dissipated).abs(),
                1e-9 * (1.0 + power.abs()),
            )?;
            prop_assert!(dissipated >= 0.0);
        }
        Ok(())
    });
}

/// A rotational spring goes on past half a turn: its moment counts turns.
#[test]
fn a_rotational_spring_counts_turns() {
    check(16, frames(), |made| {
        let frame = frame(made);
        let acted = loads(&frame).pop();
        let Some(Acted { load, angles, .. }) = acted else {
            return Ok(());
        };
        let moment = |turns: f64| {
            let hint = angles[0].value(&frame.x, 0.0) + std::f64::consts::TAU * turns;
            let AppliedLoad::JointSpring(spring) = &load else {
                return f64::NAN;
            };
            let rest = vec![[[0.0; 2]; 2]; frame.x.len()];
            let value = spring.force(Instant {
                time: 0.0,
                inputs: &[],
                input_rates: &[],
                drives: &[],
                x: &frame.x,
                v: &rest,
                bodies: &frame.bodies,
                angles: (&angles, &[hint]),
            });
            value + spring.stiffness * std::f64::consts::TAU * turns
        };
        within("one turn more", (moment(1.0) - moment(0.0)).abs(), 1e-12)?;
        within("two turns back", (moment(-2.0) - moment(0.0)).abs(), 1e-12)?;
        // A signal that is a number is one.
        let held = Signal::Function(Function::constant(2.5));
        let at = Instant {
            time: 7.0,
            inputs: &[],
            input_rates: &[],
            drives: &[],
            x: &frame.x,
            v: &frame.v,
            bodies: &frame.bodies,
            angles: (&angles, &[0.0]),
        };
        within("a number", (held.value(at) - 2.5).abs(), 0.0)
    });
}
