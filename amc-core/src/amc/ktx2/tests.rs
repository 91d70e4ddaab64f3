use half::f16;
use serde_json::json;

use super::super::{Frame, Metadata, Symmetry, Texels};
use super::*;
use crate::view_space::Azimuth;
use crate::{ErrorKind, Place};

fn metadata() -> Metadata {
    Metadata {
        name: "Ατλάζι \"red\"\n".into(),
        tags: vec!["silk".into(), "warm".into()],
        notes: "two lines\nof text".into(),
        lighting: json!({"lights": [{"towards": [0, 0, 1]}]}),
        capture: json!({"rig": "bench", "pictures": 96, "residuals": {"2": 0.01}}),
        other: json!({"from_the_future": [1, {"deep": true}]}).as_object().unwrap().clone(),
    }
}

fn amc(format: TexelFormat) -> Amc {
    let size = TableSize::new(6, 5).unwrap();
    let texels = match format {
        TexelFormat::Srgb8 => {
            Texels::Srgb8((0..size.texels()).map(|k| [k as u8, (k * 7) as u8, 3, 255]).collect())
        }
        TexelFormat::Half => Texels::Half(
            (0..size.texels()).map(|k| [k as f32 * 0.3, -0.5, 60000.0, 1.0].map(f16::from_f32)).collect(),
        ),
    };
    let mut amc = Amc::new(size, texels, Symmetry::Three, Azimuth::Projected, Frame::Full).unwrap();
    amc.metadata = metadata();
    amc
}

/// Another value under one of the keys, of the same length.
fn patched(bytes: &[u8], from: &str, to: &str) -> Vec<u8> {
    assert_eq!(from.len(), to.len());
    let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).unwrap();
    let mut patched = bytes.to_vec();
    patched[at..at + to.len()].copy_from_slice(to.as_bytes());
    patched
}

#[test]
fn everything_comes_back() {
    for format in [TexelFormat::Srgb8, TexelFormat::Half] {
        let amc = amc(format);
        assert_eq!(Amc::from_ktx2(&amc.to_ktx2().unwrap()).unwrap(), amc);
    }
}

#[test]
fn a_saved_file_is_read_and_a_broken_one_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.amc.ktx2");
    let amc = amc(TexelFormat::Srgb8);
    amc.save(&path).unwrap();
    assert_eq!(Amc::read(&path).unwrap(), amc);
    file::save_bytes(&path, b"nothing of ours").unwrap();
    assert!(Amc::read(&path).unwrap_err().to_string().contains("a.amc.ktx2: byte 0: not a KTX2 file"));
}

/// The file against the specification's own numbers, read without any of our code or of the crate that writes.
#[test]
fn the_bytes_are_those_of_the_specification() {
    for (format, vk_format, type_size, texel) in
        [(TexelFormat::Srgb8, 43, 1, 4), (TexelFormat::Half, 97, 2, 8)]
    {
        let bytes = amc(format).to_ktx2().unwrap();
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        let long = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
        assert_eq!(bytes[..12], *b"\xabKTX 20\xbb\r\n\x1a\n");
        // vkFormat, typeSize, width, height, depth, layers, faces, levels, Zstandard.
        let header: Vec<u32> = (0..9).map(|k| word(12 + 4 * k)).collect();
        assert_eq!(header, [vk_format, type_size, 6, 6, 5, 0, 1, 1, 2]);
        let (dfd, kvd) = (word(48) as usize, word(56) as usize);
        assert_eq!((dfd, word(52), kvd, long(64), long(72)), (104, 92, 196, 0, 0));
        assert_eq!(long(80), (kvd + word(60) as usize) as u64);
        assert_eq!((long(80) + long(88), long(96)), (bytes.len() as u64, 180 * texel));
        // Total size; Khronos' basic block of version 2 with 88 bytes; RGBSDA, BT.709, transfer, straight alpha; 1 x 1
        // texel blocks; bytes of plane 0.
        let transfer = if format == TexelFormat::Srgb8 { 2 } else { 1 };
        let basic: Vec<u32> = (0..7).map(|k| word(dfd + 4 * k)).collect();
        assert_eq!(basic, [92, 0, 2 | 88 << 16, 1 | 1 << 8 | transfer << 16, 0, texel as u32, 0]);
        for (k, channel) in [0u32, 1, 2, 15].into_iter().enumerate() {
            let sample: Vec<u32> = (0..4).map(|w| word(dfd + 28 + 16 * k + 4 * w)).collect();
            let bits = texel as u32 * 2;
            let (qualifiers, lower, upper) = match format {
                // Alpha is linear where colours are sRGB.
                TexelFormat::Srgb8 => (if channel == 15 { 1 } else { 0 }, 0, 255),
                // Signed floats, -1 to 1 nominal.
                TexelFormat::Half => (0b1100, (-1.0f32).to_bits(), 1.0f32.to_bits()),
            };
            let first = (k as u32 * bits) | ((bits - 1) << 16) | ((channel | (qualifiers << 4)) << 24);
            assert_eq!(sample, [first, 0, lower, upper], "{format:?} {channel}");
        }
        let keys = &bytes[kvd..kvd + word(60) as usize];
        assert_eq!(keys[..4], 19u32.to_le_bytes());
        assert_eq!(keys[4..24], *b"KTXorientation\0ruo\0\0");
    }
}

#[test]
fn a_table_of_one_colour_is_small_and_comes_back() {
    let size = TableSize::new(256, 256).unwrap();
    let texels = Texels::Srgb8(vec![[10, 20, 30, 255]; size.texels()]);
    let amc = Amc::new(size, texels, Symmetry::One, Azimuth::Transported, Frame::Half).unwrap();
    let bytes = amc.to_ktx2().unwrap();
    assert!(bytes.len() < 100_000);
    assert_eq!(Amc::from_ktx2(&bytes).unwrap().texels().len(), size.texels());
    // One slice more in so few bytes would be a bomb by our own rule, so it would be written unpacked.
    assert!(!is_justified(4000, FREE_BYTES + 1));
}

#[test]
fn texels_that_are_not_packed_start_at_a_multiple_of_a_texel_and_come_back() {
    for format in [TexelFormat::Srgb8, TexelFormat::Half] {
        let amc = amc(format);
        let bytes = amc.assemble(None).unwrap();
        let level = u64::from_le_bytes(bytes[80..88].try_into().unwrap());
        assert_eq!((level % format.bytes() as u64, bytes[44..48].to_vec()), (0, vec![0; 4]));
        assert_eq!(Amc::from_ktx2(&bytes).unwrap(), amc);
        assert!(Amc::from_ktx2(&bytes[..bytes.len() - 1]).is_err());
    }
}

#[test]
fn rows_from_the_top_are_turned_over() {
    let amc = amc(TexelFormat::Srgb8);
    let bytes = amc.to_ktx2().unwrap();
    assert_eq!(Amc::from_ktx2(&patched(&bytes, "\0ruo\0", "\0rui\0")).unwrap(), amc);
    let turned = Amc::from_ktx2(&patched(&bytes, "\0ruo\0", "\0rdi\0")).unwrap();
    assert_eq!(turned.to_linear().texel(2, 0, 3), amc.to_linear().texel(2, 5, 3));
    assert_eq!(turned.to_linear().texel(4, 4, 1), amc.to_linear().texel(4, 1, 1));
    let error = Amc::from_ktx2(&patched(&bytes, "\0ruo\0", "\0luo\0")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
}

#[test]
fn a_ktx2_file_of_others_is_refused() {
    let bytes = amc(TexelFormat::Srgb8).to_ktx2().unwrap();
    let error = Amc::from_ktx2(&patched(&bytes, "\0amc\0{", "\0abc\0{")).unwrap_err();
    assert!(error.to_string().contains("no key `amc`"), "{error}");
}

#[test]
fn bad_json_is_refused_with_its_place() {
    let bytes = amc(TexelFormat::Srgb8).to_ktx2().unwrap();
    let broken = Amc::from_ktx2(&patched(&bytes, r#""symmetry":3"#, r#""symmetry":x"#)).unwrap_err();
    assert!(matches!(broken.place(), Some(Place::LineColumn(1, _))), "{broken}");
    let five = Amc::from_ktx2(&patched(&bytes, r#""symmetry":3"#, r#""symmetry":5"#)).unwrap_err();
    assert!(five.to_string().contains("symmetry: the symmetry is 5"), "{five}");
    let later = Amc::from_ktx2(&patched(&bytes, r#""version":1"#, r#""version":2"#)).unwrap_err();
    assert_eq!(later.kind(), ErrorKind::Unsupported);
    let missing = Amc::from_ktx2(&patched(&bytes, r#""azimuth""#, r#""azimuhh""#)).unwrap_err();
    assert!(missing.to_string().contains("azimuth: the key `azimuth` is missing"), "{missing}");
}

#[test]
fn sizes_that_the_file_cannot_hold_are_refused_before_anything_is_allocated() {
    let bytes = amc(TexelFormat::Srgb8).to_ktx2().unwrap();
    let with = |words: &[(usize, u64, usize)]| {
        let mut bytes = bytes.clone();
        for &(at, value, length) in words {
            bytes[at..at + length].copy_from_slice(&value.to_le_bytes()[..length]);
        }
        Amc::from_ktx2(&bytes).unwrap_err()
    };
    assert_eq!(with(&[(20, 4096, 4), (24, 4096, 4)]).kind(), ErrorKind::TooLarge);
    // 2048 x 2048 x 2048 texels are over the limit in bytes; 1024 x 1024 x 256 are not, but not in so small a file.
    assert_eq!(with(&[(20, 2048, 4), (24, 2048, 4), (28, 2048, 4)]).kind(), ErrorKind::TooLarge);
    let bomb = with(&[(20, 1024, 4), (24, 1024, 4), (28, 256, 4), (96, 1 << 30, 8)]);
    assert!(bomb.to_string().contains("more than a table can shrink"), "{bomb}");
    assert_eq!(with(&[(28, 6, 4)]).kind(), ErrorKind::Malformed);
    assert!(with(&[(28, 6, 4), (96, 6 * 6 * 6 * 4, 8)]).to_string().contains("720 bytes instead of 864"));
    assert_eq!(with(&[(28, 0, 4)]).kind(), ErrorKind::Unsupported);
    assert_eq!(with(&[(24, 7, 4)]).kind(), ErrorKind::Malformed);
    assert_eq!(with(&[(12, 37, 4)]).kind(), ErrorKind::Unsupported);
    assert_eq!(with(&[(44, 1, 4)]).kind(), ErrorKind::Unsupported);
    assert_eq!(with(&[(80, u64::MAX, 8)]).kind(), ErrorKind::Malformed);
    assert_eq!(with(&[(56, u64::from(u32::MAX), 4)]).kind(), ErrorKind::Malformed);
}

#[test]
fn a_float_that_is_no_number_is_refused() {
    let size = TableSize::new(1, 1).unwrap();
    let texels = Texels::Half(vec![[f16::NAN, f16::ZERO, f16::ZERO, f16::ONE]]);
    let amc = Amc::new(size, texels, Symmetry::One, Azimuth::Transported, Frame::Half).unwrap();
    assert!(Amc::from_ktx2(&amc.to_ktx2().unwrap()).is_err());
}

#[test]
fn no_cut_and_no_mutation_panics_and_every_cut_is_refused() {
    let bytes = amc(TexelFormat::Half).to_ktx2().unwrap();
    for length in 0..bytes.len() {
        assert!(Amc::from_ktx2(&bytes[..length]).is_err(), "cut at {length}");
    }
    let mut numbers = crate::pseudo_random::PseudoRandom::new(1);
    let mut random = |below: usize| numbers.below(below);
    let mut read = 0;
    for _ in 0..20_000 {
        let mut mutated = bytes.clone();
        for _ in 0..1 + random(4) {
            let at = random(bytes.len());
            mutated[at] = match random(3) {
                0 => random(256) as u8,
                1 => mutated[at] ^ (1 << random(8)),
                _ => [0, 1, 0x7f, 0x80, 0xff][random(5)],
            };
        }
        read += usize::from(Amc::from_ktx2(&mutated).is_ok());
    }
    // Some fall on what readers skip, so that the good path was taken too.
    assert!(read > 100, "{read}");
}
