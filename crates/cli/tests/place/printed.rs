//! What the program prints, for tests that read all of it.

use crate::place::Place;

impl Place {
    /// Whether a command succeeds, and all that it printed.
    pub fn printed(&self, options: &[&str]) -> (bool, String) {
        let run = self.command(options).output().expect("the program runs");
        let printed = [run.stdout, run.stderr].concat();
        let printed = String::from_utf8(printed).expect("UTF-8");
        (run.status.success(), printed)
    }
}
