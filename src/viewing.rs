//! Floor 11. `flexbody view`: a scene, the scene in an FMU or a table of outputs as a page that moves.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use flexbody::page;
use flexbody::scene::Scene;
use flexbody::simulation::courses;
use flexbody::view::{Limits, Recording, Table, gltf, vtk};

use crate::planning::planned;
use crate::{Outcome, at, progress_bar, read};

/// What to show, and where to write.
#[derive(clap::Args)]
pub struct View {
    /// Scene (`.json`), FMU (`.fmu`), or outputs as `flexbody simulate` writes them (`.csv`).
    file: PathBuf,
    /// Page of HTML; named like the file, in the current folder, if it is not given.
    #[arg(long)]
    output: Option<PathBuf>,
    /// Writes the page without opening it.
    #[arg(long)]
    no_open: bool,
    /// CSV file of inputs that vary in time, as of `simulate`; what `accuracy.for` says of them if it is not given.
    #[arg(long)]
    input: Option<PathBuf>,
    /// Folder for the surfaces of bodies in every frame as files of VTK, which ParaView opens (`motion.pvd`); no page is written unless it
    /// is named too.
    #[arg(long, value_name = "FOLDER")]
    vtk: Option<PathBuf>,
    /// File for the bodies in motion as binary glTF (`.glb`); no page is written unless it is named too.
    #[arg(long, value_name = "FILE.glb")]
    gltf: Option<PathBuf>,
}

/// The scene in an FMU.
const INSIDE: &str = "resources/scene.json";
/// Most bytes of a scene in an FMU.
const MOST: u64 = 64 << 20;

/// Writes what is asked for, says where it is, and opens the page.
pub fn view(arguments: &View) -> Outcome<()> {
    let file = &arguments.file;
    let extension = file.extension().and_then(|extension| extension.to_str());
    let text = match extension {
        Some("csv") => page_of_table(arguments)?,
        Some("json" | "fmu") => {
            let (scene, recording) = recorded(arguments, extension == Some("fmu"))?;
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

fn write(path: &Path, content: &[u8]) -> Outcome<()> {
    fs::write(path, content).map_err(|error| at(path, error))?;
    println!("wrote {}", path.display());
    Ok(())
}

/// Files for other programs.
fn export(arguments: &View, recording: &Recording) -> Outcome<()> {
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

fn page_of_table(arguments: &View) -> Outcome<String> {
    let given = [
        arguments.input.is_some(),
        arguments.vtk.is_some(),
        arguments.gltf.is_some(),
    ];
    if given.contains(&true) {
        return Err("--input, --vtk, --gltf: expected a scene or an FMU, found a table".into());
    }
    let file = &arguments.file;
    let text = fs::read_to_string(file).map_err(|error| at(file, error))?;
    let table = Table::from_csv(&text).map_err(|error| at(file, error))?;
    let title = file.file_stem().unwrap_or_default().to_string_lossy();
    Ok(page::moving_table(&title, &table))
}

/// The scene, and its default experiment simulated.
fn recorded(arguments: &View, is_fmu: bool) -> Outcome<(Scene, Recording)> {
    let file = &arguments.file;
    let (scene, given) = match is_fmu {
        true => (inside(file)?, None),
        false => {
            let given = courses(&read(file)?).map_err(|error| at(file, error))?;
            (planned(file)?.0, given)
        }
    };
    let inputs = match &arguments.input {
        Some(path) => Some(fs::read_to_string(path).map_err(|error| at(path, error))?),
        None => given,
    };
    let bar = progress_bar(scene.experiment.steps() as u64);
    let found = Recording::new(
        &scene,
        inputs.as_deref(),
        &Limits::PAGE,
        &mut |number, _| {
            bar.set_position(number);
        },
    );
    bar.finish_and_clear();
    let recording = found.map_err(|error| at(file, error))?;
    if let Some(reason) = recording.stopped() {
        eprintln!("flexbody: {reason}");
    }
    Ok((scene, recording))
}

/// The scene in an FMU.
fn inside(file: &Path) -> Outcome<Scene> {
    let wrong = |error: &dyn std::fmt::Display| at(file, error);
    let opened = fs::File::open(file).map_err(|error| wrong(&error))?;
    let mut archive = zip::ZipArchive::new(opened).map_err(|error| wrong(&error))?;
    let wrong = |error: &dyn std::fmt::Display| at(file, format!("{INSIDE}: {error}"));
    let found = archive.by_name(INSIDE).map_err(|error| wrong(&error))?;
    let mut text = String::new();
    let read = found.take(MOST).read_to_string(&mut text);
    read.map_err(|error| wrong(&error))?;
    Scene::from_json(&text).map_err(|error| wrong(&error))
}

/// The section of a unit's page where its default experiment moves; the file says what inputs do.
pub fn motion(file: &Path, scene: &Scene) -> Outcome<String> {
    let inputs = courses(&read(file)?).map_err(|error| at(file, error))?;
    let bar = progress_bar(scene.experiment.steps() as u64);
    let section = page::motion(scene, inputs.as_deref(), &mut |number, _| {
        bar.set_position(number);
    });
    bar.finish_and_clear();
    Ok(section)
}
