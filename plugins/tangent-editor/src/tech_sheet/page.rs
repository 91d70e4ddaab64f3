//! A page: lines and words in millimetres from its top left corner.

use glam::Vec2;

use super::Content;
use crate::assignments::Orientation;
use crate::sheet::Piece;
use crate::texts;

/// A3, lying.
const PAPER: Vec2 = Vec2::new(420.0, 297.0);
/// Free at each side, and below the title.
const MARGIN: f32 = 12.0;
/// Millimetres of the title and of labels.
const TITLE: f32 = 6.0;
const TEXT: f32 = 2.6;
/// How many times smaller than the cloth a page may be.
const SCALES: [f32; 11] = [1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 20.0, 50.0];
/// Width of the table of pieces, and where its columns begin.
const TABLE: f32 = 118.0;
const COLUMNS: [f32; 5] = [0.0, 8.0, 46.0, 62.0, 100.0];
/// About how wide a letter is, of its height.
const LETTER: f32 = 0.55;
/// Length of an arrow's head.
const HEAD: f32 = 3.0;
/// Lengths that the bar of the scale may stand for, metres.
const BARS: [f32; 5] = [1.0, 0.5, 0.2, 0.1, 0.05];

/// What is drawn on a page.
pub(super) enum Mark {
    /// An open line.
    Line { points: Vec<Vec2>, width: f32 },
    /// A filled area: closed lines, by the even-odd rule.
    Area { lines: Vec<Vec<Vec2>>, grey: f32 },
    /// A line of text from its left end, on its base line.
    Text { at: Vec2, size: f32, text: String },
}

pub(super) struct Page {
    pub(super) size: Vec2,
    pub(super) marks: Vec<Mark>,
}

impl Page {
    pub(super) fn new(content: &Content<'_>) -> Self {
        let room = PAPER - Vec2::new(3.0 * MARGIN + TABLE, 3.0 * MARGIN + TITLE);
        let whole = content.sheet.size * 1000.0;
        let fits = |scale: &f32| (whole / *scale).cmple(room).all();
        let scale = SCALES.into_iter().find(fits).unwrap_or((whole / room).max_element().ceil());
        let place = |at: Vec2| {
            let down = Vec2::new(at.x, content.sheet.size.y - at.y) * (1000.0 / scale);
            Vec2::new(MARGIN, 2.0 * MARGIN + TITLE) + down
        };
        let mut marks = Vec::new();
        let title = Vec2::new(MARGIN, MARGIN + TITLE);
        marks.push(Mark::Text { at: title, size: TITLE, text: content.title.to_owned() });
        marks.push(Mark::Text { at: title + Vec2::Y * 2.0 * TEXT, size: TEXT, text: texts::scale(scale) });
        bar(&mut marks, scale);
        for (number, piece) in (1..).zip(&content.sheet.pieces) {
            let lines: Vec<Vec<Vec2>> =
                piece.outlines.iter().map(|line| line.iter().map(|&at| place(at)).collect()).collect();
            marks.push(Mark::Area { lines: lines.clone(), grey: 0.94 });
            for mut line in lines {
                line.extend(line.first().copied());
                marks.push(Mark::Line { points: line, width: 0.35 });
            }
            let [tail, tip] = content.arrow(piece).map(place);
            let both = content.said(piece).assignment.orientation == Orientation::TwoWay;
            arrow(&mut marks, tail, tip, both);
            marks.push(name(content, number, piece, (tail, tip), 1000.0 / scale));
        }
        table(&mut marks, content);
        Self { size: PAPER, marks }
    }
}

/// A piece's number and, where there is room, its name beside the arrow.
fn name(
    content: &Content<'_>,
    number: usize,
    piece: &Piece,
    (tail, tip): (Vec2, Vec2),
    millimetres: f32,
) -> Mark {
    let along = tip - tail;
    let is_upright = along.y.abs() > along.x.abs();
    let named = format!("{number}  {}", content.sheet.panel(piece).name);
    let width = |text: &str| text.chars().count() as f32 * LETTER * TEXT;
    let room = (piece.high.x - piece.low.x) * millimetres * if is_upright { 0.4 } else { 0.8 };
    let text = if width(&named) < room { named } else { number.to_string() };
    let aside = if is_upright { Vec2::new(1.5, 0.4 * TEXT) } else { Vec2::new(-width(&text) / 2.0, -1.2) };
    Mark::Text { at: (tail + tip) / 2.0 + aside, size: TEXT, text }
}

/// What is said of each piece, at the right of the page.
fn table(marks: &mut Vec<Mark>, content: &Content<'_>) {
    let corner = Vec2::new(PAPER.x - MARGIN - TABLE, 3.0 * MARGIN + TITLE);
    let mut row = |number: usize, cells: [String; 5]| {
        let at = corner + Vec2::Y * (1.6 * TEXT * number as f32);
        for (x, text) in COLUMNS.into_iter().zip(cells) {
            marks.push(Mark::Text { at: at + Vec2::X * x, size: TEXT, text });
        }
        let points = [0.0, TABLE].map(|x| at + Vec2::new(x, 0.5 * TEXT)).to_vec();
        marks.push(Mark::Line { points, width: if number == 0 { 0.35 } else { 0.1 } });
    };
    row(0, texts::COLUMNS.map(str::to_owned));
    for (number, piece) in (1..).zip(&content.sheet.pieces) {
        let [name, warp, fabric, laying] = content.label(piece);
        row(number, [number.to_string(), name, warp, fabric, laying]);
    }
}

/// A line with a head at its tip; at both ends where the piece may be laid both ways.
fn arrow(marks: &mut Vec<Mark>, tail: Vec2, tip: Vec2, both: bool) {
    let Some(along) = (tip - tail).try_normalize() else { return };
    let size = HEAD.min(0.4 * tip.distance(tail));
    marks.push(Mark::Line { points: vec![tail, tip], width: 0.35 });
    for (end, way) in [(tip, along), (tail, -along)].into_iter().take(if both { 2 } else { 1 }) {
        let back = end - way * size;
        let aside = way.perp() * (0.35 * size);
        marks.push(Mark::Area { lines: vec![vec![end, back + aside, back - aside]], grey: 0.0 });
    }
}

/// A bar by which the scale can be checked on paper, at the top right.
fn bar(marks: &mut Vec<Mark>, scale: f32) {
    let length = |metres: f32| metres * 1000.0 / scale;
    let Some(metres) = BARS.into_iter().find(|&metres| length(metres) <= PAPER.x / 4.0) else { return };
    let end = Vec2::new(PAPER.x - MARGIN, MARGIN + TITLE);
    let start = end - Vec2::X * length(metres);
    let tick = Vec2::Y * 1.5;
    for points in [vec![start, end], vec![start - tick, start + tick], vec![end - tick, end + tick]] {
        marks.push(Mark::Line { points, width: 0.35 });
    }
    let text = texts::centimetres(metres * 100.0);
    marks.push(Mark::Text { at: start + Vec2::new(0.0, -2.0), size: TEXT, text });
}
