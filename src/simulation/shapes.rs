//! Where bodies are, for pictures.

use nalgebra::Vector3;

use super::engine::Engine;
use super::inputs::Inputs;
use super::quantities::{Evaluated, value};
use super::{ENGINE, Error, Quantity, Simulation, Source, Variable};
use crate::bodies::{LineStance, Marker, Node, Patch, ReducedBody, axes_at, combined, completed};
use crate::math::space::{Vector, components};
use crate::scene::{Assembled, LoadId, ModalLine, PatchBody, PatchGrid};
use crate::system::{Evaluation, State};

/// Where a body is: what a line or surface of it is drawn from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// Position (m) and slope of every node along a cable, rod or beam, between which its line is the cubic of Hermite; of a rigid body
    /// its origin and the first axis of its frame. Third components are zero in the plane.
    pub nodes: Vec<[[f64; 3]; 2]>,
    /// Axes of the sections of a rod or beam at its nodes, the normal first; of a rigid body that rotates in space the axes of its frame;
    /// else none. In global components.
    pub axes: Vec<[[f64; 3]; 3]>,
    /// Amplitudes of the modes in the file of a reduced body; else none.
    pub amplitudes: Vec<f64>,
    /// Strains of these modes: amplitudes without what moves without strain; else none.
    pub strains: Vec<f64>,
    /// Points on a plate or shell, m; else none.
    pub surface: Vec<[f64; 3]>,
}

impl Simulation {
    /// Where all markers are now, m: body by body, in the order of their names; the third component is zero in the
    /// plane.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::Simulation};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let mut simulation = Simulation::new(scene);
    /// simulation.step(1.0)?;
    /// let [x, y, z] = simulation.markers()?[0];
    /// assert!((x - 1.0).abs() < 1e-9 && y == 0.0 && z == 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn markers(&mut self) -> Result<Vec<[f64; 3]>, Error> {
        self.refresh()?;
        let engine = self.engine.as_mut().expect(ENGINE);
        Ok(engine.markers(&self.state, &self.inputs))
    }

    /// Where points along every body are now, m: the ends of as many equal lengths of a cable as `parts` makes of its
    /// number of elements, the centre of mass of a rigid body; the third component is zero in the plane.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::Simulation};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let mut simulation = Simulation::new(scene);
    /// let lines = simulation.outlines(|elements| 4 * elements as u32)?;
    /// assert_eq!(lines, [[[0.0; 3]]]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn outlines(&mut self, parts: impl Fn(usize) -> u32) -> Result<Vec<Vec<[f64; 3]>>, Error> {
        self.refresh()?;
        let engine = self.engine.as_mut().expect(ENGINE);
        Ok(engine.outlines(&self.state, &self.inputs, &parts))
    }

    /// Returns the lines of all bodies as the scene draws them, m. The list is empty before [`Self::initialize`].
    pub(super) fn drawn_outlines(&self, parts: impl Fn(usize) -> u32) -> Vec<Vec<[f64; 3]>> {
        let engine = self.engine.as_ref();
        engine
            .map(|engine| engine.drawn_outlines(&parts))
            .unwrap_or_default()
    }

    /// Returns the values of computed variables in the configuration that the scene draws, in their order. Variables
    /// that are no position, angle or direction are 0.
    pub(super) fn drawn(&self) -> Vec<f64> {
        let computed = self.variables.iter().filter(|v| v.is_computed());
        let drawn = |variable: &Variable| match (&self.engine, variable.source) {
            (Some(engine), Source::Output(quantity)) => engine.drawn(quantity),
            _ => 0.0,
        };
        computed.map(drawn).collect()
    }

    /// How all bodies stand now.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::Simulation};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let mut simulation = Simulation::new(scene);
    /// let poses = simulation.poses()?;
    /// assert_eq!(poses[0].nodes[0][0], [0.0; 3]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn poses(&mut self) -> Result<Vec<Pose>, Error> {
        self.refresh()?;
        let engine = self.engine.as_mut().expect(ENGINE);
        Ok(engine.poses(&self.state, &self.inputs))
    }

    /// How all bodies stand where the scene draws them, in the order of the bodies.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub fn drawn_poses(&mut self) -> Result<Vec<Pose>, Error> {
        self.refresh()?;
        let engine = self.engine.as_ref();
        Ok(engine
            .map(|engine| engine.drawn_poses())
            .unwrap_or_default())
    }

    /// Axial force (N) and bending moments about both axes of the section (N m) at the nodes of every flexible body now, in the order of
    /// the bodies; none of a rigid one. Of a cable and in the plane the first moment is the size of the moment, the second is 0.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub fn section_forces(&mut self) -> Result<Vec<Vec<[f64; 3]>>, Error> {
        self.refresh()?;
        let engine = self.engine.as_mut();
        let forces = engine.map(|engine| engine.section_forces(&self.state, &self.inputs));
        Ok(forces.unwrap_or_default())
    }

    /// Stress 11, 22 and 12 at the bottom and then at the top of every plate or shell now, at the points that it is drawn with and along the
    /// axes of its section, Pa, in the order of the bodies; none of another body and of a section that is given as matrices.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub fn face_stresses(&mut self) -> Result<Vec<Vec<[f64; 6]>>, Error> {
        self.refresh()?;
        let engine = self.engine.as_mut();
        let stresses = engine.map(|engine| engine.face_stresses(&self.state, &self.inputs));
        Ok(stresses.unwrap_or_default())
    }

    /// The value of a quantity now, whether it is an output or not.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub fn read(&mut self, quantity: Quantity) -> Result<f64, Error> {
        self.refresh()?;
        let engine = self.engine.as_mut().expect(ENGINE);
        Ok(engine.output(quantity, &self.state, &self.inputs))
    }

    /// Largest distance of the nodes of every flexible body from the best rigid fit of its drawn shape, m, in the order of the bodies:
    /// cables, rods, beams, plates and shells; 0 of one that is rigid.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub(in crate::simulation) fn elastic_displacements(&mut self) -> Result<Vec<f64>, Error> {
        self.refresh()?;
        let engine = self.engine.as_mut().expect(ENGINE);
        Ok(engine.elastic_displacements(&self.state, &self.inputs))
    }

    /// Error in position (m) that the mesh of every plate and shell makes now along `s1` and `s2`, by jumps of curvature, with the place of the
    /// body: infinite where no node tells.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub(in crate::simulation) fn missed_by_patches(
        &mut self,
    ) -> Result<Vec<(usize, [f64; 2])>, Error> {
        self.refresh()?;
        let engine = self.engine.as_mut().expect(ENGINE);
        Ok(engine.missed_by_patches(&self.state, &self.inputs))
    }

    /// The force per reference length (N/m) of a contact along a body now at these material coordinates, in global components.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub fn contact(&mut self, load: LoadId, at: &[f64]) -> Result<Vec<[f64; 3]>, Error> {
        self.refresh()?;
        let engine = self.engine.as_mut().expect(ENGINE);
        Ok(engine.contact(load, at, &self.state, &self.inputs))
    }

    /// Numbers that the master sets, in the order of [`crate::scene::Resolved::numbers`].
    pub fn inputs(&self) -> &[f64] {
        &self.inputs.values
    }
}

impl<const D: usize> Engine<D> {
    /// Where all markers are.
    pub(super) fn markers(&mut self, state: &State, inputs: &Inputs) -> Vec<[f64; 3]> {
        let (assembled, Evaluation { x, .. }) = self.placed(state, inputs);
        let markers = assembled.markers().iter();
        markers
            .map(|marker| components(&marker.position(x)))
            .collect()
    }

    /// Where points along every body are.
    pub(super) fn outlines(
        &mut self,
        state: &State,
        inputs: &Inputs,
        parts: &dyn Fn(usize) -> u32,
    ) -> Vec<Vec<[f64; 3]>> {
        let (assembled, Evaluation { x, .. }) = self.placed(state, inputs);
        outlines(assembled, x, parts)
    }

    /// Returns the lines of all bodies as the scene draws them, m.
    pub(super) fn drawn_outlines(&self, parts: &dyn Fn(usize) -> u32) -> Vec<Vec<[f64; 3]>> {
        outlines(&self.assembled, &self.assembled.nodes, parts)
    }

    /// See [`drawn`].
    pub(super) fn drawn(&self, quantity: Quantity) -> f64 {
        drawn(quantity, &self.assembled)
    }

    /// Largest elastic displacement of every body along a line, plate and shell.
    pub(super) fn elastic_displacements(&mut self, state: &State, inputs: &Inputs) -> Vec<f64> {
        let (assembled, values) = self.placed(state, inputs);
        let Assembled { system, nodes, .. } = assembled;
        let bodies = system.bodies();
        let of = |body: usize| {
            let bends = bodies.line(body);
            let bends = bends.map(|chain| values.elastic_displacement(system, chain, nodes));
            let modal = assembled
                .modal_line(body)
                .map(|(line, body)| line.deflection(body, &values.x));
            let patch = assembled.patch(body);
            let patch = patch.map(|patch| values.surface_elastic_displacement(patch, nodes));
            (bends.or(modal).or(patch)).or(bodies.is_along_line(body).then_some(0.0))
        };
        (0..bodies.ranges.len()).filter_map(of).collect()
    }

    /// How all bodies stand.
    pub(super) fn poses(&mut self, state: &State, inputs: &Inputs) -> Vec<Pose> {
        let (assembled, Evaluation { x, .. }) = self.placed(state, inputs);
        poses(assembled, x)
    }

    /// How all bodies stand where the scene draws them.
    pub(super) fn drawn_poses(&self) -> Vec<Pose> {
        poses(&self.assembled, &self.assembled.nodes)
    }

    /// Stress at the bottom and the top of all plates and shells.
    pub(super) fn face_stresses(&mut self, state: &State, inputs: &Inputs) -> Vec<Vec<[f64; 6]>> {
        let patches = self.assembled.system.bodies().patches();
        if self.grid_stresses.len() < patches.len() {
            let read = |(patch, body): (&Patch, &PatchBody)| {
                let grid = PatchGrid::new(patch.divisions());
                patch.grid_stress(|at| body.faces(at), &grid.lines_at())
            };
            self.grid_stresses = patches
                .iter()
                .zip(&self.assembled.plates)
                .map(read)
                .collect();
        }
        let mut readers = std::mem::take(&mut self.grid_stresses);
        let (assembled, values) = self.placed(state, inputs);
        let patches = assembled.system.bodies().patches();
        let mut found: Vec<Vec<[f64; 6]>> = (patches.iter().zip(&mut readers))
            .map(|(patch, reader)| match reader {
                Some(reader) => reader.read(patch, (&values.x, &values.v)),
                None => Vec::new(),
            })
            .collect();
        let of = |body: usize| {
            let patch = assembled.patch_place(body);
            patch.map_or_else(Vec::new, |patch| std::mem::take(&mut found[patch]))
        };
        let all = (0..assembled.system.bodies().ranges.len())
            .map(of)
            .collect();
        self.grid_stresses = readers;
        all
    }

    /// Axial force and bending moments at the nodes of all flexible bodies.
    pub(super) fn section_forces(&mut self, state: &State, inputs: &Inputs) -> Vec<Vec<[f64; 3]>> {
        let (assembled, values) = self.evaluated(Evaluated::Dynamics, state, inputs);
        let system = &assembled.system;
        let at = |marker: &Marker| values.section_forces(system, marker);
        let of = |body: usize| {
            let Some(chain) = system.bodies().line(body) else {
                return Vec::new();
            };
            let count = chain.elements().len();
            let start = |element| at(&Marker::inside(body, chain, element, 0.0));
            let last = at(&Marker::inside(body, chain, count - 1, 1.0));
            (0..count).map(start).chain([last]).collect()
        };
        (0..system.bodies().ranges.len()).map(of).collect()
    }
}

fn poses<const D: usize>(assembled: &Assembled<D>, x: &[Node<D>]) -> Vec<Pose> {
    let bodies = 0..assembled.system.bodies().ranges.len();
    bodies.map(|body| pose(assembled, body, x)).collect()
}

/// Returns the value of a position, an angle or a direction in the configuration that the scene draws. Other quantities
/// are 0.
pub(super) fn drawn<const D: usize>(quantity: Quantity, assembled: &Assembled<D>) -> f64 {
    use Quantity::*;
    let is_place = matches!(
        quantity,
        Position(..)
            | CenterOfMass(_)
            | Displacement(_)
            | Angle(_)
            | Direction(..)
            | Orientation(..)
            | Quaternion(..)
            | RotationVector(..)
    );
    if !is_place {
        return 0.0;
    }
    let Assembled { system, nodes, .. } = assembled;
    value(
        quantity,
        &Evaluation::at_rest(system, nodes),
        assembled,
        [0.0; 2],
    )
}

/// How a body stands.
fn pose<const D: usize>(assembled: &Assembled<D>, body: usize, x: &[Node<D>]) -> Pose {
    let bodies = assembled.system.bodies();
    if let Some(LineStance { nodes, axes }) = bodies.line_stance(body, x) {
        return Pose {
            nodes,
            axes,
            ..Pose::default()
        };
    }
    if let Some(patch) = assembled.patch(body) {
        return patch_pose(assembled, patch, x);
    }
    let first = bodies.ranges[body].start;
    let [position, slope] = [0, 1].map(|part| components(&Vector::from(x[first][part])));
    let reduced = assembled.reduced(body);
    if let Some((line, body)) = assembled.modal_line(body) {
        return modal_pose(line, body, x);
    }
    if bodies.rigid_at(first).is_none() && reduced.is_none() {
        // The frame of a body without modes in the plane begins at the origin of its file.
        let [x, y, _] = <[f64; 3]>::from(*assembled.center(body));
        let way = [
            x * slope[0] - y * slope[1],
            x * slope[1] + y * slope[0],
            0.0,
        ];
        let origin = std::array::from_fn(|k| position[k] - way[k]);
        return Pose {
            nodes: vec![[origin, slope]],
            ..Pose::default()
        };
    }
    let principal = completed::<D, _>(axes_at(first, x));
    let within = assembled.frame(body);
    let axes: [Vector3<f64>; 3] =
        std::array::from_fn(|k| combined(&principal, &within.row(k).transpose()));
    let origin = Vector3::from(position) - combined(&axes, assembled.center(body));
    Pose {
        nodes: vec![[origin.into(), axes[0].into()]],
        axes: if D == 2 {
            Vec::new()
        } else {
            vec![axes.map(Into::into)]
        },
        amplitudes: reduced.map_or_else(Vec::new, |reduced| reduced.file_amplitudes(x)),
        strains: reduced.map_or_else(Vec::new, |reduced| reduced.file_strains(x)),
        ..Pose::default()
    }
}

/// How a plate or shell stands: points on it. Its place is the mean of these where the scene draws it, in every configuration.
fn patch_pose<const D: usize>(assembled: &Assembled<D>, patch: &Patch, x: &[Node<D>]) -> Pose {
    let drawn = patch_points(patch, &assembled.nodes);
    let mean = |k: usize| drawn.iter().map(|at| at[k]).sum::<f64>() / drawn.len() as f64;
    let axes: [[f64; 3]; 3] = std::array::from_fn(|k| Vector::<3>::ith(k, 1.0).into());
    Pose {
        nodes: vec![[std::array::from_fn(mean), axes[0]]],
        axes: vec![axes],
        surface: patch_points(patch, x),
        ..Pose::default()
    }
}

/// Points on a plate or shell, m.
fn patch_points<const D: usize>(patch: &Patch, x: &[Node<D>]) -> Vec<[f64; 3]> {
    let places = PatchGrid::new(patch.divisions()).in_elements();
    places
        .map(|(element, xi)| patch.position(element, xi, x))
        .collect()
}

/// How a line stands that is reduced to modes.
fn modal_pose<const D: usize>(line: &ModalLine, body: &ReducedBody, x: &[Node<D>]) -> Pose {
    let sections = line.sections(body, x);
    Pose {
        nodes: sections.iter().map(|(at, axes)| [*at, axes[0]]).collect(),
        axes: (sections.into_iter().filter(|_| D > 2))
            .map(|(_, axes)| axes)
            .collect(),
        ..Pose::default()
    }
}

fn outlines<const D: usize>(
    assembled: &Assembled<D>,
    x: &[Node<D>],
    parts: &dyn Fn(usize) -> u32,
) -> Vec<Vec<[f64; 3]>> {
    let bodies = assembled.system.bodies();
    let of = |body: usize| {
        if let Some(patch) = assembled.patch(body) {
            return patch_points(patch, x);
        }
        match assembled.modal_line(body) {
            Some((line, body)) => {
                let sections = line.sections(body, x).into_iter();
                sections.map(|(at, _)| at).collect()
            }
            None => bodies.outline(body, x, parts),
        }
    };
    (0..bodies.ranges.len()).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    /// `E I`, N m^2, and length, m.
    const BENDING: f64 = 10.0;
    const LENGTH: f64 = 2.0;

    /// A cantilever along a slanted line under a force across its tip, N.
    fn cantilever(dimension: usize, element: &str, force: f64) -> Simulation {
        let section = match (element, dimension) {
            ("cable", _) => r#""area": 0.01, "second_moment": 1e-4"#,
            (_, 2) => r#""area": 0.01, "second_moment": 1e-4, "shear_factor": 1e4"#,
            ("rod", _) => {
                r#""area": 0.01, "second_moments": [1e-4, 1e-4], "torsion_constant": 1e-4"#
            }
            _ => {
                r#""area": 0.01, "second_moments": [1e-4, 1e-4], "torsion_constant": 1e-4, "shear_factors": [1e4, 1e4]"#
            }
        };
        let shear = if element == "cable" {
            ""
        } else {
            r#""shear_modulus": 4e4,"#
        };
        let vector = |v: [f64; 3]| format!("{:?}", &v[..dimension]);
        let direction = [-0.8, 0.6, 0.0].map(|c| c * force);
        let text = format!(
            r#"{{ "name": "c", "dimension": {dimension}, "gravity": {},
              "bodies": [ {{ "name": "line", "element": "{element}", "elements": 6,
                "material": {{ "youngs_modulus": 1e5, {shear} "density": 1000.0 }},
                "section": {{ {section} }},
                "shape": {{ "line": {{ "from": {}, "to": {} }} }},
                "markers": {{ "root": 0.0, "tip": 1.0 }} }} ],
              "joints": [ {{ "name": "wall", "kind": "weld", "markers": ["ground", "line.root"] }} ],
              "loads": [ {{ "name": "push", "kind": "force", "marker": "line.tip", "value": {} }} ],
              "initial": "static_equilibrium", "accuracy": {{ "relative_tolerance": 1e-10 }} }}"#,
            vector([0.0; 3]),
            vector([1.0, 2.0, 0.0]),
            vector([2.2, 3.6, 0.0]),
            vector(direction),
        );
        Simulation::new(Scene::from_json(&text).expect("a valid scene"))
    }

    const ALL: [(usize, &str); 5] = [
        (2, "cable"),
        (2, "beam"),
        (3, "cable"),
        (3, "rod"),
        (3, "beam"),
    ];

    #[test]
    fn section_forces_are_those_of_a_cantilever() {
        for (dimension, element) in ALL {
            let force = 1e-3;
            let mut simulation = cantilever(dimension, element, force);
            simulation.initialize(0.0).expect("an equilibrium");
            let found = simulation.section_forces().expect("a state");
            assert_eq!(found[0].len(), 7);
            for (node, [axial, first, second]) in found[0].iter().enumerate() {
                let wanted = force * LENGTH * (1.0 - node as f64 / 6.0);
                let miss = (first.hypot(*second) - wanted).abs() / (force * LENGTH);
                assert!(
                    miss < 1e-3,
                    "{dimension} {element} {node}: {first} {second} {wanted}"
                );
                assert!(
                    axial.abs() < 1e-3 * force,
                    "{dimension} {element} {node}: {axial}"
                );
            }
        }
    }

    #[test]
    fn bodies_are_drawn_where_the_scene_says() {
        for (dimension, element) in ALL {
            let mut simulation = cantilever(dimension, element, 1.0);
            simulation.initialize(0.0).expect("an equilibrium");
            let drawn = simulation.drawn_poses().expect("a state");
            for (node, [position, slope]) in drawn[0].nodes.iter().enumerate() {
                let part = node as f64 / 6.0;
                let wanted = [1.0 + 1.2 * part, 2.0 + 1.6 * part, 0.0, 0.6, 0.8, 0.0];
                let found = position.iter().chain(slope).zip(wanted);
                assert!({ found }.all(|(a, b)| (a - b).abs() < 1e-12), "{drawn:?}");
            }
            assert_eq!(drawn[0].axes.is_empty(), element == "cable");
            for axes in &drawn[0].axes {
                let along = [0.6, 0.8, 0.0];
                assert!(
                    (0..3).all(|k| (axes[0][k] - along[k]).abs() < 1e-12),
                    "{axes:?}"
                );
            }
        }
    }

    #[test]
    fn elastic_displacement_is_that_of_a_cantilever() {
        for (dimension, element) in ALL {
            let force = 1e-3;
            let mut simulation = cantilever(dimension, element, force);
            simulation.initialize(0.0).expect("an equilibrium");
            // `F (3 L s^2 - s^3) / 6 E I` less its best straight line is largest at the root.
            let wanted = force * LENGTH.powi(3) / (20.0 * BENDING);
            let found = simulation
                .elastic_displacements()
                .expect("a state")
                .into_iter()
                .fold(0.0, f64::max);
            let miss = (found / wanted - 1.0).abs();
            assert!(miss < 1e-3, "{dimension} {element}: {found} {wanted}");
        }
    }
}
