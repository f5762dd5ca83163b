//! Where this library is, as the system that loaded it says.
//!
//! # Safety
//! The system's functions get the address of a function of this library and a place for what they answer.

use std::path::PathBuf;

/// The file of this library; nothing where the system does not know.
#[cfg(unix)]
pub fn own_place() -> Option<PathBuf> {
    use std::ffi::{CStr, OsStr};
    use std::mem::MaybeUninit;
    use std::os::unix::ffi::OsStrExt;

    let mut found = MaybeUninit::<libc::Dl_info>::zeroed();
    // SAFETY: fills the place where it finds the address; the name lives as long as the library.
    unsafe {
        if libc::dladdr(own_place as *const libc::c_void, found.as_mut_ptr()) == 0 {
            return None;
        }
        let name = found.assume_init().dli_fname;
        (!name.is_null()).then(|| OsStr::from_bytes(CStr::from_ptr(name).to_bytes()).into())
    }
}

/// The file of this library; nothing where the system does not know.
#[cfg(windows)]
pub fn own_place() -> Option<PathBuf> {
    use std::ffi::{OsString, c_void};
    use std::os::windows::ffi::OsStringExt;

    /// By an address inside the module, whose count of uses stays.
    const FROM_ADDRESS: u32 = 4 | 2;
    /// Letters of a name at most: on the heap, for stacks are small.
    const LETTERS: u32 = 1 << 15;
    #[link(name = "kernel32")]
    unsafe extern "system" {
        fn GetModuleHandleExW(flags: u32, inside: *const c_void, module: *mut *mut c_void) -> i32;
        fn GetModuleFileNameW(module: *mut c_void, name: *mut u16, size: u32) -> u32;
    }
    let mut name = vec![0; LETTERS as usize];
    let mut module = std::ptr::null_mut();
    let inside = own_place as *const c_void;
    // SAFETY: an address inside a module, a place for its handle, and room for as many letters as stated.
    let length = unsafe {
        match GetModuleHandleExW(FROM_ADDRESS, inside, &mut module) {
            0 => 0,
            _ => GetModuleFileNameW(module, name.as_mut_ptr(), LETTERS),
        }
    };
    let is_whole = 0 < length && length < LETTERS;
    is_whole.then(|| OsString::from_wide(&name[..length as usize]).into())
}

/// The file of this library; nothing where the system does not know.
#[cfg(not(any(unix, windows)))]
pub fn own_place() -> Option<PathBuf> {
    None
}
