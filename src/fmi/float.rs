//! The floating-point environment of the thread that calls: rounding, traps, flushing to zero, flags.
//!
//! A master may have set any of them for its own work. Rust computes with the default alone (rounding to
//! nearest, no traps, subnormal numbers kept), and a flag raised in here is none of the master's.
//!
//! Source: Intel 64 and IA-32 Architectures Software Developer's Manual, volume 1, sections 8.1 and 10.2.3;
//! Arm Architecture Reference Manual for A-profile, FPCR and FPSR.

/// The default environment for as long as this lives; then the one that was found, flags included.
pub struct Environment(words::Words);

impl Environment {
    /// Sets the default.
    pub fn standard() -> Self {
        let found = words::Words::read();
        found.replace_by_default();
        Self(found)
    }
}

impl Drop for Environment {
    fn drop(&mut self) {
        self.0.restore();
    }
}

/// On x86-64 the words of SSE, which computes, and of x87, which some C libraries compute functions with.
/// Writing a word costs more than reading it: what is as it should be is left alone.
#[cfg(target_arch = "x86_64")]
mod words {
    use std::arch::asm;

    /// Control bits of MXCSR by default, and its flags.
    const SSE: u32 = 0x1f80;
    const SSE_FLAGS: u32 = 0x3f;
    /// Control word of x87 by default, and the flags in its status word.
    const X87: u16 = 0x37f;
    const X87_FLAGS: u16 = 0x7f;

    /// Floating-point control and status words of a thread.
    pub struct Words {
        sse: u32,
        control: u16,
        flags: u16,
    }

    impl Words {
        /// Reads all.
        pub fn read() -> Self {
            let (mut sse, mut control, mut status) = (0_u32, 0_u16, 0_u16);
            // SAFETY: each stores one word at an address that is valid for it and changes nothing else.
            unsafe {
                asm!("stmxcsr [{0}]", "fnstcw [{1}]", "fnstsw [{2}]",
                    in(reg) &raw mut sse, in(reg) &raw mut control, in(reg) &raw mut status,
                    options(nostack, preserves_flags));
            }
            let flags = status & X87_FLAGS;
            Self {
                sse,
                control,
                flags,
            }
        }

        /// Sets the control words to their defaults.
        pub fn replace_by_default(&self) {
            if self.sse & !SSE_FLAGS != SSE {
                write_sse(SSE);
            }
            if self.control != X87 {
                // SAFETY: loads a valid control word, with nothing pending that it would let trap.
                unsafe {
                    asm!("fnclex", "fldcw [{0}]", in(reg) &raw const X87_DEFAULT,
                        options(nostack, preserves_flags));
                }
            }
        }

        /// Puts all back.
        pub fn restore(&self) {
            let now = Self::read();
            if now.sse != self.sse {
                write_sse(self.sse);
            }
            if (now.control, now.flags) != (self.control, self.flags) {
                let mut environment = [0_u32; 7];
                let (stored, loaded) = (&raw mut environment, &raw const environment);
                // SAFETY: stores the 28 bytes of the environment at an address that is valid for them.
                unsafe { asm!("fnstenv [{0}]", in(reg) stored, options(nostack, preserves_flags)) };
                let [control, flags] = [self.control, self.flags].map(u32::from);
                let status = environment[1] & !0xff | flags;
                environment[..2].copy_from_slice(&[control, status]);
                // SAFETY: loads what was stored, with a control word and flags that were found.
                unsafe { asm!("fldenv [{0}]", in(reg) loaded, options(nostack, preserves_flags)) };
            }
        }
    }

    static X87_DEFAULT: u16 = X87;

    fn write_sse(word: u32) {
        // SAFETY: the word is the default or was read from the register: no reserved bit is set.
        unsafe {
            asm!("ldmxcsr [{0}]", in(reg) &raw const word, options(nostack, preserves_flags))
        };
    }
}

/// On 64-bit ARM: control (FPCR) and status (FPSR).
#[cfg(target_arch = "aarch64")]
mod words {
    use std::arch::asm;

    /// Floating-point control and status words of a thread.
    pub struct Words {
        control: u64,
        status: u64,
    }

    impl Words {
        /// Reads both.
        pub fn read() -> Self {
            let (control, status);
            // SAFETY: reads two registers that every thread may read.
            unsafe {
                asm!("mrs {0}, fpcr", "mrs {1}, fpsr", out(reg) control, out(reg) status,
                    options(nostack, preserves_flags));
            }
            Self { control, status }
        }

        /// Sets the control register to its default.
        pub fn replace_by_default(&self) {
            if self.control != 0 {
                write(0, self.status);
            }
        }

        /// Puts both back.
        pub fn restore(&self) {
            let now = Self::read();
            if (now.control, now.status) != (self.control, self.status) {
                write(self.control, self.status);
            }
        }
    }

    fn write(control: u64, status: u64) {
        // SAFETY: values that were read from the registers, or zero, their default.
        unsafe {
            asm!("msr fpcr, {0}", "msr fpsr, {1}", in(reg) control, in(reg) status,
                options(nostack, preserves_flags));
        }
    }
}

/// Elsewhere nothing is known.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod words {
    /// Nothing.
    pub struct Words;

    impl Words {
        /// Reads nothing.
        pub fn read() -> Self {
            Self
        }

        /// Changes nothing.
        pub fn replace_by_default(&self) {}

        /// Changes nothing.
        pub fn restore(&self) {}
    }
}
