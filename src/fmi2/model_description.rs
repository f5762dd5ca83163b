//! `modelDescription.xml`: from the variables of a scene, and nothing else.

use std::io;

use crate::fmi::xml::{
    TOOL, Xml, about, default_experiment, document, kind, log_categories, units,
};
use crate::fmi::{MODEL_IDENTIFIER, guid};
use crate::scene::Scene;
use crate::scene::number;
use crate::simulation::{Causality, Variable, variables};

/// The model description of a scene. No date, no path: the same scene gives the same bytes.
pub fn model_description(scene: &Scene) -> String {
    document(|xml| write_all(xml, scene))
}

fn write_all(xml: &mut Xml, scene: &Scene) -> io::Result<()> {
    let variables = variables(scene);
    let guid = guid(scene, &variables);
    let about = about(scene);
    xml.create_element("fmiModelDescription")
        .with_attribute(("fmiVersion", "2.0"))
        .with_attribute(("modelName", scene.name.as_str()))
        .with_attribute(("guid", guid.as_str()))
        .with_attributes(about.iter().map(|(key, text)| (*key, text.as_str())))
        .with_attribute(("generationTool", TOOL))
        .with_attribute(("variableNamingConvention", "structured"))
        .write_inner_content(|xml| {
            co_simulation(xml)?;
            units(xml, &variables)?;
            log_categories(xml)?;
            default_experiment(xml, scene)?;
            model_variables(xml, &variables)?;
            model_structure(xml, &variables)
        })?;
    Ok(())
}

/// All capabilities, those too that have the schema's default: what is not offered is said.
fn co_simulation(xml: &mut Xml) -> io::Result<()> {
    let flags = [
        ("modelIdentifier", MODEL_IDENTIFIER),
        ("needsExecutionTool", "false"),
        ("canHandleVariableCommunicationStepSize", "true"),
        ("canInterpolateInputs", "true"),
        ("maxOutputDerivativeOrder", "2"),
        ("canRunAsynchronuously", "false"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canNotUseMemoryManagementFunctions", "true"),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
        ("providesDirectionalDerivative", "true"),
    ];
    xml.create_element("CoSimulation")
        .with_attributes(flags)
        .write_empty()?;
    Ok(())
}

fn model_variables(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
    xml.create_element("ModelVariables")
        .write_inner_content(|xml| {
            for (reference, variable) in variables.iter().enumerate() {
                write_variable(xml, reference, variable)?;
            }
            Ok(())
        })?;
    Ok(())
}

fn write_variable(xml: &mut Xml, reference: usize, variable: &Variable) -> io::Result<()> {
    let (causality, variability, initial) = kind(variable);
    let mut element = xml
        .create_element("ScalarVariable")
        .with_attribute(("name", variable.name.as_str()))
        .with_attribute(("valueReference", reference.to_string().as_str()))
        .with_attribute(("description", variable.description.as_str()))
        .with_attribute(("causality", causality))
        .with_attribute(("variability", variability));
    if let Some(initial) = initial {
        element = element.with_attribute(("initial", initial));
    }
    element.write_inner_content(|xml| write_type(xml, variable))?;
    Ok(())
}

fn write_type(xml: &mut Xml, variable: &Variable) -> io::Result<()> {
    let name = if variable.is_integer() {
        "Integer"
    } else {
        "Real"
    };
    let mut element = xml.create_element(name);
    if let Some(unit) = variable.unit {
        element = element.with_attribute(("unit", unit.name));
    }
    let (min, max) = variable.limits();
    for (name, value) in [("min", min), ("max", max), ("start", variable.start)] {
        if let Some(value) = value {
            element = element.with_attribute((name, number(value).as_str()));
        }
    }
    element.write_empty()?;
    Ok(())
}

/// Outputs with what they depend on: state-like ones on no input, so that masters see no loop
/// where there is none; those with direct feedthrough on the inputs that act on them at once. Positions and
/// rates of a driven motion do not: they move in the next step. An initial unknown without
/// `dependencies` depends on everything, which is true after a change of any parameter.
fn model_structure(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
    let of = |causality: Causality| -> Vec<usize> {
        let indexed = variables.iter().enumerate();
        indexed
            .filter(|(_, v)| Causality::of(v) == causality)
            .map(|(i, _)| i)
            .collect()
    };
    // The standard counts ScalarVariables from 1 here.
    let index = |reference: &usize| (reference + 1).to_string();
    let (inputs, outputs) = (of(Causality::Input), of(Causality::Output));
    let dependencies = |output: usize| -> String {
        let on = |input: &&usize| variables[output].depends_on(&variables[**input]);
        let on: Vec<String> = inputs.iter().filter(on).map(index).collect();
        on.join(" ")
    };
    let mut unknowns = [outputs.clone(), of(Causality::CalculatedParameter)].concat();
    unknowns.sort_unstable();
    xml.create_element("ModelStructure")
        .write_inner_content(|xml| {
            list(xml, "Outputs", &outputs, |output| {
                Some(dependencies(output))
            })?;
            list(xml, "InitialUnknowns", &unknowns, |_| None)
        })?;
    Ok(())
}

/// A list of unknowns; an empty one is left out, as the schema wants.
fn list(
    xml: &mut Xml,
    name: &str,
    unknowns: &[usize],
    dependencies: impl Fn(usize) -> Option<String>,
) -> io::Result<()> {
    if unknowns.is_empty() {
        return Ok(());
    }
    xml.create_element(name).write_inner_content(|xml| {
        for unknown in unknowns {
            let mut element = xml
                .create_element("Unknown")
                .with_attribute(("index", (unknown + 1).to_string().as_str()));
            if let Some(dependencies) = dependencies(*unknown) {
                element = element.with_attribute(("dependencies", dependencies.as_str()));
            }
            element.write_empty()?;
        }
        Ok(())
    })?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::example;

    #[test]
    fn the_same_scene_gives_the_same_bytes() {
        let scene = example();
        assert_eq!(model_description(&scene), model_description(&scene));
    }

    #[test]
    fn variables_stand_in_the_order_of_their_references() {
        let scene = example();
        let text = model_description(&scene);
        let names: Vec<&str> = text
            .lines()
            .filter_map(|line| line.trim().strip_prefix("<ScalarVariable name=\""))
            .filter_map(|line| line.split('"').next())
            .collect();
        let expected = variables(&scene);
        let expected: Vec<&str> = expected.iter().map(|v| v.name.as_str()).collect();
        assert_eq!(names, expected);
    }

    #[test]
    fn outputs_depend_on_the_inputs_that_act_on_them_at_once() {
        let scene = example();
        let list = variables(&scene);
        let text = model_description(&scene);
        for (reference, variable) in list.iter().enumerate() {
            if Causality::of(variable) != Causality::Output {
                continue;
            }
            let on: Vec<String> = (1..=list.len())
                .filter(|index| variable.depends_on(&list[index - 1]))
                .map(|index| index.to_string())
                .collect();
            let on = on.join(" ");
            let line = format!(
                "<Unknown index=\"{}\" dependencies=\"{on}\"/>",
                reference + 1
            );
            assert!(text.contains(&line), "{}: {line}", variable.name);
        }
    }
}
