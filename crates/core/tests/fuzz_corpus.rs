//! The bodies of the fuzz targets on the bytes that are kept in `fuzz/corpus`, and on bytes that look random.

mod bodies;

use bodies::BODIES;
use std::fs;
use std::path::Path;

#[test]
fn the_kept_bytes_pass() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus");
    for (name, body) in BODIES {
        let files = fs::read_dir(corpus.join(name)).expect("each target has a folder");
        let mut count = 0;
        for file in files {
            body(&fs::read(file.expect("a file").path()).expect("bytes"));
            count += 1;
        }
        assert!(count > 0, "{name} has no corpus");
    }
}

#[test]
fn random_bytes_pass() {
    let mut state = 1u64;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    };
    for (name, body) in BODIES {
        for k in 0..2000 {
            let data: Vec<u8> = (0..random() % 160).map(|_| (random() >> 20) as u8).collect();
            let result = std::panic::catch_unwind(|| body(&data));
            assert!(result.is_ok(), "{name} fails on number {k}: {data:?}");
        }
    }
}
