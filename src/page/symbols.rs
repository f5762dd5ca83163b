//! Symbols of joints, springs, motions and loads, as textbooks draw them. `unit` is the size of a symbol in pixels.

use super::canvas::{Canvas, Point, Style, direction, moved};

const GROUND: &str = "#3a3f45";
/// Colour of loads and of their names.
pub const LOAD: &str = "#c2571a";
/// Colour of driven motions and of their names.
pub const MOTION: &str = "#2e7d4f";
/// Colour of springs and of their names.
pub const SPRING: &str = "#6f4a9e";

fn line(width: f64) -> Style {
    Style {
        stroke: GROUND,
        width,
        fill: "none",
    }
}

/// A line with hatching on the side of `behind`: ground.
fn ground(canvas: &mut Canvas, centre: Point, along: Point, behind: Point, half: f64, unit: f64) {
    let ends = [-half, half].map(|at| moved(centre, along, at));
    canvas.polyline(&ends, false, line(0.16 * unit));
    let count = (2.0 * half / (0.5 * unit)).round().max(2.0) as usize;
    for number in 0..count {
        let at = 2.0 * half * (number as f64 + 0.75) / count as f64 - half;
        let top = moved(centre, along, at);
        let bottom = moved(moved(top, behind, 0.5 * unit), along, -0.4 * unit);
        canvas.polyline(&[top, bottom], false, line(0.09 * unit));
    }
}

/// A pin between two bodies.
pub fn pin(canvas: &mut Canvas, at: Point, unit: f64) {
    let style = Style {
        fill: "#ffffff",
        ..line(0.16 * unit)
    };
    canvas.circle(at, 0.42 * unit, style);
}

/// A ring that a cable runs through.
pub fn ring(canvas: &mut Canvas, at: Point, unit: f64) {
    canvas.circle(at, 0.75 * unit, line(0.22 * unit));
}

/// Two bodies in one piece.
pub fn block(canvas: &mut Canvas, at: Point, along: Point, unit: f64) {
    let style = Style {
        fill: GROUND,
        ..line(0.0)
    };
    canvas.polyline(&square(at, along, 0.5 * unit), true, style);
}

/// A massless link.
pub fn link(canvas: &mut Canvas, from: Point, to: Point, unit: f64) {
    canvas.polyline(&[from, to], false, line(0.24 * unit));
}

/// A spring: straight ends and a zigzag between.
pub fn spring(canvas: &mut Canvas, from: Point, to: Point, unit: f64) {
    let way = [to[0] - from[0], to[1] - from[1]];
    let (length, along) = (way[0].hypot(way[1]), direction(way));
    let across = [-along[1], along[0]];
    let straight = (0.2 * length).min(1.5 * unit);
    let teeth = ((length - 2.0 * straight) / (0.45 * unit))
        .round()
        .clamp(4.0, 24.0) as usize;
    let mut points = vec![from, moved(from, along, straight)];
    for tooth in 0..teeth {
        let part = (tooth as f64 + 0.5) / teeth as f64;
        let at = moved(from, along, straight + part * (length - 2.0 * straight));
        let side = if tooth % 2 == 0 { 0.55 } else { -0.55 };
        points.push(moved(at, across, side * unit));
    }
    points.extend([moved(to, along, -straight), to]);
    let style = Style {
        stroke: SPRING,
        ..line(0.16 * unit)
    };
    canvas.polyline(&points, false, style);
}

/// A spiral spring around a pin.
pub fn spiral(canvas: &mut Canvas, at: Point, unit: f64) {
    let points: Vec<Point> = (0..=48)
        .map(|number| {
            let part = f64::from(number) / 48.0;
            let (angle, radius) = (4.0 * std::f64::consts::PI * part, (0.5 + 0.8 * part) * unit);
            [at[0] + radius * angle.cos(), at[1] - radius * angle.sin()]
        })
        .collect();
    let style = Style {
        stroke: SPRING,
        ..line(0.12 * unit)
    };
    canvas.polyline(&points, false, style);
}

/// A driven way, to and fro.
pub fn way(canvas: &mut Canvas, at: Point, along: Point, unit: f64) {
    let style = Style {
        stroke: MOTION,
        ..line(0.2 * unit)
    };
    for sign in [-1.0, 1.0] {
        let tip = moved(at, along, sign * 2.2 * unit);
        let start = moved(at, along, sign * 0.5 * unit);
        canvas.arrow(start, tip, 0.6 * unit, style);
    }
}

/// A pin on ground below.
pub fn revolute(canvas: &mut Canvas, at: Point, unit: f64) {
    let (right, down) = ([1.0, 0.0], [0.0, 1.0]);
    let foot = moved(at, down, 1.6 * unit);
    let corners = [-0.9, 0.9].map(|side| moved(foot, right, side * unit));
    let style = Style {
        fill: "#ffffff",
        ..line(0.16 * unit)
    };
    canvas.polyline(&[at, corners[0], corners[1]], true, style);
    ground(canvas, foot, right, down, 1.3 * unit, unit);
    canvas.circle(at, 0.42 * unit, style);
}

/// A wall across the body; `outward` points from the body into the wall.
pub fn weld(canvas: &mut Canvas, at: Point, outward: Point, unit: f64) {
    let across = [-outward[1], outward[0]];
    ground(canvas, at, across, outward, 1.7 * unit, unit);
}

/// A pin between two rails, of the ground or of a body.
pub fn slider(canvas: &mut Canvas, at: Point, along: Point, is_grounded: bool, unit: f64) {
    rails(canvas, at, along, is_grounded, unit);
    canvas.circle(
        at,
        0.42 * unit,
        Style {
            fill: "#ffffff",
            ..line(0.16 * unit)
        },
    );
}

/// A block between two rails, of the ground or of a body.
pub fn prismatic(canvas: &mut Canvas, at: Point, along: Point, is_grounded: bool, unit: f64) {
    rails(canvas, at, along, is_grounded, unit);
    orientation(canvas, at, along, 0.6 * unit);
}

fn rails(canvas: &mut Canvas, at: Point, along: Point, is_grounded: bool, unit: f64) {
    // Of the two normals the one that points down the page.
    let sign = if along[0] >= 0.0 { 1.0 } else { -1.0 };
    let below = [-sign * along[1], sign * along[0]];
    let [above, under] = [-0.6, 0.6].map(|side| moved(at, below, side * unit));
    let rail = |canvas: &mut Canvas, middle: Point| {
        let ends = [-2.4, 2.4].map(|end| moved(middle, along, end * unit));
        canvas.polyline(&ends, false, line(0.16 * unit));
    };
    rail(canvas, above);
    if is_grounded {
        ground(canvas, under, along, below, 2.4 * unit, unit)
    } else {
        rail(canvas, under)
    }
}

/// A bar that stops what goes along.
pub fn stop(canvas: &mut Canvas, at: Point, along: Point, unit: f64) {
    let (across, wall) = ([-along[1], along[0]], moved(at, along, 2.8 * unit));
    let ends = [-0.9, 0.9].map(|side| moved(wall, across, side * unit));
    canvas.polyline(&ends, false, line(0.3 * unit));
}

/// Wheels of a gear with their radii, and the line between them.
pub fn gear(canvas: &mut Canvas, ends: [Point; 2], radii: [f64; 2], unit: f64) {
    canvas.polyline(&ends, false, line(0.06 * unit));
    for (at, radius) in ends.into_iter().zip(radii) {
        canvas.circle(at, radius, line(0.06 * unit));
    }
}

/// A block that may move but not turn.
pub fn orientation(canvas: &mut Canvas, at: Point, along: Point, unit: f64) {
    let corners = square(at, along, 0.8 * unit);
    canvas.polyline(&corners, true, line(0.16 * unit));
}

/// Corners of a square with sides along a direction.
fn square(at: Point, along: Point, half: f64) -> [Point; 4] {
    let across = [-along[1], along[0]];
    let corner = |a: f64, b: f64| moved(moved(at, along, a * half), across, b * half);
    [
        corner(-1.0, -1.0),
        corner(1.0, -1.0),
        corner(1.0, 1.0),
        corner(-1.0, 1.0),
    ]
}

/// A force that ends at the body; gives back where its arrow begins.
pub fn force(canvas: &mut Canvas, at: Point, along: Point, unit: f64) -> Point {
    let style = Style {
        stroke: LOAD,
        width: 0.2 * unit,
        fill: "none",
    };
    let (tail, tip) = (moved(at, along, -3.6 * unit), moved(at, along, -0.5 * unit));
    canvas.arrow(tail, tip, 0.7 * unit, style);
    tail
}

/// A counter-clockwise moment or rotation.
pub fn turn(canvas: &mut Canvas, at: Point, unit: f64, colour: &'static str) {
    let style = Style {
        stroke: colour,
        width: 0.2 * unit,
        fill: "none",
    };
    let radius = 1.5 * unit;
    let points: Vec<Point> = (0..=24)
        .map(|number| {
            // From the lower right over the top to the lower left; y points down the page.
            let angle = (-50.0 + 11.0 * f64::from(number)).to_radians();
            [at[0] + radius * angle.cos(), at[1] - radius * angle.sin()]
        })
        .collect();
    canvas.polyline(&points, false, style);
    let end = 220.0f64.to_radians();
    let (sine, cosine) = (end.sin(), end.cos());
    let along = [-sine, -cosine];
    let tip = moved(
        [at[0] + radius * cosine, at[1] - radius * sine],
        along,
        0.3 * unit,
    );
    canvas.head(tip, along, 0.7 * unit, style);
}
