//! Plates and shells as described: geometry of their surfaces, and what their sections are.

mod grid;
mod map;
mod section;

use std::collections::BTreeMap;

use nalgebra::Vector3;

pub use grid::PatchGrid;
pub use map::SurfaceMap;

use super::description::{PatchBody, PatchMarker, PatchSurface};
use crate::bodies::PatchPoint;
use crate::elements::shell::Corner;
use crate::math::quadrature::GAUSS_3;

/// Parts of a surface along each coordinate over which lengths are integrated.
const PARTS: u32 = 8;

/// A plate or shell with the map of its surface.
#[derive(Clone, Debug)]
pub struct PatchGeometry<'a> {
    body: &'a PatchBody,
    map: SurfaceMap,
    /// Mean lengths of the lines along `s1` and `s2`, m.
    pub lengths: [f64; 2],
}

impl<'a> PatchGeometry<'a> {
    /// Geometry of a plate or shell.
    pub fn new(body: &'a PatchBody) -> Self {
        let map = SurfaceMap::new(&body.surface);
        let lengths = map.lengths();
        Self { body, map, lengths }
    }

    /// Position (m), its derivatives by lengths along `s1` and `s2`, and the mixed one (1/m), at `[s1, s2]`.
    pub fn corner(&self, at: [f64; 2]) -> Corner {
        let ([point, first, second, mixed], [a, b]) = (self.map.at(at), self.lengths);
        [point, first / a, second / b, mixed / (a * b)].map(Into::into)
    }

    /// Places `[s1, s2]` of the corners of the elements: `(n + 1) (m + 1)` of them, those along `s2` side by side.
    pub fn places(&self) -> impl Iterator<Item = [f64; 2]> + use<> {
        let [n, m] = self.body.mesh.counts;
        let place = |k: u32, of: u32| f64::from(k) / f64::from(of);
        (0..=n).flat_map(move |i| (0..=m).map(move |j| [place(i, n), place(j, m)]))
    }

    /// Corners of the elements.
    pub fn corners(&self) -> Vec<Corner> {
        self.places().map(|at| self.corner(at)).collect()
    }

    /// Places of the lines of the mesh along `s1` and `s2`, m from 0.
    pub fn lines(&self) -> [Vec<f64>; 2] {
        [0, 1].map(|k| {
            let (length, count) = (self.lengths[k], self.body.mesh.counts[k]);
            let place = |line: u32| length * f64::from(line) / f64::from(count);
            (0..=count).map(place).collect()
        })
    }

    /// A marker as a point or a pad; what of a pad is beyond the edges is cut off.
    pub fn point(&self, marker: &PatchMarker) -> PatchPoint {
        let (mut at, mut pad) = (marker.at(), marker.pad());
        for k in 0..2 {
            if pad[k] > 0.0 {
                let half = 0.5 * pad[k] / self.lengths[k];
                let (low, high) = ((at[k] - half).max(0.0), (at[k] + half).min(1.0));
                (at[k], pad[k]) = (0.5 * (low + high), (high - low) * self.lengths[k]);
            }
        }
        PatchPoint {
            at,
            pad,
            has_section: false,
        }
    }

    /// Where a marker is: a point, or the mean over a pad, m.
    pub fn position(&self, marker: &PatchMarker) -> [f64; 3] {
        let PatchPoint { at, pad, .. } = self.point(marker);
        let ends: [f64; 2] = std::array::from_fn(|k| pad[k] / self.lengths[k]);
        let mut mean = Vector3::zeros();
        for p in GAUSS_3 {
            for q in GAUSS_3 {
                let place = [
                    at[0] + (p.at - 0.5) * ends[0],
                    at[1] + (q.at - 0.5) * ends[1],
                ];
                mean += self.map.at(place)[0] * (p.weight * q.weight);
            }
        }
        mean.into()
    }

    /// Axes at a marker, unit vectors: along the lines along `s1`, across them in the surface, and its normal.
    pub fn axes(&self, marker: &PatchMarker) -> [Vector3<f64>; 3] {
        self.map.axes(self.point(marker).at)
    }

    /// Map of the surface.
    pub fn map(&self) -> &SurfaceMap {
        &self.map
    }
}

impl PatchBody {
    /// Geometry of the body.
    pub fn geometry(&self) -> PatchGeometry<'_> {
        PatchGeometry::new(self)
    }

    /// Number of elements.
    pub fn elements(&self) -> u64 {
        self.mesh.counts.map(u64::from).into_iter().product()
    }

    /// Index of a marker among those of the body, in alphabetical order.
    pub fn marker_index(&self, name: &str) -> Option<usize> {
        self.markers.keys().position(|of| of == name)
    }

    /// Marker by its index in alphabetical order.
    ///
    /// # Panics
    /// When there are not as many markers.
    pub fn marker_at(&self, index: usize) -> &PatchMarker {
        let markers: &BTreeMap<_, _> = &self.markers;
        let marker = markers.values().nth(index);
        marker.unwrap_or_else(|| unreachable!("an index of a marker is that of a marker"))
    }
}

impl PatchSurface {
    /// Word for the surface in texts.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Rectangle { .. } => "rectangle",
            Self::Quadrilateral { .. } => "quadrilateral",
            Self::Annulus { .. } => "annulus",
            Self::Cylinder { .. } => "cylinder",
            Self::Cone { .. } => "cone",
            Self::Sphere { .. } => "sphere",
            Self::Ruled { .. } => "ruled",
            Self::Points { .. } => "points",
        }
    }
}
