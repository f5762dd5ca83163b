//! Joints by what they leave free.

use super::*;

/// A joint by what it leaves free.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Generic {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Translations along and rotations about the axes of the first marker's body that are free. The joint holds all others. With
    /// `ground` these are the global axes. Of two free rotations the first is about the axis of the first body.
    pub free: Vec<Freedom>,
}

/// A translation or a rotation that a joint leaves free.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Freedom {
    /// Along the first axis.
    X,
    /// Along the second axis.
    Y,
    /// Along the third axis.
    Z,
    /// About the first axis.
    RotationX,
    /// About the second axis.
    RotationY,
    /// About the third axis.
    RotationZ,
}

impl Freedom {
    /// Which axis it is of, and whether it is a rotation.
    pub fn axis(self) -> (usize, bool) {
        match self {
            Self::X => (0, false),
            Self::Y => (1, false),
            Self::Z => (2, false),
            Self::RotationX => (0, true),
            Self::RotationY => (1, true),
            Self::RotationZ => (2, true),
        }
    }
}

impl SceneJoint for Generic {
    fn parts(&self) -> JointParts {
        JointParts {
            needs_axes: true,
            ..JointParts::new(Symbol::Orientation, self.primitives()).at(self.point)
        }
    }

    fn check(&self, path: &str, _ends: &Ends<'_>) -> Found<()> {
        let (path, free) = (format!("{path}.free"), &self.free);
        let twice = (1..free.len()).find(|k| free[..*k].contains(&free[*k]));
        if let Some(k) = twice {
            let wanted = "a freedom that is not in the list yet";
            let found = format!("{:?} again", free[k]);
            return Err(expected(&format!("{path}[{k}]"), wanted, found));
        }
        if free.len() == 6 {
            let wanted = "freedoms that leave something to hold";
            return Err(expected(&path, wanted, "all six"));
        }
        Ok(())
    }
}

impl Generic {
    /// Returns the primitives that hold what is not free.
    fn primitives(&self) -> Vec<JointPrimitive> {
        let axis = |k: usize| std::array::from_fn(|i| f64::from(u8::from(i == k)));
        let named = |is_rotation: bool| {
            let free = self.free.iter().map(|freedom| freedom.axis());
            let free = free.filter(|(_, of)| *of == is_rotation).map(|(k, _)| k);
            free.collect::<Vec<usize>>()
        };
        let (ways, turns) = (named(false), named(true));
        let mut primitives: Vec<JointPrimitive> = match ways[..] {
            [] => vec![AtPoint],
            [along] => vec![Inline(axis(along))],
            _ => {
                let held = (0..3).filter(|k| !ways.contains(k));
                held.map(|k| Inplane(axis(k))).collect()
            }
        };
        primitives.extend(match turns[..] {
            [] => Some(Orientation(None)),
            [about] => Some(ParallelAxes(axis(about))),
            [first, second] => Some(Perpendicular(axis(first), axis(second))),
            _ => None,
        });
        primitives
    }
}
