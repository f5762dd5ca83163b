//! Scenes that both programs run, and the product's meshes and tolerances.

/// A scene, as the product runs it; the rest is in the settings of Exudyn.
pub struct Case {
    /// Name in the settings.
    pub name: &'static str,
    /// Name on the page.
    pub title: &'static str,
    /// Start values.
    pub set: &'static [(&'static str, f64)],
    /// Parameters that hold numbers of elements, each with its multiple.
    pub elements: &'static [(&'static str, u32)],
    /// Numbers of elements, times those multiples.
    pub meshes: &'static [u32],
    /// Relative tolerances.
    pub tolerances: &'static [f64],
    /// The product's finest run, which confirms the reference.
    pub finest: (u32, f64),
    /// How many times less CPU time is wanted at an error.
    pub wanted: &'static [(f64, f64)],
}

const ROD: &[(&str, u32)] = &[("rod.elements", 1)];
const STEEL: &[(&str, f64)] = &[("rod.youngs_modulus", 2.07e11), ("rod.density", 7800.0)];
/// All of them.
pub const CASES: [Case; 6] = [
    Case {
        name: "soft_pendulum",
        title: "soft pendulum",
        set: &[],
        elements: ROD,
        meshes: &[5, 10, 20, 30, 40, 60, 80, 160, 320],
        tolerances: &[1e-3, 1e-4, 1e-5, 1e-6],
        finest: (320, 1e-7),
        wanted: &[(1e-3, 100.0), (1e-4, 50.0)],
    },
    Case {
        name: "steel_pendulum",
        title: "steel pendulum",
        set: STEEL,
        elements: ROD,
        meshes: &[1, 2, 4, 8, 16],
        tolerances: &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7],
        finest: (32, 1e-8),
        wanted: &[(1e-3, 20.0), (1e-5, 20.0)],
    },
    Case {
        name: "flying_spaghetti",
        title: "flying spaghetti",
        set: &[],
        elements: ROD,
        meshes: &[6, 8, 12, 16, 24, 32, 48, 64, 128],
        tolerances: &[1e-3, 1e-4, 1e-5, 1e-6],
        finest: (128, 1e-8),
        wanted: &[],
    },
    Case {
        name: "spin_up",
        title: "spin-up",
        set: &[],
        elements: ROD,
        meshes: &[1, 2, 3, 4, 8, 16],
        tolerances: &[1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8],
        finest: (64, 1e-8),
        wanted: &[],
    },
    Case {
        name: "slider_crank",
        title: "slider-crank",
        set: &[],
        elements: &[("crank.elements", 1), ("rod.elements", 2)],
        meshes: &[1, 2, 4, 8, 16],
        tolerances: &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6],
        finest: (32, 1e-7),
        wanted: &[],
    },
    Case {
        name: "catenary",
        title: "swinging catenary",
        set: &[],
        elements: ROD,
        meshes: &[4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128],
        tolerances: &[1e-3, 1e-5, 1e-7],
        finest: (320, 1e-8),
        wanted: &[],
    },
];
