//! What the charts compare the product with: integrators and formulations that did not win.
//! `cargo xtask chart` calls this program as it calls `flexbody`; nothing here is in an FMU.

mod accelerate;
#[cfg(test)]
mod cases;
mod dynamics;
mod elements;
mod failures;
mod formulations;
mod integrate;
mod integrators;
#[cfg(test)]
mod laws;
mod outputs;
mod overhead;
mod plates;
mod rivals;
mod rods;
mod scene;
mod space;
mod statics;
mod swing;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[derive(Parser)]
#[command(version, about = "Methods to compare with")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Times one acceleration of a chain in a named formulation.
    Accelerate(accelerate::Accelerate),
    /// Times one acceleration of a scene in space in the product.
    Dynamics(dynamics::Dynamics),
    /// Measures where methods fail and what the product does there.
    Failures(failures::Failures),
    /// Integrates a scene with a named method.
    Integrate(integrate::Integrate),
    /// Measures the formulations that the report argues against, and the product beside them.
    Rivals(rivals::Rivals),
    /// Moves one rod in a named discretization.
    Space(space::Space),
    /// Times the static equilibrium of a scene in space in the product.
    Statics(statics::Statics),
    /// Lets a pinned rod fall in a named formulation.
    Swing(swing::Swing),
    /// Bends one rod in a named discretization.
    Bend(space::Bend),
    /// Measures what a unit costs besides its solver.
    Overhead(overhead::Overhead),
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Swing(arguments) => swing::swing(&arguments),
        Command::Accelerate(arguments) => accelerate::accelerate(&arguments),
        Command::Dynamics(arguments) => dynamics::dynamics(&arguments),
        Command::Failures(arguments) => failures::failures(&arguments),
        Command::Integrate(arguments) => integrate::integrate(&arguments),
        Command::Rivals(arguments) => rivals::rivals(&arguments),
        Command::Space(arguments) => space::space(&arguments),
        Command::Statics(arguments) => statics::statics(&arguments),
        Command::Bend(arguments) => space::bend(&arguments),
        Command::Overhead(arguments) => overhead::overhead(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("studies: {message}");
            ExitCode::FAILURE
        }
    }
}
