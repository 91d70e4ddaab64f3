//! What a plugin of AMC Studio is, and what it sees of the studio.
//!
//! A `Plugin` declares itself once (name, commands, panes, importers) and is called each frame. It sees the studio only
//! through the `Context` it is handed: the [`document`], which it reads and changes by submitting [`document::Edit`]s; the
//! selection; jobs for whatever takes longer than a frame; notices; the graphics device. The studio's own panes are
//! plugins like any other.
//!
//! Without the feature `window` there are no plugins: only what a program without a window uses of documents.

#[cfg(feature = "window")]
mod ask;
#[cfg(feature = "window")]
mod command;
#[cfg(feature = "window")]
mod context;
#[cfg(feature = "window")]
mod cover;
pub mod document;
mod jobs;
mod notices;
#[cfg(feature = "window")]
mod plugin;
#[cfg(feature = "window")]
mod registry;
mod selection;
mod shading_choice;
#[cfg(feature = "window")]
mod stage;
#[cfg(feature = "window")]
mod viewport;

#[cfg(feature = "window")]
pub use ask::{Ask, FileKind};
#[cfg(feature = "window")]
pub use command::Command;
#[cfg(feature = "window")]
pub use context::{Context, Request};
#[cfg(feature = "window")]
pub use cover::{Cover, Directions};
pub use jobs::{Job, JobView, Jobs};
pub use notices::{Notice, NoticeKind, Notices};
#[cfg(feature = "window")]
pub use plugin::{Importer, Pane, Place, Plugin};
#[cfg(feature = "window")]
pub use registry::{Registered, Registry};
pub use selection::Selection;
pub use shading_choice::ShadingChoice;
#[cfg(feature = "window")]
pub use stage::Stage;
#[cfg(feature = "window")]
pub use viewport::{Hand, ViewportView};
