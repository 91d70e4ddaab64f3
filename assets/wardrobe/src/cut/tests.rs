#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

use super::*;

fn shipped(name: &str) -> Pattern {
    let file = format!("{}/patterns/{name}.json", env!("CARGO_MANIFEST_DIR"));
    Pattern::read(Path::new(&file)).unwrap()
}

/// The smallest corner of any triangle, degrees.
fn least_angle(garment: &CutGarment) -> f64 {
    let of_triangle = |piece: &CutPiece, triangle: &[u32; 3]| {
        let c = triangle.map(|v| piece.flat[v as usize]);
        let angle = |i: usize| (c[(i + 1) % 3] - c[i]).angle_to(c[(i + 2) % 3] - c[i]).to_degrees();
        angle(0).min(angle(1)).min(angle(2))
    };
    let all =
        garment.pieces.iter().flat_map(|piece| piece.triangles.iter().map(move |t| of_triangle(piece, t)));
    all.fold(180.0, f64::min)
}

#[test]
fn the_light_garments_have_no_slivers() {
    for name in ["square", "scarf", "t-shirt", "a-line-skirt", "bias-skirt"] {
        let least = least_angle(&cut(&shipped(name), 0.012).unwrap());
        assert!(least > 20.0, "{name}: {least}");
    }
}
