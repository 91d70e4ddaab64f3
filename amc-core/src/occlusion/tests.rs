use std::f32::consts::PI;
use std::sync::atomic::AtomicBool;

use glam::{Quat, Vec2};

use super::*;
use crate::direction::tests::{flat, garment_of};
use crate::mesh::Mesh;
use crate::shape;

const MANY: Options = Options { rays: 1024 };

/// On the side of the normal.
fn open_by(rays: u32, meshes: &[Mesh]) -> Vec<f32> {
    both_sides(rays, meshes).into_iter().map(|open| open.x).collect()
}

fn both_sides(rays: u32, meshes: &[Mesh]) -> Vec<Vec2> {
    compute(&garment_of(meshes), Options { rays }, &Progress::none()).unwrap()
}

/// Two triangles over the corners, counter-clockwise from the front, with their own normal.
fn quad(corners: [Vec3; 4]) -> Mesh {
    let [a, b, _, d] = corners;
    Mesh {
        positions: corners.to_vec(),
        normals: vec![(b - a).cross(d - a).normalize_or_zero(); 4],
        uvs: Some(vec![Vec2::ZERO; 4]),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

/// The sphere of radius 1 seen from inside, without what lies above `latitude`.
fn bowl(latitude: f32) -> Mesh {
    let mut mesh = shape::mesh("sphere").unwrap();
    mesh.normals.iter_mut().for_each(|n| *n = -*n);
    mesh.triangles.retain(|t| t.iter().all(|&k| mesh.positions[k as usize].y < latitude.sin() + 1e-4));
    mesh
}

#[test]
fn a_plane_and_a_ball_see_all_of_the_sky() {
    let tilted = flat(Quat::from_rotation_x(1.0), |p| p);
    assert!(open_by(1024, &[tilted]).iter().all(|&open| open == 1.0));
    let mut ball = shape::mesh("sphere").unwrap();
    ball.positions.iter_mut().for_each(|p| *p = *p * 1e-3 + 7.0);
    assert!(open_by(16, &[ball]).iter().all(|&open| open > 0.99));
}

#[test]
fn a_dome_of_equal_triangles_sees_all_of_the_sky() {
    // The middle of a vertex's triangles lies straight below it, in the cloth.
    let mut dome = Mesh { uvs: Some(vec![Vec2::ZERO; 21 * 21]), ..Mesh::default() };
    let radius = 30.0f32;
    for (i, j) in (0..21u32).flat_map(|j| (0..21).map(move |i| (i, j))) {
        let at = Vec2::new(i as f32 + 0.5 * j as f32 - 15.0, 0.75f32.sqrt() * (j as f32 - 10.0));
        let point = at.extend((radius * radius - at.length_squared()).sqrt());
        dome.positions.push(point);
        dome.normals.push(point / radius);
        if i < 20 && j < 20 {
            let a = 21 * j + i;
            dome.triangles.extend([[a, a + 1, a + 21], [a + 1, a + 22, a + 21]]);
        }
    }
    let open = open_by(256, &[dome]);
    assert!(open.iter().all(|&open| open == 1.0), "{open:?}");
}

#[test]
fn each_side_of_a_ball_sees_its_own_sky() {
    let ball = shape::mesh("sphere").unwrap();
    // Now and then a ray slips through between two triangles.
    let open = both_sides(64, &[ball]);
    assert!(open.iter().all(|open| open.x > 0.99 && open.y < 0.02), "{open:?}");
    // A sheet alone hides nothing from either side.
    let sheet = flat(Quat::from_rotation_x(1.0), |p| p);
    assert!(both_sides(64, &[sheet]).iter().all(|&open| open == Vec2::ONE));
}

#[test]
fn inside_a_closed_box_there_is_no_sky() {
    let sides = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z].map(|side| {
        let (right, up) = side.any_orthonormal_pair();
        // Seen from inside.
        quad([side - right - up, side - right + up, side + right + up, side + right - up])
    });
    assert!(open_by(1024, &sides).iter().all(|&open| open == 0.0), "{:?}", open_by(1024, &sides));
    // The sphere from inside, its normals smooth.
    assert!(open_by(16, &[bowl(PI / 2.0)]).iter().all(|&open| open == 0.0));
}

#[test]
fn a_wall_blocks_half_of_the_sky_at_its_foot_and_less_further_off() {
    // In the plane across a long wall the rays from the ground to the wall's upper edge, at the elevation b, are
    // blocked: a share of (1 - cos b) / 2, half where b is a quarter turn.
    let wall = quad([
        Vec3::new(0.0, 0.0, -300.0),
        Vec3::new(0.0, 3.0, -300.0),
        Vec3::new(0.0, 3.0, 300.0),
        Vec3::new(0.0, 0.0, 300.0),
    ]);
    let mut ground = Mesh { uvs: Some(Vec::new()), ..Mesh::default() };
    for k in 0..12 {
        for z in [0.5, -0.5] {
            ground.positions.push(Vec3::new(k as f32, 0.0, z));
            ground.normals.push(Vec3::Y);
            ground.uvs.as_mut().unwrap().push(Vec2::ZERO);
        }
        if k > 0 {
            let a = 2 * (k - 1);
            ground.triangles.extend([[a, a + 2, a + 3], [a, a + 3, a + 1]]);
        }
    }
    let open = open_by(1024, &[wall, ground]);
    for k in 0..12 {
        let elevation = 3.0f32.atan2(k as f32);
        let expected = (1.0 + elevation.cos()) / 2.0;
        for open in &open[4 + 2 * k..6 + 2 * k] {
            assert!((open - expected).abs() < 0.012, "{k} m off: {open} for {expected}");
        }
    }
}

#[test]
fn from_the_inside_of_a_sphere_an_opening_looks_the_same_from_everywhere() {
    // The form factor between any two patches of a sphere's inside is their area over the whole: the open share is
    // that of the missing cap, (1 - sin latitude) / 2, at every vertex.
    let latitude = PI / 2.0 * 44.0 / 64.0 - PI / 8.0;
    let mesh = bowl(latitude);
    let used: std::collections::HashSet<u32> = mesh.triangles.iter().flatten().copied().collect();
    let open = open_by(32, &[mesh]);
    let expected = (1.0 - latitude.sin()) / 2.0;
    let off: Vec<f32> = used.iter().map(|&k| open[k as usize] - expected).collect();
    let mean = off.iter().sum::<f32>() / off.len() as f32;
    let spread = (off.iter().map(|off| off * off).sum::<f32>() / off.len() as f32).sqrt();
    assert!(mean.abs() < 0.01 && spread < 0.05, "{expected}: off by {mean}, spread {spread}");
}

#[test]
fn through_a_hole_overhead_one_sees_the_sine_squared_of_its_half_angle() {
    let hole = 40.0f32.to_radians();
    // A dome that reaches down to the horizon, and a patch at its centre.
    let mut dome = shape::mesh("sphere").unwrap();
    dome.positions.iter_mut().for_each(|p| *p *= 10.0);
    dome.triangles.retain(|t| t.iter().all(|&k| dome.normals[k as usize].y < hole.cos()));
    let rim = dome.triangles.iter().flatten().map(|&k| dome.normals[k as usize].y).fold(0.0, f32::max);
    let patch = quad([
        Vec3::new(-0.01, 0.0, -0.01),
        Vec3::new(-0.01, 0.0, 0.01),
        Vec3::new(0.01, 0.0, 0.01),
        Vec3::new(0.01, 0.0, -0.01),
    ]);
    let scene = Scene::new(&garment_of(&[patch, dome]));
    let samples = samples(4096);
    let open: Vec<f32> = (0..4).map(|k| scene.open_sky(scene.origins[k][0], Vec3::Y, &samples)).collect();
    let expected = 1.0 - rim * rim;
    assert!(open.iter().all(|open| (open - expected).abs() < 0.005), "{open:?} for {expected}");
}

#[test]
fn odd_garments_are_measured_and_wrong_ones_refused() {
    assert!(open_by(8, &[]).is_empty());
    let point = quad([Vec3::ONE; 4]);
    assert_eq!(open_by(8, &[point]).len(), 4);
    let mut garment = garment_of(&[quad([Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y])]);
    let refused = |garment: &Garment, rays| compute(garment, Options { rays }, &Progress::none()).is_err();
    assert!(refused(&garment, 0) && refused(&garment, MOST_RAYS + 1) && !refused(&garment, 1));
    garment.triangles[0][0] = 4;
    assert!(refused(&garment, 1));
    garment.triangles[0][0] = 0;
    garment.positions[0].x = f32::NAN;
    assert!(refused(&garment, 1));
}

#[test]
fn it_stops_when_asked_to() {
    let (cancelled, report) = (AtomicBool::new(true), |_: crate::Step<'_>| {});
    let progress = Progress::new(&report, &cancelled);
    let garment = garment_of(&[shape::mesh("sheet").unwrap()]);
    assert!(compute(&garment, Options::default(), &progress).unwrap_err().is_cancelled());
}

#[test]
fn the_cache_gives_the_same_and_mends_itself() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().join("made");
    let garment = garment_of(&[flat(Quat::IDENTITY, |p| p), flat(Quat::from_rotation_y(1.0), |p| p)]);
    let get = |options| cached(&garment, options, &folder, &Progress::none()).unwrap();
    let files =
        || -> Vec<_> { std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect() };
    let first = get(MANY);
    assert!(first.iter().any(|open| open.x < 0.9));
    assert_eq!((first == get(MANY), files().len()), (true, 1));
    // Valid content under this name is believed: it is not computed again.
    let zeros = vec![0u8; first.len() * 8];
    let forged = [&b"AMCOCC02"[..], blake3::hash(&zeros).as_bytes(), &zeros].concat();
    let path = &files()[0];
    let good = std::fs::read(path).unwrap();
    crate::file::save_bytes(path, &forged).unwrap();
    assert!(get(MANY).iter().all(|&open| open == Vec2::ZERO));
    let mut flipped = good.clone();
    flipped[60] ^= 1;
    for damaged in [&good[..20], &good[..good.len() - 4], &flipped, &[good.clone(), vec![0]].concat()] {
        crate::file::save_bytes(path, damaged).unwrap();
        assert_eq!(get(MANY), first);
        assert_eq!(std::fs::read(path).unwrap(), good);
    }
    get(Options { rays: 16 });
    assert_eq!(files().len(), 2);
}
