//! Elements by need: what a body of `"element": "auto"` becomes, and why.
//!
//! Whether a cable will do is found by trying: the scene with a cable there is valid, or what it is refused for asks for the
//! sections of a rod. So there are no rules here but those of validation, and two that it does not know: sections that
//! are given by what a cable has no key for, and joints that hold how a line stands about its tangent.

use super::description::{Body, Input, LineBody, LineModel, SectionNumbers};
use super::resolved::{First, Place, Resolved};
use super::{Error, Scene};
use crate::scene::joints::JointPrimitive;

/// Choice of the planner for a body of `"element": "auto"`.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// Index among all bodies.
    pub body: usize,
    /// Name of the body.
    pub name: String,
    /// Chosen kind of sections.
    pub sections: LineModel,
    /// Reason for the choice.
    pub why: String,
    /// The body as a beam, where it could be one and is none: shear decides.
    pub beam: Option<Box<LineBody>>,
}

/// Reason for a cable, if no key or load demands more.
const NOTHING_NEEDED: &str = "nothing asks how its sections stand";

impl Chosen {
    /// The element by name.
    pub fn element(&self) -> &'static str {
        self.sections.element()
    }

    /// The choice in words.
    pub fn in_words(&self) -> String {
        format!("{}: {}", self.element(), self.why)
    }

    fn new(body: usize, line: &LineBody, dimension: usize) -> Self {
        let needed = line
            .need(dimension)
            .filter(|(sections, _)| dimension == 3 || *sections == LineModel::Reissner);
        let unneeded = match dimension {
            2 => "nothing twists in the plane",
            _ => NOTHING_NEEDED,
        };
        let (sections, why) = needed.unwrap_or((LineModel::Cable, unneeded));
        Self {
            body,
            name: line.name.clone(),
            sections,
            why: why.into(),
            beam: None,
        }
    }

    /// Something asks for its sections.
    fn turns(&mut self, why: String, dimension: usize) {
        (self.sections, self.why) = (least(dimension), why);
    }

    /// Makes it a beam where shear moves something by more than an error wanted; `what` says what it does.
    pub fn judge_shear(&mut self, part: f64, error: f64, what: &str) {
        if part > error {
            self.sections = LineModel::Reissner;
            self.why = format!("shear {what}, more than {error:e}");
        } else {
            self.why += &format!("; shear {what}, no more than {error:e}")
        }
    }

    /// Decides on shear by its share in the static deflection. Serves scenes without an experiment in which two runs
    /// could be compared.
    pub fn estimate_shear(&mut self, error: f64, dimension: usize) {
        if let Some(beam) = &self.beam {
            let part = beam.shear_to_bending(dimension);
            let what = format!("adds {part:.1e} to bending by 3 E I / (k G A L^2)");
            self.judge_shear(part, error, &what);
        }
    }
}

/// The least that sections do which are asked for: in the plane they lean, as nothing twists.
fn least(dimension: usize) -> LineModel {
    match dimension {
        2 => LineModel::Reissner,
        _ => LineModel::Kirchhoff,
    }
}

impl LineBody {
    /// Returns the sections that the body's own keys demand, with the reason.
    fn need(&self, dimension: usize) -> Option<(LineModel, &'static str)> {
        let all = || self.all_sections();
        let is_unequal = |numbers: SectionNumbers| !numbers.is_alike();
        let is_curved = !self.shape.is_straight();
        let reasons = [
            (
                all().any(|of| of.stiffness.is_some() || of.inertia.is_some()),
                LineModel::Reissner,
                "its sections are given as whole matrices",
            ),
            (
                dimension == 3 && all().any(|of| of.numbers().is_eccentric()),
                LineModel::Reissner,
                "its shear centre is apart from its centroid",
            ),
            (
                self.axis.is_some(),
                LineModel::Kirchhoff,
                "the axis of its section is given",
            ),
            (
                self.stations.iter().any(|station| station.twist != 0.0),
                LineModel::Kirchhoff,
                "it is twisted without stress",
            ),
            (
                self.is_coupled(),
                LineModel::Kirchhoff,
                "its twist, bending or stretching are coupled",
            ),
            (
                all().any(|of| is_unequal(of.numbers())),
                LineModel::Kirchhoff,
                "it does not bend alike to all sides",
            ),
            (
                is_curved && all().any(|of| of.numbers().second_moments[0] > 0.0),
                LineModel::Kirchhoff,
                "it is curved without stress and bends",
            ),
        ];
        let found = reasons.into_iter().find(|(is_there, ..)| *is_there);
        found.map(|(_, sections, why)| (sections, why))
    }

    /// Returns the ratio of deflection by shear and by bending of a cantilever under an end force. It is the largest
    /// about both axes of all sections (S. P. Timoshenko, Strength of Materials I, 3rd ed. (1955), section 39: `F L /
    /// (k G A)` beside `F L^3 / (3 E I)`).
    fn shear_to_bending(&self, dimension: usize) -> f64 {
        let at_stations = self
            .stations
            .iter()
            .map(|station| station.section.numbers());
        let one = self.stations.is_empty().then(|| self.section.numbers());
        let square = self.shape.length().powi(2);
        let parts = at_stations.chain(one).flat_map(|numbers| {
            let stiffness = self.whole_stiffness(&numbers);
            // What bends about an axis shears along the other one; in the plane about the first alone.
            let axes = [(4, 2), (5, 1)].into_iter().take(dimension - 1);
            axes.map(move |(bending, shear)| {
                3.0 * stiffness[(bending, bending)] / (stiffness[(shear, shear)] * square)
            })
        });
        parts.fold(0.0, f64::max)
    }

    /// Values for what rods alone need, in the plane beams, where none are said: only to ask whether one would do.
    fn fill_in(&mut self, dimension: usize) {
        self.material.shear_modulus.get_or_insert(1.0);
        for section in self.sections_mut().filter(|of| of.area.is_some()) {
            match dimension {
                2 => section.shear_factor.get_or_insert(1.0),
                _ => section.torsion_constant.get_or_insert(1.0),
            };
        }
    }
}

impl Scene {
    /// Chooses an element for every body of `"element": "auto"`. Shear decides here if the planner has nothing else to
    /// choose.
    ///
    /// # Errors
    /// What is not valid, whatever they become.
    pub fn choose_elements(&self) -> Result<Vec<Chosen>, Error> {
        let bodies = self.bodies.iter().enumerate();
        let open = bodies.filter_map(|(index, body)| match body {
            Body::Auto(line) => Some(Chosen::new(index, line, self.dimension)),
            _ => None,
        });
        let mut chosen: Vec<Chosen> = open.collect();
        if chosen.is_empty() {
            return Ok(chosen);
        }
        // Each time around a cable becomes a rod, or this is the end.
        loop {
            let scene = self.with_elements(&chosen);
            let error = match scene.resolve() {
                Ok(resolved) => match held(&resolved, &chosen) {
                    Some((place, why)) => {
                        chosen[place].turns(why, self.dimension);
                        continue;
                    }
                    None => break,
                },
                Err(error) => error,
            };
            match self.asked_of(&chosen, &error) {
                Some(place) => chosen[place].turns(self.asking(&error.path), self.dimension),
                None => return Err(with_reason(&chosen, error)),
            }
        }
        let beams: Vec<_> = (0..chosen.len())
            .map(|place| self.as_beam(&chosen, place))
            .collect();
        for (of, beam) in chosen.iter_mut().zip(beams) {
            of.beam = beam.map(Box::new);
            if !self.is_to_be_planned() {
                of.estimate_shear(self.error(), self.dimension);
            }
        }
        Ok(chosen)
    }

    /// The scene with these elements.
    pub fn with_elements(&self, chosen: &[Chosen]) -> Self {
        let mut scene = self.clone();
        scene.take_elements(chosen);
        scene.plain()
    }

    /// Says in bodies of `"element": "auto"` what their sections do.
    pub(super) fn take_elements(&mut self, chosen: &[Chosen]) {
        for of in chosen {
            if let Some(line) = self.bodies[of.body].cable_mut() {
                line.sections = of.sections;
            }
        }
    }

    /// The scene with every body of `"element": "auto"` as what it became when it was read.
    pub fn plain(mut self) -> Self {
        let dimension = self.dimension;
        for body in &mut self.bodies {
            if let Body::Auto(line) = body {
                *body = line.made(line.sections, dimension);
            }
        }
        self
    }

    /// The cable that would not be refused for this, were it a rod, or a beam in the plane.
    fn asked_of(&self, chosen: &[Chosen], error: &Error) -> Option<usize> {
        let is_cable = |place: &usize| chosen[*place].sections == LineModel::Cable;
        let asks = |place: &usize| {
            let mut tried = chosen.to_vec();
            tried[*place].sections = least(self.dimension);
            let mut scene = self.with_elements(&tried);
            let body = chosen[*place].body;
            if let Some(line) = scene.bodies[body].cable_mut() {
                line.fill_in(self.dimension);
            }
            scene.resolve().err().is_none_or(|other| {
                other != *error && !other.path.starts_with(&format!("bodies[{body}]"))
            })
        };
        let mut cables = (0..chosen.len()).filter(is_cable);
        cables.find(asks)
    }

    /// A body as a beam, where it may be one and is none.
    fn as_beam(&self, chosen: &[Chosen], place: usize) -> Option<LineBody> {
        let mut tried = chosen.to_vec();
        let of = &mut tried[place];
        if of.sections == LineModel::Reissner {
            return None;
        }
        (of.sections, of.beam) = (LineModel::Reissner, None);
        let scene = self.with_elements(&tried);
        scene.resolve().ok()?;
        scene.bodies[chosen[place].body].cable().cloned()
    }

    /// Names the part of the scene that demands the sections of a rod, by the path for which a cable is refused.
    fn asking(&self, path: &str) -> String {
        let (list, rest) = path.split_once('[').unwrap_or((path, ""));
        let index = rest.split(']').next().and_then(|text| text.parse().ok());
        let index: usize = index.unwrap_or(usize::MAX);
        let at = |marker: Option<&str>| marker.unwrap_or_default().to_owned();
        let loads = [
            ("loads", &self.loads[..]),
            ("initial.loads", self.initial.loads()),
        ];
        let load = loads.into_iter().find(|(name, _)| *name == list);
        let load = load.and_then(|(_, loads)| loads.get(index));
        let words = match list {
            "joints" => self.joints.get(index).map(|of| hold([&of.name])),
            "inputs" => (self.inputs.get(index))
                .and_then(Input::action)
                .map(|of| format!("an input at {} turns its sections", of.on)),
            "outputs" => (self.outputs.get(index))
                .map(|of| format!("an output at {} reads its sections", at(of.names()[0]))),
            "ports" => (self.ports.get(index)).map(|of| format!("port {} turns with it", of.name)),
            _ => load.map(|of| format!("load {} turns its sections", of.name)),
        };
        words.unwrap_or_else(|| format!("{path} asks for its sections"))
    }
}

fn hold<const N: usize>(joints: [&str; N]) -> String {
    let (many, verb) = if N == 1 { ("", "holds") } else { ("s", "hold") };
    format!(
        "joint{many} {} {verb} its orientation",
        joints.join(" and ")
    )
}

/// A cable that joints hold in how it stands about its tangent, where that lets torque through: between it and another body, or
/// at two places of it. One joint that holds it on the ground does not: no torque comes in at its other end, and a line that bends
/// alike to all sides does not twist then.
fn held(resolved: &Resolved<'_>, chosen: &[Chosen]) -> Option<(usize, String)> {
    if resolved.scene.dimension == 2 {
        return None;
    }
    let cables = chosen.iter().enumerate();
    let mut cables = cables.filter(|(_, of)| of.sections == LineModel::Cable);
    cables.find_map(|(place, of)| {
        let is_of = |place: &Place<'_>| place.body_index() == of.body;
        let joints = resolved.joints.iter().filter(|joint| {
            let is_held = |hold: &JointPrimitive| matches!(hold, JointPrimitive::Orientation(_));
            let ends = joint.ends.markers();
            joint.primitives.iter().any(is_held) && ends.into_iter().any(|end| is_of(&end.place))
        });
        let joints: Vec<_> = joints.collect();
        let is_ground = |first: &First<'_>| matches!(first, First::Ground(_));
        if let Some(joint) = joints.iter().find(|joint| !is_ground(&joint.ends.first)) {
            return Some((place, hold([joint.name])));
        }
        match joints[..] {
            [first, second, ..] => Some((place, hold([first.name, second.name]))),
            _ => None,
        }
    })
}

/// Adds to an error about a body the reason why the body became a rod or a beam.
fn with_reason(chosen: &[Chosen], mut error: Error) -> Error {
    let is_of = |of: &&Chosen| error.path.starts_with(&format!("bodies[{}]", of.body));
    let turned = chosen.iter().find(is_of);
    if let Some(of) = turned.filter(|of| of.sections != LineModel::Cable) {
        error.message += &format!(" (a {})", of.in_words());
    }
    error
}
