//! The rules of the house, as checks that read the project's own text (`ARCHITECTURE.md` lists them).

mod docs;
mod generated;
mod manifests;
mod names;
mod prose;
mod rooms;
mod sizes;
mod source;
mod unsafety;
