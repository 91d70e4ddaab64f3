//! The node hierarchy: which mesh stands where.

use glam::Mat4;
use gltf::Document;

use crate::{Error, Result};

/// A mesh in its place.
pub(super) struct Instance<'a> {
    pub(super) mesh: gltf::Mesh<'a>,
    /// None where the file has meshes and no nodes.
    pub(super) node: Option<gltf::Node<'a>>,
    pub(super) to_world: Mat4,
}

/// The meshes of the default scene, else of the first, else of all nodes that are no one's child, else all meshes.
///
/// # Errors
/// A node that is reached twice: the hierarchy must be a tree.
pub(super) fn instances(document: &Document) -> Result<Vec<Instance<'_>>> {
    let nodes: Vec<_> = document.nodes().collect();
    let mut waiting: Vec<(usize, Mat4)> = match document.default_scene().or_else(|| document.scenes().next())
    {
        Some(scene) => scene.nodes().map(|node| (node.index(), Mat4::IDENTITY)).collect(),
        None => {
            let mut is_child = vec![false; nodes.len()];
            nodes.iter().flat_map(|node| node.children()).for_each(|child| is_child[child.index()] = true);
            (0..nodes.len()).filter(|&node| !is_child[node]).map(|node| (node, Mat4::IDENTITY)).collect()
        }
    };
    waiting.reverse();
    let mut reached = vec![false; nodes.len()];
    let mut instances = Vec::new();
    while let Some((index, above)) = waiting.pop() {
        let node = &nodes[index];
        if std::mem::replace(&mut reached[index], true) {
            let message = "reached twice: the node hierarchy must be a tree";
            return Err(Error::malformed(message).at_element(format!("node {index}")));
        }
        let to_world = above * Mat4::from_cols_array_2d(&node.transform().matrix());
        if let Some(mesh) = node.mesh() {
            instances.push(Instance { mesh, node: Some(node.clone()), to_world });
        }
        let first = waiting.len();
        waiting.extend(node.children().map(|child| (child.index(), to_world)));
        waiting[first..].reverse();
    }
    if nodes.is_empty() {
        instances.extend(document.meshes().map(|mesh| Instance {
            mesh,
            node: None,
            to_world: Mat4::IDENTITY,
        }));
    }
    Ok(instances)
}
