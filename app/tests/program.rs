//! The program as its user runs it: every command once, and every refusal with its exit status and its one line.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use studio_tests::materials::{Facets, three_lights};
use tempfile::TempDir;

/// The program with its caches in `folder`, run in `folder`.
fn run(folder: &Path, arguments: &[&str]) -> Output {
    program(folder, arguments).output().unwrap()
}

fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_amc-studio"));
    program
        .args(arguments)
        .current_dir(folder)
        .env("XDG_CACHE_HOME", folder.join("cache"))
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY");
    program
}

fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&done(folder, &[arguments, &["--json"]].concat())).unwrap()
}

/// The one line of a failure.
fn refused(folder: &Path, arguments: &[&str], status: i32) -> String {
    let output = run(folder, arguments);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {message}");
    let last: Vec<_> = message.lines().filter(|line| line.starts_with("amc-studio: ")).collect();
    if status == 1 {
        assert_eq!(last.len(), 1, "one line: {message}");
        assert!(!message.contains("panicked"), "{message}");
    }
    message
}

fn scratch() -> TempDir {
    tempfile::tempdir().unwrap()
}

#[test]
fn without_a_command_and_a_display_it_makes_a_picture_and_says_where() {
    let folder = scratch();
    let read = || amc_core::image::decode::read(&folder.path().join("amc-studio.png")).unwrap();
    let said = done(folder.path(), &[]);
    assert!(said.contains("amc-studio.png"), "{said}");
    let picture = read();
    let covered = picture.pixels().iter().filter(|pixel| pixel[3] > 0.5).count();
    assert!(covered > picture.pixels().len() / 5, "{covered} pixels of cloth");

    // Where no graphics driver is installed the processor draws the same.
    let mut program = program(folder.path(), &[]);
    program.env("VK_DRIVER_FILES", "/none.json").env("__EGL_VENDOR_LIBRARY_FILENAMES", "/none.json");
    let output = program.output().unwrap();
    let noted = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.success() && noted.contains("drawn by the processor: there is no Vulkan"),
        "{noted}"
    );
    let psnr = amc_core::image::compare::psnr_srgb(&read(), &picture).unwrap();
    assert!(psnr > 40.0, "{psnr} dB");
}

#[test]
fn from_pictures_of_a_ball_to_a_garment_in_that_cloth() {
    let folder = scratch();
    let here = folder.path();
    std::fs::create_dir(here.join("turn")).unwrap();
    Facets::new(2).save_turn(&here.join("turn"), &three_lights(), 64, 24, 0.5).unwrap();

    let built = json(here, &["build", "turn", "-o", "cloth.amc.ktx2", "--size", "64"]);
    assert_eq!((&built["symmetry"], &built["isotropic"]), (&Value::from(2), &Value::from(false)));
    assert!((built["ball"]["radius"].as_f64().unwrap() - 32.0).abs() < 0.5, "{built}");
    assert!(built["similarity"]["2"].as_f64().unwrap() < 0.2, "{built}");
    assert!(built["similarity"]["4"].as_f64().unwrap() > 0.5, "{built}");

    let amc = json(here, &["inspect", "cloth.amc.ktx2"]);
    assert_eq!(amc["kind"], "amc");
    assert_eq!((amc["size"].as_u64(), amc["symmetry"].as_u64()), (Some(64), Some(2)));
    assert_eq!((amc["azimuth"].as_str(), amc["frame"].as_str()), (Some("transported"), Some("half")));

    let common =
        ["render", "shape:torus", "--amc", "cloth.amc.ktx2", "--size", "200x160", "--occlusion", "off"];
    done(here, &[&common[..], &["-o", "gpu.png"]].concat());
    done(here, &[&common[..], &["-o", "cpu.png", "--renderer", "cpu"]].concat());
    done(here, &[&common[..], &["-o", "turned.exr", "--panel", "all,angle=90,source=yarn"]].concat());
    let read = |name: &str| amc_core::image::decode::read(&here.join(name)).unwrap();
    let psnr = |a: &str, b: &str| amc_core::image::compare::psnr_srgb(&read(a), &read(b)).unwrap();
    assert!(psnr("gpu.png", "cpu.png") > 45.0, "two renderers, one picture: {}", psnr("gpu.png", "cpu.png"));
    assert!(psnr("gpu.png", "turned.exr") < 30.0, "a turned cloth looks otherwise");
}

#[test]
fn tables_are_baked_converted_and_come_back() {
    let folder = scratch();
    let here = folder.path();
    let satin = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/fabrics/satin.json");
    done(here, &["bake", satin, "-o", "satin.amc.ktx2", "--size", "32", "--slices", "16"]);
    done(here, &["convert", "satin.amc.ktx2", "atlas.png"]);
    done(here, &["convert", "atlas.png", "again.amc.ktx2"]);
    let table = |name: &str| amc_core::amc::Amc::read(&here.join(name)).unwrap();
    assert_eq!(table("satin.amc.ktx2").texels(), table("again.amc.ktx2").texels());
    assert_eq!(table("satin.amc.ktx2").symmetry, table("again.amc.ktx2").symmetry);
    done(here, &["convert", "satin.amc.ktx2", "mean.matcap.png"]);
    done(
        here,
        &["render", "shape:sphere", "-o", "m.png", "--shading", "matcap=mean.matcap.png", "--size", "64x64"],
    );
    done(
        here,
        &[
            "render",
            "shape:sphere",
            "-o",
            "i.png",
            "--amc",
            "satin.amc.ktx2",
            "--shading",
            "isotropic",
            "--size",
            "64x64",
        ],
    );
    let read = |name: &str| amc_core::image::decode::read(&here.join(name)).unwrap();
    let psnr = amc_core::image::compare::psnr_srgb(&read("m.png"), &read("i.png")).unwrap();
    assert!(psnr > 40.0, "the isotropic MatCap is the same by file: {psnr}");
}

#[test]
fn a_damaged_cache_is_said_and_made_anew() {
    let folder = scratch();
    let here = folder.path();
    let render = ["render", "shape:disc-radial", "-o", "a.png", "--size", "32x32", "--renderer", "cpu"];
    done(here, &render);
    let fabrics = here.join("cache/amc-studio/fabrics");
    let cached = std::fs::read_dir(&fabrics).unwrap().next().unwrap().unwrap().path();
    amc_core::file::save_bytes(&cached, b"half a file").unwrap();
    let output = run(here, &render);
    assert!(output.status.success());
    assert!(String::from_utf8(output.stderr).unwrap().contains("warning: the cached fabric is baked anew"));
    assert!(amc_core::amc::Amc::read(&cached).is_ok());
}

#[test]
fn directions_are_exported_and_panels_listed() {
    let folder = scratch();
    let here = folder.path();
    let mesh = json(here, &["inspect", "shape:sheet"]);
    assert_eq!(mesh["kind"], "mesh");
    let panel = &mesh["panels"][0];
    for key in ["id", "name", "triangles", "area", "mirrored", "degenerate", "stretch", "shear"] {
        assert!(!panel[key].is_null(), "{key}: {panel}");
    }
    let id = panel["id"].as_str().unwrap();
    for suffix in ["glb", "obj", "json"] {
        done(
            here,
            &["tangents", "shape:sheet", "-o", &format!("t.{suffix}"), "--panel", &format!("{id},angle=45")],
        );
        assert!(here.join(format!("t.{suffix}")).metadata().unwrap().len() > 100);
    }
    let again = json(here, &["inspect", "t.glb"]);
    assert_eq!(again["triangles"], mesh["triangles"]);
}

#[test]
fn directions_are_imported_and_what_is_not_matched_is_said() {
    let folder = scratch();
    let here = folder.path();
    let panels = |file: &str| -> Vec<Value> {
        let text = std::fs::read_to_string(here.join(file)).unwrap();
        let document: Value = serde_json::from_str(&text).unwrap();
        document["panels"].as_array().unwrap().clone()
    };
    let turned = [
        "--panel",
        "all,angle=20,class=nap",
        "--panel",
        "back,angle=-33.3,amc=fabric:changeant,class=one-way",
    ];
    for suffix in ["dxf", "glb", "json"] {
        let file = format!("said.{suffix}");
        done(here, &[&["tangents", "garment:shirt", "-o", &file][..], &turned].concat());
        let import = ["--import", &file, "--panel", "yoke,angle=7"];
        done(here, &[&["tangents", "garment:shirt", "-o", "again.json"][..], &import].concat());
        for panel in panels("again.json") {
            let (expected, class) = match panel["id"].as_str().unwrap() {
                "back" => (-33.3, "one-way"),
                // Later ones win.
                "yoke" => (7.0, "nap"),
                _ => (20.0, "nap"),
            };
            let angle = panel["angle_deg"].as_f64().unwrap();
            assert!((angle - expected).abs() < 0.1, "{suffix}: {panel}: {angle}");
            assert_eq!(panel["orientation"], class, "{suffix}: {panel}");
            if suffix != "dxf" && expected == -33.3 {
                assert!(panel["fabric"].as_str().unwrap().eq_ignore_ascii_case("changeant"), "{panel}");
            }
        }
    }
    let hand = r#"{"panels": [{"name": "Front", "angle_deg": 12}, {"id": "hood", "angle_deg": 3}]}"#;
    amc_core::file::save_bytes(&here.join("hand.json"), hand.as_bytes()).unwrap();
    let said = json(here, &["tangents", "garment:t-shirt", "--import", "hand.json", "-o", "t.json"]);
    let notices = said["notices"].as_array().unwrap();
    let tells = |part: &str| notices.iter().any(|notice| notice.as_str().unwrap().contains(part));
    assert!(tells("left out: hood") && tells("says nothing of: back"), "{notices:?}");
    for (file, content, part) in [
        ("wrong.json", &b"{\"panels\": 3}"[..], "wrong.json: line 1"),
        ("wrong.dxf", b"0\nSECTION\n", "wrong.dxf: no pieces"),
        ("wrong.glb", b"glTF", "wrong.glb: "),
        ("wrong.txt", b"", "wrong.txt: directions are read from"),
    ] {
        amc_core::file::save_bytes(&here.join(file), content).unwrap();
        let output = run(here, &["tangents", "garment:t-shirt", "--import", file, "-o", "t.json"]);
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(1) && error.contains(part), "{error}");
    }
}

/// A square whose pattern runs its warp along +v.
fn save_upright(file: &Path) {
    use amc_core::mesh::{Garment, Mesh, Part, PatternPiece};
    let uvs = vec![glam::Vec2::ZERO, glam::Vec2::X, glam::Vec2::ONE, glam::Vec2::Y];
    let pattern =
        PatternPiece { grain: Some(std::f32::consts::FRAC_PI_2), uv_unit: Some(1.0), ..Default::default() };
    let mesh = Mesh {
        positions: uvs.iter().map(|uv| uv.extend(0.0)).collect(),
        normals: vec![glam::Vec3::Z; 4],
        uvs: Some(uvs),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        triangle_parts: vec![0; 2],
        parts: vec![Part { name: "Front".to_owned(), takes_fabric: true, pattern }],
        ..Mesh::default()
    };
    amc_core::export::garment(&Garment::new(mesh).unwrap(), file).unwrap();
}

#[test]
fn a_panel_runs_along_its_grain_until_someone_says_otherwise() {
    let folder = scratch();
    let here = folder.path();
    save_upright(&here.join("upright.glb"));
    assert_eq!(json(here, &["inspect", "upright.glb"])["panels"][0]["grain_deg"], 90.0);
    let angle_and_direction = |options: &[&str]| {
        done(here, &[&["tangents", "upright.glb", "-o", "t.json"], options].concat());
        let text = std::fs::read_to_string(here.join("t.json")).unwrap();
        let panel = serde_json::from_str::<Value>(&text).unwrap()["panels"][0].take();
        let direction: glam::Vec3 = serde_json::from_value(panel["mean_direction"].clone()).unwrap();
        (panel["angle_deg"].as_f64().unwrap(), direction)
    };
    for (options, angle, direction) in [
        (&[][..], 90.0, glam::Vec3::Y),
        (&["--panel", "all,source=yarn"], 90.0, glam::Vec3::Y),
        (&["--panel", "front,angle=0"], 0.0, glam::Vec3::X),
        (&["--panel", "front,source=along-x"], 0.0, glam::Vec3::X),
    ] {
        let found = angle_and_direction(options);
        assert!(found.0 == angle && (found.1 - direction).length() < 1e-3, "{options:?}: {found:?}");
    }
}

#[test]
fn what_is_not_there_yet_is_refused_as_such() {
    let folder = scratch();
    let here = folder.path();
    for arguments in [
        &["render", "shape:torus", "-o", "a.png", "--shading", "lines"][..],
        &["microfacet", "fit", "x"],
        &["capture", "-o", "x", "--turntable", "sim:"],
        &["shaders", "x"],
        &["build", "x", "-o", "y.amc.ktx2", "--mask", "m.png"],
        &["build", "x", "-o", "y.amc.ktx2", "--hdr"],
        &["bake", "x.json", "-o", "y.amc.ktx2", "--lights", "room.exr"],
    ] {
        assert!(refused(here, arguments, 2).contains("not available"), "{arguments:?}");
    }
    for arguments in [
        &["render", "shape:torus"][..],
        &["render", "shape:torus", "-o", "a.bmp"],
        &["render", "shape:torus", "-o", "a.gif"],
        &["render", "shape:torus", "-o", "a.exr", "--turn-frames", "4"],
        &["render", "shape:torus", "-o", "a.png", "--views", "inside"],
        &["render", "shape:torus", "-o", "a.png", "--views", "front", "--turn-frames", "4"],
        &["render", "shape:torus", "-o", "a.png", "--size", "0x0"],
        &["render", "shape:torus", "-o", "a.png", "--shading", "gold"],
        &["render", "shape:torus", "-o", "a.png", "--panel", "all,angle=north"],
        &["dance"],
    ] {
        refused(here, arguments, 2);
    }
}

#[test]
fn without_a_display_files_are_not_opened_and_it_says_so() {
    let folder = scratch();
    assert!(refused(folder.path(), &["a.amcproj"], 1).contains("no window can be opened"));
}

#[test]
fn bad_input_gives_one_line_that_names_file_and_reason() {
    let folder = scratch();
    let here = folder.path();
    let write = |name: &str, bytes: &[u8]| amc_core::file::save_bytes(&here.join(name), bytes).unwrap();
    write("point.obj", b"v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n");
    write("nan.obj", b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
    write("index.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    write("empty.glb", b"");
    write("cut.glb", b"glTF\x02\x00\x00\x00\xff\xff\xff\x7f");
    write("noise.amc.ktx2", &[7; 300]);
    write("half.amcproj", b"{\"version\": 1,");
    write(
        "bare.amcproj",
        br#"{"version": 1, "garment": "shape:torus", "fabrics": [{"id": 0, "asset": {"path": "gone.amc.ktx2"}}]}"#,
    );
    write("camera.json", b"{\"world_to_view\": [1, 2]}");
    write(
        "reflectance.json",
        b"{\"version\": 1, \"name\": \"x\", \"model\": \"gold leaf\", \"parameters\": {}}",
    );
    for (arguments, names) in [
        (&["inspect", "missing.obj"][..], "missing.obj"),
        (&["inspect", "missing.amcproj"], "missing.amcproj"),
        (&["render", "missing.amcproj", "-o", "a.png"], "missing.amcproj"),
        (&["render", "half.amcproj", "-o", "a.png"], "half.amcproj: line 1, column"),
        (&["render", "bare.amcproj", "-o", "a.png", "--renderer", "cpu"], "gone.amc.ktx2"),
        (&["render", "shape:torus", "-o", "a.gif", "--turn-frames", "0"], "0 frames"),
        (
            &["render", "shape:torus", "-o", "a.png", "--views", "front,back", "--size", "20000x9"],
            "40000 x 9",
        ),
        (&["inspect", "point.obj"], "point.obj"),
        (&["inspect", "nan.obj"], "nan.obj"),
        (&["inspect", "index.obj"], "index.obj"),
        (&["inspect", "empty.glb"], "empty.glb"),
        (&["inspect", "cut.glb"], "cut.glb"),
        (&["inspect", "noise.amc.ktx2"], "noise.amc.ktx2"),
        (&["inspect", "mystery.xyz"], "mystery.xyz"),
        (&["inspect", "shape:cube"], "torus"),
        (&["inspect", "garment:crinoline"], "no garment 'crinoline' is bundled: there are "),
        (&["render", "shape:torus", "-o", "a.png", "--amc", "fabric:felt"], "satin, changeant"),
        (&["render", "shape:torus", "-o", "a.png", "--panel", "all,amc=fabric:felt"], "no fabric \"felt\""),
        (&["render", "shape:disc-radial", "-o", "a.png", "--camera", "camera.json"], "camera.json"),
        (&["render", "shape:disc-radial", "-o", "a.png", "--panel", "sleeve,angle=3"], "sleeve"),
        (&["bake", "reflectance.json", "-o", "a.amc.ktx2"], "gold leaf"),
        (
            &[
                "render",
                "shape:disc-radial",
                "-o",
                "nowhere/a.png",
                "--renderer",
                "cpu",
                "--occlusion",
                "off",
            ],
            "nowhere",
        ),
    ] {
        let message = refused(here, arguments, 1);
        assert!(message.contains(names), "{arguments:?}: {message}");
    }
}

#[test]
fn bad_pictures_give_one_line_each() {
    let folder = scratch();
    let here = folder.path();
    let cloth = Facets::new(2);
    let turn = |name: &str| {
        std::fs::create_dir(here.join(name)).unwrap();
        cloth.save_turn(&here.join(name), &three_lights(), 32, 8, 0.0).unwrap();
    };
    let save = |picture: &amc_core::image::Picture, name: &str| {
        amc_core::image::encode::write_png(picture, &here.join(name), &[]).unwrap();
    };
    turn("broken");
    amc_core::file::save_bytes(&here.join("broken/0003.png"), b"\x89PNG\r\n\x1a\nnot a picture").unwrap();
    turn("sizes");
    save(&cloth.picture(&three_lights(), 48, 0.0, 0.0, 0).unwrap(), "sizes/0005.png");
    turn("few");
    std::fs::remove_file(here.join("few/0007.png")).unwrap();
    std::fs::create_dir(here.join("grey")).unwrap();
    let grey = amc_core::image::Picture::new(64, 64, vec![[0.2, 0.2, 0.2, 1.0]; 64 * 64]).unwrap();
    for k in 0..8 {
        save(&grey, &format!("grey/{k}.png"));
    }
    std::fs::create_dir(here.join("nothing")).unwrap();
    turn("session");
    amc_core::file::save_bytes(
        &here.join("session/session.json"),
        br#"{"version": 1, "turn": "ccw", "pictures": [{"file": "../../secret.png", "angle_deg": 0}]}"#,
    )
    .unwrap();
    for (source, names) in [
        ("broken", "0003.png"),
        ("sizes", "0005.png"),
        ("few", "8"),
        ("grey", "ball"),
        ("nothing", "nothing"),
        ("session", "session.json"),
        ("missing", "missing"),
    ] {
        let message = refused(here, &["build", source, "-o", "a.amc.ktx2"], 1);
        assert!(message.contains(names), "{source}: {message}");
        assert!(!here.join("a.amc.ktx2").exists());
    }
}

#[test]
fn a_project_is_rendered_as_its_looks_and_its_view_say() {
    let folder = scratch();
    let here = folder.path();
    let satin = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/fabrics/satin.json");
    done(here, &["bake", satin, "-o", "cloth.amc.ktx2", "--size", "32", "--slices", "16"]);
    let id = json(here, &["inspect", "shape:torus"])["panels"][0]["id"].as_str().unwrap().to_owned();
    // 30 degrees about y. The second fabric is nowhere to be found, but nobody wears it.
    let (sin, cos) = 15_f64.to_radians().sin_cos();
    let project = serde_json::json!({
        "version": 1,
        "garment": "shape:torus",
        "fabrics": [
            {"id": 3, "name": "Cloth", "asset": {"path": "cloth.amc.ktx2"}},
            {"id": 4, "name": "Lost", "asset": {"path": "lost.amc.ktx2"}},
        ],
        "panels": {&id: {"direction": {"angle_deg": 60.0}}},
        "view": {"orientation": [0.0, sin, 0.0, cos], "background": [16, 32, 48], "cyclic": "fragment"},
    });
    amc_core::file::save_bytes(&here.join("mine.amcproj"), project.to_string().as_bytes()).unwrap();
    let size = ["--size", "200x160", "--occlusion", "off"];
    let render = |scene: &str, options: &[&str]| {
        done(here, &[&["render", scene, "-o", "a.png"], &size[..], options].concat());
        amc_core::image::decode::read(&here.join("a.png")).unwrap()
    };
    let psnr = |a: &amc_core::image::Picture, b: &amc_core::image::Picture| {
        amc_core::image::compare::psnr_srgb(a, b).unwrap()
    };
    let asked = |degrees: &str, yaw: &str, background: &str| {
        let panel = format!("all,angle={degrees}");
        let cloth = ["--amc", "cloth.amc.ktx2", "--panel", &panel, "--yaw", yaw, "--background", background];
        render("shape:torus", &[&cloth[..], &["--cyclic", "fragment"]].concat())
    };
    let as_it_is = render("mine.amcproj", &[]);
    assert!(psnr(&as_it_is, &asked("60", "30", "102030")) > 60.0);
    assert!(psnr(&as_it_is, &asked("0", "30", "102030")) < 40.0, "the angle counts");
    // What is asked for wins, the rest stays.
    let changed = render("mine.amcproj", &["--panel", "all,angle=0", "--yaw", "0", "--background", "ffffff"]);
    assert!(psnr(&changed, &asked("0", "0", "ffffff")) > 60.0);
    let changeant = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/fabrics/changeant.json");
    done(here, &["bake", changeant, "-o", "other.amc.ktx2", "--size", "32", "--slices", "16"]);
    let exchanged = render("mine.amcproj", &["--amc", "other.amc.ktx2"]);
    assert!(psnr(&as_it_is, &exchanged) < 30.0);
    let by_cpu = render("mine.amcproj", &["--renderer", "cpu"]);
    assert!(psnr(&as_it_is, &by_cpu) > 45.0);

    let held = json(here, &["inspect", "mine.amcproj"]);
    assert_eq!((&held["kind"], &held["garment"]["bundled"]), (&"project".into(), &"shape:torus".into()));
    assert_eq!(held["fabrics"][0]["missing"], false);
    assert_eq!((&held["fabrics"][1]["missing"], &held["fabrics"][1]["id"]), (&true.into(), &4.into()));
    assert_eq!(held["panels"][0]["id"], *id);
    assert!((held["panels"][0]["angle_deg"].as_f64().unwrap() - 60.0).abs() < 1e-4);
    assert_eq!(held["view"]["background"], serde_json::json!([16, 32, 48]));

    done(here, &["tangents", "mine.amcproj", "-o", "t.json"]);
    let text = std::fs::read_to_string(here.join("t.json")).unwrap();
    let angle = serde_json::from_str::<Value>(&text).unwrap()["panels"][0]["angle_deg"].as_f64().unwrap();
    assert!((angle - 60.0).abs() < 1e-4);
}

#[test]
fn a_colourway_is_rendered_by_its_name() {
    let folder = scratch();
    let here = folder.path();
    let fabric = |name: &str| concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/fabrics/").to_owned() + name;
    let small = ["--size", "32", "--slices", "16"];
    done(here, &[&["bake", &fabric("satin.json"), "-o", "a.amc.ktx2"], &small[..]].concat());
    done(here, &[&["bake", &fabric("changeant.json"), "-o", "b.amc.ktx2"], &small[..]].concat());
    let id = json(here, &["inspect", "shape:torus"])["panels"][0]["id"].as_str().unwrap().to_owned();
    let project = serde_json::json!({
        "version": 1,
        "garment": "shape:torus",
        "fabrics": [{"id": 1, "asset": "a.amc.ktx2"}, {"id": 2, "asset": "b.amc.ktx2"}],
        "panels": {&id: {"fabric": 1, "direction": {"angle_deg": 60.0}}},
        "colourways": [
            {"id": 0, "name": "Day"},
            {"id": 1, "name": "Night", "panels": {&id: {"fabric": 2}}},
        ],
    });
    amc_core::file::save_bytes(&here.join("mine.amcproj"), project.to_string().as_bytes()).unwrap();
    let render = |options: &[&str]| {
        let size = ["--size", "96x96", "--occlusion", "off", "--renderer", "cpu"];
        done(here, &[&["render", "mine.amcproj", "-o", "a.png"], &size[..], options].concat());
        amc_core::image::decode::read(&here.join("a.png")).unwrap()
    };
    let psnr = |a: &amc_core::image::Picture, b: &amc_core::image::Picture| {
        amc_core::image::compare::psnr_srgb(a, b).unwrap()
    };
    let (day, night) = (render(&["--colourway", "Day"]), render(&["--colourway", "Night"]));
    assert!(psnr(&day, &render(&[])) > 60.0, "it is worn");
    assert!(psnr(&day, &night) < 30.0);
    // The fabric alone is another: the direction is the garment's.
    assert!(psnr(&night, &render(&["--amc", "b.amc.ktx2"])) > 60.0);
    let said = refused(here, &["render", "mine.amcproj", "-o", "a.png", "--colourway", "Dawn"], 1);
    assert!(said.contains("'Day', 'Night'"), "{said}");
    let held = json(here, &["inspect", "mine.amcproj"]);
    assert_eq!(held["colourways"][0], serde_json::json!({"id": 0, "name": "Day", "worn": true}));
    assert_eq!(held["colourways"][1]["panels"][0]["fabric"], 2);
}

#[test]
fn a_hidden_panel_is_not_in_the_picture() {
    let folder = scratch();
    let here = folder.path();
    let covered = |visible: bool, renderer: &str| {
        let project = serde_json::json!({
            "version": 1,
            "garment": "garment:shirt",
            "panels": {"back": {"visible": visible}},
            "view": {"orientation": [0.0, 1.0, 0.0, 0.0], "mode": "uv", "lens": {"perspective": {"focal_length_mm": 85.0}}},
        });
        amc_core::file::save_bytes(&here.join("a.amcproj"), project.to_string().as_bytes()).unwrap();
        let options = ["--size", "120x160", "--samples", "1", "--occlusion", "off", "--renderer", renderer];
        done(here, &[&["render", "a.amcproj", "-o", "a.png"], &options[..]].concat());
        let picture = amc_core::image::decode::read(&here.join("a.png")).unwrap();
        picture
            .pixels()
            .iter()
            .map(|pixel| pixel.map(|value| value.to_bits()))
            .collect::<std::collections::HashSet<_>>()
    };
    // Seen from behind, another panel's pattern stands where the back's did.
    assert_ne!(covered(true, "cpu"), covered(false, "cpu"));
    assert_ne!(covered(true, "gpu"), covered(false, "gpu"));
}

#[test]
fn contact_sheets_and_turns_are_made_without_a_window() {
    let folder = scratch();
    let here = folder.path();
    let satin = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/fabrics/satin.json");
    done(here, &["bake", satin, "-o", "cloth.amc.ktx2", "--size", "32", "--slices", "16"]);
    let cloth = ["--amc", "cloth.amc.ktx2", "--occlusion", "off", "--renderer", "cpu"];
    let told = |options: &[&str]| json(here, &[&["render", "shape:torus"], options, &cloth[..]].concat());
    let sheet = told(&["-o", "sheet.png", "--views", "front,top", "--size", "60x40"]);
    assert_eq!((&sheet["views"], &sheet["frames"]), (&2.into(), &Value::Null));
    let sheet = amc_core::image::decode::read(&here.join("sheet.png")).unwrap();
    assert_eq!((sheet.width(), sheet.height()), (120, 40));
    told(&["-o", "top.png", "--pitch", "90", "--size", "60x40"]);
    let top = amc_core::image::decode::read(&here.join("top.png")).unwrap();
    let (mut same, mut all) = (0, 0);
    for (x, y) in (0..40).flat_map(|y| (0..60).map(move |x| (x, y))) {
        same += usize::from(sheet.pixel(60 + x, y) == top.pixel(x, y));
        all += 1;
    }
    assert!(same * 1000 >= all * 999, "{same} of {all}");

    let turn = told(&["-o", "turn.gif", "--turn-frames", "5", "--fps", "10", "--size", "40x40"]);
    assert_eq!((&turn["frames"], &turn["views"]), (&5.into(), &Value::Null));
    let gif = std::fs::read(here.join("turn.gif")).unwrap();
    assert!(gif.starts_with(b"GIF89a"));
    // Five frames of 10/100 s each, told in a graphic control extension before each.
    let frames = gif.windows(4).filter(|bytes| bytes[..3] == [0x21, 0xf9, 0x04]).count();
    assert_eq!(frames, 5);
    assert_eq!(
        gif.windows(6).filter(|bytes| bytes[..3] == [0x21, 0xf9, 0x04] && bytes[4..] == [10, 0]).count(),
        5
    );
    told(&["-o", "turn.png", "--turn-frames", "3", "--size", "40x40"]);
    let png = std::fs::read(here.join("turn.png")).unwrap();
    assert_eq!(png.windows(4).filter(|bytes| bytes == b"fcTL").count(), 3);
}
