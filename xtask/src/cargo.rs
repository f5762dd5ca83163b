//! Cargo, and what it builds. Paths of products come from cargo's own messages, never from guesses.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use fmu_package::{Platform, Stage};
use serde_json::Value;

use crate::anonymous;
use crate::linker::Linker;
use crate::package::PACKAGE;
use crate::process;

/// The package of the program `flexbody`.
pub const PROGRAM: &str = "flexbody-cli";
/// The package that links the library of FMUs.
const LIBRARY: &str = "flexbody-fmu";
/// The package of the tests of the library from outside.
const TESTS: &str = "flexbody-tests";

/// Where the project lies and where its products go.
pub struct Workspace {
    root: PathBuf,
    target: PathBuf,
    /// Profile that products are compiled with.
    profile: &'static str,
}

impl Workspace {
    /// Asks cargo for the folders of the workspace that xtask belongs to.
    ///
    /// # Errors
    /// Cargo fails.
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
            profile: "release",
        })
    }

    /// A view of this workspace whose products are compiled in half of the time and run slower.
    pub fn quick(&self) -> Self {
        Self {
            root: self.root.clone(),
            target: self.target.clone(),
            profile: "demo",
        }
    }

    /// A workspace elsewhere, which cargo knows nothing of.
    #[cfg(test)]
    pub fn at(root: PathBuf, target: PathBuf) -> Self {
        let profile = "release";
        Self {
            root,
            target,
            profile,
        }
    }

    /// A file or folder of the project.
    pub fn path(&self, relative: &str) -> PathBuf {
        self.root.join(relative)
    }

    /// A file or folder among the products.
    pub fn target(&self, relative: &str) -> PathBuf {
        self.target.join(relative)
    }

    /// Creates an empty build folder among the products, for this process and purpose.
    ///
    /// # Errors
    /// The folder cannot be created.
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
    ///
    /// # Errors
    /// The build fails.
    pub fn library(&self, package: &str, platform: Platform) -> Result<PathBuf> {
        let name = if package == PACKAGE { LIBRARY } else { package };
        self.portable(platform, package, &name.replace('-', "_"), |artifact| {
            file_of(artifact, platform.suffix())
        })
        .with_context(|| format!("building the shared library for {}", platform.folder()))
    }

    /// Compiles the code that the library of FMUs and the program are linked from. Returns its path.
    ///
    /// # Errors
    /// The build fails.
    pub fn code(&self) -> Result<PathBuf> {
        self.portable(Platform::host()?, PACKAGE, PACKAGE, |artifact| {
            file_of(artifact, ".rlib")
        })
        .context("compiling the library")
    }

    /// Builds a program for release and returns where it is; its package is named like it, but for that of the product, which runs on
    /// other machines of this platform too.
    ///
    /// # Errors
    /// The build fails.
    pub fn program(&self, name: &str) -> Result<PathBuf> {
        if name == PACKAGE {
            return self
                .portable(Platform::host()?, name, name, |artifact| {
                    artifact["executable"].as_str()
                })
                .context("building the flexbody program");
        }
        self.executable(self.cargo("build").args(["--bin", name]), name)
    }

    /// Builds a package to run on any machine of a platform, that of the product for the host with the program, so that both are linked
    /// from what is compiled once, and finds a product in cargo's messages.
    fn portable(
        &self,
        platform: Platform,
        package: &str,
        name: &str,
        find: impl Fn(&Value) -> Option<&str>,
    ) -> Result<PathBuf> {
        let mut command = self.for_platform("build", platform)?;
        let package = if package == PACKAGE { LIBRARY } else { package };
        if package == LIBRARY && platform.is_host() {
            command.args(["--package", PROGRAM]);
        }
        product(named(&mut command, package), name, find)
    }

    /// A command that tests the program, and the library from outside, in the very code that is delivered.
    ///
    /// # Errors
    /// Linker or compiler are not there.
    pub fn tests_of_product(&self) -> Result<Command> {
        let mut command = self.for_platform("test", Platform::host()?)?;
        command.args(["--package", PROGRAM, "--package", TESTS]);
        Ok(command)
    }

    /// A command that runs the examples in the library's docs, in the very code that is delivered.
    ///
    /// # Errors
    /// Linker or compiler are not there.
    pub fn examples_of_docs(&self) -> Result<Command> {
        let mut command = self.tests_of_product()?;
        // The packages beside it ask for the features that it is compiled with.
        command.args(["--doc", "--package", PACKAGE]);
        Ok(command)
    }

    /// A cargo command that compiles for release what runs on any machine of a platform.
    fn for_platform(&self, subcommand: &str, platform: Platform) -> Result<Command> {
        let linker = Linker::prepare(self, platform)?;
        let mut flags = [self.flags()?, linker.flags].concat();
        flags.push("-Cstrip=symbols".into());
        let mut command = self.cargo(subcommand);
        command.envs(linker.sdk.map(|folder| ("SDKROOT", folder)));
        (self.released(&mut command, &flags)).args(["--target", platform.target()]);
        Ok(command)
    }

    /// Builds the program of a package outside the workspace. Returns its path.
    ///
    /// # Errors
    /// The build fails.
    pub fn program_apart(&self, folder: &str, package: &str) -> Result<PathBuf> {
        let mut command = self.cargo("build");
        command.arg("--manifest-path");
        command.arg(self.path(folder).join("Cargo.toml"));
        command.arg("--target-dir").arg(self.target(package));
        self.executable(&mut command, package)
    }

    /// Completes a command that compiles products.
    fn released<'a>(&self, command: &'a mut Command, flags: &[String]) -> &'a mut Command {
        command
            .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\x1f"))
            .args(["--profile", self.profile])
    }

    fn flags(&self) -> Result<Vec<String>> {
        anonymous::flags(&self.root, &self.target)
    }

    fn executable(&self, command: &mut Command, name: &str) -> Result<PathBuf> {
        let command = self.released(command, &self.flags()?);
        product(named(command, name), name, |artifact| {
            artifact["executable"].as_str()
        })
        .with_context(|| format!("building the {name} program"))
    }
}

/// The file with this ending that a message of cargo names.
fn file_of<'a>(artifact: &'a Value, ending: &str) -> Option<&'a str> {
    let files = artifact["filenames"].as_array()?;
    let mut files = files.iter().filter_map(Value::as_str);
    files.find(|file| file.ends_with(ending))
}

/// The compiler that cargo uses.
pub fn rustc() -> Command {
    Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// Returns the version of the compiler.
///
/// # Errors
/// The compiler cannot be run.
pub fn release() -> Result<String> {
    let text = process::stdout(rustc().arg("-vV"))?;
    let release = text.lines().find_map(|line| line.strip_prefix("release: "));
    release.map(str::to_owned).context("rustc names no release")
}

fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Runs a build and returns the programs that cargo's messages name.
///
/// # Errors
/// The build fails.
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

/// Completes a command that builds a package and tells its products.
fn named<'a>(command: &'a mut Command, package: &str) -> &'a mut Command {
    command
        .args(["--package", package])
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
