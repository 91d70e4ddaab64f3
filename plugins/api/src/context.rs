//! What a plugin sees of the studio.

use amc_core::render::gpu::Gpu;

use crate::document::{Document, Edit, Gesture, ViewSettings};
use crate::{Ask, Jobs, Notices, Selection, Stage};

/// The studio, as a plugin sees it for the length of one call.
#[derive(Debug)]
pub struct Context<'a> {
    /// What the person works on. It is changed by [`Context::submit`].
    pub document: &'a Document,
    /// What the document refers to, as far as it is loaded.
    pub stage: &'a Stage,
    /// What is picked.
    pub selection: &'a mut Selection,
    /// For what takes longer than a frame.
    pub jobs: &'a mut Jobs,
    /// To tell the person something.
    pub notices: &'a mut Notices,
    /// The graphics device; none where the studio draws on the processor.
    pub gpu: Option<&'a Gpu>,
    requests: &'a mut Vec<Request>,
    /// The plugin and its tool in the person's hand.
    tool: Option<(&'static str, &'static str)>,
    /// The id of the plugin that is called.
    pub(crate) plugin: &'static str,
}

/// What is done after the call, in the order asked for.
#[derive(Debug, Clone, PartialEq)]
pub enum Request {
    /// An edit, and the gesture it is part of.
    Edit(Edit, Option<Gesture>),
    /// So many of the document's steps are to be done.
    GoTo(usize),
    /// Another view.
    View(ViewSettings),
    /// The plugin of this id offers the tool of this id; one that is in the hand already is put away.
    Tool(&'static str, &'static str),
    /// A text for the clipboard.
    Copy(String),
    /// The plugin of this id wants to know where to save.
    AskWhere(&'static str, Ask),
    /// The plugin of this id wants to know which file to take in.
    AskWhich(&'static str, Ask),
}

impl<'a> Context<'a> {
    /// Requests go to the end of `requests`.
    pub fn new(
        (document, stage): (&'a Document, &'a Stage),
        selection: &'a mut Selection,
        (jobs, notices): (&'a mut Jobs, &'a mut Notices),
        gpu: Option<&'a Gpu>,
        requests: &'a mut Vec<Request>,
    ) -> Self {
        Self { document, stage, selection, jobs, notices, gpu, requests, tool: None, plugin: "" }
    }

    /// With a plugin's tool in the person's hand.
    #[must_use]
    pub fn holding(self, tool: Option<(&'static str, &'static str)>) -> Self {
        Self { tool, ..self }
    }

    /// Whether this tool of the plugin that is called is in the person's hand.
    pub fn holds(&self, tool: &str) -> bool {
        self.tool == Some((self.plugin, tool))
    }

    /// Puts this tool of the plugin that is called into the person's hand; one that is there already is put away.
    pub fn take(&mut self, tool: &'static str) {
        self.requests.push(Request::Tool(self.plugin, tool));
    }

    /// Submits an edit: one step of the undo.
    pub fn submit(&mut self, edit: Edit) {
        self.requests.push(Request::Edit(edit, None));
    }

    /// Submits an edit that is part of a gesture: all edits of one gesture are one step.
    pub fn submit_in(&mut self, gesture: Gesture, edit: Edit) {
        self.requests.push(Request::Edit(edit, Some(gesture)));
    }

    /// Undoes or does again, until so many steps are done.
    pub fn go_to(&mut self, position: usize) {
        self.requests.push(Request::GoTo(position));
    }

    /// Looks at the garment in another way.
    pub fn set_view(&mut self, view: ViewSettings) {
        self.requests.push(Request::View(view));
    }

    /// Asks the person, by a file dialog, where something is to be saved. The answer comes to [`crate::Plugin::chosen`], in
    /// a later frame; there is none where the dialog is called off, or another one is open.
    pub fn ask_where(&mut self, ask: Ask) {
        self.requests.push(Request::AskWhere(self.plugin, ask));
    }

    /// Asks the person, by a file dialog, which file is to be taken in. The answer comes as that of [`Context::ask_where`].
    pub fn ask_which(&mut self, ask: Ask) {
        self.requests.push(Request::AskWhich(self.plugin, ask));
    }

    /// Puts a text into the clipboard.
    pub fn copy(&mut self, text: impl Into<String>) {
        self.requests.push(Request::Copy(text.into()));
    }
}
