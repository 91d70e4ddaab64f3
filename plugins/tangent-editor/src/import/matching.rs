//! Which panel a piece of a file is.

use amc_core::mesh::Garment;
use amc_core::{Progress, Result};
use glam::Vec2;

use super::fit::{Fit, fit};
use super::outline::Shape;
use super::{Entry, listed};

/// Metres that files count in, whatever they say of it: a metre, a centimetre, a millimetre, an inch.
const UNITS: [f32; 4] = [1.0, 0.01, 0.001, 0.0254];
/// How far a piece may be off its panel in length, of it: less than from one size of clothes to the next.
const SIZE: f32 = 0.015;
/// Most pairs of a piece and a panel that are compared by their shapes.
const MOST_PAIRS: usize = 4000;
/// A fit that is better than all others by this factor is the one.
const CLEARLY: f32 = 3.0;

/// An entry and a panel that it is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Match {
    pub(super) entry: usize,
    pub(super) panel: usize,
    /// How the entry's shape lies against the panel's; none where it has none that fits.
    pub(super) fit: Option<Fit>,
}

/// Matches entries to panels (whose outlines are given): by id, by name, by shape. What is matched by shape and what is not
/// matched is told.
///
/// # Errors
/// Cancelled.
pub(super) fn matched(
    garment: &Garment,
    outlines: &[Option<Vec<Vec2>>],
    entries: &[Entry],
    progress: &Progress<'_>,
) -> Result<(Vec<Match>, Vec<String>)> {
    let shape = |line: &Vec<Vec2>| Shape::new(line);
    let mut matcher = Matcher {
        garment,
        panels: outlines.iter().map(|line| line.as_ref().and_then(shape)).collect(),
        pieces: entries.iter().map(|entry| entry.outlines.iter().filter_map(shape).collect()).collect(),
        entries,
        is_claimed: vec![false; garment.panels.len()],
        pairs: 0,
        matches: Vec::new(),
    };
    let (open, twice) = matcher.by_words(progress)?;
    let notices = matcher.by_shape(open, progress)?;
    let mut matches = matcher.matches;
    matches.sort_by_key(|it| (it.entry, it.panel));
    let twice = listed(twice.iter().map(|&entry| entries[entry].name.as_str()));
    let again = (!twice.is_empty()).then(|| format!("said more than once, the first counts: {twice}"));
    Ok((matches, notices.into_iter().chain(again).collect()))
}

/// An entry that is not matched yet, and the panels that it may be; none: any.
type Open = (usize, Option<Vec<usize>>);

struct Matcher<'a> {
    garment: &'a Garment,
    entries: &'a [Entry],
    panels: Vec<Option<Shape>>,
    /// The shapes that each entry may have.
    pieces: Vec<Vec<Shape>>,
    is_claimed: Vec<bool>,
    /// Compared so far.
    pairs: usize,
    matches: Vec<Match>,
}

impl Matcher<'_> {
    fn claim(&mut self, entry: usize, panel: usize, fit: Option<Fit>) {
        self.is_claimed[panel] = true;
        self.matches.push(Match { entry, panel, fit });
    }

    /// Matches by ids, then by names. Gives the entries that are left, and those whose panel has been matched before.
    fn by_words(&mut self, progress: &Progress<'_>) -> Result<(Vec<Open>, Vec<usize>)> {
        let (mut named, mut open, mut twice) = (Vec::new(), Vec::new(), Vec::new());
        for (index, entry) in self.entries.iter().enumerate() {
            let id = entry.record.id.as_ref();
            match self.garment.panels.iter().position(|panel| Some(&panel.id) == id) {
                Some(panel) if self.is_claimed[panel] => twice.push(index),
                Some(panel) => {
                    let fit = self.best_fit(index, panel);
                    self.claim(index, panel, fit);
                }
                None => named.push(index),
            }
            progress.step("matching the pieces", index, 2 * self.entries.len())?;
        }
        let keys: Vec<[String; 2]> =
            self.garment.panels.iter().map(|panel| [key(&panel.name), key(&panel.id)]).collect();
        for index in named {
            let wanted = key(&self.entries[index].name);
            let fits = |panel: &usize| !wanted.is_empty() && keys[*panel].contains(&wanted);
            let found: Vec<usize> = (0..keys.len()).filter(fits).collect();
            let free: Vec<usize> = found.iter().copied().filter(|&panel| !self.is_claimed[panel]).collect();
            match free.as_slice() {
                [] if found.is_empty() => open.push((index, None)),
                [] => twice.push(index),
                &[panel] => {
                    let fit = self.best_fit(index, panel);
                    self.claim(index, panel, fit);
                }
                _ => open.push((index, Some(free))),
            }
        }
        Ok((open, twice))
    }

    /// Matches what is left by shape, and tells of it.
    fn by_shape(&mut self, mut open: Vec<Open>, progress: &Progress<'_>) -> Result<Vec<String>> {
        let mut fits: Vec<Vec<(usize, Fit)>> = Vec::new();
        for (done, (entry, among)) in open.iter().enumerate() {
            progress.step("matching the pieces", self.entries.len() + done, 2 * self.entries.len())?;
            let panels = (0..self.panels.len())
                .filter(|panel| among.as_ref().is_none_or(|among| among.contains(panel)))
                .filter(|&panel| !self.is_claimed[panel] && self.is_of_size(*entry, panel));
            let panels: Vec<usize> = panels.collect();
            let fitting = panels.into_iter().filter_map(|panel| Some((panel, self.best_fit(*entry, panel)?)));
            fits.push(fitting.collect());
        }
        let mut notices = Vec::new();
        // Each match leaves fewer panels for the others.
        while let Some((place, chosen)) = (0..open.len()).find_map(|place| {
            let free: Vec<(usize, Fit)> =
                fits[place].iter().copied().filter(|(panel, _)| !self.is_claimed[*panel]).collect();
            let chosen = clear(&free, self.entries[open[place].0].quantity);
            (!chosen.is_empty()).then_some((place, chosen))
        }) {
            let (entry, _) = open.remove(place);
            fits.remove(place);
            let names = listed(chosen.iter().map(|(panel, _)| self.garment.panels[*panel].name.as_str()));
            notices.push(format!("{} is known by its shape: {names}", self.entries[entry].name));
            for (panel, fit) in chosen {
                self.claim(entry, panel, Some(fit));
            }
        }
        let mut unknown = Vec::new();
        for ((entry, among), fits) in open.iter().zip(&fits) {
            let fitting = fits.iter().map(|fit| fit.0).filter(|&panel| !self.is_claimed[panel]);
            let mut several: Vec<usize> = fitting.collect();
            if several.is_empty() {
                several.extend(among.iter().flatten().filter(|&&panel| !self.is_claimed[panel]));
            }
            let name = self.entries[*entry].name.as_str();
            if several.is_empty() {
                unknown.push(name);
            } else {
                let panels = listed(several.iter().map(|&panel| self.garment.panels[panel].name.as_str()));
                notices.push(format!("{name} may be any of several panels, so it is left out: {panels}"));
            }
        }
        if !unknown.is_empty() {
            let unknown = listed(unknown.into_iter());
            notices.insert(
                0,
                format!("no panel is like these, by name or shape, so they are left out: {unknown}"),
            );
        }
        Ok(notices)
    }

    /// How an entry fits a panel, by the best of its shapes.
    fn best_fit(&mut self, entry: usize, panel: usize) -> Option<Fit> {
        let panel = self.panels[panel].as_ref()?;
        self.pairs += 1;
        if self.pairs > MOST_PAIRS {
            return None;
        }
        let fits = self.pieces[entry].iter().filter_map(|piece| fit(piece, panel));
        fits.min_by(|a, b| a.error.total_cmp(&b.error))
    }

    /// Whether an entry is as large as a panel, whatever its file counts in.
    fn is_of_size(&self, entry: usize, panel: usize) -> bool {
        let Some(panel) = &self.panels[panel] else { return false };
        let is_alike = |piece: &Shape| {
            let unit = (panel.area / piece.area).sqrt();
            UNITS.iter().any(|known| (unit / known - 1.0).abs() < SIZE)
        };
        self.pieces[entry].iter().any(is_alike)
    }
}

/// The panels that are meant, of those that fit: the only one, the only one that need not be mirrored, as many as are to be cut, or
/// one that fits far better than the others. None where nothing is clear.
fn clear(fits: &[(usize, Fit)], quantity: usize) -> Vec<(usize, Fit)> {
    let mut best = fits.to_vec();
    best.sort_by(|a, b| a.1.error.total_cmp(&b.1.error));
    let straight: Vec<(usize, Fit)> = fits.iter().copied().filter(|(_, fit)| !fit.is_mirrored).collect();
    match best.as_slice() {
        [_] => best,
        _ if fits.len() <= quantity => best,
        _ if quantity == 1 && straight.len() == 1 => straight,
        [first, second, ..] if CLEARLY * first.1.error < second.1.error => vec![*first],
        _ => Vec::new(),
    }
}

/// A name by which pieces and panels are compared: many programs keep nothing but letters and digits.
fn key(name: &str) -> String {
    name.chars().filter(char::is_ascii_alphanumeric).map(|letter| letter.to_ascii_lowercase()).collect()
}
