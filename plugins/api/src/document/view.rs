//! How the garment is looked at.

use serde::{Deserialize, Serialize};

/// How the garment is looked at: saved with the project, but no step of its undo.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ViewSettings {}
