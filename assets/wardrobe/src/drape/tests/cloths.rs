//! Garments made by hand, so that these tests need no pattern.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::body::Figure;
use crate::cut::{At, CutGarment, CutPiece, Join, JoinKind};
use crate::pattern::{Cloth, Placement};

/// A rectangle of near equilateral triangles, `across` by `up` metres; its sides are named `left`, `right`, `bottom`, `top`.
pub(super) fn rectangle(name: &str, across: f64, up: f64, edge: f64, placement: Placement) -> CutPiece {
    let (columns, rows) = ((across / edge).ceil() as u32, (up / (edge * 0.866)).ceil() as u32);
    let rows = rows + rows % 2;
    let mut flat = Vec::new();
    let mut starts = Vec::new();
    for row in 0..=rows {
        let v = up * f64::from(row) / f64::from(rows);
        starts.push(flat.len() as u32);
        let shifted = row % 2 == 1;
        let count = if shifted { columns + 2 } else { columns + 1 };
        for column in 0..count {
            let share = if shifted {
                (f64::from(column) - 0.5).clamp(0.0, f64::from(columns))
            } else {
                f64::from(column)
            };
            flat.push(DVec2::new(across * share / f64::from(columns), v));
        }
    }
    let mut triangles = Vec::new();
    for row in 0..rows {
        let (wide, narrow) = if row % 2 == 0 { (row + 1, row) } else { (row, row + 1) };
        let (w, n) = (starts[wide as usize], starts[narrow as usize]);
        let mut add = |corners: [u32; 3]| {
            triangles.push(if row % 2 == 0 { corners } else { [corners[0], corners[2], corners[1]] });
        };
        for column in 0..=columns {
            add([n + column, w + column + 1, w + column]);
            if column < columns {
                add([n + column, n + column + 1, w + column + 1]);
            }
        }
    }
    let (first, last) = (
        |row: u32| starts[row as usize],
        |row: u32| starts.get(row as usize + 1).copied().unwrap_or(flat.len() as u32) - 1,
    );
    let lines = BTreeMap::from([
        ("left".to_owned(), (0..=rows).map(first).collect()),
        ("right".to_owned(), (0..=rows).map(last).collect()),
        ("bottom".to_owned(), (0..=columns).collect()),
        ("top".to_owned(), (starts[rows as usize]..=starts[rows as usize] + columns).collect()),
    ]);
    CutPiece {
        name: name.to_owned(),
        flat,
        triangles,
        grain: 90f64.to_radians(),
        cloth: None,
        placement,
        lines,
        folds: Vec::new(),
        mirror: None,
    }
}

/// One piece on its own.
pub(super) fn single(figure: Figure, piece: CutPiece) -> CutGarment {
    CutGarment {
        name: piece.name.clone(),
        figure,
        cloth: Cloth::default(),
        pieces: vec![piece],
        joins: Vec::new(),
    }
}

/// A square lying on the air above the ball.
pub(super) fn square(side: f64, edge: f64) -> CutGarment {
    let placement = Placement::Flat {
        point: [0.5 * side; 2],
        at: [0.0, 1.31, 0.0],
        across: [1.0, 0.0, 0.0],
        up: [0.0, 0.0, -1.0],
    };
    single(Figure::Ball, rectangle("square", side, side, edge, placement))
}

/// A tube of two rectangles round the torso, from the armpits down.
pub(super) fn tube(edge: f64) -> CutGarment {
    let half = |name: &str, angle_deg: f64| {
        let placement = Placement::Around {
            limb: "torso".to_owned(),
            point: [0.245, 0.5],
            along: 0.20,
            angle_deg,
            radius: 0.22,
            flare: 0.0,
        };
        rectangle(name, 0.49, 0.5, edge, placement)
    };
    let (front, back) = (half("front", 0.0), half("back", 180.0));
    let seam = |name: &str, one: &str, other: &str| {
        let at = |piece: u32, vertices: &[u32]| {
            vertices.iter().map(|vertex| At { piece, vertex: *vertex }).collect::<Vec<_>>()
        };
        Join {
            name: name.to_owned(),
            kind: JoinKind::Sewn,
            late: false,
            pairs: at(0, &front.lines[one]).into_iter().zip(at(1, &back.lines[other])).collect(),
            sides: [vec![(0, one.to_owned())], vec![(1, other.to_owned())]],
        }
    };
    let joins = vec![seam("left side", "right", "left"), seam("right side", "left", "right")];
    CutGarment {
        name: "tube".to_owned(),
        figure: Figure::Standing,
        cloth: Cloth::default(),
        pieces: vec![front, back],
        joins,
    }
}
