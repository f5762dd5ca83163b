//! The page that comes with a unit: what it simulates, its interface, and how to use it.

use super::canvas::escape;
use super::drawing::drawing;
use super::parts::parts;
use super::plan::plan;
use super::table::{code, row};
use crate::picture::{filled, palette};
use crate::scene::{Body, InitialState, Integrator, Model, Modes, Scene, Spin, Strain};
use crate::scene::{number, rounded};
use crate::simulation::{Causality, Planned, Variable, variables};

const PAGE: &str = include_str!("documentation.html");
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
    let [place, axes] = view(scene);
    let failures = interface.failures.iter();
    let categories = interface.categories.iter();
    let is_motion = |variable: &&Variable| !variable.acts_at_once();
    let motions = of(&variables, Causality::Input).filter(is_motion).count();
    let values = [
        ("name", escape(&scene.name)),
        ("style", palette::style_sheet() + STYLE),
        ("standard", interface.standard.into()),
        ("place", place.into()),
        ("bodies", bodies(scene)),
        ("axes", axes.into()),
        ("rotation", rotation(scene)),
        ("about", about(scene)),
        ("drawing", drawing(scene)),
        ("motion", motion.into()),
        ("integrator", integrator(scene).into()),
        ("start", start(scene).into()),
        ("rigid", rigid(scene)),
        ("strains", strains(scene)),
        ("plan", plan(planned)),
        ("parts", parts(scene)),
        ("parameters", parameters(&variables)),
        ("inputs", inputs(&variables)),
        ("inputs-in-steps", interface.inputs.into()),
        ("motions", if motions > 0 { " " } else { "" }.into()),
        ("outputs", outputs(&variables)),
        ("tolerance", number(scene.relative_tolerance())),
        ("takes-tolerance", interface.tolerance.into()),
        ("stop", number(scene.experiment.stop_time)),
        ("step", number(scene.experiment.step)),
        ("failures", failures.map(|cells| row(cells)).collect()),
        (
            "categories",
            categories
                .map(|[name, messages]| row(&[&code(name), messages]))
                .collect(),
        ),
        ("scene", escape(scene.to_json().trim_end())),
        ("version", env!("CARGO_PKG_VERSION").into()),
    ];
    filled(PAGE, &values)
}

/// Words for where a scene is, and for its axes.
fn view(scene: &Scene) -> [&'static str; 2] {
    match scene.dimension {
        2 => ["a planar scene", "x to the right and y upwards"],
        _ => [
            "a scene in space",
            "drawn with x to the right and front, y to the right and back, z upwards",
        ],
    }
}

fn bodies(scene: &Scene) -> String {
    let shown = scene.bodies.iter().take(MOST_BODIES).map(body_in_words);
    let mut bodies: Vec<String> = shown.collect();
    if let Some(others @ 1..) = scene.bodies.len().checked_sub(MOST_BODIES) {
        bodies.push(format!("and {others} more"));
    }
    bodies.join("; ")
}

/// A sentence about a rotating frame; nothing where it stands.
fn rotation(scene: &Scene) -> String {
    if !scene.turns() {
        return String::new();
    }
    let rate = match scene.rotation {
        Spin::Number(rate) => number(rate),
        Spin::Vector(rates) => format!("[{}]", rates.map(number).join(", ")),
    };
    format!(" The frame turns about the origin at {rate} rad/s; everything is seen from it.")
}

/// Whose model it is, where the scene says so.
fn about(scene: &Scene) -> String {
    let rows = scene.about.texts();
    let rows: Vec<String> = rows
        .map(|(key, text)| format!("<b>{key}</b> {}", escape(text)))
        .collect();
    rows.join("<br>\n")
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
                (Model::Modal, _) => {
                    let modes = cable.modes.unwrap_or_default();
                    return format!(
                        "the {kind} <em>{name}</em>, {length} m long, reduced to its static shapes and {modes} natural modes"
                    );
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
        Body::Reduced(reduced) => {
            let mass = rounded(reduced.contained().model.mass);
            let modes = match (reduced.modes, reduced.first_modes()) {
                (_, 0) => {
                    return format!(
                        "the rigid body <em>{name}</em> of {mass} kg, from a finite element model"
                    );
                }
                (Modes::FixedInterface(modes), _) => {
                    format!(
                        "static shapes and {}",
                        counted(modes.fixed_interface as usize)
                    )
                }
                (_, count) => counted(count),
            };
            format!("the finite element model <em>{name}</em> of {mass} kg, reduced to {modes}")
        }
        Body::Plate(patch) | Body::Shell(patch) => {
            let kind = if matches!(body, Body::Plate(_)) {
                "plate"
            } else {
                "shell"
            };
            let [n, m] = patch.mesh.counts;
            let lengths = patch.geometry().lengths.map(rounded);
            format!(
                "the {kind} <em>{name}</em>, {} m by {} m, of {n} by {m} elements",
                lengths[0], lengths[1]
            )
        }
    }
}

/// A number of modes in words.
fn counted(modes: usize) -> String {
    match modes {
        1 => "1 mode".into(),
        count => format!("{count} modes"),
    }
}

fn integrator(scene: &Scene) -> &'static str {
    match scene.method.integrator {
        Integrator::Auto => {
            "an explicit method or Radau IIA of order 5, whichever gets further with the same work while it runs"
        }
        Integrator::Radau => "Radau IIA of order 5, implicit",
        Integrator::Rk4 => "Runge-Kutta of order 4, explicit",
        Integrator::Dopri853 => "Runge-Kutta of Dormand and Prince of order 8, explicit",
        Integrator::Verlet => "velocity Verlet of order 2, explicit",
        Integrator::Rkn43 => "Runge-Kutta-Nystrom of order 4, explicit",
        Integrator::Rkn64 => "Runge-Kutta-Nystrom of order 6, explicit",
    }
}

fn start(scene: &Scene) -> &'static str {
    match scene.initial.state() {
        InitialState::Undeformed => {
            "the bodies as described, moved and deformed as far as their joints ask for"
        }
        InitialState::StaticEquilibrium => {
            "the equilibrium under gravity, loads and the inputs of initialization"
        }
        InitialState::Steady => "the equilibrium in the steady motion that all bodies start with",
    }
}

/// Names of cables that do not bend.
fn rigid(scene: &Scene) -> String {
    let cables = scene.bodies.iter().filter_map(Body::cable);
    let names: Vec<String> = cables
        .filter(|cable| cable.model == Model::Rigid)
        .map(|cable| code(&cable.name))
        .collect();
    names.join(", ")
}

/// Rows of strain measures, each once.
fn strains(scene: &Scene) -> String {
    let mut strains: Vec<&str> = Vec::new();
    for cable in scene.bodies.iter().filter_map(Body::flexible) {
        let strain = strain_in_words(cable.strain);
        if !strains.contains(&strain) {
            strains.push(strain);
        }
    }
    let rows = strains.iter();
    rows.map(|strain| row(&["Strain measure", strain]))
        .collect()
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
    rows.collect()
}

fn inputs(variables: &[Variable]) -> String {
    let rows = of(variables, Causality::Input).map(|variable| {
        let start = variable.start.map(number).unwrap_or_default();
        row(&[
            &code(&variable.name),
            &unit(variable),
            &start,
            &meaning(variable),
        ])
    });
    rows.collect()
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
    rows.collect()
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
