//! The words of the window that do not belong to one pane or command alone.

pub(super) const PROGRAM: &str = "AMC Studio";
pub(super) const UNNAMED: &str = "Unnamed project";
pub(super) const FILE_MENU: &str = "File";
pub(super) const EDIT_MENU: &str = "Edit";
pub(super) const SELECT_MENU: &str = "Select";
pub(super) const VIEW_MENU: &str = "View";
pub(super) const WINDOW_MENU: &str = "Window";
pub(super) const HELP_MENU: &str = "Help";
pub(super) const SETTINGS: &str = "Settings";
pub(super) const GUIDE: &str = "User guide";
pub(super) const FIRST_STEPS: &str = "First steps";
pub(super) const ABOUT: &str = "About AMC Studio";
pub(super) const PUT_AWAY: &str = "Escape puts it away";
pub(super) const CLOSE: &str = "Close";
pub(super) const PALETTE_HINT: &str = "Type what you want to do";
pub(super) const PALETTE_NOTHING: &str = "No command is called that";
pub(super) const VIEWPORT_TITLE: &str = "View";
pub(super) const NO_GPU: &str = "There is no graphics adapter: install a graphics driver (in software: Mesa). Your work can be edited and saved all the same.";
pub(super) const LOADING: &str = "Opening the garment ...";
pub(super) const DEVICE_LOST: &str =
    "The graphics device was lost, and the window opened anew on another. Your work is as it was.";
pub(super) const DROP_HERE: &str = "Drop garments, fabrics and projects here";
pub(super) const UNSAVED_TITLE: &str = "Save the changes?";
pub(super) const UNSAVED_TEXT: &str = "The project has changes that are not saved.";
pub(super) const SAVE: &str = "Save";
pub(super) const DISCARD: &str = "Discard";
pub(super) const STAY: &str = "Go on working";
pub(super) const UNDO: &str = "Undo";
pub(super) const REDO: &str = "Redo";
pub(super) const RECOVER_TITLE: &str = "Unsaved work was found";
pub(super) const RECOVER_TEXT: &str = "The studio was not closed properly. This was not saved:";
pub(super) const RECOVER: &str = "Take it back";
pub(super) const MISSING_TITLE: &str = "Some files are not there";
pub(super) const MISSING_TEXT: &str =
    "They were moved, renamed or deleted. What is missing is left out of the view and kept in the project.";
pub(super) const FIND: &str = "Find ...";
pub(super) const WITHOUT: &str = "Go on without them";
pub(super) const PATH: &str = "Path";
pub(super) const OPEN_TITLE: &str = "Open a file";
pub(super) const OPEN_TEXT: &str =
    "A project (.amcproj), a garment (.glb, .gltf, .obj) or a fabric (.amc.ktx2):";
pub(super) const OPEN: &str = "Open";
pub(super) const SAVE_TITLE: &str = "Save the project";
pub(super) const SAVE_TEXT: &str = "As:";
pub(super) const REPLACE: &str = "Replace";
pub(super) const FIND_TITLE: &str = "Where is the file?";
pub(super) const USE: &str = "Use";
pub(super) const CANCEL: &str = "Cancel";
pub(super) const ABOUT_TEXT: &str = "A studio for Anisotropic MatCap: the look of real cloth under one light, in a small table. The method is by \
     D. Magri, P. Cignoni and M. Tarini (2016). The program is under MIT or Apache-2.0, at your choice.";
pub(super) const LICENCES: &str = "Made with the work of others, under these licences";
