//! A thousand instances, each through a whole life, for AddressSanitizer to watch: what is not given
//! back at the end is a leak.

#[path = "../../../tests/abi/support.rs"]
#[allow(dead_code, reason = "shared with the tests of the C interface")]
mod support;

use support::{Instance, Status, Unit, call};

const LIVES: usize = 1000;

fn main() {
    let unit = Unit::new();
    for _ in 0..LIVES {
        let instance = Instance::started(&unit);
        instance.run(0, 2);
        let state = instance.save();
        let bytes = instance.serialize(state);
        let expected = instance.run(2, 3);
        assert_eq!(instance.restore(state), Status::Ok);
        instance.free(state);
        let state = instance.deserialize(&bytes).expect("its own bytes");
        assert_eq!(instance.restore(state), Status::Ok);
        instance.free(state);
        assert_eq!(instance.run(2, 3), expected);
        assert_eq!(call!(fmi2Terminate, instance.component), Status::Ok);
    }
    println!("{LIVES} lives");
}
