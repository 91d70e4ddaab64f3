use glam::{Vec2, Vec3};
use serde_json::{Value, json};

use super::*;
use crate::mesh::mutations;

pub(super) fn glb(json: &Value, bin: &[u8]) -> Vec<u8> {
    let mut json = json.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bin = bin.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let mut file = b"glTF".to_vec();
    for word in [2, 28 + json.len() + bin.len(), json.len()] {
        file.extend((word as u32).to_le_bytes());
    }
    file.extend(b"JSON");
    file.extend(json);
    file.extend((bin.len() as u32).to_le_bytes());
    file.extend(b"BIN\0");
    file.extend(bin);
    file
}

/// A square of four vertices in z = 0 with UVs (v down), normals +z and six 16-bit indices.
pub(super) fn square() -> (Value, Vec<u8>) {
    let mut bin = Vec::new();
    let mut put = |numbers: &[f32]| numbers.iter().for_each(|x| bin.extend(x.to_le_bytes()));
    put(&[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
    put(&[0.0, 0.0, 1.0].repeat(4));
    put(&[0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
    [0u16, 1, 2, 0, 2, 3].iter().for_each(|i| bin.extend(i.to_le_bytes()));
    let json = json!({
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": 140}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 48},
            {"buffer": 0, "byteOffset": 96, "byteLength": 32},
            {"buffer": 0, "byteOffset": 128, "byteLength": 12}
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [2, 1, 0]},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}
        ],
        "materials": [{"name": "wool"}],
        "meshes": [{"name": "square", "primitives": [
            {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}
        ]}],
        "nodes": [{"mesh": 0, "name": "Front"}],
        "scenes": [{"nodes": [0]}],
        "scene": 0
    });
    (json, bin)
}

pub(super) fn nothing_beside(name: &str) -> Result<Vec<u8>> {
    Err(Error::invalid(format!("asked for {name}")))
}

fn read(json: &Value, bin: &[u8]) -> Result<Mesh> {
    parse(&glb(json, bin), &nothing_beside)
}

fn fault(change: impl FnOnce(&mut Value)) -> String {
    let (mut json, bin) = square();
    change(&mut json);
    read(&json, &bin).unwrap_err().to_string()
}

#[test]
fn a_square_is_read_with_v_up() {
    let (json, bin) = square();
    let mesh = read(&json, &bin).unwrap();
    assert_eq!((mesh.triangles.len(), mesh.file_vertices, mesh.parts[0].name.as_str()), (2, 4, "Front"));
    assert_eq!(mesh.uvs.as_ref().unwrap()[..], [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]);
    assert!(mesh.notices.is_empty(), "{:?}", mesh.notices);
    mutations::assert_checked(&mesh);
}

#[test]
fn bytes_at_any_alignment_give_the_same_mesh() {
    let (mut json, mut bin) = square();
    let wide: Vec<u8> = [0u32, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()).collect();
    json["bufferViews"][3] = json!({"buffer": 0, "byteOffset": 140, "byteLength": 24});
    json["accessors"][3]["componentType"] = json!(5125);
    json["buffers"][0]["byteLength"] = json!(164);
    bin.extend(wide);
    let file = glb(&json, &bin);
    for shift in 0..4 {
        let shifted = [vec![0; shift], file.clone()].concat();
        let mesh = parse(&shifted[shift..], &nothing_beside).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!((mesh.positions[2], mesh.uvs.unwrap()[1]), (Vec3::new(2.0, 1.0, 0.0), Vec2::X));
    }
}

#[test]
fn nodes_place_turn_and_mirror() {
    let (mut json, bin) = square();
    let quarter = std::f32::consts::FRAC_1_SQRT_2;
    json["nodes"] = json!([
        {"children": [1, 2], "translation": [10, 0, 0]},
        {"mesh": 0, "rotation": [0, quarter, 0, quarter], "name": "turned"},
        {"mesh": 0, "scale": [-1, 3, 1], "name": "mirrored"}
    ]);
    let mesh = read(&json, &bin).unwrap();
    // A quarter turn about y takes +x to -z and +z to +x.
    assert!((mesh.positions[1] - Vec3::new(10.0, 0.0, -2.0)).length() < 1e-5);
    assert!((mesh.normals[1] - Vec3::X).length() < 1e-5);
    assert_eq!(mesh.positions[6], Vec3::new(8.0, 3.0, 0.0));
    assert_eq!((mesh.parts.len(), mesh.file_vertices), (2, 8));
    for &[a, b, c] in &mesh.triangles {
        let [p, q, r] = [a, b, c].map(|i| mesh.positions[i as usize]);
        assert!((q - p).cross(r - p).dot(mesh.normals[a as usize]) > 0.0);
    }
    assert!(mesh.notices.is_empty(), "{:?}", mesh.notices);
}

#[test]
fn an_uneven_scale_keeps_normals_perpendicular() {
    let (mut json, mut bin) = square();
    // Tilt the square: z = x.
    for vertex in [1, 2] {
        bin[vertex * 12 + 8..vertex * 12 + 12].copy_from_slice(&2.0f32.to_le_bytes());
    }
    let tilted = Vec3::new(-1.0, 0.0, 1.0).normalize_or_zero();
    for vertex in 0..4 {
        for (c, x) in tilted.to_array().iter().enumerate() {
            bin[48 + vertex * 12 + c * 4..][..4].copy_from_slice(&x.to_le_bytes());
        }
    }
    json["nodes"][0]["scale"] = json!([4, 1, 1]);
    let mesh = read(&json, &bin).unwrap();
    let expected = Vec3::new(-1.0, 0.0, 4.0).normalize_or_zero();
    assert!((mesh.normals[0] - expected).length() < 1e-6, "{}", mesh.normals[0]);
}

#[test]
fn sparse_quantised_and_data_uri_are_read() {
    let (mut json, mut bin) = square();
    // Vertex 2 is moved by a sparse accessor; UVs become normalised bytes.
    bin.extend([2, 0, 0, 0]);
    [5.0f32, 6.0, 7.0].iter().for_each(|x| bin.extend(x.to_le_bytes()));
    bin.extend([0, 255, 255, 255, 255, 0, 0, 0]);
    let views = json["bufferViews"].as_array_mut().unwrap();
    views.push(json!({"buffer": 0, "byteOffset": 140, "byteLength": 4}));
    views.push(json!({"buffer": 0, "byteOffset": 144, "byteLength": 12}));
    views.push(json!({"buffer": 0, "byteOffset": 156, "byteLength": 8}));
    json["accessors"][0]["sparse"] = json!({
        "count": 1,
        "indices": {"bufferView": 4, "componentType": 5123},
        "values": {"bufferView": 5}
    });
    json["accessors"][2] =
        json!({"bufferView": 6, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC2"});
    json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    use base64::Engine as _;
    let uri = base64::engine::general_purpose::STANDARD.encode(&bin);
    json["buffers"][0] =
        json!({"byteLength": 164, "uri": format!("data:application/octet-stream;base64,{uri}")});
    let mesh = parse(json.to_string().as_bytes(), &nothing_beside).unwrap();
    assert_eq!(mesh.positions[2], Vec3::new(5.0, 6.0, 7.0));
    assert_eq!(mesh.uvs.unwrap()[..], [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]);

    json["buffers"][0]["uri"] = json!("my%20cloth.bin");
    let mesh = parse(json.to_string().as_bytes(), &|name| {
        assert_eq!(name, "my cloth.bin");
        Ok(bin.clone())
    });
    assert_eq!(mesh.unwrap().positions[2].y, 6.0);
}

#[test]
fn strips_fans_and_missing_attributes_are_read() {
    let (mut json, bin) = square();
    let primitive = json!({"attributes": {"POSITION": 0}, "mode": 6});
    let strip = json!({"attributes": {"POSITION": 0}, "mode": 5});
    let points = json!({"attributes": {"POSITION": 0}, "mode": 0});
    json["meshes"][0]["primitives"] = json!([primitive, strip, points]);
    let mesh = read(&json, &bin).unwrap();
    assert_eq!(mesh.triangles[..2], [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.triangle_parts, [0, 0, 1, 1]);
    assert!(mesh.uvs.is_none());
    let all = mesh.notices.join("; ");
    for word in ["no UVs", "no normals", "1 primitives of points"] {
        assert!(all.contains(word), "{all}");
    }
}

#[test]
fn extras_and_names_say_what_takes_a_fabric() {
    let (mut json, bin) = square();
    json["nodes"] = json!([
        {"mesh": 0, "name": "Body"},
        {"mesh": 0, "name": "shell", "extras": {"amc": {"fabric": false, "name": "Lining"}}},
        {"mesh": 0, "name": "head", "extras": {"amc": {"fabric": true}}},
        {"mesh": 0, "name": "shirt"}, {"mesh": 0, "name": "shirt"}
    ]);
    json["scenes"][0]["nodes"] = json!([0, 1, 2, 3, 4]);
    let mesh = read(&json, &bin).unwrap();
    let told: Vec<_> = mesh.parts.iter().map(|part| (part.name.as_str(), part.takes_fabric)).collect();
    assert_eq!(
        told,
        [("Body", false), ("Lining", false), ("head", true), ("shirt", true), ("shirt 2", true)]
    );
}

#[test]
fn faults_name_mesh_and_primitive() {
    let in_primitive = |change: fn(&mut Value), what: &str| {
        let message = fault(change);
        assert!(message.starts_with("mesh 0, primitive 0: ") && message.contains(what), "{message}");
    };
    in_primitive(|j| j["accessors"][0]["count"] = json!(5), "positions: 5 items reach past");
    in_primitive(|j| j["accessors"][0]["count"] = json!(u64::MAX / 2), "reach past");
    in_primitive(|j| j["accessors"][0]["byteOffset"] = json!(u64::MAX), "reach past");
    in_primitive(|j| j["bufferViews"][1]["byteOffset"] = json!(u64::MAX), "normals: 4 items reach past");
    in_primitive(|j| j["bufferViews"][0]["byteLength"] = json!(47), "reach past");
    in_primitive(|j| j["accessors"][1]["count"] = json!(3), "3 normals for 4 positions");
    in_primitive(|j| j["accessors"][2]["type"] = json!("VEC3"), "UVs: Vec3 where Vec2");
    in_primitive(|j| j["accessors"][3]["bufferView"] = json!(2), "index 16256, of 4");
    in_primitive(|j| j["nodes"][0]["translation"] = json!([1e20, 0, 0]), "vertex 0: a coordinate beyond");
    for (at, what) in
        [(12, "vertex 1: a position that is not a finite"), (116, "UVs: vertex 2: not a finite")]
    {
        let (json, mut bin) = square();
        bin[at..at + 4].copy_from_slice(&f32::NAN.to_le_bytes());
        let message = read(&json, &bin).unwrap_err().to_string();
        assert!(message.contains(what), "{message}");
    }
}

#[test]
fn faults_of_the_document_say_where() {
    assert!(fault(|j| j["accessors"][0]["bufferView"] = json!(9)).contains("accessors[0].bufferView"));
    assert!(fault(|j| j["accessors"] = json!([])).contains("meshes[0].primitives[0].attributes"));
    assert!(fault(|j| j["nodes"] = json!([{"mesh": 0, "children": [0]}])).contains("node 0: reached twice"));
    assert!(fault(|j| j["buffers"][0]["byteLength"] = json!(1000)).contains("buffer 0: "));
    assert!(fault(|j| j["buffers"][0]["uri"] = json!("a.bin")).contains("asked for a.bin"));
    assert!(fault(|j| j["buffers"][0]["uri"] = json!("http://a/b")).contains("only files beside"));
    assert!(fault(|j| j["extensionsRequired"] = json!(["KHR_draco_mesh_compression"])).contains("draco"));
    assert!(fault(|j| j["scenes"][0]["nodes"] = json!([])).contains("no triangles"));
}

#[test]
fn copies_of_a_mesh_are_bounded_by_the_file() {
    let (mut json, bin) = square();
    let nodes = |count: usize| (vec![json!({"mesh": 0}); count], (0..count).collect::<Vec<_>>());
    let mut read_copies = |count: usize| {
        let (all, indices) = nodes(count);
        json["nodes"] = json!(all);
        json["scenes"][0]["nodes"] = json!(indices);
        read(&json, &bin)
    };
    assert_eq!(read_copies(1000).unwrap().parts.len(), 1000);
    let (mut json, mut bin) = square();
    let long: Vec<u8> = [0u16, 1, 2].repeat(40_000).iter().flat_map(|i| i.to_le_bytes()).collect();
    json["bufferViews"][3] = json!({"buffer": 0, "byteOffset": bin.len(), "byteLength": long.len()});
    json["accessors"][3]["count"] = json!(120_000);
    bin.extend(long);
    json["buffers"][0]["byteLength"] = json!(bin.len());
    let (all, indices) = nodes(100);
    json["nodes"] = json!(all);
    json["scenes"][0]["nodes"] = json!(indices);
    assert!(read(&json, &bin).unwrap_err().to_string().contains("more copies"));
}

#[test]
fn a_container_cut_anywhere_is_an_error() {
    let (json, bin) = square();
    let whole = glb(&json, &bin);
    for end in 0..whole.len() {
        assert!(parse(&whole[..end], &nothing_beside).is_err(), "{end}");
    }
    assert!(
        parse(&[&b"glTF\x01\0\0\0"[..], &whole[8..]].concat(), &nothing_beside)
            .unwrap_err()
            .to_string()
            .contains("version 1")
    );
}

#[test]
fn no_mutation_panics() {
    let (mut json, bin) = square();
    json["accessors"][1]["sparse"] = json!({
        "count": 1,
        "indices": {"bufferView": 3, "componentType": 5123},
        "values": {"bufferView": 0}
    });
    mutations::each(&glb(&json, &bin), 8_000, |bytes| {
        if let Ok(mesh) = parse(bytes, &nothing_beside) {
            mutations::assert_checked(&mesh);
            let _ = crate::mesh::Garment::new(mesh);
        }
    });
}

/// The square with its buffer in a file beside it.
fn square_beside() -> (Value, Vec<u8>) {
    let (mut json, bin) = square();
    json["buffers"][0]["uri"] = json!("two%20words.bin");
    (json, bin)
}

#[test]
fn no_mutation_of_a_file_or_of_the_buffer_beside_it_panics() {
    let (json, bin) = square_beside();
    let text = json.to_string().into_bytes();
    let look = |text: &[u8], beside: &[u8]| {
        // A mutation may change the name, too.
        if let Ok(mesh) = parse(text, &|_| Ok(beside.to_vec())) {
            mutations::assert_checked(&mesh);
            let _ = crate::mesh::Garment::new(mesh);
            return 1;
        }
        0
    };
    let mut read = [0, 0];
    mutations::each(&text, 4_000, |text| read[0] += look(text, &bin));
    mutations::each(&bin, 4_000, |bin| read[1] += look(&text, bin));
    assert!(read[0] > 20 && read[1] > 100, "the way to a mesh was hardly taken: {read:?}");
}

#[test]
fn a_file_that_many_buffers_name_is_read_once_and_justifies_no_more() {
    let (mut json, bin) = square_beside();
    let names = ["two%20words.bin", "two words.bin"];
    let buffer = |k: usize| json!({"byteLength": 140, "uri": names[k % 2]});
    json["buffers"] = (0..1000).map(buffer).collect();
    let asked = std::cell::Cell::new(0);
    let beside = |name: &str| {
        asked.set(asked.get() + 1);
        assert_eq!(name, "two words.bin");
        Ok(bin.clone())
    };
    let text = json.to_string().into_bytes();
    assert_eq!(parse(&text, &beside).unwrap().triangles.len(), 2);
    assert_eq!(asked.get(), 1);
    // Zeros for which nothing stands in the file: as many as all buffers have bytes, were they not the same ones.
    json["accessors"][1] = json!({"componentType": 5126, "count": 100_000, "type": "VEC3", "sparse": {
        "count": 1, "indices": {"bufferView": 3, "componentType": 5123}, "values": {"bufferView": 0}}});
    let error = parse(json.to_string().as_bytes(), &beside).unwrap_err();
    assert_eq!(error.kind(), crate::ErrorKind::TooLarge, "{error}");
    let (_, bin) = square();
    for buffer in json["buffers"].as_array_mut().unwrap() {
        buffer.as_object_mut().unwrap().remove("uri");
    }
    assert_eq!(read(&json, &bin).unwrap_err().kind(), crate::ErrorKind::TooLarge);
}

/// The square twice: a left and a right sleeve, sewn together.
fn sleeves() -> (Value, Vec<u8>) {
    let (mut json, bin) = square();
    json["nodes"] = json!([
        {"mesh": 0, "name": "Left", "extras": {"other": [1], "amc": {
            "version": 1, "uv_unit_m": 1.0, "grain_deg": 90, "mirror": "Right", "unheard of": {},
            "seams": [{"name": "middle", "edge": [[1, 0], [1, 1]], "partner": "Right", "partner_edge": [[0, 0], [0, 1]]}]
        }}},
        {"mesh": 0, "name": "Right", "translation": [2, 0, 0], "extras": {"amc": {"grain_deg": 405}}}
    ]);
    json["scenes"][0]["nodes"] = json!([0, 1]);
    (json, bin)
}

#[test]
fn extras_say_how_a_piece_is_cut_and_sewn() {
    let (json, bin) = sleeves();
    let garment = crate::mesh::Garment::new(read(&json, &bin).unwrap()).unwrap();
    assert!(garment.notices.is_empty(), "{:?}", garment.notices);
    let [left, right] = [0, 1].map(|k| &garment.panels[k].pattern);
    assert_eq!((left.grain, right.grain), (Some(90f32.to_radians()), Some(45f32.to_radians())));
    // The right one does not say so, but a mirror image is mutual.
    assert_eq!((left.mirror, right.mirror, left.uv_unit), (Some(1), Some(0), Some(1.0)));
    assert_eq!((left.seams.len(), right.seams.len()), (1, 0));
    assert_eq!((left.seams[0].partner, left.seams[0].edge), (1, [Vec2::X, Vec2::ONE]));
}

#[test]
fn bad_extras_are_a_notice_and_no_more() {
    let notice = |node: usize, key: &str, value: Value, what: &str| {
        let (mut json, bin) = sleeves();
        json["nodes"][node]["extras"]["amc"][key] = value;
        let garment = crate::mesh::Garment::new(read(&json, &bin).unwrap()).unwrap();
        assert!(garment.notices.len() == 1 && garment.notices[0].contains(what), "{:?}", garment.notices);
        garment
    };
    let garment = notice(0, "grain_deg", json!("north"), "mesh 0, primitive 0: invalid type: string");
    assert_eq!((garment.panels[0].pattern.grain, garment.panels[0].pattern.mirror), (None, None));
    notice(0, "version", json!(2), "version 2; this program reads 1");
    notice(0, "uv_unit_m", json!(-1), "Left: the unit -1");
    notice(0, "uv_unit_m", json!(1e300), "Left: the unit inf");
    notice(0, "mirror", json!("Middle"), "Left: the mirror partner 'Middle' is not there");
    notice(0, "mirror", json!("Left"), "Left: it is named as its own mirror partner");
    notice(0, "seams", json!([{"edge": [[0, 0]]}]), "invalid length");
    notice(0, "seams", json!(vec![vec![0; 100]; 100]), "mesh 0, primitive 0");
    let seam = |partner: &str, u: f64| json!({"edge": [[u, 0], [1, 1]], "partner": partner, "partner_edge": [[0, 0], [0, 1]]});
    notice(0, "seams", json!([seam("Back", 0.0)]), "Left: the seam '' is sewn to 'Back', which is not there");
    notice(0, "seams", json!([seam("Right", 1e300)]), "has an end that is no place");
    let garment = notice(0, "seams", json!(vec![seam("Right", 1.0); 5000]), "more than 4096 seams");
    assert_eq!(garment.panels[0].pattern.seams.len(), 4096);

    let (mut json, bin) = sleeves();
    json["nodes"] = json!([json["nodes"][0], json["nodes"][1], {"mesh": 0, "name": "Third", "translation": [4, 0, 0],
        "extras": {"amc": {"mirror": "Left"}}}]);
    json["scenes"][0]["nodes"] = json!([0, 1, 2]);
    let garment = crate::mesh::Garment::new(read(&json, &bin).unwrap()).unwrap();
    assert!(
        garment.notices[0].contains("Third: its mirror partner 'Left' names another"),
        "{:?}",
        garment.notices
    );
}

#[test]
fn extras_are_read_as_often_as_the_file_justifies() {
    let (mut json, bin) = square();
    let seam = json!({"edge": [[0, 0], [1, 1]], "partner": "a", "partner_edge": [[0, 0], [0, 1]]});
    json["meshes"][0]["extras"] = json!({"amc": {"name": "a", "seams": vec![seam; 1000]}});
    json["nodes"] = json!(vec![json!({"mesh": 0}); 1000]);
    json["scenes"][0]["nodes"] = json!((0..1000).collect::<Vec<_>>());
    let mesh = read(&json, &bin).unwrap();
    let seams: usize = mesh.parts.iter().map(|part| part.pattern.seams.len()).sum();
    assert!((1000..100_000).contains(&seams), "{seams} seams");
    assert!(mesh.notices[0].contains("too many copies"), "{:?}", mesh.notices);
}

#[test]
fn no_mutation_of_extras_panics() {
    let (json, bin) = sleeves();
    let whole = glb(&json, &bin);
    let start = whole.windows(5).position(|bytes| bytes == b"\"amc\"").unwrap();
    let end = whole.windows(7).position(|bytes| bytes == b"\"scenes").unwrap();
    mutations::each(&whole[start..end], 4_000, |bytes| {
        // Keep the container's lengths true, so that the mutation reaches the extras.
        let text = [&whole[20..start], bytes, &whole[end..whole.len() - 8 - bin.len()]].concat();
        let mut text = String::from_utf8_lossy(&text).trim_end().to_owned().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut file = whole[..20].to_vec();
        file[8..12].copy_from_slice(&((28 + text.len() + bin.len()) as u32).to_le_bytes());
        file[12..16].copy_from_slice(&(text.len() as u32).to_le_bytes());
        file.extend(text);
        file.extend_from_slice(&whole[whole.len() - 8 - bin.len()..]);
        let Ok(mesh) = parse(&file, &nothing_beside) else { return };
        let Ok(garment) = crate::mesh::Garment::new(mesh) else { return };
        let count = garment.panels.len();
        for panel in &garment.panels {
            let pattern = &panel.pattern;
            assert!(pattern.grain.is_none_or(f32::is_finite) && pattern.mirror.is_none_or(|k| k < count));
            assert!(pattern.seams.iter().all(|seam| seam.partner < count && seam.edge[0].is_finite()));
        }
    });
}
