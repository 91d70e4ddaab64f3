//! From a garment's directions to pictures over its panels.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use amc_core::color::linear_from_srgb;
use amc_core::direction::Direction;
use amc_core::image::Picture;
use amc_core::mesh::Garment;
use amc_core::render::{LaidPrint, Print};
use amc_core::{Progress, Result};
use glam::{Affine2, Mat2, Vec2, Vec3};
use rayon::prelude::*;

use super::convolution::{Smear, convolved};
use super::edges::extended;
use super::spread::percentiles;
use super::strain::{at_vertices, strains};
use super::streamlines::{Domain, streamlines};
use super::{ColorScale, Field, FlatPanel, Grid, Settings, Show, Spread, Strain, checker, patches, strokes};

/// Texels of all of a garment's pictures together: of lines, and of what is smooth.
const TEXELS: (f32, f32) = (4.0e6, 1.0e6);
/// The least side of a texel, metres.
const FINEST: f32 = 2.5e-4;
/// How broad a grain of smeared noise is on the cloth, metres, how many texels it has, and how many grains it is smeared to either side.
const GRAIN: (f32, f32, f32) = (1.3e-3, 1.8, 12.0);
/// Between streamlines, and their width, metres.
const LINES: (f32, f32) = (8e-3, 1.4e-3);
/// The cell of an arrow, and the width of its lines, metres.
const ARROWS: (f32, f32) = (2.2e-2, 1.6e-3);
/// sRGB values of what is dark and of what is light where lines are drawn.
const TONES: [[f32; 3]; 2] = [[0.10, 0.13, 0.20], [0.93, 0.92, 0.88]];

/// How a panel is cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    /// Its direction.
    pub direction: Direction,
    /// Whether that is all: not where strokes comb it. A procedural field is never steady.
    pub is_combed: bool,
}

/// What is to be seen.
#[derive(Debug, Clone)]
pub struct Asked {
    /// The garment.
    pub garment: Arc<Garment>,
    /// Its vertices' directions: unit, object space.
    pub vectors: Arc<Vec<Vec3>>,
    /// One for each panel.
    pub cuts: Vec<Cut>,
    /// What is shown.
    pub show: Show,
    /// How.
    pub settings: Settings,
}

/// What is seen of a garment.
#[derive(Debug)]
pub struct Seen {
    /// What is shown.
    pub show: Show,
    /// How.
    pub settings: Settings,
    /// Whose.
    pub garment: Arc<Garment>,
    /// One for each panel; none where it has no flat pattern, or takes no fabric.
    pub panels: Vec<Option<SeenPanel>>,
    /// What the colours of a heat map mean; in its unit: per cent of length, or degrees.
    pub scale: Option<ColorScale>,
    flat: Arc<Vec<Option<FlatPanel>>>,
}

/// What is seen of a panel.
#[derive(Debug, Clone)]
pub struct SeenPanel {
    /// The picture, and where it lies.
    pub laid: LaidPrint,
    /// A heat map's values.
    spread: Option<Arc<Spread>>,
    /// How many times larger than it is a weave is drawn.
    pub enlargement: f32,
    /// Of all that it follows from.
    key: u64,
}

impl PartialEq for Asked {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.garment, &other.garment)
            && Arc::ptr_eq(&self.vectors, &other.vectors)
            && self.cuts == other.cuts
            && self.show == other.show
            && self.settings == other.settings
    }
}

/// The pictures of a garment. Of `before` those are kept that would come out the same.
///
/// # Errors
/// [`amc_core::ErrorKind::Cancelled`]; not one direction for each vertex.
pub fn seen(asked: &Asked, before: Option<&Seen>, progress: &Progress<'_>) -> Result<Seen> {
    let Asked { garment, vectors, cuts, show, settings } = asked;
    if vectors.len() != garment.positions.len() || cuts.len() != garment.panels.len() {
        return Err(amc_core::Error::invalid("not one direction for each vertex and each panel"));
    }
    let before = before.filter(|before| Arc::ptr_eq(&before.garment, garment));
    progress.step("laying panels flat", 0, garment.panels.len())?;
    let flat = before.map_or_else(|| Arc::new(laid_flat(garment)), |before| Arc::clone(&before.flat));
    let heat = if show.is_heat_map() { Heat::new(asked, &flat, progress)? } else { Heat::default() };
    let area: f32 = flat.iter().flatten().map(|panel| panel.size().element_product()).sum();
    let (texels, finest) = match show {
        Show::Lines => (TEXELS.0, GRAIN.0 / GRAIN.1),
        _ if show.is_heat_map() => (TEXELS.1, FINEST),
        _ => (TEXELS.0, FINEST),
    };
    let texel = (area / texels).sqrt().max(finest);
    let tile = match show {
        Show::Checker => Some(Arc::new(checker::tile()?)),
        Show::Weave => Some(Arc::new(settings.weave.within_bounds().tile()?)),
        _ => None,
    };
    let maker = Maker { asked, heat: &heat, tile, texel, progress };
    let done = AtomicUsize::new(0);
    let of = |(number, panel): (usize, &Option<FlatPanel>)| {
        let Some(panel) = panel else { return Ok(None) };
        let key = maker.key(number, panel);
        let known = before.and_then(|before| before.panels[number].as_ref()).filter(|known| known.key == key);
        let made = known.map_or_else(|| maker.panel(number, panel, key), |known| Ok(known.clone()));
        progress.step("drawing", done.fetch_add(1, Ordering::Relaxed) + 1, flat.len())?;
        made.map(Some)
    };
    let panels = flat.par_iter().enumerate().map(of).collect::<Result<Vec<_>>>()?;
    let (garment, scale) = (Arc::clone(garment), heat.scale);
    Ok(Seen { show: *show, settings: *settings, garment, panels, scale, flat })
}

impl Seen {
    /// A heat map's percentiles over these panels; over all where there are none of them. In the unit of the scale.
    pub fn percentiles(&self, of: impl Fn(usize) -> bool) -> Option<[f32; 5]> {
        let spreads = |is_wanted: &dyn Fn(usize) -> bool| -> Vec<&Spread> {
            let wanted = self.panels.iter().enumerate().filter(|(number, _)| is_wanted(*number));
            wanted.filter_map(|(_, panel)| panel.as_ref()?.spread.as_deref()).collect()
        };
        percentiles(&spreads(&of)).or_else(|| percentiles(&spreads(&|_| true)))
    }

    /// Whether the lengths of all panels' flat patterns are said by the file; else they are those that agree best with the garment.
    pub fn has_true_lengths(&self) -> bool {
        let panels = self.garment.panels.iter().zip(&self.panels);
        panels.filter(|(_, seen)| seen.is_some()).all(|(panel, _)| panel.pattern.uv_unit.is_some())
    }

    /// Panels that take a fabric but have no flat pattern: nothing is seen of them.
    pub fn without_pattern(&self) -> usize {
        let panels = self.garment.panels.iter().zip(&self.panels);
        panels.filter(|(panel, seen)| panel.takes_fabric && seen.is_none()).count()
    }
}

fn laid_flat(garment: &Garment) -> Vec<Option<FlatPanel>> {
    let flat = |number: usize| {
        let takes_fabric = garment.panels[number].takes_fabric;
        takes_fabric.then(|| FlatPanel::new(garment, number)).flatten()
    };
    (0..garment.panels.len()).into_par_iter().map(flat).collect()
}

/// A value for each of a panel's triangles, with the area, and how they are spread.
type PanelHeat = (Vec<Option<(f32, f32)>>, Arc<Spread>);

/// The values of a heat map.
#[derive(Debug, Default)]
struct Heat {
    /// One for each panel.
    panels: Vec<Option<PanelHeat>>,
    scale: Option<ColorScale>,
}

impl Heat {
    fn new(asked: &Asked, flat: &[Option<FlatPanel>], progress: &Progress<'_>) -> Result<Self> {
        let values = |(number, panel): (usize, &Option<FlatPanel>)| {
            progress.step("measuring", number, flat.len())?;
            let Some(panel) = panel else { return Ok(None) };
            let values: Vec<Option<(f32, f32)>> = asked
                .strains(number, panel)
                .into_iter()
                .map(|it| it.map(|(strain, area)| (value(asked.show, &strain), area)))
                .collect();
            let spread = Arc::new(Spread::new(values.iter().flatten().copied()));
            Ok(Some((values, spread)))
        };
        let panels = flat.par_iter().enumerate().map(values).collect::<Result<Vec<_>>>()?;
        let spreads: Vec<&Spread> = panels.iter().flatten().map(|(_, spread)| &**spread).collect();
        let [low, _, _, _, high] = percentiles(&spreads).unwrap_or_default();
        let scale = match asked.show {
            Show::Shear => ColorScale::diverging(90.0, [low, high], 1.0),
            Show::GradientAgainstYarn => ColorScale::rising(high, 1.0),
            _ => ColorScale::diverging(0.0, [low, high], 1.0),
        };
        Ok(Self { panels, scale: Some(scale) })
    }
}

/// What a heat map shows of a strain: per cent, or degrees.
fn value(show: Show, strain: &Strain) -> f32 {
    match show {
        Show::WeftStretch => 100.0 * (strain.weft - 1.0),
        Show::Shear => strain.angle.to_degrees(),
        Show::GradientAgainstYarn => strain.turn.to_degrees(),
        _ => 100.0 * (strain.warp - 1.0),
    }
}

impl Asked {
    /// Where the warp runs all over a flat panel; none where that varies.
    fn steady(&self, number: usize, panel: &FlatPanel) -> Option<Vec2> {
        let Cut { direction, is_combed } = self.cuts[number];
        let is_field = matches!(direction.source, amc_core::direction::Source::Field(_));
        (!is_combed && !is_field).then(|| direction.on_cloth(panel.uv_to_flat.matrix2))
    }

    fn strains(&self, number: usize, panel: &FlatPanel) -> Vec<Option<(Strain, f32)>> {
        if let Some(along) = self.steady(number, panel) {
            return strains(panel, &self.garment, |_| along);
        }
        let vertices = panel.taken_back(&self.garment, &self.vectors);
        strains(panel, &self.garment, |triangle| {
            let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
            let aligned = |d: Vec2| if d.dot(a) < 0.0 { -d } else { d };
            (a + aligned(b) + aligned(c)).normalize_or(Vec2::X)
        })
    }
}

/// Makes the pictures.
struct Maker<'a> {
    asked: &'a Asked,
    heat: &'a Heat,
    /// What is repeated over all panels.
    tile: Option<Arc<Print>>,
    /// Metres.
    texel: f32,
    progress: &'a Progress<'a>,
}

impl Maker<'_> {
    /// Of everything a panel's picture follows from, but for the garment.
    fn key(&self, number: usize, panel: &FlatPanel) -> u64 {
        let Asked { vectors, show, settings, .. } = self.asked;
        let mut hasher = DefaultHasher::new();
        show.hash(&mut hasher);
        let bits = |values: &[f32], hasher: &mut DefaultHasher| {
            values.iter().for_each(|it| it.to_bits().hash(hasher))
        };
        match show {
            Show::Checker => (settings.square as u8).hash(&mut hasher),
            Show::Weave => {
                (settings.weave.binding as u8).hash(&mut hasher);
                bits(&[settings.weave.ends, settings.weave.picks, settings.weave.enlargement], &mut hasher);
            }
            _ => {}
        }
        if let Some(scale) = self.heat.scale {
            bits(&[scale.low, scale.high], &mut hasher);
        }
        let follows_steady = show.is_heat_map() || *show == Show::Weave;
        match self.asked.steady(number, panel).filter(|_| follows_steady) {
            _ if *show == Show::Checker => {}
            Some(along) => bits(&along.to_array(), &mut hasher),
            None => panel.vertices.iter().for_each(|&k| bits(&vectors[k as usize].to_array(), &mut hasher)),
        }
        hasher.finish()
    }

    fn panel(&self, number: usize, panel: &FlatPanel, key: u64) -> Result<SeenPanel> {
        let weave = self.asked.settings.weave.within_bounds();
        let mut enlargement = weave.enlargement;
        let mut spread = None;
        let laid = match (self.asked.show, &self.tile, self.asked.steady(number, panel)) {
            (Show::Checker, Some(tile), _) => repeated(tile, self.asked.settings.square.laying(), panel),
            (Show::Weave, Some(tile), Some(along)) => {
                // The front up.
                let turned = Mat2::from_diagonal(Vec2::new(if panel.is_mirrored { -1.0 } else { 1.0 }, 1.0));
                repeated(tile, weave.laying(turned * along) * Affine2::from_mat2(turned), panel)
            }
            (Show::Weave, _, _) => {
                let weave = patches::drawable(weave, self.grid(panel).texel);
                enlargement = weave.enlargement;
                once(patches::woven(&self.field(panel), &weave)?, self.grid(panel), panel)?
            }
            (Show::Lines, _, _) => self.lines(panel)?,
            (Show::Streamlines | Show::Arrows, _, _) => self.strokes(panel)?,
            _ => {
                let (laid, of) = self.heat_map(number, panel)?;
                spread = of;
                laid
            }
        };
        Ok(SeenPanel { laid, spread, enlargement, key })
    }

    fn grid(&self, panel: &FlatPanel) -> Grid {
        Grid::over(panel, self.texel)
    }

    fn field(&self, panel: &FlatPanel) -> Field {
        let vertices = panel.taken_back(&self.asked.garment, &self.asked.vectors);
        Field::new(panel, self.grid(panel), &vertices)
    }

    fn lines(&self, panel: &FlatPanel) -> Result<LaidPrint> {
        let field = self.field(panel);
        // As broad as it should be, or as it can be.
        let grain = (GRAIN.0 / field.grid.texel).clamp(1.2, 2.0 * GRAIN.1);
        let smear = Smear { grain, reach: (grain * GRAIN.2) as usize };
        let values = convolved(&field, smear, self.progress)?;
        once(toned(&values, &field), field.grid, panel)
    }

    fn strokes(&self, panel: &FlatPanel) -> Result<LaidPrint> {
        let field = self.field(panel);
        let grid = field.grid;
        let (lines, width) = match self.asked.show {
            Show::Arrows => (strokes::arrows(&field, ARROWS.0), ARROWS.1),
            _ => {
                let domain = Domain { low: panel.low, high: panel.high };
                let along = |at: Vec2, heading: Vec2| field.along_metres(at, heading);
                (streamlines(domain, LINES.0.max(6.0 * grid.texel), along), LINES.1)
            }
        };
        let covered = strokes::drawn(grid, &lines, width);
        let values: Vec<f32> = covered.into_iter().map(|share| 1.0 - share).collect();
        once(toned(&values, &field), grid, panel)
    }

    fn heat_map(&self, number: usize, panel: &FlatPanel) -> Result<(LaidPrint, Option<Arc<Spread>>)> {
        let grid = self.grid(panel);
        let mut pixels = vec![[0.0; 4]; grid.count()];
        let known = self.heat.panels.get(number).and_then(Option::as_ref).zip(self.heat.scale);
        if let Some(((values, _), scale)) = known {
            let vertices = at_vertices(panel, values);
            grid.fill(panel, &mut pixels, |triangle, shares| {
                let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
                let value = a * shares.x + b * shares.y + c * shares.z;
                if value.is_nan() { [0.0; 4] } else { opaque(scale.color(value)) }
            });
        }
        Ok((once(pixels, grid, panel)?, known.map(|((_, spread), _)| Arc::clone(spread))))
    }
}

fn opaque(encoded: [f32; 3]) -> [f32; 4] {
    let [r, g, b] = encoded.map(linear_from_srgb);
    [r, g, b, 1.0]
}

/// From 0, dark, to 1, light, where the field reaches.
fn toned(values: &[f32], field: &Field) -> Vec<[f32; 4]> {
    let [dark, light] = TONES.map(|tone| Vec3::from_array(tone.map(linear_from_srgb)));
    let pixel = |(index, &value): (usize, &f32)| {
        let shown = field.holds(index) && value.is_finite();
        if shown { dark.lerp(light, value).extend(1.0).to_array() } else { [0.0; 4] }
    };
    values.iter().enumerate().map(pixel).collect()
}

/// A picture over a panel.
fn once(pixels: Vec<[f32; 4]>, grid: Grid, panel: &FlatPanel) -> Result<LaidPrint> {
    let picture = Picture::new(grid.width as u32, grid.height as u32, extended(pixels, grid.width))?;
    Ok(LaidPrint {
        print: Arc::new(Print::new(&picture)?),
        uv_to_picture: grid.to_picture() * panel.uv_to_flat,
        is_repeated: false,
    })
}

/// A tile all over a panel.
fn repeated(tile: &Arc<Print>, laying: Affine2, panel: &FlatPanel) -> LaidPrint {
    LaidPrint { print: Arc::clone(tile), uv_to_picture: laying * panel.uv_to_flat, is_repeated: true }
}
