//! Ropes that run over points, and onto drums.

use super::*;
use crate::math::function::Function;
use crate::math::space;
use crate::scene::marker::{GROUND, difference, length};
use crate::scene::validate::checks::vector;
use crate::system::Attachment;
use crate::system::loads::{Drum, MOST_POINTS, Reeving};

/// A rope without mass over points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ReevingLoad {
    /// Points that the rope runs over, in order from one of its ends to the other: `ground` or `body.marker`, from 2 to 30.
    #[schemars(length(min = 2, max = 30))]
    pub markers: Vec<String>,
    /// Points on the ground, one for each `ground` among `markers` in their order, m.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<SceneVector>,
    /// Axial stiffness of the rope, `E A`, N.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub axial_stiffness: f64,
    /// Kelvin-Voigt damping: ratio of viscosity to stiffness, s; 0 by default. The viscous part of the tension is at most as large as the
    /// elastic part.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping_time: Option<f64>,
    /// Length of the rope without stress, m; by default that of its path at the start. A drum winds up from it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<Value>,
    /// Name of a joint with an angle that rotates a drum. The drum winds up the rope from either of its ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drum: Option<String>,
    /// Radius of the drum, m: a positive angle of the joint winds up, of a negative radius it pays out. Needed with `drum`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drum_radius: Option<f64>,
}

/// A rope over points, and its drum.
#[derive(Clone, Debug)]
pub struct ResolvedReeving<'a> {
    /// As described.
    given: &'a ReevingLoad,
    /// Points from one end to the other.
    path: Vec<RopePoint<'a>>,
    /// Angle of the joint of a drum, and its radius, m.
    drum: Option<(JointCoordinate<'a>, f64)>,
    /// Length without stress, m; that of the path at the start if there is none.
    length: Option<Signal>,
}

/// A point that a rope runs over.
#[derive(Clone, Copy, Debug)]
pub enum RopePoint<'a> {
    /// A point of the ground, m.
    Ground([f64; 3]),
    /// A marker.
    Marker(ResolvedMarker<'a>),
}

impl<'a> RopePoint<'a> {
    /// Position as described, m.
    fn position(&self) -> [f64; 3] {
        match self {
            Self::Ground(point) => *point,
            Self::Marker(marker) => marker.position,
        }
    }

    /// The marker, if it is one.
    fn marker(&self) -> Option<ResolvedMarker<'a>> {
        match self {
            Self::Ground(_) => None,
            Self::Marker(marker) => Some(*marker),
        }
    }
}

impl SceneLoad for ReevingLoad {
    type Acting<'a> = ResolvedReeving<'a>;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let at = |key: &str| format!("{path}.{key}");
        let rope = self.resolve_path(path, scene)?;
        positive(&at("axial_stiffness"), "N", self.axial_stiffness)?;
        not_negative(
            &at("damping_time"),
            "s",
            self.damping_time.unwrap_or_default(),
        )?;
        let length = rest_length::course(path, self.length.as_ref(), positive)?;
        let drum = match (&self.drum, self.drum_radius) {
            (None, None) => None,
            (None, Some(radius)) => {
                let wanted = "nothing without a `drum`";
                return Err(expected(&at("drum_radius"), wanted, radius));
            }
            (Some(joint), radius) => {
                let radius = needed(path, "drum_radius", "a radius, m", radius)?;
                finite(&at("drum_radius"), radius)?;
                if radius == 0.0 {
                    let wanted = "a radius other than 0, m";
                    return Err(expected(&at("drum_radius"), wanted, radius));
                }
                let angle = CoordinateKind::Angle;
                let on = scene.require_coordinate(&at("drum"), joint, Some(angle), angle)?;
                Some((on, radius))
            }
        };
        Ok(ResolvedReeving {
            given: self,
            path: rope,
            drum,
            length,
        })
    }

    fn timed(&self) -> Option<TimedKey<'_>> {
        rest_length::timed(self.length.as_ref())
    }

    fn numbers(&mut self, _on: LoadExtent) -> Vec<LoadNumber<'_>> {
        let stiffness = Needed(&mut self.axial_stiffness);
        let damping = Optional(&mut self.damping_time);
        vec![
            LoadNumber::new(
                "axial_stiffness",
                "Axial stiffness",
                Some(NEWTON),
                stiffness,
            ),
            LoadNumber::new("damping_time", "Damping time", Some(SECOND), damping),
        ]
    }
}

impl ReevingLoad {
    /// Finds the points, which belong to two bodies or more (the ground counts).
    fn resolve_path<'a>(
        &'a self,
        path: &str,
        scene: &Resolved<'a>,
    ) -> Result<Vec<RopePoint<'a>>, Error> {
        let place = format!("{path}.markers");
        let count = self.markers.len();
        if !(2..=MOST_POINTS).contains(&count) {
            let wanted = format!("from 2 to {MOST_POINTS} of them");
            return Err(expected(&place, &wanted, count));
        }
        let mut points = self.points.iter().enumerate();
        let mut found = Vec::with_capacity(count);
        for (k, name) in self.markers.iter().enumerate() {
            if name != GROUND {
                let marker = scene.require_marker(&format!("{place}[{k}]"), name)?;
                found.push(RopePoint::Marker(marker));
                continue;
            }
            let Some((index, point)) = points.next() else {
                let wanted = "a point for each `ground` among `markers`";
                let found = format!("{} of them", self.points.len());
                return Err(expected(&format!("{path}.points"), wanted, found));
            };
            let place = format!("{path}.points[{index}]");
            vector(&place, scene.scene.dimension, point)?;
            found.push(RopePoint::Ground(point.full()));
        }
        if let Some((index, _)) = points.next() {
            let wanted = "no more points than `ground` is among `markers`";
            let place = format!("{path}.points");
            return Err(expected(&place, wanted, format!("{index} and more")));
        }
        let on = |point: &RopePoint<'_>| point.marker().map(|marker| marker.place.body_index());
        let first = on(&found[0]);
        if found.iter().all(|point| on(point) == first) {
            let wanted = "points of two bodies or more, of which the ground is one";
            return Err(expected(&place, wanted, "points of one"));
        }
        Ok(found)
    }
}

impl ResolvedReeving<'_> {
    /// Length without stress at the start if no input sets it, m; none where it changes in time.
    fn length_at_start(&self) -> Option<f64> {
        let span =
            |span: &[RopePoint<'_>]| length(difference(span[1].position(), span[0].position()));
        let drawn = || self.path.windows(2).map(span).sum();
        rest_length::at_start(self.given.length.as_ref(), drawn)
    }

    /// Length without stress, which an input may set.
    pub(super) fn rest_length(&mut self) -> RestLength<'_> {
        RestLength {
            start: self.length_at_start(),
            course: &mut self.length,
        }
    }
}

impl<'a> ActingLoad<'a> for ResolvedReeving<'a> {
    fn place(&self) -> LoadPlace<'a> {
        let last = self.markers().pop();
        LoadPlace::Marker(last.expect("a marker of a body"))
    }

    fn markers(&self) -> Vec<ResolvedMarker<'a>> {
        self.path.iter().filter_map(RopePoint::marker).collect()
    }

    fn bodies(&self) -> Vec<usize> {
        let path = self.markers().into_iter();
        let path = path.map(|marker| marker.place.body_index());
        let drum = self.drum.iter().flat_map(|(on, _)| on.ends().bodies());
        path.chain(drum).collect()
    }

    fn stiffness(&self) -> [f64; 2] {
        let length = self.length_at_start().unwrap_or(1.0);
        [self.given.axial_stiffness / length, 0.0]
    }

    fn is_one_sided(&self) -> bool {
        true
    }

    fn has_tension(&self) -> bool {
        true
    }

    fn spans(&self) -> Vec<Ends<'a>> {
        let ends = |pair: &[RopePoint<'a>]| {
            let (first, second) = match (pair[0], pair[1]) {
                (first, RopePoint::Marker(second)) => (first, second),
                (RopePoint::Marker(second), first) => (first, second),
                (RopePoint::Ground(_), RopePoint::Ground(_)) => return None,
            };
            let first = match first {
                RopePoint::Ground(point) => First::Ground(Some(point)),
                RopePoint::Marker(marker) => First::Marker(marker),
            };
            Some(Ends { first, second })
        };
        self.path.windows(2).filter_map(ends).collect()
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        _path: &str,
    ) -> AssembledLoad<D> {
        let drum = self.drum.map(|(on, radius)| {
            let angle = Box::new(builder.coordinate(&on));
            Drum {
                start: builder.at_start(&angle),
                angle,
                radius,
            }
        });
        let point = |point: &RopePoint<'_>| match *point {
            RopePoint::Ground(point) => Attachment::Ground(space::vector(point)),
            RopePoint::Marker(marker) => Attachment::Body(builder.marker(marker)),
        };
        let points: Vec<_> = self.path.iter().map(point).collect();
        let now = || {
            let spans = points.array_windows();
            let lengths = spans.map(|span| builder.distance_at_start(span));
            Signal::Function(Function::Constant(lengths.sum()))
        };
        Ok(AppliedLoad::Reeving(Box::new(Reeving {
            length: self.length.clone().unwrap_or_else(now),
            points,
            drum,
            axial_stiffness: self.given.axial_stiffness,
            damping_time: self.given.damping_time.unwrap_or_default(),
        })))
    }

    fn words(&self, dimension: usize) -> LoadWords {
        let point = |point: &RopePoint<'_>| match point {
            RopePoint::Ground(point) => words::vector(dimension, *point),
            RopePoint::Marker(marker) => words::code(marker.name),
        };
        let drum = self.drum.map(|(on, radius)| {
            let (joint, radius) = (words::code(on.name()), number(radius));
            format!(", a drum of radius {radius} m on {joint}")
        });
        let length = self.given.length.as_ref().map_or(String::new(), |length| {
            format!(", length without stress {} m", words::value(length))
        });
        let stiffness = number(self.given.axial_stiffness);
        LoadWords {
            kind: "rope over points".into(),
            on: self.path.iter().map(point).collect::<Vec<_>>().join(", "),
            size: format!("{stiffness} N{length}{}", drum.unwrap_or_default()),
        }
    }
}
