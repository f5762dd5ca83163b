//! Frames of sections transported along the line of an element, and how what sections see changes with the line, the spins of its ends
//! and the internal twist.
//!
//! Source: the equations of `rod/mod.rs`; the gradient is theirs by the variation of a transported frame (1).

use super::vectors::{Vector, across, add, carry, cross, plus, unit};
use super::{Force, Rates};
use crate::elements::line::{Sample, combine, dot, sample, times};
use crate::math::lanes::{Lanes, PACK, Real, Simd};
use crate::math::quadrature::{GAUSS_3, GAUSS_5, QuadraturePoint};

/// Points that strains are sampled at.
pub(in crate::elements) const POINTS: [Sample; 3] =
    [sample(GAUSS_3[0]), sample(GAUSS_3[1]), sample(GAUSS_3[2])];

/// Points that moments along the line are known at.
pub(in crate::elements) const LOADED: [Sample; GAUSS_5.len()] = [
    sample(GAUSS_5[0]),
    sample(GAUSS_5[1]),
    sample(GAUSS_5[2]),
    sample(GAUSS_5[3]),
    sample(GAUSS_5[4]),
];

/// Weights of the three vectors in the slope at the middle.
pub(in crate::elements) const MIDDLE: [f64; 3] = sample(QuadraturePoint {
    at: 0.5,
    weight: 0.0,
})
.slope;

/// Lengths of one element or, in lanes, of several.
#[derive(Clone, Copy, Debug)]
pub(in crate::elements) struct Geometry<N> {
    pub length: N,
    pub inverse_length: N,
    /// Whether the stresses do not notice a rotation of the section about the tangent.
    pub is_round: bool,
}

/// One end of an element.
#[derive(Clone, Copy)]
pub(in crate::elements) struct End<N> {
    pub tangent: Vector<N>,
    /// One over the length of the slope.
    pub inverse_size: N,
    /// `t x z / (1 + t . z)`.
    pub half: Vector<N>,
}

/// The frames that sections of an element are compared with.
pub(in crate::elements) struct Frame<N> {
    /// Unit tangent at the middle and one over the length of the slope there.
    pub middle: Vector<N>,
    pub inverse_size: N,
    pub ends: [End<N>; 2],
    /// The first end's frame, transported to the middle.
    pub axes: [Vector<N>; 2],
    /// Twist of the element, rad.
    pub twist: N,
}

/// Rates of the three vectors, of the frame, and of the internal twist.
pub(in crate::elements) struct Motion<N> {
    pub dv: [Vector<N>; 3],
    change: FrameRate<N>,
    bubble: N,
}

/// Rates of a frame.
struct FrameRate<N> {
    middle: Vector<N>,
    /// Rate of rotating of the first end's frame, transported to the middle.
    turn: N,
    twist: N,
}

/// A section.
pub(in crate::elements) struct Section<N> {
    pub u: Vector<N>,
    pub w: Vector<N>,
    pub tangent: Vector<N>,
    pub inverse_size: N,
    pub curvature: Vector<N>,
    /// `1 / (1 + z . t)`.
    pub inverse: N,
    /// `z . kappa`.
    pub along: N,
    pub sine: N,
    pub cosine: N,
    pub strains: [N; 3],
}

/// A section with its point and the frames that it is compared with.
#[derive(Clone, Copy)]
pub(in crate::elements) struct PlacedSection<'a, N> {
    pub point: &'a Sample,
    pub section: &'a Section<N>,
    pub frame: &'a Frame<N>,
}

/// Factors of the changes of what a section sees, summed over sections.
#[derive(Clone, Copy)]
pub(in crate::elements) struct Sum<N> {
    /// Factors of the changes of the three vectors.
    pub vectors: [Vector<N>; 3],
    middle: Vector<N>,
    /// Factor of the rotation of the first end's frame, transported to the middle.
    turn: N,
    twist: N,
    bubble: N,
}

impl<N: Real> Sum<N> {
    #[inline(always)]
    pub fn nothing(zero: N) -> Self {
        Self {
            vectors: [[zero; 3]; 3],
            middle: [zero; 3],
            turn: zero,
            twist: zero,
            bubble: zero,
        }
    }
}

impl Geometry<f64> {
    /// Converts the lengths to constants of the number type of `like`.
    #[inline(always)]
    pub fn lift<N: Real>(&self, like: N) -> Geometry<N> {
        Geometry {
            length: like.constant(self.length),
            inverse_length: like.constant(self.inverse_length),
            is_round: self.is_round,
        }
    }
}

impl Geometry<[f64; PACK]> {
    /// A group of the elements of a pack.
    #[inline(always)]
    pub fn group<S: Simd>(&self, simd: S, group: usize) -> Geometry<Lanes<S>> {
        Geometry {
            length: Lanes::read(simd, &self.length, group),
            inverse_length: Lanes::read(simd, &self.inverse_length, group),
            is_round: self.is_round,
        }
    }
}

impl<N: Real> Geometry<N> {
    #[inline(always)]
    pub fn number(&self, value: f64) -> N {
        self.length.constant(value)
    }

    #[inline(always)]
    pub fn vectors(&self, e: &[Vector<N>; 4]) -> [Vector<N>; 3] {
        let chord = each!(e[0], i => (e[2][i] - e[0][i]) * self.inverse_length);
        [chord, e[1], e[3]]
    }

    #[inline(always)]
    fn end(&self, u: &Vector<N>, middle: &Vector<N>) -> (End<N>, N) {
        let (tangent, inverse_size) = unit(u);
        let inverse = self.number(1.0) / (self.number(1.0) + dot(&tangent, middle));
        let half = times(&cross(&tangent, middle), inverse);
        let end = End {
            tangent,
            inverse_size,
            half,
        };
        (end, inverse)
    }

    #[inline(always)]
    pub fn frame(&self, v: &[Vector<N>; 3], d: &[Vector<N>; 2]) -> Frame<N> {
        let (middle, inverse_size) = unit(&combine(&MIDDLE, v));
        let (first, inverse) = self.end(&v[1], &middle);
        let axis = carry(&first.tangent, &middle, inverse, &d[0]);
        let (last, inverse) = self.end(&v[2], &middle);
        let other = carry(&last.tangent, &middle, inverse, &d[1]);
        let side = cross(&middle, &axis);
        Frame {
            middle,
            inverse_size,
            ends: [first, last],
            axes: [axis, side],
            twist: dot(&side, &other).angle(dot(&axis, &other)),
        }
    }

    /// Evaluates the shape function of the internal twist at a point, and its derivative by the reference length times
    /// the length.
    #[inline(always)]
    pub fn quadratic(&self, at: f64) -> (N, N) {
        (
            self.number(4.0 * at * (1.0 - at)),
            self.number(4.0 - 8.0 * at),
        )
    }

    #[inline(always)]
    pub fn section(
        &self,
        point: &Sample,
        v: &[Vector<N>; 3],
        frame: &Frame<N>,
        bubble: N,
    ) -> Section<N> {
        let u = combine(&point.slope, v);
        let w = times(&combine(&point.curvature, v), self.inverse_length);
        let (tangent, inverse_size) = unit(&u);
        let curvature = times(&cross(&u, &w), inverse_size * inverse_size);
        let inverse = self.number(1.0) / (self.number(1.0) + dot(&frame.middle, &tangent));
        let along = dot(&frame.middle, &curvature);
        let (shape, slope) = self.quadratic(point.at);
        let (sine, cosine) = if self.is_round {
            (self.number(0.0), self.number(1.0))
        } else {
            let angle = frame
                .twist
                .times_plus(self.number(point.at), shape * bubble);
            angle.sine_cosine()
        };
        let carried = plus(&tangent, -(along * inverse), &curvature);
        let [p, q] = [dot(&carried, &frame.axes[0]), dot(&carried, &frame.axes[1])];
        let twist = slope.times_plus(bubble, frame.twist) * self.inverse_length;
        Section {
            u,
            w,
            tangent,
            inverse_size,
            curvature,
            inverse,
            along,
            sine,
            cosine,
            strains: [
                twist - along * inverse,
                cosine * p + sine * q,
                cosine * q - sine * p,
            ],
        }
    }

    /// Adds what a section's stresses make of the changes of what it sees.
    #[inline(always)]
    pub fn add_section(
        &self,
        place: PlacedSection<'_, N>,
        [torque, first, second]: &[N; 3],
        sum: &mut Sum<N>,
    ) {
        let PlacedSection {
            point,
            section: at,
            frame,
        } = place;
        let (shape, slope) = self.quadratic(point.at);
        let (torque, z, t) = (*torque, &frame.middle, &at.tangent);
        let turn = *first * at.strains[2] - *second * at.strains[1];
        let rise = torque * self.inverse_length;
        sum.turn += turn;
        sum.twist += turn.times_plus(self.number(point.at), rise);
        sum.bubble += turn.times_plus(shape, rise * slope);
        let [p, q] = [
            at.cosine * *first - at.sine * *second,
            at.sine * *first + at.cosine * *second,
        ];
        let flat = plus(&frame.axes[0], p, &times(&frame.axes[1], q));
        let shared = torque * at.inverse;
        // The moment less what the twist of the transported frame takes.
        let back = carry(z, t, at.inverse, &flat);
        let m = plus(z, -shared, &back);
        let half = times(&cross(z, t), -(turn * at.inverse));
        let lag = shared * at.inverse * at.along;
        sum.middle = add(
            &sum.middle,
            &plus(t, lag, &plus(&at.curvature, -shared, &half)),
        );
        let by_tangent = plus(&across(t, z), lag, &half);
        let square = at.inverse_size * at.inverse_size;
        let shrink = dot(&m, &at.curvature);
        let by_u = plus(&at.u, -(shrink + shrink), &cross(&at.w, &m));
        let by_u = plus(&by_u, square, &times(&by_tangent, at.inverse_size));
        let by_w = times(&cross(&m, &at.u), square * self.inverse_length);
        for i in 0..3 {
            let by_u = plus(&by_u, self.number(point.slope[i]), &sum.vectors[i]);
            sum.vectors[i] = plus(&by_w, self.number(point.curvature[i]), &by_u);
        }
    }

    /// Tangent and axes across it of a section; of round ones, whose stresses do not notice a rotation, untwisted.
    #[inline(always)]
    pub fn axes(&self, at: &Section<N>, frame: &Frame<N>) -> [Vector<N>; 3] {
        let [first, second] = &frame.axes;
        let turned = plus(first, at.cosine, &times(second, at.sine));
        let axis = carry(&frame.middle, &at.tangent, at.inverse, &turned);
        [at.tangent, axis, cross(&at.tangent, &axis)]
    }

    /// Adds what a moment on a section makes of the changes of what it sees, taken with the angular velocity `t x t' + w t` of the axes
    /// there, whose part `w` about the tangent is that of (1).
    #[inline(always)]
    pub fn add_moment(&self, place: PlacedSection<'_, N>, moment: &Vector<N>, sum: &mut Sum<N>) {
        let PlacedSection {
            point,
            section: at,
            frame,
        } = place;
        let ((shape, _), t) = (self.quadratic(point.at), &at.tangent);
        let turn = dot(moment, t);
        sum.turn += turn;
        sum.twist += turn * self.number(point.at);
        sum.bubble += turn * shape;
        let half = times(&cross(&frame.middle, t), -(turn * at.inverse));
        sum.middle = add(&sum.middle, &half);
        let by_u = times(&add(&half, &cross(moment, t)), at.inverse_size);
        for i in 0..3 {
            sum.vectors[i] = plus(&by_u, self.number(point.slope[i]), &sum.vectors[i]);
        }
    }

    /// Force from the summed factors.
    #[inline(always)]
    pub fn spread(&self, frame: &Frame<N>, sum: &Sum<N>) -> Force<N> {
        let [first, last] = &frame.ends;
        let (kept, twist) = (sum.twist - sum.turn, sum.twist);
        let by_first = times(&first.half, kept);
        let by_last = times(&last.half, -twist);
        let middle = add(&sum.middle, &add(&by_first, &by_last));
        let middle = times(&across(&frame.middle, &middle), frame.inverse_size);
        let v = &sum.vectors;
        let chord = plus(&middle, self.number(MIDDLE[0]), &v[0]);
        let a = plus(&by_first, first.inverse_size, &v[1]);
        let b = plus(&by_last, last.inverse_size, &v[2]);
        let a = plus(&middle, self.number(MIDDLE[1]), &a);
        let b = plus(&middle, self.number(MIDDLE[2]), &b);
        let l = self.length;
        Force {
            e: [
                chord,
                times(&a, -l),
                times(&chord, self.number(-1.0)),
                times(&b, -l),
            ],
            torque: [kept * l, -(twist * l)],
            bubble: -(sum.bubble * l),
        }
    }

    /// Computes the rates of vectors, frame and internal twist, from which rates of strains follow.
    #[inline(always)]
    pub fn motion(&self, frame: &Frame<N>, rates: &Rates<N>) -> Motion<N> {
        let dv = self.vectors(&rates.e);
        Motion {
            change: self.frame_rate(frame, &dv, &rates.spin),
            dv,
            bubble: rates.bubble,
        }
    }

    #[inline(always)]
    fn frame_rate(&self, frame: &Frame<N>, dv: &[Vector<N>; 3], spin: &[N; 2]) -> FrameRate<N> {
        let change = across(&frame.middle, &combine(&MIDDLE, dv));
        let middle = times(&change, frame.inverse_size);
        let [first, last] = &frame.ends;
        let turn = spin[0] - self.lost(first, &dv[1], &middle);
        FrameRate {
            turn,
            twist: spin[1] - self.lost(last, &dv[2], &middle) - turn,
            middle,
        }
    }

    /// Returns the difference between the spin of an end and that of its frame transported to the middle.
    #[inline(always)]
    fn lost(&self, end: &End<N>, du: &Vector<N>, middle: &Vector<N>) -> N {
        // The half is across the tangent: so is all that it sees.
        dot(&end.half, du) * end.inverse_size + dot(&end.half, middle)
    }

    /// Rates of the strains of a section.
    #[inline(always)]
    pub fn strain_rates(
        &self,
        point: &Sample,
        at: &Section<N>,
        frame: &Frame<N>,
        Motion { dv, change, bubble }: &Motion<N>,
    ) -> [N; 3] {
        let ((shape, slope), bubble) = (self.quadratic(point.at), *bubble);
        let du = combine(&point.slope, dv);
        let dw = times(&combine(&point.curvature, dv), self.inverse_length);
        let (z, t) = (&frame.middle, &at.tangent);
        let stretch = dot(t, &du);
        let dt = times(&plus(t, -stretch, &du), at.inverse_size);
        let square = at.inverse_size * at.inverse_size;
        let turned = add(&cross(&du, &at.w), &cross(&at.u, &dw));
        let shrink = (stretch + stretch) * at.inverse_size;
        let rate = plus(&at.curvature, -shrink, &times(&turned, square));
        let both = add(&change.middle, &dt);
        let turn = change.twist.times_plus(self.number(point.at), change.turn) + shape * bubble
            - dot(&cross(z, t), &both) * at.inverse;
        let along = dot(z, &rate);
        let carried = plus(t, -((along + dot(t, &rate)) * at.inverse), &rate);
        let [p, q] = [dot(&carried, &frame.axes[0]), dot(&carried, &frame.axes[1])];
        let lean = dot(t, &change.middle) + dot(z, &dt);
        let lost = dot(&change.middle, &at.curvature) + along - at.along * at.inverse * lean;
        [
            slope.times_plus(bubble, change.twist) * self.inverse_length - lost * at.inverse,
            at.cosine * p + at.sine * q + at.strains[2] * turn,
            at.cosine * q - at.sine * p - at.strains[1] * turn,
        ]
    }
}

impl Geometry<f64> {
    /// The larger angle between the tangents at the ends and that at the middle, and the size of the twist, rad.
    pub fn angles(&self, e: &[Vector<f64>; 4], d: &[Vector<f64>; 2]) -> [f64; 2] {
        let v = self.vectors(e);
        let frame = self.frame(&v, d);
        let lean = |end: &End<f64>| {
            let sine = cross(&end.tangent, &frame.middle);
            dot(&sine, &sine)
                .sqrt()
                .atan2(dot(&end.tangent, &frame.middle))
        };
        let [first, last] = frame.ends.map(|end| lean(&end));
        [first.max(last), frame.twist.abs()]
    }
}
