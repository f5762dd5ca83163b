//! Floor 2. Bodies as nodes: chains of elements through them, points on bodies, linear constraints
//! between nodes and their elimination, and the structured tangent solve.

mod all;
mod articulated;
mod assembly;
mod body;
mod chain;
mod connectivity;
mod drawn;
mod elimination;
mod frame;
mod jacobian;
mod layout;
mod line;
mod linearized;
mod loaded_line;
mod lumped;
mod map;
mod marker;
mod mechanics;
mod nodes;
mod patch;
mod probe;
mod reduced;
mod rod_chain;
mod setup;
mod stages;
mod sums;
mod tangent;
pub mod winch;

pub use all::Bodies;
pub use articulated::{Articulated, Link};
pub use assembly::{Assembly, Links, NodeBlock, block_of_parts, no_block};
pub use body::NodalMotion;
pub use chain::Chain;
pub use connectivity::{
    Cluster, ConnectivityRow, Dependent, Node, RANK_TOLERANCE, add_node, map_node, no_node,
    node_frame_acceleration, product, tied_with,
};
pub use drawn::LineStance;
pub use elimination::Elimination;
pub use frame::{
    AngularAccelerations, Axes, AxisMotion, Derivative, RENEWED, RigidBodyFrame, SectionFrame,
    axes_at, axis_rates, combined, completed, rotation_block, spin_at,
};
pub use jacobian::{Jacobian, SparseRows};
pub use linearized::{ElementTangent, LinearTerms, LinearizationPoint};
pub use loaded_line::{LinePoint, LoadedLine, PANELS};
pub use lumped::{LumpedMass, RigidRod};
pub use map::{Rotations, ScratchVectors};
pub use marker::{Marker, Partial, block_of};
pub use nodes::NodeKind;
pub use patch::{GridStress, Patch, PatchPoint, SectionFaces, stress_at};
pub use probe::{NodeBlocks, Nodes, Probe, SKEW};
pub use reduced::ReducedBody;
pub use rod_chain::{RodChain, middle, planar_axes, rotate_inner, transported_nodes, untwisted};
pub use stages::{RotatingNodes, STAGES};
pub use tangent::Tangent;
pub use winch::Winch;

use crate::elements::cable::Cable;

/// The line of a flexible body.
pub type LineChain<const D: usize = 2> = Chain<Cable<D>, D>;
