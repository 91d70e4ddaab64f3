use std::f32::consts::{FRAC_PI_2, PI};

use glam::Quat;

use super::*;
use crate::mesh::{Garment, Mesh, Panel, Part};
use crate::shape;

/// A garment with one panel per mesh, as it is.
pub(crate) fn garment_of(meshes: &[Mesh]) -> Garment {
    let mut garment = Garment { has_uvs: true, ..Garment::default() };
    for (index, mesh) in meshes.iter().enumerate() {
        let (first, start) = (garment.positions.len() as u32, garment.triangles.len() as u32);
        garment.positions.extend(&mesh.positions);
        garment.normals.extend(&mesh.normals);
        match &mesh.uvs {
            Some(uvs) => garment.uvs.extend(uvs),
            None => garment.has_uvs = false,
        }
        garment.triangles.extend(mesh.triangles.iter().map(|t| t.map(|corner| corner + first)));
        garment.panels.push(Panel {
            id: format!("id{index}"),
            name: mesh.parts.first().map_or("none", |part: &Part| &part.name).to_owned(),
            triangles: start..garment.triangles.len() as u32,
            takes_fabric: true,
            area: 0.0,
            flags: Default::default(),
            pattern: Default::default(),
        });
    }
    if !garment.has_uvs {
        garment.uvs = vec![Vec2::ZERO; garment.positions.len()];
    }
    garment
}

/// A flat uneven grid of 6 x 6 cells, turned by `tilt`; `to_uv` gives the UVs.
pub(crate) fn flat(tilt: Quat, to_uv: impl Fn(Vec2) -> Vec2) -> Mesh {
    grid(tilt, 0.05, to_uv)
}

/// [`flat`], its corners shaken in the plane by up to 6 `shake`.
fn grid(tilt: Quat, shake: f32, to_uv: impl Fn(Vec2) -> Vec2) -> Mesh {
    let mut mesh = Mesh { uvs: Some(Vec::new()), ..Mesh::default() };
    for j in 0..7u32 {
        for i in 0..7u32 {
            let shake = Vec2::new(((i * 7 + j * 13) % 5) as f32, ((i * 11 + j * 3) % 7) as f32) * shake;
            let p = Vec2::new(i as f32, j as f32) + shake;
            mesh.positions.push(tilt * p.extend(0.0));
            mesh.normals.push(tilt * Vec3::Z);
            mesh.uvs.as_mut().unwrap().push(to_uv(p));
            if i < 6 && j < 6 {
                let k = j * 7 + i;
                mesh.triangles.extend([[k, k + 1, k + 8], [k, k + 8, k + 7]]);
            }
        }
    }
    mesh
}

pub(crate) fn degrees_between(a: Vec3, b: Vec3) -> f32 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

fn one(source: Source, angle: f32) -> [Direction; 1] {
    [Direction { source, angle }]
}

fn tilt() -> Quat {
    Quat::from_euler(glam::EulerRot::XYZ, 0.4, -0.7, 1.1)
}

#[test]
fn a_sheared_stretched_sheet_has_the_gradients_and_yarns_of_its_map() {
    // The columns are dP/du and dP/dv; the second map is mirrored.
    for columns in [[0.8, 0.1, 0.5, 1.7], [0.8, 0.1, 0.5, -1.7]] {
        let map = Mat2::from_cols_array(&columns);
        let (x, y) = (map.x_axis, map.y_axis);
        let garment = garment_of(&[flat(tilt(), |p| map.inverse() * p)]);
        // Duality: grad u . dP/du = 1, grad u . dP/dv = 0, and the other way round.
        let (grad_u, grad_v) = (y.perp() / y.perp().dot(x), x.perp() / x.perp().dot(y));
        for degrees in [0.0f32, 30.0, 45.0, 90.0, 137.5, 180.0, -60.0, 400.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            for (source, expected) in
                [(Source::Gradient, grad_u * cos + grad_v * sin), (Source::Yarn, x * cos + y * sin)]
            {
                let got = tangents(&garment, &one(source, degrees.to_radians())).unwrap();
                assert_eq!((&got.filled[..], &got.made_up[..]), (&[0][..], &[false][..]));
                let expected = tilt() * expected.extend(0.0);
                for &t in got.vectors.iter() {
                    assert!((t.length() - 1.0).abs() < 1e-5);
                    assert!(degrees_between(t, expected) < 0.01, "{source:?} {degrees}: {t} for {expected}");
                }
            }
        }
    }
}

#[test]
fn a_quarter_turn_is_counter_clockwise_in_the_pattern_so_clockwise_on_a_mirrored_panel() {
    for (mirror, side) in [(1.0, 1.0), (-1.0, -1.0)] {
        let garment = garment_of(&[flat(tilt(), |p| Vec2::new(p.x * mirror, p.y))]);
        for source in [Source::Gradient, Source::Yarn] {
            let warp = tangents(&garment, &one(source, 0.0)).unwrap();
            let weft = tangents(&garment, &one(source, FRAC_PI_2)).unwrap();
            for ((warp, weft), normal) in warp.vectors.iter().zip(weft.vectors.iter()).zip(&garment.normals) {
                assert!(degrees_between(*warp, tilt() * Vec3::X * mirror) < 0.01);
                assert!(degrees_between(*weft, normal.cross(*warp) * side) < 0.01);
            }
        }
    }
}

#[test]
fn triangles_count_by_their_angle_not_by_their_number() {
    // Left of x = 0 grad U is (1, 1), right of it (-1, 1): both sides span half a turn about the origin, in two and in
    // eight triangles, so the mean is +y.
    let mut mesh = Mesh { uvs: Some(vec![]), ..Mesh::default() };
    let angles =
        (0..=2).map(|k| PI / 2.0 + k as f32 * PI / 2.0).chain((1..8).map(|k| k as f32 * PI / 8.0 - PI / 2.0));
    let rim: Vec<Vec2> = angles.map(Vec2::from_angle).collect();
    for p in [Vec2::ZERO].into_iter().chain(rim) {
        mesh.positions.push(p.extend(0.0));
        mesh.normals.push(Vec3::Z);
        mesh.uvs.as_mut().unwrap().push(Vec2::new(p.y - p.x.abs(), -p.x));
    }
    mesh.triangles = (1..=10).map(|k| [0, k, k % 10 + 1]).collect();
    let got = tangents(&garment_of(&[mesh]), &one(Source::Gradient, 0.0)).unwrap();
    assert!(degrees_between(got.vectors[0], Vec3::Y) < 0.01, "{}", got.vectors[0]);
}

#[test]
fn the_shapes_have_the_grain_their_names_promise() {
    type Grain = fn(Vec3) -> Vec3;
    let circles: Grain = |p| Vec3::Z.cross(p);
    let parallels: Grain = |p| Vec3::Y.cross(p);
    let around_the_tube: Grain = |p| {
        let out = p.with_z(0.0).normalize_or_zero();
        Vec3::Z.cross(out).cross(out * 0.7 - p)
    };
    let outwards: Grain = |p| p;
    let grains = [
        ("sphere", parallels),
        ("torus", circles),
        ("torus-poloidal", around_the_tube),
        ("disc-circular", circles),
        ("disc-radial", outwards),
        ("cylinder", parallels),
    ];
    for (name, grain) in grains {
        let garment = garment_of(&[shape::mesh(name).unwrap()]);
        for source in [Source::Gradient, Source::Yarn] {
            let got = tangents(&garment, &one(source, 0.0)).unwrap();
            assert_eq!(got.filled, [0], "{name}");
            let mut off: Vec<f32> = Vec::new();
            for (&p, &t) in garment.positions.iter().zip(got.vectors.iter()) {
                let expected = grain(p);
                // Poles have a test of their own.
                if expected.length() > 1e-4 {
                    off.push(degrees_between(t, expected));
                }
            }
            off.sort_by(f32::total_cmp);
            assert!(off.len() + 512 >= garment.positions.len());
            // A seam's vertex sees one side only: about half a column's turn, 1.5 degrees at most.
            let (most, all) = (off[off.len() * 98 / 100], off[off.len() - 1]);
            assert!(most < 0.5 && all < 1.1, "{name} {source:?}: {most} and {all} degrees off");
        }
    }
}

#[test]
fn every_cell_at_a_pole_has_its_own_direction_there() {
    let garment = garment_of(&[shape::mesh("sphere").unwrap()]);
    let got = tangents(&garment, &one(Source::Gradient, 0.0)).unwrap();
    let mut seen = 0;
    for triangle in &garment.triangles {
        let Some(pole) = triangle.iter().find(|&&k| garment.positions[k as usize].y.abs() == 1.0) else {
            continue;
        };
        let middle: Vec3 = triangle.iter().map(|&k| garment.positions[k as usize]).sum();
        assert!(degrees_between(got.vectors[*pole as usize], Vec3::Y.cross(middle)) < 0.01);
        seen += 1;
    }
    assert_eq!(seen, 512);
}

#[test]
fn fields_are_exact_and_their_zeros_are_filled() {
    let garment = garment_of(&[shape::mesh("sphere").unwrap()]);
    let around = Field::Around { origin: Vec3::new(0.0, 5.0, 0.0), direction: Vec3::Y * 3.0 };
    for angle in [0.0f32, 0.6] {
        let got = tangents(&garment, &one(Source::Field(around), angle)).unwrap();
        // The poles, one vertex per column, are the field's zeros.
        assert_eq!((&got.filled[..], &got.made_up[..]), (&[512][..], &[false][..]));
        for ((&p, &n), &t) in garment.positions.iter().zip(&garment.normals).zip(got.vectors.iter()) {
            assert!((t.length() - 1.0).abs() < 1e-5 && t.dot(n).abs() < 1e-5);
            let east = Vec3::Y.cross(p).normalize_or_zero();
            let expected = east * angle.cos() + n.cross(east) * angle.sin();
            assert!(p.y.abs() == 1.0 || degrees_between(t, expected) < 0.01);
        }
    }
    let along = Source::Field(Field::Along { direction: Vec3::new(0.0, -2.0, 0.0) });
    let got = tangents(&garment, &one(along, 0.0)).unwrap();
    for (&p, &t) in garment.positions.iter().zip(got.vectors.iter()).filter(|(p, _)| p.y.abs() < 0.999) {
        let south = p * p.y - Vec3::Y;
        assert!(degrees_between(t, south) < 0.01);
    }
    // From the centre a sphere's radial field runs along the normals everywhere: all is made up.
    let radial = Source::Field(Field::Radial { origin: Vec3::ZERO });
    let got = tangents(&garment, &one(radial, 0.0)).unwrap();
    assert_eq!((got.filled[0] as usize, got.made_up[0]), (garment.positions.len(), true));
    let got = tangents(&garment_of(&[shape::mesh("disc-circular").unwrap()]), &one(radial, 0.0)).unwrap();
    assert_eq!((got.filled[0], got.made_up[0]), (256, false));
}

#[test]
fn panels_do_not_mix() {
    let turn = Mat2::from_angle(1.0);
    let garment = garment_of(&[flat(tilt(), |p| p), flat(tilt(), |p| turn * p)]);
    let directions = [Direction::default(), Direction { source: Source::Yarn, angle: 0.5 }];
    let got = tangents(&garment, &directions).unwrap();
    let (first, second) = got.vectors.split_at(49);
    assert!(first.iter().all(|&t| degrees_between(t, tilt() * Vec3::X) < 0.01));
    let expected = tilt() * Vec2::from_angle(0.5 - 1.0).extend(0.0);
    assert!(second.iter().all(|&t| degrees_between(t, expected) < 0.01));
}

#[test]
fn degenerate_uvs_are_filled_from_the_neighbours_of_the_same_panel() {
    // All that lies right of x = 2.5 has one and the same UV, far from zero, where rounding leaves false areas.
    let collapse = |p: Vec2| if p.x < 2.5 { p + 100.0 } else { Vec2::new(103.1, 107.7) };
    let turned = Mat2::from_angle(1.0);
    let garment = garment_of(&[flat(tilt(), collapse), flat(tilt(), |p| turned * p)]);
    let got = tangents(&garment, &[Direction::default(); 2]).unwrap();
    // Columns 4, 5 and 6 touch only triangles without UV area, and so does the first vertex of column 3.
    assert_eq!((&got.filled[..], &got.made_up[..]), (&[22, 0][..], &[false, false][..]));
    for row in 0..7 {
        let row = &got.vectors[row * 7..row * 7 + 7];
        assert!(row.iter().all(|t| (t.length() - 1.0).abs() < 1e-5));
        // Columns 0 and 1 see clean triangles only.
        assert!(row[..2].iter().all(|&t| degrees_between(t, tilt() * Vec3::X) < 0.01));
        assert!(row[4..].iter().all(|&t| degrees_between(t, row[3]) < 60.0));
    }
}

#[test]
fn filling_carries_a_constant_direction_across_any_number_of_rings() {
    // Above the third row v stands still, so no triangle there has UV area.
    let garment = garment_of(&[grid(tilt(), 0.0, |p| Vec2::new(p.x, p.y.min(2.0)))]);
    for source in [Source::Gradient, Source::Yarn] {
        let got = tangents(&garment, &one(source, 0.3)).unwrap();
        assert_eq!((&got.filled[..], &got.made_up[..]), (&[28][..], &[false][..]));
        let expected = tilt() * Vec2::from_angle(0.3).extend(0.0);
        assert!(got.vectors.iter().all(|&t| degrees_between(t, expected) < 0.01));
    }
}

#[test]
fn filling_crosses_a_crease() {
    // Two halves of one panel whose normals differ, so that the vertices between them are doubled.
    let (mut left, mut right) =
        (grid(Quat::IDENTITY, 0.0, |p| p), grid(Quat::IDENTITY, 0.0, |p| Vec2::new(6.0, p.y)));
    left.normals = vec![Vec3::new(-0.6, 0.0, 0.8); 49];
    right.normals = vec![Vec3::new(0.6, 0.0, 0.8); 49];
    right.positions.iter_mut().for_each(|p| p.x += 6.0);
    let mut garment = garment_of(&[left, right]);
    garment.panels.pop();
    garment.panels[0].triangles.end *= 2;
    let got = tangents(&garment, &one(Source::Gradient, FRAC_PI_2)).unwrap();
    assert_eq!((&got.filled[..], &got.made_up[..]), (&[49][..], &[false][..]));
    assert!(got.vectors.iter().all(|&t| degrees_between(t, Vec3::Y) < 0.01));
}

#[test]
fn a_panel_without_uvs_runs_along_y_and_a_level_one_along_x() {
    let mut standing = flat(Quat::from_rotation_x(0.5), |p| p);
    standing.uvs = None;
    let got = tangents(&garment_of(&[standing]), &one(Source::Gradient, 0.0)).unwrap();
    assert_eq!((got.filled[0], got.made_up[0]), (49, true));
    assert!(got.vectors.iter().all(|&t| degrees_between(t, Quat::from_rotation_x(0.5) * Vec3::Y) < 0.01));
    let mut level = flat(Quat::from_rotation_x(-FRAC_PI_2), |p| p);
    level.uvs = None;
    let got = tangents(&garment_of(&[level]), &one(Source::Yarn, 0.0)).unwrap();
    assert!(got.vectors.iter().all(|&t| degrees_between(t, Vec3::X) < 0.01));
}

#[test]
fn tiny_and_huge_garments_have_directions_too() {
    for scale in [1e-6, 1e6] {
        let mut mesh = flat(tilt(), |p| p * scale);
        mesh.positions.iter_mut().for_each(|p| *p *= scale);
        let got = tangents(&garment_of(&[mesh]), &one(Source::Gradient, 0.0)).unwrap();
        assert_eq!(got.filled, [0]);
        assert!(got.vectors.iter().all(|&t| degrees_between(t, tilt() * Vec3::X) < 0.05));
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let mut garment = garment_of(&[flat(tilt(), |p| p)]);
    let refused =
        |garment: &Garment, directions: &[Direction]| tangents(garment, directions).unwrap_err().to_string();
    assert!(refused(&garment, &[]).contains("0 directions for 1 panels"));
    assert!(refused(&garment, &one(Source::Yarn, f32::NAN)).contains("id0"));
    let axis = Source::Field(Field::Along { direction: Vec3::ZERO });
    assert!(refused(&garment, &one(axis, 0.0)).contains("no length"));
    garment.triangles[3][1] = 49;
    assert!(refused(&garment, &one(Source::Yarn, 0.0)).contains("not there"));
}

#[test]
fn a_direction_runs_on_the_cloth_as_it_does_on_the_surface_and_is_found_again() {
    let scale = Vec2::new(0.02, 0.1);
    let tilt = Quat::from_rotation_x(0.4);
    let garment = garment_of(&[flat(tilt, |p| p * scale)]);
    let metres = garment.uv_to_metres(&garment.panels[0]).unwrap().matrix2;
    for source in [Source::Gradient, Source::Yarn] {
        for angle in [0.0, 0.4, FRAC_PI_2, 2.5, -1.2] {
            let direction = Direction { source, angle };
            let on_cloth = direction.on_cloth(metres);
            let on_surface = tangents(&garment, &[direction]).unwrap().vectors[24];
            assert!((tilt * on_cloth.extend(0.0) - on_surface).length() < 1e-4, "{source:?} {angle}");
            let again = Direction::along_cloth(source, on_cloth, metres);
            assert!((again.angle - angle).abs() < 1e-5 && again.source == source);
        }
    }
}
