//! From a validated scene to a system.

use nalgebra::Vector2;

use super::{Body, Error, Formulation, InputKind, JointKind, OutputKind, Scene, Strain};
use crate::body;
use crate::elements::{self, Nodal, cable};
use crate::system::joints::{self, Joint};
use crate::system::loads::{Load, LoadKind};
use crate::system::{PlanarBody, System};

/// Builds the system that a valid scene describes.
///
/// # Errors
/// When the mesh is too coarse for the joints and loads inside the body.
pub fn assemble(scene: &Scene) -> Result<System, Error> {
    let description = &scene.bodies[0];
    let nodes = scene.nodes(0)?;
    let joints = build_joints(scene, description, &nodes);
    let constraints: Vec<_> = joints
        .iter()
        .enumerate()
        .flat_map(|(index, joint)| joint.constraints(index))
        .collect();
    let formulation = match scene.method.formulation {
        Formulation::MassWeighted => body::Formulation::MassWeighted,
        Formulation::AsPrinted => body::Formulation::AsPrinted,
    };
    let curve: Vec<_> = nodes.iter().map(|s| node(description, *s)).collect();
    let elements = build_elements(description, &nodes, &curve);
    let body = PlanarBody::new(elements, &curve, &constraints, formulation);
    let loads = scene
        .inputs
        .iter()
        .filter_map(|input| {
            let kind = match input.kind {
                InputKind::Force => LoadKind::Force,
                InputKind::Moment => LoadKind::Moment,
            };
            let marker = body.marker(scene.marker(&input.marker)?.coordinate);
            Some(Load { kind, marker })
        })
        .collect();
    let angles = scene
        .outputs
        .iter()
        .filter(|output| output.kind == OutputKind::Angle)
        .filter_map(|output| scene.marker(output.marker.as_deref()?))
        .map(|marker| body.marker(marker.coordinate))
        .collect();
    Ok(System::new(
        body,
        scene.gravity.into(),
        joints,
        loads,
        angles,
    ))
}

/// Position and slope of the unstressed shape.
fn node(body: &Body, s: f64) -> [Vector2<f64>; 2] {
    [body.shape.point(s).into(), body.shape.tangent(s).into()]
}

fn build_elements(
    body: &Body,
    nodes: &[f64],
    curve: &[[Vector2<f64>; 2]],
) -> Vec<cable::Cable<2, 1>> {
    let (material, section) = (&body.material, &body.section);
    let strain = match body.strain {
        Strain::ThetaPrime => elements::Strain::ThetaPrime,
        Strain::GreenLagrangeFrenetKappa => elements::Strain::GreenLagrangeFrenetKappa,
        Strain::EngStrainFrenetKappa => elements::Strain::EngStrainFrenetKappa,
    };
    nodes
        .windows(2)
        .zip(curve.windows(2))
        .map(|(s, ends)| {
            let parameters = cable::Parameters {
                length: (s[1] - s[0]) * body.shape.length(),
                axial_stiffness: material.youngs_modulus * section.area,
                bending_stiffness: material.youngs_modulus * section.second_moment,
                line_density: material.density * section.area,
                damping_time: material.damping_time,
                strain,
            };
            let e = Nodal::from_columns(&[ends[0][0], ends[0][1], ends[1][0], ends[1][1]]);
            let curved = (!body.shape.is_straight()).then_some(&e);
            cable::Cable::new(parameters, curved)
        })
        .collect()
}

fn build_joints(scene: &Scene, body: &Body, nodes: &[f64]) -> Vec<Joint> {
    let build = |joint: &super::Joint| {
        let at = scene.marker(&joint.markers[1])?.coordinate;
        let distance = |i: &usize| (nodes[*i] - at).abs();
        let node = (0..nodes.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let kind = match joint.kind {
            JointKind::Revolute => joints::JointKind::Revolute,
            JointKind::Weld => joints::JointKind::Weld,
            JointKind::Slider => joints::JointKind::Slider(joint.direction?.into()),
            JointKind::Orientation => joints::JointKind::Orientation,
        };
        Some(Joint {
            kind,
            node,
            slope: body.shape.tangent(nodes[node]).into(),
        })
    };
    scene.joints.iter().filter_map(build).collect()
}
