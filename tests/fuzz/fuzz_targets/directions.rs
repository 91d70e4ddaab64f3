#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| studio_fuzz::feed(studio_fuzz::fuzz_targets::directions, bytes));
