//! Coefficients of the Radau IIA method of order 5, three stages.
//!
//! Source: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed., section IV.8.

/// Nodes.
pub const C: [f64; 3] = [0.155_051_025_721_682_2, 0.644_948_974_278_317_8, 1.0];
/// Real eigenvalue of the inverse Runge-Kutta matrix.
pub const GAMMA: f64 = 3.637_834_252_744_496;
/// Real part of its complex pair.
pub const ALPHA: f64 = 2.681_082_873_627_752;
/// Imaginary part of the pair.
pub const BETA: f64 = 3.050_430_199_247_410_5;
/// Transformation that makes the inverse Runge-Kutta matrix block diagonal: `z = T w`.
pub const T: [[f64; 3]; 3] = [
    [
        0.091_232_394_870_892_94,
        -0.141_255_295_020_954_2,
        -0.030_029_194_105_147_424,
    ],
    [
        0.241_717_932_707_107,
        0.204_129_352_293_799_93,
        0.382_942_112_757_261_9,
    ],
    [0.966_048_182_615_093, 1.0, 0.0],
];
/// Inverse of [`T`].
pub const INVERSE: [[f64; 3]; 3] = [
    [
        4.325_579_890_063_155,
        0.339_199_251_815_809_87,
        0.541_770_539_935_874_9,
    ],
    [
        -4.178_718_591_551_905,
        -0.327_682_820_761_062_4,
        0.476_623_554_500_550_45,
    ],
    [
        -0.502_872_634_945_786_9,
        2.571_926_949_855_605,
        -0.596_039_204_828_224_9,
    ],
];
/// Inverse of the Runge-Kutta matrix.
pub const A_INVERSE: [[f64; 3]; 3] = [
    [
        3.224_744_871_391_589,
        1.167_840_084_690_405_5,
        -0.253_197_264_742_180_8,
    ],
    [
        -3.567_840_084_690_405_5,
        0.775_255_128_608_411,
        1.053_197_264_742_180_8,
    ],
    [5.531_972_647_421_809, -7.531_972_647_421_809, 5.0],
];
/// Weights of the stages in an integral.
pub const B: [f64; 3] = [0.376_403_062_700_467_3, 0.512_485_826_188_421_6, 1.0 / 9.0];
/// Weights of the stages in the error estimate.
pub const ERROR: [f64; 3] = [-10.048_809_399_827_415, 1.382_142_733_160_749, -1.0 / 3.0];
