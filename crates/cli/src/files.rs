//! What a run of the headless program writes: outputs, and what pictures are drawn from.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use anyhow::{Context, Result, anyhow};
use flexbody::scene::{Body, Scene};
use flexbody::simulation::Simulation;

use crate::reading::at;
use crate::settings::outputs;

/// Parts of a cable that a picture shows: as many an element, at least, at most.
const PARTS: (u32, u32, u32) = (6, 48, 480);

/// A file that is written, or standard output.
pub struct Sink {
    name: String,
    writer: Box<dyn Write>,
}

impl Sink {
    /// Opens the file at `path`, or standard output where there is none.
    ///
    /// # Errors
    /// The file cannot be created.
    pub fn new(path: Option<&Path>) -> Result<Self> {
        Ok(match path {
            Some(path) => {
                let file = File::create(path).map_err(|error| at(path, error))?;
                Self {
                    name: path.display().to_string(),
                    writer: Box::new(BufWriter::new(file)),
                }
            }
            None => Self {
                name: "standard output".into(),
                writer: Box::new(BufWriter::new(io::stdout().lock())),
            },
        })
    }

    /// Writes a line.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn line(&mut self, text: &str) -> Result<()> {
        let written = writeln!(self.writer, "{text}");
        written.with_context(|| self.name.clone())
    }

    /// Flushes the buffered output.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn finish(&mut self) -> Result<()> {
        let flushed = self.writer.flush();
        flushed.with_context(|| self.name.clone())
    }
}

/// Outputs at communication points.
pub struct Table {
    outputs: Vec<usize>,
    /// Where they go.
    pub sink: Sink,
}

impl Table {
    /// The outputs of a simulation, to be written to `sink`.
    pub fn new(simulation: &Simulation, sink: Sink) -> Self {
        Self {
            outputs: outputs(simulation),
            sink,
        }
    }

    /// Writes the names.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn header(&mut self, simulation: &Simulation) -> Result<()> {
        let names = self.outputs.iter();
        let names = names.map(|index| simulation.variables()[*index].name.as_str());
        let names: Vec<&str> = std::iter::once("time").chain(names).collect();
        self.sink.line(&names.join(","))
    }

    /// Writes the present values.
    ///
    /// # Errors
    /// Values that cannot be computed, or a file that cannot be written.
    pub fn row(&mut self, simulation: &mut Simulation) -> Result<()> {
        let mut fields = vec![format!("{:?}", simulation.time())];
        for index in &self.outputs {
            let value = simulation
                .real(*index)
                .map_err(|error| anyhow!("{error}"))?;
            fields.push(format!("{value:?}"));
        }
        self.sink.line(&fields.join(","))
    }
}

/// Positions of markers and of points along bodies, for pictures.
pub struct Shapes {
    /// The first line: bodies and their markers.
    pub header: String,
    /// Whether each body is drawn by its markers, `[bodies]`.
    is_rigid: Vec<bool>,
    /// Number of markers of every body.
    markers: Vec<usize>,
    /// Where they go.
    pub sink: Sink,
}

impl Shapes {
    /// The bodies of a scene, to be written to `sink`.
    pub fn new(scene: &Scene, sink: Sink) -> Self {
        let (mut header, mut is_rigid, mut markers) = (Vec::new(), Vec::new(), Vec::new());
        for body in &scene.bodies {
            let names = body.marker_names();
            // Names are letters, digits and _: they need no escapes.
            let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
            let kind = match body {
                Body::Cable(_) | Body::Rod(_) | Body::Beam(_) | Body::Auto(_) => "cable",
                Body::Rigid(_) => "rigid",
                Body::Reduced(_) => "reduced",
                Body::Plate(_) | Body::Shell(_) => "surface",
            };
            header.push(format!(
                "{{\"name\": \"{}\", \"kind\": \"{kind}\", \"markers\": [{}]}}",
                body.name(),
                quoted.join(", ")
            ));
            is_rigid.push(kind != "cable");
            markers.push(names.len());
        }
        Self {
            header: format!("{{\"bodies\": [{}]}}", header.join(", ")),
            is_rigid,
            markers,
            sink,
        }
    }

    /// Writes a line of positions. With `is_whole` it has the points along flexible bodies, and centre of mass and
    /// markers of rigid ones.
    ///
    /// # Errors
    /// Positions that cannot be computed, or a file that cannot be written.
    pub fn row(&mut self, simulation: &mut Simulation, is_whole: bool) -> Result<()> {
        let dimension = simulation.scene().dimension;
        let list = |points: &[[f64; 3]]| {
            let points = points.iter().map(|point| &point[..dimension]);
            let points: Vec<String> = points.map(|point| format!("{point:?}")).collect();
            format!("[{}]", points.join(", "))
        };
        let markers = simulation.markers().map_err(|error| anyhow!("{error}"))?;
        let mut text = format!("\"markers\": {}", list(&markers));
        if is_whole {
            let (each, least, most) = PARTS;
            let parts = |elements: usize| {
                let elements = u32::try_from(elements).unwrap_or(most);
                elements.saturating_mul(each).clamp(least, most)
            };
            let found = simulation.outlines(parts);
            let mut outlines = found.map_err(|error| anyhow!("{error}"))?;
            let mut rest = &markers[..];
            for (body, outline) in outlines.iter_mut().enumerate() {
                let (own, others) = rest.split_at(self.markers[body]);
                rest = others;
                if self.is_rigid[body] {
                    outline.extend(own);
                }
            }
            let outlines: Vec<String> = outlines.iter().map(|points| list(points)).collect();
            text += &format!(", \"outlines\": [{}]", outlines.join(", "));
        }
        let time = simulation.time();
        self.sink.line(&format!("{{\"time\": {time:?}, {text}}}"))
    }
}
