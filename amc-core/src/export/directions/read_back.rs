//! A GLB of directions, read by the rules of those who will read it, against what trigonometry says of flat panels.

use glam::{Mat2, Quat, Vec2, Vec3};
use serde_json::Value;

use super::*;
use crate::direction::tests::{degrees_between, flat, garment_of};
use crate::direction::{self, Field, Orientation};
use crate::mesh;

/// The bound, degrees.
const BOUND: f32 = 0.1;

/// A flat panel of the test garment.
struct Case {
    /// From the places on the panel to its UVs.
    to_uv: Mat2,
    direction: Direction,
    /// 1 in the UVs, metres, where the file says so.
    uv_unit: Option<f32>,
}

fn case(to_uv: Mat2, source: Source, degrees: f32) -> Case {
    Case { to_uv, direction: Direction { source, angle: degrees.to_radians() }, uv_unit: None }
}

fn cases() -> Vec<Case> {
    let mirrored = Mat2::from_diagonal(Vec2::new(-1.0, 1.0));
    let sheared = Mat2::from_cols(Vec2::X, Vec2::new(0.3, 1.0));
    let drawn_out = Mat2::from_diagonal(Vec2::new(0.1, 0.4));
    let mut cases: Vec<Case> =
        [0.0, 30.0, 45.0, 90.0].map(|degrees| case(Mat2::IDENTITY, Source::Gradient, degrees)).into();
    cases.extend([30.0, 45.0, 90.0].map(|degrees| case(mirrored, Source::Gradient, degrees)));
    cases.push(case(mirrored * Mat2::from_angle(0.4), Source::Yarn, -71.3));
    cases.push(Case { uv_unit: Some(1.0), ..case(sheared, Source::Yarn, 30.0) });
    cases.push(case(drawn_out, Source::Gradient, 30.0));
    cases.push(case(drawn_out, Source::Yarn, 30.0));
    cases
}

fn tilt() -> Quat {
    Quat::from_euler(glam::EulerRot::XYZ, 0.4, -0.7, 1.1)
}

/// Where the direction runs, by hand: the gradients of the UVs are the rows of the matrix, the yarns the columns of its
/// inverse.
fn expected(case: &Case) -> Vec3 {
    let along = Vec2::from_angle(case.direction.angle);
    let flat = match case.direction.source {
        Source::Gradient => case.to_uv.transpose() * along,
        _ => case.to_uv.inverse() * along,
    };
    tilt() * flat.extend(0.0).normalize_or_zero()
}

fn garment(cases: &[Case]) -> Garment {
    let meshes: Vec<_> = cases.iter().map(|case| flat(tilt(), |p| case.to_uv * p)).collect();
    let mut garment = garment_of(&meshes);
    for (panel, case) in garment.panels.iter_mut().zip(cases) {
        panel.flags.mirrored = case.to_uv.determinant() < 0.0;
        panel.pattern.uv_unit = case.uv_unit;
    }
    garment
}

/// The file of a garment, and its JSON.
fn saved(garment: &Garment, directions: &[Direction], said: &[Said]) -> (Vec<u8>, Value) {
    let made = direction::tangents(garment, directions).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.glb");
    tangents(garment, &made, directions, said, &path).unwrap();
    let bytes = file::read(&path, 1 << 26).unwrap();
    let json = serde_json::from_slice(&gltf::binary::Glb::from_slice(&bytes).unwrap().json).unwrap();
    (bytes, json)
}

/// What a viewer has of a vertex or of the triangle that begins with it.
struct Seen {
    normal: Vec3,
    tangent: Vec3,
    w: f32,
    /// Of `TEXCOORD_0` as the file has it, v down: dP/du and dP/dv of the triangle.
    dp_du: Vec3,
    dp_dv: Vec3,
    warp: Vec3,
    weft: Vec3,
}

fn vec3s(accessor: &gltf::Accessor<'_>, blob: &[u8]) -> Vec<Vec3> {
    let view = accessor.view().unwrap();
    let bytes = &blob[view.offset()..view.offset() + view.length()];
    bytes.chunks_exact(12).map(bytemuck::pod_read_unaligned).collect()
}

/// What is seen of the primitive at the first corners of its triangles.
fn seen(primitive: &gltf::Primitive<'_>, blob: &[u8]) -> Vec<Seen> {
    let reader = primitive.reader(|_| Some(blob));
    let positions: Vec<Vec3> = reader.read_positions().unwrap().map(Vec3::from).collect();
    let normals: Vec<Vec3> = reader.read_normals().unwrap().map(Vec3::from).collect();
    let tangents: Vec<[f32; 4]> = reader.read_tangents().unwrap().collect();
    let uvs: Vec<Vec2> = reader.read_tex_coords(0).unwrap().into_f32().map(Vec2::from).collect();
    let extra = |name: &str| {
        let found = primitive.attributes().find(|(semantic, _)| semantic.to_string() == name);
        vec3s(&found.unwrap().1, blob)
    };
    let (warps, wefts) = (extra("_WARP"), extra("_WEFT"));
    let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
    let triangle = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| corner as usize);
        let (e, f) = (positions[b] - positions[a], positions[c] - positions[a]);
        let (s, t) = (uvs[b] - uvs[a], uvs[c] - uvs[a]);
        let [x, y, z, w] = tangents[a];
        Seen {
            normal: normals[a],
            tangent: Vec3::new(x, y, z),
            w,
            dp_du: (e * t.y - f * s.y) / s.perp_dot(t),
            dp_dv: (f * s.x - e * t.x) / s.perp_dot(t),
            warp: warps[a],
            weft: wefts[a],
        }
    };
    indices.as_chunks::<3>().0.iter().map(triangle).collect()
}

/// The direction of KHR_materials_anisotropy in the tangent plane, x along T and y along B: the texture's texel turned by the
/// factor. Three.js and the specification: the texel is made unit, then turned by the matrix of the factor.
fn anisotropy(json: &Value, blob: &[u8], primitive: &Value) -> Vec2 {
    let material = &json["materials"][primitive["material"].as_u64().unwrap() as usize];
    let anisotropy = &material["extensions"]["KHR_materials_anisotropy"];
    let (sin, cos) = (anisotropy["anisotropyRotation"].as_f64().unwrap() as f32).sin_cos();
    let texture = &json["textures"][anisotropy["anisotropyTexture"]["index"].as_u64().unwrap() as usize];
    assert_eq!(anisotropy["anisotropyTexture"]["texCoord"], 0);
    let image = &json["images"][texture["source"].as_u64().unwrap() as usize];
    let view = &json["bufferViews"][image["bufferView"].as_u64().unwrap() as usize];
    let [from, length] = ["byteOffset", "byteLength"].map(|key| view[key].as_u64().unwrap() as usize);
    let mut reader = png::Decoder::new(io::Cursor::new(&blob[from..from + length])).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    assert!(pixels.chunks(3).all(|pixel| pixel == &pixels[..3]), "constant");
    assert_eq!(pixels[2], 255, "full strength");
    let texel = Vec2::new(f32::from(pixels[0]), f32::from(pixels[1])) / 255.0 * 2.0 - 1.0;
    Mat2::from_cols(Vec2::new(cos, sin), Vec2::new(-sin, cos)) * texel.normalize_or_zero()
}

/// How far two lines are from being square to each other, degrees.
fn off_square(a: Vec3, b: Vec3) -> f32 {
    (degrees_between(a, b) - 90.0).abs()
}

#[test]
fn every_reader_finds_each_direction_within_a_tenth_of_a_degree() {
    let cases = cases();
    let directions: Vec<Direction> = cases.iter().map(|case| case.direction).collect();
    let (bytes, json) = saved(&garment(&cases), &directions, &[]);
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(&bytes).unwrap();
    let blob = blob.unwrap();
    let mut worst = [0f32; 5];
    for (index, (mesh, case)) in document.meshes().zip(&cases).enumerate() {
        let (warp, primitive) = (expected(case), mesh.primitives().next().unwrap());
        let way = anisotropy(&json, &blob, &json["meshes"][index]["primitives"][0]);
        for seen in seen(&primitive, &blob) {
            // The specification: cos r T + sin r B with B = cross(N, T) w. The same in three.js, and here signed: B is the weft.
            let b = seen.normal.cross(seen.tangent) * seen.w;
            let highlight = seen.tangent * way.x + b * way.y;
            let across = seen.normal.cross(warp) * case.to_uv.determinant().signum();
            // Blender and all that make tangents of their own: from TEXCOORD_0, turned about the normal, w passed over.
            let made = seen.dp_du.normalize_or_zero();
            let in_blender = made * way.x + seen.normal.cross(made) * way.y;
            // Three.js without tangents: both axes from the derivatives, v down, the rotation as it stands.
            let in_derivatives = made * way.x + seen.dp_dv.normalize_or_zero() * way.y;
            let sheared = 90.0 - degrees_between(seen.dp_du, seen.dp_dv);
            let off = [
                degrees_between(seen.tangent, warp),
                degrees_between(highlight, across),
                degrees_between(made, warp),
                off_square(in_blender, warp),
                (off_square(in_derivatives, warp) - sheared.abs()).abs(),
            ];
            worst = std::array::from_fn(|k| worst[k].max(off[k]));
            assert!(off.iter().all(|&off| off < BOUND), "panel {index}: {off:?}");
            // v is down in the file.
            assert!(degrees_between(seen.warp, seen.dp_du) < BOUND, "panel {index}: warp");
            assert!(degrees_between(seen.weft, -seen.dp_dv) < BOUND, "panel {index}: weft");
        }
    }
    println!("worst, degrees: tangent, highlight, own tangents, Blender, derivatives: {worst:?}");
}

#[test]
fn the_yarns_hold_the_shear_and_the_first_uvs_count_metres() {
    let cases = cases();
    let directions: Vec<Direction> = cases.iter().map(|case| case.direction).collect();
    let (bytes, _) = saved(&garment(&cases), &directions, &[]);
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(&bytes).unwrap();
    for (index, (mesh, case)) in document.meshes().zip(&cases).enumerate() {
        for seen in seen(&mesh.primitives().next().unwrap(), blob.as_ref().unwrap()) {
            let angle = degrees_between(seen.warp, seen.weft);
            if case.uv_unit.is_none() {
                // Not even where the UVs are drawn out.
                assert!((angle - 90.0).abs() < BOUND, "panel {index}: {angle}");
                assert!((seen.dp_du.length() - 1.0).abs() < 1e-3 && (seen.dp_dv.length() - 1.0).abs() < 1e-3);
            } else {
                // The cloth was cut square: the yarns at 30 and 120 degrees of the UVs, taken to the sheared panel.
                let [a, b] = [30f32, 120.0]
                    .map(|degrees| case.to_uv.inverse() * Vec2::from_angle(degrees.to_radians()));
                let sheared = a.perp_dot(b).atan2(a.dot(b)).to_degrees();
                assert!((sheared - 90.0).abs() > 5.0 && (angle - sheared).abs() < BOUND, "{angle} {sheared}");
            }
        }
    }
}

#[test]
fn a_field_is_in_the_tangents_and_said_to_be_one() {
    let cases = cases();
    let garment = garment(&cases);
    let mut directions: Vec<Direction> = cases.iter().map(|case| case.direction).collect();
    let field = Source::Field(Field::Along { direction: Vec3::X });
    (directions[0].source, directions[5].source) = (field, field);
    let (bytes, json) = saved(&garment, &directions, &[]);
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(&bytes).unwrap();
    for (index, mesh) in document.meshes().enumerate() {
        let extras = &json["meshes"][index]["primitives"][0]["extras"];
        let is_field = index == 0 || index == 5;
        assert_eq!(
            (&extras["follows_pattern"], extras["grain_deg"].is_null()),
            (&(!is_field).into(), is_field)
        );
        assert_eq!(extras["amc"]["grain_deg"].is_null(), is_field);
        for seen in seen(&mesh.primitives().next().unwrap(), blob.as_ref().unwrap()) {
            if is_field {
                assert_eq!(seen.warp, seen.tangent);
                let b = seen.normal.cross(seen.tangent) * seen.w;
                assert!(degrees_between(seen.weft, b) < 1e-2);
                // As drawn: the panel's own axes, not turned.
                let drawn = tilt() * (cases[index].to_uv.inverse() * Vec2::X).extend(0.0);
                assert!(degrees_between(seen.dp_du, drawn) < BOUND);
            }
        }
    }
    assert!(json["meshes"][0]["primitives"][0]["extras"]["source"]["field"].is_object());
}

#[test]
fn a_combed_panel_is_a_field_and_no_obj() {
    let cases = cases();
    let garment = garment(&cases);
    let directions: Vec<Direction> = cases.iter().map(|case| case.direction).collect();
    let mut made = direction::tangents(&garment, &directions).unwrap();
    made.combed[2] = true;
    let folder = tempfile::tempdir().unwrap();
    let save = |name: &str| tangents(&garment, &made, &directions, &[], &folder.path().join(name));
    assert!(save("a.obj").unwrap_err().to_string().contains("combed"));
    save("a.json").unwrap();
    let text = file::read(&folder.path().join("a.json"), 1 << 26).unwrap();
    let json: Value = serde_json::from_slice(&text).unwrap();
    let said = |index: usize| ["combed", "follows_pattern"].map(|key| json["panels"][index][key].clone());
    assert_eq!((said(2), said(1)), ([true, false].map(Value::from), [false, true].map(Value::from)));
}

#[test]
fn extras_and_materials_say_what_is_known() {
    let cases = cases();
    let mut garment = garment(&cases);
    garment.panels[0].pattern.mirror = Some(4);
    garment.panels[1].takes_fabric = false;
    let directions: Vec<Direction> = cases.iter().map(|case| case.direction).collect();
    let mut said = vec![Said::default(); cases.len()];
    said[3] = Said {
        fabric: Some("Silk".to_owned()),
        orientation: Orientation::Nap,
        is_locked: true,
        is_linked: true,
    };
    let (_, json) = saved(&garment, &directions, &said);
    let primitive = |index: usize| &json["meshes"][index]["primitives"][0];
    let extras = &primitive(3)["extras"];
    for (key, value) in [
        ("fabric", Value::from("Silk")),
        ("orientation", "nap".into()),
        ("locked", true.into()),
        ("linked", true.into()),
        ("warp_weft_swapped", true.into()),
        ("unit", "m".into()),
        ("angle_deg", 90.0.into()),
    ] {
        assert_eq!(extras[key], value, "{key}");
    }
    assert_eq!(primitive(0)["extras"]["mirror_partner"], "id4");
    assert_eq!(primitive(0)["extras"]["warp_weft_swapped"], false);
    // Drawn out four to one: 30 degrees in the UVs are a steeper or a flatter angle on the cloth.
    for (index, slope) in [(9, 4.0f64), (10, 0.25)] {
        let grain = primitive(index)["extras"]["grain_deg"].as_f64().unwrap();
        let expected = (30f64.to_radians().tan() * slope).atan().to_degrees();
        assert!((grain - expected).abs() < 0.1, "{grain} {expected}");
    }
    let material = |index: usize| &json["materials"][primitive(index)["material"].as_u64().unwrap() as usize];
    assert_eq!((&material(3)["name"], &material(0)["name"]), (&"Silk".into(), &"cloth".into()));
    assert!(material(1)["extensions"].is_null() && material(0)["doubleSided"] == true);
    assert_eq!(json["materials"].as_array().unwrap().len(), 3, "one per group");
    assert_eq!(json["extensionsUsed"], serde_json::json!(["KHR_materials_anisotropy"]));
}

#[test]
fn read_again_the_pattern_is_the_turned_one_with_its_warp_along_u() {
    let cases = cases();
    let directions: Vec<Direction> = cases.iter().map(|case| case.direction).collect();
    let (bytes, _) = saved(&garment(&cases), &directions, &[]);
    let no_files = |_: &str| Err(Error::invalid("no files here"));
    let again = Garment::new(mesh::gltf::parse(&bytes, &no_files).unwrap()).unwrap();
    let along: Vec<Direction> = again.panels.iter().map(Direction::along_grain).collect();
    let made = direction::tangents(&again, &along).unwrap();
    for (index, case) in cases.iter().enumerate().filter(|(_, case)| case.uv_unit.is_none()) {
        let panel = &again.panels[index];
        assert_eq!((panel.pattern.grain, panel.pattern.uv_unit), (Some(0.0), Some(1.0)));
        assert_eq!(panel.flags.mirrored, case.to_uv.determinant() < 0.0);
        for corner in again.triangles[panel.triangles.start as usize] {
            let off = degrees_between(made.vectors[corner as usize], expected(case));
            assert!(off < BOUND, "panel {index}: {off}");
        }
    }
}
