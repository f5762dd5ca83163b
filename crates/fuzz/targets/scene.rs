//! Bytes as a scene.
#![no_main]

#[path = "../inputs/scene.rs"]
mod scene;

libfuzzer_sys::fuzz_target!(|data: &[u8]| scene::put_through(data));
