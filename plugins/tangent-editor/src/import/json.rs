//! The JSON of all panels.

use std::fmt;

use amc_core::direction::{Record, Source};
use amc_core::{Error, Result};
use serde::de::{Error as _, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::{Entry, MOST_PIECES, Way, clean};

/// The version that is read.
const VERSION: u32 = 1;

#[derive(Deserialize)]
struct Document {
    version: Option<u32>,
    #[serde(deserialize_with = "few")]
    panels: Vec<Record>,
}

/// Reads records, as many as a garment may have: each takes far more memory than the two bytes it may be in the file.
fn few<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Record>, D::Error> {
    struct Few;
    impl<'de> Visitor<'de> for Few {
        type Value = Vec<Record>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("a list of panels")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Vec<Record>, A::Error> {
            let mut all = Vec::new();
            while let Some(item) = items.next_element()? {
                if all.len() == MOST_PIECES {
                    return Err(A::Error::custom(format_args!("more than {MOST_PIECES} panels")));
                }
                all.push(item);
            }
            Ok(all)
        }
    }
    deserializer.deserialize_seq(Few)
}

/// Reads the JSON that [`amc_core::export::tangents`] writes, or one made by hand.
///
/// # Errors
/// Not such a JSON, of another version, an entry without a name, or a number that makes no sense.
pub fn parse(bytes: &[u8]) -> Result<Vec<Entry>> {
    let document: Document = serde_json::from_slice(bytes).map_err(|error| {
        Error::malformed(format!("no JSON of directions: {error}")).at_line(error.line() as u64)
    })?;
    if let Some(version) = document.version.filter(|&version| version != VERSION) {
        return Err(Error::unsupported(format!("version {version}; this program reads {VERSION}")));
    }
    document.panels.into_iter().enumerate().map(|(number, record)| entry(number, record)).collect()
}

fn entry(number: usize, record: Record) -> Result<Entry> {
    let here = |error: Error| error.at_element(format!("panels[{number}]"));
    let Some(name) = record.name.as_deref().or(record.id.as_deref()) else {
        return Err(here(Error::malformed("neither id nor name")));
    };
    let name = clean(name);
    let way = way(&record).map_err(here)?;
    let remarks = strokes(&record).into_iter().collect();
    Ok(Entry { name, way, record, quantity: 1, remarks, ..Entry::default() })
}

/// What is to be told of a combed panel.
pub(super) fn strokes(record: &Record) -> Option<&'static str> {
    let told = "strokes comb it, which are not in the file: only the direction under them is taken";
    (record.combed == Some(true)).then_some(told)
}

/// The direction of a record in the panel's own UVs.
///
/// # Errors
/// An angle that is not finite, or a field without a direction.
pub(super) fn way(record: &Record) -> Result<Way> {
    let angle = record.angle_deg.map(|degrees| (degrees % 360.0).to_radians() as f32);
    if angle.is_some_and(|angle| !angle.is_finite()) {
        return Err(Error::invalid("the angle is not a finite number"));
    }
    if let Some(Source::Field(field)) = record.source {
        field.check()?;
    }
    Ok(Way::InUvs { source: record.source, angle })
}
