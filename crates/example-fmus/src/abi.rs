//! The C interface of FMI 2.0 for co-simulation, and the only unsafe code of this crate.
//!
//! # Safety
//! As in Flexbody's own interface: pointers are NULL or valid for the call with the stated number of
//! entries; instances and saved states came from this library, and one call uses them at a time.
#![allow(non_snake_case, reason = "the names are those of the standard")]
#![allow(
    clippy::missing_safety_doc,
    reason = "one contract for all, stated above"
)]

use std::ffi::{CStr, CString, c_char, c_int, c_uint, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr;
use std::slice;

use crate::instance::{Instance, Phase, Refusal, Saved};

type Outcome = Result<(), Refusal>;

const OK: c_int = 0;
const DISCARD: c_int = 2;
const ERROR: c_int = 3;
const FATAL: c_int = 4;
/// `fmi2LastSuccessfulTime` of `fmi2StatusKind`.
const LAST_SUCCESSFUL_TIME: c_int = 2;

/// `fmi2CallbackLogger`.
type Logger =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);

/// `fmi2CallbackFunctions`; the library has its own allocator and no step in the background.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct Callbacks {
    logger: Option<Logger>,
    allocate_memory: *const c_void,
    free_memory: *const c_void,
    step_finished: *const c_void,
    environment: *mut c_void,
}

/// `fmi2Component`.
pub struct Component {
    /// `None` after a panic.
    instance: Option<Instance>,
    name: CString,
    callbacks: Callbacks,
    logging: bool,
}

impl Component {
    fn log(&self, message: String) {
        let Some(logger) = self.callbacks.logger.filter(|_| self.logging) else {
            return;
        };
        let message = CString::new(message).unwrap_or_default();
        let (category, text) = (c"logStatusError".as_ptr(), message.as_ptr());
        let (environment, name) = (self.callbacks.environment, self.name.as_ptr());
        // SAFETY: the master's function with its own pointer; the texts outlive the call.
        unsafe { logger(environment, name, ERROR, category, c"%s".as_ptr(), text) }
    }
}

/// Runs a function on an instance and guards it: against NULL, refusals and panics.
unsafe fn guard(c: *mut Component, body: impl FnOnce(&mut Instance) -> Outcome) -> c_int {
    // SAFETY: module contract.
    let Some(component) = (unsafe { c.as_mut() }) else {
        return ERROR;
    };
    let Some(instance) = &mut component.instance else {
        return FATAL;
    };
    match catch_unwind(AssertUnwindSafe(|| body(instance))) {
        Ok(Ok(())) => OK,
        Ok(Err(refusal)) => {
            component.log(refusal);
            ERROR
        }
        Err(_) => {
            component.instance = None;
            FATAL
        }
    }
}

/// An array that the master lends for reading.
unsafe fn lent<'a, T>(data: *const T, count: usize) -> Result<&'a [T], Refusal> {
    match count {
        0 => Ok(&[]),
        _ if data.is_null() => Err("found NULL for an array".into()),
        // SAFETY: module contract.
        _ => Ok(unsafe { slice::from_raw_parts(data, count) }),
    }
}

/// An array or a place that the master lends for writing.
unsafe fn lent_mut<'a, T>(data: *mut T, count: usize) -> Result<&'a mut [T], Refusal> {
    match count {
        0 => Ok(&mut []),
        _ if data.is_null() => Err("found NULL for an array".into()),
        // SAFETY: module contract; all types written here are plain numbers and pointers.
        _ => Ok(unsafe { slice::from_raw_parts_mut(data, count) }),
    }
}

unsafe fn text(data: *const c_char) -> CString {
    if data.is_null() {
        return CString::default();
    }
    // SAFETY: module contract.
    unsafe { CStr::from_ptr(data) }.to_owned()
}

/// `fmi2GetTypesPlatform`.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

/// `fmi2GetVersion`.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// `fmi2Instantiate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: c_int,
    guid: *const c_char,
    _resources: *const c_char,
    callbacks: *const Callbacks,
    _visible: c_int,
    logging: c_int,
) -> *mut Component {
    let instantiate = || {
        // SAFETY: module contract, for all three.
        let (name, guid, callbacks) = unsafe { (text(name), text(guid), callbacks.as_ref()?) };
        let mut component = Component {
            instance: None,
            name,
            callbacks: *callbacks,
            logging: logging != 0,
        };
        component.instance = Instance::new(guid.to_str().ok()?);
        let is_co_simulation = kind == 1;
        if component.instance.is_none() || component.name.is_empty() || !is_co_simulation {
            component.log(format!(
                "fmi2Instantiate: refused GUID {guid:?}, type {kind}"
            ));
            return None;
        }
        Some(Box::new(component))
    };
    match catch_unwind(AssertUnwindSafe(instantiate)) {
        Ok(Some(component)) => Box::into_raw(component),
        _ => ptr::null_mut(),
    }
}

/// `fmi2FreeInstance`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: *mut Component) {
    if !c.is_null() {
        // SAFETY: made by `Box::into_raw` in `fmi2Instantiate`, freed only here.
        drop(unsafe { Box::from_raw(c) });
    }
}

/// `fmi2SetDebugLogging`: there is one category only.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    c: *mut Component,
    on: c_int,
    _count: usize,
    _categories: *const *const c_char,
) -> c_int {
    // SAFETY: module contract.
    let Some(component) = (unsafe { c.as_mut() }) else {
        return ERROR;
    };
    component.logging = on != 0;
    OK
}

/// Functions that pass the guard, with their arguments and what they do.
macro_rules! functions {
    ($($name:ident($instance:ident $(, $argument:ident: $type:ty)*) $body:block)*) => {$(
        #[doc = concat!("`", stringify!($name), "`.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(c: *mut Component $(, $argument: $type)*) -> c_int {
            let body = |$instance: &mut Instance| {
                // SAFETY: module contract, for all that the master lends.
                #[allow(unused_unsafe, reason = "some functions borrow nothing")]
                unsafe { $body }
            };
            // SAFETY: module contract.
            unsafe { guard(c, body) }
        }
    )*};
}

functions! {
    fmi2SetupExperiment(i, _defined: c_int, _tolerance: f64, start: f64, _stops: c_int, _stop: f64) {
        i.set_up(start)
    }
    fmi2EnterInitializationMode(i) { i.advance(Phase::Instantiated, Phase::Initialization) }
    fmi2ExitInitializationMode(i) { i.advance(Phase::Initialization, Phase::Ready) }
    fmi2Terminate(i) { i.advance(Phase::Ready, Phase::Terminated) }
    fmi2Reset(i) {
        i.reset();
        Ok(())
    }
    fmi2GetReal(i, vr: *const c_uint, count: usize, value: *mut f64) {
        let pairs = lent(vr, count)?.iter().zip(lent_mut(value, count)?);
        pairs.into_iter().try_for_each(|(vr, value)| {
            *value = i.get(*vr)?;
            Ok(())
        })
    }
    fmi2SetReal(i, vr: *const c_uint, count: usize, value: *const f64) {
        let pairs = lent(vr, count)?.iter().zip(lent(value, count)?);
        pairs.into_iter().try_for_each(|(vr, value)| i.set(*vr, *value))
    }
    fmi2SetRealInputDerivatives(
        i, vr: *const c_uint, count: usize, order: *const c_int, value: *const f64
    ) {
        let orders = lent(order, count)?.iter().zip(lent(value, count)?);
        let all = lent(vr, count)?.iter().zip(orders);
        all.into_iter().try_for_each(|(vr, (order, value))| i.set_derivative(*vr, *order, *value))
    }
    fmi2GetRealOutputDerivatives(
        i, vr: *const c_uint, count: usize, order: *const c_int, value: *mut f64
    ) {
        i.expect(&[Phase::Ready, Phase::Terminated])?;
        let orders = lent(order, count)?.iter().zip(lent_mut(value, count)?);
        lent(vr, count)?.iter().zip(orders).try_for_each(|(vr, (order, value))| {
            if *order < 1 {
                return Err(format!("order {order}: expected at least 1"));
            }
            *value = i.output_derivative(*vr, *order)?;
            Ok(())
        })
    }
    fmi2GetDirectionalDerivative(
        i,
        unknowns: *const c_uint, unknown_count: usize,
        knowns: *const c_uint, known_count: usize,
        seed: *const f64, sensitivity: *mut f64
    ) {
        i.expect(&[Phase::Initialization, Phase::Ready])?;
        let (knowns, seed) = (lent(knowns, known_count)?, lent(seed, known_count)?);
        let places = lent_mut(sensitivity, unknown_count)?;
        lent(unknowns, unknown_count)?.iter().zip(places).try_for_each(|(unknown, place)| {
            *place = i.directional(*unknown, knowns, seed)?;
            Ok(())
        })
    }
    fmi2DoStep(i, current: f64, size: f64, _keep: c_int) { i.step(current, size) }
    fmi2CancelStep(_i) { Err("no step is in progress".into()) }
    fmi2GetFMUstate(i, state: *mut *mut Saved) {
        let place = &mut lent_mut(state, 1)?[0];
        match place.as_mut() {
            Some(old) => *old = i.save(),
            None => *place = Box::into_raw(Box::new(i.save())),
        }
        Ok(())
    }
    fmi2SetFMUstate(i, state: *mut Saved) { i.restore(&lent(state, 1)?[0]) }
    fmi2FreeFMUstate(_i, state: *mut *mut Saved) {
        if let Some(place) = state.as_mut() && !place.is_null() {
            drop(Box::from_raw(*place));
            *place = ptr::null_mut();
        }
        Ok(())
    }
    fmi2SerializedFMUstateSize(_i, state: *mut Saved, size: *mut usize) {
        lent_mut(size, 1)?[0] = lent(state, 1)?[0].size();
        Ok(())
    }
    fmi2SerializeFMUstate(_i, state: *mut Saved, target: *mut u8, size: usize) {
        let bytes = lent(state, 1)?[0].bytes();
        let target = lent_mut(target, size)?.get_mut(..bytes.len());
        target.ok_or("too little room for the state")?.copy_from_slice(&bytes);
        Ok(())
    }
    fmi2DeSerializeFMUstate(i, source: *const u8, size: usize, state: *mut *mut Saved) {
        let saved = i.deserialize(lent(source, size)?)?;
        lent_mut(state, 1)?[0] = Box::into_raw(Box::new(saved));
        Ok(())
    }
}

/// Functions on variables of types that no model has.
macro_rules! without_variables {
    ($($name:ident)*) => {functions! {$(
        $name(_i, _vr: *const c_uint, count: usize, _value: *const c_void) {
            (count == 0).then_some(()).ok_or("all variables are Real".into())
        }
    )*}};
}

without_variables! {
    fmi2GetInteger fmi2GetBoolean fmi2GetString fmi2SetInteger fmi2SetBoolean fmi2SetString
}

/// `fmi2GetRealStatus`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(
    c: *mut Component,
    kind: c_int,
    value: *mut f64,
) -> c_int {
    if kind != LAST_SUCCESSFUL_TIME {
        return DISCARD;
    }
    let body = |instance: &mut Instance| {
        // SAFETY: module contract.
        unsafe { lent_mut(value, 1)?[0] = instance.time() };
        Ok(())
    };
    // SAFETY: module contract.
    unsafe { guard(c, body) }
}

/// Status of kinds that only a step in the background has.
macro_rules! without_status {
    ($($name:ident)*) => {$(
        #[doc = concat!("`", stringify!($name), "`.")]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name(_c: *mut Component, _kind: c_int, _value: *mut c_void) -> c_int {
            DISCARD
        }
    )*};
}

without_status! { fmi2GetStatus fmi2GetIntegerStatus fmi2GetBooleanStatus fmi2GetStringStatus }
