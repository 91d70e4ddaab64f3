//! The pane of fabrics.

pub(crate) const NAME: &str = "Fabrics";
pub(crate) const BUNDLED: &str = "With the program";

/// What a click does, with so many panels selected.
pub(crate) fn hint(selected: usize) -> String {
    let whom = match selected {
        0 => "all panels".to_owned(),
        1 => "the selected panel".to_owned(),
        count => format!("{count} selected panels"),
    };
    format!("A click puts a fabric on {whom}. Drop AMC files here to add them.")
}

/// A table's size and its symmetry.
pub(crate) fn detail(side: u32, slices: u32, order: u32) -> String {
    format!("{side} x {side} x {slices}, R = {order}")
}
