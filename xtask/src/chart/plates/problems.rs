//! Problems of plates for Flexbody and Exudyn: the scene of the one, the options of the other, and the answer.

use std::f64::consts::PI;

use serde_json::{Value, json};

/// Edges of a rectangle.
pub const EDGES: [&str; 4] = ["s1=0", "s1=1", "s2=0", "s2=1"];
/// Poisson's ratio where nothing else is said.
const POISSON: f64 = 0.3;
/// Uniform load that bends squares little: deflections are below a hundredth of a thousandth of the thickness, N/m^2.
const SMALL: f64 = 1e-4;
/// Deflection of a clamped square under a uniform load, over `q a^4 / D` (S. Timoshenko, S. Woinowsky-Krieger, Theory of Plates and Shells
/// (1959), article 44, to more digits).
const CLAMPED: f64 = 0.001_265_32;
/// Terms of Navier's series in each direction, and steps of the elastica.
const TERMS: u32 = 200;
const STEPS: u32 = 4000;

/// A motion: its end and the time between points, s, and the method that runs beside `auto`.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// End, s.
    pub stop: f64,
    /// Time between points, s.
    pub every: f64,
    /// Method of Flexbody beside `auto`, which finds the converged answer too.
    pub method: &'static str,
    /// Tolerance of the converged answer.
    pub tightest: f64,
}

/// Solution that an error is measured from.
#[derive(Clone, Debug)]
pub enum Answer {
    /// Flexbody's finest mesh.
    Converged,
    /// Where the point is, m, by a solution that has this name.
    Place(&'static str, [f64; 3]),
    /// The third component of the place, m. The error is relative.
    Deflection(&'static str, f64),
}

/// Meshes by their number of elements along the first axis.
#[derive(Clone, Copy, Debug)]
pub struct Meshes {
    /// Meshes of Flexbody.
    pub own: &'static [u32],
    /// Meshes of Flexbody's converged answer, the finest first.
    pub finest: [u32; 2],
    /// Meshes of Exudyn, from coarse to fine; all settings run on the first.
    pub exudyn: &'static [u32],
    /// Whether there is one element across.
    pub is_strip: bool,
}

/// A problem.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Name in the chart.
    pub name: &'static str,
    /// Lengths along both axes, m.
    sides: [f64; 2],
    /// Thickness, m.
    thickness: f64,
    /// Young's modulus (N/m^2), Poisson's ratio, density (kg/m^3).
    material: [f64; 3],
    /// Kind and edges of what holds the plate.
    held: (&'static str, &'static [&'static str]),
    /// Loads of Exudyn's options by their names.
    loads: Vec<(&'static str, [f64; 3])>,
    is_thrown: bool,
    /// Points whose places are compared, as fractions of both sides.
    pub points: Vec<[f64; 2]>,
    /// Length that errors are divided by, m.
    pub length: f64,
    /// The motion; nothing of an equilibrium.
    pub motion: Option<Motion>,
    /// Numbers of parts of the load in Exudyn's static solver.
    pub load_steps: &'static [u32],
    /// Solution that errors are measured from.
    pub answer: Answer,
    /// Meshes.
    pub meshes: Meshes,
}

/// All problems, in the order of the chart.
pub fn problems() -> Vec<Problem> {
    vec![
        thrown(),
        corner(),
        strip(),
        loaded("pinned, uniform", "pinned", "series of Navier", navier()),
        loaded(
            "clamped, uniform",
            "clamped",
            "Timoshenko and Woinowsky-Krieger, to six digits",
            CLAMPED,
        ),
        panel(),
    ]
}

/// A free square of rubber that is thrown with bending, twist and spin.
pub fn thrown() -> Problem {
    Problem {
        name: "thrown, free",
        sides: [1.0; 2],
        thickness: 0.01,
        material: [1e8, POISSON, 1000.0],
        held: ("", &[]),
        loads: vec![],
        is_thrown: true,
        points: vec![[1.0, 1.0], [1.0, 0.0]],
        length: 1.0,
        motion: Some(Motion {
            stop: 0.2,
            every: 0.02,
            method: "dopri853",
            tightest: 1e-8,
        }),
        load_steps: &[],
        answer: Answer::Converged,
        meshes: Meshes {
            own: &[2, 3, 4, 5, 8, 12],
            finest: [20, 16],
            exudyn: &[4, 5, 6, 8, 12],
            is_strip: false,
        },
    }
}

/// A steel panel on one edge that falls.
pub fn panel() -> Problem {
    Problem {
        name: "falling steel panel",
        sides: [1.0; 2],
        thickness: 2e-3,
        material: [2.1e11, POISSON, 7850.0],
        held: ("clamped", &["s1=0"]),
        loads: vec![("gravity", [0.0, 0.0, -9.81])],
        is_thrown: false,
        points: vec![[1.0, 1.0], [1.0, 0.5]],
        length: 1.0,
        motion: Some(Motion {
            stop: 0.5,
            every: 0.05,
            method: "radau",
            tightest: 1e-6,
        }),
        load_steps: &[],
        answer: Answer::Converged,
        meshes: Meshes {
            own: &[2, 3, 4, 6, 8],
            finest: [10, 8],
            exudyn: &[4, 6, 8],
            is_strip: false,
        },
    }
}

/// A square of bending stiffness 1 N m.
fn square() -> Problem {
    let thickness = 0.01_f64;
    let modulus = 12.0 * (1.0 - POISSON * POISSON) / thickness.powi(3);
    Problem {
        name: "",
        sides: [1.0; 2],
        thickness,
        material: [modulus, POISSON, 1.0 / thickness],
        held: ("clamped", &["s1=0"]),
        loads: vec![],
        is_thrown: false,
        points: vec![[1.0, 1.0]],
        length: 1.0,
        motion: None,
        load_steps: &[1, 2, 3, 4],
        answer: Answer::Converged,
        meshes: Meshes {
            own: &[2, 3, 4, 5, 6, 8, 12],
            finest: [32, 24],
            exudyn: &[4, 6, 8, 12, 16],
            is_strip: false,
        },
    }
}

/// A square on one edge under a force at a free corner.
fn corner() -> Problem {
    Problem {
        name: "force at a corner",
        loads: vec![("corner_force", [0.0, 0.0, 3.0])],
        ..square()
    }
}

/// A square that all edges hold under a small uniform load; its middle deflects by `part` of `q a^4 / D`.
fn loaded(name: &'static str, kind: &'static str, source: &'static str, part: f64) -> Problem {
    Problem {
        name,
        held: (kind, &EDGES),
        loads: vec![("area_force", [0.0, 0.0, SMALL])],
        points: vec![[0.5; 2]],
        load_steps: &[1],
        answer: Answer::Deflection(source, part * SMALL),
        meshes: Meshes {
            own: &[2, 4, 6, 8, 12, 16],
            finest: [24, 16],
            ..square().meshes
        },
        ..square()
    }
}

/// A strip whose end a force bends, the elastica.
fn strip() -> Problem {
    let ([length, width], thickness, modulus) = ([10.0, 1.0], 0.1_f64, 1.2e6);
    let bending = modulus * width * thickness.powi(3) / 12.0;
    let force = 4.0 * bending / (length * length);
    let [x, z] = elastica(length, bending, modulus * width * thickness, force);
    Problem {
        name: "strip, elastica",
        sides: [length, width],
        thickness,
        material: [modulus, 0.0, 1000.0],
        held: ("clamped", &["s1=0"]),
        loads: vec![("end_force", [0.0, 0.0, force])],
        points: vec![[1.0, 1.0]],
        length,
        load_steps: &[1, 2, 4, 8],
        answer: Answer::Place("elastica that stretches, by integration", [x, width, z]),
        meshes: Meshes {
            own: &[2, 3, 4, 6, 8, 12, 16],
            finest: [64, 32],
            exudyn: &[4, 6, 8, 12, 16, 32, 64],
            is_strip: true,
        },
        ..square()
    }
}

/// Deflection in the middle of a square that all edges pin, over `q a^4 / D`: Navier's double series.
fn navier() -> f64 {
    let odd = || (0..TERMS).map(|k| f64::from(2 * k + 1));
    let mut sum = 0.0;
    for m in odd() {
        for n in odd() {
            let sign = (0.5 * PI * m).sin() * (0.5 * PI * n).sin();
            sum += sign / (m * n * (m * m + n * n).powi(2));
        }
    }
    16.0 / PI.powi(6) * sum
}

/// Place of the tip of a clamped line under a force across it, m: `EI theta'' = -(1 + P sin(theta) / EA) P cos(theta)`, integrated from the
/// tip, whose angle is such that the other end is level.
fn elastica(length: f64, bending: f64, axial: f64, force: f64) -> [f64; 2] {
    let (mut low, mut high) = (0.0, 0.5 * PI);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let [root, ..] = line(length, [bending, axial, force], middle);
        if root < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let [_, _, x, z] = line(length, [bending, axial, force], 0.5 * (low + high));
    [x, z]
}

/// Angle and curvature at the clamped end, and where the tip is from there, of a line with this angle at its tip.
fn line(length: f64, [bending, axial, force]: [f64; 3], tip: f64) -> [f64; 4] {
    let rate = |[angle, curvature, ..]: [f64; 4]| {
        let (sine, cosine) = angle.sin_cos();
        let stretch = 1.0 + force * sine / axial;
        // Along the way from the tip to the clamped end.
        [
            -curvature,
            stretch * force * cosine / bending,
            stretch * cosine,
            stretch * sine,
        ]
    };
    let h = length / f64::from(STEPS);
    let moved = |y: [f64; 4], by: [f64; 4], part: f64| std::array::from_fn(|k| y[k] + part * by[k]);
    let mut y = [tip, 0.0, 0.0, 0.0];
    for _ in 0..STEPS {
        let a = rate(y);
        let b = rate(moved(y, a, 0.5 * h));
        let c = rate(moved(y, b, 0.5 * h));
        let d = rate(moved(y, c, h));
        y = std::array::from_fn(|k| y[k] + h / 6.0 * (a[k] + 2.0 * (b[k] + c[k]) + d[k]));
    }
    y
}

impl Problem {
    /// Numbers of elements along both axes.
    pub fn mesh(&self, elements: u32) -> [u32; 2] {
        let across = if self.meshes.is_strip { 1 } else { elements };
        [elements, across]
    }

    /// The mesh in words.
    pub fn mesh_name(&self, elements: u32) -> String {
        let [along, across] = self.mesh(elements);
        format!("{along} x {across}")
    }

    /// Name of the marker of a point.
    pub fn marker(index: usize) -> String {
        format!("plate.point{index}")
    }

    /// Scene of Flexbody.
    pub fn scene(&self, elements: u32) -> Value {
        let [modulus, ratio, density] = self.material;
        let [along, across] = self.sides;
        let mut markers = json!({});
        let mut outputs = Vec::new();
        for (index, point) in self.points.iter().enumerate() {
            markers[format!("point{index}")] = json!(point);
            outputs.push(json!({ "kind": "position", "marker": Self::marker(index) }));
        }
        let (mut gravity, mut loads) = ([0.0; 3], Vec::new());
        for (name, value) in &self.loads {
            let mut load = json!({ "name": "load", "kind": "force", "value": value });
            match *name {
                "gravity" => {
                    gravity = *value;
                    continue;
                }
                "area_force" => {
                    load["kind"] = json!("area_force");
                    load["body"] = json!("plate");
                }
                "corner_force" => {
                    markers["corner"] = json!([1.0, 1.0]);
                    load["marker"] = json!("plate.corner");
                }
                _ => {
                    markers["end"] = json!({ "at": [1.0, 0.5], "pad": [1e-6, across] });
                    load["marker"] = json!("plate.end");
                }
            }
            loads.push(load);
        }
        let mut body = json!({
            "name": "plate", "element": "plate", "mesh": self.mesh(elements), "thickness": self.thickness,
            "surface": { "rectangle": { "corner": [0.0, 0.0, 0.0], "edges": [[along, 0.0, 0.0], [0.0, across, 0.0]] } },
            "material": { "youngs_modulus": modulus, "poisson_ratio": ratio, "density": density },
            "markers": markers,
        });
        if self.is_thrown {
            // Velocity of the corner, which the field is beside; the spin is about the middle.
            body["motion"] = json!({ "velocity": [1.5, -1.5, -0.5], "spin": [2.0, 1.0, 3.0],
                "deformation": ["0", "0", "3*(2*s1-1)^2 + 3*(2*s1-1)*(2*s2-1)"] });
        }
        let (kind, edges) = self.held;
        let joints: Vec<Value> = (edges.iter().enumerate())
            .map(|(k, edge)| json!({ "name": format!("edge{k}"), "kind": kind, "edges": ["ground", format!("plate.{edge}")] }))
            .collect();
        json!({
            "name": "plate", "dimension": 3, "gravity": gravity, "bodies": [body], "joints": joints, "loads": loads,
            "outputs": outputs, "accuracy": {},
        })
    }

    /// Options of Exudyn's run (`crates/studies/exudyn/plates.py`).
    pub fn options(&self, elements: u32, settings: &Value) -> Value {
        let [modulus, ratio, density] = self.material;
        let mut options = settings.clone();
        let (kind, edges) = self.held;
        let held = edges.iter().map(|edge| ((*edge).to_owned(), json!(kind)));
        let own = json!({
            "sides": self.sides, "mesh": self.mesh(elements), "thickness": self.thickness, "youngs_modulus": modulus,
            "poisson_ratio": ratio, "density": density, "is_thrown": self.is_thrown, "points": self.points,
            "edges": Value::Object(held.collect()),
        });
        for (key, value) in own.as_object().into_iter().flatten() {
            options[key] = value.clone();
        }
        for (name, value) in &self.loads {
            options[*name] = json!(value);
        }
        if let Some(motion) = self.motion {
            options["stop_time"] = json!(motion.stop);
            options["every"] = json!(motion.every);
        }
        options
    }
}

/// Bisshopp and Drucker (1945): the tip of an elastica that does not stretch under `4 EI / L^2` is at 0.67106 L and 0.66997 L.
#[test]
fn the_elastica_is_that_of_bisshopp_and_drucker() {
    let [x, z] = elastica(1.0, 1.0, 1e9, 4.0);
    assert!(
        (x - 0.671_06).abs() < 1e-5 && (z - 0.669_97).abs() < 1e-5,
        "{x} {z}"
    );
    let [root, curvature, ..] = line(1.0, [1.0, 1e9, 4.0], 1.0);
    // The first integral of the elastica, where nothing stretches.
    let first = 0.5 * curvature * curvature + 4.0 * root.sin();
    assert!((first - 4.0 * 1.0_f64.sin()).abs() < 1e-8, "{first}");
}

/// Timoshenko and Woinowsky-Krieger (1959), article 30.
#[test]
fn the_series_of_navier_is_that_of_the_books() {
    assert!((navier() - 0.004_062_352_66).abs() < 1e-10, "{}", navier());
}
