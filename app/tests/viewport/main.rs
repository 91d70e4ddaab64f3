//! The viewport in a window of its own: pictures, gestures, picking. They need a Vulkan or OpenGL adapter (Mesa's will do).

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod touch;

use std::collections::BTreeSet;
use std::sync::Arc;

use amc_core::amc::{Amc, Frame, Symmetry, TableSize, Texels};
use amc_core::color::srgb8_from_linear;
use amc_core::image::Picture;
use amc_core::mesh::{Garment, Picker};
use amc_core::render::gpu::{Gpu, render_picture};
use amc_core::render::{Bounds, Cloth, Drawing, Shading, View, cpu};
use amc_core::view_space::Azimuth;
use amc_core::{Progress, shape};
use amc_studio::viewport::{Boxed, Click, Viewport, ViewportInput, ViewportOutput};
use eframe::egui::{self, Key, Modifiers, PointerButton, Pos2, Rect, pos2, vec2};
use eframe::egui_wgpu::{RenderState, RendererOptions};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
use glam::{DQuat, Vec3};
use studio_plugin::Stage;
use studio_plugin::document::{Lens, NamedView, ViewSettings};

const BACKDROP: egui::Color32 = egui::Color32::from_rgb(40, 44, 52);
const SELECTED: egui::Color32 = egui::Color32::from_rgb(255, 0, 255);
const HOVERED: egui::Color32 = egui::Color32::from_rgb(0, 255, 0);
const SIZE: [f32; 2] = [200.0, 160.0];

/// A torus over a smaller sphere, each a panel or more, in a table whose every texel differs.
fn drawing() -> Arc<Drawing> {
    let mut mesh = shape::mesh("torus").unwrap();
    let sphere = shape::mesh("sphere").unwrap();
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(sphere.positions.iter().map(|p| *p * 0.3 + Vec3::new(0.1, 0.2, 0.15)));
    mesh.normals.extend(sphere.normals);
    mesh.uvs.as_mut().unwrap().extend(sphere.uvs.unwrap());
    mesh.triangles.extend(sphere.triangles.iter().map(|corners| corners.map(|k| k + first)));
    let part = mesh.parts.len() as u32;
    mesh.parts.extend(sphere.parts);
    mesh.triangle_parts.extend(sphere.triangle_parts.iter().map(|k| k + part));
    let garment = Garment::new(mesh).unwrap();
    let directions = vec![Default::default(); garment.panels.len()];
    let tangents = amc_core::direction::tangents(&garment, &directions).unwrap();
    let cloth = |panel| if panel == 0 { Cloth::Fabric(0) } else { Cloth::Plain };
    Arc::new(Drawing::new(&garment, tangents.vectors, None, vec![table()], cloth).unwrap())
}

fn table() -> Arc<Amc> {
    let (side, slices) = (16u32, 8u32);
    let texel = |k: u32| {
        let (i, j, s) = (k % side, k / side % side, k / side / side);
        [(i * 17) as u8, (j * 17) as u8, (s * 36) as u8, 255]
    };
    let texels = Texels::Srgb8((0..side * side * slices).map(texel).collect());
    let size = TableSize::new(side, slices).unwrap();
    Arc::new(Amc::new(size, texels, Symmetry::One, Azimuth::Transported, Frame::Half).unwrap())
}

/// A window with nothing but a viewport.
struct Window {
    viewport: Viewport,
    settings: ViewSettings,
    selected: BTreeSet<usize>,
    hidden: BTreeSet<usize>,
    compared: Option<Shading>,
    /// Where the viewport stands in the window; none: it fills it.
    place: Option<Rect>,
    /// The latest, and what happened since the last look.
    output: Option<ViewportOutput>,
    clicks: Vec<Click>,
    boxes: Vec<Boxed>,
}

impl Window {
    fn ui(&mut self, ui: &mut egui::Ui) {
        let place = self.place.unwrap_or(ui.ctx().content_rect());
        let mut ui = ui.new_child(egui::UiBuilder::new().max_rect(place));
        let input = ViewportInput {
            selected: &self.selected,
            hovered: None,
            hidden: &self.hidden,
            shading: Stage::default().shading(&self.settings),
            compared: self.compared.clone(),
            tool: false,
            backdrop: BACKDROP,
            selected_color: SELECTED,
            hovered_color: HOVERED,
        };
        let output = self.viewport.show(&mut ui, &mut self.settings, &input);
        self.clicks.extend(output.clicked);
        self.boxes.extend(output.boxed.clone());
        self.output = Some(output);
    }
}

fn window(drawing: Option<Arc<Drawing>>, pixels_per_point: f32) -> (Harness<'static, Window>, RenderState) {
    let render_state = create_render_state(default_wgpu_setup(), RendererOptions::PREDICTABLE);
    let mut viewport = Viewport::new(&render_state);
    if let Some(drawing) = drawing {
        let picker = Arc::new(Picker::new(&drawing).unwrap());
        viewport.set_scene(drawing, picker);
    }
    let window = Window {
        viewport,
        settings: ViewSettings::default(),
        selected: BTreeSet::new(),
        hidden: BTreeSet::new(),
        compared: None,
        place: None,
        output: None,
        clicks: Vec::new(),
        boxes: Vec::new(),
    };
    let harness = Harness::builder()
        .with_size(SIZE)
        .with_pixels_per_point(pixels_per_point)
        .with_render_cursor(false)
        .with_step_dt(1.0 / 60.0)
        .renderer(WgpuTestRenderer::from_render_state(render_state.clone()))
        .build_ui_state(|ui, window: &mut Window| window.ui(ui), window);
    (harness, render_state)
}

/// The picture that the command line would save, over the backdrop, sRGB-encoded.
fn expected(render_state: &RenderState, drawing: &Drawing, view: &View, shading: Shading) -> Picture {
    let gpu = Gpu { device: render_state.device.clone(), queue: render_state.queue.clone() };
    let backdrop = [BACKDROP.r(), BACKDROP.g(), BACKDROP.b()];
    let background = Some(backdrop.map(|value| amc_core::color::LINEAR_FROM_SRGB8[usize::from(value)]));
    render_picture(&gpu, drawing, view, &Shading { background, ..shading }).unwrap()
}

/// The largest difference of `picture` from what the window shows from `corner` on, and how many pixels show something.
fn difference(harness: &mut Harness<'_, Window>, picture: &Picture, corner: [i64; 2]) -> (u8, usize) {
    let shown = harness.render().unwrap();
    let (mut worst, mut seen) = (0, 0);
    for y in 0..i64::from(picture.height()) {
        for x in 0..i64::from(picture.width()) {
            let at = [x + corner[0], y + corner[1]];
            let inside =
                at[0] >= 0 && at[1] >= 0 && at[0] < shown.width().into() && at[1] < shown.height().into();
            if !inside {
                continue;
            }
            let [r, g, b, _] = picture.pixel(x as u32, y as u32);
            let found = shown.get_pixel(at[0] as u32, at[1] as u32).0;
            for (expected, found) in [r, g, b].map(srgb8_from_linear).into_iter().zip(found) {
                worst = worst.max(expected.abs_diff(found));
            }
            seen += usize::from(found[..3] != [BACKDROP.r(), BACKDROP.g(), BACKDROP.b()]);
        }
    }
    (worst, seen)
}

fn press(
    harness: &mut Harness<'_, Window>,
    at: Pos2,
    button: PointerButton,
    pressed: bool,
    modifiers: Modifiers,
) {
    harness.event(egui::Event::PointerMoved(at));
    harness.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
    harness.step();
}

fn drag(harness: &mut Harness<'_, Window>, way: &[Pos2], button: PointerButton, modifiers: Modifiers) {
    harness.event(egui::Event::ModifiersChanged(modifiers));
    press(harness, way[0], button, true, modifiers);
    for &at in &way[1..] {
        harness.event(egui::Event::PointerMoved(at));
        harness.step();
    }
    press(harness, way[way.len() - 1], button, false, modifiers);
    harness.event(egui::Event::ModifiersChanged(Modifiers::NONE));
    harness.step();
}

fn click(harness: &mut Harness<'_, Window>, at: Pos2, modifiers: Modifiers) {
    // Two clicks in a row are a double click.
    harness.run_steps(40);
    harness.event(egui::Event::ModifiersChanged(modifiers));
    press(harness, at, PointerButton::Primary, true, modifiers);
    press(harness, at, PointerButton::Primary, false, modifiers);
    harness.event(egui::Event::ModifiersChanged(Modifiers::NONE));
    harness.step();
}

#[test]
fn the_window_shows_the_command_lines_picture_pixel_for_pixel() {
    let drawing = drawing();
    for pixels_per_point in [1.0, 1.5] {
        let (mut harness, render_state) = window(Some(Arc::clone(&drawing)), pixels_per_point);
        for lens in [Lens::Orthographic, Lens::Perspective { focal_length_mm: 50.0 }] {
            harness.state_mut().settings.lens = lens;
            harness.state_mut().settings.look(NamedView::Left);
            harness.step();
            let view = harness.state().output.as_ref().unwrap().view.unwrap();
            assert_eq!(view.width, (SIZE[0] * pixels_per_point) as u32);
            let picture = expected(&render_state, &drawing, &view, Shading::default());
            let (worst, seen) = difference(&mut harness, &picture, [0, 0]);
            assert!(worst <= 1 && seen > 5_000, "{worst} of 255, {seen} pixels");
        }
    }
}

#[test]
fn a_viewport_partly_outside_of_the_window_is_not_squeezed() {
    let drawing = drawing();
    let (mut harness, render_state) = window(Some(Arc::clone(&drawing)), 1.0);
    harness.state_mut().place = Some(Rect::from_min_size(pos2(-60.0, -31.0), vec2(220.0, 240.0)));
    harness.run();
    let view = harness.state().output.as_ref().unwrap().view.unwrap();
    assert_eq!((view.width, view.height), (220, 240));
    let picture = expected(&render_state, &drawing, &view, Shading::default());
    let (worst, seen) = difference(&mut harness, &picture, [-60, -31]);
    assert!(worst <= 1 && seen > 4_000, "{worst} of 255, {seen} pixels");
}

#[test]
fn a_frame_in_which_nothing_changes_draws_nothing() {
    let (mut harness, _) = window(Some(drawing()), 1.0);
    harness.run();
    let drawn = |harness: &Harness<'_, Window>| harness.state().viewport.scenes_drawn();
    let first = drawn(&harness);
    assert_eq!(first, 1);
    harness.run_steps(5);
    assert_eq!(drawn(&harness), first);
    // Outlines are drawn over the picture that is there.
    harness.state_mut().selected.insert(1);
    harness.hover_at(pos2(100.0, 80.0));
    harness.run_steps(2);
    assert_eq!(drawn(&harness), first);
    harness.state_mut().settings.zoom = 1.5;
    harness.run_steps(2);
    assert_eq!(drawn(&harness), first + 1);
    harness.state_mut().settings.mode = "normals".into();
    harness.run_steps(2);
    assert_eq!(drawn(&harness), first + 2);
    harness.state_mut().hidden.insert(0);
    harness.run_steps(2);
    assert_eq!(drawn(&harness), first + 3);
    harness.state_mut().viewport.redraw();
    harness.run_steps(2);
    assert_eq!(drawn(&harness), first + 4);
    harness.set_size(vec2(300.0, 200.0));
    harness.run_steps(2);
    assert_eq!(drawn(&harness), first + 5);
    // Nobody asks for frames on his own.
    assert!(harness.run() <= 2);
}

#[test]
fn drags_keys_and_the_wheel_change_the_view() {
    let (mut harness, _) = window(Some(drawing()), 1.0);
    let middle = pos2(100.0, 80.0);
    // The ball's radius is 80 points: from its middle to its outline is a quarter turn.
    let way = [middle, pos2(150.0, 80.0), pos2(180.0, 80.0)];
    drag(&mut harness, &way, PointerButton::Primary, Modifiers::NONE);
    let turned = harness.state().settings.orientation();
    assert!(turned.angle_between(DQuat::from_rotation_y(90f64.to_radians())) < 1e-4, "{turned}");
    assert!(harness.state().clicks.is_empty());

    harness.key_press(Key::ArrowLeft);
    harness.step();
    assert!((harness.state().settings.angles().yaw - 75.0).abs() < 1e-3);
    harness.key_press(Key::Num2);
    harness.step();
    assert!((harness.state().settings.angles().yaw.abs() - 180.0).abs() < 1e-6);

    drag(&mut harness, &[middle, pos2(120.0, 70.0)], PointerButton::Middle, Modifiers::NONE);
    let pan = harness.state().settings.pan;
    assert!((pan - glam::Vec2::new(0.25, 0.125)).length() < 1e-5, "{pan}");
    drag(&mut harness, &[middle, pos2(90.0, 70.0)], PointerButton::Primary, Modifiers::SHIFT);
    let pan = harness.state().settings.pan;
    assert!((pan - glam::Vec2::new(0.125, 0.25)).length() < 1e-5, "{pan}");

    let rolled = [pos2(150.0, 80.0), pos2(140.0, 50.0), pos2(100.0, 30.0)];
    drag(&mut harness, &rolled, PointerButton::Primary, Modifiers::ALT);
    assert!((harness.state().settings.angles().roll.abs() - 90.0).abs() < 0.01);

    harness.key_press(Key::F);
    harness.step();
    assert_eq!(harness.state().settings.zoom, 1.0);
    harness.hover_at(middle);
    harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: vec2(0.0, 40.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    harness.run_steps(30);
    assert!(harness.state().settings.zoom > 1.1);
    harness.state().settings.check().unwrap();
}

/// Which panel the CPU renderer shows at each pixel: every panel is drawn alone in its own colour by its index.
fn id_picture(drawing: &Drawing, view: &View) -> Vec<Option<usize>> {
    let fabric = |panel: usize| {
        let size = TableSize::new(8, 8).unwrap();
        let texels = Texels::Srgb8(vec![[panel as u8 + 1, 0, 0, 255]; 512]);
        Arc::new(Amc::new(size, texels, Symmetry::One, Azimuth::Transported, Frame::Half).unwrap())
    };
    let mut painted = drawing.clone();
    painted.fabrics = (0..drawing.draws.len()).map(fabric).collect();
    for (panel, draw) in painted.draws.iter_mut().enumerate() {
        draw.cloth = Cloth::Fabric(panel);
    }
    let shading = Shading { samples: 1, occlusion: false, ..Shading::default() };
    let picture = cpu::render(&painted, view, &shading, &Progress::none()).unwrap();
    let panel = |&[r, _, _, a]: &[f32; 4]| (a > 0.0).then(|| usize::from(srgb8_from_linear(r)) - 1);
    picture.pixels().iter().map(panel).collect()
}

#[test]
fn the_pointer_finds_the_panel_that_is_drawn_there() {
    let drawing = drawing();
    let picker = Picker::new(&drawing).unwrap();
    let positions: Vec<Vec3> = drawing.vertices.iter().map(|vertex| vertex.position).collect();
    let bounds = Bounds::of(&positions).unwrap();
    for (lens, named) in [
        (Lens::Orthographic, NamedView::Front),
        (Lens::Orthographic, NamedView::Left),
        (Lens::Perspective { focal_length_mm: 24.0 }, NamedView::Back),
        (Lens::Perspective { focal_length_mm: 85.0 }, NamedView::Top),
    ] {
        let mut settings = ViewSettings::default();
        settings.lens = lens;
        settings.look(named);
        let view = settings.view(bounds, 96, 72);
        let ids = id_picture(&drawing, &view);
        let at = |k: usize| glam::Vec2::new((k % 96) as f32 + 0.5, (k / 96) as f32 + 0.5);
        // A ray and a rasteriser round differently where a triangle's edge runs through a pixel's centre.
        let differ = (0..ids.len()).filter(|&k| picker.first(view.ray(at(k)), |_| false) != ids[k]).count();
        assert!(differ <= 2, "{differ} pixels, {named:?}");
        assert!(ids.iter().flatten().collect::<BTreeSet<_>>().len() > 1);
    }
}

#[test]
fn clicks_and_boxes_select_what_is_seen() {
    let (mut harness, _) = window(Some(drawing()), 1.0);
    harness.step();
    let view = harness.state().output.as_ref().unwrap().view.unwrap();
    let ids = id_picture(&drawing(), &view);
    let of_panel = |panel: Option<usize>| {
        let k = ids.iter().position(|id| *id == panel).unwrap() + 2;
        pos2((k % view.width as usize) as f32 + 0.5, (k / view.width as usize) as f32 + 2.5)
    };
    for panel in [Some(0), Some(1), None] {
        let at = of_panel(panel);
        for modifiers in [Modifiers::NONE, Modifiers::COMMAND] {
            click(&mut harness, at, modifiers);
            let click = Click { panel, add: modifiers != Modifiers::NONE };
            assert_eq!(harness.state_mut().clicks.drain(..).collect::<Vec<_>>(), [click]);
        }
        assert_eq!(harness.state().output.as_ref().unwrap().hovered, panel);
    }
    drag(
        &mut harness,
        &[pos2(1.0, 1.0), pos2(50.0, 50.0), pos2(199.0, 159.0)],
        PointerButton::Secondary,
        Modifiers::NONE,
    );
    let seen: BTreeSet<usize> = ids.iter().flatten().copied().collect();
    assert_eq!(harness.state_mut().boxes.drain(..).collect::<Vec<_>>(), [Boxed { panels: seen, add: false }]);
    assert_eq!(harness.state().settings, ViewSettings::default());
    // What is hidden is not there.
    harness.state_mut().hidden.insert(1);
    harness.hover_at(of_panel(Some(1)));
    harness.run_steps(2);
    assert_ne!(harness.state().output.as_ref().unwrap().hovered, Some(1));
}

#[test]
fn outlines_surround_the_selected_panel_and_leave_its_colours_alone() {
    let (mut harness, _) = window(Some(drawing()), 1.0);
    harness.step();
    let view = harness.state().output.as_ref().unwrap().view.unwrap();
    let ids = id_picture(&drawing(), &view);
    let before = harness.render().unwrap();
    harness.state_mut().selected.insert(1);
    harness.step();
    let after = harness.render().unwrap();
    let near = |k: usize| {
        let (x, y) = ((k % view.width as usize) as i64, (k / view.width as usize) as i64);
        let reach = |d: i64| (-d..=d).flat_map(move |dy| (-d..=d).map(move |dx| (x + dx, y + dy)));
        let id = |(x, y): (i64, i64)| {
            let inside = (0..view.width.into()).contains(&x) && (0..view.height.into()).contains(&y);
            inside.then(|| ids[(y * i64::from(view.width) + x) as usize]).flatten()
        };
        (reach(1).all(|at| id(at) == Some(1)), reach(4).any(|at| id(at) == Some(1)))
    };
    let mut outlined = 0;
    for (k, (before, after)) in before.pixels().zip(after.pixels()).enumerate() {
        let (within, close) = near(k);
        if within || !close {
            assert_eq!(before, after, "pixel {k}");
        }
        outlined += usize::from(after.0[..3] == [255, 0, 255]);
    }
    assert!(outlined > 40, "{outlined}");
}

#[test]
fn a_split_view_shows_two_looks_and_its_divider_moves() {
    let drawing = drawing();
    let (mut harness, render_state) = window(Some(Arc::clone(&drawing)), 1.0);
    let normals = Shading { mode: amc_core::render::Mode::Normals, ..Shading::default() };
    harness.state_mut().compared = Some(normals.clone());
    harness.run();
    drag(
        &mut harness,
        &[pos2(100.0, 20.0), pos2(80.0, 20.0), pos2(60.0, 20.0)],
        PointerButton::Primary,
        Modifiers::NONE,
    );
    assert!((harness.state().viewport.divider() - 0.3).abs() < 0.01);
    assert_eq!(harness.state().settings, ViewSettings::default());
    harness.remove_cursor();
    harness.run();
    let view = harness.state().output.as_ref().unwrap().view.unwrap();
    let shown = harness.render().unwrap();
    let [left, right] =
        [Shading::default(), normals].map(|shading| expected(&render_state, &drawing, &view, shading));
    for (picture, columns) in [(left, 0..50), (right, 70..200)] {
        for x in columns {
            let [r, g, b, _] = picture.pixel(x, 75).map(srgb8_from_linear);
            let found = shown.get_pixel(x, 75).0;
            assert!([r, g, b].into_iter().zip(found).all(|(a, b)| a.abs_diff(b) <= 1), "column {x}");
        }
    }
}

#[test]
fn faults_are_said_in_words_and_nothing_is_open_at_first() {
    let (mut harness, _) = window(None, 1.0);
    harness.run();
    assert!(harness.state().output.as_ref().unwrap().error.is_none());
    harness.get_by_label("Garment");
    let mut broken = (*drawing()).clone();
    let picker = Arc::new(Picker::new(&broken).unwrap());
    broken.draws[0].cloth = Cloth::Fabric(7);
    harness.state_mut().viewport.set_scene(Arc::new(broken), Arc::clone(&picker));
    harness.run();
    let says = |harness: &Harness<'_, Window>| {
        harness.state().output.as_ref().unwrap().error.as_ref().unwrap().to_string()
    };
    assert!(says(&harness).contains("panel 0: fabric 7"));
    let shown = harness.render().unwrap();
    let text =
        shown.pixels().filter(|pixel| pixel.0[..3] != [BACKDROP.r(), BACKDROP.g(), BACKDROP.b()]).count();
    assert!(text > 100, "the message is not to be seen");
    harness.state_mut().viewport.set_scene(Arc::new(Drawing::default()), picker);
    harness.run();
    assert!(says(&harness).contains("nothing to look at"));
}

#[test]
fn the_garment_turns_by_itself_only_while_it_is_told_to() {
    let (mut harness, _) = window(Some(drawing()), 1.0);
    harness.state_mut().settings.auto_turn = Some(30.0);
    harness.run_steps(10);
    let yaw = harness.state().settings.angles().yaw;
    assert!(yaw > 0.5, "{yaw}");
    harness.state_mut().settings.auto_turn = None;
    harness.run();
    assert_eq!(harness.state().settings.angles().yaw, harness.state().settings.angles().yaw.max(yaw));
    assert!(harness.run() <= 2);
}
