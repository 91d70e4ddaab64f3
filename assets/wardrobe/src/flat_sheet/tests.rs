#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use super::*;
use crate::collection::COLLECTION;
use crate::pattern::tests::shipped;

/// The points of the first path of a picture: an outline.
fn first_outline(svg: &str) -> Vec<DVec2> {
    let path = svg.split("<path d=\"M").nth(1).unwrap().split('Z').next().unwrap();
    let point = |text: &str| {
        let (x, y) = text.split_once(' ').unwrap();
        DVec2::new(x.parse().unwrap(), y.parse().unwrap())
    };
    path.split('L').map(point).collect()
}

#[test]
fn a_metre_of_cloth_is_a_thousand_units_and_v_is_up() {
    let outline = first_outline(&svg(&shipped("square")).unwrap());
    assert_eq!(outline.len(), 4);
    assert!((outline[1] - outline[0]).distance(DVec2::new(1200.0, 0.0)) < 0.02);
    assert!((outline[2] - outline[1]).distance(DVec2::new(0.0, -1200.0)) < 0.02);
}

#[test]
fn the_sheet_names_all_pieces_and_seams_and_holds_all_that_is_drawn() {
    for name in COLLECTION.map(|entry| entry.name) {
        let pattern = shipped(name);
        let whole = pattern.unfold().unwrap();
        let text = svg(&pattern).unwrap();
        for name in whole.pieces.iter().map(|p| &p.name).chain(whole.seams.iter().map(|s| &s.name)) {
            assert!(text.contains(&format!(">{name}</text>")), "{name}");
        }
        let size: Vec<f64> = text
            .split("viewBox=\"0 0 ")
            .nth(1)
            .unwrap()
            .split(['"', ' '])
            .take(2)
            .map(|n| n.parse().unwrap())
            .collect();
        for place in text.split("translate(").skip(1) {
            let at: Vec<f64> = place.split([' ', ')']).take(2).map(|n| n.parse().unwrap()).collect();
            assert!(at[0] > 0.0 && at[0] < size[0] && at[1] > 0.0 && at[1] < size[1], "{name}: {at:?}");
        }
    }
}

#[test]
fn names_cannot_break_the_picture() {
    let mut pattern = shipped("square");
    pattern.pieces[0].name = "a <b> & \"c\"".to_owned();
    assert!(svg(&pattern).unwrap().contains(">a &lt;b&gt; &amp; &quot;c&quot;</text>"));
}
