//! From strokes to a direction at every vertex.

use std::sync::Arc;

use faer::c64;
use glam::Vec3;
use rayon::prelude::*;

use super::clusters::Clusters;
use super::demands::Demands;
use super::edges::{ZERO, power};
use super::frame::{turn_onto, unit};
use super::panel_mesh::PanelMesh;
use super::singularities::{Singularity, singularities};
use super::stroke::{Comb, Stroke};
use super::system::System;
use super::{Complex, branches, elsewhere, lift};
use crate::progress::Progress;
use crate::{Error, Result};

/// Meshes of at most this many vertices are solved at once instead of being previewed.
const PREVIEWED_ABOVE: usize = 12_000;

/// Greatest rotational symmetry.
const MOST_SYMMETRY: u32 = 4;

/// Combs one panel, again and again: it keeps the order of elimination, which depends on the mesh alone, and the last
/// factor, which serves as long as strokes change no more than their senses, or the panel its angle.
#[derive(Debug)]
pub struct CombSolver {
    mesh: PanelMesh,
    /// None before the first solution.
    system: Option<System>,
    /// None before the first preview.
    clusters: Option<Clusters>,
}

/// A panel's direction, combed.
#[derive(Debug, Clone, PartialEq)]
pub struct CombedField {
    /// The garment's vertices that the panel uses.
    pub vertices: Arc<[u32]>,
    /// One for each of them, object space: unit, perpendicular to the garment's normal there.
    pub directions: Vec<Vec3>,
    /// Triangles around which the field turns; none in a preview.
    pub singularities: Vec<Singularity>,
    /// Strokes that are on and have no say, as places in [`Comb::strokes`]: without length, further off the panel than their
    /// radius, or in the flat pattern of a panel without UVs.
    pub unplaced: Vec<usize>,
}

impl CombedField {
    /// Puts the directions where a garment's vertices have theirs ([`crate::direction::Tangents::vectors`]). Vertices that
    /// are not there are passed over.
    pub fn put(&self, vectors: &mut [Vec3]) {
        for (&vertex, &direction) in self.vertices.iter().zip(&self.directions) {
            if let Some(vector) = vectors.get_mut(vertex as usize) {
                *vector = direction;
            }
        }
    }
}

/// All that is known before there is a field.
struct Asked {
    /// The panel's own direction.
    own: Vec<Complex>,
    /// What is asked for away from strokes, zero where nothing is.
    away: Vec<Complex>,
    demands: Demands,
}

impl Asked {
    /// What decides where directions are equal to the fabric.
    fn usual(&self) -> Vec<Complex> {
        let usual = |(&away, &own): (&Complex, &Complex)| if away == ZERO { own } else { away };
        self.away.iter().zip(&self.own).map(usual).collect()
    }
}

impl CombSolver {
    /// Of a panel's mesh. Quick: nothing is solved yet.
    pub fn new(mesh: PanelMesh) -> Self {
        Self { mesh, system: None, clusters: None }
    }

    /// The mesh.
    pub fn mesh(&self) -> &PanelMesh {
        &self.mesh
    }

    /// Whether [`CombSolver::preview`] is another than [`CombSolver::solve`].
    pub fn is_large(&self) -> bool {
        self.mesh.positions.len() > PREVIEWED_ABOVE
    }

    /// Where a stroke runs on the surface, object space, metres: points in its order; empty where it is off the panel.
    pub fn trace(&self, stroke: &Stroke) -> Vec<Vec3> {
        lift::lift(&self.mesh, stroke, 1).iter().map(|sample| sample.position.as_vec3()).collect()
    }

    /// The panel's direction.
    ///
    /// `symmetry` is the fabric's, 1 to 4; `own` the direction the panel has without the comb, one per vertex of the garment
    /// ([`crate::direction::Tangents::vectors`]). Where directions are the same to the fabric, those are chosen that agree with
    /// their neighbours, and with `own` where that can be.
    ///
    /// A piece of the panel on which no stroke runs has what `comb.elsewhere` says, without a solution: `own` itself,
    /// to the bit, with [`super::Elsewhere::Own`] and wherever there is nothing to say.
    ///
    /// # Errors
    /// What [`Comb::check`] refuses; a symmetry out of range; not one direction per vertex; a panel too large for the memory; an
    /// order to stop, which is heeded between the stages, the longest of which takes a second for 240,000 vertices.
    pub fn solve(
        &mut self,
        comb: &Comb,
        symmetry: u32,
        own: &[Vec3],
        progress: Progress<'_>,
    ) -> Result<CombedField> {
        let asked = self.ask(comb, symmetry, own, progress)?;
        let powers = if asked.demands.is_combed.contains(&true) {
            self.powers(&asked.demands, symmetry, progress)?
        } else {
            vec![ZERO; asked.own.len()]
        };
        progress.step("choosing directions", 0, 1)?;
        let singular = singularities(&self.mesh, &powers, symmetry);
        let chosen = branches::choose(&self.mesh, &powers, symmetry, &asked.usual());
        Ok(self.field(asked, &chosen, own, singular))
    }

    /// Nearly the panel's direction, in less time where the panel is large: from the mean directions of a few thousand
    /// clusters of vertices. The same as [`CombSolver::solve`] for up to 12,000 vertices; else without singular points, and of
    /// directions that are the same to the fabric those nearest to `own`, whatever the neighbours have.
    ///
    /// # Errors
    /// As [`CombSolver::solve`].
    pub fn preview(
        &mut self,
        comb: &Comb,
        symmetry: u32,
        own: &[Vec3],
        progress: Progress<'_>,
    ) -> Result<CombedField> {
        if !self.is_large() {
            return self.solve(comb, symmetry, own, progress);
        }
        let asked = self.ask(comb, symmetry, own, progress)?;
        let mut powers = vec![ZERO; asked.own.len()];
        if asked.demands.is_combed.contains(&true) {
            if self.clusters.is_none() {
                self.clusters = Some(Clusters::new(&self.mesh)?);
            }
            if let Some(clusters) = &mut self.clusters {
                powers = clusters.powers(&self.mesh, &asked.demands, symmetry)?;
            }
        }
        progress.step("choosing directions", 0, 1)?;
        let chosen = branches::nearest_to_own(&powers, symmetry, &asked.usual());
        Ok(self.field(asked, &chosen, own, Vec::new()))
    }

    fn ask(&self, comb: &Comb, symmetry: u32, own: &[Vec3], progress: Progress<'_>) -> Result<Asked> {
        comb.check()?;
        if !(1..=MOST_SYMMETRY).contains(&symmetry) {
            return Err(Error::invalid(format!("the symmetry {symmetry} is not from 1 to {MOST_SYMMETRY}")));
        }
        if self.mesh.vertices.last().is_some_and(|&last| last as usize >= own.len()) {
            return Err(Error::invalid(format!(
                "{} directions are fewer than the garment's vertices",
                own.len()
            )));
        }
        let own = elsewhere::own(&self.mesh, own, symmetry);
        let away = elsewhere::away(&self.mesh, comb, &own);
        let demands = Demands::new(&self.mesh, comb, symmetry, &away, progress)?;
        Ok(Asked { own, away, demands })
    }

    /// The field to the power of the symmetry, unit numbers; zero in pieces that are not combed.
    fn powers(&mut self, demands: &Demands, symmetry: u32, progress: Progress<'_>) -> Result<Vec<Complex>> {
        let edges = &self.mesh.edges;
        progress.step("ordering the mesh", 0, 3)?;
        let system = match &mut self.system {
            Some(system) => system,
            none => none.insert(System::new(&edges.starts, &edges.lower)?),
        };
        progress.step("combing", 1, 3)?;
        let (values, mut right) = assemble(&self.mesh, demands, symmetry);
        system.factor(values)?;
        progress.step("combing", 2, 3)?;
        system.solve(&mut right)?;
        let is_combed = |vertex: usize| demands.is_combed[self.mesh.pieces[vertex] as usize];
        let power = |(vertex, z): (usize, Complex)| match unit(z) {
            Some(z) if is_combed(vertex) => z,
            // The very middle of a singular point: any direction.
            None if is_combed(vertex) => c64::new(1.0, 0.0),
            _ => ZERO,
        };
        Ok(right.into_iter().enumerate().map(power).collect())
    }

    fn field(
        &self,
        asked: Asked,
        chosen: &[Complex],
        own: &[Vec3],
        singularities: Vec<Singularity>,
    ) -> CombedField {
        let mesh = &self.mesh;
        let direction = |((&vertex, &place), &normal): ((&u32, &u32), &Vec3)| {
            let place = place as usize;
            let is_combed = asked.demands.is_combed[mesh.pieces[place] as usize];
            let z = if is_combed { chosen[place] } else { asked.away[place] };
            if z == ZERO || (!is_combed && asked.away[place] == asked.own[place]) {
                return own[vertex as usize];
            }
            let frame = &mesh.frames[place];
            turn_onto(frame.vector(z), frame.normal, normal)
        };
        let places = mesh.vertices.par_iter().zip(&mesh.places).zip(&mesh.garment_normals);
        CombedField {
            vertices: mesh.vertices.clone(),
            directions: places.with_min_len(4096).map(direction).collect(),
            singularities,
            unplaced: asked.demands.unplaced,
        }
    }
}

/// The matrix's values, column by column with the diagonal last, and the right-hand side.
fn assemble(mesh: &PanelMesh, demands: &Demands, symmetry: u32) -> (Vec<Complex>, Vec<Complex>) {
    let edges = &mesh.edges;
    let count = mesh.positions.len();
    let is_combed = |vertex: usize| demands.is_combed[mesh.pieces[vertex] as usize];
    let mut diagonal = demands.weights.clone();
    let mut right = demands.sums.clone();
    for edge in 0..edges.count() {
        let [low, high] = [edges.lower[edge], edges.higher[edge]].map(|vertex| vertex as usize);
        diagonal[low] += edges.weights[edge];
        diagonal[high] += edges.weights[edge];
        // Zero where a neighbour is not fixed.
        let turn = power(edges.turns[edge], symmetry) * edges.weights[edge];
        right[high] += turn * demands.fixed[low];
        right[low] += turn.conj() * demands.fixed[high];
    }
    for (vertex, (diagonal, right)) in diagonal.iter_mut().zip(&mut right).enumerate() {
        let fixed = demands.fixed[vertex];
        if fixed != ZERO || !is_combed(vertex) {
            (*diagonal, *right) = (1.0, fixed);
        }
    }
    let mut values = Vec::with_capacity(edges.count() + count);
    for (column, &diagonal) in diagonal.iter().enumerate() {
        let is_free = |vertex: usize| demands.fixed[vertex] == ZERO && is_combed(vertex);
        for edge in edges.starts[column] as usize..edges.starts[column + 1] as usize {
            let is_kept = is_free(column) && is_free(edges.lower[edge] as usize);
            let value = power(edges.turns[edge], symmetry).conj() * -edges.weights[edge];
            values.push(if is_kept { value } else { ZERO });
        }
        values.push(c64::new(diagonal, 0.0));
    }
    (values, right)
}
