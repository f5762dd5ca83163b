//! Derivatives in time of the accelerations of axes, from those of angular accelerations.

use nalgebra::Vector3;

use super::{Axes, axis_rates, set_axes_at};
use crate::bodies::Bodies;
use crate::bodies::connectivity::Node;
use crate::math::jet::{Jet, part, set_part};

/// Angular accelerations of rigid bodies and sections with their derivatives.
#[derive(Clone, Debug)]
pub struct AngularAccelerations {
    /// Of rigid bodies along their axes, `[rigid bodies]`, rad/s^2.
    rigid: Vec<Vector3<Jet>>,
    /// Of sections: about the tangents of rods, along the section axes of beams, `[sections]`, rad/s^2.
    sections: Vec<[Jet; 3]>,
    /// Of what reduced bodies count, spins and rates of amplitudes, body by body, `[3 + n]`.
    reduced: Vec<Vec<Jet>>,
}

/// Accelerations of all nodes with derivatives, and what they are made of.
pub struct AxisMotion<'a, const D: usize> {
    /// Nodal coordinates, `[nodes]`.
    pub x: &'a [Node<D, Jet>],
    /// Part of nodal accelerations that follows from positions and rates alone, `[nodes]`.
    pub bias: &'a [Node<D, Jet>],
    /// Nodal accelerations, `[nodes]`.
    pub acceleration: &'a mut [Node<D, Jet>],
}

impl AngularAccelerations {
    /// Zero.
    pub fn of<const D: usize>(bodies: &Bodies<D>) -> Self {
        let zero = Jet::from_re(0.0);
        Self {
            rigid: vec![Vector3::from_element(zero); bodies.rigid.len()],
            sections: vec![[zero; 3]; bodies.moments()],
            reduced: (bodies.reduced.iter().map(|body| vec![zero; body.count()])).collect(),
        }
    }
}

/// Derivative `k` of the accelerations `sum` of axes.
fn add_parts(k: usize, sum: &mut Axes<Jet>, by_rate: &Axes<Jet>, by_spin: &Axes<Jet>) {
    for (axis, sum) in sum.iter_mut().enumerate() {
        for (i, sum) in sum.iter_mut().enumerate() {
            let [a, b] = [by_rate[axis][i], by_spin[axis][i]].map(|of| part(of, k));
            set_part(sum, k, a + b);
        }
    }
}

impl<const D: usize> Bodies<D> {
    /// Sets the values of angular accelerations, which stand in the places of rotations in `found`.
    pub fn set_angular_accelerations(&self, found: &[Node<D>], to: &mut AngularAccelerations) {
        for (frame, rate) in self.rigid.iter().zip(&mut to.rigid) {
            for (rate, value) in rate.iter_mut().zip(&found[frame.node][1]) {
                rate.re = *value;
            }
        }
        for (body, rates) in self.reduced.iter().zip(&mut to.reduced) {
            for (rate, value) in rates.iter_mut().zip(body.counted(found)) {
                rate.re = *value;
            }
        }
        for (frame, rate) in self.section_frames().zip(&mut to.sections) {
            for (rate, value) in rate.iter_mut().zip(&found[frame.node][1]) {
                rate.re = *value;
            }
        }
    }

    /// Derivative `k` of the accelerations of axes, from that of angular accelerations, which stand in the places of rotations in `found`.
    pub fn differentiate_axes(
        &self,
        k: usize,
        found: &[Node<D>],
        angular: &mut AngularAccelerations,
        AxisMotion {
            x,
            bias,
            acceleration,
        }: AxisMotion<'_, D>,
    ) {
        for (frame, spin_rate) in self.rigid.iter().zip(&mut angular.rigid) {
            for (rate, value) in spin_rate.iter_mut().zip(&found[frame.node][1]) {
                set_part(rate, k, *value);
            }
            let mut sum = frame.axes(acceleration);
            let by_rate = axis_rates(&frame.axes(x), spin_rate);
            add_parts(k, &mut sum, &by_rate, &frame.axes(bias));
            frame.set_axes(&sum, acceleration);
        }
        for (body, rates) in self.reduced.iter().zip(&mut angular.reduced) {
            for (rate, value) in rates.iter_mut().zip(body.counted(found)) {
                set_part(rate, k, *value);
            }
            body.differentiate(k, rates, (x, bias), acceleration);
        }
        for patch in &self.patches {
            patch.differentiate(x, bias, acceleration);
        }
        for (frame, spin_rate) in self.section_frames().zip(&mut angular.sections) {
            for (rate, value) in spin_rate.iter_mut().zip(&found[frame.node][1]) {
                set_part(rate, k, *value);
            }
            let mut sum = frame.axes(acceleration);
            let by_rate = frame.axis_rates(x, acceleration, *spin_rate);
            add_parts(k, &mut sum, &by_rate, &frame.axes(bias));
            set_axes_at(frame.node, &sum, acceleration);
            acceleration[frame.node][0] = acceleration[frame.line][0];
        }
    }
}
