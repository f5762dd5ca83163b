//! Small FMI 2.0 co-simulation units that Flexbody's FMUs are coupled with in tests and examples:
//! linear models, integrated exactly for inputs that are polynomials of degree 2 over a step.
//! What a coupled run gets wrong is then the coupling's.
//!
//! One library holds all models; `fmi2Instantiate` picks one by its GUID.

pub mod abi;
pub mod description;
mod instance;
mod linear;
mod model;
mod models;

pub use model::Model;
pub use models::ALL;
