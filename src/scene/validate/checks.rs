//! Checks of single values, and how what is wrong with them is told.

use std::collections::BTreeSet;
use std::fmt::Display;

use crate::math::function::Function;
use crate::scene::Error;
use crate::scene::alike::{did_you_mean, listed};
use crate::scene::description::{SceneVector, Spin, Value};
use crate::scene::marker::GROUND;
use crate::scene::unit::Unit;

/// Words that begin variable names of the scene itself, or stand for something else.
const RESERVED: [&str; 13] = [
    GROUND,
    "gravity",
    "rotation",
    "energy",
    "momentum",
    "angular_momentum",
    "center_of_mass",
    "residual",
    "natural_frequency",
    "eigenvalue",
    "time",
    "relative_tolerance",
    "work_limit",
];

/// Longest text about a scene.
const MOST_IN_SENTENCE: usize = 1000;
/// Longest name of a scene or a part.
const MOST_LETTERS: usize = 100;

/// An error about the value at `path`.
pub fn expected(path: &str, wanted: &str, found: impl Display) -> Error {
    Error::new(path, format!("expected {wanted}, found {found}"))
}

/// A text between quotation marks, cut off where it is longer than two names.
pub fn quoted(text: &str) -> String {
    let mut letters = text.chars();
    let shown: String = letters.by_ref().take(2 * MOST_LETTERS + 1).collect();
    let more = if letters.next().is_some() { "..." } else { "" };
    format!("\"{shown}{more}\"")
}

/// An error about a name that nothing of a kind bears: what there is where that is short, and what was meant.
pub fn unknown<'a>(
    path: &str,
    what: &str,
    name: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Error {
    let known: Vec<&str> = known.into_iter().collect();
    let wanted = format!("{what}{}", listed(&known));
    let meant = did_you_mean(name, known);
    expected(path, &wanted, quoted(name) + &meant)
}

/// Returns the value of a key that its kind demands.
///
/// # Errors
/// The key is missing.
pub fn needed<T>(path: &str, key: &str, what: &str, value: Option<T>) -> Result<T, Error> {
    value.ok_or_else(|| expected(&format!("{path}.{key}"), what, "nothing"))
}

/// Checks that a number is finite.
///
/// # Errors
/// Infinity or NaN.
pub fn finite(path: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() {
        return Ok(());
    }
    Err(expected(path, "a finite number", value))
}

/// Returns the notation of a vector of this dimension, for messages.
pub fn shape(dimension: usize) -> &'static str {
    match dimension {
        2 => "[x, y]",
        _ => "[x, y, z]",
    }
}

/// Checks that there are as many components as dimensions, and that they are finite.
///
/// # Errors
/// Another number of components, or one that is not finite.
pub fn vector(path: &str, dimension: usize, value: &SceneVector) -> Result<(), Error> {
    let count = value.given().len();
    if count != dimension && count > 0 {
        let wanted = format!("{dimension} components {}", shape(dimension));
        return Err(expected(path, &wanted, count));
    }
    let mut components = value.given().iter().enumerate();
    match components.find(|(_, component)| !component.is_finite()) {
        Some((k, component)) => finite(&format!("{path}[{k}]"), *component),
        None => Ok(()),
    }
}

/// Checks that a direction has as many components as the scene has dimensions, and is not zero.
///
/// # Errors
/// Another number of components, one that is not finite, or a vector of length 0.
pub fn direction(path: &str, dimension: usize, value: &SceneVector) -> Result<(), Error> {
    vector(path, dimension, value)?;
    if value.full() != [0.0; 3] {
        return Ok(());
    }
    let found = format!("{:?}", value.given());
    Err(expected(path, "a direction that is not zero", found))
}

/// Reads the components of a force or a position with `of`, as many as dimensions.
///
/// # Errors
/// Another number of components, or one that `of` refuses.
pub fn components<T, U>(
    path: &str,
    dimension: usize,
    given: &[T],
    mut of: impl FnMut(&str, &T) -> Result<U, Error>,
) -> Result<Vec<U>, Error> {
    if given.len() != dimension {
        let wanted = format!("{dimension} values {}", shape(dimension));
        return Err(expected(path, &wanted, given.len()));
    }
    let places = given.iter().enumerate();
    places
        .map(|(k, given)| of(&format!("{path}[{k}]"), given))
        .collect()
}

/// Refuses a feature of planar scenes in space. `instead` names the replacement there.
///
/// # Errors
/// The scene is in space.
pub fn planar(path: &str, dimension: usize, instead: &str, found: &str) -> Result<(), Error> {
    if dimension == 2 {
        return Ok(());
    }
    Err(expected(path, &format!("{instead} in space"), found))
}

/// Checks an angular velocity: a number in the plane, a vector in space.
///
/// # Errors
/// A number in space, a vector in the plane, or a component that is not finite.
pub fn spin(path: &str, dimension: usize, value: &Spin) -> Result<(), Error> {
    match (value, dimension) {
        (Spin::Number(rate), 2) => finite(path, *rate),
        (Spin::Vector(rates), 3) => vector(path, dimension, &(*rates).into()),
        // What a scene that is changed by hand leaves out.
        (Spin::Number(0.0), _) => Ok(()),
        (Spin::Number(rate), _) => Err(expected(path, "[x, y, z] in space", rate)),
        (Spin::Vector(_), _) => Err(expected(path, "a number in the plane", "a list")),
    }
}

/// Checks that a quantity is positive.
///
/// # Errors
/// A number that is not positive and finite.
pub fn positive(path: &str, unit: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    let wanted = format!("a positive number ({unit})");
    Err(expected(path, &wanted, value))
}

/// Checks that a quantity is not negative.
///
/// # Errors
/// A number that is negative or not finite.
pub fn not_negative(path: &str, unit: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() && value >= 0.0 {
        return Ok(());
    }
    let wanted = format!("zero or a positive number ({unit})");
    Err(expected(path, &wanted, value))
}

/// Checks that a quantity is finite and not zero.
///
/// # Errors
/// A number that is zero or not finite.
pub fn not_zero(path: &str, unit: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() && value != 0.0 {
        return Ok(());
    }
    let wanted = format!("a number that is not zero ({unit})");
    Err(expected(path, &wanted, value))
}

/// Reads stiffness and damping of a spring and a damper in parallel, with the units of both. A missing one is 0.
///
/// # Errors
/// Both are missing, or one is negative or not finite.
pub fn spring_damper(
    path: &str,
    stiffness: Option<f64>,
    damping: Option<f64>,
    units: [Unit; 2],
) -> Result<[f64; 2], Error> {
    if stiffness.is_none() && damping.is_none() {
        return Err(expected(path, "a stiffness or a damping", "neither"));
    }
    let values = [("stiffness", stiffness), ("damping", damping)];
    for ((key, value), unit) in values.into_iter().zip(units) {
        if let Some(value) = value {
            not_negative(&format!("{path}.{key}"), &unit.text(), value)?;
        }
    }
    Ok([stiffness, damping].map(Option::unwrap_or_default))
}

/// Builds the function of time of a value. Tables of motions become splines.
///
/// # Errors
/// A number that is not finite, an expression that is not valid, or a table through which no curve goes.
pub fn value(path: &str, value: &Value, of_motion: bool) -> Result<Function, Error> {
    let (place, built) = match value {
        Value::Number(number) => {
            finite(path, *number)?;
            return Ok(Function::constant(*number));
        }
        Value::Expression(_) => (path.to_owned(), value.function()),
        Value::Table(_) if of_motion => (format!("{path}.table"), value.motion_function()),
        Value::Table(_) => (format!("{path}.table"), value.function()),
    };
    built.map_err(|message| Error::new(place, message))
}

/// Refuses a name that no table, page or file name has room for.
fn bounded(path: &str, name: &str) -> Result<(), Error> {
    if name.len() <= MOST_LETTERS {
        return Ok(());
    }
    let wanted = format!("at most {MOST_LETTERS} characters");
    let found = format!("{} bytes", name.len());
    // Where a place is a name itself, its beginning tells it.
    let place: String = path.chars().take(2 * MOST_LETTERS).collect();
    Err(expected(&place, &wanted, found))
}

/// Checks the name of a scene, which is also that of the FMU.
///
/// # Errors
/// A name that is empty, too long, or has other characters than letters, digits, `_` and `-`.
pub fn scene_name(name: &str) -> Result<(), Error> {
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    bounded("name", name)?;
    if !name.is_empty() && name.chars().all(allowed) {
        return Ok(());
    }
    Err(expected("name", "letters, digits, _ and -", quoted(name)))
}

/// Checks a text that goes into the model description, where XML has no room for control characters.
///
/// # Errors
/// A text that is empty, too long, or has control characters.
pub fn sentence(path: &str, text: &str) -> Result<(), Error> {
    let is_written = |c: char| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}');
    let length = text.chars().count();
    if text.trim().is_empty() || length > MOST_IN_SENTENCE {
        let wanted = format!("a text of 1 to {MOST_IN_SENTENCE} characters");
        return Err(expected(path, &wanted, length));
    }
    match text.chars().find(|c| !is_written(*c)) {
        Some(c) => Err(expected(path, "a text in one line", format!("{c:?}"))),
        None => Ok(()),
    }
}

/// Checks the name of a part, and that it is new among `names`.
///
/// # Errors
/// A name that is no identifier, too long, reserved, or used twice.
pub fn name<'a>(path: &str, name: &'a str, names: &mut BTreeSet<&'a str>) -> Result<(), Error> {
    bounded(path, name)?;
    let starts = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    if !starts || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        let wanted = "a letter or _, then letters, digits and _";
        return Err(expected(path, wanted, quoted(name)));
    }
    if RESERVED.contains(&name) || !names.insert(name) {
        return Err(expected(path, "a name not used yet", quoted(name)));
    }
    Ok(())
}

/// Lists names in a sentence: `a, b or c`.
pub fn or(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [name] => (*name).into(),
        [names @ .., last] => format!("{} or {last}", names.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use crate::scene::Scene;

    fn bead() -> Value {
        json!({"name": "scene", "dimension": 2,
            "bodies": [{"name": "bead", "element": "rigid", "mass": 1, "inertia": 1, "position": [0, 0],
                "markers": {"eye": [0, 0]}}],
            "outputs": [{"kind": "position", "marker": "bead.eye"}]})
    }

    fn refusal(scene: &Value) -> String {
        let error = Scene::from_json(&scene.to_string()).expect_err("a refusal");
        error.to_string()
    }

    #[test]
    fn names_have_a_greatest_length() {
        let (long, too_long) = ("n".repeat(100), "n".repeat(100_000));
        let mut scene = bead();
        scene["name"] = json!(long);
        scene["bodies"][0]["markers"][&long] = json!([0, 1]);
        Scene::from_json(&scene.to_string()).expect("names of 100 letters");
        let end = "expected at most 100 characters, found 100000 bytes";
        for place in ["/name", "/bodies/0/name"] {
            let mut scene = bead();
            *scene.pointer_mut(place).expect(place) = json!(too_long);
            assert!(refusal(&scene).ends_with(end), "{place}");
        }
        let mut scene = bead();
        scene["bodies"][0]["markers"][&too_long] = json!([0, 1]);
        let message = refusal(&scene);
        assert!(message.ends_with(end) && message.len() < 1000);
        // What names nothing is told by its beginning.
        let mut scene = bead();
        scene["outputs"][0]["marker"] = json!(too_long);
        assert!(refusal(&scene).len() < 1000);
    }

    #[test]
    fn what_a_model_says_of_itself_is_one_line_of_text() {
        let mut scene = bead();
        scene["about"] =
            json!({"author": "Ada <ada@example.org> & Söhne", "license": "x".repeat(1000)});
        let read = Scene::from_json(&scene.to_string()).expect("texts");
        assert_eq!(Scene::from_json(&read.to_json()).as_ref(), Ok(&read));
        let long = "x".repeat(1001);
        for (key, text, found) in [
            (
                "author",
                "",
                "expected a text of 1 to 1000 characters, found 0",
            ),
            (
                "license",
                &*long,
                "expected a text of 1 to 1000 characters, found 1001",
            ),
            (
                "version",
                "1\n2",
                "expected a text in one line, found '\\n'",
            ),
            (
                "copyright",
                "a\u{1}",
                "expected a text in one line, found '\\u{1}'",
            ),
        ] {
            let mut scene = bead();
            scene["about"] = json!({ key: text });
            assert_eq!(refusal(&scene), format!("about.{key}: {found}"));
        }
    }
}
