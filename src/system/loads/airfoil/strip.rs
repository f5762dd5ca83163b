//! A strip of an airfoil: its directions, and the flow past it.

use super::Instant;
use crate::bodies::Marker;
use crate::math::jet::Number;
use crate::math::space::{Vector, perpendicular, spun};
use crate::system::end::Attachment;

/// Part of the chord from the aerodynamic centre to the point whose velocity counts.
const BEHIND: f64 = 0.5;

/// Directions of a section: of the chord, towards the trailing edge, and of the lift at no angle of attack.
#[derive(Clone, Copy, Debug)]
pub enum AirfoilAxes {
    /// In the plane, by a marker and the angle, rad, from its direction to the chord; the other one is to its left.
    Angle(Marker, f64),
    /// In space, as directions of markers.
    Markers([Marker; 2]),
}

/// A strip of an airfoil. Its directions are those of one section of a body, or lie between those of two.
#[derive(Clone, Debug)]
pub struct AirfoilStrip {
    /// Point of the body that it belongs to.
    pub point: Marker,
    /// Sections and their weights.
    pub sections: [(f64, AirfoilAxes); 2],
    /// Length along the span, m.
    pub span: f64,
    /// Chord, m.
    pub chord: f64,
    /// Distance of the aerodynamic centre ahead of the point, m.
    pub ahead: f64,
    /// Material coordinate of the body, in [0, 1].
    pub s: f64,
}

/// Directions of a strip.
pub(super) struct StripAxes<const D: usize, N> {
    /// Unit vector along the chord.
    pub(super) chord: Vector<D, N>,
    /// Unit vector across it.
    pub(super) up: Vector<D, N>,
    /// Rate of the first, 1/s.
    pub(super) rate: Vector<D, N>,
    /// Length of what lies between the directions of the sections.
    pub(super) length: N,
}

/// Flow past a strip.
pub(super) struct StripFlow<const D: usize, N> {
    pub(super) axes: StripAxes<D, N>,
    /// Rate of pitch, with that of the motion of the whole, nose up, rad/s.
    pub(super) pitch: N,
    /// Velocity of the air past the strip along both axes, m/s.
    pub(super) past: [N; 2],
}

impl<const D: usize, N: Number> StripFlow<D, N> {
    /// Unit vectors of lift and drag, times the speed.
    pub(super) fn directions(&self) -> [Vector<D, N>; 2] {
        let (StripAxes { chord, up, .. }, [along, across]) = (&self.axes, self.past);
        [*up * along - *chord * across, *chord * along + *up * across]
    }

    pub(super) fn speed(&self) -> N {
        let [along, across] = self.past;
        (along * along + across * across).sqrt()
    }

    /// Angle of attack, rad.
    pub(super) fn angle(&self) -> N {
        let [along, across] = self.past;
        across.angle(along)
    }

    /// Whether there is none, where forces have no direction.
    pub(super) fn is_still(&self) -> bool {
        self.past.iter().all(|part| part.plain() == 0.0)
    }
}

impl AirfoilAxes {
    /// Unit vectors along the chord and across it, and the rate of the first, 1/s.
    pub(super) fn directions<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
    ) -> [Vector<D, N>; 3] {
        match self {
            Self::Angle(of, angle) => {
                let end = Attachment::Body(of.lift());
                let u = end.direction(at.x).normalize();
                let (sin, cos) = angle.sin_cos();
                let chord = u * N::of(cos) + perpendicular(u) * N::of(sin);
                let up = perpendicular(chord);
                [chord, up, up * end.spin(at.x, at.v)]
            }
            Self::Markers(axes) => {
                let [chord, up] = axes.each_ref().map(|axis| axis.lift());
                [
                    chord.direction(at.x),
                    up.direction(at.x),
                    chord.direction(at.v),
                ]
            }
        }
    }
}

impl AirfoilStrip {
    /// Sections that its directions follow from, with their weights.
    pub(super) fn sections(&self) -> impl Iterator<Item = &(f64, AirfoilAxes)> {
        self.sections.iter().filter(|(weight, _)| *weight != 0.0)
    }

    /// Markers on whose nodes it depends.
    pub(super) fn markers(&self) -> impl Iterator<Item = Marker> {
        let of = self.sections().flat_map(|(_, axes)| match axes {
            AirfoilAxes::Angle(marker, _) => vec![*marker],
            AirfoilAxes::Markers(markers) => markers.to_vec(),
        });
        [self.point].into_iter().chain(of)
    }

    pub(super) fn axes<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> StripAxes<D, N> {
        let mut sums = [Vector::zeros(); 3];
        for (weight, axes) in self.sections() {
            let parts = axes.directions(at);
            let sums = sums.iter_mut().zip(parts);
            sums.for_each(|(sum, part)| *sum += part * N::of(*weight));
        }
        let [chord, up, rate] = sums;
        let length = chord.norm();
        let chord = chord / length;
        let rate = rate / length;
        StripAxes {
            chord,
            up: across(chord, up).normalize(),
            rate: across(chord, rate),
            length,
        }
    }

    pub(super) fn flow<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        wind: Vector<D, N>,
        (origin, spin): (Vector<D>, [f64; 3]),
    ) -> StripFlow<D, N> {
        let axes = self.axes(at);
        let mut turning = axes.rate;
        let point = self.point.lift();
        let mut velocity = point.position(at.v);
        velocity += origin.map(N::of);
        if spin != [0.0; 3] {
            velocity += spun(spin, point.position(at.x));
            turning += spun(spin, axes.chord);
        }
        velocity += turning * N::of(BEHIND * self.chord - self.ahead);
        let past = wind - velocity;
        StripFlow {
            pitch: -turning.dot(&axes.up),
            past: [axes.chord, axes.up].map(|axis| axis.dot(&past)),
            axes,
        }
    }
}

/// Part of a vector across a unit vector.
pub(super) fn across<const D: usize, N: Number>(
    unit: Vector<D, N>,
    of: Vector<D, N>,
) -> Vector<D, N> {
    of - unit * unit.dot(&of)
}
