//! The licences of all that the program is made of: whether the list it shows is that of its dependencies.
//! `UPDATE_LICENCES=1 cargo test --workspace --test licences` makes it anew.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Beginnings of the names of files that hold a licence, in upper case.
const NAMES: [&str; 5] = ["LICENSE", "LICENCE", "COPYING", "NOTICE", "UNLICENSE"];

/// What the program is handed out for; other systems link less, or their own libraries.
const PLATFORM: &str = "x86_64-unknown-linux-gnu";

#[test]
fn the_list_of_licences_is_of_these_dependencies() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/licences/third-party.txt");
    let text = gathered().unwrap();
    if std::env::var_os("UPDATE_LICENCES").is_some() {
        amc_core::file::save_bytes(&file, text.as_bytes()).unwrap();
    }
    let kept = std::fs::read_to_string(&file).unwrap();
    let differs = kept.lines().zip(text.lines()).find(|(kept, now)| kept != now);
    assert!(kept == text, "made anew with UPDATE_LICENCES=1 it would differ: {differs:?}");
}

/// Every crate with its licence, then every text once, with the crates that carry it.
fn gathered() -> Result<String, Box<dyn Error>> {
    let metadata = metadata()?;
    let mut list = String::new();
    let mut texts: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for package in linked(&metadata)? {
        let field = |name: &str| package[name].as_str().unwrap_or("");
        let name = format!("{} {}", field("name"), field("version"));
        list += &format!("{name}: {}\n", field("license"));
        let folder = Path::new(field("manifest_path")).parent().ok_or("a crate without a folder")?;
        for text in licence_texts(folder)? {
            texts.entry(text).or_default().insert(name.clone());
        }
    }
    let mut all = format!("The crates\n\n{list}");
    for (text, crates) in texts {
        let crates: Vec<&str> = crates.iter().map(String::as_str).collect();
        all += &format!("\n{}\n{}\n\n{text}\n", "-".repeat(80), wrapped(&crates.join(", ")));
    }
    Ok(all)
}

fn metadata() -> Result<Value, Box<dyn Error>> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--locked", "--offline", "--filter-platform", PLATFORM])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}

/// The packages that are linked into the program and are not its own, by name.
fn linked(metadata: &Value) -> Result<Vec<&Value>, Box<dyn Error>> {
    let array = |value: &'static str, of: &'_ Value| of[value].as_array().cloned().unwrap_or_default();
    let nodes: BTreeMap<String, Value> = array("nodes", &metadata["resolve"])
        .into_iter()
        .filter_map(|node| Some((node["id"].as_str()?.to_owned(), node)))
        .collect();
    let packages = metadata["packages"].as_array().ok_or("no packages")?;
    let program = packages.iter().find(|package| package["name"] == "amc-studio").ok_or("no program")?;
    let mut open: Vec<String> = program["id"].as_str().map(str::to_owned).into_iter().collect();
    let mut found = BTreeSet::new();
    while let Some(id) = open.pop() {
        if !found.insert(id.clone()) {
            continue;
        }
        for dependency in nodes.get(&id).map(|node| array("deps", node)).unwrap_or_default() {
            let is_linked = array("dep_kinds", &dependency).iter().any(|kind| kind["kind"].is_null());
            if let (true, Some(id)) = (is_linked, dependency["pkg"].as_str()) {
                open.push(id.to_owned());
            }
        }
    }
    let is_other = |package: &&Value| {
        package["id"].as_str().is_some_and(|id| found.contains(id)) && !package["source"].is_null()
    };
    Ok(packages.iter().filter(is_other).collect())
}

fn licence_texts(folder: &Path) -> Result<Vec<String>, Box<dyn Error>> {
    let mut texts = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().to_uppercase();
        if entry.file_type()?.is_file() && NAMES.iter().any(|begin| name.starts_with(begin)) {
            let text = String::from_utf8_lossy(&std::fs::read(entry.path())?).replace("\r\n", "\n");
            let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
            texts.push(lines.join("\n").trim_matches('\n').to_owned());
        }
    }
    texts.sort();
    Ok(texts)
}

/// Lines of at most a hundred letters.
fn wrapped(text: &str) -> String {
    let mut all = String::new();
    let mut width = 0;
    for word in text.split(' ') {
        if width + word.len() > 100 {
            all += "\n";
            width = 0;
        } else if width > 0 {
            all += " ";
        }
        all += word;
        width += word.len() + 1;
    }
    all
}
