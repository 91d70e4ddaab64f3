//! Mirror partners: the left and the right of what is worn on both sides.

use amc_core::mesh::Garment;

/// The panel of which `panel` is the mirror image: as the garment's file says; else the only one whose name has `left` for its
/// `right` or the other way round, and that has the same area to 1 %.
pub(crate) fn partner(garment: &Garment, panel: usize) -> Option<usize> {
    let this = garment.panels.get(panel)?;
    if this.pattern.mirror.is_some() {
        return this.pattern.mirror;
    }
    let wanted = swapped(&this.name.to_lowercase())?;
    let fits = |&other: &usize| {
        let other = &garment.panels[other];
        other.name.to_lowercase() == wanted && (other.area - this.area).abs() <= 0.01 * this.area
    };
    let mut found = (0..garment.panels.len()).filter(|&other| other != panel).filter(fits);
    found.next().filter(|_| found.next().is_none())
}

/// A name with the other side's word in it.
fn swapped(name: &str) -> Option<String> {
    let sides = [("left", "right"), ("right", "left")];
    sides.iter().find(|(side, _)| name.contains(side)).map(|(side, other)| name.replacen(side, other, 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use amc_core::mesh::Panel;

    fn panel(name: &str, area: f32) -> Panel {
        Panel {
            id: name.to_owned(),
            name: name.to_owned(),
            triangles: 0..0,
            takes_fabric: true,
            area,
            flags: Default::default(),
            pattern: Default::default(),
        }
    }

    #[test]
    fn what_the_file_says_goes_before_names() {
        let named =
            ["Left sleeve", "Right sleeve", "left cuff", "right cuff", "back", "left pocket", "Right pocket"];
        let areas = [0.2, 0.2001, 0.01, 0.02, 0.5, 0.1, 0.1];
        let mut garment = Garment {
            panels: named.iter().zip(areas).map(|(name, area)| panel(name, area)).collect(),
            ..Garment::default()
        };
        assert_eq!((partner(&garment, 0), partner(&garment, 1)), (Some(1), Some(0)));
        assert_eq!((partner(&garment, 2), partner(&garment, 4)), (None, None), "not alike; no sides");
        garment.panels[5].pattern.mirror = Some(4);
        assert_eq!(
            (partner(&garment, 5), partner(&garment, 6), partner(&garment, 99)),
            (Some(4), Some(5), None)
        );
    }
}
