//! WGSL sources: found, composed by `#import`, validated.
