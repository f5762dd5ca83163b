//! The motion as glTF in one binary file (`.glb`). A rigid body is a mesh that its node moves, a reduced one has its modes as morph targets; of a cable, rod or beam every ring of points
//! is bound to a joint of its own, so that the surface is exact in every frame. Up is the y axis of glTF, in space our z.
//!
//! Source: The Khronos Group, glTF 2.0 Specification (2021): binary glTF (4.4), morph targets (3.7.2.2), skins (3.7.3), animations (3.11).

use super::numbers::{list, quoted};
use super::recording::Recording;
use super::surface::{BodySurface, PointWithAxes, surfaces};
use crate::math::rotation::quaternion;
use crate::picture::palette::{BODIES, linear};

/// Numbers of types of components and of targets in glTF.
const FLOAT: u32 = 5126;
const SHORT: u32 = 5123;
const INTEGER: u32 = 5125;
/// Part of the file that is written so far.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
    nodes: Vec<String>,
    meshes: Vec<String>,
    skins: Vec<String>,
    channels: Vec<String>,
    samplers: Vec<String>,
    /// Nodes below the one that turns our axes to those of glTF.
    turned: Vec<usize>,
    /// Nodes of meshes that joints alone move.
    bound: Vec<usize>,
}

/// The file.
pub fn gltf(recording: &Recording) -> Vec<u8> {
    let mut file = File::default();
    let times: Vec<f32> = recording.times.iter().map(|time| *time as f32).collect();
    let input = file.floats(&times, "SCALAR", 1);
    let surfaces = surfaces(recording);
    for (body, surface) in surfaces.iter().enumerate() {
        file.body(recording, surface, body, input);
    }
    file.finish(recording)
}

/// Type of the entries of an accessor.
struct AccessorType<'a> {
    /// Number of the format of a component.
    component: u32,
    /// How components make an entry, such as `VEC3`.
    shape: &'a str,
}

impl File {
    fn accessor(
        &mut self,
        kind: AccessorType<'_>,
        count: usize,
        bytes: &[u8],
        more: &str,
    ) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let (at, view) = (self.bytes.len(), self.views.len());
        self.bytes.extend_from_slice(bytes);
        self.views.push(format!(
            "{{\"buffer\":0,\"byteOffset\":{at},\"byteLength\":{}}}",
            bytes.len()
        ));
        self.accessors.push(format!(
            "{{\"bufferView\":{view},\"componentType\":{},\"type\":\"{}\",\"count\":{count}{more}}}",
            kind.component, kind.shape
        ));
        self.accessors.len() - 1
    }

    /// Singles, with the least and the largest value of every component.
    fn floats(&mut self, values: &[f32], kind: &str, width: usize) -> usize {
        let bytes: Vec<u8> = values
            .iter()
            .flat_map(|value| value.to_le_bytes())
            .collect();
        let ends = |fold: fn(f32, f32) -> f32, start: f32| {
            let column = |k: usize| {
                values
                    .iter()
                    .skip(k)
                    .step_by(width)
                    .copied()
                    .fold(start, fold)
            };
            list((0..width).map(column), |value| format!("{value:?}"))
        };
        let (low, high) = (
            ends(f32::min, f32::INFINITY),
            ends(f32::max, f32::NEG_INFINITY),
        );
        let more = format!(",\"min\":{low},\"max\":{high}");
        self.accessor(
            AccessorType {
                component: FLOAT,
                shape: kind,
            },
            values.len() / width,
            &bytes,
            &more,
        )
    }

    fn body(&mut self, recording: &Recording, surface: &BodySurface, body: usize, input: usize) {
        let frames: Vec<Vec<PointWithAxes>> = (0..recording.times.len())
            .map(|frame| surface.places(recording, frame))
            .collect();
        let count = frames[0].len();
        let first = self.nodes.len();
        for place in 0..count {
            self.place(&frames, place, input);
        }
        let is_rigid = count == 1;
        let mesh = self.mesh(surface, body, is_rigid);
        let name = quoted(&surface.name);
        if is_rigid {
            self.nodes
                .push(format!("{{\"name\":{name},\"mesh\":{mesh}}}"));
            let own = self.nodes.len() - 1;
            self.deform(recording, surface, body, [own, input]);
            // The mesh hangs on what moves.
            let mover = &mut self.nodes[first];
            *mover = mover.replacen('{', &format!("{{\"children\":[{own}],"), 1);
            self.turned.push(first);
            return;
        }
        let joints = list(first..first + count, |joint| joint.to_string());
        // Points are given along the axes of their joints already. That is what nothing said means, but not every reader takes it so.
        let unit: [f32; 16] = std::array::from_fn(|k| f32::from(u8::from(k % 5 == 0)));
        let bytes: Vec<u8> = unit.iter().flat_map(|value| value.to_le_bytes()).collect();
        let matrices = self.accessor(
            AccessorType {
                component: FLOAT,
                shape: "MAT4",
            },
            count,
            &bytes.repeat(count),
            "",
        );
        self.skins.push(format!(
            "{{\"joints\":{joints},\"inverseBindMatrices\":{matrices}}}"
        ));
        let skin = self.skins.len() - 1;
        self.turned.extend(first..first + count);
        self.bound.push(self.nodes.len());
        self.nodes.push(format!(
            "{{\"name\":{name},\"mesh\":{mesh},\"skin\":{skin}}}"
        ));
    }

    /// Amplitudes of modes as weights of the mesh of a node over times.
    fn deform(
        &mut self,
        recording: &Recording,
        surface: &BodySurface,
        body: usize,
        [node, input]: [usize; 2],
    ) {
        if surface.modes.is_empty() {
            return;
        }
        let frames = recording.poses.iter().map(|poses| &poses[body].amplitudes);
        let modes = |amplitudes: &Vec<f64>| -> Vec<f32> {
            let modes = surface.modes.iter();
            modes.map(|(mode, _)| amplitudes[*mode] as f32).collect()
        };
        let weights: Vec<f32> = frames.flat_map(modes).collect();
        let output = self.floats(&weights, "SCALAR", 1);
        self.channel([input, output], node, "weights");
    }

    /// A quantity of a node that follows an output over an input.
    fn channel(&mut self, [input, output]: [usize; 2], node: usize, path: &str) {
        let sampler = self.samplers.len();
        self.samplers.push(format!(
            "{{\"input\":{input},\"output\":{output},\"interpolation\":\"LINEAR\"}}"
        ));
        self.channels.push(format!(
            "{{\"sampler\":{sampler},\"target\":{{\"node\":{node},\"path\":\"{path}\"}}}}"
        ));
    }

    /// A node that goes and turns as a place does.
    fn place(&mut self, frames: &[Vec<PointWithAxes>], place: usize, input: usize) {
        let (mut ways, mut turns): (Vec<f32>, Vec<f32>) = (Vec::new(), Vec::new());
        let mut held = quaternion(&frames[0][place].axes);
        for places in frames {
            let placed = &places[place];
            held = placed.quaternion(&held);
            ways.extend(placed.point.iter().map(|x| *x as f32));
            let [w, x, y, z] = held;
            turns.extend([x, y, z, w].map(|part| part as f32));
        }
        let node = self.nodes.len();
        self.nodes.push(format!(
            "{{\"translation\":{:?},\"rotation\":{:?}}}",
            &ways[..3],
            &turns[..4]
        ));
        let outputs = [
            ("translation", self.floats(&ways, "VEC3", 3)),
            ("rotation", self.floats(&turns, "VEC4", 4)),
        ];
        for (path, output) in outputs {
            self.channel([input, output], node, path);
        }
    }

    fn mesh(&mut self, surface: &BodySurface, body: usize, is_rigid: bool) -> usize {
        let points: Vec<f32> = surface
            .points
            .iter()
            .flat_map(|(_, point)| point.map(|x| x as f32))
            .collect();
        let position = self.floats(&points, "VEC3", 3);
        let fans = surface
            .faces
            .iter()
            .flat_map(|face| (1..face.len() - 1).flat_map(|k| [face[0], face[k], face[k + 1]]));
        let corners: Vec<u32> = fans.map(|corner| corner as u32).collect();
        let bytes: Vec<u8> = corners
            .iter()
            .flat_map(|corner| corner.to_le_bytes())
            .collect();
        let indices = self.accessor(
            AccessorType {
                component: INTEGER,
                shape: "SCALAR",
            },
            corners.len(),
            &bytes,
            "",
        );
        let mut bound = String::new();
        if !is_rigid {
            let joints = surface
                .points
                .iter()
                .flat_map(|(place, _)| [*place as u16, 0, 0, 0]);
            let bytes: Vec<u8> = joints.flat_map(u16::to_le_bytes).collect();
            let joints = self.accessor(
                AccessorType {
                    component: SHORT,
                    shape: "VEC4",
                },
                surface.points.len(),
                &bytes,
                "",
            );
            let weights: Vec<f32> = surface
                .points
                .iter()
                .flat_map(|_| [1.0, 0.0, 0.0, 0.0])
                .collect();
            let weights = self.floats(&weights, "VEC4", 4);
            bound = format!(",\"JOINTS_0\":{joints},\"WEIGHTS_0\":{weights}");
        }
        let targets = self.targets(surface);
        // Zero is what nothing said means, but not every reader of motions takes it so.
        let still = list(&surface.modes, |_| "0.0".to_owned());
        let weights = if surface.modes.is_empty() {
            String::new()
        } else {
            format!(",\"weights\":{still}")
        };
        self.meshes.push(format!(
            "{{\"primitives\":[{{\"attributes\":{{\"POSITION\":{position}{bound}}},\"indices\":{indices},\"material\":{}{targets}}}]{weights}}}",
            body % BODIES.len()
        ));
        self.meshes.len() - 1
    }

    /// Displacements by modes, as morph targets.
    fn targets(&mut self, surface: &BodySurface) -> String {
        if surface.modes.is_empty() {
            return String::new();
        }
        let targets = list(&surface.modes, |(_, ways)| {
            let ways: Vec<f32> = ways.iter().flatten().map(|x| *x as f32).collect();
            format!("{{\"POSITION\":{}}}", self.floats(&ways, "VEC3", 3))
        });
        format!(",\"targets\":{targets}")
    }

    fn finish(mut self, recording: &Recording) -> Vec<u8> {
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let turn = match recording.scene.dimension {
            3 => format!(",\"rotation\":[{:?},0.0,0.0,{half:?}]", -half),
            _ => String::new(),
        };
        let children = list(&self.turned, ToString::to_string);
        let root = self.nodes.len();
        let scene = list(self.bound.iter().chain([&root]), ToString::to_string);
        self.nodes.push(format!(
            "{{\"name\":{},\"children\":{children}{turn}}}",
            quoted(&recording.scene.name)
        ));
        let materials = list(BODIES.map(linear), |[r, g, b]| {
            format!(
                "{{\"pbrMetallicRoughness\":{{\"baseColorFactor\":[{r:?},{g:?},{b:?},1.0],\"metallicFactor\":0.1,\"roughnessFactor\":0.6}},\
                 \"doubleSided\":true}}"
            )
        });
        let skins = if self.skins.is_empty() {
            String::new()
        } else {
            format!("\"skins\":[{}],", self.skins.join(","))
        };
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let json = format!(
            "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"Flexbody {}\"}},\"scene\":0,\"scenes\":[{{\"nodes\":{scene}}}],\"nodes\":[{}],\
             \"meshes\":[{}],{skins}\"materials\":{materials},\"animations\":[{{\"channels\":[{}],\"samplers\":[{}]}}],\
             \"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]}}",
            env!("CARGO_PKG_VERSION"),
            self.nodes.join(","),
            self.meshes.join(","),
            self.channels.join(","),
            self.samplers.join(","),
            self.accessors.join(","),
            self.views.join(","),
            self.bytes.len()
        );
        let mut json = json.into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let chunk = |kind: &[u8; 4], content: &[u8]| {
            let length = (content.len() as u32).to_le_bytes();
            [&length[..], kind, content].concat()
        };
        let chunks = [chunk(b"JSON", &json), chunk(b"BIN\0", &self.bytes)].concat();
        let whole = (12 + chunks.len() as u32).to_le_bytes();
        [b"glTF", &2_u32.to_le_bytes()[..], &whole, &chunks].concat()
    }
}
