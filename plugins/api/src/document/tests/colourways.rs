//! Colourways: what changes with them, and what does not.

use std::path::PathBuf;
use std::sync::Arc;

use amc_core::direction::comb::Comb;
use amc_core::render::Laying;

use super::super::{
    Asset, Colourway, ColourwayId, ColourwayLabel, Colourways, Document, Edit, FabricId, PanelPrint, Project,
};
use super::{at, fabric, panels};

fn label(number: u32, name: &str) -> ColourwayLabel {
    ColourwayLabel { id: ColourwayId::new(number), name: name.to_owned() }
}

fn printed(file: &str) -> PanelPrint {
    PanelPrint { picture: Asset::file(file), laying: Laying { width: 0.2, ..Laying::default() } }
}

fn put(document: &mut Document, number: u32) {
    let fabric = Some(FabricId::new(number));
    document.submit(Edit::SetFabric { panels: panels(&["front"]), fabric }, None).unwrap();
}

/// 'Summer' in satin, 'Winter' in twill with a print; a hidden panel, an angle and a comb.
fn two() -> Document {
    let mut document = Document::new(Project::default());
    let mut submit = |edit| document.submit(edit, None).unwrap();
    submit(Edit::AddFabric(fabric(1, "twill")));
    submit(Edit::SetDirection { panels: panels(&["front"]), direction: Some(at(1.0)) });
    let comb = Some(Arc::new(Comb::default()));
    submit(Edit::SetComb { panel: "front".to_owned(), comb, what: "Comb".to_owned() });
    submit(Edit::SetVisible { panels: panels(&["back"]), visible: false });
    submit(Edit::RenameColourway(label(0, "Summer")));
    submit(Edit::AddColourway(label(1, "Winter")));
    let print = Some(printed("snow.png"));
    submit(Edit::SetPrint { panels: panels(&["collar"]), print });
    put(&mut document, 1);
    document
}

#[test]
fn a_change_of_colourway_changes_fabrics_and_prints_and_nothing_else() {
    let mut document = two();
    let winter = document.project().clone();
    document.submit(Edit::WearColourway(ColourwayId::new(0)), None).unwrap();
    assert_eq!(document.undo_name(), Some("Wear 'Summer'"));
    let summer = document.project();
    assert_eq!(
        (winter.look("front").fabric, summer.look("front").fabric.map(FabricId::number)),
        (Some(FabricId::new(1)), Some(0))
    );
    assert_eq!((summer.print("collar"), winter.print("collar").is_some()), (None, true));
    assert_eq!(summer.look("front").direction, winter.look("front").direction);
    assert!(Arc::ptr_eq(summer.comb("front").unwrap(), winter.comb("front").unwrap()));
    assert!(!summer.look("back").visible);
    assert!(!summer.panels.contains_key("collar"), "all as by default");
    // Both can be looked at, whichever is worn.
    for project in [summer, &winter] {
        assert_eq!(project.print_in(ColourwayId::new(1), "collar"), winter.print("collar"));
        assert_eq!(project.print_in(ColourwayId::new(0), "collar"), None);
    }
    // What is done to the garment meanwhile is there in all of them.
    document
        .submit(Edit::SetDirection { panels: panels(&["collar"]), direction: Some(at(0.5)) }, None)
        .unwrap();
    document.submit(Edit::WearColourway(ColourwayId::new(1)), None).unwrap();
    let again = document.project();
    assert_eq!(again.look("collar").direction, Some(at(0.5)));
    assert_eq!(again.print("collar"), winter.print("collar"));
    document.undo();
    document.undo();
    document.undo();
    assert_eq!(*document.project(), winter);
}

#[test]
fn looks_of_panels_that_take_no_fabric_stay_grey_in_every_colourway() {
    let mesh = amc_core::shape::mesh("sheet").unwrap();
    let mut panel = amc_core::mesh::Garment::new(mesh).unwrap().panels.remove(0);
    let mut document = two();
    document.submit(Edit::WearColourway(ColourwayId::new(0)), None).unwrap();
    let [worn, kept] = [0, 1].map(ColourwayId::new);
    let fabric = |panel: &_, colourway| document.project().look_in(colourway, panel).fabric;
    assert_eq!([worn, kept].map(|id| fabric(&panel, id)), [Some(FabricId::new(0)); 2]);
    panel.takes_fabric = false;
    assert_eq!([worn, kept].map(|id| fabric(&panel, id)), [None; 2]);
    panel.id = "front".to_owned();
    assert_eq!([worn, kept].map(|id| fabric(&panel, id)), [None, Some(FabricId::new(1))]);
}

#[test]
fn a_removed_fabric_is_taken_off_in_all_and_files_are_located_in_all() {
    let mut document = two();
    document.submit(Edit::WearColourway(ColourwayId::new(0)), None).unwrap();
    let new = Asset::file("/found/snow.png");
    document.submit(Edit::Relocate { old: PathBuf::from("snow.png"), new: new.clone() }, None).unwrap();
    document.submit(Edit::RemoveFabric(FabricId::new(1)), None).unwrap();
    document.submit(Edit::WearColourway(ColourwayId::new(1)), None).unwrap();
    let project = document.project();
    assert_eq!(project.look("front").fabric, Some(FabricId::new(0)), "the default");
    assert_eq!(project.print("collar").unwrap().picture, new);
    assert!(project.assets().any(|asset| *asset == new));
}

#[test]
fn the_next_one_is_worn_in_place_of_one_that_is_removed() {
    let mut document = two();
    let worn = |document: &Document| document.project().colourways.worn().name.clone();
    document.submit(Edit::AddColourway(label(5, "Spring")), None).unwrap();
    document.submit(Edit::WearColourway(ColourwayId::new(1)), None).unwrap();
    document.submit(Edit::RemoveColourway(ColourwayId::new(1)), None).unwrap();
    assert_eq!((worn(&document).as_str(), document.undo_name()), ("Spring", Some("Remove 'Winter'")));
    document.submit(Edit::RemoveColourway(ColourwayId::new(5)), None).unwrap();
    assert_eq!(worn(&document), "Summer");
    let said = document.submit(Edit::RemoveColourway(ColourwayId::new(0)), None).unwrap_err().to_string();
    assert!(said.contains("only colourway"), "{said}");
}

#[test]
fn they_follow_each_other_in_their_order_and_round() {
    let mut document = two();
    document.submit(Edit::AddColourway(label(9, "Spring")), None).unwrap();
    document.submit(Edit::MoveColourway { colourway: ColourwayId::new(9), place: 0 }, None).unwrap();
    let colourways = &document.project().colourways;
    let names: Vec<_> = colourways.labels().map(|label| label.name.as_str()).collect();
    assert_eq!(names, ["Spring", "Summer", "Winter"]);
    assert_eq!(
        (colourways.place(), &*colourways.next().name, &*colourways.previous().name),
        (0, "Summer", "Winter")
    );
    let alone = Colourways::default();
    assert_eq!((alone.next(), alone.previous(), alone.count()), (alone.worn(), alone.worn(), 1));
}

#[test]
fn what_would_make_two_of_one_name_or_id_is_refused() {
    let mut document = two();
    let before = document.snapshot().project;
    let long = "n".repeat(Project::LONGEST_NAME + 1);
    for (edit, reason) in [
        (Edit::AddColourway(label(1, "Autumn")), "the id 1"),
        (Edit::AddColourway(label(2, "Winter")), "called 'Winter'"),
        (Edit::RenameColourway(label(0, "Winter")), "called 'Winter'"),
        (Edit::RenameColourway(label(0, " ")), "name is empty"),
        (Edit::RenameColourway(label(0, &long)), "longer than"),
        (Edit::RenameColourway(label(8, "Autumn")), "no colourway 8"),
        (Edit::WearColourway(ColourwayId::new(8)), "no colourway 8"),
        (Edit::RemoveColourway(ColourwayId::new(8)), "no colourway 8"),
    ] {
        let said = document.submit(edit, None).unwrap_err().to_string();
        assert!(said.contains(reason), "{said}");
        assert_eq!(document.snapshot().project, before);
    }
    let mut free = document.project().colourways.free_label();
    assert_eq!((free.id.number(), free.name.as_str()), (2, "Colourway 3"));
    free.id = ColourwayId::new(u32::MAX);
    document.submit(Edit::AddColourway(free), None).unwrap();
    let free = document.project().colourways.free_label();
    assert_eq!((free.id.number(), free.name.as_str()), (2, "Colourway 4"));
}

#[test]
fn there_are_limits() {
    let mut document = Document::new(Project::default());
    for _ in 1..Colourways::MOST {
        let label = document.project().colourways.free_label();
        document.submit(Edit::AddColourway(label), None).unwrap();
    }
    let label = document.project().colourways.free_label();
    let said = document.submit(Edit::AddColourway(label), None).unwrap_err().to_string();
    assert!(said.contains("256 colourways"), "{said}");
}

#[test]
fn the_place_of_the_worn_one_is_empty() {
    let empty = |number, name| Colourway { label: label(number, name), panels: Default::default() };
    let wears = {
        let mut colourway = empty(1, "B");
        colourway.panels.insert("front".to_owned(), Default::default());
        colourway
    };
    let list = || vec![empty(0, "A"), wears.clone()];
    let worn = |list, id: Option<u32>| Colourways::new(list, id.map(ColourwayId::new));
    assert_eq!(worn(list(), None).unwrap().worn().name, "A");
    assert!(worn(list(), Some(1)).unwrap_err().to_string().contains("'B' is worn"));
    assert!(worn(list(), Some(2)).unwrap_err().to_string().contains("no colourway 2"));
    assert_eq!(worn(Vec::new(), None).unwrap(), Colourways::default());
}
