//! Checks of cross sections.

use nalgebra::{Matrix6, Vector3};

use super::checks::{expected, finite, needed, not_negative, planar, positive, vector};
use crate::scene::mesh::SHORTEST;
use crate::scene::{Error, LineBody, LineModel, Model, Profile, Section, Strain};

impl LineBody {
    /// Checks the cross section or the sections at stations. A cable may have no keys of rods.
    ///
    /// # Errors
    /// A missing section, keys of rods on a cable, or a dimension or stiffness out of range.
    pub(super) fn validate_sections(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let (at, is_rod) = (|key: &str| format!("{path}.{key}"), self.is_rod());
        if is_rod {
            self.validate_rod(path, dimension)?
        } else {
            self.refuse_what_is_of_rods(path)?
        }
        if self.stations.is_empty() && self.section.is_unsaid() {
            let wanted = "a cross section, or `stations`";
            return Err(expected(&at("section"), wanted, "nothing"));
        }
        if self.stations.is_empty() {
            return (self.section).validate(&at("section"), dimension, self.sections);
        }
        if !self.section.is_unsaid() {
            let wanted = "nothing beside `stations`, each of which has its section";
            return Err(expected(&at("section"), wanted, "a section"));
        }
        if self.model == Model::Rigid {
            let wanted = "none of a rigid rod, which is uniform along its length";
            return Err(expected(&at("stations"), wanted, "some"));
        }
        self.validate_stations(&at("stations"), dimension)
    }

    fn validate_stations(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let last = self.stations.len() - 1;
        let wanted =
            "stations from 0 to 1 in order, two at one place at most, others at least 1e-3 apart";
        for (k, station) in self.stations.iter().enumerate() {
            let place = format!("{path}[{k}]");
            finite(&format!("{place}.at"), station.at)?;
            let from = |j: usize| station.at - self.stations[j].at;
            let is_right = match k {
                0 => station.at == 0.0 && last > 0,
                _ => from(k - 1) == 0.0 || from(k - 1) >= SHORTEST,
            };
            let is_step = k > 0 && from(k - 1) == 0.0;
            let is_alone = !is_step || (k > 1 && k < last && from(k - 2) != 0.0);
            if !is_right || !is_alone || (k == last && station.at != 1.0) {
                return Err(expected(&format!("{place}.at"), wanted, station.at));
            }
            finite(&format!("{place}.twist"), station.twist)?;
            if is_step && station.twist != self.stations[k - 1].twist {
                let wanted = "the twist of the other station at this place";
                return Err(expected(&format!("{place}.twist"), wanted, station.twist));
            }
            let has_axes = self.is_rod() && dimension == 3;
            if !has_axes && station.twist != 0.0 {
                let wanted = if self.is_rod() {
                    "0 in the plane, where nothing twists"
                } else {
                    "0 of a cable, whose sections have no axes"
                };
                return Err(expected(&format!("{place}.twist"), wanted, station.twist));
            }
            (station.section).validate(&format!("{place}.section"), dimension, self.sections)?;
            let says = |said: &dyn Fn(&Section) -> bool| {
                said(&station.section) == said(&self.stations[0].section)
            };
            if !says(&|section| section.shear_factors().is_some()) {
                let wanted = "shear factors at all stations or at none";
                return Err(expected(&format!("{place}.section"), wanted, "another way"));
            }
            self.validate_between(&place, k)?;
            if !says(&|section| section.stiffness.is_some()) {
                let wanted = "`stiffness` and `inertia` at all stations or at none";
                return Err(expected(&format!("{place}.section"), wanted, "another way"));
            }
        }
        Ok(())
    }

    /// Shapes between a station and the one before it exist, where polygons change.
    fn validate_between(&self, place: &str, k: usize) -> Result<(), Error> {
        let Some(before) = k
            .checked_sub(1)
            .map(|before| &self.stations[before].section.shape)
        else {
            return Ok(());
        };
        let (Some(first), Some(last)) = (before, &self.stations[k].section.shape) else {
            return Ok(());
        };
        let is_step = self.stations[k].at == self.stations[k - 1].at;
        if is_step || first == last || [first, last].iter().all(|of| of.key() != "polygon") {
            return Ok(());
        }
        let place = format!("{place}.section.shape.{}", last.key());
        if !first.is_like(last) {
            let wanted =
                "a polygon with as many corners and holes as the one at the station before";
            return Err(expected(&place, wanted, "another shape"));
        }
        first.validate_between(last, &place)
    }

    /// Checks values that the chosen element may not use.
    ///
    /// # Errors
    /// A modulus, stiffness, factor or dimension out of range.
    pub(super) fn validate_spare(&self, path: &str) -> Result<(), Error> {
        if let Some(modulus) = self.material.shear_modulus {
            positive(&format!("{path}.material.shear_modulus"), "Pa", modulus)?;
        }
        let stations = self.stations.iter().enumerate();
        let all = stations.map(|(k, s)| (&s.section, format!("{path}.stations[{k}].section")));
        for (section, place) in all.chain([(&self.section, format!("{path}.section"))]) {
            let at = |key: &str| format!("{place}.{key}");
            if let Some(constant) = section.torsion_constant {
                positive(&at("torsion_constant"), "m^4", constant)?;
            }
            for (k, moment) in section.second_moments.iter().flatten().enumerate() {
                not_negative(&at(&format!("second_moments[{k}]")), "m^4", *moment)?;
            }
            section.validate_factors(&place)?;
        }
        Ok(())
    }

    /// Nothing that rods alone have.
    fn refuse_what_is_of_rods(&self, path: &str) -> Result<(), Error> {
        let of_rods = [
            ("axis", self.axis.is_some()),
            (
                "material.shear_modulus",
                self.material.shear_modulus.is_some(),
            ),
        ];
        match of_rods.iter().find(|(_, is_said)| *is_said) {
            Some((key, _)) => Err(expected(&format!("{path}.{key}"), OF_RODS, "a value")),
            None => Ok(()),
        }
    }

    /// Checks the keys of a rod beside its sections.
    fn validate_rod(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        if dimension == 2 && !self.is_beam() {
            let wanted =
                "\"cable\", \"beam\", \"rigid\" or \"reduced\" in the plane, where nothing twists";
            let found = format!("{:?}", self.sections.element());
            return Err(expected(&at("element"), wanted, found));
        }
        if self.strain != Strain::ThetaPrime {
            let wanted = "\"thetaPrime\" of a rod";
            return Err(expected(&at("strain"), wanted, "another measure"));
        }
        self.validate_axis(&at("axis"), dimension)?;
        self.validate_shear(path)?;
        match dimension {
            // What couples is refused with the sections.
            2 => Ok(()),
            _ => self.validate_coupling(path),
        }
    }

    /// Iterates over the section and those at stations with their places.
    fn places_of_sections(&self, path: &str) -> impl Iterator<Item = (&Section, String)> {
        let one = [(&self.section, format!("{path}.section"))];
        let stations = self.stations.iter().enumerate();
        one.into_iter().chain(
            stations.map(move |(k, s)| (&s.section, format!("{path}.stations[{k}].section"))),
        )
    }

    /// Shear compliance of shapes is positive at the ratio of Poisson of both moduli.
    fn validate_shear(&self, path: &str) -> Result<(), Error> {
        if !self.is_beam() || self.material.shear_modulus.is_none() {
            return Ok(());
        }
        for (section, place) in self.places_of_sections(path) {
            let Some(shape) = section.shape.as_ref().filter(|of| of.solved_by_elements()) else {
                continue;
            };
            shape.validate(&format!("{place}.shape.{}", shape.key()))?;
            if self
                .shear_stiffness(&section.numbers())
                .cholesky()
                .is_none()
            {
                let wanted = "moduli whose ratio of Poisson, `E / (2 G) - 1`, leaves a shear compliance, or `shear_factors`";
                return Err(expected(&place, wanted, "moduli that leave none"));
            }
        }
        Ok(())
    }

    /// Stiffness is positive with what couples stretching, twist and bending.
    fn validate_coupling(&self, path: &str) -> Result<(), Error> {
        for (section, place) in self.places_of_sections(path) {
            for (key, coupling) in [
                ("coupling", section.coupling),
                ("axial_coupling", section.axial_coupling),
            ] {
                let Some(coupling) = coupling else {
                    continue;
                };
                let (place, numbers) = (format!("{place}.{key}"), section.numbers());
                for entry in coupling {
                    finite(&place, entry)?;
                }
                let (is_positive, wanted) = match key {
                    "coupling" => (
                        self.stiffness(&numbers).cholesky().is_some(),
                        "stiffness that couples less than twist and bending alone have",
                    ),
                    _ => (
                        self.coupled_stiffness(&numbers).cholesky().is_some(),
                        "stiffness that couples less than stretching, twist and bending alone have",
                    ),
                };
                if !is_positive {
                    return Err(expected(&place, wanted, format!("{coupling:?}")));
                }
            }
        }
        Ok(())
    }

    /// The first axis of a rod's section is across its line.
    fn validate_axis(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let Some(axis) = &self.axis else {
            return Ok(());
        };
        if dimension == 2 {
            let wanted = "nothing in the plane, which the first axis of sections is across";
            return Err(expected(path, wanted, "an axis"));
        }
        vector(path, dimension, axis)?;
        let tangent = Vector3::from(self.shape.tangent(0.0));
        let axis = Vector3::from(axis.full());
        if axis.cross(&tangent).norm() <= 1e-9 * axis.norm() {
            let wanted = "a direction that is not along the tangent at the first end";
            return Err(expected(path, wanted, format!("{:?}", axis.as_slice())));
        }
        Ok(())
    }
}

const OF_RODS: &str = "nothing of a cable (an element of \"rod\" has sections that rotate)";
const OF_SPACE: &str =
    "nothing in the plane, where nothing twists and sections bend about one axis";

/// Names the replacement for a feature of sections that rotate about their line, in a message.
fn instead_of_turning(kind: LineModel) -> &'static str {
    match kind {
        LineModel::Cable => OF_RODS,
        _ => OF_SPACE,
    }
}

impl Section {
    fn validate(&self, path: &str, dimension: usize, kind: LineModel) -> Result<(), Error> {
        if kind == LineModel::Reissner {
            self.validate_beam(path, dimension)?;
            if self.stiffness.is_some() {
                return Ok(());
            }
        } else {
            self.refuse_what_is_of_beams(path)?;
        }
        if let Some(shape) = &self.shape {
            return self.validate_shape(path, dimension, kind, shape);
        }
        let at = |key: &str| format!("{path}.{key}");
        if kind != LineModel::Cable && dimension == 3 {
            self.validate_numbers_of_rod(path)?;
        } else {
            self.refuse_numbers_of_rods(path, instead_of_turning(kind))?;
            let moment = needed(path, "second_moment", "a value", self.second_moment)?;
            match kind {
                LineModel::Cable => not_negative(&at("second_moment"), "m^4", moment)?,
                _ => positive(&at("second_moment"), "m^4", moment)?,
            }
        }
        let area = needed(path, "area", "a value, or a `shape`", self.area)?;
        positive(&at("area"), "m^2", area)
    }

    fn validate_shape(
        &self,
        path: &str,
        dimension: usize,
        kind: LineModel,
        shape: &Profile,
    ) -> Result<(), Error> {
        let turns = kind != LineModel::Cable && dimension == 3;
        let numbers = [
            ("area", self.area.is_some()),
            ("second_moment", self.second_moment.is_some()),
            ("second_moments", self.second_moments.is_some()),
            ("torsion_constant", self.torsion_constant.is_some()),
        ];
        if let Some((key, _)) = numbers.iter().find(|(_, is_said)| *is_said) {
            let wanted = "nothing beside `shape`, which it follows from";
            return Err(expected(&format!("{path}.{key}"), wanted, "a value"));
        }
        let place = format!("{path}.shape.{}", shape.key());
        shape.validate(&place)?;
        let couplings = [
            ("coupling", self.coupling.is_some()),
            ("axial_coupling", self.axial_coupling.is_some()),
        ];
        if let Some((key, _)) = couplings.iter().find(|(_, is_said)| *is_said && !turns) {
            let wanted = instead_of_turning(kind);
            return Err(expected(&format!("{path}.{key}"), wanted, "a value"));
        }
        if turns || shape.numbers().is_alike() {
            return Ok(());
        }
        let instead = "a circle or a tube of a cable, which bends alike to all sides (an element of \"rod\" does not),";
        planar(&place, dimension, instead, &format!("a {}", shape.key()))
    }

    fn refuse_what_is_of_beams(&self, path: &str) -> Result<(), Error> {
        let of_beams = [
            ("shear_factors", self.shear_factors.is_some()),
            ("shear_factor", self.shear_factor.is_some()),
            ("stiffness", self.stiffness.is_some()),
            ("inertia", self.inertia.is_some()),
            ("about", self.about.is_some()),
        ];
        match of_beams.iter().find(|(_, is_said)| *is_said) {
            Some((key, _)) => {
                let wanted = "nothing but of an element of \"beam\", whose sections shear";
                Err(expected(&format!("{path}.{key}"), wanted, "a value"))
            }
            None => Ok(()),
        }
    }

    /// Shear factors are positive.
    fn validate_factors(&self, path: &str) -> Result<(), Error> {
        for (k, factor) in self.shear_factors.iter().flatten().enumerate() {
            positive(&format!("{path}.shear_factors[{k}]"), "1", *factor)?;
        }
        match self.shear_factor {
            Some(factor) => positive(&format!("{path}.shear_factor"), "1", factor),
            None => Ok(()),
        }
    }

    /// Checks the keys of a beam's section beside those of a rod's.
    fn validate_beam(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        self.validate_factors(path)?;
        let elsewhere = match dimension {
            2 => (
                "shear_factors",
                "`shear_factor` in the plane, where sections shear one way",
                self.shear_factors.is_some(),
            ),
            _ => (
                "shear_factor",
                "`shear_factors` in space, one along each axis",
                self.shear_factor.is_some(),
            ),
        };
        if let (key, wanted, true) = elsewhere {
            return Err(expected(&at(key), wanted, "a value"));
        }
        if self.stiffness.is_none() {
            let alone = [
                ("inertia", self.inertia.is_some()),
                ("about", self.about.is_some()),
            ];
            if let Some((key, _)) = alone.iter().find(|(_, is_said)| *is_said) {
                return Err(expected(&at(key), "nothing without `stiffness`", "a value"));
            }
            if self.shape.is_none() && dimension == 2 {
                let wanted = "a value of a beam, or a `shape`, or `stiffness`";
                needed(path, "shear_factor", wanted, self.shear_factor)?;
            } else if self.shape.is_none() {
                let wanted = "two values of a beam, or a `shape`, or `stiffness`";
                needed(path, "shear_factors", wanted, self.shear_factors)?;
            }
            return Ok(());
        }
        let beside = [
            ("shape", self.shape.is_some()),
            ("area", self.area.is_some()),
            ("second_moment", self.second_moment.is_some()),
            ("second_moments", self.second_moments.is_some()),
            ("torsion_constant", self.torsion_constant.is_some()),
            ("coupling", self.coupling.is_some()),
            ("axial_coupling", self.axial_coupling.is_some()),
            ("shear_factors", self.shear_factors.is_some()),
            ("shear_factor", self.shear_factor.is_some()),
        ];
        if let Some((key, _)) = beside.iter().find(|(_, is_said)| *is_said) {
            let wanted = "nothing beside `stiffness`, which holds it";
            return Err(expected(&at(key), wanted, "a value"));
        }
        self.validate_matrices(path)?;
        match dimension {
            2 => self.validate_planar(path),
            _ => Ok(()),
        }
    }

    /// In the plane nothing couples what moves in it with what would leave it.
    fn validate_planar(&self, path: &str) -> Result<(), Error> {
        let Some(given) = self.given() else {
            return Ok(());
        };
        for (key, matrix) in [("stiffness", given.stiffness), ("inertia", given.inertia)] {
            let both = (0..6).flat_map(|r| (0..r).map(move |c| (r, c)));
            for (r, c) in both.filter(|(r, c)| r % 2 != c % 2) {
                let size = (matrix[(r, r)] * matrix[(c, c)]).sqrt();
                if matrix[(r, c)].abs() > 1e-9 * size {
                    let wanted = "0 about the line in the plane, which the body would leave";
                    let place = format!("{path}.{key}[{r}][{c}]");
                    return Err(expected(&place, wanted, matrix[(r, c)]));
                }
            }
        }
        Ok(())
    }

    /// Whole matrices are symmetric and positive, and the centre of mass is on the line.
    fn validate_matrices(&self, path: &str) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        needed(path, "inertia", "six rows beside `stiffness`", self.inertia)?;
        for (k, place) in self.about.iter().flatten().enumerate() {
            finite(&at(&format!("about[{k}]")), *place)?;
        }
        for (key, rows) in [("stiffness", self.stiffness), ("inertia", self.inertia)] {
            let rows = rows.unwrap_or_default();
            for (r, c) in (0..6).flat_map(|r| (0..6).map(move |c| (r, c))) {
                let (entry, other) = (rows[r][c], rows[c][r]);
                let place = at(&format!("{key}[{r}][{c}]"));
                finite(&place, entry)?;
                if (entry - other).abs() > 1e-9 * (rows[r][r] * rows[c][c]).abs().sqrt() {
                    let wanted = format!("{other}, as on the other side of the diagonal");
                    return Err(expected(&place, &wanted, entry));
                }
            }
        }
        let Some(given) = self.given() else {
            return Ok(());
        };
        for (key, matrix) in [("stiffness", given.stiffness), ("inertia", given.inertia)] {
            if matrix.cholesky().is_none() {
                let wanted = "a positive definite matrix";
                return Err(expected(&at(key), wanted, "one that is not"));
            }
        }
        let (inertia, mass) = (given.inertia, given.inertia[(0, 0)]);
        let size = inertia.fixed_view::<3, 3>(3, 3).trace().sqrt() / mass.sqrt();
        let center = [-inertia[(0, 5)] / mass, inertia[(0, 4)] / mass];
        if center.iter().any(|way| way.abs() > 1e-6 * size) {
            let wanted = "a centre of mass on the line of the body (move the line there, and say `about` from it)";
            return Err(expected(
                &at("inertia"),
                wanted,
                format!("it at {center:?} m"),
            ));
        }
        // Velocities of points across the line that rotations of the section give, and products of inertia with its twist.
        let apart = [(0, 3), (1, 3), (1, 4), (1, 5), (2, 3), (2, 4), (2, 5)].map(|at| (at, 1e-6));
        let products = [(3, 4), (3, 5)].map(|at| (at, 1e-9));
        for ((r, c), part) in apart.into_iter().chain(products) {
            let size = (inertia[(r, r)] * inertia[(c, c)]).sqrt();
            if inertia[(r, c)].abs() > part * size {
                let wanted = "0 of a section that lies across the line";
                let place = at(&format!("inertia[{r}][{c}]"));
                return Err(expected(&place, wanted, inertia[(r, c)]));
            }
        }
        let plain = inertia - Matrix6::from_diagonal_element(mass);
        if plain.fixed_view::<3, 3>(0, 0).norm() > 1e-9 * mass {
            let wanted = "the same mass in all directions";
            return Err(expected(&at("inertia"), wanted, "another"));
        }
        Ok(())
    }

    fn refuse_numbers_of_rods(&self, path: &str, wanted: &str) -> Result<(), Error> {
        let of_rods = [
            ("second_moments", self.second_moments.is_some()),
            ("torsion_constant", self.torsion_constant.is_some()),
            ("coupling", self.coupling.is_some()),
            ("axial_coupling", self.axial_coupling.is_some()),
        ];
        match of_rods.iter().find(|(_, is_said)| *is_said) {
            Some((key, _)) => Err(expected(&format!("{path}.{key}"), wanted, "a value")),
            None => Ok(()),
        }
    }

    fn validate_numbers_of_rod(&self, path: &str) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        if self.second_moment.is_some() {
            let wanted = "`second_moments` of a rod, one about each axis";
            return Err(expected(&at("second_moment"), wanted, "`second_moment`"));
        }
        let torsion = needed(
            path,
            "torsion_constant",
            "a value of a rod",
            self.torsion_constant,
        )?;
        positive(&at("torsion_constant"), "m^4", torsion)?;
        let key = "second_moments";
        let moments = needed(path, key, "two values of a rod", self.second_moments)?;
        for (k, moment) in moments.into_iter().enumerate() {
            positive(&format!("{path}.{key}[{k}]"), "m^4", moment)?;
        }
        Ok(())
    }
}
