//! Opening a mesh file.

use std::path::Path;

use super::{Garment, Mesh, Unit, gltf, obj};
use crate::{Error, Result, file};

/// Largest mesh file, and largest buffer beside one, in bytes.
pub const FILE_LIMIT: u64 = 512 << 20;

/// Files that a mesh file refers to by name, such as `garment.bin`.
pub type Resolve<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>>;

/// A format: how it is recognised, and how it is read.
struct Format {
    suffixes: &'static [&'static str],
    /// First bytes of every file of this format, where it has such.
    magic: Option<&'static [u8]>,
    parse: fn(&[u8], Resolve<'_>) -> Result<Mesh>,
}

/// The formats that can be read.
const FORMATS: [Format; 3] = [
    Format { suffixes: &["glb"], magic: Some(b"glTF"), parse: gltf::parse },
    Format { suffixes: &["gltf"], magic: None, parse: gltf::parse },
    Format { suffixes: &["obj"], magic: None, parse: |bytes, _| obj::parse(bytes) },
];

/// Suffixes of the mesh files that can be read, in lower case.
pub fn suffixes() -> impl Iterator<Item = &'static str> {
    FORMATS.iter().flat_map(|format| format.suffixes.iter().copied())
}

/// Reads a mesh file; its numbers mean `unit`s. The format is told by the first bytes, else by the suffix.
///
/// # Errors
/// The file cannot be read, is larger than [`FILE_LIMIT`], of no known format, or not what its format demands; the
/// error names the file and the line or element.
pub fn read(path: &Path, unit: Unit) -> Result<Mesh> {
    let bytes = file::read(path, FILE_LIMIT)?;
    let suffix = path.extension().and_then(|suffix| suffix.to_str()).unwrap_or_default().to_lowercase();
    let by_content = FORMATS.iter().find(|format| format.magic.is_some_and(|magic| bytes.starts_with(magic)));
    let format = by_content
        .or_else(|| FORMATS.iter().find(|format| format.suffixes.contains(&suffix.as_str())))
        .ok_or_else(|| {
            let known = suffixes().collect::<Vec<_>>().join(", .");
            Error::unsupported(format!("no mesh file by its suffix: .{known} can be read")).in_file(path)
        })?;
    let beside = |name: &str| read_beside(path, name);
    let mut mesh = (format.parse)(&bytes, &beside).map_err(|error| error.in_file(path))?;
    if unit != Unit::Metre {
        for position in &mut mesh.positions {
            *position *= unit.metres();
        }
    }
    Ok(mesh)
}

/// Reads a glTF file, in metres, with what KHR_materials_anisotropy says of its panels: see [`gltf::anisotropy`].
///
/// # Errors
/// The file cannot be read, is larger than [`FILE_LIMIT`], or as [`gltf::anisotropy`]; the error names the file.
pub fn read_anisotropy(path: &Path) -> Result<(Garment, Vec<gltf::Anisotropy>)> {
    let bytes = file::read(path, FILE_LIMIT)?;
    gltf::anisotropy(&bytes, &|name: &str| read_beside(path, name)).map_err(|error| error.in_file(path))
}

/// Reads a file that lies in the folder of `path` or below it.
fn read_beside(path: &Path, name: &str) -> Result<Vec<u8>> {
    let relative = Path::new(name);
    let inside = relative.components().all(|part| matches!(part, std::path::Component::Normal(_)));
    if name.is_empty() || !inside {
        return Err(Error::unsupported(format!("refers to {name}, which is not in the file's own folder")));
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let wanted = folder.join(relative);
    // A link could lead out again.
    let real =
        |path: &Path| path.canonicalize().map_err(|source| Error::io("cannot open", source).in_file(path));
    let root = real(if folder.as_os_str().is_empty() { Path::new(".") } else { folder })?;
    if !real(&wanted)?.starts_with(&root) {
        return Err(Error::unsupported(format!("refers to {name}, a link out of the file's own folder")));
    }
    file::read(&wanted, FILE_LIMIT)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_in_its_unit_and_faults_name_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("Cloth.OBJ");
        file::save_bytes(&path, b"v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n").unwrap();
        let mesh = read(&path, Unit::Decimetre).unwrap();
        assert_eq!(mesh.positions[1].x, 1.0);
        file::save_bytes(&path, b"v 0 0 0\nv 10 nan 0\n").unwrap();
        let message = read(&path, Unit::Metre).unwrap_err().to_string();
        assert!(message.contains("Cloth.OBJ: line 2: "), "{message}");
        let other = folder.path().join("cloth.stl");
        file::save_bytes(&other, b"solid").unwrap();
        assert!(read(&other, Unit::Metre).unwrap_err().to_string().contains(".glb, .gltf, .obj"));
    }

    #[test]
    fn buffers_come_from_the_folder_only() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("garments").join("a.gltf");
        std::fs::create_dir(path.parent().unwrap()).unwrap();
        file::save_bytes(&folder.path().join("secret"), b"x").unwrap();
        file::save_bytes(&path.with_file_name("a.bin"), b"yes").unwrap();
        assert_eq!(read_beside(&path, "a.bin").unwrap(), b"yes");
        for out in ["../secret", "/etc/hostname", "", "x/../../secret"] {
            assert_eq!(read_beside(&path, out).unwrap_err().kind(), crate::ErrorKind::Unsupported, "{out}");
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(folder.path().join("secret"), path.with_file_name("link")).unwrap();
            assert!(read_beside(&path, "link").unwrap_err().to_string().contains("link out"));
        }
        assert_eq!(read_beside(&path, "none.bin").unwrap_err().kind(), crate::ErrorKind::Io);
    }
}
