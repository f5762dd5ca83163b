//! Panels of lines with marks, side by side, as SVG. Colours are those of Okabe and Ito, told apart
//! with any colour vision; marks tell lines apart without colour.

use std::ops::Range;
use std::path::Path;

use anyhow::{Context, Result, anyhow};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::element::{DashedPathElement, Drawable, PointCollection};
use plotters::prelude::*;
use plotters_backend::{BackendCoord, DrawingErrorKind};

use crate::process::prepared;

/// Width of a panel beside one other and beside more, height of its axes, height of a row of its
/// legend, in pixels.
const WIDE: u32 = 600;
const NARROW: u32 = 430;
const HEIGHT: u32 = 430;
const ROW: u32 = 22;
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];
/// Ratio of the end of a logarithmic axis to the outermost value, at least.
const MARGIN: f64 = 1.2;
/// Length and spacing of dashes, in pixels.
const DASH: (i32, i32) = (6, 4);
const GUIDE: RGBColor = RGBColor(120, 120, 120);

/// Marks of the points of a line.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// No mark.
    None,
    /// Filled circle.
    Dot,
    /// Open circle.
    Ring,
    /// Filled triangle.
    Triangle,
    /// Open square.
    Square,
    /// Diagonal cross.
    Cross,
}

/// A line of a panel.
pub struct Line {
    /// Name in the legend.
    pub name: String,
    /// Points in drawing order.
    pub points: Vec<(f64, f64)>,
    /// Index of the colour; none for a grey guide.
    pub colour: Option<usize>,
    /// Marks of the points.
    pub mark: Mark,
    /// Dashed instead of solid.
    pub dashed: bool,
    /// Marks alone.
    pub scattered: bool,
}

impl Line {
    /// A solid line with marks.
    pub fn new(name: &str, points: Vec<(f64, f64)>, colour: usize, mark: Mark) -> Self {
        Self {
            name: name.to_owned(),
            points,
            colour: Some(colour),
            mark,
            dashed: false,
            scattered: false,
        }
    }

    /// Dashed.
    pub fn dashed(mut self) -> Self {
        self.dashed = true;
        self
    }

    /// Without the line.
    pub fn scattered(mut self) -> Self {
        self.scattered = true;
        self
    }

    /// A guide for the eye from a point on: a power law.
    pub fn guide(name: &str, from: (f64, f64), to: f64, power: f64) -> Self {
        let end = (to, from.1 * (to / from.0).powf(power));
        Self {
            name: name.to_owned(),
            points: vec![from, end],
            colour: None,
            mark: Mark::None,
            dashed: true,
            scattered: false,
        }
    }

    fn point<C>(&self, at: C) -> Point<C> {
        Point {
            at,
            mark: self.mark,
            style: self.style(),
        }
    }

    fn style(&self) -> ShapeStyle {
        match self.colour {
            Some(index) => COLOURS[index % COLOURS.len()].stroke_width(2),
            None => GUIDE.stroke_width(1),
        }
    }
}

/// How an axis is divided.
pub enum Division {
    /// Logarithmic, by decades.
    Log,
    /// Logarithmic, with ticks at these numbers.
    Counts(Vec<u32>),
    /// Linear from zero, with ticks at multiples of this number.
    Linear(f64),
}

/// An axis.
pub struct Axis {
    /// What is shown, with its unit.
    pub label: &'static str,
    /// How it is divided.
    pub division: Division,
    /// Smallest value shown; smaller ones are drawn here.
    pub floor: Option<f64>,
}

impl Axis {
    /// A logarithmic axis.
    pub fn log(label: &'static str) -> Self {
        let (division, floor) = (Division::Log, None);
        Self {
            label,
            division,
            floor,
        }
    }

    /// A logarithmic axis with ticks at these numbers.
    pub fn counts(label: &'static str, ticks: &[u32]) -> Self {
        let (division, floor) = (Division::Counts(ticks.to_vec()), None);
        Self {
            label,
            division,
            floor,
        }
    }

    /// A linear axis from zero.
    pub fn linear(label: &'static str, tick: f64) -> Self {
        let (division, floor) = (Division::Linear(tick), None);
        Self {
            label,
            division,
            floor,
        }
    }

    /// With a smallest value.
    pub fn floor(mut self, floor: f64) -> Self {
        self.floor = Some(floor);
        self
    }

    fn shown(&self, value: f64) -> f64 {
        self.floor.map_or(value, |floor| value.max(floor))
    }

    fn scale(&self, values: impl Iterator<Item = f64>) -> Result<Scale> {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.map(|value| self.shown(value)) {
            (low, high) = (low.min(value), high.max(value));
        }
        let log = !matches!(self.division, Division::Linear(_));
        if !(low.is_finite() && high.is_finite()) || (log && low <= 0.0) {
            return Err(anyhow!(
                "axis {:?}: expected finite numbers{}, found {low} to {high}",
                self.label,
                if log { " above zero" } else { "" }
            ));
        }
        Ok(match &self.division {
            Division::Log => Scale::decades(low, high),
            Division::Counts(ticks) => Scale {
                log,
                range: low / 1.15..high * 1.15,
                ticks: ticks.iter().map(|&tick| f64::from(tick)).collect(),
                minor: Vec::new(),
            },
            Division::Linear(tick) => {
                let count = (high / tick + 1e-9).floor();
                Scale {
                    log,
                    range: 0.0..high,
                    ticks: (0..=count as u32).map(|n| f64::from(n) * tick).collect(),
                    minor: Vec::new(),
                }
            }
        })
    }
}

/// Axes with lines.
pub struct Panel {
    /// Title.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Lines, in the order of the legend.
    pub lines: Vec<Line>,
}

/// Draws panels side by side into an SVG file.
pub fn draw(path: &Path, panels: &[Panel]) -> Result<()> {
    let (width, columns) = if panels.len() > 2 {
        (NARROW, 1)
    } else {
        (WIDE, 2)
    };
    let rows = panels
        .iter()
        .map(|panel| panel.lines.len().div_ceil(columns));
    let legend = ROW * rows.max().unwrap_or(0) as u32 + 12;
    let size = (width * panels.len() as u32, HEIGHT + legend);
    let path = prepared(path)?;
    let outcome = || -> Result<()> {
        let root = SVGBackend::new(&path, size).into_drawing_area();
        root.fill(&WHITE)?;
        for (panel, area) in panels.iter().zip(root.split_evenly((1, panels.len()))) {
            let (axes, legend) = area.split_vertically(HEIGHT);
            draw_axes(panel, &axes)?;
            draw_legend(panel, &legend, columns)?;
        }
        root.present()?;
        Ok(())
    };
    outcome().with_context(|| format!("cannot draw {}", crate::process::shown(&path)))
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

fn draw_axes(panel: &Panel, area: &Area) -> Result<()> {
    let points = || panel.lines.iter().flat_map(|line| &line.points);
    let x = panel.x.scale(points().map(|point| point.0))?;
    let y = panel.y.scale(points().map(|point| point.1))?;
    let mut chart = ChartBuilder::on(area)
        .caption(&panel.title, ("sans-serif", 21))
        .margin(12)
        .margin_right(24)
        .x_label_area_size(50)
        .y_label_area_size(76)
        .build_cartesian_2d(x, y)?;
    chart
        .configure_mesh()
        .label_style(("sans-serif", 16))
        .axis_desc_style(("sans-serif", 18))
        .bold_line_style(BLACK.mix(0.18))
        .light_line_style(BLACK.mix(0.06))
        .x_desc(panel.x.label)
        .y_desc(panel.y.label)
        .draw()?;
    for line in &panel.lines {
        let shown = |&(x, y): &(f64, f64)| (panel.x.shown(x), panel.y.shown(y));
        let points: Vec<(f64, f64)> = line.points.iter().map(shown).collect();
        let style = line.style();
        if line.scattered {
            // Nothing joins the marks.
        } else if line.dashed {
            let path = DashedPathElement::new(points.clone(), DASH.0, DASH.1, style);
            chart.draw_series(std::iter::once(path))?;
        } else {
            chart.draw_series(std::iter::once(PathElement::new(points.clone(), style)))?;
        }
        chart.draw_series(points.into_iter().map(|at| line.point(at)))?;
    }
    Ok(())
}

/// Names row by row.
fn draw_legend(panel: &Panel, area: &Area, columns: usize) -> Result<()> {
    let column = (area.dim_in_pixel().0 as i32 - 100) / columns as i32;
    for (index, line) in panel.lines.iter().enumerate() {
        let x = 84 + column * (index % columns) as i32;
        let y = 10 + ROW as i32 * (index / columns) as i32;
        let (path, style) = (vec![(x, y), (x + 34, y)], line.style());
        if line.scattered {
            // Nothing joins the marks.
        } else if line.dashed {
            area.draw(&DashedPathElement::new(path, DASH.0, DASH.1, style))?;
        } else {
            area.draw(&PathElement::new(path, style))?;
        }
        area.draw(&line.point((x + 17, y)))?;
        let style = ("sans-serif", 16).into_text_style(area);
        area.draw_text(&line.name, &style, (x + 42, y - 7))?;
    }
    Ok(())
}

/// A mark at a point of any coordinate system.
struct Point<C> {
    at: C,
    mark: Mark,
    style: ShapeStyle,
}

impl<'a, C> PointCollection<'a, C> for &'a Point<C> {
    type Point = &'a C;
    type IntoIter = std::iter::Once<&'a C>;

    fn point_iter(self) -> Self::IntoIter {
        std::iter::once(&self.at)
    }
}

impl<C, B: DrawingBackend> Drawable<B> for Point<C> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        mut points: I,
        backend: &mut B,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<B::ErrorType>> {
        let Some((x, y)) = points.next() else {
            return Ok(());
        };
        let style = &self.style;
        match self.mark {
            Mark::None => Ok(()),
            Mark::Dot => backend.draw_circle((x, y), 4, style, true),
            Mark::Ring => backend.draw_circle((x, y), 5, style, false),
            Mark::Triangle => {
                backend.fill_polygon([(x, y - 6), (x + 5, y + 4), (x - 5, y + 4)], style)
            }
            Mark::Square => backend.draw_rect((x - 4, y - 4), (x + 4, y + 4), style, false),
            Mark::Cross => {
                backend.draw_line((x - 4, y - 4), (x + 4, y + 4), style)?;
                backend.draw_line((x - 4, y + 4), (x + 4, y - 4), style)
            }
        }
    }
}

/// An axis in numbers. One type for both kinds, so that panels of any kind are one type.
struct Scale {
    log: bool,
    range: Range<f64>,
    ticks: Vec<f64>,
    minor: Vec<f64>,
}

impl Scale {
    /// From a round number below the values to one above.
    fn decades(low: f64, high: f64) -> Self {
        let decades =
            |from: f64, to: f64| from.log10().floor() as i32..to.log10().ceil() as i32 + 1;
        let all = |digits: &[f64]| -> Vec<f64> {
            let decade = |k| digits.iter().map(move |digit| digit * 10_f64.powi(k));
            decades(low / 10.0, high * 10.0).flat_map(decade).collect()
        };
        let round = all(&[1.0, 2.0, 5.0]);
        // Marks keep clear of the frame.
        let below = |tick: &&f64| **tick <= low / MARGIN;
        let above = |tick: &&f64| **tick >= high * MARGIN;
        let start = round.iter().rfind(below).copied().unwrap_or(low);
        let end = round.iter().find(above).copied().unwrap_or(high);
        let inside = |ticks: Vec<f64>| -> Vec<f64> {
            let inside = start * (1.0 - 1e-9)..=end * (1.0 + 1e-9);
            ticks.into_iter().filter(|t| inside.contains(t)).collect()
        };
        let tens = inside(all(&[1.0]));
        let ticks = match tens.len() {
            0..=2 => inside(round),
            3..=9 => tens,
            _ => tens.into_iter().step_by(2).collect(),
        };
        Self {
            log: true,
            range: start..end,
            ticks,
            minor: inside(all(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0])),
        }
    }

    fn position(&self, value: f64) -> f64 {
        if self.log { value.log10() } else { value }
    }
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let range = self.position(self.range.start)..self.position(self.range.end);
        RangedCoordf64::from(range).map(&self.position(*value), limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let points = if hint.weight().allow_light_points() {
            &self.minor
        } else {
            &self.ticks
        };
        points.clone()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, value: &f64) -> String {
        let exponent = (value.abs().log10() + 1e-9).floor();
        if !self.log || (-2.0..5.0).contains(&exponent) {
            return format!("{}", (value * 1e6).round() / 1e6);
        }
        let power = format!("10{}", superscript(exponent as i32));
        match (value / 10_f64.powf(exponent)).round() as i32 {
            1 => power,
            digit => format!("{digit}·{power}"),
        }
    }
}

fn superscript(number: i32) -> String {
    let raised = |character| match character {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    number.to_string().chars().map(raised).collect()
}
