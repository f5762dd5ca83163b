//! The library in the process of another: whatever floating-point environment and however little
//! stack a thread of the master has, results are the same, and nothing is left changed.

use std::ptr;

use crate::support::{CO_SIMULATION, Record, SCENE, Status, Unit, call};

/// Rigid bodies, joints with friction of their own, a spring and a cable.
const MECHANISM: &str = include_str!("../fmpy/mechanism.json");
/// Communication points; computed by the compiler, because under traps a test must not compute.
const TIMES: [(f64, f64); 4] = [(0.0, 0.01), (0.01, 0.01), (0.02, 0.01), (0.03, 0.01)];

/// A whole life, each call made by `on`; returns the bits of all outputs at every point.
fn life(unit: &Unit, on: &mut impl FnMut(&str, &mut dyn FnMut() -> Status)) -> Vec<u64> {
    let record = Record::default();
    let callbacks = record.callbacks();
    let mut c = ptr::null_mut();
    let (guid, place) = (unit.guid.as_ptr(), unit.location.as_ptr());
    on("fmi2Instantiate", &mut || {
        c = call!(
            fmi2Instantiate,
            c"guest".as_ptr(),
            CO_SIMULATION,
            guid,
            place,
            &callbacks,
            0,
            1
        );
        if c.is_null() {
            Status::Error
        } else {
            Status::Ok
        }
    });
    let variables = unit.variables.iter().zip(0_u32..);
    let outputs = variables.filter(|(variable, _)| variable.start.is_none());
    let outputs: Vec<u32> = outputs.map(|(_, reference)| reference).collect();
    let mut values = vec![0.0; outputs.len()];
    let mut bits = Vec::new();
    on("fmi2SetupExperiment", &mut || {
        call!(fmi2SetupExperiment, c, 1, 1e-4, 0.0, 0, 0.0)
    });
    on("fmi2EnterInitializationMode", &mut || {
        call!(fmi2EnterInitializationMode, c)
    });
    on("fmi2ExitInitializationMode", &mut || {
        call!(fmi2ExitInitializationMode, c)
    });
    for (time, step) in TIMES {
        on("fmi2DoStep", &mut || call!(fmi2DoStep, c, time, step, 0));
        let (from, to, count) = (outputs.as_ptr(), values.as_mut_ptr(), outputs.len());
        on("fmi2GetReal", &mut || {
            call!(fmi2GetReal, c, from, count, to)
        });
        bits.extend(values.iter().map(|value| value.to_bits()));
    }
    let mut state = ptr::null_mut();
    on("fmi2GetFMUstate", &mut || {
        call!(fmi2GetFMUstate, c, &mut state)
    });
    on("fmi2SetFMUstate", &mut || call!(fmi2SetFMUstate, c, state));
    on("fmi2FreeFMUstate", &mut || {
        call!(fmi2FreeFMUstate, c, &mut state)
    });
    on("fmi2Terminate", &mut || call!(fmi2Terminate, c));
    on("fmi2Reset", &mut || call!(fmi2Reset, c));
    on("fmi2FreeInstance", &mut || {
        call!(fmi2FreeInstance, c);
        Status::Ok
    });
    bits
}

/// A life with nothing special around it.
fn plain(unit: &Unit) -> Vec<u64> {
    life(unit, &mut |name, call| {
        assert_eq!(call(), Status::Ok, "{name}")
    })
}

/// Processor words of x86-64.
#[cfg(target_arch = "x86_64")]
mod words {
    use std::arch::asm;

    /// MXCSR and the control and status words of x87.
    pub type Words = [u32; 3];
    pub const DEFAULT: Words = [0x1f80, 0x37f, 0];
    /// Name and words of environments that hosts have been seen with.
    pub const MODES: [(&str, Words); 8] = [
        ("all traps", [0x0000, 0x340, 0]),
        (
            "traps on invalid, division and overflow",
            [0x1900, 0x372, 0],
        ),
        ("all flags raised", [0x1fbf, 0x37f, 0x3f]),
        ("down", [0x3f80, 0x77f, 0]),
        ("up", [0x5f80, 0xb7f, 0]),
        ("toward zero", [0x7f80, 0xf7f, 0]),
        ("subnormal numbers are zero", [0x9fc0, 0x37f, 0]),
        (
            "x87 of 53 bits, traps, flags of the harmless",
            [0x1920, 0x272, 0x20],
        ),
    ];

    /// Sets all words.
    #[inline(never)]
    pub fn write([sse, control, status]: Words) {
        let mut environment = [0_u32; 7];
        let (stored, loaded) = (&raw mut environment, &raw const environment);
        // SAFETY: stores 28 bytes at an address that is valid for them.
        unsafe { asm!("fnstenv [{0}]", in(reg) stored) };
        environment[..2].copy_from_slice(&[control, status]);
        // SAFETY: valid words; what a trap does to the process is what the test is about.
        unsafe { asm!("fldenv [{0}]", "ldmxcsr [{1}]", in(reg) loaded, in(reg) &raw const sse) };
    }

    /// Reads all words.
    #[inline(never)]
    pub fn read() -> Words {
        let (mut sse, mut control, mut status) = (0_u32, 0_u16, 0_u16);
        // SAFETY: each stores a word at an address that is valid for it.
        unsafe {
            asm!("stmxcsr [{0}]", "fnstcw [{1}]", "fnstsw [{2}]",
                in(reg) &raw mut sse, in(reg) &raw mut control, in(reg) &raw mut status);
        }
        [sse, u32::from(control), u32::from(status) & 0x7f]
    }
}

/// Processor words of 64-bit ARM.
#[cfg(target_arch = "aarch64")]
mod words {
    use std::arch::asm;

    /// FPCR and FPSR.
    pub type Words = [u64; 2];
    pub const DEFAULT: Words = [0, 0];
    /// Many processors have no traps.
    pub const MODES: [(&str, Words); 5] = [
        ("all flags raised", [0, 0x9f]),
        ("up", [1 << 22, 0]),
        ("down", [2 << 22, 0]),
        ("toward zero", [3 << 22, 0]),
        ("subnormal numbers are zero", [1 << 24, 0]),
    ];

    /// Sets both words.
    #[inline(never)]
    pub fn write([control, status]: Words) {
        // SAFETY: valid words.
        unsafe { asm!("msr fpcr, {0}", "msr fpsr, {1}", in(reg) control, in(reg) status) };
    }

    /// Reads both words.
    #[inline(never)]
    pub fn read() -> Words {
        let (control, status): (u64, u64);
        // SAFETY: registers that every thread may read.
        unsafe { asm!("mrs {0}, fpcr", "mrs {1}, fpsr", out(reg) control, out(reg) status) };
        [control, status]
    }
}

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
#[test]
fn any_floating_point_environment_gives_the_same_bits_and_is_left_as_it_was() {
    for scene in [SCENE, MECHANISM] {
        let unit = Unit::of(scene);
        let expected = plain(&unit);
        for (mode, words) in words::MODES {
            let found = life(&unit, &mut |name, call| {
                words::write(words);
                let status = call();
                let left = words::read();
                words::write(words::DEFAULT);
                assert_eq!((status, left), (Status::Ok, words), "{name}, {mode}");
            });
            assert_eq!(found, expected, "{mode}");
        }
    }
}

/// A stack that suffices. In a process that has had a larger one before, the system may give that again in place of a smaller one: sizes
/// below the largest of these tests would not be seen to fail.
const STACK: usize = 256 << 10;

fn suffices(scene: &str) {
    let unit = Unit::of(scene);
    let expected = plain(&unit);
    let found = std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK);
        let thread = thread.spawn_scoped(scope, || plain(&unit));
        thread.expect("a thread").join().expect("a whole life")
    });
    assert_eq!(found, expected);
}

#[test]
fn a_small_stack_suffices() {
    for scene in [SCENE, MECHANISM] {
        suffices(scene);
    }
}

#[test]
fn a_quarter_of_a_megabyte_suffices_for_every_kind_of_body() {
    for element in ["cable", "rod", "beam"] {
        let mut scene = serde_json::json!({"name": "falling", "dimension": 3, "gravity": [0, 0, -9.81],
            "bodies": [
                {"name": "line", "element": element, "elements": 2,
                 "material": {"youngs_modulus": 1e9, "shear_modulus": 4e8, "density": 1200},
                 "section": {"shape": {"circle": {"radius": 0.01}}},
                 "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"a": 0.0, "b": 1.0}},
                {"name": "bob", "element": "rigid", "mass": 0.1, "inertia": [1e-4, 1e-4, 1e-4], "position": [1, 0, 0],
                 "markers": {"c": [0, 0, 0]}}],
            "joints": [{"name": "wall", "kind": "spherical", "markers": ["ground", "line.a"]},
                       {"name": "tip", "kind": "spherical", "markers": ["line.b", "bob.c"]}],
            "loads": [{"name": "floor", "kind": "contact", "body": "line", "stiffness": 1e4,
                       "surface": {"plane": {"point": [0, 0, -1e-3], "normal": [0, 0, 1]}}}],
            "outputs": [{"kind": "position", "marker": "line.b"}, {"kind": "energy"}, {"kind": "reaction", "joint": "tip"}],
            "experiment": {"stop_time": 0.04, "step": 0.01}});
        if element == "cable" {
            let material = scene["bodies"][0]["material"].as_object_mut();
            material.expect("a material").remove("shear_modulus");
        }
        suffices(&scene.to_string());
    }
}
