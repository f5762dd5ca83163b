//! Plates and shells: surfaces, sections, markers, edges and what acts on them.

use serde_json::{Value, json};

use super::check;
use crate::scene::{Place, Scene, remarks};

fn scene() -> Value {
    json!({"name": "panel", "dimension": 3,
        "bodies": [
            {"name": "panel", "element": "plate", "mesh": [4, 2],
                "surface": {"rectangle": {"corner": [0, 0, 0], "edges": [[2, 0, 0], [0, 1, 0]]}},
                "material": {"youngs_modulus": 7e10, "poisson_ratio": 0.33, "density": 2700}, "thickness": 2e-3,
                "markers": {"tip": [1, 1], "root": {"at": [0, 0.5], "pad": [0.02, 0.1]}}},
            {"name": "roof", "element": "shell", "mesh": [3, 3],
                "surface": {"cylinder": {"from": [0, 0, 5], "to": [0, 4, 5], "radius": 2, "start": [1, 0, 0], "angle": 3}},
                "laminate": [
                    {"material": {"youngs_modulus": [1.4e11, 1e10], "poisson_ratio": 0.3, "shear_modulus": 5e9, "density": 1600}, "thickness": 1e-3},
                    {"material": {"youngs_modulus": [1.4e11, 1e10], "poisson_ratio": 0.3, "shear_modulus": 5e9, "density": 1600}, "thickness": 1e-3, "angle": 1}],
                "markers": {"top": [0.5, 0.5]}},
            {"name": "ball", "element": "rigid", "mass": 1, "inertia": [1, 1, 1], "position": [2, 1, 0], "markers": {"c": [0, 0, 0]}}],
        "masses": [], "motions": [],
        "joints": [
            {"name": "wall", "kind": "clamped", "edges": ["ground", "panel.s1=0"]},
            {"name": "ties", "kind": "pinned", "edges": ["ground", "roof.s2=1"]},
            {"name": "mirror", "kind": "symmetry", "edges": ["ground", "roof.s2=0"], "normal": [0, 1, 0]},
            {"name": "hold", "kind": "weld", "markers": ["panel.tip", "ball.c"]}],
        "loads": [
            {"name": "wind", "kind": "pressure", "body": "roof", "value": "100*t"},
            {"name": "snow", "kind": "area_force", "body": "panel", "value": [0, 0, -100]}],
        "inputs": [{"kind": "pressure", "body": "panel"}],
        "outputs": [{"kind": "position", "marker": "panel.tip"}]})
}

#[test]
fn surfaces_and_meshes_are_checked() {
    check(
        scene,
        r#"
        /name | "panels" | accepted
        /bodies/0/mesh | [0, 2] | bodies[0].mesh[0]: expected an integer from 1 to 200 (factors of finer meshes take gigabytes), found 0
        /bodies/0/mesh | [4, 201] | bodies[0].mesh[1]
        /bodies/0/mesh | [4] | bodies[0].mesh: expected two numbers of elements, each a positive integer or "auto", found 1
        /bodies/0/mesh | "many" | bodies[0].mesh: expected two numbers of elements, each a positive integer or "auto", found "many"
        /bodies/0/mesh | [4, "many"] | bodies[0].mesh: expected two numbers of elements, each a positive integer or "auto", found "many"
        /bodies/0/mesh | [4, 1.5] | bodies[0].mesh: expected two numbers of elements, each a positive integer or "auto", found 1.5
        /bodies/0/mesh | [4, -1] | bodies[0].mesh: expected two numbers of elements
        /bodies/0/mesh | 4 | bodies[0].mesh: expected two numbers of elements
        /bodies/0/mesh | "auto" | accepted
        /bodies/0/mesh | [4, "auto"] | accepted
        /bodies/0/mesh | null | bodies[0].mesh: expected two numbers of elements, each a positive integer or "auto", found null
        /joints/0/edges | ["ground", "panel.s1=0.3"] | joints[0].edges[1]: expected an edge (s1=0, s1=1, s2=0, s2=1) or another line of the mesh of 4 x 2 elements
        /bodies/0/surface | {"disc": {}} | bodies[0].surface
        /bodies/0/surface/rectangle/edges | [[2, 0, 0], [4, 0, 0]] | bodies[0].surface: expected a surface whose lines along s1 and s2 cross
        /bodies/0/surface/rectangle/edges/0 | [2, 0] | bodies[0].surface.rectangle.edges[0]: expected 3 components [x, y, z], found 2
        /bodies/0/surface | {"quadrilateral": {"corners": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]}} | bodies[0].surface: expected a surface whose lines along s1 and s2 cross
        /bodies/0/surface | {"quadrilateral": {"corners": [[0, 0, 0], [1, 0, 0], [0.15, 0.3, 0], [0, 1, 0]]}} | bodies[0].surface: expected a surface that does not fold over itself
        /bodies/0/surface | {"quadrilateral": {"corners": [[0, 0, 0], [1, 0, 0], [0, 0, 0], [0, 1, 0]]}} | bodies[0].surface
        /bodies/0/surface | {"quadrilateral": {"corners": [[0, 0, 0], [1, 0, 0], [1, 1, 0.1], [0, 1, 0]]}} | bodies[0].surface: expected a flat surface of a plate
        /bodies/1/surface | {"quadrilateral": {"corners": [[0, 0, 0], [1, 0, 0], [1, 1, 0.1], [0, 1, 0]]}} | joints[2].normal
        /bodies/0/surface | {"annulus": {"center": [0, 0, 0], "normal": [0, 0, 1], "start": [1, 0, 0], "radii": [1, 2], "angle": 3}} | accepted
        /bodies/0/surface | {"annulus": {"center": [0, 0, 0], "normal": [0, 0, 1], "start": [1, 0, 0], "radii": [0, 2], "angle": 3}} | bodies[0].surface.annulus.radii[0]: expected a positive number (m), found 0
        /bodies/0/surface | {"annulus": {"center": [0, 0, 0], "normal": [0, 0, 1], "start": [1, 0, 0], "radii": [2, 1], "angle": 3}} | bodies[0].surface.annulus.radii[1]: expected more than the inner radius (2 m), found 1
        /bodies/0/surface | {"annulus": {"center": [0, 0, 0], "normal": [0, 0, 1], "start": [0, 0, 2], "radii": [1, 2], "angle": 3}} | bodies[0].surface.annulus.start: expected a direction that is not along the axis
        /bodies/0/surface | {"annulus": {"center": [0, 0, 0], "normal": [0, 0, 0], "start": [0, 0, 2], "radii": [1, 2], "angle": 3}} | bodies[0].surface.annulus.normal
        /bodies/1/surface/cylinder/angle | 7 | bodies[1].surface.cylinder.angle: expected an angle above 0 and up to 2 pi (rad), found 7
        /bodies/1/surface/cylinder/to | [0, 0, 5] | bodies[1].surface.cylinder.to: expected another end of the axis
        /bodies/1/surface/cylinder/radius | -1 | bodies[1].surface.cylinder.radius
        /bodies/1/surface | {"sphere": {"center": [0, 0, 0], "radius": 1, "axis": [0, 0, 1], "start": [1, 0, 0], "latitudes": [0, 1.6], "angle": 1}} | bodies[1].surface.sphere.latitudes[1]: expected a latitude between the poles
        /bodies/1/surface | {"sphere": {"center": [0, 0, 0], "radius": 1, "axis": [0, 0, 1], "start": [1, 0, 0], "latitudes": [0, 1.5707], "angle": 1}} | bodies[1].surface: expected a surface whose lines along s1 and s2 cross
        /bodies/1/surface | {"sphere": {"center": [0, 0, 0], "radius": 1, "axis": [0, 0, 1], "start": [1, 0, 0], "latitudes": [1, 0], "angle": 1}} | bodies[1].surface.sphere.latitudes[1]: expected more than the first latitude (1 rad), found 0
        /bodies/1/surface | {"points": {"grid": [[[0, 0, 0], [1, 0, 0]]]}} | bodies[1].surface.points.grid: expected 2 to 200 points, found 1
        /bodies/1/surface | {"points": {"grid": [[[0, 0, 0], [1, 0, 0]], [[0, 1, 0]]]}} | bodies[1].surface.points.grid[1]
        /bodies/1/surface | {"ruled": {"curves": [[[0, 0, 0], [1, 0, 0]], [[0, 1, 0], [1, 1, 0], [2, 1, 0]]]}} | joints[2].normal
        /bodies/1/element | "plate" | bodies[1].surface: expected a flat surface of a plate
        /dimension | 2 | bodies[0].element: expected a body of the plane (plates and shells are of space, "dimension": 3), found "plate"
        "#,
    );
}

#[test]
fn sections_are_checked() {
    check(
        scene,
        r#"
        /bodies/0/thickness | 0 | bodies[0].thickness: expected a positive number (m), found 0
        /bodies/0/thickness | "0.01*(1-0.5*s1*s2)" | accepted
        /bodies/0/thickness | "0.01*(1-2*s1)" | bodies[0].thickness: expected a positive thickness (m) all over the surface, found 0 at s1 = 0.5, s2 = 0
        /bodies/0/thickness | "0.01*(1+t)" | bodies[0].thickness: expected an expression in `s1` and `s2` alone
        /bodies/0/thickness | "0.01*(1+s)" | bodies[0].thickness
        /bodies/0/thickness | {"table": [[0, 1], [1, 2]]} | bodies[0].thickness: expected a number or an expression
        /bodies/0/thickness | null | bodies[0].thickness: expected a thickness, found nothing
        /bodies/0/material/poisson_ratio | 0.6 | bodies[0].material.poisson_ratio: expected a number above -1 and up to 0.5, found 0.6
        /bodies/0/material/poisson_ratio | -1 | bodies[0].material.poisson_ratio
        /bodies/0/material/youngs_modulus | 0 | bodies[0].material.youngs_modulus
        /bodies/0/material/density | -1 | bodies[0].material.density
        /bodies/0/material/damping_time | -1 | bodies[0].material.damping_time
        /bodies/0/material | null | bodies[0].material: expected a material beside `thickness`, or `laminate` or `stiffness` instead, found nothing
        /bodies/0/axis_angle | 1 | bodies[0].axis_angle: expected 0 of an isotropic material, which has no axes, found 1
        /bodies/0/damping_time | 1 | bodies[0].damping_time: expected nothing beside `material`, which has one, found 1
        /bodies/0/area_density | 1 | bodies[0].area_density: expected nothing beside `material`, found a value
        /bodies/1/thickness | 1 | bodies[1].thickness: expected nothing beside `laminate`, found a value
        /bodies/1/material | {"youngs_modulus": 7e10, "poisson_ratio": 0.33, "density": 2700} | bodies[1].laminate: expected nothing beside `material`, found a value
        /bodies/1/laminate/0/material/poisson_ratio | 4 | bodies[1].laminate[0].material.poisson_ratio
        /bodies/1/laminate/1/material/youngs_modulus | [1, 0] | bodies[1].laminate[1].material.youngs_modulus[1]
        /bodies/1/laminate/1/thickness | 0 | bodies[1].laminate[1].thickness
        /bodies/1/axis_angle | 1 | accepted
        /bodies/1/damping_time | 1e-3 | accepted
        /bodies/0/motion | {"deformation": ["s1*s2", "0", "sin(PI*s2)"]} | accepted
        /bodies/0/motion | {"deformation": ["s", "0", "0"]} | bodies[0].motion.deformation[0]: expected one of the names s1, s2, PI
        /bodies/0/motion | {"deformation": ["0", "0", "t"]} | bodies[0].motion.deformation[2]: expected one of the names s1, s2, PI
        /bodies/0/motion | {"deformation": ["0", "s1"]} | bodies[0].motion.deformation: expected 3 values [x, y, z], found 2
        /bodies/0/motion | {"deformation": ["0", "1/s2", "0"]} | bodies[0].motion.deformation[1]: expected a finite velocity and finite derivatives at [s1, s2] = [0, 0], found
        "#,
    );
    let given = || {
        let mut scene = scene();
        let body = scene["bodies"][0].as_object_mut().expect("a body");
        body.remove("material");
        body.remove("thickness");
        let a = json!([[2, 0.5, 0], [0.5, 2, 0], [0, 0, 1]]);
        body.insert("stiffness".into(), json!({"A": a, "D": a}));
        body.insert("area_density".into(), json!(3));
        scene
    };
    check(
        given,
        r#"
        /name | "given" | accepted
        /bodies/0/area_density | null | bodies[0].area_density: expected a mass per area (kg/m^2), found nothing
        /bodies/0/stiffness/A/0/1 | 0.4 | bodies[0].stiffness.A: expected a symmetric matrix
        /bodies/0/stiffness/D/2/2 | 0 | bodies[0].stiffness: expected a stiffness that is positive definite
        /bodies/0/stiffness/B | [[3, 0, 0], [0, 0, 0], [0, 0, 0]] | bodies[0].stiffness: expected a stiffness that is positive definite
        /bodies/0/stiffness/B | [[1, 0, 0], [0, 0, 0], [0, 0, 0]] | accepted
        /loads/1 | {"name": "air", "kind": "fluid", "body": "panel", "density": 1.2} | loads[1].buoyancy: expected false for a section whose thickness is not given, found true
        /loads/1 | {"name": "air", "kind": "fluid", "body": "panel", "density": 1.2, "buoyancy": false} | accepted
        "#,
    );
}

#[test]
fn markers_edges_and_loads_are_checked() {
    check(
        scene,
        r#"
        /bodies/0/markers/tip | [1, 1.5] | bodies[0].markers.tip[1]: expected a number from 0 to 1, found 1.5
        /bodies/0/markers/root/pad | [0, 1] | bodies[0].markers.root.pad[0]: expected a positive number (m), found 0
        /bodies/0/markers/root/at | [-1, 1] | bodies[0].markers.root.at[0]
        /bodies/0/markers/root/width | 1 | bodies[0].markers.root.width
        /joints/0/edges | ["ground", "panel.s3=0"] | joints[0].edges[1]: expected an edge (s1=0, s1=1, s2=0, s2=1) or another line of the mesh of 4 x 2 elements, found "s3=0"
        /joints/0/edges | ["ground", "ball.c"] | joints[0].edges[1]: expected an edge of a plate or shell of this scene
        /joints/0/edges | ["ground", "panel.s1=0.3"] | joints[0].edges[1]: expected an edge (s1=0, s1=1, s2=0, s2=1) or another line of the mesh
        /joints/0/edges | ["ground", "panel.s1=nan"] | joints[0].edges[1]: expected an edge
        /joints/0/edges | ["ground", "panel.s1=0.25"] | accepted
        /joints/0/edges | ["ground", "panel.s1=1.25"] | joints[0].edges[1]: expected an edge
        /joints/0/edges | ["panel.s1=1", "panel.s1=0"] | joints[0].edges[0]: expected another line at the place of panel.s1=0, found panel.s1=1 (nodes up to 2 m off)
        /joints/0/edges | ["panel.s1=0", "panel.s1=0"] | joints[0].edges[0]: expected another line at the place of panel.s1=0
        /joints/0/edges | ["panel.s2=1", "panel.s1=0"] | joints[0].edges[0]: expected a line of 2 elements, as many as panel.s1=0 has, found panel.s2=1 of 4
        /joints/0/edges | ["roof.s1=1", "panel.s1=0"] | joints[0].edges[0]: expected a line of 2 elements, as many as panel.s1=0 has, found roof.s1=1 of 3
        /joints/0/edges | ["ball.c", "panel.s1=0"] | accepted
        /joints/0/edges | ["ball.d", "panel.s1=0"] | joints[0].edges[0]: expected a marker of this scene
        /joints/0 | {"name": "wall", "kind": "smooth", "edges": ["ground", "panel.s1=0"]} | joints[0].edges[0]: expected an edge of a plate or shell of this scene, `body.s1=0`, found "ground"
        /joints/0 | {"name": "wall", "kind": "smooth", "edges": ["panel.s1=0", "panel.s1=0.5"]} | joints[0].edges[1]: expected an edge (s1=0, s1=1, s2=0, s2=1), found "s1=0.5"
        /joints/2/edges | ["ball.c", "roof.s2=0"] | joints[2].edges[0]: expected "ground", found "ball.c"
        /joints/0/release_time | 1 | joints[0].release_time: expected nothing: the joint of an edge is not released, found 1
        /joints/2/normal | [1, 0, 0] | joints[2].normal: expected the normal of a plane that the edge lies in
        /joints/2/normal | [0, 0, 0] | joints[2].normal
        /joints/2/name | "hold" | joints[3].name
        /joints/3/markers | ["panel.tip", "panel.root"] | joints[3].markers
        /loads/1 | {"name": "air", "kind": "fluid", "body": "panel", "density": 1.2, "drag": 1.5, "current": ["s1*t", "s2", 3]} | accepted
        /loads/1 | {"name": "air", "kind": "fluid", "body": "panel", "density": 1.2, "current": ["s", 0, 0]} | loads[1].current[0]
        /loads/1 | {"name": "air", "kind": "fluid", "body": "panel", "density": 1.2, "diameter": 1} | loads[1].diameter: expected nothing for a plate or shell, found 1
        /loads/1 | {"name": "air", "kind": "fluid", "body": "panel", "density": 1.2, "area": 1} | loads[1].area: expected nothing for a plate or shell, found 1
        /loads/1 | {"name": "air", "kind": "fluid", "body": "panel", "density": 1.2, "added_mass": 1} | loads[1].added_mass: expected nothing for a plate or shell, found 1
        /loads/1 | {"name": "air", "kind": "fluid", "body": "ball", "density": 1.2} | loads[1].body: expected the name of a cable, rod, beam, plate or shell of this scene (panel, roof), found "ball"
        /loads/1 | {"name": "floor", "kind": "contact", "body": "panel", "stiffness": 1e6, "surface": {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}} | accepted
        /loads/1 | {"name": "floor", "kind": "contact", "body": "panel", "stiffness": -1, "surface": {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}} | loads[1].stiffness: expected a positive number (N/m^3), found -1
        /loads/0/body | "ball" | loads[0].body: expected the name of a plate or shell of this scene (panel, roof), found "ball"
        /loads/0/value | [1, 2, 3] | loads[0].value: expected one value, found 3
        /loads/1/value | 3 | loads[1].value
        /loads/0/value | "100*s1*sin(PI*s2)*t" | accepted
        /loads/0/value | "s" | loads[0].value: expected one of the names t, s1, s2, PI
        /loads/0/value | "1/s3" | loads[0].value: expected one of the names t, s1, s2, PI
        /loads/1/value | [0, "s2-0.5", -1] | accepted
        /inputs/0/body | "pannel" | inputs[0].body: expected the name of a plate or shell of this scene (panel, roof), found "pannel"; did you mean `panel`?
        /inputs | [{"kind": "area_force", "body": "roof", "start": [1, 2, 3]}] | accepted
        /masses | [{"marker": "panel.tip", "mass": 1}] | masses[0].marker: expected a marker of another body than a plate or shell
        /outputs | [{"kind": "reaction", "joint": "wall"}, {"kind": "reaction_moment", "joint": "wall"}] | accepted
        /outputs | [{"kind": "velocity", "joint": "wall"}] | outputs[0].joint: expected a joint of markers (of a joint of edges only its reaction is read), found "wall"
        /outputs | [{"kind": "axial_force", "marker": "panel.tip"}] | outputs[0].marker: expected a marker of a cable, found "panel.tip"
        /outputs | [{"kind": "deflection", "marker": "panel.tip"}] | outputs[0].from: expected another marker of the plate or shell
        /outputs | [{"kind": "deflection", "marker": "panel.tip", "from": "panel.root"}] | accepted
        /outputs | [{"kind": "orientation", "marker": "roof.top"}] | accepted
        "#,
    );
}

/// A marker with a pad is at the mean of the part of the pad that is on the body.
#[test]
fn markers_are_at_points_and_pads() {
    let scene = Scene::from_json(&scene().to_string()).expect("a valid scene");
    let resolved = scene.resolved();
    let position = |name: &str| resolved.markers.iter().find(|of| of.name == name);
    let root = position("root").expect("a marker");
    assert!((root.position[0] - 0.005).abs() < 1e-12 && (root.position[1] - 0.5).abs() < 1e-12);
    let top = position("top").expect("a marker");
    let wanted = [2.0 * 1.5_f64.cos(), 2.0, 5.0 + 2.0 * 1.5_f64.sin()];
    // About the axis along y from x to minus z.
    assert!((top.position[0] - wanted[0]).abs() < 1e-12, "{top:?}");
    assert!(
        (top.position[2] - (10.0 - wanted[2])).abs() < 1e-12,
        "{top:?}"
    );
    assert!(matches!(top.place, Place::Patch(_, 0)));
}

/// A point that is held in the surface is told of; one with a pad is not, nor is one that is pushed across.
#[test]
fn bare_points_are_told() {
    let told =
        |scene: &Value| remarks(&Scene::from_json(&scene.to_string()).expect("a valid scene"));
    let found = told(&scene());
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].starts_with("bodies[0].markers.tip: hold acts on it"));
    let mut padded = scene();
    padded["bodies"][0]["markers"]["tip"] = json!({"at": [1, 1], "pad": [0.1, 0.1]});
    assert_eq!(told(&padded), Vec::<String>::new());
    let mut pushed = scene();
    pushed["joints"] = json!([]);
    let force = |value: Value| json!([{"name": "f", "kind": "force", "marker": "panel.tip", "value": value}]);
    pushed["loads"] = force(json!([0, 0, 3]));
    assert_eq!(told(&pushed), Vec::<String>::new());
    pushed["loads"] = force(json!([0, 1, 3]));
    assert_eq!(told(&pushed).len(), 1);
}

/// Sections are read at markers of plates and shells, where there are such quantities.
#[test]
fn sections_are_read_where_they_are() {
    check(
        scene,
        r#"
        /outputs/0/kind | "membrane_strain" | accepted
        /outputs/0/kind | "membrane_force" | accepted
        /outputs/0/kind | "curvature" | accepted
        /outputs/0/kind | "bending_moment" | accepted
        /outputs/0/kind | "surface_stress" | accepted
        /outputs/0/kind | "strain" | outputs[0].marker: expected a marker of a cable, found "panel.tip"
        /outputs/0/kind | "axial_force" | outputs[0].marker: expected a marker of a cable, found "panel.tip"
        /outputs/0 | {"kind": "curvature", "marker": "ball.c"} | outputs[0].marker: expected a marker of a cable, found "ball.c"
        /outputs/0 | {"kind": "membrane_force", "marker": "ball.c"} | outputs[0].marker: expected a marker of a plate or shell, found "ball.c"
        /outputs/0 | {"kind": "surface_stress", "marker": "panel.top"} | outputs[0].marker
        /outputs/0 | {"kind": "ply_stress", "marker": "panel.tip", "plies": [1]} | outputs[0].marker: expected a marker of a plate or shell with a laminate, found "panel.tip"
        /outputs/0 | {"kind": "ply_stress", "marker": "roof.top", "plies": [2, 1]} | accepted
        /outputs/0 | {"kind": "ply_stress", "marker": "roof.top", "plies": [2, 2]} | outputs[0].plies[1]: expected a ply not named before, found 2
        /outputs/0 | {"kind": "ply_stress", "marker": "roof.top", "plies": [0]} | outputs[0].plies[0]: expected the number of a ply, from 1 to 2, found 0
        /outputs/0 | {"kind": "ply_stress", "marker": "roof.top", "plies": [3]} | outputs[0].plies[0]: expected the number of a ply, from 1 to 2, found 3
        /outputs/0 | {"kind": "ply_stress", "marker": "roof.top", "plies": []} | outputs[0].plies: expected 1 to 200 numbers of plies, found 0
        /outputs/0 | {"kind": "ply_stress", "marker": "roof.top"} | outputs[0].plies
    "#,
    );
    let stiff = || {
        let mut scene = scene();
        let panel = scene["bodies"][0].as_object_mut().expect("a body");
        panel.remove("material");
        panel.remove("thickness");
        let rows = json!([[2, 0, 0], [0, 2, 0], [0, 0, 1]]);
        panel.insert("stiffness".into(), json!({"A": rows, "D": rows}));
        panel.insert("area_density".into(), json!(1));
        scene
    };
    check(
        stiff,
        r#"
        /outputs/0/kind | "membrane_force" | accepted
        /outputs/0/kind | "surface_stress" | outputs[0].marker: expected a marker of a plate or shell with a material or a laminate
    "#,
    );
}

/// The panel with a rib along its middle, a cable along its long edge, and what a stiffener cannot be.
fn stiffened() -> Value {
    let mut scene = scene();
    let line = |name: &str, element: &str, y: f64| {
        let mut body = json!({"name": name, "element": element, "elements": 4, "markers": {"a": 0, "b": 0.5, "c": 1},
            "material": {"youngs_modulus": 1e9, "density": 1000},
            "section": {"area": 1e-4, "second_moment": 1e-10}, "shape": {"line": {"from": [0, y, 0], "to": [2, y, 0]}}});
        if element == "rod" {
            body["material"]["shear_modulus"] = json!(4e8);
            body["section"] =
                json!({"area": 1e-4, "second_moments": [1e-10, 1e-10], "torsion_constant": 2e-10});
            body["axis"] = json!([0, 0, 1]);
        }
        body
    };
    let bodies = scene["bodies"].as_array_mut().expect("bodies");
    bodies.extend([line("rib", "rod", 0.5), line("rope", "cable", 0.0)]);
    let joints = scene["joints"].as_array_mut().expect("joints");
    joints.push(json!({"name": "glue", "kind": "clamped", "edges": ["rib", "panel.s2=0.5"]}));
    joints.push(json!({"name": "hem", "kind": "pinned", "edges": ["rope", "panel.s2=0"]}));
    scene
}

#[test]
fn stiffeners_are_checked() {
    check(
        stiffened,
        r#"
        /name | "ribs" | accepted
        /joints/4/kind | "pinned" | accepted
        /joints/5/kind | "clamped" | joints[5].edges[0]: expected a rod or beam, whose sections rotate with the surface (`pinned` holds an edge on a cable), found the cable rope
        /joints/4 | {"name": "glue", "kind": "smooth", "edges": ["rib", "panel.s2=0"]} | joints[4].edges[0]: expected an edge of a plate or shell of this scene, `body.s1=0`, found "rib"
        /joints/4/edges | ["panel.s2=0.5", "rib"] | joints[4].edges[1]: expected an edge of a plate or shell of this scene
        /joints/4/edges | ["rib", "panel.s2=0"] | joints[4].edges[0]: expected a body whose nodes are those of panel.s2=0, found rib (nodes up to 0.5 m off)
        /joints/4/edges | ["rib", "panel.s1=0.5"] | joints[4].edges[0]: expected a body of 2 elements, as many as panel.s1=0.5 has, found rib of 4
        /joints/4/edges | ["ball", "panel.s2=0.5"] | joints[4].edges[0]: expected a marker of this scene
        /joints/4/edges | ["bone", "panel.s2=0.5"] | joints[4].edges[0]: expected a marker of this scene
        /bodies/3/elements | 3 | joints[4].edges[0]: expected a body of 4 elements, as many as panel.s2=0.5 has, found rib of 3
        /bodies/3/elements | "auto" | accepted
        /bodies/3/markers/b | 0.3 | joints[4].edges[0]: expected a body whose nodes are those of panel.s2=0.5, found rib (nodes up to
        /bodies/3 | {"name": "rib", "element": "rod", "model": "modal", "modes": 2, "material": {"youngs_modulus": 1e9, "shear_modulus": 4e8, "density": 1000}, "section": {"area": 1e-4, "second_moments": [1e-10, 1e-10], "torsion_constant": 2e-10}, "axis": [0, 0, 1], "shape": {"line": {"from": [0, 0.5, 0], "to": [2, 0.5, 0]}}} | joints[4].edges[0]: expected a cable, rod or beam with elements, neither rigid nor reduced to modes, found "rib"
        /bodies/3/shape/line | {"from": [2, 0.5, 0], "to": [0, 0.5, 0]} | accepted
        /bodies/3/shape/line/to | [2, 0.5, 0.001] | joints[4].edges[0]: expected a body whose nodes are those of panel.s2=0.5, found rib (nodes up to 0.001 m off)
        /joints/4/release_time | 1 | joints[4].release_time: expected nothing
        /motions | [{"name": "drum", "kind": "winch", "marker": "rope.a", "value": "0.1*t"}] | joints[5].edges[0]: expected a body that no winch pays out, found "rope"
        "#,
    );
}
