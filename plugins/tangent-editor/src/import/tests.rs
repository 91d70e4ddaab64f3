use std::f32::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use amc_core::direction::{self, Field};
use amc_core::export;
use amc_core::mesh::{self, Mesh, Part, Unit};
use glam::{Mat2, Vec3};
use studio_plugin::document::{Document, Project};

use super::*;
use crate::assignments::{Assignment, Assignments};
use crate::tech_sheet::{self, Said};

/// Flat pieces of cloth of these outlines, fans about their first corner, on UVs that are their places after `to_uv`.
fn cut(outlines: &[(&str, Vec<Vec2>)], to_uv: Mat2) -> Garment {
    let mut mesh = Mesh { uvs: Some(Vec::new()), ..Mesh::default() };
    for (part, (name, line)) in outlines.iter().enumerate() {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(line.iter().map(|at| (*at + 2.0 * part as f32).extend(0.0)));
        mesh.uvs.as_mut().unwrap().extend(line.iter().map(|at| to_uv * (*at + 3.0 * part as f32)));
        let fan = 1..line.len() as u32 - 1;
        mesh.triangle_parts.extend(fan.clone().map(|_| part as u32));
        mesh.triangles.extend(fan.map(|k| [first, first + k, first + k + 1]));
        let name = (*name).to_owned();
        mesh.parts.push(Part { name, takes_fabric: true, ..Part::default() });
    }
    mesh.normals = vec![Vec3::Z; mesh.positions.len()];
    mesh.file_vertices = mesh.positions.len();
    Garment::new(mesh).unwrap()
}

fn polygon(corners: &[(f32, f32)]) -> Vec<Vec2> {
    corners.iter().map(|&(x, y)| Vec2::new(x, y)).collect()
}

fn front() -> Vec<Vec2> {
    polygon(&[(0.0, 0.0), (0.5, 0.0), (0.55, 0.4), (0.3, 0.7), (0.0, 0.6)])
}

fn sleeve() -> Vec<Vec2> {
    polygon(&[(0.0, 0.0), (0.3, 0.05), (0.35, 0.5), (0.1, 0.55)])
}

fn pieces() -> Vec<(&'static str, Vec<Vec2>)> {
    let right = sleeve().iter().rev().map(|at| Vec2::new(1.0 - at.x, at.y)).collect();
    vec![("Front", front()), ("Left sleeve", sleeve()), ("Right sleeve", right)]
}

fn shirt(variant: &str) -> Garment {
    let path = format!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/garments/{}"), variant);
    Garment::new(mesh::read(Path::new(&path), Unit::Metre).unwrap()).unwrap()
}

/// Some direction for each panel, of both sources.
fn directions(garment: &Garment) -> Vec<Direction> {
    let angle = |k: usize| [0.0, 30.0, 45.0, 90.0, -12.3, 171.7][k % 6];
    let source = |k: usize| if k % 4 < 2 { Source::Gradient } else { Source::Yarn };
    let of = |k: usize| Direction { source: source(k), angle: f32::to_radians(angle(k)) };
    (0..garment.panels.len()).map(of).collect()
}

fn said(garment: &Garment) -> Vec<Said> {
    let of = |(k, direction): (usize, Direction)| Said {
        direction,
        fabric: (k == 1).then(|| "Silk".to_owned()),
        assignment: Assignment {
            orientation: Orientation::ALL[k % 3],
            is_locked: k == 2,
            is_linked: k == 1,
            ..Assignment::default()
        },
    };
    directions(garment).into_iter().enumerate().map(of).collect()
}

/// Saves the directions to a file of this name, and reads it for `to`, whose panels run along their grain.
fn exchanged(garment: Garment, name: &str, to: &Garment) -> Import {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    let said = said(&garment);
    if tech_sheet::is_tech_sheet(&path) {
        tech_sheet::save("a", Arc::new(garment), &said, &path, &Progress::none()).unwrap();
    } else {
        let directions = directions(&garment);
        let made = direction::tangents(&garment, &directions).unwrap();
        let said: Vec<export::Said> = said.iter().map(Said::exported).collect();
        export::tangents(&garment, &made, &directions, &said, &path).unwrap();
    }
    let now: Vec<Direction> = to.panels.iter().map(Direction::along_grain).collect();
    read(to, &now, &path, &Progress::none()).unwrap()
}

/// How far the warp of a panel is from where it was, on the flat cloth, degrees.
fn off(garment: &Garment, found: &Found, expected: Direction) -> f32 {
    let metres = garment.uv_to_drawn_metres(&garment.panels[found.panel]).unwrap().matrix2;
    let [a, b] = [found.direction.unwrap(), expected].map(|direction| direction.on_cloth(metres));
    a.perp_dot(b).atan2(a.dot(b)).to_degrees().abs()
}

#[test]
fn what_is_written_is_read_again_in_every_format() {
    for (variant, name, bound) in [
        ("shirt.glb", "a.json", 0.0),
        ("shirt.glb", "a.glb", 0.0),
        ("shirt.glb", "a.dxf", 0.1),
        ("variants/shirt-turned.glb", "a.dxf", 0.1),
    ] {
        let garment = shirt(variant);
        let import = exchanged(garment.clone(), name, &garment);
        let expected = directions(&garment);
        assert_eq!(import.notices, Vec::<String>::new(), "{variant} {name}");
        assert_eq!(
            import.found.len(),
            garment.panels.iter().filter(|panel| has_outline(&garment, panel)).count()
        );
        let mut worst = 0f32;
        for found in &import.found {
            let expected = expected[found.panel];
            worst = worst.max(off(&garment, found, expected));
            assert_eq!(found.orientation, Some(Orientation::ALL[found.panel % 3]));
            if bound == 0.0 {
                assert_eq!(found.direction, Some(expected));
                assert_eq!(found.fabric.as_deref(), (found.panel == 1).then_some("Silk"));
                assert_eq!(
                    (found.is_locked, found.is_linked),
                    (Some(found.panel == 2), Some(found.panel == 1))
                );
            }
        }
        assert!(worst <= bound, "{variant} {name}: {worst}");
        println!("{variant} by {name}: worst {worst} degrees");
    }
}

fn has_outline(garment: &Garment, panel: &mesh::Panel) -> bool {
    garment.uv_to_drawn_metres(panel).is_some()
}

/// A DXF as another program may write it: each outline after `place`, in millimetres, with its grain.
fn foreign(blocks: &[(&str, Vec<Vec2>, Vec2)], place: impl Fn(Vec2) -> Vec2) -> Vec<u8> {
    let mut text = "0\nSECTION\n2\nBLOCKS\n".to_owned();
    for (name, line, grain) in blocks {
        text += &format!("0\nBLOCK\n8\n1\n2\n{name}\n0\nPOLYLINE\n8\n1\n66\n1\n70\n1\n");
        for at in line.iter().map(|at| 1000.0 * place(*at)) {
            text += &format!("0\nVERTEX\n8\n1\n10\n{:.4}\n20\n{:.4}\n", at.x, at.y);
        }
        let [a, b] = [Vec2::ZERO, 0.1 * *grain].map(|at| 1000.0 * place(at));
        text += &format!(
            "0\nSEQEND\n0\nLINE\n8\n7\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n0\nENDBLK\n",
            a.x, a.y, b.x, b.y
        );
    }
    (text + "0\nENDSEC\n0\nEOF\n").into_bytes()
}

fn placed(garment: &Garment, dxf: &[u8]) -> Result<Import> {
    let now = vec![Direction::default(); garment.panels.len()];
    place(garment, &now, &parse_dxf(dxf)?, &Progress::none())
}

#[test]
fn a_foreign_dxf_is_matched_by_name_and_shape_and_turned_back() {
    // Drawn out and turned UVs: what counts is the cloth.
    let to_uv = Mat2::from_diagonal(Vec2::new(0.2, 0.5)) * Mat2::from_angle(0.3);
    let garment = cut(&pieces(), to_uv);
    let grains = [0.2f32, 1.7, PI - 1.7].map(Vec2::from_angle);
    let names = ["front", "AB-1", "AB-2"];
    let blocks: Vec<(&str, Vec<Vec2>, Vec2)> = pieces()
        .into_iter()
        .zip(names)
        .zip(grains)
        .map(|(((_, line), name), grain)| (name, line, grain))
        .collect();
    for degrees in [0.0f32, 33.0, -90.0, 180.0] {
        let turn = Mat2::from_angle(degrees.to_radians());
        let import = placed(&garment, &foreign(&blocks, |at| turn * at + Vec2::new(3.0, -1.0))).unwrap();
        assert_eq!(import.found.len(), 3, "{:?}", import.notices);
        for (found, grain) in import.found.iter().zip(grains) {
            // On the panel as its flat cloth: UVs of no unit are laid as the surface has them in the mean.
            let metres = garment.uv_to_drawn_metres(&garment.panels[found.panel]).unwrap().matrix2;
            let expected = metres * (to_uv * grain);
            let is = found.direction.unwrap().on_cloth(metres);
            let off = is.perp_dot(expected).atan2(is.dot(expected)).to_degrees();
            assert!(off.abs() < 0.1, "turned by {degrees}, panel {}: {off}", found.panel);
        }
        assert!(
            import.notices.iter().any(|it| it == "AB-1 is known by its shape: Left sleeve"),
            "{:?}",
            import.notices
        );
    }
}

#[test]
fn what_is_not_clear_is_said_and_left_out() {
    let garment = cut(&pieces(), Mat2::IDENTITY);
    // One sleeve for two: which of the panels is meant is not said, but it lies as the left one does.
    let import =
        placed(&garment, &foreign(&[("ARM", sleeve(), Vec2::Y), ("X", front(), Vec2::X)], |at| at)).unwrap();
    assert_eq!(import.found.iter().map(|found| found.panel).collect::<Vec<_>>(), [1, 0]);
    assert!(
        import.notices.iter().any(|it| it.ends_with("says nothing of: Right sleeve")),
        "{:?}",
        import.notices
    );
    // To be cut twice, it is both; the right one mirrored.
    let text = String::from_utf8(foreign(&[("ARM", sleeve(), Vec2::from_angle(1.2))], |at| at)).unwrap();
    let twice = text.replace("0\nENDBLK", "0\nTEXT\n1\nQuantity: 2\n0\nENDBLK");
    let import = placed(&garment, twice.as_bytes()).unwrap();
    assert_eq!(import.found.iter().map(|found| found.panel).collect::<Vec<_>>(), [1, 2]);
    for (found, angle) in import.found.iter().zip([1.2, PI - 1.2]) {
        assert!((found.direction.unwrap().angle - angle).abs() < 1e-3, "{found:?}");
    }
    assert!(import.notices.iter().any(|it| it.contains("mirrored")), "{:?}", import.notices);

    let square = polygon(&[(0.0, 0.0), (0.4, 0.0), (0.4, 0.4), (0.0, 0.4)]);
    let alike =
        cut(&[("Front", front()), ("Pocket", square.clone()), ("Flap", square.clone())], Mat2::IDENTITY);
    let import =
        placed(&alike, &foreign(&[("Front", front(), Vec2::Y), ("Q", square.clone(), Vec2::Y)], |at| at))
            .unwrap();
    assert_eq!(import.found.len(), 1);
    assert!(
        import.notices.iter().any(|it| it.starts_with("Q may be any of") && it.ends_with("Pocket, Flap"))
    );
    // Too large, and of another shape.
    let other: Vec<Vec2> = front().iter().map(|at| 1.3 * *at).collect();
    let import =
        placed(&alike, &foreign(&[("Front", front(), Vec2::Y), ("Big", other, Vec2::Y)], |at| at)).unwrap();
    assert!(import.notices[0].contains("left out: Big"), "{:?}", import.notices);
    let none = placed(&alike, &foreign(&[("Scarf", sleeve(), Vec2::Y)], |at| at)).unwrap_err();
    assert!(none.to_string().contains("Scarf"), "{none}");
    // Named right, but not the panel's outline: as drawn, and said.
    let import = placed(&alike, &foreign(&[("Front", sleeve(), Vec2::Y)], |at| at)).unwrap();
    assert!((import.found[0].direction.unwrap().angle - FRAC_PI_2).abs() < 1e-4);
    assert!(import.notices.iter().any(|it| it.contains("as drawn")), "{:?}", import.notices);
}

/// A GLB without what only we write, so that its anisotropy must speak.
fn without_extras(path: &Path) {
    let bytes = file::read(path, 1 << 26).unwrap();
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let text = String::from_utf8(bytes[20..20 + length].to_vec()).unwrap();
    let foreign = text.replace("\"extras\":", "\"other_\":");
    file::save_bytes(path, &[&bytes[..20], foreign.as_bytes(), &bytes[20 + length..]].concat()).unwrap();
}

#[test]
fn a_foreign_glb_says_it_by_its_anisotropy() {
    let to_uv = Mat2::from_diagonal(Vec2::new(-0.2, 0.5)) * Mat2::from_angle(0.3);
    let garment = cut(&pieces(), to_uv);
    assert!(garment.panels.iter().all(|panel| panel.flags.mirrored));
    let expected = directions(&garment);
    let made = direction::tangents(&garment, &expected).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.glb");
    export::tangents(&garment, &made, &expected, &[], &path).unwrap();
    without_extras(&path);
    // Its first UVs are turned: the outlines tell by how much.
    let now = vec![Direction::default(); 3];
    let import = read(&garment, &now, &path, &Progress::none()).unwrap();
    assert_eq!(import.found.len(), 3);
    for found in &import.found {
        let off = off(&garment, found, expected[found.panel]);
        assert!(off < 0.1, "{}: {off}", found.panel);
    }
    assert!(import.notices.iter().any(|it| it.contains("against the panel")), "{:?}", import.notices);
}

#[test]
fn our_own_glb_is_understood_by_a_garment_that_was_opened_from_it() {
    let garment = cut(&pieces(), Mat2::IDENTITY);
    let expected = directions(&garment);
    let made = direction::tangents(&garment, &expected).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.glb");
    export::tangents(&garment, &made, &expected, &[], &path).unwrap();
    // There the pattern is turned: the warp runs along +u, not at the angle in the extras.
    let opened = Garment::new(mesh::read(&path, Unit::Metre).unwrap()).unwrap();
    let import = read(&opened, &[Direction::default(); 3], &path, &Progress::none()).unwrap();
    for found in &import.found {
        assert!(found.direction.unwrap().angle.abs() < 0.1f32.to_radians(), "{found:?}");
    }
}

#[test]
fn a_json_made_by_hand_says_what_it_says_and_no_more() {
    let garment = cut(&pieces(), Mat2::IDENTITY);
    let now = vec![Direction { source: Source::Yarn, angle: 0.5 }; 3];
    let read = |text: &str| place(&garment, &now, &parse_json(text.as_bytes())?, &Progress::none());
    let import = read(
        r#"{"panels": [{"name": "LEFT_SLEEVE", "angle_deg": 450}, {"id": "front", "orientation": "nap", "note": [1]},
        {"id": "gone", "name": "Hood"}, {"name": "front", "angle_deg": 1}]}"#,
    )
    .unwrap();
    let [sleeve, front] = import.found.try_into().unwrap();
    assert_eq!((sleeve.panel, front.panel), (1, 0));
    assert_eq!(sleeve.direction, Some(Direction { source: Source::Yarn, angle: FRAC_PI_2 }));
    assert_eq!((front.direction, front.orientation), (None, Some(Orientation::Nap)));
    let told = import.notices.join("\n");
    for part in ["left out: Hood", "the first counts: front", "says nothing of: Right sleeve"] {
        assert!(told.contains(part), "{part}: {told}");
    }
    let field =
        read(r#"{"panels": [{"id": "front", "source": {"field": {"along": {"direction": [0, 1, 0]}}}}]}"#);
    let along = Source::Field(Field::Along { direction: Vec3::Y });
    assert_eq!(field.unwrap().found[0].direction, Some(Direction { source: along, angle: 0.5 }));
    for (wrong, part) in [
        ("", "no JSON of directions"),
        ("[]", "no JSON of directions"),
        (r#"{"version": 2, "panels": []}"#, "version 2"),
        (r#"{"panels": []}"#, "says nothing of any panel"),
        (r#"{"panels": [{"angle_deg": 3}]}"#, "panels[0]: neither id nor name"),
        (r#"{"panels": [{"id": "front", "angle_deg": 1e999}]}"#, "out of range"),
        (r#"{"panels": [{"id": "front", "angle_deg": "north"}]}"#, "line 1"),
        (
            r#"{"panels": [{"id": "front", "source": {"field": {"along": {"direction": [0, 0, 0]}}}}]}"#,
            "axis",
        ),
        (r#"{"panels": [{"id": "front", "orientation": "both"}]}"#, "both"),
    ] {
        let error = read(wrong).unwrap_err().to_string();
        assert!(error.contains(part), "{wrong}: {error}");
    }
    let many = format!(r#"{{"panels": [{}{{}}]}}"#, "{},".repeat(MOST_PIECES));
    assert!(read(&many).unwrap_err().to_string().contains("more than"));
}

#[test]
fn edits_keep_locked_panels_and_name_what_is_not_there() {
    let garment = cut(&pieces(), Mat2::IDENTITY);
    let mut document = Document::new(Project::default());
    let lock = Assignments::default()
        .changed(["left-sleeve"], "Lock".to_owned(), |assignment| assignment.is_locked = true);
    document.submit(lock, None).unwrap();
    let direction = Direction { source: Source::Yarn, angle: 0.5 };
    let found = |panel: usize, fabric: &str| Found {
        panel,
        direction: Some(direction),
        orientation: Some(Orientation::OneWay),
        fabric: Some(fabric.to_owned()),
        ..Found::default()
    };
    let import =
        Import { found: vec![found(0, "Satin"), found(1, "Tulle"), found(2, "Tulle")], notices: Vec::new() };
    let planned = edits(&import, &garment, document.project()).unwrap();
    let told = planned.notices.join("\n");
    assert!(told.contains("stays: Left sleeve") && told.contains("of these names: Tulle"), "{told}");
    planned.edits.into_iter().for_each(|edit| document.submit(edit, None).unwrap());
    let look = |panel: usize| document.project().look_of(&garment.panels[panel]);
    assert_eq!([0, 1, 2].map(|panel| look(panel).direction), [Some(direction), None, Some(direction)]);
    let kept = Assignments::of(document.project()).unwrap();
    let sleeve = kept.panel("left-sleeve");
    assert_eq!((sleeve.orientation, sleeve.is_locked), (Orientation::OneWay, true));
    assert_eq!(document.project().panels["front"].fabric, Some(Some(document.project().fabrics[0].id)));
}

#[test]
fn another_suffix_is_refused_by_name() {
    let error =
        read(&Garment::default(), &[], Path::new("a.xlsx"), &Progress::none()).unwrap_err().to_string();
    assert!(error.starts_with("a.xlsx: ") && error.contains(".dxf"), "{error}");
}
