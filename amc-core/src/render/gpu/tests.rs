//! Pictures whose colours are known in closed form. They need an OpenGL adapter (Mesa's will do).

use std::sync::{Arc, OnceLock};

use glam::{Mat4, Vec2, Vec3};
use half::f16;

use super::*;
use crate::amc::{Amc, Frame, Symmetry, TableSize, Texels};
use crate::color::srgb_from_linear;
use crate::image::Picture;
use crate::render::{
    Cloth, Cyclic, Draw, Drawing, Mode, OwnMode, Perspective, Projection, Shading, Vertex, View,
};
use crate::view_space::Azimuth;

const SIDE: u32 = 8;
const SLICES: u32 = 8;

fn opengl() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| Gpu::headless(Backend::Gl).unwrap_or_else(|error| panic!("{error}")))
}

macro_rules! on_opengl {
    ($($test:ident),* $(,)?) => {
        mod opengl {
            $(#[test] fn $test() { super::$test(super::opengl()); })*
        }
    };
}

on_opengl!(
    a_table_is_looked_up_by_normal_and_azimuth,
    a_back_face_has_its_normal_negated_and_its_tangent_kept,
    a_replaced_slice_changes_only_what_shows_it,
    panels_wear_their_own_fabrics,
    what_is_not_covered_is_transparent,
    occlusion_multiplies_and_can_be_off,
    a_matcap_picture_has_its_top_row_up,
    the_mean_over_slices_is_the_isotropic_look,
    the_full_turn_takes_the_line_of_sight_to_the_middle,
    the_half_turn_takes_the_half_vector_to_the_middle,
    normals_tangents_and_uvs_come_out_as_encoded_values,
    a_mode_from_outside_is_drawn_and_its_faults_are_told_by_line,
    a_target_without_srgb_gets_encoded_values,
    a_changed_direction_uploads_only_what_changed,
    impossible_requests_are_refused,
);

fn half(colour: [f32; 3]) -> [f16; 4] {
    let [r, g, b] = colour.map(f16::from_f32);
    [r, g, b, f16::ONE]
}

/// A table of the colour `of(n_x, n_y, share of the axis)`.
fn table(symmetry: Symmetry, azimuth: Azimuth, of: impl Fn(Vec2, f32) -> [f32; 3]) -> Arc<Amc> {
    let size = TableSize::new(SIDE, SLICES).unwrap();
    let mut texels = Vec::new();
    for s in 0..SLICES {
        for j in 0..SIDE {
            for i in 0..SIDE {
                texels.push(half(of(size.normal_xy(i, j), s as f32 / SLICES as f32)));
            }
        }
    }
    Arc::new(Amc::new(size, Texels::Half(texels), symmetry, azimuth, Frame::Half).unwrap())
}

fn ramp(xy: Vec2, share: f32) -> [f32; 3] {
    [xy.x / 2.0 + 0.5, xy.y / 2.0 + 0.5, share]
}

/// A square over x of `from..to` (the view's width is -1..1) that looks at the viewer.
fn square(from: f32, to: f32, n: Vec3, t: Vec3) -> Drawing {
    let vertex = |x, y| Vertex {
        position: Vec3::new(x, y, 0.0),
        normal: n,
        uv: Vec2::new(x, y),
        occlusion: Vec2::splat(0.5),
    };
    Drawing {
        vertices: vec![vertex(from, -1.0), vertex(to, -1.0), vertex(to, 1.0), vertex(from, 1.0)].into(),
        tangents: vec![t; 4].into(),
        triangles: vec![[0, 1, 2], [0, 2, 3]].into(),
        draws: vec![Draw { triangles: 0..2, cloth: Cloth::Fabric(0) }],
        fabrics: Vec::new(),
    }
}

/// Adds the vertices and triangles of another drawing.
fn append(drawing: &mut Drawing, other: &Drawing) {
    let first = drawing.vertices.len() as u32;
    Arc::make_mut(&mut drawing.vertices).extend_from_slice(&other.vertices);
    Arc::make_mut(&mut drawing.tangents).extend_from_slice(&other.tangents);
    let triangles = other.triangles.iter().map(|corners| corners.map(|k| k + first));
    Arc::make_mut(&mut drawing.triangles).extend(triangles);
}

fn view() -> View {
    View {
        object_to_view: Mat4::from_translation(Vec3::new(0.0, 0.0, -1.0)),
        projection: Projection::Orthographic { half_height: 1.0 },
        width: 16,
        height: 16,
        near: 0.1,
        far: 10.0,
        shift: Vec2::ZERO,
    }
}

fn shading(mode: Mode) -> Shading {
    Shading { mode, occlusion: false, samples: 1, ..Shading::default() }
}

fn middle(gpu: &Gpu, drawing: &Drawing, view: &View, shading: &Shading) -> [f32; 3] {
    let picture = render_picture(gpu, drawing, view, shading).unwrap();
    let [r, g, b, a] = picture.pixel(view.width / 2, view.height / 2);
    assert_eq!(a, 1.0);
    [r, g, b]
}

#[track_caller]
fn assert_near(seen: [f32; 3], expected: [f32; 3], tolerance: f32) {
    let near = seen.iter().zip(expected).all(|(seen, expected)| (seen - expected).abs() <= tolerance);
    assert!(near, "{seen:?}, expected {expected:?}");
}

fn a_table_is_looked_up_by_normal_and_azimuth(gpu: &Gpu) {
    let n = Vec3::new(0.3, -0.4, 0.75f32.sqrt());
    for azimuth in [Azimuth::Transported, Azimuth::Projected] {
        for symmetry in Symmetry::ALL {
            // Within the first 1/R of the turn, off the wrap between the last slice and the first.
            let share = 0.3;
            let phi = share * std::f32::consts::TAU / symmetry.order() as f32;
            let mut drawing = square(-1.0, 1.0, n, azimuth.tangent(n, phi));
            drawing.fabrics = vec![table(symmetry, azimuth, ramp)];
            for cyclic in [Cyclic::Naive, Cyclic::Cyclic, Cyclic::Fragment] {
                for samples in [1, 4] {
                    let shading = Shading { cyclic, samples, ..shading(Mode::Amc) };
                    assert_near(middle(gpu, &drawing, &view(), &shading), [0.65, 0.3, share], 0.004);
                }
            }
        }
    }
}

fn a_back_face_has_its_normal_negated_and_its_tangent_kept(gpu: &Gpu) {
    let n = Vec3::new(0.3, -0.4, 0.75f32.sqrt());
    let t = Azimuth::Transported.tangent(n, 0.3 * std::f32::consts::TAU);
    let mut drawing = square(-1.0, 1.0, -n, t);
    drawing.triangles = vec![[0, 2, 1], [0, 3, 2]].into();
    drawing.fabrics = vec![table(Symmetry::One, Azimuth::Transported, ramp)];
    for cyclic in [Cyclic::Naive, Cyclic::Cyclic, Cyclic::Fragment] {
        let shading = Shading { cyclic, ..shading(Mode::Amc) };
        assert_near(middle(gpu, &drawing, &view(), &shading), [0.65, 0.3, 0.3], 0.004);
    }
}

fn a_replaced_slice_changes_only_what_shows_it(gpu: &Gpu) {
    // Eight stripes, one at each slice's azimuth.
    let mut drawing = Drawing::default();
    for s in 0..SLICES {
        let phi = std::f32::consts::TAU * s as f32 / SLICES as f32;
        let from = -1.0 + 2.0 * s as f32 / SLICES as f32;
        let stripe =
            square(from, from + 2.0 / SLICES as f32, Vec3::Z, Azimuth::Transported.tangent(Vec3::Z, phi));
        append(&mut drawing, &stripe);
    }
    drawing.draws = vec![Draw { triangles: 0..2 * SLICES, cloth: Cloth::Fabric(0) }];
    drawing.fabrics = vec![table(Symmetry::One, Azimuth::Transported, |_, share| [share, 0.25, 0.5])];

    let mut renderer = Renderer::new(&gpu.device, &gpu.queue);
    let mut scene = renderer.prepare(&drawing).unwrap();
    let offscreen = Offscreen::new(&gpu.device, 16, 16, 1).unwrap();
    let eye = renderer.eye();
    let shading = shading(Mode::Amc);
    let frame = renderer.draw_data(&mut scene, &eye, &view(), &shading, offscreen.target()).unwrap();
    let before = offscreen.picture(gpu, &frame, None).unwrap();
    let slice = vec![half([1.0, 1.0, 0.0]); (SIDE * SIDE) as usize];
    let fabric = scene.fabric(0).unwrap();
    fabric.write_slice(&gpu.queue, 2, bytemuck::cast_slice(&slice)).unwrap();
    let after = offscreen.picture(gpu, &frame, None).unwrap();
    for x in 0..16 {
        let [r, g, b, _] = after.pixel(x, 8);
        if x / 2 == 2 {
            assert_near([r, g, b], [1.0, 1.0, 0.0], 0.002);
        } else {
            // The wrap is a rounding of 1e-7 turns, no more.
            let [r0, g0, b0, _] = before.pixel(x, 8);
            assert_near([r, g, b], [r0, g0, b0], 0.001);
        }
    }
    assert!(fabric.write_slice(&gpu.queue, SLICES, bytemuck::cast_slice(&slice)).is_err());
    assert!(fabric.write_slice(&gpu.queue, 0, &[0; 3]).is_err());
}

fn panels_wear_their_own_fabrics(gpu: &Gpu) {
    let mut drawing = square(-1.0, 0.0, Vec3::Z, Vec3::X);
    let right = square(0.0, 1.0, Vec3::Z, Vec3::X);
    append(&mut drawing, &right);
    drawing.draws.push(Draw { triangles: 2..3, cloth: Cloth::Fabric(1) });
    drawing.draws.push(Draw { triangles: 3..4, cloth: Cloth::Plain });
    let plain_red = table(Symmetry::One, Azimuth::Transported, |_, _| [1.0, 0.0, 0.0]);
    let plain_blue = table(Symmetry::Four, Azimuth::Projected, |_, _| [0.0, 0.0, 1.0]);
    drawing.fabrics = vec![plain_red, plain_blue];
    let picture = render_picture(gpu, &drawing, &view(), &shading(Mode::Amc)).unwrap();
    assert_eq!(picture.pixel(4, 8), [1.0, 0.0, 0.0, 1.0]);
    // The right square's lower triangle, then its upper one.
    assert_eq!(picture.pixel(14, 14), [0.0, 0.0, 1.0, 1.0]);
    let [r, g, b, _] = picture.pixel(9, 1);
    assert_near([r, g, b], [0.35; 3], 0.001);
}

fn what_is_not_covered_is_transparent(gpu: &Gpu) {
    // The edge at x = 1/32 halves the samples of column 8.
    let mut drawing = square(-1.0, 1.0 / 16.0, Vec3::Z, Vec3::X);
    drawing.fabrics = vec![table(Symmetry::One, Azimuth::Transported, |_, _| [0.5, 0.25, 1.0])];
    let shading = Shading { samples: 4, ..shading(Mode::Amc) };
    let picture = render_picture(gpu, &drawing, &view(), &shading).unwrap();
    assert_eq!(picture.pixel(7, 3), [0.5, 0.25, 1.0, 1.0]);
    assert_eq!(picture.pixel(8, 3), [0.5, 0.25, 1.0, 0.5]);
    assert_eq!(picture.pixel(9, 3), [0.0; 4]);
    let shading = Shading { background: Some([0.0, 0.5, 0.0]), ..shading };
    let picture = render_picture(gpu, &drawing, &view(), &shading).unwrap();
    assert_eq!(picture.pixel(8, 3), [0.25, 0.375, 0.5, 1.0]);
    assert_eq!(picture.pixel(9, 3), [0.0, 0.5, 0.0, 1.0]);
}

fn occlusion_multiplies_and_can_be_off(gpu: &Gpu) {
    let mut drawing = square(-1.0, 1.0, Vec3::Z, Vec3::X);
    drawing.fabrics = vec![table(Symmetry::One, Azimuth::Transported, |_, _| [0.5, 0.25, 1.0])];
    for (occlusion, light) in [(true, 0.5), (false, 1.0)] {
        let shading = Shading { occlusion, ..shading(Mode::Amc) };
        let expected = [0.5 * light, 0.25 * light, light];
        assert_near(middle(gpu, &drawing, &view(), &shading), expected, 1e-3);
    }
}

fn a_matcap_picture_has_its_top_row_up(gpu: &Gpu) {
    // Left and right, top and bottom all differ.
    let pixels = [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0], [1.0, 1.0, 1.0, 1.0]];
    let ball = Arc::new(Picture::new(2, 2, pixels.to_vec()).unwrap());
    let z = (1.0f32 - 2.0 * 0.36).sqrt();
    for (x, y, expected) in [
        (-0.6, 0.6, [1.0, 0.0, 0.0]),
        (0.6, 0.6, [0.0, 1.0, 0.0]),
        (-0.6, -0.6, [0.0, 0.0, 1.0]),
        (0.6, -0.6, [1.0, 1.0, 1.0]),
    ] {
        let mut drawing = square(-1.0, 1.0, Vec3::new(x, y, z), Vec3::X);
        drawing.fabrics = vec![table(Symmetry::One, Azimuth::Transported, ramp)];
        let seen = middle(gpu, &drawing, &view(), &shading(Mode::MatCap(Arc::clone(&ball))));
        assert_near(seen, expected, 1e-3);
    }
}

fn the_mean_over_slices_is_the_isotropic_look(gpu: &Gpu) {
    let n = Vec3::new(0.3, -0.4, 0.75f32.sqrt());
    let mut drawing = square(-1.0, 1.0, n, Vec3::X);
    drawing.fabrics = vec![table(Symmetry::Two, Azimuth::Transported, ramp)];
    // The mean of 0/8 .. 7/8.
    assert_near(middle(gpu, &drawing, &view(), &shading(Mode::Isotropic)), [0.65, 0.3, 0.4375], 0.002);
}

/// A square before a camera, whose normals are `of` their view-space position.
fn before_a_camera(of: impl Fn(Vec3) -> Vec3) -> (Drawing, View) {
    let mut drawing = square(-1.0, 1.0, Vec3::Z, Vec3::X);
    for vertex in Arc::make_mut(&mut drawing.vertices) {
        vertex.normal = of(vertex.position - Vec3::Z);
    }
    drawing.fabrics = vec![table(Symmetry::One, Azimuth::Transported, ramp)];
    let projection = Projection::Perspective { fov_y: std::f32::consts::FRAC_PI_2 };
    (drawing, View { projection, ..view() })
}

fn the_full_turn_takes_the_line_of_sight_to_the_middle(gpu: &Gpu) {
    // Normals against the line of sight are linear in the position, so that interpolation is exact.
    let (drawing, view) = before_a_camera(|p| -p);
    let shading = Shading { perspective: Perspective::Full, ..shading(Mode::Amc) };
    let picture = render_picture(gpu, &drawing, &view, &shading).unwrap();
    for &[r, g, _, _] in picture.pixels() {
        assert_near([r, g, 0.0], [0.5, 0.5, 0.0], 0.002);
    }
    // Without the turn it is the normal itself: at the picture's edge 45 degrees off.
    let shading = Shading { perspective: Perspective::Off, ..shading };
    let picture = render_picture(gpu, &drawing, &view, &shading).unwrap();
    let x = 15.0 / 16.0f32;
    let expected = 0.5 - x / (2.0 * (1.0 + x * x + 1.0 / 256.0).sqrt());
    let [r, _, _, _] = picture.pixel(15, 8);
    assert!((r - expected).abs() < 0.003, "{r} {expected}");
}

fn the_half_turn_takes_the_half_vector_to_the_middle(gpu: &Gpu) {
    let x = 13.0 / 16.0;
    let towards_eye = Vec3::new(-x, 1.0 / 16.0, 1.0).normalize_or(Vec3::Z);
    let half_vector = (towards_eye + Vec3::Z).normalize_or(Vec3::Z);
    let (drawing, view) = before_a_camera(|_| half_vector);
    let picture = render_picture(gpu, &drawing, &view, &shading(Mode::Amc)).unwrap();
    let [r, g, _, _] = picture.pixel(14, 8);
    assert_near([r, g, 0.0], [0.5, 0.5, 0.0], 0.002);
}

fn normals_tangents_and_uvs_come_out_as_encoded_values(gpu: &Gpu) {
    let n = Vec3::new(0.36, -0.48, 0.8);
    let drawing = Drawing {
        draws: vec![Draw { triangles: 0..2, cloth: Cloth::Plain }],
        ..square(-1.0, 1.0, n, Vec3::new(0.8, 0.6, 0.0))
    };
    let encoded = |mode| middle(gpu, &drawing, &view(), &shading(mode)).map(srgb_from_linear);
    assert_near(encoded(Mode::Normals), [0.68, 0.26, 0.9], 0.002);
    assert_near(encoded(Mode::Tangents), [0.9, 0.8, 0.5], 0.002);
    // The pixel right and below of the middle has its centre at (1/16, -1/16): an odd square.
    assert_near(encoded(Mode::Uv), [0.0625, 0.9375, 0.75], 0.002);
}

fn a_mode_from_outside_is_drawn_and_its_faults_are_told_by_line(gpu: &Gpu) {
    let own = |text, reads_fabric| Mode::Own(OwnMode { name: "own", text, reads_fabric });
    let mut drawing = square(-1.0, 1.0, Vec3::Z, Vec3::X);
    drawing.fabrics = vec![table(Symmetry::One, Azimuth::Transported, |_, _| [0.5, 0.25, 1.0])];
    let flat = "#import color\n#import surface\n@fragment\n\
                fn fragment_main(surface: Surface) -> @location(0) vec4<f32> {\n\
                return opaque(vec3<f32>(0.25, 0.5, surface.uv.x * 0.0)); }";
    assert_near(middle(gpu, &drawing, &view(), &shading(own(flat, false))), [0.25, 0.5, 0.0], 0.002);
    let half = "#import color\n#import surface\n#import table\n@fragment\n\
                fn fragment_main(surface: Surface) -> @location(0) vec4<f32> {\n\
                return opaque(look_up(vec2<f32>(0.0), 0.0) / 2.0); }";
    assert_near(middle(gpu, &drawing, &view(), &shading(own(half, true))), [0.25, 0.125, 0.5], 0.002);
    let fault = render_picture(gpu, &drawing, &view(), &shading(own("#import color\nfn", false)));
    assert!(fault.unwrap_err().to_string().contains("own.wgsl"));
    let taken = Mode::Own(OwnMode { name: "mode_uv", text: flat, reads_fabric: false });
    let fault = render_picture(gpu, &drawing, &view(), &shading(taken));
    assert!(fault.unwrap_err().to_string().contains("mode_uv"));
}

fn a_target_without_srgb_gets_encoded_values(gpu: &Gpu) {
    let mut drawing = square(-1.0, 1.0, Vec3::Z, Vec3::X);
    drawing.fabrics = vec![table(Symmetry::One, Azimuth::Transported, |_, _| [0.5, 0.25, 1.0])];
    let target = TargetFormat {
        color: wgpu::TextureFormat::Rgba8Unorm,
        depth: wgpu::TextureFormat::Depth32Float,
        samples: 1,
    };
    let offscreen = Offscreen::of_format(&gpu.device, 64, 4, target).unwrap();
    let mut renderer = Renderer::new(&gpu.device, &gpu.queue);
    let mut scene = renderer.prepare(&drawing).unwrap();
    let eye = renderer.eye();
    let view = View { width: 64, height: 4, ..view() };
    let frame = renderer.draw_data(&mut scene, &eye, &view, &shading(Mode::Amc), target).unwrap();
    let bytes = offscreen.bytes(gpu, &frame, None).unwrap();
    let middle = &bytes[(2 * 64 + 32) * 4..][..4];
    let expected = [0.5f32, 0.25, 1.0].map(crate::color::srgb8_from_linear);
    assert_eq!(middle[..3], expected);
}

fn a_changed_direction_uploads_only_what_changed(gpu: &Gpu) {
    let along = |phi: f32| Azimuth::Transported.tangent(Vec3::Z, phi);
    let mut drawing = square(-1.0, 0.0, Vec3::Z, along(0.1));
    append(&mut drawing, &square(0.0, 1.0, Vec3::Z, along(0.1)));
    drawing.draws.push(Draw { triangles: 2..4, cloth: Cloth::Fabric(0) });
    drawing.fabrics = vec![table(Symmetry::One, Azimuth::Transported, |_, share| [share, 0.25, 0.5])];
    let mut renderer = Renderer::new(&gpu.device, &gpu.queue);
    let mut scene = renderer.prepare(&drawing).unwrap();
    let (offscreen, eye) = (Offscreen::new(&gpu.device, 16, 16, 1).unwrap(), renderer.eye());
    let picture = |scene: &mut Scene, renderer: &mut Renderer| {
        let target = offscreen.target();
        let frame = renderer.draw_data(scene, &eye, &view(), &shading(Mode::Amc), target).unwrap();
        offscreen.picture(gpu, &frame, None).unwrap()
    };
    let mut turned = |drawing: &Drawing, bytes: u64| {
        assert_eq!(renderer.update(&mut scene, drawing).unwrap(), bytes);
        let seen = picture(&mut scene, &mut renderer);
        let anew = renderer.prepare(drawing).map(|mut scene| picture(&mut scene, &mut renderer));
        assert!(seen == anew.unwrap());
        seen
    };
    let before = turned(&drawing, 0);
    // The right square: its four tangents of twelve bytes.
    let mut tangents = drawing.tangents.to_vec();
    tangents[4..].fill(along(2.0));
    let other = drawing.dressed(tangents, drawing.fabrics.clone(), |_| Cloth::Fabric(0)).unwrap();
    let after = turned(&other, 4 * 12);
    assert!(before.pixel(4, 8) == after.pixel(4, 8) && before.pixel(12, 8) != after.pixel(12, 8));
    // Another fabric and a plain panel: nothing of the mesh.
    let blue = table(Symmetry::One, Azimuth::Transported, |_, _| [0.0, 0.0, 1.0]);
    let cloth = |panel| if panel == 0 { Cloth::Fabric(1) } else { Cloth::Plain };
    let fabrics = vec![Arc::clone(&drawing.fabrics[0]), blue];
    let blue = turned(&other.dressed(other.tangents.to_vec(), fabrics, cloth).unwrap(), 0);
    assert_eq!(blue.pixel(4, 8), [0.0, 0.0, 1.0, 1.0]);
    // Another mesh: all of it.
    turned(
        &square(-1.0, 1.0, Vec3::Z, along(1.0))
            .dressed(vec![along(1.0); 4], vec![], |_| Cloth::Plain)
            .unwrap(),
        4 * (40 + 12) + 24,
    );
    // Two at once: each keeps its own directions.
    let mut one = renderer.prepare(&drawing).unwrap();
    let mut two = renderer.prepare_beside(&one, &other).unwrap();
    assert!(picture(&mut two, &mut renderer) == after && picture(&mut one, &mut renderer) == before);
}

fn impossible_requests_are_refused(gpu: &Gpu) {
    let drawing = square(-1.0, 1.0, Vec3::Z, Vec3::X);
    let says = |drawing: &Drawing, view: &View, shading: &Shading| {
        render_picture(gpu, drawing, view, shading).unwrap_err().to_string()
    };
    let amc = shading(Mode::Amc);
    assert!(says(&drawing, &view(), &amc).contains("panel 0: fabric 0"));
    let beyond = Drawing { triangles: vec![[0, 1, 4], [0, 2, 3]].into(), ..drawing.clone() };
    assert!(says(&beyond, &view(), &amc).contains("triangle 0: refers to a vertex"));
    let plain = Drawing { draws: vec![Draw { triangles: 0..3, cloth: Cloth::Plain }], ..drawing };
    assert!(says(&plain, &view(), &amc).contains("panel 0: triangles 0 to 3"));
    let empty = Drawing::default();
    assert!(says(&empty, &View { width: 0, ..view() }, &amc).contains("0 x 16"));
    assert!(says(&empty, &View { width: 1 << 20, ..view() }, &amc).contains("x 16"));
    assert!(says(&empty, &view(), &Shading { samples: 3, ..amc.clone() }).contains("1 or 4"));
    let nothing = render_picture(gpu, &empty, &view(), &amc).unwrap();
    assert!(nothing.pixels().iter().all(|pixel| *pixel == [0.0; 4]));
}
