//! What every fuzz target links: an allocator that takes an absurd allocation for a crash.

#[path = "../../src/fuzz_targets.rs"]
pub mod fuzz_targets;

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::Once;

/// The largest single allocation that an input of 64 KiB may cause, bytes.
const LIMIT: usize = 256 << 20;

struct Bounded;

// SAFETY: every call goes to the system's allocator unchanged; the size is only looked at.
unsafe impl GlobalAlloc for Bounded {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        check(layout.size());
        // SAFETY: the caller's promises are passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        check(layout.size());
        // SAFETY: the caller's promises are passed on.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        check(size);
        // SAFETY: the caller's promises are passed on.
        unsafe { System.realloc(pointer, layout, size) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promises are passed on.
        unsafe { System.dealloc(pointer, layout) }
    }
}

fn check(size: usize) {
    if size > LIMIT {
        eprintln!("an allocation of {size} bytes");
        // Unwinding out of an allocator is not allowed.
        std::process::abort();
    }
}

#[global_allocator]
static ALLOCATOR: Bounded = Bounded;

/// Feeds `bytes` to `target`; naming this function is what links the allocator.
pub fn feed(target: fn(&[u8]), bytes: &[u8]) {
    static HOOK: Once = Once::new();
    // libFuzzer's hook ends the process at every panic, those of other people's decoders too, which the readers catch.
    HOOK.call_once(|| drop(std::panic::take_hook()));
    if std::panic::catch_unwind(|| target(bytes)).is_err() {
        std::process::abort();
    }
}
