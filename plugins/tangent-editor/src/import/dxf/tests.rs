use super::*;

/// A file of these pairs, a line each.
fn file(pairs: &[(i32, &str)]) -> String {
    pairs.iter().map(|(code, value)| format!("{code:>3}\n{value}\n")).collect()
}

const HEAD: &[(i32, &str)] = &[
    (0, "SECTION"),
    (2, "HEADER"),
    (9, "$INSUNITS"),
    (70, "4"),
    (0, "ENDSEC"),
    (0, "SECTION"),
    (2, "BLOCKS"),
    (0, "BLOCK"),
    (8, "1"),
    (2, "FRONT_M"),
    (70, "0"),
    (10, "5"),
    (20, "5"),
    (0, "POLYLINE"),
    (8, "1"),
    (66, "1"),
    (10, "0"),
    (20, "0"),
    (0, "VERTEX"),
    (8, "1"),
    (10, "0.0"),
    (20, "0.0"),
    (30, "0"),
    (0, "VERTEX"),
    (8, "1"),
    (10, "100.0"),
    (20, "0.0"),
    (0, "VERTEX"),
    (8, "1"),
    (10, "0.0"),
    (20, "2.0e2"),
    (0, "SEQEND"),
    (8, "1"),
];
const GRAIN: &[(i32, &str)] =
    &[(0, "LINE"), (8, "7"), (10, "10"), (20, "10"), (11, "10"), (21, "60"), (62, "3")];
const TAIL: &[(i32, &str)] = &[(0, "ENDBLK"), (0, "ENDSEC"), (0, "EOF")];

fn with(middle: &[(i32, &str)]) -> Result<Vec<Entry>> {
    parse(file(&[HEAD, middle, TAIL].concat()).as_bytes())
}

#[test]
fn a_block_is_a_piece_with_its_outline_and_its_grain() {
    let texts = [
        (0, "TEXT"),
        (8, "1"),
        (10, "3"),
        (20, "3"),
        (1, "Piece Name: Left front"),
        (0, "TEXT"),
        (1, "ANNOTATION: with nap"),
        (0, "TEXT"),
        (1, "QUANTITY: 2, 1"),
        // A head of the arrow, and a notch.
        (0, "LINE"),
        (8, "7"),
        (10, "10"),
        (20, "60"),
        (11, "12"),
        (21, "55"),
        (0, "POINT"),
        (8, "4"),
        (10, "not looked at"),
    ];
    let [entry] = with(&[GRAIN, &texts].concat()).unwrap().try_into().unwrap();
    assert_eq!((entry.name.as_str(), entry.quantity), ("Left front", 2));
    assert_eq!(entry.record.orientation, Some(Orientation::Nap));
    assert_eq!(entry.way, Way::OnPiece(Vec2::Y));
    assert_eq!(entry.outlines, [[Vec2::ZERO, Vec2::new(100.0, 0.0), Vec2::new(0.0, 200.0)]]);
    assert!(entry.remarks.is_empty());
}

#[test]
fn other_entities_and_doubts_are_told() {
    let light = [
        (0, "LWPOLYLINE"),
        (8, "14"),
        (90, "3"),
        (10, "1"),
        (20, "1"),
        (10, "99"),
        (20, "1"),
        (10, "1"),
        (20, "199"),
    ];
    let crossing = [(0, "LINE"), (8, "7"), (10, "0"), (20, "20"), (11, "-45"), (21, "20")];
    let [entry] = with(&[GRAIN, &light, &crossing].concat()).unwrap().try_into().unwrap();
    assert_eq!(entry.name, "FRONT_M");
    assert_eq!(entry.outlines[0][1], Vec2::new(99.0, 1.0), "the sewn line first");
    assert_eq!(entry.outlines.len(), 2);
    assert_eq!((entry.way, entry.remarks.len()), (Way::OnPiece(Vec2::Y), 1));
    let [bare] = with(&[]).unwrap().try_into().unwrap();
    assert!(bare.way == Way::Unsaid && bare.remarks[0].contains("no grain line"), "{bare:?}");
}

#[test]
fn what_is_no_dxf_is_refused_with_its_line() {
    let said = |bytes: &[u8]| parse(bytes).unwrap_err().to_string();
    assert!(said(b"AutoCAD Binary DXF\r\n\x1a\0").contains("save it as ASCII"));
    assert!(said(b"").contains("no pieces"));
    assert!(said(b"solid cube\nfacet\n").starts_with("line 1: no DXF"));
    assert!(said(b"0\nSECTION\n2\n").starts_with("line 3: cut short"));
    assert!(said(file(&[(0, "SECTION"), (2, "ENTITIES"), (0, "EOF")]).as_bytes()).contains("no pieces"));
    for wrong in ["north", "NaN", "inf", "1e300", "-1e9", ""] {
        let mut pairs = [HEAD, GRAIN, TAIL].concat();
        let place = pairs.iter().position(|pair| *pair == (11, "10")).unwrap();
        pairs[place].1 = wrong;
        let text = said(file(&pairs).as_bytes());
        assert!(text.starts_with(&format!("line {}: '{wrong}'", 2 * place + 2)), "{text}");
    }
    let many = "0\nBLOCK\n0\nLINE\n8\n7\n10\n0\n20\n0\n11\n1\n21\n0\n".repeat(MOST_PIECES + 2);
    assert!(said(many.as_bytes()).contains("more than"));
}

#[test]
fn whatever_is_cut_off_or_changed_is_read_or_refused() {
    let whole = file(&[HEAD, GRAIN, TAIL].concat());
    for end in 0..whole.len() {
        drop(parse(&whole.as_bytes()[..end]));
    }
    for at in 0..whole.len() {
        let mut bytes = whole.clone().into_bytes();
        for byte in [0, b'\n', b'9', b'-', 0xff] {
            bytes[at] = byte;
            drop(parse(&bytes));
        }
    }
}
