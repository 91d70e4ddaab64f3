use glam::{Vec2, Vec3};

use super::*;
use crate::ErrorKind;
use crate::mesh::{self, Mesh, Part, PatternPiece, Unit, cloth_normals};

/// The step of UVs that come back to the bit.
const STEP: f32 = 1.0 / (1 << 22) as f32;

/// A front and a sleeve with its mirror image, gently curved, on UVs that are multiples of [`STEP`].
fn blouse() -> Mesh {
    let mut mesh = Mesh { uvs: Some(Vec::new()), ..Mesh::default() };
    for (index, name) in ["Front", "Left sleeve", "Right sleeve"].into_iter().enumerate() {
        let first = mesh.positions.len() as u32;
        for k in 0..12 {
            let (column, row) = ((k % 4) as f32, (k / 4) as f32);
            let p = Vec2::new(column * 0.1234567 - 0.7, row * 0.37654321 - 0.2 * index as f32);
            let uv = (p / STEP).round() * STEP;
            mesh.uvs.as_mut().unwrap().push(uv);
            mesh.positions.push(Vec3::new(p.x + index as f32, p.y, 0.1 * p.x * p.x));
            if column < 3.0 && row < 2.0 {
                let a = first + k;
                mesh.triangles.extend([[a, a + 1, a + 5], [a, a + 5, a + 4]]);
                mesh.triangle_parts.extend([index as u32; 2]);
            }
        }
        mesh.parts.push(Part { name: name.into(), takes_fabric: true, ..Part::default() });
    }
    let uv = |part: usize, k: usize| mesh.uvs.as_ref().unwrap()[12 * part + k];
    let armhole = |left: [Vec2; 2], partner: &str, right: [Vec2; 2]| Seam {
        name: "armhole".to_owned(),
        edge: left,
        partner: partner.to_owned(),
        partner_edge: right,
    };
    let (front, sleeve) = ([uv(0, 3), uv(0, 11)], [uv(1, 8), uv(1, 0)]);
    let patterns = [
        PatternPiece {
            grain: Some(90f32.to_radians()),
            mirror: None,
            seams: vec![armhole(front, "Left sleeve", sleeve)],
            uv_unit: Some(1.0),
        },
        PatternPiece {
            grain: Some(1.2345678),
            mirror: Some("Right sleeve".into()),
            seams: vec![armhole(sleeve, "Front", front)],
            uv_unit: Some(1.0),
        },
        PatternPiece { grain: Some(-0.1), mirror: Some("Left sleeve".into()), ..PatternPiece::default() },
    ];
    for (part, pattern) in mesh.parts.iter_mut().zip(patterns) {
        part.pattern = pattern;
    }
    mesh.normals = cloth_normals(&mesh.positions, &mesh.triangles);
    mesh.file_vertices = mesh.positions.len();
    mesh
}

fn saved_and_read(garment: &Garment, name: &str) -> Garment {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    super::garment(garment, &path).unwrap();
    Garment::new(mesh::read(&path, Unit::Metre).unwrap()).unwrap()
}

fn bits(uvs: &[Vec2]) -> Vec<[u32; 2]> {
    uvs.iter().map(|uv| (*uv + 0.0).to_array().map(f32::to_bits)).collect()
}

#[test]
fn a_glb_read_again_is_the_same_garment() {
    let before = Garment::new(blouse()).unwrap();
    assert!(before.notices.is_empty(), "{:?}", before.notices);
    let after = saved_and_read(&before, "blouse.GLB");
    assert!(after.notices.is_empty(), "{:?}", after.notices);
    assert_eq!(after.panels, before.panels);
    assert_eq!(after.panels[1].pattern.mirror, Some(2));
    assert_eq!(after.panels[0].pattern.seams[0].partner, 1);
    assert_eq!((&after.positions, &after.normals), (&before.positions, &before.normals));
    assert_eq!(after.triangles, before.triangles);
    assert_eq!(bits(&after.uvs), bits(&before.uvs));
}

#[test]
fn an_obj_read_again_has_the_same_panels_and_uvs() {
    let before = Garment::new(blouse()).unwrap();
    let after = saved_and_read(&before, "blouse.obj");
    let names: Vec<&str> = after.panels.iter().map(|panel| panel.name.as_str()).collect();
    assert_eq!(names, ["Front", "Left_sleeve", "Right_sleeve"]);
    // An OBJ's vertices are numbered as its faces come upon them: compare corner by corner.
    let corners = |garment: &Garment| -> (Vec<Vec3>, Vec<[u32; 2]>) {
        let corners = garment.triangles.as_flattened().iter().map(|&corner| corner as usize);
        let uvs: Vec<Vec2> = corners.clone().map(|corner| garment.uvs[corner]).collect();
        (corners.map(|corner| garment.positions[corner]).collect(), bits(&uvs))
    };
    assert_eq!(corners(&after), corners(&before));
    let folder = tempfile::tempdir().unwrap();
    garment(&Garment::new(blouse()).unwrap(), &folder.path().join("a.obj")).unwrap();
    let text = std::fs::read_to_string(folder.path().join("a.obj")).unwrap();
    assert!(text.contains("\n# panel Front grain_deg=90 uv_unit_m=1\n"), "{text}");
    assert!(text.contains("sewn to Left_sleeve"), "{text}");
}

#[test]
fn a_small_panel_has_16_bit_indices_and_a_large_one_32() {
    let component = |panels: &[usize]| -> Vec<u64> {
        let mut mesh = Mesh::default();
        for (part, &vertices) in panels.iter().enumerate() {
            let first = mesh.positions.len() as u32;
            // A fan: each further vertex is one triangle.
            let angle = |k: usize| k as f32 / vertices as f32;
            mesh.positions.push(Vec3::ZERO);
            mesh.positions.extend((1..vertices).map(|k| Vec3::new(angle(k).cos(), angle(k).sin(), 0.0)));
            mesh.triangles.extend((2..vertices as u32).map(|k| [first, first + k - 1, first + k]));
            mesh.triangle_parts.resize(mesh.triangles.len(), part as u32);
            mesh.parts.push(Part { name: part.to_string(), takes_fabric: true, ..Part::default() });
        }
        mesh.normals = vec![Vec3::Z; mesh.positions.len()];
        let mut bytes = Vec::new();
        write_glb(&Garment::new(mesh).unwrap(), &mut bytes).unwrap();
        let glb = gltf::binary::Glb::from_slice(&bytes).unwrap();
        let document: serde_json::Value = serde_json::from_slice(&glb.json).unwrap();
        let meshes = document["meshes"].as_array().unwrap().iter();
        let indices = meshes.map(|mesh| mesh["primitives"][0]["indices"].as_u64().unwrap() as usize);
        indices.map(|k| document["accessors"][k]["componentType"].as_u64().unwrap()).collect()
    };
    assert_eq!(component(&[5, 65535, 65536]), [5123, 5123, 5125]);
}

#[test]
fn what_cannot_be_saved_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let garment = Garment::new(blouse()).unwrap();
    let save = |garment: &Garment, name: &str| super::garment(garment, &folder.path().join(name));
    assert_eq!(save(&garment, "a.gltf").unwrap_err().kind(), ErrorKind::Unsupported);
    for name in ["a.glb", "a.obj"] {
        assert_eq!(save(&Garment::default(), name).unwrap_err().kind(), ErrorKind::Invalid);
        let mut short = garment.clone();
        short.normals.pop();
        assert_eq!(save(&short, name).unwrap_err().kind(), ErrorKind::Invalid);
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
