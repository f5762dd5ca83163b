//! What the master reads.

use super::{
    AngleId, Cable, ConstraintOwnerId, DirectionSource, GaugeId, LayerId, LoadId, PointId, Reduced,
    ResolvedMarker, SlideId, Slider,
};
use crate::scene::description::{Along, OutputKind};

/// A joint or a motion that reacts.
#[derive(Clone, Copy, Debug)]
pub struct Reaction<'a> {
    /// Name.
    pub name: &'a str,
    /// Which one.
    pub holder: ConstraintOwnerId,
    /// Whether it is a motion.
    pub is_motion: bool,
}

/// A quantity that the master reads.
#[derive(Clone, Copy, Debug)]
pub struct Output<'a> {
    /// Kind of quantity that is read.
    pub kind: OutputKind,
    /// Object that the quantity is read at, depending on its kind.
    pub of: OutputTarget<'a>,
    /// Along which axes.
    pub along: Along,
}

/// Object that an output is read at.
#[derive(Clone, Copy, Debug)]
pub enum OutputTarget<'a> {
    /// A marker.
    Marker(ResolvedMarker<'a>),
    /// A marker of a cable, and another one of the same body.
    Deflected(ResolvedMarker<'a>, Option<ResolvedMarker<'a>>),
    /// Marker or joint with an angle.
    Rotation(DirectionSource<'a>),
    /// Marker or joint with an angle that is counted over full turns.
    Angle(DirectionSource<'a>, AngleId),
    /// Points of the section at a marker: the first, and the points as described.
    Points(ResolvedMarker<'a>, PointId, &'a [Vec<f64>]),
    /// Bottom and top of the section at a marker: the first of both.
    Faces(ResolvedMarker<'a>, LayerId),
    /// Bottom and top of plies of the section at a marker: the first, and the numbers of the plies.
    Plies(ResolvedMarker<'a>, LayerId, &'a [u32]),
    /// A gauge of a reduced body, of this name.
    Gauge(&'a str, GaugeId),
    /// A joint of this name, and its slide.
    Slide(&'a str, SlideId),
    /// A joint or a motion.
    Reaction(Reaction<'a>),
    /// A joint along a line.
    Sliding(Slider<'a>),
    /// A gear or a latch of this name, and which owner of constraints it is.
    Relation(&'a str, ConstraintOwnerId),
    /// A load of this name, and the marker that it acts on; none of a contact of a body.
    Load(&'a str, LoadId, Option<ResolvedMarker<'a>>),
    /// A load of this name that pulls along a line.
    Rope(&'a str, LoadId),
    /// The scene.
    Scene,
    /// The spectrum of the scene: the body whose name those of the variables begin with, and how many there are.
    Spectrum(Option<&'a str>, u32),
}

/// A point of a section whose stress is read.
#[derive(Clone, Copy, Debug)]
pub struct SectionPoint<'a> {
    /// Where the section is.
    pub marker: ResolvedMarker<'a>,
    /// The cable, rod or beam.
    pub cable: Cable<'a>,
    /// Material coordinate of the section, in [0, 1].
    pub at: f64,
    /// Coordinates along the first and the second axis of the section; in the plane the way from the line to the left, and 0, m.
    pub point: [f64; 2],
}

/// A height in the section of a plate or shell where stress is read.
#[derive(Clone, Copy, Debug)]
pub struct SectionLayer<'a> {
    /// Where on the surface.
    pub marker: ResolvedMarker<'a>,
    /// Height along the normal from the middle surface, m.
    pub height: f64,
    /// Stress of strains along the axes of the section, Pa.
    pub law: [[f64; 3]; 3],
}

/// A gauge of a reduced body whose stress is read.
#[derive(Clone, Copy, Debug)]
pub struct ResolvedGauge<'a> {
    /// The body.
    pub reduced: Reduced<'a>,
    /// Stress by all modes of the file, `xx yy zz xy xz yz` in the file's axes, Pa.
    pub by_modes: &'a [[f64; 6]],
}
