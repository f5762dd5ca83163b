//! Strokes that symbols are made of. A stroke is given in units of symbols, whose size in pixels the drawing chooses, relative to points and
//! axes of what the symbol stands for. So one description serves a still drawing and a picture that moves.

use serde::Serialize;

/// A point of a stroke: part of the way from the first to the second point of its frame, part of their distance across, then units along both
/// axes of the frame.
pub type StrokePoint = [f64; 4];

/// A part of a symbol in one style.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stroke {
    /// The two points of its frame.
    pub points: FramePoints,
    /// The axes of its frame. The second axis is across the first, on the side that points down the page.
    pub axes: FrameAxes,
    /// Shape.
    #[serde(flatten)]
    pub shape: StrokeShape,
    /// Style.
    #[serde(flatten)]
    pub style: Style,
}

/// The two points that a stroke is relative to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FramePoints {
    /// Both are the first end.
    First,
    /// Both are the second end.
    Second,
    /// The first and the second end.
    Both,
    /// The ends of the way of the second end along the direction, in a whole run.
    Travel,
    /// Both are at this displacement along the direction from the first end, m.
    Limit(f64),
    /// Both are beside the second end: units to the right and downwards.
    Beside([f64; 2]),
}

/// The axes that a stroke is relative to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FrameAxes {
    /// To the right and downwards.
    Page,
    /// Along the direction as it is seen, and across it.
    Along,
    /// As `Along`, foreshortened as the direction is seen.
    Axis,
    /// From the first to the second point, and across.
    Span,
    /// Along a direction in global axes, foreshortened as it is seen, and across it.
    Global([f64; 3]),
}

/// A radius: the sum of so many units, of a part of the distance between the points, and of a length of the scene, m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Radius {
    /// Units.
    pub units: f64,
    /// Part of the distance between the points, which counts as two units where it is less.
    pub part: f64,
    /// Length of the scene, m.
    pub length: f64,
}

/// Shape of a stroke.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StrokeShape {
    /// An open line; a closed one where the style has an inside.
    Line(Vec<StrokePoint>),
    /// A circle.
    Circle {
        /// Centre.
        centre: StrokePoint,
        /// Radius.
        radius: Radius,
    },
    /// An arc.
    Arc(Arc),
    /// Equal cells between two points.
    Repeat(Cells),
}

/// An arc about the first point with the head of an arrow at its end. In a moving picture a value scales its sweep.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Arc {
    /// Radius, units.
    pub radius: f64,
    /// Angle of the beginning, counter-clockwise from the right, rad.
    pub from: f64,
    /// Angle from the beginning to the end, rad.
    pub sweep: f64,
    /// Length of the head, units.
    pub head: f64,
}

/// Equal cells between two points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cells {
    /// Where the first cell begins.
    pub from: StrokePoint,
    /// Where the last cell ends.
    pub to: StrokePoint,
    /// Length of a cell, units, as far as whole cells fill the way.
    pub pitch: f64,
    /// Least and largest number of cells.
    pub counts: [u32; 2],
    /// Points in a cell: part of its length, then units along both axes of the frame.
    pub cell: Vec<[f64; 3]>,
    /// Whether cells make one line between the two points.
    pub is_joined: bool,
}

/// How a stroke is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Style {
    /// Colour of the line.
    pub stroke: &'static str,
    /// Width of the line: units of a symbol, pixels on a canvas.
    pub width: f64,
    /// Colour of the inside.
    pub fill: &'static str,
}

impl Style {
    /// A line without an inside.
    pub const fn line(stroke: &'static str, width: f64) -> Self {
        Self {
            stroke,
            width,
            fill: "none",
        }
    }

    /// An inside without a line.
    pub const fn solid(fill: &'static str) -> Self {
        Self {
            stroke: "none",
            width: 0.0,
            fill,
        }
    }

    /// Whether it has an inside.
    pub fn is_filled(&self) -> bool {
        self.fill != "none"
    }
}

/// Symbols as a JSON list for scripts.
pub fn symbols_to_json(symbols: &[Vec<Stroke>]) -> String {
    serde_json::to_string(symbols).unwrap_or_else(|_| unreachable!("strokes are plain data"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_are_written_as_scripts_read_them() {
        let cells = Cells {
            from: [0.0; 4],
            to: [1.0, 0.0, 0.0, 0.0],
            pitch: 0.5,
            counts: [2, 9],
            cell: vec![[0.5, 0.0, 1.0]],
            is_joined: true,
        };
        let stroke = |points, axes, shape| Stroke {
            points,
            axes,
            shape,
            style: Style::line("#000000", 0.1),
        };
        let symbol = vec![
            stroke(
                FramePoints::Limit(0.5),
                FrameAxes::Global([0.0, 0.0, 1.0]),
                StrokeShape::Line(vec![[0.0, 0.0, 1.0, 2.0]]),
            ),
            stroke(
                FramePoints::Both,
                FrameAxes::Span,
                StrokeShape::Repeat(cells),
            ),
        ];
        let style = r##""stroke":"#000000","width":0.1,"fill":"none""##;
        assert_eq!(
            symbols_to_json(&[symbol]),
            format!(
                r#"[[{{"points":{{"limit":0.5}},"axes":{{"global":[0.0,0.0,1.0]}},"line":[[0.0,0.0,1.0,2.0]],{style}}},{{"points":"both","axes":"span","repeat":{{"from":[0.0,0.0,0.0,0.0],"to":[1.0,0.0,0.0,0.0],"pitch":0.5,"counts":[2,9],"cell":[[0.5,0.0,1.0]],"is_joined":true}},{style}}}]]"#
            )
        );
    }
}
