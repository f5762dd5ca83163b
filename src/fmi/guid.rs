//! The GUID of an FMU: a fingerprint of its scene, its variables and the library's version, so
//! that a library never runs with the description of another model.

use sha2::{Digest, Sha256};

use crate::scene::Scene;
use crate::simulation::Variable;

/// The GUID of a scene, as `{xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx}`.
pub fn guid(scene: &Scene, variables: &[Variable]) -> String {
    let mut hash = Sha256::new();
    // A separator that no part contains keeps different lists from running into one text.
    let mut add = |part: &str| {
        hash.update(part.as_bytes());
        hash.update([0]);
    };
    add(env!("CARGO_PKG_VERSION"));
    add(&scene.to_json());
    for variable in variables {
        add(&variable.name);
    }
    let hex: String = hash.finalize()[..16]
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect();
    let groups = [
        &hex[..8],
        &hex[8..12],
        &hex[12..16],
        &hex[16..20],
        &hex[20..],
    ];
    format!("{{{}}}", groups.join("-"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::example;
    use crate::simulation::variables;

    #[test]
    fn it_has_the_form_of_a_guid_and_follows_the_scene() {
        let scene = example();
        let first = guid(&scene, &variables(&scene));
        assert_eq!(first.len(), 38);
        assert_eq!(first, guid(&scene, &variables(&scene)));
        let dashes: Vec<usize> = first.match_indices('-').map(|(at, _)| at).collect();
        assert_eq!(dashes, [9, 14, 19, 24]);
        let mut other = scene.clone();
        other.gravity[1] = -1.62;
        assert_ne!(first, guid(&other, &variables(&other)));
    }
}
