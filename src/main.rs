//! Headless runner.
fn main(){}
