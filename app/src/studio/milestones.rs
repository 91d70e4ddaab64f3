//! When something was first shown, for whoever measures.

use eframe::egui;

/// Something that was shown for the first time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Milestone {
    /// The window.
    Window,
    /// The garment in it.
    Garment,
}

impl Milestone {
    /// In one word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Window => "window",
            Self::Garment => "garment",
        }
    }
}

/// Tells of milestones, once each.
#[derive(Default)]
pub(super) struct Milestones {
    tell: Option<Box<dyn FnMut(Milestone)>>,
    /// Those painted in the frame of this number, which is presented when the next one begins.
    painted: (u64, Vec<Milestone>),
    next: usize,
}

impl Milestones {
    pub(super) fn new(tell: Box<dyn FnMut(Milestone)>) -> Self {
        Self { tell: Some(tell), ..Self::default() }
    }

    /// At the start of a frame.
    pub(super) fn begin_frame(&mut self, context: &egui::Context) {
        let Some(tell) = &mut self.tell else { return };
        // A frame may be laid out twice before it is shown.
        if context.cumulative_frame_nr() > self.painted.0 {
            self.painted.1.drain(..).for_each(tell);
        }
    }

    /// At its end; `has_garment`: whether it was drawn.
    pub(super) fn end_frame(&mut self, context: &egui::Context, has_garment: bool) {
        const IN_ORDER: [Milestone; 2] = [Milestone::Window, Milestone::Garment];
        if self.tell.is_none() {
            return;
        }
        let reached = if has_garment { 2 } else { 1 };
        if reached > self.next {
            self.painted = (context.cumulative_frame_nr(), IN_ORDER[self.next..reached].to_vec());
            self.next = reached;
            context.request_repaint();
        }
    }
}
