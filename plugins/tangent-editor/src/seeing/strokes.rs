//! Lines drawn into texels.

use glam::Vec2;

use super::{Field, Grid};

/// How much of each texel lines of this width (metres) cover, 0 to 1.
pub(super) fn drawn(grid: Grid, lines: &[Vec<Vec2>], width: f32) -> Vec<f32> {
    let mut covered = vec![0.0; grid.count()];
    let half = (width / grid.texel / 2.0).max(0.5);
    for ends in lines.iter().flat_map(|line| line.windows(2)) {
        segment(grid, &mut covered, [grid.to_texels(ends[0]), grid.to_texels(ends[1])], half);
    }
    covered
}

fn segment(grid: Grid, covered: &mut [f32], [from, to]: [Vec2; 2], half: f32) {
    let reach = half + 1.0;
    let (low, high) = (from.min(to) - reach, from.max(to) + reach);
    let along = to - from;
    let range =
        |low: f32, high: f32, count: usize| (low.max(0.0) as usize)..(high.max(0.0) as usize + 1).min(count);
    for row in range(low.y, high.y, grid.height) {
        for column in range(low.x, high.x, grid.width) {
            let at = Vec2::new(column as f32 + 0.5, row as f32 + 0.5);
            let share = ((at - from).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
            let distance = at.distance(from + along * share);
            let texel = &mut covered[row * grid.width + column];
            *texel = texel.max((half + 0.5 - distance).clamp(0.0, 1.0));
        }
    }
}

/// Arrows along the field, one in each cell of this size (metres): shafts and heads.
pub(super) fn arrows(field: &Field, cell: f32) -> Vec<Vec<Vec2>> {
    let grid = field.grid;
    let step = (cell / grid.texel).max(4.0);
    let (columns, rows) = ((grid.width as f32 / step) as usize, (grid.height as f32 / step) as usize);
    let mut lines = Vec::new();
    for row in 0..=rows {
        for column in 0..=columns {
            let at = Vec2::new(column as f32 + 0.5, row as f32 + 0.5) * step;
            let Some(index) = grid.index(at) else { continue };
            let along = field.directions[index];
            if along == Vec2::ZERO {
                continue;
            }
            let (tip, tail) = (at + along * (0.38 * step), at - along * (0.38 * step));
            let barb = |side: f32| tip - along * (0.2 * step) + along.perp() * (0.12 * side * step);
            lines.push(vec![grid.to_metres(tail), grid.to_metres(tip)]);
            lines.push([barb(1.0), tip, barb(-1.0)].map(|at| grid.to_metres(at)).to_vec());
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::super::tests::sheet;
    use super::*;

    #[test]
    fn lines_cover_their_area() {
        let (_, panel) = sheet(5, |p| p.extend(0.0));
        let grid = Grid::over(&panel, 0.004);
        let line = vec![Vec2::new(-0.3, -0.2), Vec2::new(0.3, 0.1)];
        let covered = drawn(grid, std::slice::from_ref(&line), 0.03);
        let area = covered.iter().sum::<f32>() * grid.texel * grid.texel;
        let wanted = line[0].distance(line[1]) * 0.03 + std::f32::consts::PI * 0.015f32.powi(2);
        assert!((area / wanted - 1.0).abs() < 0.02, "{area} {wanted}");
    }

    #[test]
    fn arrows_point_along_the_field() {
        let (_, panel) = sheet(5, |p| p.extend(0.0));
        let along = Vec2::from_angle(2.0);
        let field = Field::new(&panel, Grid::over(&panel, 0.01), &vec![along; panel.places.len()]);
        let arrows = arrows(&field, 0.1);
        assert!(arrows.len() > 100, "{}", arrows.len());
        for shaft in arrows.iter().filter(|line| line.len() == 2) {
            assert!(((shaft[1] - shaft[0]).normalize_or_zero() - along).length() < 1e-2);
        }
    }
}
