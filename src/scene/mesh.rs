//! Meshes: nodes where joints and loads act, the rest spread evenly.

use super::{Error, Scene};

impl Scene {
    /// Material coordinates in [0, 1] of the nodes of a body, by its index.
    ///
    /// # Errors
    /// When there are too few elements for the joints and loads inside the body.
    pub fn nodes(&self, body: usize) -> Result<Vec<f64>, Error> {
        let path = format!("bodies[{body}].elements");
        let elements = self.bodies[body].elements as usize;
        nodes(&path, elements, &self.loaded_coordinates(body))
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
            "expected at least {} elements (joints and loads act inside the body), found {elements}",
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
