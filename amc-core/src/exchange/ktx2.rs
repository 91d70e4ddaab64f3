//! The AMC file itself.

use super::{Form, Kind, Source};
use crate::amc::Amc;

pub(super) const FORM: Form = Form {
    kind: Kind::Amc,
    name: "AMC",
    ends: &[".ktx2"],
    is: |source| matches!(source, Source::File(bytes) if bytes.starts_with(&::ktx2::MAGIC)),
    read: |source| Amc::from_ktx2(source.bytes()?),
    write: |amc, path| amc.save(path).map(|()| Vec::new()),
};
