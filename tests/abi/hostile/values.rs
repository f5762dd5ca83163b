//! Getting and setting variables of every type with references and arrays of every kind.

use std::ffi::{c_char, c_int};
use std::ptr;

use flexbody::simulation::Source;

use super::bytes::Bytes;
use super::standard::mark;
use super::{ERROR, Master, OK, OK_OR_ERROR, Temper};
use crate::support::{Status, Unit, call};

/// Most references of one call.
pub const MOST: usize = 3;
/// What stands behind the values of an answer: nobody may write there.
const GUARD: f64 = -7.25;

pub fn is_input(unit: &Unit, index: usize) -> bool {
    matches!(unit.variables[index].source, Source::Input(..))
}

pub fn is_output(unit: &Unit, index: usize) -> bool {
    matches!(unit.variables[index].source, Source::Output(..))
}

/// Values of a parameter or input that make no trouble.
pub fn tame(unit: &Unit, index: usize) -> [f64; 3] {
    let start = unit.variables[index].start.unwrap_or(0.0);
    if is_input(unit, index) {
        [start, 0.5, -0.25]
    } else {
        [start, 2.0 * start, 0.5 * start]
    }
}

/// Arguments of a call on variables: what is wrong with the arrays, and the references.
pub struct Arguments {
    references: [u32; MOST],
    pub count: usize,
    null_references: bool,
    null_values: bool,
}

impl Arguments {
    /// References of all kinds.
    fn new(unit: &Unit, bytes: &mut Bytes<'_>) -> Self {
        let count = unit.variables.len() as u32;
        let reference = |byte: u8| match byte {
            0..248 => u32::from(byte) % count,
            248..252 => count,
            _ => u32::MAX,
        };
        let wrong = bytes.byte();
        let number = usize::from(bytes.byte()) % (MOST + 1);
        Self {
            references: [(); MOST].map(|()| reference(bytes.byte())),
            count: if wrong == 255 { usize::MAX } else { number },
            null_references: wrong == 253 || wrong == 254,
            null_values: (250..253).contains(&wrong),
        }
    }

    /// References mostly of some.
    pub fn of(unit: &Unit, bytes: &mut Bytes<'_>, some: &[u32]) -> Self {
        let mut arguments = Self::new(unit, bytes);
        if !bytes.once_in(8) {
            arguments.references = [(); MOST].map(|()| bytes.pick(some));
        }
        arguments
    }

    pub fn picked(&self) -> &[u32] {
        &self.references[..self.count.min(MOST)]
    }

    /// Whether the arrays are what they should be.
    pub fn sound(&self) -> bool {
        self.count == 0 || self.count <= MOST && !(self.null_references || self.null_values)
    }

    pub fn vr(&self) -> *const u32 {
        if self.null_references {
            ptr::null()
        } else {
            self.references.as_ptr()
        }
    }

    pub fn array<T>(&self, values: &[T; MOST]) -> *const T {
        if self.null_values {
            ptr::null()
        } else {
            values.as_ptr()
        }
    }

    pub fn array_mut<T>(&self, values: &mut [T; MOST + 1]) -> *mut T {
        if self.null_values {
            ptr::null_mut()
        } else {
            values.as_mut_ptr()
        }
    }
}

impl Master<'_> {
    /// Whether all references name variables of a type.
    pub(super) fn all_of_type(&self, picked: &[u32], integers: bool) -> bool {
        picked.iter().all(|reference| {
            let variable = self.unit.variables.get(*reference as usize);
            variable.is_some_and(|variable| variable.is_integer() == integers)
        })
    }

    fn readable(&self, arguments: &Arguments, integers: bool) -> &'static [Status] {
        let known = self.all_of_type(arguments.picked(), integers);
        if !(arguments.sound() && known) {
            ERROR
        } else if self.temper() == Temper::Tame {
            OK
        } else {
            OK_OR_ERROR
        }
    }

    pub(super) fn get_real(&mut self, bytes: &mut Bytes<'_>) {
        let arguments = Arguments::new(self.unit, bytes);
        let mut values = [GUARD; MOST + 1];
        let expected = self.readable(&arguments, false);
        let (vr, count) = (arguments.vr(), arguments.count);
        let target = arguments.array_mut(&mut values);
        let status = self.call("fmi2GetReal", expected, |c| {
            call!(fmi2GetReal, c, vr, count, target)
        });
        let picked = arguments.picked();
        assert_eq!(values[picked.len()..], [GUARD; MOST + 1][picked.len()..]);
        if status == Status::Ok {
            for (reference, value) in picked.iter().zip(values) {
                assert!(value.is_finite(), "{value} of reference {reference}");
                self.check_kept(*reference, value);
            }
        }
    }

    pub(super) fn get_integer(&mut self, bytes: &mut Bytes<'_>) {
        let arguments = Arguments::new(self.unit, bytes);
        let mut values = [-7; MOST + 1];
        let expected = self.readable(&arguments, true);
        let (vr, count) = (arguments.vr(), arguments.count);
        let target = arguments.array_mut(&mut values);
        let status = self.call("fmi2GetInteger", expected, |c| {
            call!(fmi2GetInteger, c, vr, count, target)
        });
        if status == Status::Ok {
            for (reference, value) in arguments.picked().iter().zip(values) {
                self.check_kept(*reference, f64::from(value));
            }
        }
    }

    /// Parameters and inputs are what they were set to, time is the master's.
    fn check_kept(&self, reference: u32, value: f64) {
        let index = reference as usize;
        let variable = &self.unit.variables[index];
        let moved = self.memory.moved && is_input(self.unit, index);
        if variable.start.is_some() && !moved {
            assert_eq!(value, self.memory.values[index], "{}", variable.name);
        }
        if matches!(variable.source, Source::Time) {
            assert_eq!(value, self.memory.time);
        }
    }

    /// No variable is Boolean or a string.
    pub(super) fn get_other(&mut self, bytes: &mut Bytes<'_>) {
        let arguments = Arguments::new(self.unit, bytes);
        let expected = if arguments.count == 0 { OK } else { ERROR };
        let (vr, count) = (arguments.vr(), arguments.count);
        let mut words = [ptr::null::<c_char>(); MOST + 1];
        let mut truths: [c_int; MOST + 1] = [0; MOST + 1];
        let (words, truths) = (
            arguments.array_mut(&mut words),
            arguments.array_mut(&mut truths),
        );
        let _ = if bytes.once_in(2) {
            self.call("fmi2GetBoolean", expected, |c| {
                call!(fmi2GetBoolean, c, vr, count, truths)
            })
        } else {
            self.call("fmi2GetString", expected, |c| {
                call!(fmi2GetString, c, vr, count, words)
            })
        };
    }

    /// What the standard says to setting these values now.
    fn settable(&self, function: &str, arguments: &Arguments, values: &[f64]) -> &'static [Status] {
        let mark = mark(function, self.memory.mode);
        let open = |index: usize| {
            if is_input(self.unit, index) {
                mark != '-'
            } else {
                self.unit.variables[index].start.is_some() && mark == 'e'
            }
        };
        let integers = function == "fmi2SetInteger";
        let picked = arguments.picked();
        let known = self.all_of_type(picked, integers);
        let right = known && picked.iter().all(|reference| open(*reference as usize));
        if !(arguments.sound() && right && values.iter().all(|value| value.is_finite())) {
            return ERROR;
        }
        let harmless = |(reference, value): (&u32, &f64)| {
            let index = *reference as usize;
            is_input(self.unit, index) || tame(self.unit, index).contains(value)
        };
        let all = picked.iter().zip(values).all(harmless);
        if all && self.temper() != Temper::Absurd {
            OK
        } else {
            OK_OR_ERROR
        }
    }

    fn keep(&mut self, status: Status, arguments: &Arguments, values: &[f64]) {
        if status == Status::Ok {
            for (reference, value) in arguments.picked().iter().zip(values) {
                self.memory.values[*reference as usize] = *value;
            }
        }
    }

    pub(super) fn set_real(&mut self, bytes: &mut Bytes<'_>) {
        let arguments = Arguments::new(self.unit, bytes);
        let values = arguments.references.map(|reference| {
            let index = reference as usize;
            if index < self.unit.variables.len() && !bytes.once_in(6) {
                bytes.pick(&tame(self.unit, index))
            } else {
                bytes.number()
            }
        });
        let (vr, count, source) = (arguments.vr(), arguments.count, arguments.array(&values));
        let values = &values[..arguments.picked().len()];
        let expected = self.settable("fmi2SetReal", &arguments, values);
        let status = self.call("fmi2SetReal", expected, |c| {
            call!(fmi2SetReal, c, vr, count, source)
        });
        self.keep(status, &arguments, values);
    }

    pub(super) fn set_integer(&mut self, bytes: &mut Bytes<'_>) {
        let mut arguments = Arguments::new(self.unit, bytes);
        if !bytes.once_in(4) {
            arguments.references = [self.unit.reference("rod.elements"); MOST];
        }
        let choices = [4, 2, 8, 4, 2, 1, 0, -1, c_int::MIN, c_int::MAX];
        let values = [(); MOST].map(|()| bytes.pick(&choices));
        let (vr, count, source) = (arguments.vr(), arguments.count, arguments.array(&values));
        let values = values.map(f64::from);
        let values = &values[..arguments.picked().len()];
        let expected = self.settable("fmi2SetInteger", &arguments, values);
        let status = self.call("fmi2SetInteger", expected, |c| {
            call!(fmi2SetInteger, c, vr, count, source)
        });
        self.keep(status, &arguments, values);
    }

    pub(super) fn set_other(&mut self, bytes: &mut Bytes<'_>) {
        let arguments = Arguments::new(self.unit, bytes);
        let expected = if arguments.count == 0 { OK } else { ERROR };
        let (vr, count) = (arguments.vr(), arguments.count);
        let (words, truths) = ([ptr::null::<c_char>(); MOST], [1; MOST]);
        let (words, truths) = (arguments.array(&words), arguments.array(&truths));
        let _ = if bytes.once_in(2) {
            self.call("fmi2SetBoolean", expected, |c| {
                call!(fmi2SetBoolean, c, vr, count, truths)
            })
        } else {
            self.call("fmi2SetString", expected, |c| {
                call!(fmi2SetString, c, vr, count, words)
            })
        };
    }
}
