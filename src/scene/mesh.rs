//! Meshes: nodes where something acts on a cable or is joined to it, the rest spread evenly.

use super::Error;
use super::description::OutputKind;
use super::resolved::{Cable, InputKind, OutputTarget, Place, Resolved, ResolvedMarker};

/// Shortest segment between two nodes, in elements of even length: shorter ones swing so fast that they
/// would set the steps of the whole scene.
pub(super) const SHORTEST: f64 = 1e-3;
/// Segments of a line that is reduced to modes, between which strains are of degree 2: its first three frequencies are exact to 1e-4.
const SEGMENTS: usize = 6;
/// Most segments of such a line: all pairs of their strains are combined.
const MOST_SEGMENTS: usize = 24;
/// Part of the shortest segment, and of the length of a body, by which roundoff moves a marker.
const ROUNDOFF: f64 = 1e-9;

impl<'a> Resolved<'a> {
    /// Material coordinates in [0, 1] of the nodes of a cable, between which modes are computed where it is reduced to them.
    ///
    /// # Errors
    /// When there are too few elements for what acts inside the body, or it acts at two places that are closer
    /// than a thousandth of an element; when their number is left to the planner.
    pub fn nodes(&self, cable: Cable<'_>) -> Result<Vec<f64>, Error> {
        let path = format!("bodies[{}]", cable.id.body);
        let held = self.loaded_coordinates(cable);
        let stations = cable.body.stations.iter().map(|station| station.at);
        if cable.is_modal() {
            let least = corners(&path, 1, &held)?.len() - 1;
            if least > MOST_SEGMENTS {
                let message = format!(
                    "expected markers and stations of a line that is reduced to modes at less than {MOST_SEGMENTS} places between its ends, found {}",
                    least - 1
                );
                return Err(Error::new(format!("{path}.markers"), message));
            }
            return nodes(&path, least.max(SEGMENTS), &held, stations.count());
        }
        let Some(elements) = cable.body.elements else {
            let message = "expected a number of elements, found \"auto\": `flexbody plan` finds it";
            return Err(Error::new(format!("{path}.elements"), message));
        };
        self.nodes_of(cable, elements)
    }

    /// Material coordinates in [0, 1] of the nodes of a cable with so many elements.
    ///
    /// # Errors
    /// As [`Self::nodes`].
    pub(super) fn nodes_of(&self, cable: Cable<'_>, elements: u32) -> Result<Vec<f64>, Error> {
        let path = format!("bodies[{}]", cable.id.body);
        let held = self.loaded_coordinates(cable);
        let stations = cable.body.stations.len();
        nodes(&path, elements as usize, &held, stations)
    }

    /// Fewest elements of a cable: what acts inside it acts at nodes.
    ///
    /// # Errors
    /// When it acts at two places that are closer than a thousandth of an element.
    pub fn fewest_elements(&self, cable: Cable<'_>) -> Result<u32, Error> {
        let path = format!("bodies[{}]", cable.id.body);
        let corners = corners(&path, 1, &self.loaded_coordinates(cable))?;
        Ok(corners.len() as u32 - 1)
    }

    /// Material coordinates of a cable where joints, motions, loads, inputs, ports and masses act or where
    /// the force from element to element is read: the mesh has nodes there. Increasing.
    pub fn loaded_coordinates(&self, cable: Cable<'_>) -> Vec<f64> {
        let loaded = self.loaded_markers().into_iter();
        let mut coordinates: Vec<f64> = loaded
            .filter_map(|marker| match marker.place {
                Place::Along(of, coordinate) if of.id == cable.id => Some(coordinate),
                Place::Along(..) | Place::Point(..) | Place::Interface(..) | Place::Patch(..) => {
                    None
                }
            })
            .collect();
        if cable.body.is_rod() {
            // What has axes is a node.
            coordinates.extend(cable.body.markers.values());
        }
        // Where the section begins to change otherwise is a node.
        coordinates.extend(cable.body.stations.iter().map(|station| station.at));
        coordinates.sort_by(f64::total_cmp);
        coordinates.dedup();
        coordinates
    }

    fn loaded_markers(&self) -> Vec<ResolvedMarker<'a>> {
        let mut found = self.acted_on();
        found.extend(self.outputs.iter().filter_map(|output| match output.of {
            OutputTarget::Marker(marker) if output.kind == OutputKind::ConnectivityForce => {
                Some(marker)
            }
            _ => None,
        }));
        found
    }

    /// Markers where joints, motions, loads, inputs, ports and masses act.
    pub(super) fn acted_on(&self) -> Vec<ResolvedMarker<'a>> {
        let mut found: Vec<ResolvedMarker<'a>> =
            self.masses.iter().map(|mass| mass.marker).collect();
        found.extend(self.ports.iter().map(|port| port.marker));
        found.extend(self.joints.iter().flat_map(|joint| joint.ends.markers()));
        let motions = self.motions.iter();
        found.extend(motions.flat_map(|motion| motion.driven.quantity().place.markers()));
        // Forces and moments come after all other loads.
        let (actions, others): (Vec<_>, Vec<_>) = { self.loads.iter() }
            .map(|load| &load.kind)
            .partition(|kind| kind.action().is_some());
        let loads = others.into_iter().chain(actions);
        found.extend(loads.flat_map(|kind| kind.markers()));
        for input in &self.inputs {
            if let InputKind::Action(action) = &input.kind {
                found.extend(action.on.markers());
            }
        }
        found
    }
}

/// Both ends and what is held between them, once each; what roundoff alone keeps apart is one.
fn corners(path: &str, elements: usize, held: &[f64]) -> Result<Vec<f64>, Error> {
    let shortest = SHORTEST / elements as f64;
    let one = (ROUNDOFF * shortest).max(4.0 * f64::EPSILON);
    let mut corners = vec![0.0];
    let inner = held.iter().copied().filter(|c| *c < 1.0 - one);
    for next in inner.chain([1.0]) {
        let last = *corners.last().expect("the first end is a corner");
        if next - last <= one {
            continue;
        }
        if next - last < shortest {
            let message = format!(
                "expected what acts on the cable at one place or at places at least {shortest:e} of its length \
                 apart (a thousandth of an element), found markers at {last} and {next}"
            );
            return Err(Error::new(format!("{path}.markers"), message));
        }
        corners.push(next);
    }
    Ok(corners)
}

/// Material coordinates in [0, 1] of the nodes of `elements` elements, with a node at every
/// coordinate of `held`, of which there are some by this number of stations.
fn nodes(path: &str, elements: usize, held: &[f64], stations: usize) -> Result<Vec<f64>, Error> {
    let corners = corners(path, elements, held)?;
    let segments: Vec<f64> = corners.windows(2).map(|c| c[1] - c[0]).collect();
    if elements < segments.len() {
        let inside = match stations {
            0 => "joints, loads and masses act inside the body".into(),
            _ => format!("its {stations} stations and what acts inside it are between elements"),
        };
        let message = format!(
            "expected at least {} elements ({inside}), found {elements}",
            segments.len()
        );
        return Err(Error::new(format!("{path}.elements"), message));
    }
    let mut counts = vec![1_u32; segments.len()];
    for _ in segments.len()..elements {
        // The next element goes where elements are longest.
        let longest = (0..segments.len()).max_by(|a, b| {
            let length = |i: usize| segments[i] / f64::from(counts[i]);
            length(*a).total_cmp(&length(*b))
        });
        counts[longest.expect("a cable has two ends")] += 1;
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
        let nodes = nodes("elements", 10, &[0.0, 0.3], 0).expect("enough elements");
        assert_eq!(nodes.len(), 11);
        assert_eq!(nodes[3], 0.3);
        let longest = nodes.windows(2).map(|n| n[1] - n[0]).fold(0.0, f64::max);
        assert!(longest < 0.1 + 1e-12);
    }

    #[test]
    fn says_how_many_elements_it_needs() {
        let error = nodes("bodies[0]", 1, &[0.5], 0).expect_err("too few");
        let told = error.to_string();
        assert!(
            told.starts_with("bodies[0].elements: expected at least 2 elements"),
            "{told}"
        );
    }

    #[test]
    fn places_that_roundoff_keeps_apart_share_a_node() {
        let held = [1e-16, 0.3, 0.1 + 0.2, 1.0 - 1e-16];
        let nodes = nodes("bodies[0]", 10, &held, 0).expect("three corners");
        assert_eq!((nodes.len(), nodes[3]), (11, 0.3));
        assert_eq!((nodes[0], nodes[10]), (0.0, 1.0));
    }

    #[test]
    fn slivers_are_refused() {
        for held in [[0.5, 0.5 + 1e-9], [1e-9, 0.5], [0.5, 1.0 - 9e-5]] {
            let told = nodes("bodies[0]", 10, &held, 0)
                .expect_err("a sliver")
                .to_string();
            assert!(
                told.starts_with("bodies[0].markers: expected what acts"),
                "{told}"
            );
        }
        assert!(nodes("bodies[0]", 10, &[0.5, 0.50011], 0).is_ok());
    }
}
