//! Physical laws on random elements, bodies and systems. What is compared with is written here anew:
//! quadrature, differences, dense matrices, augmented equations.

mod bodies;
mod chain;
mod differences;
mod elements;
mod motion;
mod planar;
mod printed;
mod reactions;
mod solves;
mod spatial;
mod specimen;
