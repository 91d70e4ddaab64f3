use std::f32::consts::FRAC_PI_2;

use glam::{Quat, Vec2, Vec3};

use super::*;
use crate::ErrorKind;
use crate::direction::tests::{degrees_between, flat, garment_of};
use crate::direction::{self, Field, Source};
use crate::shape;

fn direction(source: Source, degrees: f32) -> Direction {
    Direction { source, angle: degrees.to_radians() }
}

/// Four panels: as drawn, mirrored, sheared, and a torus; with angles and sources of all kinds.
fn garment() -> (Garment, Vec<Direction>) {
    let tilt = Quat::from_euler(glam::EulerRot::XYZ, 0.4, -0.7, 1.1);
    let garment = garment_of(&[
        flat(tilt, |p| p),
        flat(tilt, |p| Vec2::new(-p.x, p.y)),
        flat(tilt, |p| Vec2::new(p.x + 0.3 * p.y, -0.5 * p.y)),
        shape::mesh("torus").unwrap(),
    ]);
    let directions = vec![
        direction(Source::Gradient, 30.0),
        direction(Source::Gradient, 45.0),
        direction(Source::Yarn, 90.0),
        direction(Source::Yarn, -37.5),
    ];
    (garment, directions)
}

fn exported(name: &str) -> (Garment, Tangents, Vec<u8>) {
    let (garment, directions) = garment();
    let made = direction::tangents(&garment, &directions).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    tangents(&garment, &made, &directions, &[], &path).unwrap();
    (garment, made, file::read(&path, 1 << 26).unwrap())
}

/// The tangent at one corner of a flat triangle as a program makes it from UVs with v up: dP/du.
fn dp_du(p: [Vec3; 3], uv: [Vec2; 3]) -> Vec3 {
    let (e, f) = (uv[1] - uv[0], uv[2] - uv[0]);
    ((p[1] - p[0]) * f.y - (p[2] - p[0]) * e.y) / e.perp_dot(f)
}

#[test]
fn a_glb_read_back_has_the_directions_and_the_frames() {
    let (garment, made, bytes) = exported("out.GLB");
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(&bytes).unwrap();
    let blob = blob.unwrap();
    assert_eq!(document.meshes().count(), 4);
    for (index, mesh) in document.meshes().enumerate() {
        assert_eq!(mesh.primitives().len(), 1);
        let primitive = mesh.primitives().next().unwrap();
        let reader = primitive.reader(|_| Some(&blob));
        let positions: Vec<Vec3> = reader.read_positions().unwrap().map(Vec3::from).collect();
        let normals: Vec<Vec3> = reader.read_normals().unwrap().map(Vec3::from).collect();
        let tangents: Vec<[f32; 4]> = reader.read_tangents().unwrap().collect();
        // Back to v up.
        let up = |uvs: gltf::mesh::util::ReadTexCoords<'_>| -> Vec<Vec2> {
            uvs.into_f32().map(|[u, v]| Vec2::new(u, 1.0 - v)).collect()
        };
        let turned = up(reader.read_tex_coords(0).unwrap());
        let drawn = up(reader.read_tex_coords(1).unwrap());
        let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
        let bounds = primitive.bounding_box();
        assert!(
            positions.iter().all(|p| p.cmpge(bounds.min.into()).all() && p.cmple(bounds.max.into()).all())
        );

        let range =
            garment.panels[index].triangles.start as usize..garment.panels[index].triangles.end as usize;
        let old: Vec<u32> = garment.triangles[range].as_flattened().to_vec();
        assert_eq!(old.len(), indices.len());
        for (&new, &old) in indices.iter().zip(&old) {
            let (new, old) = (new as usize, old as usize);
            assert_eq!((positions[new], normals[new]), (garment.positions[old], garment.normals[old]));
            assert!((drawn[new] - garment.uvs[old]).length() < 1e-5);
            let [x, y, z, w] = tangents[new];
            assert!(degrees_between(Vec3::new(x, y, z), made.vectors[old]) < 0.1);
            assert_eq!(w, [1.0, -1.0, -1.0, 1.0][index]);
        }
        for corners in indices.as_chunks::<3>().0 {
            let corners = corners.map(|corner| corner as usize);
            let p = corners.map(|corner| positions[corner]);
            let uv = corners.map(|corner| turned[corner]);
            let [x, y, z, w] = tangents[corners[0]];
            let (normal, tangent) = (normals[corners[0]], Vec3::new(x, y, z));
            // glTF: cross(normal, tangent) * w is the way texture rows go up.
            let up = dp_du(p, uv.map(|uv| Vec2::new(uv.y, -uv.x)));
            assert!((normal.cross(tangent) * w).dot(up) > 0.0);
            // Who makes tangents from the first UVs finds the same; exact where the panel is flat and the source agrees.
            let off = degrees_between(dp_du(p, uv), tangent);
            assert!(off < if index == 3 { 3.0 } else { 0.1 }, "panel {index}: {off}");
        }
    }
}

#[test]
fn a_glb_says_what_its_panels_are() {
    let (_, _, bytes) = exported("out.glb");
    let glb = gltf::binary::Glb::from_slice(&bytes).unwrap();
    let document: serde_json::Value = serde_json::from_slice(&glb.json).unwrap();
    let extras = |index: usize| &document["meshes"][index]["primitives"][0]["extras"];
    assert_eq!((&extras(1)["id"], &extras(1)["angle_deg"]), (&"id1".into(), &45.0.into()));
    assert_eq!((&extras(3)["name"], &extras(3)["source"]), (&"torus".into(), &"yarn".into()));
    assert_eq!(extras(3)["angle_deg"], -37.5);
    assert_eq!(document["nodes"][3]["name"], "torus");
    assert!(document["asset"]["generator"].as_str().unwrap().starts_with("AMC Studio"));
    for accessor in document["accessors"].as_array().unwrap() {
        let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        assert_eq!(view["byteOffset"].as_u64().unwrap() % 4, 0);
    }
}

#[test]
fn an_obj_carries_the_directions_in_its_uvs() {
    let (garment, made, bytes) = exported("out.obj");
    let options = tobj::LoadOptions { single_index: true, ..Default::default() };
    let (models, _) = tobj::load_obj_buf(&mut &bytes[..], &options, |_| Ok(Default::default())).unwrap();
    assert_eq!(models.len(), 4);
    for (model, panel) in models.iter().zip(&garment.panels).take(3) {
        let mesh = &model.mesh;
        let old = &garment.triangles[panel.triangles.start as usize..panel.triangles.end as usize];
        for (corners, old) in mesh.indices.as_chunks::<3>().0.iter().zip(old) {
            let corners = corners.map(|corner| corner as usize);
            let p = corners.map(|k| Vec3::from_slice(&mesh.positions[3 * k..]));
            let uv = corners.map(|k| Vec2::from_slice(&mesh.texcoords[2 * k..]));
            assert!((p[1] - garment.positions[old[1] as usize]).length() < 1e-6);
            assert!(degrees_between(dp_du(p, uv), made.vectors[old[0] as usize]) < 0.1);
        }
    }
}

#[test]
fn a_json_lists_panels_and_vertices() {
    let (garment, made, bytes) = exported("out.json");
    let document: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
    let panels = document["panels"].as_array().unwrap();
    assert_eq!((panels.len(), panels[0]["angle_deg"].as_f64()), (4, Some(30.0)));
    let vector = |value: &serde_json::Value| -> Vec3 { serde_json::from_value(value.clone()).unwrap() };
    assert!(degrees_between(vector(&panels[1]["mean_direction"]), made.vectors[49]) < 0.1);
    // Around the ring the directions cancel; what is left is along its axis.
    assert!(degrees_between(vector(&panels[3]["mean_direction"]), Vec3::Z) < 3.0);
    let count = panels[3]["vertices"].as_u64().unwrap() as usize;
    assert_eq!(count, garment.positions.len() - 3 * 49);
    assert_eq!(panels[3]["tangents"].as_array().unwrap().len(), count);
    assert_eq!(vector(&panels[3]["positions"][0]), garment.positions[3 * 49]);
    assert_eq!(vector(&panels[3]["tangents"][0]), made.vectors[3 * 49]);
}

#[test]
fn what_a_format_cannot_hold_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (garment, mut directions) = garment();
    let made = direction::tangents(&garment, &directions).unwrap();
    let save = |name: &str, directions: &[Direction]| {
        tangents(&garment, &made, directions, &[], &folder.path().join(name))
    };
    assert_eq!(save("out.fbx", &directions).unwrap_err().kind(), ErrorKind::Unsupported);
    assert_eq!(save("out", &directions).unwrap_err().kind(), ErrorKind::Unsupported);
    assert_eq!(save("out.glb", &directions[1..]).unwrap_err().kind(), ErrorKind::Invalid);
    directions[2] = direction(Source::Field(Field::Along { direction: Vec3::X }), FRAC_PI_2);
    let error = save("out.obj", &directions).unwrap_err();
    assert!(error.kind() == ErrorKind::Unsupported && error.to_string().contains("id2"), "{error}");
    save("out.glb", &directions).unwrap();
    let empty =
        tangents(&Garment::default(), &Tangents::default(), &[], &[], &folder.path().join("empty.glb"));
    assert_eq!(empty.unwrap_err().kind(), ErrorKind::Invalid);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}
