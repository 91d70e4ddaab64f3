//! A page as PDF 1.7, its text in the Helvetica that every reader has.

use glam::Vec2;
use pdf_writer::{Content as Drawn, Finish as _, Name, Pdf, Rect, Ref, Str, TextStr};

use super::Content;
use super::page::{Mark, Page};

/// Points of a millimetre.
const POINTS: f32 = 72.0 / 25.4;

pub(super) fn bytes(content: &Content<'_>) -> Vec<u8> {
    let page = Page::new(content);
    let [catalog, tree, leaf, font, stream, information] = [1, 2, 3, 4, 5, 6].map(Ref::new);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(tree);
    pdf.pages(tree).kids([leaf]).count(1);
    let mut described = pdf.page(leaf);
    let size = page.size * POINTS;
    described.media_box(Rect::new(0.0, 0.0, size.x, size.y)).parent(tree).contents(stream);
    described.resources().fonts().pair(Name(b"F"), font);
    described.finish();
    pdf.type1_font(font).base_font(Name(b"Helvetica")).encoding_predefined(Name(b"WinAnsiEncoding"));
    pdf.stream(stream, &drawn(&page));
    pdf.document_info(information).title(TextStr(content.title));
    pdf.finish()
}

/// What draws the marks. PDF counts from the bottom.
fn drawn(page: &Page) -> Vec<u8> {
    let mut out = Drawn::new();
    let place = |at: Vec2| Vec2::new(at.x, page.size.y - at.y) * POINTS;
    let trace = |out: &mut Drawn, line: &[Vec2]| {
        for (k, at) in line.iter().map(|&at| place(at)).enumerate() {
            if k == 0 {
                out.move_to(at.x, at.y)
            } else {
                out.line_to(at.x, at.y)
            };
        }
    };
    for mark in &page.marks {
        match mark {
            Mark::Line { points, width } => {
                out.set_line_width(width * POINTS).set_stroke_gray(0.0);
                trace(&mut out, points);
                out.stroke();
            }
            Mark::Area { lines, grey } => {
                out.set_fill_gray(*grey);
                for line in lines {
                    trace(&mut out, line);
                    out.close_path();
                }
                out.fill_even_odd();
            }
            Mark::Text { at, size, text } => {
                let at = place(*at);
                out.set_fill_gray(0.0).begin_text().set_font(Name(b"F"), size * POINTS);
                out.next_line(at.x, at.y).show(Str(&win_ansi(text))).end_text();
            }
        }
    }
    out.finish().into_vec()
}

/// A text in the encoding of the font: Latin letters; others become question marks.
fn win_ansi(text: &str) -> Vec<u8> {
    let letters = text.chars().filter(|letter| !letter.is_control());
    letters
        .map(|letter| {
            u8::try_from(u32::from(letter)).ok().filter(|byte| !(0x80..0xa0).contains(byte)).unwrap_or(b'?')
        })
        .collect()
}
