//! Mirror images of names, lines and placements.

use glam::DVec2;

use super::{Line, Placement};

/// The name with the words `left` and `right` exchanged.
pub(super) fn name(name: &str) -> String {
    let swap = |word| match word {
        "left" => "right",
        "right" => "left",
        other => other,
    };
    name.split(' ').map(swap).collect::<Vec<_>>().join(" ")
}

/// Whether a name says on which side its thing is.
pub(super) fn has_side(text: &str) -> bool {
    name(text) != text
}

/// The mirror image of a point of a piece.
pub(super) fn point(point: DVec2) -> DVec2 {
    DVec2::new(-point.x, point.y)
}

/// The mirror image of a line. It runs the other way, so that outlines stay counter-clockwise.
pub(super) fn line(line: &Line) -> Line {
    let length = line.length();
    let points: Vec<DVec2> = line.points.iter().rev().map(|&p| point(p)).collect();
    let mut image = Line::new(&name(&line.name), line.kind, points, &[]);
    image.corners = line.corners.iter().rev().map(|corner| length - corner).collect();
    image
}

/// Two lines, the second of which starts where the first ends, as one.
pub(super) fn join(first: &Line, second: &Line) -> Line {
    let mut points = first.points.clone();
    let joint = points.len() - 1;
    points.extend(second.points.iter().skip(1));
    let mut joined = Line::new(&first.name, first.kind, points, &[joint]);
    let shift = first.length();
    let corners = second.corners.iter().map(|corner| corner + shift);
    joined.corners = first.corners.iter().copied().chain(joined.corners).chain(corners).collect();
    joined
}

/// The placement of a piece's mirror image: on the wearer's other side, x to -x.
pub(super) fn placement(placement: &Placement) -> Placement {
    match placement.clone() {
        Placement::Around { limb, point: [u, v], along, angle_deg, radius, flare } => Placement::Around {
            limb: name(&limb),
            point: [-u, v],
            along,
            angle_deg: -angle_deg,
            radius,
            flare,
        },
        Placement::Flat { point: [u, v], at: [x, y, z], across, up } => Placement::Flat {
            point: [-u, v],
            at: [-x, y, z],
            // The image of -u: +u goes to the image of `across` turned about.
            across: [across[0], -across[1], -across[2]],
            up: [-up[0], up[1], up[2]],
        },
        Placement::Hung(hang) => Placement::Hung(hang.mirrored()),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn a_mirrored_piece_lies_where_the_mirror_shows_it_and_its_right_side_too() {
        let placed = |placement: &Placement, [u, v]: [f64; 2]| {
            let Placement::Flat { point, at, across, up } = placement else { panic!("not flat") };
            DVec3::from(*at) + (u - point[0]) * DVec3::from(*across) + (v - point[1]) * DVec3::from(*up)
        };
        let own = Placement::Flat {
            point: [0.1, 0.2],
            at: [0.3, 1.0, 0.2],
            across: [0.6, 0.0, -0.8],
            up: [0.0, 1.0, 0.0],
        };
        let image = placement(&own);
        let seen = placed(&own, [0.4, 0.7]) * DVec3::new(-1.0, 1.0, 1.0);
        assert!(placed(&image, [-0.4, 0.7]).distance(seen) < 1e-12);
        let right_side = |placement: &Placement| match placement {
            Placement::Flat { across, up, .. } => DVec3::from(*across).cross(DVec3::from(*up)),
            _ => DVec3::ZERO,
        };
        let seen = right_side(&own) * DVec3::new(-1.0, 1.0, 1.0);
        assert!(right_side(&image).distance(seen) < 1e-12);
        assert_eq!(placement(&image), own);
    }

    #[test]
    fn names_change_sides_by_whole_words() {
        assert_eq!(name("left sleeve front"), "right sleeve front");
        assert_eq!(name("leftover"), "leftover");
    }
}
