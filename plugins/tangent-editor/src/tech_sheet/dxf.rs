//! Pieces as DXF R12 in the manner of AAMA and ASTM D6673: a block for each, its outline on layer 1, its grain on layer 7.

use std::fmt::{Display, Write as _};

use glam::Vec2;

use super::Content;
use crate::sheet::Piece;
use crate::texts;

/// The outline of a piece.
const BOUNDARY: u8 = 1;
/// The grain line.
const GRAIN: u8 = 7;
/// What is cut out of a piece.
const INTERNAL: u8 = 11;
/// Millimetres of the words.
const TEXT: f32 = 10.0;

pub(super) fn bytes(content: &Content<'_>) -> Vec<u8> {
    let mut out = Writer(String::new());
    let names = names(content);
    out.section("BLOCKS");
    for (piece, name) in content.sheet.pieces.iter().zip(&names) {
        out.block(content, piece, name);
    }
    out.pair(0, "ENDSEC");
    out.section("ENTITIES");
    for name in &names {
        out.pair(0, "INSERT");
        out.pair(8, BOUNDARY);
        out.pair(2, name);
        out.place(10, Vec2::ZERO);
    }
    out.text(Vec2::ZERO, &format!("STYLE NAME: {}", plain(content.title)));
    out.text(Vec2::new(0.0, -2.0 * TEXT), "UNITS: METRIC");
    out.pair(0, "ENDSEC");
    out.pair(0, "EOF");
    out.0.into_bytes()
}

/// Group codes and values, a line each.
struct Writer(String);

impl Writer {
    fn pair(&mut self, code: u32, value: impl Display) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{code}\r\n{value}\r");
    }

    fn place(&mut self, code: u32, at: Vec2) {
        self.pair(code, format_args!("{:.3}", at.x));
        self.pair(code + 10, format_args!("{:.3}", at.y));
    }

    fn section(&mut self, name: &str) {
        self.pair(0, "SECTION");
        self.pair(2, name);
    }

    fn block(&mut self, content: &Content<'_>, piece: &Piece, name: &str) {
        let place = |at: Vec2| at * 1000.0;
        self.pair(0, "BLOCK");
        self.pair(8, BOUNDARY);
        self.pair(2, name);
        self.pair(70, 0);
        self.place(10, Vec2::ZERO);
        for (number, line) in piece.outlines.iter().enumerate() {
            let layer = if number == 0 { BOUNDARY } else { INTERNAL };
            self.pair(0, "POLYLINE");
            self.pair(8, layer);
            self.pair(66, 1);
            self.pair(70, 1);
            for &at in line {
                self.pair(0, "VERTEX");
                self.pair(8, layer);
                self.place(10, place(at));
            }
            self.pair(0, "SEQEND");
        }
        let [tail, tip] = content.arrow(piece).map(place);
        self.pair(0, "LINE");
        self.pair(8, GRAIN);
        self.place(10, tail);
        self.place(11, tip);
        let said = content.said(piece);
        let fabric = said.fabric.as_deref().unwrap_or(texts::NO_FABRIC);
        let words = [
            format!("PIECE NAME: {name}"),
            "SIZE: 1".to_owned(),
            "QUANTITY: 1".to_owned(),
            format!("MATERIAL: {}", plain(fabric)),
            format!("ANNOTATION: {}", super::orientation(said.assignment.orientation)),
        ];
        for (k, text) in words.iter().enumerate() {
            self.text(place(piece.middle) - Vec2::Y * (1.5 * TEXT * (k + 1) as f32), text);
        }
        self.pair(0, "ENDBLK");
        self.pair(8, BOUNDARY);
    }

    fn text(&mut self, at: Vec2, text: &str) {
        self.pair(0, "TEXT");
        self.pair(8, BOUNDARY);
        self.place(10, at);
        self.pair(40, TEXT);
        self.pair(1, text);
    }
}

/// What the blocks are called: capitals, digits and `-`, each once.
fn names(content: &Content<'_>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for piece in &content.sheet.pieces {
        let name = plain(&content.sheet.panel(piece).name);
        let name: String =
            name.chars().map(|letter| if letter.is_ascii_alphanumeric() { letter } else { '-' }).collect();
        let mut free = name.clone();
        let mut number = 2;
        while names.contains(&free) || free.is_empty() {
            free = format!("{name}-{number}");
            number += 1;
        }
        names.push(free);
    }
    names
}

/// A text as R12 holds it: capitals of ASCII on one line.
fn plain(text: &str) -> String {
    text.chars()
        .map(
            |letter| {
                if letter.is_ascii_graphic() || letter == ' ' { letter.to_ascii_uppercase() } else { '?' }
            },
        )
        .collect()
}
