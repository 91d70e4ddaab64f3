//! What lies beyond a panel's edge in its picture.

use glam::Vec4;

use super::grid::MARGIN;

/// Lays texels on beyond the edge, as many as there may be in a margin, and fills what is left with the mean: smaller copies of the picture
/// then have the cloth's colours up to the edge. Where alpha is 0 there is no cloth.
pub(super) fn extended(mut pixels: Vec<[f32; 4]>, width: usize) -> Vec<[f32; 4]> {
    let height = pixels.len() / width.max(1);
    let neighbours = |index: usize| {
        let (x, y) = (index % width, index / width);
        let left = (x > 0).then(|| index - 1);
        let right = (x + 1 < width).then_some(index + 1);
        let above = (y > 0).then(|| index - width);
        let below = (y + 1 < height).then_some(index + width);
        [left, right, above, below].into_iter().flatten()
    };
    let sum = pixels.iter().map(|&pixel| Vec4::from_array(pixel)).filter(|pixel| pixel.w > 0.0).sum::<Vec4>();
    let mean = if sum.w > 0.0 { sum / sum.w } else { Vec4::ONE };
    let is_edge = |pixels: &[[f32; 4]], index: usize| {
        pixels[index][3] == 0.0 && neighbours(index).any(|other| pixels[other][3] > 0.0)
    };
    let mut edge: Vec<usize> = (0..pixels.len()).filter(|&index| is_edge(&pixels, index)).collect();
    for _ in 0..MARGIN {
        let laid: Vec<[f32; 4]> = edge
            .iter()
            .map(|&index| {
                let known =
                    neighbours(index).map(|other| Vec4::from_array(pixels[other])).filter(|it| it.w > 0.0);
                let sum = known.sum::<Vec4>();
                (sum / sum.w).to_array()
            })
            .collect();
        for (&index, pixel) in edge.iter().zip(laid) {
            pixels[index] = pixel;
        }
        let mut next: Vec<usize> = edge
            .iter()
            .flat_map(|&index| neighbours(index))
            .filter(|&index| pixels[index][3] == 0.0)
            .collect();
        next.sort_unstable();
        next.dedup();
        edge = next;
    }
    for pixel in pixels.iter_mut().filter(|pixel| pixel[3] == 0.0) {
        *pixel = mean.to_array();
    }
    pixels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cloth_goes_on_beyond_its_edge_and_the_rest_is_its_mean() {
        let width = 20;
        let mut pixels = vec![[0.0; 4]; width * 9];
        (pixels[4 * width], pixels[4 * width + 1]) = ([1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]);
        let made = extended(pixels, width);
        assert_eq!(made[4 * width + 2], [0.0, 0.0, 1.0, 1.0]);
        assert_eq!(made[3 * width], [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(made[width - 1], [0.5, 0.0, 0.5, 1.0]);
        assert_eq!(extended(vec![[0.0; 4]; 6], 3), vec![[1.0; 4]; 6]);
    }
}
