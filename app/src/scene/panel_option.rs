//! What is said of one panel, or of all, in one line: `ID|all[,amc=FILE][,angle=DEG][,source=...][,class=...]`.

use std::path::PathBuf;
use std::str::FromStr;

use amc_core::direction::Orientation;
use amc_core::mesh::Panel;

/// Where a panel's direction comes from, as it is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SourceName {
    Gradient,
    Yarn,
    /// Circles around the axis 0, 1, 2 (x, y, z) through the garment's centre.
    Around(usize),
    /// Along the axis 0, 1, 2.
    Along(usize),
    /// Away from the garment's centre.
    Radial,
}

/// The names as they are written; also the help.
pub(crate) const SOURCES: [(&str, SourceName); 9] = [
    ("gradient", SourceName::Gradient),
    ("yarn", SourceName::Yarn),
    ("around-x", SourceName::Around(0)),
    ("around-y", SourceName::Around(1)),
    ("around-z", SourceName::Around(2)),
    ("along-x", SourceName::Along(0)),
    ("along-y", SourceName::Along(1)),
    ("along-z", SourceName::Along(2)),
    ("radial", SourceName::Radial),
];

impl PanelOption {
    /// Whether it is for this panel. 'all' means all cloth; a part that takes no fabric is meant only by its own id.
    pub(crate) fn is_for(&self, panel: &Panel) -> bool {
        match &self.id {
            Some(id) => *id == panel.id,
            None => panel.takes_fabric,
        }
    }
}

/// One `--panel`: what is said of one panel or of all; what is not said stays as it was.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PanelOption {
    /// None: all panels.
    pub(crate) id: Option<String>,
    /// A file, or `fabric:NAME`.
    pub(crate) amc: Option<PathBuf>,
    pub(crate) angle_degrees: Option<f32>,
    pub(crate) source: Option<SourceName>,
    /// In which turns it may be laid.
    pub(crate) class: Option<Orientation>,
}

impl FromStr for PanelOption {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut parts = text.split(',');
        let id = parts.next().unwrap_or_default();
        if id.is_empty() || id.contains('=') {
            return Err("expected a panel's id or 'all' first (ids: amc-studio inspect MESH)".to_owned());
        }
        let id = (id != "all").then(|| id.to_owned());
        let mut option = Self { id, amc: None, angle_degrees: None, source: None, class: None };
        for part in parts {
            match part.split_once('=') {
                Some(("amc", file)) if !file.is_empty() => option.amc = Some(file.into()),
                Some(("angle", degrees)) => {
                    let degrees = degrees.parse::<f32>().ok().filter(|degrees| degrees.is_finite());
                    option.angle_degrees =
                        Some(degrees.ok_or("an angle is a number of degrees, such as angle=45")?);
                }
                Some(("source", name)) => {
                    let known = SOURCES.iter().find(|(known, _)| *known == name);
                    let (_, source) = known.ok_or_else(|| {
                        let names: Vec<_> = SOURCES.iter().map(|(name, _)| *name).collect();
                        format!("the source '{name}' is none of {}", names.join(", "))
                    })?;
                    option.source = Some(*source);
                }
                Some(("class", name)) => {
                    let names = Orientation::ALL.map(Orientation::name).join(", ");
                    let known = Orientation::named(name);
                    option.class =
                        Some(known.ok_or_else(|| format!("the class '{name}' is none of {names}"))?);
                }
                _ => {
                    return Err(format!(
                        "'{part}' is none of amc=FILE, angle=DEGREES, source=NAME, class=NAME"
                    ));
                }
            }
        }
        Ok(option)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_option_says_only_what_it_says() {
        let option: PanelOption = "front,angle=-12.5,source=yarn,class=one-way".parse().unwrap();
        assert_eq!(option.class, Some(Orientation::OneWay));
        assert_eq!(option.id.as_deref(), Some("front"));
        assert_eq!(
            (option.angle_degrees, option.source, option.amc),
            (Some(-12.5), Some(SourceName::Yarn), None)
        );
        assert_eq!("all,amc=a.amc.ktx2".parse::<PanelOption>().unwrap().id, None);
        for wrong in [
            "",
            "angle=3",
            "all,angle=north",
            "all,source=warp",
            "all,class=both",
            "all,amc=",
            "all,colour=red",
            "all,angle=NaN",
        ] {
            assert!(wrong.parse::<PanelOption>().is_err(), "{wrong}");
        }
    }
}
