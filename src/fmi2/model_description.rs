//! `modelDescription.xml`: from the variables of a scene, and nothing else.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use super::MODEL_IDENTIFIER;
use super::guid::guid;
use super::logger::Category;
use crate::page::number;
use crate::scene::Scene;
use crate::simulation::{Causality, Unit, Variable, variables};

type Xml = Writer<Vec<u8>>;

/// The terms of the library in every unit, and where it says more.
const LICENSE: &str = concat!(
    "library: ",
    env!("CARGO_PKG_LICENSE"),
    ", see documentation/licenses"
);

/// The model description of a scene. No date, no path: the same scene gives the same bytes.
pub fn model_description(scene: &Scene) -> String {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    write_all(&mut xml, scene).expect("writing into memory cannot fail");
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    String::from_utf8(bytes).expect("written from texts")
}

fn write_all(xml: &mut Xml, scene: &Scene) -> io::Result<()> {
    let variables = variables(scene);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let guid = guid(scene, &variables);
    // What a model says of itself goes before what holds of every one.
    let own = scene.about.texts().map(|(key, text)| match key {
        "license" => (key, format!("{text}; {LICENSE}")),
        _ => (key, text.to_owned()),
    });
    let mut about: Vec<(&str, String)> = own.collect();
    if scene.about.license.is_none() {
        about.push(("license", LICENSE.into()));
    }
    xml.create_element("fmiModelDescription")
        .with_attribute(("fmiVersion", "2.0"))
        .with_attribute(("modelName", scene.name.as_str()))
        .with_attribute(("guid", guid.as_str()))
        .with_attributes(about.iter().map(|(key, text)| (*key, text.as_str())))
        .with_attribute((
            "generationTool",
            concat!("Flexbody ", env!("CARGO_PKG_VERSION")),
        ))
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

fn units(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
    let mut used: Vec<Unit> = Vec::new();
    for unit in variables.iter().filter_map(|variable| variable.unit) {
        if !used.contains(&unit) {
            used.push(unit);
        }
    }
    xml.create_element("UnitDefinitions")
        .write_inner_content(|xml| used.iter().try_for_each(|unit| write_unit(xml, unit)))?;
    Ok(())
}

fn write_unit(xml: &mut Xml, unit: &Unit) -> io::Result<()> {
    let bases = ["kg", "m", "s", "rad"].into_iter().zip(unit.exponents);
    let exponents: Vec<(&str, String)> = bases
        .filter(|(_, exponent)| *exponent != 0)
        .map(|(base, exponent)| (base, exponent.to_string()))
        .collect();
    let attributes = exponents
        .iter()
        .map(|(base, exponent)| (*base, exponent.as_str()));
    xml.create_element("Unit")
        .with_attribute(("name", unit.name))
        .write_inner_content(|xml| {
            xml.create_element("BaseUnit")
                .with_attributes(attributes)
                .write_empty()?;
            Ok(())
        })?;
    Ok(())
}

fn log_categories(xml: &mut Xml) -> io::Result<()> {
    xml.create_element("LogCategories")
        .write_inner_content(|xml| {
            for category in Category::ALL {
                xml.create_element("Category")
                    .with_attribute(("name", category.name().to_str().unwrap_or_default()))
                    .with_attribute(("description", category.description()))
                    .write_empty()?;
            }
            Ok(())
        })?;
    Ok(())
}

fn default_experiment(xml: &mut Xml, scene: &Scene) -> io::Result<()> {
    let values = [
        ("startTime", 0.0),
        ("stopTime", scene.experiment.stop_time),
        ("tolerance", scene.relative_tolerance()),
        ("stepSize", scene.experiment.step),
    ];
    let texts = values.map(|(name, value)| (name, number(value)));
    xml.create_element("DefaultExperiment")
        .with_attributes(texts.iter().map(|(name, text)| (*name, text.as_str())))
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

/// Causality, variability and initial of a variable.
fn kind(variable: &Variable) -> (&'static str, &'static str, Option<&'static str>) {
    match Causality::of(variable) {
        Causality::Independent => ("independent", "continuous", None),
        Causality::Parameter => ("parameter", "fixed", Some("exact")),
        Causality::Input => ("input", "continuous", None),
        Causality::Output => ("output", "continuous", Some("calculated")),
        Causality::CalculatedParameter => ("calculatedParameter", "fixed", Some("calculated")),
    }
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
