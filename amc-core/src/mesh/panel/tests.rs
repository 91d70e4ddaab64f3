use super::*;
use crate::mesh::uv_area;

/// Two squares of two triangles each, side by side in space, over the given UVs; vertices shared along the middle.
fn strip(uvs: [[f32; 2]; 6]) -> Mesh {
    let positions: Vec<Vec3> = (0..6).map(|i| Vec3::new((i % 3) as f32, (i / 3) as f32, 0.0)).collect();
    Mesh {
        normals: vec![Vec3::Z; 6],
        uvs: Some(uvs.map(Vec2::from).to_vec()),
        triangles: vec![[0, 1, 4], [1, 2, 5], [0, 4, 3], [1, 5, 4]],
        triangle_parts: vec![0; 4],
        parts: vec![Part { name: "strip".into(), takes_fabric: true, ..Part::default() }],
        file_vertices: 6,
        positions,
        notices: Vec::new(),
    }
}

const UPRIGHT: [[f32; 2]; 6] = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 1.0]];
const FOLDED: [[f32; 2]; 6] = [[0.0, 0.0], [1.0, 0.0], [0.2, 0.0], [0.0, 1.0], [1.0, 1.0], [0.2, 1.0]];

fn assert_vertices_have_one_class(garment: &Garment) {
    let mut class = vec![None; garment.positions.len()];
    for (index, panel) in garment.panels.iter().enumerate() {
        for &triangle in &garment.triangles[panel.triangles.start as usize..panel.triangles.end as usize] {
            let mirrored = uv_area(triangle.map(|i| garment.uvs[i as usize])) < 0.0;
            for vertex in triangle {
                let seen = class[vertex as usize].get_or_insert((index, mirrored));
                assert_eq!(*seen, (index, mirrored));
            }
        }
    }
    assert!(class.iter().all(Option::is_some), "a vertex that nobody uses");
}

#[test]
fn an_upright_strip_is_one_panel_and_stays_as_it_is() {
    let mesh = strip(UPRIGHT);
    let garment = Garment::new(mesh.clone()).unwrap();
    assert_eq!((garment.panels.len(), &garment.triangles), (1, &mesh.triangles));
    let panel = &garment.panels[0];
    assert_eq!((panel.id.as_str(), panel.name.as_str(), panel.area), ("strip", "strip", 2.0));
    assert_eq!(panel.flags, PanelFlags::default());
    let distortion = garment.distortion();
    assert!(distortion.len() == 1 && (distortion[0].stretch.p95 - 1.0).abs() < 1e-6);
}

#[test]
fn where_the_uv_map_folds_vertices_are_doubled_within_one_panel() {
    let garment = Garment::new(strip(FOLDED)).unwrap();
    assert_eq!((garment.panels.len(), garment.positions.len()), (1, 8));
    assert_vertices_have_one_class(&garment);
}

#[test]
fn triangles_without_uv_area_follow_their_neighbours() {
    let mut mesh = strip(FOLDED);
    // The first square collapses to a line: its triangles go with the mirrored square.
    let uvs = mesh.uvs.as_mut().unwrap();
    (uvs[0], uvs[3]) = (Vec2::new(1.0, 0.2), Vec2::new(1.0, 0.8));
    let garment = Garment::new(mesh).unwrap();
    assert_eq!((garment.panels.len(), garment.positions.len()), (1, 6));
    assert!(garment.panels[0].flags.degenerate);
}

#[test]
fn parts_cut_and_panels_stand_together() {
    let mut mesh = strip(UPRIGHT);
    mesh.parts = vec![
        Part { name: "left".into(), takes_fabric: true, ..Part::default() },
        Part { name: "buttons".into(), takes_fabric: false, ..Part::default() },
    ];
    mesh.triangle_parts = vec![1, 0, 1, 0];
    let garment = Garment::new(mesh).unwrap();
    assert_eq!(garment.positions.len(), 8);
    assert_vertices_have_one_class(&garment);
    let told: Vec<_> =
        garment.panels.iter().map(|p| (p.id.as_str(), p.triangles.clone(), p.takes_fabric)).collect();
    assert_eq!(told, [("left", 0..2, true), ("buttons", 2..4, false)]);
}

#[test]
fn without_uvs_each_part_is_one_panel() {
    let mut mesh = strip(UPRIGHT);
    mesh.uvs = None;
    mesh.triangles = vec![[0, 1, 4], [1, 2, 5]];
    mesh.triangle_parts = vec![0; 2];
    let garment = Garment::new(mesh).unwrap();
    assert!(!garment.has_uvs && garment.panels[0].flags.degenerate);
    // Vertex 3 is used by nobody.
    assert_eq!((garment.panels.len(), garment.positions.len(), garment.uvs.len()), (1, 5, 5));
}

#[test]
fn ids_survive_another_order_of_everything() {
    let mut text = String::new();
    let mut vertices = Vec::new();
    // Nine separate squares on a grid of the UV map, of different sizes.
    for k in 0..9 {
        let (x, y, s) = ((k % 3) as f32 * 0.3, (k / 3) as f32 * 0.3, 0.1 + 0.01 * k as f32);
        for [u, v] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            vertices.push([x + s * u, y + s * v]);
        }
    }
    let mut write = |order: &dyn Fn(usize) -> usize, turn: usize, scale: f32| {
        text.clear();
        let mut place = vec![0; 36];
        for i in 0..36 {
            let [u, v] = vertices[order(i)];
            place[order(i)] = i + 1;
            text += &format!("v {} {} 0\nvt {u:.6} {v:.6}\n", u * scale, v * scale);
        }
        text += "g shirt\n";
        for k in 0..9 {
            let square = order(4 * k) / 4;
            let corner = |c: usize| place[4 * square + (c + turn) % 4];
            text +=
                &format!("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", corner(0), corner(1), corner(2), corner(3));
        }
        let garment = Garment::new(crate::mesh::obj::parse(text.as_bytes()).unwrap()).unwrap();
        let mut panels: Vec<_> = garment.panels.into_iter().map(|p| (p.id, p.name)).collect();
        panels.sort();
        panels
    };
    let before = write(&|i| i, 0, 1.0);
    assert_eq!(before.len(), 9);
    assert_eq!(write(&|i| 35 - i, 1, 10.0), before);
}

#[test]
fn arrays_that_do_not_fit_are_refused() {
    let mut short = strip(UPRIGHT);
    short.normals.pop();
    assert!(Garment::new(short).is_err());
    let mut beyond = strip(UPRIGHT);
    beyond.triangles[1][2] = 6;
    assert!(Garment::new(beyond).unwrap_err().to_string().contains("out of range"));
    assert!(Garment::new(Mesh::default()).is_err());
}
