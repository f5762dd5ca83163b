//! A run in motion: as a page of its own, and as a section of the page that comes with a unit.

use super::canvas::escape;
use super::drawing::drawing;
use crate::scene::Scene;
use crate::scene::{number, rounded};
use crate::simulation::InputTable;
use crate::view::{HeldInput, Limits, OutputTable, Recording, document, picture, picture_of_table};

/// Comments around the section of a run in motion: it is that of the machine which made the page, the rest of the page is not.
const AROUND: [&str; 2] = ["<!-- motion begins -->\n", "<!-- motion ends -->\n"];

/// The default experiment in motion, as a section of a page; inputs follow a table where one is given. Where it cannot be shown, or not
/// to its end, a sentence says why. The same scene gives the same bytes on one machine.
pub fn motion(
    scene: &Scene,
    inputs: Option<&InputTable>,
    told: &mut dyn FnMut(u64, u64),
) -> String {
    let course = match inputs {
        Some(_) => " Inputs move meanwhile as the scene says for planning.",
        None => "",
    };
    let shown = match Recording::new(scene, inputs, &Limits::unit(scene.dimension), told) {
        Ok(run) => {
            let end = run.stopped().map(|reason| {
                let time = number(run.times().last().copied().unwrap_or_default());
                format!(" It is shown until {time} s: {}.", escape(reason))
            });
            let figure = format!(
                "<figure class=\"motion\">\n{}</figure>\n",
                picture(&run, "")
            );
            format!(
                "<p>The default experiment.{course}{}{}</p>\n{figure}",
                held_in_words(run.held()).map_or(String::new(), |held| format!(" {held}.")),
                end.unwrap_or_default()
            )
        }
        Err(reason) => format!(
            "<p>The default experiment is not shown: {}.</p>\n",
            escape(&reason)
        ),
    };
    format!("{}<h2>In motion</h2>\n{shown}{}", AROUND[0], AROUND[1])
}

/// The page of a run of a scene.
pub fn moving(scene: &Scene, run: &Recording) -> String {
    let end = run.times().last().copied().unwrap_or_default();
    let mut note = format!("{} s, {} frames", number(end), run.times().len());
    if let Some(reason) = run.stopped() {
        note += &format!("; the run ended there: {}", escape(reason));
    }
    if let Some(held) = held_in_words(run.held()) {
        note += &format!("<br>{}", escape(&held));
    }
    document(&escape(&scene.name), &note, &picture(run, &drawing(scene)))
}

/// Most inputs that are told one by one.
const MOST_INPUTS: usize = 6;

/// Inputs that nothing moves, with their values; components of a vector together. Nothing where there is none.
fn held_in_words(held: &[HeldInput]) -> Option<String> {
    let mut found: Vec<(&str, Vec<String>, &str)> = Vec::new();
    for input in held {
        let name = input.name.split('[').next().unwrap_or_default();
        match found.last_mut() {
            Some((last, values, _)) if *last == name => values.push(rounded(input.value)),
            _ => found.push((name, vec![rounded(input.value)], &input.unit)),
        }
    }
    let shown = found.iter().take(MOST_INPUTS);
    let mut texts: Vec<String> = shown
        .map(|(name, values, unit)| match &values[..] {
            [value] => format!("{name} = {value} {unit}"),
            values => format!("{name} = ({}) {unit}", values.join(", ")),
        })
        .map(|text| text.trim_end().to_owned())
        .collect();
    if let Some(others @ 1..) = found.len().checked_sub(MOST_INPUTS) {
        texts.push(format!("{others} more"));
    }
    (!texts.is_empty()).then(|| format!("Inputs held: {}", texts.join(", ")))
}

/// The page of a table of outputs.
pub fn moving_table(title: &str, table: &OutputTable) -> String {
    let note = "outputs alone: markers whose positions are among them";
    document(&escape(title), note, &picture_of_table(table, title))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_are_told_by_vectors_and_not_all_of_many() {
        let held = |names: &[&str]| -> Option<String> {
            let inputs = names.iter().map(|name| HeldInput {
                name: (*name).into(),
                value: 0.500_012,
                unit: "N".into(),
            });
            held_in_words(&inputs.collect::<Vec<_>>())
        };
        assert_eq!(held(&[]), None);
        let told = held(&["a.force[1]", "a.force[2]", "b.torque"]).expect("inputs");
        assert_eq!(
            told,
            "Inputs held: a.force = (0.5, 0.5) N, b.torque = 0.5 N"
        );
        let told = held(&["a", "b", "c", "d", "e", "f", "g", "h"]).expect("inputs");
        assert!(told.ends_with("f = 0.5 N, 2 more"), "{told}");
    }
}
