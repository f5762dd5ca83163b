//! What a master lends for a call, as safe Rust, and the one guard that every call passes.
//!
//! # Safety
//! All functions rely on what the standards ask of a master: pointers are NULL or valid for the call with the stated
//! number of entries; an instance is NULL or came from this library, has not been freed, and is not in another call at
//! the same time; likewise a saved state came from this library.

use std::ffi::{CStr, c_char, c_void};
use std::mem::MaybeUninit;
use std::slice;

use super::float::Environment;
use super::instance::Instance;
use super::lifecycle::Call;
use super::state::SavedState;
use super::status::{Fault, Status};

/// The guard of every function on an instance.
pub unsafe fn guard(
    instance: *mut c_void,
    call: Call,
    body: impl FnOnce(&mut Instance) -> Result<(), Fault>,
) -> Status {
    let _environment = Environment::standard();
    // SAFETY: NULL, or an instance that no other call uses (contract of this file).
    match unsafe { instance.cast::<Instance>().as_mut() } {
        Some(instance) => instance.call(call, body),
        None => Status::Error,
    }
}

/// Whether a pointer may stand for an array of `count` entries.
fn usable<T>(data: *const T, count: usize) -> bool {
    !data.is_null() && count <= isize::MAX as usize / size_of::<T>()
}

/// Borrows an array of the master for reading.
///
/// # Errors
/// [`Fault::Pointer`] for NULL or an impossible count, unless the count is 0.
pub unsafe fn lent<'a, T>(
    name: &'static str,
    data: *const T,
    count: usize,
) -> Result<&'a [T], Fault> {
    match count {
        0 => Ok(&[]),
        _ if !usable(data, count) => Err(Fault::Pointer(name)),
        // SAFETY: not NULL, and valid for `count` entries (contract of this file).
        _ => Ok(unsafe { slice::from_raw_parts(data, count) }),
    }
}

/// Borrows an array of the master for writing. Its values are not initialized.
///
/// # Errors
/// [`Fault::Pointer`] for NULL or an impossible count, unless the count is 0.
pub unsafe fn lent_mut<'a, T>(
    name: &'static str,
    data: *mut T,
    count: usize,
) -> Result<&'a mut [MaybeUninit<T>], Fault> {
    match count {
        0 => Ok(&mut []),
        _ if !usable(data, count) => Err(Fault::Pointer(name)),
        // SAFETY: not NULL, and valid for `count` entries (contract of this file).
        _ => Ok(unsafe { slice::from_raw_parts_mut(data.cast(), count) }),
    }
}

/// Borrows a place of the master for one result.
///
/// # Errors
/// [`Fault::Pointer`] for NULL.
pub unsafe fn place<'a, T>(
    name: &'static str,
    data: *mut T,
) -> Result<&'a mut MaybeUninit<T>, Fault> {
    // SAFETY: NULL, or valid for one value (contract of this file).
    unsafe { data.cast::<MaybeUninit<T>>().as_mut() }.ok_or(Fault::Pointer(name))
}

/// Borrows a text of the master. `None` for NULL.
///
/// # Errors
/// [`Fault::Text`] for bytes that are not UTF-8.
pub unsafe fn text<'a>(name: &'static str, data: *const c_char) -> Result<Option<&'a str>, Fault> {
    if data.is_null() {
        return Ok(None);
    }
    // SAFETY: not NULL, and a C string (contract of this file).
    let bytes = unsafe { CStr::from_ptr(data) };
    bytes.to_str().map(Some).map_err(|_| Fault::Text(name))
}

/// Borrows a saved state that the master holds.
///
/// # Errors
/// [`Fault::Pointer`] for NULL.
pub unsafe fn saved<'a>(name: &'static str, state: *mut c_void) -> Result<&'a SavedState, Fault> {
    // SAFETY: NULL, or a state of this library (contract of this file).
    unsafe { state.cast::<SavedState>().as_ref() }.ok_or(Fault::Pointer(name))
}
