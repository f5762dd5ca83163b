//! Nodes of the frames that an unstressed line carries.

use nalgebra::Vector3;

use crate::bodies::connectivity::Node;
use crate::bodies::stages::rotated;
use crate::math::space::vector;

/// Axes of frames transported along a line, whose tangents are those at parts in [0, 1] of its elements, by so many smallest rotations an element
/// (one where a plane holds it; else the angle that they miss falls with the square of their number), the first of them with this second
/// axis, and then rotated about the tangent by the angles of these twists, rad: position and axes in two nodes each.
pub fn transported_nodes<const D: usize>(
    line: &[Node<D>],
    second: [f64; 3],
    (tangent, steps): (impl Fn(usize, f64) -> [f64; 3], u32),
    twists: impl Iterator<Item = f64>,
) -> Vec<Node<D>> {
    let mut second = Vector3::from(second);
    let mut t = Vector3::from(tangent(0, 0.0));
    let mut nodes = Vec::with_capacity(2 * line.len());
    for (j, (node, twist)) in line.iter().zip(twists).enumerate() {
        for step in (1..=steps).take_while(|_| j > 0) {
            let next = Vector3::from(tangent(j - 1, f64::from(step) / f64::from(steps)));
            second = rotated(&t, &next, &second);
            t = next;
        }
        second = (second - t * t.dot(&second)).normalize();
        let (sin, cos) = twist.sin_cos();
        let turned = second * cos + t.cross(&second) * sin;
        let [a, b, c] =
            [t, turned, t.cross(&turned)].map(|axis| vector::<D, f64>(axis.into()).into());
        nodes.extend([[node[0], a], [b, c]]);
    }
    nodes
}
