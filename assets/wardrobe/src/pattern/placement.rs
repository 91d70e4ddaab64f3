//! Where a piece lies before it is sewn.

use serde::{Deserialize, Serialize};

use super::Hang;

/// Where a piece lies before it is sewn. The right side faces away from the limb.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Placement {
    /// Wrapped round a limb of the figure: +v of the piece goes along the limb's axis towards its start (upwards on the
    /// torso, towards the shoulder on an arm), +u counter-clockwise round it as seen from its start (on the torso: from
    /// the wearer's right to the wearer's left at the front).
    Around {
        /// The limb's name: see [`crate::body::Figure`].
        limb: String,
        /// The piece's point, metres, that goes to the place below.
        point: [f64; 2],
        /// Distance of that point from the limb's start along its axis, metres; negative: beyond it.
        along: f64,
        /// Where round the limb, degrees from its front (torso, legs, neck) or its outer side (arms), counter-clockwise as
        /// seen from the limb's start.
        angle_deg: f64,
        /// Distance from the axis, metres; the piece is bent to this radius.
        radius: f64,
        /// How much the radius grows per metre of distance from the start, -2 to 2: more than 0 for skirts, less for
        /// trouser legs; 0: a cylinder.
        #[serde(default)]
        flare: f64,
    },
    /// Flat in space.
    Flat {
        /// The piece's point, metres, that goes to `at`.
        point: [f64; 2],
        /// Where, metres.
        at: [f64; 3],
        /// Where +u goes: made unit.
        across: [f64; 3],
        /// Where +v goes: made perpendicular and unit. The right side faces `across x up`.
        up: [f64; 3],
    },
    /// Hung along a line in space, perhaps gathered: a scarf.
    Hung(Hang),
}
