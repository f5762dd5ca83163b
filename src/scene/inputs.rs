//! Order of the numbers that the master sets: those of the inputs, then those of driven motions, then
//! those of ports.

use super::{Motion, MotionKind, MotionValue, Port, Scene};

/// Where inputs and motions find their numbers among all inputs of a system.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct InputLayout {
    /// Index of the first component of every input of the scene; the others follow it.
    pub of_inputs: Vec<usize>,
    /// Index of the first number of every motion that has an input, in the order of the motions. The
    /// numbers of a driven coordinate follow each other: its value, then as many derivatives as are
    /// inputs; then those of the next coordinate of the same motion.
    pub of_motions: Vec<usize>,
    /// Index of the first number of every port: those of its loads, then those of its motions.
    pub of_ports: Vec<usize>,
    /// How many numbers there are.
    pub total: usize,
}

impl Scene {
    /// Order of the numbers that the master sets.
    pub fn input_layout(&self) -> InputLayout {
        let mut total = 0;
        let mut place = |count: usize| {
            let first = total;
            total += count;
            first
        };
        let of_inputs = self.inputs.iter().map(|input| place(input.components()));
        let of_inputs = of_inputs.collect();
        let driven = self.motions.iter().filter_map(Motion::input_count);
        let of_motions = driven.map(&mut place).collect();
        let of_ports = self
            .ports
            .iter()
            .map(Port::input_count)
            .map(place)
            .collect();
        InputLayout {
            of_inputs,
            of_motions,
            of_ports,
            total,
        }
    }
}

impl Motion {
    /// Number of coordinates that the motion drives.
    pub fn coordinates(&self) -> usize {
        match self.kind {
            MotionKind::Position => 2,
            MotionKind::Angle | MotionKind::Displacement => 1,
        }
    }

    /// Derivatives that the master sets beside the value of every driven coordinate, if the motion is
    /// an input.
    pub fn input_derivatives(&self) -> Option<usize> {
        match &self.value {
            MotionValue::Input(input) => Some(usize::from(input.input)),
            MotionValue::One(_) | MotionValue::Two(_) => None,
        }
    }

    /// How many numbers the master sets for the motion, if it is an input.
    pub fn input_count(&self) -> Option<usize> {
        let derivatives = self.input_derivatives()?;
        Some(self.coordinates() * (1 + derivatives))
    }
}
