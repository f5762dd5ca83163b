//! Every key of the schema, changed, left out and put where it was not.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use serde_json::Value;

use crate::claims::mutate::{changes, clash, plants, without};
use crate::claims::scenes;
use crate::claims::schema::{Place, Schema, Sort};
use crate::claims::specimen::{Outcome, Specimen, units};

/// Keys of which one value only is accepted: the others are refused, and say so.
const SINGLE: [&str; 5] = [
    "inputs{control}.load",
    "dimension",
    "motions{winch}.value#number",
    "outputs{natural_frequency}.body",
    "outputs{eigenvalue}.body",
];
/// What stands in the schema and is refused.
const REFUSED: [&str; 17] = [
    "bodies{rod}.motion.spin#number",
    "bodies{rod}.strain",
    "bodies{rod}.model=rigid",
    "bodies{beam}.strain",
    "bodies{beam}.model=rigid",
    "initial.state=undeformed",
    "initial.loads{spring_damper}",
    "initial.loads{table_spring}",
    "initial.loads{reeving}",
    "initial.loads{force_law}",
    "initial.loads{joint_spring}",
    "initial.loads{joint_friction}",
    "initial.loads{joint_limit}",
    "initial.loads{bushing}",
    "initial.loads{fluid}",
    "initial.loads{airfoil}",
    "initial.loads{contact}",
];
/// Keys that are refused where one of them alone is changed.
const TOGETHER: [&str; 7] = [
    "bodies{rigid}.orientation.matrix[",
    "bodies{beam}.section.stiffness[",
    "bodies{beam}.section.inertia[",
    "bodies{beam}.section.about[",
    "bodies{beam}.stations.section.stiffness[",
    "bodies{beam}.stations.section.inertia[",
    "bodies{beam}.stations.section.about[",
];
/// Keys that change how results are found or whose they are, not what they are; their claims are in `own.rs`, those of
/// what the planner reads in `tests/planner`, those of elements of rods are orders in `tests/cases/rod_statics`. What a body
/// whose element is chosen says is what the element says that it becomes (`elements.rs`). Plates and shells have theirs in `patches.rs` and `tests/laws/plate_sections.rs`, latches in
/// `tests/laws/latches.rs`, friction of joints in `tests/laws/friction.rs`, the largest one of contacts that stick in
/// `tests/laws/sticking.rs`. What needs a file has its claims in `reduced.rs`,
/// what reduces lines to modes in `tests/laws/modal_lines.rs` and `planar_modes.rs`.
const OWN: [&str; 40] = [
    "about.",
    "accuracy.notes",
    "method.work_limit",
    "accuracy.input_profiles.",
    "bodies{cable}.elements=auto",
    "bodies{cable}.model=",
    "bodies{cable}.modes",
    "bodies{rod}.elements",
    "bodies{rod}.model",
    "bodies{rod}.modes",
    "bodies{beam}.elements",
    "bodies{beam}.model",
    "bodies{beam}.modes",
    "bodies{auto}",
    "bodies{reduced}",
    "bodies{plate}",
    "bodies{shell}",
    "joints{clamped}",
    "joints{pinned}",
    "joints{symmetry}",
    "joints{smooth}",
    "latches.",
    "inputs{latch}",
    "inputs{friction}",
    "loads{joint_friction}",
    "loads{contact}.static_ratio",
    "outputs{latch_force}",
    "outputs{latch_torque}",
    "outputs{latch_state}",
    "loads{pressure}",
    "loads{area_force}",
    "inputs{pressure}",
    "inputs{area_force}",
    "initial.loads{pressure}",
    "initial.loads{area_force}",
    "outputs{stress_tensor}",
    "outputs{membrane_strain}",
    "outputs{membrane_force}",
    "outputs{surface_stress}",
    "outputs{ply_stress}",
];
/// Keys of every table, whatever follows it: claimed of one that a load and one that a motion follows.
const OF_TABLES: [&str; 2] = [".interpolation", ".slopes"];
const TABLES: [&str; 2] = ["loads{force}.value[0]", "motions{displacement}.value."];

/// Keys that are drawn only beside the mass and inertia of a body: where they were left out they change no number. A test of pages sees
/// them (`tests/view/test_engineering.py`).
const DRAWN: &str = "bodies{rigid}.shape.";

/// What was done at a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Deed {
    /// Another value.
    Changed,
    /// Left out.
    Removed,
    /// A value where there was none.
    Planted,
    /// The name of another part.
    Clashed,
}

type Records = BTreeMap<(String, Deed), Vec<(&'static str, Outcome)>>;

/// All specimens in turn, on all cores.
pub fn for_each_specimen(work: impl Fn(&Specimen) + Sync) {
    let specimens = scenes::all();
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(specimen) = specimens.get(next.fetch_add(1, Ordering::Relaxed)) {
                    work(specimen);
                }
            });
        }
    });
}

/// Whether its claims are elsewhere: no run here would tell.
fn has_its_own(key: &str) -> bool {
    OWN.iter().any(|start| key.starts_with(start))
}

/// Changes one place of a specimen, in one way after the other until a claim notices.
fn examine(specimen: &Specimen, known: &[String], place: &Place, records: &Mutex<Records>) {
    // Whether it is done: a claim has noticed, of this specimen or another.
    let is_done = |key: &str, deed| {
        let records = records.lock().expect("no panic while locked");
        let list = records.get(&(key.to_owned(), deed));
        list.is_some_and(|list| list.iter().any(|(_, outcome)| outcome.is_noticed()))
    };
    let record = |key: &str, deed, scene: &Value, known: &[String]| {
        if is_done(key, deed) {
            return true;
        }
        let outcome = specimen.judge(scene, known);
        let is_refused = matches!(outcome, Outcome::Refused(_));
        let mut records = records.lock().expect("no panic while locked");
        let list = records.entry((key.to_owned(), deed)).or_default();
        list.push((specimen.name, outcome));
        !is_refused
    };
    let scene = &specimen.scene;
    if place.samples.is_some() {
        for planted in plants(scene, place) {
            record(&place.key, Deed::Planted, &planted, &[]);
        }
        return;
    }
    let key = match &place.sort {
        Sort::Choice(_) if !place.key.ends_with('}') => {
            let variant = scene
                .pointer(&place.pointer)
                .and_then(|value| value.as_str());
            format!("{}={}", place.key, variant.unwrap_or_default())
        }
        _ => place.key.clone(),
    };
    if has_its_own(&key) {
        return;
    }
    let first_decides = matches!(place.sort, Sort::Number | Sort::Integer);
    for mutant in changes(scene, place) {
        let known = if mutant.is_renamed { &[] } else { known };
        if record(&key, Deed::Changed, &mutant.scene, known) && first_decides {
            break;
        }
    }
    if place.key.ends_with(".name") {
        record(&place.key, Deed::Clashed, &clash(scene, place), known);
    }
    if let Some(removal) = &place.removal {
        record(&place.key, Deed::Removed, &without(scene, removal), &[]);
    }
}

/// What is missing at a key.
fn complaints(key: &str, records: &Records) -> Vec<String> {
    let of = |deed| {
        records
            .get(&(key.to_owned(), deed))
            .map_or(&[][..], Vec::as_slice)
    };
    let refused = |list: &[(&str, Outcome)]| {
        list.iter()
            .all(|(_, outcome)| matches!(outcome, Outcome::Refused(_)))
    };
    let noticed = |list: &[(&str, Outcome)]| list.iter().any(|(_, outcome)| outcome.is_noticed());
    let told = |what: &str, list: &[(&str, Outcome)]| {
        let seen = list
            .iter()
            .filter(|(_, outcome)| !matches!(outcome, Outcome::Refused(_)));
        let seen: Vec<String> = seen.map(|(name, o)| format!("{name}: {o:?}")).collect();
        format!("{key}: {what}; {}", seen.join(", "))
    };
    let (changed, removed, planted) = (of(Deed::Changed), of(Deed::Removed), of(Deed::Planted));
    let taken = |(_, outcome): &(&str, Outcome)| matches!(outcome, Outcome::Refused(told) if told.contains("a name not used yet"));
    let stuck = |(_, outcome): &(&str, Outcome)| matches!(outcome, Outcome::Stuck(_));
    let mut found = Vec::new();
    let is_one_of_several = TOGETHER.iter().any(|start| key.starts_with(start));
    let choice = key.ends_with('}') || SINGLE.contains(&key) || is_one_of_several;
    let holds = if changed.is_empty() {
        !planted.is_empty() && refused(planted)
    } else {
        // Inputs and outputs may change places with the kind.
        let is_stuck = key.ends_with('}') && changed.iter().any(stuck);
        is_stuck || noticed(changed) || (choice && refused(changed))
    };
    if !holds && !of(Deed::Clashed).iter().any(taken) {
        let what = if changed.is_empty() {
            "no specimen has it"
        } else {
            "no claim notices a change"
        };
        found.push(told(what, changed));
    }
    // Without it there may be no start.
    if !refused(removed) && !noticed(removed) && !removed.iter().any(stuck) {
        found.push(told("no claim notices that it is left out", removed));
    }
    if !refused(planted) && !noticed(planted) && !key.starts_with(DRAWN) {
        found.push(told("no claim notices it where it was left out", planted));
    }
    found
}

#[test]
fn every_claim_holds_with_its_unit() {
    let failed = Mutex::new(Vec::new());
    for_each_specimen(|specimen| {
        let outcome = specimen.judge(&specimen.scene, &[]);
        let mut failed = failed.lock().expect("no panic while locked");
        if outcome != Outcome::Holds {
            failed.push(format!("{}: {outcome:?}", specimen.name));
            return;
        }
        let units = units(&specimen.scene);
        for claim in specimen
            .claims
            .iter()
            .filter(|claim| !claim.of.starts_with('@'))
        {
            let found = units.get(&claim.of).map_or("none", String::as_str);
            if found != claim.unit {
                let (name, of, unit) = (specimen.name, &claim.of, claim.unit);
                failed.push(format!(
                    "{name}: {of}: expected the unit {unit}, found {found}"
                ));
            }
        }
    });
    let failed = failed.into_inner().expect("no panic while locked");
    assert!(
        failed.is_empty(),
        "{} claims fail:\n{}",
        failed.len(),
        failed.join("\n")
    );
}

#[test]
#[ignore = "takes minutes: the check `claims of keys` runs it where scenes or claims have changed"]
fn every_key_has_a_claim_that_moves_with_it() {
    let schema = Schema::published();
    let records = Mutex::new(Records::new());
    for_each_specimen(|specimen| {
        let known = specimen.variables();
        for place in schema.places(&specimen.scene) {
            examine(specimen, &known, &place, &records);
        }
    });
    let records = records.into_inner().expect("no panic while locked");
    let mut keys = schema.keys();
    let count = keys.len();
    // The key itself beside its variants: what happens where it is left out.
    let plain = keys
        .iter()
        .filter_map(|key| Some(key.split_once('=')?.0.to_owned()));
    let plain: BTreeSet<String> = plain.collect();
    let complaints: Vec<String> = keys
        .iter()
        .flat_map(|key| complaints(key, &records))
        .chain(plain.iter().flat_map(|key| of_default(key, &records)))
        .filter(|text| {
            let is_of_tables = OF_TABLES.iter().any(|key| text.contains(key));
            !is_of_tables || TABLES.iter().any(|key| text.starts_with(key))
        })
        .filter(|text| {
            let is_refused = REFUSED.iter().any(|key| text.starts_with(key));
            !is_refused && !has_its_own(text)
        })
        .collect();
    keys.retain(|key| records.contains_key(&(key.clone(), Deed::Changed)));
    let runs: usize = records.values().map(Vec::len).sum();
    println!(
        "{count} keys and variants, {} of them in specimens, {runs} changes",
        keys.len()
    );
    assert!(
        complaints.is_empty(),
        "{} of {count} keys:\n{}",
        complaints.len(),
        complaints.join("\n")
    );
}

/// Complaints about a choice that is left out or put where it was not.
fn of_default(key: &str, records: &Records) -> Vec<String> {
    let mut found = complaints(key, records);
    found.retain(|text| text.contains("left out"));
    found
}
