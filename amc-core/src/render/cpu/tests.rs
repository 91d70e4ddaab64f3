//! Whole pictures against closed forms.

use std::f32::consts::TAU;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use glam::{Mat4, Vec2, Vec3};
use half::f16;

use super::render;
use crate::amc::{Amc, Frame, Symmetry, TableSize, Texels};
use crate::color::{linear_from_srgb, srgb_from_linear};
use crate::image::Picture;
use crate::render::{
    Cloth, Cyclic, Draw, Drawing, Mode, Perspective, Projection, Shading, Vertex, View, shade,
};
use crate::view_space::Azimuth;
use crate::{ErrorKind, Progress};

const SIDE: u32 = 64;
const SLICES: u32 = 64;

/// A table that tells where it was read: red is u, green is v, blue a wave along the azimuth.
fn telling_table(symmetry: Symmetry, azimuth: Azimuth) -> Arc<Amc> {
    let size = TableSize::new(SIDE, SLICES).unwrap();
    let texel = |index: u32| {
        let (i, j, s) = (index % SIDE, index / SIDE % SIDE, index / (SIDE * SIDE));
        let at = |k: u32| (k as f32 + 0.5) / SIDE as f32;
        [at(i), at(j), wave(s as f32 / SLICES as f32), 1.0].map(f16::from_f32)
    };
    let texels = (0..SIDE * SIDE * SLICES).map(texel).collect();
    Arc::new(Amc::new(size, Texels::Half(texels), symmetry, azimuth, Frame::Half).unwrap())
}

fn wave(turns: f32) -> f32 {
    0.5 + 0.5 * (turns * TAU).cos()
}

fn drawing(corners: Vec<(Vertex, Vec3)>, triangles: Vec<[u32; 3]>, fabric: Option<Arc<Amc>>) -> Drawing {
    let cloth = if fabric.is_some() { Cloth::Fabric(0) } else { Cloth::Plain };
    let draws = vec![Draw { triangles: 0..triangles.len() as u32, cloth }];
    let (vertices, tangents): (Vec<Vertex>, Vec<Vec3>) = corners.into_iter().unzip();
    Drawing {
        vertices: Arc::new(vertices),
        tangents: Arc::new(tangents),
        triangles: Arc::new(triangles),
        draws,
        fabrics: fabric.into_iter().collect(),
    }
}

/// A parallelogram `origin + u a + v b`, u and v in 0..=1 being its UVs, with one normal and tangent.
fn sheet(origin: Vec3, a: Vec3, b: Vec3, normal: Vec3, tangent: Vec3, fabric: Option<Arc<Amc>>) -> Drawing {
    let vertex = |(u, v): (f32, f32)| {
        let (position, uv) = (origin + a * u + b * v, Vec2::new(u, v));
        (Vertex { position, normal, uv, occlusion: Vec2::splat(0.5) }, tangent)
    };
    let vertices = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(vertex).to_vec();
    drawing(vertices, vec![[0, 1, 2], [0, 2, 3]], fabric)
}

/// One that fills the orthographic view.
fn full_screen(normal: Vec3, tangent: Vec3, fabric: Option<Arc<Amc>>) -> Drawing {
    sheet(Vec3::new(-2.0, -2.0, 0.0), Vec3::X * 4.0, Vec3::Y * 4.0, normal, tangent, fabric)
}

fn orthographic(width: u32, height: u32) -> View {
    let projection = Projection::Orthographic { half_height: 1.0 };
    View {
        object_to_view: Mat4::IDENTITY,
        projection,
        width,
        height,
        near: -2.0,
        far: 2.0,
        shift: Vec2::ZERO,
    }
}

fn perspective(width: u32, height: u32) -> View {
    let projection = Projection::Perspective { fov_y: 1.2 };
    View {
        object_to_view: Mat4::IDENTITY,
        projection,
        width,
        height,
        near: 0.1,
        far: 100.0,
        shift: Vec2::ZERO,
    }
}

/// Where the line of sight through a pixel's centre goes, at depth 1.
fn sight(view: &View, x: u32, y: u32) -> Vec3 {
    let Projection::Perspective { fov_y } = view.projection else { panic!("a perspective view") };
    let (width, height) = (view.width as f32, view.height as f32);
    let slope = (fov_y / 2.0).tan();
    let (right, up) = ((x as f32 + 0.5) * 2.0 / width - 1.0, 1.0 - (y as f32 + 0.5) * 2.0 / height);
    Vec3::new(right * slope * width / height, up * slope, -1.0)
}

fn plainly(mode: Mode) -> Shading {
    Shading { mode, occlusion: false, samples: 1, ..Shading::default() }
}

fn draw(drawing: &Drawing, view: &View, shading: &Shading) -> Picture {
    render(drawing, view, shading, &Progress::none()).unwrap()
}

fn assert_close(pixel: [f32; 4], expected: [f32; 4], tolerance: f32) {
    let near = pixel.iter().zip(expected).all(|(value, wanted)| (value - wanted).abs() <= tolerance);
    assert!(near, "{pixel:?} is not {expected:?}");
}

#[test]
fn a_sheet_across_the_view_shows_the_table_where_its_normal_and_azimuth_are() {
    let n = Vec3::new(0.3, -0.2, 0.87_f32.sqrt());
    for azimuth in [Azimuth::Transported, Azimuth::Projected] {
        for (symmetry, phi) in [(Symmetry::One, 0.7), (Symmetry::Two, -1.9), (Symmetry::Four, 3.0)] {
            let t = azimuth.tangent(n, phi);
            let drawing = full_screen(n, t, Some(telling_table(symmetry, azimuth)));
            let turns = symmetry.order() as f32 * phi / TAU;
            for cyclic in [Cyclic::Naive, Cyclic::Cyclic, Cyclic::Fragment] {
                let shading = Shading { cyclic, ..plainly(Mode::Amc) };
                let picture = draw(&drawing, &orthographic(67, 41), &shading);
                for pixel in picture.pixels() {
                    assert_close(*pixel, [0.65, 0.4, wave(turns), 1.0], 2e-3);
                }
            }
        }
    }
}

#[test]
fn isotropic_and_matcap_pictures_are_looked_up_by_the_normal_alone() {
    let n = Vec3::new(0.3, -0.2, 0.87_f32.sqrt());
    let drawing = full_screen(n, Vec3::X, Some(telling_table(Symmetry::Two, Azimuth::Transported)));
    let isotropic = draw(&drawing, &orthographic(9, 9), &plainly(Mode::Isotropic));
    // The wave's mean over a turn is one half.
    assert_close(isotropic.pixel(4, 4), [0.65, 0.4, 0.5, 1.0], 2e-3);
    // A picture that tells its column and its row from the top.
    let pixels = (0..64).map(|k| [(k % 8) as f32, (k / 8) as f32, 0.0, 1.0]).collect();
    let matcap = Mode::MatCap(Arc::new(Picture::new(8, 8, pixels).unwrap()));
    let picture = draw(&drawing, &orthographic(9, 9), &plainly(matcap));
    assert_close(picture.pixel(4, 4), [0.65 * 8.0 - 0.5, 0.6 * 8.0 - 0.5, 0.0, 1.0], 1e-4);
}

#[test]
fn parts_without_a_fabric_are_grey_and_occlusion_multiplies() {
    let n = Vec3::new(0.6, 0.0, 0.8);
    let drawing = full_screen(n, Vec3::Y, None);
    for mode in [Mode::Amc, Mode::Isotropic] {
        let grey = shade::PLAIN_GREY * (0.3 + 0.7 * 0.8);
        let open = draw(&drawing, &orthographic(4, 4), &plainly(mode.clone()));
        assert_close(open.pixel(1, 1), [grey, grey, grey, 1.0], 1e-6);
        let shading = Shading { occlusion: true, ..plainly(mode) };
        let occluded = draw(&drawing, &orthographic(4, 4), &shading);
        assert_close(occluded.pixel(1, 1), [grey / 2.0, grey / 2.0, grey / 2.0, 1.0], 1e-6);
    }
}

#[test]
fn four_samples_give_an_edge_its_share_in_linear_light() {
    let white = Arc::new(Picture::new(1, 1, vec![[1.0; 4]]).unwrap());
    let table = telling_table(Symmetry::One, Azimuth::Transported);
    // Samples stand at 1/8, 3/8, 5/8 and 7/8 of the pixel across, and down.
    for (covered, share) in [(0.1, 0.0), (0.25, 0.25), (0.5, 0.5), (0.8, 0.75), (0.9, 1.0)] {
        let edge = (5.0 + covered) / 16.0 * 2.0 - 1.0;
        for (a, b) in [(Vec3::X, Vec3::Y), (Vec3::Y, -Vec3::X)] {
            let origin = -a * 2.0 - b * 2.0;
            let drawing = sheet(origin, a * (2.0 + edge), b * 4.0, Vec3::Z, Vec3::X, Some(table.clone()));
            let shading = Shading { samples: 4, ..plainly(Mode::MatCap(white.clone())) };
            let at =
                |picture: &Picture| if a == Vec3::X { picture.pixel(5, 8) } else { picture.pixel(8, 10) };
            let clear = draw(&drawing, &orthographic(16, 16), &shading);
            let colour = if share > 0.0 { 1.0 } else { 0.0 };
            assert_close(at(&clear), [colour, colour, colour, share], 1e-6);
            let shading = Shading { background: Some([0.2, 0.0, 0.4]), ..shading };
            let over = draw(&drawing, &orthographic(16, 16), &shading);
            let mixed = |back: f32| share + back * (1.0 - share);
            assert_close(at(&over), [mixed(0.2), mixed(0.0), mixed(0.4), 1.0], 1e-6);
        }
    }
}

#[test]
fn attributes_are_perspective_correct() {
    let view = perspective(90, 60);
    let (origin, a, b) = (Vec3::new(-3.0, -2.0, -2.0), Vec3::new(6.0, 1.0, -5.0), Vec3::new(0.5, 4.0, -1.0));
    let normal = a.cross(b).try_normalize().unwrap();
    let drawing = sheet(origin, a, b, normal, Vec3::X, None);
    let picture = draw(&drawing, &view, &plainly(Mode::Uv));
    let mut seen = 0;
    for y in 0..view.height {
        for x in 0..view.width {
            let direction = sight(&view, x, y);
            let point = direction * (origin.dot(normal) / direction.dot(normal)) - origin;
            // Coordinates in the plane by the dual basis.
            let u = b.cross(normal).dot(point) / b.cross(normal).dot(a);
            let v = a.cross(normal).dot(point) / a.cross(normal).dot(b);
            let pixel = picture.pixel(x, y);
            if (0.01..0.99).contains(&u) && (0.01..0.99).contains(&v) {
                seen += 1;
                assert_eq!(pixel[3], 1.0);
                let (red, green) = (srgb_from_linear(pixel[0]), srgb_from_linear(pixel[1]));
                // Snapping moves a corner by up to 1/512 pixel.
                assert!((red - u).abs() < 3e-4 && (green - v).abs() < 3e-4, "{red} {u} {green} {v}");
            } else if !(-0.01..1.01).contains(&u) || !(-0.01..1.01).contains(&v) {
                assert_eq!(pixel[3], 0.0);
            }
        }
    }
    assert!(seen > 1000);
}

#[test]
fn ground_that_runs_on_behind_the_eye_ends_at_the_near_plane_and_keeps_its_uvs() {
    let view = View { near: 1.0, ..perspective(64, 64) };
    // One unit below the eye, from 10 units behind it to 30 before.
    let (origin, a, b) = (Vec3::new(-50.0, -1.0, 10.0), Vec3::X * 100.0, Vec3::Z * -40.0);
    let drawing = sheet(origin, a, b, Vec3::Y, Vec3::X, None);
    let picture = draw(&drawing, &view, &plainly(Mode::Uv));
    for y in 0..64 {
        let direction = sight(&view, 32, y);
        // Depth 1 along z at the near plane: the ray meets the ground at depth 1 / -direction.y.
        let depth = 1.0 / -direction.y;
        let pixel = picture.pixel(32, y);
        if depth > 1.02 && depth < 29.0 {
            assert_eq!(pixel[3], 1.0, "row {y} at depth {depth}");
            assert!((srgb_from_linear(pixel[1]) - (10.0 + depth) / 40.0).abs() < 2e-3);
        } else if !(0.98..31.0).contains(&depth) {
            assert_eq!(pixel[3], 0.0, "row {y} at depth {depth}");
        }
    }
}

#[test]
fn a_sheet_far_larger_than_the_picture_is_clipped_without_a_gap() {
    let view = orthographic(64, 48);
    // 4000 pictures wide, turned by 20 degrees.
    let (a, b) = (Vec3::new(940.0, 342.0, 0.0) * 8.0, Vec3::new(-342.0, 940.0, 0.0) * 8.0);
    let picture = draw(&sheet(-(a + b) * 0.4, a, b, Vec3::Z, Vec3::X, None), &view, &plainly(Mode::Uv));
    for pixel in picture.pixels() {
        assert_close(*pixel, [linear_from_srgb(0.4), linear_from_srgb(0.4), pixel[2], 1.0], 1e-3);
    }
}

#[test]
fn the_nearest_is_seen_whatever_the_order_and_the_first_of_equals() {
    let quad = |z: f32, uv: f32| {
        let corners = [(-20.0, -2.0), (20.0, -2.0), (20.0, 2.0), (-20.0, 2.0)];
        corners.map(|(x, y)| {
            let (position, uv) = (Vec3::new(x, y, z), Vec2::splat(uv));
            (Vertex { position, normal: Vec3::Z, uv, occlusion: Vec2::ONE }, Vec3::X)
        })
    };
    let seen = |first: [(Vertex, Vec3); 4], second: [(Vertex, Vec3); 4]| {
        let triangles = vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
        let drawing = drawing([first, second].concat(), triangles, None);
        let picture = draw(&drawing, &orthographic(130, 7), &Shading { samples: 4, ..plainly(Mode::Uv) });
        let reds: Vec<f32> = picture.pixels().iter().map(|pixel| srgb_from_linear(pixel[0])).collect();
        assert!(reds.iter().all(|red| (red - reds[0]).abs() < 1e-4));
        reds[0]
    };
    assert!((seen(quad(0.5, 0.2), quad(-0.5, 0.7)) - 0.2).abs() < 1e-5);
    assert!((seen(quad(-0.5, 0.7), quad(0.5, 0.2)) - 0.2).abs() < 1e-5);
    assert!((seen(quad(0.5, 0.7), quad(0.5, 0.2)) - 0.7).abs() < 1e-5);
}

#[test]
fn cloth_is_two_sided() {
    let n = Vec3::new(0.3, 0.2, -0.87_f32.sqrt());
    let t = Azimuth::Transported.tangent(-n, 0.8);
    let table = telling_table(Symmetry::One, Azimuth::Transported);
    // Seen from behind: its corners run clockwise.
    let drawing = sheet(Vec3::new(2.0, -2.0, 0.0), Vec3::X * -4.0, Vec3::Y * 4.0, n, t, Some(table));
    for cyclic in [Cyclic::Naive, Cyclic::Cyclic, Cyclic::Fragment] {
        let picture = draw(&drawing, &orthographic(8, 8), &Shading { cyclic, ..plainly(Mode::Amc) });
        assert_close(picture.pixel(3, 4), [0.35, 0.4, wave(0.8 / TAU), 1.0], 2e-3);
    }
    let encoded = |direction: Vec3| {
        let [x, y, z] = direction.to_array().map(|value| linear_from_srgb(value / 2.0 + 0.5));
        [x, y, z, 1.0]
    };
    let normals = draw(&drawing, &orthographic(8, 8), &plainly(Mode::Normals));
    assert_close(normals.pixel(3, 4), encoded(-n), 1e-5);
    let tangents = draw(&drawing, &orthographic(8, 8), &plainly(Mode::Tangents));
    assert_close(tangents.pixel(3, 4), encoded(t), 1e-5);
}

#[test]
fn a_front_face_whose_normal_looks_away_shows_the_rim() {
    let table = telling_table(Symmetry::Two, Azimuth::Transported);
    let drawing = full_screen(Vec3::new(0.0, 0.6, -0.8), Vec3::X, Some(table));
    let picture = draw(&drawing, &orthographic(8, 8), &plainly(Mode::Amc));
    // u = 1/2, v = 1: the last row's centre.
    let [red, green, ..] = picture.pixel(2, 2);
    assert!((red - 0.5).abs() < 1e-3 && (green - (1.0 - 0.5 / SIDE as f32)).abs() < 1e-3);
}

#[test]
fn a_plane_seen_in_perspective_is_looked_up_as_each_mode_says() {
    let view = perspective(33, 33);
    let table = telling_table(Symmetry::Two, Azimuth::Transported);
    let drawing =
        sheet(Vec3::new(-9.0, -9.0, -3.0), Vec3::X * 18.0, Vec3::Y * 18.0, Vec3::Z, Vec3::X, Some(table));
    for (x, y) in [(16, 16), (2, 5), (30, 1), (8, 28)] {
        let along = sight(&view, x, y).try_normalize().unwrap();
        let slope = along.truncate() / along.z;
        // Half of the angle between the line of sight and -z: tan(a/2) = sin a / (1 + cos a).
        let tangent_of_half = along.truncate() / (1.0 - along.z);
        let cases = [
            (Perspective::Off, Vec2::ZERO),
            (Perspective::Paper, Vec2::new(-slope.x / slope.x.hypot(1.0), -slope.y / slope.y.hypot(1.0))),
            (Perspective::Full, along.truncate()),
            (Perspective::Half, tangent_of_half / tangent_of_half.length().hypot(1.0)),
        ];
        for (perspective, xy) in cases {
            for mode in [Mode::Amc, Mode::Isotropic] {
                let picture = draw(&drawing, &view, &Shading { perspective, ..plainly(mode) });
                let pixel = picture.pixel(x, y);
                let found = Vec2::new(pixel[0], pixel[1]) * 2.0 - Vec2::ONE;
                assert!((found - xy).length() < 2e-3, "{perspective:?} at {x} {y}: {found} not {xy}");
            }
        }
    }
}

/// A ring of `around` x `across` squares whose tangents run along it.
fn torus(around: u32, across: u32, fabric: Arc<Amc>) -> Drawing {
    let vertex = |k: u32| {
        let angle = (k / across) as f32 * TAU / around as f32;
        let turn = (k % across) as f32 * TAU / across as f32;
        let outwards = Vec3::new(angle.cos(), angle.sin(), 0.0);
        let normal = outwards * turn.cos() + Vec3::Z * turn.sin();
        let position = outwards * 0.65 + normal * 0.3;
        let tangent = Vec3::new(-angle.sin(), angle.cos(), 0.0);
        (Vertex { position, normal, uv: Vec2::ZERO, occlusion: Vec2::ONE }, tangent)
    };
    let squares = (0..around).flat_map(|i| (0..across).map(move |j| (i, j)));
    let triangles = squares.flat_map(|(i, j)| {
        let at = |i: u32, j: u32| (i % around) * across + j % across;
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    drawing((0..around * across).map(vertex).collect(), triangles.collect(), Some(fabric))
}

#[test]
fn naive_interpolation_streaks_and_the_two_others_do_not() {
    for symmetry in [Symmetry::One, Symmetry::Two, Symmetry::Four] {
        for azimuth in [Azimuth::Transported, Azimuth::Projected] {
            for (around, across) in [(24, 12), (96, 48)] {
                let ring = torus(around, across, telling_table(symmetry, azimuth));
                let picture = |cyclic: Cyclic| {
                    draw(&ring, &orthographic(160, 160), &Shading { cyclic, ..plainly(Mode::Amc) })
                };
                let [naive, cyclic, fragment] =
                    [Cyclic::Naive, Cyclic::Cyclic, Cyclic::Fragment].map(picture);
                // In a streak the azimuth runs once through the whole wave, up to 1 away from the truth.
                let streaked = |other: &Picture| {
                    let pairs = other.pixels().iter().zip(fragment.pixels());
                    pairs.filter(|(a, b)| (a[2] - b[2]).abs() > 0.4).count()
                };
                let what = format!("{symmetry:?} {azimuth:?} {around}");
                assert!(streaked(&naive) > 40, "{what}: {} in naive", streaked(&naive));
                assert_eq!(streaked(&cyclic), 0, "{what}");
            }
        }
    }
}

#[test]
fn a_picture_is_the_same_on_any_number_of_threads() {
    let ring = torus(48, 24, telling_table(Symmetry::Two, Azimuth::Transported));
    let picture = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| draw(&ring, &orthographic(201, 131), &Shading::default()))
    };
    assert_eq!(picture(1), picture(3));
}

#[test]
fn what_cannot_be_drawn_is_refused_and_a_cancelled_picture_stops() {
    let sheet = full_screen(Vec3::Z, Vec3::X, None);
    let failed = |drawing: &Drawing, view: &View, shading: &Shading| {
        render(drawing, view, shading, &Progress::none()).unwrap_err().to_string()
    };
    let shading = Shading::default();
    let two = Shading { samples: 2, ..Shading::default() };
    assert!(failed(&sheet, &orthographic(8, 8), &two).contains("2 samples"));
    assert!(failed(&sheet, &orthographic(0, 8), &shading).contains("0 x 8"));
    assert!(failed(&sheet, &orthographic(16_384, 16_384), &shading).contains("16384"));
    let flat = View { far: -2.0, ..orthographic(8, 8) };
    assert!(failed(&sheet, &flat, &shading).contains("far"));
    let mut stray = sheet.clone();
    Arc::make_mut(&mut stray.triangles)[1][2] = 9;
    assert!(failed(&stray, &orthographic(8, 8), &shading).contains("triangle 1"));

    let flag = AtomicBool::new(true);
    let progress = Progress::new(&|_| {}, &flag);
    let stopped = render(&sheet, &orthographic(8, 8), &shading, &progress);
    assert_eq!(stopped.unwrap_err().kind(), ErrorKind::Cancelled);
}

#[test]
fn positions_that_are_no_numbers_or_far_away_draw_nothing_and_do_no_harm() {
    for value in [f32::NAN, f32::INFINITY, 1e30, -1e38] {
        let mut sheet = full_screen(Vec3::Z, Vec3::X, None);
        for vertex in &mut Arc::make_mut(&mut sheet.vertices)[1..] {
            vertex.position *= value;
            vertex.normal *= value;
        }
        for view in [orthographic(40, 30), perspective(40, 30)] {
            let picture = draw(&sheet, &view, &Shading::default());
            assert!(picture.pixels().iter().flatten().all(|value| value.is_finite()));
        }
    }
}
