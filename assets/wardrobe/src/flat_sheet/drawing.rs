//! A picture in SVG.

use std::fmt::Write;

use glam::DVec2;

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Style {
    /// A piece's outline, its inside tinted.
    Outline,
    /// A thin line.
    Line,
    /// A dashed line.
    Fold,
    /// The grain's arrow.
    Grain,
    /// A filled arrow head.
    Head,
    /// A thick line.
    Bar,
}

/// Which point of a text lies at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A picture that is being drawn. Units are the sheet's, the second coordinate downwards.
#[derive(Debug)]
pub(super) struct Drawing {
    pub(super) size: DVec2,
    /// The height of small type.
    pub(super) type_size: f64,
    body: String,
}

impl Drawing {
    pub(super) fn new(size: DVec2, type_size: f64) -> Self {
        Self { size, type_size, body: String::new() }
    }

    pub(super) fn line(&mut self, points: &[DVec2], style: Style) {
        let mut path = String::new();
        for (i, point) in points.iter().enumerate() {
            let command = if i == 0 { 'M' } else { 'L' };
            // Writing to a string cannot fail.
            let _ = write!(path, "{command}{:.2} {:.2}", point.x, point.y);
        }
        if matches!(style, Style::Outline | Style::Head) {
            path.push('Z');
        }
        let width = self.type_size
            * match style {
                Style::Outline => 0.16,
                Style::Grain => 0.12,
                Style::Bar => 0.5,
                Style::Line | Style::Fold | Style::Head => 0.08,
            };
        let (fill, dash) = match style {
            Style::Outline => ("#f4efe4", String::new()),
            Style::Head => ("#222222", String::new()),
            Style::Fold => (
                "none",
                format!(" stroke-dasharray=\"{:.2} {:.2}\"", self.type_size * 0.9, self.type_size * 0.5),
            ),
            _ => ("none", String::new()),
        };
        let _ = writeln!(
            self.body,
            "<path d=\"{path}\" fill=\"{fill}\" stroke=\"#222222\" stroke-width=\"{width:.3}\" stroke-linejoin=\"round\"{dash}/>"
        );
    }

    pub(super) fn circle(&mut self, centre: DVec2, radius: f64) {
        let width = self.type_size * 0.08;
        let _ = writeln!(
            self.body,
            "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"{radius:.2}\" fill=\"none\" stroke=\"#222222\" stroke-width=\"{width:.3}\"/>",
            centre.x, centre.y
        );
    }

    /// Writes at a point, turned by degrees clockwise, `times` as large as small type.
    pub(super) fn text(&mut self, at: DVec2, turn: f64, anchor: Anchor, times: f64, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let size = self.type_size * times;
        // The middle of the letters, not their base line, comes to lie at the point.
        let _ = writeln!(
            self.body,
            "<text transform=\"translate({:.2} {:.2}) rotate({turn:.2})\" x=\"0\" y=\"{:.2}\" font-size=\"{size:.2}\" text-anchor=\"{anchor}\">{}</text>",
            at.x,
            at.y,
            size * 0.35,
            escaped(text)
        );
    }

    /// The whole file.
    pub(super) fn finish(self) -> String {
        let DVec2 { x, y } = self.size;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{x:.2}mm\" height=\"{y:.2}mm\" viewBox=\"0 0 {x:.2} {y:.2}\" font-family=\"sans-serif\" fill=\"#222222\">\n\
             <rect width=\"{x:.2}\" height=\"{y:.2}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            self.body
        )
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
