//! Forces and moments: at markers, in joints and along bodies.

use super::line::{component, uniform, varying};
use super::*;
use crate::math::function::Function;
use crate::math::space::axis;
use crate::scene::assemble::{each, unit};
use crate::scene::description::{Acting, ActionKind, ActsOn, LoadValue, is_false};
use crate::scene::resolved::{Pivot, Plate};
use crate::system::Direction;
use crate::system::loads::{
    AreaAction, AreaLoad, AreaValues, DistributedForce, DistributedMoment, Force, Moment,
    SpatialMoment,
};

/// The axis of the plane.
const THIRD: [f64; 3] = [0.0, 0.0, 1.0];

/// A force at a marker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ForceLoad {
    /// Marker that the force acts at, `body.marker`.
    pub marker: String,
    /// Whether the components rotate with the marker. They are then along and to the left of its direction in the plane, and along the
    /// axes of the body's frame in space.
    #[serde(default, skip_serializing_if = "is_false")]
    pub follower: bool,
    /// Components of the force, N: two in the plane, three in space.
    pub value: LoadValue,
}

/// A moment at a marker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MomentLoad {
    /// Marker that the moment acts at, `body.marker`.
    pub marker: String,
    /// Whether the components rotate with the marker, along the axes of the body's frame; in space only.
    #[serde(default, skip_serializing_if = "is_false")]
    pub follower: bool,
    /// Moment, N m: one value in the plane, three components in space.
    pub value: LoadValue,
}

/// A moment between the two bodies of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Torque {
    /// Name of the joint with an axis that the torque acts about.
    pub joint: String,
    /// Torque on the second marker, N m: one value.
    pub value: LoadValue,
}

/// A force along a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DistributedForceLoad {
    /// Name of the cable, rod or beam that the force acts along.
    pub body: String,
    /// Components of the force per reference length, N/m: two in the plane, three in space. Expressions may contain the material
    /// coordinate `s` of the body, which is 0 at the first end and 1 at the last.
    pub value: LoadValue,
}

/// A moment along the sections of a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DistributedMomentLoad {
    /// Name of the rod or beam that the moment acts along.
    pub body: String,
    /// Whether the components rotate with the sections, along their axes; in space only.
    #[serde(default, skip_serializing_if = "is_false")]
    pub follower: bool,
    /// Moment per reference length, N m/m: one value in the plane, three components in space. Expressions may contain the material
    /// coordinate `s` of the body, which is 0 at the first end and 1 at the last.
    pub value: LoadValue,
}

/// A pressure on a plate or shell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PressureLoad {
    /// Name of the plate or shell that the pressure acts on.
    pub body: String,
    /// Pressure along the normal, Pa: one value. Expressions may contain the coordinates `s1` and `s2` of the body, each from 0 to 1.
    pub value: LoadValue,
}

/// A force over the surface of a plate or shell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AreaForceLoad {
    /// Name of the plate or shell that the force acts on.
    pub body: String,
    /// Components of the force per area, N/m^2. Expressions may contain the coordinates `s1` and `s2` of the body, each from 0 to 1.
    pub value: LoadValue,
}

/// A force or a moment, known or an input.
#[derive(Clone, Debug)]
pub struct Action<'a> {
    /// Which.
    pub kind: ActionKind,
    /// Marker, joint or line body that it acts on, depending on its kind; in a joint on the second marker, and opposite on the first.
    pub on: LoadPlace<'a>,
    /// Whether it rotates with the marker.
    pub follower: bool,
    /// Components, as many as the kind has. Components that vary along a body are zero here.
    pub components: Vec<Signal>,
    /// Components that change along a body, and their expressions.
    pub along: Vec<(usize, &'a str)>,
    /// Components as written in the scene; none of an input.
    pub given: &'a [Value],
}

/// A load that is a force or a moment.
pub trait Acts: Clone {
    /// Returns the force or moment with its components.
    fn acting(&self) -> (Acting<'_>, &LoadValue);
}

/// Says of structs of keys which force or moment they are, and on what.
macro_rules! acts {
    ($($load:ident: $kind:ident on $on:ident $(with $follower:ident)?;)*) => {$(
        impl Acts for $load {
            fn acting(&self) -> (Acting<'_>, &LoadValue) {
                let acting = Acting {
                    kind: ActionKind::$kind,
                    on: &self.$on,
                    follower: false $(|| self.$follower)?,
                };
                (acting, &self.value)
            }
        }
    )*};
}

acts! {
    ForceLoad: Force on marker with follower;
    MomentLoad: Moment on marker with follower;
    Torque: Torque on joint;
    DistributedForceLoad: DistributedForce on body;
    DistributedMomentLoad: DistributedMoment on body with follower;
    PressureLoad: Pressure on body;
    AreaForceLoad: AreaForce on body;
}

impl<L: Acts> SceneLoad for L {
    type Acting<'a>
        = Action<'a>
    where
        L: 'a;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let (acting, given) = self.acting();
        let dimension = scene.scene.dimension;
        let signals = signals(&format!("{path}.value"), acting.kind, given, dimension)?;
        let mut action = scene.resolve_action(path, acting, signals)?;
        action.given = given.components();
        action.along = varying(action.given);
        Ok(action)
    }

    fn is_action(&self) -> bool {
        true
    }

    fn timed(&self) -> Option<TimedKey<'_>> {
        Some(TimedKey {
            key: "value",
            values: self.acting().1.components(),
            order: 0,
        })
    }
}

impl<'a> ActingLoad<'a> for Action<'a> {
    fn place(&self) -> LoadPlace<'a> {
        self.on
    }

    fn action(&self) -> Option<&Action<'a>> {
        Some(self)
    }

    /// Components that vary along a body are parsed for every Gauss point.
    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        path: &str,
    ) -> AssembledLoad<D> {
        let mut load = builder.action(self);
        if let LoadPlace::Line(cable) = self.on {
            let (along, path) = (&self.along[..], format!("{path}.value"));
            match &mut load {
                AppliedLoad::DistributedForce(on) => {
                    builder.fill(cable, along, &path, &mut on.density.along)?;
                }
                AppliedLoad::DistributedMoment(on) => {
                    // In the plane the third alone.
                    let first = if D == 2 { 2 } else { 0 };
                    builder.fill(cable, along, &path, &mut on.density.along[first..])?;
                }
                _ => {}
            }
        }
        if let (LoadPlace::Surface(plate), AppliedLoad::AreaLoad(load)) = (self.on, &mut load) {
            for (k, text) in &self.along {
                let path = match self.given {
                    [_] => format!("{path}.value"),
                    _ => format!("{path}.value[{k}]"),
                };
                load.action.values_mut()[*k].places = builder.over_places(plate, text, &path)?;
            }
        }
        Ok(load)
    }

    fn words(&self, _dimension: usize) -> LoadWords {
        let [what, unit] = self.kind.words();
        let turning = if self.follower {
            " that turns along (along and across)"
        } else {
            ""
        };
        LoadWords {
            kind: format!("{what}{turning}, {unit}"),
            on: words::code(self.on.name()),
            size: words::values(self.given),
        }
    }
}

/// The components of a load as functions of time.
fn signals(
    path: &str,
    kind: ActionKind,
    given: &LoadValue,
    dimension: usize,
) -> Result<Vec<Signal>, Error> {
    let signal = |path: &str, of: &Value| component(path, of, kind.coordinates());
    match given {
        _ if kind.is_force() || kind.components(dimension) > 1 => {
            components(path, dimension, given.components(), signal)
        }
        LoadValue::One(of) => Ok(vec![signal(path, of)?]),
        LoadValue::Vector(values) => Err(expected(path, "one value", values.len())),
    }
}

impl<'a> Resolved<'a> {
    /// Resolves a force or a moment with its components, on the marker, joint or body that it names. A follower rotates
    /// with its marker.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, or a moment in the plane that follows.
    pub(crate) fn resolve_action(
        &self,
        path: &str,
        Acting { kind, on, follower }: Acting<'a>,
        components: Vec<Signal>,
    ) -> Result<Action<'a>, Error> {
        if follower && !kind.is_force() && self.scene.dimension == 2 {
            let wanted = "nothing for a moment in the plane";
            return Err(expected(&format!("{path}.follower"), wanted, "true"));
        }
        let at = |key: &str| format!("{path}.{key}");
        let on = match kind.acts_on() {
            // A direction is what a moment rotates and what a follower rotates with.
            ActsOn::Marker => LoadPlace::Marker(if follower || !kind.is_force() {
                self.require_spinning(&at("marker"), on)?
            } else {
                self.require_marker(&at("marker"), on)?
            }),
            ActsOn::Joint => {
                let pivot = self.require_pivot(&at("joint"), on)?;
                LoadPlace::Coordinate(JointCoordinate::Angle(pivot))
            }
            ActsOn::Cable => LoadPlace::Line(self.require_cable(&at("body"), on)?),
            ActsOn::Sections => LoadPlace::Line(self.require_sections(&at("body"), on)?),
            ActsOn::Surface => LoadPlace::Surface(self.require_plate(&at("body"), on)?),
        };
        Ok(Action {
            kind,
            on,
            follower,
            components,
            along: Vec::new(),
            given: &[],
        })
    }
}

impl<const D: usize> Builder<'_, D> {
    /// A force or a moment, without what varies along a body.
    pub(crate) fn action(&self, action: &Action<'_>) -> AppliedLoad<D> {
        let components = &action.components;
        let moment = |ends| {
            AppliedLoad::Moment(Moment {
                ends,
                size: components[0].clone(),
            })
        };
        match action.on {
            LoadPlace::Marker(marker) if action.kind.is_force() => AppliedLoad::Force(Force {
                marker: self.marker(marker),
                follower: action.follower,
                components: each(components),
                axes: self.frame_axes(marker),
            }),
            LoadPlace::Marker(marker) if D == 3 => self.moment_on(marker, action),
            LoadPlace::Coordinate(JointCoordinate::Angle(pivot)) if D == 3 => {
                self.torque(pivot, action)
            }
            LoadPlace::Marker(marker) => moment(self.on_marker(marker)),
            LoadPlace::Coordinate(on) => moment(self.ends(on.ends())),
            LoadPlace::Ends(ends) => moment(self.ends(ends)),
            LoadPlace::Surface(plate) => self.over(plate, action),
            LoadPlace::Line(cable) if !action.kind.is_force() => self.moment_along(cable, action),
            LoadPlace::Line(cable) => AppliedLoad::DistributedForce(DistributedForce {
                on: self.line(cable),
                density: uniform(components),
            }),
        }
    }

    /// A load over the surface of a plate or shell.
    fn over(&self, plate: Plate<'_>, action: &Action<'_>) -> AppliedLoad<D> {
        let components = &action.components;
        AppliedLoad::AreaLoad(Box::new(AreaLoad {
            on: self.surface(plate),
            action: match action.kind {
                ActionKind::Pressure => {
                    AreaAction::Pressure(AreaValues::uniform(components[0].clone()))
                }
                _ => AreaAction::Force(Box::new(each(components).map(AreaValues::uniform))),
            },
        }))
    }

    /// Evaluates a component that varies over a plate or shell at the places of quadrature of its elements.
    ///
    /// # Errors
    /// An expression that has no value at a place.
    pub(super) fn over_places(
        &self,
        plate: Plate<'_>,
        text: &str,
        path: &str,
    ) -> Result<Vec<Signal>, Error> {
        let places = self.patch_of(plate).area_places();
        let signal = |at: [f64; 2]| {
            let function = Function::at(text, &[("s1", at[0]), ("s2", at[1])]);
            let function = function.map_err(|told| Error::new(path, told))?;
            Ok(Signal::Function(function))
        };
        places.map(signal).collect()
    }

    /// A moment along a rod or beam.
    fn moment_along(&self, cable: Cable<'_>, action: &Action<'_>) -> AppliedLoad<D> {
        let on = self.sections_of(cable);
        AppliedLoad::DistributedMoment(Box::new(DistributedMoment {
            on: on.expect("a body with sections is among the rods"),
            end: self.along(cable, 0.0),
            follower: action.follower,
            density: match D {
                2 => {
                    let none = || Signal::Function(Function::Constant(0.0));
                    uniform(&[none(), none(), action.components[0].clone()])
                }
                _ => uniform(&action.components),
            },
        }))
    }

    /// A moment on a rigid body: in global axes, or in those of its frame.
    fn moment_on(&self, marker: ResolvedMarker<'_>, action: &Action<'_>) -> AppliedLoad<D> {
        let axes = self.frame_axes(marker);
        let about = |k: usize| {
            if action.follower {
                Direction::Of(axes[k])
            } else {
                Direction::Fixed(axis(k))
            }
        };
        let parts = action.components.iter().enumerate();
        AppliedLoad::SpatialMoment(SpatialMoment {
            ends: self.on_marker(marker),
            is_torque: false,
            parts: parts.map(|(k, size)| (size.clone(), about(k))).collect(),
        })
    }

    /// A torque about the axis of a joint.
    fn torque(&self, pivot: Pivot<'_>, action: &Action<'_>) -> AppliedLoad<D> {
        let ends = self.ends(pivot.ends);
        let about = self.fixed(&ends[0], unit(pivot.axis.unwrap_or(THIRD)));
        let sizes = action.components.iter();
        AppliedLoad::SpatialMoment(SpatialMoment {
            ends,
            is_torque: true,
            parts: sizes.map(|size| (size.clone(), about)).collect(),
        })
    }
}
