//! A one-sided spring with a damper: compressed by `d` it pushes with `k d (1 + a d')`. It is continuous, damping with it, since a damper
//! beside the spring would push all at once where contact begins; its derivatives have a kink there, which the control of errors steps up
//! to. Where `d` shrinks so fast that the bracket is negative, it pushes no more: nothing sticks.
//!
//! Source: K. H. Hunt, F. R. E. Crossley, Coefficient of restitution interpreted as damping in vibroimpact, Journal of Applied
//! Mechanics 42 (1975) 440-445, with a force that is linear in `d`.

use crate::math::jet::Number;

/// One-sided spring with a damper.
#[derive(Clone, Copy, Debug)]
pub struct OneSidedSpring {
    /// Stiffness `k`, N/m or N m/rad; along a body N/m per reference length.
    pub stiffness: f64,
    /// Damping `a` relative to the stiffness, s/m or s/rad.
    pub damping: f64,
}

/// A one-sided spring while it is compressed.
pub(super) struct Compression<N> {
    spring: OneSidedSpring,
    /// Compression `d`, m or rad.
    pub depth: N,
    /// Rate `d'` of the compression.
    rate: N,
    /// Bracket `1 + a d'` of the force; 0 where it would be negative.
    bracket: N,
}

impl OneSidedSpring {
    /// Compresses the spring by a positive depth that grows at a rate.
    #[inline(always)]
    pub(super) fn compressed<N: Number>(self, depth: N, rate: N) -> Compression<N> {
        let bracket = N::of(1.0) + N::of(self.damping) * rate;
        let is_pushing = bracket.plain() > 0.0;
        Compression {
            spring: self,
            depth,
            rate,
            bracket: if is_pushing { bracket } else { N::of(0.0) },
        }
    }

    /// Energy that is stored at a depth, J or J/m.
    pub(super) fn energy<N: Number>(self, depth: N) -> N {
        N::of(0.5 * self.stiffness) * depth * depth
    }
}

impl<N: Number> Compression<N> {
    /// Pushing force, N, N m or N/m.
    #[inline(always)]
    pub fn force(&self) -> N {
        N::of(self.spring.stiffness) * self.depth * self.bracket
    }

    /// Dissipated power, W or W/m. Where the spring no longer pushes, the stored energy is lost.
    pub fn dissipation(&self) -> N {
        let beyond = self.bracket - N::of(1.0);
        N::of(self.spring.stiffness) * self.depth * beyond * self.rate
    }
}

impl Compression<f64> {
    /// Derivatives of the force by depth and by its rate.
    pub fn slopes(&self) -> [f64; 2] {
        let OneSidedSpring { stiffness, damping } = self.spring;
        let by_rate = if self.bracket > 0.0 {
            stiffness * damping * self.depth
        } else {
            0.0
        };
        [stiffness * self.bracket, by_rate]
    }
}
