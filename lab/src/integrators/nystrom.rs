//! A Nystrom pair of order 6 for the product's method. It amplifies the fastest waves a little at any
//! step beyond 0.57 of their period over 2 pi, and is run here without a limit.
//!
//! Source: J. R. Dormand, M. E. A. El-Mikkawy, P. J. Prince, Families of Runge-Kutta-Nystrom formulae, IMA J.
//! Numer. Anal. 7 (1987) 235-250: RKN6(4)6FM (Table 5).

use flexbody::integrators::Tableau;

/// Order 6 with 4, five evaluations a step.
pub static RKN64: Tableau = Tableau {
    name: "rkn64",
    limit: f64::INFINITY,
    c: &[0.0, 0.1, 0.3, 0.7, 17.0 / 25.0, 1.0],
    a: &[
        &[],
        &[1.0 / 200.0],
        &[-1.0 / 2_200.0, 1.0 / 22.0],
        &[637.0 / 6_600.0, -7.0 / 110.0, 7.0 / 33.0],
        &[
            225_437.0 / 1_968_750.0,
            -30_073.0 / 281_250.0,
            65_569.0 / 281_250.0,
            -9_367.0 / 984_375.0,
        ],
        &[
            151.0 / 2_142.0,
            5.0 / 116.0,
            385.0 / 1_368.0,
            55.0 / 168.0,
            -6_250.0 / 28_101.0,
        ],
    ],
    rates: &[
        151.0 / 2_142.0,
        25.0 / 522.0,
        275.0 / 684.0,
        275.0 / 252.0,
        -78_125.0 / 112_404.0,
        1.0 / 12.0,
    ],
    error: [
        &[
            151.0 / 2_142.0 - 1_349.0 / 157_500.0,
            5.0 / 116.0 - 7_873.0 / 50_000.0,
            385.0 / 1_368.0 - 192_199.0 / 900_000.0,
            55.0 / 168.0 - 521_683.0 / 2_100_000.0,
            -6_250.0 / 28_101.0 + 16.0 / 125.0,
            0.0,
        ],
        &[
            151.0 / 2_142.0 - 1_349.0 / 157_500.0,
            25.0 / 522.0 - 7_873.0 / 45_000.0,
            275.0 / 684.0 - 27_457.0 / 90_000.0,
            275.0 / 252.0 - 521_683.0 / 630_000.0,
            -78_125.0 / 112_404.0 + 2.0 / 5.0,
            0.0,
        ],
    ],
    power: 5.0,
};
