//! Flexbody.
