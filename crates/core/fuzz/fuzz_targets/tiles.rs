//! `tiles` of `tests/bodies` on bytes that cover more and more code.

#![no_main]

#[path = "../../tests/bodies/mod.rs"]
#[allow(dead_code)]
mod bodies;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| bodies::run("tiles", data));
