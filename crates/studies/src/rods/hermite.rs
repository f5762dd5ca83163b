//! The rod of the product on its Hermite line, written anew for straight ones, with the terms in it that rivals leave out.
//!
//! Source: `src/elements/rod/mod.rs`; C. Meier, A. Popp, W. A. Wall, Geometrically exact finite element formulations for slender
//! beams, Arch. Comput. Methods Eng. 26 (2019).

use flexbody::elements::shape;

use super::statics::Line;
use super::{Number, Real3, Vector, angle, carry, gradient, lift, number, real, unit, vector};

/// Numbers of a node: position, slope, rotation about the tangent.
pub const NODE: usize = 7;
/// Numbers of an element: two nodes and the internal twist.
pub const ELEMENT: usize = 2 * NODE + 1;

/// Points and weights on [0, 1] of Gauss, exact to degree 5, and of Lobatto, to degree 3.
const GAUSS: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_3, 5.0 / 18.0],
    [0.5, 4.0 / 9.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];
const LOBATTO: [[f64; 2]; 3] = [[0.0, 1.0 / 6.0], [0.5, 2.0 / 3.0], [1.0, 1.0 / 6.0]];

/// Stiffness of a section.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// EA, N.
    pub axial: f64,
    /// GJ, and EI about `d` and about `t x d`, N m^2.
    pub stiffness: [f64; 3],
}

/// Which terms stay.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    /// The twist of the transported frame itself, `-(z . kappa) / (1 + z . t)`.
    pub own_twist: bool,
    /// The internal twist of the elements.
    pub internal_twist: bool,
}

/// All of them: the product's rod.
pub const ALL: Kept = Kept {
    own_twist: true,
    internal_twist: true,
};

/// Position, slope and unit vector of the section across it.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    pub r: Real3,
    pub u: Real3,
    pub d: Real3,
}

impl Node {
    /// Moved by position, slope and rotation about the tangent; before this rotation the section rotates with the tangent by the
    /// smallest one.
    pub fn moved(&self, step: &[Number]) -> [Vector; 3] {
        let r = lift(self.r) + vector(step, 0);
        let u = lift(self.u) + vector(step, 3);
        let (before, t) = (lift(self.u.normalize()), unit(&u));
        let carried = carry(&before, &t, &lift(self.d));
        let turned = carried * step[6].cos() + t.cross(&carried) * step[6].sin();
        [r, u, turned]
    }

    /// Moves the node by a step, and removes the roundoff across the slope and in the length.
    pub fn accept(&mut self, step: &[f64]) {
        let step: Vec<Number> = step.iter().copied().map(number).collect();
        let [r, u, d] = self.moved(&step).map(|v| real(&v));
        let t = u.normalize();
        *self = Self {
            r,
            u,
            d: (d - t * t.dot(&d)).normalize(),
        };
    }
}

/// A rod, straight without stress.
#[derive(Clone, Debug)]
pub struct Rod {
    /// Nodes of the rod.
    pub nodes: Vec<Node>,
    /// Internal twists of its elements, rad.
    pub bubbles: Vec<f64>,
    /// Reference length of an element, m.
    pub length: f64,
    pub(super) section: Section,
    kept: Kept,
    /// Dead force (N) and moment (N m) at the last node.
    load: [Real3; 2],
}

impl Rod {
    /// Along the first axis from the origin, its sections' `d` along the second.
    pub fn straight(length: f64, elements: usize, section: Section, kept: Kept) -> Self {
        let length = length / elements as f64;
        let node = |k: usize| Node {
            r: Real3::x() * length * k as f64,
            u: Real3::x(),
            d: Real3::y(),
        };
        Self {
            nodes: (0..=elements).map(node).collect(),
            bubbles: vec![0.0; elements],
            length,
            section,
            kept,
            load: [Real3::zeros(); 2],
        }
    }

    /// The last node.
    pub fn tip(&self) -> &Node {
        &self.nodes[self.nodes.len() - 1]
    }

    /// Loads the rod with a dead force (N) and a dead moment (N m) at its last node.
    pub fn under(mut self, force: Real3, moment: Real3) -> Self {
        self.load = [force, moment];
        self
    }

    /// Strain energy of bending and torsion of an element at nodes, J.
    fn bending(&self, a: &[Vector; 3], b: &[Vector; 3], bubble: Number) -> Number {
        let l = self.length;
        let line = |weights: [f64; 4]| {
            let [ra, ua, _] = a;
            let [rb, ub, _] = b;
            let [p, q, r, s] = weights.map(number);
            ra * p + ua * q + rb * r + ub * s
        };
        let at = |xi: f64| {
            let u = line(shape::slopes(xi, l).into());
            (u, line(shape::curvatures(xi, l).into()))
        };
        let middle = unit(&at(0.5).0);
        let [first, last] = [a, b].map(|[_, u, d]| carry(&unit(u), &middle, d));
        let side = middle.cross(&first);
        let twist = angle([first.dot(&last), side.dot(&last)]);
        let mut sum = number(0.0);
        for [xi, weight] in GAUSS {
            let (u, w) = at(xi);
            let (t, kappa) = (unit(&u), u.cross(&w) / u.dot(&u));
            let phi = twist * xi + bubble * (4.0 * xi * (1.0 - xi));
            let turned = first * phi.cos() + side * phi.sin();
            let axis = carry(&middle, &t, &turned);
            let mut strains = [
                (twist + bubble * (4.0 - 8.0 * xi)) / l,
                kappa.dot(&axis),
                kappa.dot(&t.cross(&axis)),
            ];
            if self.kept.own_twist {
                strains[0] -= middle.dot(&kappa) / (number(1.0) + middle.dot(&t));
            }
            for (strain, stiffness) in strains.iter().zip(self.section.stiffness) {
                sum += strain * strain * (0.5 * stiffness * weight * l);
            }
        }
        sum
    }

    /// Strain energy of stretching of an element at nodes, J.
    fn stretching(&self, a: &[Vector; 3], b: &[Vector; 3]) -> Number {
        let l = self.length;
        let mut sum = number(0.0);
        for [xi, weight] in LOBATTO {
            let [p, q, r, s] = <[f64; 4]>::from(shape::slopes(xi, l)).map(number);
            let u = a[0] * p + a[1] * q + b[0] * r + b[1] * s;
            let strain = u.dot(&u).sqrt() - 1.0;
            sum += strain * strain * (0.5 * self.section.axial * weight * l);
        }
        sum
    }

    fn energy_of(&self, element: usize, step: &[Number; ELEMENT]) -> Number {
        let a = self.nodes[element].moved(&step[..NODE]);
        let b = self.nodes[element + 1].moved(&step[NODE..2 * NODE]);
        let bubble = number(self.bubbles[element]) + step[2 * NODE];
        self.bending(&a, &b, bubble) + self.stretching(&a, &b)
    }

    /// Strain energy, J.
    pub fn energy(&self) -> f64 {
        let still = [number(0.0); ELEMENT];
        (0..self.bubbles.len())
            .map(|element| self.energy_of(element, &still).re)
            .sum()
    }
}

impl Line for Rod {
    const NODE: usize = NODE;
    const INTERNAL: usize = 1;

    fn elements(&self) -> usize {
        self.bubbles.len()
    }

    /// The clamp leaves the stretch.
    fn held(&self) -> Vec<usize> {
        let held = [0, 1, 2, 4, 5, 6].into_iter();
        let internal = NODE * self.nodes.len()..NODE * self.nodes.len() + self.bubbles.len();
        if self.kept.internal_twist {
            held.collect()
        } else {
            held.chain(internal).collect()
        }
    }

    fn slopes(&self, element: usize, step: &[f64]) -> Vec<f64> {
        let step = <&[f64; ELEMENT]>::try_from(step).expect("numbers of an element");
        gradient(step, |step| self.energy_of(element, step)).to_vec()
    }

    /// A moment rotates slopes, and sections about the tangent: of their spin the chart's rotation is short of what the tangent's rotate
    /// takes.
    fn load(&self, part: f64, step: &[f64]) -> Vec<f64> {
        let node = self.tip();
        let [force, moment] = self.load.map(|load| load * part);
        let (u, before) = (
            node.u + Real3::new(step[3], step[4], step[5]),
            node.u.normalize(),
        );
        let t = u.normalize();
        let half = before.cross(&t) / (1.0 + before.dot(&t));
        let lost = (half - t * t.dot(&half)) / u.norm() * moment.dot(&t);
        let slope = moment.cross(&u) / u.norm_squared() - lost;
        let (f, s) = (force, slope);
        vec![f.x, f.y, f.z, s.x, s.y, s.z, moment.dot(&t)]
    }

    fn accept(&mut self, step: &[f64]) {
        let (nodes, bubbles) = step.split_at(NODE * self.nodes.len());
        for (node, step) in self.nodes.iter_mut().zip(nodes.chunks(NODE)) {
            node.accept(step);
        }
        for (bubble, step) in self.bubbles.iter_mut().zip(bubbles) {
            *bubble += step;
        }
    }
}

/// Torque of an element of unit length and torsional stiffness whose ends are rotated by an angle (rad) against each other, N m.
pub fn torque_at(angle: f64) -> f64 {
    let section = Section {
        axial: 1.0,
        stiffness: [1.0; 3],
    };
    let mut rod = Rod::straight(1.0, 1, section, ALL);
    rod.nodes[1].d = Real3::new(0.0, angle.cos(), angle.sin());
    rod.slopes(0, &[0.0; ELEMENT])[2 * NODE - 1]
}
