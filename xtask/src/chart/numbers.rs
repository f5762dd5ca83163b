//! Small statistics, and numbers as the page shows them.

/// The middle value; the mean of the two middle ones where their number is even.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => sorted[n / 2],
        n => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}

/// Largest size so far of a curve over time, at every tenth point.
pub fn peaks(curve: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut largest = 0.0_f64;
    let so_far = curve.iter().map(|(time, value)| {
        largest = largest.max(value.abs());
        (*time, largest)
    });
    so_far.skip(10).step_by(10).collect()
}

/// Slope of the straight line through two points on logarithmic axes.
pub fn slope(a: (f64, f64), b: (f64, f64)) -> f64 {
    (b.1 / a.1).ln() / (b.0 / a.0).ln()
}

/// Slope of the line of least squares on logarithmic axes; nothing where the points have no two
/// different abscissae.
pub fn fitted_slope(points: &[(f64, f64)]) -> Option<f64> {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let mean_x = logs.iter().map(|p| p.0).sum::<f64>() / count;
    let mean_y = logs.iter().map(|p| p.1).sum::<f64>() / count;
    let spread: f64 = logs.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    let common: f64 = logs.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum();
    (spread > 1e-3).then(|| common / spread)
}

/// Time needed for an error, from points of time and error, the tolerance tightening from one to the
/// next: the least over the points that are at least as good and over the straight lines between
/// neighbours on logarithmic axes. Nothing where no point is as good.
pub fn needed_for(points: &[(f64, f64)], error: f64) -> Option<f64> {
    let good = points.iter().filter(|point| point.1 <= error);
    let between = points.windows(2).filter_map(|pair| {
        let [a, b] = [pair[0], pair[1]];
        let inside = (b.1..a.1).contains(&error);
        let part = (error / a.1).ln() / (b.1 / a.1).ln();
        inside.then(|| a.0 * (b.0 / a.0).powf(part))
    });
    good.map(|point| point.0)
        .chain(between)
        .min_by(f64::total_cmp)
}

/// Largest distance between two plane curves given point by point.
pub fn largest_distance(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| distance(*a, *b))
        .fold(0.0, f64::max)
}

/// Distance between two points.
pub fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Two digits, e.g. `3.1e-5`, `0.31`, `31`; zero is `0`.
pub fn short(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if !(0.01..99.5).contains(&size) {
        return format!("{value:.1e}");
    }
    let decimals = match size {
        9.95.. => 0,
        0.995.. => 1,
        0.0995.. => 2,
        _ => 3,
    };
    format!("{value:.decimals$}")
}

/// A time in milliseconds with three digits.
pub fn milliseconds(seconds: f64) -> String {
    three_digits(1e3 * seconds)
}

/// Three digits without an exponent.
pub fn three_digits(value: f64) -> String {
    let before = value.abs().log10().floor().clamp(-3.0, 2.0);
    format!("{value:.*}", (2.0 - before) as usize)
}
