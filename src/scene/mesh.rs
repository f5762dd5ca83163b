//! Meshes: nodes where something acts on a cable or is joined to it, the rest spread evenly.

use super::{At, Error, JointKind, OutputKind, Scene};

impl Scene {
    /// Material coordinates in [0, 1] of the nodes of a cable, by the index of the body; none of a
    /// rigid body.
    ///
    /// # Errors
    /// When there are too few elements for what acts inside the body.
    pub fn nodes(&self, body: usize) -> Result<Vec<f64>, Error> {
        let path = format!("bodies[{body}].elements");
        let Some(cable) = self.bodies[body].cable() else {
            return Ok(Vec::new());
        };
        let elements = cable.elements as usize;
        nodes(&path, elements, &self.loaded_coordinates(body))
    }

    /// Material coordinates of a cable where joints, motions, loads, inputs, ports and masses act or where
    /// the force from element to element is read: the mesh has nodes there. Increasing.
    pub fn loaded_coordinates(&self, body: usize) -> Vec<f64> {
        let mut coordinates: Vec<f64> = self
            .loaded_markers()
            .into_iter()
            .filter_map(|name| self.marker(name))
            .filter(|marker| marker.body == body)
            .filter_map(|marker| match marker.at {
                At::Along(coordinate) => Some(coordinate),
                At::Point(_) => None,
            })
            .collect();
        coordinates.sort_by(f64::total_cmp);
        coordinates.dedup();
        coordinates
    }

    fn loaded_markers(&self) -> Vec<&String> {
        // The cable that a joint of kind `along` slides on is named without a marker.
        let joints = self.joints.iter().flat_map(|joint| match joint.kind {
            JointKind::Along => &joint.markers[1..],
            _ => &joint.markers[..],
        });
        let springs = self.loads.iter().flat_map(|load| load.markers.iter());
        let is_cut = |kind| kind == OutputKind::ConnectivityForce;
        let cuts = self.outputs.iter().filter(|output| is_cut(output.kind));
        joints
            .chain(self.motions.iter().flat_map(|motion| &motion.marker))
            .chain(self.loads.iter().flat_map(|load| &load.marker))
            .chain(springs.flatten())
            .chain(self.inputs.iter().flat_map(|input| &input.marker))
            .chain(self.ports.iter().map(|port| &port.marker))
            .chain(self.masses.iter().map(|mass| &mass.marker))
            .chain(cuts.flat_map(|output| &output.marker))
            .collect()
    }
}

/// Material coordinates in [0, 1] of the nodes of `elements` elements, with a node at every
/// coordinate of `held`.
fn nodes(path: &str, elements: usize, held: &[f64]) -> Result<Vec<f64>, Error> {
    let inner = held.iter().copied().filter(|c| *c > 0.0 && *c < 1.0);
    let mut corners = vec![0.0];
    corners.extend(inner);
    corners.push(1.0);
    let stretches: Vec<f64> = corners.windows(2).map(|c| c[1] - c[0]).collect();
    if elements < stretches.len() {
        let message = format!(
            "expected at least {} elements (joints, loads and masses act inside the body), found {elements}",
            stretches.len()
        );
        return Err(Error::new(path, message));
    }
    let mut counts = vec![1_u32; stretches.len()];
    for _ in stretches.len()..elements {
        // The next element goes where elements are longest.
        let longest = (0..stretches.len()).max_by(|a, b| {
            let length = |i: usize| stretches[i] / f64::from(counts[i]);
            length(*a).total_cmp(&length(*b))
        });
        counts[longest.unwrap_or(0)] += 1;
    }
    let mut nodes = vec![0.0];
    for (corner, count) in corners.windows(2).zip(counts) {
        for i in 1..=count {
            let fraction = f64::from(i) / f64::from(count);
            let inside = corner[0] + fraction * (corner[1] - corner[0]);
            nodes.push(if i == count { corner[1] } else { inside });
        }
    }
    Ok(nodes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn has_a_node_at_every_held_coordinate_and_even_elements_between() {
        let nodes = nodes("elements", 10, &[0.0, 0.3]).expect("enough elements");
        assert_eq!(nodes.len(), 11);
        assert_eq!(nodes[3], 0.3);
        let longest = nodes.windows(2).map(|n| n[1] - n[0]).fold(0.0, f64::max);
        assert!(longest < 0.1 + 1e-12);
    }

    #[test]
    fn says_how_many_elements_it_needs() {
        let error = nodes("bodies[0].elements", 1, &[0.5]).expect_err("too few");
        assert!(error.to_string().contains("at least 2 elements"));
    }
}
