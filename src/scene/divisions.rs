//! Numbers of elements of plates and shells that are one: edges that are joined have the same number, and so has a stiffener with its line.
//!
//! Directions of plates and shells are the nodes of a graph, joints between lines its edges. The directions that are connected, found as trees
//! of a forest (union-find), are a division. One number that is given decides for all of them. Where none is, the number is left to the
//! planner, and lines inside that joints hold say how few elements there may be.

use std::collections::BTreeMap;

use super::Scene;
use super::description::{Body, PatchMesh};
use super::joints::Joint;

/// Most elements of a plate or shell along a coordinate: factors of finer meshes take gigabytes.
pub const MOST_DIVISIONS: u32 = 200;
/// Part of an element by which a line that is held may be off one of the mesh.
pub(super) const OFF: f64 = 1e-6;

/// Directions of plates and shells that have one number of elements, some of it not said.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Division {
    /// Places among the bodies, with 0 for `s1` and 1 for `s2`.
    pub directions: Vec<(usize, usize)>,
    /// Places among the bodies of stiffeners along such directions.
    pub stiffeners: Vec<usize>,
    /// Number of elements; where the planner finds it, the fewest that lines which joints hold allow.
    pub count: u32,
    /// Whether the planner finds it.
    pub is_open: bool,
}

/// A line of a mesh as joints name it: the body, the coordinate that is constant, and its value.
struct NamedLine {
    body: usize,
    across: usize,
    value: f64,
}

/// Splits a place such as `s1=0.5` into the coordinate, 0 or 1, and its value.
pub(super) fn coordinate(place: &str) -> Option<(usize, f64)> {
    let (name, value) = place.split_once('=')?;
    let across = ["s1", "s2"].iter().position(|of| *of == name)?;
    let value: f64 = value.parse().ok()?;
    (0.0..=1.0).contains(&value).then_some((across, value))
}

/// Number of the mesh line at a coordinate in [0, 1] of so many elements, if there is one.
pub(super) fn line_at(value: f64, count: u32) -> Option<u32> {
    let at = value * f64::from(count);
    let line = at.round();
    ((line - at).abs() <= OFF).then_some(line as u32)
}

/// Multiples of a number of elements, up to the most.
pub(super) fn multiples(count: u32) -> impl Iterator<Item = u32> {
    (1..)
        .map(move |times| times * count)
        .take_while(|count| *count <= MOST_DIVISIONS)
}

/// Fewest elements with mesh lines at these coordinates. Those that no number has are left out.
fn fewest(values: &[f64]) -> u32 {
    values.iter().fold(1, |count, value| {
        let mut finer = multiples(count);
        finer
            .find(|count| line_at(*value, *count).is_some())
            .unwrap_or(count)
    })
}

/// A forest over directions of plates and shells: each points to another one of its tree, roots to themselves.
struct Forest(Vec<usize>);

impl Forest {
    fn root(&self, mut of: usize) -> usize {
        while self.0[of] != of {
            of = self.0[of];
        }
        of
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        // The first one is the root, so that divisions are in the order of the bodies.
        self.0[a.max(b)] = a.min(b);
    }
}

/// Directions that joints connect, and what else joints say of them.
struct Connections {
    forest: Forest,
    /// Lines that are held: directions along which they set nodes, with their coordinates.
    held: Vec<(usize, f64)>,
    /// Directions of the lines of stiffeners, with places of these among the bodies.
    stiffened: Vec<(usize, usize)>,
}

impl Scene {
    /// Gives directions of plates and shells whose numbers of elements are not said those of what they are joined with, or the fewest that
    /// joints allow. They stay open to the planner.
    pub(super) fn divide_open_meshes(&mut self) {
        for division in self.divisions() {
            for (body, along) in division.directions {
                if let Some(mesh) = self.mesh_mut(body)
                    && mesh.is_open[along]
                {
                    mesh.counts[along] = division.count;
                }
            }
        }
    }

    /// Gives numbers of elements to the divisions that are open, in the order of [`Scene::divisions`]; those of what is given to all others.
    pub fn divide(&mut self, counts: impl IntoIterator<Item = u32>) {
        let mut counts = counts.into_iter();
        for division in self.divisions() {
            let found = if division.is_open {
                counts.next()
            } else {
                None
            };
            let count = found.unwrap_or(division.count);
            for (body, along) in division.directions {
                if let Some(mesh) = self.mesh_mut(body)
                    && mesh.is_open[along]
                {
                    (mesh.counts[along], mesh.is_open[along]) = (count, false);
                }
            }
            for body in division.stiffeners {
                if let Some(line) = self.bodies[body].cable_mut() {
                    line.elements.get_or_insert(count);
                }
            }
        }
    }

    /// Directions with one number of elements that is not said everywhere, in the order of the first of each.
    pub fn divisions(&self) -> Vec<Division> {
        let open = |body: &Body| body.patch().is_some_and(|of| of.mesh.is_open != [false; 2]);
        let is_line_open = |body: &Body| body.cable().is_some_and(|line| line.elements.is_none());
        let has_patch = self.bodies.iter().any(|body| body.patch().is_some());
        if !has_patch || !(self.bodies.iter().any(open) || self.bodies.iter().any(is_line_open)) {
            return Vec::new();
        }
        let mut connections = Connections {
            forest: Forest((0..2 * self.bodies.len()).collect()),
            held: Vec::new(),
            stiffened: Vec::new(),
        };
        for joint in &self.joints {
            self.connect(joint, &mut connections);
        }
        let Connections {
            forest,
            held,
            stiffened,
        } = connections;
        let mut trees: BTreeMap<usize, Vec<(usize, usize)>> = BTreeMap::new();
        for (body, of) in self.bodies.iter().enumerate() {
            for along in (0..2).filter(|_| of.patch().is_some()) {
                let tree = trees.entry(forest.root(2 * body + along)).or_default();
                tree.push((body, along));
            }
        }
        let of_tree = |root: usize, (direction, value): &(usize, f64)| {
            (forest.root(*direction) == root).then_some(*value)
        };
        let divisions = trees.into_iter().map(|(root, directions)| {
            let lines: Vec<f64> = held.iter().filter_map(|of| of_tree(root, of)).collect();
            let own = stiffened.iter();
            let own = own.filter(|(direction, _)| forest.root(*direction) == root);
            let stiffeners: Vec<usize> = own.map(|(_, body)| *body).collect();
            let given = self.given(&directions, &stiffeners);
            Division {
                directions,
                stiffeners,
                count: given.unwrap_or_else(|| fewest(&lines)),
                is_open: given.is_none(),
            }
        });
        divisions.filter(|of| self.leaves_open(of)).collect()
    }

    /// Joins the directions of the lines of a joint.
    fn connect(&self, joint: &Joint, to: &mut Connections) {
        if joint.kind.edge().is_none() {
            return;
        }
        let names = joint.kind.markers();
        let lines = [0, 1].map(|end| self.named_line(&names[end]));
        for line in lines.iter().flatten() {
            to.held.push((2 * line.body + line.across, line.value));
        }
        let along = |line: &NamedLine| 2 * line.body + 1 - line.across;
        match &lines {
            [Some(first), Some(second)] => to.forest.join(along(first), along(second)),
            [None, Some(line)] => {
                let is_stiffener = |body: &Body| body.cable().is_some_and(|of| of.name == names[0]);
                if let Some(body) = self.bodies.iter().position(is_stiffener) {
                    to.stiffened.push((along(line), body));
                }
            }
            _ => {}
        }
    }

    /// A line of a plate or shell by its name, `body.s1=0.5`.
    fn named_line(&self, text: &str) -> Option<NamedLine> {
        let (name, place) = text.split_once('.')?;
        let (across, value) = coordinate(place)?;
        let is_meant = |body: &Body| body.patch().is_some_and(|patch| patch.name == name);
        let body = self.bodies.iter().position(is_meant)?;
        Some(NamedLine {
            body,
            across,
            value,
        })
    }

    /// The number of elements that is given for one of these directions or stiffeners. Those out of range are refused where they are.
    fn given(&self, directions: &[(usize, usize)], stiffeners: &[usize]) -> Option<u32> {
        let of_patches = directions.iter().filter_map(|(body, along)| {
            let mesh = &self.bodies[*body].patch()?.mesh;
            (!mesh.is_open[*along]).then_some(mesh.counts[*along])
        });
        let lines = stiffeners.iter();
        let of_lines = lines.filter_map(|body| self.bodies[*body].cable()?.elements);
        let mut all = of_patches.chain(of_lines);
        all.find(|count| (1..=MOST_DIVISIONS).contains(count))
    }

    /// Whether something of a division is not said.
    fn leaves_open(&self, division: &Division) -> bool {
        let mut directions = division.directions.iter();
        let mut stiffeners = division.stiffeners.iter();
        directions.any(|(body, along)| {
            let patch = self.bodies[*body].patch();
            patch.is_some_and(|patch| patch.mesh.is_open[*along])
        }) || stiffeners.any(|body| {
            let line = self.bodies[*body].cable();
            line.is_some_and(|line| line.elements.is_none())
        })
    }

    fn mesh_mut(&mut self, body: usize) -> Option<&mut PatchMesh> {
        Some(&mut self.bodies[body].patch_mut()?.mesh)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value as Json, json};

    /// A square plate from here on along x.
    fn plate(name: &str, x: f64, mesh: Json) -> Json {
        json!({"name": name, "element": "plate", "mesh": mesh, "thickness": 0.01,
            "surface": {"rectangle": {"corner": [x, 0, 0], "edges": [[1, 0, 0], [0, 1, 0]]}},
            "material": {"youngs_modulus": 1e9, "poisson_ratio": 0.3, "density": 1000}})
    }

    /// A rod over the end of the first plate.
    fn rib(elements: Json, markers: Json) -> Json {
        json!({"name": "rib", "element": "rod", "elements": elements, "markers": markers,
            "material": {"youngs_modulus": 1e9, "shear_modulus": 4e8, "density": 1000},
            "section": {"area": 1e-4, "second_moments": [1e-9, 1e-9], "torsion_constant": 2e-9},
            "shape": {"line": {"from": [1, 0, 0], "to": [1, 1, 0]}}})
    }

    /// A scene of bodies that joints of these kinds and edges hold.
    fn scene(
        bodies: Vec<Json>,
        joints: &[(&str, [&str; 2])],
    ) -> Result<Scene, crate::scene::Error> {
        let joints = joints.iter().enumerate().map(
            |(k, (kind, edges))| json!({"name": format!("j{k}"), "kind": kind, "edges": edges}),
        );
        let scene = json!({"name": "divided", "dimension": 3, "bodies": bodies, "joints": joints.collect::<Vec<_>>(),
            "accuracy": {"relative_tolerance": 1e-6}});
        Scene::from_json(&scene.to_string())
    }

    fn found(bodies: Vec<Json>, joints: &[(&str, [&str; 2])]) -> Scene {
        scene(bodies, joints).expect("a valid scene")
    }

    fn counts(scene: &Scene) -> Vec<[u32; 2]> {
        let patches = scene.bodies.iter().filter_map(Body::patch);
        patches.map(|patch| patch.mesh.counts).collect()
    }

    const AUTO: &str = "auto";

    /// Two plates side by side have three numbers: one along each of their own directions and one along their common edge.
    #[test]
    fn joined_edges_have_one_number_of_elements() {
        let bodies = || vec![plate("a", 0.0, json!(AUTO)), plate("b", 1.0, json!(AUTO))];
        let joined = [("smooth", ["a.s1=1", "b.s1=0"])];
        let apart = found(bodies(), &[]);
        assert_eq!(apart.divisions().len(), 4);
        let mut scene = found(bodies(), &joined);
        let directions: Vec<_> = (scene.divisions().into_iter())
            .map(|of| of.directions)
            .collect();
        assert_eq!(
            directions,
            [vec![(0, 0)], vec![(0, 1), (1, 1)], vec![(1, 0)]]
        );
        scene.divide([3, 4, 5]);
        assert_eq!(counts(&scene), [[3, 4], [5, 4]]);
        assert_eq!(
            (scene.divisions(), scene.is_to_be_planned()),
            (vec![], false)
        );
    }

    /// A chain of three plates, the last of them across, and a number in its middle.
    #[test]
    fn a_number_that_is_given_decides_for_all() {
        let across = json!({"name": "c", "element": "plate", "thickness": 0.01,
            "surface": {"rectangle": {"corner": [2, 0, 0], "edges": [[0, 1, 0], [-0.0, 0, 1]]}},
            "material": {"youngs_modulus": 1e9, "poisson_ratio": 0.3, "density": 1000}});
        let bodies = vec![
            plate("a", 0.0, json!(AUTO)),
            plate("b", 1.0, json!([AUTO, 6])),
            across,
            rib(json!(AUTO), json!({})),
        ];
        let joints = [
            ("smooth", ["a.s1=1", "b.s1=0"]),
            ("clamped", ["c.s2=0", "b.s1=1"]),
            ("clamped", ["rib", "a.s1=1"]),
        ];
        let mut scene = found(bodies, &joints);
        assert_eq!(counts(&scene), [[1, 6], [1, 6], [6, 1]]);
        let open: Vec<_> = { scene.divisions().into_iter() }
            .map(|division| division.is_open)
            .collect();
        assert_eq!(open, [true, false, true, true]);
        scene.divide([2, 3, 4]);
        assert_eq!(counts(&scene), [[2, 6], [3, 6], [6, 4]]);
        let rib = scene.bodies[3].cable().and_then(|line| line.elements);
        assert_eq!(rib, Some(6));
    }

    #[test]
    fn a_stiffener_with_a_number_decides_for_its_line() {
        let with = |elements: Json, mesh: Json| {
            let bodies = vec![plate("a", 0.0, mesh), rib(elements, json!({}))];
            scene(bodies, &[("clamped", ["rib", "a.s1=1"])])
        };
        let scene = with(json!(7), json!(AUTO)).expect("a valid scene");
        assert_eq!(counts(&scene), [[1, 7]]);
        let error = with(json!(7), json!([1, 4])).expect_err("two numbers");
        assert_eq!(error.path, "joints[0].edges[0]");
    }

    /// Markers of rods are nodes: a third asks for three elements or multiples, and no number up to 200 has a node at 0.1234.
    #[test]
    fn nodes_of_stiffeners_are_those_of_some_mesh() {
        let with = |at: f64, mesh: Json| {
            let bodies = vec![plate("a", 0.0, mesh), rib(json!(AUTO), json!({"m": at}))];
            scene(bodies, &[("clamped", ["rib", "a.s1=1"])])
        };
        assert!(with(1.0 / 3.0, json!(AUTO)).is_ok());
        assert!(with(1.0 / 3.0, json!([1, 6])).is_ok());
        for (at, mesh, wanted) in [
            (
                0.1234,
                json!(AUTO),
                "nodes of up to 200 elements of equal lengths",
            ),
            (1.0 / 3.0, json!([1, 4]), "nodes are those of a.s1=1"),
        ] {
            let error = with(at, mesh).expect_err("no such nodes");
            assert_eq!(error.path, "joints[0].edges[0]");
            assert!(error.message.contains(wanted), "{error}");
        }
    }

    /// Least common multiples: lines at halves and thirds need six elements, and three quarters twelve.
    #[test]
    fn lines_that_are_held_set_the_fewest_elements() {
        for (at, wanted) in [
            (vec![0.5], 2),
            (vec![0.5, 1.0 / 3.0], 6),
            (vec![0.5, 0.33333333333, 0.75], 12),
            (vec![0.0, 1.0], 1),
            (vec![0.005], 200),
        ] {
            let names: Vec<String> = at.iter().map(|at| format!("a.s1={at}")).collect();
            let joints: Vec<_> = (names.iter())
                .map(|name| ("pinned", ["ground", name.as_str()]))
                .collect();
            let scene = found(vec![plate("a", 0.0, json!(AUTO))], &joints);
            assert_eq!(counts(&scene), [[wanted, 1]], "{at:?}");
        }
    }

    /// No number up to 200 has a line at 0.1234, none has both 1/199 and 1/197, and the number that is given has none at 0.3.
    #[test]
    fn lines_that_no_mesh_has_are_refused_where_they_are() {
        let bodies = || {
            vec![
                plate("a", 0.0, json!(AUTO)),
                plate("b", 1.0, json!([AUTO, 4])),
            ]
        };
        for (joints, path, wanted) in [
            (
                vec![("pinned", ["ground", "a.s1=0.1234"])],
                "joints[0].edges[1]",
                "a line that up to 200 elements",
            ),
            (
                vec![
                    ("pinned", ["ground", "a.s1=0.005025125628"]),
                    ("pinned", ["ground", "a.s1=0.005076142132"]),
                ],
                "joints[1].edges[1]",
                "199 x 1 elements",
            ),
            (
                vec![
                    ("smooth", ["a.s1=1", "b.s1=0"]),
                    ("pinned", ["ground", "a.s2=0.3"]),
                ],
                "joints[1].edges[1]",
                "1 x 4 elements",
            ),
        ] {
            let error = scene(bodies(), &joints).expect_err("a line of no mesh");
            assert_eq!(error.path, path);
            assert!(error.message.contains(wanted), "{error}");
        }
    }

    /// Numbers that are left open stay open when a scene is written and read.
    #[test]
    fn scenes_are_read_as_they_are_written() {
        for mesh in [
            json!(AUTO),
            json!([3, AUTO]),
            json!([AUTO, AUTO]),
            json!([3, 4]),
        ] {
            let scene = found(
                vec![plate("a", 0.0, mesh.clone())],
                &[("pinned", ["ground", "a.s2=0.5"])],
            );
            assert_eq!(Scene::from_json(&scene.to_json()), Ok(scene), "{mesh}");
        }
    }
}
