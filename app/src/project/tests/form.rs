//! The form of a `.amcproj`: versions, faults with their places, unknown keys.

use std::path::Path;

use amc_core::ErrorKind;
use serde_json::{Value, json};
use studio_plugin::document::{Angles, Asset, Colourways, FabricId, Project};

use super::super::{FILE_LIMIT, Unknown, encode, parse};
use super::rich;

fn refusal(text: &str) -> amc_core::Error {
    parse(text.as_bytes(), None).unwrap_err()
}

#[test]
fn a_written_project_is_read_as_it_was() {
    let folder = Path::new(if cfg!(windows) { r"C:\clothes\coat" } else { "/clothes/coat" });
    for project in [Project::default(), rich(folder)] {
        let bytes = encode(&project, &Unknown::default(), Some(folder)).unwrap();
        let read = parse(&bytes, Some(folder)).unwrap();
        assert_eq!((&read.project, read.version), (&project, 1));
        assert_eq!(read.unknown, Unknown::default());
    }
}

#[test]
fn people_can_read_what_is_written() {
    let folder = Path::new(if cfg!(windows) { r"C:\clothes\coat" } else { "/clothes/coat" });
    let bytes = encode(&rich(folder), &Unknown::default(), Some(folder)).unwrap();
    let value: Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!(value["version"], 1);
    assert_eq!(value["garment"]["path"], "coat.glb");
    assert_eq!(value["fabrics"][0]["asset"], "fabric:satin");
    assert_eq!(value["fabrics"][1]["asset"]["path"], "fabrics/silk.amc.ktx2");
    assert_eq!(value["fabrics"][2]["asset"]["path"], "../library/tweed.amc.ktx2");
    assert_eq!(value["panels"]["panel-1"]["direction"]["angle_deg"], 90.0);
    assert_eq!(value["panels"]["panel-1"]["fabric"], Value::Null);
    assert_eq!(value["panels"]["panel-2"]["print"]["picture"]["path"], "prints/roses.png");
    assert_eq!(value["changes"][0]["merge"][1], "panel-4");
    assert_eq!(value["changes"][1]["split"]["into"][0], "panel-1-1");
    assert_eq!(
        (&value["names"]["panel-2"], &value["groups"]["body"][1]),
        (&json!("Ärmel"), &json!("panel-2"))
    );
    assert!(value["panels"]["panel-0"].get("fabric").is_none(), "as by default");
    assert_eq!(value["worn_colourway"], 0);
    assert_eq!(value["colourways"][1], json!({"id": 0, "name": "Summer"}), "its panels are the project's");
    let winter = &value["colourways"][2]["panels"];
    assert_eq!(winter["panel-0"]["fabric"], 4);
    assert_eq!(winter["panel-0"]["print"]["picture"]["path"], "prints/snow.png");
    assert_eq!(winter["panel-1"], json!({"fabric": null}));
}

#[test]
fn a_project_without_colourways_has_one() {
    let text = r#"{"version": 1, "fabrics": [{"id": 3, "asset": "fabric:satin"}],
        "panels": {"front": {"fabric": null}}}"#;
    let project = parse(text.as_bytes(), None).unwrap().project;
    assert_eq!(project.colourways, Colourways::default());
    assert_eq!(project.look("front").fabric, None);
    // By hand: the first is worn unless another is said to be.
    let text = r#"{"version": 1, "colourways": [{"id": 5, "name": "A"}, {"id": 2, "name": "B", "panels": {"x": {}}}]}"#;
    let project = parse(text.as_bytes(), None).unwrap().project;
    assert_eq!((project.colourways.worn().id.number(), project.colourways.count()), (5, 2));
}

#[test]
fn any_angle_comes_back_to_the_last_bit() {
    let mut project = Project::default();
    let mut bits = 1_u32;
    for _ in 0..2000 {
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let angle = f32::from_bits(bits);
        if angle.is_finite() {
            let direction = Some(amc_core::direction::Direction { angle, ..Default::default() });
            let choice = studio_plugin::document::PanelChoice { direction, ..Default::default() };
            project.panels.insert(format!("panel-{bits}"), choice);
        }
    }
    assert!(project.panels.len() > 1900);
    let bytes = encode(&project, &Unknown::default(), None).unwrap();
    assert_eq!(parse(&bytes, None).unwrap().project, project);
}

#[test]
fn any_view_comes_back_to_the_last_bit() {
    let mut project = Project::default();
    for k in 0..500 {
        let angle = |step: f64| f64::from(k) * step;
        project.view.set_angles(Angles { yaw: angle(7.1), pitch: angle(3.3), roll: angle(0.9) });
        project.view.pan = glam::Vec2::new(angle(0.013) as f32, -angle(0.7) as f32);
        let bytes = encode(&project, &Unknown::default(), None).unwrap();
        assert_eq!(parse(&bytes, None).unwrap().project, project, "{k}");
    }
}

#[test]
fn a_project_written_by_hand_may_leave_out_almost_everything() {
    let bare = parse(br#"{"version": 1}"#, None).unwrap().project;
    assert_eq!(bare, Project { fabrics: Vec::new(), ..Project::default() });
    let text = r#"{"version": 1, "garment": "coat.obj", "fabrics": [{"id": 3, "asset": "silk.amc.ktx2"}],
        "panels": {"front": {}, "back": {"direction": {"angle_deg": 180}}}}"#;
    let project = parse(text.as_bytes(), None).unwrap().project;
    assert_eq!((&project.garment, &*project.fabrics[0].name), (&Asset::file("coat.obj"), "silk"));
    let look = project.look("front");
    assert_eq!((look.fabric, look.direction, look.visible), (Some(FabricId::new(3)), None, true));
    assert_eq!(project.look("back").direction.unwrap().angle, std::f32::consts::PI);
}

#[test]
fn version_0_is_read() {
    let text = r#"{"garment": "shape:sheet", "fabric": "cloth/old-silk.amc.ktx2", "for": "Ada"}"#;
    let read = parse(text.as_bytes(), Some(Path::new(if cfg!(windows) { r"C:\p" } else { "/p" }))).unwrap();
    assert_eq!(read.version, 0);
    assert_eq!(read.project.garment, Asset::Bundled("shape:sheet".to_owned()));
    let [fabric] = &read.project.fabrics[..] else { panic!("one fabric for all") };
    let silk = Path::new(if cfg!(windows) { r"C:\p" } else { "/p" }).join("cloth").join("old-silk.amc.ktx2");
    assert_eq!((fabric.asset.path(), fabric.name.as_str()), (Some(&*silk), "old-silk"));
    assert_eq!(read.project.look("any").fabric, Some(fabric.id));
    // Saved, it is of version 1 and has lost nothing.
    let bytes = encode(&read.project, &read.unknown, None).unwrap();
    let value: Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!((&value["version"], &value["for"]), (&json!(1), &json!("Ada")));
    let default = parse(b"{}", None).unwrap().project;
    assert_eq!(default.garment, Project::default().garment);
    assert_eq!(default.fabrics[0].asset, Project::default().fabrics[0].asset);
}

#[test]
fn faults_have_a_place_and_a_reason() {
    let said = |text: &str| refusal(text).to_string();
    assert_eq!(said("{\n  \"version\": 1,\n  \"notes\": 7\n}").split(": ").next(), Some("line 3, column 12"));
    assert!(
        said("{\n\"version\": 1,,}").starts_with("line 2, column 14: "),
        "{}",
        said("{\n\"version\": 1,,}")
    );
    assert!(said("[]").contains("an object"));
    assert!(said("").starts_with("line 1, column 0: "));
    assert!(said(r#"{"version": -1}"#).starts_with("version: "));
    assert!(said(r#"{"garment": 3}"#).starts_with("garment: "));
    assert!(said(r#"{"panels": {}}"#).contains("add \"version\": 1"));
    assert!(said(r#"{"version": 1, "view": {"zoom": 1e30}}"#).starts_with("view, zoom: "));
    assert!(said(r#"{"version": 1, "garment": {"file": "a"}}"#).contains("an asset is a name"));
    assert!(said(r#"{"version": 1, "panels": {"a": {"fabric": 5}}}"#).starts_with("panels.a: "));
    let twice = r#"{"version": 1, "fabrics": [{"id": 1, "asset": "fabric:satin"}, {"id": 1, "asset": "fabric:satin"}]}"#;
    assert!(said(twice).starts_with("fabrics[1]: "));
    assert!(
        said(r#"{"version": 1, "panels": {"a": {"direction": {"angle_deg": 1e300}}}}"#).contains("finite")
    );
    let colourways = |list: &str| said(&format!("{{\"version\": 1, \"colourways\": {list}}}"));
    assert!(colourways(r#"[{"id": 1, "name": "A"}, {"id": 1, "name": "B"}]"#).starts_with("colourways[1]: "));
    assert!(colourways(r#"[{"id": 1, "name": "A"}, {"id": 2, "name": "A"}]"#).contains("called 'A'"));
    assert!(colourways(r#"[{"id": 1, "name": "A"}], "worn_colourway": 2"#).starts_with("colourways: "));
    assert!(
        colourways(r#"[{"id": 1, "name": "A", "panels": {"x": {"fabric": null}}}]"#).contains("'A' is worn")
    );
    let panels = r#"[{"id": 1, "name": "A"}, {"id": 2, "name": "B", "panels": {"x": {"fabric": 5}}}]"#;
    assert!(colourways(panels).starts_with("colourways[1].panels.x: "));
    assert!(said(&format!("{{\"a\": {}", "[".repeat(100_000))).contains("recursion"));
    let newer = refusal(r#"{"version": 2, "garment": {"new": "form"}}"#);
    assert_eq!(newer.kind(), ErrorKind::Unsupported);
    assert!(newer.to_string().contains("newer AMC Studio"), "{newer}");
    let large = parse(&vec![b' '; FILE_LIMIT as usize + 1], None).unwrap_err();
    assert_eq!(large.kind(), ErrorKind::TooLarge);
}

#[test]
fn what_could_not_be_read_again_is_not_written() {
    // A control character is six bytes in JSON.
    let mut project = Project { notes: "\u{1}".repeat(Project::LONGEST_NOTES), ..Project::default() };
    for k in 0..11_000 {
        project.panels.insert(format!("{k:01000}"), Default::default());
    }
    project.check().unwrap();
    let error = encode(&project, &Unknown::default(), None).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::TooLarge);
}

#[test]
fn keys_of_a_newer_program_survive_a_save() {
    let text = json!({
        "version": 1,
        "garment": {"path": "coat.glb", "lining": true},
        "fabrics": [
            {"id": 1, "name": "A", "asset": "fabric:satin", "price": {"euro": 12.5}},
            {"id": 2, "name": "B", "asset": "fabric:satin", "price": 3},
        ],
        "panels": {
            "front": {"fabric": 2, "visible": true, "pleats": [1, 2]},
            "back": {"fabric": 1, "hem": "blind"},
        },
        "colourways": [
            {"id": 4, "name": "A", "season": 2},
            {"id": 6, "name": "B", "panels": {"front": {"fabric": 2, "dye": "madder"}}},
        ],
        "render": {"samples": 64},
    });
    let mut read = parse(&serde_json::to_vec(&text).unwrap(), None).unwrap();
    read.project.fabrics.remove(0);
    read.project.panels.remove("back");
    let bytes = encode(&read.project, &read.unknown, None).unwrap();
    let value: Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!(value["render"], json!({"samples": 64}));
    assert_eq!(value["garment"]["lining"], true);
    assert_eq!((&value["fabrics"][0]["id"], &value["fabrics"][0]["price"]), (&json!(2), &json!(3)));
    assert_eq!(value["panels"]["front"]["pleats"], json!([1, 2]));
    assert_eq!(value["colourways"][0]["season"], 2);
    assert_eq!(value["colourways"][1]["panels"]["front"]["dye"], "madder");
    assert!(value["panels"].get("back").is_none(), "it went with its panel");
    let again = parse(&bytes, None).unwrap();
    assert_eq!(encode(&again.project, &again.unknown, None).unwrap(), bytes);
}
