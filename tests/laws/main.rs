//! Physical laws on random elements, bodies and systems. What is compared with is written here anew:
//! quadrature, differences, dense matrices, augmented equations.

mod bodies;
mod chain;
mod differences;
mod elements;
mod planar;
mod printed;
mod solves;
mod space;
mod reactions;
mod spatial;
mod specimen;
mod motion;
