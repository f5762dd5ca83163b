//! Messages to the master's logger: filtered by category. When logging is off only errors are passed on.
//!
//! Source: FMI 2.0.4, section 2.1.3 (`fmi2Error`: the logger was called with the reason) and section 2.1.5 (`loggingOn` is about debug
//! messages).

use std::ffi::{CStr, CString};
use std::fmt;

use super::status::{Fault, Status};

/// Where messages go: status, category, text. Built by the ABI around the master's callback.
pub type Sink = Box<dyn Fn(Status, &CStr, &CStr) + Send>;

/// Categories of messages, one bit each; the model description lists them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Category {
    /// Refused calls and failed computations.
    Error = 1,
    /// Steps that were done only in part.
    Warning = 2,
    /// Course of a simulation.
    Events = 4,
    /// Work of the solver.
    Solver = 8,
}

impl Category {
    /// All categories, in the order of the model description.
    pub const ALL: [Self; 4] = [Self::Error, Self::Warning, Self::Events, Self::Solver];

    /// Name in the model description.
    pub fn name(self) -> &'static CStr {
        match self {
            Self::Error => c"logStatusError",
            Self::Warning => c"logStatusWarning",
            Self::Events => c"logEvents",
            Self::Solver => c"logSolver",
        }
    }

    /// Description in the model description.
    pub fn description(self) -> &'static str {
        match self {
            Self::Error => "Calls that were refused and computations that failed, with the reason",
            Self::Warning => {
                "Steps that were done only in part, outputs that the tolerance does not reach, singular positions, and \
                 statuses that do not exist"
            }
            Self::Events => "Course of the simulation: initialization, reset, restored states, end",
            Self::Solver => {
                "Each communication step: method, steps, rejected steps, Newton iterations"
            }
        }
    }
}

const ALL: u8 = 15;
/// Categories that are passed on when logging is off: the reasons of `Error` and `Fatal`, which are no debug messages.
const OFF: u8 = Category::Error as u8;

/// The logger of one instance.
pub struct Logger {
    sink: Option<Sink>,
    enabled: u8,
}

impl Logger {
    /// A logger for `sink`, with all categories or errors alone. A master without a logger gives no sink.
    pub fn new(sink: Option<Sink>, on: bool) -> Self {
        let enabled = if on { ALL } else { OFF };
        Self { sink, enabled }
    }

    /// Enables only the named categories, all when none is named or `logAll` is, errors alone when off. Categories that
    /// are not there are passed over.
    ///
    /// # Errors
    /// The categories that are not there; what is no text, of which nothing changes.
    pub fn enable<'a>(
        &mut self,
        on: bool,
        categories: impl Iterator<Item = Result<&'a str, Fault>>,
    ) -> Result<(), Fault> {
        let (mut named, mut unknown) = (0, Vec::new());
        for name in categories {
            let name = name?;
            let known = |category: &Category| category.name().to_bytes() == name.as_bytes();
            match Category::ALL.into_iter().find(known) {
                Some(category) => named |= category as u8,
                // The standard knows it for all.
                None if name == "logAll" => named = ALL,
                None => unknown.push(name),
            }
        }
        self.enabled = match (on, named) {
            (false, _) => OFF,
            (true, 0) if unknown.is_empty() => ALL,
            (true, _) => named,
        };
        if unknown.is_empty() {
            Ok(())
        } else {
            Err(Fault::Category(unknown.join("\", \"")))
        }
    }

    /// Passes a message on, if its category is enabled. Formats nothing otherwise, so that a
    /// silent step does not allocate.
    pub fn log(&self, status: Status, category: Category, message: fmt::Arguments<'_>) {
        if self.enabled & category as u8 != 0 {
            self.report(status, category, message);
        }
    }

    /// Passes a message on even when logging is off: where no instance could be made, for which the standard promises
    /// the reason, and where logging itself could not be set as asked.
    pub fn report(&self, status: Status, category: Category, message: fmt::Arguments<'_>) {
        let Some(sink) = &self.sink else { return };
        // In a message `#` introduces a value reference; NUL would end it.
        let text = message.to_string().replace('#', "##").replace('\0', " ");
        sink(
            status,
            category.name(),
            &CString::new(text).unwrap_or_default(),
        );
    }

    /// Logs why a call is not answered with OK.
    pub fn fault(&self, function: &str, fault: &Fault) {
        let category = match fault.status() {
            Status::Discard | Status::Warning => Category::Warning,
            _ => Category::Error,
        };
        let message = format_args!("{function}: {fault}");
        match fault {
            Fault::Category(_) => self.report(fault.status(), category, message),
            _ => self.log(fault.status(), category, message),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::{Arc, Mutex};

    fn recorded(on: bool) -> (Logger, Arc<Mutex<Vec<String>>>) {
        let lines = Arc::new(Mutex::new(Vec::new()));
        let copy = Arc::clone(&lines);
        let sink: Sink = Box::new(move |_, category, text| {
            let line = format!("{}: {}", category.to_string_lossy(), text.to_string_lossy());
            copy.lock().expect("no panic while locked").push(line);
        });
        (Logger::new(Some(sink), on), lines)
    }

    /// An error is no debug message: its reason reaches the log that a master shows by default.
    #[test]
    fn errors_are_told_when_logging_is_off() {
        let (mut logger, lines) = recorded(false);
        for _ in 0..2 {
            logger.fault("call", &Fault::Pointer("vr"));
            logger.fault("call", &Fault::NoAnswer("not yet"));
            logger.fault("call", &Fault::Remark("not stable"));
            let lines = std::mem::take(&mut *lines.lock().expect("no panic"));
            assert_eq!(lines.len(), 1, "{lines:?}");
            assert!(lines[0].starts_with("logStatusError: call: vr"));
            logger.enable(false, std::iter::empty()).expect("off");
        }
        logger
            .enable(true, std::iter::once(Ok("logEvents")))
            .expect("a known category");
        logger.fault("call", &Fault::Pointer("vr"));
        assert!(lines.lock().expect("no panic").is_empty());
    }

    fn say(logger: &Logger) {
        logger.log(Status::Ok, Category::Events, format_args!("100 % of #1\0"));
        logger.log(Status::Ok, Category::Solver, format_args!("ten steps"));
    }

    #[test]
    fn it_is_silent_when_off_and_filters_by_category() {
        let (mut logger, lines) = recorded(false);
        say(&logger);
        assert!(lines.lock().expect("no panic").is_empty());
        logger
            .enable(true, std::iter::once(Ok("logEvents")))
            .expect("a known category");
        say(&logger);
        assert_eq!(
            *lines.lock().expect("no panic"),
            ["logEvents: 100 % of ##1 "]
        );
        logger
            .enable(true, std::iter::empty())
            .expect("all categories");
        say(&logger);
        assert_eq!(lines.lock().expect("no panic").len(), 3);
        logger
            .enable(false, std::iter::once(Ok("logEvents")))
            .expect("off");
        say(&logger);
        assert_eq!(lines.lock().expect("no panic").len(), 3);
    }

    #[test]
    fn an_unknown_category_is_told_and_the_others_count() {
        let (mut logger, lines) = recorded(true);
        let mut enable = |names: &[&'static str]| {
            let answer = logger.enable(true, names.iter().copied().map(Ok));
            say(&logger);
            (answer, lines.lock().expect("no panic").drain(..).count())
        };
        let unknown = |names: &str| Err(Fault::Category(names.into()));
        assert_eq!(
            enable(&["logEvents", "logNothing"]),
            (unknown("logNothing"), 1)
        );
        assert_eq!(enable(&["a", "b"]), (unknown("a\", \"b"), 0));
        assert_eq!(enable(&["logAll"]), (Ok(()), 2));
        let broken = std::iter::once(Err(Fault::Text("categories")));
        assert_eq!(logger.enable(false, broken), Err(Fault::Text("categories")));
        say(&logger);
        assert_eq!(lines.lock().expect("no panic").len(), 2);
    }
}
