//! The C interface of FMI 2.0 for co-simulation.
//!
//! Every function does three things: it borrows what the master lends for the call, passes one
//! guard (NULL instance, floating-point environment, lifecycle, panic), and leaves the work to safe
//! code in `fmi/`.
//!
//! # Safety
//! All functions rely on what the standard asks of a master: pointers are NULL or valid for the
//! call with the stated number of entries; an instance is NULL or came from [`fmi2Instantiate`],
//! has not been freed, and is not in another call at the same time; likewise a saved state came
//! from this library. Enumerations arrive as plain integers, so that no value of theirs is
//! undefined behaviour.
#![allow(non_snake_case, reason = "the names are those of the standard")]
#![allow(
    clippy::missing_safety_doc,
    reason = "one contract for all, stated above"
)]

use std::ffi::{CStr, CString};
use std::mem::MaybeUninit;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr;
use std::sync::atomic::{AtomicPtr, Ordering};

use libc::{c_char, c_int, c_uint, c_void, size_t};

use super::instantiation::{Request, instantiate};
use super::lifecycle::InterfaceFunction;
use crate::fmi::{
    Environment, Fault, Instance, Logger, SavedState, Sink, Status, guard, lent, lent_mut, place,
    saved, text,
};

/// `fmi2CoSimulation` of `fmi2Type`.
const CO_SIMULATION: c_int = 1;
/// `fmi2LastSuccessfulTime` of `fmi2StatusKind`.
const LAST_SUCCESSFUL_TIME: c_int = 2;
/// `fmi2Terminated` of `fmi2StatusKind`.
const TERMINATED: c_int = 3;
/// Why most statuses are not answered.
const NO_STATUS: Fault = Fault::NoAnswer(
    "this status exists only while a step runs in the background, which never happens here",
);

/// `fmi2Component`.
pub type Component = *mut c_void;
/// `fmi2FMUstate`.
pub type FmuState = *mut c_void;
/// `fmi2CallbackLogger`.
pub type LoggerCallback = unsafe extern "C" fn(
    environment: *mut c_void,
    instance_name: *const c_char,
    status: Status,
    category: *const c_char,
    message: *const c_char,
    ...
);

/// `fmi2CallbackFunctions`.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct CallbackFunctions {
    /// Receives messages; may be NULL.
    pub logger: Option<LoggerCallback>,
    /// Not used: the library has its own allocator.
    pub allocate_memory: Option<unsafe extern "C" fn(size_t, size_t) -> *mut c_void>,
    /// Not used: the library has its own allocator.
    pub free_memory: Option<unsafe extern "C" fn(*mut c_void)>,
    /// Not used: no step runs in the background.
    pub step_finished: Option<unsafe extern "C" fn(*mut c_void, Status)>,
    /// Passed back to the logger as it is.
    pub component_environment: *mut c_void,
}

/// The master's logger as a safe function.
fn sink(callbacks: CallbackFunctions, instance_name: CString) -> Option<Sink> {
    let logger = callbacks.logger?;
    // An atomic pointer may move between threads, as a master's calls do; it is not followed here.
    let environment = AtomicPtr::new(callbacks.component_environment);
    Some(Box::new(move |status, category, message| {
        let format = as_format(message);
        let (name, category, text) = (instance_name.as_ptr(), category.as_ptr(), format.as_ptr());
        let environment = environment.load(Ordering::Relaxed);
        // SAFETY: the master's own function, with its own pointer and C strings that outlive the
        // call. The logger takes a format: this one converts nothing, so no argument follows it.
        unsafe { logger(environment, name, status, category, text) };
    }))
}

/// A format that stands for a text. Masters that do not expand formats show it nearly as it is.
fn as_format(text: &CStr) -> CString {
    let mut format = Vec::with_capacity(text.count_bytes() + 1);
    for byte in text.to_bytes() {
        format.push(*byte);
        if *byte == b'%' {
            format.push(b'%');
        }
    }
    CString::new(format).unwrap_or_default()
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
    instanceName: *const c_char,
    fmuType: c_int,
    fmuGUID: *const c_char,
    fmuResourceLocation: *const c_char,
    functions: *const CallbackFunctions,
    _visible: c_int,
    loggingOn: c_int,
) -> Component {
    let _environment = Environment::standard();
    let made = || {
        // SAFETY: all are NULL or valid for the call (module contract); the callbacks are copied,
        // because they may be gone afterwards. Bytes that are not UTF-8 cannot be right anywhere
        // and are treated like a missing text.
        unsafe {
            let read = |name, data| text(name, data).unwrap_or_default();
            let name = read("instanceName", instanceName).unwrap_or_default();
            let sink = functions.as_ref().map(|callbacks| {
                let name = CString::new(name).unwrap_or_default();
                sink(*callbacks, name)
            });
            let request = Request {
                name,
                co_simulation: fmuType == CO_SIMULATION,
                guid: read("fmuGUID", fmuGUID).unwrap_or_default(),
                // What cannot be read is no URI either.
                location: text("fmuResourceLocation", fmuResourceLocation).unwrap_or(Some("?")),
            };
            instantiate(&request, Logger::new(sink?, loggingOn != 0))
        }
    };
    match catch_unwind(made) {
        Ok(Some(instance)) => Box::into_raw(Box::new(instance)).cast(),
        _ => ptr::null_mut(),
    }
}

/// `fmi2FreeInstance`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: Component) {
    if !c.is_null() {
        let _environment = Environment::standard();
        // SAFETY: made by `Box::into_raw` in `fmi2Instantiate` and freed only here.
        let instance = unsafe { Box::from_raw(c.cast::<Instance>()) };
        // After a defect the instance may be half-changed, and dropping it may panic as well.
        let _ = catch_unwind(AssertUnwindSafe(|| drop(instance)));
    }
}

/// `fmi2SetDebugLogging`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    c: Component,
    loggingOn: c_int,
    nCategories: size_t,
    categories: *const *const c_char,
) -> Status {
    // SAFETY: module contract, for all three.
    unsafe {
        guard(c, InterfaceFunction::SetDebugLogging.call(), |instance| {
            let category = |data: &*const c_char| {
                text("categories", *data)?.ok_or(Fault::Pointer("categories"))
            };
            let names = lent("categories", categories, nCategories)?
                .iter()
                .map(category);
            instance.set_debug_logging(loggingOn != 0, names)
        })
    }
}

/// `fmi2SetupExperiment`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    c: Component,
    toleranceDefined: c_int,
    tolerance: f64,
    startTime: f64,
    stopTimeDefined: c_int,
    stopTime: f64,
) -> Status {
    let tolerance = (toleranceDefined != 0).then_some(tolerance);
    let stop = (stopTimeDefined != 0).then_some(stopTime);
    let body = |instance: &mut Instance| instance.set_up_experiment(tolerance, startTime, stop);
    // SAFETY: module contract.
    unsafe { guard(c, InterfaceFunction::SetupExperiment.call(), body) }
}

/// Functions that take nothing but the instance.
macro_rules! transitions {
    ($($name:ident: $function:ident, $body:expr;)*) => {$(
        #[doc = concat!("`", stringify!($name), "`.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(c: Component) -> Status {
            // SAFETY: module contract.
            unsafe { guard(c, InterfaceFunction::$function.call(), $body) }
        }
    )*};
}

transitions! {
    fmi2EnterInitializationMode: EnterInitializationMode, Instance::enter_initialization_mode;
    fmi2ExitInitializationMode: ExitInitializationMode, Instance::exit_initialization_mode;
    fmi2Terminate: Terminate, Instance::terminate;
    fmi2Reset: Reset, Instance::reset;
    fmi2CancelStep: CancelStep, |_| Ok(());
}

/// Functions that read or set variables of one type.
macro_rules! accessors {
    ($($name:ident: $function:ident, $pointer:ty, $lent:ident -> $slice:ty, $body:expr;)*) => {$(
        #[doc = concat!("`", stringify!($name), "`.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            c: Component,
            vr: *const c_uint,
            nvr: size_t,
            value: $pointer,
        ) -> Status {
            let body: fn(&mut Instance, &[u32], $slice) -> _ = $body;
            // SAFETY: module contract, for both arrays and the instance.
            unsafe {
                let (vr, value) = (lent("vr", vr, nvr), $lent("value", value, nvr));
                guard(c, InterfaceFunction::$function.call(), |instance| body(instance, vr?, value?))
            }
        }
    )*};
}

accessors! {
    fmi2GetReal: GetReal, *mut f64, lent_mut -> &mut [MaybeUninit<f64>], Instance::get_real;
    fmi2GetInteger: GetInteger, *mut c_int, lent_mut -> &mut [MaybeUninit<c_int>],
        Instance::get_integer;
    fmi2GetBoolean: GetBoolean, *mut c_int, lent_mut -> &mut [MaybeUninit<c_int>],
        |instance, vr, _| instance.no_such_type(vr, "Boolean");
    fmi2GetString: GetString, *mut *const c_char, lent_mut -> &mut [MaybeUninit<*const c_char>],
        |instance, vr, _| instance.no_such_type(vr, "String");
    fmi2SetReal: SetReal, *const f64, lent -> &[f64], Instance::set_real;
    fmi2SetInteger: SetInteger, *const c_int, lent -> &[c_int], Instance::set_integer;
    fmi2SetBoolean: SetBoolean, *const c_int, lent -> &[c_int],
        |instance, vr, _| instance.no_such_type(vr, "Boolean");
    fmi2SetString: SetString, *const *const c_char, lent -> &[*const c_char],
        |instance, vr, _| instance.no_such_type(vr, "String");
}

/// `fmi2GetFMUstate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: Component, FMUstate: *mut FmuState) -> Status {
    // SAFETY: module contract; `*FMUstate` is NULL or a state of this library, which is reused.
    unsafe {
        guard(c, InterfaceFunction::GetFMUstate.call(), |instance| {
            let place = FMUstate.as_mut().ok_or(Fault::Pointer("FMUstate"))?;
            let state = instance.save();
            match place.cast::<SavedState>().as_mut() {
                Some(old) => *old = state,
                None => *place = Box::into_raw(Box::new(state)).cast(),
            }
            Ok(())
        })
    }
}

/// `fmi2SetFMUstate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: Component, FMUstate: FmuState) -> Status {
    // SAFETY: module contract.
    unsafe {
        guard(c, InterfaceFunction::SetFMUstate.call(), |instance| {
            instance.restore(saved("FMUstate", FMUstate)?)
        })
    }
}

/// `fmi2FreeFMUstate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: Component, FMUstate: *mut FmuState) -> Status {
    // SAFETY: module contract; a state was made by `Box::into_raw`, and NULL takes its place.
    unsafe {
        guard(c, InterfaceFunction::FreeFMUstate.call(), |_| {
            if let Some(place) = FMUstate.as_mut()
                && !place.is_null()
            {
                drop(Box::from_raw(place.cast::<SavedState>()));
                *place = ptr::null_mut();
            }
            Ok(())
        })
    }
}

/// `fmi2SerializedFMUstateSize`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    c: Component,
    FMUstate: FmuState,
    size: *mut size_t,
) -> Status {
    // SAFETY: module contract.
    unsafe {
        guard(c, InterfaceFunction::SerializedFMUstateSize.call(), |_| {
            place("size", size)?.write(saved("FMUstate", FMUstate)?.size());
            Ok(())
        })
    }
}

/// `fmi2SerializeFMUstate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: Component,
    FMUstate: FmuState,
    serializedState: *mut c_char,
    size: size_t,
) -> Status {
    // SAFETY: module contract.
    unsafe {
        guard(c, InterfaceFunction::SerializeFMUstate.call(), |_| {
            let target = lent_mut("serializedState", serializedState.cast::<u8>(), size)?;
            saved("FMUstate", FMUstate)?.write_to(target)
        })
    }
}

/// `fmi2DeSerializeFMUstate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: Component,
    serializedState: *const c_char,
    size: size_t,
    FMUstate: *mut FmuState,
) -> Status {
    // SAFETY: module contract. A state that `*FMUstate` already holds stays the master's to free:
    // the standard speaks of reuse only for `fmi2GetFMUstate`.
    unsafe {
        guard(
            c,
            InterfaceFunction::DeSerializeFMUstate.call(),
            |instance| {
                let place = place("FMUstate", FMUstate)?;
                let bytes = lent("serializedState", serializedState.cast::<u8>(), size)?;
                place.write(Box::into_raw(Box::new(instance.deserialize(bytes)?)).cast());
                Ok(())
            },
        )
    }
}

/// `fmi2GetDirectionalDerivative`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: Component,
    vUnknown_ref: *const c_uint,
    nUnknown: size_t,
    vKnown_ref: *const c_uint,
    nKnown: size_t,
    dvKnown: *const f64,
    dvUnknown: *mut f64,
) -> Status {
    // SAFETY: module contract, for all arrays and the instance.
    unsafe {
        guard(
            c,
            InterfaceFunction::GetDirectionalDerivative.call(),
            |instance| {
                let unknowns = lent("vUnknown_ref", vUnknown_ref, nUnknown)?;
                let knowns = lent("vKnown_ref", vKnown_ref, nKnown)?;
                let seeds = lent("dvKnown", dvKnown, nKnown)?;
                let changes = lent_mut("dvUnknown", dvUnknown, nUnknown)?;
                instance.directional_derivative(knowns, seeds, unknowns, changes)
            },
        )
    }
}

/// Functions for derivatives of variables in time.
macro_rules! derivatives {
    ($($name:ident: $function:ident, $value:ty, $lent:ident, $body:expr;)*) => {$(
        #[doc = concat!("`", stringify!($name), "`.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            c: Component,
            vr: *const c_uint,
            nvr: size_t,
            order: *const c_int,
            value: $value,
        ) -> Status {
            // SAFETY: module contract, for all arrays and the instance.
            unsafe {
                let (vr, order) = (lent("vr", vr, nvr), lent("order", order, nvr));
                let value = $lent("value", value, nvr);
                guard(c, InterfaceFunction::$function.call(), |instance| $body(instance, vr?, order?, value?))
            }
        }
    )*};
}

derivatives! {
    fmi2SetRealInputDerivatives: SetRealInputDerivatives, *const f64, lent,
        Instance::set_input_derivatives;
    fmi2GetRealOutputDerivatives: GetRealOutputDerivatives, *mut f64, lent_mut,
        Instance::get_output_derivatives;
}

/// `fmi2DoStep`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    c: Component,
    currentCommunicationPoint: f64,
    communicationStepSize: f64,
    _noSetFMUStatePriorToCurrentPoint: c_int,
) -> Status {
    let (current, step) = (currentCommunicationPoint, communicationStepSize);
    let body = |instance: &mut Instance| instance.do_step(current, step);
    // SAFETY: module contract.
    unsafe { guard(c, InterfaceFunction::DoStep.call(), body) }
}

/// Functions that ask for a status of one type.
macro_rules! statuses {
    ($($name:ident: $function:ident, $type:ty, $body:expr;)*) => {$(
        #[doc = concat!("`", stringify!($name), "`.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(c: Component, s: c_int, value: *mut $type) -> Status {
            let body: fn(&Instance, c_int) -> Option<$type> = $body;
            // SAFETY: module contract.
            unsafe {
                guard(c, InterfaceFunction::$function.call(), |instance| {
                    let value = place("value", value)?;
                    value.write(body(instance, s).ok_or(NO_STATUS)?);
                    Ok(())
                })
            }
        }
    )*};
}

statuses! {
    fmi2GetStatus: GetStatus, Status, |_, _| None;
    fmi2GetRealStatus: GetRealStatus, f64,
        |instance, s| (s == LAST_SUCCESSFUL_TIME).then(|| instance.last_successful_time());
    fmi2GetIntegerStatus: GetIntegerStatus, c_int, |_, _| None;
    fmi2GetBooleanStatus: GetBooleanStatus, c_int, |_, s| (s == TERMINATED).then_some(0);
    fmi2GetStringStatus: GetStringStatus, *const c_char, |_, _| None;
}
