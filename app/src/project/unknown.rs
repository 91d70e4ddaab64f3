//! Keys of a newer program, kept so that a save does not lose them.

use std::collections::BTreeMap;

use serde_json::{Map, Value};

/// Keys of a file that this program does not know, wherever they stand: in the project, in a fabric (found again by its
/// id), in a panel, in the view. Those of a thing that is removed go with it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Unknown(BTreeMap<String, Node>);

#[derive(Debug, Clone, PartialEq)]
enum Node {
    /// An unknown key's value.
    Whole(Value),
    /// What is unknown inside a known key's value: by key in an object, by id in a list.
    Inside(BTreeMap<String, Node>),
}

impl Unknown {
    /// What `file` has and `known`, the same as this program would write it, has not.
    pub(super) fn between(file: &Value, known: &Value) -> Self {
        match (file, known) {
            (Value::Object(file), Value::Object(known)) => Self(beyond(file, known)),
            _ => Self::default(),
        }
    }

    /// Puts them where they belong in what is about to be written.
    pub(super) fn put_into(&self, written: &mut Value) {
        if let Value::Object(written) = written {
            put(&self.0, written);
        }
    }
}

fn beyond(file: &Map<String, Value>, known: &Map<String, Value>) -> BTreeMap<String, Node> {
    let node = |(key, value): (&String, &Value)| {
        let node = match known.get(key) {
            None => Some(Node::Whole(value.clone())),
            Some(known) => inside(value, known),
        };
        node.map(|node| (key.clone(), node))
    };
    file.iter().filter_map(node).collect()
}

fn inside(file: &Value, known: &Value) -> Option<Node> {
    let nodes = match (file, known) {
        (Value::Object(file), Value::Object(known)) => beyond(file, known),
        (Value::Array(file), Value::Array(known)) => {
            let known: BTreeMap<String, &Map<String, Value>> = by_id(known).collect();
            let node = |(id, element)| {
                let nodes = beyond(element, known.get(&id)?);
                (!nodes.is_empty()).then_some((id, Node::Inside(nodes)))
            };
            by_id(file).filter_map(node).collect()
        }
        _ => BTreeMap::new(),
    };
    (!nodes.is_empty()).then_some(Node::Inside(nodes))
}

/// Elements of a list that have an `id`, and the id as a key.
fn by_id(list: &[Value]) -> impl Iterator<Item = (String, &Map<String, Value>)> {
    list.iter().filter_map(|element| {
        let element = element.as_object()?;
        Some((element.get("id")?.to_string(), element))
    })
}

fn put(unknown: &BTreeMap<String, Node>, written: &mut Map<String, Value>) {
    for (key, node) in unknown {
        match (node, written.get_mut(key)) {
            (Node::Whole(value), None) => {
                written.insert(key.clone(), value.clone());
            }
            (Node::Inside(nodes), Some(Value::Object(written))) => put(nodes, written),
            (Node::Inside(nodes), Some(Value::Array(written))) => put_by_id(nodes, written),
            // Known by now, or gone.
            (Node::Whole(_) | Node::Inside(_), _) => {}
        }
    }
}

fn put_by_id(unknown: &BTreeMap<String, Node>, written: &mut [Value]) {
    for element in written.iter_mut().filter_map(Value::as_object_mut) {
        let id = element.get("id").map(Value::to_string);
        if let Some(Node::Inside(nodes)) = id.and_then(|id| unknown.get(&id)) {
            put(nodes, element);
        }
    }
}
