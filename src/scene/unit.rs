//! Units of variables, as parts of a scene name them.

/// A unit: its name and exponents of the SI base units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// Name as written in the model description.
    pub name: &'static str,
    /// Exponents of kg, m, s and rad.
    pub exponents: [i32; 4],
}

impl Unit {
    /// Writes the unit for people: `m/s²`, `N·m`.
    pub fn symbol(&self) -> String {
        let letters = self.name.chars().map(|letter| match letter {
            '.' => '·',
            '2' => '²',
            '3' => '³',
            '4' => '⁴',
            other => other,
        });
        letters.collect()
    }

    /// Writes the unit in plain letters, as messages do: `m/s^2`, `N m`.
    pub fn text(&self) -> String {
        let letters = self.name.chars().map(|letter| match letter {
            '.' => " ".into(),
            '2'..='4' => format!("^{letter}"),
            other => other.into(),
        });
        letters.collect()
    }
}

const fn unit(name: &'static str, kg: i32, m: i32, s: i32, rad: i32) -> Unit {
    Unit {
        name,
        exponents: [kg, m, s, rad],
    }
}

pub const SECOND: Unit = unit("s", 0, 0, 1, 0);
pub const PER_SECOND: Unit = unit("1/s", 0, 0, -1, 0);
pub const METRE: Unit = unit("m", 0, 1, 0, 0);
pub const SQUARE_METRE: Unit = unit("m2", 0, 2, 0, 0);
pub const METRE_4: Unit = unit("m4", 0, 4, 0, 0);
pub const PER_METRE: Unit = unit("1/m", 0, -1, 0, 0);
pub const METRE_PER_SECOND: Unit = unit("m/s", 0, 1, -1, 0);
pub const METRE_PER_SECOND_2: Unit = unit("m/s2", 0, 1, -2, 0);
pub const RADIAN: Unit = unit("rad", 0, 0, 0, 1);
pub const RADIAN_PER_SECOND: Unit = unit("rad/s", 0, 0, -1, 1);
pub const RADIAN_PER_SECOND_2: Unit = unit("rad/s2", 0, 0, -2, 1);
pub const SECOND_PER_METRE: Unit = unit("s/m", 0, -1, 1, 0);
pub const SECOND_PER_RADIAN: Unit = unit("s/rad", 0, 0, 1, -1);
pub const PASCAL: Unit = unit("Pa", 1, -1, -2, 0);
pub const DENSITY: Unit = unit("kg/m3", 1, -3, 0, 0);
pub const KILOGRAM: Unit = unit("kg", 1, 0, 0, 0);
pub const INERTIA: Unit = unit("kg.m2", 1, 2, 0, 0);
pub const NEWTON: Unit = unit("N", 1, 1, -2, 0);
pub const NEWTON_PER_METRE: Unit = unit("N/m", 1, 0, -2, 0);
pub const NEWTON_PER_SQUARE_METRE: Unit = unit("N/m2", 1, -1, -2, 0);
pub const NEWTON_PER_CUBIC_METRE: Unit = unit("N/m3", 1, -2, -2, 0);
pub const NEWTON_SECOND: Unit = unit("N.s", 1, 1, -1, 0);
pub const NEWTON_SECOND_PER_METRE: Unit = unit("N.s/m", 1, 0, -1, 0);
pub const NEWTON_METRE: Unit = unit("N.m", 1, 2, -2, 0);
pub const NEWTON_METRE_PER_METRE: Unit = unit("N.m/m", 1, 1, -2, 0);
pub const NEWTON_METRE_SECOND: Unit = unit("N.m.s", 1, 2, -1, 0);
pub const NEWTON_METRE_PER_RADIAN: Unit = unit("N.m/rad", 1, 2, -2, -1);
pub const NEWTON_METRE_SECOND_PER_RADIAN: Unit = unit("N.m.s/rad", 1, 2, -1, -1);
pub const JOULE: Unit = unit("J", 1, 2, -2, 0);

/// Units of the stiffness and the damping of a spring: about an axis, or along one.
pub fn spring_units(is_angle: bool) -> [Unit; 2] {
    if is_angle {
        [NEWTON_METRE_PER_RADIAN, NEWTON_METRE_SECOND_PER_RADIAN]
    } else {
        [NEWTON_PER_METRE, NEWTON_SECOND_PER_METRE]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_those_of_print() {
        let found = [
            METRE_PER_SECOND_2,
            NEWTON_METRE_PER_RADIAN,
            INERTIA,
            METRE_4,
            DENSITY,
        ];
        let symbols = found.map(|unit| unit.symbol());
        assert_eq!(symbols, ["m/s²", "N·m/rad", "kg·m²", "m⁴", "kg/m³"]);
        let texts = found.map(|unit| unit.text());
        assert_eq!(texts, ["m/s^2", "N m/rad", "kg m^2", "m^4", "kg/m^3"]);
    }
}
