//! `flexbody view`: a scene, the scene in an FMU or a table of outputs as a page that moves.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use flexbody::page;
use flexbody::scene::Scene;
use flexbody::simulation::{TrialConditions, courses};
use flexbody::view::{Limits, OutputTable, Recording, gltf, vtk};

use crate::inputs::Inputs;
use crate::planning::{Within, planned_for};
use crate::reading::{at, is_fmu, read};
use crate::simulating::progress_bar;

/// Arguments of `flexbody view`: files to read and to write.
#[derive(clap::Args)]
pub struct View {
    #[command(flatten)]
    within: Within,
    /// Scene (`.json`), FMU (`.fmu`), or outputs as `flexbody simulate` writes them (`.csv`).
    file: PathBuf,
    /// Page of HTML; named like the file, in the current folder, if it is not given.
    #[arg(long)]
    output: Option<PathBuf>,
    /// Writes the page without opening it.
    #[arg(long)]
    no_open: bool,
    /// Inputs as for `simulate`. Without a table they follow `accuracy.input_profiles`.
    #[command(flatten)]
    inputs: Inputs,
    /// Folder for the surfaces of bodies in every frame as files of VTK, which ParaView opens (`motion.pvd`); no page is written unless it
    /// is named too.
    #[arg(long, value_name = "FOLDER")]
    vtk: Option<PathBuf>,
    /// File for the bodies in motion as binary glTF (`.glb`); no page is written unless it is named too.
    #[arg(long, value_name = "FILE.glb")]
    gltf: Option<PathBuf>,
}

/// Writes the requested files, prints their paths, and opens the page.
///
/// # Errors
/// A file that cannot be read or written, or a scene that cannot be simulated.
pub fn view(arguments: &View) -> Result<()> {
    let file = &arguments.file;
    let extension = file.extension().and_then(|extension| extension.to_str());
    let text = match extension {
        Some("csv") => page_of_table(arguments)?,
        Some("json" | "fmu") => {
            let (scene, recording) = recorded(arguments)?;
            export(arguments, &recording)?;
            page::moving(&scene, &recording)
        }
        _ => return Err(at(file, "expected a file ending in .json, .fmu or .csv")),
    };
    let is_exported = arguments.vtk.is_some() || arguments.gltf.is_some();
    let output = match &arguments.output {
        Some(output) => output.clone(),
        None if is_exported => return Ok(()),
        None => Path::new(file.file_stem().unwrap_or_default()).with_extension("html"),
    };
    write(&output, text.as_bytes())?;
    if arguments.no_open {
        return Ok(());
    }
    let opened = open::that_detached(&output);
    opened.map_err(|error| at(&output, format!("no browser opened it: {error}")))
}

fn write(path: &Path, content: &[u8]) -> Result<()> {
    fs::write(path, content).map_err(|error| at(path, error))?;
    println!("wrote {}", path.display());
    Ok(())
}

/// Files for other programs.
fn export(arguments: &View, recording: &Recording) -> Result<()> {
    if let Some(folder) = &arguments.vtk {
        fs::create_dir_all(folder).map_err(|error| at(folder, error))?;
        for (name, text) in vtk(recording) {
            let path = folder.join(name);
            fs::write(&path, text).map_err(|error| at(&path, error))?;
        }
        println!("wrote {}", folder.join("motion.pvd").display());
    }
    match &arguments.gltf {
        Some(path) => write(path, &gltf(recording)),
        None => Ok(()),
    }
}

fn page_of_table(arguments: &View) -> Result<String> {
    let given = [
        arguments.inputs.input.is_some(),
        arguments.vtk.is_some(),
        arguments.gltf.is_some(),
    ];
    if given.contains(&true) {
        bail!("--input, --vtk, --gltf: expected a scene or an FMU, found a table");
    }
    let file = &arguments.file;
    let text = fs::read_to_string(file).map_err(|error| at(file, error))?;
    let table = OutputTable::from_csv(&text).map_err(|error| at(file, error))?;
    let title = file.file_stem().unwrap_or_default().to_string_lossy();
    Ok(page::moving_table(&title, &table))
}

/// The scene, and its default experiment simulated.
fn recorded(arguments: &View) -> Result<(Scene, Recording)> {
    let file = &arguments.file;
    let scene = read(file)?;
    let inputs = arguments.inputs.table()?.map(|(table, _)| table);
    let given = TrialConditions {
        inputs: inputs.clone(),
        ..TrialConditions::default()
    };
    let (scene, inputs) = if is_fmu(file) {
        (scene, inputs)
    } else {
        let courses = courses(&scene).map_err(|error| at(file, error))?;
        let (planned, _) = planned_for(file, &scene, &given, &arguments.within)?;
        (planned, inputs.or(courses))
    };
    let bar = progress_bar(scene.experiment.steps() as u64);
    let found = Recording::new(&scene, inputs.as_ref(), &Limits::PAGE, &mut |number, _| {
        bar.set_position(number);
    });
    drop(bar);
    let recording = found.map_err(|error| at(file, error))?;
    if let Some(reason) = recording.stopped() {
        eprintln!("flexbody: {reason}");
    }
    Ok((scene, recording))
}

/// Returns the section of a unit's page that shows its default experiment in motion. `file` provides the inputs.
///
/// # Errors
/// A scene that cannot be simulated.
pub fn motion(file: &Path, scene: &Scene) -> Result<String> {
    let inputs = courses(&read(file)?).map_err(|error| at(file, error))?;
    let bar = progress_bar(scene.experiment.steps() as u64);
    let section = page::motion(scene, inputs.as_ref(), &mut |number, _| {
        bar.set_position(number);
    });
    drop(bar);
    Ok(section)
}
