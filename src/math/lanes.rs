//! The same formula for several numbers at once, one a lane, with the vector instructions that the
//! processor is found to have when running. Sums keep their order; where a processor can multiply and
//! add in one it does, so that processors of different generations differ in the last bit.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

pub use pulp::Simd;

/// Elements that are computed together; a multiple of the lanes of every processor.
pub const PACK: usize = 8;

/// What formulas need of a number: `f64` and [`Lanes`].
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
{
    /// Whether loops over a few points are written out: of numbers in lanes, on which time is spent.
    const WRITTEN_OUT: bool = false;
    /// A constant, in as many lanes.
    fn constant(self, value: f64) -> Self;
    /// Square root.
    fn root(self) -> Self;
    /// `self factor + term`, rounded once where the processor can.
    fn times_plus(self, factor: Self, term: Self) -> Self;
}

impl Real for f64 {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }
}

/// As many numbers as the processor takes at once.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<S: Simd>(S, S::f64s);

impl<S: Simd> Lanes<S> {
    /// Group `group` of the numbers of a pack.
    #[inline(always)]
    pub fn read(simd: S, numbers: &[f64; PACK], group: usize) -> Self {
        Self(simd, S::as_simd_f64s(numbers).0[group])
    }

    /// Puts them back.
    #[inline(always)]
    pub fn write(self, numbers: &mut [f64; PACK], group: usize) {
        S::as_mut_simd_f64s(numbers).0[group] = self.1;
    }
}

macro_rules! by_lane {
    ($operator:ident, $call:ident, $lanes:ident) => {
        impl<S: Simd> $operator for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $call(self, other: Self) -> Self {
                Self(self.0, self.0.$lanes(self.1, other.1))
            }
        }
    };
}

by_lane!(Add, add, add_f64s);
by_lane!(Sub, sub, sub_f64s);
by_lane!(Mul, mul, mul_f64s);
by_lane!(Div, div, div_f64s);

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0, self.0.neg_f64s(self.1))
    }
}

impl<S: Simd> AddAssign for Lanes<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> Real for Lanes<S> {
    // One lane is what processors without vectors have.
    const WRITTEN_OUT: bool = S::F64_LANES > 1;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self(self.0, self.0.splat_f64s(value))
    }

    #[inline(always)]
    fn root(self) -> Self {
        Self(self.0, self.0.sqrt_f64s(self.1))
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        Self(self.0, self.0.mul_add_e_f64s(self.1, factor.1, term.1))
    }
}

/// Work in lanes. All that it spends its time in must be `#[inline(always)]`: what is called instead is
/// compiled for the oldest processor.
pub trait Work {
    /// Does it.
    fn run<S: Simd>(self, simd: S);
}

/// Does work with the vector instructions of this processor where there is enough of it: less than a call costs goes
/// number by number.
#[inline]
pub fn vectorized_where(is_long: bool, work: impl Work) {
    if is_long {
        vectorized(work);
    } else {
        work.run(pulp::Scalar::new());
    }
}

/// Does work with the vector instructions of this processor.
#[inline]
pub fn vectorized(work: impl Work) {
    struct Run<W>(W);
    impl<W: Work> pulp::WithSimd for Run<W> {
        type Output = ();
        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            self.0.run(simd);
        }
    }
    pulp::Arch::new().dispatch(Run(work));
}
