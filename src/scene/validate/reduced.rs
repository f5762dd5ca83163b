//! Checks of reduced bodies.

use std::collections::BTreeSet;

use super::checks::{expected, finite, name, not_negative, positive, quoted, unknown, vector};
use crate::scene::description::{DampingRatio, FixedInterfaceModes, Modes, ModesUpTo};
use crate::scene::{Container, Error, FileBody};

/// What the third axis of a body in the plane may lack of 1 along that of the scene.
const TILTED: f64 = 1e-9;

impl FileBody {
    /// Checks a reduced body on its own.
    ///
    /// # Errors
    /// A file that was not read, a key that is out of range or names nothing of the file, or an orientation that leaves the plane.
    pub(super) fn validate(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        let Some(container) = &self.container else {
            let wanted = "a file that is read with the scene";
            return Err(expected(&at("file"), wanted, quoted(&self.file)));
        };
        self.validate_modes(&at("modes"), container)?;
        self.validate_damping(&at("damping_ratio"))?;
        vector(&at("position"), dimension, &self.position)?;
        if let Some(orientation) = &self.orientation {
            orientation.validate(&at("orientation"))?;
            if dimension == 2 && self.axes()[(2, 2)] < 1.0 - TILTED {
                let wanted = "a rotation about the third axis in the plane";
                return Err(expected(&at("orientation"), wanted, "another one"));
            }
        }
        if self.motion.deformation.is_some() {
            let place = at("motion.deformation");
            return Err(expected(&place, "none of a reduced body", "one"));
        }
        if self.is_rigid() && !self.gauges.is_empty() {
            return Err(expected(
                &at("gauges"),
                "none of a body without modes",
                self.gauges.len(),
            ));
        }
        for (marker, interface) in &self.markers {
            if container.interface(interface).is_none() {
                let known = container.model.interfaces.iter().map(|of| of.name.as_str());
                let what = format!("the name of an interface in {}", quoted(&self.file));
                let place = at(&format!("markers.{marker}"));
                return Err(unknown(&place, &what, interface, known));
            }
        }
        self.validate_gauges(path, container)
    }

    fn validate_gauges(&self, path: &str, container: &Container) -> Result<(), Error> {
        let mut names = BTreeSet::new();
        for (gauge, stress) in &self.gauges {
            let place = format!("{path}.gauges.{gauge}");
            name(&place, gauge, &mut names)?;
            let stresses = &container.details.stresses;
            if !stresses.contains_key(stress) {
                let known = stresses.keys().map(String::as_str);
                let what = format!("the name of a stress in {}", quoted(&self.file));
                return Err(unknown(&place, &what, stress, known));
            }
        }
        Ok(())
    }

    fn validate_modes(&self, path: &str, container: &Container) -> Result<(), Error> {
        let frequencies = container.frequencies();
        let (count, first) = (frequencies.len(), frequencies[0]);
        match self.modes {
            Modes::Count(found) if found as usize > count => {
                let wanted = format!("a number of modes from 0 to {count}, which the file has");
                Err(expected(path, &wanted, found))
            }
            Modes::FixedInterface(FixedInterfaceModes { fixed_interface })
                if fixed_interface as usize > count =>
            {
                let wanted = format!("a number of modes from 0 to {count}, which the file has");
                Err(expected(
                    &format!("{path}.fixed_interface"),
                    &wanted,
                    fixed_interface,
                ))
            }
            Modes::UpTo(ModesUpTo { up_to }) => {
                let path = format!("{path}.up_to");
                positive(&path, "Hz", up_to)?;
                if up_to < first {
                    let wanted = format!("at least the first natural frequency ({first} Hz)");
                    return Err(expected(&path, &wanted, up_to));
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn validate_damping(&self, path: &str) -> Result<(), Error> {
        let table = match &self.damping_ratio {
            DampingRatio::Number(ratio) => return not_negative(path, "1", *ratio),
            DampingRatio::Table(table) => table,
        };
        if table.is_empty() {
            let wanted = "at least one pair of a frequency (Hz) and a ratio";
            return Err(expected(path, wanted, "none"));
        }
        let mut before = None;
        for (row, [frequency, ratio]) in table.iter().enumerate() {
            let place = |column: usize| format!("{path}[{row}][{column}]");
            finite(&place(0), *frequency)?;
            not_negative(&place(1), "1", *ratio)?;
            if before.is_some_and(|before| *frequency <= before) {
                let wanted = "frequencies (Hz) that ascend";
                return Err(expected(&place(0), wanted, frequency));
            }
            before = Some(*frequency);
        }
        Ok(())
    }
}
