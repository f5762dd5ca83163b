//! `flexbody merge`: one FMU of two that were built for different platforms.

use std::collections::BTreeSet;
use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::ValueEnum;
use fmu_package::{BINARIES, Content, LICENSES, Platform, announced, prepared, read, shown, write};

use crate::packaging::checked_output;

/// Two FMUs, and where to write.
#[derive(clap::Args)]
pub struct Merge {
    /// An FMU.
    #[arg(value_name = "A.fmu")]
    first: PathBuf,
    /// FMU of the same scene for other platforms.
    #[arg(value_name = "B.fmu")]
    second: PathBuf,
    /// Where to write [default: merged/<name of A>.fmu].
    #[arg(long, value_name = "C.fmu")]
    output: Option<PathBuf>,
}

const DESCRIPTION: &str = "modelDescription.xml";
/// The page, and what its section of the default experiment in motion stands between: it is that of the machine which packaged it, and may
/// differ in the last digits from that of another.
const PAGE: &str = "documentation/index.html";
const MOTION: [&str; 2] = ["<!-- motion begins -->", "<!-- motion ends -->"];
/// How many differences an error names.
const NAMED: usize = 5;

/// Joins the platforms of two FMUs that agree in everything else, and says where the result is.
///
/// # Errors
/// An FMU that cannot be read, FMUs that differ, or a file that cannot be written.
pub fn merge(arguments: &Merge) -> Result<()> {
    let files = [&arguments.first, &arguments.second];
    let name = files[0].file_name().unwrap_or_default();
    let output = match &arguments.output {
        Some(output) => checked_output(output)?,
        None => prepared(&PathBuf::from("merged").join(name))?,
    };
    let [first, second] = files.map(|file| read(file));
    let names = files.map(|file| shown(file));
    let joined = join(first?, second?, [&names[0], &names[1]])?;
    let done = format!("merged {}", shown(&output));
    announced("packaging", &done, || write(&joined, &output))
}

/// Joins the content of two FMUs. `names` serve error messages.
fn join(mut first: Content, second: Content, names: [&str; 2]) -> Result<Content> {
    for (content, name) in [&first, &second].into_iter().zip(names) {
        if !content.contains_key(DESCRIPTION) {
            bail!("{name}: expected an FMU, found no {DESCRIPTION}");
        }
        if platforms(content).is_empty() {
            bail!("{name}: expected a binary, found nothing below {BINARIES}");
        }
        let known: BTreeSet<&str> = Platform::value_variants()
            .iter()
            .map(|platform| platform.folder())
            .collect();
        if let Some(unknown) = platforms(content).difference(&known).next() {
            let known = Vec::from_iter(known.iter().copied()).join(", ");
            bail!("{name}: expected platforms among {known}, found {BINARIES}{unknown}");
        }
    }
    let both: BTreeSet<&str> = platforms(&first)
        .intersection(&platforms(&second))
        .copied()
        .collect();
    // A platform of one alone is what is to be joined; all else must be the same.
    let is_shared = |file: &&String| platform(file).is_none_or(|found| both.contains(found));
    // Notices of two compilers go side by side.
    let is_shared = |file: &&String| {
        is_shared(file) && (!file.starts_with(LICENSES) || in_both(&first, &second, file))
    };
    let all: BTreeSet<&String> = first.keys().chain(second.keys()).collect();
    let compared = |content: &Content, file: &String| {
        let bytes = content.get(file)?;
        Some(if file == PAGE {
            still(bytes)
        } else {
            bytes.clone()
        })
    };
    let differ = |file: &&String| compared(&first, file) != compared(&second, file);
    let mut different: Vec<String> = all
        .into_iter()
        .filter(is_shared)
        .filter(differ)
        .map(|file| match (first.get(file), second.get(file)) {
            (Some(_), None) => format!("{file} (in the first only)"),
            (None, _) => format!("{file} (in the second only)"),
            _ => file.clone(),
        })
        .collect();
    // The file that says what the others are for is named in any case.
    different.sort_by_key(|file| !file.starts_with(DESCRIPTION));
    if !different.is_empty() {
        let more = different.len().saturating_sub(NAMED);
        let named = different[..different.len() - more].join(", ");
        let more = if more == 0 {
            String::new()
        } else {
            format!(" and {more} more")
        };
        bail!(
            "{} and {}: expected FMUs that differ in their platforms only, found different: \
             {named}{more}",
            names[0],
            names[1]
        );
    }
    let page = first.remove(PAGE);
    first.extend(second);
    first.extend(page.map(|page| (PAGE.to_owned(), page)));
    Ok(first)
}

/// A page without its section of what moves.
fn still(page: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(page);
    let cut = text.split_once(MOTION[0]).and_then(|(before, rest)| {
        let (_, after) = rest.split_once(MOTION[1])?;
        Some(format!("{before}{after}"))
    });
    cut.map_or_else(|| page.to_vec(), String::into_bytes)
}

fn in_both(first: &Content, second: &Content, file: &str) -> bool {
    first.contains_key(file) && second.contains_key(file)
}

/// The platforms that an FMU has binaries for.
fn platforms(content: &Content) -> BTreeSet<&str> {
    content.keys().filter_map(|file| platform(file)).collect()
}

/// The platform that a file of an FMU is for, if it is for one.
fn platform(file: &str) -> Option<&str> {
    let (platform, _) = file.strip_prefix(BINARIES)?.split_once('/')?;
    Some(platform)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An FMU of a platform, with other content where named.
    fn fmu(platform: &str, changed: &[(&str, &str)]) -> Content {
        let library = format!("binaries/{platform}/flexbody.so");
        [
            (DESCRIPTION, "xml"),
            ("resources/scene.json", "scene"),
            (&library, "machine code"),
        ]
        .iter()
        .chain(changed)
        .map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_owned()))
        .collect()
    }

    fn refused(first: Content, second: Content) -> String {
        let error = join(first, second, ["a.fmu", "b.fmu"]).expect_err("a difference");
        error.to_string()
    }

    #[test]
    fn platforms_are_joined_and_nothing_else_changes() -> Result<()> {
        let [linux, windows] = [fmu("linux64", &[]), fmu("win64", &[])];
        let joined = join(linux.clone(), windows.clone(), ["a.fmu", "b.fmu"])?;
        assert_eq!(platforms(&joined), BTreeSet::from(["linux64", "win64"]));
        assert_eq!(joined.len(), 4);
        assert!(
            linux
                .iter()
                .chain(&windows)
                .all(|(name, bytes)| joined[name] == *bytes)
        );
        assert_eq!(join(windows, linux, ["b.fmu", "a.fmu"])?, joined);
        // A platform that both have, in the same bytes, is no conflict.
        assert_eq!(
            join(joined.clone(), fmu("win64", &[]), ["c.fmu", "b.fmu"])?,
            joined
        );
        Ok(())
    }

    #[test]
    fn notices_of_two_compilers_go_side_by_side() -> Result<()> {
        let [first, second] =
            ["rust-1.html", "rust-2.html"].map(|name| format!("{LICENSES}{name}"));
        let joined = join(
            fmu("linux64", &[(&first, "one")]),
            fmu("win64", &[(&second, "two")]),
            ["a.fmu", "b.fmu"],
        )?;
        assert!(joined.contains_key(&first) && joined.contains_key(&second));
        let found = refused(
            fmu("linux64", &[(&first, "one")]),
            fmu("win64", &[(&first, "two")]),
        );
        assert!(found.ends_with(&first), "{found}");
        Ok(())
    }

    #[test]
    fn what_differs_is_named() {
        for (file, text) in [
            (DESCRIPTION, "other xml"),
            ("resources/scene.json", "other scene"),
            ("documentation/index.html", "page"),
        ] {
            let found = refused(fmu("linux64", &[]), fmu("win64", &[(file, text)]));
            assert!(
                found.contains(&format!("found different: {file}")),
                "{found}"
            );
            assert!(found.contains("a.fmu and b.fmu"), "{found}");
        }
    }

    #[test]
    fn what_moves_on_a_page_may_differ() -> Result<()> {
        let page = |before: &str, moves: &str| {
            format!("{before}{}\n{moves}\n{}\nafter", MOTION[0], MOTION[1])
        };
        let [one, other, changed] = [("a", "1"), ("a", "2"), ("b", "1")].map(|(a, b)| page(a, b));
        let join_pages = |second: &str| {
            let [linux, windows] = [("linux64", &one[..]), ("win64", second)]
                .map(|(platform, text)| fmu(platform, &[(PAGE, text)]));
            join(linux, windows, ["a.fmu", "b.fmu"])
        };
        assert_eq!(
            join_pages(&other)?.get(PAGE),
            Some(&one.clone().into_bytes())
        );
        assert!(join_pages(&changed).is_err());
        Ok(())
    }

    #[test]
    fn a_platform_built_twice_is_no_matter_of_taste() {
        let library = "binaries/linux64/flexbody.so";
        let found = refused(
            fmu("linux64", &[]),
            fmu("linux64", &[(library, "other code")]),
        );
        assert!(found.ends_with(library), "{found}");
        let beside = "binaries/linux64/libgfortran.so";
        let found = refused(fmu("linux64", &[]), fmu("linux64", &[(beside, "code")]));
        assert!(
            found.ends_with(&format!("{beside} (in the second only)")),
            "{found}"
        );
    }

    #[test]
    fn other_archives_are_refused() {
        let mut other = fmu("win64", &[]);
        other.remove(DESCRIPTION);
        let found = refused(fmu("linux64", &[]), other);
        assert_eq!(
            found,
            "b.fmu: expected an FMU, found no modelDescription.xml"
        );
        let mut empty = fmu("win64", &[]);
        empty.retain(|file, _| platform(file).is_none());
        let found = refused(empty, fmu("linux64", &[]));
        assert!(found.starts_with("a.fmu: expected a binary"), "{found}");
        let found = refused(fmu("linux64", &[]), fmu("riscv", &[]));
        assert!(found.starts_with("b.fmu: expected platforms"), "{found}");
        assert!(found.ends_with("found binaries/riscv"), "{found}");
    }
}
