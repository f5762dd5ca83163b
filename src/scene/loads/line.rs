//! What acts along a line body: components that vary along it, at the Gauss points of its segments.

use crate::bodies::{LoadedLine, PANELS};
use crate::math::expression::Expression;
use crate::math::function::Function;
use crate::math::quadrature::GAUSS_5;
use crate::scene::Error;
use crate::scene::assemble::{Builder, each};
use crate::scene::description::Value;
use crate::scene::resolved::{Cable, Form};
use crate::scene::validate::checks::value;
use crate::system::Signal;
use crate::system::loads::LineLoad;

/// Builds a component of a load as a function of time. Components may change with coordinates of a body, and are built by
/// [`function_all_over`] then.
///
/// # Errors
/// A number, an expression or a table that is not valid.
pub(super) fn component(
    path: &str,
    of: &Value,
    coordinates: &[&'static str],
) -> Result<Signal, Error> {
    let function = match of {
        Value::Expression(text) if !coordinates.is_empty() => {
            function_all_over(path, text, coordinates)
        }
        _ => value(path, of, false),
    };
    function.map(Signal::Function)
}

/// The function of time that a component is all over a body; zero of one that changes with its coordinates.
fn function_all_over(
    path: &str,
    text: &str,
    coordinates: &[&'static str],
) -> Result<Function, Error> {
    if Function::varies(text, coordinates) {
        return Ok(Function::constant(0.0));
    }
    // Where it is neither, the coordinates of the body are known too.
    let middle: Vec<_> = coordinates.iter().map(|name| (*name, 0.5)).collect();
    let function = match Expression::at(text, &middle) {
        Ok(_) => Function::expression(text),
        Err(told) => Err(told),
    };
    function.map_err(|told| Error::new(path, told))
}

/// Components that change along a body, by their places among all, and their expressions.
pub(super) fn varying(values: &[Value]) -> Vec<(usize, &str)> {
    let values = values.iter().enumerate();
    let varying = values.filter_map(|(k, of)| Some((k, of.varying()?.0)));
    varying.collect()
}

/// Why nothing acts along a body that is reduced to modes.
pub(super) const NOT_ALONG_MODES: &str =
    "what acts along a body that is reduced to modes is refused";

/// Builds a line load that is uniform along a body.
pub(super) fn uniform<const K: usize>(components: &[Signal]) -> LineLoad<K> {
    LineLoad {
        uniform: each(components),
        along: std::array::from_fn(|_| Vec::new()),
    }
}

impl<const D: usize> Builder<'_, D> {
    /// Returns the material coordinates that bound the segments along which loads are integrated: the nodes of a
    /// flexible body, the ends of equal parts of a rigid one.
    ///
    /// # Errors
    /// A mesh that is not possible.
    pub(super) fn segments(&self, cable: Cable<'_>) -> Result<Vec<f64>, Error> {
        match cable.id.form {
            Form::Chain(_) => self.resolved.nodes(cable),
            Form::Rod(_) | Form::Modal => {
                Ok((0..=PANELS).map(|k| k as f64 / PANELS as f64).collect())
            }
        }
    }

    /// The line in the system.
    pub(super) fn line(&self, cable: Cable<'_>) -> LoadedLine {
        match cable.id.form {
            Form::Chain(chain) => LoadedLine::Chain(chain),
            Form::Rod(rod) => LoadedLine::Rod(self.parts.bodies.rods()[rod]),
            Form::Modal => unreachable!("{NOT_ALONG_MODES}"),
        }
    }

    /// Index of the rod or beam among those with sections. `None` for a cable and a rigid body.
    pub(super) fn sections_of(&self, cable: Cable<'_>) -> Option<usize> {
        let Form::Chain(chain) = cable.id.form else {
            return None;
        };
        let first = self.parts.bodies.lines()[chain].first_node();
        let mut rods = self.parts.bodies.all_sections().iter();
        rods.position(|rod| rod.line() == first)
    }

    /// Evaluates the components that vary along a body at the Gauss points of its segments.
    ///
    /// # Errors
    /// A mesh that is not possible, or an expression that has no value at a Gauss point.
    pub(super) fn fill(
        &self,
        cable: Cable<'_>,
        given: &[(usize, &str)],
        path: &str,
        along: &mut [Vec<Signal>],
    ) -> Result<(), Error> {
        if given.is_empty() {
            return Ok(());
        }
        let mesh = self.segments(cable)?;
        for (k, text) in given {
            for ends in mesh.windows(2) {
                for point in GAUSS_5 {
                    let s = ends[0] + point.at * (ends[1] - ends[0]);
                    let function = Function::at(text, &[("s", s)]);
                    let function =
                        function.map_err(|told| Error::new(format!("{path}[{k}]"), told))?;
                    along[*k].push(Signal::Function(function));
                }
            }
        }
        Ok(())
    }
}
