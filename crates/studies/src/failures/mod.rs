//! Where methods fail: rows of a table, each measured when it is asked for, and held by a test beside it.

mod alpha;
mod cables;
mod communication;
mod constraints;
mod elimination;
mod locking;
mod plates;
mod ratios;
mod reduced;
mod rivals;
mod rods;
mod snap;
mod steps;
pub mod support;

use serde_json::{Value, json};

use crate::scene::Outcome;
use support::Row;

/// Arguments that select rows.
#[derive(clap::Args)]
pub struct Failures {
    /// Only rows with this in their name.
    #[arg(long, default_value = "")]
    only: String,
}

/// A row, by the name of its test.
type Measure = (&'static str, fn() -> Outcome<Row>);

const ROWS: &[Measure] = &[
    ("printed", elimination::printed),
    ("green", elimination::green),
    ("locking", locking::locking),
    ("no_mixed_derivative", plates::no_mixed_derivative),
    ("membrane_locking", plates::membrane_locking),
    ("thick_nodes", plates::thick_nodes),
    ("newton_of_plates", plates::newton_of_plates),
    ("held_at_a_point", plates::held_at_a_point),
    ("shear_locking", rivals::shear_locking),
    ("large_bending_by_modes", rivals::large_bending_by_modes),
    ("linear_frame", reduced::linear_frame),
    ("softening", rivals::softening),
    ("increments", rivals::increments),
    ("own_twist", rods::own_twist),
    ("internal_twist", rods::internal_twist),
    ("spin", rods::spin),
    ("directors", rods::directors),
    ("half_a_turn", rods::half_a_turn),
    ("right_angle", rods::right_angle),
    ("roll_up", snap::roll_up),
    ("slack", snap::slack),
    ("buckling", snap::buckling),
    ("under_load", snap::under_load),
    ("under_displacement", snap::under_displacement),
    ("beyond_stability", steps::beyond_stability),
    ("undamped_alpha", steps::undamped_alpha),
    ("trapezoidal", steps::trapezoidal),
    ("dead_centre", constraints::dead_centre),
    ("flat_position", constraints::flat_position),
    ("drift", constraints::drift),
    ("masses_and_lengths", ratios::masses_and_lengths),
    ("whip", cables::whip),
    ("taut", cables::taut),
    ("spaghetti", cables::spaghetti),
    ("communication_steps", communication::communication_steps),
    ("jumps", communication::jumps),
    ("tolerance", communication::tolerance),
];

/// Measures all rows and prints them as JSON.
pub fn failures(arguments: &Failures) -> Outcome<()> {
    let mut rows = Vec::new();
    for (name, measure) in ROWS {
        if name.contains(&arguments.only) {
            let row = measure().map_err(|error| format!("{name}: {error}"))?;
            rows.push(json!({
                "place": row.place,
                "method": row.method,
                "failing": row.failing.text,
                "product": row.product.text,
                "test": row.test,
            }));
        }
    }
    println!("{}", Value::from(rows));
    Ok(())
}

/// Tests that the rows name stand in this folder.
#[test]
fn rows_name_tests_that_exist() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/failures");
    let mut texts = String::new();
    for file in std::fs::read_dir(folder).expect("a folder") {
        texts += &std::fs::read_to_string(file.expect("a file").path()).expect("text");
    }
    for part in texts.split(" test: \"").skip(1) {
        let name = part.split('"').next().unwrap_or_default();
        assert!(
            texts.contains(&format!("#[test]\nfn {name}()")),
            "{name}: no such test"
        );
    }
}
