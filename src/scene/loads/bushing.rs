//! Springs and dampers along and about three axes.

use super::*;
use crate::math::space::{Vector, axis};
use crate::system::loads::{BetweenFrames, Bushing, BushingMeasure};
use crate::system::{Direction, Translation};

/// Springs and dampers along and about three axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BushingLoad {
    /// Markers that the bushing connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// Stiffness along the three axes, N/m; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub translational_stiffness: Option<[f64; 3]>,
    /// Damping along the three axes, N s/m; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub translational_damping: Option<[f64; 3]>,
    /// Stiffness about the three axes, N m/rad; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotational_stiffness: Option<[f64; 3]>,
    /// Damping about the three axes, N m s/rad; zeros by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotational_damping: Option<[f64; 3]>,
}

/// Springs and dampers along and about the axes of the first end's body.
#[derive(Clone, Debug)]
pub struct ResolvedBushing<'a> {
    /// Ends of the bushing.
    ends: Ends<'a>,
    /// Stiffness along (N/m) and about (N m/rad) the axes.
    stiffness: [[f64; 3]; 2],
    /// Damping along (N s/m) and about (N m s/rad) the axes.
    damping: [[f64; 3]; 2],
}

impl SceneLoad for BushingLoad {
    type Acting<'a> = ResolvedBushing<'a>;

    const EXERTS: Exerts = Exerts::ForceAndMoment;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        if scene.scene.dimension == 2 {
            let wanted = "spring_damper, or revolute with a stiffness in the plane";
            return Err(expected(&format!("{path}.kind"), wanted, "bushing"));
        }
        let markers = &self.markers;
        let ends = scene.require_pair(path, markers, None)?;
        if let First::Marker(_) = ends.first {
            scene.require_standing(&format!("{path}.markers[0]"), &markers[0])?;
        }
        scene.require_standing(&format!("{path}.markers[1]"), &markers[1])?;
        #[rustfmt::skip] // a table
        let all = [
            ("translational_stiffness", self.translational_stiffness, NEWTON_PER_METRE),
            ("rotational_stiffness", self.rotational_stiffness, NEWTON_METRE_PER_RADIAN),
            ("translational_damping", self.translational_damping, NEWTON_SECOND_PER_METRE),
            ("rotational_damping", self.rotational_damping, NEWTON_METRE_SECOND_PER_RADIAN),
        ];
        if all.iter().all(|(_, given, _)| given.is_none()) {
            return Err(expected(path, "stiffnesses or dampings", "none"));
        }
        for (key, given, unit) in all {
            for (k, value) in given.iter().flatten().enumerate() {
                not_negative(&format!("{path}.{key}[{k}]"), &unit.text(), *value)?;
            }
        }
        let [along, about, damped, turned] = all.map(|(_, given, _)| given.unwrap_or_default());
        Ok(ResolvedBushing {
            ends,
            stiffness: [along, about],
            damping: [damped, turned],
        })
    }

    fn numbers(&mut self, _on: LoadExtent) -> Vec<LoadNumber<'_>> {
        #[rustfmt::skip] // a table
        let numbers = vec![
            LoadNumber::new("translational_stiffness", "Stiffness along", Some(NEWTON_PER_METRE), Axes(&mut self.translational_stiffness)),
            LoadNumber::new("translational_damping", "Damping along", Some(NEWTON_SECOND_PER_METRE), Axes(&mut self.translational_damping)),
            LoadNumber::new("rotational_stiffness", "Stiffness about", Some(NEWTON_METRE_PER_RADIAN), Axes(&mut self.rotational_stiffness)),
            LoadNumber::new("rotational_damping", "Damping about", Some(NEWTON_METRE_SECOND_PER_RADIAN), Axes(&mut self.rotational_damping)),
        ];
        numbers
    }
}

impl<'a> ActingLoad<'a> for ResolvedBushing<'a> {
    fn place(&self) -> LoadPlace<'a> {
        LoadPlace::Ends(self.ends)
    }

    fn stiffness(&self) -> [f64; 2] {
        (self.stiffness).map(|axes| axes.into_iter().fold(0.0, f64::max))
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        _path: &str,
    ) -> AssembledLoad<D> {
        let ends = builder.ends(self.ends);
        let first = match self.ends.first {
            First::Marker(marker) => builder.frame_axes(marker).map(Direction::Of),
            First::Ground(_) | First::Cable(_) => {
                std::array::from_fn(|k| Direction::Fixed(axis(k)))
            }
        };
        let nodes = &builder.parts.bodies.reference;
        let axes: [Vector<D>; D] = first.map(|axis| axis.value(nodes));
        let second = axes.map(|axis| builder.fixed(&ends[1], axis));
        // In space alone.
        let three = |of: &[Direction<D>; D]| std::array::from_fn(|k| of[k.min(D - 1)]);
        let ways = three(&first).map(|direction| Translation {
            ends,
            direction,
            turn: [0.0, 1.0],
        });
        Ok(AppliedLoad::Bushing(Box::new(Bushing {
            measure: BushingMeasure::Frames(BetweenFrames {
                rest: ways.map(|way| way.value(nodes)),
                ways,
                axes: [three(&first), three(&second)],
            }),
            stiffness: self.stiffness,
            damping: self.damping,
        })))
    }

    fn words(&self, _dimension: usize) -> LoadWords {
        let units = [["N/m", "N·m/rad"], ["N·s/m", "N·m·s/rad"]];
        let sizes = [self.stiffness, self.damping];
        let sizes = sizes.iter().zip(units).flat_map(|(sizes, units)| {
            let sizes = sizes.iter().zip(units);
            sizes.map(|(axes, unit)| format!("{} {unit}", words::vector(3, *axes)))
        });
        let point = words::at_point(3, &self.ends);
        LoadWords {
            kind: "bushing".into(),
            on: format!("{}{point}", words::ends(&self.ends)),
            size: sizes.collect::<Vec<_>>().join(", "),
        }
    }
}
