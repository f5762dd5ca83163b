//! A run in motion: as a page of its own, and as a section of the page that comes with a unit.

use super::canvas::escape;
use super::drawing::drawing;
use super::number::number;
use crate::scene::Scene;
use crate::simulation::InputTable;
use crate::view::{Limits, OutputTable, Recording, document, picture, picture_of_table};

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
        Some(_) => "Inputs move meanwhile as the scene says for planning.",
        None => "Inputs keep their start values meanwhile.",
    };
    let course = if scene.resolved().numbers > 0 {
        course
    } else {
        ""
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
                "<p>The default experiment. {course}{}</p>\n{figure}",
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
    document(&escape(&scene.name), &note, &picture(run, &drawing(scene)))
}

/// The page of a table of outputs.
pub fn moving_table(title: &str, table: &OutputTable) -> String {
    let note = "outputs alone: markers whose positions are among them";
    document(&escape(title), note, &picture_of_table(table, title))
}
