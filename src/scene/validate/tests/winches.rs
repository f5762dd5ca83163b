//! Cables that winches pay out: which, and what may act on them.

use serde_json::{Value, json};

use super::check;

fn scene() -> Value {
    json!({"name": "hoist", "dimension": 2,
        "bodies": [{"name": "rope", "element": "cable", "elements": 2, "material": {"youngs_modulus": 1e9, "density": 1e3},
                    "section": {"area": 1e-4, "second_moment": 0},
                    "shape": {"line": {"from": [0, 0], "to": [0, -2]}}, "markers": {"drum": 0, "inside": 0.4, "hook": 1}},
                   {"name": "load", "element": "rigid", "mass": 1, "inertia": 1, "position": [0, -2], "markers": {"eye": [0, 0]}}],
        "joints": [{"name": "fairlead", "kind": "revolute", "markers": ["ground", "rope.drum"]},
                   {"name": "hook", "kind": "revolute", "markers": ["rope.hook", "load.eye"]}],
        "motions": [{"name": "winch", "kind": "winch", "marker": "rope.drum", "value": "t"}],
        "loads": [], "inputs": [], "masses": [], "outputs": []})
}

#[test]
fn a_winch_pays_out_a_cable_at_its_end() {
    check(
        scene,
        r#"
        /name | "lift" | accepted
        /motions/0/value | {"input": 2} | accepted
        /motions/0/value | 0 | accepted
        /motions/0/value | 1 | motions[0].value: expected a length that begins at 0
        /motions/0/value | ["t", "t"] | motions[0].value: expected one value, found 2
        /motions/0/marker | "rope.hook" | accepted
        /motions/0/marker | "rope.inside" | motions[0].marker: expected a marker at an end of a cable that bends and stretches, found one at 0.4 of its length
        /motions/0/marker | "load.eye" | motions[0].marker: expected a marker at an end of a cable that bends and stretches, found "load.eye"
        /motions/0/joint | "hook" | motions[0].joint
        /bodies/0/model | "rigid" | motions[0].marker: expected a marker at an end of a cable that bends and stretches, found "rope.drum"
        /bodies/0/strain | "GreenLagrange_FrenetKappa" | motions[0].marker: expected a cable that is the same all along, in strains of kind thetaPrime, straight or without bending stiffness, found another `strain` than thetaPrime
        /bodies/0/section/second_moment | 1e-9 | accepted
        /bodies/0/shape | {"arc": {"from": [0, 0], "to": [0, -2], "length": 2.5}} | accepted
        /outputs | [{"kind": "reaction", "motion": "winch"}] | outputs[0].motion: expected a motion other than a winch, whose force is `axial_force` of its marker, found "rope.drum"
        "#,
    );
}

#[test]
fn what_acts_between_its_ends_acts_along_it() {
    check(
        scene,
        r#"
        /rotation | 1 | motions[0]: expected a frame that stands still beside a winch, found `rotation`
        /initial | "steady" | motions[0]: expected no steady motion at the start beside a winch, found one
        /motions | [{"name": "one", "kind": "winch", "marker": "rope.drum", "value": "t"}, {"name": "two", "kind": "winch", "marker": "rope.hook", "value": "t"}] | motions[1]: expected one winch for a cable, found two
        /loads | [{"name": "pull", "kind": "force", "marker": "rope.hook", "value": [1, 0]}] | accepted
        /loads | [{"name": "pull", "kind": "force", "marker": "rope.inside", "value": [1, 0]}] | motions[0]: expected a cable at whose markers between its ends nothing acts, and without masses, since a winch pays it out, found
        /loads | [{"name": "wind", "kind": "distributed_force", "body": "rope", "value": [1, 0]}] | accepted
        /loads | [{"name": "sea", "kind": "fluid", "body": "rope", "density": 1000}] | accepted
        /loads | [{"name": "sea", "kind": "fluid", "body": "rope", "density": 1000, "added_mass": 1}] | loads[0].added_mass: expected 0 along a cable that a winch pays out, which slides past fluid that it does not take along, found 1
        /loads | [{"name": "bed", "kind": "contact", "body": "rope", "surface": {"plane": {"point": [0, -3], "normal": [0, 1]}}, "stiffness": 1e3}] | accepted
        /inputs | [{"kind": "distributed_force", "body": "rope"}] | accepted
        /masses | [{"marker": "rope.hook", "mass": 1}] | motions[0]: expected a cable at whose markers between its ends nothing acts, and without masses, since a winch pays it out, found "rope.hook"
        "#,
    );
}
