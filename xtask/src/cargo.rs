//! Cargo, and what it builds. Paths of products come from cargo's own messages, never from guesses.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use packing::{Platform, Stage};
use serde_json::Value;

use crate::anonymous;
use crate::assembly;
use crate::linker::Linker;
use crate::package::PACKAGE;
use crate::process;

/// The package of the program `flexbody`.
pub const PROGRAM: &str = "flexbody-program";

/// Where the project lies and where its products go.
pub struct Workspace {
    root: PathBuf,
    target: PathBuf,
}

impl Workspace {
    /// Asks cargo for the folders of the workspace that xtask belongs to.
    pub fn locate() -> Result<Self> {
        let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
        let text = process::stdout(
            cargo()
                .args(["metadata", "--no-deps", "--format-version", "1"])
                .arg("--manifest-path")
                .arg(manifest),
        )?;
        let metadata: Value =
            serde_json::from_str(&text).context("cargo metadata printed broken JSON")?;
        let folder = |key: &str| {
            let path = metadata[key].as_str();
            path.map(PathBuf::from)
                .with_context(|| format!("cargo metadata names no {key}"))
        };
        Ok(Self {
            root: folder("workspace_root")?,
            target: folder("target_directory")?,
        })
    }

    /// A workspace elsewhere, which cargo knows nothing of.
    #[cfg(test)]
    pub fn at(root: PathBuf, target: PathBuf) -> Self {
        Self { root, target }
    }

    /// A file or folder of the project.
    pub fn path(&self, relative: &str) -> PathBuf {
        self.root.join(relative)
    }

    /// A file or folder among the products.
    pub fn target(&self, relative: &str) -> PathBuf {
        self.target.join(relative)
    }

    /// An empty folder among the products to build in, of this process and this purpose alone.
    pub fn stage(&self, purpose: &str) -> Result<Stage> {
        Stage::new(&self.target("fmu"), purpose)
    }

    /// A cargo command in the project's folder.
    pub fn cargo(&self, subcommand: &str) -> Command {
        let mut command = cargo();
        command.arg(subcommand).current_dir(&self.root);
        command
    }

    /// Builds a package as the shared library of an FMU and returns where it is. What is in it
    /// follows from the source, the versions of the tools and the platform, not from the place.
    pub fn library(&self, package: &str, platform: Platform) -> Result<PathBuf> {
        let linker = Linker::prepare(self, platform)?;
        let flags = [self.flags()?, linker.flags].concat();
        let mut last = [vec!["-Cstrip=symbols".to_owned()], linker.arguments].concat();
        if package == PACKAGE && platform.is_host() {
            last.push(assembly::EMIT.into());
        }
        if platform.is_darwin() {
            // Else the library calls itself by the path that it was built at.
            let name = format!("@rpath/{package}{}", platform.suffix());
            last.extend([
                "-Clink-arg=-install_name".into(),
                format!("-Clink-arg={name}"),
            ]);
        }
        if platform.is_linux() {
            // Else a loader that goes by names could take it for a library of another version.
            let name = format!("{package}-{}.so", env!("CARGO_PKG_VERSION"));
            last.push(format!("-Clink-arg=-Wl,-soname,{name}"));
        }
        let mut command = self.cargo("rustc");
        command.args(["--lib", "--crate-type", "cdylib"]);
        command.envs(linker.sdk.map(|folder| ("SDKROOT", folder)));
        if !platform.is_host() {
            command.args(["--target", platform.target()]);
        }
        released(&mut command, package, &flags).arg("--").args(last);
        product(&mut command, package, |artifact| {
            let is_library = |file: &&str| file.ends_with(platform.suffix());
            let files = artifact["filenames"].as_array()?;
            files.iter().filter_map(Value::as_str).find(is_library)
        })
        .with_context(|| format!("building the shared library for {}", platform.folder()))
    }

    /// Builds the `flexbody` program, as `cargo test` does, and returns where it is.
    pub fn binary(&self) -> Result<PathBuf> {
        let mut command = self.cargo("build");
        command
            .args(["--package", PROGRAM, "--bin", PACKAGE])
            .args(["--message-format", "json-render-diagnostics"]);
        product(&mut command, PACKAGE, |artifact| {
            artifact["executable"].as_str()
        })
        .context("building the flexbody program")
    }

    /// Builds a program for release and returns where it is; its package is named like it, but for that of the product.
    pub fn program(&self, name: &str) -> Result<PathBuf> {
        let mut command = self.cargo("build");
        let package = if name == PACKAGE { PROGRAM } else { name };
        self.executable(command.args(["--bin", name]), (package, name))
    }

    /// Builds the program `flexbody` for release, to run on other machines of this platform too: linked as libraries are.
    pub fn portable_program(&self) -> Result<PathBuf> {
        let linker = Linker::prepare(self, Platform::host()?)?;
        let flags = [self.flags()?, linker.flags].concat();
        let mut command = self.cargo("rustc");
        command.args(["--bin", PACKAGE]);
        let command = released(&mut command, PROGRAM, &flags);
        command.args(["--", "-Cstrip=symbols"]);
        product(command.args(linker.arguments), PACKAGE, |artifact| {
            artifact["executable"].as_str()
        })
        .context("building the flexbody program")
    }

    /// Builds the program of a package outside the workspace and returns where it is.
    pub fn program_apart(&self, folder: &str, package: &str) -> Result<PathBuf> {
        let mut command = self.cargo("build");
        command.arg("--manifest-path");
        command.arg(self.path(folder).join("Cargo.toml"));
        command.arg("--target-dir").arg(self.target(package));
        self.executable(&mut command, (package, package))
    }

    fn flags(&self) -> Result<Vec<String>> {
        anonymous::flags(&self.root, &self.target)
    }

    fn executable(&self, command: &mut Command, (package, name): (&str, &str)) -> Result<PathBuf> {
        // With the flags of libraries, so that the two share what they depend on.
        let command = released(command, package, &self.flags()?);
        product(command, name, |artifact| artifact["executable"].as_str())
            .with_context(|| format!("building the {name} program"))
    }
}

/// The compiler that cargo uses.
pub fn rustc() -> Command {
    Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// The version of that compiler.
pub fn release() -> Result<String> {
    let text = process::stdout(rustc().arg("-vV"))?;
    let release = text.lines().find_map(|line| line.strip_prefix("release: "));
    release.map(str::to_owned).context("rustc names no release")
}

fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Runs a build and returns the programs that cargo's messages name.
pub fn executables(command: &mut Command) -> Result<Vec<PathBuf>> {
    let messages = process::stdout(command.args(["--message-format", "json-render-diagnostics"]))?;
    let parsed = messages.lines().map(serde_json::from_str::<Value>);
    let parsed: Vec<Value> = parsed
        .collect::<Result<_, _>>()
        .context("expected JSON messages of cargo")?;
    let programs = parsed
        .iter()
        .filter_map(|message| message["executable"].as_str());
    Ok(programs.map(PathBuf::from).collect())
}

/// Completes a command that builds a package in release.
fn released<'a>(command: &'a mut Command, package: &str, flags: &[String]) -> &'a mut Command {
    command
        .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\x1f"))
        .args(["--package", package, "--release"])
        .args(["--message-format", "json-render-diagnostics"])
}

/// Runs a command that builds a package and finds a product in cargo's messages.
fn product(
    command: &mut Command,
    package: &str,
    find: impl Fn(&Value) -> Option<&str>,
) -> Result<PathBuf> {
    for line in process::stdout(command)?.lines() {
        let message: Value = serde_json::from_str(line)
            .with_context(|| format!("expected a JSON message of cargo, found {line:?}"))?;
        let is_ours = message["target"]["name"] == package;
        if is_ours && let Some(path) = find(&message) {
            return Ok(path.into());
        }
    }
    bail!("cargo succeeded but names no product")
}
