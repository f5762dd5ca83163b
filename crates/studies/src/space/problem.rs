//! What a scene of one straight cable says, for rods of any shape functions.

use flexbody::elements::StrainMeasure;
use flexbody::elements::cable::{Inertia, Parameters};
use serde_json::Value;

use crate::elements::rod::{Material, Rod, Vector};

/// One rod, what holds it and what acts on it.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Ends of the straight line, m.
    ends: [Vector; 2],
    /// Stiffness and mass of the rod.
    pub material: Material,
    /// Gravity, m/s^2.
    pub gravity: Vector,
    /// Whether the position of the start is held.
    pub held: bool,
    /// Force on the start (N) along both axes and moment (N m), as times and values.
    loads: [Vec<(f64, f64)>; 3],
}

impl Problem {
    /// Reads a scene of one straight cable, pinned at its start or free, with loads on its start that are tables or
    /// numbers.
    ///
    /// # Errors
    /// A scene of another kind, in words.
    pub fn read(scene: &Value) -> Result<Self, String> {
        let body = &scene["bodies"][0];
        let number = |value: &Value, name: &str| {
            let number = value.as_f64();
            number.ok_or_else(|| format!("expected a number {name}, found {value}"))
        };
        let pair = |value: &Value, name: &str| -> Result<Vector, String> {
            Ok([number(&value[0], name)?, number(&value[1], name)?])
        };
        let line = &body["shape"]["line"];
        let area = number(&body["section"]["area"], "area")?;
        let modulus = number(&body["material"]["youngs_modulus"], "youngs_modulus")?;
        let second = number(&body["section"]["second_moment"], "second_moment")?;
        let density = number(&body["material"]["density"], "density")?;
        let mut loads = [Vec::new(), Vec::new(), Vec::new()];
        for load in scene["loads"].as_array().into_iter().flatten() {
            if load["kind"] == "moment" {
                loads[2] = table(&load["value"]);
            } else {
                loads[0] = table(&load["value"][0]);
                loads[1] = table(&load["value"][1]);
            }
        }
        Ok(Self {
            ends: [pair(&line["from"], "from")?, pair(&line["to"], "to")?],
            material: Material {
                axial: modulus * area,
                bending: modulus * second,
                density: density * area,
            },
            gravity: pair(&scene["gravity"], "gravity")?,
            held: scene["joints"].as_array().is_some_and(|j| !j.is_empty()),
            loads,
        })
    }

    /// The whole rod as a cable of the product: undamped, with its mass and `thetaPrime`.
    pub fn cable(&self) -> Parameters {
        Parameters {
            length: self.length(),
            axial_stiffness: self.material.axial,
            bending_stiffness: self.material.bending,
            line_of: flexbody::elements::cable::LineOf::Cable,
            line_density: self.material.density,
            axial_damping_time: 0.0,
            bending_damping_time: 0.0,
            strain: StrainMeasure::ThetaPrime,
            inertia: Inertia::Corrected,
        }
    }

    /// Length of the line, m.
    pub fn length(&self) -> f64 {
        let [a, b] = self.ends;
        (b[0] - a[0]).hypot(b[1] - a[1])
    }

    /// Point of the line at a reference arc length, m.
    pub fn straight(&self, s: f64) -> Vector {
        let [a, b] = self.ends;
        let part = s / self.length();
        [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])]
    }

    /// Adds what acts on the start of the rod.
    pub fn add_load<const F: usize>(&self, rod: &Rod<F>, t: f64, c: &[Vector], f: &mut [Vector]) {
        let [x, y, moment] = &self.loads;
        if x.is_empty() && y.is_empty() && moment.is_empty() {
            return;
        }
        f[0][0] += value(x, t);
        f[0][1] += value(y, t);
        let (first, jets) = rod.jets(0, 0.0);
        let u = rod.vector(c, 0, 0.0, 1);
        let part = value(moment, t) / (u[0] * u[0] + u[1] * u[1]);
        for (j, jet) in jets.iter().enumerate() {
            f[first + j][0] -= part * u[1] * jet[1];
            f[first + j][1] += part * u[0] * jet[1];
        }
    }
}

fn table(value: &Value) -> Vec<(f64, f64)> {
    let pair = |row: &Value| Some((row[0].as_f64()?, row[1].as_f64()?));
    match &value["table"] {
        Value::Array(rows) => rows.iter().filter_map(pair).collect(),
        _ => vec![(0.0, value.as_f64().unwrap_or(0.0))],
    }
}

/// Linear between the rows of a table, constant beyond them.
fn value(table: &[(f64, f64)], t: f64) -> f64 {
    match table.iter().position(|(time, _)| *time > t) {
        None => table.last().map_or(0.0, |last| last.1),
        Some(0) => table[0].1,
        Some(after) => {
            let [(t0, a), (t1, b)] = [table[after - 1], table[after]];
            a + (b - a) * (t - t0) / (t1 - t0)
        }
    }
}
