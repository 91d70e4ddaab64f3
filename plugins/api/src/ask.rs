//! Questions to the person.

/// Files of one kind, by the ends of their names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FileKind {
    /// What they are: "Pictures".
    pub name: &'static str,
    /// Ends of their names, without a dot, in lower case. A file that is given none of them gets the first.
    pub suffixes: &'static [&'static str],
}

/// Where something is to be saved, or which file is to be taken in: asked by [`crate::Context::ask_where`] or
/// [`crate::Context::ask_which`], answered to [`crate::Plugin::chosen`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ask {
    /// By which the plugin knows the answer.
    pub id: &'static str,
    /// Of the dialog: "Save the picture".
    pub title: String,
    /// The file's name that is suggested; empty where a file is to be taken in.
    pub name: String,
    /// What it can be; not empty.
    pub kinds: &'static [FileKind],
}
