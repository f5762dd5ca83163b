//! Plates and shells against published benchmarks, an independent program and closed forms of their motions.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use serde_json::{Value, json};

use super::plates::{ALL, hold, plate};
use super::runs::Run;

/// A quarter of a hemisphere of radius 10 with a hole of 18 degrees, pulled apart along `x` and pressed together along `y` by forces `load` on
/// the whole. Displacements below both forces.
fn hemisphere(elements: u32, h: f64, load: f64) -> [f64; 2] {
    let latitude = 72_f64.to_radians();
    let symmetry = |edge: &str, normal: [u32; 3]| json!({"name": edge.replace('=', "_"), "kind": "symmetry", "edges": ["ground", format!("p.{edge}")], "normal": normal});
    let force = |name: &str, value: [f64; 3]| json!({"name": name, "kind": "force", "marker": format!("p.{name}"), "value": value});
    let scene = json!({"name": "hemisphere", "dimension": 3, "gravity": [0, 0, 0],
        "bodies": [{"name": "p", "element": "shell", "mesh": [elements, elements], "thickness": h,
            "surface": {"sphere": {"center": [0, 0, 0], "radius": 10, "axis": [0, 0, 1], "start": [1, 0, 0],
                "latitudes": [0, latitude], "angle": FRAC_PI_2}},
            "material": {"youngs_modulus": 6.825e7, "poisson_ratio": 0.3, "density": 1},
            "markers": {"pull": [0, 0], "press": [1, 0], "top": [0.5, 1]}}],
        "joints": [symmetry("s1=0", [0, 1, 0]), symmetry("s1=1", [1, 0, 0]),
            {"name": "height", "kind": "generic", "markers": ["ground", "p.top"],
                "free": ["x", "y", "rotation_x", "rotation_y", "rotation_z"]}],
        "outputs": [{"kind": "position", "marker": "p.pull"}, {"kind": "position", "marker": "p.press"}]});
    // A quarter carries half of each force.
    let loads = json!([
        force("pull", [0.5 * load, 0.0, 0.0]),
        force("press", [0.0, -0.5 * load, 0.0])
    ]);
    let mut run = Run::at_rest(scene, &loads);
    let out = run.read("p.pull.position[1]") - 10.0;
    [out, 10.0 - run.read("p.press.position[2]")]
}

/// R. H. MacNeal, R. L. Harder, Finite Elem. Anal. Des. 1 (1985): 0.094 at a force of 2. J. C. Simo, D. D. Fox, M. S. Rifai, Comput. Methods
/// Appl. Mech. Eng. 73 (1989): 0.093. Bending without stretching makes displacements of thin shells proportional to the force over the cube of the
/// thickness. Strains that lock make a tenth of the thickness 13 % stiffer on this mesh.
#[test]
fn thin_hemispheres_do_not_lock() {
    for (h, load, within) in [(0.04, 0.02, 5e-3), (0.004, 2e-5, 0.03)] {
        for displacement in hemisphere(8, h, load) {
            let found = displacement * 2.0 / load * (h / 0.04_f64).powi(3);
            assert!((found / 0.0935 - 1.0).abs() < within, "{h}: {found}");
        }
    }
}

/// K. Y. Sze, X. H. Liu, S. H. Lo, Finite Elem. Anal. Des. 40 (2004): 4.067 and 8.178 at a force of 400, by elements that shear.
#[test]
fn a_hemisphere_deforms_as_published() {
    let found = hemisphere(8, 0.04, 400.0);
    for (found, published) in found.into_iter().zip([4.067, 8.178]) {
        assert!((found / published - 1.0).abs() < 5e-3, "{found}");
    }
}

/// K. Y. Sze, X. H. Liu, S. H. Lo, Finite Elem. Anal. Des. 40 (2004): lips of a slit ring lifted by 0.8 a length, 13.891 inside and 17.528
/// outside, by elements that shear.
#[test]
fn a_slit_ring_opens_as_published() {
    let scene = json!({"name": "ring", "dimension": 3, "gravity": [0, 0, 0],
        "bodies": [{"name": "p", "element": "plate", "mesh": [2, 32], "thickness": 0.03,
            "surface": {"annulus": {"center": [0, 0, 0], "normal": [0, 0, 1], "start": [1, 0, 0], "radii": [6, 10], "angle": TAU}},
            "material": {"youngs_modulus": 21e6, "poisson_ratio": 0, "density": 1},
            "markers": {"inside": [0, 1], "outside": [1, 1], "lip": {"at": [0.5, 1], "pad": [4, 1e-6]}}}],
        "joints": [{"name": "wall", "kind": "clamped", "edges": ["ground", "p.s2=0"]}],
        "outputs": [{"kind": "position", "marker": "p.inside"}, {"kind": "position", "marker": "p.outside"}]});
    let lift = json!([{"name": "lift", "kind": "force", "marker": "p.lip", "value": [0, 0, 3.2]}]);
    let mut run = Run::at_rest(scene, &lift);
    for (name, published) in [("inside", 13.891), ("outside", 17.528)] {
        let found = run.read(&format!("p.{name}.position[3]"));
        assert!(
            (found / published - 1.0).abs() < 5e-3,
            "{name}: {found} for {published}"
        );
    }
}

/// A square on one edge under three times `D / a` at a free corner. Exudyn 1.13.6 (`crates/studies/exudyn/plates.py`): z of the corner at 0.67528
/// and 0.68068 for 4 and 8 elements a side, which tends to it.
#[test]
fn a_square_on_one_edge_converges_under_a_force_at_its_corner() {
    let corner = |elements: u32| {
        let mut scene = plate([1.0, 1.0], [elements; 2], 0.01, 0.3);
        hold(&mut scene, "clamped", &["s1=0"]);
        let force =
            json!([{"name": "F", "kind": "force", "marker": "p.corner", "value": [0, 0, 3]}]);
        Run::at_rest(scene, &force).read_all::<3>("p.corner.position")
    };
    let apart =
        |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
    let [coarse, middle, fine] = [2, 4, 8].map(corner);
    // The point force costs orders.
    let (first, second) = (apart(&coarse, &middle), apart(&middle, &fine));
    assert!(first > 4.0 * second && second < 2e-3, "{first} {second}");
    assert!(apart(&fine, &[0.6751, 0.9296, 0.6818]) < 5e-4, "{fine:?}");
}

/// The upper bounds of Ritz's method in A. W. Leissa, J. Sound Vib. 31 (1973), table C17, are within a hundredth.
#[test]
fn frequencies_of_a_square_on_one_edge_are_below_the_bounds_of_ritz() {
    let bounds = [3.4917, 8.5246, 21.429, 27.331, 31.111, 54.443];
    let mut scene = plate([1.0, 1.0], [8, 8], 0.01, 0.3);
    hold(&mut scene, "clamped", &["s1=0"]);
    scene["outputs"] = json!([{"kind": "natural_frequency", "count": bounds.len()}]);
    let mut run = Run::started(&scene);
    for (k, bound) in bounds.iter().enumerate() {
        let found = run.read(&format!("natural_frequency[{}]", k + 1));
        assert!(
            found < *bound && found > 0.99 * bound,
            "{k}: {found} below {bound}"
        );
    }
}

/// Errors of the lowest frequencies of a pinned square, `pi^2 (i^2 + j^2)`, fall with the fourth power of the size of elements.
#[test]
fn frequencies_converge_with_order_four() {
    let sums = [2.0, 5.0, 5.0, 8.0];
    let error = |elements: u32| {
        let mut scene = plate([1.0, 1.0], [elements; 2], 0.01, 0.3);
        hold(&mut scene, "pinned", &ALL);
        scene["outputs"] = json!([{"kind": "natural_frequency", "count": sums.len()}]);
        let mut run = Run::started(&scene);
        let off = sums.iter().enumerate().map(|(k, sum)| {
            (run.read(&format!("natural_frequency[{}]", k + 1)) / (sum * PI * PI) - 1.0).abs()
        });
        off.fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(4), error(8));
    assert!(coarse > 2_f64.powf(3.7) * fine, "{coarse:e} {fine:e}");
}

/// A free square of rubber that is thrown with bending, twist and spin.
fn thrown(elements: u32, spin: [f64; 3]) -> Value {
    let mut scene = plate([1.0, 1.0], [elements; 2], 0.01, 0.3);
    let body = &mut scene["bodies"][0];
    body["material"] = json!({"youngs_modulus": 1e8, "poisson_ratio": 0.3, "density": 1000});
    body["markers"] = json!({"far": [1, 1], "near": [1, 0], "middle": [0.5, 0.5]});
    // Velocity of the corner, which the field is beside; the spin is about the middle.
    let [p, q, r] = spin;
    let motion = json!({"velocity": [0.5 * r, -0.5 * r, 0.5 * (q - p)], "spin": [p, q, r],
        "deformation": ["0", "0", "3*(2*s1-1)^2 + 3*(2*s1-1)*(2*s2-1)"]});
    body["motion"] = motion;
    scene["outputs"] = json!([{"kind": "position", "marker": "p.far"}, {"kind": "position", "marker": "p.near"},
        {"kind": "velocity", "marker": "p.near"}, {"kind": "energy"}, {"kind": "momentum"}]);
    scene["method"] = json!({"integrator": "dopri853"});
    scene["accuracy"] = json!({"relative_tolerance": 1e-6});
    scene
}

/// Momenta in closed form, about the origin, and kinetic energy of the field. Places of corners after 0.2 s are those to which Exudyn 1.13.6 tends
/// (generalized-alpha method at 1 ms, 16 elements a side: within 2.7e-3).
#[test]
fn a_thrown_plate_keeps_its_momentum() {
    let mut run = Run::started(&thrown(4, [2.0, 1.0, 3.0]));
    let [x, y, z] = run.read_all("p.near.velocity");
    // Spin about the middle at (0.5, -0.5), and the field there: 3 - 3.
    for (found, exact) in [(x, 1.5), (y, 1.5), (z, -1.5)] {
        assert!((found - exact).abs() < 1e-12, "{x} {y} {z}");
    }
    let kinetic = run.read("energy.kinetic");
    assert!((kinetic / (283.0 / 12.0) - 1.0).abs() < 1e-3, "{kinetic}");
    let momenta = run.momenta();
    let exact = [0.0, 0.0, 10.0, 20.0 / 3.0, -25.0 / 6.0, 5.0];
    assert!(momenta.len() == exact.len(), "{:?}", run.names());
    for (found, exact) in momenta.iter().zip(exact) {
        assert!((found - exact).abs() < 1e-9, "{momenta:?}");
    }
    let energy = run.mechanical_energy();
    run.step(0.2);
    for (found, exact) in run.momenta().iter().zip(exact) {
        assert!((found - exact).abs() < 1e-7, "{:?}", run.momenta());
    }
    let kept = run.mechanical_energy() / energy - 1.0;
    assert!(kept.abs() < 1e-5, "{kept:e}");
    let wanted = [
        ("far", [0.590_43, 1.197_22, 0.221_99]),
        ("near", [1.167_63, 0.411_88, -0.012_34]),
    ];
    for (corner, wanted) in wanted {
        let found: [f64; 3] = run.read_all(&format!("p.{corner}.position"));
        for (found, wanted) in found.into_iter().zip(wanted) {
            assert!(
                (found - wanted).abs() < 1.2e-2,
                "{corner}: {found} for {wanted}"
            );
        }
    }
}

/// A stiff flat square has a moment about its normal that is twice that about each edge: its normal wobbles about the angular momentum `L` with
/// `L / A`.
#[test]
fn a_spinning_plate_wobbles_as_a_rigid_one() {
    let mut scene = plate([1.0, 1.0], [2, 2], 0.01, 0.3);
    scene["bodies"][0]["material"] =
        json!({"youngs_modulus": 1e12, "poisson_ratio": 0.3, "density": 100});
    let (p, r) = (0.6_f64, 1.0);
    scene["bodies"][0]["motion"] =
        json!({"velocity": [0.5 * r, -0.5 * r, -0.5 * p], "spin": [p, 0, r]});
    scene["outputs"] = json!([{"kind": "orientation", "marker": "p.middle"}]);
    scene["method"] = json!({"integrator": "radau"});
    scene["accuracy"] = json!({"relative_tolerance": 1e-7});
    let mut run = Run::started(&scene);
    // Angular momentum over `A`, and its direction.
    let momentum = [p, 0.0, 2.0 * r];
    let rate = p.hypot(2.0 * r);
    let axis = momentum.map(|part| part / rate);
    for t in [0.5, 1.4] {
        run.step(t);
        let (sine, cosine) = (rate * t).sin_cos();
        // The third axis rotated about `axis`.
        let across = [axis[1], -axis[0], 0.0];
        let exact: [f64; 3] = std::array::from_fn(|k| {
            let own = if k == 2 { cosine } else { 0.0 };
            own + across[k] * sine + axis[k] * axis[2] * (1.0 - cosine)
        });
        for (k, exact) in exact.into_iter().enumerate() {
            let found = run.read(&format!("p.middle.orientation[{}]", 3 * k + 3));
            assert!((found - exact).abs() < 1e-6, "{t} {k}: {found} for {exact}");
        }
    }
}
