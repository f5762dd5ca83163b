//! `flexbody describe` of a file of a reduced model: what it holds, in words.

use std::ffi::OsStr;
use std::fmt::Write;
use std::path::Path;

use anyhow::Result;
use flexbody::scene::{Container, bounded, number};

use crate::reading::at;

/// Whether a file is one of a reduced model by its name.
pub fn is_container(path: &Path) -> bool {
    path.extension() == Some(OsStr::new("safetensors"))
}

/// Reads a file of a reduced model and says what it holds.
///
/// # Errors
/// A file that cannot be read or is not valid.
pub fn described(path: &Path) -> Result<String> {
    let bytes = bounded(path).map_err(|error| at(path, error))?;
    let container = Container::from_bytes(&bytes).map_err(|error| at(path, error))?;
    Ok(words(&container))
}

/// Part of the largest number of a list below which one is rounding.
const ROUNDOFF: f64 = 1e-12;

/// A number to six digits.
fn short(value: f64) -> String {
    let rounded = format!("{value:.5e}").parse();
    rounded.map_or_else(|_| number(value), number)
}

fn list(numbers: &[f64]) -> String {
    let largest = numbers.iter().fold(0.0, |most: f64, of| most.max(of.abs()));
    let rounded = numbers.iter().map(|of| {
        let is_noise = of.abs() < ROUNDOFF * largest;
        short(if is_noise { 0.0 } else { *of })
    });
    rounded.collect::<Vec<_>>().join(", ")
}

fn words(container: &Container) -> String {
    let model = &container.model;
    let mut text = String::new();
    let mut line = |key: &str, value: String| {
        // A text takes what is written into it.
        let _ = writeln!(text, "{key}: {value}");
    };
    let source = match container.source.as_str() {
        "" => "not said",
        source => source,
    };
    line("source", source.escape_debug().to_string());
    line("SHA-256", container.digest().to_owned());
    line("mass", format!("{} kg", short(model.mass)));
    let center = list(container.center.as_slice());
    line("centre of mass", format!("[{center}] m"));
    line(
        "inertia about it (xx yy zz xy xz yz)",
        format!("[{}] kg m^2", list(&container.tensor())),
    );
    line(
        "principal moments",
        format!("[{}] kg m^2", list(&model.moments)),
    );
    let frequencies = list(&container.frequencies());
    line("modes", model.modes().to_string());
    line("natural frequencies, free", format!("{frequencies} Hz"));
    if let Some(highest) = container.highest_frequency {
        line("the mesh resolves", format!("up to {} Hz", short(highest)));
    }
    for (index, interface) in model.interfaces.iter().enumerate() {
        let kind = match interface.rotation {
            Some(_) => "frame (with rotations)",
            None => "point (without rotations)",
        };
        let second = match (model.paired, interface.second.is_empty()) {
            (0, _) => "",
            (_, true) => ", without second-order displacements",
            (_, false) => ", with second-order displacements",
        };
        let place = list(container.place(index).as_slice());
        let name = &interface.name;
        line(
            &format!("interface {name}"),
            format!("{kind} at [{place}] m{second}"),
        );
    }
    let pairs = match model.paired {
        0 => "none".into(),
        count if count < model.modes() => format!(
            "of pairs of the first {count} modes; a basis that combines others lacks theirs"
        ),
        count => format!("of pairs of the first {count} modes"),
    };
    line("second-order terms", pairs);
    let details = &container.details;
    let surface = match (details.points.len(), details.triangles.len()) {
        (0, _) => "none".into(),
        (points, triangles) => {
            let stress = if details.point_stresses.is_empty() {
                ""
            } else {
                ", with stress"
            };
            format!("{points} points, {triangles} triangles{stress}")
        }
    };
    line("surface", surface);
    let stresses: Vec<&str> = details.stresses.keys().map(String::as_str).collect();
    let stresses = match stresses[..] {
        [] => "none".into(),
        _ => stresses.join(", "),
    };
    line("stresses", stresses);
    text
}
