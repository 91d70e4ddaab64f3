//! A page as SVG 1.1, in millimetres.

use std::fmt::Write as _;

use glam::Vec2;

use super::Content;
use super::page::{Mark, Page};

pub(super) fn bytes(content: &Content<'_>) -> Vec<u8> {
    let Page { size, marks } = Page::new(content);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {} {}\" font-family=\"Helvetica, \
         Arial, sans-serif\">\n<title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        size.x,
        size.y,
        size.x,
        size.y,
        escaped(content.title)
    );
    for mark in marks {
        // Writing to a string cannot fail.
        let _ = match mark {
            Mark::Line { points, width } => {
                writeln!(
                    out,
                    "<path d=\"{}\" fill=\"none\" stroke=\"#000\" stroke-width=\"{width}\" stroke-linejoin=\"round\"/>",
                    path(&points)
                )
            }
            Mark::Area { lines, grey } => {
                let lines: Vec<String> = lines.iter().map(|line| path(line) + "Z").collect();
                let level = (grey * 255.0).round();
                writeln!(
                    out,
                    "<path d=\"{}\" fill=\"rgb({level},{level},{level})\" fill-rule=\"evenodd\"/>",
                    lines.concat()
                )
            }
            Mark::Text { at, size, text } => {
                writeln!(
                    out,
                    "<text x=\"{:.3}\" y=\"{:.3}\" font-size=\"{size}\">{}</text>",
                    at.x,
                    at.y,
                    escaped(&text)
                )
            }
        };
    }
    out.push_str("</svg>\n");
    out.into_bytes()
}

fn path(points: &[Vec2]) -> String {
    let part = |(k, at): (usize, &Vec2)| format!("{}{:.3} {:.3}", if k == 0 { 'M' } else { 'L' }, at.x, at.y);
    points.iter().enumerate().map(part).collect()
}

/// A text for XML; what XML cannot hold is left out.
fn escaped(text: &str) -> String {
    let letters = text.chars().filter(|letter| !letter.is_control());
    letters.fold(String::new(), |mut out, letter| {
        match letter {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            other => out.push(other),
        }
        out
    })
}
