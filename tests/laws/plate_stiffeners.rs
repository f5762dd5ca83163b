//! Stiffeners: cables, rods and beams along mesh lines of plates and shells.

use std::f64::consts::PI;

use serde_json::{Value, json};

use super::runs::Run;

/// Thickness (m) and Young's modulus (Pa) of plates with D = 1 and Poisson's ratio 0.
const THICKNESS: f64 = 0.01;
const YOUNG: f64 = 12e6;

/// A strip of a length of 1 m along `x` and this width along `y`, with a mass of 1 kg/m^2.
fn strip(width: f64, mesh: [u32; 2]) -> Value {
    json!({"name": "p", "element": "plate", "mesh": mesh, "thickness": THICKNESS,
        "surface": {"rectangle": {"corner": [0, 0, 0], "edges": [[1, 0, 0], [0, width, 0]]}},
        "material": {"youngs_modulus": YOUNG, "poisson_ratio": 0, "density": 1.0 / THICKNESS}})
}

/// A rib along `x` at this `y`, with a stiffness of 0.3 N m^2 against bending out of the plane of the strip, one of 0.6 N m^2 against torsion,
/// and 0.1 kg/m. It runs along `x`, or back.
fn rib(element: &str, y: f64, elements: u32, runs_back: bool) -> Value {
    let (ends, places) = if runs_back {
        ([[1.0, y, 0.0], [0.0, y, 0.0]], [1.0, 0.75, 0.25, 0.0])
    } else {
        ([[0.0, y, 0.0], [1.0, y, 0.0]], [0.0, 0.25, 0.75, 1.0])
    };
    let [root, first, last, tip] = places;
    let area = 0.01;
    let mut body = json!({"name": "rib", "element": element, "elements": elements,
        "shape": {"line": {"from": ends[0], "to": ends[1]}},
        "material": {"youngs_modulus": 1e6, "density": 10},
        "markers": {"root": root, "first": first, "last": last, "tip": tip}});
    if element == "cable" {
        body["section"] = json!({"area": area, "second_moment": 3e-7});
    } else {
        body["axis"] = json!([0, 1, 0]);
        body["material"]["shear_modulus"] = json!(1e6);
        body["section"] =
            json!({"area": area, "second_moments": [3e-7, 5e-7], "torsion_constant": 6e-7});
    }
    if element == "beam" {
        body["section"]["shear_factors"] = json!([1, 1]);
    }
    body
}

fn joint(name: &str, kind: &str, first: &str, second: &str) -> Value {
    json!({"name": name, "kind": kind, "edges": [first, second]})
}

fn scene(bodies: &Value, joints: &Value, outputs: &Value) -> Value {
    json!({"name": "stiffened", "dimension": 3, "gravity": [0, 0, 0], "bodies": bodies, "joints": joints,
        "outputs": outputs})
}

fn near(found: f64, exact: f64, part: f64) {
    assert!(
        (found - exact).abs() <= part * exact.abs(),
        "{found} instead of {exact}"
    );
}

/// Bending stiffnesses of strip and rib add up in a cantilever whose rib alone is loaded: `P L^3 / 3 (EI + EI)`.
/// The joint carries all of the load to the strip.
#[test]
fn a_rib_in_the_middle_adds_its_bending_stiffness() {
    let (width, force) = (0.1, 1e-5);
    for (element, kind, runs_back) in [
        ("cable", "pinned", false),
        ("cable", "pinned", true),
        ("rod", "pinned", true),
        ("rod", "clamped", false),
        ("rod", "clamped", true),
    ] {
        let bodies = json!([
            strip(width, [4, 2]),
            rib(element, 0.5 * width, 4, runs_back)
        ]);
        let joints = json!([
            joint("wall", "clamped", "ground", "p.s1=0"),
            joint("glue", kind, "rib", "p.s2=0.5")
        ]);
        let outputs = json!([{"kind": "position", "marker": "rib.tip"},
            {"kind": "reaction", "joint": "glue"}, {"kind": "reaction_moment", "joint": "glue"}]);
        let loads =
            json!([{"name": "P", "kind": "force", "marker": "rib.tip", "value": [0, 0, force]}]);
        let mut run = Run::at_rest(scene(&bodies, &joints, &outputs), &loads);
        let [_, _, z] = run.read_all("rib.tip.position");
        near(z, force / (3.0 * (width + 0.3)), 5e-4);
        let [_, _, reaction] = run.read_all("glue.reaction");
        near(reaction, force, 1e-6);
        let [_, about, _] = run.read_all("glue.reaction_moment");
        near(about, -0.5 * force, 1e-4);
    }
}

/// A strip hangs on a welded rib alone: the weld has the whole load, and its moment.
#[test]
fn a_welded_rib_carries_a_strip() {
    let (width, load) = (0.1, [1e-5, 2e-5, 1e-4]);
    for (element, runs_back) in [("rod", false), ("rod", true), ("beam", false)] {
        let bodies = json!([
            strip(width, [4, 2]),
            rib(element, 0.5 * width, 4, runs_back)
        ]);
        let joints = json!([
            {"name": "weld", "kind": "weld", "markers": ["ground", "rib.root"]},
            joint("glue", "clamped", "rib", "p.s2=0.5")
        ]);
        let outputs = json!([{"kind": "reaction", "joint": "weld"}, {"kind": "reaction_moment", "joint": "weld"},
            {"kind": "reaction", "joint": "glue"}]);
        let loads = json!([{"name": "q", "kind": "area_force", "body": "p", "value": load}]);
        let mut run = Run::at_rest(scene(&bodies, &joints, &outputs), &loads);
        let force: [f64; 3] = run.read_all("weld.reaction");
        let glue: [f64; 3] = run.read_all("glue.reaction");
        let moment: [f64; 3] = run.read_all("weld.reaction_moment");
        let wanted = [0.0, 0.5 * load[2], -0.5 * load[1]].map(|part| part * width);
        for k in 0..3 {
            let (own, whole) = (load[k] * width, load[2] * width);
            assert!((force[k] + own).abs() < 1e-5 * whole, "{force:?}");
            assert!((glue[k] + own).abs() < 1e-5 * whole, "{glue:?}");
            assert!(
                (moment[k] - wanted[k]).abs() < 1e-3 * wanted[1],
                "{moment:?}"
            );
        }
    }
}

/// Torsional stiffnesses of strip (`G h^3 b / 3`) and rib add up: `M L / (G J + G J)` between places away from the ends. The joint carries the
/// torque to the strip.
#[test]
fn a_rib_in_the_middle_adds_its_torsional_stiffness() {
    let (width, moment) = (0.1, 1e-4);
    let own = 0.5 * YOUNG * THICKNESS.powi(3) * width / 3.0;
    for (element, runs_back) in [("rod", false), ("rod", true), ("beam", false)] {
        let bodies = json!([
            strip(width, [16, 4]),
            rib(element, 0.5 * width, 16, runs_back)
        ]);
        let rotations = ["rotation_x", "rotation_y", "rotation_z"];
        let free: Vec<&str> = ["x"].into_iter().chain(rotations).collect();
        let joints = json!([
            joint("wall", "pinned", "ground", "p.s1=0"),
            joint("glue", "clamped", "rib", "p.s2=0.5"),
            {"name": "rest", "kind": "generic", "markers": ["ground", "rib.tip"], "free": free}
        ]);
        let outputs = json!([{"kind": "orientation", "marker": "rib.first"},
            {"kind": "orientation", "marker": "rib.last"},
            {"kind": "reaction_moment", "joint": "glue"}]);
        let loads =
            json!([{"name": "M", "kind": "moment", "marker": "rib.tip", "value": [moment, 0, 0]}]);
        let mut run = Run::at_rest(scene(&bodies, &joints, &outputs), &loads);
        // The first axis of the section is along `y` at the start.
        let rotation =
            |run: &mut Run, marker: &str| run.read(&format!("rib.{marker}.orientation[8]"));
        let [first, last] = ["first", "last"].map(|marker| rotation(&mut run, marker));
        near(last - first, 0.5 * moment / (own + 0.6), 1e-4);
        let [about, _, _] = run.read_all("glue.reaction_moment");
        near(about, moment, 1e-4);
    }
}

/// A rib beside the middle surface is a rod whose elastic centre is away from its line. In a cantilever bent by a moment the composite section
/// has `EI + EI + e^2 EA EA / (EA + EA)`, and its line in the middle surface does stretch.
#[test]
fn a_rib_beside_the_surface_bends_with_it() {
    let (width, arm, moment) = (0.02, 0.01, 1e-5);
    let stiff = [YOUNG * THICKNESS * width, 2e3];
    let mut body = rib("rod", 0.5 * width, 16, false);
    let own = 0.01;
    body["material"]["youngs_modulus"] = json!(1e6);
    body["section"] = json!({"area": stiff[1] / 1e6, "second_moments": [(own + stiff[1] * arm * arm) / 1e6, 1e-6],
        "torsion_constant": 6e-7, "axial_coupling": [0, stiff[1] * arm, 0]});
    let bodies = json!([strip(width, [16, 2]), body]);
    let joints = json!([
        joint("wall", "clamped", "ground", "p.s1=0"),
        joint("glue", "clamped", "rib", "p.s2=0.5")
    ]);
    let outputs = json!([{"kind": "position", "marker": "rib.tip"}]);
    let loads =
        json!([{"name": "M", "kind": "moment", "marker": "rib.tip", "value": [0, -moment, 0]}]);
    let mut run = Run::at_rest(scene(&bodies, &joints, &outputs), &loads);
    let [x, _, z] = run.read_all("rib.tip.position");
    let both = stiff[0] + stiff[1];
    let curvature = moment / (width + own + arm * arm * stiff[0] * stiff[1] / both);
    near(z, 0.5 * curvature, 2e-3);
    let strain = curvature * arm * stiff[1] / both;
    near((x - 1.0).abs(), strain, 5e-3);
}

/// A strip between two pins with a rib in its middle vibrates as a beam does: `omega_n = (n pi / L)^2 sqrt((EI + EI) / (m + m))`.
#[test]
fn a_rib_has_its_mass_and_stiffness_in_vibrations() {
    let width = 0.1;
    for (element, kind) in [("cable", "pinned"), ("rod", "clamped")] {
        let bodies = json!([strip(width, [8, 2]), rib(element, 0.5 * width, 8, false)]);
        let joints = json!([
            joint("left", "pinned", "ground", "p.s1=0"),
            joint("right", "pinned", "ground", "p.s1=1"),
            joint("glue", kind, "rib", "p.s2=0.5")
        ]);
        let outputs = json!([{"kind": "natural_frequency", "count": 2}]);
        let mut run = Run::started(&scene(&bodies, &joints, &outputs));
        for n in 1..=2 {
            let found = run.read(&format!("natural_frequency[{n}]"));
            let exact = (f64::from(n) * PI).powi(2) * (0.4_f64 / 0.2).sqrt();
            near(found, exact, 5e-4);
        }
    }
}

/// A strip with a cable along each of its long edges, pulled by a head: forces in the ratio of stiffnesses, `F EA / (EA + 2 EA)`.
#[test]
fn cables_along_edges_share_a_pull() {
    let (width, force) = (0.2, 0.01);
    let cable = |name: &str, y: f64| {
        json!({"name": name, "element": "cable", "elements": 3, "shape": {"line": {"from": [1, y, 0], "to": [0, y, 0]}},
            "material": {"youngs_modulus": 1e9, "density": 1000}, "section": {"area": 1e-5, "second_moment": 0},
            "markers": {"a": 0.5}})
    };
    let head = json!({"name": "head", "element": "rigid", "mass": 1, "inertia": [1, 1, 1],
        "position": [1, 0.5 * width, 0], "markers": {"c": [0, 0, 0]}});
    let bodies = json!([
        strip(width, [3, 2]),
        cable("near", 0.0),
        cable("far", width),
        head
    ]);
    let joints = json!([
        joint("wall", "clamped", "ground", "p.s1=0"),
        joint("grip", "clamped", "head.c", "p.s1=1"),
        joint("one", "pinned", "near", "p.s2=0"),
        joint("other", "pinned", "far", "p.s2=1"),
        {"name": "guide", "kind": "prismatic", "markers": ["ground", "head.c"], "direction": [1, 0, 0]}
    ]);
    let outputs = json!([{"kind": "position", "marker": "head.c"},
        {"kind": "axial_force", "marker": "near.a"}, {"kind": "axial_force", "marker": "far.a"}]);
    let loads = json!([{"name": "F", "kind": "force", "marker": "head.c", "value": [force, 0, 0]}]);
    let mut run = Run::at_rest(scene(&bodies, &joints, &outputs), &loads);
    let strain = force / (YOUNG * THICKNESS * width + 2e4);
    let [x, _, _] = run.read_all("head.c.position");
    near(x - 1.0, strain, 1e-5);
    for name in ["near", "far"] {
        let found = run.read(&format!("{name}.a.axial_force"));
        near(found, 1e4 * strain, 1e-5);
    }
}

/// Horizontal force and sag of an elastic cable between two supports at the distance of its unstressed length, with the weight `w` (Irvine,
/// Cable Structures (1981), section 1.5).
fn elastic_catenary(weight: f64, stiffness: f64) -> [f64; 2] {
    let (mut low, mut high) = (1e-3 * weight, 1e3 * weight);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        let span = middle / stiffness + 2.0 * middle / weight * (0.5 * weight / middle).asinh();
        if span > 1.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    let ratio = 0.5 * weight / low;
    [
        low,
        weight / (8.0 * stiffness) + low / weight * (ratio.hypot(1.0) - 1.0),
    ]
}

/// A curtain that is stiff along its threads only hangs on the cable along its upper edge, which becomes an elastic catenary of the weight of
/// both.
#[test]
fn a_curtain_hangs_on_the_cable_along_its_edge() {
    let (depth, gravity, stiffness) = (0.3, 9.81, 640.0);
    let diagonal = |of: [f64; 3]| json!([[of[0], 0, 0], [0, of[1], 0], [0, 0, of[2]]]);
    let curtain = json!({"name": "p", "element": "plate", "mesh": [8, 2],
        "surface": {"rectangle": {"corner": [0, 0, -depth], "edges": [[1, 0, 0], [0, 0, depth]]}},
        "stiffness": {"A": diagonal([1e-3, 1e3, 1e-3]), "D": diagonal([1e-4; 3])}, "area_density": 1});
    let cable = json!({"name": "line", "element": "cable", "elements": 8,
        "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}},
        "material": {"youngs_modulus": stiffness / 1e-5, "density": 1e4}, "section": {"area": 1e-5, "second_moment": 0},
        "markers": {"first": 0, "middle": 0.5, "last": 1}});
    let joints = json!([
        joint("hem", "pinned", "line", "p.s2=1"),
        {"name": "left", "kind": "spherical", "markers": ["ground", "line.first"]},
        {"name": "right", "kind": "spherical", "markers": ["ground", "line.last"]}
    ]);
    let outputs = json!([{"kind": "position", "marker": "line.middle"},
        {"kind": "axial_force", "marker": "line.middle"}]);
    let mut scene = scene(&json!([curtain, cable]), &joints, &outputs);
    scene["gravity"] = json!([0, 0, -gravity]);
    let mut run = Run::at_rest(scene, &json!([]));
    let [pull, sag] = elastic_catenary(gravity * (depth + 0.1), stiffness);
    let [_, _, z] = run.read_all("line.middle.position");
    near(-z, sag, 1e-3);
    near(run.read("line.middle.axial_force"), pull, 1e-3);
}

/// A free plate with stiffeners of all three kinds keeps its momentum and energy, whatever the steps are.
#[test]
fn stiffeners_do_no_work() {
    let plate = json!({"name": "p", "element": "plate", "mesh": [2, 2], "thickness": THICKNESS,
        "surface": {"rectangle": {"corner": [0, 0, 0], "edges": [[0.6, 0, 0], [0, 0.5, 0]]}}, "markers": {"c": [1, 1]},
        "material": {"youngs_modulus": YOUNG, "poisson_ratio": 0.3, "density": 1.0 / THICKNESS}});
    let line = |name: &str, element: &str, ends: [[f64; 3]; 2]| {
        let mut body = rib(element, 0.0, 2, false);
        body["name"] = json!(name);
        body["markers"] = json!({});
        body["shape"] = json!({"line": {"from": ends[0], "to": ends[1]}});
        if element != "cable" {
            body["axis"] = json!([0, 0, 1]);
        }
        body
    };
    let bodies = json!([
        plate,
        line("rod", "rod", [[0.0, 0.25, 0.0], [0.6, 0.25, 0.0]]),
        line("beam", "beam", [[0.6, 0.5, 0.0], [0.6, 0.0, 0.0]]),
        line("cable", "cable", [[0.0, 0.0, 0.0], [0.6, 0.0, 0.0]])
    ]);
    let joints = json!([
        joint("a", "clamped", "rod", "p.s2=0.5"),
        joint("b", "clamped", "beam", "p.s1=1"),
        joint("c", "pinned", "cable", "p.s2=0")
    ]);
    let outputs = json!([{"kind": "energy"}, {"kind": "momentum"}]);
    let mut free = scene(&bodies, &joints, &outputs);
    free["loads"] = json!([{"name": "kick", "kind": "force", "marker": "p.c", "value": [0, "if(t < 0.01, 1, 0)", "if(t < 0.01, 3, 0)"]}]);
    Run::check_kept(free, 6);
}
