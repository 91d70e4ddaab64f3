//! From a pattern as it is written to one whole: halves unfolded, mirror images drawn, curves flattened.

use amc_core::{Error, Result};

use super::{
    Line, Pattern, Piece, Unfolded, WholeFold, WholeNotch, WholePiece, check, draw, halves, mirror,
    seam_check,
};

pub(super) fn unfold(pattern: &Pattern) -> Result<Unfolded> {
    check::names(pattern)?;
    let mut pieces: Vec<WholePiece> = Vec::with_capacity(pattern.pieces.len());
    for piece in &pattern.pieces {
        let whole = match &piece.mirror_of {
            Some(of) => mirror_image(piece, of, &pieces),
            None => unfold_piece(piece),
        };
        let named = |error: Error| error.at_element(format!("piece '{}'", piece.name));
        let mut whole = whole.map_err(named)?;
        check::piece(&mut whole, pattern.figure).map_err(named)?;
        pieces.push(whole);
    }
    let seams = seam_check::seams(pattern, &pieces)?;
    let Pattern { name, figure, cloth, .. } = pattern;
    Ok(Unfolded { name: name.clone(), figure: *figure, cloth: *cloth, pieces, seams })
}

/// The mirror image of the piece called `of`.
fn mirror_image(piece: &Piece, of: &str, pieces: &[WholePiece]) -> Result<WholePiece> {
    let only_a_name = Piece { cloth: None, ..piece.clone() } == bare(piece);
    if !only_a_name {
        return Err(Error::invalid("a mirror image has nothing of its own but a name and a cloth"));
    }
    let Some(index) = pieces.iter().position(|piece| piece.name == of) else {
        return Err(Error::invalid(format!("mirror_of: no piece before it is called '{of}'")));
    };
    let original = &pieces[index];
    let count = original.outline().len();
    let images = original.lines.iter().map(mirror::line);
    let mut lines: Vec<Line> = images.clone().take(count).rev().collect();
    lines.extend(images.skip(count));
    let place = |line: usize| if line < count { count - 1 - line } else { line };
    let notch = |notch: &WholeNotch| WholeNotch {
        name: mirror::name(&notch.name),
        line: place(notch.line),
        along: original.lines[notch.line].length() - notch.along,
    };
    Ok(WholePiece {
        name: piece.name.clone(),
        grain: std::f64::consts::PI - original.grain,
        notches: original.notches.iter().map(notch).collect(),
        folds: original
            .folds
            .iter()
            .map(|fold| WholeFold { line: place(fold.line), ..fold.clone() })
            .collect(),
        lines,
        placement: mirror::placement(&original.placement),
        cloth: piece.cloth.or(original.cloth),
        mirror: Some(index),
    })
}

/// What a piece with this name and `mirror_of` looks like that gives nothing else.
fn bare(piece: &Piece) -> Piece {
    Piece {
        name: piece.name.clone(),
        mirror_of: piece.mirror_of.clone(),
        mirrored: false,
        grain_deg: 90.0,
        start: [0.0; 2],
        outline: Vec::new(),
        notches: Vec::new(),
        lines: Vec::new(),
        folds: Vec::new(),
        points: Vec::new(),
        placement: None,
        cloth: None,
    }
}

/// A piece drawn in full, or the half of one.
fn unfold_piece(piece: &Piece) -> Result<WholePiece> {
    let Some(placement) = piece.placement.clone() else {
        return Err(Error::invalid("its placement is missing"));
    };
    let edges = draw::outline(piece)?;
    let notches: Vec<WholeNotch> =
        piece.notches.iter().map(|notch| draw::notch(notch, &edges)).collect::<Result<_>>()?;
    let inner = draw::inner(piece)?;
    let folds = draw::folds(&piece.folds, &inner)?;
    let mut whole = WholePiece {
        name: piece.name.clone(),
        grain: piece.grain_deg.to_radians(),
        lines: Vec::new(),
        notches,
        folds: Vec::new(),
        placement,
        cloth: piece.cloth,
        mirror: None,
    };
    let count = if piece.mirrored {
        let (edges, notches) = halves::outline(&edges, &whole.notches)?;
        whole.lines = edges;
        whole.notches = notches;
        let count = whole.lines.len();
        for line in &inner {
            whole.lines.extend(halves::inner(line)?);
        }
        count
    } else {
        let count = edges.len();
        whole.lines = edges;
        whole.lines.extend(inner);
        count
    };
    // A fold of a half is a fold of its mirror image too.
    for (name, angle) in folds {
        let also = mirror::name(&name);
        let of_fold = |line: &Line| line.name == name || (piece.mirrored && line.name == also);
        let lines = (count..whole.lines.len()).filter(|&i| of_fold(&whole.lines[i]));
        whole.folds.extend(lines.map(|line| WholeFold { line, angle }));
    }
    Ok(whole)
}
