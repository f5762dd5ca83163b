//! Platforms that FMUs are built for, and what their libraries are called.

use anyhow::{Result, bail};
use clap::ValueEnum;

/// A platform, named as its folder below `binaries/`: FMI 2.0 names where it has one, else those
/// of FMI 3.0.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Platform {
    /// Linux on x86_64
    Linux64,
    /// Windows on x86_64
    Win64,
    /// Linux on 64-bit ARM
    #[value(name = "aarch64-linux")]
    Aarch64Linux,
    /// macOS on x86_64
    Darwin64,
    /// macOS on 64-bit ARM
    #[value(name = "aarch64-darwin")]
    Aarch64Darwin,
}

impl Platform {
    /// Returns the platform that this program runs on.
    ///
    /// # Errors
    /// A platform without FMUs.
    pub fn host() -> Result<Self> {
        match (std::env::consts::OS, std::env::consts::ARCH) {
            ("linux", "x86_64") => Ok(Self::Linux64),
            ("windows", "x86_64") => Ok(Self::Win64),
            ("linux", "aarch64") => Ok(Self::Aarch64Linux),
            ("macos", "x86_64") => Ok(Self::Darwin64),
            ("macos", "aarch64") => Ok(Self::Aarch64Darwin),
            (system, processor) => bail!(
                "expected Linux, macOS or Windows on x86_64, or Linux or macOS on aarch64, \
                 found {system} on {processor}"
            ),
        }
    }

    /// The platform that this program runs on, if that is one.
    pub fn is_host(self) -> bool {
        Self::host().is_ok_and(|host| host == self)
    }

    /// Returns the name of the platform's folder below `binaries/`.
    pub fn folder(self) -> &'static str {
        match self {
            Self::Linux64 => "linux64",
            Self::Win64 => "win64",
            Self::Aarch64Linux => "aarch64-linux",
            Self::Darwin64 => "darwin64",
            Self::Aarch64Darwin => "aarch64-darwin",
        }
    }

    /// Returns the platform's target triple in Rust.
    pub fn target(self) -> &'static str {
        match self {
            Self::Linux64 => "x86_64-unknown-linux-gnu",
            Self::Win64 => "x86_64-pc-windows-gnu",
            Self::Aarch64Linux => "aarch64-unknown-linux-gnu",
            Self::Darwin64 => "x86_64-apple-darwin",
            Self::Aarch64Darwin => "aarch64-apple-darwin",
        }
    }

    /// Whether it is one of Linux.
    pub fn is_linux(self) -> bool {
        matches!(self, Self::Linux64 | Self::Aarch64Linux)
    }

    /// Whether it is one of Apple's.
    pub fn is_darwin(self) -> bool {
        matches!(self, Self::Darwin64 | Self::Aarch64Darwin)
    }

    /// Returns the extension of shared libraries, with its dot.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Linux64 | Self::Aarch64Linux => ".so",
            Self::Win64 => ".dll",
            Self::Darwin64 | Self::Aarch64Darwin => ".dylib",
        }
    }
}
