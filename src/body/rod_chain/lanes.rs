//! Forces of a rod in lanes: several elements at once.

use std::ops::Range;

use super::{INNER, RodChain, SpinInertia};
use crate::body::assembly::Assembly;
use crate::body::chain::both;
use crate::body::connectivity::Node;
use crate::body::frame::Frames;
use crate::elements::rod::{
    At, Force, Matrix as ElementMatrix, Pack, Rates, Rod, Tangent, VELOCITIES,
};
use crate::math::lanes::{PACK, Simd, Work, vectorized};
use crate::math::sparse::Matrix;

/// Elements that are computed together, at most [`PACK`].
#[derive(Clone, Debug)]
pub(super) struct Packed {
    elements: Range<usize>,
    kernel: Pack,
}

/// Runs of elements that are alike.
pub(super) fn packs(elements: &[(Rod, SpinInertia)]) -> Vec<Packed> {
    let (mut packs, mut start) = (Vec::new(), 0);
    while start < elements.len() {
        let rest = elements[start..].iter().map(|(rod, _)| rod);
        let alike = rest.take_while(|rod| elements[start].0.goes_with(rod));
        let alike: Vec<Rod> = alike.take(PACK).cloned().collect();
        packs.push(Packed {
            elements: start..start + alike.len(),
            kernel: Rod::pack(&alike),
        });
        start += alike.len();
    }
    packs
}

impl RodChain {
    /// Adds elastic and damping forces: those on the line and on internal twists over the nodes, torques about the tangents to those of
    /// all carried frames. The power that damping takes out, W.
    pub fn add_force<const D: usize>(
        &self,
        motion: (&[Node<D>], &[Node<D>]),
        frames: &Frames,
        out: (&mut [Node<D>], &mut [f64]),
    ) -> f64 {
        let (mut place, mut rate) = (NodePack::straight(), NodePack::straight());
        let (zero, mut power) = ([0.0; PACK], 0.0);
        let mut force = Force {
            e: [[zero; 3]; 4],
            torque: [zero; 2],
            bubble: zero,
        };
        let (nodes, torques) = out;
        for Packed { elements, kernel } in &self.packs {
            self.read(motion, None, elements, &mut place);
            if self.is_damped {
                self.read(motion, Some(frames), elements, &mut rate);
            }
            vectorized(PackForce {
                kernel,
                place: &place,
                rate: self.is_damped.then_some(&rate),
                force: &mut force,
                power: &mut power,
            });
            self.write(elements, &force, (nodes, torques));
        }
        power
    }

    /// Adds the tangent stiffness, and damping where there is any, over rotations about tangents.
    pub fn add_tangent<const D: usize>(
        &self,
        motion: (&[Node<D>], &[Node<D>]),
        frames: &Frames,
        assembly: &Assembly<D>,
        matrices: [&mut Matrix<f64>; 2],
    ) {
        self.for_each_tangent(motion, frames, |kind, j, whole| {
            let matrix = &mut *matrices[kind as usize];
            self.for_each_block(j, whole, |row, column, block| {
                assembly.add(row, column, block, matrix);
            });
        });
    }

    /// Calls with the tangent stiffness of every element, then with the damping of every one where there is any.
    #[inline(always)]
    pub fn for_each_tangent<const D: usize>(
        &self,
        motion: (&[Node<D>], &[Node<D>]),
        frames: &Frames,
        mut each: impl FnMut(Tangent, usize, &ElementMatrix),
    ) {
        let (mut place, mut rate) = (NodePack::straight(), NodePack::straight());
        let mut out = [[[0.0; PACK]; VELOCITIES]; VELOCITIES];
        let count = if self.is_damped { 2 } else { 1 };
        for kind in [Tangent::Stiffness, Tangent::Damping]
            .into_iter()
            .take(count)
        {
            for Packed { elements, kernel } in &self.packs {
                self.read(motion, None, elements, &mut place);
                if self.is_damped {
                    self.read(motion, Some(frames), elements, &mut rate);
                }
                vectorized(PackTangent {
                    kernel,
                    place: &place,
                    rate: self.is_damped.then_some(&rate),
                    kind,
                    out: &mut out,
                });
                for (lane, j) in elements.clone().enumerate() {
                    each(kind, j, &of_lane(&out, lane));
                }
            }
        }
    }

    /// Copies what an evaluation needs of the nodes of a pack, or of their rates.
    fn read<const D: usize>(
        &self,
        (x, v): (&[Node<D>], &[Node<D>]),
        frames: Option<&Frames>,
        elements: &Range<usize>,
        pack: &mut NodePack,
    ) {
        let from = if frames.is_some() { v } else { x };
        for (lane, k) in (elements.start..=elements.end).enumerate() {
            let (node, axes) = (&from[self.line + k], &x[self.frames + 2 * k + 1]);
            for d in 0..D.min(3) {
                pack.line[0][d][lane] = node[0][d];
                pack.line[1][d][lane] = node[1][d];
                pack.second[d][lane] = axes[0][d];
            }
            if let Some(frames) = frames {
                pack.spin[lane] = self.frame(k, frames).spin(x, v);
            }
        }
        for (lane, j) in elements.clone().enumerate() {
            pack.bubble[lane] = from[self.inner + j][INNER.0][INNER.1];
        }
    }

    fn write<const D: usize>(
        &self,
        elements: &Range<usize>,
        f: &Force<[f64; PACK]>,
        (nodes, torques): (&mut [Node<D>], &mut [f64]),
    ) {
        for (lane, j) in elements.clone().enumerate() {
            for end in 0..2 {
                let node = &mut nodes[self.line + j + end];
                for p in 0..2 {
                    for d in 0..D.min(3) {
                        node[p][d] += f.e[2 * end + p][d][lane];
                    }
                }
                torques[self.carried + j + end] += f.torque[end][lane];
            }
            nodes[self.inner + j][INNER.0][INNER.1] += f.bubble[lane];
        }
    }
}

/// The matrix of one element of a pack, of which rows up to the diagonal are given.
fn of_lane(lanes: &ElementMatrix<[f64; PACK]>, lane: usize) -> ElementMatrix {
    let mut whole = [[0.0; VELOCITIES]; VELOCITIES];
    for r in 0..VELOCITIES {
        for c in 0..=r {
            (whole[r][c], whole[c][r]) = (lanes[r][c][lane], lanes[r][c][lane]);
        }
    }
    whole
}

/// Every coordinate of the nodes of a pack side by side: positions and slopes, or their rates; second axes; spins; internal twists.
struct NodePack {
    line: [[[f64; PACK + 1]; 3]; 2],
    second: [[f64; PACK + 1]; 3],
    spin: [f64; PACK + 1],
    bubble: [f64; PACK],
}

impl NodePack {
    /// A straight line of nodes along the first axis, for lanes without an element.
    #[inline(always)]
    fn straight() -> Self {
        let (zero, one) = ([0.0; PACK + 1], [1.0; PACK + 1]);
        let mut places = zero;
        for (k, place) in places.iter_mut().enumerate() {
            *place = k as f64;
        }
        Self {
            line: [[places, zero, zero], [one, zero, zero]],
            second: [zero, one, zero],
            spin: zero,
            bubble: [0.0; PACK],
        }
    }

    #[inline(always)]
    fn at(&self) -> At<&[f64; PACK]> {
        let mut d = [[&self.bubble; 3]; 2];
        for k in 0..3 {
            [d[0][k], d[1][k]] = both(&self.second[k]);
        }
        At {
            e: self.ends(),
            d,
            bubble: &self.bubble,
        }
    }

    #[inline(always)]
    fn rates(&self) -> Rates<&[f64; PACK]> {
        Rates {
            e: self.ends(),
            spin: both(&self.spin),
            bubble: &self.bubble,
        }
    }

    #[inline(always)]
    fn ends(&self) -> [[&[f64; PACK]; 3]; 4] {
        let [first @ .., _] = &self.line[0][0];
        let mut ends = [[first; 3]; 4];
        for p in 0..2 {
            for d in 0..3 {
                [ends[p][d], ends[2 + p][d]] = both(&self.line[p][d]);
            }
        }
        ends
    }
}

/// Forces of a pack. Neither this nor [`PackTangent`] knows the dimension: that would compile them twice.
struct PackForce<'a> {
    kernel: &'a Pack,
    place: &'a NodePack,
    rate: Option<&'a NodePack>,
    force: &'a mut Force<[f64; PACK]>,
    power: &'a mut f64,
}

impl Work for PackForce<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let rates = self.rate.map(NodePack::rates);
        let motion = (&self.place.at(), rates.as_ref());
        *self.power += Rod::pack_force(simd, self.kernel, motion, self.force);
    }
}

/// Tangent of a pack.
struct PackTangent<'a> {
    kernel: &'a Pack,
    place: &'a NodePack,
    rate: Option<&'a NodePack>,
    kind: Tangent,
    out: &'a mut ElementMatrix<[f64; PACK]>,
}

impl Work for PackTangent<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let rates = self.rate.map(NodePack::rates);
        let motion = (&self.place.at(), rates.as_ref());
        Rod::pack_tangent(simd, self.kernel, motion, self.kind, self.out);
    }
}
