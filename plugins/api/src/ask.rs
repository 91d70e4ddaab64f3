//! Questions to the person.

/// Files of one kind, by the ends of their names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FileKind {
    /// What they are: "Pictures".
    pub name: &'static str,
    /// Ends of their names, without a dot, in lower case. A file that is given none of them gets the first.
    pub suffixes: &'static [&'static str],
}

/// Where something is to be saved: asked by [`crate::Context::ask_where`], answered to [`crate::Plugin::chosen`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ask {
    /// By which the plugin knows the answer.
    pub id: &'static str,
    /// Of the dialog: "Save the picture".
    pub title: String,
    /// The file's name that is suggested.
    pub name: String,
    /// What it can be saved as; not empty.
    pub kinds: &'static [FileKind],
}
