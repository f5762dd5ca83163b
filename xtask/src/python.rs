//! The Python environments of the project: virtual environments among the products, with every
//! version pinned. Nothing outside the products is read or written.

use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use fmu_package::{announced, shown};

use crate::cargo::Workspace;
use crate::process::run_quietly;

/// Pinned packages of an environment.
struct PinnedPackages {
    /// File that lists them.
    requirements: &'static str,
    /// Folder of the environment among the products.
    folder: &'static str,
}

/// Packages that a file lists, in an environment in a folder among the products.
const fn pinned(requirements: &'static str, folder: &'static str) -> PinnedPackages {
    PinnedPackages {
        requirements,
        folder,
    }
}

/// The packages of tests and pictures.
const PROJECT: PinnedPackages = pinned("tests/fmpy/requirements.txt", "python");
/// Environment of the programs that charts compare the product with. It is separate, so that no check needs them.
const PEERS: PinnedPackages = pinned("crates/studies/exudyn/requirements.txt", "python-peers");
/// Environment of the masters that tests couple FMUs in. It is separate, so that a picture needs none of them.
const MASTERS: PinnedPackages = pinned("tests/masters/requirements.txt", "python-masters");
/// Environment of the Python package and of the generator of its models. It is separate, so that no picture needs a
/// cluster.
const OWN: PinnedPackages = pinned("tests/python/requirements.txt", "python-own");
/// Environment of the readers of finite element models that need packages of other programs. It is separate, because one of
/// them needs an older numpy.
const READERS: PinnedPackages = pinned("tests/python/readers.txt", "python-readers");
/// Environment of the references of random scenes. It is separate, so that no picture needs it.
const PLANS: PinnedPackages = pinned("tests/plans/requirements.txt", "python-plans");
/// The linker of libraries; apart, so that what needs no library does not need it.
const LINKER: PinnedPackages = pinned("xtask/linker.txt", "python-linker");
/// The checker of dependencies, built.
const DENY: PinnedPackages = pinned("xtask/deny.txt", "python-deny");
/// Environment of the browser driver in tests. It is separate, since not every machine has a browser.
const BROWSER: PinnedPackages = pinned("tests/view/requirements.txt", "python-browser");
/// Environment that builds the script of moving pages. It is separate, since its result is committed.
const NODE: PinnedPackages = pinned("xtask/node.txt", "python-node");
/// The file in an environment that says what it was made from; the last one written.
const STAMP: &str = "installed.txt";
/// Oldest Python that the pinned packages run on.
const OLDEST: (u32, u32) = (3, 11);
/// Where to look, best first: the version that the pins were made with, then any other.
const CANDIDATES: [&str; 6] = [
    "python3.11",
    "python3.12",
    "python3.13",
    "python3.14",
    "python3",
    "python",
];
/// Prints the version where a virtual environment can be made, else fails and says why.
const PROBE: &str = "import sys, venv, ensurepip; print(*sys.version_info[:2])";

/// A Python interpreter with the project's packages.
pub struct Python {
    interpreter: PathBuf,
    temporary: PathBuf,
    settings: PathBuf,
}

impl Python {
    /// Prepares the environment of tests and pictures.
    ///
    /// # Errors
    /// Python or a package cannot be installed.
    pub fn prepare(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, PROJECT)
    }

    /// Prepares the environment of the programs to compare with.
    ///
    /// # Errors
    /// Python or a package cannot be installed.
    pub fn prepare_peers(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, PEERS)
    }

    /// Prepares the environment of the masters.
    ///
    /// # Errors
    /// Python or a package cannot be installed.
    pub fn prepare_masters(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, MASTERS)
    }

    /// Prepares the environment of the Python package.
    ///
    /// # Errors
    /// Python or a package cannot be installed.
    pub fn prepare_own(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, OWN)
    }

    /// Prepares the environment of readers of finite element models.
    ///
    /// # Errors
    /// Python or a package cannot be installed.
    pub fn prepare_readers(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, READERS)
    }

    /// Prepares the environment of plans that are compared with references.
    ///
    /// # Errors
    /// Python or a package cannot be installed.
    pub fn prepare_plans(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, PLANS)
    }

    /// Prepares the environment of the linker.
    ///
    /// # Errors
    /// Python or a package cannot be installed.
    pub fn prepare_linker(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, LINKER)
    }

    /// Prepares the environment of the checker of dependencies.
    ///
    /// # Errors
    /// Python or a package cannot be installed.
    pub fn prepare_deny(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, DENY)
    }

    /// Prepares the environment of tests in a browser.
    ///
    /// # Errors
    /// Python or a package cannot be installed.
    pub fn prepare_browser(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, BROWSER)
    }

    /// Prepares the environment with node.
    ///
    /// # Errors
    /// Python or a package cannot be installed.
    pub fn prepare_node(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, NODE)
    }

    fn prepare_one(workspace: &Workspace, packages: PinnedPackages) -> Result<Self> {
        let folder = workspace.target(packages.folder);
        let python = Self {
            interpreter: interpreter(&folder),
            temporary: workspace.target("tmp"),
            settings: folder.join("matplotlib"),
        };
        std::fs::create_dir_all(&python.temporary)
            .with_context(|| format!("cannot create the folder {}", shown(&python.temporary)))?;
        let requirements = workspace.path(packages.requirements);
        let wanted = std::fs::read_to_string(&requirements)
            .with_context(|| format!("cannot read {}", shown(&requirements)))?;
        // One run at a time looks and makes; the operating system lets go of the lock of one that ends, however it ends.
        let _lock = locked(&folder.with_extension("lock"))?;
        let stamp = folder.join(STAMP);
        let is_current = std::fs::read_to_string(&stamp).is_ok_and(|found| found == wanted);
        if !is_current || !python.runs() {
            install(&folder, &requirements, &wanted)?;
        }
        Ok(python)
    }

    /// A command that runs a Python file.
    pub fn script(&self, file: &Path) -> Command {
        let mut command = self.command();
        command.arg(file);
        command
    }

    /// A command that runs a module.
    pub fn module(&self, name: &str) -> Command {
        let mut command = self.command();
        command.args(["-m", name]);
        command
    }

    /// A program that came with a package, or the interpreter itself.
    pub fn program(&self, name: &str) -> PathBuf {
        self.interpreter.with_file_name(name)
    }

    fn command(&self) -> Command {
        let mut command = isolated(&self.interpreter);
        command
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .env("PYTHONUTF8", "1")
            .env("MPLBACKEND", "Agg")
            .env("MPLCONFIGDIR", &self.settings);
        for variable in ["TMPDIR", "TEMP", "TMP"] {
            command.env(variable, &self.temporary);
        }
        command
    }

    /// Whether the interpreter still starts: the Python it was made from may be gone.
    fn runs(&self) -> bool {
        let probe = self.command().args(["-c", ""]).output();
        probe.is_ok_and(|output| output.status.success())
    }
}

/// Makes an environment. It is made elsewhere and moved when it is whole, so that a run that ends half-way, or programs
/// of one that was killed and still write, leave no half environment in its place.
fn install(folder: &Path, requirements: &Path, wanted: &str) -> Result<()> {
    let base = find()?;
    let beside = |what: &str| folder.with_extension(format!("{what}-{}", std::process::id()));
    let (partial, old) = (beside("partial"), beside("old"));
    let done = format!("made the Python environment {}", shown(folder));
    announced("making the Python environment", &done, || {
        clear_leftovers(folder);
        run_quietly(
            isolated(Path::new(base))
                .args(["-m", "venv", "--clear"])
                .arg(&partial),
        )?;
        run_quietly(
            isolated(&interpreter(&partial))
                .args(["-m", "pip", "install", "--no-input", "--no-cache-dir"])
                .args(["--disable-pip-version-check", "--requirement"])
                .arg(requirements),
        )
        .with_context(|| format!("cannot install {}", shown(requirements)))?;
        std::fs::write(partial.join(STAMP), wanted)
            .with_context(|| format!("cannot write {}", shown(&partial)))?;
        if folder.exists() {
            std::fs::rename(folder, &old)
                .with_context(|| format!("cannot move {}", shown(folder)))?;
        }
        std::fs::rename(&partial, folder)
            .with_context(|| format!("cannot move {}", shown(&partial)))?;
        clear_leftovers(folder);
        Ok(())
    })
}

/// Removes what runs have left beside an environment. What cannot be removed does no harm: the next run
/// makes its own.
fn clear_leftovers(folder: &Path) {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    let is_left = |entry: &std::fs::DirEntry| {
        let found = entry.file_name();
        let found = found.to_string_lossy();
        let rest = found.strip_prefix(&*name).unwrap_or_default();
        rest.starts_with(".partial-") || rest.starts_with(".old-")
    };
    let beside = folder.parent().map(std::fs::read_dir);
    for entry in beside.into_iter().flatten().flatten().flatten() {
        if is_left(&entry) {
            let _ = std::fs::remove_dir_all(entry.path());
        }
    }
}

/// Holds a lock for as long as the file lives.
fn locked(path: &Path) -> Result<File> {
    let cannot = || format!("cannot lock {}", shown(path));
    let file = File::create(path).with_context(cannot)?;
    if let Err(TryLockError::WouldBlock) = file.try_lock() {
        eprintln!("waiting for another run that prepares a Python environment");
    }
    file.lock().with_context(cannot)?;
    Ok(file)
}

/// The interpreter of an environment.
fn interpreter(folder: &Path) -> PathBuf {
    if cfg!(windows) {
        folder.join("Scripts").join("python.exe")
    } else {
        folder.join("bin").join("python")
    }
}

/// Finds a Python that is new enough and can make a virtual environment.
fn find() -> Result<&'static str> {
    let mut found = Vec::new();
    for name in CANDIDATES {
        // Not on this machine: nothing to report.
        let Ok(output) = isolated(Path::new(name)).args(["-c", PROBE]).output() else {
            continue;
        };
        if !output.status.success() {
            let errors = String::from_utf8_lossy(&output.stderr);
            let reason = errors
                .trim()
                .lines()
                .last()
                .unwrap_or("does not start")
                .to_owned();
            found.push(format!("{name}: {reason}"));
            continue;
        }
        let version = String::from_utf8_lossy(&output.stdout);
        match parse_version(&version) {
            Some(version) if version >= OLDEST => return Ok(name),
            _ => found.push(format!(
                "{name}: version {}",
                version.trim().replace(' ', ".")
            )),
        }
    }
    let found = if found.is_empty() {
        "none".to_owned()
    } else {
        found.join("; ")
    };
    bail!(
        "expected Python {}.{} or newer with venv and ensurepip (Debian: python3-venv), found {found}",
        OLDEST.0,
        OLDEST.1
    )
}

/// A command that no setting of another Python installation reaches.
fn isolated(interpreter: &Path) -> Command {
    let mut command = Command::new(interpreter);
    for variable in ["PYTHONHOME", "PYTHONPATH", "PYTHONSTARTUP", "VIRTUAL_ENV"] {
        command.env_remove(variable);
    }
    command
}

fn parse_version(text: &str) -> Option<(u32, u32)> {
    let (major, minor) = text.trim().split_once(' ')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use std::sync::Barrier;

    use super::*;

    /// A project whose environment holds nothing but Python itself.
    struct Project(PathBuf);

    impl Project {
        fn new(name: &str) -> Result<Self> {
            let root = std::env::temp_dir().join(format!("xtask-{name}-{}", std::process::id()));
            std::fs::create_dir_all(root.join("target"))?;
            std::fs::write(root.join("nothing.txt"), "# No packages.\n")?;
            Ok(Self(root))
        }

        fn prepare(&self) -> Result<Python> {
            let workspace = Workspace::at(self.0.clone(), self.0.join("target"));
            let packages = PinnedPackages {
                requirements: "nothing.txt",
                folder: "python",
            };
            Python::prepare_one(&workspace, packages)
        }

        /// Lists the products, except the lock.
        fn products(&self) -> Result<Vec<String>> {
            let listing = std::fs::read_dir(self.0.join("target"))?;
            let names = listing.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
            let mut names: Vec<String> = names.collect::<Result<_>>()?;
            names.retain(|name| name != "python.lock");
            names.sort();
            Ok(names)
        }
    }

    impl Drop for Project {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn two_runs_at_once_make_one_environment_that_works() -> Result<()> {
        let project = Project::new("two-runs")?;
        let start = Barrier::new(2);
        let run = || {
            start.wait();
            let python = project.prepare()?;
            let stamp = std::fs::metadata(project.0.join("target/python").join(STAMP))?;
            run_quietly(python.module("pip").arg("--version"))?;
            Ok(stamp.modified()?)
        };
        let made: Vec<Result<_>> = std::thread::scope(|scope| {
            let threads = [scope.spawn(run), scope.spawn(run)];
            threads
                .map(|thread| thread.join().expect("no panic"))
                .into()
        });
        let made = made.into_iter().collect::<Result<Vec<_>>>()?;
        assert_eq!(made[0], made[1], "made twice");
        assert_eq!(project.products()?, ["python", "tmp"]);
        Ok(())
    }

    #[test]
    fn what_a_killed_run_left_is_made_anew() -> Result<()> {
        let project = Project::new("killed-run")?;
        let half = project.0.join("target/python");
        // Half an environment in its place, as of old, and one beside it.
        for folder in [&half, &half.with_extension("partial-1")] {
            std::fs::create_dir_all(folder.join("bin"))?;
            std::fs::write(folder.join("bin/python"), "half")?;
        }
        let python = project.prepare()?;
        assert!(python.runs());
        assert_eq!(project.products()?, ["python", "tmp"]);
        let made = std::fs::metadata(half.join(STAMP))?.modified()?;
        assert!(project.prepare()?.runs());
        assert_eq!(std::fs::metadata(half.join(STAMP))?.modified()?, made);
        Ok(())
    }

    #[test]
    fn versions_compare_by_number() {
        assert_eq!(parse_version("3 11\n"), Some((3, 11)));
        assert!(parse_version("3 9") < Some(OLDEST));
        assert!(parse_version("3 14") > Some(OLDEST));
        assert_eq!(parse_version("Python"), None);
    }
}
