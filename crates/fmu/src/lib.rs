//! The shared library inside every FMU. It exports the functions of FMI 2.0, which are in `src/fmi2/abi.rs` of the package `flexbody`.

use flexbody as _;
