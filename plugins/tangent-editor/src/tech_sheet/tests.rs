use std::f32::consts::FRAC_PI_4;

use amc_core::direction::Source;
use amc_core::shape;
use glam::Vec2;

use super::*;

/// The cylinder, its warp at 45 degrees, in a fabric with a difficult name.
fn saved(suffix: &str) -> (String, Arc<Garment>) {
    let garment = Arc::new(Garment::new(shape::mesh("cylinder").unwrap()).unwrap());
    let direction = Direction { source: Source::Yarn, angle: FRAC_PI_4 };
    let metres = garment.uv_to_metres(&garment.panels[0]).unwrap().matrix2;
    let direction = Direction::along_cloth(Source::Yarn, Vec2::from_angle(direction.angle), metres);
    let assignment = Assignment { orientation: Orientation::Nap, ..Assignment::default() };
    let said = vec![
        Said { direction, fabric: Some("Silk <& \u{e9}>".to_owned()), assignment };
        garment.panels.len()
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("sheet.{suffix}"));
    save("A \"coat\"", Arc::clone(&garment), &said, &path, &Progress::none()).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    (String::from_utf8_lossy(&bytes).into_owned(), garment)
}

/// The area within a closed line.
fn area(line: &[Vec2]) -> f32 {
    (0..line.len()).map(|k| line[k].perp_dot(line[(k + 1) % line.len()])).sum::<f32>().abs() / 2.0
}

#[test]
fn the_svg_is_to_scale_and_well_formed() {
    let (text, garment) = saved("svg");
    let scale: f32 = text.split("Scale 1:").nth(1).unwrap().split('<').next().unwrap().parse().unwrap();
    let outline =
        text.split("evenodd").next().unwrap().rsplit("d=\"M").next().unwrap().split('Z').next().unwrap();
    let points: Vec<Vec2> = outline
        .split('L')
        .map(|pair| {
            let mut numbers = pair.split_whitespace().map(|number| number.parse::<f32>().unwrap());
            Vec2::new(numbers.next().unwrap(), numbers.next().unwrap()) * scale / 1000.0
        })
        .collect();
    let expected = garment.panels[0].area;
    assert!((area(&points) / expected - 1.0).abs() < 0.01, "{} {expected}", area(&points));
    assert!(text.contains("Silk &lt;&amp; \u{e9}&gt;") && text.contains("A &quot;coat&quot;"));
    assert!(text.contains("45.0") && text.contains("with nap"));
    assert_eq!(text.matches('<').count(), text.matches('>').count());
}

#[test]
fn the_pdf_has_the_words_and_says_where_its_parts_are() {
    let (text, _) = saved("pdf");
    assert!(text.starts_with("%PDF-1.7") && text.trim_end().ends_with("%%EOF"));
    // What is not plain ASCII, as the sign for degrees, is written by the numbers of its letters: here "45.0".
    assert!(text.contains("(with nap)") && text.contains("34352E30"));
    assert_eq!(text.matches(" obj\n").count(), text.matches("endobj").count());
}

#[test]
fn the_dxf_has_the_outline_on_layer_1_and_the_grain_on_layer_7() {
    let (text, garment) = saved("dxf");
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    assert!(lines.len().is_multiple_of(2));
    let pairs: Vec<(u32, &str)> =
        lines.chunks_exact(2).map(|pair| (pair[0].parse().unwrap(), pair[1])).collect();
    // Entities: from each 0 to the next.
    let entities: Vec<&[(u32, &str)]> = pairs.chunk_by(|_, next| next.0 != 0).collect();
    let number = |entity: &[(u32, &str)], code: u32| -> f32 {
        entity.iter().find(|pair| pair.0 == code).unwrap().1.parse().unwrap()
    };
    let on = |entity: &&&[(u32, &str)], kind: &str, layer: &str| {
        entity[0].1 == kind && entity.contains(&(8, layer))
    };
    let outline: Vec<Vec2> = entities
        .iter()
        .filter(|entity| on(entity, "VERTEX", "1"))
        .map(|entity| Vec2::new(number(entity, 10), number(entity, 20)) / 1000.0)
        .collect();
    assert!((area(&outline) / garment.panels[0].area - 1.0).abs() < 0.01);
    let grain = entities.iter().find(|entity| on(entity, "LINE", "7")).unwrap();
    let along = Vec2::new(number(grain, 11) - number(grain, 10), number(grain, 21) - number(grain, 20));
    assert!((along.to_angle() - FRAC_PI_4).abs() < 1e-3);
    assert_eq!(pairs.last(), Some(&(0, "EOF")));
    assert!(text.is_ascii() && text.contains("MATERIAL: SILK"));
}

#[test]
fn another_suffix_and_a_garment_without_a_pattern_are_refused() {
    let garment = Arc::new(Garment::default());
    let said = |path: &str| {
        save("", Arc::clone(&garment), &[], Path::new(path), &Progress::none()).unwrap_err().to_string()
    };
    assert!(said("a.txt").contains(".svg, .pdf or .dxf"));
    assert!(said("a.pdf").contains("no flat pattern"));
    assert!(is_tech_sheet(Path::new("a.SVG")) && !is_tech_sheet(Path::new("a.glb")));
}
