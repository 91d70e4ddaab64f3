//! After the idea of Khronos' AnisotropyRotationTest: tangents turned by some angle, undone by the factor, by the texture, or by
//! both; whoever mistakes a sense is off by twice that angle.

use serde_json::{Value, json};

use super::*;
use crate::mesh::gltf::tests::{glb, nothing_beside, square};

/// A texture of one direction, in 16 bits a channel, or of several.
fn texture(degrees: &[f32]) -> Vec<u8> {
    let texel = |degrees: &f32| {
        let way = Vec2::from_angle(degrees.to_radians());
        [way.x, way.y, 1.0].map(|it: f32| (((it + 1.0) / 2.0 * 65535.0).round() as u16).to_be_bytes())
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, degrees.len() as u32, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Sixteen);
    let texels: Vec<u8> = degrees.iter().flat_map(texel).flatten().collect();
    encoder.write_header().unwrap().write_image_data(&texels).unwrap();
    bytes
}

/// Tangents in the plane of the square: degrees from +x, and w.
type Tangents = Option<(f32, f32)>;

fn file(tangents: Tangents, rotation: f32, directions: &[f32]) -> (Value, Vec<u8>) {
    let (mut json, mut bin) = square();
    let mut view = |json: &mut Value, bytes: &[u8]| {
        let views = json["bufferViews"].as_array_mut().unwrap();
        views.push(json!({ "buffer": 0, "byteOffset": bin.len(), "byteLength": bytes.len() }));
        bin.extend(bytes);
        bin.resize(bin.len().next_multiple_of(4), 0);
        views.len() - 1
    };
    if let Some((degrees, w)) = tangents {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let bytes: Vec<u8> = [cos, sin, 0.0, w].repeat(4).iter().flat_map(|it| it.to_le_bytes()).collect();
        let view = view(&mut json, &bytes);
        let accessor = json!({ "bufferView": view, "componentType": 5126, "count": 4, "type": "VEC4" });
        json["accessors"].as_array_mut().unwrap().push(accessor);
        json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = json!(4);
    }
    let mut anisotropy = json!({ "anisotropyStrength": 1, "anisotropyRotation": rotation.to_radians() });
    if !directions.is_empty() {
        let view = view(&mut json, &texture(directions));
        json["images"] = json!([{ "bufferView": view, "mimeType": "image/png" }]);
        json["textures"] = json!([{ "source": 0 }]);
        anisotropy["anisotropyTexture"] = json!({ "index": 0 });
    }
    json["extensionsUsed"] = json!(["KHR_materials_anisotropy"]);
    json["materials"][0]["extensions"] = json!({ "KHR_materials_anisotropy": anisotropy });
    json["buffers"][0]["byteLength"] = json!(bin.len());
    (json, bin)
}

fn read((json, bin): &(Value, Vec<u8>)) -> Result<Vec<Anisotropy>> {
    anisotropy(&glb(json, bin), &nothing_beside).map(|(_, panels)| panels)
}

/// Where the warp runs on the square, 2 by 1 metres on UVs of 1 by 1: degrees from +x.
fn warp(file: &(Value, Vec<u8>)) -> f32 {
    let [panel] = read(file).unwrap().try_into().unwrap();
    assert!(!panel.varies && panel.record.is_none());
    let warp = panel.warp.unwrap() * Vec2::new(2.0, 1.0);
    assert!((warp.length() - 1.0).abs() < 1e-4, "a unit vector in space");
    warp.to_angle().to_degrees()
}

#[test]
fn rotation_by_texture_by_factor_and_by_both_are_the_same() {
    for (tangents, rotation, texture, expected) in [
        // The highlight along x, the warp a quarter turn back.
        (Some((0.0, 1.0)), 0.0, None, -90.0),
        (Some((-30.0, 1.0)), 30.0, None, -90.0),
        (Some((-30.0, 1.0)), 0.0, Some(30.0), -90.0),
        (Some((-30.0, 1.0)), 10.0, Some(20.0), -90.0),
        (Some((-30.0, 1.0)), -50.0, Some(80.0), -90.0),
        // Where B is turned over, all is counted the other way.
        (Some((30.0, -1.0)), 10.0, Some(20.0), 90.0),
        (Some((0.0, -1.0)), 25.0, None, 65.0),
        // A bias, whose sign shows.
        (Some((0.0, 1.0)), 90.0 + 45.0, None, 45.0),
        // Without tangents they are those of the UVs, v up: here x and y.
        (None, 90.0, None, 0.0),
        (None, 30.0, Some(40.0), -20.0),
    ] {
        let texture: Vec<f32> = texture.into_iter().collect();
        let found = warp(&file(tangents, rotation, &texture));
        assert!(
            (found - expected).abs() < 0.01,
            "{tangents:?} {rotation} {texture:?}: {found}, not {expected}"
        );
    }
}

#[test]
fn a_node_that_turns_and_mirrors_takes_its_tangents_along() {
    let mut turned = file(Some((0.0, 1.0)), 60.0, &[]);
    let straight = warp(&turned);
    turned.0["nodes"][0]["rotation"] = json!([0.1, 0.7, 0.1, 0.7]);
    assert!((warp(&turned) - straight).abs() < 0.01, "the pattern stays where it is");
    turned.0["nodes"][0]["scale"] = json!([-1, 1, 1]);
    assert!((warp(&turned) - straight).abs() < 0.01, "so it does in the mirror");
}

#[test]
fn a_texture_of_many_directions_is_said_to_vary() {
    let [panel] = read(&file(Some((0.0, 1.0)), 0.0, &[20.0, 40.0])).unwrap().try_into().unwrap();
    assert!(panel.varies);
    let warp = panel.warp.unwrap() * Vec2::new(2.0, 1.0);
    assert!((warp.to_angle().to_degrees() + 60.0).abs() < 0.01, "{warp}");
    // Too few degrees apart to matter.
    assert!(!read(&file(Some((0.0, 1.0)), 0.0, &[30.0, 31.0])).unwrap()[0].varies);
}

#[test]
fn cloth_without_anisotropy_or_uvs_has_no_direction() {
    let mut plain = file(None, 0.0, &[]);
    plain.0["materials"][0].as_object_mut().unwrap().remove("extensions");
    assert_eq!(read(&plain).unwrap()[0].warp, None);
    let mut bare = file(Some((0.0, 1.0)), 0.0, &[]);
    bare.0["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("TEXCOORD_0");
    assert_eq!(read(&bare).unwrap()[0].warp, None);
}

#[test]
fn what_cannot_be_read_is_refused_by_name() {
    let said = |change: &dyn Fn(&mut Value)| {
        let mut file = file(Some((0.0, 1.0)), 0.0, &[10.0]);
        change(&mut file.0);
        read(&file).unwrap_err().to_string()
    };
    let anisotropy = |json: &mut Value, key: &str, value: Value| {
        json["materials"][0]["extensions"]["KHR_materials_anisotropy"][key] = value;
    };
    assert!(said(&|json| anisotropy(json, "anisotropyTexture", json!({"index": 7}))).contains("texture 7"));
    assert!(said(&|json| anisotropy(json, "anisotropyRotation", json!("north"))).contains("not glTF"));
    assert!(said(&|json| json["images"][0]["bufferView"] = json!(0)).starts_with("materials[0]: "));
    assert!(said(&|json| json["accessors"][4]["count"] = json!(3)).contains("3 tangents for 4"));
    assert!(said(&|json| json["accessors"][4]["type"] = json!("VEC3")).contains("Vec4"));
}
