use std::path::PathBuf;

use amc_core::Progress;

use super::cloths;
use crate::body::Body;
use crate::cut::CutGarment;
use crate::drape::{Draped, Options, drape};

fn write(garment: &CutGarment, draped: &Draped, name: &str) {
    let Ok(folder) = std::env::var("WARDROBE_LOOK") else { return };
    let mut text = String::new();
    let mut base = 1;
    for (piece, places) in garment.pieces.iter().zip(&draped.positions) {
        text += &format!("o {}\n", piece.name);
        for p in places {
            text += &format!("v {} {} {}\n", p.x, p.y, p.z);
        }
        for uv in &piece.flat {
            text += &format!("vt {} {}\n", uv.x, uv.y);
        }
        for t in &piece.triangles {
            let [a, b, c] = t.map(|i| i + base);
            text += &format!("f {a}/{a} {b}/{b} {c}/{c}\n");
        }
        base += places.len() as u32;
    }
    std::fs::write(PathBuf::from(folder).join(name), text).unwrap();
}

#[test]
fn look() {
    let levels = [cloths::tube(0.03), cloths::tube(0.013)];
    let garment = &levels[1];
    let start = std::time::Instant::now();
    let (draped, rest) = drape(&levels, &Body::new(garment.figure), &Options::default(), &Progress::none()).unwrap();
    eprintln!("{} triangles {:?} {} steps fastest {}", garment.pieces[0].triangles.len(), start.elapsed(), rest.substeps, rest.fastest);
    for e in rest.energies.iter().step_by(10) {
        eprintln!("{:.5} {:.5} {:.5}", e.kinetic, e.elastic, e.height);
    }
    write(garment, &draped, "tube.obj");
}
