//! Where the numbers of a planned scene come from, as tables of the page.

use super::canvas::escape;
use super::table::{code, row, table};
use crate::scene::Chosen;
use crate::scene::number;
use crate::simulation::{Damped, Plan, Planned, Settles};

/// The sections; nothing of a scene that was not planned.
pub fn plan(planned: &Planned) -> String {
    elements(&planned.elements)
        + &damping(&planned.damping)
        + &planned.numbers.as_ref().map(numbers).unwrap_or_default()
}

/// Elements that were chosen.
fn elements(chosen: &[Chosen]) -> String {
    let rows = chosen
        .iter()
        .map(|of| row(&[&code(&of.name), of.element(), &escape(&of.why)]));
    let note = "<p>A cable is enough where nothing asks how its sections stand, a rod where shear moves no output by more than the \
        error wanted.</p>\n";
    if chosen.is_empty() {
        String::new()
    } else {
        table(
            "Elements that were chosen",
            note,
            &["Body", "Element", "Why"],
            rows.collect(),
        )
    }
}

/// Damping times that were made of damping ratios.
fn damping(damped: &[Damped]) -> String {
    let rows = damped.iter().map(|of| {
        let [ratio, frequency, share, time] =
            [of.ratio, of.frequency, of.share, of.time].map(number);
        row(&[&code(&of.name), &ratio, &frequency, &share, &time])
    });
    let note = "<p>A body that a damping ratio is written of has the Kelvin-Voigt time that gives this ratio to the first mode \
        about the start in which at least half of the energy is strain of the body.</p>\n";
    if damped.is_empty() {
        String::new()
    } else {
        table(
            "Damping by ratios",
            note,
            &[
                "Body",
                "Damping ratio",
                "Frequency of the mode, rad/s",
                "Strain of the body in its energy",
                "Damping time, s",
            ],
            rows.collect(),
        )
    }
}

fn numbers(plan: &Plan) -> String {
    let note = format!(
        "<p>Numbers of elements and the tolerance were found while packaging, for an error of {} in the default experiment, relative \
         to the largest change of each output: what twice as many elements and a tenth of the tolerance change is told below.{} {} runs \
         were made, which cost {:.1} times one with the choice.</p>\n",
        number(plan.error),
        held(plan),
        plan.runs,
        plan.runs_cost
    );
    let rows = plan.bodies.iter().map(|body| {
        let count = body.count_in_words();
        row(&[&code(&body.name), body.kind, &count, &escape(&body.why)])
    });
    let bodies = table(
        "Numbers that were planned",
        &note,
        &["Body", "Kind", "Elements", "Why"],
        rows.collect(),
    );
    let time = format!(
        "<p>Relative tolerance {}, integrator {} at the end of the experiment.</p>\n",
        number(plan.tolerance),
        code(plan.method)
    );
    let settled = plan.settled.as_ref();
    let settled = settled.map(|settled| format!("<p>{}.</p>\n", escape(&settled.in_words())));
    bodies + &time + &outputs(plan) + &settled.unwrap_or_default() + &costs(plan)
}

fn held(plan: &Plan) -> String {
    if plan.held.is_empty() {
        String::new()
    } else {
        let names: Vec<String> = plan.held.iter().map(|name| code(name)).collect();
        format!(
            " Inputs that kept their start values, by whose linear answers meshes were compared: {}.",
            names.join(", ")
        )
    }
}

fn outputs(plan: &Plan) -> String {
    let rows = plan.outputs.iter().map(|output| {
        let settles = match output.settles {
            Settles::Yes => "kept".into(),
            Settles::Until(time) => missed(&format!("kept until {} s", number(time))),
            Settles::No => missed("does not settle"),
        };
        row(&[&code(&output.name), &output.error_in_words(), &settles])
    });
    let heads = ["Output", "Error estimated", "Error wanted"];
    let note: String = (plan.missed().iter())
        .map(|sentence| format!("<p>{}.</p>\n", missed(&escape(sentence))))
        .collect();
    table("Errors estimated", &note, &heads, rows.collect())
}

/// Lists what a plan does not keep, in red.
fn missed(text: &str) -> String {
    format!("<strong style=\"color: var(--warning)\">{text}</strong>")
}

fn costs(plan: &Plan) -> String {
    let rows = plan.prices().map(|(name, price)| {
        row(&[
            name,
            &price.elements_in_words(),
            &format!("{:.2}", price.milliseconds()),
            &price.error_in_words(),
        ])
    });
    let heads = [
        "Choice",
        "Elements",
        "Milliseconds a second, about",
        "Largest error estimated",
    ];
    table("Cost", "", &heads, rows.collect())
}
