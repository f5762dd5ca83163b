//! The scenes, as the product has them, and what they become in every formulation.

use serde_json::Value;

use super::basis::{Basis, Held, Modes};
use super::corotational::{Corotational, Inertia, Local};
use super::frame::FloatingFrame;
use super::rigid::Rigid;
use super::rotations::{Interpolation, Rotations};
use super::system::{Item, Joint, Load, System, To};
use super::{Body, BodyMarker, Marker, Placement, Vector, plus};

/// A straight uniform rod.
#[derive(Clone, Copy, Debug)]
pub struct Rod {
    /// Length, m.
    pub length: f64,
    /// Stiffness EA, N.
    pub axial: f64,
    /// Shear stiffness GA with its factor, N; of formulations that shear.
    pub shear: f64,
    /// Stiffness EI, N m^2.
    pub bending: f64,
    /// Mass per length, kg/m.
    pub density: f64,
    /// Rotary inertia per length, kg m; of formulations that have it.
    pub rotary: f64,
}

/// A formulation with its numbers of elements or modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Floating frame: bending and axial modes, with foreshortening or without
    Frame(usize, usize, bool),
    /// Corotational elements
    Corotational(usize, Local, Inertia),
    /// Elements with rotations
    Rotations(usize, Interpolation),
}

impl Choice {
    /// Returns the name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Frame(.., true) => "floating_frame_foreshortened",
            Self::Frame(.., false) => "floating_frame",
            Self::Corotational(_, _, Inertia::Lumped) => "corotational_lumped",
            Self::Corotational(_, Local::Linear, _) => "corotational",
            Self::Corotational(_, Local::ShallowArch, _) => "corotational_arch",
            Self::Rotations(_, interpolation) => {
                match (interpolation.degree, interpolation.reduced) {
                    (1, true) => "rotations_linear_reduced",
                    (1, false) => "rotations_linear_full",
                    (_, true) => "rotations_quadratic_reduced",
                    (_, false) => "rotations_quadratic_full",
                }
            }
        }
    }

    /// Elements or modes.
    pub fn count(self) -> usize {
        match self {
            Self::Frame(bending, axial, _) => bending + axial,
            Self::Corotational(elements, ..) | Self::Rotations(elements, _) => elements,
        }
    }

    /// Whether it shears and has rotary inertia.
    pub fn shears(self) -> bool {
        matches!(self, Self::Rotations(..))
    }

    /// A rod in this formulation; modes are those of a rod held so.
    pub fn rod(self, rod: Rod, held: Held) -> Box<dyn Body> {
        match self {
            Self::Frame(bending, axial, foreshortening) => {
                let modes = Modes {
                    held,
                    bending,
                    axial,
                    foreshortening,
                };
                Box::new(FloatingFrame::new(Basis::modes(&rod, modes)))
            }
            Self::Corotational(elements, local, inertia) => {
                Box::new(Corotational::new(rod, elements, local, inertia))
            }
            Self::Rotations(elements, shape) => Box::new(Rotations::new(rod, elements, shape)),
        }
    }
}

/// Coordinates and rates of nodes at equal distances: positions and angles.
pub fn nodes_of(length: f64, count: usize, placement: &Placement) -> [Vec<f64>; 2] {
    let (s, c) = placement.angle.sin_cos();
    let node = |i: usize| {
        let at = length * i as f64 / (count - 1) as f64;
        let [x, y] = plus(placement.start, at, [c, s]);
        let [u, v] = plus(placement.velocity, at * placement.spin, [-s, c]);
        ([x, y, placement.angle], [u, v, placement.spin])
    };
    let (q, v): (Vec<_>, Vec<_>) = (0..count).map(node).unzip();
    [q.concat(), v.concat()]
}

/// A scene that is played.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Played {
    /// A steel rod, pinned, falls
    SteelPendulum,
    /// A soft one
    SoftPendulum,
    /// A beam is rotated faster and faster
    SpinUp,
    /// A driven crank with a flexible rod
    SliderCrank,
    /// A free rod is thrown and bent by loads on its end
    Spaghetti,
}

/// All of them.
pub const SCENES: [Played; 5] = [
    Played::SteelPendulum,
    Played::SoftPendulum,
    Played::SpinUp,
    Played::SliderCrank,
    Played::Spaghetti,
];

const STEEL: &str = include_str!("../../../../tests/cases/steel_pendulum/scene.json");
const SOFT: &str = include_str!("../../../../tests/cases/soft_pendulum/scene.json");
const SPIN_UP: &str = include_str!("../../../../scenes/spin_up_beam.json");
const CRANK: &str = include_str!("../../../../scenes/slider_crank.json");
const SPAGHETTI: &str = include_str!("../../../../tests/cases/flying_spaghetti/triangular.json");

/// Shear modulus with the factor of a rectangle over the modulus of elasticity, Poisson's ratio 0.3.
const SHEAR: f64 = 5.0 / 6.0 / 2.6;

impl Played {
    /// Returns the name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::SteelPendulum => "steel_pendulum",
            Self::SoftPendulum => "soft_pendulum",
            Self::SpinUp => "spin_up",
            Self::SliderCrank => "slider_crank",
            Self::Spaghetti => "flying_spaghetti",
        }
    }

    /// As the product reads it.
    pub fn json(self) -> Value {
        let text = match self {
            Self::SteelPendulum => STEEL,
            Self::SoftPendulum => SOFT,
            Self::SpinUp => SPIN_UP,
            Self::SliderCrank => CRANK,
            Self::Spaghetti => SPAGHETTI,
        };
        serde_json::from_str(text).unwrap_or_default()
    }

    /// Which body of the scene is the rod.
    pub fn rod_index(self) -> usize {
        usize::from(self == Self::SliderCrank)
    }

    /// Returns the markers that are compared, by their names in the product.
    pub fn markers(self) -> &'static [&'static str] {
        match self {
            Self::SteelPendulum | Self::SoftPendulum | Self::SpinUp => &["rod.tip"],
            Self::SliderCrank => &["rod.middle", "block.centre"],
            Self::Spaghetti => &["rod.bottom", "rod.middle", "rod.top"],
        }
    }

    /// Returns the markers that are compared, on bodies of [`Played::system`].
    pub fn places(self) -> &'static [BodyMarker] {
        match self {
            Self::SteelPendulum | Self::SoftPendulum | Self::SpinUp => {
                const { &[Marker::End.on(0)] }
            }
            Self::SliderCrank => const { &[Marker::Middle.on(1), Marker::Start.on(2)] },
            Self::Spaghetti => {
                const { &[Marker::Start.on(0), Marker::Middle.on(0), Marker::End.on(0)] }
            }
        }
    }

    /// When it is looked at, s.
    pub fn times(self) -> Vec<f64> {
        let (every, count) = match self {
            Self::SteelPendulum | Self::SoftPendulum => (0.1, 11),
            Self::SpinUp => (1.0, 20),
            Self::SliderCrank => (0.05, 20),
            Self::Spaghetti => (0.5, 20),
        };
        (1..=count).map(|i| f64::from(i) * every).collect()
    }

    /// The rod. Shear stiffness of the two scenes of Simo and Vu-Quoc is theirs.
    pub fn rod(self) -> Rod {
        let scene = self.json();
        let body = &scene["bodies"][self.rod_index()];
        let number = |key: &str| {
            body.pointer(key)
                .and_then(Value::as_f64)
                .unwrap_or(f64::NAN)
        };
        let (modulus, density) = (
            number("/material/youngs_modulus"),
            number("/material/density"),
        );
        let (area, second) = (number("/section/area"), number("/section/second_moment"));
        let axial = modulus * area;
        Rod {
            length: self.line().1,
            axial,
            shear: match self {
                Self::SpinUp => 1e7,
                Self::Spaghetti => axial,
                _ => SHEAR * axial,
            },
            bending: modulus * second,
            density: density * area,
            rotary: density * second,
        }
    }

    /// Placement and length of the rod.
    fn line(self) -> (Placement, f64) {
        let scene = self.json();
        let body = &scene["bodies"][self.rod_index()];
        let pair = |key: &str| {
            let at = |i: usize| body.pointer(key).and_then(|pair| pair[i].as_f64());
            [at(0).unwrap_or_default(), at(1).unwrap_or_default()]
        };
        let (from, to) = (pair("/shape/line/from"), pair("/shape/line/to"));
        let way = plus(to, -1.0, from);
        let spin = body.pointer("/motion/spin").and_then(Value::as_f64);
        let placement = Placement {
            start: from,
            angle: way[1].atan2(way[0]),
            velocity: pair("/motion/velocity"),
            spin: spin.unwrap_or_default(),
        };
        (placement, way[0].hypot(way[1]))
    }

    fn held(self) -> Held {
        match self {
            Self::SteelPendulum | Self::SoftPendulum => Held::Start,
            Self::SpinUp => Held::Clamped,
            Self::SliderCrank => Held::BothEnds,
            Self::Spaghetti => Held::Nothing,
        }
    }

    /// The whole in a formulation.
    pub fn system(self, choice: Choice) -> System {
        self.with(self.rod(), choice)
    }

    /// Builds the system with another rod.
    pub fn with(self, rod: Rod, choice: Choice) -> System {
        let rod = choice.rod(rod, self.held());
        let placement = self.line().0;
        let start = Marker::Start.on(0);
        let pin = Item::Joint(Joint::Pin {
            at: start,
            to: To::Ground(placement.start),
        });
        let mut items = Vec::new();
        let mut loads = Vec::new();
        match self {
            Self::SteelPendulum | Self::SoftPendulum => items.push(pin),
            Self::SpinUp => {
                let drive = Joint::Drive {
                    at: start,
                    angle: spin_up,
                };
                items.extend([pin, Item::Joint(drive)]);
            }
            Self::SliderCrank => return slider_crank(rod, placement),
            Self::Spaghetti => loads.push(Load {
                at: start,
                value: Box::new(thrown),
            }),
        }
        items.push(Item::Body(rod, placement));
        let falls = matches!(self, Self::SteelPendulum | Self::SoftPendulum);
        System::new(items, loads, if falls { GRAVITY } else { [0.0; 2] })
    }
}

const GRAVITY: Vector = [0.0, -9.81];

/// J. C. Simo, L. Vu-Quoc, J. Sound Vib. 119 (1987) 487-508: to 6 rad/s in 15 s.
fn spin_up(t: f64) -> [f64; 3] {
    let rate = std::f64::consts::TAU / 15.0;
    match t {
        _ if t < 15.0 => [
            0.4 * (0.5 * t * t + ((rate * t).cos() - 1.0) / (rate * rate)),
            0.4 * (t - (rate * t).sin() / rate),
            0.4 * (1.0 - (rate * t).cos()),
        ],
        _ => [6.0 * t - 45.0, 6.0, 0.0],
    }
}

/// Force of 8 N and moment of -80 N m that rise for 2.5 s and fall for 2.5 s.
fn thrown(t: f64) -> [f64; 3] {
    let part = (1.0 - (t / 2.5 - 1.0).abs()).max(0.0);
    [8.0 * part, 0.0, -80.0 * part]
}

fn slider_crank(rod: Box<dyn Body>, placement: Placement) -> System {
    let (crank, link, block) = (0, 1, 2);
    let bar = Rigid {
        mass: 0.033,
        bar: Some([0.152, 6.37e-5]),
    };
    let particle = Rigid {
        mass: 0.05,
        bar: None,
    };
    let at = |x: f64, velocity: f64, spin: f64| Placement {
        start: [x, 0.0],
        angle: 0.0,
        velocity: [0.0, velocity],
        spin,
    };
    let drive = Joint::Drive {
        at: Marker::Start.on(crank),
        angle: |t| [20.0 * t, 20.0, 0.0],
    };
    let pin = |at, to| Item::Joint(Joint::Pin { at, to });
    let guide = Joint::Guide {
        at: Marker::Start.on(block),
        height: 0.0,
    };
    let items = vec![
        pin(Marker::Start.on(crank), To::Ground([0.0; 2])),
        Item::Joint(drive),
        Item::Body(Box::new(bar), at(0.0, 0.0, 20.0)),
        pin(Marker::Start.on(link), To::Body(Marker::End.on(crank))),
        Item::Body(rod, placement),
        pin(Marker::Start.on(block), To::Body(Marker::End.on(link))),
        Item::Body(Box::new(particle), at(0.456, 0.0, 0.0)),
        Item::Joint(guide),
    ];
    System::new(items, Vec::new(), GRAVITY)
}
