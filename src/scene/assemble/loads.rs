//! Loads: what acts on markers, in joints and along bodies, springs, and what the master sets.

use super::{Builder, each};
use crate::bodies::RodChain;
use crate::math::function::Function;
use crate::math::quadrature::GAUSS_5;
use crate::scene::Error;
use crate::scene::resolved::{Action, Cable, InputKind, LoadKind, LoadTarget, ResolvedSpring};
use crate::system::Signal;
use crate::system::loads::{self, AppliedLoad, DistributedMoment, LineLoad};

impl<const D: usize> Builder<'_, D> {
    /// Builds all loads and those of the initial state.
    ///
    /// # Errors
    /// A mesh that is not possible, or an expression that has no value at a Gauss point.
    pub(super) fn loads(&mut self) -> Result<(), Error> {
        for (index, load) in self.resolved.loads.iter().enumerate() {
            let built = match &load.kind {
                LoadKind::Action { action, .. } => {
                    self.action_along(action, &format!("loads[{index}]"))?
                }
                LoadKind::Spring(spring) => self.spring(spring),
                LoadKind::TableSpring(of) => AppliedLoad::TableSpring(loads::TableSpring {
                    ends: self.ends(of.ends),
                    spring: of.spring.clone(),
                    damper: of.damper.clone(),
                }),
                LoadKind::JointSpring { on, sizes, rest } => {
                    let coordinate = self.coordinate(on);
                    self.joint_spring(coordinate, *sizes, *rest)
                }
                LoadKind::JointLimit { on, sizes, limits } => self.stop(on, *sizes, *limits),
                LoadKind::Bushing(bushing) => self.bushing(bushing),
                LoadKind::Fluid(fluid) => self.fluid(fluid, &format!("loads[{index}]"))?,
                LoadKind::Contact(contact) => self.contact(contact),
            };
            self.parts.loads.push(built);
        }
        for (index, load) in self.resolved.initial_loads.iter().enumerate() {
            if let LoadKind::Action { action, .. } = &load.kind {
                let built = self.action_along(action, &format!("initial.loads[{index}]"))?;
                self.parts.initial_loads.push(built);
            }
        }
        Ok(())
    }

    fn spring(&self, spring: &ResolvedSpring<'_>) -> AppliedLoad<D> {
        let ends = self.ends(spring.ends);
        let now = || Signal::Function(Function::Constant(self.distance_at_start(&ends)));
        AppliedLoad::Spring(loads::Spring {
            ends,
            stiffness: spring.stiffness,
            damping: spring.damping,
            length: spring.length.clone().unwrap_or_else(now),
        })
    }

    fn action(&self, action: &Action<'_>) -> AppliedLoad<D> {
        let components = &action.components;
        let moment = |ends| {
            AppliedLoad::Moment(loads::Moment {
                ends,
                size: components[0].clone(),
            })
        };
        match action.on {
            LoadTarget::Marker(marker) if action.kind.is_force() => {
                AppliedLoad::Force(loads::Force {
                    marker: self.marker(marker),
                    follower: action.follower,
                    components: each(components),
                    axes: self.frame_axes(marker),
                })
            }
            LoadTarget::Marker(marker) if D == 3 => self.moment_on(marker, action),
            LoadTarget::Joint(pivot) if D == 3 => self.torque(pivot, action),
            LoadTarget::Marker(marker) => moment(self.on_marker(marker)),
            LoadTarget::Joint(pivot) => moment(self.ends(pivot.ends)),
            LoadTarget::Cable(cable) if !action.kind.is_force() => self.moment_along(cable, action),
            LoadTarget::Cable(cable) => AppliedLoad::DistributedForce(loads::DistributedForce {
                on: self.line(cable),
                density: uniform(components),
            }),
        }
    }

    /// A moment along a rod or beam.
    fn moment_along(&self, cable: Cable<'_>, action: &Action<'_>) -> AppliedLoad<D> {
        let end = self.along(cable, 0.0);
        let first = |chain: &RodChain| chain.frames().next();
        let mut firsts = self.parts.bodies.all_sections().iter().filter_map(first);
        let on = firsts.position(|(frame, line)| [frame, line].contains(&end.nodes[0]));
        AppliedLoad::DistributedMoment(Box::new(DistributedMoment {
            on: on.expect("a body with sections is among the rods"),
            end,
            follower: action.follower,
            density: match D {
                2 => {
                    let none = || Signal::Function(Function::Constant(0.0));
                    uniform(&[none(), none(), action.components[0].clone()])
                }
                _ => uniform(&action.components),
            },
        }))
    }

    /// Builds a force or a moment with the components that vary along a body. These are parsed for every Gauss point.
    fn action_along(&self, action: &Action<'_>, path: &str) -> Result<AppliedLoad<D>, Error> {
        let mut load = self.action(action);
        if let LoadTarget::Cable(cable) = action.on {
            let (along, path) = (&action.along[..], format!("{path}.value"));
            match &mut load {
                AppliedLoad::DistributedForce(on) => {
                    self.fill(cable, along, &path, &mut on.density.along)?;
                }
                AppliedLoad::DistributedMoment(on) => {
                    // In the plane the third alone.
                    let first = if D == 2 { 2 } else { 0 };
                    self.fill(cable, along, &path, &mut on.density.along[first..])?;
                }
                _ => {}
            }
        }
        Ok(load)
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
                    let function = Function::along(text, s);
                    let function =
                        function.map_err(|told| Error::new(format!("{path}[{k}]"), told))?;
                    along[*k].push(Signal::Function(function));
                }
            }
        }
        Ok(())
    }

    pub(super) fn inputs(&mut self) {
        for input in &self.resolved.inputs {
            self.input(&input.kind);
        }
    }

    /// A load whose size is an input; a spring whose length is one has been built.
    pub(super) fn input(&mut self, input: &InputKind<'_>) {
        if let InputKind::Action(action) = input {
            let built = self.action(action);
            self.parts.loads.push(built);
        }
    }
}

/// Builds a line load that is uniform along a body.
pub(super) fn uniform<const K: usize>(components: &[Signal]) -> LineLoad<K> {
    LineLoad {
        uniform: each(components),
        along: std::array::from_fn(|_| Vec::new()),
    }
}
