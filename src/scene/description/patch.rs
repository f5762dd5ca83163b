//! Plates and shells: surfaces, what they are made of, and markers on them.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::de::Deserializer;
use serde::{Deserialize, Serialize, Serializer};

use super::SceneVector;
use super::accuracy::elements;
use super::body::InitialMotion;
use super::reader::found;
use super::strict::{Strict, typed};
use super::value::Value;

/// A thin plate or shell of bicubic elements: stretches and bends, does not shear through its thickness. In space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatchBody {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Middle surface without stress, also the configuration at the start. Coordinates `s1` and `s2` run over it from 0 to 1.
    pub surface: PatchSurface,
    /// Numbers of elements along `s1` and `s2`, each from 1 to 200; `"auto"` for one of them or for both, or nothing said, is as many as the
    /// accuracy asks for, found while packaging. Edges that are joined have one number of elements.
    #[serde(default)]
    #[schemars(with = "MeshInJson")]
    pub mesh: PatchMesh,
    /// Isotropic material, with `thickness`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<PatchMaterial>,
    /// Thickness, m, with `material`: a number, or an expression in the coordinates `s1` and `s2` of the surface, each from 0 to 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thickness: Option<PatchThickness>,
    /// Plies from the bottom to the top, along the normal of the surface; instead of `material` and `thickness`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub laminate: Vec<LaminatePly>,
    /// Stiffness of a section as matrices; instead of `material` and `thickness`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<PatchStiffness>,
    /// Mass per area, kg/m^2, with `stiffness`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub area_density: Option<f64>,
    /// Kelvin-Voigt damping of `laminate` or `stiffness`: ratio of viscosity to stiffness, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping_time: Option<f64>,
    /// Angle of the first axis of `laminate` or `stiffness` from the lines along `s1`, counter-clockwise about the normal, rad.
    #[serde(default)]
    pub axis_angle: f64,
    /// Rigid motion at the start; velocity of the corner at `s1 = 0`, `s2 = 0`.
    #[serde(default)]
    pub motion: InitialMotion,
    /// Named points: `[s1, s2]`, or one with a pad.
    #[serde(default)]
    pub markers: BTreeMap<String, PatchMarker>,
}

/// Numbers of elements of a plate or shell along `s1` and `s2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PatchMesh {
    /// Numbers of elements; of those that are left to the planner the fewest that joints allow.
    pub counts: [u32; 2],
    /// Whether numbers are left to the planner.
    pub is_open: [bool; 2],
}

impl Default for PatchMesh {
    /// Left to the planner.
    fn default() -> Self {
        Self {
            counts: [1; 2],
            is_open: [true; 2],
        }
    }
}

impl From<[u32; 2]> for PatchMesh {
    fn from(counts: [u32; 2]) -> Self {
        Self {
            counts,
            is_open: [false; 2],
        }
    }
}

/// Numbers of elements in JSON: two, each an integer or `"auto"`, or that word for both.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Mesh")]
#[serde(untagged)]
enum MeshInJson {
    /// As many as the accuracy asks for along both coordinates: found while packaging.
    Auto(elements::Word),
    /// Numbers of elements along `s1` and `s2`.
    Counts([elements::InJson; 2]),
}

impl Serialize for PatchMesh {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let of = |k: usize| {
            if self.is_open[k] {
                elements::InJson::Auto(elements::Word::Auto)
            } else {
                elements::InJson::Count(self.counts[k])
            }
        };
        let value = if self.is_open == [true; 2] {
            MeshInJson::Auto(elements::Word::Auto)
        } else {
            MeshInJson::Counts([of(0), of(1)])
        };
        value.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for PatchMesh {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        const WANTED: &str = "two numbers of elements, each a positive integer or \"auto\"";
        let is_auto = |value: &serde_json::Value| value.as_str() == Some("auto");
        let value = Strict::deserialize(deserializer)?.0;
        let refused =
            |found: String| serde::de::Error::custom(format!("expected {WANTED}, found {found}"));
        if is_auto(&value) {
            return Ok(Self::default());
        }
        let Some([first, second]) = value.as_array().map(Vec::as_slice) else {
            return Err(refused(match value.as_array() {
                Some(values) => values.len().to_string(),
                None => found(&value),
            }));
        };
        let mut mesh = Self::default();
        for (k, of) in [first, second].into_iter().enumerate() {
            if !is_auto(of) {
                mesh.is_open[k] = false;
                mesh.counts[k] = match of.as_u64().map(u32::try_from) {
                    Some(Ok(count)) => count,
                    _ => return Err(refused(found(of))),
                };
            }
        }
        Ok(mesh)
    }
}

/// Thickness of a plate or shell.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum PatchThickness {
    /// Thickness all over, m.
    Number(#[schemars(extend("exclusiveMinimum" = 0))] f64),
    /// Expression in `s1` and `s2`, m.
    Expression(String),
}

impl<'de> Deserialize<'de> for PatchThickness {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Value::deserialize(deserializer)? {
            Value::Number(number) => Ok(Self::Number(number)),
            Value::Expression(text) => Ok(Self::Expression(text)),
            Value::Table(_) => {
                let wanted = "expected a number or an expression in `s1` and `s2`, found a table";
                Err(serde::de::Error::custom(wanted))
            }
        }
    }
}

/// Isotropic material of a plate or shell.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatchMaterial {
    /// Young's modulus, Pa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub youngs_modulus: f64,
    /// Poisson's ratio, between -1 and 0.5.
    #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
    pub poisson_ratio: f64,
    /// Density, kg/m^3.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: f64,
    /// Kelvin-Voigt damping: ratio of viscosity to stiffness, s.
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub damping_time: f64,
}

/// Ply of a laminate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LaminatePly {
    /// Orthotropic material.
    pub material: PlyMaterial,
    /// Thickness, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thickness: f64,
    /// Angle of the first axis of the material from that of the laminate, counter-clockwise about the normal, rad.
    #[serde(default)]
    pub angle: f64,
}

/// Orthotropic material of a ply.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlyMaterial {
    /// Young's moduli along both axes, Pa.
    pub youngs_modulus: [f64; 2],
    /// Poisson's ratio: contraction along the second axis by tension along the first.
    pub poisson_ratio: f64,
    /// Shear modulus in the plane, Pa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_modulus: f64,
    /// Density, kg/m^3.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: f64,
}

/// Stiffness of a section of a plate or shell: forces `N = A e - B k` and moments `M = D k - B e` per length, of strains `e` of the middle
/// surface and curvatures `k`, each along the first axis, along the second and of shear (engineering). The strain at a height is `e - z k`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[expect(
    non_snake_case,
    reason = "the letters that laminates are described with"
)]
pub struct PatchStiffness {
    /// Membrane stiffness, N/m.
    pub A: [[f64; 3]; 3],
    /// Coupling, N; zero where nothing is said.
    #[serde(default)]
    pub B: [[f64; 3]; 3],
    /// Bending stiffness, N m.
    pub D: [[f64; 3]; 3],
}

/// A marker on a plate or shell.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum PatchMarker {
    /// A point `[s1, s2]`.
    Point([f64; 2]),
    /// The mean over a pad.
    Pad(Pad),
}

/// Pad of a marker: position and orientation are means over it, and forces are spread over it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pad {
    /// Middle of the pad, `[s1, s2]`.
    pub at: [f64; 2],
    /// Lengths along `s1` and `s2`, m; what is beyond the edges does not count.
    pub pad: [f64; 2],
}

impl<'de> Deserialize<'de> for PatchMarker {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Strict::deserialize(deserializer)?.0;
        if value.is_object() {
            typed(value).map(Self::Pad)
        } else {
            typed(value).map(Self::Point)
        }
    }
}

impl PatchMarker {
    /// Middle of the marker, `[s1, s2]`.
    pub fn at(&self) -> [f64; 2] {
        match self {
            Self::Point(at) | Self::Pad(Pad { at, .. }) => *at,
        }
    }

    /// Lengths of the pad, m; zero of a point.
    pub fn pad(&self) -> [f64; 2] {
        match self {
            Self::Point(_) => [0.0; 2],
            Self::Pad(Pad { pad, .. }) => *pad,
        }
    }
}

/// Middle surface of a plate or shell. Its normal is that of the lines along `s1` and `s2`, in this order. Plates take those that are flat.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum PatchSurface {
    /// Rectangle or parallelogram, flat.
    #[schemars(title = "RectangleSurface")]
    Rectangle {
        /// Corner where `s1` and `s2` are 0, m.
        corner: SceneVector,
        /// Edges along `s1` and `s2` from there, m.
        edges: [SceneVector; 2],
    },
    /// Four corners with straight edges; lines between opposite edges are straight.
    #[schemars(title = "QuadrilateralSurface")]
    Quadrilateral {
        /// Corners one after the other, m: at `[0, 0]`, `[1, 0]`, `[1, 1]` and `[0, 1]`.
        corners: [SceneVector; 4],
    },
    /// Sector of a ring, flat: `s1` outwards, `s2` around.
    #[schemars(title = "AnnulusSurface")]
    Annulus {
        /// Centre, m.
        center: SceneVector,
        /// Normal, of any length.
        normal: SceneVector,
        /// Direction of the edge `s2 = 0` from the centre, of any length; its part along the normal does not count.
        start: SceneVector,
        /// Inner and outer radius, m.
        radii: [f64; 2],
        /// Angle of the sector, counter-clockwise about the normal, rad.
        angle: f64,
    },
    /// Sector of a cylinder: `s1` around, `s2` along the axis. The normal points away from the axis.
    #[schemars(title = "CylinderSectorSurface")]
    Cylinder {
        /// Where its axis begins, m.
        from: SceneVector,
        /// Where its axis ends, m.
        to: SceneVector,
        /// Radius, m.
        radius: f64,
        /// Direction of the edge `s1 = 0` from the axis, of any length; its part along the axis does not count.
        start: SceneVector,
        /// Angle of the sector, counter-clockwise about the axis, rad.
        angle: f64,
    },
    /// Sector of a cone: `s1` around, `s2` along the axis. The normal points away from the axis.
    #[schemars(title = "ConeSectorSurface")]
    Cone {
        /// Where its axis begins, m.
        from: SceneVector,
        /// Where its axis ends, m.
        to: SceneVector,
        /// Radii at both ends of the axis, m.
        radii: [f64; 2],
        /// Direction of the edge `s1 = 0` from the axis, of any length; its part along the axis does not count.
        start: SceneVector,
        /// Angle of the sector, counter-clockwise about the axis, rad.
        angle: f64,
    },
    /// Sector of a sphere between two latitudes: `s1` around the axis, `s2` from the first latitude to the second. The normal points outwards.
    #[schemars(title = "SphereSectorSurface")]
    Sphere {
        /// Centre, m.
        center: SceneVector,
        /// Radius, m.
        radius: f64,
        /// Axis from the centre to the upper pole, of any length.
        axis: SceneVector,
        /// Direction of the edge `s1 = 0`, of any length; its part along the axis does not count.
        start: SceneVector,
        /// Latitudes from the equator, the second above the first, rad. Poles collapse an edge and are refused.
        latitudes: [f64; 2],
        /// Angle of the sector, counter-clockwise about the axis, rad.
        angle: f64,
    },
    /// Straight lines between two smooth curves: `s1` along the curves, `s2` from the first to the second.
    #[schemars(title = "RuledSurface")]
    Ruled {
        /// Points of both curves, m, at least two each: splines go through them, at even steps of `s1`.
        curves: [Vec<SceneVector>; 2],
    },
    /// Smooth surface through a grid of points.
    #[schemars(title = "PointsSurface")]
    Points {
        /// Points, m: a list for each of the even steps of `s1`, in each a point for each of those of `s2`; at least two of both.
        grid: Vec<Vec<SceneVector>>,
    },
}
