//! Writes the model description of every example: `example-fmus FOLDER` makes
//! `FOLDER/<model>/modelDescription.xml`.

use std::path::PathBuf;
use std::{env, fs, io};

use example_fmus::ALL;
use example_fmus::description::model_description;

fn main() -> io::Result<()> {
    let folder = env::args_os().nth(1).map(PathBuf::from);
    let folder = folder.ok_or_else(|| io::Error::other("expected a folder"))?;
    for model in &ALL {
        let place = folder.join(model.name);
        fs::create_dir_all(&place)?;
        fs::write(place.join("modelDescription.xml"), model_description(model))?;
    }
    Ok(())
}
