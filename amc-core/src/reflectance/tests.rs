use glam::Vec3;

use super::*;
use crate::ErrorKind;

fn fibre(exponent: f32) -> Fibre {
    Fibre { weight: 1.0, diffuse: Vec3::ZERO, specular: Vec3::ONE, exponent }
}

fn line(warp: Option<Fibre>, weft: Option<Fibre>, self_shadow: bool) -> Line {
    Line { warp, weft, ambient: Vec3::ZERO, self_shadow }
}

fn directions() -> impl Iterator<Item = Vec3> + Clone {
    (0..60).map(|k| {
        let z = (k as f32 + 0.5) / 60.0;
        let xy = glam::Vec2::from_angle(k as f32 * 2.399_963) * (1.0 - z * z).sqrt();
        Vec3::new(xy.x, xy.y, z)
    })
}

/// The highlight is the largest over all normals of the line (its cone of reflection), found here by trying them.
#[test]
fn the_highlight_is_the_largest_over_all_normals_of_the_line() {
    let cloth = line(Some(fibre(1.0)), None, false);
    for to_light in directions() {
        for to_viewer in directions().step_by(7) {
            let normal = |k: u32| {
                let (sin, cos) = (k as f32 * std::f32::consts::TAU / 4000.0).sin_cos();
                Vec3::new(0.0, cos, sin)
            };
            let mirrored = |n: Vec3| n * (2.0 * n.dot(to_light)) - to_light;
            let largest = (0..4000).map(|k| mirrored(normal(k)).dot(to_viewer)).fold(f32::MIN, f32::max);
            let reflected = cloth.reflect(to_light, to_viewer).x;
            assert!((reflected - largest.max(0.0)).abs() < 1e-5, "{to_light} {to_viewer}");
        }
    }
}

#[test]
fn the_highlight_is_minus_the_cosine_of_the_summed_angles() {
    // Light and viewer in the plane of the fibre, at angles a and b to it: brightest where a + b is half a turn.
    let cloth = line(Some(fibre(5.0)), None, false);
    for (a, b) in [(40.0f32, 140.0f32), (60.0, 100.0), (90.0, 90.0), (120.0, 75.0), (30.0, 40.0)] {
        let at = |degrees: f32| Vec3::new(degrees.to_radians().cos(), 0.0, degrees.to_radians().sin());
        let expected = (-(a + b).to_radians().cos()).max(0.0).powi(5);
        assert!((cloth.reflect(at(a), at(b)).x - expected).abs() < 1e-5, "{a} {b}");
    }
}

#[test]
fn a_line_in_its_own_direction_reflects_no_diffuse_light_and_across_all() {
    let diffuse = Fibre { diffuse: Vec3::ONE, specular: Vec3::ZERO, ..fibre(1.0) };
    let cloth = line(Some(diffuse), None, false);
    assert!(cloth.reflect(Vec3::X, Vec3::Z).x < 1e-3);
    assert_eq!(cloth.reflect(Vec3::Y, Vec3::Z).x, 1.0);
    // With its cosine: 60 degrees from the normal, in the plane across.
    let cloth = line(Some(diffuse), None, true);
    let sixty = Vec3::new(0.0, 60f32.to_radians().sin(), 0.5);
    assert!((cloth.reflect(sixty, Vec3::Z).x - 0.5).abs() < 1e-6);
    assert_eq!(cloth.reflect(-Vec3::Z, Vec3::Z), Vec3::ZERO);
}

#[test]
fn warp_and_weft_change_places_in_a_quarter_turn() {
    let (a, b) = (fibre(9.0), Fibre { weight: 0.4, specular: Vec3::new(1.0, 0.5, 0.2), ..fibre(20.0) });
    let (cloth, swapped) = (line(Some(a), Some(b), true), line(Some(b), Some(a), true));
    let turn = |x: Vec3| Vec3::new(-x.y, x.x, x.z);
    for to_light in directions() {
        for to_viewer in directions().step_by(5) {
            let difference =
                cloth.reflect(to_light, to_viewer) - swapped.reflect(turn(to_light), turn(to_viewer));
            assert!(difference.length() < 1e-5);
        }
    }
}

#[test]
fn what_the_symmetry_promises_is_so_and_no_more() {
    let cases = [
        (line(Some(fibre(9.0)), None, true), 2),
        (line(Some(fibre(9.0)), Some(fibre(10.0)), true), 2),
        (line(Some(fibre(9.0)), Some(fibre(9.0)), true), 4),
    ];
    for (cloth, order) in cases {
        assert_eq!(cloth.symmetry().order(), order);
        let change = |order: u32| {
            let turn = glam::Quat::from_rotation_z(std::f32::consts::TAU / order as f32);
            let pairs = directions().flat_map(|l| directions().step_by(5).map(move |v| (l, v)));
            pairs
                .map(|(l, v)| (cloth.reflect(l, v) - cloth.reflect(turn * l, turn * v)).length())
                .fold(0.0, f32::max)
        };
        assert!(change(order) < 1e-5);
        assert!(change(2 * order) > 1e-2);
    }
}

#[test]
fn the_bundled_fabrics_parse_and_have_lights() {
    for fabric in BUNDLED {
        let description = fabric.description().unwrap();
        assert!(!description.name.is_empty() && description.lighting.is_some());
    }
    assert_eq!(bundled("satin").unwrap().description().unwrap().reflectance.symmetry(), Symmetry::Two);
    assert!(bundled("velvet").unwrap_err().to_string().contains("these are: satin"));
}

#[test]
fn refusals_have_a_place() {
    let json =
        |parameters: &str| format!("{{\"version\": 1, \"model\": \"line\",\n \"parameters\": {parameters}}}");
    let refused = |text: &str| parse(text).unwrap_err().to_string();
    let warp = |exponent: &str| {
        json(&format!(r#"{{"warp": {{"diffuse": [0,0,0], "specular": [1,1,1], "exponent": {exponent}}}}}"#))
    };
    assert!(parse(&warp("10")).is_ok());
    assert!(refused(&warp("0.5")).starts_with("parameters.warp.exponent: 0.5 must be 1 or more"));
    assert!(
        refused(&warp("true")).starts_with("line 2, column 82: invalid type"),
        "{}",
        refused(&warp("true"))
    );
    assert!(refused(&json("{}")).contains("a cloth needs `warp` or `weft`"));
    assert!(refused(&json(r#"{"wrap": 1}"#)).starts_with("line 2, column"));
    let unknown = refused(r#"{"version": 1, "model": "velvet", "parameters": {"x": 1}}"#);
    assert_eq!(unknown, "model: the model \"velvet\" is not known; these are: line");
    assert!(refused(r#"{"version": 9, "model": "line", "parameters": {}}"#).contains("version 9"));
    assert!(refused("{\"version\": 1,").starts_with("line 1, column"));
}

#[test]
fn lights_without_direction_or_with_darkness_are_refused() {
    let light = |towards: &str, irradiance: &str| {
        Lighting::parse(&format!(r#"{{"lights": [{{"towards": {towards}, "irradiance": {irradiance}}}]}}"#))
    };
    assert!(light("[0, 0, 5]", "[1, 1, 1]").is_ok());
    let error = light("[0, 0, 0]", "[1, 1, 1]").unwrap_err();
    assert_eq!(
        (error.kind(), error.to_string().starts_with("lights[0].towards")),
        (ErrorKind::Invalid, true)
    );
    assert!(light("[0, 0, 1]", "[1, -1, 1]").is_err());
    assert!(light("[0, 0, 1]", "[1, 1]").unwrap_err().to_string().starts_with("line 1"));
}
