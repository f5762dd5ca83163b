//! What a sweep varies: a grid of axes, each with one variable or with several that move together.

use std::path::Path;

use anyhow::{Context, Result, bail};
use serde_json::{Value, json};

/// Most runs of a sweep.
const MOST: usize = 100_000_000;

/// Variables that move together, and their values one after the other.
struct Axis {
    names: Vec<String>,
    /// Values of one run each, as many as names.
    rows: Vec<Vec<f64>>,
}

/// All axes; runs are every combination, the last axis changes first.
pub struct Axes(Vec<Axis>);

impl Axes {
    /// Reads `NAME=FROM:TO:COUNT`, `NAME=A,B,...` and `NAME=@FILE.csv`. Columns of one file move together, line by
    /// line.
    ///
    /// # Errors
    /// An axis of another form, a file that cannot be read, or a name that is varied twice.
    pub fn parse(given: &[String]) -> Result<Self> {
        let mut axes: Vec<Axis> = Vec::new();
        let mut samples: Option<usize> = None;
        for option in given {
            let place = || format!("--vary {option}");
            let (name, values) = option
                .split_once('=')
                .context("expected NAME=FROM:TO:COUNT, NAME=A,B,... or NAME=@FILE.csv")
                .with_context(place)?;
            let (name, values) = (name.trim().to_owned(), values.trim());
            if axes.iter().any(|axis| axis.names.contains(&name)) {
                bail!("{}: {name} is varied already", place());
            }
            let is_file = values.starts_with('@');
            let found = match values.strip_prefix('@') {
                Some(file) => column(Path::new(file), &name),
                None => range_or_list(values),
            };
            let found = found.with_context(place)?;
            match samples.filter(|_| is_file) {
                Some(index) => {
                    let axis = &mut axes[index];
                    if axis.rows.len() != found.len() {
                        bail!(
                            "{}: expected {} rows as of {}, found {}",
                            place(),
                            axis.rows.len(),
                            axis.names[0],
                            found.len()
                        );
                    }
                    axis.names.push(name);
                    for (row, value) in axis.rows.iter_mut().zip(found) {
                        row.push(value);
                    }
                }
                None => {
                    if is_file {
                        samples = Some(axes.len());
                    }
                    axes.push(Axis {
                        names: vec![name],
                        rows: found.into_iter().map(|value| vec![value]).collect(),
                    });
                }
            }
        }
        let axes = Self(axes);
        match axes.counted() {
            Some(count) if count <= MOST => Ok(axes),
            _ => bail!("--vary: expected at most {MOST} runs, found more"),
        }
    }

    fn counted(&self) -> Option<usize> {
        let lengths = self.0.iter().map(|axis| axis.rows.len());
        lengths.into_iter().try_fold(1_usize, usize::checked_mul)
    }

    /// Number of runs.
    pub fn count(&self) -> usize {
        self.counted().unwrap_or(MOST)
    }

    /// Names of the variables, in the order of values.
    pub fn names(&self) -> Vec<&str> {
        let names = self.0.iter().flat_map(|axis| &axis.names);
        names.map(String::as_str).collect()
    }

    /// Returns the values of the varied variables in a run.
    pub fn values(&self, run: usize) -> Vec<f64> {
        let mut left = run;
        let mut parts = Vec::new();
        for axis in self.0.iter().rev() {
            parts.push(&axis.rows[left % axis.rows.len()]);
            left /= axis.rows.len();
        }
        parts.into_iter().rev().flatten().copied().collect()
    }

    /// All of it, so that two sweeps can be told apart.
    pub fn to_json(&self) -> Value {
        let axes = self.0.iter();
        axes.map(|axis| json!({"names": axis.names, "rows": axis.rows}))
            .collect()
    }
}

/// `FROM:TO:COUNT`, both ends with it, or a list.
fn range_or_list(text: &str) -> Result<Vec<f64>> {
    let parts: Vec<&str> = text.split(':').collect();
    if let [from, to, count] = parts[..] {
        let [from, to] = [number(from)?, number(to)?];
        let count: usize = count
            .trim()
            .parse()
            .ok()
            .filter(|count| (1..=MOST).contains(count))
            .with_context(|| format!("expected a number of values, found {count:?}"))?;
        let last = (count - 1).max(1) as f64;
        // Both ends to the bit.
        let at = |k: usize| match k {
            0 => from,
            k if k + 1 == count => to,
            k => from + (to - from) * (k as f64 / last),
        };
        return Ok((0..count).map(at).collect());
    }
    text.split(',').map(number).collect()
}

fn number(text: &str) -> Result<f64> {
    let parsed = text.trim().parse().ok();
    parsed
        .filter(|value: &f64| value.is_finite())
        .with_context(|| format!("expected a number, found {text:?}"))
}

/// The name of a column; quotation marks stand around all of it or nowhere.
fn title(field: &str) -> Result<&str> {
    let field = field.trim();
    let inside = field
        .strip_prefix('"')
        .and_then(|rest| rest.strip_suffix('"'));
    let name = inside.unwrap_or(field);
    if name.contains('"') {
        bail!("expected names with quotation marks around them or none, found {field}")
    } else {
        Ok(name)
    }
}

/// The column of a CSV file that is named like a variable.
fn column(file: &Path, name: &str) -> Result<Vec<f64>> {
    let text =
        std::fs::read_to_string(file).with_context(|| format!("cannot read {}", file.display()))?;
    // Spreadsheets of some systems begin a file with a mark of its encoding.
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let Some(line) = lines.next() else {
        bail!("{}: expected names in the first line", file.display());
    };
    let titles = line.split(',').map(title);
    let header: Vec<&str> = titles
        .collect::<Result<_>>()
        .with_context(|| format!("{}, first line", file.display()))?;
    let mut places = (0..header.len()).filter(|place| header[*place] == name);
    let place = places.next().with_context(|| {
        format!(
            "{}: expected a column {name}, found {}",
            file.display(),
            header.join(", ")
        )
    })?;
    if places.next().is_some() {
        bail!(
            "{}: expected one column {name}, found {}",
            file.display(),
            2 + places.count()
        );
    }
    let mut found = Vec::new();
    for (index, line) in lines.enumerate() {
        let fields: Vec<&str> = line.split(',').collect();
        let row = || format!("{}, row {}", file.display(), index + 1);
        if fields.len() != header.len() {
            bail!(
                "{}: expected {} fields as in the first line, found {}",
                row(),
                header.len(),
                fields.len()
            );
        }
        found.push(number(fields[place]).with_context(row)?);
    }
    if found.is_empty() {
        bail!("{}: expected rows of samples, found none", file.display());
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(options: &[&str]) -> Result<Axes> {
        Axes::parse(&options.iter().map(|&text| text.into()).collect::<Vec<_>>())
    }

    #[test]
    fn runs_are_every_combination() -> Result<()> {
        let axes = parsed(&["a=1:2:3", "b=10,20"])?;
        let runs: Vec<Vec<f64>> = (0..axes.count()).map(|run| axes.values(run)).collect();
        assert_eq!(axes.names(), ["a", "b"]);
        assert_eq!(
            runs,
            [
                [1.0, 10.0],
                [1.0, 20.0],
                [1.5, 10.0],
                [1.5, 20.0],
                [2.0, 10.0],
                [2.0, 20.0]
            ]
        );
        Ok(())
    }

    #[test]
    fn columns_of_samples_move_together() -> Result<()> {
        let folder = std::env::temp_dir().join(format!("flexbody-axes-{}", std::process::id()));
        std::fs::create_dir_all(&folder)?;
        let file = folder.join("samples.csv");
        std::fs::write(&file, "\"a\", b[2]\n1, 5\n2, 6\n\n3, 7\n")?;
        let at = file.display();
        let axes = parsed(&[&format!("b[2]=@{at}"), "c=0,1", &format!("a=@{at}")])?;
        assert_eq!(axes.names(), ["b[2]", "a", "c"]);
        assert_eq!(axes.count(), 6);
        assert_eq!(axes.values(3), [6.0, 2.0, 1.0]);
        let error = parsed(&[&format!("d=@{at}")]).err().context("no column")?;
        assert!(format!("{error:#}").contains("expected a column d, found a, b[2]"));
        for (header, told) in [
            ("a,b,a", "expected one column a, found 2"),
            (
                "\"a,b",
                "expected names with quotation marks around them or none, found \"a",
            ),
            (
                "a,b\"",
                "expected names with quotation marks around them or none, found b\"",
            ),
        ] {
            std::fs::write(&file, format!("{header}\n1,2,3\n"))?;
            let error = parsed(&[&format!("a=@{at}")]).err().context(header)?;
            assert!(format!("{error:#}").contains(told), "{error:#}");
        }
        std::fs::write(&file, "\u{feff}a,b\r\n1,5\r\n2,6\r\n")?;
        assert_eq!(parsed(&[&format!("a=@{at}")])?.values(1), [2.0]);
        std::fs::remove_dir_all(&folder)?;
        Ok(())
    }

    #[test]
    fn what_is_wrong_is_named() -> Result<()> {
        for (option, found) in [
            ("a", "expected NAME=FROM:TO:COUNT"),
            ("a=1:2:0", "expected a number of values, found \"0\""),
            ("a=1,x", "expected a number, found \"x\""),
            ("a=1,inf", "expected a number, found \"inf\""),
            ("a=@none.csv", "cannot read none.csv"),
        ] {
            let error = parsed(&[option]).err().context("an error")?;
            let error = format!("{error:#}");
            assert!(error.starts_with(&format!("--vary {option}: ")), "{error}");
            assert!(error.contains(found), "{error}");
        }
        let error = parsed(&["a=1", "a=2"]).err().context("an error")?;
        assert!(error.to_string().contains("a is varied already"));
        let error = parsed(&["a=1:2:100000", "b=1:2:100000"]).err();
        assert!(error.context("an error")?.to_string().contains("at most"));
        Ok(())
    }
}
