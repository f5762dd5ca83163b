//! What was planned, and why.

use super::outputs::RelativeTo;

/// Remark on a plan that used up its budget.
const CUT: &str = "planning took all the work it may (`--budget`): this is the best plan so far";

/// Where the numbers of a planned scene come from.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Error wanted.
    pub error: f64,
    /// Bodies in the order of the scene.
    pub bodies: Vec<PlannedBody>,
    /// Tolerance chosen.
    pub tolerance: f64,
    /// Integrator at the end of the experiment.
    pub method: &'static str,
    /// Inputs that kept their start values; meshes were compared by the linear answers to them.
    pub held: Vec<String>,
    /// Relative changes on doubling the mesh, by name: of these answers, and of the natural frequencies that the
    /// communication step resolves.
    pub answers: Vec<(String, f64)>,
    /// Outputs that count.
    pub outputs: Vec<PlannedOutput>,
    /// The choice, and the next cheaper and dearer ones, where they were run.
    pub chosen: Option<Price>,
    /// See `chosen`.
    pub cheaper: Option<Price>,
    /// See `chosen`.
    pub dearer: Option<Price>,
    /// Proposal of axial damping for forces that do not converge.
    pub settled: Option<Settled>,
    /// Plates and shells whose meshes are as fine as they may be, in words.
    pub(super) at_bound: Vec<String>,
    /// Whether the work that planning may cost ended before the plan was found: it is the best so far.
    pub is_cut: bool,
    /// Runs that were made, and what they cost together, in runs with the choice.
    pub runs: usize,
    /// See `runs`.
    pub runs_cost: f64,
}

/// Model that was planned for a body.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedBody {
    /// Name of the body.
    pub name: String,
    /// `cable`, `rod`, `beam`, `plate`, `shell`, `reduced`, `modal` or `rigid`.
    pub kind: &'static str,
    /// Number of elements, where it bends; of natural modes with held interfaces, where it is a line that is reduced to modes, or reduced and
    /// their number was open.
    pub elements: Option<u32>,
    /// Numbers of elements of a plate or shell along `s1` and `s2`.
    pub mesh: Option<[u32; 2]>,
    /// The fewest that a cable can have, or is given.
    pub fewest: Option<u32>,
    /// Why.
    pub why: String,
}

/// Planned accuracy of an output.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedOutput {
    /// Name of the output without an index.
    pub name: String,
    /// Error estimated over the experiment, relative.
    pub error: f64,
    /// Reference size of relative errors, in the unit of the output.
    pub scale: f64,
    /// Origin of the reference size.
    pub relative_to: RelativeTo,
    /// Whether the first instant is left out.
    pub skips_start: bool,
    /// Whether the error wanted is kept.
    pub settles: Settles,
}

/// Whether an output keeps the error wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Settles {
    /// Over the whole experiment.
    Yes,
    /// Up to this time, s.
    Until(f64),
    /// Not at all.
    No,
}

/// Effect of `"axial": "critically_damped"` on forces that do not converge. It is proposed and never chosen, because it
/// changes the physics.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    /// Names of the cables.
    pub bodies: Vec<String>,
    /// Forces that it changes by more than the error wanted: name, what it changes, and what doubling changes then, relative;
    /// nothing where that is not known.
    pub forces: Vec<(String, f64, Option<f64>)>,
    /// Price of a plan with this damping.
    pub price: Price,
}

/// Price of a choice of mesh and tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Price {
    /// Elements of every line, and modes of every reduced body whose number of modes was open.
    pub elements: Vec<u32>,
    /// Numbers of elements of every plate and shell along `s1` and `s2`.
    pub meshes: Vec<[u32; 2]>,
    /// Tolerance.
    pub tolerance: f64,
    /// Work (operations times parts) in a second of simulated time.
    pub work: f64,
    /// Largest error estimated; nothing where it is not known.
    pub error: Option<f64>,
}

/// Time of an operation on a part, s: an explicit evaluation of an element on a processor of 2024.
const OPERATION: f64 = 36e-9;

impl Plan {
    /// Summarizes the choice and its criterion in one line.
    pub fn in_a_line(&self) -> String {
        let body = |body: &PlannedBody| match body.elements {
            None if body.mesh.is_some() => {
                let mesh = body.count_in_words();
                format!("{} {} with {mesh} elements", body.name, body.kind)
            }
            Some(count) => format!("{} {} with {count} {}", body.name, body.kind, body.parts()),
            None => format!("{} {}", body.name, body.kind),
        };
        let bodies = self.bodies.iter();
        let bodies = bodies.filter(|body| body.fewest.is_some() || body.mesh.is_some());
        let bodies: Vec<String> = bodies.map(body).collect();
        let bodies = if bodies.is_empty() {
            String::new()
        } else {
            format!("{}, ", bodies.join(", "))
        };
        let held = if self.held.is_empty() {
            String::new()
        } else {
            format!(
                "; inputs held at their start values: {} (the mesh follows from the linear answers to them)",
                self.held.join(", ")
            )
        };
        format!(
            "planned for an error of {:e}: {bodies}relative tolerance {:e}{held}",
            self.error, self.tolerance
        )
    }

    /// Returns the remark that planning used up its budget. `None` if it did not.
    pub fn cut(&self) -> Option<&'static str> {
        self.is_cut.then_some(CUT)
    }

    /// Plates and shells whose meshes could not be finer, one sentence each, where that keeps the plan from its error.
    pub fn bounds(&self) -> &[String] {
        let is_kept = self.outputs.iter().all(|of| of.settles == Settles::Yes)
            && self.answers.iter().all(|(_, error)| *error <= self.error);
        if is_kept { &[] } else { &self.at_bound }
    }

    /// Lists the promises that the plan does not keep, one sentence each.
    pub fn missed(&self) -> Vec<String> {
        let wanted = self.error;
        let outputs = self.outputs.iter().filter(|of| of.settles != Settles::Yes);
        let outputs = outputs.map(|output| {
            let until = match output.settles {
                Settles::Until(time) => format!("; it is kept until {time:.3} s"),
                _ => String::new(),
            };
            let error = output.error_in_words();
            format!(
                "{}: the error of the plan is {error}, {wanted:e} is wanted{until}",
                output.name
            )
        });
        let answers = self.answers.iter().filter(|(_, error)| *error > wanted);
        let answers = answers.map(|(name, error)| {
            let error = in_words(*error);
            format!("{name}: twice the mesh changes it by {error}, {wanted:e} is wanted")
        });
        let cut = self.cut().map(str::to_owned);
        let mut told: Vec<String> = outputs.chain(answers).chain(cut).collect();
        told.extend(self.bounds().iter().cloned());
        told
    }

    /// Outputs that were measured by another size than their own largest change, a sentence each.
    pub fn measured_otherwise(&self) -> Vec<String> {
        let others = self.outputs.iter().filter_map(|output| {
            let by = match output.relative_to {
                RelativeTo::Own => return None,
                RelativeTo::Body => {
                    "a thousandth of the largest change of like outputs of its body"
                }
                RelativeTo::Scene => "a thousandth of what is natural in the scene",
                RelativeTo::Eigenvalue => {
                    return Some(format!(
                        "{}: it is nearly zero, its error is relative to a thousandth of the size of its eigenvalue, at least of 1 / stop time",
                        output.name
                    ));
                }
            };
            Some(format!(
                "{}: it hardly changes, its error is relative to {by}",
                output.name
            ))
        });
        others.collect()
    }

    /// The choices by name, from cheap to dear, those that were run.
    pub fn prices(&self) -> impl Iterator<Item = (&'static str, &Price)> {
        let all = [
            ("cheaper", &self.cheaper),
            ("chosen", &self.chosen),
            ("dearer", &self.dearer),
        ];
        all.into_iter()
            .filter_map(|(name, price)| Some((name, price.as_ref()?)))
    }
}

impl Settled {
    /// The proposal in words.
    pub fn in_words(&self) -> String {
        let forces = self.forces.iter().map(|(name, change, error)| {
            let error = error.map_or(String::new(), |error| {
                format!(", which is then known to {}", in_words(error))
            });
            format!("{name} by {}{error}", in_words(*change))
        });
        format!(
            "Forces oscillate with axial vibrations. \"axial\": \"critically_damped\" of {} would change {}, at about {:.2} ms a second",
            self.bodies.join(", "),
            forces.collect::<Vec<_>>().join("; "),
            self.price.milliseconds()
        )
    }
}

impl PlannedBody {
    /// The parts that the number of the body counts.
    pub fn parts(&self) -> &'static str {
        match self.kind {
            "reduced" | "modal" => "fixed-interface modes",
            _ => "elements",
        }
    }

    /// The number of the body in a column of elements; of modes, with that word.
    pub fn count_in_words(&self) -> String {
        let has_modes = ["reduced", "modal"].contains(&self.kind);
        match self.elements {
            None if self.mesh.is_some() => self.mesh.map(mesh_in_words).unwrap_or_default(),
            Some(1) if has_modes => "1 mode".into(),
            Some(count) if has_modes => format!("{count} modes"),
            count => count.map_or(String::new(), |count| count.to_string()),
        }
    }
}

impl PlannedOutput {
    /// The error in words.
    pub fn error_in_words(&self) -> String {
        in_words(self.error)
    }
}

impl Price {
    /// Elements of all bodies in words.
    pub fn elements_in_words(&self) -> String {
        let elements = self.elements.iter().map(u32::to_string);
        let elements = elements.chain(self.meshes.iter().copied().map(mesh_in_words));
        elements.collect::<Vec<_>>().join(", ")
    }

    /// The error in words; none where it is not known.
    pub fn error_in_words(&self) -> String {
        self.error.map(in_words).unwrap_or_default()
    }

    /// Estimates the time for a second of simulated time, ms. It is counted, not measured.
    pub fn milliseconds(&self) -> f64 {
        1e3 * OPERATION * self.work
    }
}

fn mesh_in_words([n, m]: [u32; 2]) -> String {
    format!("{n} x {m}")
}

fn in_words(error: f64) -> String {
    if error.is_finite() {
        format!("{error:.1e}")
    } else {
        "not known".into()
    }
}
