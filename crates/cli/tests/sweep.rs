//! Sweeps: equal bits however many run at a time, nothing lost where the process was killed, reasons of runs that failed.

mod place;

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use place::Place;

/// A bar on a hinge, which falls.
const SCENE: &str = r#"{
    "name": "bar", "dimension": 2, "gravity": [0, -9.81],
    "bodies": [{"name": "bar", "element": "rigid", "mass": 2, "inertia": 0.5,
                "position": [0.5, 0], "markers": {"end": [-0.5, 0], "tip": [0.5, 0]}}],
    "joints": [{"name": "hinge", "kind": "revolute", "markers": ["ground", "bar.end"]}],
    "outputs": [{"kind": "position", "marker": "bar.tip"}],
    "accuracy": {"relative_tolerance": 1e-6},
    "experiment": {"stop_time": 1, "step": 0.01}
}"#;

/// A folder with the scene.
fn place(name: &str) -> Place {
    Place::new(&format!("sweep-{name}"), &[("scene.json", SCENE)])
}

impl Place {
    fn sweep(&self, options: &[&str]) -> Command {
        self.command(&[&["sweep", "scene.json"], options].concat())
    }

    fn run(&self, options: &[&str]) -> Output {
        self.sweep(options).output().expect("the program runs")
    }

    /// Runs what succeeds, and returns what was printed on standard error.
    fn swept(&self, options: &[&str]) -> String {
        let run = self.run(options);
        let printed = String::from_utf8(run.stderr).expect("UTF-8");
        assert!(run.status.success(), "{printed}");
        printed
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.0.join(name)).expect(name)
    }
}

/// Columns of all rows.
fn rows(path: &Path) -> Vec<Vec<(String, Field)>> {
    let file = std::fs::File::open(path).expect("a table");
    let reader = SerializedFileReader::new(file).expect("Parquet");
    let rows = reader.get_row_iter(None).expect("rows");
    rows.map(|row| {
        let row = row.expect("a row");
        let columns = row.get_column_iter();
        columns
            .map(|(name, field)| (name.clone(), field.clone()))
            .collect()
    })
    .collect()
}

fn cell<'a>(row: &'a [(String, Field)], name: &str) -> &'a Field {
    let found = row.iter().find(|(title, _)| title == name);
    &found.unwrap_or_else(|| panic!("no column {name}")).1
}

#[test]
fn any_number_of_jobs_gives_the_same_bits() {
    let place = place("jobs");
    let vary = ["--vary", "gravity[2]=-5:-10:7", "--vary", "bar.mass=1,2,3"];
    for jobs in ["1", "4"] {
        let (table, series) = (format!("{jobs}.parquet"), format!("{jobs}.series.parquet"));
        let mut options = vary.to_vec();
        options.extend(["--jobs", jobs, "--output", &table, "--series", &series]);
        place.swept(&options);
    }
    assert_eq!(place.bytes("1.parquet"), place.bytes("4.parquet"));
    assert_eq!(
        place.bytes("1.series.parquet"),
        place.bytes("4.series.parquet")
    );
    let rows = rows(&place.0.join("4.series.parquet"));
    assert_eq!(rows.len(), 21 * 101);
    assert_eq!(cell(&rows[101], "run"), &Field::Long(1));
    assert_eq!(cell(&rows[103], "time"), &Field::Double(0.02));
}

/// A run of a sweep is what `flexbody simulate` gives.
#[test]
fn a_row_says_what_a_simulation_of_its_own_gives() {
    let place = place("own");
    place.swept(&[
        "--vary",
        "bar.mass=1,3",
        "--vary",
        "bar.inertia=0.5,1",
        "--output",
        "t.parquet",
    ]);
    let run = Command::new(env!("CARGO_BIN_EXE_flexbody"))
        .args([
            "simulate",
            "scene.json",
            "--set",
            "bar.mass=3",
            "--set",
            "bar.inertia=0.5",
        ])
        .current_dir(&place.0)
        .output()
        .expect("the program runs");
    let text = String::from_utf8(run.stdout).expect("UTF-8");
    let mut lines = text.lines();
    let titles: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let column = titles
        .iter()
        .position(|title| *title == "bar.tip.position[2]");
    let column = column.expect("the output");
    let values = lines.map(|line| line.split(',').nth(column).expect("a value"));
    let values: Vec<f64> = values.map(|text| text.parse().expect("a number")).collect();
    let rows = rows(&place.0.join("t.parquet"));
    let row = &rows[2];
    let number = |name: &str| match cell(row, name) {
        Field::Double(value) => *value,
        other => panic!("{name}: {other:?}"),
    };
    assert_eq!([number("bar.mass"), number("bar.inertia")], [3.0, 0.5]);
    let [last, least, largest] =
        ["final", "min", "max"].map(|which| number(&format!("bar.tip.position[2].{which}")));
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    close(last, *values.last().expect("rows"));
    close(least, values.iter().copied().fold(f64::INFINITY, f64::min));
    close(
        largest,
        values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    );
}

#[test]
fn a_sweep_that_was_killed_goes_on_and_loses_nothing() {
    let place = place("killed");
    let vary = ["--vary", "bar.mass=1:2:300", "--stop-time", "20"];
    let options = |output| [&vary[..], &["--jobs", "2", "--output", output]].concat();
    place.swept(&options("whole.parquet"));
    let mut child = place.sweep(&options("cut.parquet"));
    let mut child = child
        .stderr(Stdio::null())
        .spawn()
        .expect("the program runs");
    let journal = place.0.join("cut.parquet.runs");
    let lines = || std::fs::read_to_string(&journal).map_or(0, |text| text.lines().count());
    let started = Instant::now();
    while lines() < 10 && started.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("it runs still");
    child.wait().expect("an end");
    let done = lines() - 1;
    assert!((9..300).contains(&done), "{done}");
    assert!(!place.0.join("cut.parquet").exists());
    // Half a line is no run.
    let mut text = std::fs::read(&journal).expect("a journal");
    text.extend(br#"{"run":299,"fin"#);
    std::fs::write(&journal, text).expect("a writable temporary directory");
    // Another sweep is not mixed in.
    let other = place.run(&[
        "--vary",
        "bar.mass=1:3:300",
        "--stop-time",
        "20",
        "--output",
        "cut.parquet",
    ]);
    let printed = String::from_utf8_lossy(&other.stderr).into_owned();
    assert!(
        !other.status.success() && printed.contains("found another's"),
        "{printed}"
    );
    let printed = place.swept(&options("cut.parquet"));
    let there: usize = printed
        .split(' ')
        .next()
        .and_then(|n| n.parse().ok())
        .expect(&printed);
    assert!(there + 1 >= done && there < 300, "{printed}");
    assert_eq!(place.bytes("cut.parquet"), place.bytes("whole.parquet"));
    assert!(!journal.exists());
}

#[test]
fn a_run_that_fails_is_a_row_with_its_reason() {
    let place = place("failed");
    let printed = place.swept(&["--vary", "bar.mass=2,-2,3", "--output", "t.parquet"]);
    assert!(
        printed.contains("1 of 3 runs failed; first run 1: bar.mass: "),
        "{printed}"
    );
    let rows = rows(&place.0.join("t.parquet"));
    let Field::Str(reason) = cell(&rows[1], "error") else {
        panic!("{:?}", rows[1]);
    };
    assert!(reason.starts_with("bar.mass: "), "{reason}");
    assert_eq!(cell(&rows[1], "bar.tip.position[1].final"), &Field::Null);
    assert_eq!(cell(&rows[0], "error"), &Field::Null);
    assert!(matches!(
        cell(&rows[2], "bar.tip.position[1].final"),
        Field::Double(_)
    ));
}

#[test]
fn names_that_are_not_there_are_told_before_anything_runs() {
    let place = place("names");
    for (options, expected) in [
        (&["--vary", "bar.mas=1,2"][..], "did you mean `bar.mass`"),
        (
            &["--vary", "bar.mass=1,2", "--set", "bar.mass=1"],
            "--vary sets it already",
        ),
        (
            &[
                "--vary",
                "bar.mass=1,2",
                "--scheduler",
                "local",
                "--parts",
                "none",
            ],
            "expected libraries for FMUs in",
        ),
    ] {
        let run = place.run(options);
        let printed = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(
            !run.status.success() && printed.contains(expected),
            "{printed}"
        );
    }
}

#[test]
fn a_sweep_in_which_every_run_fails_fails() {
    let place = place("all-failed");
    let run = place.run(&["--vary", "bar.mass=-2,-1", "--output", "t.parquet"]);
    let printed = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(!run.status.success());
    assert!(
        printed.contains("all of 2 runs failed; first run 0: bar.mass: "),
        "{printed}"
    );
    // The table with the reasons is there, and nothing is left to go on with.
    assert_eq!(rows(&place.0.join("t.parquet")).len(), 2);
    assert!(!place.0.join("t.parquet.runs").exists());
}

#[test]
fn a_second_sweep_into_one_file_says_that_another_is_at_work() {
    let place = place("second");
    let journal = std::fs::File::create(place.0.join("t.parquet.runs")).expect("a journal");
    journal.lock().expect("a lock");
    let options = ["--vary", "bar.mass=1,2", "--output", "t.parquet"];
    let run = place.run(&options);
    let printed = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(!run.status.success());
    assert!(printed.contains("found another sweep at work"), "{printed}");
    drop(journal);
    place.swept(&options);
}

#[cfg(unix)]
#[test]
fn what_is_no_plain_file_stays_and_links_are_followed() {
    use std::os::unix::fs::{FileTypeExt, symlink};

    let place = place("device");
    let pipe = std::os::unix::net::UnixListener::bind(place.0.join("t.parquet"));
    pipe.expect("a socket");
    let vary = ["--vary", "bar.mass=1,2", "--output"];
    for keys in [&["t.parquet"][..], &["a.parquet", "--series", "t.parquet"]] {
        let run = place.run(&[&vary[..], keys].concat());
        let printed = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(!run.status.success());
        assert!(
            printed.contains("expected a plain file or none"),
            "{printed}"
        );
    }
    let found = std::fs::symlink_metadata(place.0.join("t.parquet")).expect("it is there still");
    assert!(found.file_type().is_socket());
    std::fs::create_dir(place.0.join("far")).expect("a folder");
    symlink("far/table.parquet", place.0.join("link.parquet")).expect("a link");
    place.swept(&[&vary[..], &["link.parquet"]].concat());
    assert_eq!(rows(&place.0.join("far/table.parquet")).len(), 2);
    let link = std::fs::symlink_metadata(place.0.join("link.parquet")).expect("a link");
    assert!(link.is_symlink());
    let run = place.run(&[&vary[..], &["a.parquet", "--series", "./a.parquet"]].concat());
    let printed = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(
        printed.contains("--series: expected another file"),
        "{printed}"
    );
}

/// Every row has the reason and the warnings of its own run, whichever came first.
#[test]
fn reasons_and_warnings_stand_in_the_rows_of_their_runs() {
    let place = place("rows");
    let vary = ["--vary", "bar.mass=2,-2", "--vary", "bar.inertia=1,-1"];
    let printed = place.swept(&[&vary[..], &["--jobs", "2", "--output", "t.parquet"]].concat());
    assert!(
        printed.contains("3 of 4 runs failed; first run 1: bar.inertia: "),
        "{printed}"
    );
    let found = rows(&place.0.join("t.parquet"));
    for (row, wanted) in found
        .iter()
        .zip(["", "bar.inertia: ", "bar.mass: ", "bar.mass: "])
    {
        match cell(row, "error") {
            Field::Str(reason) => {
                assert!(!wanted.is_empty() && reason.starts_with(wanted), "{reason}")
            }
            other => assert_eq!((other, wanted), (&Field::Null, "")),
        }
    }
    // One element bends too far for what it resolves under the larger force alone.
    std::fs::write(place.0.join("scene.json"), BENT).expect("a writable temporary directory");
    let vary = ["--vary", "strip.tip.force[2]=0,2,0.01,4"];
    place.swept(&[&vary[..], &["--jobs", "2", "--output", "w.parquet"]].concat());
    let found = rows(&place.0.join("w.parquet"));
    for (row, warns) in found.iter().zip([false, true, false, true]) {
        let warning = cell(row, "warnings");
        assert_eq!(warning != &Field::Null, warns, "{warning:?}");
    }
}

/// A strip of one element on a wall.
const BENT: &str = r#"{
    "name": "bent", "dimension": 2, "gravity": [0, 0],
    "bodies": [{"name": "strip", "element": "cable", "elements": 1,
                "material": {"youngs_modulus": 1e7, "density": 1000, "damping_time": 0.05},
                "section": {"area": 1e-4, "second_moment": 1e-7},
                "shape": {"line": {"from": [0, 0], "to": [1, 0]}}, "markers": {"root": 0, "tip": 1}}],
    "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "strip.root"]}],
    "inputs": [{"kind": "force", "marker": "strip.tip"}],
    "outputs": [{"kind": "resolution"}, {"kind": "position", "marker": "strip.tip"}],
    "accuracy": {"error": 1e-2, "relative_tolerance": 1e-8},
    "experiment": {"stop_time": 1, "step": 0.1}
}"#;

/// What decides the results of a sweep decides whether runs that are there already are its own; what is fixed in all runs is so after a
/// stop too.
#[test]
fn a_sweep_goes_on_with_its_own_runs_alone() {
    let place = place("goes-on");
    let own = [
        "--vary",
        "bar.mass=1:2:120",
        "--set",
        "gravity[2]=-5",
        "--stop-time",
        "5",
        "--step",
        "0.01",
    ];
    let with = |change: &[(&str, &str)], output: &'static str| -> Vec<String> {
        let mut options: Vec<String> = own.iter().map(|option| (*option).into()).collect();
        for (old, new) in change {
            let at = own
                .iter()
                .position(|option| option == old)
                .expect("an option");
            options[at] = (*new).into();
        }
        options.extend(["--jobs", "1", "--output", output].map(String::from));
        options
    };
    let run = |options: Vec<String>| {
        let options: Vec<&str> = options.iter().map(String::as_str).collect();
        place.run(&options)
    };
    assert!(run(with(&[], "whole.parquet")).status.success());
    // What a killed process leaves: some runs, out of order.
    let journal = place.0.join("cut.parquet.runs");
    let options = with(&[], "cut.parquet");
    let options: Vec<&str> = options.iter().map(String::as_str).collect();
    let mut child = place.sweep(&options);
    let mut child = child
        .stderr(Stdio::null())
        .spawn()
        .expect("the program runs");
    let lines = || std::fs::read_to_string(&journal).map_or(0, |text| text.lines().count());
    let started = Instant::now();
    while lines() < 3 && started.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("it runs still");
    child.wait().expect("an end");
    assert!(
        journal.exists(),
        "expected a sweep that was stopped half-way"
    );
    for change in [
        ("gravity[2]=-5", "gravity[2]=-6"),
        ("gravity[2]=-5", "bar.inertia=0.5"),
        ("bar.mass=1:2:120", "bar.mass=1:2:121"),
        ("bar.mass=1:2:120", "bar.inertia=1:2:120"),
        ("5", "6"),
        ("0.01", "0.02"),
    ] {
        let other = run(with(&[change], "cut.parquet"));
        let printed = String::from_utf8_lossy(&other.stderr).into_owned();
        assert!(
            !other.status.success() && printed.contains("found another's"),
            "{change:?}: {printed}"
        );
    }
    assert!(run(with(&[], "cut.parquet")).status.success());
    assert_eq!(place.bytes("cut.parquet"), place.bytes("whole.parquet"));
}
