//! What the charts compare the product with: integrators and formulations that did not win.
//! `cargo xtask chart` calls this program as it calls `flexbody`; nothing here is in an FMU.

use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[derive(Parser)]
#[command(version, about = "Methods to compare with")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {}

fn main() -> ExitCode {
    match Arguments::parse().command {}
}
