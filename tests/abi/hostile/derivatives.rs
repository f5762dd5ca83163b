//! Derivatives of inputs and outputs in time, and of outputs in directions of inputs.

use std::ffi::c_int;
use std::ptr;

use super::bytes::Bytes;
use super::standard::{Mode, mark};
use super::values::{Arguments, MOST, is_input, is_output};
use super::{ERROR, Master, OK, OK_OR_ERROR, Temper};
use crate::support::{Status, call};

/// Orders that are offered.
const ORDERS: std::ops::RangeInclusive<c_int> = 1..=2;

impl Master<'_> {
    /// What may be answered to arguments that are right, of which the standard does not say more.
    fn derived(&self, function: &str, usual: bool) -> &'static [Status] {
        let settled = mark(function, self.memory.mode) == 'x' && self.temper() == Temper::Tame;
        if settled && usual { OK } else { OK_OR_ERROR }
    }

    /// Whether references name inputs, or outputs.
    fn all_are(&self, picked: &[u32], inputs: bool) -> bool {
        self.all_of_type(picked, false)
            && picked.iter().all(|reference| {
                let index = *reference as usize;
                if inputs {
                    is_input(self.unit, index)
                } else {
                    is_output(self.unit, index)
                }
            })
    }

    fn orders(bytes: &mut Bytes<'_>) -> ([c_int; MOST], bool) {
        let order = |bytes: &mut Bytes<'_>| match bytes.byte() {
            at @ 0..240 => c_int::from(at % 2) + 1,
            240..248 => 3,
            248..252 => 0,
            _ => c_int::MIN,
        };
        ([(); MOST].map(|()| order(bytes)), bytes.once_in(16))
    }

    pub(super) fn input_derivatives(&mut self, bytes: &mut Bytes<'_>) {
        let function = "fmi2SetRealInputDerivatives";
        let arguments = Arguments::of(self.unit, bytes, &self.inputs);
        let (orders, no_orders) = Self::orders(bytes);
        let values = [(); MOST].map(|()| {
            if bytes.once_in(6) {
                bytes.number()
            } else {
                bytes.pick(&[0.0, 0.5, -1.0])
            }
        });
        let picked = arguments.picked();
        let (given, ranks) = (&values[..picked.len()], &orders[..picked.len()]);
        let right = arguments.sound()
            && (picked.is_empty() || !no_orders)
            && self.all_are(picked, true)
            && ranks.iter().all(|order| *order >= 1)
            && given.iter().all(|value| value.is_finite());
        let usual = ranks.iter().all(|order| ORDERS.contains(order));
        let expected = if !(self.derivatives && right) {
            ERROR
        } else if usual {
            OK
        } else {
            OK_OR_ERROR
        };
        let (vr, count, values) = (arguments.vr(), arguments.count, arguments.array(&values));
        let orders = if no_orders {
            ptr::null()
        } else {
            orders.as_ptr()
        };
        let status = self.call(function, expected, |c| {
            call!(fmi2SetRealInputDerivatives, c, vr, count, orders, values)
        });
        let steep = given.iter().any(|value| value.abs() > 1.0);
        self.memory.shaken |= status == Status::Ok && steep;
        self.memory.moved |= status == Status::Ok;
    }

    pub(super) fn output_derivatives(&mut self, bytes: &mut Bytes<'_>) {
        let function = "fmi2GetRealOutputDerivatives";
        let arguments = Arguments::of(self.unit, bytes, &self.outputs);
        let (orders, no_orders) = Self::orders(bytes);
        let picked = arguments.picked();
        let ranks = &orders[..picked.len()];
        let right = arguments.sound()
            && (picked.is_empty() || !no_orders)
            && self.all_are(picked, false)
            && ranks.iter().all(|order| *order >= 1);
        let usual = ranks.iter().all(|order| ORDERS.contains(order));
        let expected = if self.derivatives && right {
            self.derived(function, usual)
        } else {
            ERROR
        };
        let mut values = [0.0; MOST + 1];
        let (vr, count, target) = (
            arguments.vr(),
            arguments.count,
            arguments.array_mut(&mut values),
        );
        let orders = if no_orders {
            ptr::null()
        } else {
            orders.as_ptr()
        };
        let status = self.call(function, expected, |c| {
            call!(fmi2GetRealOutputDerivatives, c, vr, count, orders, target)
        });
        if status == Status::Ok {
            assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
        }
    }

    pub(super) fn directional_derivative(&mut self, bytes: &mut Bytes<'_>) {
        let function = "fmi2GetDirectionalDerivative";
        let unknown = Arguments::of(self.unit, bytes, &self.outputs);
        let known = Arguments::of(self.unit, bytes, &self.inputs);
        let seed = [(); MOST].map(|()| {
            if bytes.once_in(8) {
                bytes.number()
            } else {
                bytes.pick(&[0.0, 1.0, -2.0])
            }
        });
        let (unknowns, knowns) = (unknown.picked(), known.picked());
        let seeds = &seed[..knowns.len()];
        let sound = unknown.sound() && known.sound();
        let right = self.all_are(unknowns, false) && self.all_are(knowns, true);
        // Before the end of initialization more may be known: parameters.
        let open = self.memory.mode == Mode::Initialization;
        let usual = right && seeds.iter().all(|seed| seed.abs() <= 2.0);
        let expected = if self.derivatives && sound && (right || open) {
            self.derived(function, usual)
        } else {
            ERROR
        };
        let mut values = [0.0; MOST + 1];
        let (u, v, target) = (unknown.vr(), known.vr(), unknown.array_mut(&mut values));
        let (m, n, source) = (unknown.count, known.count, known.array(&seed));
        let status = self.call(function, expected, |c| {
            call!(fmi2GetDirectionalDerivative, c, u, m, v, n, source, target)
        });
        if status == Status::Ok && usual {
            assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
            let nothing = seeds.iter().all(|seed| *seed == 0.0);
            assert!(
                !nothing || values == [0.0; MOST + 1],
                "of nothing: {values:?}"
            );
        }
    }
}
