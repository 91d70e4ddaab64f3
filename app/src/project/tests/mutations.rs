//! Thousands of files that are almost projects: each is refused or read, and what is read can be saved and read again.

use std::path::Path;

use super::super::{Unknown, encode, parse};
use super::rich;

/// splitmix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) % bound as u64) as usize
    }
}

/// What projects are made of, and what they should not be.
const PIECES: [&str; 16] = [
    "null",
    "1e999",
    "-1",
    "4294967296",
    "0.5",
    "\"\"",
    "[]",
    "{}",
    "true",
    "\"fabric:\"",
    "\"\\ud800\"",
    "\"../../x\"",
    "\"version\": 0",
    "\"id\": 4,",
    "}",
    "]",
];

fn mutated(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=random.below(3) {
        let at = random.below(bytes.len());
        let end = (at + random.below(12)).min(bytes.len());
        match random.below(5) {
            0 => bytes[at] = random.below(256) as u8,
            1 => drop(bytes.drain(at..end)),
            2 => {
                let piece = PIECES[random.below(PIECES.len())];
                drop(bytes.splice(at..end, piece.bytes()));
            }
            3 => {
                // A whole value.
                let start = bytes[at..].iter().position(|&byte| byte == b':').map_or(at, |k| at + k + 1);
                let end = bytes[start..]
                    .iter()
                    .position(|byte| b",\n}".contains(byte))
                    .map_or(start, |k| start + k);
                drop(bytes.splice(start..end, PIECES[random.below(PIECES.len())].bytes()));
            }
            _ => {
                let copied = bytes[at..end].to_vec();
                let to = random.below(bytes.len());
                drop(bytes.splice(to..to, copied));
            }
        }
        if bytes.is_empty() {
            bytes.push(b'{');
        }
    }
    bytes
}

#[test]
fn almost_projects_are_refused_or_read() {
    let folder = Path::new(if cfg!(windows) { r"C:\clothes\coat" } else { "/clothes/coat" });
    let whole = encode(&rich(folder), &Unknown::default(), Some(folder)).unwrap();
    let version_0 = br#"{"garment": "shape:sheet", "fabric": "silk.amc.ktx2", "for": {"whom": [1]}}"#;
    let mut random = Random(4);
    let mut read = 0;
    for k in 0..6000 {
        let bytes = mutated(if k % 6 == 0 { version_0 } else { &whole }, &mut random);
        if let Ok(first) = parse(&bytes, Some(folder)) {
            read += 1;
            first.project.check().unwrap();
            let written = encode(&first.project, &first.unknown, Some(folder)).unwrap();
            let again = parse(&written, Some(folder)).unwrap();
            let text = String::from_utf8_lossy(&bytes);
            assert_eq!((&again.project, &again.unknown), (&first.project, &first.unknown), "{text}");
        }
    }
    // Both ways are taken.
    assert!((200..5500).contains(&read), "{read} of 6000 were read");
}
