//! Forces of a rod in lanes: several elements at once.

use std::ops::Range;

use super::{AHEAD, RodChain, SpinInertia, plane};
use crate::bodies::assembly::Assembly;
use crate::bodies::chain::both;
use crate::bodies::connectivity::Node;
use crate::elements::ElementMotion;
use crate::elements::beam::planar::{self, Planar};
use crate::elements::beam::{self, At, Beam, Force, Matrix as ElementMatrix, Rates, VELOCITIES};
use crate::elements::rod::{self, Rod, Tangent};
use crate::elements::section::{SectionElement, SectionPack, rod_at, rod_rates};
use crate::math::lanes::{PACK, Simd, Vectorized, vectorized};
use crate::math::sparse::Matrix;

/// Elements that are computed together, at most [`PACK`].
#[derive(Clone, Debug)]
pub(super) struct Packed {
    elements: Range<usize>,
    kernel: SectionPack,
}

/// Runs of elements that are alike.
pub(super) fn packs(elements: &[(SectionElement, SpinInertia)]) -> Vec<Packed> {
    let (mut packs, mut start) = (Vec::new(), 0);
    while start < elements.len() {
        let rest = elements[start..].iter().map(|(section, _)| section);
        let alike = rest.take_while(|section| elements[start].0.goes_with(section));
        let alike: Vec<&SectionElement> = alike.take(PACK).collect();
        packs.push(Packed {
            elements: start..start + alike.len(),
            kernel: SectionElement::pack(&alike),
        });
        start += alike.len();
    }
    packs
}

impl RodChain {
    /// Adds elastic and damping forces: those on the line and inside elements over the nodes, moments on sections to those of all transported
    /// frames. The power that damping takes out, W.
    pub fn add_force<const D: usize>(
        &self,
        motion_of: (&[Node<D>], &[Node<D>]),
        out: (&mut [Node<D>], &mut [[f64; 3]]),
    ) -> f64 {
        let (mut place, mut rate) = (SectionNodePack::straight(), SectionNodePack::straight());
        let (zero, mut power) = ([0.0; PACK], 0.0);
        let mut force = Force {
            e: [[zero; 3]; 4],
            moment: [[zero; 3]; 2],
            inner: [zero; 3],
        };
        let (nodes, moments) = out;
        for Packed { elements, kernel } in &self.packs {
            self.read(motion_of, false, elements, &mut place);
            if self.is_damped {
                self.read(motion_of, true, elements, &mut rate);
            }
            let motion = (&place, self.is_damped.then_some(&rate));
            power += match kernel {
                SectionPack::Rod(kernel) => rod_force(kernel, motion, &mut force),
                SectionPack::Beam(kernel) => beam_force(&**kernel, motion, &mut force),
                SectionPack::Planar(kernel) => beam_force(&**kernel, motion, &mut force),
            };
            self.write(elements, &force, motion_of.0, (nodes, moments));
        }
        power
    }

    /// Adds the tangent stiffness, and damping where there is any, over small rotations of sections.
    pub fn add_tangent<const D: usize>(
        &self,
        motion: (&[Node<D>], &[Node<D>]),
        assembly: &Assembly<D>,
        matrices: [&mut Matrix<f64>; 2],
    ) {
        self.for_each_tangent(motion, |kind, j, whole| {
            let matrix = &mut *matrices[kind as usize];
            self.for_each_block(j, whole, |row, column, block| {
                assembly.add(row, column, block, matrix);
            });
        });
    }

    /// Calls with the tangent stiffness of every element, then with the damping of every one where there is any: over small rotations of
    /// sections, in the plane over changes of their directions.
    #[inline(always)]
    pub fn for_each_tangent<const D: usize>(
        &self,
        motion_of: (&[Node<D>], &[Node<D>]),
        mut each: impl FnMut(Tangent, usize, &ElementMatrix),
    ) {
        let (mut place, mut rate) = (SectionNodePack::straight(), SectionNodePack::straight());
        let mut out = [[[0.0; PACK]; VELOCITIES]; VELOCITIES];
        let count = if self.is_damped { 2 } else { 1 };
        for kind in [Tangent::Stiffness, Tangent::Damping]
            .into_iter()
            .take(count)
        {
            for Packed { elements, kernel } in &self.packs {
                self.read(motion_of, false, elements, &mut place);
                if self.is_damped {
                    self.read(motion_of, true, elements, &mut rate);
                }
                let motion = (&place, self.is_damped.then_some(&rate));
                match kernel {
                    SectionPack::Rod(kernel) => rod_tangent(kernel, motion, kind, &mut out),
                    SectionPack::Beam(kernel) => beam_tangent(&**kernel, motion, kind, &mut out),
                    SectionPack::Planar(kernel) => beam_tangent(&**kernel, motion, kind, &mut out),
                }
                for (lane, j) in elements.clone().enumerate() {
                    let mut whole = of_lane(&out, lane);
                    if D == 2 {
                        let [_, first, _, last, _] = self.nodes(j);
                        let directions = [first, last].map(|node| &motion_of.0[node][1]);
                        plane::over_directions(directions, &mut whole);
                    }
                    each(kind, j, &whole);
                }
            }
        }
    }

    /// Copies what an evaluation needs of the nodes of a pack, or of their rates.
    fn read<const D: usize>(
        &self,
        (x, v): (&[Node<D>], &[Node<D>]),
        are_rates: bool,
        elements: &Range<usize>,
        pack: &mut SectionNodePack,
    ) {
        let from = if are_rates { v } else { x };
        for (lane, k) in (elements.start..=elements.end).enumerate() {
            let node = &from[self.line + k];
            for d in 0..D.min(3) {
                pack.line[0][d][lane] = node[0][d];
                pack.line[1][d][lane] = node[1][d];
            }
            let frame = self.frames + self.stride * k;
            if are_rates {
                let spin = match D {
                    2 => plane::spin(&x[frame][1], &v[frame][1]),
                    _ => self.frame(k).spin(x, v),
                };
                for (to, spin) in pack.turn[0].iter_mut().zip(spin).take(self.parts.end) {
                    to[lane] = spin;
                }
                continue;
            }
            if D == 2 {
                let [first, second, third] = plane::axes(&x[frame][1]);
                for (to, axis) in pack.turn.iter_mut().zip([second, first, third]) {
                    for d in 0..3 {
                        to[d][lane] = axis[d];
                    }
                }
                continue;
            }
            let ([_, first], [second, third]) = (&x[frame], &x[frame + 1]);
            // A rod asks for the second axis alone.
            let axes = [second, first, third];
            for (to, axis) in pack.turn.iter_mut().zip(axes).take(self.rotations()) {
                for d in 0..D.min(3) {
                    to[d][lane] = axis[d];
                }
            }
        }
        let ahead = if are_rates { [0.0; 3] } else { AHEAD };
        for (lane, j) in elements.clone().enumerate() {
            for (k, (part, axis)) in self.inside() {
                pack.inner[k][lane] = from[self.inner + j][part][axis] - ahead[k];
            }
            if D == 2 && !are_rates {
                let [c, s, _] = plane::inner(&x[self.inner + j]);
                (pack.inner[0][lane], pack.inner[1][lane]) = (c, s);
            }
        }
    }

    fn write<const D: usize>(
        &self,
        elements: &Range<usize>,
        f: &Force<[f64; PACK]>,
        x: &[Node<D>],
        (nodes, moments): (&mut [Node<D>], &mut [[f64; 3]]),
    ) {
        for (lane, j) in elements.clone().enumerate() {
            for end in 0..2 {
                let node = &mut nodes[self.line + j + end];
                for p in 0..2 {
                    for d in 0..D.min(3) {
                        node[p][d] += f.e[2 * end + p][d][lane];
                    }
                }
                if D == 2 {
                    let frame = self.frames + j + end;
                    let moment = f.moment[end].map(|m| m[lane]);
                    plane::turn(&x[frame][1], &moment, &mut nodes[frame][1]);
                    continue;
                }
                let moment = moments[self.first_section + j + end].iter_mut();
                for (sum, m) in moment.zip(&f.moment[end]).take(self.rotations()) {
                    *sum += m[lane];
                }
            }
            for (k, (part, axis)) in self.inside() {
                nodes[self.inner + j][part][axis] += f.inner[k][lane];
            }
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

/// Every coordinate of the nodes of a pack side by side: positions and slopes, or their rates; axes of sections (the second, the first,
/// the third), or of the first of these in its place spins; coordinates inside elements.
struct SectionNodePack {
    line: [[[f64; PACK + 1]; 3]; 2],
    turn: [[[f64; PACK + 1]; 3]; 3],
    inner: [[f64; PACK]; 3],
}

impl SectionNodePack {
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
            turn: [[zero, one, zero], [one, zero, zero], [zero, zero, one]],
            inner: [[0.0; PACK]; 3],
        }
    }

    #[inline(always)]
    fn at(&self) -> At<&[f64; PACK]> {
        let mut axes = [[[&self.inner[0]; 3]; 3]; 2];
        for (axis, k) in [1, 0, 2].into_iter().enumerate() {
            for d in 0..3 {
                [axes[0][axis][d], axes[1][axis][d]] = both(&self.turn[k][d]);
            }
        }
        At {
            e: self.ends(),
            axes,
            inner: self.inner.each_ref(),
        }
    }

    #[inline(always)]
    fn rates(&self) -> Rates<&[f64; PACK]> {
        let mut spin = [[&self.inner[0]; 3]; 2];
        for k in 0..3 {
            [spin[0][k], spin[1][k]] = both(&self.turn[0][k]);
        }
        Rates {
            e: self.ends(),
            spin,
            inner: self.inner.each_ref(),
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

/// Coordinates of the nodes of a pack, and rates where it is damped.
type PackMotion<'a> = (&'a SectionNodePack, Option<&'a SectionNodePack>);

/// Something to compute in lanes. None of these knows the dimension: that would compile them twice.
struct InLanes<'a, K, O> {
    kernel: &'a K,
    motion: PackMotion<'a>,
    kind: Tangent,
    out: &'a mut O,
    power: &'a mut f64,
}

/// Forces of a pack of rods, and the power that damping takes out, W.
fn rod_force(kernel: &rod::Pack, motion: PackMotion<'_>, force: &mut Force<[f64; PACK]>) -> f64 {
    let zero = [0.0; PACK];
    let (mut power, mut out) = (
        0.0,
        rod::Force {
            e: [[zero; 3]; 4],
            torque: [zero; 2],
            bubble: zero,
        },
    );
    vectorized(InLanes {
        kernel,
        motion,
        kind: Tangent::Stiffness,
        out: &mut out,
        power: &mut power,
    });
    force.e = out.e;
    [force.moment[0][0], force.moment[1][0]] = out.torque;
    force.inner[0] = out.bubble;
    power
}

impl Vectorized for InLanes<'_, rod::Pack, rod::Force<[f64; PACK]>> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let rates = self.motion.1.map(|rate| rod_rates(&rate.rates()));
        let at = rod_at(&self.motion.0.at());
        let motion = ElementMotion::new(&at, rates.as_ref());
        *self.power += Rod::pack_force(simd, self.kernel, motion, self.out);
    }
}

/// Computes the forces of beam elements in lanes, in space or in the plane.
fn beam_force<K>(kernel: &K, motion: PackMotion<'_>, force: &mut Force<[f64; PACK]>) -> f64
where
    for<'a> InLanes<'a, K, Force<[f64; PACK]>>: Vectorized,
{
    let mut power = 0.0;
    vectorized(InLanes {
        kernel,
        motion,
        kind: Tangent::Stiffness,
        out: force,
        power: &mut power,
    });
    power
}

/// Tangent of a pack of rods.
fn rod_tangent(
    kernel: &rod::Pack,
    motion: PackMotion<'_>,
    kind: Tangent,
    whole: &mut ElementMatrix<[f64; PACK]>,
) {
    let mut out = [[[0.0; PACK]; rod::VELOCITIES]; rod::VELOCITIES];
    vectorized(InLanes {
        kernel,
        motion,
        kind,
        out: &mut out,
        power: &mut 0.0,
    });
    for (row, from) in whole.iter_mut().zip(&out) {
        row[..rod::VELOCITIES].copy_from_slice(from);
    }
}

impl Vectorized for InLanes<'_, rod::Pack, rod::Matrix<[f64; PACK]>> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let rates = self.motion.1.map(|rate| rod_rates(&rate.rates()));
        let at = rod_at(&self.motion.0.at());
        let motion = ElementMotion::new(&at, rates.as_ref());
        Rod::pack_tangent(simd, self.kernel, motion, self.kind, self.out);
    }
}

/// Computes the tangents of beam elements in lanes.
fn beam_tangent<K>(
    kernel: &K,
    motion: PackMotion<'_>,
    kind: Tangent,
    out: &mut ElementMatrix<[f64; PACK]>,
) where
    for<'a> InLanes<'a, K, ElementMatrix<[f64; PACK]>>: Vectorized,
{
    vectorized(InLanes {
        kernel,
        motion,
        kind,
        out,
        power: &mut 0.0,
    });
}

/// Forces and tangents of beam elements in lanes.
macro_rules! beams_in_lanes {
    ($element:ident of $pack:ty) => {
        impl Vectorized for InLanes<'_, $pack, Force<[f64; PACK]>> {
            #[inline(always)]
            fn run<S: Simd>(self, simd: S) {
                let rates = self.motion.1.map(SectionNodePack::rates);
                let at = self.motion.0.at();
                let motion = ElementMotion::new(&at, rates.as_ref());
                *self.power += $element::pack_force(simd, self.kernel, motion, self.out);
            }
        }

        impl Vectorized for InLanes<'_, $pack, ElementMatrix<[f64; PACK]>> {
            #[inline(always)]
            fn run<S: Simd>(self, simd: S) {
                let rates = self.motion.1.map(SectionNodePack::rates);
                let at = self.motion.0.at();
                let motion = ElementMotion::new(&at, rates.as_ref());
                $element::pack_tangent(simd, self.kernel, motion, self.kind, self.out);
            }
        }
    };
}
beams_in_lanes!(Beam of beam::Pack);
beams_in_lanes!(Planar of planar::Pack);
