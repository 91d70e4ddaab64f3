use std::fs;
use std::path::{Path, PathBuf};

use super::*;
use crate::ErrorKind;

fn shaders() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders")
}

fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        crate::file::save_bytes(&folder.path().join(name), text.as_bytes()).unwrap();
    }
    folder
}

#[test]
fn every_file_of_the_folder_is_embedded_as_it_is() {
    let mut names: Vec<String> = fs::read_dir(shaders())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "wgsl"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    assert_eq!(Sources::embedded().names().unwrap(), names);
    for name in names {
        let on_disk = Sources::folder(shaders()).read(&name).unwrap().unwrap();
        assert_eq!(Sources::embedded().read(&name).unwrap().unwrap().text, on_disk.text, "{name}");
    }
}

#[test]
fn an_import_stands_for_its_text_once_and_lines_lead_back() {
    let folder = folder(&[
        ("a.wgsl", "#import b\n#import c // again b\nconst A = B;\n"),
        ("b.wgsl", "const B = 1;\n"),
        ("c.wgsl", "\n  #import b\nconst C = B;"),
    ]);
    let done = compose(&Sources::folder(folder.path()), "a").unwrap();
    assert_eq!(done.text(), "const B = 1;\n\nconst C = B;\nconst A = B;\n");
    assert_eq!(done.names(), ["a", "b", "c"]);
    let places: Vec<_> = (1..=4)
        .map(|line| {
            let origin = done.origin(line).unwrap();
            (origin.file.file_name().unwrap().to_str().unwrap(), origin.line)
        })
        .collect();
    assert_eq!(places, [("b.wgsl", 1), ("c.wgsl", 1), ("c.wgsl", 3), ("a.wgsl", 3)]);
}

#[test]
fn faulty_imports_are_reported_where_they_stand() {
    let folder = folder(&[
        ("a.wgsl", "// first\n#import b\n"),
        ("b.wgsl", "#import c\n"),
        ("c.wgsl", "\n\n#import a\n"),
        ("missing.wgsl", "\n#import nowhere\n"),
        ("outside.wgsl", "#import ../b\n"),
        ("empty.wgsl", "#import\n"),
    ]);
    let sources = Sources::folder(folder.path());
    let says = |name: &str| compose(&sources, name).unwrap_err().to_string().replace("\\", "/");
    let circle = says("a");
    assert!(
        circle.contains("c.wgsl: line 3: imports run in a circle: a imports b imports c imports a"),
        "{circle}"
    );
    let missing = says("missing");
    assert!(missing.contains("missing.wgsl: line 2: there is no shader \"nowhere\""), "{missing}");
    assert!(says("outside").contains("outside.wgsl: line 1: \"../b\" is no name"));
    assert!(says("empty").contains("empty.wgsl: line 1: \"\" is no name"));
    assert_eq!(compose(&sources, "nothing").unwrap_err().kind(), ErrorKind::Invalid);
}

#[cfg(feature = "gpu")]
mod with_naga {
    use super::*;
    use crate::Place;

    #[test]
    fn every_shader_is_valid() {
        for name in Sources::embedded().names().unwrap() {
            let checked = validate(&Sources::embedded(), &name).unwrap_or_else(|error| panic!("{error}"));
            let entry_points: Vec<_> = checked.entry_points().collect();
            if name.starts_with("mode_") {
                assert_eq!(entry_points, ["vertex_main", "fragment_main"], "{name}");
            }
        }
    }

    /// The twins: the functions' names are read from the Rust, so that none is forgotten.
    #[test]
    fn every_shading_function_has_a_twin_of_its_name() {
        let mut twins: Vec<String> = Vec::new();
        for name in Sources::embedded().names().unwrap() {
            twins.extend(validate(&Sources::embedded(), &name).unwrap().functions().map(str::to_owned));
        }
        // Methods have no name of their own in WGSL.
        let renamed = |name: &str| match name {
            "of" => "azimuth_of".to_owned(),
            "tangent" => "azimuth_tangent".to_owned(),
            name => name.to_owned(),
        };
        let mut seen = 0;
        for text in [include_str!("../render/shade.rs"), include_str!("../view_space.rs")] {
            for line in text.lines().take_while(|line| !line.contains("#[cfg(test)]")) {
                let Some(rest) = line.trim_start().strip_prefix("pub fn ") else { continue };
                let name = renamed(rest.split('(').next().unwrap());
                assert!(twins.contains(&name), "no WGSL twin of {name}");
                seen += 1;
            }
        }
        assert!(seen > 15);
    }

    #[test]
    fn faults_in_an_import_are_reported_in_its_own_file_by_line_and_column() {
        let folder = folder(&[
            ("root.wgsl", "#import broken\nconst A = 1;\n"),
            ("broken.wgsl", "// one\nconst B: f32 = /* é */ nothing;\n"),
            ("wrong.wgsl", "// one\nfn f() -> f32 {\n    return vec2<f32>();\n}\n"),
            ("wrong_root.wgsl", "const A = 1;\n#import wrong\n"),
        ]);
        let sources = Sources::folder(folder.path());
        let parsing = validate(&sources, "root").unwrap_err();
        assert_eq!(parsing.place(), Some(&Place::LineColumn(2, 24)), "{parsing}");
        assert!(parsing.file().unwrap().ends_with("broken.wgsl"));
        let validation = validate(&sources, "wrong_root").unwrap_err();
        assert!(matches!(validation.place(), Some(&Place::LineColumn(2 | 3, _))), "{validation}");
        assert!(validation.file().unwrap().ends_with("wrong.wgsl"));
    }
}
