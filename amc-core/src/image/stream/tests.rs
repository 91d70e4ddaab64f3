//! What was saved in bands and frames is read again, by other code than wrote it.

use std::fs::File;
use std::io::BufReader;

use super::*;
use crate::color::{linear_from_srgb, srgb_from_linear};
use crate::image::decode;

const WIDTH: u32 = 40;
const HEIGHT: u32 = 75;

/// A picture with gradients, a hole and soft alpha; `phase` moves it.
fn picture(height: u32, phase: u32) -> Picture {
    let pixels = (0..WIDTH * height).map(|k| {
        let (x, y) = ((k % WIDTH + phase) % WIDTH, k / WIDTH);
        let (u, v) = (x as f32 / WIDTH as f32, y as f32 / height as f32);
        let alpha = if x < 6 {
            0.0
        } else if x < 9 {
            0.4
        } else {
            1.0
        };
        [
            linear_from_srgb(0.2 + 0.6 * u),
            linear_from_srgb(0.3 + 0.3 * v),
            linear_from_srgb(0.5 * u * v),
            alpha,
        ]
    });
    Picture::new(WIDTH, height, pixels.collect()).unwrap()
}

/// Rows of a picture, in bands of uneven height.
fn put_in_bands(picture: &Picture, put: Put<'_>) -> Result<()> {
    let mut rest = picture.pixels();
    for rows in [1, 40, 7].into_iter().cycle() {
        let taken = rest.len().min(rows * WIDTH as usize);
        let (band, left) = rest.split_at(taken);
        put(&Picture::new(WIDTH, band.len() as u32 / WIDTH, band.to_vec())?)?;
        rest = left;
        if rest.is_empty() {
            break;
        }
    }
    Ok(())
}

#[test]
fn bands_make_the_same_pictures_as_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, banded) = (folder.path().join("whole"), folder.path().join("banded"));
    let picture = picture(HEIGHT, 0);
    crate::image::encode::write_png(&picture, &whole, &[]).unwrap();
    save_png(&banded, WIDTH, HEIGHT, |put| put_in_bands(&picture, put)).unwrap();
    assert_eq!(decode::read(&whole).unwrap(), decode::read(&banded).unwrap());

    crate::image::encode::write_exr(&picture, &whole).unwrap();
    save_exr(&banded, WIDTH, HEIGHT, |put| put_in_bands(&picture, put)).unwrap();
    assert_eq!(decode::read(&whole).unwrap(), decode::read(&banded).unwrap());
}

#[test]
fn what_does_not_add_up_or_breaks_off_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    let picture = picture(HEIGHT, 0);
    let timing = Timing { frames: 2, per_second: 10 };
    let palette = Palette::of(std::slice::from_ref(&picture), None);
    let colours = (&palette, Backdrop::Transparent);
    for (height, says) in [(HEIGHT - 1, "rows left"), (HEIGHT + 1, "lacks 1 rows")] {
        let png = save_png(&path, WIDTH, height, |put| put_in_bands(&picture, put)).unwrap_err().to_string();
        let exr = save_exr(&path, WIDTH, height, |put| put_in_bands(&picture, put)).unwrap_err().to_string();
        assert!(png.contains(says) && exr.contains(says), "{png}, {exr}");
    }
    let one = |put: Put<'_>| put(&picture);
    let three = |put: Put<'_>| (0..3).try_for_each(|_| put(&picture));
    for error in [
        save_apng(&path, WIDTH, HEIGHT, timing, one).unwrap_err(),
        save_gif(&path, WIDTH, HEIGHT, timing, colours, one).unwrap_err(),
        save_apng(&path, WIDTH, HEIGHT, timing, three).unwrap_err(),
        save_gif(&path, WIDTH, HEIGHT, timing, colours, three).unwrap_err(),
        save_gif(&path, 70_000, 1, timing, colours, one).unwrap_err(),
        save_apng(&path, WIDTH, HEIGHT, Timing { frames: 0, ..timing }, one).unwrap_err(),
        save_apng(&path, WIDTH, HEIGHT, Timing { per_second: 51, ..timing }, one).unwrap_err(),
        save_png(&path, 0, 3, one).unwrap_err(),
    ] {
        assert!(error.to_string().contains(&path.display().to_string()), "{error}");
    }
    let cancelled = save_exr(&path, WIDTH, HEIGHT, |_| Err(Error::cancelled())).unwrap_err();
    assert!(cancelled.is_cancelled());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn an_animated_png_holds_every_frame_and_its_time() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let timing = Timing { frames: 5, per_second: 24 };
    save_apng(&path, WIDTH, HEIGHT, timing, |put| (0..5).try_for_each(|k| put(&picture(HEIGHT, 7 * k))))
        .unwrap();
    let mut reader = png::Decoder::new(BufReader::new(File::open(&path).unwrap())).read_info().unwrap();
    let control = reader.info().animation_control.unwrap();
    assert_eq!((control.num_frames, control.num_plays), (5, 0));
    for k in 0..5 {
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut bytes).unwrap();
        let frame = reader.info().frame_control.unwrap();
        assert_eq!((frame.delay_num, frame.delay_den), (1, 24));
        assert_eq!(bytes, crate::image::encode::srgb8(&picture(HEIGHT, 7 * k)).as_flattened());
    }
}

/// The mean sRGB colour of each block of 8 x 5 pixels that is opaque throughout.
fn blocks(width: u32, pixel: impl Fn(u32, u32) -> Option<[f32; 3]>) -> Vec<[f32; 3]> {
    let corners = (0..HEIGHT / 5).flat_map(|j| (0..width / 8).map(move |i| (8 * i, 5 * j)));
    let mean = |(left, top): (u32, u32)| {
        let mut sum = [0.0; 3];
        for k in 0..40 {
            let colour = pixel(left + k % 8, top + k / 8)?;
            (0..3).for_each(|c| sum[c] += colour[c] / 40.0);
        }
        Some(sum)
    };
    corners.filter_map(mean).collect()
}

#[test]
fn a_gif_has_the_frames_colours_and_times() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gif");
    let timing = Timing { frames: 24, per_second: 24 };
    let frames: Vec<Picture> = (0..24).map(|k| picture(HEIGHT, k)).collect();
    let palette = Palette::of(&frames[..6], None);
    let colours = (&palette, Backdrop::Transparent);
    save_gif(&path, WIDTH, HEIGHT, timing, colours, |put| frames.iter().try_for_each(&mut *put)).unwrap();
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(BufReader::new(File::open(&path).unwrap())).unwrap();
    let (mut count, mut hundredths) = (0, 0);
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let source = &frames[count];
        let at = |x: u32, y: u32| (y * WIDTH + x) as usize;
        for (k, pixel) in source.pixels().iter().enumerate() {
            assert_eq!(frame.buffer[4 * k + 3] == 255, pixel[3] >= 0.5, "frame {count}, pixel {k}");
        }
        let found = blocks(WIDTH, |x, y| {
            let pixel = &frame.buffer[4 * at(x, y)..][..4];
            (pixel[3] == 255).then(|| [0, 1, 2].map(|c| f32::from(pixel[c])))
        });
        let wanted = blocks(WIDTH, |x, y| {
            let pixel = source.pixels()[at(x, y)];
            (pixel[3] >= 0.5).then(|| [0, 1, 2].map(|c| 255.0 * srgb_from_linear(pixel[c])))
        });
        assert!(wanted.len() > 30);
        for (a, b) in found.iter().zip(&wanted) {
            assert!((0..3).all(|c| (a[c] - b[c]).abs() < 3.0), "frame {count}: {a:?} {b:?}");
        }
        hundredths += u32::from(frame.delay);
        count += 1;
    }
    assert_eq!((count, hundredths), (24, 100));
    assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
}

#[test]
fn a_plain_background_stays_plain() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gif");
    let behind = [250, 240, 7];
    let linear = behind.map(|value: u8| linear_from_srgb(f32::from(value) / 255.0));
    let gradients = picture(HEIGHT, 0);
    let pixels = gradients.pixels().iter().map(|&[r, g, b, a]| {
        let [r, g, b] = if a == 1.0 { [r, g, b] } else { linear };
        [r, g, b, 1.0]
    });
    let picture = Picture::new(WIDTH, HEIGHT, pixels.collect()).unwrap();
    let palette = Palette::of(std::slice::from_ref(&picture), Some(behind));
    let timing = Timing { frames: 1, per_second: 1 };
    save_gif(&path, WIDTH, HEIGHT, timing, (&palette, Backdrop::Opaque), |put| put(&picture)).unwrap();
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(File::open(&path).unwrap()).unwrap();
    let frame = decoder.read_next_frame().unwrap().unwrap();
    let rows = frame.buffer.chunks_exact(4 * WIDTH as usize);
    assert!(rows.flat_map(|row| row[..24].chunks_exact(4)).all(|pixel| pixel == [250, 240, 7, 255]));
    // Nothing at all to choose colours by.
    let empty = Picture::new(1, 1, vec![[0.0; 4]]).unwrap();
    assert_eq!(Palette::of(&[empty], None).bytes().len(), 3 * 256);
}
