//! The files of the collection, as they are kept: what a program that opens them may rely on.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::{Path, PathBuf};

use amc_core::Progress;
use amc_core::mesh::{self, Garment, Unit};
use wardrobe::body::Body;
use wardrobe::collection::{COLLECTION, Entry};
use wardrobe::drape::{Energy, Options, linger};
use wardrobe::garment_file::{self, Variant, turn_of_part};
use wardrobe::measure::{Figures, measure};

/// Bytes of a file, triangles of a garment.
const MOST_BYTES: u64 = 1 << 20;
const MOST_TRIANGLES: usize = 20_000;

/// Millimetres that a seam may stand open.
const WIDEST_SEAM: f64 = 1.0;

/// UVs in a file are the flat piece to this, metres.
const UV_TOLERANCE: f32 = 5e-7;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../garments")
}

fn opened(entry: &Entry) -> Garment {
    let bytes = std::fs::read(entry.file(&folder())).unwrap();
    let stranger = |_: &str| -> amc_core::Result<Vec<u8>> { panic!("one file") };
    let mesh = mesh::gltf::parse(&bytes, &stranger).unwrap();
    Garment::new(mesh).unwrap()
}

fn figures(entry: &Entry) -> Figures {
    let (cut, draped) = entry.draped(&folder()).unwrap();
    measure(&cut, &draped, &Body::new(cut.figure))
}

#[test]
fn files_are_light_and_open_without_a_notice() {
    for entry in &COLLECTION {
        let file = entry.file(&folder());
        assert!(std::fs::metadata(&file).unwrap().len() < MOST_BYTES, "{}", entry.name);
        let garment = opened(entry);
        assert!(garment.triangles.len() < MOST_TRIANGLES, "{}: {}", entry.name, garment.triangles.len());
        assert!(garment.notices.is_empty(), "{}: {:?}", entry.name, garment.notices);
        assert!(mesh::read(&file, Unit::Metre).is_ok(), "{}", entry.name);
    }
}

#[test]
fn panels_are_the_patterns_pieces_and_uvs_are_cut_to_size() {
    for entry in &COLLECTION {
        let cut = entry.cut().unwrap();
        let garment = opened(entry);
        let names: Vec<&str> = garment.panels.iter().map(|panel| panel.name.as_str()).collect();
        let pieces: Vec<&str> = cut.pieces.iter().map(|piece| piece.name.as_str()).collect();
        assert_eq!(names, pieces, "{}", entry.name);
        let flat = cut.pieces.iter().flat_map(|piece| &piece.flat);
        assert_eq!(garment.uvs.len(), flat.clone().count());
        for (uv, flat) in garment.uvs.iter().zip(flat) {
            assert!(uv.distance(flat.as_vec2()) < UV_TOLERANCE, "{}: {uv} {flat}", entry.name);
        }
        for (panel, piece) in garment.panels.iter().zip(&cut.pieces) {
            let grain = f64::from(panel.pattern.grain.unwrap());
            assert!((grain - piece.grain).abs() < 1e-6, "{} {}", entry.name, panel.name);
            assert_eq!(panel.pattern.uv_unit, Some(1.0));
            assert!(!panel.flags.mirrored && !panel.flags.degenerate, "{} {}", entry.name, panel.name);
        }
    }
}

#[test]
fn seams_and_mirror_partners_are_mutual() {
    for entry in &COLLECTION {
        let garment = opened(entry);
        for (index, panel) in garment.panels.iter().enumerate() {
            if let Some(partner) = panel.pattern.mirror {
                assert_ne!(partner, index, "{} {}", entry.name, panel.name);
                assert_eq!(
                    garment.panels[partner].pattern.mirror,
                    Some(index),
                    "{} {}",
                    entry.name,
                    panel.name
                );
            }
            for seam in &panel.pattern.seams {
                let back = garment.panels[seam.partner].pattern.seams.iter().any(|other| {
                    other.name == seam.name
                        && other.partner == index
                        && (other.edge == [seam.partner_edge[1], seam.partner_edge[0]]
                            // A line within a piece runs neither way round.
                            || other.edge == seam.partner_edge && other.partner_edge == seam.edge)
                });
                assert!(back, "{} {}: {}", entry.name, panel.name, seam.name);
            }
        }
    }
}

#[test]
fn drapes_are_closed_outside_of_the_body_and_do_not_cut_themselves() {
    for entry in &COLLECTION {
        let figures = figures(entry);
        let row = figures.row(entry.name);
        assert!(figures.seam_gap * 1e3 <= WIDEST_SEAM, "{row}");
        assert_eq!(figures.inside_body, 0, "{row}");
        assert_eq!(figures.pierced_in_view, 0, "{row}");
    }
}

#[test]
fn cloth_is_sheared_and_stretched_as_cloth_is() {
    for entry in &COLLECTION {
        let figures = figures(entry);
        let row = figures.row(entry.name);
        // What hangs on the bias shears; a fifth of a right angle is where woven cloth locks.
        assert!((figures.angle.p50 - 90.0).abs() < 6.0, "{row}");
        assert!(figures.angle.p5 > 70.0 && figures.angle.p95 < 110.0, "{row}");
        for stretch in [figures.warp, figures.weft] {
            assert!(stretch.p5 > 0.93 && stretch.p95 < 1.12, "{row}");
            assert!((stretch.p50 - 1.0).abs() < 0.03, "{row}");
        }
    }
}

/// Joules that the energy may rise by in the time of the test: contacts and friction do a little work of their own.
const MOST_RISE: f64 = 2e-4;

/// Seconds for which each is left lying, without anything that holds it.
const LYING: f64 = 0.1;

#[test]
fn drapes_lie_still_and_their_energy_does_not_rise() {
    let options = Options::default();
    for entry in &COLLECTION {
        let (cut, draped) = entry.draped(&folder()).unwrap();
        let body = Body::new(cut.figure);
        let rest = linger(&cut, &draped, &body, LYING, &options, &Progress::none()).unwrap();
        let totals: Vec<f64> = rest.energies.iter().map(Energy::total).collect();
        assert!(totals.len() > 2, "{}", entry.name);
        let rise = totals[totals.len() - 1] - totals[0];
        assert!(rise < MOST_RISE, "{}: {rise} J", entry.name);
        assert!(rest.is_still(&options), "{}: {} m/s", entry.name, rest.fastest);
    }
}

#[test]
fn the_shirts_variants_are_what_programs_are_tested_with() {
    let shirt = Entry::named("shirt").unwrap();
    let (cut, draped) = shirt.draped(&folder()).unwrap();
    let plain = Garment::new(garment_file::mesh(&cut, &draped).unwrap()).unwrap();
    let variant = |variant: Variant| {
        let mut mesh = garment_file::mesh(&cut, &draped).unwrap();
        variant.apply(&mut mesh);
        Garment::new(mesh).unwrap()
    };
    let mirrored = variant(Variant::Mirrored);
    assert!(mirrored.panels.iter().all(|panel| panel.flags.mirrored));
    assert!(!variant(Variant::WithoutUvs).has_uvs);
    let turned = variant(Variant::Turned);
    for (part, (panel, was)) in turned.panels.iter().zip(&plain.panels).enumerate() {
        let by = f64::from(panel.pattern.grain.unwrap() - was.pattern.grain.unwrap());
        assert!((by - turn_of_part(part)).sin().abs() < 1e-5, "{}: {by}", panel.name);
    }
}
