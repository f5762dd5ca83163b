//! Errors that explicit methods make when they integrate a function of time: a driven coordinate or a load that changes
//! faster than the scene moves. Their embedded formulas compare accelerations of one step, and hardly see it.

use super::dynamics::Model;
use crate::math::function::Function;
use crate::math::quadrature::GAUSS_3;
use crate::system::System;
use crate::system::joints::{JointKind, Target};
use crate::system::loads::Load;
use crate::system::signal::{Drive, Signal};

/// What is integrated of a driven angle and of any other driven coordinate: the second derivatives of these.
const OF_ANGLE: &[Target] = &[Target::Value(0, 0.0), Target::Cosine(0), Target::Sine(0)];
const OF_COORDINATE: &[Target] = &[Target::Value(0, 0.0)];

/// Relative error below which a sum differs by roundoff.
const ROUNDOFF: f64 = 16.0 * f64::EPSILON;

/// An expression of time in a system.
#[derive(Clone, Copy, Debug)]
pub(in crate::system) struct Source {
    what: What,
    /// Its natural size, in powers of the mass (kg) and the size (m) of the system, and of the rate at which
    /// it moves (1/s).
    powers: [i32; 3],
}

#[derive(Clone, Copy, Debug)]
enum What {
    /// A driven coordinate, by its index.
    Drive(usize),
    /// A size of a load, by their indices.
    Load(usize, usize),
}

impl Source {
    /// Those of a system. Tables are smooth between their points.
    pub(in crate::system) fn all(system: &System) -> Vec<Self> {
        let drives = system.drives.iter().enumerate();
        let drives = drives.filter_map(|(index, drive)| match drive {
            Drive::Function(Function::Expression(_)) => {
                let length = i32::from(!system.turns(index));
                let powers = [0, length, 2];
                Some(Self {
                    what: What::Drive(index),
                    powers,
                })
            }
            _ => None,
        });
        let loads = system.loads.iter().enumerate().flat_map(|(index, load)| {
            let signals = load.signals().into_iter().zip(powers(load)).enumerate();
            signals.filter_map(move |(signal, (of, powers))| match of {
                Some(Signal::Function(Function::Expression(_))) => Some(Self {
                    what: What::Load(index, signal),
                    powers,
                }),
                _ => None,
            })
        });
        drives.chain(loads).collect()
    }
}

/// Powers of mass, size and rate in the natural sizes of what changes in a load.
fn powers(load: &Load) -> [[i32; 3]; 4] {
    match load {
        Load::Force(_) => [[1, 1, 2]; 4],
        Load::Moment(_) => [[1, 2, 2]; 4],
        Load::Distributed(_) => [[1, 0, 2]; 4],
        Load::Spring(_) | Load::Rotational(_) => [[0, 1, 0]; 4],
        Load::Coupling(_) => [[0, 1, 0], [0, 1, 0], [0, 1, 1], [0, 1, 1]],
        Load::Turning(_) => [[0, 0, 0], [0, 0, 1], [0, 0, 0], [0, 0, 0]],
    }
}

impl System {
    /// Whether a driven coordinate is an angle.
    fn turns(&self, drive: usize) -> bool {
        let joint = self
            .driven_joint(drive)
            .map(|joint| &self.joints[joint].kind);
        matches!(joint, Some(JointKind::DrivenAngle(_)))
    }
}

impl Model<'_> {
    /// How far a rule is off over a step, against Gauss's of order 6: the largest error of any expression of time over
    /// its size there, or over its natural size if that is more. What is small beside the scene must not
    /// stop it, and may be nothing but roundoff.
    pub(in crate::system) fn missed(
        &self,
        [time, h]: [f64; 2],
        rule: [&[f64]; 2],
        natural: f64,
    ) -> f64 {
        let system = self.system;
        let scales = [system.mass, system.size, 1.0 / natural];
        let at = |part: f64| system.clock(time + part * h, self.work);
        let errors = system.sources.iter().map(|source| {
            let pairs = scales.iter().zip(source.powers);
            let least: f64 = pairs.map(|(scale, power)| scale.powi(power)).product();
            match source.what {
                What::Load(index, signal) => match system.loads[index].signals()[signal] {
                    Some(Signal::Function(f)) => relative(rule, least, |part| f.value(at(part))),
                    _ => 0.0,
                },
                What::Drive(index) => match &system.drives[index] {
                    Drive::Function(f) => {
                        let angle = source.powers[1] == 0;
                        let targets = if angle { OF_ANGLE } else { OF_COORDINATE };
                        let of = |target: &Target| {
                            let second = |part| target.derivatives(&[f.derivatives(at(part))])[2];
                            relative(rule, least, second)
                        };
                        targets.iter().map(of).fold(0.0, f64::max)
                    }
                    Drive::Input { .. } => 0.0,
                },
            }
        });
        errors.fold(0.0, f64::max)
    }
}

/// Error of a quadrature rule over the unit interval, over the largest value that it takes or `least`.
fn relative([nodes, weights]: [&[f64]; 2], least: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut sum, mut largest) = (0.0, least);
    for (node, weight) in nodes.iter().zip(weights) {
        let value = f(*node);
        sum += weight * value;
        largest = largest.max(value.abs());
    }
    for point in GAUSS_3 {
        let value = f(point.at);
        sum -= point.weight * value;
        largest = largest.max(value.abs());
    }
    // Differences of roundoff are no error.
    (sum.abs() / largest - ROUNDOFF).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIMPSON: [&[f64]; 2] = [&[0.0, 0.5, 1.0], &[1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0]];

    #[test]
    fn errors_are_those_of_the_rule() {
        // Over the unit interval the rule is off by the fourth derivative over 2880.
        let error = |f: fn(f64) -> f64| relative(SIMPSON, 0.0, f);
        assert!((error(|t| t.powi(4)) - 24.0 / 2880.0).abs() < 1e-14);
        assert_eq!(error(|t| 1.0 + t * t * t), 0.0);
        let small = relative(SIMPSON, 1e3, |t| 1e-3 * t.powi(4));
        assert!(
            small < 1e-8,
            "what is small beside the scene counts little: {small}"
        );
    }
}
