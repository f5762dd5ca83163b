//! Values, derivatives and turns of switches, against those found by hand.

use super::*;
use crate::math::expression::Expression;

/// All times up to `until` at which branches turn over, each searched from just after the one before.
fn breaks(text: &str, from: f64, until: f64) -> Vec<f64> {
    let f = Expression::new(text).expect(text);
    let next = |t: &f64| f.next_break(*t + grain(*t), until);
    std::iter::successors(f.next_break(from, until), next).collect()
}

/// Value and derivatives on either side, by hand.
#[test]
fn switches_have_values_and_derivatives_of_their_branches() {
    let cases: [(&str, f64, [f64; 3]); 24] = [
        ("abs(t-1)", 0.25, [0.75, -1.0, 0.0]),
        ("abs(t-1)^3", 3.0, [8.0, 12.0, 12.0]),
        ("sign(t-1)", 0.5, [-1.0, 0.0, 0.0]),
        ("sign(t-1)", 1.0, [0.0, 0.0, 0.0]),
        ("sign(t-1)*t", 2.0, [2.0, 1.0, 0.0]),
        ("step(t-1)*t^2", 1.0, [1.0, 2.0, 2.0]),
        ("step(t-1)*t^2", 0.9, [0.0, 0.0, 0.0]),
        ("min(t, t^2)", 0.5, [0.25, 1.0, 2.0]),
        ("min(t, t^2)", 2.0, [2.0, 1.0, 0.0]),
        ("max(t, t^2)", 2.0, [4.0, 4.0, 2.0]),
        ("max(1, t, t^2)", 0.5, [1.0, 0.0, 0.0]),
        ("max(1, t, t^2)", 3.0, [9.0, 6.0, 2.0]),
        ("min(3*t, 2*t, t)", 1.0, [1.0, 1.0, 0.0]),
        ("if(t - 1, t^2, -t)", 1.0, [-1.0, -1.0, 0.0]),
        ("if(t > 1, t^2, -t)", 2.0, [4.0, 4.0, 2.0]),
        ("if(t < 1, ln(t), sqrt(t-1))", 1.25, [0.5, 1.0, -2.0]),
        ("(t >= 1)*5 + (t <= 1) + 2*(t < 1)", 1.0, [6.0, 0.0, 0.0]),
        ("1 + t > 2", 1.5, [1.0, 0.0, 0.0]),
        ("min(-2, 3) + 0*t", 1.0, [-2.0, 0.0, 0.0]),
        ("atan2(t, 2)", 1.0, [0.5_f64.atan(), 0.4, -0.16]),
        ("atan2(2, t)", 1.0, [2.0_f64.atan(), -0.4, 0.16]),
        ("atan2(sin(t), cos(t))", 2.5, [2.5, 1.0, 0.0]),
        ("atan2(sin(t), cos(t))", -2.0, [-2.0, 1.0, 0.0]),
        ("-abs(t)^2", 3.0, [-9.0, -6.0, -2.0]),
    ];
    for (text, t, wanted) in cases {
        let f = Expression::new(text).expect(text);
        let found = f.derivatives(t);
        assert!((f.value(t) - wanted[0]).abs() < 1e-14, "{text}");
        for order in 0..3 {
            let error = (found[order] - wanted[order]).abs();
            assert!(error < 1e-13, "{text}: {found:?}, expected {wanted:?}");
        }
    }
}

#[test]
fn every_turn_is_found_and_nothing_else() {
    use std::f64::consts::TAU;
    let cases: [(&str, f64, &[f64]); 20] = [
        ("step(t-0.5)", 10.0, &[0.5]),
        ("step(0.5-t)", 10.0, &[0.5]),
        ("abs(sin(2*PI*t))", 2.2, &[0.5, 1.0, 1.5, 2.0]),
        ("min(t, 1)", 1e6, &[1.0]),
        ("max(0, min(1, 5*(t-0.7)))", 3.0, &[0.7, 0.9]),
        ("if(t^2 - 2, 1, t)", 3.0, &[std::f64::consts::SQRT_2]),
        ("sign(exp(-t) - 0.25)", 9.0, &[2.0 * std::f64::consts::LN_2]),
        ("sign(1/(t-1))", 3.0, &[1.0]),
        ("1/(t-1)", 3.0, &[1.0]),
        ("1/(t-1)^2 + t/3", 3.0, &[]),
        ("tan(t)", 5.0, &[FRAC_PI_2, 3.0 * FRAC_PI_2]),
        ("(t >= 1)*(t < 2)", 3.0, &[1.0, 2.0]),
        // Where it touches zero nothing turns over.
        ("abs(t^2 - 2*t + 1)", 3.0, &[]),
        ("max(0, 1.0000001 - cos(2*PI*t))", 3.5, &[]),
        ("abs(t^2)", 3.0, &[]),
        ("max(0*t, t - t)", 3.0, &[]),
        ("max(min(t, 2) - 2, 0)", 9.0, &[2.0]),
        // Two turns that samples would overlook.
        ("step(1e-12 - (t-1)^2)", 1000.0, &[1.0 - 1e-6, 1.0 + 1e-6]),
        ("step(sin(t/1e3) - 0.5)", 1000.0, &[1000.0 * TAU / 12.0]),
        (
            "tan(abs(t - 0.2)) + sqrt(t) + t^t + acos(t/9)",
            3.0,
            &[0.2, 0.2 + FRAC_PI_2],
        ),
    ];
    for (text, until, wanted) in cases {
        let found = breaks(text, 1e-9, until);
        assert_eq!(found.len(), wanted.len(), "{text}: {found:?}");
        for (found, wanted) in found.iter().zip(wanted) {
            let error = (found - wanted).abs();
            assert!(error < 1e-9 * wanted, "{text}: {found}, expected {wanted}");
        }
    }
}

#[test]
fn the_cut_of_the_angle_is_found() {
    let found = breaks("atan2(sin(t), cos(t))", 0.1, 9.0);
    assert!(found.iter().any(|t| (t - PI).abs() < 1e-14), "{found:?}");
}

/// Infinitely many: the next one comes on demand, and each within a few hundred evaluations.
#[test]
fn fast_switches_over_long_times_are_found_one_by_one() {
    let f = Expression::new("abs(sin(1e5*t))").expect("an expression");
    let mut t = 1e-7;
    for k in 1..2000 {
        t = f.next_break(t + grain(t), 1e4).expect("another");
        let wanted = f64::from(k) * PI / 1e5;
        assert!((t - wanted).abs() < 1e-14, "{t}, expected {wanted}");
    }
}

#[test]
fn a_search_is_bounded() {
    // Nowhere more than roundoff: nothing can be proven.
    let f = Expression::new("step(sin(t)^2 + cos(t)^2 - 1)").expect("an expression");
    let _ = f.next_break(0.0, 100.0);
    let f = Expression::new("abs(1/sin(1e9*t)) + step(sin(1e12*t))").expect("an expression");
    assert!(f.next_break(0.0, 1e3).is_some());
}

#[test]
fn the_same_question_has_the_same_answer() {
    let f = Expression::new("abs(sin(3*t)) + min(t, 2 - t)").expect("an expression");
    let first = f.next_break(0.3, 5.0);
    let other = f.next_break(0.31, 5.0);
    assert_eq!(first, f.next_break(0.3, 5.0));
    let (a, b) = (first.unwrap_or(0.0), other.unwrap_or(9.0));
    assert!((a - b).abs() < grain(a));
}
