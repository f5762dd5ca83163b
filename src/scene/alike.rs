//! Names that were meant where one is not found.

/// Names that are offered in place of one that is not there.
const OFFERED: usize = 3;
/// How alike (0 to 1) an offered name is at least.
const ALIKE: f64 = 0.6;
/// Names that are listed where there are no more, and letters of all together.
const LISTED: (usize, usize) = (8, 200);
/// Letters from which on a name is like nothing.
const LONG: usize = 200;

/// The names that are most like one that is not there, as the end of a message; nothing where none is.
pub fn did_you_mean<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    if name.len() > LONG {
        return String::new();
    }
    let mut alike: Vec<(f64, &str)> = known
        .into_iter()
        .map(|known| (likeness(name, known), known))
        .filter(|(likeness, _)| *likeness >= ALIKE)
        .collect();
    alike.sort_by(|a, b| b.0.total_cmp(&a.0));
    alike.dedup_by_key(|(_, known)| *known);
    alike.truncate(OFFERED);
    if alike.is_empty() {
        return String::new();
    }
    let alike: Vec<String> = alike.iter().map(|(_, name)| format!("`{name}`")).collect();
    format!("; did you mean {}?", alike.join(" or "))
}

/// Lists the known names in parentheses if the list is short, as the end of an expectation in an error message.
pub(super) fn listed(known: &[&str]) -> String {
    let letters: usize = known.iter().map(|name| name.len() + 2).sum();
    match known.len() {
        0 => ", of which there are none".into(),
        count if count <= LISTED.0 && letters <= LISTED.1 => format!(" ({})", known.join(", ")),
        _ => String::new(),
    }
}

/// How alike two names are, from 0 to 1: by the letters that have to change, to which capitals do not count; or by how much of one
/// the other is.
fn likeness(name: &str, known: &str) -> f64 {
    let [a, b] = [name, known].map(str::to_lowercase);
    let letters = [&a, &b].map(|name| name.chars().count());
    let (shorter, longer) = (letters[0].min(letters[1]), letters[0].max(letters[1]));
    if shorter == 0 || longer > LONG {
        return 0.0;
    }
    let by_letters = 1.0 - strsim::osa_distance(&a, &b) as f64 / longer as f64;
    // A name without that of its body, or without its index.
    let is_part = shorter >= 3 && (name.contains(known) || known.contains(name));
    let by_part = if is_part {
        0.6 + 0.4 * shorter as f64 / longer as f64
    } else {
        0.0
    };
    by_letters.max(by_part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_pen_are_seen() {
        let known = [
            "rod.tip.force[1]",
            "rod.tip.force[2]",
            "rod.tip.moment",
            "gravity[1]",
        ];
        let offered = |name: &str| did_you_mean(name, known);
        assert_eq!(
            offered("rod.tip.fource[1]"),
            "; did you mean `rod.tip.force[1]` or `rod.tip.force[2]`?"
        );
        assert!(offered("gravity").starts_with("; did you mean `gravity[1]`?"));
        assert!(offered("ROD.TIP.MOMENT").contains("`rod.tip.moment`"));
        assert!(offered("rod.tip.momnet").starts_with("; did you mean `rod.tip.moment`"));
        assert_eq!(offered("elbow"), "");
        assert_eq!(offered(&"f".repeat(1000)), "");
        assert_eq!(
            did_you_mean("blade.distributed[3]", ["blade.distributed_force[3]"]),
            "; did you mean `blade.distributed_force[3]`?"
        );
    }

    #[test]
    fn what_there_is_is_listed_where_it_is_short() {
        assert_eq!(listed(&[]), ", of which there are none");
        assert_eq!(listed(&["a", "b"]), " (a, b)");
        assert_eq!(listed(&["a"; 9]), "");
        assert_eq!(listed(&[&"a".repeat(300)]), "");
    }
}
