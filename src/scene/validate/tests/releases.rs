//! Releases of joints: when, and what may act on them.

use serde_json::{Value, json};

use super::check;

fn scene() -> Value {
    json!({"name": "let_go", "dimension": 2,
        "bodies": [{"name": "bob", "element": "rigid", "mass": 1, "inertia": 1, "position": [1, 0], "markers": {"p": [-1, 0]}}],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "bob.p"], "release_time": 1.5}],
        "motions": [], "loads": [], "inputs": [{"kind": "release", "joint": "pin"}]})
}

#[test]
fn a_joint_lets_go_where_nothing_acts_on_its_coordinates() {
    check(
        scene,
        r#"
        /name | "free" | accepted
        /joints/0/release_time | null | accepted
        /joints/0/release_time | -1 | joints[0].release_time
        /joints/0 | {"name": "pin", "kind": "revolute", "markers": ["ground", "bob.p"], "stiffness": 1} | joints[0]: expected nothing that acts on the coordinates of a joint that can be released, found a spring of its own
        /loads | [{"name": "motor", "kind": "torque", "joint": "pin", "value": 1}] | joints[0]: expected nothing that acts on the coordinates of a joint that can be released, found "motor"
        /loads | [{"name": "end", "kind": "joint_limit", "joint": "pin", "stiffness": 1, "upper": 1}] | joints[0]: expected nothing that acts on the coordinates of a joint that can be released, found "end"
        /latches | [{"name": "bolt", "joint": "pin"}] | joints[0]: expected nothing that acts on the coordinates of a joint that can be released, found "bolt"
        /inputs | [{"kind": "latch", "latch": "bolt"}] | inputs[0].latch: expected a latch of this scene
        /motions | [{"name": "drive", "kind": "angle", "joint": "pin", "value": "t"}] | joints[0]: expected nothing that acts on the coordinates of a joint that can be released, found "drive"
        /inputs | [{"kind": "torque", "joint": "pin"}, {"kind": "release", "joint": "pin"}] | joints[0]: expected nothing that acts on the coordinates of a joint that can be released, found "torque"
        /inputs/0/joint | "pen" | inputs[0].joint: expected a joint of this scene (pin), found "pen"; did you mean `pin`?
        /inputs/0/joint | null | inputs[0].joint: expected a name, found nothing
        /inputs/0/marker | "bob.p" | inputs[0].marker
        "#,
    );
}
