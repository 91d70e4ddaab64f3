//! Every input that a fuzzer once broke a reader with, again.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

use studio_tests::fuzz_targets::TARGETS;

/// One folder per target that has ever failed.
const CRASHES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/crashes");

#[test]
fn inputs_that_once_failed_are_refused_or_read() {
    let mut fed = 0;
    for folder in entries(Path::new(CRASHES)) {
        let name = folder.file_name().unwrap().to_str().unwrap();
        let (_, target) = TARGETS.iter().find(|(known, _)| *known == name).expect("a folder per target");
        for input in entries(&folder) {
            target(&std::fs::read(input).unwrap());
            fed += 1;
        }
    }
    assert!(fed > 0, "the folder of crashes is empty");
}

fn entries(folder: &Path) -> impl Iterator<Item = std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    entries.map(|entry| entry.unwrap().path())
}

#[test]
fn every_target_stands_nothing_and_noise() {
    for (_, target) in TARGETS {
        target(&[]);
        target(&[0; 4096]);
        target(b"{\"version\": 1e999, \"asset\": [[[[]]]]}");
        target("v 0 0 0\nf 1 1 1\nf -1 99999999999 1\u{0}\n".as_bytes());
    }
}
