//! Pictures drawn in parts against the same drawn at once; sheets and turns against single pictures.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use amc_core::image::compare::Difference;
use amc_core::image::stream::Timing;
use amc_core::image::{Picture, decode};
use amc_core::mesh::Garment;
use amc_core::render::gpu::{Backend, Gpu, render_picture};
use amc_core::render::{Bounds, Cloth, Drawing, Mode, Shading, cpu};
use amc_core::{ErrorKind, Progress, shape};
use glam::{Vec2, Vec3};
use studio_plugin::document::{Angles, Lens, NamedView, ViewSettings};

use super::*;

/// A torus without a fabric, whose tangents are all along x.
fn drawing() -> Drawing {
    let garment = Garment::new(shape::mesh("torus").unwrap()).unwrap();
    let along = vec![Vec3::X; garment.positions.len()];
    let occlusion: Vec<Vec2> =
        garment.positions.iter().map(|p| Vec2::splat(0.75 + 0.25 * p.x.sin())).collect();
    Drawing::new(&garment, along, Some(&occlusion), Vec::new(), |_| Cloth::Plain).unwrap()
}

fn stand(lens: Lens) -> Stand {
    let positions: Vec<Vec3> = drawing().vertices.iter().map(|vertex| vertex.position).collect();
    let mut settings = ViewSettings::default();
    settings.lens = lens;
    settings.set_angles(Angles { yaw: 20.0, pitch: 50.0, roll: 5.0 });
    settings.pan = Vec2::new(0.2, -0.1);
    settings.zoom = 1.3;
    Stand::Settings { settings: Box::new(settings), bounds: Bounds::of(&positions).unwrap() }
}

fn painter(device: &Device) -> Painter {
    Painter::new(device.clone(), drawing(), &BTreeSet::new()).unwrap()
}

fn order(kind: Kind, size: [u32; 2], file: &Path) -> Order {
    Order {
        kind,
        stand: stand(Lens::Perspective { focal_length_mm: 50.0 }),
        size: Size { width: size[0], height: size[1] },
        shading: Shading { mode: Mode::Normals, ..Shading::default() },
        file: file.to_owned(),
    }
}

fn still(painter: &mut Painter, stand: &Stand, size: [u32; 2], shading: &Shading) -> Picture {
    let view = stand.view(Size { width: size[0], height: size[1] }).unwrap();
    sheet::Sheet { cells: &[view], columns: 1, shading }.picture(painter, &Progress::none()).unwrap()
}

#[test]
fn what_is_drawn_in_parts_is_what_is_drawn_at_once() {
    let gpu = Gpu::headless(Backend::Auto).unwrap();
    let on_gpu = Device::Gpu(gpu.clone());
    let drawing = drawing();
    for (lens, samples, mode) in [
        (Lens::Orthographic, 4, Mode::Normals),
        (Lens::Perspective { focal_length_mm: 24.0 }, 1, Mode::Tangents),
    ] {
        let shading = Shading { mode, samples, background: Some([0.1, 0.2, 0.3]), ..Shading::default() };
        let stand = stand(lens);
        let view = stand.view(Size { width: 1301, height: 1105 }).unwrap();
        let whole = render_picture(&gpu, &drawing, &view, &shading).unwrap();
        let in_parts = still(&mut painter(&on_gpu), &stand, [1301, 1105], &shading);
        let difference = Difference::new(&whole, &in_parts).unwrap();
        // Rounding moves an edge by 1/256 of a pixel here and there, no more.
        assert!(difference.share_within(1) > 0.9999, "{lens:?}: {difference:?}");

        let reference = cpu::render(&drawing, &view, &shading, &Progress::none()).unwrap();
        let in_parts = still(&mut painter(&Device::Cpu), &stand, [1301, 1105], &shading);
        let difference = Difference::new(&reference, &in_parts).unwrap();
        assert!(difference.share_within(1) > 0.9999, "{lens:?}: {difference:?}");
    }
}

#[test]
fn hidden_panels_are_left_out_by_both_renderers() {
    let hidden = BTreeSet::from([0]);
    for device in [Device::Cpu, Device::headless().unwrap()] {
        let mut painter = Painter::new(device, drawing(), &hidden).unwrap();
        let picture = still(&mut painter, &stand(Lens::Orthographic), [64, 64], &Shading::default());
        assert!(picture.pixels().iter().all(|pixel| pixel[3] == 0.0));
    }
}

#[test]
fn a_contact_sheet_is_its_views_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("sheet.exr");
    let views = [NamedView::Front, NamedView::Right, NamedView::Back, NamedView::Left, NamedView::Top];
    let order = order(Kind::Views(views.to_vec()), [50, 41], &file);
    let mut painter = painter(&Device::Cpu);
    order.carry_out(&mut painter, &Progress::none()).unwrap();
    let sheet = decode::read(&file).unwrap();
    // Five views make two rows of three, the last of them empty.
    assert_eq!((sheet.width(), sheet.height()), (150, 82));
    for (k, named) in (0..).zip(views) {
        let single = still(&mut painter, &order.stand.named(named), [50, 41], &order.shading);
        for y in 0..41 {
            for x in 0..50 {
                let (on_sheet, alone) = (sheet.pixel(50 * (k % 3) + x, 41 * (k / 3) + y), single.pixel(x, y));
                // What is premultiplied and divided again is off by rounding.
                assert!((0..4).all(|c| (on_sheet[c] - alone[c]).abs() < 1e-6), "{named:?} {x} {y}");
            }
        }
    }
    assert!((100..150).all(|x| (41..82).all(|y| sheet.pixel(x, y) == [0.0; 4])));
}

#[test]
fn a_turn_begins_with_the_view_and_goes_once_around() {
    let start = stand(Lens::Orthographic);
    let Stand::Settings { settings, .. } = &start else { panic!("settings") };
    let at = |share: f64| {
        let Stand::Settings { settings, .. } = start.turned(share) else { panic!("settings") };
        settings.orientation()
    };
    assert!(at(0.0).dot(settings.orientation()).abs() > 1.0 - 1e-12);
    assert!(at(1.0).dot(settings.orientation()).abs() > 1.0 - 1e-12);
    // A quarter brings the side at -x, the wearer's right, to the front, about the garment's own axis.
    let quarter = settings.orientation().inverse() * at(0.25);
    assert!((quarter * glam::DVec3::NEG_X - glam::DVec3::Z).length() < 1e-9);
    assert!((quarter * glam::DVec3::Y - glam::DVec3::Y).length() < 1e-9);

    let folder = tempfile::tempdir().unwrap();
    let mut painter = painter(&Device::Cpu);
    let timing = Timing { frames: 3, per_second: 10 };
    for name in ["turn.png", "turn.gif"] {
        let order = order(Kind::Turn(timing), [40, 30], &folder.path().join(name));
        order.carry_out(&mut painter, &Progress::none()).unwrap();
    }
    // A reader that knows no animations sees the first frame.
    let first = decode::read(&folder.path().join("turn.png")).unwrap();
    let order = order(Kind::Still, [40, 30], &folder.path().join("still.png"));
    order.carry_out(&mut painter, &Progress::none()).unwrap();
    assert_eq!(first, decode::read(&order.file).unwrap());
}

#[test]
fn what_cannot_be_made_is_refused_and_what_is_stopped_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut painter = painter(&Device::Cpu);
    let file = |name: &str| folder.path().join(name);
    let timing = Timing { frames: 3, per_second: 10 };
    let all = NamedView::ALL.to_vec();
    for (order, kind) in [
        (order(Kind::Still, [32_769, 1], &file("a.png")), ErrorKind::TooLarge),
        (order(Kind::Still, [0, 5], &file("a.png")), ErrorKind::TooLarge),
        (order(Kind::Views(all), [16_384, 16_384], &file("a.exr")), ErrorKind::TooLarge),
        (order(Kind::Views(Vec::new()), [5, 5], &file("a.exr")), ErrorKind::TooLarge),
        (order(Kind::Turn(timing), [4000, 3000], &file("a.gif")), ErrorKind::TooLarge),
        (order(Kind::Turn(Timing { frames: 0, ..timing }), [4, 3], &file("a.gif")), ErrorKind::Invalid),
        (order(Kind::Still, [4, 4], &file("a.gif")), ErrorKind::Unsupported),
        (order(Kind::Turn(timing), [4, 4], &file("a.exr")), ErrorKind::Unsupported),
    ] {
        let error = order.carry_out(&mut painter, &Progress::none()).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
    }
    let (report, stop) = (|_: amc_core::Step<'_>| {}, AtomicBool::new(true));
    for order in
        [order(Kind::Still, [64, 64], &file("a.png")), order(Kind::Turn(timing), [64, 64], &file("a.gif"))]
    {
        let error = order.carry_out(&mut painter, &Progress::new(&report, &stop)).unwrap_err();
        assert!(error.is_cancelled(), "{error}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
