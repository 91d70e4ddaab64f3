//! Seams written out whole, and what they must be like.

use amc_core::{Error, Result};

use super::{CLOSE, LineKind, Pattern, Seam, SeamKind, SeamPart, SidePart, WholePiece, WholeSeam, mirror};

/// How much longer one side may be than the other whatever the ease, metres.
const ALLOWANCE: f64 = 0.001;
/// The most parts of one side.
const MOST_PARTS: usize = 100;
/// The largest ease.
const MOST_EASE: f64 = 2.0;

/// The pattern's seams and their mirror images, checked.
pub(super) fn seams(pattern: &Pattern, pieces: &[WholePiece]) -> Result<Vec<WholeSeam>> {
    let mut seams = Vec::new();
    for seam in &pattern.seams {
        seams.push(whole(seam, pieces)?);
        if seam.mirrored {
            seams.push(whole(&mirror_image(seam)?, pieces)?);
        }
    }
    sewn_once(&seams, pieces)?;
    Ok(seams)
}

fn named(name: &str) -> impl Fn(Error) -> Error + '_ {
    move |error| error.at_element(format!("seam '{name}'"))
}

/// The seam on the wearer's other side. Mirrored lines run the other way, so the parts come in the other order.
fn mirror_image(seam: &Seam) -> Result<Seam> {
    if !mirror::has_side(&seam.name) {
        let what = "it is mirrored: its name needs 'left' or 'right' to tell it from its mirror image";
        return Err(named(&seam.name)(Error::invalid(what)));
    }
    let image = |part: &SeamPart| {
        let part = part.part();
        let (piece, line) = part.line.split_once(':').unwrap_or(("", &part.line));
        let line = format!("{}: {}", mirror::name(piece.trim()), mirror::name(line.trim()));
        SeamPart::Part(super::LinePart {
            line,
            from: 1.0 - part.to,
            to: 1.0 - part.from,
            reversed: part.reversed,
        })
    };
    Ok(Seam {
        name: mirror::name(&seam.name),
        a: seam.a.iter().rev().map(image).collect(),
        b: seam.b.iter().rev().map(image).collect(),
        between: seam.between.as_ref().map(|[from, to]| [mirror::name(to), mirror::name(from)]),
        mirrored: false,
        ..seam.clone()
    })
}

fn whole(seam: &Seam, pieces: &[WholePiece]) -> Result<WholeSeam> {
    let side = |parts: &[SeamPart], against: bool| {
        if parts.is_empty() || parts.len() > MOST_PARTS {
            return Err(Error::invalid(format!("a side has 1 to {MOST_PARTS} parts, not {}", parts.len())));
        }
        parts.iter().map(|part| side_part(part, against, pieces)).collect::<Result<Vec<_>>>()
    };
    let both = || Ok([side(&seam.a, false)?, side(&seam.b, true)?]);
    let sides = both().map_err(named(&seam.name))?;
    let mut whole =
        WholeSeam { name: seam.name.clone(), kind: seam.kind, sides, between: None, late: seam.late };
    let check = |whole: &mut WholeSeam| {
        if points(whole, pieces)? {
            return Ok(());
        }
        lengths(seam, whole)?;
        whole.between = seam.between.as_ref().map(|names| between(names, whole, pieces)).transpose()?;
        Ok(())
    };
    check(&mut whole).map_err(named(&seam.name))?;
    Ok(whole)
}

fn side_part(part: &SeamPart, against: bool, pieces: &[WholePiece]) -> Result<SidePart> {
    let part = part.part();
    let Some((piece_name, line_name)) = part.line.split_once(':') else {
        return Err(Error::invalid(format!("'{}' names no line: write \"piece: line\"", part.line)));
    };
    let (piece_name, line_name) = (piece_name.trim(), line_name.trim());
    let Some(piece) = pieces.iter().position(|piece| piece.name == piece_name) else {
        return Err(Error::invalid(format!("no piece is called '{piece_name}'")));
    };
    let lines = &pieces[piece].lines;
    let Some(line) = lines.iter().position(|line| line.name == line_name) else {
        let known: Vec<&str> = lines.iter().map(|line| line.name.as_str()).take(20).collect();
        return Err(Error::invalid(format!(
            "piece '{piece_name}' has no line '{line_name}'; it has {}",
            known.join(", ")
        )));
    };
    let fractions = 0.0..=1.0;
    if !fractions.contains(&part.from) || !fractions.contains(&part.to) || part.to <= part.from {
        return Err(Error::invalid(format!(
            "the part of '{}' runs from {} to {}; both are between 0 and 1, the second is greater",
            part.line, part.from, part.to
        )));
    }
    let length = lines[line].length();
    Ok(SidePart {
        piece,
        line,
        from: part.from * length,
        to: part.to * length,
        // Points meet in the order in which they are given.
        backwards: (against && lines[line].kind != LineKind::Points) != part.reversed,
    })
}

/// Whether the seam joins points; an error where it joins points to a line.
fn points(seam: &WholeSeam, pieces: &[WholePiece]) -> Result<bool> {
    let line = |part: &SidePart| &pieces[part.piece].lines[part.line];
    let dotted = |part: &SidePart| line(part).kind == LineKind::Points;
    if !seam.sides.iter().flatten().any(dotted) {
        return Ok(false);
    }
    let counts =
        seam.sides.each_ref().map(|side| side.iter().map(|part| line(part).points.len()).sum::<usize>());
    let all = seam
        .sides
        .iter()
        .flatten()
        .all(|part| dotted(part) && (part.length() - line(part).length()).abs() < CLOSE);
    if !all || counts[0] != counts[1] {
        return Err(Error::invalid("points are joined to as many points: all of each set, and to no line"));
    }
    Ok(true)
}

fn lengths(seam: &Seam, whole: &WholeSeam) -> Result<()> {
    if !(0.0..=MOST_EASE).contains(&seam.ease) {
        return Err(Error::invalid(format!("its ease is {}; it is between 0 and {MOST_EASE}", seam.ease)));
    }
    let [a, b] = whole.lengths();
    let (short, long) = (a.min(b), a.max(b));
    if short < CLOSE {
        return Err(Error::invalid("one side has no length"));
    }
    if long > short * (1.0 + seam.ease) + ALLOWANCE {
        return Err(Error::invalid(format!(
            "its sides cannot match: {:.1} and {:.1} mm long, one {:.1} % longer, and the ease is {:.1} %",
            a * 1000.0,
            b * 1000.0,
            (long / short - 1.0) * 100.0,
            seam.ease * 100.0
        )));
    }
    Ok(())
}

/// Which side is longer, and where along it two of its notches lie.
fn between(names: &[String; 2], seam: &WholeSeam, pieces: &[WholePiece]) -> Result<(usize, [f64; 2])> {
    let lengths = seam.lengths();
    let longer = usize::from(lengths[1] > lengths[0]);
    let place = |name: &String| {
        let mut found = Vec::new();
        let mut before = 0.0;
        for part in &seam.sides[longer] {
            for notch in &pieces[part.piece].notches {
                let here = notch.line == part.line && (part.from..=part.to).contains(&notch.along);
                if here && notch.name == *name {
                    let within = if part.backwards { part.to - notch.along } else { notch.along - part.from };
                    found.push(before + within);
                }
            }
            before += part.length();
        }
        match found[..] {
            [one] => Ok(one),
            [] => Err(Error::invalid(format!("no notch '{name}' lies on its longer side"))),
            _ => Err(Error::invalid(format!("several notches '{name}' lie on its longer side"))),
        }
    };
    let (mut from, mut to) = (place(&names[0])?, place(&names[1])?);
    if from > to {
        std::mem::swap(&mut from, &mut to);
    }
    let excess = lengths[longer] - lengths[1 - longer];
    if to - from < 1.5 * excess + CLOSE {
        return Err(Error::invalid(format!(
            "{:.1} mm of ease do not fit between notches that are {:.1} mm apart",
            excess * 1000.0,
            (to - from) * 1000.0
        )));
    }
    Ok((longer, [from, to]))
}

/// Refuses a line that is sewn twice over the same part.
fn sewn_once(seams: &[WholeSeam], pieces: &[WholePiece]) -> Result<()> {
    let mut parts: Vec<(SidePart, SeamKind, &str)> = Vec::new();
    for seam in seams {
        for part in seam.sides.iter().flatten() {
            let taken = parts.iter().find(|(other, kind, _)| {
                let overlap = part.to.min(other.to) - part.from.max(other.from);
                let whole = pieces[part.piece].lines[part.line].kind == LineKind::Points;
                (other.piece, other.line) == (part.piece, part.line)
                    && *kind == seam.kind
                    && (whole || overlap > CLOSE)
            });
            if let Some((_, _, before)) = taken {
                let piece = &pieces[part.piece];
                let what = format!(
                    "'{}: {}' is sewn twice over the same part: by '{before}' as well",
                    piece.name, piece.lines[part.line].name
                );
                return Err(named(&seam.name)(Error::invalid(what)));
            }
            parts.push((*part, seam.kind, &seam.name));
        }
    }
    Ok(())
}
