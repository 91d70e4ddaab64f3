use super::orientation::tests::exif;
use super::*;
use crate::pseudo_random::PseudoRandom;

fn png_bytes(
    width: u32,
    height: u32,
    colour: ::png::ColorType,
    depth: ::png::BitDepth,
    data: &[u8],
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    if colour == ::png::ColorType::Indexed {
        encoder.set_palette(vec![0, 0, 0, 255, 0, 128]);
        encoder.set_trns(vec![0]);
    }
    encoder.write_header().unwrap().write_image_data(data).unwrap();
    bytes
}

fn exr_bytes(width: usize, height: usize, pixel: impl Fn(usize, usize) -> [f32; 4] + Sync) -> Vec<u8> {
    use ::exr::prelude::*;
    let channels = SpecificChannels::rgba(|at: Vec2<usize>| {
        let [r, g, b, a] = pixel(at.x(), at.y());
        (r, g, b, a)
    });
    let mut bytes = Vec::new();
    Image::from_channels((width, height), channels)
        .write()
        .to_buffered(std::io::Cursor::new(&mut bytes))
        .unwrap();
    bytes
}

/// A grey JPEG of 8 x 8 pixels, all of one value.
fn grey_jpeg() -> Vec<u8> {
    // 0, then 400 in nine bits (110010000), then 0, then ones: the level is 128 + 400 / 8 = 178.
    hand_made_jpeg(8, &[0b0110_0100, 0b0001_1111])
}

/// A grey JPEG of 8 x 16 pixels, its upper half of one value and its lower half of another.
fn two_greys_jpeg() -> Vec<u8> {
    // As above; then 0, -400 in nine bits (001101111), 0, ones: 50 less.
    hand_made_jpeg(16, &[0b0110_0100, 0b0000_0011, 0b0111_1011])
}

/// A grey JPEG, 8 pixels wide, made by hand: each table holds the one code it needs.
fn hand_made_jpeg(height: u8, scan: &[u8]) -> Vec<u8> {
    let mut bytes = vec![0xff, 0xd8, 0xff, 0xdb, 0, 67, 0];
    bytes.extend([1; 64]);
    bytes.extend([0xff, 0xc0, 0, 11, 8, 0, height, 0, 8, 1, 1, 0x11, 0]);
    // DC: one code of one bit, category 9; AC: one code of one bit, the end of the block.
    bytes.extend([0xff, 0xc4, 0, 20, 0x00, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9]);
    bytes.extend([0xff, 0xc4, 0, 20, 0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    bytes.extend([0xff, 0xda, 0, 8, 1, 1, 0, 0, 63, 0]);
    bytes.extend(scan);
    bytes.extend([0xff, 0xd9]);
    bytes
}

/// The JPEG with a segment APP1 that holds Exif data.
fn with_exif(jpeg: &[u8], exif: &[u8]) -> Vec<u8> {
    let length = (2 + 6 + exif.len() as u16).to_be_bytes();
    [&jpeg[..2], &[0xff, 0xe1], &length, b"Exif\0\0", exif, &jpeg[2..]].concat()
}

#[test]
fn a_jpeg_is_turned_as_its_exif_orientation_says() {
    let decoded = |exif: &[u8]| decode(&with_exif(&two_greys_jpeg(), exif)).unwrap();
    assert_eq!(decoded(b"nothing of the sort"), decode(&two_greys_jpeg()).unwrap());
    let level = |raster: &Raster, x: u32, y: u32| match raster.samples() {
        Samples::U8(samples) => samples[(y * raster.width() + x) as usize],
        _ => panic!("8 bits"),
    };
    // The file's first row is seen at the bottom, then on the right, then on the left.
    for (tag, size, bright, dark) in
        [(3, (8, 16), (4, 12), (4, 3)), (6, (16, 8), (12, 4), (3, 4)), (8, (16, 8), (3, 4), (12, 4))]
    {
        let turned = decoded(&exif(tag == 6, 3, tag));
        assert_eq!((turned.width(), turned.height()), size, "{tag}");
        assert_eq!((level(&turned, bright.0, bright.1), level(&turned, dark.0, dark.1)), (178, 128), "{tag}");
        assert_eq!(turned.orientation().tag(), tag);
    }
}

#[test]
fn a_grey_jpeg_of_known_level() {
    let raster = decode(&grey_jpeg()).unwrap();
    assert_eq!((raster.width(), raster.height(), raster.channels()), (8, 8, 1));
    assert_eq!(raster.samples(), &Samples::U8(vec![178; 64]));
    let pixel = raster.to_picture().pixel(7, 7);
    assert!((pixel[0] - 0.445).abs() < 1e-3 && pixel[3] == 1.0, "{pixel:?}");
}

#[test]
fn png_of_16_bits_keeps_them() {
    let data: Vec<u8> = [0u16, 1, 32768, 65535].iter().flat_map(|value| value.to_be_bytes()).collect();
    let raster =
        decode(&png_bytes(2, 1, ::png::ColorType::GrayscaleAlpha, ::png::BitDepth::Sixteen, &data)).unwrap();
    assert_eq!(raster.samples(), &Samples::U16(vec![0, 1, 32768, 65535]));
    assert!(raster.has_alpha());
    let picture = raster.to_picture();
    assert!((picture.pixel(1, 0)[2] - 0.214_05).abs() < 1e-4);
    assert_eq!(picture.pixel(1, 0)[3], 1.0);
}

#[test]
fn png_of_a_palette_becomes_colour_and_alpha() {
    let raster =
        decode(&png_bytes(4, 1, ::png::ColorType::Indexed, ::png::BitDepth::One, &[0b0101_0000])).unwrap();
    assert_eq!(raster.channels(), 4);
    let Samples::U8(samples) = raster.samples() else { panic!("8 bits") };
    assert_eq!(&samples[..8], &[0, 0, 0, 0, 255, 0, 128, 255]);
}

#[test]
fn exr_is_linear_and_becomes_straight() {
    let bytes = exr_bytes(3, 2, |x, y| if (x, y) == (2, 1) { [0.5, 4.0, 0.0, 0.5] } else { [0.25; 4] });
    let picture = decode(&bytes).unwrap().to_picture();
    assert_eq!((picture.width(), picture.height()), (3, 2));
    assert_eq!(picture.pixel(2, 1), [1.0, 8.0, 0.0, 0.5]);
    assert_eq!(picture.pixel(0, 0), [1.0, 1.0, 1.0, 0.25]);
}

#[test]
fn an_exr_sample_that_is_no_number_is_named() {
    let bytes = exr_bytes(4, 4, |x, y| if (x, y) == (2, 3) { [f32::NAN; 4] } else { [1.0; 4] });
    assert!(decode(&bytes).unwrap_err().to_string().contains("pixel 2, 3"));
}

#[test]
fn what_is_no_picture_is_refused() {
    assert!(decode(b"").unwrap_err().to_string().contains("empty"));
    assert!(decode(b"turntable notes").unwrap_err().to_string().contains("not a picture"));
}

#[test]
fn absurd_sizes_are_refused_before_they_are_allocated() {
    // 60000 x 60000 grey in the frame header.
    let mut jpeg = grey_jpeg();
    let frame = jpeg.windows(2).position(|pair| pair == [0xff, 0xc0]).unwrap();
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0xea, 0x60, 0xea, 0x60]);
    assert_eq!(decode(&jpeg).unwrap_err().kind(), crate::ErrorKind::TooLarge);
    // 4096 x 4096: inside the limit, but not in 150 bytes.
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0x10, 0, 0x10, 0]);
    assert_eq!(decode(&jpeg).unwrap_err().kind(), crate::ErrorKind::TooLarge);
    let mut png = png_bytes(2, 2, ::png::ColorType::Rgb, ::png::BitDepth::Eight, &[7; 12]);
    png[16..24].copy_from_slice(&[0, 0, 0x20, 0, 0, 0, 0x20, 0]);
    let mut crc = crc32(&png[12..29]).to_be_bytes().to_vec();
    png.splice(29..33, crc.drain(..));
    assert_eq!(decode(&png).unwrap_err().kind(), crate::ErrorKind::TooLarge);
    let mut exr = exr_bytes(4, 4, |_, _| [1.0; 4]);
    for name in [&b"dataWindow"[..], &b"displayWindow"[..]] {
        let at = exr.windows(name.len()).position(|window| window == name).unwrap();
        // name, 0, "box2i", 0, size; then x min, y min, x max, y max.
        let value = at + name.len() + 1 + 6 + 4;
        exr[value + 8..value + 16].copy_from_slice(&[0xff, 0x1f, 0, 0, 0xff, 0x1f, 0, 0]);
    }
    let error = decode(&exr).unwrap_err();
    assert!(
        error.kind() == crate::ErrorKind::TooLarge || error.kind() == crate::ErrorKind::Malformed,
        "{error}"
    );
}

/// CRC-32 as PNG has it (ISO 3309), bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(
            crc ^ u32::from(byte),
            |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 },
        )
    })
}

#[test]
fn cut_and_damaged_files_are_errors_or_pictures_and_never_panics() {
    let noise = |x: usize, y: usize| ((x * 37 + y * 101) % 64) as f32 / 64.0;
    let files = [
        grey_jpeg(),
        with_exif(&two_greys_jpeg(), &exif(true, 3, 6)),
        png_bytes(16, 16, ::png::ColorType::Rgb, ::png::BitDepth::Eight, &[9; 768]),
        exr_bytes(16, 16, |x, y| [noise(x, y); 4]),
    ];
    for file in &files {
        for length in 0..file.len() - 16 {
            assert!(decode(&file[..length]).is_err(), "{length} of {}", file.len());
        }
        let mut numbers = PseudoRandom::new(1);
        for _ in 0..2000 {
            let mut damaged = file.clone();
            for _ in 0..3 {
                let at = numbers.below(damaged.len());
                damaged[at] = numbers.byte();
            }
            if let Err(error) = decode(&damaged) {
                assert!(!error.to_string().contains("beyond what"), "a decoder panicked: {error}");
            }
        }
    }
}

#[test]
fn the_rows_asked_for_are_decoded_and_far_below_nothing_is() {
    use jpeg_encoder::{ColorType, Encoder, SamplingFactor};
    let (width, height) = (40, 100);
    let mut numbers = PseudoRandom::new(5);
    let samples: Vec<u8> = (0..width * height * 3).map(|_| numbers.byte()).collect();
    let samplings =
        [SamplingFactor::F_1_1, SamplingFactor::F_2_1, SamplingFactor::F_1_2, SamplingFactor::F_2_2];
    for (sampling, progressive) in
        samplings.into_iter().flat_map(|sampling| [(sampling, false), (sampling, true)])
    {
        let mut file = Vec::new();
        let mut encoder = Encoder::new(&mut file, 80);
        encoder.set_sampling_factor(sampling);
        encoder.set_progressive(progressive);
        encoder.encode(&samples, width as u16, height as u16, ColorType::Rgb).unwrap();
        let all = decode(&file).unwrap().into_buffer().unwrap();
        for rows in [0, 1, 8, 17, 48, 99, 100, usize::MAX] {
            let raster = decode_rows(&file, vec![7; all.len()], rows).unwrap();
            assert_eq!((raster.width(), raster.height()), (width, height));
            let decoded = raster.into_buffer().unwrap();
            let asked_for = rows.min(height as usize) * width as usize * 3;
            assert!(decoded[..asked_for] == all[..asked_for], "{sampling:?} {progressive} {rows}");
            let rest_is_left = decoded[all.len() - 300..].iter().all(|&sample| sample == 7);
            assert_eq!(rest_is_left, rows < 50 && !progressive, "{sampling:?} {progressive} {rows}");
        }
        // What a file has lost is missed, wherever it was.
        let cut = &file[..file.len() / 2];
        let outcome = |result: Result<Raster>| result.map_err(|error| error.to_string());
        let whole = outcome(decode(cut));
        assert!(progressive || whole.is_err());
        assert_eq!(outcome(decode_rows(cut, Vec::new(), 8)), whole);
    }
}
