//! What each edit does, what it is called, and what is refused.

use std::f32::consts::{FRAC_PI_2, PI};
use std::path::PathBuf;

use amc_core::direction::{Field, Source};
use glam::Vec3;

use super::super::{Asset, Document, Edit, FabricId, PanelLook, Project};
use super::{at, fabric, panels, turn};

fn document() -> Document {
    let mut document = Document::new(Project::default());
    document.submit(Edit::AddFabric(fabric(1, "twill")), None).unwrap();
    document
}

#[test]
fn a_panel_nobody_touched_wears_the_first_fabric_along_its_grain() {
    let expected = PanelLook { fabric: Some(FabricId::new(0)), direction: None, visible: true };
    assert_eq!(document().project().look("front"), expected);
}

#[test]
fn buttons_are_grey_until_a_fabric_is_chosen_for_them() {
    let mesh = amc_core::shape::mesh("sheet").unwrap();
    let mut button = amc_core::mesh::Garment::new(mesh).unwrap().panels.remove(0);
    button.takes_fabric = false;
    let mut document = document();
    document.submit(Edit::SetVisible { panels: vec![button.id.clone()], visible: false }, None).unwrap();
    let look = document.project().look_of(&button);
    assert_eq!((look.fabric, look.visible), (None, false));
    let fabric = Some(FabricId::new(0));
    document.submit(Edit::SetFabric { panels: vec![button.id.clone()], fabric }, None).unwrap();
    assert_eq!(document.project().look_of(&button).fabric, fabric);
}

#[test]
fn a_removed_fabric_gives_way_to_the_default() {
    let mut document = document();
    for (panel, fabric) in [("front", Some(FabricId::new(1))), ("back", None)] {
        document.submit(Edit::SetFabric { panels: panels(&[panel]), fabric }, None).unwrap();
    }
    document.submit(Edit::RemoveFabric(FabricId::new(1)), None).unwrap();
    assert_eq!(document.project().look("front").fabric, Some(FabricId::new(0)));
    assert_eq!(document.project().look("back").fabric, None, "grey was chosen");
    document.submit(Edit::RemoveFabric(FabricId::new(0)), None).unwrap();
    assert_eq!(document.project().look("front").fabric, None, "there is no fabric left");
    document.go_to(0);
    assert_eq!(document.project(), &Project::default());
}

#[test]
fn turns_stay_within_half_a_turn() {
    let mut document = document();
    document.submit(turn("front", 3.0, 1.0), None).unwrap();
    let angle = document.project().look("front").direction.unwrap().angle;
    assert!((angle - (4.0 - 2.0 * PI)).abs() < 1e-5, "{angle}");
}

#[test]
fn edits_are_called_what_they_do() {
    let named = |edit: Edit| edit.name(document().project());
    let fabric_edit = |fabric| Edit::SetFabric { panels: panels(&["a"]), fabric };
    assert_eq!(named(fabric_edit(Some(FabricId::new(1)))), "Put twill on 1 panel");
    assert_eq!(named(fabric_edit(None)), "Take the fabric off 1 panel");
    assert_eq!(named(turn("a", 0.3, FRAC_PI_2)), "Swap warp and weft of 1 panel");
    assert_eq!(named(turn("a", 0.3, -FRAC_PI_2)), "Swap warp and weft of 1 panel");
    assert_eq!(named(turn("a", 0.0, 0.2)), "Turn 1 panel by 11.5°");
    assert_eq!(named(Edit::RemoveFabric(FabricId::new(0))), "Remove Satin");
    assert_eq!(named(Edit::SetGarment(Asset::file("/clothes/coat.v2.glb"))), "Change the garment to coat");
    let hidden = Edit::SetVisible { panels: panels(&["a", "b", "c"]), visible: false };
    assert_eq!(named(hidden), "Hide 3 panels");
    let directed = Edit::SetDirection { panels: panels(&["a", "b"]), direction: Some(at(PI / 4.0)) };
    assert_eq!(named(directed), "Set the direction of 2 panels to 45°");
}

#[test]
fn a_relocated_file_is_replaced_wherever_it_is_used() {
    let mut document = document();
    let lost = FabricInUseAt { number: 2, path: "/lost/silk.amc.ktx2" }.add(&mut document);
    let again = FabricInUseAt { number: 3, path: "/lost/silk.amc.ktx2" }.add(&mut document);
    let new = Asset::File { path: "/found/silk.amc.ktx2".into(), content: Some("0".repeat(32)) };
    document
        .submit(Edit::Relocate { old: PathBuf::from("/lost/silk.amc.ktx2"), new: new.clone() }, None)
        .unwrap();
    for id in [lost, again] {
        assert_eq!(document.project().fabric(id).unwrap().asset, new);
    }
}

struct FabricInUseAt {
    number: u32,
    path: &'static str,
}

impl FabricInUseAt {
    fn add(self, document: &mut Document) -> FabricId {
        let mut fabric = fabric(self.number, "silk");
        fabric.asset = Asset::file(self.path);
        document.submit(Edit::AddFabric(fabric), None).unwrap();
        FabricId::new(self.number)
    }
}

#[test]
fn what_would_break_a_project_is_refused_and_changes_nothing() {
    let endless = amc_core::direction::Direction {
        source: Source::Field(Field::Radial { origin: Vec3::new(0.0, f32::INFINITY, 0.0) }),
        angle: 0.0,
    };
    let unnamed = super::FabricInUse { name: " ".to_owned(), ..fabric(7, "silk") };
    let no_fabric = super::FabricInUse { asset: Asset::named("garment:shirt"), ..fabric(7, "silk") };
    let keyed = Asset::File { path: "a.glb".into(), content: Some("no key".to_owned()) };
    let refused = [
        (Edit::AddFabric(fabric(1, "silk")), "the id 1"),
        (Edit::AddFabric(unnamed), "name is empty"),
        (Edit::AddFabric(no_fabric), "no bundled fabric"),
        (Edit::SetGarment(Asset::named("fabric:satin")), "no bundled garment"),
        (Edit::SetGarment(Asset::file("")), "no name"),
        (Edit::SetGarment(keyed), "content key"),
        (Edit::RemoveFabric(FabricId::new(9)), "no fabric 9"),
        (Edit::SetFabric { panels: panels(&["a"]), fabric: Some(FabricId::new(9)) }, "fabric 9"),
        (Edit::SetVisible { panels: panels(&[""]), visible: false }, "id is empty"),
        (turn("a", 0.0, f32::NAN), "not a finite number"),
        (Edit::SetDirection { panels: panels(&["a"]), direction: Some(endless) }, "not a finite number"),
        (Edit::SetNotes("n".repeat(Project::LONGEST_NOTES + 1)), "notes are longer"),
        (Edit::RenamePanel { panel: "a".into(), name: Some(" ".into()) }, "name is empty"),
        (Edit::GroupPanels { panels: panels(&["a"]), group: Some(String::new()) }, "name is empty"),
        (Edit::MergePanels { panels: panels(&["a"]), comb: None }, "two panels or more"),
        (
            Edit::SplitPanel { panel: "a".into(), line: [glam::Vec2::X; 2], into: ["b".into(), "c".into()] },
            "no length",
        ),
        (Edit::Relocate { old: "/not/used".into(), new: Asset::file("/b") }, "does not use"),
    ];
    let mut document = document();
    let before = (document.snapshot().project, document.revision(), document.position());
    for (edit, reason) in refused {
        let said = document.submit(edit.clone(), None).unwrap_err().to_string();
        assert!(said.contains(reason), "{edit:?}: {said}");
        assert_eq!((document.snapshot().project, document.revision(), document.position()), before);
    }
}

#[test]
fn a_panel_is_in_one_group_and_an_empty_group_is_none() {
    let mut document = document();
    let group = |names: &[&str], group: Option<&str>| Edit::GroupPanels {
        panels: panels(names),
        group: group.map(str::to_owned),
    };
    document.submit(group(&["front", "back"], Some("body")), None).unwrap();
    document.submit(group(&["back", "cuff"], Some("rest")), None).unwrap();
    let project = document.project();
    assert_eq!(
        ["front", "back", "cuff"].map(|id| project.group_of(id)),
        [Some("body"), Some("rest"), Some("rest")]
    );
    document.submit(group(&["front"], None), None).unwrap();
    assert_eq!(document.project().groups.keys().collect::<Vec<_>>(), ["rest"]);
    assert_eq!(document.undo().unwrap(), "Ungroup 1 panel");
    assert_eq!(document.undo().unwrap(), "Group 2 panels as rest");
}

#[test]
fn halves_take_over_all_that_was_chosen_for_the_whole() {
    let mut document = document();
    let fabric = Some(FabricId::new(1));
    document.submit(Edit::SetFabric { panels: panels(&["front"]), fabric }, None).unwrap();
    document.submit(turn("front", 0.5, 0.25), None).unwrap();
    document.submit(Edit::RenamePanel { panel: "front".into(), name: Some("Vorn".into()) }, None).unwrap();
    let grouped = Edit::GroupPanels { panels: panels(&["front"]), group: Some("body".into()) };
    document.submit(grouped, None).unwrap();
    let line = [glam::Vec2::ZERO, glam::Vec2::Y];
    let into = ["front-1".to_owned(), "front-2".to_owned()];
    document.submit(Edit::SplitPanel { panel: "front".into(), line, into }, None).unwrap();
    let project = document.project();
    for (half, name) in [("front-1", "Vorn 1"), ("front-2", "Vorn 2")] {
        assert_eq!(project.look(half), project.look("front"));
        assert_eq!((project.group_of(half), &*project.arrangement.names[half]), (Some("body"), name));
    }
    document.submit(Edit::MergePanels { panels: panels(&["front-2", "front-1"]), comb: None }, None).unwrap();
    assert_eq!(document.project().arrangement.changes.len(), 2);
    assert_eq!(document.undo().unwrap(), "Merge 2 panels");
    assert_eq!(document.undo().unwrap(), "Split a panel");
    assert!(
        document.project().arrangement.changes.is_empty()
            && !document.project().panels.contains_key("front-1")
    );
}

#[test]
fn a_free_id_is_free_even_where_the_largest_number_is_taken() {
    let mut project = Project::default();
    project.fabrics.push(fabric(u32::MAX, "silk"));
    assert_eq!(project.free_fabric_id(), FabricId::new(1));
    project.fabrics.pop();
    assert_eq!(project.free_fabric_id(), FabricId::new(1));
    project.fabrics.clear();
    assert_eq!(project.free_fabric_id(), FabricId::new(0));
}
