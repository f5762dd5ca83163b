//! Checks that a scene means something, and finds what its names refer to.

use std::collections::BTreeSet;
use std::fmt::Display;
use std::ops::RangeInclusive;

use super::{
    Body, Error, Formulation, Initial, Input, InputKind, Integrator, Joint, JointKind, Motion,
    Output, OutputKind, Scene, Shape,
};

/// Numbers of elements of a body: the limit on memory is far beyond any use.
pub const ELEMENTS: RangeInclusive<u32> = 1..=100_000;
/// Relative tolerances: below, the error of a step drowns in roundoff; above, it is none at all.
pub const TOLERANCE: RangeInclusive<f64> = 1e-12..=0.1;
/// Most natural frequencies: they are computed with dense matrices.
const MOST_FREQUENCIES: u32 = 100;
/// Words that begin variable names of the scene itself.
const RESERVED: [&str; 5] = ["ground", "gravity", "energy", "time", "relative_tolerance"];

/// A marker found by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkerReference {
    /// Index of the body.
    pub body: usize,
    /// Material coordinate in [0, 1].
    pub coordinate: f64,
}

impl Scene {
    /// Checks every value of the scene.
    ///
    /// # Errors
    /// The first value that is out of range or refers to nothing.
    pub fn validate(&self) -> Result<(), Error> {
        check_scene_name(&self.name)?;
        if self.dimension != 2 {
            return Err(expected("dimension", "2 (planar)", self.dimension));
        }
        vector("gravity", self.gravity)?;
        if self.bodies.len() != 1 {
            return Err(expected("bodies", "exactly one body", self.bodies.len()));
        }
        let mut names = BTreeSet::new();
        for (index, body) in self.bodies.iter().enumerate() {
            let path = format!("bodies[{index}]");
            check_name(&format!("{path}.name"), &body.name, &mut names)?;
            body.validate(&path)?;
            let moves = body.motion != Motion::default();
            if moves && self.initial == Initial::StaticEquilibrium {
                let place = format!("{path}.motion");
                return Err(expected(
                    &place,
                    "no motion at static equilibrium",
                    "a motion",
                ));
            }
        }
        for (index, joint) in self.joints.iter().enumerate() {
            let path = format!("joints[{index}]");
            check_name(&format!("{path}.name"), &joint.name, &mut names)?;
            self.validate_joint(&path, joint)?;
        }
        self.validate_inputs()?;
        self.validate_outputs()?;
        check_tolerance(
            "accuracy.relative_tolerance",
            self.accuracy.relative_tolerance,
        )?;
        positive("experiment.stop_time", "s", self.experiment.stop_time)?;
        positive("experiment.step", "s", self.experiment.step)?;
        self.validate_method()
    }

    /// Finds a marker by `body.marker`.
    pub fn marker(&self, name: &str) -> Option<MarkerReference> {
        let (body_name, marker_name) = name.split_once('.')?;
        let body = self.bodies.iter().position(|b| b.name == body_name)?;
        let coordinate = *self.bodies[body].markers.get(marker_name)?;
        Some(MarkerReference { body, coordinate })
    }

    /// Material coordinates of a body where joints or inputs act: the mesh has nodes there.
    pub fn loaded_coordinates(&self, body: usize) -> Vec<f64> {
        let joints = self.joints.iter().map(|joint| &joint.markers[1]);
        let inputs = self.inputs.iter().map(|input| &input.marker);
        let mut coordinates: Vec<f64> = joints
            .chain(inputs)
            .filter_map(|name| self.marker(name))
            .filter(|marker| marker.body == body)
            .map(|marker| marker.coordinate)
            .collect();
        coordinates.sort_by(f64::total_cmp);
        coordinates.dedup();
        coordinates
    }

    fn require_marker(&self, path: &str, name: &str) -> Result<(), Error> {
        if self.marker(name).is_some() {
            return Ok(());
        }
        let known: Vec<String> = self
            .bodies
            .iter()
            .flat_map(|b| b.markers.keys().map(|m| format!("{}.{m}", b.name)))
            .collect();
        let wanted = format!("a marker of this scene ({})", known.join(", "));
        Err(expected(path, &wanted, quoted(name)))
    }

    fn validate_joint(&self, path: &str, joint: &Joint) -> Result<(), Error> {
        if joint.markers[0] != "ground" {
            return Err(expected(
                &format!("{path}.markers[0]"),
                "\"ground\"",
                quoted(&joint.markers[0]),
            ));
        }
        self.require_marker(&format!("{path}.markers[1]"), &joint.markers[1])?;
        let place = format!("{path}.direction");
        match (joint.kind, joint.direction) {
            (JointKind::Slider, None) => Err(expected(&place, "a direction [x, y]", "nothing")),
            (JointKind::Slider, Some(direction)) => {
                vector(&place, direction)?;
                if direction[0].hypot(direction[1]) > 0.0 {
                    Ok(())
                } else {
                    Err(expected(&place, "a direction that is not zero", "[0, 0]"))
                }
            }
            (_, Some(_)) => Err(expected(
                &place,
                "nothing for this kind of joint",
                "a direction",
            )),
            (_, None) => Ok(()),
        }
    }

    fn validate_inputs(&self) -> Result<(), Error> {
        let mut seen = BTreeSet::new();
        for (index, input) in self.inputs.iter().enumerate() {
            let path = format!("inputs[{index}]");
            self.require_marker(&format!("{path}.marker"), &input.marker)?;
            let Input {
                kind,
                marker,
                start,
            } = input;
            if !seen.insert((marker, *kind == InputKind::Force)) {
                return Err(expected(
                    &path,
                    "an input not declared before",
                    quoted(marker),
                ));
            }
            let components = input.components();
            if !start.is_empty() && start.len() != components {
                let wanted = format!("{components} component(s)");
                return Err(expected(&format!("{path}.start"), &wanted, start.len()));
            }
            for (axis, value) in start.iter().enumerate() {
                finite(&format!("{path}.start[{axis}]"), *value)?;
            }
        }
        Ok(())
    }

    fn validate_outputs(&self) -> Result<(), Error> {
        let mut seen = BTreeSet::new();
        for (index, output) in self.outputs.iter().enumerate() {
            let path = format!("outputs[{index}]");
            output.validate(&path)?;
            if let Some(name) = &output.marker {
                self.require_marker(&format!("{path}.marker"), name)?;
            }
            if let Some(name) = &output.joint {
                self.require_joint(&path, output.kind, name)?;
            }
            if let Some(name) = &output.body
                && !self.bodies.iter().any(|body| &body.name == name)
            {
                let place = format!("{path}.body");
                return Err(expected(&place, "a body of this scene", quoted(name)));
            }
            let of = [&output.marker, &output.joint, &output.body];
            if !seen.insert((format!("{:?}", output.kind), of)) {
                return Err(expected(&path, "an output not declared before", "it again"));
            }
        }
        Ok(())
    }

    fn require_joint(&self, path: &str, kind: OutputKind, name: &str) -> Result<(), Error> {
        let place = format!("{path}.joint");
        let Some(joint) = self.joints.iter().find(|joint| joint.name == name) else {
            return Err(expected(&place, "a joint of this scene", quoted(name)));
        };
        let offered = match kind {
            OutputKind::Reaction => joint.kind != JointKind::Orientation,
            _ => matches!(joint.kind, JointKind::Weld | JointKind::Orientation),
        };
        if offered {
            Ok(())
        } else {
            let wanted = format!("a joint that transmits a {}", output_word(kind));
            Err(expected(&place, &wanted, quoted(name)))
        }
    }

    fn validate_method(&self) -> Result<(), Error> {
        if self.method.formulation == Formulation::MassWeighted {
            return Ok(());
        }
        if self.method.integrator != Integrator::Rk4 {
            return Err(expected(
                "method.integrator",
                "\"rk4\": the implicit solve needs the exact connectivity that as_printed breaks",
                format!("{:?}", self.method.integrator).to_lowercase(),
            ));
        }
        let component = |joint: &&Joint| joint.kind != JointKind::Revolute;
        match self.joints.iter().find(component) {
            Some(joint) => Err(expected(
                "method.formulation",
                "revolute joints only under \"as_printed\"",
                quoted(&joint.name),
            )),
            None => Ok(()),
        }
    }
}

impl Body {
    fn validate(&self, path: &str) -> Result<(), Error> {
        let elements = format!("{path}.elements");
        if !ELEMENTS.contains(&self.elements) {
            let wanted = format!("an integer from {} to {}", ELEMENTS.start(), ELEMENTS.end());
            return Err(expected(&elements, &wanted, self.elements));
        }
        let material = format!("{path}.material");
        positive(
            &format!("{material}.youngs_modulus"),
            "Pa",
            self.material.youngs_modulus,
        )?;
        positive(
            &format!("{material}.density"),
            "kg/m^3",
            self.material.density,
        )?;
        not_negative(
            &format!("{material}.damping_time"),
            "s",
            self.material.damping_time,
        )?;
        positive(&format!("{path}.section.area"), "m^2", self.section.area)?;
        not_negative(
            &format!("{path}.section.second_moment"),
            "m^4",
            self.section.second_moment,
        )?;
        vector(&format!("{path}.motion.velocity"), self.motion.velocity)?;
        finite(&format!("{path}.motion.spin"), self.motion.spin)?;
        self.validate_shape(&format!("{path}.shape"))?;
        let mut names = BTreeSet::new();
        for (name, coordinate) in &self.markers {
            let place = format!("{path}.markers.{name}");
            check_name(&place, name, &mut names)?;
            if !(0.0..=1.0).contains(coordinate) {
                return Err(expected(&place, "a number from 0 to 1", coordinate));
            }
        }
        Ok(())
    }

    fn validate_shape(&self, path: &str) -> Result<(), Error> {
        let (Shape::Line { from, to } | Shape::Arc { from, to, .. }) = &self.shape;
        vector(&format!("{path}.from"), *from)?;
        vector(&format!("{path}.to"), *to)?;
        let distance = (to[0] - from[0]).hypot(to[1] - from[1]);
        if distance <= 0.0 {
            return Err(expected(
                path,
                "two ends that differ",
                "the same point twice",
            ));
        }
        if let Shape::Arc { length, .. } = self.shape {
            let place = format!("{path}.arc.length");
            finite(&place, length)?;
            if length <= distance {
                let wanted = format!("more than the distance between the ends ({distance} m)");
                return Err(expected(&place, &wanted, length));
            }
        }
        Ok(())
    }
}

impl Input {
    /// Number of components: 2 for a force, 1 for a moment.
    pub fn components(&self) -> usize {
        match self.kind {
            InputKind::Force => 2,
            InputKind::Moment => 1,
        }
    }
}

impl Output {
    fn validate(&self, path: &str) -> Result<(), Error> {
        use OutputKind::*;
        let needs = match self.kind {
            Position | Velocity | Acceleration | Angle | AngularVelocity | Strain | Curvature => {
                "marker"
            }
            Reaction | ReactionMoment => "joint",
            Energy => "",
            NaturalFrequency => "body",
        };
        let given = [
            ("marker", self.marker.is_some()),
            ("joint", self.joint.is_some()),
            ("body", self.body.is_some()),
        ];
        for (key, is_given) in given {
            let place = format!("{path}.{key}");
            if key == needs && !is_given {
                return Err(expected(&place, "a name", "nothing"));
            }
            if key != needs && is_given {
                return Err(expected(
                    &place,
                    "nothing for this kind of output",
                    "a name",
                ));
            }
        }
        let place = format!("{path}.count");
        match (self.kind, self.count) {
            (NaturalFrequency, Some(count)) if (1..=MOST_FREQUENCIES).contains(&count) => Ok(()),
            (NaturalFrequency, count) => {
                let wanted = format!("an integer from 1 to {MOST_FREQUENCIES}");
                let found = count.map_or("nothing".into(), |count| count.to_string());
                Err(expected(&place, &wanted, found))
            }
            (_, Some(_)) => Err(expected(
                &place,
                "nothing for this kind of output",
                "a count",
            )),
            (_, None) => Ok(()),
        }
    }
}

fn output_word(kind: OutputKind) -> &'static str {
    match kind {
        OutputKind::Reaction => "force",
        _ => "moment",
    }
}

fn expected(path: &str, wanted: &str, found: impl Display) -> Error {
    Error::new(path, format!("expected {wanted}, found {found}"))
}

fn quoted(text: &str) -> String {
    format!("\"{text}\"")
}

fn finite(path: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() {
        return Ok(());
    }
    Err(expected(path, "a finite number", value))
}

fn vector(path: &str, value: [f64; 2]) -> Result<(), Error> {
    finite(&format!("{path}[0]"), value[0])?;
    finite(&format!("{path}[1]"), value[1])
}

fn positive(path: &str, unit: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(expected(
        path,
        &format!("a positive number ({unit})"),
        value,
    ))
}

fn not_negative(path: &str, unit: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() && value >= 0.0 {
        return Ok(());
    }
    Err(expected(
        path,
        &format!("zero or a positive number ({unit})"),
        value,
    ))
}

fn check_tolerance(path: &str, value: f64) -> Result<(), Error> {
    if TOLERANCE.contains(&value) {
        return Ok(());
    }
    let wanted = format!(
        "a number from {:e} to {}",
        TOLERANCE.start(),
        TOLERANCE.end()
    );
    Err(expected(path, &wanted, value))
}

fn check_scene_name(name: &str) -> Result<(), Error> {
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !name.is_empty() && name.len() <= 100 && name.chars().all(allowed) {
        return Ok(());
    }
    Err(expected("name", "letters, digits, _ and -", quoted(name)))
}

fn check_name<'a>(path: &str, name: &'a str, names: &mut BTreeSet<&'a str>) -> Result<(), Error> {
    let starts = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    if !starts || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        let wanted = "a letter or _, then letters, digits and _";
        return Err(expected(path, wanted, quoted(name)));
    }
    if RESERVED.contains(&name) || !names.insert(name) {
        return Err(expected(path, "a name not used yet", quoted(name)));
    }
    Ok(())
}
