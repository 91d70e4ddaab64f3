use glam::Vec3;

use super::*;

#[test]
fn an_unknown_shape_is_told_the_known_ones() {
    let error = mesh("cube").unwrap_err().to_string();
    assert!(error.contains("'cube'") && NAMES.iter().all(|name| error.contains(name)), "{error}");
}

#[test]
fn shapes_are_sound_and_their_faces_agree_with_their_normals() {
    for name in NAMES {
        let mesh = mesh(name).unwrap();
        let count = mesh.positions.len();
        assert_eq!((mesh.normals.len(), mesh.uvs.as_ref().unwrap().len()), (count, count));
        assert_eq!(mesh.triangle_parts.len(), mesh.triangles.len());
        assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5), "{name}");
        let mut used = vec![false; count];
        for &triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|corner| corner as usize);
            let p = &mesh.positions;
            let face = (p[b] - p[a]).cross(p[c] - p[a]).try_normalize().unwrap();
            for corner in [a, b, c] {
                used[corner] = true;
                assert!(face.dot(mesh.normals[corner]) > 0.95, "{name} {}", p[corner]);
            }
            let uv = mesh.uvs.as_ref().unwrap();
            assert!(
                (uv[b] - uv[a]).perp_dot(uv[c] - uv[a]) > 0.0,
                "{name}: mirrored or no UV area at {}",
                p[a]
            );
        }
        assert!(used.iter().all(|&used| used), "{name} has vertices of no triangle");
        let reach = mesh.positions.iter().map(|p| p.length()).fold(0.0, f32::max);
        assert!((0.9..1.4).contains(&reach), "{name} reaches {reach} m");
    }
}

#[test]
fn areas_are_those_of_the_ideal_shapes() {
    use std::f32::consts::PI;
    let ideal = [
        ("sphere", 4.0 * PI),
        ("torus", 4.0 * PI * PI * 0.7 * 0.3),
        ("disc-radial", PI),
        ("cylinder", 2.0 * PI * 0.5 * 1.6),
    ];
    for (name, ideal) in ideal {
        let mesh = mesh(name).unwrap();
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|corner| mesh.positions[corner as usize]);
            (b - a).cross(c - a).length() / 2.0
        };
        let area: f32 = mesh.triangles.iter().map(area).sum();
        assert!((area / ideal - 1.0).abs() < 2e-3, "{name}: {area} for {ideal}");
    }
}

#[test]
fn the_sheet_is_true_to_length_along_its_grain() {
    let mesh = mesh("sheet").unwrap();
    assert!((18_000..22_000).contains(&mesh.triangles.len()));
    // Every first edge of a lower triangle runs along the grain.
    let uv = mesh.uvs.as_ref().unwrap();
    let along = |t: &&[u32; 3]| uv[t[0] as usize].y == uv[t[1] as usize].y;
    for t in mesh.triangles.iter().filter(along) {
        let [a, b] = [t[0] as usize, t[1] as usize];
        let ratio = mesh.positions[a].distance(mesh.positions[b]) / uv[a].distance(uv[b]);
        assert!((ratio - 1.0).abs() < 5e-3, "{ratio}");
    }
    let back: Vec<Vec3> = mesh.normals.iter().copied().filter(|n| n.z <= 0.0).collect();
    assert!(back.is_empty());
}

#[test]
fn every_shape_is_one_clean_panel() {
    for name in NAMES {
        let mesh = mesh(name).unwrap();
        let count = mesh.positions.len();
        let garment = crate::mesh::Garment::new(mesh).unwrap();
        assert_eq!((garment.panels.len(), garment.positions.len()), (1, count), "{name}");
        let flags = garment.panels[0].flags;
        assert!(!flags.mirrored && !flags.degenerate, "{name}: {flags:?}");
    }
}
