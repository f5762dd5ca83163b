//! A small master: calls the C interface of a unit as any master does. The only unsafe code here.

use std::ffi::CString;
use std::path::PathBuf;
use std::ptr;

use flexbody::fmi::{Status, guid};
use flexbody::fmi2::abi::{self, CallbackFunctions, Component, FmuState};
use flexbody::scene::Scene;
use flexbody::simulation::{Source, variables};

/// `fmi2CoSimulation`.
const CO_SIMULATION: i32 = 1;

/// A unit unpacked on disk: a folder that holds the scene and goes when dropped.
pub struct Unit {
    folder: PathBuf,
    guid: CString,
    location: CString,
    /// Value references of inputs.
    pub inputs: Vec<u32>,
    /// Value references of outputs.
    pub outputs: Vec<u32>,
}

impl Unit {
    /// Writes a scene to the resources of an instance.
    ///
    /// # Errors
    /// A folder or file that cannot be written, in words.
    pub fn new(scene: &Scene) -> Result<Self, String> {
        let folder = std::env::temp_dir().join(format!("flexbody-studies-{}", std::process::id()));
        let in_folder = |error| format!("{}: {error}", folder.display());
        std::fs::create_dir_all(&folder).map_err(in_folder)?;
        std::fs::write(folder.join("scene.json"), scene.to_json()).map_err(in_folder)?;
        let variables = variables(scene);
        let references = |wanted: fn(&Source) -> bool| {
            let numbered = (0_u32..).zip(&variables);
            let chosen = numbered.filter(|(_, variable)| wanted(&variable.source));
            chosen.map(|(reference, _)| reference).collect()
        };
        let text = |text: String| CString::new(text).map_err(|error| error.to_string());
        Ok(Self {
            guid: text(guid(scene, &variables))?,
            location: text(format!("file://{}", folder.display()))?,
            inputs: references(|source| matches!(source, Source::Input(..))),
            outputs: references(|source| matches!(source, Source::Output(_))),
            folder,
        })
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        // What is left in the temporary folder does no harm.
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

/// Calls a function of the interface; what it answers unless that is `fmi2OK`.
macro_rules! call {
    ($name:ident $(, $argument:expr)* $(,)?) => {{
        // SAFETY: live instances and states, and arrays as long as stated.
        match unsafe { abi::$name($($argument),*) } {
            Status::Ok => Ok(()),
            status => Err(format!("{}: {status:?}", stringify!($name))),
        }
    }};
}

/// An instance, freed when dropped.
pub struct Instance {
    component: Component,
    state: FmuState,
}

impl Instance {
    /// Calls `fmi2Instantiate`.
    ///
    /// # Errors
    /// The call is refused.
    pub fn new(unit: &Unit) -> Result<Self, String> {
        let callbacks = CallbackFunctions {
            logger: None,
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: ptr::null_mut(),
        };
        // SAFETY: texts and callbacks live through the call.
        let component = unsafe {
            abi::fmi2Instantiate(
                c"studies".as_ptr(),
                CO_SIMULATION,
                unit.guid.as_ptr(),
                unit.location.as_ptr(),
                &raw const callbacks,
                0,
                0,
            )
        };
        if component.is_null() {
            return Err("fmi2Instantiate: expected an instance, found none".into());
        }
        Ok(Self {
            component,
            state: ptr::null_mut(),
        })
    }

    /// Calls `fmi2SetupExperiment`, from time 0.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn set_up(&self) -> Result<(), String> {
        call!(fmi2SetupExperiment, self.component, 0, 0.0, 0.0, 0, 0.0)
    }

    /// Calls `fmi2EnterInitializationMode`.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn enter(&self) -> Result<(), String> {
        call!(fmi2EnterInitializationMode, self.component)
    }

    /// Calls `fmi2ExitInitializationMode`.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn exit(&self) -> Result<(), String> {
        call!(fmi2ExitInitializationMode, self.component)
    }

    /// Calls `fmi2DoStep`.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn step(&self, time: f64, step: f64) -> Result<(), String> {
        call!(fmi2DoStep, self.component, time, step, 0)
    }

    /// Calls `fmi2SetReal`.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn set(&self, references: &[u32], values: &[f64]) -> Result<(), String> {
        let (count, values) = (references.len().min(values.len()), values.as_ptr());
        call!(
            fmi2SetReal,
            self.component,
            references.as_ptr(),
            count,
            values
        )
    }

    /// Calls `fmi2GetReal`.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn get(&self, references: &[u32], values: &mut [f64]) -> Result<(), String> {
        let (count, values) = (references.len().min(values.len()), values.as_mut_ptr());
        call!(
            fmi2GetReal,
            self.component,
            references.as_ptr(),
            count,
            values
        )
    }

    /// Calls `fmi2GetFMUstate`, into one state every time.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn save(&mut self) -> Result<(), String> {
        call!(fmi2GetFMUstate, self.component, &raw mut self.state)
    }

    /// Calls `fmi2SetFMUstate` with the state saved last.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn restore(&mut self) -> Result<(), String> {
        call!(fmi2SetFMUstate, self.component, self.state)
    }

    /// Calls `fmi2SerializeFMUstate` with the state saved last. `bytes` takes its size.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn serialize(&self, bytes: &mut Vec<u8>) -> Result<(), String> {
        let mut size = 0;
        call!(
            fmi2SerializedFMUstateSize,
            self.component,
            self.state,
            &raw mut size
        )?;
        bytes.resize(size, 0);
        let target = bytes.as_mut_ptr().cast();
        call!(
            fmi2SerializeFMUstate,
            self.component,
            self.state,
            target,
            size
        )
    }

    /// Calls `fmi2DeSerializeFMUstate`, in place of the state saved last.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn deserialize(&mut self, bytes: &[u8]) -> Result<(), String> {
        call!(fmi2FreeFMUstate, self.component, &raw mut self.state)?;
        call!(
            fmi2DeSerializeFMUstate,
            self.component,
            bytes.as_ptr().cast(),
            bytes.len(),
            &raw mut self.state
        )
    }

    /// Calls `fmi2GetRealOutputDerivatives` for one order.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn derivatives(
        &self,
        references: &[u32],
        order: i32,
        values: &mut [f64],
    ) -> Result<(), String> {
        let (orders, count) = (
            vec![order; references.len()],
            references.len().min(values.len()),
        );
        call!(
            fmi2GetRealOutputDerivatives,
            self.component,
            references.as_ptr(),
            count,
            orders.as_ptr(),
            values.as_mut_ptr()
        )
    }

    /// Calls `fmi2GetDirectionalDerivative` for outputs by one input.
    ///
    /// # Errors
    /// The call is not answered with `fmi2OK`.
    pub fn directional(
        &self,
        outputs: &[u32],
        input: u32,
        values: &mut [f64],
    ) -> Result<(), String> {
        call!(
            fmi2GetDirectionalDerivative,
            self.component,
            outputs.as_ptr(),
            outputs.len().min(values.len()),
            &raw const input,
            1,
            [1.0].as_ptr(),
            values.as_mut_ptr()
        )
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // A state that was never saved is NULL, which both functions take.
        let _ = call!(fmi2FreeFMUstate, self.component, &raw mut self.state);
        // SAFETY: made by `fmi2Instantiate` and freed only here.
        unsafe { abi::fmi2FreeInstance(self.component) };
    }
}
