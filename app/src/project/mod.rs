//! Projects in files, and what keeps them safe.
//!
//! - [`parse`] and [`encode`]: the form of a `.amcproj`, on bytes alone; versions before the present one are brought up to it.
//! - [`open`] and [`save`]: a project and its file, with what is missing or has changed beside it.
//! - [`Autosave`] keeps unsaved work in a recovery file; [`recoverable`] finds what dead sessions left.
//! - [`ProjectLock`]: the second window on one project is told.
//! - [`recent`] and [`settings`]: small files in the settings' folder.
//!
//! Everything that is written goes through a [`Disk`], so that tests can make it full, read-only or broken; locks are
//! the operating system's own, which die with the process that holds them.

mod autosave;
mod disk;
mod form;
mod format;
mod lock;
mod migrations;
mod open;
mod paths;
pub mod recent;
mod recovery;
mod save;
pub mod settings;
#[cfg(test)]
mod tests;
mod unknown;

pub use autosave::Autosave;
pub use disk::{Disk, System};
pub use format::{FILE_LIMIT, Read, SUFFIX, VERSION, encode, parse};
pub use lock::{Claim, ProjectLock};
pub use open::{Missing, Opened, locate, open};
pub use recovery::{Recoverable, Recovery, recoverable};
pub use save::save;
pub use unknown::Unknown;

pub use crate::storage::Folders;
