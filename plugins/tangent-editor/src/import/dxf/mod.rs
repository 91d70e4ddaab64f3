//! Grain lines out of DXF, as AAMA and ASTM D6673 have it: a block for each piece, what a line means told by its layer.

mod groups;
#[cfg(test)]
mod tests;

use amc_core::direction::{Orientation, Record};
use amc_core::{Error, Result};
use glam::Vec2;

use self::groups::{Group, Groups};
use super::{Entry, MOST_PIECES, Way, clean};
use crate::texts;

/// The outline that is sewn, and that which is cut; in this order they are compared with a panel.
const OUTLINES: [&str; 2] = ["14", "1"];
/// The grain line.
const GRAIN: &str = "7";
/// Most outlines and grain lines of a piece that are kept.
const MOST_LINES: usize = 64;
/// A second grain line at least this long, of the first, counts as one too; shorter ones are heads of arrows.
const SECOND: f32 = 0.6;
/// Another direction than the first grain line's, sine of the angle.
const OTHER: f32 = 0.02;

/// A block, as far as it matters.
#[derive(Debug, Default)]
struct Block {
    name: String,
    /// Layer (place in [`OUTLINES`]) and points.
    outlines: Vec<(usize, Vec<Vec2>)>,
    /// From tail to tip.
    grains: Vec<[Vec2; 2]>,
    texts: Vec<String>,
}

/// A line that is being read, on its layer.
#[derive(Debug, Default)]
struct Line {
    layer: String,
    points: Vec<Vec2>,
}

/// Reads the pieces of a DXF file.
///
/// # Errors
/// No DXF in ASCII, a coordinate that is no number, more pieces than anybody cuts, or none.
pub fn parse(bytes: &[u8]) -> Result<Vec<Entry>> {
    let mut groups = Groups::new(bytes)?;
    let (mut blocks, mut reader) = (Vec::new(), Reader::default());
    while let Some(group) = groups.next()? {
        let ended = if group.code == 0 { reader.begin(&group.value) } else { reader.take(&group)? };
        blocks.extend(ended.filter(Block::is_piece));
        if blocks.len() > MOST_PIECES {
            return Err(Error::too_large(format!("more than {MOST_PIECES} pieces")).at_line(group.line));
        }
    }
    if blocks.is_empty() {
        let what = "no pieces in it (blocks with an outline or a grain line): save it as AAMA or ASTM DXF";
        return Err(Error::unsupported(what));
    }
    Ok(blocks.into_iter().map(Block::into_entry).collect())
}

/// What is being read.
#[derive(Debug, Default)]
struct Reader {
    block: Option<Block>,
    entity: String,
    /// The entity's layer and text.
    layer: String,
    text: String,
    /// The last point's x, until its y comes.
    x: Option<f32>,
    /// The points of the entity itself.
    points: Vec<Vec2>,
    /// The polyline whose vertices are coming.
    polyline: Option<Line>,
}

impl Reader {
    /// An entity begins, so the last one has ended; with it perhaps its block.
    fn begin(&mut self, entity: &str) -> Option<Block> {
        self.end_entity();
        let ended = match entity {
            "BLOCK" | "ENDBLK" | "ENDSEC" | "EOF" => self.block.take(),
            _ => None,
        };
        if entity == "BLOCK" {
            self.block = Some(Block::default());
        }
        entity.clone_into(&mut self.entity);
        self.layer.clear();
        self.text.clear();
        self.points.clear();
        self.x = None;
        ended
    }

    fn end_entity(&mut self) {
        let Some(block) = &mut self.block else { return };
        let layer = std::mem::take(&mut self.layer);
        match self.entity.as_str() {
            "POLYLINE" => self.polyline = Some(Line { layer, points: Vec::new() }),
            "VERTEX" => {
                if let Some(line) = &mut self.polyline {
                    line.points.append(&mut self.points);
                }
            }
            "SEQEND" => {
                if let Some(line) = self.polyline.take() {
                    block.add(line);
                }
            }
            "LINE" | "LWPOLYLINE" => block.add(Line { layer, points: std::mem::take(&mut self.points) }),
            "TEXT" if block.texts.len() < MOST_LINES => block.texts.push(clean(&self.text)),
            _ => {}
        }
    }

    fn take(&mut self, group: &Group<'_>) -> Result<Option<Block>> {
        let Some(block) = &mut self.block else { return Ok(None) };
        // The place of a polyline itself says nothing.
        let has_points = matches!(self.entity.as_str(), "VERTEX" | "LINE" | "LWPOLYLINE");
        match group.code {
            2 if self.entity == "BLOCK" => block.name = clean(&group.value),
            1 if self.entity == "TEXT" => group.value.as_ref().clone_into(&mut self.text),
            8 => group.value.as_ref().clone_into(&mut self.layer),
            10 | 11 if has_points => self.x = Some(group.number()?),
            20 | 21 if has_points => {
                let y = group.number()?;
                self.points.extend(self.x.take().map(|x| Vec2::new(x, y)));
            }
            _ => {}
        }
        Ok(None)
    }
}

impl Block {
    fn add(&mut self, line: Line) {
        let outline = OUTLINES.iter().position(|layer| *layer == line.layer);
        match (outline, line.points.as_slice()) {
            (Some(layer), [_, _, _, ..]) if self.outlines.len() < MOST_LINES => {
                self.outlines.push((layer, line.points));
            }
            (None, &[tail, .., tip]) if line.layer == GRAIN && self.grains.len() < MOST_LINES => {
                self.grains.push([tail, tip]);
            }
            _ => {}
        }
    }

    /// Not a symbol, or a drawing's own space.
    fn is_piece(&self) -> bool {
        let has_lines = !self.outlines.is_empty() || !self.grains.is_empty();
        has_lines && !self.name.starts_with('*')
    }

    fn into_entry(mut self) -> Entry {
        // The longest of each layer bounds the piece.
        self.outlines.sort_by_key(|(layer, points)| (*layer, std::cmp::Reverse(points.len())));
        self.outlines.dedup_by_key(|(layer, _)| *layer);
        let (way, mut remarks) = self.way();
        let said = |key: &str| {
            let value = |text: &String| {
                let (known, value) = text.split_once(':')?;
                known.trim().eq_ignore_ascii_case(key).then(|| value.trim().to_owned())
            };
            self.texts.iter().find_map(value).filter(|value| !value.is_empty())
        };
        let orientation = said("ANNOTATION").and_then(|text| orientation(&text));
        let name = said("PIECE NAME").unwrap_or_else(|| self.name.clone());
        let quantity = said("QUANTITY").and_then(|text| {
            let digits: String = text.chars().take_while(char::is_ascii_digit).collect();
            digits.parse().ok()
        });
        if self.outlines.is_empty() {
            remarks.push("the piece has no outline");
        }
        Entry {
            name: if name.is_empty() { "a block without a name".to_owned() } else { name },
            record: Record { orientation, ..Record::default() },
            way,
            outlines: self.outlines.into_iter().map(|(_, points)| points).collect(),
            quantity: quantity.unwrap_or(1).max(1),
            remarks,
        }
    }

    /// Along the longest grain line.
    fn way(&self) -> (Way, Vec<&'static str>) {
        let along = |ends: &[Vec2; 2]| ends[1] - ends[0];
        let mut lines: Vec<Vec2> = self.grains.iter().map(along).filter(|line| line.length() > 0.0).collect();
        lines.sort_by(|a, b| b.length().total_cmp(&a.length()));
        let Some(first) = lines.first().and_then(|line| line.try_normalize()) else {
            return (Way::Unsaid, vec!["there is no grain line on layer 7: the direction stays"]);
        };
        let is_other = |line: &Vec2| {
            line.length() > SECOND * lines[0].length()
                && first.perp_dot(line.normalize_or(first)).abs() > OTHER
        };
        let remarks = if lines.iter().any(is_other) {
            vec!["of several grain lines the longest is taken"]
        } else {
            Vec::new()
        };
        (Way::OnPiece(first), remarks)
    }
}

/// How a piece may be laid, as our own sheets say it.
fn orientation(text: &str) -> Option<Orientation> {
    let words = [
        (texts::TWO_WAY, Orientation::TwoWay),
        (texts::ONE_WAY, Orientation::OneWay),
        (texts::NAP, Orientation::Nap),
    ];
    words.into_iter().find(|(word, _)| word.eq_ignore_ascii_case(text)).map(|(_, orientation)| orientation)
}
