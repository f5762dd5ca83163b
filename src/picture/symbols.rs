//! Symbols of joints, springs, gears, latches, motions, ports and loads, as textbooks draw them. Each is here and nowhere else.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use super::palette::{FAINT, JOINT, MOTION, PAPER, SPRING};
use super::stroke::{
    Arc, Cells, FrameAxes, FramePoints, Radius, Stroke, StrokePoint, StrokeShape, Style,
};
use crate::scene::{
    DrivenQuantity, JointCoordinate, LoadPlace, Place, PortKind, ResolvedGear, ResolvedJoint,
    Symbol,
};

/// Width of most lines, units.
const LINE: Style = Style::line(JOINT, 0.16);
/// The inside of pins and feet, which hides what is behind.
const HOLLOW: Style = Style {
    fill: PAPER,
    ..LINE
};
const HATCHING: Style = Style::line(JOINT, 0.09);
/// Most hatches of a line, which may be long where a picture is enlarged.
const HATCHES: u32 = 240;
/// Height of a foot, and half the length of a rail, units.
const FOOT: f64 = 1.6;
const RAIL: f64 = 2.4;
/// Coordinates of a point beside a port where the motion comes in, units.
const PLUG: [f64; 2] = [4.0 * FRAC_1_SQRT_2; 2];

/// A point at coordinates along both axes, units.
const fn at(x: f64, y: f64) -> StrokePoint {
    [0.0, 0.0, x, y]
}

/// A point at a part of the way between both points.
const fn part(of: f64) -> StrokePoint {
    [of, 0.0, 0.0, 0.0]
}

/// A point at an angle and a distance from the first point, as axes of the page are, units.
fn polar(angle: f64, radius: f64) -> StrokePoint {
    at(radius * angle.cos(), -radius * angle.sin())
}

/// Where strokes are: points and axes of their frame.
#[derive(Clone, Copy)]
struct StrokeFrame {
    points: FramePoints,
    axes: FrameAxes,
}

impl StrokeFrame {
    const fn new(points: FramePoints, axes: FrameAxes) -> Self {
        Self { points, axes }
    }

    const fn draw(self, shape: StrokeShape, style: Style) -> Stroke {
        Stroke {
            points: self.points,
            axes: self.axes,
            shape,
            style,
        }
    }

    fn line<const N: usize>(self, points: [StrokePoint; N], style: Style) -> Stroke {
        self.draw(StrokeShape::Line(points.into()), style)
    }

    fn circle(self, centre: StrokePoint, units: f64, style: Style) -> Stroke {
        let radius = Radius {
            units,
            ..Radius::default()
        };
        self.draw(StrokeShape::Circle { centre, radius }, style)
    }

    /// A line with hatching: ground. Hatches begin on the line and lead behind it by a vector in units.
    fn ground(self, [from, to]: [StrokePoint; 2], hatch: [f64; 2]) -> [Stroke; 2] {
        let [x, y] = hatch;
        let hatches = StrokeShape::Repeat(Cells {
            from,
            to,
            pitch: 0.5,
            counts: [2, HATCHES],
            cell: vec![[0.75, 0.0, 0.0], [0.75, x, y]],
            is_joined: false,
        });
        [self.line([from, to], LINE), self.draw(hatches, HATCHING)]
    }

    fn pin(self) -> Stroke {
        self.circle(at(0.0, 0.0), 0.42, HOLLOW)
    }

    /// A square with a half side in units.
    fn square(self, half: f64, style: Style) -> Stroke {
        let corners = [
            [-1.0, -1.0],
            [1.0, -1.0],
            [1.0, 1.0],
            [-1.0, 1.0],
            [-1.0, -1.0],
        ];
        let corners = corners.map(|[a, b]| at(half * a, half * b));
        self.line(corners, style)
    }
}

const FIRST: StrokeFrame = StrokeFrame::new(FramePoints::First, FrameAxes::Page);
const SECOND: StrokeFrame = StrokeFrame::new(FramePoints::Second, FrameAxes::Page);
const ALONG: StrokeFrame = StrokeFrame::new(FramePoints::Second, FrameAxes::Along);
const SPAN: StrokeFrame = StrokeFrame::new(FramePoints::Both, FrameAxes::Span);
const TRAVEL: StrokeFrame = StrokeFrame::new(FramePoints::Travel, FrameAxes::Along);

/// A pin on the ground below.
fn support(frame: StrokeFrame) -> Vec<Stroke> {
    let feet = [at(0.0, 0.0), at(-0.9, FOOT), at(0.9, FOOT)];
    let [line, hatches] = frame.ground([at(-1.3, FOOT), at(1.3, FOOT)], [-0.4, 0.5]);
    vec![frame.line(feet, HOLLOW), line, hatches, frame.pin()]
}

/// A pin, on the ground where one end of what it belongs to is.
fn foot(frame: StrokeFrame, is_grounded: bool) -> Vec<Stroke> {
    if is_grounded {
        support(frame)
    } else {
        vec![frame.pin()]
    }
}

/// Two rails along the way of the second end, of the ground or of a body.
fn rails(is_grounded: bool) -> Vec<Stroke> {
    let rail = |y: f64| [[0.0, 0.0, -RAIL, y], [1.0, 0.0, RAIL, y]];
    let mut found = vec![TRAVEL.line(rail(-0.6), LINE)];
    if is_grounded {
        found.extend(TRAVEL.ground(rail(0.6), [-0.4, 0.5]));
    } else {
        found.push(TRAVEL.line(rail(0.6), LINE));
    }
    found
}

/// A wall across a body that ends at the ground.
fn wall(joint: &ResolvedJoint<'_>) -> Vec<Stroke> {
    let out = match joint.ends.second.place {
        Place::Along(_, s) if s < 0.5 => -1.0,
        Place::Point(_, [x, ..]) if x < 0.0 => -1.0,
        Place::Interface(reduced, index) if reduced.body.contained().place(index)[0] < 0.0 => -1.0,
        Place::Patch(plate, index) if plate.body.marker_at(index).at()[0] < 0.5 => -1.0,
        Place::Along(..) | Place::Point(..) | Place::Interface(..) | Place::Patch(..) => 1.0,
    };
    let frame = StrokeFrame::new(FramePoints::First, FrameAxes::Along);
    frame
        .ground([at(0.0, -1.7), at(0.0, 1.7)], [0.5 * out, -0.4])
        .into()
}

fn spiral() -> Stroke {
    let points = (0..=48).map(|number| {
        let part = f64::from(number) / 48.0;
        polar(4.0 * PI * part, 0.5 + 0.8 * part)
    });
    SECOND.draw(
        StrokeShape::Line(points.collect()),
        Style::line(SPRING, 0.12),
    )
}

/// A joint.
pub fn joint(joint: &ResolvedJoint<'_>) -> Vec<Stroke> {
    let is_grounded = joint.ends.is_grounded();
    let upright = if is_grounded { FIRST } else { SECOND };
    let has_axis = matches!(joint.symbol(), Symbol::Pin | Symbol::Spiral)
        && joint.primitives.iter().any(|of| of.direction().is_some());
    let axis = has_axis.then(|| {
        let frame = StrokeFrame::new(upright.points, FrameAxes::Axis);
        frame.line([at(-2.2, 0.0), at(2.2, 0.0)], Style::line(FAINT, 0.14))
    });
    let symbol = match joint.symbol() {
        Symbol::Pin => foot(upright, is_grounded),
        Symbol::Spiral => [vec![spiral()], foot(upright, is_grounded)].concat(),
        Symbol::Weld if is_grounded => wall(joint),
        Symbol::Weld => vec![ALONG.square(0.5, Style::solid(JOINT))],
        Symbol::Slider => [rails(is_grounded), vec![SECOND.pin()]].concat(),
        Symbol::Prismatic => [rails(is_grounded), vec![ALONG.square(0.48, LINE)]].concat(),
        Symbol::Orientation => vec![ALONG.square(0.8, LINE)],
        Symbol::Link => {
            let link = SPAN.line([part(0.0), part(1.0)], Style::line(JOINT, 0.24));
            [vec![link], foot(FIRST, is_grounded), vec![SECOND.pin()]].concat()
        }
        Symbol::Ring => vec![SECOND.circle(at(0.0, 0.0), 0.75, Style::line(JOINT, 0.22))],
    };
    axis.into_iter().chain(symbol).collect()
}

/// Straight ends and a zigzag between.
fn coil() -> [Stroke; 3] {
    let style = Style::line(SPRING, 0.16);
    let zigzag = StrokeShape::Repeat(Cells {
        from: part(0.15),
        to: part(0.85),
        pitch: 0.9,
        counts: [2, 12],
        cell: vec![[0.25, 0.0, 0.55], [0.75, 0.0, -0.55]],
        is_joined: true,
    });
    [
        SPAN.line([part(0.0), part(0.15)], style),
        SPAN.draw(zigzag, style),
        SPAN.line([part(0.85), part(1.0)], style),
    ]
}

/// A spring between two ends; on a foot where the first is the ground.
pub fn spring(is_grounded: bool) -> Vec<Stroke> {
    let mut found = Vec::from(coil());
    if is_grounded {
        found.extend(support(FIRST));
    }
    found
}

/// A straight part of a rope between two points that it runs over.
pub fn rope(is_grounded: bool) -> Vec<Stroke> {
    let line = SPAN.line([part(0.0), part(1.0)], Style::line(SPRING, 0.12));
    [vec![line], foot(FIRST, is_grounded), vec![SECOND.pin()]].concat()
}

/// A spring on the coordinate of a joint.
pub fn joint_spring(on: &JointCoordinate<'_>) -> Vec<Stroke> {
    if on.is_angle() {
        vec![spiral()]
    } else {
        coil().into()
    }
}

/// Friction on the coordinate of a joint: two shoes that press on it.
pub fn joint_friction() -> Vec<Stroke> {
    let shoe = |side: f64| {
        let shoe = [-0.9, 0.9].map(|x| at(x, 1.3 * side));
        SECOND.line(shoe, Style::line(SPRING, 0.35))
    };
    vec![shoe(-1.0), shoe(1.0)]
}

/// Bars where a coordinate of a joint meets its limits: across the way, or beside the joint where it is an angle.
pub fn joint_limit(on: &JointCoordinate<'_>, limits: [Option<f64>; 2]) -> Vec<Stroke> {
    let sides = [-1.0, 1.0].into_iter().zip(limits);
    let bar = |(side, limit): (f64, Option<f64>)| {
        let limit = limit?;
        let (frame, x) = if on.is_angle() {
            (SECOND, 2.2)
        } else {
            (
                StrokeFrame::new(FramePoints::Limit(limit), FrameAxes::Along),
                1.1,
            )
        };
        let bar = [-0.9, 0.9].map(|y| at(side * x, y));
        Some(frame.line(bar, Style::line(JOINT, 0.3)))
    };
    sides.filter_map(bar).collect()
}

/// A gear: between two angles wheels with radii in the ratio of their rates, in mesh where they rotate opposite ways, else with a belt;
/// between an angle and a displacement the wheel that rolls along it.
pub fn gear(gear: &ResolvedGear<'_>) -> Vec<Stroke> {
    let style = Style::line(FAINT, 0.1);
    let wheel = |end: f64, radius: Radius| {
        let centre = part(end);
        SPAN.draw(StrokeShape::Circle { centre, radius }, style)
    };
    let rolling = |length: f64| Radius {
        length,
        ..Radius::default()
    };
    let line = SPAN.line([part(0.0), part(1.0)], style);
    let size = gear.ratio.abs();
    match gear.coordinates.map(|of| of.is_angle()) {
        [true, true] => {
            let is_meshed = gear.ratio < 0.0;
            let second = if is_meshed { 1.0 } else { 0.6 } / (1.0 + size);
            let radii = [second * size, second];
            let wheels = [0, 1].map(|end| {
                let part = radii[end];
                let radius = Radius {
                    part,
                    ..Radius::default()
                };
                wheel(end as f64, radius)
            });
            let mut found = Vec::from(wheels);
            if !is_meshed {
                // The belt touches both wheels where their radii are at right angles to it.
                let sine = radii[0] - radii[1];
                let cosine = (1.0 - sine * sine).sqrt();
                for side in [1.0, -1.0] {
                    let touched = |end: f64, radius: f64| {
                        [end + radius * sine, side * radius * cosine, 0.0, 0.0]
                    };
                    found.push(SPAN.line([touched(0.0, radii[0]), touched(1.0, radii[1])], style));
                }
            }
            found
        }
        [true, false] => vec![line, wheel(0.0, rolling(size))],
        [false, true] => vec![line, wheel(1.0, rolling(1.0 / size))],
        [false, false] => vec![line],
    }
}

/// A driven displacement: arrows to and fro.
fn drive(points: FramePoints, axes: FrameAxes) -> Vec<Stroke> {
    let frame = StrokeFrame::new(points, axes);
    let arrow = |sign: f64| {
        let along = |x: f64, y: f64| at(sign * x, y);
        let shaft = [along(0.5, 0.0), along(1.6, 0.0)];
        let head = [along(2.2, 0.0), along(1.48, 0.3), along(1.48, -0.3)];
        [
            frame.line(shaft, Style::line(MOTION, 0.2)),
            frame.line(head, Style::solid(MOTION)),
        ]
    };
    [-1.0, 1.0].into_iter().flat_map(arrow).collect()
}

/// A driven position: ways along all global axes.
fn drives(points: FramePoints, dimension: usize) -> Vec<Stroke> {
    let axes = (0..dimension).map(|axis| std::array::from_fn(|k| f64::from(u8::from(k == axis))));
    axes.flat_map(|axis| drive(points, FrameAxes::Global(axis)))
        .collect()
}

/// A driven motion.
pub fn motion(quantity: &DrivenQuantity<'_>, dimension: usize) -> Vec<Stroke> {
    let [has_force, _] = quantity.exerts;
    match quantity.place {
        LoadPlace::Ends(ends) => cylinder(ends.is_grounded()),
        LoadPlace::Coordinate(_) if has_force => drive(FramePoints::Second, FrameAxes::Axis),
        _ if has_force => drives(FramePoints::Second, dimension),
        _ => vec![rotation(FramePoints::Second, MOTION)],
    }
}

/// A driven distance: a cylinder and its rod between the ends; on a foot where the first is the ground.
fn cylinder(is_grounded: bool) -> Vec<Stroke> {
    let side = |of: f64, across: f64| [of, 0.0, 0.0, across];
    let barrel = [
        side(0.1, -0.5),
        side(0.65, -0.5),
        side(0.65, 0.5),
        side(0.1, 0.5),
    ];
    let line = Style::line(MOTION, 0.16);
    let mut found = vec![
        SPAN.line([part(0.0), part(0.1)], line),
        SPAN.line(
            barrel,
            Style {
                fill: PAPER,
                ..line
            },
        ),
        SPAN.line([side(0.4, -0.5), side(0.4, 0.5)], line),
        SPAN.line([part(0.4), part(1.0)], line),
    ];
    if is_grounded {
        found.extend(support(FIRST));
    }
    found
}

/// A latch: a hook above the second marker.
pub fn latch() -> Vec<Stroke> {
    let arm = [at(-1.6, 1.5), at(0.5, 1.5), at(0.5, 0.9), at(0.1, 1.2)];
    vec![SECOND.line(arm, Style::line(JOINT, 0.2))]
}

/// A port that a motion comes into; one that a force comes into is drawn as this force. Through a coupling the motion comes in beside the
/// marker, because both are in one place at the start.
pub fn port(kind: &PortKind<'_>, dimension: usize) -> Vec<Stroke> {
    let (points, turns) = match kind {
        PortKind::Force { .. } => return Vec::new(),
        PortKind::Motion { angle, .. } => (FramePoints::Second, angle.is_some()),
        PortKind::Coupling { angle, .. } => (FramePoints::Beside(PLUG), angle.is_some()),
    };
    let mut found = Vec::new();
    if matches!(kind, PortKind::Coupling { .. }) {
        found.push(plug());
    }
    found.extend(drives(points, dimension));
    found.extend(turns.then(|| rotation(points, MOTION)));
    found
}

/// A spring from a marker to where a motion comes in.
fn plug() -> Stroke {
    let [x, y] = PLUG.map(|part| part / 4.0);
    let tooth = |tooth: i32| {
        let side = if tooth % 2 == 0 { 0.55 } else { -0.55 } * FRAC_1_SQRT_2;
        let along = 0.8 + 2.4 * (f64::from(tooth) + 0.5) / 6.0;
        at(along * x - side, along * y + side)
    };
    let ends = [0.0, 0.8, 3.2, 4.0].map(|along| at(along * x, along * y));
    let points = ends[..2].iter().copied().chain((0..6).map(tooth));
    let points = points.chain(ends[2..].iter().copied());
    SECOND.draw(
        StrokeShape::Line(points.collect()),
        Style::line(SPRING, 0.16),
    )
}

/// A counter-clockwise moment or rotation in the plane.
fn rotation(points: FramePoints, colour: &'static str) -> Stroke {
    let arc = StrokeShape::Arc(Arc {
        radius: 1.5,
        from: (-50.0_f64).to_radians(),
        sweep: 264.0_f64.to_radians(),
        head: 0.84,
    });
    StrokeFrame::new(points, FrameAxes::Page).draw(arc, Style::line(colour, 0.2))
}

/// An arrow from the first to the second point.
pub fn arrow(colour: &'static str) -> Vec<Stroke> {
    let tip = |x: f64, y: f64| [1.0, 0.0, x, y];
    vec![
        SPAN.line([part(0.0), tip(-0.7, 0.0)], Style::line(colour, 0.2)),
        SPAN.line(
            [part(1.0), tip(-0.84, 0.35), tip(-0.84, -0.35)],
            Style::solid(colour),
        ),
    ]
}

/// A force, or a moment: in the plane an arc, in space an arrow with two heads.
pub fn load(is_moment: bool, dimension: usize, colour: &'static str) -> Vec<Stroke> {
    if is_moment && dimension == 2 {
        return vec![rotation(FramePoints::First, colour)];
    }
    let mut found = arrow(colour);
    if is_moment {
        let tip = |x: f64, y: f64| [1.0, 0.0, x, y];
        let head = [tip(-0.7, 0.0), tip(-1.54, 0.35), tip(-1.54, -0.35)];
        found.push(SPAN.line(head, Style::solid(colour)));
    }
    found
}

/// Returns the direction of a joint that its symbol is drawn along.
pub(super) fn direction(joint: &ResolvedJoint<'_>) -> Option<[f64; 3]> {
    joint.primitives.iter().find_map(|of| of.direction())
}
