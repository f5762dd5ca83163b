//! A small master: a scene on disk, an instance of it, and a record of what it logs.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::fs;
use std::mem::transmute;
use std::path::{Path, PathBuf};
use std::ptr;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};

pub use flexbody::fmi::{InstanceState, Status};
use flexbody::fmi2::abi::{CallbackFunctions, Component, FmuState, LoggerCallback};
use flexbody::scene::{Scene, beside};
use flexbody::simulation::{Variable, variables};

/// Calls a function of the interface.
macro_rules! call {
    ($name:ident $(, $argument:expr)* $(,)?) => {
        // SAFETY: a test passes what a master may pass: NULL, live instances and states, and
        // arrays that are as long as it says.
        unsafe { flexbody::fmi2::abi::$name($($argument),*) }
    };
}
pub(crate) use call;

/// `fmi2CoSimulation`.
pub const CO_SIMULATION: c_int = 1;

/// A coarse pendulum with a load inside, so that one element is too few.
pub const SCENE: &str = include_str!("scene.json");

static FOLDERS: AtomicU32 = AtomicU32::new(0);

/// An unpacked unit: a directory that holds the scene and goes when dropped.
pub struct Unit {
    folder: PathBuf,
    pub guid: CString,
    pub location: CString,
    pub variables: Vec<Variable>,
}

impl Unit {
    /// The unit of a scene.
    pub fn of(scene: &str) -> Self {
        Self::with(scene, &[])
    }

    /// The unit of a scene that names these files: names and contents.
    pub fn with(scene: &str, files: &[(&str, &[u8])]) -> Self {
        let number = FOLDERS.fetch_add(1, Ordering::Relaxed);
        let name = format!("flexbody-abi-{}-{number}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        fs::create_dir_all(&folder).expect("a writable temporary directory");
        let scenes = [("scene.json", scene.as_bytes())];
        for (name, bytes) in scenes.iter().chain(files) {
            fs::write(folder.join(name), bytes).expect("a writable temporary directory");
        }
        Self::at(folder, scene)
    }

    /// The unit of a scene in a folder that holds it.
    pub fn at(folder: PathBuf, scene: &str) -> Self {
        let scene = Scene::from_json_with(scene, &beside(&folder)).expect("a valid scene");
        let variables = variables(&scene);
        let guid = flexbody::fmi::guid(&scene, &variables);
        let location = format!("file://{}", folder.display());
        Self {
            folder,
            guid: text(&guid),
            location: text(&location),
            variables,
        }
    }

    /// The unit of [`SCENE`].
    pub fn new() -> Self {
        Self::of(SCENE)
    }

    /// The directory `resources`.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Replaces the scene file.
    pub fn overwrite(&self, scene: &[u8]) {
        fs::write(self.folder.join("scene.json"), scene).expect("a writable directory");
    }

    /// Value reference of a variable.
    pub fn reference(&self, name: &str) -> u32 {
        let index = self
            .variables
            .iter()
            .position(|variable| variable.name == name);
        u32::try_from(index.expect(name)).expect("few variables")
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// A C string.
pub fn text(text: &str) -> CString {
    CString::new(text).expect("no NUL inside")
}

/// Line that the logger received: instance name, status, category, message.
pub type Line = (String, Status, String, String);

/// A record of messages; its address is the component environment.
#[derive(Default)]
pub struct Record(Mutex<Vec<Line>>);

impl Record {
    /// Takes all messages so far.
    pub fn take(&self) -> Vec<Line> {
        std::mem::take(&mut *self.0.lock().expect("no panic while locked"))
    }

    /// Takes the text of the last message.
    pub fn last(&self) -> String {
        self.take().pop().map_or(String::new(), |line| line.3)
    }

    /// Callbacks that write into this record.
    pub fn callbacks(&self) -> CallbackFunctions {
        CallbackFunctions {
            logger: Some(variadic(log)),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: ptr::from_ref(self).cast_mut().cast(),
        }
    }
}

type FixedLogger =
    unsafe extern "C" fn(*mut c_void, *const c_char, Status, *const c_char, *const c_char);

fn variadic(logger: FixedLogger) -> LoggerCallback {
    // SAFETY: where these tests run, a variadic call passes five pointer-sized arguments as a fixed
    // one does; stable Rust cannot define a variadic function.
    unsafe { transmute::<FixedLogger, LoggerCallback>(logger) }
}

unsafe extern "C" fn log(
    environment: *mut c_void,
    name: *const c_char,
    status: Status,
    category: *const c_char,
    format: *const c_char,
) {
    // SAFETY: the environment is a record that outlives its instances, the rest are C strings.
    let (record, [name, category, format]) = unsafe {
        let texts = [name, category, format];
        (
            &*environment.cast::<Record>(),
            texts.map(|text| CStr::from_ptr(text)),
        )
    };
    let [name, category, format] = [name, category, format].map(|t| t.to_str().expect("UTF-8"));
    let message = printed(format);
    let line = (name.into(), status, category.into(), message);
    record.0.lock().expect("no panic while locked").push(line);
}

/// What `printf` makes of a format that has no arguments: a conversion would read what is not there.
fn printed(format: &str) -> String {
    let plain = format.replace("%%", "");
    assert!(
        !plain.contains('%'),
        "a message must convert nothing: {format}"
    );
    format.replace("%%", "%")
}

/// An instance, freed when dropped.
pub struct Instance<'a> {
    pub unit: &'a Unit,
    pub record: Box<Record>,
    pub component: Component,
}

// An instance may be used from another thread than the one that made it.
// SAFETY: the component is a pointer to data that this struct owns alone.
unsafe impl Send for Instance<'_> {}

impl<'a> Instance<'a> {
    /// An instance with logging on.
    pub fn new(unit: &'a Unit) -> Self {
        Self::with_logging(unit, true)
    }

    /// An instance with logging on or off.
    pub fn with_logging(unit: &'a Unit, on: bool) -> Self {
        Self::made(unit, unit.location.as_ptr(), on)
    }

    /// An instance without resources, which only a saved state brings to life.
    pub fn bare(unit: &'a Unit) -> Self {
        Self::made(unit, ptr::null(), true)
    }

    /// The callbacks are gone when this returns.
    fn made(unit: &'a Unit, location: *const c_char, on: bool) -> Self {
        let record = Box::<Record>::default();
        let mut callbacks = Box::new(record.callbacks());
        let component = call!(
            fmi2Instantiate,
            c"instance".as_ptr(),
            CO_SIMULATION,
            unit.guid.as_ptr(),
            location,
            ptr::from_ref(&*callbacks),
            0,
            c_int::from(on),
        );
        // A master may reuse the memory; whoever still reads it crashes.
        callbacks.logger = None;
        callbacks.component_environment = ptr::null_mut();
        assert!(!component.is_null(), "{:?}", record.take());
        record.take();
        Self {
            unit,
            record,
            component,
        }
    }

    /// An instance at its first communication point.
    pub fn started(unit: &'a Unit) -> Self {
        let instance = Self::new(unit);
        instance.start();
        instance
    }

    /// From instantiated to the first communication point.
    pub fn start(&self) {
        let c = self.component;
        assert_eq!(
            call!(fmi2SetupExperiment, c, 0, 0.0, 0.0, 0, 0.0),
            Status::Ok
        );
        assert_eq!(
            call!(fmi2EnterInitializationMode, c),
            Status::Ok,
            "{}",
            self.record.last()
        );
        assert_eq!(
            call!(fmi2ExitInitializationMode, c),
            Status::Ok,
            "{}",
            self.record.last()
        );
    }

    /// An instance in a state.
    pub fn in_state(unit: &'a Unit, state: InstanceState) -> Self {
        let instance = match state {
            InstanceState::Bare => Self::bare(unit),
            _ => Self::new(unit),
        };
        let c = instance.component;
        match state {
            InstanceState::Instantiated | InstanceState::Bare => {}
            InstanceState::Initialization => {
                assert_eq!(call!(fmi2EnterInitializationMode, c), Status::Ok);
            }
            InstanceState::StepComplete => instance.start(),
            InstanceState::StepFailed => {
                instance.start();
                assert_eq!(instance.set("rod.tip.force[1]", 1e300), Status::Ok);
                assert_eq!(instance.step(0.0, 0.1), Status::Discard);
            }
            InstanceState::Terminated => {
                instance.start();
                assert_eq!(call!(fmi2Terminate, c), Status::Ok);
            }
            InstanceState::Error => {
                assert_eq!(instance.set_elements(1), Status::Ok);
                assert_eq!(call!(fmi2EnterInitializationMode, c), Status::Error);
            }
            InstanceState::Fatal => unreachable!("only a defect of the library leads there"),
        }
        instance.record.take();
        instance
    }

    pub fn set(&self, name: &str, value: f64) -> Status {
        call!(
            fmi2SetReal,
            self.component,
            &self.unit.reference(name),
            1,
            &value
        )
    }

    pub fn set_elements(&self, value: c_int) -> Status {
        let reference = self.unit.reference("rod.elements");
        call!(fmi2SetInteger, self.component, &reference, 1, &value)
    }

    pub fn get(&self, name: &str) -> f64 {
        let mut value = f64::NAN;
        let reference = self.unit.reference(name);
        let status = call!(fmi2GetReal, self.component, &reference, 1, &mut value);
        assert_eq!(status, Status::Ok, "{name}: {}", self.record.last());
        value
    }

    pub fn step(&self, time: f64, step: f64) -> Status {
        call!(fmi2DoStep, self.component, time, step, 0)
    }

    /// The bits of all outputs.
    pub fn outputs(&self) -> Vec<u64> {
        let is_output = |v: &&Variable| v.start.is_none();
        let names = self.unit.variables.iter().filter(is_output);
        names
            .map(|variable| self.get(&variable.name).to_bits())
            .collect()
    }

    /// The bits of all outputs after each of some steps of 20 ms.
    pub fn run(&self, from: u32, to: u32) -> Vec<Vec<u64>> {
        let step = |number| {
            let time = 0.02 * f64::from(number);
            assert_eq!(self.step(time, 0.02), Status::Ok, "{}", self.record.last());
            self.outputs()
        };
        (from..to).map(step).collect()
    }

    pub fn save(&self) -> FmuState {
        let mut state = ptr::null_mut();
        assert_eq!(
            call!(fmi2GetFMUstate, self.component, &mut state),
            Status::Ok
        );
        state
    }

    pub fn restore(&self, state: FmuState) -> Status {
        call!(fmi2SetFMUstate, self.component, state)
    }

    pub fn free(&self, mut state: FmuState) {
        assert_eq!(
            call!(fmi2FreeFMUstate, self.component, &mut state),
            Status::Ok
        );
        assert!(state.is_null());
    }

    pub fn serialize(&self, state: FmuState) -> Vec<u8> {
        let mut size = 0;
        let c = self.component;
        assert_eq!(
            call!(fmi2SerializedFMUstateSize, c, state, &mut size),
            Status::Ok
        );
        let mut bytes = vec![0; size];
        let target = bytes.as_mut_ptr().cast();
        assert_eq!(
            call!(fmi2SerializeFMUstate, c, state, target, size),
            Status::Ok
        );
        bytes
    }

    pub fn deserialize(&self, bytes: &[u8]) -> Option<FmuState> {
        let mut state = ptr::null_mut();
        let (data, size) = (bytes.as_ptr().cast(), bytes.len());
        match call!(
            fmi2DeSerializeFMUstate,
            self.component,
            data,
            size,
            &mut state
        ) {
            Status::Ok => Some(state),
            status => {
                assert_eq!((status, state.is_null()), (Status::Error, true));
                None
            }
        }
    }

    /// Everything that the instance is, as bytes.
    pub fn fingerprint(&self) -> Vec<u8> {
        let state = self.save();
        let bytes = self.serialize(state);
        self.free(state);
        bytes
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        call!(fmi2FreeInstance, self.component);
    }
}
