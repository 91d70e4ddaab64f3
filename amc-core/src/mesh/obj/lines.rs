//! The lines of an OBJ file, checked and plain.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::{self, BufRead, Read};
use std::str::SplitWhitespace;

use glam::Vec3;

use crate::mesh::Part;
use crate::mesh::draft::{check_position, clean_name};
use crate::mesh::fabric_words::names_no_fabric;
use crate::mesh::triangulate::CORNER_LIMIT;
use crate::{Error, Result};

/// Most changes of group, material or vertex format: each costs `tobj` a table.
const RUN_LIMIT: usize = 1 << 20;

/// An OBJ file as `tobj` is to see it, made line by line while `tobj` reads.
///
/// It sees `v` with three finite numbers, `vt` with two, `vn` with three, `f` with at least three corners whose
/// indices are absolute and in range, and `o` with the number of a part. `tobj` gives vertices without an index
/// someone else's, so a new `o` also starts where faces begin or cease to have UVs or normals.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    /// Number of the last physical line taken from `rest`.
    number: u64,
    plain: Vec<u8>,
    taken: usize,
    fault: Option<Error>,
    state: State,
}

/// What the lines so far have said.
#[derive(Default)]
struct State {
    positions: usize,
    uvs: usize,
    normals: usize,
    names: Names,
    parts: HashMap<Names, usize>,
    part_names: Vec<Names>,
    /// The part and vertex format that the last `o` line announced.
    run: Option<(usize, bool, bool)>,
    runs: usize,
    points_and_lines: usize,
    curves: usize,
    corners: Vec<[Option<usize>; 3]>,
}

/// What names the faces of a part.
#[derive(Default, Clone, PartialEq, Eq, Hash)]
struct Names {
    object: String,
    group: String,
    material: String,
}

/// What is known after the last line.
pub(super) struct Finished {
    pub(super) parts: Vec<Part>,
    /// `v` lines.
    pub(super) vertices: usize,
    pub(super) notices: Vec<String>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let rest = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        Self { rest, number: 0, plain: Vec::new(), taken: 0, fault: None, state: State::default() }
    }

    /// # Errors
    /// The fault that ended the reading.
    pub(super) fn finish(self) -> Result<Finished> {
        if let Some(fault) = self.fault {
            return Err(fault);
        }
        let mut notices = Vec::new();
        if self.state.points_and_lines > 0 {
            notices.push(format!("{} points and lines were left out", self.state.points_and_lines));
        }
        if self.state.curves > 0 {
            notices.push("curves and curved surfaces were left out".to_owned());
        }
        Ok(Finished { parts: parts(&self.state.part_names), vertices: self.state.positions, notices })
    }

    /// The next line, with those that a backslash at the end appends to it; none at the end.
    fn next_line(&mut self) -> Option<Cow<'a, [u8]>> {
        let first = self.next_physical_line()?;
        let Some(start) = first.strip_suffix(b"\\") else { return Some(Cow::Borrowed(first)) };
        let mut joined = start.to_vec();
        while let Some(next) = self.next_physical_line() {
            joined.push(b' ');
            let start = next.strip_suffix(b"\\");
            joined.extend_from_slice(start.unwrap_or(next));
            if start.is_none() {
                break;
            }
        }
        Some(Cow::Owned(joined))
    }

    fn next_physical_line(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|&byte| byte == b'\n');
        let (line, rest) = match end {
            Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
            None => (self.rest, &self.rest[self.rest.len()..]),
        };
        self.rest = rest;
        self.number += 1;
        Some(line.strip_suffix(b"\r").unwrap_or(line))
    }
}

impl BufRead for Lines<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        while self.taken == self.plain.len() {
            self.plain.clear();
            self.taken = 0;
            let Some(line) = self.next_line() else { break };
            if let Err(fault) = self.state.line(&String::from_utf8_lossy(&line), &mut self.plain) {
                self.fault = Some(fault.at_line(self.number));
                return Err(io::ErrorKind::InvalidData.into());
            }
        }
        Ok(&self.plain[self.taken..])
    }

    fn consume(&mut self, amount: usize) {
        self.taken += amount;
    }
}

impl Read for Lines<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(buffer)?;
        self.consume(count);
        Ok(count)
    }
}

impl State {
    /// Checks one line and writes what `tobj` is to see of it.
    fn line(&mut self, line: &str, plain: &mut Vec<u8>) -> Result<()> {
        let mut words = line.split_whitespace();
        let Some(keyword) = words.next() else { return Ok(()) };
        match keyword {
            "v" => {
                let [x, y, z] = numbers(&mut words, 3, "a position needs three numbers")?;
                check_position(Vec3::new(x, y, z))?;
                self.positions += 1;
                put(plain, format_args!("v {x:?} {y:?} {z:?}\n"));
            }
            "vt" => {
                // v may be left out.
                let [u, v, _] = numbers(&mut words.by_ref().take(2), 1, "a UV needs a number or two")?;
                if !(u.is_finite() && v.is_finite()) {
                    return Err(Error::invalid("a UV that is not a finite number"));
                }
                self.uvs += 1;
                put(plain, format_args!("vt {u:?} {v:?}\n"));
            }
            "vn" => {
                let [x, y, z] = numbers(&mut words, 3, "a normal needs three numbers")?;
                self.normals += 1;
                put(plain, format_args!("vn {x:?} {y:?} {z:?}\n"));
            }
            "f" | "fo" => self.face(words, plain)?,
            "p" | "l" => self.points_and_lines += 1,
            "curv" | "curv2" | "surf" => self.curves += 1,
            "o" => {
                self.names.object = name(line, keyword);
                self.names.group.clear();
            }
            "g" => self.names.group = name(line, keyword),
            "usemtl" => self.names.material = name(line, keyword),
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, words: SplitWhitespace<'_>, plain: &mut Vec<u8>) -> Result<()> {
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        for word in words {
            if word.starts_with('#') {
                break;
            }
            let corner = self.corner(word)?;
            // A corner said twice in a row makes no edge.
            if corners.last().is_none_or(|last: &[Option<usize>; 3]| last[0] != corner[0]) {
                corners.push(corner);
            }
            if corners.len() > CORNER_LIMIT {
                return Err(Error::too_large(format!("a face of more than {CORNER_LIMIT} corners")));
            }
        }
        if corners.len() > 3 && corners.first().map(|c| c[0]) == corners.last().map(|c| c[0]) {
            corners.pop();
        }
        if corners.is_empty() {
            return Err(Error::malformed("a face without corners"));
        }
        if corners.len() < 3 {
            self.points_and_lines += 1;
        } else {
            let has = |attribute: usize| corners.iter().all(|corner| corner[attribute].is_some());
            let (has_uvs, has_normals) = (has(1), has(2));
            self.announce(has_uvs, has_normals, plain)?;
            put(plain, format_args!("f"));
            for corner in &corners {
                put(plain, format_args!(" {}", corner[0].unwrap_or(0)));
                match (corner[1].filter(|_| has_uvs), corner[2].filter(|_| has_normals)) {
                    (None, None) => {}
                    (Some(uv), None) => put(plain, format_args!("/{uv}")),
                    (None, Some(normal)) => put(plain, format_args!("//{normal}")),
                    (Some(uv), Some(normal)) => put(plain, format_args!("/{uv}/{normal}")),
                }
            }
            plain.push(b'\n');
        }
        self.corners = corners;
        Ok(())
    }

    /// Starts a new run of faces, unless this face goes on with the last.
    fn announce(&mut self, has_uvs: bool, has_normals: bool, plain: &mut Vec<u8>) -> Result<()> {
        let part = match self.parts.get(&self.names) {
            Some(&part) => part,
            None => {
                self.parts.insert(self.names.clone(), self.part_names.len());
                self.part_names.push(self.names.clone());
                self.part_names.len() - 1
            }
        };
        let run = (part, has_uvs, has_normals);
        if self.run != Some(run) {
            self.run = Some(run);
            self.runs += 1;
            if self.runs > RUN_LIMIT {
                return Err(Error::too_large(format!("more than {RUN_LIMIT} changes of group or material")));
            }
            put(plain, format_args!("o {part}\n"));
        }
        Ok(())
    }

    /// Position, UV and normal of a corner such as `3/1/2`, `3//2`, `-1`; counted from 1.
    fn corner(&self, word: &str) -> Result<[Option<usize>; 3]> {
        let mut corner = [None; 3];
        let kinds = [("vertex", self.positions), ("UV", self.uvs), ("normal", self.normals)];
        let mut indices = word.split('/');
        for (slot, (kind, count)) in corner.iter_mut().zip(kinds) {
            let Some(index) = indices.next().filter(|index| !index.is_empty()) else { continue };
            let number: i64 = index
                .parse()
                .map_err(|_| Error::malformed(format!("no face corner: {}", clean_name(word))))?;
            let absolute =
                if number < 0 { (count as i64).saturating_add(number).saturating_add(1) } else { number };
            if absolute < 1 || absolute > count as i64 {
                return Err(Error::malformed(format!("the face names {kind} {number}, of {count} so far")));
            }
            *slot = Some(absolute as usize);
        }
        if corner[0].is_none() || indices.next().is_some() {
            return Err(Error::malformed(format!("no face corner: {}", clean_name(word))));
        }
        Ok(corner)
    }
}

/// Up to three numbers, of which `needed` must be there; zero for those that are not.
fn numbers<'w>(words: &mut impl Iterator<Item = &'w str>, needed: usize, lack: &str) -> Result<[f32; 3]> {
    let mut numbers = [0.0; 3];
    for (i, number) in numbers.iter_mut().enumerate() {
        match words.next() {
            Some(word) if !word.starts_with('#') => {
                *number =
                    word.parse().map_err(|_| Error::malformed(format!("no number: {}", clean_name(word))))?;
            }
            _ if i < needed => return Err(Error::malformed(lack)),
            _ => break,
        }
    }
    Ok(numbers)
}

fn name(line: &str, keyword: &str) -> String {
    clean_name(line.trim_start().strip_prefix(keyword).unwrap_or_default())
}

/// Writing to memory does not fail.
fn put(plain: &mut Vec<u8>, text: std::fmt::Arguments<'_>) {
    let written = io::Write::write_fmt(plain, text);
    debug_assert!(written.is_ok());
}

/// Names the parts after their group, else object, else material; the material follows where that alone is not enough.
fn parts(names: &[Names]) -> Vec<Part> {
    fn short(names: &Names) -> &str {
        let candidates = [&names.group, &names.object, &names.material];
        candidates.into_iter().find(|name| !name.is_empty()).map_or("panel", |name| name)
    }
    let mut uses: HashMap<&str, usize> = HashMap::new();
    for names in names {
        *uses.entry(short(names)).or_default() += 1;
    }
    names
        .iter()
        .map(|names| {
            let alone = uses.get(short(names)) == Some(&1);
            let long = [short(names), if alone { "" } else { &names.material }].join(" ");
            let takes_fabric =
                ![&names.object, &names.group, &names.material].into_iter().any(|n| names_no_fabric(n));
            Part { name: long.trim().to_owned(), takes_fabric, ..Part::default() }
        })
        .collect()
}
