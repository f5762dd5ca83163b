//! Flexbody: flexible bodies as FMI co-simulation units.
//!
//! A scene in JSON becomes a simulation, and a simulation becomes a unit that any FMI 2.0 master can
//! load. Modules stand on floors; each imports only lower ones:
//!
//! | floor | module | holds |
//! |---|---|---|
//! | 0 | [`math`] | quadrature, structured solves, factorizations |
//! | 1 | [`elements`] | mass, force and tangent of a finite element |
//! | 2 | [`body`] | connectivity, elimination of constraints, markers |
//! | 3 | [`system`] | the constant system, its state, joints and loads |
//! | 4 | [`integrators`] | time stepping with error control |
//! | 5 | [`scene`] | JSON to a validated scene to a system |
//! | 6 | [`simulation`] | a scene with parameters and inputs, stepped in time |
//! | 7 | [`view`] | a run as a picture that moves |
//! | 8 | [`page`] | drawing of a scene, and the page that comes with a unit |
//! | 9 | [`fmi`] | what all versions of FMI share: instance, lifecycle, states, logger |
//! | 10 | [`fmi2`] | model description and C interface of FMI 2.0 |

pub mod body;
pub mod elements;
pub mod fmi;
pub mod fmi2;
pub mod integrators;
pub mod math;
pub mod page;
pub mod scene;
pub mod simulation;
pub mod system;
pub mod view;

// Laws use generic code throughout, which every test of its own would compile anew.
#[cfg(test)]
extern crate self as flexbody;
#[cfg(test)]
#[path = "../tests/laws/mod.rs"]
mod laws;
