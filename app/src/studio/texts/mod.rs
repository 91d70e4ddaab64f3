//! The words of the window, in one place: what stands here is what a translation would replace. A pane or page has a file of its
//! own. Elsewhere are only the words that other crates bring (names of edits and shading modes: `studio-plugin`; faults: `amc-core`), and
//! those of the viewport, which is a part of its own (`viewport/texts.rs`).

pub(crate) mod activity;
pub(crate) mod colourways;
pub(crate) mod commands;
#[cfg(feature = "dialogs")]
pub(crate) mod dialogs;
pub(crate) mod export;
pub(crate) mod fabrics;
pub(crate) mod files;
pub(crate) mod history;
pub(crate) mod inspector;
pub(crate) mod look;
pub(crate) mod notes;
pub(crate) mod notices;
pub(crate) mod panels;
pub(crate) mod print;
pub(crate) mod settings;
pub(crate) mod welcome;

pub(crate) const PROGRAM: &str = "AMC Studio";
pub(crate) const UNNAMED: &str = "Unnamed project";
pub(crate) const FILE_MENU: &str = "File";
pub(crate) const EDIT_MENU: &str = "Edit";
pub(crate) const SELECT_MENU: &str = "Select";
pub(crate) const VIEW_MENU: &str = "View";
pub(crate) const WINDOW_MENU: &str = "Window";
pub(crate) const HELP_MENU: &str = "Help";
pub(crate) const SETTINGS: &str = "Settings";
pub(crate) const GUIDE: &str = "User guide";
pub(crate) const FIRST_STEPS: &str = "First steps";
pub(crate) const ABOUT: &str = "About AMC Studio";
pub(crate) const PUT_AWAY: &str = "Escape puts it away";
pub(crate) const OPENING: &str = "The garment is being opened.";
pub(crate) const NO_FABRIC: &str = "no fabric";
pub(crate) const CLOSE: &str = "Close";
pub(crate) const PALETTE_HINT: &str = "Type what you want to do";
pub(crate) const PALETTE_NOTHING: &str = "No command is called that";
pub(crate) const VIEWPORT_TITLE: &str = "View";
pub(crate) const NO_GPU: &str = "There is no graphics adapter: install a graphics driver (in software: Mesa). Your work can be edited and saved all the same.";
pub(crate) const LOADING: &str = "Opening the garment ...";
pub(crate) const DEVICE_LOST: &str =
    "The graphics device was lost, and the window opened anew on another. Your work is as it was.";
pub(crate) const DROP_HERE: &str = "Drop garments, fabrics and projects here";
pub(crate) const UNSAVED_TITLE: &str = "Save the changes?";
pub(crate) const UNSAVED_TEXT: &str = "The project has changes that are not saved.";
pub(crate) const SAVE: &str = "Save";
pub(crate) const DISCARD: &str = "Discard";
pub(crate) const STAY: &str = "Go on working";
pub(crate) const UNDO: &str = "Undo";
pub(crate) const REDO: &str = "Redo";
pub(crate) const RECOVER_TITLE: &str = "Unsaved work was found";
pub(crate) const RECOVER_TEXT: &str = "The studio was not closed properly. This was not saved:";
pub(crate) const RECOVER: &str = "Take it back";
pub(crate) const MISSING_TITLE: &str = "Some files are not there";
pub(crate) const MISSING_TEXT: &str =
    "They were moved, renamed or deleted. What is missing is left out of the view and kept in the project.";
pub(crate) const FIND: &str = "Find ...";
pub(crate) const WITHOUT: &str = "Go on without them";
pub(crate) const PATH: &str = "Path";
pub(crate) const OPEN_TITLE: &str = "Open a file";
pub(crate) const OPEN_TEXT: &str =
    "A project (.amcproj), a garment (.glb, .gltf, .obj) or a fabric (.amc.ktx2):";
pub(crate) const OPEN: &str = "Open";
pub(crate) const SAVE_TITLE: &str = "Save the project";
pub(crate) const SAVE_TEXT: &str = "As:";
pub(crate) const REPLACE: &str = "Replace";
pub(crate) const FIND_TITLE: &str = "Where is the file?";
pub(crate) const USE: &str = "Use";
pub(crate) const CANCEL: &str = "Cancel";
pub(crate) const ABOUT_TEXT: &str = "A studio for Anisotropic MatCap: the look of real cloth under one light, in a small table. The method is by \
     D. Magri, P. Cignoni and M. Tarini (2016). The program is under MIT or Apache-2.0, at your choice.";
pub(crate) const LICENCES: &str = "Made with the work of others, under these licences";
