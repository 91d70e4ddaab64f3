//! What a plugin of AMC Studio is, and what it sees of the studio.
//!
//! A [`Plugin`] declares itself once (name, commands, panes, importers) and is called each frame. It sees the studio only
//! through the [`Context`] it is handed: the [`document`], which it reads and changes by submitting [`document::Edit`]s; the
//! selection; jobs for whatever takes longer than a frame; notices; the graphics device. The studio's own panes are
//! plugins like any other.

mod command;
mod context;
pub mod document;
mod jobs;
mod notices;
mod plugin;
mod registry;
mod selection;
mod shading_choice;
mod stage;
mod viewport;

pub use command::Command;
pub use context::{Context, Request};
pub use jobs::{Job, JobView, Jobs};
pub use notices::{Notice, NoticeKind, Notices};
pub use plugin::{Importer, Pane, Place, Plugin};
pub use registry::{Registered, Registry};
pub use selection::Selection;
pub use shading_choice::ShadingChoice;
pub use stage::Stage;
pub use viewport::{Hand, ViewportView};
