//! The program `flexbody`: packages, plans, simulates and shows scenes, and prints their schema.

use std::io::{self, Write};
use std::process::ExitCode;

use anyhow::{Context, Result};
use clap::{Parser, Subcommand};
use flexbody::scene::Scene;

mod containers;
mod describing;
mod files;
mod icon;
mod inputs;
mod merging;
mod packaging;
mod planning;
mod reading;
mod settings;
mod simulating;
mod stopwatch;
mod sweep;
mod viewing;

#[derive(Parser)]
#[command(
    version,
    about = "Flexible bodies as FMI co-simulation units: package, plan, simulate, view"
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Makes an FMU of a scene.
    Package(packaging::Package),
    /// Simulates a scene, or that in an FMU, and writes its outputs at every communication point as CSV.
    Simulate(simulating::Simulate),
    /// Finds elements, their numbers and a tolerance for the error that a scene asks for, and says why.
    Plan(planning::Planning),
    /// Shows a scene, the scene in an FMU or a table of outputs in motion: writes a page of HTML and opens it.
    View(viewing::View),
    /// Simulates a scene many times with other parameters: on all processors, or on a cluster.
    Sweep(sweep::Sweep),
    /// Joins two FMUs of one scene that were built for different platforms.
    Merge(merging::Merge),
    /// Writes what an FMU holds besides the library: model description, scene, documentation. Says what a file of a reduced model holds.
    Describe(describing::Describe),
    /// Prints the JSON Schema of a scene.
    Schema,
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Package(arguments) => packaging::package(&arguments),
        Command::Simulate(arguments) => simulating::simulate(&arguments),
        Command::Plan(arguments) => planning::plan(&arguments),
        Command::View(arguments) => viewing::view(&arguments),
        Command::Sweep(arguments) => sweep::sweep(&arguments),
        Command::Merge(arguments) => merging::merge(&arguments),
        Command::Describe(arguments) => describing::run(&arguments),
        Command::Schema => schema(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("flexbody: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn schema() -> Result<()> {
    let written = io::stdout().write_all(Scene::json_schema().as_bytes());
    written.context("standard output")
}
