//! What links libraries. For Linux and Windows it is Zig's linker, for macOS that of Rust; the
//! system libraries of all, for Linux in the version asked for, come with the Python package of Zig.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use fmu_package::{Platform, prepared, shown, write_whole};

use crate::cargo::{Workspace, rustc};
use crate::exports;
use crate::process::stdout;
use crate::python::Python;

/// Where scripts and what Zig builds once are kept, among the products.
const FOLDER: &str = "linker";
/// Oldest glibc that a library for Linux loads on: the oldest that Rust's own standard library does.
const GLIBC: &str = "2.17";
/// The libraries that rustc names for macOS. The first holds all that is used: nothing here calls iconv, which
/// the crate libc names all the same.
const DARWIN_LIBRARIES: [&str; 4] = ["libSystem", "libc", "libm", "libiconv"];

/// Settings with which cargo builds the library of a platform.
#[derive(Default)]
pub struct Linker {
    /// Flags of rustc.
    pub flags: Vec<String>,
    /// The system libraries of macOS.
    pub sdk: Option<PathBuf>,
}

impl Linker {
    /// Makes ready what a platform needs in place of the system's own linker. That does for the host,
    /// unless that is Linux: there a library would ask for the glibc of the machine that built it.
    ///
    /// # Errors
    /// A linker or library that cannot be installed.
    pub fn prepare(workspace: &Workspace, platform: Platform) -> Result<Self> {
        if platform.is_host() && !platform.is_linux() {
            return Ok(Self::default());
        }
        check_possible(platform)?;
        let python = Python::prepare_linker(workspace)?;
        let target = match platform {
            Platform::Linux64 => format!("x86_64-linux-gnu.{GLIBC}"),
            Platform::Aarch64Linux => format!("aarch64-linux-gnu.{GLIBC}"),
            Platform::Win64 => "x86_64-windows-gnu".into(),
            Platform::Darwin64 | Platform::Aarch64Darwin => {
                return Self::darwin(workspace, &python);
            }
        };
        let script = |name: &str, arguments: &str| {
            let file = prepared(&workspace.target(FOLDER).join(name))?;
            write(&file, &text(workspace, &python, arguments))?;
            make_executable(&file)?;
            Ok::<_, anyhow::Error>(file.display().to_string())
        };
        let file = script(platform.folder(), &format!("cc -- -target {target}"))?;
        let mut linker = Self::default();
        linker.flags.push(format!("-Clinker={file}"));
        if platform == Platform::Win64 {
            let file = script("dlltool", "dlltool --")?;
            linker.flags.push(format!("-Cdlltool={file}"));
            let list = prepared(&workspace.target(FOLDER).join("fmi2.def"))?;
            write(&list, &exports::list())?;
            let list = list.display();
            linker.flags.push(format!("-Clink-arg={list}"));
        }
        Ok(linker)
    }

    /// Rust's own: Zig's leaves in what nothing uses, exports it and names a library by its path.
    fn darwin(workspace: &Workspace, python: &Python) -> Result<Self> {
        // The last leaves out the paths of object files, which the library's UUID is made of.
        let flags = [
            "-Clinker-flavor=ld64.lld",
            "-Clinker=rust-lld",
            "-Clink-arg=-S",
        ];
        Ok(Self {
            flags: flags.map(String::from).into(),
            sdk: Some(sdk(workspace, python)?),
        })
    }
}

/// Refuses a platform that this machine cannot build for.
fn check_possible(platform: Platform) -> Result<()> {
    let (name, target) = (platform.folder(), platform.target());
    if cfg!(windows) {
        bail!(
            "expected Linux or macOS to build for {name}, found Windows: build there, then merge"
        );
    }
    let folder = stdout(rustc().args(["--print", "target-libdir", "--target", target]))?;
    if !Path::new(folder.trim_end()).is_dir() {
        bail!(
            "Rust's standard library for {name} is not installed: run `rustup target add {target}`"
        );
    }
    Ok(())
}

/// A shell script: rustc takes one path, and Zig wants arguments before those of rustc.
fn text(workspace: &Workspace, python: &Python, arguments: &str) -> String {
    let cache = quoted(&workspace.target(FOLDER).join("cache"));
    let interpreter = quoted(&python.program("python"));
    let program = quoted(&python.program("cargo-zigbuild"));
    format!(
        "#!/bin/sh\n\
         export ZIG_GLOBAL_CACHE_DIR={cache} ZIG_LOCAL_CACHE_DIR={cache}\n\
         export CARGO_ZIGBUILD_CACHE_DIR={cache}\n\
         # Else a library for Windows holds the time of its linking.\n\
         export SOURCE_DATE_EPOCH=0\n\
         export CARGO_ZIGBUILD_ZIG_COMMAND={interpreter}\n\
         export CARGO_ZIGBUILD_ZIG_COMMAND_ARGS='-m ziglang'\n\
         exec {program} zig {arguments} \"$@\"\n"
    )
}

/// A path as one word of the shell.
fn quoted(path: &Path) -> String {
    format!("'{}'", path.display().to_string().replace('\'', r"'\''"))
}

/// Returns the file with the notices of the C library that a platform's library is linked with. `None` for the C
/// library of the system.
///
/// # Errors
/// The linker is not installed.
pub fn c_library_notices(workspace: &Workspace, platform: Platform) -> Result<Option<PathBuf>> {
    if platform != Platform::Win64 || platform.is_host() {
        return Ok(None);
    }
    let python = Python::prepare_linker(workspace)?;
    Ok(Some(zig(&python)?.join("lib/libc/mingw/COPYING")))
}

/// The folder of Zig.
fn zig(python: &Python) -> Result<PathBuf> {
    let question = "import ziglang; print(ziglang.__path__[0])";
    let folder = stdout(Command::new(python.program("python")).args(["-c", question]))?;
    Ok(folder.trim_end().into())
}

/// The folder of macOS's system libraries: text that says what they offer. Zig's names a variant of
/// a processor that Rust's linker does not know.
fn sdk(workspace: &Workspace, python: &Python) -> Result<PathBuf> {
    let source = zig(python)?.join("lib/libc/darwin/libSystem.tbd");
    let text = std::fs::read_to_string(&source)
        .with_context(|| format!("cannot read {}", shown(&source)))?;
    let text = text.replace("arm64e.x1-", "arm64e-");
    let folder = workspace.target(FOLDER).join("sdk");
    for name in DARWIN_LIBRARIES {
        write(
            &prepared(&folder.join(format!("usr/lib/{name}.tbd")))?,
            &text,
        )?;
    }
    Ok(folder)
}

/// Writes a file, unless it is there already: another run may be using it.
fn write(file: &Path, text: &str) -> Result<()> {
    if std::fs::read_to_string(file).is_ok_and(|found| found == text) {
        return Ok(());
    }
    write_whole(file, text)
}

#[cfg(unix)]
fn make_executable(file: &Path) -> Result<()> {
    use std::os::unix::fs::PermissionsExt;
    std::fs::set_permissions(file, std::fs::Permissions::from_mode(0o755))
        .with_context(|| format!("cannot make {} executable", shown(file)))
}

#[cfg(not(unix))]
fn make_executable(_: &Path) -> Result<()> {
    Ok(())
}
