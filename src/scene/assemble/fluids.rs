//! Fluids along bodies, and the mass that moves along with these.

use super::{Builder, loads::uniform};
use crate::bodies::{LoadedLine, PANELS};
use crate::math::quadrature::GAUSS_5;
use crate::math::space::vector;
use crate::scene::Error;
use crate::scene::description::SectionNumbers;
use crate::scene::resolved::{Cable, Form, LoadKind, Resolved, ResolvedFluid};
use crate::system::loads::{self, AppliedLoad, FluidSegment};

impl Resolved<'_> {
    /// Mass of all fluids that move along with a body at a section, kg/m.
    pub(super) fn added_mass(&self, body: usize, section: &SectionNumbers) -> f64 {
        let loads = self.loads.iter();
        let added = loads.filter_map(|load| match &load.kind {
            LoadKind::Fluid(fluid) if fluid.on.id.body_index() == body => {
                Some(fluid.added(section))
            }
            _ => None,
        });
        added.sum()
    }
}

impl ResolvedFluid<'_> {
    fn strip(&self, section: &SectionNumbers) -> FluidSegment {
        let [across, along] = self.drag;
        let faced = 0.5 * self.density * self.diameter(section);
        let displaced = self.displaced(section);
        FluidSegment {
            drag: [faced * across, faced * std::f64::consts::PI * along],
            buoyant: if self.buoyancy { displaced } else { 0.0 },
            inert: displaced + self.added(section),
        }
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
            Form::Rod(_) => Ok((0..=PANELS).map(|k| k as f64 / PANELS as f64).collect()),
        }
    }

    pub(super) fn line(&self, cable: Cable<'_>) -> LoadedLine {
        match cable.id.form {
            Form::Chain(chain) => LoadedLine::Chain(chain),
            Form::Rod(rod) => LoadedLine::Rod(self.parts.bodies.rods()[rod]),
        }
    }

    /// Builds the load of a fluid.
    ///
    /// # Errors
    /// A mesh that is not possible, or an expression of the current that has no value at a Gauss point.
    pub(super) fn fluid(
        &self,
        fluid: &ResolvedFluid<'_>,
        path: &str,
    ) -> Result<AppliedLoad<D>, Error> {
        let cable = fluid.on;
        let mut strips = Vec::new();
        for ends in self.segments(cable)?.windows(2) {
            let sections = cable.body.sections_about(0.5 * (ends[0] + ends[1]));
            for point in GAUSS_5 {
                let section = match cable.id.form {
                    Form::Chain(_) => sections(ends[0] + point.at * (ends[1] - ends[0])).0,
                    // All along it that of its middle, as its mass.
                    Form::Rod(_) => cable.body.section_at(0.5),
                };
                strips.push(fluid.strip(&section));
            }
        }
        let mut current = uniform(&fluid.current);
        let path = format!("{path}.current");
        self.fill(cable, &fluid.along, &path, &mut current.along)?;
        Ok(AppliedLoad::Fluid(Box::new(loads::Fluid {
            on: self.line(cable),
            strips,
            current,
            gravity: vector(self.resolved.scene.gravity.full()),
            carried: (vector([0.0; 3]), [0.0; 3]),
            fraction: 1.0,
        })))
    }
}
