//! The look: one table of tokens for each theme, and what egui is told of them.

use eframe::egui::{self, Color32, CornerRadius, FontFamily, FontId, Margin, Stroke, TextStyle, Theme, vec2};

/// The colours of a theme. Nothing else in the window names a colour.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tokens {
    /// Behind panes.
    pub(super) surface: Color32,
    /// Behind tab bars and between panes.
    pub(super) gap: Color32,
    /// Buttons and fields.
    pub(super) control: Color32,
    /// The same under the pointer.
    pub(super) control_hovered: Color32,
    /// Behind text that is typed.
    pub(super) field: Color32,
    /// Thin lines.
    pub(super) line: Color32,
    pub(super) text: Color32,
    pub(super) text_weak: Color32,
    /// What is selected.
    pub(super) accent: Color32,
    /// Text on it.
    pub(super) on_accent: Color32,
    pub(super) done: Color32,
    pub(super) failed: Color32,
}

const DARK: Tokens = Tokens {
    surface: Color32::from_rgb(0x20, 0x21, 0x24),
    gap: Color32::from_rgb(0x16, 0x17, 0x19),
    control: Color32::from_rgb(0x30, 0x32, 0x37),
    control_hovered: Color32::from_rgb(0x3c, 0x3f, 0x46),
    field: Color32::from_rgb(0x18, 0x19, 0x1b),
    line: Color32::from_rgb(0x36, 0x38, 0x3d),
    text: Color32::from_rgb(0xe6, 0xe6, 0xe3),
    text_weak: Color32::from_rgb(0xa0, 0xa3, 0xa9),
    accent: Color32::from_rgb(0xe0, 0x9a, 0x4f),
    on_accent: Color32::from_rgb(0x1b, 0x13, 0x0a),
    done: Color32::from_rgb(0x6f, 0xb8, 0x8a),
    failed: Color32::from_rgb(0xe8, 0x7a, 0x6d),
};

const LIGHT: Tokens = Tokens {
    surface: Color32::from_rgb(0xf6, 0xf5, 0xf2),
    gap: Color32::from_rgb(0xe2, 0xe0, 0xdb),
    control: Color32::from_rgb(0xe6, 0xe4, 0xdf),
    control_hovered: Color32::from_rgb(0xd8, 0xd5, 0xce),
    field: Color32::from_rgb(0xff, 0xff, 0xff),
    line: Color32::from_rgb(0xcf, 0xcc, 0xc5),
    text: Color32::from_rgb(0x22, 0x22, 0x20),
    text_weak: Color32::from_rgb(0x60, 0x5e, 0x59),
    accent: Color32::from_rgb(0x9c, 0x58, 0x12),
    on_accent: Color32::from_rgb(0xff, 0xff, 0xff),
    done: Color32::from_rgb(0x22, 0x6e, 0x42),
    failed: Color32::from_rgb(0xa8, 0x2d, 0x20),
};

/// Space between things, points: everything is a multiple.
pub(super) const STEP: f32 = 4.0;

impl Tokens {
    /// Those of the theme in use.
    pub(super) fn of(ui: &egui::Ui) -> Self {
        if ui.visuals().dark_mode { DARK } else { LIGHT }
    }
}

/// Tells egui of both themes.
pub(super) fn apply(context: &egui::Context) {
    // The studio has commands of its own for it, and remembers.
    context.options_mut(|options| options.zoom_with_keyboard = false);
    for (theme, tokens) in [(Theme::Dark, DARK), (Theme::Light, LIGHT)] {
        context.style_mut_of(theme, |style| {
            style.text_styles = [
                (TextStyle::Small, 11.0, FontFamily::Proportional),
                (TextStyle::Body, 13.0, FontFamily::Proportional),
                (TextStyle::Button, 13.0, FontFamily::Proportional),
                (TextStyle::Heading, 16.0, FontFamily::Proportional),
                (TextStyle::Monospace, 12.0, FontFamily::Monospace),
            ]
            .into_iter()
            .map(|(style, size, family)| (style, FontId::new(size, family)))
            .collect();
            style.spacing.item_spacing = vec2(2.0 * STEP, 1.5 * STEP);
            style.spacing.button_padding = vec2(2.0 * STEP, STEP);
            style.spacing.interact_size.y = 6.0 * STEP;
            style.spacing.menu_margin = Margin::same(6);
            style.spacing.window_margin = Margin::same(12);
            colour(&mut style.visuals, &tokens);
        });
    }
}

fn colour(visuals: &mut egui::Visuals, tokens: &Tokens) {
    let corner = CornerRadius::same(4);
    visuals.panel_fill = tokens.surface;
    visuals.window_fill = tokens.surface;
    visuals.window_stroke = Stroke::new(1.0, tokens.line);
    visuals.window_corner_radius = CornerRadius::same(8);
    visuals.menu_corner_radius = CornerRadius::same(6);
    visuals.extreme_bg_color = tokens.field;
    visuals.faint_bg_color = tokens.gap;
    visuals.code_bg_color = tokens.field;
    visuals.hyperlink_color = tokens.accent;
    visuals.error_fg_color = tokens.failed;
    visuals.warn_fg_color = tokens.accent;
    visuals.weak_text_color = Some(tokens.text_weak);
    visuals.selection.bg_fill = tokens.accent;
    visuals.selection.stroke = Stroke::new(1.0, tokens.on_accent);
    let widgets = &mut visuals.widgets;
    let states = [
        (&mut widgets.noninteractive, tokens.surface, tokens.line),
        (&mut widgets.inactive, tokens.control, tokens.control),
        (&mut widgets.hovered, tokens.control_hovered, tokens.line),
        (&mut widgets.active, tokens.control_hovered, tokens.accent),
        (&mut widgets.open, tokens.control_hovered, tokens.line),
    ];
    for (widget, fill, line) in states {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = Stroke::new(1.0, line);
        widget.fg_stroke = Stroke::new(1.0, tokens.text);
        widget.corner_radius = corner;
        widget.expansion = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The contrast of two colours, 1 to 21 (WCAG 2.2, "contrast ratio").
    fn contrast(a: Color32, b: Color32) -> f32 {
        let luminance = |c: Color32| {
            let [r, g, b] = [c.r(), c.g(), c.b()].map(|v| amc_core::color::LINEAR_FROM_SRGB8[usize::from(v)]);
            0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
        };
        let (a, b) = (luminance(a), luminance(b));
        a.max(b) / a.min(b)
    }

    #[test]
    fn text_can_be_read_on_every_surface() {
        for tokens in [DARK, LIGHT] {
            for surface in [tokens.surface, tokens.gap, tokens.field] {
                // WCAG 2.2 asks for 4.5 of small text.
                assert!(contrast(tokens.text, surface) >= 7.0);
                assert!(contrast(tokens.text_weak, surface) >= 4.5);
            }
            for colour in [tokens.failed, tokens.done, tokens.accent] {
                assert!(contrast(colour, tokens.surface) >= 4.5);
            }
            assert!(contrast(tokens.text, tokens.control_hovered) >= 4.5);
            assert!(contrast(tokens.on_accent, tokens.accent) >= 4.5);
        }
    }
}
