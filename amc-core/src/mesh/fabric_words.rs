//! Whether a part takes a fabric, judged by its names.

/// Last words of names of parts that take no fabric.
///
/// English compounds end in what the thing is: "shirt buttons" are buttons, a "body suit" is a suit.
const NO_FABRIC: [&str; 36] = [
    "avatar",
    "body",
    "boot",
    "boots",
    "buckle",
    "buckles",
    "button",
    "buttons",
    "eye",
    "eyebrow",
    "eyebrows",
    "eyelash",
    "eyelashes",
    "eyes",
    "face",
    "hair",
    "hand",
    "hands",
    "head",
    "heel",
    "heels",
    "mannequin",
    "nails",
    "rivet",
    "rivets",
    "shoe",
    "shoes",
    "skin",
    "sole",
    "soles",
    "teeth",
    "tongue",
    "zip",
    "zipper",
    "zippers",
    "zips",
];

/// Words at the end of a name that say nothing about what the part is.
const FILLERS: [&str; 14] = [
    "l", "r", "left", "right", "mesh", "mat", "material", "geo", "geometry", "shape", "obj", "object", "low",
    "high",
];

/// Whether a part of this name is no cloth: its last telling word is one of a short list (body, skin, hair, eyes,
/// shoes, buttons, zippers and the like).
pub(super) fn names_no_fabric(name: &str) -> bool {
    let words = words(name);
    let last = words.iter().rev().find(|word| !FILLERS.contains(&word.as_str()));
    last.is_some_and(|word| NO_FABRIC.contains(&word.as_str()))
}

/// The words of a name in lower case: parted by anything but letters, and at capitals (`ShirtButtons`).
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut after_lower_case = false;
    for letter in name.chars().take(super::NAME_LIMIT) {
        let starts_word = letter.is_uppercase() && after_lower_case;
        if (starts_word || !letter.is_alphabetic()) && words.last().is_some_and(|word| !word.is_empty()) {
            words.push(String::new());
        }
        if letter.is_alphabetic()
            && let Some(word) = words.last_mut()
        {
            word.extend(letter.to_lowercase());
        }
        after_lower_case = letter.is_lowercase();
    }
    words.retain(|word| !word.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_telling_word_decides() {
        for no_fabric in
            ["Body", "ShirtButtons", "button_12", "eye.L", "male body mesh", "SKIN", "Hair-Mat.001"]
        {
            assert!(names_no_fabric(no_fabric), "{no_fabric}");
        }
        for fabric in
            ["", "BodySuit", "bodysuit", "button shirt", "sleeve_left", "skin-tight top", "Material.001"]
        {
            assert!(!names_no_fabric(fabric), "{fabric}");
        }
    }
}
