//! Plates and shells that deform: their motion in a run as few modes, found in the run. Pages and glTF then hold points, modes and triangles
//! once, and amplitudes in every frame, as of reduced bodies.

use nalgebra::Vector3;

use super::numbers::{Numbers, list};
use super::run_modes::{RunModes, at_point, by_points};
use crate::scene::PatchBody;
use crate::simulation::Pose;
use crate::system::von_mises;

/// Most modes of a run.
const MODES: usize = 40;
/// Distance of a point from where it is, relative to the largest displacement, that is not seen.
const UNSEEN: f64 = 1e-3;
/// Most points whose stress a page holds.
pub(super) const PAINTED: usize = 1000;
/// Modes that a page has room for, when its frames are counted.
pub(super) const EXPECTED: usize = 12;

/// The motion of a plate or shell in a run.
#[derive(Clone, Debug)]
pub(super) struct SheetModes {
    /// Points where the scene draws them, from the place of the body, m.
    pub points: Vec<Vector3<f64>>,
    /// Displacements of the points by each mode, m.
    pub modes: Vec<Vec<Vector3<f64>>>,
    /// Largest distance of a point from the place of the body, m.
    pub reach: f64,
    /// Stress; none where it is not known.
    stress: Option<SheetStress>,
}

/// Stress of a plate or shell in a run.
#[derive(Clone, Debug)]
struct SheetStress {
    /// Stress 11, 22 and 12 at the bottom and then at the top, Pa.
    modes: RunModes<6>,
    /// Largest stress of von Mises in the run, Pa.
    most: f64,
}

impl SheetStress {
    fn of(frames: &[&[[f64; 6]]]) -> Self {
        let all = frames.iter().flat_map(|points| points.iter());
        let most = all.map(largest_von_mises).fold(0.0, f64::max);
        let vectors = |points: &&[[f64; 6]]| points.iter().map(|of| (*of).into()).collect();
        let frames = frames.iter().map(vectors).collect();
        Self {
            modes: RunModes::of(frames, MODES, UNSEEN),
            most,
        }
    }

    /// Stress as JSON, and its numbers; nothing where there is none all along.
    fn to_json(&self, points: usize, numbers: &mut Numbers) -> String {
        if self.modes.modes.is_empty() || points > PAINTED {
            return String::new();
        }
        let tables = [
            by_points(&self.modes.modes, points),
            self.modes.amplitudes.clone(),
        ];
        let [modes, strains] = tables.map(|rows| numbers.stepped(&rows));
        let most = self.most;
        format!(
            ",\"stress\":{{\"modes\":{modes},\"strains\":{strains},\"most\":{most:?},\"hasFaces\":true}}"
        )
    }
}

/// The larger stress of von Mises of a bottom and a top, Pa.
pub(super) fn largest_von_mises(faces: &[f64; 6]) -> f64 {
    let of = |k: usize| von_mises([faces[k], faces[k + 1], 0.0, faces[k + 2], 0.0, 0.0]);
    f64::max(of(0), of(3))
}

impl SheetModes {
    /// Finds modes of a body, by its place among all, from how it is drawn and all frames of a run, and sets its amplitudes in them.
    pub fn of(drawn: &mut Pose, frames: &mut [Vec<Pose>], body: usize) -> Self {
        let place = Vector3::from(drawn.nodes[0][0]);
        let points: Vec<Vector3<f64>> = drawn
            .surface
            .iter()
            .map(|at| Vector3::from(*at) - place)
            .collect();
        let moved = |pose: &Pose| -> Vec<Vector3<f64>> {
            let now = pose.surface.iter().zip(&points);
            now.map(|(at, point)| Vector3::from(*at) - place - point)
                .collect()
        };
        let left = frames.iter().map(|poses| moved(&poses[body])).collect();
        let all = frames.iter().flat_map(|poses| &poses[body].surface);
        let reach = all.map(|at| (Vector3::from(*at) - place).norm());
        let reach = reach.fold(
            points.iter().map(Vector3::norm).fold(0.0, f64::max),
            f64::max,
        );
        let RunModes { modes, amplitudes } = RunModes::of(left, MODES, UNSEEN);
        drawn.amplitudes = vec![0.0; modes.len()];
        for (poses, amplitudes) in frames.iter_mut().zip(amplitudes) {
            poses[body].amplitudes = amplitudes;
        }
        Self {
            points,
            modes,
            reach,
            stress: None,
        }
    }

    /// With stress at its points in all frames, where it is known.
    pub fn with_stress(mut self, frames: &[&[[f64; 6]]]) -> Self {
        if frames
            .iter()
            .any(|points| points.len() == self.points.len())
        {
            self.stress = Some(SheetStress::of(frames));
        }
        self
    }

    /// The surface as JSON, and its numbers.
    pub fn to_json(
        &self,
        body: &PatchBody,
        frames: &[Vec<Pose>],
        place: usize,
        numbers: &mut Numbers,
    ) -> String {
        let grid = body.grid();
        let points: Vec<Vec<f64>> = self
            .points
            .iter()
            .map(|at| at.iter().copied().collect())
            .collect();
        let moved = by_points(&self.modes, points.len());
        let amplitudes: Vec<Vec<f64>> = frames
            .iter()
            .map(|poses| poses[place].amplitudes.clone())
            .collect();
        let [points, moved, amplitudes] =
            [points, moved, amplitudes].map(|rows| numbers.stepped(&rows));
        let stress = self.stress.as_ref();
        let stress = stress.map_or_else(String::new, |of| of.to_json(self.points.len(), numbers));
        let corners = list(grid.triangles().as_flattened(), ToString::to_string);
        let edges = list(grid.lines().as_flattened(), ToString::to_string);
        format!(
            "\"skin\":{{\"points\":{points},\"modes\":{moved},\"amplitudes\":{amplitudes},\"triangles\":{corners},\"edges\":{edges}{stress}}},\"radius\":{:?}",
            self.reach
        )
    }

    /// Place of a marker that is drawn at a point of the surface nearest to it, and how modes move it, as JSON.
    pub fn marker_to_json(&self, body: &PatchBody, at: [f64; 2]) -> String {
        let far = |place: [f64; 2]| (place[0] - at[0]).hypot(place[1] - at[1]);
        let places = body.grid().places().map(far).enumerate();
        let nearest = places
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map_or(0, |(point, _)| point);
        self.point_to_json(nearest)
    }

    /// Place of a point of the surface and how modes move it, as JSON.
    pub fn point_to_json(&self, point: usize) -> String {
        let at = <[f64; 3]>::from(self.points[point]);
        let modes = at_point(&self.modes, point);
        format!("\"point\":{at:?},\"modes\":{modes:?}")
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;
    use crate::scene::Scene;
    use crate::view::gltf::gltf;
    use crate::view::header::header;
    use crate::view::recording::{Limits, Recording};
    use crate::view::surface::surfaces;

    /// A soft sheet that spins and falls, held at an edge.
    fn recording() -> Recording {
        let scene = json!({"name": "flag", "dimension": 3, "gravity": [0, 0, -9.81],
            "bodies": [{"name": "flag", "element": "plate", "mesh": [3, 2],
                "surface": {"rectangle": {"corner": [0.3, 0, 0], "edges": [[1, 0, 0], [0, 0.5, 0]]}},
                "material": {"youngs_modulus": 1e6, "poisson_ratio": 0.3, "density": 1000, "damping_time": 1e-3}, "thickness": 0.01,
                "markers": {"tip": [1, 1], "mast": [0, 0]}}],
            "joints": [{"name": "mast", "kind": "pinned", "edges": ["ground", "flag.s1=0"]}],
            "outputs": [{"kind": "position", "marker": "flag.tip"}, {"kind": "surface_stress", "marker": "flag.tip"},
                {"kind": "surface_stress", "marker": "flag.mast"}],
            "experiment": {"stop_time": 0.3, "step": 0.01}});
        let scene = Scene::from_json(&scene.to_string()).expect("a valid scene");
        Recording::new(&scene, None, &Limits::PAGE, &mut |_, _| ()).expect("a run")
    }

    /// Few modes give every point of every frame back, the corner as the marker there is read.
    #[test]
    fn modes_of_a_run_are_its_motion() {
        let recording = recording();
        let sheet = recording.sheets[0].as_ref().expect("a sheet");
        assert!(
            (2..=20).contains(&sheet.modes.len()),
            "{}",
            sheet.modes.len()
        );
        let surface = &surfaces(&recording)[0];
        assert_eq!(
            [surface.points.len(), surface.faces.len()],
            [13 * 9, 12 * 8]
        );
        let mut most: f64 = 0.0;
        for (frame, row) in recording.rows.iter().enumerate() {
            let place = surface.places(&recording, frame)[0];
            let drawn = &recording.poses[frame][0].surface;
            let tip = Vector3::from_column_slice(&row[..3]);
            assert!((Vector3::from(drawn[drawn.len() - 1]) - tip).norm() < 1e-12);
            for (point, at) in drawn.iter().enumerate() {
                let found = place.at(&surface.local(point, &recording, frame));
                assert!((found - Vector3::from(*at)).norm() < 2e-3, "{frame}");
            }
            most = most.max((tip - Vector3::from_column_slice(&recording.rows[0][..3])).norm());
        }
        assert!(most > 0.1, "{most}");
    }

    /// Stress at points is what outputs read there, and modes of a page give it back.
    #[test]
    fn stress_at_points_is_that_of_outputs() {
        let recording = recording();
        let surface = &surfaces(&recording)[0];
        let stress = recording.sheets[0]
            .as_ref()
            .and_then(|of| of.stress.as_ref());
        let stress = stress.expect("a section whose stress is known");
        let mut most: f64 = 0.0;
        for (frame, row) in recording.rows.iter().enumerate() {
            let points = &recording.stresses[frame][0];
            // The corners of the grid, with their components at both faces and their stresses of von Mises.
            for (point, first) in [(points.len() - 1, 3), (0, 11)] {
                let own = points[point];
                let read = &row[first..first + 8];
                for (found, read) in own.iter().zip(read) {
                    assert!((found - read).abs() < 1e-9 * stress.most, "{found} {read}");
                }
                let told = surface.stresses[frame][point];
                assert!((told - read[6].max(read[7])).abs() < 1e-9 * stress.most);
                let modes = stress.modes.modes.iter();
                let amplitudes = &stress.modes.amplitudes[frame];
                for (k, own) in own.iter().enumerate() {
                    let parts = modes.clone().zip(amplitudes);
                    let sum: f64 = parts.map(|(mode, by)| mode[point][k] * by).sum();
                    assert!((sum - own).abs() < 4e-3 * stress.most, "{sum} {own}");
                }
            }
            most = surface.stresses[frame].iter().copied().fold(most, f64::max);
        }
        assert!(most == stress.most && most > 1e3, "{most}");
    }

    /// Pages and glTF hold the modes as those of a reduced body.
    #[test]
    fn pages_and_gltf_hold_sheets() {
        let recording = recording();
        let modes = recording.sheets[0].as_ref().map_or(0, |of| of.modes.len());
        let (header, _) = header(&recording);
        let header: Value = serde_json::from_str(&header).expect("JSON");
        let skin = &header["bodies"][0]["skin"];
        let width = |key: &str| {
            let track = &header["tracks"][skin[key].as_u64().expect("a track") as usize];
            track["width"].as_u64().expect("a number") as usize
        };
        assert_eq!([width("amplitudes"), width("modes")], [modes, 3 * modes]);
        let stress = &skin["stress"];
        assert_eq!(stress["hasFaces"], json!(true));
        let track = &header["tracks"][stress["modes"].as_u64().expect("a track") as usize];
        assert_eq!(track["rows"], json!(13 * 9));
        let marker = &header["markers"][0]["modes"];
        assert_eq!(marker.as_array().map(Vec::len), Some(3 * modes));
        let file = gltf(&recording);
        let length = u32::from_le_bytes(std::array::from_fn(|k| file[12 + k]));
        let file: Value = serde_json::from_slice(&file[20..20 + length as usize]).expect("JSON");
        let targets = file["meshes"][0]["primitives"][0]["targets"].as_array();
        assert_eq!(targets.map(Vec::len), Some(modes));
    }
}
