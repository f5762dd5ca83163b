//! Every claim of every case in `tests/cases`, natively. The same claims run through the packaged
//! FMU under fmpy (`tests/fmpy/claims.py`), read and evaluated there anew: the FMU is seen from outside Rust alone, and what one
//! of the two gets wrong the other does not believe. The studies checks its own cases with what stands here (`crates/studies/src/cases.rs`).
//!
//! `FLEXBODY_CASE=name` checks only the cases whose folder has `name` in its name.

use std::path::Path;

use crate::cases_runner::{Case, Step, Verdict, check_all, table};
use flexbody::simulation::Simulation;

/// The product takes the steps.
fn product(_: &Path, _: &Simulation) -> Result<Step, String> {
    Ok(Box::new(|simulation, until| {
        let step = simulation.step(until);
        step.map_err(|failure| failure.to_string())
    }))
}

#[test]
fn every_claim_of_every_case_holds() {
    let filter = std::env::var("FLEXBODY_CASE").unwrap_or_default();
    let root = crate::root().join("tests/cases");
    let cases = crate::cases_runner::find(&root, &filter).expect("readable cases");
    assert!(
        !cases.is_empty(),
        "expected a case in tests/cases with \"{filter}\" in its name, found none"
    );
    let verdicts = check_all(&cases, &product);
    println!("{}", table(&verdicts));
    let failed: Vec<String> = verdicts.iter().filter_map(Verdict::failure).collect();
    assert!(
        failed.is_empty(),
        "{} of {} claims fail:\n{}",
        failed.len(),
        verdicts.len(),
        failed.join("\n")
    );
}

/// A case of the runner's own, that is on no disk.
fn refusal(case: &str) -> String {
    match Case::parse("planted", Path::new("."), case) {
        Ok(case) => {
            let failures = check_all(&[case], &product)
                .iter()
                .filter_map(Verdict::failure)
                .collect::<Vec<_>>();
            failures.join("\n")
        }
        Err(message) => message,
    }
}

#[test]
fn a_case_that_says_too_little_or_too_much_is_refused() {
    let claim = r#"[{"kind": "values", "values": {}, "relative": 1.0}]"#;
    for (case, message) in [
        (
            format!(r#"{{"purpose": "to pass", "claims": {claim}}}"#),
            "source: expected a sentence",
        ),
        (
            format!(r#"{{"purpose": " ", "source": "somewhere", "claims": {claim}}}"#),
            "purpose: expected a sentence",
        ),
        (
            r#"{"purpose": "to pass", "source": "somewhere", "claims": []}"#.into(),
            "claims: expected at least one",
        ),
        (
            format!(
                r#"{{"purpose": "to pass", "source": "somewhere", "sauce": 1, "claims": {claim}}}"#
            ),
            "unknown field `sauce`",
        ),
    ] {
        let found = refusal(&case);
        assert!(
            found.contains(message),
            "expected \"{message}\", found \"{found}\""
        );
    }
}

#[test]
fn a_claim_nobody_checks_is_refused() {
    for (claim, message) in [
        (
            r#"{"kind": "faith"}"#,
            "kind: expected one of series, values, order, critical, drift, found \"faith\"",
        ),
        (r#"{"values": {}, "relative": 1.0}"#, "found nothing"),
        (
            r#"{"kind": "values", "values": {}, "relative": 1.0, "tolerence": 1.0}"#,
            "unknown field `tolerence`",
        ),
        (
            r#"{"kind": "values", "values": {}}"#,
            "missing field `relative`",
        ),
        (
            r#"{"kind": "values", "values": {}, "relative": 1.0, "note": "1.5 times what was measured"}"#,
            "no_reference: expected why the limit has no outside reference",
        ),
        (
            r#"{"kind": "values", "values": {}, "relative": 1.0, "scene": 3}"#,
            "scene: expected a text",
        ),
    ] {
        let case =
            format!(r#"{{"purpose": "to pass", "source": "somewhere", "claims": [{claim}]}}"#);
        let found = refusal(&case);
        assert!(
            found.contains(message),
            "expected \"{message}\", found \"{found}\""
        );
    }
}

#[test]
fn claims_are_measured_and_not_believed() {
    let scene = crate::root().join("tests/abi/scene.json");
    let scene = scene.display();
    for (claim, message) in [
        (
            r#""kind": "values", "values": {"rod.tip.position[1]": 1.2}, "relative": 1e-12"#,
            "",
        ),
        (
            r#""kind": "values", "values": {"rod.tip.position[1]": 1.3}, "relative": 1e-2"#,
            "rod.tip.position[1]: expected 1.3, found 1.2",
        ),
        (
            r#""kind": "values", "values": {"rod.tail.position[1]": 1.2}, "relative": 1e-2"#,
            "rod.tail.position[1]: expected a variable",
        ),
        (
            r#""kind": "values", "values": {}, "set": {"rod.elements": 4.5}, "relative": 1.0"#,
            "rod.elements: expected an integer",
        ),
        (
            r#""kind": "drift", "stop_time": 0.1, "step": 0.05, "sum": ["energy.kinetic"], "scale": 1.0, "absolute": 1e-3"#,
            "energy.kinetic drifts by",
        ),
        (
            r#""kind": "drift", "stop_time": 0.1, "step": 0.05, "sum": ["energy.kinetic"], "less": ["energy.kinetic"], "scale": 1.0, "absolute": 0.0"#,
            "",
        ),
        (
            r#""kind": "drift", "stop_time": 0.1, "step": 0.05, "sum": ["energy.kinetic"], "after": 0.1, "scale": 1.0, "absolute": 1.0"#,
            "after: expected a time before 0.1, found 0.1",
        ),
        (
            r#""kind": "values", "time": 0.1, "step": 0.05, "values": {"rod.tip.position[1]": 1.2}, "relative": 1.0, "changes": [{"time": 0.05, "set": {"rod.tail.force[1]": 1.0}}]"#,
            "rod.tail.force[1]: expected a variable",
        ),
    ] {
        let found = refusal(&format!(
            r#"{{"purpose": "to pass", "source": "somewhere", "scene": "{scene}", "claims": [{{{claim}}}]}}"#
        ));
        assert!(
            found.contains(message) && found.is_empty() == message.is_empty(),
            "expected \"{message}\", found \"{found}\""
        );
    }
}
