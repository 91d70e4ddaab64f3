//! Names and ids of panels that outlive another save of the file.

use std::collections::HashMap;
use std::hash::Hash;

use super::measure::Figures;

/// Most characters of a part's name in an id.
const SLUG_LIMIT: usize = 40;

/// Steps per unit of the UV map in which a panel's place is kept in its id: coarser than any rounding of a save.
const PLACE_STEPS: f32 = 256.0;

/// What panels are told apart by.
pub(super) struct Nameable<'a> {
    /// Of the panel's part.
    pub(super) part_name: &'a str,
    pub(super) figures: &'a Figures,
}

/// A panel's id and name.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Identity {
    pub(super) id: String,
    pub(super) name: String,
}

/// Gives every panel an id and a name; all ids differ.
///
/// The id of a part's only panel is the part's name in plain letters (`left-sleeve`). Where several panels have the
/// same part name, four hexadecimal digits follow that stand for the middle of the panel's box in the UV map
/// (`shirt-4c1f`); panels that lie over each other there are numbered by their place in space (`shirt-4c1f-2`).
/// So an id does not depend on the order of vertices, triangles or parts, on the unit, on how polygons were cut, nor
/// on panels elsewhere in the pattern; it changes when its part is renamed or, among several, when the panel is moved
/// in the UV map. (A middle within the rounding error of a step's edge may change with a less exact save.)
///
/// The name is the part's, numbered from the top of the flat pattern where there are several.
pub(super) fn identify(panels: &[Nameable<'_>]) -> Vec<Identity> {
    let mut identities = vec![Identity::default(); panels.len()];
    let slugs: Vec<String> = panels.iter().map(|panel| slug(panel.part_name)).collect();
    for members in groups(&slugs) {
        for &panel in &members {
            identities[panel].id.clone_from(&slugs[panel]);
        }
        if members.len() > 1 {
            let place = |panel: usize| format!("{}-{}", slugs[panel], place_digits(panels[panel].figures));
            members.iter().for_each(|&panel| identities[panel].id = place(panel));
        }
    }
    let ids: Vec<String> = identities.iter().map(|identity| identity.id.clone()).collect();
    for mut members in groups(&ids) {
        members.sort_by(|&a, &b| in_space(panels[a].figures).total_cmp(&in_space(panels[b].figures)));
        for (number, &panel) in members.iter().enumerate().skip(1) {
            identities[panel].id = format!("{}-{}", ids[panel], number + 1);
        }
    }
    make_unique(&mut identities);

    let names: Vec<&str> = panels.iter().map(|panel| panel.part_name).collect();
    for mut members in groups(&names) {
        let several = members.len() > 1;
        members.sort_by(|&a, &b| {
            reading_order(panels[a].figures)
                .total_cmp(&reading_order(panels[b].figures))
                .then_with(|| identities[a].id.cmp(&identities[b].id))
        });
        for (number, &panel) in members.iter().enumerate() {
            let name = names[panel];
            identities[panel].name = if several { format!("{name} {}", number + 1) } else { name.to_owned() };
        }
    }
    identities
}

/// Indices of equal keys, in the order of their first.
fn groups<K: Hash + Eq>(keys: &[K]) -> Vec<Vec<usize>> {
    let mut group_of = HashMap::new();
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (index, key) in keys.iter().enumerate() {
        let group = *group_of.entry(key).or_insert(groups.len());
        if group == groups.len() {
            groups.push(Vec::new());
        }
        groups[group].push(index);
    }
    groups
}

/// A part named like another's numbered id is the only way for two ids to be equal still.
fn make_unique(identities: &mut [Identity]) {
    let mut taken = std::collections::HashSet::new();
    let mut next = HashMap::new();
    for identity in identities {
        while !taken.insert(identity.id.clone()) {
            let number = next.entry(identity.id.clone()).or_insert(2);
            identity.id = format!("{}-x{number}", identity.id);
            *number += 1;
        }
    }
}

/// Letters and digits in lower case, all else a hyphen.
fn slug(name: &str) -> String {
    let mut slug = String::new();
    for letter in name.chars().flat_map(char::to_lowercase).take(SLUG_LIMIT) {
        if letter.is_alphanumeric() {
            slug.push(letter);
        } else if !slug.is_empty() && !slug.ends_with('-') {
            slug.push('-');
        }
    }
    let slug = slug.trim_end_matches('-');
    if slug.is_empty() { "panel".to_owned() } else { slug.to_owned() }
}

fn place_digits(figures: &Figures) -> String {
    let (low, high) = figures.uv_box;
    // Half a step off: patterns like to lie at round numbers, which must not be the edge of a step.
    let steps = ((low + high) * 0.5 * PLACE_STEPS + glam::Vec2::new(0.382, 0.618)).floor();
    let (u, v) = (steps.x as i64, steps.y as i64);
    let mixed = (u.wrapping_mul(0x9E37_79B9) ^ v.wrapping_mul(0x85EB_CA6B)) as u64;
    format!("{:04x}", (mixed ^ (mixed >> 16)) & 0xFFFF)
}

/// A number that tells places apart, mirrored ones too; near ones are near, so a rounding does not change an order.
fn in_space(figures: &Figures) -> f32 {
    figures.centre.dot(glam::Vec3::new(1.0, 0.31, 0.11))
}

/// From the top of the flat pattern down; u tells apart what lies side by side.
fn reading_order(figures: &Figures) -> f32 {
    let (low, high) = figures.uv_box;
    (low.x + high.x) * 0.1592 - (low.y + high.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec2, Vec3};

    fn figures(u: f32, v: f32, x: f32) -> Figures {
        let middle = Vec2::new(u, v);
        Figures { uv_box: (middle - 0.1, middle + 0.1), centre: Vec3::X * x, ..Figures::default() }
    }

    fn ids(panels: &[(&str, Figures)]) -> Vec<String> {
        let panels: Vec<_> =
            panels.iter().map(|(part_name, figures)| Nameable { part_name, figures }).collect();
        identify(&panels).into_iter().map(|identity| identity.id).collect()
    }

    #[test]
    fn ids_do_not_depend_on_order_small_errors_or_other_panels() {
        let all = [
            ("Shirt Front", figures(0.5, 0.5, 0.0)),
            ("sleeves", figures(0.25, 0.75, -1.0)),
            ("sleeves", figures(0.25, 0.75, 1.0)),
            ("sleeves", figures(0.75, 0.25, 0.0)),
        ];
        let before = ids(&all);
        assert_eq!(before[0], "shirt-front");
        assert_eq!(before[2], format!("{}-2", before[1]));
        let mut reversed = all;
        reversed.reverse();
        for (_, figures) in &mut reversed {
            figures.uv_box.0 += 1e-5;
            figures.centre += 1e-5;
        }
        reversed[3].0 = "Collar";
        let after = ids(&reversed);
        assert_eq!(
            after,
            ["sleeves-".to_owned() + &before[3][8..], before[2].clone(), before[1].clone(), "collar".into()]
        );
    }

    #[test]
    fn ids_differ_and_names_are_numbered_from_the_top() {
        let panels = [
            ("a", figures(0.1, 0.1, 0.0)),
            ("a", figures(0.1, 0.9, 0.0)),
            ("A-", figures(0.5, 0.1, 0.0)),
            ("?", figures(0.0, 0.0, 0.0)),
        ];
        let found = ids(&panels);
        let unique: std::collections::HashSet<_> = found.iter().collect();
        assert_eq!(unique.len(), 4);
        assert_eq!(found[3], "panel");
        let nameable: Vec<_> =
            panels.iter().map(|(part_name, figures)| Nameable { part_name, figures }).collect();
        let names: Vec<String> = identify(&nameable).into_iter().map(|identity| identity.name).collect();
        assert_eq!(names, ["a 2", "a 1", "A-", "?"]);
    }

    #[test]
    fn a_part_named_like_a_numbered_id_gets_its_own() {
        let place = place_digits(&figures(0.5, 0.5, 0.0));
        let evil = format!("a-{place}-2");
        let panels = [
            ("a", figures(0.5, 0.5, 0.0)),
            ("a", figures(0.5, 0.5, 1.0)),
            (evil.as_str(), figures(0.0, 0.0, 0.0)),
        ];
        let found = ids(&panels);
        assert_ne!(found[1], found[2]);
    }
}
