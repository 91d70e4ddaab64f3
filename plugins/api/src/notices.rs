//! What the studio tells the person: shown for a moment, kept in the log.

use std::time::SystemTime;

/// How much a notice matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoticeKind {
    /// Something is done.
    Done,
    /// Something is worth knowing.
    Note,
    /// Something did not work.
    Failed,
}

/// One thing that was told.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Notice {
    /// How much it matters.
    pub kind: NoticeKind,
    /// One line.
    pub text: String,
    /// When it was told.
    pub at: SystemTime,
}

/// All that was told in this session, oldest first; the oldest are dropped beyond [`Notices::LIMIT`].
#[derive(Debug, Default)]
pub struct Notices {
    all: Vec<Notice>,
}

impl Notices {
    /// How many are kept.
    pub const LIMIT: usize = 1000;

    /// Tells that something is done.
    pub fn done(&mut self, text: impl Into<String>) {
        self.tell(NoticeKind::Done, text.into());
    }

    /// Tells something worth knowing.
    pub fn note(&mut self, text: impl Into<String>) {
        self.tell(NoticeKind::Note, text.into());
    }

    /// Tells what did not work: an [`amc_core::Error`] says what, where and why in one line.
    pub fn failed(&mut self, error: impl std::fmt::Display) {
        self.tell(NoticeKind::Failed, error.to_string());
    }

    /// What is kept, oldest first.
    pub fn all(&self) -> &[Notice] {
        &self.all
    }

    fn tell(&mut self, kind: NoticeKind, text: String) {
        match kind {
            NoticeKind::Failed => log::error!("{text}"),
            NoticeKind::Done | NoticeKind::Note => log::info!("{text}"),
        }
        if self.all.len() == Self::LIMIT {
            self.all.remove(0);
        }
        self.all.push(Notice { kind, text, at: SystemTime::now() });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_are_dropped_beyond_the_limit() {
        let mut notices = Notices::default();
        for k in 0..Notices::LIMIT + 5 {
            notices.note(format!("{k}"));
        }
        assert_eq!(notices.all().len(), Notices::LIMIT);
        assert_eq!(notices.all()[0].text, "5");
    }
}
