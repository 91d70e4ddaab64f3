//! Projects of older versions, brought up step by step.

use amc_core::{Error, Result};
use serde_json::{Value, json};
use studio_plugin::document::Asset;

use super::VERSION;

/// A step from one version to the next, on a file's JSON.
type Step = fn(Value) -> Result<Value>;

/// Step k brings version k to version k + 1. A new version is one more line.
const STEPS: [Step; VERSION as usize] = [from_0_to_1];

/// `value`, of `version` (at most the newest), as the newest version has it.
pub(super) fn migrated(value: Value, version: u32) -> Result<Value> {
    STEPS.iter().skip(version as usize).try_fold(value, |value, step| step(value))
}

/// Version 0 was written by hand for the command line: `{"garment": ..., "fabric": ...}`, both optional, each a bundled
/// name or a path; one fabric for all.
fn from_0_to_1(value: Value) -> Result<Value> {
    let Value::Object(mut old) = value else { return Err(Error::malformed("not a project")) };
    let mut take = |key: &str, default: &str| match old.shift_remove(key) {
        None | Some(Value::Null) => Ok(default.to_owned()),
        Some(Value::String(name)) => Ok(name),
        Some(_) => Err(Error::malformed("not a name or a path in quotes").at_element(key)),
    };
    let garment = take("garment", "garment:shirt")?;
    let fabric = take("fabric", "fabric:satin")?;
    let name = Asset::named(&fabric).name();
    let mut new = json!({
        "version": 1,
        "garment": garment,
        "fabrics": [{"id": 0, "name": name, "asset": fabric}],
    });
    if let Value::Object(new) = &mut new {
        old.shift_remove("version");
        // A version 0 had no other keys that mean anything now.
        for key in ["fabrics", "panels", "view", "notes"] {
            if old.contains_key(key) {
                let what = "this key belongs to version 1: add \"version\": 1 at the top, or remove it";
                return Err(Error::malformed(what).at_element(key));
            }
        }
        new.extend(old);
    }
    Ok(new)
}
