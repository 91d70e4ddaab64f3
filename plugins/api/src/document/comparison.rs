//! The other half of a split view.

use std::sync::Arc;

use amc_core::direction::{Direction, PanelDirection};
use serde::{Deserialize, Serialize};

use super::{ColourwayId, Colourways, FabricId};

/// What is different right of the divider of a split view. The default is: nothing.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Comparison {
    /// The id of the shading mode; none: that of the view.
    pub mode: Option<String>,
    /// The colourway; none, or one that is not there: the worn one.
    pub colourway: Option<ColourwayId>,
    /// What all panels with a fabric wear; none, or a fabric that is not in use: each its own.
    pub fabric: Option<FabricId>,
    /// How far all directions are turned, degrees, counter-clockwise in the flat pattern.
    pub turned_deg: f32,
}

impl Comparison {
    /// A panel's look in it. `worn` are the fabric that it wears in the colourway and the direction left of the divider; `is_used` says whether a fabric
    /// is there to be worn.
    pub fn look(
        &self,
        worn: (Option<FabricId>, PanelDirection),
        is_used: impl FnOnce(FabricId) -> bool,
    ) -> (Option<FabricId>, PanelDirection) {
        let (fabric, mut direction) = worn;
        let other = self.fabric.filter(|&id| is_used(id));
        let turn = self.turned_deg.to_radians();
        let angle = direction.own.angle + turn;
        direction.own = Direction { angle, ..direction.own };
        if let Some(comb) = direction.comb.as_mut().filter(|_| turn != 0.0) {
            Arc::make_mut(comb).turn += turn;
        }
        (fabric.map(|own| other.unwrap_or(own)), direction)
    }

    /// The colourway right of the divider, of these.
    pub fn colourway(&self, colourways: &Colourways) -> ColourwayId {
        let known = self.colourway.and_then(|id| colourways.get(id));
        known.unwrap_or_else(|| colourways.worn()).id
    }

    /// Whether panels look other than they do left of the divider, the shading mode aside.
    pub fn changes_panels(&self, colourways: &Colourways) -> bool {
        let is_other = self.colourway(colourways) != colourways.worn().id;
        is_other || self.fabric.is_some() || self.turned_deg != 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fabrics_and_directions_are_exchanged_where_there_is_cloth() {
        let [own, other, gone] = [0, 1, 2].map(FabricId::new);
        let direction = PanelDirection::plain(Direction { angle: 0.25, ..Direction::default() });
        let quarter = Comparison { turned_deg: 90.0, fabric: Some(other), ..Comparison::default() };
        let (fabric, turned) = quarter.look((Some(own), direction.clone()), |id| id == other);
        assert_eq!(fabric, Some(other));
        assert!((turned.own.angle - direction.own.angle - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
        assert_eq!(turned.own.source, direction.own.source);
        // Buttons stay buttons.
        assert_eq!(quarter.look((None, direction.clone()), |_| true).0, None);
        let lost = Comparison { fabric: Some(gone), ..Comparison::default() };
        assert_eq!(lost.look((Some(own), direction.clone()), |id| id == other), (Some(own), direction));
        let colourways = Colourways::default();
        let changes = |compared: &Comparison| compared.changes_panels(&colourways);
        assert!(!changes(&Comparison::default()) && changes(&quarter));
        // A colourway that is gone is the worn one.
        let gone = Comparison { colourway: Some(ColourwayId::new(7)), ..Comparison::default() };
        assert_eq!((gone.colourway(&colourways), changes(&gone)), (ColourwayId::new(0), false));
    }
}
