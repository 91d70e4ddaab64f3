//! glTF 2.0.
use super::{Mesh, Resolve};
use crate::{Error, Result};
/// Reads.
pub fn parse(_bytes: &[u8], _resolve: Resolve<'_>) -> Result<Mesh> {
    Err(Error::unsupported("glTF"))
}
