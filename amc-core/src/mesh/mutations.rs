//! Spoilt copies of a file, the same ones every time.

use super::Mesh;
use crate::pseudo_random::PseudoRandom;

/// Calls `look` with `count` mutations of `bytes`: bytes changed, removed, doubled, cut short.
pub(super) fn each(bytes: &[u8], count: u32, mut look: impl FnMut(&[u8])) {
    let mut numbers = PseudoRandom::new(0);
    let mut random = |below: usize| numbers.below(below);
    const TELLING: &[u8] = b"0123456789-/.eE \n\\#{}[]\":,\0\xFFvftn";
    for _ in 0..count {
        let mut spoilt = bytes.to_vec();
        for _ in 0..1 + random(4) {
            let at = random(spoilt.len());
            match random(6) {
                0 | 1 if !spoilt.is_empty() => spoilt[at] = TELLING[random(TELLING.len())],
                2 if !spoilt.is_empty() => spoilt[at] ^= 1 << random(8),
                3 if !spoilt.is_empty() => {
                    let end = (at + 1 + random(12)).min(spoilt.len());
                    spoilt.drain(at..end);
                }
                4 => {
                    let end = (at + 1 + random(40)).min(spoilt.len());
                    let copy = spoilt[at..end].to_vec();
                    let to = random(spoilt.len());
                    spoilt.splice(to..to, copy);
                }
                _ => spoilt.truncate(spoilt.len() - random(spoilt.len() / 8)),
            }
        }
        look(&spoilt);
    }
}

/// What the documentation of [`Mesh`] promises.
pub(super) fn assert_checked(mesh: &Mesh) {
    let count = mesh.positions.len();
    assert_eq!(mesh.normals.len(), count);
    assert!(mesh.uvs.as_ref().is_none_or(|uvs| uvs.len() == count && uvs.iter().all(|uv| uv.is_finite())));
    assert!(mesh.positions.iter().all(|p| p.is_finite()));
    assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-3));
    assert!(!mesh.triangles.is_empty() && mesh.triangles.len() == mesh.triangle_parts.len());
    assert!(mesh.triangles.as_flattened().iter().all(|&i| (i as usize) < count));
    assert!(mesh.triangles.iter().all(|[a, b, c]| a != b && b != c && c != a));
    assert!(mesh.triangle_parts.iter().all(|&part| (part as usize) < mesh.parts.len()));
}
