//! Scenes whose saved states are fuzzed, and what of a state's bytes the fuzzer sees: what stands between the header and the
//! scene.

use flexbody::scene::Scene;
use sha2::{Digest, Sha256};

use crate::support;

/// A flexible pendulum; rigid bodies with constraints, and a trolley that inputs drive; rigid bodies of space.
pub const SCENES: [&str; 3] = [
    support::SCENE,
    include_str!("crane.json"),
    include_str!("arm.json"),
];

/// Bytes of what says whose state it is: magic, version, GUID.
const HEADER: usize = 8 + 4 + 38;
/// Bytes of the checksum.
const HASH: usize = 32;

/// A scene as its states hold it.
pub fn written(scene: &str) -> String {
    Scene::from_json(scene).expect("a valid scene").to_json()
}

/// Returns the part of a saved state that the fuzzer changes, without header, hash and scene.
#[allow(dead_code, reason = "for the program that writes seeds")]
pub fn opened<'a>(state: &'a [u8], scene: &str) -> &'a [u8] {
    &state[HEADER..state.len() - HASH - scene.len()]
}

/// A state in bytes with the header and the scene of another and a checksum that fits, so that the
/// fuzzer gets beyond them.
pub fn sealed(other: &[u8], body: &[u8], scene: &str) -> Vec<u8> {
    let mut bytes = [&other[..HEADER], body, scene.as_bytes()].concat();
    let hash = Sha256::digest(&bytes);
    bytes.extend(hash);
    bytes
}
