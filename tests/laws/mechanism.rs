//! Random mechanisms: bodies of all kinds, what holds them and what acts on them, in a description of
//! its own from which both a system (`built.rs`) and dense equations (`dense.rs`) are made.

use flexbody::bodies::Node;
use flexbody::elements::Element;
use flexbody::elements::cable::Cable;
use flexbody::math::function::Function;
use nalgebra::{DVector, Vector2};

/// A body.
#[derive(Clone)]
pub enum Body {
    Cable(Vec<Cable<2>>),
    Rigid {
        mass: f64,
        inertia: f64,
    },
    /// A point mass: its direction stays.
    Particle {
        mass: f64,
    },
}

/// A place on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    pub body: usize,
    pub at: At,
}

/// Where on a body: at a part of the length of a cable, or at a point of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum At {
    Part(f64),
    Point([f64; 2]),
}

/// A place on a body or a point of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Point {
    Ground(Vector2<f64>),
    On(Place),
}

/// `constant + amplitude sin(frequency t)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    pub constant: f64,
    pub amplitude: f64,
    pub frequency: f64,
}

impl Wave {
    pub fn value(&self, t: f64) -> f64 {
        self.constant + self.amplitude * (self.frequency * t).sin()
    }

    /// As the product knows it.
    pub fn function(&self) -> Function {
        let Self {
            constant,
            amplitude,
            frequency,
        } = self;
        let text = format!("{constant:?} + {amplitude:?}*sin({frequency:?}*t)");
        Function::expression(&text).expect("an expression")
    }
}

/// Kind of a joint or motion between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Revolute,
    /// With rotational stiffness, damping and rest angle.
    Hinge([f64; 3]),
    Weld(f64),
    /// Along this unit direction of the ground.
    Slider(Vector2<f64>),
    Orientation(f64),
    /// On a line through the first end, along this unit direction in its axes, and at an angle.
    Prismatic(Vector2<f64>, f64),
    Distance(f64),
    /// The second on the cable of the first.
    Along,
    DrivenAngle(Wave),
    DrivenPosition([Wave; 2]),
    DrivenWay(Vector2<f64>, Wave),
}

/// A joint or a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hold {
    pub kind: Kind,
    pub ends: [Point; 2],
}

/// Load on bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Acting {
    Force {
        at: Place,
        follower: bool,
        size: [Wave; 2],
    },
    Moment {
        ends: [Point; 2],
        size: Wave,
    },
    DistributedForce {
        body: usize,
        size: [Wave; 2],
    },
    Spring {
        ends: [Point; 2],
        stiffness: f64,
        damping: f64,
        length: Wave,
    },
}

/// A mechanism.
#[derive(Clone)]
pub struct Mechanism {
    pub bodies: Vec<Body>,
    /// First node of every body.
    pub firsts: Vec<usize>,
    pub nodes: Vec<Node>,
    pub holds: Vec<Hold>,
    pub loads: Vec<Acting>,
    /// Masses at places: mass, inertia of the direction.
    pub lumped_masses: Vec<(Place, [f64; 2])>,
    pub gravity: Vector2<f64>,
    pub rotation: f64,
    /// Numbers in (-1, 1) for anybody.
    pub noise: Vec<f64>,
}

/// A vector rotated left by a right angle.
pub fn left(v: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-v.y, v.x)
}

/// What matters, in a few lines: a failing case is read by people.
impl std::fmt::Debug for Mechanism {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (body, first) in self.bodies.iter().zip(&self.firsts) {
            match body {
                Body::Cable(_) => write!(f, "\n  cable of")?,
                Body::Rigid { mass, inertia } => write!(f, "\n  rigid {mass} kg {inertia} kg m^2")?,
                Body::Particle { mass } => write!(f, "\n  particle {mass} kg")?,
            }
            let lengths = body.elements().iter().map(Element::length);
            let nodes = &self.nodes[*first..first + body.sizes()[0]];
            write!(f, " {:?} m at {nodes:?}", lengths.collect::<Vec<_>>())?;
        }
        for hold in &self.holds {
            write!(f, "\n  {hold:?}")?;
        }
        for load in &self.loads {
            write!(f, "\n  {load:?}")?;
        }
        write!(
            f,
            "\n  lumped_masses {:?}, rotation {}",
            self.lumped_masses, self.rotation
        )
    }
}

impl Body {
    fn elements(&self) -> &[Cable<2>] {
        match self {
            Self::Cable(elements) => elements,
            _ => &[],
        }
    }

    /// Number of nodes, and of coordinates of unconnected parts.
    pub fn sizes(&self) -> [usize; 2] {
        match self {
            Self::Cable(elements) => [elements.len() + 1, 8 * elements.len()],
            _ => [1, 4],
        }
    }

    /// Reference length of a cable, m.
    pub fn length(&self) -> f64 {
        self.elements().iter().map(Element::length).sum()
    }
}

impl Mechanism {
    /// First coordinate of a body in vectors over unconnected parts.
    pub fn offset(&self, body: usize) -> usize {
        self.bodies[..body].iter().map(|b| b.sizes()[1]).sum()
    }

    /// Number of coordinates of unconnected parts.
    pub fn size(&self) -> usize {
        self.offset(self.bodies.len())
    }

    /// Coordinates of unconnected parts from those of nodes: every element has both its ends to itself.
    pub fn apart(&self, nodes: &[Node]) -> DVector<f64> {
        let mut numbers = Vec::new();
        for (body, first) in self.bodies.iter().zip(&self.firsts) {
            let count = body.elements().len();
            if count == 0 {
                numbers.extend(nodes[*first].as_flattened());
            }
            for j in 0..count {
                numbers.extend(nodes[first + j].as_flattened());
                numbers.extend(nodes[first + j + 1].as_flattened());
            }
        }
        DVector::from_vec(numbers)
    }

    /// Position and direction of a place: linear in the coordinates, so of rates as well.
    pub fn point(&self, place: Place, x: &DVector<f64>) -> [Vector2<f64>; 2] {
        let first = self.offset(place.body);
        let vector = |at: usize| Vector2::new(x[at], x[at + 1]);
        match place.at {
            At::Point([a, b]) => {
                let (p, u) = (vector(first), vector(first + 2));
                [p + u * a + left(u) * b, u]
            }
            At::Part(part) => {
                let body = &self.bodies[place.body];
                let (mut rest, mut j) = (part * body.length(), 0);
                let lengths: Vec<f64> = body.elements().iter().map(Element::length).collect();
                while j + 1 < lengths.len() && rest > lengths[j] - 1e-9 {
                    rest -= lengths[j];
                    j += 1;
                }
                let (l, z) = (lengths[j], rest / lengths[j]);
                let [p, s, q, t] = [0, 2, 4, 6].map(|k| vector(first + 8 * j + k));
                // Hermite's cubic, in powers of the way.
                let way = q - p;
                let square = way * 3.0 - (s * 2.0 + t) * l;
                let cube = (s + t) * l - way * 2.0;
                let at = p + s * (l * z) + square * (z * z) + cube * (z * z * z);
                let slope = s + (square * (2.0 * z) + cube * (3.0 * z * z)) / l;
                [at, slope]
            }
        }
    }

    /// Position and direction of a point; the ground looks along the first axis.
    pub fn end(&self, point: Point, x: &DVector<f64>) -> [Vector2<f64>; 2] {
        match point {
            Point::Ground(p) => [p, Vector2::x()],
            Point::On(place) => self.point(place, x),
        }
    }

    /// Velocity and rate of the direction of a point.
    pub fn end_rate(&self, point: Point, v: &DVector<f64>) -> [Vector2<f64>; 2] {
        match point {
            Point::Ground(_) => [Vector2::zeros(); 2],
            Point::On(place) => self.point(place, v),
        }
    }

    /// The place on the cable of a point that is nearest to `p`.
    pub fn nearest(&self, on: Point, p: Vector2<f64>, x: &DVector<f64>) -> Place {
        let Point::On(Place { body, .. }) = on else {
            panic!("a cable");
        };
        let at = |part: f64| Place {
            body,
            at: At::Part(part),
        };
        let away = |part: f64| (self.point(at(part), x)[0] - p).norm();
        let steps = 200_u32;
        let parts = (0..=steps).map(|i| f64::from(i) / f64::from(steps));
        let start = parts.min_by(|a, b| away(*a).total_cmp(&away(*b)));
        let mut part = start.unwrap_or(0.0);
        let length = self.bodies[body].length();
        for _ in 0..50 {
            // Newton on (p - r) . r' without the curvature: the way is short where it matters.
            let [r, slope] = self.point(at(part), x);
            part += (p - r).dot(&slope) / slope.norm_squared() / length;
        }
        at(part)
    }

    /// The elements with their first coordinates.
    pub fn elements(&self) -> impl Iterator<Item = (usize, &Cable<2>)> {
        (0..self.bodies.len()).flat_map(|b| {
            let first = self.offset(b);
            let elements = self.bodies[b].elements().iter().enumerate();
            elements.map(move |(j, element)| (first + 8 * j, element))
        })
    }

    /// Whether a point has a direction that can rotate, or is the ground.
    pub fn turns(&self, point: Point) -> bool {
        match point {
            Point::Ground(_) => true,
            Point::On(place) => !matches!(self.bodies[place.body], Body::Particle { .. }),
        }
    }

    /// Whether anything slides along a cable.
    pub fn slides(&self) -> bool {
        self.holds.iter().any(|hold| hold.kind == Kind::Along)
    }
}
