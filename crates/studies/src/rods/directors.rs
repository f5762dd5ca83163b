//! A line of nodes with orthonormal directors that are interpolated linearly, and shear: frame-indifferent, with constant mass.
//!
//! Source: P. Betsch, P. Steinmann, Frame-indifferent beam finite elements based upon the geometrically exact beam theory, Int. J.
//! Numer. Meth. Eng. 54 (2002), doi 10.1002/nme.487. Unknowns of a step are rotations of nodes, as in P. Betsch, S. Leyendecker, Int. J.
//! Numer. Meth. Eng. 67 (2006) (null space of the constraints).

use super::hermite::Section;
use super::statics::Line;
use super::{Number, Real3, Vector, gradient, lift, number, real, vector};

/// Numbers of a node: position and rotation.
const NODE: usize = 6;

/// One point, with which straight elements do not lock, and two.
const REDUCED: &[[f64; 2]] = &[[0.5, 1.0]];
const FULL: &[[f64; 2]] = &[
    [0.211_324_865_405_187_1, 0.5],
    [0.788_675_134_594_812_9, 0.5],
];

/// Position and directors: the normal of the section first.
#[derive(Clone, Copy, Debug)]
struct Node {
    r: Real3,
    d: [Real3; 3],
}

/// The rational rotation `c`, `v + (c x v + c x (c x v) / 2) / (1 + c . c / 4)`.
fn turned(c: &Vector, v: &Vector) -> Vector {
    let once = c.cross(v);
    let scale = number(1.0) / (number(1.0) + c.dot(c) * 0.25);
    v + (once + c.cross(&once) * number(0.5)) * scale
}

impl Node {
    fn moved(&self, step: &[Number]) -> (Vector, [Vector; 3]) {
        let turn = vector(step, 3);
        let r = lift(self.r) + vector(step, 0);
        (r, self.d.map(|d| turned(&turn, &lift(d))))
    }
}

/// A line with directors, straight without stress.
#[derive(Clone, Debug)]
pub struct Directors {
    nodes: Vec<Node>,
    length: f64,
    section: Section,
    /// GA, N.
    shear: f64,
    points: &'static [[f64; 2]],
    moment: Real3,
}

impl Directors {
    /// Along the first axis from the origin, clamped there, under a dead moment (N m) at its end; shear as stiff as stretching.
    pub fn straight(
        length: f64,
        elements: usize,
        section: Section,
        is_reduced: bool,
        moment: Real3,
    ) -> Self {
        let length = length / elements as f64;
        let node = |k: usize| Node {
            r: Real3::x() * length * k as f64,
            d: [Real3::x(), Real3::y(), Real3::z()],
        };
        Self {
            nodes: (0..=elements).map(node).collect(),
            length,
            shear: section.axial,
            section,
            points: if is_reduced { REDUCED } else { FULL },
            moment,
        }
    }

    /// The last node, m.
    pub fn tip(&self) -> Real3 {
        self.nodes[self.nodes.len() - 1].r
    }

    fn energy_of(&self, element: usize, step: &[Number; 2 * NODE]) -> Number {
        let (ra, a) = self.nodes[element].moved(&step[..NODE]);
        let (rb, b) = self.nodes[element + 1].moved(&step[NODE..]);
        let l = self.length;
        let slope = (rb - ra) / number(l);
        let rate: [Vector; 3] = std::array::from_fn(|k| (b[k] - a[k]) / number(l));
        let mut sum = number(0.0);
        for [xi, weight] in self.points {
            let d: [Vector; 3] = std::array::from_fn(|k| a[k] + rate[k] * number(l * xi));
            let curved = |i: usize, j: usize| (rate[i].dot(&d[j]) - rate[j].dot(&d[i])) * 0.5;
            let [torsion, first, second] = self.section.stiffness;
            let terms = [
                (slope.dot(&d[0]) - 1.0, self.section.axial),
                (slope.dot(&d[1]), self.shear),
                (slope.dot(&d[2]), self.shear),
                (curved(1, 2), torsion),
                (curved(2, 0), first),
                (curved(0, 1), second),
            ];
            for (strain, stiffness) in terms {
                sum += strain * strain * (0.5 * stiffness * weight * l);
            }
        }
        sum
    }
}

impl Line for Directors {
    const NODE: usize = NODE;
    const INTERNAL: usize = 0;

    fn elements(&self) -> usize {
        self.nodes.len() - 1
    }

    fn held(&self) -> Vec<usize> {
        (0..NODE).collect()
    }

    fn slopes(&self, element: usize, step: &[f64]) -> Vec<f64> {
        let step = <&[f64; 2 * NODE]>::try_from(step).expect("numbers of an element");
        gradient(step, |step| self.energy_of(element, step)).to_vec()
    }

    /// The spin of the rational rotation `c` is `(c' + c x c' / 2) / (1 + c . c / 4)`.
    fn load(&self, part: f64, step: &[f64]) -> Vec<f64> {
        let moment = self.moment * part;
        let c = Real3::new(step[3], step[4], step[5]);
        let turn = (moment + moment.cross(&c) * 0.5) / (1.0 + 0.25 * c.norm_squared());
        vec![0.0, 0.0, 0.0, turn.x, turn.y, turn.z]
    }

    fn accept(&mut self, step: &[f64]) {
        for (node, step) in self.nodes.iter_mut().zip(step.chunks(NODE)) {
            let step: Vec<Number> = step.iter().copied().map(number).collect();
            let (r, d) = node.moved(&step);
            *node = Node {
                r: real(&r),
                d: d.map(|d| real(&d)),
            };
        }
    }
}
