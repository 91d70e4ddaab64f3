#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::PathBuf;

use amc_core::ErrorKind;
use serde_json::{Value, json};

use super::*;
use crate::collection::{COLLECTION, Entry};

/// Spoils a part of a pattern.
type Change = fn(&mut Value);

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("patterns/{name}.json"))
}

pub(crate) fn shipped(name: &str) -> Pattern {
    Entry::named(name).unwrap().pattern().unwrap()
}

/// A pattern on the ball of rectangles that are 0.4 m by 0.3 m, changed by `change`.
fn rectangles(names: &[&str], seams: Value, change: impl FnOnce(&mut Value)) -> amc_core::Result<Pattern> {
    let piece = |name: &&str| {
        json!({
            "name": name,
            "start": [0, 0],
            "outline": [
                { "name": "bottom", "path": [[0.4, 0]] },
                { "name": "right", "path": [[0.4, 0.3]] },
                { "name": "top", "path": [[0, 0.3]] },
                { "name": "left", "path": [[0, 0]] }
            ],
            "placement": { "kind": "flat", "point": [0, 0], "at": [0, 1, 0], "across": [1, 0, 0], "up": [0, 1, 0] }
        })
    };
    let pieces: Vec<Value> = names.iter().map(piece).collect();
    let mut pattern =
        json!({ "version": 1, "name": "test", "figure": "ball", "pieces": pieces, "seams": seams });
    change(&mut pattern);
    Pattern::from_json(&pattern.to_string())
}

fn fault(names: &[&str], seams: Value, change: impl FnOnce(&mut Value)) -> String {
    rectangles(names, seams, change).unwrap_err().to_string()
}

#[test]
fn a_piece_that_cannot_be_cut_is_refused_by_name() {
    let cases: [(Change, &str); 14] = [
        (|p| p["outline"][3]["path"] = json!([[0, 0.01]]), "its outline is open"),
        (|p| p["outline"][1]["path"] = json!([[0.1, 0.3], [0.5, 0.1]]), "overlaps itself"),
        (
            |p| p["outline"][0]["path"] = json!([{ "curve": [[0.9, 0.5], [-0.5, 0.5], [0.4, 0]] }]),
            "overlaps itself",
        ),
        (|p| p["outline"][1]["path"] = json!([[0.4, 0.2], [0.4, 0.05]]), "overlaps itself"),
        (|p| p["outline"][1]["path"] = json!([[0.4, 0]]), "'right' is 0.00 mm long"),
        (
            |p| {
                p["start"] = json!([0, 0]);
                p["outline"] = json!([
                    { "name": "left", "path": [[0, 0.3]] },
                    { "name": "top", "path": [[0.4, 0.3], [0.4, 0], [0, 0]] }
                ]);
            },
            "clockwise",
        ),
        (|p| p["outline"][1]["path"] = json!([[40, 0.3]]), "metres"),
        (|p| p["outline"] = json!([]), "no outline"),
        (|p| p["outline"][1]["name"] = json!("top"), "two of its lines are called 'top'"),
        (|p| p["notches"] = json!([{ "edge": "hem", "at": 0.5 }]), "no edge is called so"),
        (
            |p| p["placement"] = json!({ "kind": "around", "limb": "tail", "point": [0, 0], "along": 0, "angle_deg": 0, "radius": 1 }),
            "'tail'",
        ),
        (
            |p| p["lines"] = json!([{ "name": "pocket", "start": [0.1, 0.1], "path": [[0.5, 0.1]] }]),
            "cross or touch",
        ),
        (|p| p["points"] = json!([{ "name": "button", "at": [[0.1, 0.5]] }]), "outside"),
        (|p| p["folds"] = json!([{ "along": "roll line", "angle_deg": 90 }]), "no inner line"),
    ];
    for (change, expected) in cases {
        let message = fault(&["flap"], json!([]), |pattern| change(&mut pattern["pieces"][0]));
        assert!(message.contains("piece 'flap'") && message.contains(expected), "{expected}: {message}");
    }
}

#[test]
fn a_seam_that_cannot_be_sewn_is_refused_by_name() {
    let seam = |change: Change| {
        let mut seam = json!({ "name": "join", "a": ["one: right"], "b": ["two: left"] });
        change(&mut seam);
        fault(
            &["one", "two"],
            json!([seam, { "name": "other", "a": ["one: bottom"], "b": ["two: bottom"] }]),
            |_| {},
        )
    };
    let cases: [(Change, &str); 8] = [
        (|s| s["a"] = json!(["one: top"]), "its sides cannot match: 400.0 and 300.0 mm"),
        (|s| s["a"] = json!(["three: top"]), "no piece is called 'three'"),
        (|s| s["a"] = json!(["one: hem"]), "no line 'hem'"),
        (|s| s["a"] = json!(["right"]), "names no line"),
        (|s| s["ease"] = json!(-0.2), "ease"),
        (|s| s["between"] = json!(["from", "to"]), "no notch 'from'"),
        (|s| s["mirrored"] = json!(true), "'left' or 'right'"),
        (|s| s["a"] = json!([{ "line": "one: bottom", "from": 0.25 }]), "sewn twice"),
    ];
    for (change, expected) in cases {
        let message = seam(change);
        let name = if expected == "sewn twice" { "seam 'other'" } else { "seam 'join'" };
        assert!(message.contains(name) && message.contains(expected), "{expected}: {message}");
    }
}

#[test]
fn a_half_unfolds_to_the_whole() {
    let pattern = rectangles(&["front"], json!([]), |pattern| {
        let piece = &mut pattern["pieces"][0];
        piece["mirrored"] = json!(true);
        piece["outline"] = json!([
            { "name": "hem", "path": [[0.4, 0]] },
            { "name": "left side", "path": [[0.4, 0.3]] },
            { "name": "top", "path": [[0, 0.3]] }
        ]);
        piece["notches"] =
            json!([{ "edge": "hem", "at": 0.25, "name": "left" }, { "edge": "left side", "at": 0.1 }]);
        piece["lines"] = json!([{ "name": "across", "start": [0, 0.1], "path": [[0.4, 0.1]] }]);
        piece["folds"] = json!([{ "along": "across", "angle_deg": 90 }]);
    })
    .unwrap();
    let piece = &pattern.unfold().unwrap().pieces[0];
    assert!((piece.area() - 0.24).abs() < 1e-12);
    let names: Vec<&str> = piece.lines.iter().map(|line| line.name.as_str()).collect();
    assert_eq!(names, ["hem", "left side", "top", "right side", "across"]);
    assert!((piece.lines[4].length() - 0.8).abs() < 1e-12);
    let marks: Vec<(&str, f64, f64)> = piece
        .notches
        .iter()
        .map(|n| (n.name.as_str(), piece.lines[n.line].at(n.along).x, piece.lines[n.line].at(n.along).y))
        .collect();
    for expected in [("right", -0.1, 0.0), ("left", 0.1, 0.0), ("", 0.4, 0.03), ("", -0.4, 0.03)] {
        let found = marks
            .iter()
            .any(|m| m.0 == expected.0 && (m.1 - expected.1).abs() + (m.2 - expected.2).abs() < 1e-9);
        assert!(found, "{expected:?} in {marks:?}");
    }
    assert_eq!(piece.folds.len(), 1);
}

#[test]
fn a_mirror_image_has_its_edges_names_and_grain_mirrored() {
    let pattern = shipped("t-shirt").unfold().unwrap();
    let index = |name: &str| pattern.pieces.iter().position(|piece| piece.name == name).unwrap();
    let (left, right) = (&pattern.pieces[index("left sleeve")], &pattern.pieces[index("right sleeve")]);
    assert_eq!(right.mirror, Some(index("left sleeve")));
    assert!((left.area() - right.area()).abs() < 1e-12);
    let end = |piece: &WholePiece| piece.lines.iter().find(|line| line.name == "cap front").unwrap().end();
    // The same corner is its start in one and its end in the other.
    assert!((end(left).x + 0.18).abs() < 1e-9);
    assert!(end(right).x.abs() < 1e-9);
    let Placement::Around { limb, .. } = &right.placement else { panic!("not round a limb") };
    assert_eq!(limb, "right arm");
}

#[test]
fn the_t_shirt_is_drafted_by_the_rules() {
    let pattern = shipped("t-shirt").unfold().unwrap();
    let seam = |name: &str| pattern.seams.iter().find(|seam| seam.name == name).unwrap().lengths();
    for name in ["left armhole back", "right armhole front"] {
        let [cap, armhole] = seam(name);
        let ease = cap / armhole - 1.0;
        assert!((0.02..=0.04).contains(&ease), "{name}: {ease}");
    }
    let [band, neck] = seam("neckline");
    assert!((band / neck - 0.9).abs() < 0.01, "{}", band / neck);
}

#[test]
fn a_file_is_named_with_what_is_wrong_in_it() {
    let error = Pattern::read(&file("no such garment")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io);
    assert!(error.to_string().contains("no such garment.json"));
    let error = Pattern::from_json("{\n\"version\": 1, \"colour\": 2}").unwrap_err().to_string();
    assert!(error.contains("line 2") && error.contains("colour"), "{error}");
    assert!(fault(&["a"], json!([]), |p| p["version"] = json!(2)).contains("version 2"));
}

/// A small generator of numbers (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators").
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % most.max(1) as u64) as usize
    }
}

/// All values of a JSON document that hold no others, in order.
fn leaves<'a>(value: &'a mut Value, into: &mut Vec<&'a mut Value>) {
    match value {
        Value::Array(all) => all.iter_mut().for_each(|value| leaves(value, into)),
        Value::Object(all) => all.values_mut().for_each(|value| leaves(value, into)),
        _ => into.push(value),
    }
}

fn mutate(value: &mut Value, numbers: &mut Numbers) {
    let mut all = Vec::new();
    leaves(value, &mut all);
    let (chosen, other) = (numbers.below(all.len()), numbers.below(all.len()));
    let other = all[other].clone();
    let spoilt = [
        json!(0),
        json!(-1e300),
        json!(1e-300),
        json!(9.9),
        json!(""),
        json!(null),
        json!("front: hem"),
        json!([[0.1, 0.2]]),
    ];
    let leaf = &mut *all[chosen];
    *leaf = match (numbers.below(4), leaf.as_f64()) {
        (0, Some(x)) => json!(x + (numbers.below(2001) as f64 - 1000.0) * 1e-4),
        (1, Some(x)) => json!(-x),
        (2, _) => other,
        _ => spoilt[numbers.below(spoilt.len())].clone(),
    };
}

/// Whatever a file holds, it is refused or cut: nothing panics, and what is accepted meets vertex by vertex.
#[test]
fn spoilt_patterns_are_refused_or_cut() {
    let mut numbers = Numbers(7);
    let (mut cut, mut refused) = (0, 0);
    for name in COLLECTION.map(|entry| entry.name) {
        let text = std::fs::read_to_string(file(name)).unwrap();
        for _ in 0..100 {
            let mut value: Value = serde_json::from_str(&text).unwrap();
            for _ in 0..=numbers.below(3) {
                mutate(&mut value, &mut numbers);
            }
            let garment =
                Pattern::from_json(&value.to_string()).and_then(|pattern| crate::cut::cut(&pattern, 0.04));
            match garment {
                Ok(_) => cut += 1,
                Err(error) => {
                    refused += 1;
                    assert!(!error.to_string().contains('\n'));
                }
            }
        }
    }
    assert!(cut > 50 && refused > 50, "{cut} cut, {refused} refused");
}

/// Files that are mostly not even JSON any more.
#[test]
fn spoilt_bytes_are_refused_in_one_line_or_cut() {
    let mut numbers = Numbers(11);
    let mut refused = 0;
    for name in COLLECTION.map(|entry| entry.name) {
        let bytes = std::fs::read(file(name)).unwrap();
        for _ in 0..60 {
            let mut spoilt = bytes.clone();
            for _ in 0..=numbers.below(4) {
                let at = numbers.below(spoilt.len());
                spoilt[at] = b"0123456789-.,[]{}\"eE"[numbers.below(20)];
            }
            spoilt.truncate(spoilt.len() - numbers.below(2) * numbers.below(spoilt.len()));
            let pattern = Pattern::from_json(&String::from_utf8_lossy(&spoilt));
            if let Err(error) = pattern.and_then(|pattern| crate::cut::cut(&pattern, 0.05)) {
                refused += 1;
                assert!(!error.to_string().contains('\n'), "{error}");
            }
        }
    }
    assert!(refused > 100, "{refused} refused");
}
