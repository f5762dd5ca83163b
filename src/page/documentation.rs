//! The page that comes with a unit: what it simulates, its interface, and how to use it.

use super::canvas::escape;
use super::drawing::drawing;
use super::number::{number, rounded};
use super::parts::parts;
use super::plan::plan;
use super::table::{code, row, table};
use crate::picture::palette;
use crate::scene::{Body, InitialState, Integrator, Model, Scene, Spin, Strain};
use crate::simulation::{Causality, Planned, Variable, variables};

const STYLE: &str = include_str!("documentation.css");

/// Texts of the page in the words of a standard. Texts are HTML.
pub struct Interface<'a> {
    /// Name and version of the standard.
    pub standard: &'a str,
    /// How an input moves during a step, where the standard can say more than its value.
    pub inputs: &'a str,
    /// The function that takes a tolerance.
    pub tolerance: &'a str,
    /// Rows of what can fail: status, meaning, remedy.
    pub failures: &'a [[&'a str; 3]],
    /// Log categories: name, what is logged.
    pub categories: &'a [[&'a str; 2]],
}

/// The documentation of a scene, of how it was planned, and of it in motion ([`super::motion`]; nothing where it stands still), as one HTML
/// page. The same gives the same bytes.
pub fn documentation(
    scene: &Scene,
    planned: &Planned,
    motion: &str,
    interface: &Interface<'_>,
) -> String {
    let variables = variables(scene);
    let sections = [
        summary(scene, interface.standard),
        format!("<figure>\n{}</figure>\n", drawing(scene)),
        motion.into(),
        model(scene),
        plan(planned),
        parts(scene),
        parameters(&variables),
        inputs(&variables, interface.inputs),
        outputs(&variables),
        usage(scene, interface.tolerance),
        statuses(interface.failures),
        categories(interface.categories),
        format!(
            "<h2>Scene</h2>\n<pre>{}</pre>\n",
            escape(scene.to_json().trim_end())
        ),
    ];
    let title = escape(&scene.name);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{}{STYLE}</style>\n</head>\n<body>\n<main>\n{}\
         <footer>Written by Flexbody {}; \
         <a href=\"licenses/license.txt\">licenses</a> of what this FMU holds.</footer>\n</main>\n</body>\n</html>\n",
        palette::style_sheet(),
        sections.concat(),
        env!("CARGO_PKG_VERSION")
    )
}

fn turning(rate: &str) -> String {
    format!(" The frame turns about the origin at {rate} rad/s; everything is seen from it.")
}

fn summary(scene: &Scene, standard: &str) -> String {
    let shown = scene.bodies.iter().take(MOST_BODIES).map(body_in_words);
    let mut bodies: Vec<String> = shown.collect();
    if let Some(others @ 1..) = scene.bodies.len().checked_sub(MOST_BODIES) {
        bodies.push(format!("and {others} more"));
    }
    let frame = match (scene.turns(), scene.rotation) {
        (false, _) => String::new(),
        (true, Spin::Number(rate)) => turning(&number(rate)),
        (true, Spin::Vector(rates)) => turning(&format!("[{}]", rates.map(number).join(", "))),
    };
    let (place, axes) = match scene.dimension {
        2 => ("a planar scene", "x to the right and y upwards"),
        _ => (
            "a scene in space",
            "drawn with x to the right and front, y to the right and back, z upwards",
        ),
    };
    format!(
        "<h1>{}</h1>\n<p>A co-simulation unit ({standard}) of {place}: {}. All quantities are \
         in SI units, angles in rad, vectors in global axes, {axes}.{frame}</p>\n",
        escape(&scene.name),
        bodies.join("; ")
    ) + &about(scene)
}

/// Whose model it is, where the scene says so.
fn about(scene: &Scene) -> String {
    let rows = scene.about.texts();
    let rows: Vec<String> = rows
        .map(|(key, text)| format!("<b>{key}</b> {}", escape(text)))
        .collect();
    if rows.is_empty() {
        String::new()
    } else {
        format!("<p>{}</p>\n", rows.join("<br>\n"))
    }
}

/// Most bodies that are told one by one.
const MOST_BODIES: usize = 12;

fn body_in_words(body: &Body) -> String {
    let name = escape(body.name());
    match body {
        Body::Cable(cable) | Body::Rod(cable) | Body::Beam(cable) | Body::Auto(cable) => {
            let length = rounded(cable.shape.length());
            let kind = cable.sections.element();
            let elements = match (cable.model, cable.elements) {
                (Model::Rigid, _) => {
                    return format!("the rigid rod <em>{name}</em>, {length} m long");
                }
                (_, None) => "elements still to be counted".into(),
                (_, Some(1)) => format!("1 {kind} element"),
                (_, Some(count)) => format!("{count} {kind} elements"),
            };
            format!("the flexible body <em>{name}</em>, {length} m long, of {elements}")
        }
        Body::Rigid(rigid) => {
            let kind = if rigid.inertia().is_some() {
                "rigid body"
            } else {
                "particle"
            };
            format!("the {kind} <em>{name}</em> of {} kg", rounded(rigid.mass()))
        }
    }
}

fn model(scene: &Scene) -> String {
    let formulation = "joints that are linear in the coordinates are eliminated by QR factorizations and the \
                       mass by its Cholesky factor: they hold exactly, and the inertia is the identity";
    let integrator = match scene.method.integrator {
        Integrator::Auto => {
            "an explicit method or Radau IIA of order 5, whichever gets further with the same work while it runs"
        }
        Integrator::Radau => "Radau IIA of order 5, implicit",
        Integrator::Rk4 => "Runge-Kutta of order 4, explicit",
        Integrator::Dopri853 => "Runge-Kutta of Dormand and Prince of order 8, explicit",
        Integrator::Verlet => "velocity Verlet of order 2, explicit",
        Integrator::Rkn43 => "Runge-Kutta-Nystrom of order 4, explicit",
        Integrator::Rkn64 => "Runge-Kutta-Nystrom of order 6, explicit",
    };
    let initial = match scene.initial.state() {
        InitialState::Undeformed => {
            "the bodies as described, moved and deformed as far as their joints ask for"
        }
        InitialState::StaticEquilibrium => {
            "the equilibrium under gravity, loads and the inputs of initialization"
        }
        InitialState::Steady => "the equilibrium in the steady motion that all bodies start with",
    };
    let constraints = "multipliers for those that are not linear; positions and velocities are projected \
                       after every step";
    let mut strains: Vec<&str> = Vec::new();
    for cable in scene.bodies.iter().filter_map(Body::flexible) {
        let strain = strain_in_words(cable.strain);
        if !strains.contains(&strain) {
            strains.push(strain);
        }
    }
    let mut rows = vec![
        row(&[
            "Coordinates",
            "of cables absolute nodal ones: positions and slopes, no rotations; of rigid bodies \
             natural ones: the centre of mass and a unit vector",
        ]),
        row(&["Formulation", formulation]),
        row(&["Constraints", constraints]),
        row(&["Integrator", integrator]),
        row(&["Start", initial]),
    ];
    rows.extend(rigid_in_words(scene).map(|cables| row(&["Rigid cables", &cables])));
    rows.extend(
        strains
            .iter()
            .map(|strain| row(&["Strain measure", strain])),
    );
    format!(
        "<h2>Model</h2>\n<table class=\"facts\">\n{}</table>\n",
        rows.concat()
    )
}

/// Cables that do not bend, if there are any.
fn rigid_in_words(scene: &Scene) -> Option<String> {
    let cables = scene.bodies.iter().filter_map(Body::cable);
    let names: Vec<String> = cables
        .filter(|cable| cable.model == Model::Rigid)
        .map(|cable| code(&cable.name))
        .collect();
    (!names.is_empty()).then(|| {
        let names = names.join(", ");
        format!("{names}: uniform rods; axial forces and bending moments balance what acts on them with their inertia")
    })
}

fn strain_in_words(strain: Strain) -> &'static str {
    match strain {
        Strain::ThetaPrime => {
            "thetaPrime: stretch |r'| - 1 and rotation per reference length, as in geometrically \
             exact beam theory"
        }
        Strain::GreenLagrangeFrenetKappa => {
            "GreenLagrange_FrenetKappa: Green-Lagrange axial strain and curvature of the deformed \
             line"
        }
        Strain::EngStrainFrenetKappa => {
            "engStrain_FrenetKappa: stretch |r'| - 1 and curvature of the deformed line"
        }
    }
}

fn parameters(variables: &[Variable]) -> String {
    let rows = of(variables, Causality::Parameter).map(|variable| {
        let start = variable.start.map(number).unwrap_or_default();
        row(&[
            &code(&variable.name),
            &unit(variable),
            &start,
            &range(variable),
            &meaning(variable),
        ])
    });
    let heads = ["Name", "Unit", "Start", "Range", "Meaning"];
    table("Parameters", "", &heads, rows.collect())
}

fn inputs(variables: &[Variable], course: &str) -> String {
    let rows = of(variables, Causality::Input).map(|variable| {
        let start = variable.start.map(number).unwrap_or_default();
        row(&[
            &code(&variable.name),
            &unit(variable),
            &start,
            &meaning(variable),
        ])
    });
    let is_motion = |variable: &Variable| !variable.acts_at_once();
    let motions = if of(variables, Causality::Input).any(is_motion) {
        " A driven motion never jumps: during a step it moves smoothly from where it is to where \
         its inputs, continued with the derivatives given, are at the end of the step."
    } else {
        ""
    };
    let note = format!(
        "<p>An input keeps its value during a communication step and may jump between two. \
         {course}{motions}</p>\n"
    );
    table(
        "Inputs",
        &note,
        &["Name", "Unit", "Start", "Meaning"],
        rows.collect(),
    )
}

fn outputs(variables: &[Variable]) -> String {
    let follows_inputs = |output: &Variable| variables.iter().any(|v| output.depends_on(v));
    let rows = variables.iter().filter_map(|variable| {
        let follows = match (Causality::of(variable), follows_inputs(variable)) {
            (Causality::Output, true) => "state and inputs",
            (Causality::Output, false) => "state",
            (Causality::CalculatedParameter, _) => "parameters",
            _ => return None,
        };
        Some(row(&[
            &code(&variable.name),
            &unit(variable),
            follows,
            &meaning(variable),
        ]))
    });
    table(
        "Outputs",
        "",
        &["Name", "Unit", "Follows from", "Meaning"],
        rows.collect(),
    )
}

fn usage(scene: &Scene, takes_tolerance: &str) -> String {
    let tolerance = number(scene.relative_tolerance());
    let (stop, step) = (
        number(scene.experiment.stop_time),
        number(scene.experiment.step),
    );
    format!(
        "<h2>How to use it</h2>\n<ul>\n\
         <li><strong>Accuracy is set by a tolerance, not by the step.</strong> \
         <code>relative_tolerance</code> (here {tolerance}) bounds the error in time of a step of \
         the solver, relative to the size of the scene. A tolerance in \
         <code>{takes_tolerance}</code> replaces it. The error of the mesh is another matter: it \
         falls with <code>elements</code>.</li>\n\
         <li><strong>A communication step may have any positive length.</strong> Within it the \
         solver takes the steps that the tolerance asks for. The default experiment is {stop} s \
         in steps of {step} s.</li>\n\
         <li><strong>Parameters</strong> may be set until initialization ends, the number of \
         elements included. <strong>Inputs</strong> may be set then and between steps; outputs \
         answer to new inputs at once.</li>\n\
         <li><strong>Derivatives</strong> of outputs in time, of order 1 and 2, and directional \
         derivatives of outputs by inputs are exact at every communication point and disturb \
         nothing. Higher orders are answered by zero.</li>\n\
         <li><strong>A state</strong> can be saved, restored and serialized at any time between \
         two calls; the simulation goes on from it bit for bit. Bytes that are damaged, or of \
         another model, are refused.</li>\n\
         <li><strong>Instances</strong> are independent of each other: many of them may run in \
         one process, each in a thread of its own.</li>\n</ul>\n"
    )
}

fn statuses(failures: &[[&str; 3]]) -> String {
    let heads = ["Status", "Meaning", "What to do"];
    let rows = failures.iter().map(|cells| row(cells));
    table("When something fails", "", &heads, rows.collect())
}

fn categories(categories: &[[&str; 2]]) -> String {
    let rows = categories
        .iter()
        .map(|[name, messages]| row(&[&code(name), messages]));
    table("Log categories", "", &["Name", "Messages"], rows.collect())
}

fn of(variables: &[Variable], causality: Causality) -> impl Iterator<Item = &Variable> {
    variables
        .iter()
        .filter(move |variable| Causality::of(variable) == causality)
}

fn unit(variable: &Variable) -> String {
    variable.unit.map_or(String::new(), |unit| unit.symbol())
}

fn meaning(variable: &Variable) -> String {
    escape(&variable.description)
}

fn range(variable: &Variable) -> String {
    match variable.limits() {
        (Some(min), Some(max)) => format!("{} to {}", number(min), number(max)),
        (Some(min), None) => format!("from {}", number(min)),
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::example;

    const INTERFACE: Interface<'_> = Interface {
        standard: "FMI",
        inputs: "It keeps it.",
        tolerance: "setUp",
        failures: &[["Error", "a call out of order", "correct it"]],
        categories: &[["logEvents", "course of the simulation"]],
    };

    #[test]
    fn the_page_names_every_variable_and_shows_the_scene() {
        let scene = example();
        let page = documentation(&scene, &Planned::default(), "", &INTERFACE);
        for variable in variables(&scene)
            .iter()
            .filter(|variable| variable.name != "time")
        {
            assert!(page.contains(&code(&variable.name)), "{}", variable.name);
        }
        assert!(page.contains("<svg") && page.contains("&quot;name&quot;: &quot;example&quot;"));
        assert_eq!(
            page,
            documentation(&scene, &Planned::default(), "", &INTERFACE)
        );
        assert!(!page.contains("Rigid cables"));
    }

    #[test]
    fn the_page_says_which_cables_are_rigid_and_draws_them() {
        let text = r#"{ "name": "one", "dimension": 2,
          "bodies": [ { "name": "rod", "element": "cable", "model": "rigid",
            "material": { "youngs_modulus": 7.0e5, "density": 5540.0 },
            "section": { "area": 1.8e-3, "second_moment": 1.215e-8 },
            "shape": { "line": { "from": [0.0, 0.0], "to": [1.2, 0.0] } },
            "markers": { "middle": 0.5 } } ],
          "outputs": [ { "kind": "bending_moment", "marker": "rod.middle" } ] }"#;
        let scene = Scene::from_json(text).expect("a valid scene");
        let page = documentation(&scene, &Planned::default(), "", &INTERFACE);
        for told in [
            "the rigid rod <em>rod</em>, 1.2 m long",
            "Rigid cables",
            ">rod</text>",
            "rod.density",
            "rod.middle.bending_moment",
        ] {
            assert!(page.contains(told), "{told}");
        }
        assert!(!page.contains("Strain measure") && !page.contains("rod.youngs_modulus"));
    }
}
