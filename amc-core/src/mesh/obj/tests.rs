use super::*;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn fault(text: &str) -> String {
    parse(text.as_bytes()).unwrap_err().to_string()
}

#[test]
fn quads_polygons_and_relative_indices_become_triangles() {
    let text =
        format!("{SQUARE}v 0.5 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\nf -5 -4 -3 -1 -2\n");
    let mesh = parse(text.as_bytes()).unwrap();
    assert_eq!((mesh.triangles.len(), mesh.file_vertices), (5, 5));
    let total: f32 = mesh
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
            0.5 * (b - a).cross(c - a).z
        })
        .sum();
    assert!((total - 2.5).abs() < 1e-6);
    // The second face has no UVs: it must not get the first one's.
    let uvs = mesh.uvs.unwrap();
    assert!(mesh.triangles[2..].as_flattened().iter().all(|&i| uvs[i as usize] == Vec2::ZERO));
    assert!(
        mesh.triangles[..2]
            .as_flattened()
            .iter()
            .all(|&i| uvs[i as usize] == mesh.positions[i as usize].truncate())
    );
}

#[test]
fn groups_objects_and_materials_make_parts() {
    let text = format!(
        "mtllib none.mtl\n{SQUARE}o suit\ng sleeve\nusemtl wool\nf 1 2 3\nusemtl silk\nf 1 3 4\n\
         g shirt_buttons\nf 1 2 4\ng sleeve\nusemtl wool\nf 2 3 4\no hat\nf 1 2 3\n"
    );
    let mesh = parse(text.as_bytes()).unwrap();
    let names: Vec<&str> = mesh.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["sleeve wool", "sleeve silk", "shirt_buttons", "hat"]);
    assert_eq!(
        mesh.parts.iter().map(|part| part.takes_fabric).collect::<Vec<_>>(),
        [true, true, false, true]
    );
    assert_eq!(mesh.triangle_parts, [0, 0, 1, 2, 3]);
}

#[test]
fn unusual_but_valid_lines_are_read() {
    let text = b"\xEF\xBB\xBF# \xFF\r\nv 0 0 0 1 0.5 0.5 0.5\r\nv 1 0 0 1.0 # w\r\n  v\t1 1 \\\r\n 0\r\n\
        vp 1 2\nvn 0 0 2\ng \xC3\x28 caf\xC3\xA9\0\nl 1 2 3\np 1\nf 1 2\nf 1//1 2//1 3//1 1//1 # closed\nbevel on";
    let mesh = parse(text).unwrap();
    assert_eq!(mesh.triangles.len(), 1);
    assert_eq!(mesh.normals, [Vec3::Z; 3]);
    assert_eq!(mesh.parts[0].name, "\u{FFFD}( café");
    assert!(
        mesh.notices.iter().any(|notice| notice == "3 points and lines were left out"),
        "{:?}",
        mesh.notices
    );
}

#[test]
fn faults_name_their_line() {
    for (line, what) in [
        ("v 1 2", "three numbers"),
        ("v 1 2 x", "no number: x"),
        ("v 1 2 nan", "not a finite number"),
        ("v 1 -inf 2", "not a finite number"),
        ("v 1 1e30 2", "beyond the limit"),
        ("vt", "a number or two"),
        ("vt nan 0", "not a finite number"),
        ("vn 1 0", "three numbers"),
        ("f", "without corners"),
        ("f 1 2 5", "vertex 5, of 4 so far"),
        ("f 1 2 0", "vertex 0, of 4 so far"),
        ("f 1 2 -5", "vertex -5, of 4 so far"),
        ("f 1 2 -9223372036854775808", "of 4 so far"),
        ("f 1 2 9223372036854775807", "of 4 so far"),
        ("f 1 2 99999999999999999999", "no face corner"),
        ("f 1/1 2/1 3/1", "UV 1, of 0 so far"),
        ("f 1//1 2//1 3//1", "normal 1, of 0 so far"),
        ("f 1 2 3/////", "no face corner"),
        ("f 1 2 /3", "UV 3, of 0 so far"),
        ("f 1 2 b", "no face corner"),
    ] {
        let message = fault(&format!("{SQUARE}{line}\nf 1 2 3\n"));
        assert!(message.starts_with("line 5: ") && message.contains(what), "{line}: {message}");
    }
    let many = "1 2 ".repeat(3000);
    assert!(fault(&format!("{SQUARE}f {many}\n")).contains("more than 4096 corners"));
    assert_eq!(fault("v 1 2 3\n"), "a mesh of one point: holds no triangles");
    assert_eq!(fault(""), "holds no vertices and no triangles");
    assert_eq!(fault(&format!("{SQUARE}f 1 1 1\n")), "holds 4 vertices but no triangles");
}

#[test]
fn no_mutation_panics() {
    let text = format!(
        "{SQUARE}v 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\no a\ng b\nusemtl c\nf 1/1/1 2/2/1 3/3/1\n\
         f 1 2 3 4\nf -1//-1 -2//-1 -3//-1\nl 1 2\nf 1 2 3 4 \\\n 5\n"
    );
    crate::mesh::mutations::each(text.as_bytes(), 20_000, |bytes| {
        if let Ok(mesh) = parse(bytes) {
            crate::mesh::mutations::assert_checked(&mesh);
            let _ = crate::mesh::Garment::new(mesh);
        }
    });
}
