//! Surfaces of reduced bodies that deform: a page gets points, what modes move them by, and triangles once, and amplitudes in every frame. Where
//! files have stresses at these points it gets them by modes, and strains of modes in every frame.

use nalgebra::Vector3;

use super::numbers::{Numbers, list};
use super::recording::Recording;
use super::sheets::{EXPECTED, PAINTED};
use crate::elements::reduced::Interface;
use crate::picture::Skin;
use crate::scene::{BodyReference, Container, Scene};
use crate::system::von_mises;

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
    /// Stress at the points; none where the file has none.
    stress: Option<MovingStress>,
}

/// Stress of von Mises at the points of a surface.
pub(super) struct MovingStress {
    /// Modes that matter, by their places in the file, and their largest strains in a run.
    modes: Vec<(usize, f64)>,
}

impl MovingStress {
    /// Stress in a run, by so many modes at most: those first that have most. None of a file without stresses.
    pub fn of(recording: &Recording, body: usize, skin: &Skin<'_>, most: usize) -> Option<Self> {
        let strains = || recording.poses.iter().map(|poses| &poses[body].strains);
        let taken = strains().next().map_or(0, Vec::len);
        if !skin.has_stress() || taken == 0 {
            return None;
        }
        let largest = |mode: usize| strains().fold(0.0, |most: f64, of| most.max(of[mode].abs()));
        let stress = |mode: usize| {
            let points = 0..skin.points.len();
            let of_points = points.map(|point| von_mises(skin.stress(point, mode)));
            of_points.fold(0.0, f64::max)
        };
        let mut modes: Vec<(f64, usize, f64)> = (0..taken)
            .map(|mode| (mode, largest(mode)))
            .map(|(mode, strain)| (stress(mode) * strain, mode, strain))
            .collect();
        modes.sort_by(|a, b| b.0.total_cmp(&a.0));
        modes.truncate(most);
        let least = modes.first().map_or(0.0, |(most, ..)| UNSEEN * most);
        let seen = modes.into_iter().filter(|(stress, ..)| *stress > least);
        let modes = seen.map(|(_, mode, strain)| (mode, strain)).collect();
        Some(Self { modes })
    }

    /// Stress of von Mises at a point for the strains of a frame, Pa.
    pub fn at(&self, skin: &Skin<'_>, point: usize, strains: &[f64]) -> f64 {
        let mut sum = [0.0; 6];
        for (mode, _) in &self.modes {
            let by_mode = skin.stress(point, *mode);
            let parts = sum.iter_mut().zip(by_mode);
            parts.for_each(|(sum, part)| *sum += strains[*mode] * part);
        }
        von_mises(sum)
    }

    /// Stresses by modes at all points, `[points][6 modes]`, Pa, times the largest strains; strains in all frames, parts of these; largest
    /// stress of von Mises in the run, Pa.
    fn tables(
        &self,
        recording: &Recording,
        body: usize,
        skin: &Skin<'_>,
    ) -> ([Vec<Vec<f64>>; 2], f64) {
        let points = || 0..skin.points.len();
        let row = |point: usize| {
            let modes = self.modes.iter();
            let by_modes =
                modes.map(|(mode, strain)| skin.stress(point, *mode).map(|of| of * strain));
            by_modes.flatten().collect()
        };
        let strains = || recording.poses.iter().map(|poses| &poses[body].strains);
        let parts = |strains: &Vec<f64>| {
            let modes = self.modes.iter();
            modes
                .map(|(mode, strain)| strains[*mode] / strain)
                .collect()
        };
        let frames =
            strains().flat_map(|strains| points().map(|point| self.at(skin, point, strains)));
        let largest = frames.fold(0.0, f64::max);
        (
            [points().map(row).collect(), strains().map(parts).collect()],
            largest,
        )
    }
}

impl<'a> MovingSkin<'a> {
    /// The surface of a body; none where its file has none, and none of another body.
    pub fn of(recording: &Recording, body: usize, reference: BodyReference<'a>) -> Option<Self> {
        let (skin, container) = thinned(reference)?;
        let mut modes = seen_modes(recording, body, &skin);
        modes.truncate(MODES);
        modes.sort_unstable();
        Some(Self {
            stress: MovingStress::of(recording, body, &skin, MODES),
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
        let stress = self.stress_to_json(recording, numbers);
        format!(
            "\"skin\":{{\"points\":{places},\"modes\":{moved},\"amplitudes\":{amplitudes},\"triangles\":{corners},\"edges\":{edges}{stress}}}"
        )
    }

    /// Stress at the points as JSON; nothing where there is none.
    fn stress_to_json(&self, recording: &Recording, numbers: &mut Numbers) -> String {
        let stress = self.stress.as_ref();
        let Some(stress) = stress.filter(|stress| !stress.modes.is_empty()) else {
            return String::new();
        };
        let (tables, most) = stress.tables(recording, self.body, &self.skin);
        let [by_modes, strains] = tables.map(|rows| numbers.stepped(&rows));
        format!(",\"stress\":{{\"modes\":{by_modes},\"strains\":{strains},\"most\":{most:?}}}")
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
        let stress = if skin.has_stress() { modes } else { 0 };
        let points = skin.points.len() * 3 * 2 * (1 + modes + 2 * stress);
        let corners = skin.triangles.len() * 3 * CORNER;
        [points + corners, modes + stress]
    });
    let sheets = scene.bodies.iter().filter_map(|body| body.patch());
    let sheets = sheets.map(|body| {
        let grid = body.grid();
        let has_stress = grid.count() <= PAINTED && body.stiffness.is_none();
        let stress = if has_stress { EXPECTED } else { 0 };
        let points = grid.count() * 3 * 2 * (1 + EXPECTED + 2 * stress);
        let corners = grid.triangles().len() * 3 * CORNER;
        [points + corners, EXPECTED + stress]
    });
    let all = skins.chain(sheets);
    all.fold([0, 0], |[bytes, numbers], [own, of_frame]| {
        [bytes + own, numbers + of_frame]
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
    use crate::view::vtk::vtk;

    /// The strip of the book, clamped in axes of its own, which a force at its tip bends. Its modes are in closed form, and so is its surface:
    /// the last two points are the corners of its end.
    fn recording() -> Recording {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/book/examples/bodies");
        recorded(&beside(&folder))
    }

    fn recorded(files: &dyn Fn(&str) -> Result<Vec<u8>, String>) -> Recording {
        let scene = json!({"name": "strip", "dimension": 3,
            "bodies": [{"name": "strip", "element": "reduced", "file": "strip.safetensors", "damping_ratio": 0.05,
                "position": [0.3, -0.4, 0.8], "orientation": {"rotation_vector": [0.4, -0.3, 0.6]},
                "markers": {"root": "root", "tip": "tip"}, "gauges": {"root": "root"}}],
            "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "strip.root"]}],
            "loads": [{"name": "pull", "kind": "force", "marker": "strip.tip", "value": [0, 0, 1]}],
            "outputs": [{"kind": "position", "marker": "strip.tip"}, {"kind": "stress_tensor", "gauge": "strip.root"}],
            "experiment": {"stop_time": 0.1, "step": 0.005}});
        let scene = Scene::from_json_with(&scene.to_string(), files);
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
            let tip = Vector3::from_column_slice(&row[..3]);
            // The strip keeps its length, what modes move does not: w^2 / L about.
            let moved = (tip - Vector3::from_column_slice(&recording.rows[0][..3])).norm();
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

    /// The file of the strip with the stress of its gauge at every point of its surface, twice as large at every other point.
    fn with_stress(_: &str) -> Result<Vec<u8>, String> {
        let bytes = include_bytes!("../../docs/book/examples/bodies/strip.safetensors");
        let length = u64::from_le_bytes(std::array::from_fn(|k| bytes[k])) as usize;
        let mut header: Value = serde_json::from_slice(&bytes[8..8 + length]).expect("JSON");
        let mut data = bytes[8 + length..].to_vec();
        let gauge = &header["stress.root"]["data_offsets"][0];
        let first = gauge.as_u64().expect("a place") as usize;
        let (numbers, _) = bytes[8 + length + first..].as_chunks::<8>();
        let begin = data.len();
        for point in 0..18 {
            for number in &numbers[..36] {
                let stress = f64::from_le_bytes(*number) * f64::from(1 + point % 2);
                data.extend((stress as f32).to_le_bytes());
            }
        }
        let place =
            json!({"dtype": "F32", "shape": [18, 6, 6], "data_offsets": [begin, data.len()]});
        header["surface.stress"] = place;
        let header = header.to_string().into_bytes();
        Ok([&(header.len() as u64).to_le_bytes()[..], &header, &data].concat())
    }

    /// Stresses on a surface are those that outputs read, with strains of second order.
    #[test]
    fn stresses_on_surfaces_are_those_of_gauges() {
        let recording = recorded(&with_stress);
        let surface = &surfaces(&recording)[0];
        let body = recording.scene.bodies[0].reduced().expect("a reduced body");
        let skin = Skin::whole(body.contained()).expect("a surface");
        let mut most: f64 = 0.0;
        for (stresses, row) in surface.stresses.iter().zip(&recording.rows) {
            let read = row[9];
            most = most.max(read);
            for (point, stress) in stresses.iter().enumerate() {
                let wanted = read * (1 + skin.points[point] % 2) as f64;
                assert!(
                    (stress - wanted).abs() < 2e-3 * wanted + 1.0,
                    "{stress} {wanted}"
                );
            }
        }
        assert!(most > 1e6, "{most}");
        let (header, _) = header(&recording);
        let header: Value = serde_json::from_str(&header).expect("JSON");
        let stress = &header["bodies"][0]["skin"]["stress"];
        let told = stress["most"].as_f64().expect("a number");
        assert!((told - 2.0 * most).abs() < 4e-3 * most, "{told} {most}");
        let width = |key: &str| {
            let track = stress[key].as_u64().expect("a track") as usize;
            header["tracks"][track]["width"].as_u64().expect("a number")
        };
        assert_eq!(width("modes"), 6 * width("strains"));
        let frames = vtk(&recording).map(|(_, text)| text);
        let with_stress = frames.filter(|text| text.contains("Name=\"von_mises_stress\""));
        assert_eq!(with_stress.count(), recording.rows.len());
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
