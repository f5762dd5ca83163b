//! Flexbody: flexible bodies as FMI co-simulation units.
//!
//! A scene in JSON becomes a simulation, and a simulation becomes a unit that any FMI 2.0 master can
//! load. Modules stand on floors; each imports only lower ones:
//!
//! | floor | module | holds |
//! |---|---|---|
//! | 0 | [`math`] | quadrature, structured solves, factorizations |
//! | 1 | [`elements`] | mass, force and tangent of a finite element |
//! | 2 | [`bodies`] | bodies behind one interface, elimination of constraints, markers |
//! | 3 | [`system`] | the constant system, its state, joints and loads |
//! | 4 | [`integrators`] | time stepping with error control |
//! | 5 | [`scene`] | JSON to a validated scene to a system |
//! | 6 | [`simulation`] | a scene with parameters and inputs, stepped in time |
//! | 7 | [`picture`] | colours, and symbols of joints, springs, motions and loads as strokes |
//! | 8 | [`view`] | a run as a picture that moves |
//! | 9 | [`page`] | drawing of a scene, and the page that comes with a unit |
//! | 10 | [`fmi`] | what all versions of FMI share: instance, lifecycle, states, logger |
//! | 11 | [`fmi2`] | model description and C interface of FMI 2.0 |
//!
//! # Example
//!
//! A stone that is released falls by `g t^2 / 2`:
//!
//! ```
//! use flexbody::{scene::Scene, simulation::Simulation};
//!
//! let scene = Scene::from_json(
//!     r#"{
//!         "name": "stone", "dimension": 2, "gravity": [0.0, -9.81],
//!         "bodies": [{ "name": "stone", "element": "rigid", "mass": 2.0, "position": [0.0, 0.0],
//!                      "markers": { "centre": [0.0, 0.0] } }],
//!         "outputs": [{ "kind": "position", "marker": "stone.centre" }]
//!     }"#,
//! )?;
//! let mut simulation = Simulation::new(scene);
//! let names = simulation.variables();
//! let height = names.iter().position(|variable| variable.name == "stone.centre.position[2]").unwrap();
//!
//! simulation.initialize(0.0)?;
//! simulation.start()?;
//! for point in 1..=10 {
//!     simulation.step(0.1 * f64::from(point))?;
//! }
//! assert!((simulation.real(height)? + 0.5 * 9.81).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod bodies;
pub mod elements;
pub mod fmi;
pub mod fmi2;
pub mod integrators;
pub mod math;
pub mod page;
pub mod picture;
pub mod scene;
pub mod simulation;
pub mod system;
pub mod view;
