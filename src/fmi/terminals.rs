//! `terminalsAndIcons.xml`: one terminal a port, so that a master connects ports as a whole.

use std::io;

use super::xml::{Xml, document};
use crate::scene::{PortKind, Resolved, ResolvedPort, Scene};
use crate::simulation::{Causality, Variable, variables};

/// The terminals of a scene; nothing where it has no ports.
pub fn terminals(scene: &Scene) -> Option<String> {
    let resolved = scene.resolved();
    if resolved.ports.is_empty() {
        return None;
    }
    Some(document(|xml| write_all(xml, &resolved)))
}

fn write_all(xml: &mut Xml, resolved: &Resolved<'_>) -> io::Result<()> {
    let variables = variables(resolved.scene);
    // FMI 2.0.4 takes the file as FMI 3.0 defines it, with its schema.
    xml.create_element("fmiTerminalsAndIcons")
        .with_attribute(("fmiVersion", "3.0"))
        .write_inner_content(|xml| {
            xml.create_element("Terminals").write_inner_content(|xml| {
                let mut ports = resolved.ports.iter();
                ports.try_for_each(|port| write_terminal(xml, port, &variables))
            })?;
            Ok(())
        })?;
    Ok(())
}

/// Any two ports fit: what both have is connected, and a spring and damper feel no acceleration.
fn write_terminal(
    xml: &mut Xml,
    port: &ResolvedPort<'_>,
    variables: &[Variable],
) -> io::Result<()> {
    let what = match &port.kind {
        PortKind::Force { .. } => "force in, motion out",
        PortKind::Motion { .. } | PortKind::Coupling { .. } => "motion in, force out",
    };
    let description = format!("{}: {what}", port.marker.name);
    xml.create_element("Terminal")
        .with_attribute(("name", port.name))
        .with_attribute(("matchingRule", "bus"))
        .with_attribute(("description", description.as_str()))
        .write_inner_content(|xml| {
            for (variable, member) in members(port.name, variables) {
                xml.create_element("TerminalMemberVariable")
                    .with_attribute(("variableName", variable.name.as_str()))
                    .with_attribute(("memberName", member.as_str()))
                    .with_attribute(("variableKind", "signal"))
                    .write_empty()?;
            }
            Ok(())
        })?;
    Ok(())
}

/// Inputs and outputs of a port, and what they are called in every port.
fn members<'a>(
    port: &'a str,
    variables: &'a [Variable],
) -> impl Iterator<Item = (&'a Variable, String)> {
    variables.iter().filter_map(move |variable| {
        let (of, key) = variable.name.split_once('.')?;
        let is_signal = matches!(
            Causality::of(variable),
            Causality::Input | Causality::Output
        );
        let letters = if key.starts_with("quaternion") {
            ["_w", "_x", "_y", "_z"]
        } else {
            ["_x", "_y", "_z", ""]
        };
        let named =
            |key: String, (k, letter): (usize, &str)| key.replace(&format!("[{}]", k + 1), letter);
        let member = letters.into_iter().enumerate().fold(key.to_owned(), named);
        (of == port && is_signal).then_some((variable, member))
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::scene::example;

    #[test]
    fn ports_of_both_kinds_have_the_same_members() {
        let scene = example();
        let list = variables(&scene);
        let of = |name: &str| -> BTreeSet<String> {
            let port = scene.ports.iter().find(|port| port.name == name);
            let port = port.expect("a port of the example");
            members(&port.name, &list)
                .map(|(_, member)| member)
                .collect()
        };
        let (plug, socket, mount) = (of("plug"), of("socket"), of("mount"));
        assert_eq!(plug.len(), 12);
        assert_eq!(plug, socket);
        let felt = |member: &&String| !member.contains("acceleration");
        let but_accelerations: BTreeSet<String> = plug.iter().filter(felt).cloned().collect();
        assert_eq!(mount, but_accelerations);
    }

    #[test]
    fn every_member_is_a_variable_and_scenes_without_ports_have_no_file() {
        let mut scene = example();
        let text = terminals(&scene).expect("terminals");
        for port in &scene.ports {
            assert!(text.contains(&format!("<Terminal name=\"{}\"", port.name)));
        }
        assert!(text.contains("variableName=\"plug.force[2]\" memberName=\"force_y\""));
        assert!(!text.contains("mount.stiffness"));
        scene.ports.clear();
        assert_eq!(terminals(&scene), None);
    }
}
