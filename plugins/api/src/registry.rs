//! The plugins of a studio.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use amc_core::Result;
use serde_json::Value;

use crate::{Context, Cover, Notices, Plugin};

/// A registered plugin.
pub struct Registered {
    plugin: Box<dyn Plugin>,
    /// It panicked, and is called no more.
    off: bool,
}

impl std::fmt::Debug for Registered {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Registered").field("id", &self.plugin.id()).field("off", &self.off).finish()
    }
}

impl Registered {
    /// The plugin, to be asked what it declares.
    pub fn plugin(&self) -> &dyn Plugin {
        self.plugin.as_ref()
    }

    /// Whether it was switched off.
    pub fn is_off(&self) -> bool {
        self.off
    }

    /// Calls it, unless it is off. Where it panics, it is switched off, with a notice.
    pub fn call<T>(
        &mut self,
        studio: &mut Context<'_>,
        call: impl FnOnce(&mut dyn Plugin, &mut Context<'_>) -> T,
    ) -> Option<T> {
        studio.plugin = self.plugin.id();
        let outcome = self.guarded(|plugin| call(plugin, studio))?;
        if outcome.is_none() {
            self.tell_off(studio.notices);
        }
        outcome
    }

    /// Gives it back what it kept; none where it is off or fails.
    pub fn restore(&mut self, settings: Value, notices: &mut Notices) -> Option<Result<()>> {
        let outcome = self.guarded(|plugin| plugin.restore(settings))?;
        if outcome.is_none() {
            self.tell_off(notices);
        }
        outcome
    }

    /// What it wants kept; none where it is off or fails.
    pub fn settings(&mut self, notices: &mut Notices) -> Option<Option<Value>> {
        let outcome = self.guarded(|plugin| plugin.settings())?;
        if outcome.is_none() {
            self.tell_off(notices);
        }
        outcome
    }

    /// What it lays over the cloth; none where it is off or fails.
    fn cover(&mut self, notices: &mut Notices) -> Option<Arc<Cover>> {
        let outcome = self.guarded(|plugin| plugin.cover())?;
        if outcome.is_none() {
            self.tell_off(notices);
        }
        outcome?
    }

    /// What the call gives; nothing in it where it panicked, and nothing at all where the plugin is off.
    fn guarded<T>(&mut self, call: impl FnOnce(&mut dyn Plugin) -> T) -> Option<Option<T>> {
        if self.off {
            return None;
        }
        // What a panic leaves half done inside the plugin is never looked at again.
        let outcome = catch_unwind(AssertUnwindSafe(|| call(self.plugin.as_mut())));
        self.off = outcome.is_err();
        Some(outcome.ok())
    }

    fn tell_off(&self, notices: &mut Notices) {
        let name = self.plugin.name();
        notices.failed(format!(
            "the plugin '{name}' failed and is switched off until the studio is started again; your work is not touched"
        ));
    }
}

/// All plugins, in the order they were registered.
#[derive(Debug, Default)]
pub struct Registry {
    plugins: Vec<Registered>,
}

impl Registry {
    /// Adds a plugin. One of the same id takes the place of the former.
    pub fn register(&mut self, plugin: impl Plugin + 'static) {
        self.plugins.retain(|known| known.plugin.id() != plugin.id());
        self.plugins.push(Registered { plugin: Box::new(plugin), off: false });
    }

    /// All of them.
    pub fn plugins(&self) -> &[Registered] {
        &self.plugins
    }

    /// All of them, to be called.
    pub fn plugins_mut(&mut self) -> &mut [Registered] {
        &mut self.plugins
    }

    /// The plugin of this id.
    pub fn get_mut(&mut self, id: &str) -> Option<&mut Registered> {
        self.plugins.iter_mut().find(|known| known.plugin.id() == id)
    }

    /// What lies over the cloth: the first plugin's that has something.
    pub fn cover(&mut self, notices: &mut Notices) -> Option<Arc<Cover>> {
        self.plugins.iter_mut().find_map(|plugin| plugin.cover(notices))
    }

    /// Calls all that are on.
    pub fn each(
        &mut self,
        studio: &mut Context<'_>,
        mut call: impl FnMut(&mut dyn Plugin, &mut Context<'_>),
    ) {
        for plugin in &mut self.plugins {
            plugin.call(studio, &mut call);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Document, Project};
    use crate::{Ask, FileKind, Jobs, Request, Selection, Stage};

    /// Asks a question in every frame.
    struct Asking(&'static str);

    impl Plugin for Asking {
        fn id(&self) -> &'static str {
            self.0
        }

        fn name(&self) -> &'static str {
            "Asking"
        }

        fn update(&mut self, studio: &mut Context<'_>) {
            const KINDS: &[FileKind] = &[FileKind { name: "Lists", suffixes: &["csv"] }];
            studio.ask_where(Ask { id: "list", title: String::new(), name: String::new(), kinds: KINDS });
        }
    }

    #[test]
    fn a_question_is_that_of_the_plugin_that_asked() {
        let mut registry = Registry::default();
        registry.register(Asking("first"));
        registry.register(Asking("second"));
        let (document, stage) = (Document::new(Project::default()), Stage::default());
        let (mut selection, mut jobs, mut notices) =
            (Selection::default(), Jobs::new(|| {}), Notices::default());
        let mut requests = Vec::new();
        let about = (&mut jobs, &mut notices);
        let mut studio = Context::new((&document, &stage), &mut selection, about, None, &mut requests);
        registry.each(&mut studio, |plugin, studio| plugin.update(studio));
        let askers: Vec<_> = requests
            .iter()
            .filter_map(|request| match request {
                Request::AskWhere(plugin, ask) => Some((*plugin, ask.id)),
                _ => None,
            })
            .collect();
        assert_eq!(askers, [("first", "list"), ("second", "list")]);
    }
}
