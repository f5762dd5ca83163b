//! Bytes as a saved state: refused, or restored and simulated, and never in the way of what follows.

use crate::saved::{SCENES, sealed, written};
use crate::support::{Instance, Status, Unit, call};

/// Steps, outputs and the end of an instance in whatever state it is.
fn used(instance: &Instance<'_>) {
    let c = instance.component;
    let _ = call!(fmi2ExitInitializationMode, c);
    let time = instance.unit.reference("time");
    for _ in 0..3 {
        let mut now = 0.0;
        let _ = call!(fmi2GetReal, c, &time, 1, &mut now);
        let _ = instance.step(now, 1e-3);
        for reference in 0..instance.unit.variables.len() as u32 {
            let mut value = 0.0;
            if call!(fmi2GetReal, c, &reference, 1, &mut value) == Status::Ok {
                assert!(value.is_finite(), "{value} of reference {reference}");
            }
        }
    }
    let _ = call!(fmi2Terminate, c);
}

/// Puts bytes through all of it.
pub fn put_through(data: &[u8]) {
    let (scene, body) = data.split_first().unwrap_or((&0, &[]));
    let text = SCENES[usize::from(*scene) % SCENES.len()];
    let unit = Unit::of(text);
    let instance = Instance::new(&unit);
    let fresh = instance.fingerprint();
    assert_eq!(instance.deserialize(body), None, "without its checksum");
    if let Some(state) = instance.deserialize(&sealed(&fresh, body, &written(text))) {
        let bare = Instance::bare(&unit);
        let restored = [&instance, &bare].map(|instance| instance.restore(state));
        assert_eq!(restored[0], restored[1]);
        if restored == [Status::Ok; 2] {
            let bytes = instance.serialize(state);
            assert_eq!(instance.fingerprint(), bytes);
            assert_eq!(bare.fingerprint(), bytes);
            used(&instance);
        } else {
            assert_eq!(instance.fingerprint(), fresh, "changed though refused");
        }
        instance.free(state);
    }
    assert_eq!(call!(fmi2Reset, instance.component), Status::Ok);
    assert_eq!(instance.fingerprint(), fresh);
    instance.start();
}
