//! Panels as groups of an OBJ.

use std::fmt::Display;
use std::io::{self, Write};

use glam::Vec2;

use super::PanelMesh;

/// An OBJ being written: it counts its vertices.
pub(super) struct Obj<'a> {
    out: &'a mut dyn Write,
    /// Vertices so far.
    vertices: u64,
}

impl<'a> Obj<'a> {
    pub(super) fn new(out: &'a mut dyn Write) -> Self {
        Self { out, vertices: 0 }
    }

    /// A line that programs pass over.
    pub(super) fn comment(&mut self, text: impl Display) -> io::Result<()> {
        writeln!(self.out, "# {text}")
    }

    /// A panel as a group; without `uvs` there must be none in the whole file, so that their count never runs behind the
    /// vertices'.
    pub(super) fn panel(&mut self, mesh: &PanelMesh<'_>, uvs: Option<&[Vec2]>) -> io::Result<()> {
        writeln!(self.out, "g {}", one_word(&mesh.panel.name))?;
        self.lines("v", mesh.positions.iter().map(|p| p.to_array()))?;
        self.lines("vn", mesh.normals.iter().map(|n| n.to_array()))?;
        if let Some(uvs) = uvs {
            self.lines("vt", uvs.iter().map(|uv| uv.to_array()))?;
        }
        for corners in &mesh.triangles {
            write!(self.out, "f")?;
            for corner in corners {
                let k = self.vertices + 1 + u64::from(*corner);
                match uvs {
                    Some(_) => write!(self.out, " {k}/{k}/{k}")?,
                    None => write!(self.out, " {k}//{k}")?,
                }
            }
            writeln!(self.out)?;
        }
        self.vertices += mesh.positions.len() as u64;
        Ok(())
    }

    fn lines<const N: usize>(
        &mut self,
        keyword: &str,
        rows: impl Iterator<Item = [impl Display; N]>,
    ) -> io::Result<()> {
        for row in rows {
            write!(self.out, "{keyword}")?;
            for number in row {
                write!(self.out, " {number}")?;
            }
            writeln!(self.out)?;
        }
        Ok(())
    }
}

/// A name as one word on one line, which is all that OBJ can hold.
pub(super) fn one_word(name: &str) -> String {
    let word: String =
        name.chars().map(|c| if c.is_whitespace() || c.is_control() { '_' } else { c }).collect();
    if word.is_empty() { "panel".to_owned() } else { word }
}
