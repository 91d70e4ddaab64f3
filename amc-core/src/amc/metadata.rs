//! What an AMC file says about itself beside the texels.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Names, notes and origin of an AMC. Keys this program does not know are kept as they are.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Metadata {
    /// What people call the fabric.
    pub name: String,
    /// Words to find it by.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tags: Vec<String>,
    /// Anything else worth saying.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub notes: String,
    /// The lighting it was taken or baked under, in words or as data.
    #[serde(skip_serializing_if = "Value::is_null")]
    pub lighting: Value,
    /// How it was captured or baked: rig, camera, date, pictures, residuals.
    #[serde(skip_serializing_if = "Value::is_null")]
    pub capture: Value,
    /// Keys of later versions, or of other programs.
    #[serde(flatten)]
    pub other: Map<String, Value>,
}
