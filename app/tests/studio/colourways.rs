//! Colourways, as a designer uses them: made, worn, compared, kept; strokes and angles are the same in all.

use amc_studio::studio::Studio;
use eframe::egui::{Key, Modifiers, vec2};
use studio_plugin::document::Project;

use super::directions::{command, drag, piece, strokes};
use super::journeys::stripes;
use super::*;

/// Clicks on what is called something that begins like this.
fn click_first(harness: &mut Harness<'_, App>, begin: &str) {
    harness.get_by(|node| node.label().is_some_and(|label| label.starts_with(begin))).click();
    settle(harness);
}

fn project<'a>(harness: &'a Harness<'_, App>) -> &'a Project {
    harness.state().document().project()
}

/// The name of what the back wears, and whether it is printed.
fn worn(harness: &Harness<'_, App>) -> (String, bool) {
    let project = project(harness);
    let fabric = project.look("back").fabric.and_then(|id| project.fabric(id));
    (fabric.map(|fabric| fabric.name.clone()).unwrap_or_default(), project.print("back").is_some())
}

fn names(harness: &Harness<'_, App>) -> Vec<String> {
    project(harness).colourways.labels().map(|label| label.name.clone()).collect()
}

/// Types a name into the field that has the focus, in place of what is in it.
fn name(harness: &mut Harness<'_, App>, name: &str, end: Key) {
    settle(harness);
    harness.get_by_label("Name of the colourway").type_text(name);
    settle(harness);
    press(harness, Modifiers::NONE, end);
}

#[test]
fn colourways_are_made_switched_and_compared_and_lose_no_stroke_and_no_angle() {
    let folder = tempfile::tempdir().unwrap();
    let (file, print) = (folder.path().join("two.amcproj"), folder.path().join("stripes.png"));
    stripes(&print);
    let mut harness = window(Studio::new(), folder.path());
    let beginning = project(&harness).clone();
    select(&mut harness, "back");
    press(&mut harness, Modifiers::NONE, Key::CloseBracket);
    show_tab(&mut harness, "Flat pattern");
    press(&mut harness, Modifiers::NONE, Key::B);
    let middle = piece(&harness, "back").center();
    drag(&mut harness, middle + vec2(-25.0, 10.0), middle + vec2(30.0, -5.0));
    press(&mut harness, Modifiers::NONE, Key::B);
    let shaped = (strokes(&harness, "back"), degrees(&harness, "back"));
    assert_eq!((shaped.0.len(), shaped.1.is_some()), (1, true));

    // A second one: in another cloth, with a print on the back.
    show_tab(&mut harness, "Colourways");
    click(&mut harness, "New colourway");
    name(&mut harness, "Winter", Key::Enter);
    assert_eq!(names(&harness), ["Colourway 1", "Winter"]);
    harness.state_mut().open(&print);
    settle(&mut harness);
    press(&mut harness, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::A);
    show_tab(&mut harness, "Fabrics");
    click_first(&mut harness, "Changeant");
    assert_eq!(worn(&harness), ("Changeant".to_owned(), true));
    let winter = picture_of_the_garment(&mut harness);

    // One click.
    show_tab(&mut harness, "Colourways");
    click_first(&mut harness, "Colourway 1: Satin");
    assert_eq!(harness.state().document().undo_name(), Some("Wear 'Colourway 1'"));
    assert_eq!(worn(&harness), ("Satin".to_owned(), false));
    assert_eq!((strokes(&harness, "back"), degrees(&harness, "back")), shaped);
    let first = picture_of_the_garment(&mut harness);
    assert!(first != winter, "another cloth");

    // Side by side, and the other way round.
    click(&mut harness, "Compare with Winter");
    let compared = picture_of_the_garment(&mut harness);
    assert!(halves(&first).0 == halves(&compared).0, "left it is as it was");
    assert!(halves(&winter).1 == halves(&compared).1, "right it is what it would be, with its print");
    command(&mut harness, "Next colourway");
    assert_eq!(worn(&harness), ("Changeant".to_owned(), true));
    assert_eq!((strokes(&harness, "back"), degrees(&harness, "back")), shaped);
    let exchanged = picture_of_the_garment(&mut harness);
    assert!(halves(&winter).0 == halves(&exchanged).0 && halves(&first).1 == halves(&exchanged).1);
    click(&mut harness, "Compare with Colourway 1");
    assert!(picture_of_the_garment(&mut harness) == winter);

    // Saved and opened, undone to the beginning and done again.
    harness.state_mut().save_to(&file);
    settle(&mut harness);
    let kept = project(&harness).clone();
    while harness.state().document().undo_name().is_some() {
        press(&mut harness, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(
        (&project(&harness).panels, &project(&harness).colourways),
        (&beginning.panels, &beginning.colourways)
    );
    while harness.state().document().redo_name().is_some() {
        press(&mut harness, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    }
    assert_eq!(*project(&harness), kept);
    drop(harness);
    let again = window(Studio::new().open([file]), folder.path());
    let mut opened = project(&again).clone();
    // Files come with what they hold.
    opened.assets_mut().zip(kept.assets()).for_each(|(asset, saved)| *asset = saved.clone());
    assert_eq!(opened, kept);
    assert_eq!(worn(&again), ("Changeant".to_owned(), true));
}

#[test]
fn colourways_are_renamed_moved_and_removed() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(Studio::new(), folder.path());
    show_tab(&mut harness, "Colourways");
    click(&mut harness, "Remove");
    assert_eq!(harness.state().document().steps().count(), 0, "the only one stays");
    click(&mut harness, "Rename");
    name(&mut harness, "Summer", Key::Enter);
    assert_eq!(harness.state().document().undo_name(), Some("Rename 'Colourway 1' to 'Summer'"));
    click(&mut harness, "Rename");
    name(&mut harness, "Autumn", Key::Escape);
    assert_eq!(names(&harness), ["Summer"]);
    // A name that is taken is refused, and said.
    click(&mut harness, "New colourway");
    name(&mut harness, "Summer", Key::Enter);
    assert_eq!(names(&harness), ["Summer", "Colourway 2"]);
    assert!(reads(&harness, &["called 'Summer'"]));
    command(&mut harness, "Move the colourway up");
    assert_eq!(names(&harness), ["Colourway 2", "Summer"]);
    command(&mut harness, "Previous colourway");
    assert_eq!(project(&harness).colourways.worn().name, "Summer");
    click(&mut harness, "Remove");
    assert_eq!(names(&harness), ["Colourway 2"]);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(project(&harness).colourways.worn().name, "Summer");
}

/// What is to be seen of the garment: rows of pixels.
fn picture_of_the_garment(harness: &mut Harness<'_, App>) -> Vec<Vec<[u8; 4]>> {
    harness.remove_cursor();
    settle(harness);
    let place = harness.get_by_label("Garment").rect();
    let picture = harness.render().unwrap();
    let scale = picture.width() as f32 / harness.ctx.content_rect().width();
    // Clear of the frame and of what is written in the corners.
    let within = place.shrink2(vec2(0.1 * place.width(), 0.2 * place.height())) * scale;
    let row = |y| (within.left() as u32..within.right() as u32).map(|x| picture.get_pixel(x, y).0).collect();
    (within.top() as u32..within.bottom() as u32).map(row).collect()
}

/// Rows of pixels.
type Rows<'a> = Vec<&'a [[u8; 4]]>;

/// Left and right of the divider, and clear of it.
fn halves(picture: &[Vec<[u8; 4]>]) -> (Rows<'_>, Rows<'_>) {
    let middle = picture[0].len() / 2;
    let left = picture.iter().map(|row| &row[..middle - 8]).collect();
    (left, picture.iter().map(|row| &row[middle + 8..]).collect())
}
