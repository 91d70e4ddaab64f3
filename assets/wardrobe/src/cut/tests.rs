#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;

use serde_json::{Value, json};

use super::*;
use crate::collection::COLLECTION;
use crate::pattern::tests::shipped;

/// The corners of all triangles of a piece, degrees.
fn angles(piece: &CutPiece) -> Vec<f64> {
    let of_triangle = |triangle: &[u32; 3]| {
        let c = triangle.map(|v| piece.flat[v as usize]);
        [0, 1, 2].map(|i| (c[(i + 1) % 3] - c[i]).angle_to(c[(i + 2) % 3] - c[i]).to_degrees())
    };
    piece.triangles.iter().flat_map(of_triangle).collect()
}

fn area(piece: &CutPiece) -> f64 {
    let of_triangle = |t: &[u32; 3]| smooth::doubled_area(t.map(|v| piece.flat[v as usize])) / 2.0;
    piece.triangles.iter().map(of_triangle).sum()
}

fn piece<'a>(garment: &'a CutGarment, name: &str) -> &'a CutPiece {
    garment.pieces.iter().find(|piece| piece.name == name).unwrap()
}

fn join<'a>(garment: &'a CutGarment, name: &str) -> &'a Join {
    garment.joins.iter().find(|join| join.name == name).unwrap()
}

fn place(garment: &CutGarment, at: At) -> DVec2 {
    garment.pieces[at.piece as usize].flat[at.vertex as usize]
}

/// The undirected edges of a piece's triangles.
fn edges(piece: &CutPiece) -> BTreeSet<[u32; 2]> {
    let of_triangle =
        |&[a, b, c]: &[u32; 3]| [[a.min(b), a.max(b)], [b.min(c), b.max(c)], [c.min(a), c.max(a)]];
    piece.triangles.iter().flat_map(of_triangle).collect()
}

/// A pattern of rectangles: name, width, height, and what else it has.
fn rectangles(pieces: &[(&str, f64, f64, Value)], seams: Value) -> Pattern {
    let piece = |(name, width, height, more): &(&str, f64, f64, Value)| {
        let mut piece = json!({
            "name": name,
            "outline": [
                { "name": "bottom", "path": [[width, 0]] },
                { "name": "right", "path": [[width, height]] },
                { "name": "top", "path": [[0, height]] },
                { "name": "left", "path": [[0, 0]] }
            ],
            "placement": { "kind": "flat", "point": [0, 0], "at": [0, 1, 0], "across": [1, 0, 0], "up": [0, 1, 0] }
        });
        for (key, value) in more.as_object().into_iter().flatten() {
            piece[key] = value.clone();
        }
        piece
    };
    let pieces: Vec<Value> = pieces.iter().map(piece).collect();
    let pattern = json!({ "version": 1, "name": "test", "figure": "ball", "pieces": pieces, "seams": seams });
    Pattern::from_json(&pattern.to_string()).unwrap()
}

#[test]
fn triangles_fill_every_piece_and_none_is_a_sliver() {
    for entry in &COLLECTION {
        let (name, pattern) = (entry.name, entry.pattern().unwrap());
        let whole = pattern.unfold().unwrap();
        for edge_length in [0.025, 0.012] {
            let garment = cut(&pattern, edge_length).unwrap();
            for (piece, drawn) in garment.pieces.iter().zip(&whole.pieces) {
                // Chords cut off a little of curved edges: most of the stand's ends, which are round and hardly wider than an edge is long.
                let round = name == "shirt" && piece.name == "stand" && edge_length > 0.02;
                let cut_off = (area(piece) / drawn.area() - 1.0).abs();
                assert!(cut_off < if round { 0.02 } else { 0.01 }, "{name}: {}: {cut_off}", piece.name);
                let mut angles = angles(piece);
                angles.sort_by(f64::total_cmp);
                assert!(angles[0] > 15.0, "{name}: {}: {}", piece.name, angles[0]);
                let twentieth = angles[angles.len() / 20];
                // The strip between the collar's neck and its roll line is 7 mm wide: its triangles are lower than long.
                let strip = name == "shirt" && piece.name == "collar";
                let least = if strip { 30.0 } else { 36.0 };
                assert!(edge_length > 0.02 || twentieth > least, "{name}: {}: {twentieth}", piece.name);
            }
        }
    }
}

#[test]
fn edges_are_about_as_long_as_asked() {
    let garment = cut(&shipped("square"), 0.02).unwrap();
    let square = &garment.pieces[0];
    // An equilateral triangle's area.
    let expected = 1.44 / (0.02f64.powi(2) * 3f64.sqrt() / 4.0);
    assert!((square.triangles.len() as f64 / expected - 1.0).abs() < 0.05, "{}", square.triangles.len());
    for [a, b] in edges(square) {
        let length = square.flat[a as usize].distance(square.flat[b as usize]);
        assert!((0.010..0.034).contains(&length), "{length}");
    }
}

#[test]
fn corners_notches_and_lines_are_where_they_are_drawn() {
    let more = json!({
        "notches": [{ "edge": "bottom", "at": 0.37 }],
        "lines": [{ "name": "pocket", "start": [0.1, 0.2], "path": [[0.1, 0.1], [0.2, 0.1], [0.2, 0.2]] }],
        "folds": [{ "along": [[0, 0.25], [0.4, 0.25]], "angle_deg": 170 }],
        "points": [{ "name": "buttons", "at": [[0.3, 0.05], [0.35, 0.25]] }]
    });
    let garment = cut(&rectangles(&[("front", 0.4, 0.3, more)], json!([])), 0.017).unwrap();
    let front = &garment.pieces[0];
    let has = |u: f64, v: f64| front.flat.iter().filter(|p| p.distance(DVec2::new(u, v)) < 1e-9).count();
    for [u, v] in
        [[0.0, 0.0], [0.4, 0.3], [0.148, 0.0], [0.1, 0.1], [0.2, 0.2], [0.0, 0.25], [0.4, 0.25], [0.3, 0.05]]
    {
        assert_eq!(has(u, v), 1, "{u} {v}");
    }
    let edges = edges(front);
    for line in ["bottom", "right", "top", "left", "pocket", "fold 1"] {
        let line = &front.lines[line];
        assert!(line.windows(2).all(|ends| edges.contains(&[ends[0].min(ends[1]), ends[0].max(ends[1])])));
    }
    let fold = &front.folds[0];
    assert_eq!(fold.vertices, front.lines["fold 1"]);
    assert!(front.lines["left"].contains(&fold.vertices[0]));
    assert!(fold.vertices.contains(&front.lines["buttons"][1]), "a button on the fold is a vertex of it");
}

#[test]
fn a_joint_on_one_side_of_a_seam_is_a_vertex_of_the_other() {
    let pieces =
        [("yoke", 0.4, 0.1, json!({})), ("left", 0.27, 0.3, json!({})), ("right", 0.13, 0.3, json!({}))];
    let seam = json!([{ "name": "yoke", "a": ["yoke: bottom"], "b": ["left: top", "right: top"] }]);
    let garment = cut(&rectangles(&pieces, seam), 0.03).unwrap();
    let pairs = &join(&garment, "yoke").pairs;
    for (a, b) in pairs {
        let across = if b.piece == 2 { 0.27 } else { 0.0 };
        assert!((place(&garment, *a).x - place(&garment, *b).x - across).abs() < 1e-9);
    }
    // The joint is met by a corner of each of the two.
    let at_joint = pairs.iter().filter(|(a, _)| (place(&garment, *a).x - 0.27).abs() < 1e-9).count();
    assert_eq!(at_joint, 2);
    assert_eq!(pairs.len(), garment.pieces[0].lines["bottom"].len() + 1);
}

#[test]
fn ease_is_spread_between_its_notches_and_not_beyond() {
    let notches = json!({ "notches": [
        { "edge": "top", "at": 0.3, "name": "from" },
        { "edge": "top", "at": 0.7, "name": "to" }
    ] });
    let pieces = [("sleeve", 0.5, 0.2, notches), ("body", 0.45, 0.2, json!({}))];
    let seam = json!([{ "name": "cap", "ease": 0.12, "between": ["from", "to"], "a": ["sleeve: top"], "b": ["body: bottom"] }]);
    let garment = cut(&rectangles(&pieces, seam), 0.01).unwrap();
    for (a, b) in &join(&garment, "cap").pairs {
        // The top runs from right to left: distances from the seam's start, which is the body's right end.
        let (long, short) = (0.5 - place(&garment, *a).x, 0.45 - place(&garment, *b).x);
        let expected = match long {
            x if x < 0.15 => x,
            x if x < 0.35 => 0.15 + (x - 0.15) * 0.75,
            x => x - 0.05,
        };
        assert!((short - expected).abs() < 1e-9, "{long} meets {short}");
    }
}

#[test]
fn notches_that_nearly_meet_do_meet() {
    let notch = |at: f64| json!({ "notches": [{ "edge": "right", "at": at }, { "edge": "left", "at": 1.0 - at - 0.004 }] });
    let pieces = [("one", 0.2, 0.3, notch(0.5)), ("two", 0.2, 0.3, notch(0.5))];
    let seam = json!([{ "name": "side", "a": ["one: right"], "b": ["two: left"] }]);
    let garment = cut(&rectangles(&pieces, seam), 0.02).unwrap();
    let pairs = &join(&garment, "side").pairs;
    let met = pairs.iter().find(|(a, _)| (place(&garment, *a).y - 0.15).abs() < 1e-9).unwrap();
    assert!((place(&garment, met.1).y - 0.1512).abs() < 1e-9);
}

#[test]
fn seams_pair_every_vertex_of_their_edges_in_order() {
    let garment = cut(&shipped("t-shirt"), 0.02).unwrap();
    for join in &garment.joins {
        for (side, lines) in join.sides.iter().enumerate() {
            let pick = |pair: &(At, At)| if side == 0 { pair.0 } else { pair.1 };
            let paired: BTreeSet<At> = join.pairs.iter().map(pick).collect();
            for (piece, line) in lines {
                // Half an edge is sewn where the collar band starts at the centre back.
                let of_line = &garment.pieces[*piece].lines[line];
                let all = of_line.iter().map(|&vertex| At { piece: *piece as u32, vertex });
                assert!(all.clone().all(|at| paired.contains(&at)), "{}: {line}", join.name);
            }
        }
        for pairs in join.pairs.windows(2) {
            let step = |a: At, b: At| {
                if a.piece == b.piece { place(&garment, a).distance(place(&garment, b)) } else { 0.0 }
            };
            assert!(
                step(pairs[0].0, pairs[1].0) < 0.03 && step(pairs[0].1, pairs[1].1) < 0.03,
                "{}",
                join.name
            );
        }
    }
    // The sides of the body: sewn from hem to armhole, hem to hem.
    let side = join(&garment, "left side");
    let (front, back) = side.pairs[0];
    assert!(place(&garment, front).y < 0.01 && place(&garment, back).y < 0.01);
    assert!(place(&garment, front).x > 0.2 && place(&garment, back).x < -0.2);
}

#[test]
fn buttons_meet_their_buttonholes_first_to_first() {
    let points =
        |name: &str, u: f64| json!({ "points": [{ "name": name, "at": [[u, 0.05], [u, 0.15], [u, 0.25]] }] });
    let pieces =
        [("front", 0.3, 0.3, points("buttons", 0.02)), ("placket", 0.04, 0.3, points("holes", 0.02))];
    let seam =
        json!([{ "name": "buttons", "kind": "layered", "a": ["front: buttons"], "b": ["placket: holes"] }]);
    let garment = cut(&rectangles(&pieces, seam), 0.015).unwrap();
    let join = join(&garment, "buttons");
    assert_eq!((join.kind, join.pairs.len()), (JoinKind::Layered, 3));
    assert!(join.pairs.iter().all(|(a, b)| place(&garment, *a).y == place(&garment, *b).y));
}

#[test]
fn a_pocket_is_sewn_on_three_edges_to_a_line_of_the_front() {
    let line = json!({ "lines": [{ "name": "pocket", "start": [0.1, 0.2], "path": [[0.1, 0.1], [0.2, 0.1], [0.2, 0.2]] }] });
    let pieces = [("front", 0.4, 0.3, line), ("pocket", 0.1, 0.1, json!({}))];
    let seam = json!([{
        "name": "pocket",
        "kind": "layered",
        "a": ["pocket: left", "pocket: bottom", "pocket: right"],
        "b": [{ "line": "front: pocket", "reversed": true }]
    }]);
    let garment = cut(&rectangles(&pieces, seam), 0.013).unwrap();
    let pairs = &join(&garment, "pocket").pairs;
    assert_eq!(pairs.len(), garment.pieces[0].lines["pocket"].len());
    for (a, b) in pairs {
        let shift = place(&garment, *b) - place(&garment, *a);
        assert!(shift.distance(DVec2::new(0.1, 0.1)) < 1e-9, "{shift}");
    }
}

#[test]
fn a_dart_meets_itself_at_its_point() {
    let mut pattern = rectangles(&[("front", 0.3, 0.3, json!({}))], json!([]));
    let dart = json!([
        { "name": "bottom", "path": [[0.3, 0]] },
        { "name": "right", "path": [[0.3, 0.3]] },
        { "name": "top right", "path": [[0.17, 0.3]] },
        { "name": "dart right", "path": [[0.15, 0.18]] },
        { "name": "dart left", "path": [[0.13, 0.3]] },
        { "name": "top left", "path": [[0, 0.3]] },
        { "name": "left", "path": [[0, 0]] }
    ]);
    pattern.pieces[0].outline = serde_json::from_value(dart).unwrap();
    pattern.seams = serde_json::from_value(
        json!([{ "name": "dart", "a": ["front: dart right"], "b": ["front: dart left"] }]),
    )
    .unwrap();
    let garment = cut(&pattern, 0.02).unwrap();
    let pairs = &join(&garment, "dart").pairs;
    assert_eq!(pairs.len() + 1, garment.pieces[0].lines["dart left"].len());
    for (a, b) in pairs {
        let (a, b) = (place(&garment, *a), place(&garment, *b));
        assert!((a.x + b.x - 0.3).abs() < 1e-9 && (a.y - b.y).abs() < 1e-9);
    }
}

#[test]
fn a_mirror_image_is_cut_as_its_original() {
    let garment = cut(&shipped("t-shirt"), 0.015).unwrap();
    let (left, right) = (piece(&garment, "left sleeve"), piece(&garment, "right sleeve"));
    let sorted = |piece: &CutPiece, sign: f64| {
        let mut all: Vec<[i64; 2]> = piece
            .flat
            .iter()
            .map(|p| [(sign * p.x * 1e7).round() as i64, (p.y * 1e7).round() as i64])
            .collect();
        all.sort_unstable();
        all
    };
    assert_eq!(left.triangles.len(), right.triangles.len());
    let differ =
        sorted(left, 1.0).iter().zip(sorted(right, -1.0)).filter(|(a, b)| (a[1] - b[1]).abs() > 1).count();
    assert_eq!(differ, 0);
}

#[test]
fn the_cut_does_not_depend_on_the_number_of_threads() {
    let pattern = shipped("t-shirt");
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        format!("{:?}", pool.install(|| cut(&pattern, 0.03)).unwrap())
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn edge_lengths_out_of_range_are_refused() {
    for bad in [0.0, -0.01, 1e-5, 0.5, f64::NAN] {
        assert!(cut(&shipped("square"), bad).is_err());
    }
    let error = cut(&shipped("square"), 0.0006).unwrap_err();
    assert_eq!(error.kind(), amc_core::ErrorKind::TooLarge);
}
