//! Symbols as strokes: where their frames are in the image.

use super::picture::Picture;
use crate::page::canvas::{Point, direction, moved};
use crate::picture::{
    Arc, Cells, FrameAxes, FramePoints, Mark, Radius, Stroke, StrokePoint, StrokeShape, Style,
    marks,
};
use crate::scene::First;

/// Parts of an arc.
const ARC: u32 = 24;

/// Where a symbol is in the image.
pub(super) struct Placement<'a> {
    ends: [Point; 2],
    /// Its direction as it is seen; as long as it is seen.
    along: Point,
    /// What the symbol belongs to, where it is a part of the scene.
    mark: Option<&'a Mark<'a>>,
    /// Size of a unit, pixels.
    unit: f64,
}

/// The frame of a stroke, pixels.
struct PlacedFrame {
    from: Point,
    to: Point,
    axes: [Point; 2],
    unit: f64,
}

impl PlacedFrame {
    fn at(&self, [part, beside, x, y]: StrokePoint) -> Point {
        let span = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        let point = moved(moved(self.from, span, part), across(span), beside);
        let point = moved(point, self.axes[0], x * self.unit);
        moved(point, self.axes[1], y * self.unit)
    }
}

/// The normal of the same length that points down the page.
fn across([x, y]: Point) -> Point {
    if x >= 0.0 { [-y, x] } else { [y, -x] }
}

fn distance(from: Point, to: Point) -> f64 {
    (to[0] - from[0]).hypot(to[1] - from[1])
}

impl Picture<'_> {
    /// Symbols of joints, springs, gears, motions and ports.
    pub(super) fn symbols(&mut self) {
        for mark in marks(self.resolved) {
            let placement = Placement {
                ends: self.ends(&mark.ends),
                along: self.along(&mark),
                mark: Some(&mark),
                unit: self.unit,
            };
            self.strokes(&mark.strokes, &placement);
        }
    }

    /// Draws a symbol between two points, pixels.
    pub(super) fn symbol(&mut self, strokes: &[Stroke], ends: [Point; 2], unit: f64) {
        let placement = Placement {
            ends,
            along: [1.0, 0.0],
            mark: None,
            unit,
        };
        self.strokes(strokes, &placement);
    }

    /// The direction of a mark as it is seen: its own, or that of its second end.
    fn along(&self, mark: &Mark<'_>) -> Point {
        let Some(given) = mark.direction else {
            return direction(self.place(mark.ends.second).direction);
        };
        let [a, b] = self.seen(given);
        match mark.ends.first {
            First::Marker(first) if self.scene.dimension == 2 => {
                let [x, y] = self.place(first).direction;
                [a * x + b * y, a * y - b * x]
            }
            _ => [a, -b],
        }
    }

    fn strokes(&mut self, strokes: &[Stroke], placement: &Placement<'_>) {
        for stroke in strokes {
            let frame = self.frame(stroke, placement);
            let style = Style {
                width: stroke.style.width * frame.unit,
                ..stroke.style
            };
            match &stroke.shape {
                StrokeShape::Line(points) => {
                    let points: Vec<Point> = points.iter().map(|point| frame.at(*point)).collect();
                    self.canvas.polyline(&points, style);
                }
                StrokeShape::Circle { centre, radius } => {
                    let radius = self.radius(radius, &frame);
                    self.canvas.circle(frame.at(*centre), radius, style);
                }
                StrokeShape::Arc(arc) => self.arc(arc, &frame, style),
                StrokeShape::Repeat(cells) => self.cells(cells, &frame, style),
            }
        }
    }

    fn frame(&self, stroke: &Stroke, placement: &Placement<'_>) -> PlacedFrame {
        let &Placement {
            ends,
            along,
            mark,
            unit,
        } = placement;
        let [from, to] = match stroke.points {
            FramePoints::First => [ends[0]; 2],
            // A still drawing knows no way.
            FramePoints::Second | FramePoints::Travel => [ends[1]; 2],
            FramePoints::Both => ends,
            FramePoints::Limit(limit) => [self.limit(mark, limit).unwrap_or(ends[1]); 2],
            FramePoints::Beside([x, y]) => [[ends[1][0] + x * unit, ends[1][1] + y * unit]; 2],
        };
        let along = match stroke.axes {
            FrameAxes::Page => [1.0, 0.0],
            FrameAxes::Along => direction(along),
            FrameAxes::Axis => along,
            FrameAxes::Span => direction([to[0] - from[0], to[1] - from[1]]),
            FrameAxes::Global(axis) => {
                let [across, up] = self.seen(axis);
                [across, -up]
            }
        };
        PlacedFrame {
            from,
            to,
            axes: [along, across(along)],
            unit,
        }
    }

    /// Where a coordinate meets a limit, no further than the edge of the image.
    fn limit(&self, mark: Option<&Mark<'_>>, limit: f64) -> Option<Point> {
        let mark = mark?;
        let [first, _] = self.ends(&mark.ends);
        let met = moved(first, self.along(mark), self.pixels(limit));
        let edges = [self.canvas.width(), self.canvas.height()];
        Some([0, 1].map(|k| met[k].clamp(2.0 * self.unit, edges[k] - 2.0 * self.unit)))
    }

    fn radius(&self, radius: &Radius, frame: &PlacedFrame) -> f64 {
        let reach = distance(frame.from, frame.to).max(2.0 * frame.unit);
        radius.units * frame.unit + radius.part * reach + self.pixels(radius.length)
    }

    fn arc(&mut self, arc: &Arc, frame: &PlacedFrame, style: Style) {
        let &Arc {
            radius,
            from,
            sweep,
            head,
        } = arc;
        let at = |angle: f64, radius: f64| {
            frame.at([0.0, 0.0, radius * angle.cos(), -radius * angle.sin()])
        };
        let points = (0..=ARC).map(|k| from + sweep * f64::from(k) / f64::from(ARC));
        let points: Vec<Point> = points.map(|angle| at(angle, radius)).collect();
        self.canvas.polyline(&points, style);
        // The head goes on along the arc by a third of its length.
        let end = from + sweep;
        let (sine, cosine) = end.sin_cos();
        let way = if sweep > 0.0 { head } else { -head };
        let ahead = moved(at(end, radius), [-sine, -cosine], 0.36 * way * frame.unit);
        let back = moved(ahead, [-sine, -cosine], -way * frame.unit);
        let side = 0.42 * head * frame.unit;
        let corners = [side, -side].map(|side| moved(back, [cosine, -sine], side));
        self.canvas
            .polyline(&[ahead, corners[0], corners[1]], Style::solid(style.stroke));
    }

    fn cells(&mut self, cells: &Cells, frame: &PlacedFrame, style: Style) {
        let [from, to] = [cells.from, cells.to].map(|end| frame.at(end));
        let count = (distance(from, to) / (cells.pitch * frame.unit)).round();
        let [least, most] = cells.counts.map(f64::from);
        let count = count.clamp(least, most) as u32;
        let span = [to[0] - from[0], to[1] - from[1]];
        let mut line = vec![from];
        for number in 0..count {
            let points = cells.cell.iter().map(|[part, x, y]| {
                let part = (f64::from(number) + part) / f64::from(count);
                let point = moved(moved(from, span, part), frame.axes[0], x * frame.unit);
                moved(point, frame.axes[1], y * frame.unit)
            });
            if cells.is_joined {
                line.extend(points);
            } else {
                let points: Vec<Point> = points.collect();
                self.canvas.polyline(&points, style);
            }
        }
        line.push(to);
        if cells.is_joined {
            self.canvas.polyline(&line, style);
        }
    }
}
