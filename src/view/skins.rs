//! Surfaces of reduced bodies that deform: a page gets points, what modes move them by, and triangles once, and amplitudes in every frame.

use nalgebra::Vector3;

use super::numbers::{Numbers, list};
use super::recording::Recording;
use super::sheets::{EXPECTED, grid_of};
use crate::elements::reduced::Interface;
use crate::picture::Skin;
use crate::scene::{BodyReference, Container, Scene};

/// Most points of a surface in a page, and most of its modes.
const POINTS: usize = 1000;
const MODES: usize = 12;
/// Part of the largest displacement by any mode in a run below which a mode is not seen.
const UNSEEN: f64 = 1e-3;
/// Bytes of a corner of a triangle in a page, about.
const CORNER: usize = 4;

/// The surface of a reduced body in a page.
pub(super) struct MovingSkin<'a> {
    skin: Skin<'a>,
    container: &'a Container,
    body: usize,
    /// Modes that are seen, by their places in the file.
    modes: Vec<usize>,
}

impl<'a> MovingSkin<'a> {
    /// The surface of a body; none where its file has none, and none of another body.
    pub fn of(recording: &Recording, body: usize, reference: BodyReference<'a>) -> Option<Self> {
        let (skin, container) = thinned(reference)?;
        let mut modes = seen_modes(recording, body, &skin);
        modes.truncate(MODES);
        modes.sort_unstable();
        Some(Self {
            skin,
            container,
            body,
            modes,
        })
    }

    /// The surface as JSON, and its numbers.
    pub fn to_json(&self, recording: &Recording, numbers: &mut Numbers) -> String {
        let points = 0..self.skin.points.len();
        let places: Vec<Vec<f64>> = (points.clone())
            .map(|point| self.skin.place(point).iter().copied().collect())
            .collect();
        let moved = |point: usize| {
            let modes = self.modes.iter();
            let ways = modes.map(|mode| <[f64; 3]>::from(self.skin.mode(point, *mode)));
            ways.flatten().collect()
        };
        let moved: Vec<Vec<f64>> = points.map(moved).collect();
        let poses = recording.poses.iter().map(|poses| &poses[self.body]);
        let row = |amplitudes: &[f64]| self.modes.iter().map(|mode| amplitudes[*mode]).collect();
        let amplitudes: Vec<Vec<f64>> = poses.map(|pose| row(&pose.amplitudes)).collect();
        let tracks = [places, moved, amplitudes].map(|rows| numbers.stepped(&rows));
        let [places, moved, amplitudes] = tracks;
        let corners = list(self.skin.triangles.iter().flatten(), ToString::to_string);
        let edges = list(self.skin.edges(None).iter().flatten(), ToString::to_string);
        format!(
            "\"skin\":{{\"points\":{places},\"modes\":{moved},\"amplitudes\":{amplitudes},\"triangles\":{corners},\"edges\":{edges}}}"
        )
    }

    /// Displacement and rotation of an interface by amplitudes, as JSON: three numbers for each mode that is seen.
    pub fn interface_to_json(&self, interface: &Interface) -> String {
        let turned = |ways: &[Vector3<f64>]| {
            let ways = self
                .modes
                .iter()
                .map(|mode| self.container.axes * ways[*mode]);
            format!("{:?}", ways.flat_map(<[f64; 3]>::from).collect::<Vec<_>>())
        };
        let rotation = interface.rotation.as_deref().map(turned);
        let rotation = rotation.map_or(String::new(), |ways| format!(",\"rotation\":{ways}"));
        format!(",\"modes\":{}{rotation}", turned(&interface.modes))
    }

    /// Largest distance of a point from the origin of the file's axes, m.
    pub fn reach(&self) -> f64 {
        let points = 0..self.skin.points.len();
        let far = points.map(|point| self.skin.place(point).norm());
        far.fold(0.0, f64::max)
    }
}

/// The surface of a reduced body with as many points as a page takes.
fn thinned(reference: BodyReference<'_>) -> Option<(Skin<'_>, &Container)> {
    let BodyReference::Reduced(reduced) = reference else {
        return None;
    };
    let container = reduced.body.contained();
    Some((Skin::thinned(container, POINTS)?, container))
}

/// Bytes that surfaces of reduced bodies, plates and shells take in a page, at most, and numbers of theirs in every frame.
pub(super) fn size(scene: &Scene) -> [usize; 2] {
    let resolved = scene.resolved();
    let skins = resolved.bodies.iter().filter_map(|body| thinned(*body));
    let skins = skins.map(|(skin, container)| {
        let modes = container.model.modes().min(MODES);
        [skin.points.len(), skin.triangles.len(), modes]
    });
    let sheets = scene.bodies.iter().filter_map(|body| body.patch());
    let sheets = sheets.map(|body| {
        let grid = grid_of(body);
        [grid.count(), grid.triangles().len(), EXPECTED]
    });
    skins
        .chain(sheets)
        .fold([0, 0], |[bytes, numbers], [points, triangles, modes]| {
            let points = points * 3 * 2 * (1 + modes);
            [bytes + points + triangles * 3 * CORNER, numbers + modes]
        })
}

/// Modes of a body that are seen in a run, the one that moves its surface most first.
pub(super) fn seen_modes(recording: &Recording, body: usize, skin: &Skin<'_>) -> Vec<usize> {
    let poses = || recording.poses.iter().map(|poses| &poses[body].amplitudes);
    let moved = |mode: usize| {
        let points = 0..skin.points.len();
        let shape = points.map(|point| skin.mode(point, mode).norm());
        let amplitude = poses().map(|amplitudes| amplitudes[mode].abs());
        shape.fold(0.0, f64::max) * amplitude.fold(0.0, f64::max)
    };
    let taken = poses().next().map_or(0, Vec::len);
    let mut modes: Vec<(f64, usize)> = (0..taken).map(|mode| (moved(mode), mode)).collect();
    modes.sort_by(|a, b| b.0.total_cmp(&a.0));
    let least = modes.first().map_or(0.0, |(most, _)| UNSEEN * most);
    let seen = modes.into_iter().filter(|(moved, _)| *moved > least);
    seen.map(|(_, mode)| mode).collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use serde_json::{Value, json};

    use super::*;
    use crate::scene::beside;
    use crate::view::gltf::gltf;
    use crate::view::header::header;
    use crate::view::recording::Limits;
    use crate::view::surface::surfaces;

    /// The strip of the book, clamped in axes of its own, which a force at its tip bends. Its modes are in closed form, and so is its surface:
    /// the last two points are the corners of its end.
    fn recording() -> Recording {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/book/examples/bodies");
        let scene = json!({"name": "strip", "dimension": 3,
            "bodies": [{"name": "strip", "element": "reduced", "file": "strip.safetensors", "damping_ratio": 0.05,
                "position": [0.3, -0.4, 0.8], "orientation": {"rotation_vector": [0.4, -0.3, 0.6]},
                "markers": {"root": "root", "tip": "tip"}}],
            "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "strip.root"]}],
            "loads": [{"name": "pull", "kind": "force", "marker": "strip.tip", "value": [0, 0, 1]}],
            "outputs": [{"kind": "position", "marker": "strip.tip"}],
            "experiment": {"stop_time": 0.1, "step": 0.005}});
        let scene = Scene::from_json_with(&scene.to_string(), &beside(&folder));
        let scene = scene.expect("a valid scene");
        Recording::new(&scene, None, &Limits::PAGE, &mut |_, _| ()).expect("a run")
    }

    #[test]
    fn surfaces_deform_as_markers_move() {
        let recording = recording();
        let surface = &surfaces(&recording)[0];
        assert_eq!([surface.points.len(), surface.faces.len()], [18, 16]);
        let mut most: f64 = 0.0;
        for (frame, row) in recording.rows.iter().enumerate() {
            let place = surface.places(&recording, frame)[0];
            let corner = |point: usize| place.at(&surface.local(point, &recording, frame));
            let end = (corner(16) + corner(17)) * 0.5;
            let tip = Vector3::from_column_slice(row);
            // The strip keeps its length, what modes move does not: w^2 / L about.
            let moved = (tip - Vector3::from_column_slice(&recording.rows[0])).norm();
            assert!((end - tip).norm() < 1e-6 + 2.0 * moved * moved, "{frame}");
            most = most.max(moved);
        }
        assert!(most > 2e-3, "{most}");
    }

    #[test]
    fn pages_hold_the_surface_and_amplitudes_of_what_is_seen() {
        let recording = recording();
        let (header, _) = header(&recording);
        let header: Value = serde_json::from_str(&header).expect("JSON");
        let skin = &header["bodies"][0]["skin"];
        let track = |key: &str| {
            let track = &header["tracks"][skin[key].as_u64().expect("a track") as usize];
            ["rows", "width"].map(|key| track[key].as_u64().expect("a number"))
        };
        let [frames, modes] = track("amplitudes");
        assert_eq!(frames, 21);
        assert!((1..=6).contains(&modes));
        assert_eq!(
            [track("points"), track("modes")],
            [[18, 3], [18, 3 * modes]]
        );
        let count = |of: &Value| of.as_array().map(Vec::len);
        assert_eq!(count(&skin["triangles"]), Some(48));
        assert_eq!(count(&skin["edges"]), Some(36));
        for marker in header["markers"].as_array().expect("markers") {
            let ways = [&marker["modes"], &marker["rotation"]].map(count);
            assert_eq!(ways, [Some(3 * modes as usize); 2]);
        }
    }

    /// Morph targets and weights in every frame, one for each mode that is seen.
    #[test]
    fn gltf_has_modes_as_morph_targets() {
        let recording = recording();
        let file = gltf(&recording);
        let length = u32::from_le_bytes(std::array::from_fn(|k| file[12 + k]));
        let file: Value = serde_json::from_slice(&file[20..20 + length as usize]).expect("JSON");
        let targets = file["meshes"][0]["primitives"][0]["targets"].as_array();
        let targets = targets.map(Vec::len).expect("targets");
        let weights = file["meshes"][0]["weights"].as_array();
        assert_eq!(weights.map(Vec::len), Some(targets));
        let mut channels = file["animations"][0]["channels"]
            .as_array()
            .into_iter()
            .flatten();
        let weights = channels.find(|channel| channel["target"]["path"] == "weights");
        let sampler = weights.expect("weights")["sampler"]
            .as_u64()
            .expect("a number");
        let output = &file["animations"][0]["samplers"][sampler as usize]["output"];
        let accessor = &file["accessors"][output.as_u64().expect("a number") as usize];
        assert_eq!(accessor["count"], 21 * targets);
    }
}
