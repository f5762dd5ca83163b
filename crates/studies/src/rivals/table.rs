//! `studies rivals`: error against CPU time of every formulation on every scene, as CSV.

use std::time::Duration;

use super::corotational::{Inertia, Local};
use super::march::{Kind, run};
use super::product::{Path, adaptive, alpha, converged, energy_turned};
use super::rotations::Interpolation;
use super::scenes::{Choice, Played, SCENES};
use super::{Body, Placement, increments};
use crate::scene::Outcome;

/// Runs whose median counts.
const RUNS: usize = 3;
/// What costs more CPU time than this, s, is measured once, and finer steps are left out.
const LONGEST: f64 = 2.0;
/// What is worse than this is no result.
const LOST: f64 = 3.0;

/// Arguments that select rows.
#[derive(clap::Args)]
pub struct Rivals {
    /// Only scenes with this in their name.
    #[arg(long, default_value = "")]
    scene: String,
    /// Only formulations with this in their name.
    #[arg(long, default_value = "")]
    formulation: String,
}

/// Prints the table.
pub fn rivals(arguments: &Rivals) -> Outcome<()> {
    println!("formulation,scene,settings,elements,error,cpu_time_s");
    for scene in SCENES {
        if scene.name().contains(&arguments.scene) {
            play(scene, &arguments.formulation)?;
        }
    }
    if "rigid_rotation".contains(&arguments.scene) {
        rigid_rotation()?;
    }
    Ok(())
}

/// Largest distance of all markers at all times over the length.
pub fn apart(found: &Path, reference: &Path, length: f64) -> f64 {
    let points = found.iter().flatten().zip(reference.iter().flatten());
    let far = points.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
    far.fold(0.0, f64::max) / length
}

/// Converged references: the product's cable, which formulations without shear share, and Simo and Vu-Quoc's beam with
/// shear and rotary inertia.
pub struct References {
    /// Without shear.
    pub cable: Path,
    /// With it.
    pub shearing: Path,
}

impl References {
    /// Computes both; steps of the second are extrapolated to zero.
    pub fn new(scene: Played) -> Outcome<Self> {
        let (elements, step) = match scene {
            Played::SteelPendulum => (16, 1e-4),
            Played::SoftPendulum => (240, 0.0),
            Played::SpinUp => (16, 2e-3),
            Played::SliderCrank => (16, 5e-5),
            Played::Spaghetti => (96, 0.0),
        };
        let quadratic = Interpolation {
            degree: 2,
            reduced: true,
        };
        let choice = Choice::Rotations(elements, quadratic);
        let path = |kind: Kind| {
            let seen = run(
                &mut scene.system(choice),
                kind,
                &scene.times(),
                scene.places(),
            );
            let lost = |time| format!("{}: the reference ends at {time} s", scene.name());
            seen.map_err(lost).map(|seen| seen.positions)
        };
        let shearing = match step {
            0.0 => path(Kind::Explicit(0.8))?,
            step => {
                let [coarse, fine] = [path(Kind::Alpha(step))?, path(Kind::Alpha(0.5 * step))?];
                extrapolated(&coarse, &fine)
            }
        };
        let cable = converged(scene)?.0;
        Ok(Self { cable, shearing })
    }
}

fn extrapolated(coarse: &Path, fine: &Path) -> Path {
    let point = |(a, b): (&[f64; 2], &[f64; 2])| [0, 1].map(|k| (4.0 * b[k] - a[k]) / 3.0);
    let row = |(a, b): (&Vec<_>, &Vec<_>)| a.iter().zip(b).map(point).collect();
    coarse.iter().zip(fine).map(row).collect()
}

/// What is tried on a scene.
struct Grid {
    /// Steps of generalized-alpha, s.
    steps: &'static [f64],
    /// Bending and axial modes.
    modes: &'static [(usize, usize)],
    /// Elements; even.
    elements: &'static [usize],
    /// Whether explicit steps make sense for elements, and for modes.
    explicit: [bool; 2],
}

fn grid(scene: Played) -> Grid {
    match scene {
        Played::SteelPendulum => Grid {
            steps: &[0.05, 0.02, 0.01, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4],
            modes: &[(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (4, 1)],
            elements: &[2, 4, 8],
            explicit: [false, true],
        },
        Played::SoftPendulum => Grid {
            steps: &[0.02, 0.01, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4],
            modes: &[(2, 0), (4, 1), (6, 2), (10, 4)],
            elements: &[10, 20, 40, 80, 160],
            explicit: [true, true],
        },
        Played::SpinUp => Grid {
            steps: &[0.2, 0.1, 0.05, 0.02, 0.01, 5e-3, 2e-3],
            modes: &[(1, 0), (2, 0), (3, 0), (4, 0), (4, 1), (6, 2)],
            elements: &[2, 4, 8, 16],
            explicit: [false, true],
        },
        Played::SliderCrank => Grid {
            steps: &[0.01, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5],
            modes: &[(1, 0), (2, 0), (3, 0), (4, 0), (4, 1), (6, 2)],
            elements: &[2, 4, 8, 16],
            explicit: [false, true],
        },
        Played::Spaghetti => Grid {
            steps: &[0.1, 0.05, 0.02, 0.01, 5e-3, 2e-3],
            modes: &[(2, 0), (4, 1), (6, 2), (10, 4)],
            elements: &[8, 16, 32, 64],
            explicit: [true, true],
        },
    }
}

/// One run, to be repeated.
type Once<'a> = &'a dyn Fn() -> Outcome<(Path, Duration)>;

/// Columns that say what a row is of.
struct RowLabel<'a> {
    name: &'a str,
    settings: &'a str,
    /// Number of elements.
    count: usize,
}

/// Where rows go.
struct Sheet<'a> {
    scene: Played,
    only: &'a str,
    length: f64,
}

impl Sheet<'_> {
    /// Measures a row; its CPU time, or nothing where it is left out or ends in failure, which the row says.
    fn row(&self, label: &RowLabel<'_>, reference: &Path, once: Once) -> Option<f64> {
        let RowLabel {
            name,
            settings,
            count,
        } = *label;
        if !name.contains(self.only) {
            return None;
        }
        eprintln!("{}: {name}, {settings}, {count}", self.scene.name());
        let first = once();
        let (error, times) = match first {
            Err(_) => (f64::INFINITY, vec![f64::NAN]),
            Ok((path, spent)) => {
                let mut times = vec![spent.as_secs_f64()];
                if times[0] < LONGEST {
                    let again = (1..RUNS).filter_map(|_| once().ok());
                    times.extend(again.map(|(_, spent)| spent.as_secs_f64()));
                }
                times.sort_by(f64::total_cmp);
                (apart(&path, reference, self.length), times)
            }
        };
        let fails = error.is_nan() || error > LOST;
        let [error, time] = if fails {
            ["inf".to_owned(), "nan".to_owned()]
        } else {
            [error, times[times.len() / 2]].map(|x| format!("{x:.3e}"))
        };
        println!(
            "{name},{},{settings},{count},{error},{time}",
            self.scene.name()
        );
        (!fails).then_some(times[0])
    }
}

fn play(scene: Played, only: &str) -> Outcome<()> {
    eprintln!("{}: references", scene.name());
    let references = References::new(scene)?;
    let sheet = Sheet {
        scene,
        only,
        length: scene.rod().length,
    };
    let between = apart(&references.shearing, &references.cable, sheet.length);
    eprintln!("{}: references differ by {between:.2e} L", scene.name());
    let grid = grid(scene);
    for elements in grid.elements {
        for tolerance in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            let label = RowLabel {
                name: "product",
                settings: &format!("tolerance={tolerance:e}"),
                count: *elements,
            };
            let once = || adaptive(scene, *elements, tolerance);
            if (sheet.row(&label, &references.cable, &once)).is_some_and(|time| time > LONGEST) {
                break;
            }
        }
        for step in grid.steps {
            let label = RowLabel {
                name: "product_alpha",
                settings: &format!("step={step:e}"),
                count: *elements,
            };
            let time = sheet.row(&label, &references.cable, &|| {
                alpha(scene, *elements, *step)
            });
            if time.is_some_and(|time| time > LONGEST) {
                break;
            }
        }
    }
    for choice in choices(&grid) {
        measure(&sheet, choice, &grid, &references);
    }
    Ok(())
}

fn choices(grid: &Grid) -> Vec<Choice> {
    let mut all = Vec::new();
    for foreshortening in [false, true] {
        let frame =
            |(bending, axial): &(usize, usize)| Choice::Frame(*bending, *axial, foreshortening);
        all.extend(grid.modes.iter().map(frame));
    }
    for (local, inertia) in [
        (Local::Linear, Inertia::Cubic),
        (Local::ShallowArch, Inertia::Cubic),
        (Local::ShallowArch, Inertia::Lumped),
    ] {
        let made = |n: &usize| Choice::Corotational(*n, local, inertia);
        all.extend(grid.elements.iter().map(made));
    }
    for (degree, reduced) in [(1, false), (1, true), (2, false), (2, true)] {
        let made = |n: &usize| Choice::Rotations(*n, Interpolation { degree, reduced });
        all.extend(grid.elements.iter().map(made));
    }
    all
}

fn measure(sheet: &Sheet<'_>, choice: Choice, grid: &Grid, references: &References) {
    let scene = sheet.scene;
    let reference = if choice.shears() {
        &references.shearing
    } else {
        &references.cable
    };
    let once = |kind: Kind| {
        let seen = run(
            &mut scene.system(choice),
            kind,
            &scene.times(),
            scene.places(),
        );
        let seen = seen.map_err(|time| format!("ends at {time} s"))?;
        Ok((seen.positions, seen.spent))
    };
    let modal = matches!(choice, Choice::Frame(..));
    let axial = match choice {
        Choice::Frame(bending, axial, _) => format!(" modes={bending}+{axial}"),
        _ => String::new(),
    };
    let parts: &[f64] = if modal {
        &[0.9, 0.5, 0.25, 0.1, 0.05, 0.02]
    } else {
        &[0.9, 0.5]
    };
    if grid.explicit[usize::from(modal)] && choice.count() > 0 {
        for part in parts {
            let label = RowLabel {
                name: choice.name(),
                settings: &format!("rk4={part}{axial}"),
                count: choice.count(),
            };
            let time = sheet.row(&label, reference, &|| once(Kind::Explicit(*part)));
            if time.is_some_and(|time| time > LONGEST) {
                break;
            }
        }
    }
    for step in grid.steps {
        let label = RowLabel {
            name: choice.name(),
            settings: &format!("alpha={step:e}{axial}"),
            count: choice.count(),
        };
        let time = sheet.row(&label, reference, &|| once(Kind::Alpha(*step)));
        if time.is_some_and(|time| time > LONGEST) {
            break;
        }
    }
}

/// Largest strain `sqrt(2 U / (EA L))` of an undeformed rod in eight directions.
pub fn strain_turned(body: &dyn Body, played: Played) -> f64 {
    let rod = played.rod();
    let strain = |direction: u32| {
        let placement = Placement {
            start: [0.3, -0.2],
            angle: std::f64::consts::TAU * f64::from(direction) / 8.0,
            velocity: [0.0; 2],
            spin: 0.0,
        };
        let [q, _] = body.place(&placement);
        (2.0 * body.strain_energy(&q) / (rod.axial * rod.length)).sqrt()
    };
    (1..=8).map(strain).fold(0.0, f64::max)
}

/// Rows on an undeformed beam that is rotated: whether it feels that.
fn rigid_rotation() -> Outcome<()> {
    let played = Played::SteelPendulum;
    let rod = played.rod();
    let line = |name: &str, settings: &str, count: usize, strain: f64| {
        println!("{name},rigid_rotation,{settings},{count},{strain:.3e},nan");
    };
    let energy = energy_turned(played, 8, 8)?;
    line(
        "product",
        "turned",
        8,
        (2.0 * energy / (rod.axial * rod.length)).sqrt(),
    );
    for choice in [
        Choice::Frame(4, 1, false),
        Choice::Frame(4, 1, true),
        Choice::Corotational(8, Local::Linear, Inertia::Cubic),
        Choice::Corotational(8, Local::ShallowArch, Inertia::Cubic),
        Choice::Rotations(
            8,
            Interpolation {
                degree: 1,
                reduced: false,
            },
        ),
        Choice::Rotations(
            8,
            Interpolation {
                degree: 1,
                reduced: true,
            },
        ),
        Choice::Rotations(
            8,
            Interpolation {
                degree: 2,
                reduced: false,
            },
        ),
        Choice::Rotations(
            8,
            Interpolation {
                degree: 2,
                reduced: true,
            },
        ),
    ] {
        let body = choice.rod(rod, super::basis::Held::Start);
        line(
            choice.name(),
            "turned",
            choice.count(),
            strain_turned(&*body, played),
        );
    }
    for count in [12, 36, 120, 360, 1200, 3600] {
        let strain = increments::stretch_of_a_turn(count).abs();
        line(
            "linear_increments",
            &format!("increments={count}"),
            1,
            strain,
        );
    }
    Ok(())
}
