//! Writing of XML, and what a model description says alike in FMI 2.0 and 3.0.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use super::logger::Category;
use crate::scene::Scene;
use crate::scene::number;
use crate::simulation::{Causality, Unit, Variable};

/// The tool that wrote a description.
pub const TOOL: &str = concat!("Flexbody ", env!("CARGO_PKG_VERSION"));

/// The terms of the library in every unit, and where it says more.
const LICENSE: &str = concat!(
    "library: ",
    env!("CARGO_PKG_LICENSE"),
    ", see documentation/licenses"
);

/// A document in the making.
pub type Xml = Writer<Vec<u8>>;

/// A document with the root that `root` writes.
pub fn document(root: impl FnOnce(&mut Xml) -> io::Result<()>) -> String {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    let declaration = Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None));
    let written = xml.write_event(declaration).and_then(|()| root(&mut xml));
    written.expect("writing into memory cannot fail");
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    String::from_utf8(bytes).expect("written from texts")
}

/// Attributes that tell whose model it is, and the license.
pub fn about(scene: &Scene) -> Vec<(&str, String)> {
    // What a model says of itself goes before what holds of every one.
    let own = scene.about.texts().map(|(key, text)| match key {
        "license" => (key, format!("{text}; {LICENSE}")),
        _ => (key, text.to_owned()),
    });
    let mut about: Vec<(&str, String)> = own.collect();
    if scene.about.license.is_none() {
        about.push(("license", LICENSE.into()));
    }
    about
}

/// Writes the units of all variables.
///
/// # Errors
/// Errors of `xml`.
pub fn units(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
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

/// Writes the categories of messages.
///
/// # Errors
/// Errors of `xml`.
pub fn log_categories(xml: &mut Xml) -> io::Result<()> {
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

/// Writes the experiment of a scene.
///
/// # Errors
/// Errors of `xml`.
pub fn default_experiment(xml: &mut Xml, scene: &Scene) -> io::Result<()> {
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

/// Causality, variability and initial of a variable.
pub fn kind(variable: &Variable) -> (&'static str, &'static str, Option<&'static str>) {
    match Causality::of(variable) {
        Causality::Independent => ("independent", "continuous", None),
        Causality::Parameter => ("parameter", "fixed", Some("exact")),
        Causality::Input => ("input", "continuous", None),
        Causality::Output => ("output", "continuous", Some("calculated")),
        Causality::CalculatedParameter => ("calculatedParameter", "fixed", Some("calculated")),
    }
}
