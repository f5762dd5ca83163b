//! Physical laws on random elements, bodies, systems and mechanisms. What is compared with is written
//! here anew: quadrature, differences, dense matrices, augmented equations.

mod acting;
mod balance;
mod bodies;
mod built;
mod chain;
mod closed;
mod dense;
mod differences;
mod driven;
mod elements;
mod frames;
mod least;
mod linkage;
mod links;
mod mechanics;
mod mechanism;
mod motion;
mod moved;
mod moved_bodies;
mod pinned;
mod planar;
mod ports;
mod projection;
mod random;
mod reactions;
mod rigid;
mod solves;
mod space;
mod spatial;
mod specimen;
mod spectra;
mod spinning;
mod sprung;
mod tangents;
mod whirl;
