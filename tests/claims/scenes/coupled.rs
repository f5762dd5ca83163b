//! Sections that couple stretching, twist and bending.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use serde_json::json;

use super::space::array;
use super::tapers::{LENGTH, SHEAR, YOUNG, body, hung};
use crate::claims::specimen::Specimen;

/// Returns the specimens of rods, which serve beams too.
pub fn all() -> Vec<Specimen> {
    let mut all = vec![rope()];
    for axial in [[0.0; 3], [40.0, -60.0, 50.0]] {
        all.extend([false, true].map(|is_at_stations| coupled(is_at_stations, axial)));
    }
    all
}

/// A rope of wires untwists when it is pulled: `E A e + p k = F`, `p e + G J k = 0`. A rod whose elastic centre is off its line bends about
/// that under a moment, and its line, at `z` from it, stretches by `-z K`; a force through the elastic centre, on the line with its moment,
/// does not bend it.
fn rope() -> Specimen {
    let (area, second, torsion) = (2e-3, 4e-7, 5e-7);
    let (stiffness, rigidity) = (YOUNG * area, SHEAR * torsion);
    let section = |axial: [f64; 3], second: f64| {
        json!({"area": area, "second_moments": [second, second],
        "torsion_constant": torsion, "axial_coupling": axial})
    };
    let (twisting, off) = (17.0, 0.011);
    let eccentric = [0.0, stiffness * off, 0.0];
    let sections = [
        ("rope", section([twisting, 0.0, 0.0], second)),
        ("bow", section(eccentric, second + area * off * off)),
        ("tie", section(eccentric, second + area * off * off)),
    ];
    let bodies = sections
        .into_iter()
        .enumerate()
        .map(|(k, (name, section))| {
            let mut made = body(name, true, k as f64);
            made["section"] = section;
            made["axis"] = json!([0.0, 1.0, 0.0]);
            made
        });
    let (force, moment) = (60.0, 0.9);
    let mut scene = hung("rope", true, bodies.collect());
    scene["gravity"] = json!([0.0, 0.0, 0.0]);
    // The tangent is -z, the first axis y, the second x.
    scene["loads"] = json!([
        {"name": "pull", "kind": "force", "marker": "rope.tip", "value": [0.0, 0.0, -force]},
        {"name": "bend", "kind": "moment", "marker": "bow.tip", "value": [0.0, moment, 0.0]},
        {"name": "tension", "kind": "force", "marker": "tie.tip", "value": [0.0, 0.0, -force]},
        {"name": "shift", "kind": "moment", "marker": "tie.tip", "value": [0.0, force * off, 0.0]}]);
    let mut specimen = Specimen::new("rope", scene);
    let minor = stiffness * rigidity - twisting * twisting;
    let (stretch, twist) = (rigidity * force / minor, -twisting * force / minor);
    // About the tangent -z, by which y rotates towards x.
    let angle = twist * LENGTH;
    let curvature = moment / (YOUNG * second);
    let (bend, radius) = (curvature * LENGTH, (1.0 - off * curvature) / curvature);
    let claims = [
        ("rope.tip.position[3]", "m", -LENGTH * (1.0 + stretch)),
        ("rope.tip.orientation[2]", "", angle.sin()),
        ("rope.tip.orientation[5]", "", angle.cos()),
        (
            "bow.tip.position[1]",
            "m",
            1.0 - radius * (1.0 - bend.cos()),
        ),
        ("bow.tip.position[3]", "m", -radius * bend.sin()),
        ("tie.tip.position[1]", "m", 2.0),
        (
            "tie.tip.position[3]",
            "m",
            -LENGTH * (1.0 + force / stiffness),
        ),
    ];
    for (of, unit, value) in claims {
        specimen = specimen.claim_within(of, unit, value, 2e-6);
    }
    specimen
}

/// Under a dead moment along an eigenvector of its stiffness a rod of coupled sections bends to a helix about it, of the
/// rate moment over eigenvalue. Where stretching is coupled too there is no axial force: `C - c c^T / (E A)` is the stiffness, and the rod
/// stretches by `-c . k / (E A)`.
fn coupled(is_at_stations: bool, axial: [f64; 3]) -> Specimen {
    let (area, moments, torsion) = (2e-2, [3.0e-7, 7.0e-7], 5.0e-7);
    let (coupling, is_axial) = ([0.2, -0.3, 0.25], axial != [0.0; 3]);
    let mut section = json!({"area": area, "second_moments": moments, "torsion_constant": torsion, "coupling": coupling});
    if is_axial {
        section["axial_coupling"] = json!(axial);
    }
    let mut made = body("rod", true, 0.0);
    made["elements"] = json!(32);
    if is_at_stations {
        made["stations"] =
            json!([{"at": 0.0, "section": section}, {"at": 1.0, "section": section}]);
    } else {
        made["section"] = section;
    }
    made["axis"] = json!([0.0, 1.0, 0.0]);
    let [p, q, r] = coupling;
    let stiffness = Matrix3::new(
        SHEAR * torsion,
        p,
        q, //
        p,
        YOUNG * moments[0],
        r, //
        q,
        r,
        YOUNG * moments[1],
    );
    let axial = Vector3::from(axial);
    let eigen = (stiffness - axial * axial.transpose() / (YOUNG * area)).symmetric_eigen();
    let k = eigen.eigenvalues.imin();
    // In the axes of the section at the root: tangent -z, first axis y, second x.
    let own: Vector3<f64> = eigen.eigenvectors.column(k).into();

    let axes = Matrix3::from_columns(&[-Vector3::z(), Vector3::y(), Vector3::x()]);
    let own = own * own.iter().sum::<f64>().signum();
    let (way, rate) = (axes * own, 1.2);
    let stretch = 1.0 - axial.dot(&own) * rate / (YOUNG * area);
    let moment = way * rate * eigen.eigenvalues[k];
    let scene = json!({"name": "coupled", "dimension": 3, "bodies": [made], "initial": "static_equilibrium",
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.root"]}],
        "loads": [{"name": "end", "kind": "moment", "marker": "rod.tip", "value": array(moment)}],
        "accuracy": {"relative_tolerance": 1e-9},
        "outputs": [{"kind": "position", "marker": "rod.tip"}, {"kind": "orientation", "marker": "rod.tip"}]});
    let angle = rate * LENGTH;
    let tangent = -Vector3::z();
    let along = way * way.dot(&tangent);
    let tip = along * LENGTH
        + (tangent - along) * (angle.sin() / rate)
        + way.cross(&tangent) * ((1.0 - angle.cos()) / rate);
    let tip = tip * stretch;
    let turned = Rotation3::from_axis_angle(&Unit::new_normalize(way), angle) * axes;
    let title = match (is_axial, is_at_stations) {
        (false, true) => "coupled sections at stations",
        (false, false) => "coupled sections",
        (true, true) => "axially coupled sections at stations",
        (true, false) => "axially coupled sections",
    };
    let mut specimen = Specimen::new(title, scene);
    for row in 0..3 {
        for column in 0..3 {
            let of = format!("rod.tip.orientation[{}]", 3 * row + column + 1);
            specimen = specimen.claim_within(&of, "", turned[(row, column)], 2e-6);
        }
        let of = format!("rod.tip.position[{}]", row + 1);
        specimen = specimen.claim_within(&of, "m", tip[row], 2e-6);
    }
    specimen
}
