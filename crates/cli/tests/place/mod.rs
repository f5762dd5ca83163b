//! Folders in which tests run the program.

use std::path::PathBuf;
use std::process::Command;

/// A folder that is removed at the end.
pub struct Place(pub PathBuf);

impl Place {
    /// A folder of this name with these files in it: names and contents.
    pub fn new(name: &str, files: &[(&str, &str)]) -> Self {
        let name = format!("flexbody-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder).expect("a writable temporary directory");
        for (file, text) in files {
            std::fs::write(folder.join(file), text).expect("a writable temporary directory");
        }
        Self(folder)
    }

    /// The program in this folder.
    pub fn command(&self, options: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_flexbody"));
        command.args(options).current_dir(&self.0);
        command
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
