//! The calls of a life: its transitions, steps, statuses and messages.

use std::ffi::{CStr, c_char, c_int};
use std::ptr;

use super::bytes::Bytes;
use super::standard::Mode;
use super::{ANY, DISCARD, ERROR, Master, Memory, OK, OK_OR_DISCARD, OK_OR_ERROR, Temper, WARNING};
use crate::support::{CO_SIMULATION, Instance, Status, call};

const LAST_SUCCESSFUL_TIME: c_int = 2;
const TERMINATED: c_int = 3;

/// Longest step that a master takes where nothing limits the work.
const LONG: f64 = 0.05;

/// Whether masters that add up their time may be off by so much: relatively 1e-5, never half a step.
/// Close to that the unit may see it either way.
fn is_rounding(difference: f64, size: f64, step: f64) -> Option<bool> {
    let most = (1e-5 * size.max(step)).min(0.5 * step);
    match difference.abs() / most {
        part if part < 0.99 => Some(true),
        part if part > 1.01 => Some(false),
        _ => None,
    }
}

impl Master<'_> {
    /// Makes the next call.
    pub(super) fn act(&mut self, bytes: &mut Bytes<'_>) {
        match bytes.byte() % 64 {
            0..14 => self.do_step(bytes),
            14..20 => self.set_real(bytes),
            20..26 => self.get_real(bytes),
            26..28 => self.enter(),
            28..30 => self.exit(),
            30..32 => self.fail(bytes),
            32 => self.set_debug_logging(bytes),
            33..35 => self.set_up_experiment(bytes),
            35 => self.terminate(),
            36..38 => self.reset(),
            38 => self.get_integer(bytes),
            39..41 => self.set_integer(bytes),
            41 => self.get_other(bytes),
            42 => self.set_other(bytes),
            43..46 => self.save(bytes),
            46..50 => self.restore(bytes),
            50 => self.free(bytes),
            51 => self.size(bytes),
            52..54 => self.serialize(bytes),
            54..56 => self.deserialize(bytes),
            56 => self.directional_derivative(bytes),
            57 => self.input_derivatives(bytes),
            58 => self.output_derivatives(bytes),
            59 => drop(self.call("fmi2CancelStep", ERROR, |c| call!(fmi2CancelStep, c))),
            60..62 => self.status(bytes),
            62 => self.refused_instance(bytes),
            _ => self.new_instance(bytes),
        }
    }

    /// What a computation with the present parameters and inputs may answer.
    fn computed(&self) -> &'static [Status] {
        match self.temper() {
            Temper::Tame => OK,
            _ => OK_OR_ERROR,
        }
    }

    fn enter(&mut self) {
        let function = "fmi2EnterInitializationMode";
        let expected = self.computed();
        let status = self.call(function, expected, |c| {
            call!(fmi2EnterInitializationMode, c)
        });
        self.memory.time = match status {
            Status::Ok => self.memory.start,
            _ => self.memory.time,
        };
        self.move_on(status, Mode::Instantiated, Mode::Initialization);
    }

    fn exit(&mut self) {
        let function = "fmi2ExitInitializationMode";
        let expected = self.computed();
        let status = self.call(function, expected, |c| call!(fmi2ExitInitializationMode, c));
        self.move_on(status, Mode::Initialization, Mode::StepComplete);
    }

    /// The shortest way to a step or an initialization that fails.
    fn fail(&mut self, bytes: &mut Bytes<'_>) {
        let reference = self.unit.reference("rod.elements");
        match self.memory.mode {
            Mode::Instantiated => {
                let status = self.call("fmi2SetInteger", OK_OR_ERROR, |c| {
                    call!(fmi2SetInteger, c, &reference, 1, &1)
                });
                if status == Status::Ok {
                    self.memory.values[reference as usize] = 1.0;
                }
                self.enter();
            }
            Mode::StepComplete => {
                let reference = self.unit.reference("rod.tip.force[1]");
                let force = 1e300;
                let status = self.call("fmi2SetReal", OK, |c| {
                    call!(fmi2SetReal, c, &reference, 1, &force)
                });
                if status == Status::Ok {
                    self.memory.values[reference as usize] = force;
                }
                self.do_step(bytes);
            }
            _ => {}
        }
    }

    /// To the next mode, or to the error mode if a computation failed.
    fn move_on(&mut self, status: Status, from: Mode, to: Mode) {
        if self.memory.mode == from && !self.nobody {
            self.memory.mode = if status == Status::Ok {
                to
            } else {
                Mode::Error
            };
        }
    }

    fn terminate(&mut self) {
        let status = self.call("fmi2Terminate", OK, |c| call!(fmi2Terminate, c));
        if status == Status::Ok {
            self.memory.mode = Mode::Terminated;
        }
    }

    fn reset(&mut self) {
        let status = self.call("fmi2Reset", OK, |c| call!(fmi2Reset, c));
        if status == Status::Ok {
            self.memory = Memory::new(self.unit);
        }
    }

    fn set_up_experiment(&mut self, bytes: &mut Bytes<'_>) {
        let hostile = bytes.once_in(4);
        let mut number = |usual: &[f64]| {
            if hostile {
                bytes.number()
            } else {
                bytes.pick(usual)
            }
        };
        let tolerance = number(&[1e-4, 5e-5, 2e-4]);
        let start = number(&[0.0, 0.5, -2.0]);
        let stop = number(&[start + 0.1, start + 1.0, start + 1e-3]);
        let [with_tolerance, with_stop] = [(); 2].map(|()| bytes.once_in(2));
        let no_tolerance = with_tolerance && !(0.0..1.0).contains(&tolerance);
        let no_stop = with_stop && !(stop > start && stop.is_finite());
        let expected = if !start.is_finite() || no_tolerance || no_stop {
            ERROR
        } else if hostile && with_tolerance || self.temper() == Temper::Absurd {
            OK_OR_ERROR
        } else {
            OK
        };
        let (t, s) = (c_int::from(with_tolerance), c_int::from(with_stop));
        let status = self.call("fmi2SetupExperiment", expected, |c| {
            call!(fmi2SetupExperiment, c, t, tolerance, start, s, stop)
        });
        if status == Status::Ok {
            let memory = &mut self.memory;
            (memory.start, memory.stop) = (start, with_stop.then_some(stop));
            // The tighter one holds; 0 is none.
            if with_tolerance && tolerance > 0.0 {
                let reference = self.unit.reference("relative_tolerance");
                let holds = &mut memory.values[reference as usize];
                *holds = holds.min(tolerance);
            }
        }
    }

    fn do_step(&mut self, bytes: &mut Bytes<'_>) {
        let step = if bytes.once_in(5) {
            bytes.number()
        } else {
            bytes.pick(&[0.01, 0.002, 1e-6, 0.02])
        };
        let now = self.memory.time;
        let current = match bytes.byte() {
            0..220 => now,
            220..232 => now * (1.0 + 1e-13),
            232..244 => now + 1.01 * step,
            _ => bytes.number(),
        };
        let expected = self.stepped(current, step);
        let temper = self.temper();
        let endless = temper == Temper::Absurd || step > LONG;
        if expected != ERROR && endless && !self.limited && self.memory.mode == Mode::StepComplete {
            return;
        }
        let expected = match temper {
            Temper::Tame if step <= LONG => expected,
            _ if expected == OK => OK_OR_DISCARD,
            _ if expected == OK_OR_ERROR => ANY,
            _ => expected,
        };
        let status = self.call("fmi2DoStep", expected, |c| {
            call!(fmi2DoStep, c, current, step, 0)
        });
        match status {
            Status::Ok => {
                self.memory.time = current + step;
                self.memory.shaken |= temper != Temper::Tame;
            }
            Status::Discard => self.stopped_before(current + step),
            _ => {}
        }
    }

    /// What a step that can be computed may answer: whether the arguments allow it.
    fn stepped(&self, current: f64, step: f64) -> &'static [Status] {
        let (now, until) = (self.memory.time, current + step);
        let numbers = current.is_finite() && step.is_finite() && until.is_finite();
        if !numbers || step <= 0.0 || until <= now {
            return ERROR;
        }
        let past = self.memory.stop.filter(|stop| until > *stop);
        let allowed = [
            is_rounding(current - now, current.abs().max(now.abs()), step),
            past.map_or(Some(true), |stop| {
                is_rounding(until - stop, until.abs(), step)
            }),
        ];
        match allowed {
            [Some(true), Some(true)] => OK,
            [Some(false), _] | [_, Some(false)] => ERROR,
            _ => OK_OR_ERROR,
        }
    }

    /// After a step that was done in part: how far it came, and that it may be tried again.
    fn stopped_before(&mut self, until: f64) {
        self.memory.mode = Mode::StepFailed;
        let mut time = f64::NAN;
        let status = self.call("fmi2GetRealStatus", OK, |c| {
            call!(fmi2GetRealStatus, c, LAST_SUCCESSFUL_TIME, &mut time)
        });
        assert_eq!(status, Status::Ok);
        assert!((self.memory.time..until).contains(&time), "{time}");
        self.memory.time = time;
        self.memory.shaken = true;
    }

    fn status(&mut self, bytes: &mut Bytes<'_>) {
        let kind = bytes.pick(&[2, 3, 0, 1, -1, c_int::MAX]);
        let null = bytes.once_in(8);
        let (mut status, mut real, mut integer) = (Status::Ok, f64::NAN, 7);
        let mut word: *const c_char = ptr::null();
        let expected = |kind_of: c_int| match (null, kind == kind_of) {
            (true, _) => ERROR,
            (_, true) => OK,
            (_, false) => DISCARD,
        };
        let place = |at| if null { ptr::null_mut() } else { at };
        let real_at = if null { ptr::null_mut() } else { &raw mut real };
        // No integer kind exists, and the others speak of steps in the background.
        const NONE: c_int = c_int::MIN;
        let answered = match bytes.byte() % 5 {
            0 => self.call("fmi2GetStatus", expected(NONE), |c| {
                let at = if null {
                    ptr::null_mut()
                } else {
                    &raw mut status
                };
                call!(fmi2GetStatus, c, kind, at)
            }),
            1 => self.call("fmi2GetRealStatus", expected(LAST_SUCCESSFUL_TIME), |c| {
                call!(fmi2GetRealStatus, c, kind, real_at)
            }),
            2 => self.call("fmi2GetIntegerStatus", expected(NONE), |c| {
                call!(fmi2GetIntegerStatus, c, kind, place(&mut integer))
            }),
            3 => self.call("fmi2GetBooleanStatus", expected(TERMINATED), |c| {
                call!(fmi2GetBooleanStatus, c, kind, place(&mut integer))
            }),
            _ => self.call("fmi2GetStringStatus", expected(NONE), |c| {
                let at = if null { ptr::null_mut() } else { &raw mut word };
                call!(fmi2GetStringStatus, c, kind, at)
            }),
        };
        if answered == Status::Ok {
            assert!(real == self.memory.time || integer == 0);
        }
    }

    fn set_debug_logging(&mut self, bytes: &mut Bytes<'_>) {
        let known = [
            c"logStatusError",
            c"logStatusWarning",
            c"logEvents",
            c"logSolver",
        ];
        let pick = |bytes: &mut Bytes<'_>| -> Option<&'static CStr> {
            match bytes.byte() {
                at @ 0..240 => Some(known[usize::from(at) % known.len()]),
                240..246 => Some(c"gossip"),
                246..251 => Some(c"\xff"),
                _ => None,
            }
        };
        let count = usize::from(bytes.byte()) % 3;
        let names: Vec<_> = (0..count).map(|_| pick(bytes)).collect();
        let (on, null) = (!bytes.once_in(4), count > 0 && bytes.once_in(8));
        let is_text = |name: &Option<&'static CStr>| name.is_some_and(|name| name != c"\xff");
        let right: Vec<_> = (names.iter().flatten().copied())
            .filter(|name| known.contains(name))
            .collect();
        let expected = if null || !names.iter().all(is_text) {
            ERROR
        } else if right.len() == count {
            OK
        } else {
            WARNING
        };
        let data: Vec<_> = names
            .iter()
            .map(|name| name.map_or(ptr::null(), CStr::as_ptr))
            .collect();
        let categories = if null { ptr::null() } else { data.as_ptr() };
        let status = self.call("fmi2SetDebugLogging", expected, |c| {
            call!(fmi2SetDebugLogging, c, c_int::from(on), count, categories)
        });
        if status != Status::Error {
            let named = right.into_iter();
            self.enabled = match (on, count) {
                (false, _) => vec!["logStatusError".into()],
                (true, 0) => self.declared.clone(),
                _ => named.map(|n| n.to_string_lossy().into_owned()).collect(),
            };
        }
    }

    /// The instance ends, with the states that belong to it, and another takes its place.
    fn new_instance(&mut self, bytes: &mut Bytes<'_>) {
        self.free_all();
        self.memory = Memory::new(self.unit);
        self.instance = if bytes.once_in(2) {
            self.memory.mode = Mode::Bare;
            Instance::bare(self.unit)
        } else {
            Instance::new(self.unit)
        };
        self.enabled = self.declared.clone();
    }

    /// An instance that must not come to be: one argument is wrong.
    fn refused_instance(&mut self, bytes: &mut Bytes<'_>) {
        let unit = self.unit;
        let (mut name, mut kind) = (c"other".as_ptr(), CO_SIMULATION);
        let (mut guid, mut location) = (unit.guid.as_ptr(), unit.location.as_ptr());
        match bytes.byte() % 8 {
            0 => name = ptr::null(),
            1 => name = c"".as_ptr(),
            2 => kind = 0,
            3 => kind = c_int::MIN,
            4 => guid = ptr::null(),
            5 => guid = self.foreign.unit.guid.as_ptr(),
            6 => location = c"file:///%".as_ptr(),
            _ => location = c"\xff".as_ptr(),
        }
        self.instance.record.take();
        let callbacks = self.instance.record.callbacks();
        let made = call!(
            fmi2Instantiate,
            name,
            kind,
            guid,
            location,
            &callbacks,
            0,
            0
        );
        assert!(made.is_null());
        let lines = self.instance.record.take();
        assert!(
            matches!(&lines[..], [(_, Status::Error, category, _)] if category == "logStatusError")
        );
    }
}
