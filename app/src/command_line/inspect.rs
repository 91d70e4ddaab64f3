//! `amc-studio inspect`: what a project, a mesh, an AMC or a capture session holds.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use amc_core::amc::Amc;
use amc_core::capture::{SESSION_FILE, Session};
use amc_core::mesh::{Distortion, Garment, Panel, Unit};
use amc_core::{Error, Progress, Result};
use serde_json::{Value, json};
use studio_plugin::document::{
    Asset, ColourwayLabel, FabricId, FabricInUse, PanelChoice, PanelPrint, PanelWear,
};

use super::Outcome;
use super::output::Output;
use super::values::unit;
use crate::project::{self, Opened, SUFFIX, System};
use crate::scene::load_garment;

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A project, a mesh, garment:NAME, shape:NAME, an AMC, or a session's folder.
    file: PathBuf,
    /// What a mesh's numbers mean: m, dm, cm or mm.
    #[arg(long, default_value = "m", value_parser = unit)]
    unit: Unit,
}

pub(super) fn run(arguments: &Arguments, output: &Output) -> Outcome {
    let found = inspect(&arguments.file, arguments.unit)?;
    output.result(&found, || as_text(&found, 0))?;
    Ok(())
}

fn inspect(file: &Path, unit: Unit) -> Result<Value> {
    if file.is_dir() || file.file_name().is_some_and(|name| name == SESSION_FILE) {
        return session(file);
    }
    match file.extension().and_then(|suffix| suffix.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("ktx2") => amc(file),
        Some(SUFFIX) => project(file),
        _ => Ok(mesh(&load_garment(file, unit)?)),
    }
}

fn mesh(garment: &Garment) -> Value {
    json!({
        "kind": "mesh",
        "vertices": garment.file_vertices,
        "triangles": garment.triangles.len(),
        "has_uvs": garment.has_uvs,
        "panels": garment.panels.iter().zip(garment.distortion())
            .map(|(panel, distortion)| describe(garment, panel, distortion))
            .collect::<Vec<_>>(),
        "notices": garment.notices,
    })
}

fn describe(garment: &Garment, panel: &Panel, Distortion { stretch, shear }: Distortion) -> Value {
    let mut described = json!({
        "id": panel.id,
        "name": panel.name,
        "triangles": panel.triangles.len(),
        "area": panel.area,
        "takes_fabric": panel.takes_fabric,
        "mirrored": panel.flags.mirrored,
        "degenerate": panel.flags.degenerate,
        "stretch": { "p50": stretch.p50, "p95": stretch.p95 },
        "shear": { "p5": shear.p5.to_degrees(), "p95": shear.p95.to_degrees() },
    });
    // What a pattern says is there only where a pattern said it.
    let pattern = &panel.pattern;
    let id = |panel: usize| &garment.panels[panel].id;
    if let Some(grain) = pattern.grain {
        described["grain_deg"] = json!(grain.to_degrees());
    }
    if let Some(mirror) = pattern.mirror {
        described["mirror"] = json!(id(mirror));
    }
    if !pattern.seams.is_empty() {
        let seams =
            pattern.seams.iter().map(|seam| json!({ "name": seam.name, "partner": id(seam.partner) }));
        described["seams"] = seams.collect();
    }
    described
}

/// What is written in it, with files as they were found. The garment is not read.
fn project(file: &Path) -> Result<Value> {
    let Opened { project, missing, notices, .. } = project::open(&System, file, &Progress::none())?;
    let asset = |asset: &Asset| match asset {
        Asset::Bundled(name) => json!({ "bundled": name }),
        Asset::File { path, .. } => json!({
            "file": path,
            "missing": missing.iter().any(|missing| missing.asset == *asset),
        }),
    };
    let fabric = |fabric: &FabricInUse| {
        let mut described = json!({ "id": fabric.id, "name": fabric.name });
        merge(&mut described, asset(&fabric.asset));
        described
    };
    let wear = |fabric: Option<Option<FabricId>>, print: Option<&PanelPrint>| {
        let mut described = json!({});
        // What nobody has chosen is not there; a chosen null is plain grey.
        if let Some(fabric) = fabric {
            described["fabric"] = json!(fabric);
        }
        if let Some(print) = print {
            described["print"] = asset(&print.picture);
            described["print_width_m"] = json!(print.laying.width);
        }
        described
    };
    let panel = |(id, choice): (&String, &PanelChoice)| {
        let mut described = json!({ "id": id, "visible": choice.visible });
        merge(&mut described, wear(choice.fabric, choice.print.as_ref()));
        if let Some(direction) = choice.direction {
            described["angle_deg"] = json!(direction.angle.to_degrees());
            described["source"] = json!(direction.source);
        }
        described
    };
    let colourway = |(label, kept): (&ColourwayLabel, Option<&BTreeMap<String, PanelWear>>)| {
        let mut described = json!({ "id": label.id, "name": label.name, "worn": kept.is_none() });
        if let Some(kept) = kept {
            let panel = |(id, panel): (&String, &PanelWear)| {
                let mut described = json!({ "id": id });
                merge(&mut described, wear(panel.fabric, panel.print.as_ref()));
                described
            };
            described["panels"] = kept.iter().map(panel).collect();
        }
        described
    };
    Ok(json!({
        "kind": "project",
        "garment": asset(&project.garment),
        "fabrics": project.fabrics.iter().map(fabric).collect::<Vec<_>>(),
        "panels": project.panels.iter().map(panel).collect::<Vec<_>>(),
        "arrangement": project.arrangement,
        "groups": project.groups,
        "colourways": project.colourways.all().map(colourway).collect::<Vec<_>>(),
        "view": project.view,
        "notes": project.notes,
        "notices": notices,
    }))
}

/// Adds the members of one object to another.
fn merge(into: &mut Value, more: Value) {
    if let (Value::Object(into), Value::Object(more)) = (into, more) {
        into.extend(more);
    }
}

fn amc(file: &Path) -> Result<Value> {
    serde_json::to_value(Amc::read(file)?.summary())
        .map_err(|error| Error::invalid("its summary cannot be written as JSON").because(error).in_file(file))
}

fn session(path: &Path) -> Result<Value> {
    let session = if path.is_dir() { Session::read(&path.join(SESSION_FILE))? } else { Session::read(path)? };
    Ok(json!({
        "kind": "session",
        "pictures": session.pictures.iter().map(|picture| json!({
            "file": picture.file,
            "angle_deg": picture.angle_deg,
        })).collect::<Vec<_>>(),
        "turn": session.turn,
    }))
}

/// A JSON value as indented lines `key: value`; lists longer than a page by their length.
fn as_text(value: &Value, depth: usize) -> String {
    let indent = "  ".repeat(depth);
    let Value::Object(members) = value else { return format!("{indent}{value}\n") };
    let mut text = String::new();
    for (key, member) in members {
        match member {
            Value::Object(inner) if !inner.is_empty() && depth < 2 => {
                text += &format!("{indent}{key}:\n{}", as_text(member, depth + 1));
            }
            Value::Array(items) if items.len() > 64 => {
                text += &format!("{indent}{key}: {} of them\n", items.len())
            }
            Value::Array(items) if !items.is_empty() => {
                text += &format!("{indent}{key}:\n");
                for item in items {
                    text += &format!("{indent}  {}\n", one_line(item));
                }
            }
            other => text += &format!("{indent}{key}: {}\n", one_line(other)),
        }
    }
    text
}

/// A value in one line: members as `key value`, numbers short.
fn one_line(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Number(number) => match (number.as_i64(), number.as_f64()) {
            (None, Some(float)) => format!("{float:.4}"),
            _ => number.to_string(),
        },
        Value::Object(members) => {
            let parts: Vec<_> =
                members.iter().map(|(key, member)| format!("{key} {}", one_line(member))).collect();
            parts.join(", ")
        }
        Value::Array(items) => items.iter().map(one_line).collect::<Vec<_>>().join(" "),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nested_values_become_indented_lines() {
        let value = json!({ "kind": "mesh", "panels": [{ "id": "a", "area": 0.25 }], "empty": [] });
        assert_eq!(as_text(&value, 0), "kind: mesh\npanels:\n  id a, area 0.2500\nempty: \n");
    }
}
