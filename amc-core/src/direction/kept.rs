//! The directions of a garment, kept while a person changes them.

use std::sync::Arc;

use super::comb::{Comb, CombSolver, CombedField, PanelMesh};
use super::tangents::{Share, renew, tangents, triangles_of};
use super::{Direction, Tangents};
use crate::mesh::{Garment, Panel};
use crate::progress::Progress;
use crate::{Error, Result};

/// As many triangles as are made anew within a share of a frame: two milliseconds or so.
const QUICK: u32 = 60_000;

/// What a panel's direction is to be: its own, and the strokes that comb it.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelDirection {
    /// Without strokes, and what they may follow elsewhere.
    pub own: Direction,
    /// The strokes; none: the panel's own direction, to the bit.
    pub comb: Option<Arc<Comb>>,
    /// The rotational symmetry of the panel's fabric, 1 to 4: directions that look the same are the same to the comb.
    pub symmetry: u32,
}

impl PanelDirection {
    /// A direction without strokes.
    pub fn plain(own: Direction) -> Self {
        Self { own, comb: None, symmetry: 1 }
    }
}

/// How exactly strokes are followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fineness {
    /// Nearly, on large panels: see [`CombSolver::preview`].
    Preview,
    /// Wholly.
    Whole,
}

/// The tangents of a garment, combed, `directions` being one per panel.
///
/// # Errors
/// As [`tangents`] and [`CombSolver::solve`]; the place is the panel.
pub fn combed_tangents(
    garment: &Garment,
    directions: &[PanelDirection],
    progress: Progress<'_>,
) -> Result<Tangents> {
    let own: Vec<Direction> = directions.iter().map(|direction| direction.own).collect();
    let mut made = tangents(garment, &own)?;
    for (index, (panel, direction)) in garment.panels.iter().zip(directions).enumerate() {
        let Some(comb) = &direction.comb else { continue };
        let place = |error: Error| error.at_element(format!("panel {}", panel.id));
        let mut solver = CombSolver::new(PanelMesh::new(garment, panel).map_err(place)?);
        let field = solver.solve(comb, direction.symmetry, &made.vectors, progress).map_err(place)?;
        field.put(Arc::make_mut(&mut made.vectors).as_mut_slice());
        made.combed[index] = true;
    }
    Ok(made)
}

/// The tangents of one garment. Only panels that change are made anew, and what the comb has reckoned of a panel's mesh is kept.
#[derive(Debug)]
pub struct KeptTangents {
    garment: Arc<Garment>,
    /// Of each panel, in ascending order.
    vertices: Vec<Box<[u32]>>,
    tangents: Tangents,
    panels: Vec<Kept>,
    scratch: Vec<Share>,
}

/// What is known of a panel.
#[derive(Debug, Default)]
struct Kept {
    /// What its tangents are, and how fine; none where they are not yet, or half done.
    now: Option<(PanelDirection, Fineness)>,
    solver: Option<CombSolver>,
    field: Option<Arc<CombedField>>,
}

impl KeptTangents {
    /// Of a garment all of whose panels have these directions, without strokes until [`KeptTangents::set`].
    ///
    /// # Errors
    /// As [`tangents`].
    pub fn new(garment: Arc<Garment>, own: &[Direction]) -> Result<Self> {
        let made = tangents(&garment, own)?;
        let vertices = garment.panels.iter().map(|panel| vertices_of(&garment, panel)).collect();
        let kept = |&own: &Direction| Kept {
            now: Some((PanelDirection::plain(own), Fineness::Whole)),
            ..Kept::default()
        };
        let panels = own.iter().map(kept).collect();
        Ok(Self { garment, vertices, tangents: made, panels, scratch: Vec::new() })
    }

    /// The garment.
    pub fn garment(&self) -> &Arc<Garment> {
        &self.garment
    }

    /// The tangents as they are now.
    pub fn tangents(&self) -> &Tangents {
        &self.tangents
    }

    /// What the strokes of each panel made; none where there are none.
    pub fn fields(&self) -> Vec<Option<Arc<CombedField>>> {
        self.panels.iter().map(|kept| kept.field.clone()).collect()
    }

    /// Whether [`KeptTangents::set`] is a matter of a frame: few triangles, and no strokes to follow.
    pub fn is_quick(&self, directions: &[PanelDirection]) -> bool {
        let mut triangles = 0;
        self.panels.len() == directions.len()
            && self.changed(directions, Fineness::Whole).all(|index| {
                let range = &self.garment.panels[index].triangles;
                triangles += range.end.saturating_sub(range.start);
                directions[index].comb.is_none() && triangles <= QUICK
            })
    }

    /// Makes the panels anew whose directions are not these, or not as fine. A preview of what is whole already stays whole.
    /// Says whether all is whole now.
    ///
    /// # Errors
    /// Not one direction per panel; as [`combed_tangents`]. What was not reached is as before.
    pub fn set(
        &mut self,
        directions: &[PanelDirection],
        fineness: Fineness,
        progress: Progress<'_>,
    ) -> Result<bool> {
        let (count, panels) = (directions.len(), self.panels.len());
        if count != panels {
            return Err(Error::invalid(format!("{count} directions for {panels} panels")));
        }
        let changed: Vec<usize> = self.changed(directions, fineness).collect();
        for index in changed {
            self.set_panel(index, &directions[index], fineness, progress)?;
        }
        Ok(self.panels.iter().all(|kept| matches!(kept.now, Some((_, Fineness::Whole)))))
    }

    fn changed<'a>(
        &'a self,
        directions: &'a [PanelDirection],
        fineness: Fineness,
    ) -> impl Iterator<Item = usize> + 'a {
        self.panels.iter().zip(directions).enumerate().filter_map(move |(index, (kept, wanted))| {
            let is_so = kept.now.as_ref().is_some_and(|(now, fine)| {
                let same = match (&now.comb, &wanted.comb) {
                    // Without strokes the symmetry says nothing.
                    (None, None) => now.own == wanted.own,
                    _ => now == wanted,
                };
                same && (fineness == Fineness::Preview || *fine == Fineness::Whole)
            });
            (!is_so).then_some(index)
        })
    }

    fn set_panel(
        &mut self,
        index: usize,
        wanted: &PanelDirection,
        fineness: Fineness,
        progress: Progress<'_>,
    ) -> Result<()> {
        let kept = &mut self.panels[index];
        (kept.now, kept.field) = (None, None);
        let panel = &self.garment.panels[index];
        let made = &mut self.tangents;
        renew(&self.garment, (index, &self.vertices[index]), &wanted.own, &mut self.scratch, made)?;
        let mut reached = Fineness::Whole;
        if let Some(comb) = &wanted.comb {
            let place = |error: Error| error.at_element(format!("panel {}", panel.id));
            let solver = match &mut kept.solver {
                Some(solver) => solver,
                none => none.insert(CombSolver::new(PanelMesh::new(&self.garment, panel).map_err(place)?)),
            };
            let own = &made.vectors;
            let field = match fineness {
                Fineness::Preview if solver.is_large() => {
                    reached = Fineness::Preview;
                    solver.preview(comb, wanted.symmetry, own, progress)
                }
                _ => solver.solve(comb, wanted.symmetry, own, progress),
            };
            let field = field.map_err(place)?;
            field.put(Arc::make_mut(&mut made.vectors).as_mut_slice());
            made.combed[index] = true;
            kept.field = Some(Arc::new(field));
        }
        kept.now = Some((wanted.clone(), reached));
        Ok(())
    }
}

fn vertices_of(garment: &Garment, panel: &Panel) -> Box<[u32]> {
    let mut vertices: Vec<u32> = triangles_of(garment, panel).as_flattened().to_vec();
    vertices.sort_unstable();
    vertices.dedup();
    vertices.into()
}

#[cfg(test)]
mod tests {
    use super::super::comb::{Elsewhere, Hold, Path, Stroke};
    use super::super::tests::{flat, garment_of};
    use super::super::{Field, Source};
    use super::*;
    use glam::{Quat, Vec2, Vec3};

    fn comb(turn: f32) -> Arc<Comb> {
        let points = vec![Vec2::new(0.2, 0.2), Vec2::new(0.2, 0.2) + Vec2::from_angle(turn) * 0.5];
        let stroke = Stroke { path: Path::Pattern(points), hold: Hold::Exact, radius: 0.1, is_on: true };
        Arc::new(Comb { strokes: vec![stroke], elsewhere: Elsewhere::Own, reach: 0.2, turn: 0.0 })
    }

    fn three() -> Arc<Garment> {
        let tilt = Quat::from_rotation_x(0.4);
        let map = |p: Vec2| Vec2::new(p.x + 0.2 * p.y, p.y);
        Arc::new(garment_of(&[flat(tilt, map), flat(tilt, |p| p), flat(tilt, |_| Vec2::ZERO)]))
    }

    #[test]
    fn what_is_kept_is_what_is_made_at_once_whatever_the_way_there() {
        let garment = three();
        let mut kept = KeptTangents::new(Arc::clone(&garment), &[Direction::default(); 3]).unwrap();
        let mut wanted = vec![PanelDirection::plain(Direction::default()); 3];
        let field = Source::Field(Field::Radial { origin: Vec3::new(0.1, 0.2, 0.3) });
        for step in 0..24_usize {
            let direction = &mut wanted[step % 3];
            direction.own.angle = step as f32 * 0.37;
            direction.own.source = [Source::Gradient, Source::Yarn, field][(step / 3) % 3];
            direction.comb = (step % 4 == 1).then(|| comb(step as f32));
            direction.symmetry = 1 + step as u32 % 4;
            let is_combed = direction.comb.is_some();
            assert_eq!(kept.is_quick(&wanted), !is_combed);
            let fineness = if step % 2 == 0 { Fineness::Preview } else { Fineness::Whole };
            assert!(kept.set(&wanted, fineness, Progress::none()).unwrap());
            let at_once = combed_tangents(&garment, &wanted, Progress::none()).unwrap();
            assert!(*kept.tangents() == at_once, "step {step}");
            let is_combed: Vec<bool> = kept.fields().iter().map(Option::is_some).collect();
            assert_eq!(is_combed, at_once.combed);
        }
    }

    #[test]
    fn what_was_broken_off_is_made_again() {
        let mut kept = KeptTangents::new(three(), &[Direction::default(); 3]).unwrap();
        let mut wanted = vec![PanelDirection::plain(Direction { angle: 1.0, ..Direction::default() }); 3];
        wanted[1].comb = Some(comb(0.3));
        let stop = std::sync::atomic::AtomicBool::new(true);
        let error = kept.set(&wanted, Fineness::Whole, Progress::new(&|_| (), &stop)).unwrap_err();
        assert_eq!(error.kind(), crate::ErrorKind::Cancelled);
        assert!(kept.set(&wanted, Fineness::Whole, Progress::none()).unwrap());
        assert!(*kept.tangents() == combed_tangents(&three(), &wanted, Progress::none()).unwrap());

        wanted[0].own.angle = f32::NAN;
        let message = kept.set(&wanted, Fineness::Whole, Progress::none()).unwrap_err().to_string();
        assert!(message.contains("panel id0"), "{message}");
        assert!(kept.set(&wanted[..2], Fineness::Whole, Progress::none()).is_err());
    }
}
