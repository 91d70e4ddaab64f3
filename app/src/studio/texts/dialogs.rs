//! What the system's dialogs say.

pub(crate) const CHOOSING: &str = "Choosing a file";
pub(crate) const ALL_KINDS: &str = "All that can be opened";
pub(crate) const PROJECTS: &str = "Projects";
pub(crate) const GARMENTS: &str = "Garments";
pub(crate) const FABRICS: &str = "Fabrics";
