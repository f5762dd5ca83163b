//! Commands of the project: `cargo xtask help` lists them.

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use fmu_package::Platform;

mod anonymous;
mod assembly;
mod cargo;
mod chart;
mod demo;
mod describe;
mod example_fmus;
mod exports;
mod fuzz;
mod licenses;
mod linker;
mod package;
mod passed;
mod process;
mod product;
mod python;
mod simulate;
mod table;
mod test;
mod view_bundle;
mod wheel;

#[derive(Parser)]
#[command(
    name = "cargo xtask",
    bin_name = "cargo xtask",
    version,
    about = "Commands of the project"
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Makes an FMU of a scene
    Package {
        /// The scene
        #[arg(value_name = "SCENE.json")]
        scene: PathBuf,
        /// Where to write [default: target/fmu/<scene name>.fmu]
        #[arg(long, value_name = "FILE.fmu")]
        output: Option<PathBuf>,
        /// Platforms of the FMU [default: platforms like this one]
        #[arg(long, value_name = "PLATFORM,...", value_delimiter = ',')]
        platform: Vec<Platform>,
        /// Leave out terminalsAndIcons.xml, which FMI Library warns of in every FMU
        #[arg(long)]
        no_terminals: bool,
        /// Leave the default experiment in motion out of the documentation
        #[arg(long)]
        no_animation: bool,
    },
    /// Joins two FMUs of one scene that were built for different platforms
    Merge(Rest),
    /// Finds numbers of elements and a tolerance for the error that a scene asks for, and says why
    Plan(Rest),
    /// Simulates a scene (natively) or an FMU (with fmpy) to a CSV file
    Simulate(simulate::Arguments),
    /// Shows a scene (.json), an FMU or outputs (.csv) in motion: writes a page of HTML and opens it
    View(Rest),
    /// Simulates a scene many times with other parameters
    Sweep(Rest),
    /// Makes a Python package with the program and the libraries for FMUs, which needs no compiler
    Wheel {
        /// Platforms of the FMUs that it packages [default: platforms like this one]
        #[arg(long, value_name = "PLATFORM,...", value_delimiter = ',')]
        platform: Vec<Platform>,
        /// Where to write [default: target/wheel]
        #[arg(long, value_name = "FOLDER")]
        output: Option<PathBuf>,
    },
    /// Packages the pendulum, simulates it with fmpy, compares and draws it
    Demo,
    /// Regenerates the committed modelDescription/ and scenes/scene.schema.json
    Describe,
    /// Regenerates src/view/bundle.txt, the program of pages that move, from src/view/script
    ViewBundle,
    /// Regenerates docs/charts: CSV files, pictures of them and the page that explains them
    Chart {
        /// Which charts [default: all]
        #[arg(value_name = "NAME", value_parser = chart::names())]
        charts: Vec<String>,
        /// Draw and write anew from the CSV files that there are, without measuring
        #[arg(long)]
        draw: bool,
    },
    /// Makes the FMUs that others are coupled with in tests: mass, spring, controller, cylinder
    ExampleFmus {
        /// Where to write [default: target/fmu/examples]
        #[arg(long, value_name = "FOLDER")]
        output: Option<PathBuf>,
    },
    /// Runs the checks of a change: formatting, clippy, Rust tests, generated files, FMUs under fmpy, plans; the long ones where
    /// their files have changed since they passed
    Test {
        /// Words of the names of the checks to run [default: all]
        #[arg(value_name = "WORD")]
        words: Vec<String>,
        /// Run every check in full, as for a release
        #[arg(long)]
        all: bool,
    },
}

/// Arguments that are passed on unchanged.
#[derive(clap::Args)]
struct Rest {
    /// Arguments of the program `flexbody`: files, then options
    #[arg(
        value_name = "ARGUMENT",
        required = true,
        trailing_var_arg = true,
        allow_hyphen_values = true
    )]
    arguments: Vec<OsString>,
}

fn main() -> ExitCode {
    let command = Arguments::parse().command;
    let result = cargo::Workspace::locate().and_then(|workspace| match command {
        Command::Package {
            scene,
            output,
            platform,
            no_terminals,
            no_animation,
        } => {
            let options = [
                no_terminals.then_some("--no-terminals"),
                no_animation.then_some("--no-animation"),
            ];
            let options: Vec<&str> = options.into_iter().flatten().collect();
            package::package(&workspace, &scene, output.as_deref(), &platform, &options)
        }
        Command::Merge(rest) => simulate::pass_on(&workspace, "merge", &rest.arguments),
        Command::Plan(rest) => simulate::pass_on(&workspace, "plan", &rest.arguments),
        Command::Simulate(arguments) => simulate::simulate(&workspace, &arguments),
        Command::View(rest) => simulate::pass_on(&workspace, "view", &rest.arguments),
        Command::Sweep(rest) => simulate::pass_on(&workspace, "sweep", &rest.arguments),
        Command::Wheel { platform, output } => {
            wheel::wheel(&workspace, &platform, output.as_deref())
        }
        Command::Demo => demo::demo(&workspace),
        Command::Describe => describe::regenerate(&workspace),
        Command::ViewBundle => view_bundle::regenerate(&workspace),
        Command::Chart { charts, draw } => chart::chart(&workspace, &charts, !draw),
        Command::ExampleFmus { output } => {
            example_fmus::example_fmus(&workspace, output.as_deref())
        }
        Command::Test { words, all } => test::test(&workspace, &words, all),
    });
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
