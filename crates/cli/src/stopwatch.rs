//! Floor 11. CPU time of many short calls.

use std::time::Duration;

use cpu_time::ThreadTime;

/// Empty calls that are timed to know what reading the clock adds.
const EMPTY: usize = 101;

/// CPU time that this thread spends in calls, with other work between them that does not count.
pub struct Stopwatch {
    /// Total time of all calls, each with the overhead of reading the clock.
    total: Duration,
    calls: u64,
    /// Overhead of reading the clock: the median over empty calls. It is some tenths of a microsecond, as much as a
    /// cheap step takes. Reading the clock also slows the following code a little, and that stays in the total.
    reading: Duration,
}

impl Stopwatch {
    /// Nothing yet.
    pub fn new() -> Self {
        let mut empty = [(); EMPTY].map(|()| ThreadTime::now().elapsed());
        empty.sort_unstable();
        Self {
            total: Duration::ZERO,
            calls: 0,
            reading: empty[EMPTY / 2],
        }
    }

    /// Calls, and counts the time.
    pub fn time<T>(&mut self, call: impl FnOnce() -> T) -> T {
        let started = ThreadTime::now();
        let outcome = call();
        self.total += started.elapsed();
        self.calls += 1;
        outcome
    }

    /// CPU time of all calls less what reading the clock added, s.
    pub fn seconds(&self) -> f64 {
        let reading = self.calls as f64 * self.reading.as_secs_f64();
        (self.total.as_secs_f64() - reading).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_calls_took_counts_less_the_readings() {
        let milliseconds = Duration::from_millis;
        let mut stopwatch = Stopwatch {
            total: milliseconds(30),
            calls: 4,
            reading: milliseconds(5),
        };
        assert!((stopwatch.seconds() - 0.01).abs() < 1e-12);
        stopwatch.calls = 7;
        assert_eq!(stopwatch.seconds(), 0.0);
        assert_eq!(stopwatch.time(|| 3), 3);
        assert_eq!(stopwatch.calls, 8);
    }
}
