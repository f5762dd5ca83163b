//! `modelDescription.xml` of a model. Texts are the models' own and need no escaping.

use std::fmt::Write;

use crate::model::{Model, Quantity};

/// Units with their exponents of kg, m, s.
const UNITS: [(&str, [i32; 3]); 13] = [
    ("kg", [1, 0, 0]),
    ("m", [0, 1, 0]),
    ("m/s", [0, 1, -1]),
    ("m/s2", [0, 1, -2]),
    ("m2", [0, 2, 0]),
    ("m3", [0, 3, 0]),
    ("m2/s", [0, 2, -1]),
    ("1/s", [0, 0, -1]),
    ("N", [1, 1, -2]),
    ("N/m", [1, 0, -2]),
    ("N.s/m", [1, 0, -1]),
    ("Pa", [1, -1, -2]),
    ("m4.s/kg", [-1, 4, 1]),
];

/// The model description as text.
pub fn model_description(model: &Model) -> String {
    let all = quantities(model);
    let units = UNITS
        .iter()
        .filter(|(name, _)| all.iter().any(|(_, q)| q.unit == *name));
    let units = units.map(|(name, exponents)| unit(name, exponents));
    let units: String = units.collect();
    let variables = all.iter().enumerate();
    let variables = variables
        .map(|(reference, (causality, quantity))| variable(reference, causality, quantity));
    let variables: String = variables.collect();
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="{name}" guid="{guid}" description="{description}">
  <CoSimulation modelIdentifier="example_fmus" canHandleVariableCommunicationStepSize="true" canInterpolateInputs="true" maxOutputDerivativeOrder="2" canNotUseMemoryManagementFunctions="true" canGetAndSetFMUstate="true" canSerializeFMUstate="true" providesDirectionalDerivative="true"/>
  <UnitDefinitions>
{units}  </UnitDefinitions>
  <LogCategories>
    <Category name="logStatusError" description="Calls that were refused"/>
  </LogCategories>
  <DefaultExperiment startTime="0" stopTime="1" stepSize="0.01"/>
  <ModelVariables>
{variables}  </ModelVariables>
{structure}</fmiModelDescription>
"#,
        name = model.name,
        guid = model.guid(),
        description = model.description,
        structure = structure(model),
    )
}

/// Variables in the order of their value references.
fn quantities(model: &Model) -> Vec<(&'static str, &'static Quantity)> {
    let of = |causality, list: &'static [Quantity]| list.iter().map(move |q| (causality, q));
    let inputs = of("input", model.inputs);
    let outputs = of("output", model.outputs);
    let parameters = of("parameter", model.parameters);
    inputs.chain(outputs).chain(parameters).collect()
}

fn unit(name: &str, exponents: &[i32; 3]) -> String {
    let mut base = String::new();
    for (unit, exponent) in ["kg", "m", "s"].iter().zip(exponents) {
        if *exponent != 0 {
            write!(base, " {unit}=\"{exponent}\"").expect("writing to memory");
        }
    }
    format!("    <Unit name=\"{name}\"><BaseUnit{base}/></Unit>\n")
}

fn variable(reference: usize, causality: &str, quantity: &Quantity) -> String {
    let Quantity {
        name,
        unit,
        start,
        description,
    } = quantity;
    let kind = match causality {
        "parameter" => "variability=\"fixed\" initial=\"exact\"",
        "output" => "variability=\"continuous\" initial=\"calculated\"",
        _ => "variability=\"continuous\"",
    };
    let unit = match *unit {
        "" => String::new(),
        unit => format!(" unit=\"{unit}\""),
    };
    let start = match causality {
        "output" => String::new(),
        _ => format!(" start=\"{start:e}\""),
    };
    format!(
        "    <ScalarVariable name=\"{name}\" valueReference=\"{reference}\" \
         description=\"{description}\" causality=\"{causality}\" {kind}>\
         <Real{unit}{start}/></ScalarVariable>\n"
    )
}

/// Outputs with the inputs that they follow at once.
fn structure(model: &Model) -> String {
    let (mut outputs, mut initial) = (String::new(), String::new());
    for output in 0..model.outputs.len() {
        // The standard counts from 1 here.
        let index = model.inputs.len() + output + 1;
        let dependencies = model.dependencies(output);
        let dependencies: Vec<String> = dependencies.iter().map(|i| (i + 1).to_string()).collect();
        let dependencies = dependencies.join(" ");
        outputs += &format!("      <Unknown index=\"{index}\" dependencies=\"{dependencies}\"/>\n");
        initial += &format!("      <Unknown index=\"{index}\"/>\n");
    }
    format!(
        "  <ModelStructure>\n    <Outputs>\n{outputs}    </Outputs>\n    <InitialUnknowns>\n\
         {initial}    </InitialUnknowns>\n  </ModelStructure>\n"
    )
}
