//! Torsion and flexure of a bar whose section is a polygon with holes, as Saint-Venant posed them, by finite elements.
//!
//! Torsion is solved twice. The warping function `w` makes the stress compatible, the stress function `p` keeps it in balance. With
//! `d = (w_y - z, w_z + y)` and `s = (p_z, -p_y)` the torsion constant is between the integrals of `s^2` and of `d^2`, which differ by the
//! integral of `(d - s)^2`: its parts in the triangles say where finer ones are needed. The mean of both is good to half of the difference.
//!
//! Flexure is that under a shear force `Q`, with `a = I^-1 Q`: warping `c / E` has `lap c = -2 a x`, without slope across the outline but for a
//! part with Poisson's ratio that needs no solution of its own. Shear strain is the difference of the mean displacement's slope and of the
//! mean rotation, as Cowper has it: `E g = (C0 + nu C1) Q`.
//!
//! Source: E. Trefftz, Ein Gegenstück zum Ritzschen Verfahren, Proc. 2nd Int. Congr. Appl. Mech., Zürich (1926) 131-137, and W. Prager,
//! J. L. Synge, Approximations in elasticity based on the concept of function space, Quart. Appl. Math. 5 (1947) 241-269 (bounds); E. Trefftz,
//! Über den Schubmittelpunkt in einem durch eine Einzellast gebogenen Balken, Z. angew. Math. Mech. 15 (1935) 220-225 (shear centre);
//! G. R. Cowper, The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33 (1966) 335-340 (shear strain); A. E. H. Love,
//! A Treatise on the Mathematical Theory of Elasticity, 4th ed. (1927), chapters 14 and 15 (both problems).

mod basis;
mod mesh;
mod outline;
mod space;
#[cfg(test)]
mod tests;

use nalgebra::{Matrix2, Vector2};

use basis::{NODES, Nodal, Reference, shapes};
use mesh::{Mesh, Point};
pub use outline::{Outline, OutlineFlaw, flaw};
use space::{Map, Space, dot};

/// Half of the difference of the bounds, as part of the torsion constant, that meshes are refined to.
pub const TORSION_ERROR: f64 = 1e-4;
/// Half of that difference where stress is read, which is off by the root of it in the mean.
pub const STRESS_ERROR: f64 = 1e-6;
/// Most points of a mesh.
const MOST_POINTS: usize = 6000;
/// Angle by which the material reaches around a corner beyond a straight one, where triangles are small from the start, rad.
const SHARP: f64 = 0.3;
/// Halvings of triangles towards such a corner.
const LAYERS: i32 = 8;
/// Part of the error whose triangles are split.
const BULK: f64 = 0.7;

/// Numbers of a section that follow from both problems.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearNumbers {
    /// Torsion constant, m^4.
    pub torsion_constant: f64,
    /// Bound of its error, as part of it.
    pub error: f64,
    /// Shear centre from the centroid, m.
    pub shear_center: [f64; 2],
    /// Young's modulus times the shear compliance without Poisson's ratio, and its increase by that ratio, 1/m^2.
    pub compliance: [Matrix2<f64>; 2],
}

/// Solution of torsion over a section, and its numbers.
#[derive(Clone, Debug)]
pub struct Torsion {
    /// Numbers of the section.
    pub numbers: ShearNumbers,
    mesh: Mesh,
    /// Warping and stress function in each triangle.
    functions: Vec<[Nodal; 2]>,
}

/// Both problems on one mesh.
struct Solved {
    numbers: ShearNumbers,
    functions: Vec<[Nodal; 2]>,
    /// Part of each triangle in the difference of the bounds.
    parts: Vec<f64>,
}

impl Torsion {
    /// Solves torsion and flexure of a section, with meshes that are refined until the torsion constant is known up to a part of it, or there are
    /// too many points. `None` where the outline has no triangulation.
    pub fn new(outline: &Outline, error: f64) -> Option<Self> {
        let mut mesh = Mesh::new(&outline.loops)?;
        let least = mesh.shortest();
        mesh.improve(MOST_POINTS / 2, 0.1 * least);
        for corner in outline.reentrant(SHARP) {
            let size = mesh.size_at(corner);
            mesh.grade(corner, size * 0.5_f64.powi(LAYERS));
        }
        mesh.improve(MOST_POINTS / 2, 0.1 * least * 0.5_f64.powi(LAYERS));
        let reference = Reference::new();
        loop {
            let solved = solve(outline, &mesh, &reference)?;
            if solved.numbers.error <= error || mesh.points.len() > MOST_POINTS {
                return Some(Self {
                    numbers: solved.numbers,
                    functions: solved.functions,
                    mesh,
                });
            }
            refine(&mut mesh, &solved.parts);
        }
    }

    /// Shear stress by torsion at a point about the centroid, by the torque, 1/m^3: the mean of both solutions. `None` outside.
    pub fn stress(&self, point: Point) -> Option<[f64; 2]> {
        let inside = |t: usize| {
            let [p, q] = Map::new(&self.mesh, t).back(point);
            p.min(q).min(1.0 - p - q)
        };
        let all = (0..self.mesh.triangles.len()).map(|t| (t, inside(t)));
        let (t, depth) = all.max_by(|a, b| a.1.total_cmp(&b.1))?;
        // On the outline up to roundoff.
        if depth < -1e-6 {
            return None;
        }
        let map = Map::new(&self.mesh, t);
        let at = shapes(map.back(point));
        let [warping, stress] = self.functions[t].map(|of| Space::gradient(&map, &at, &of));
        let [y, z] = point;
        let both = [warping[0] - z + stress[1], warping[1] + y - stress[0]];
        Some(both.map(|of| 0.5 * of / self.numbers.torsion_constant))
    }
}

/// Splits the triangles with the largest parts in the error.
fn refine(mesh: &mut Mesh, parts: &[f64]) {
    let mut order: Vec<usize> = (0..parts.len()).collect();
    order.sort_by(|a, b| parts[*b].total_cmp(&parts[*a]));
    let all: f64 = parts.iter().sum();
    let mut marked = Vec::new();
    let mut sum = 0.0;
    for t in order {
        if sum >= BULK * all {
            break;
        }
        sum += parts[t];
        marked.push((t, mesh.triangles[t].corners));
    }
    for (t, corners) in marked {
        // Points that were added for others may have changed it.
        if mesh.triangles[t].corners == corners {
            mesh.refine(t);
        }
    }
}

/// Solves torsion and flexure on a mesh.
fn solve(outline: &Outline, mesh: &Mesh, reference: &Reference) -> Option<Solved> {
    let space = Space::new(mesh, reference);
    let [warping, first, second] = loads(&space);
    // A constant more changes nothing: one number is held.
    let natural = space.factor(&|number| number == 0)?;
    let free = |load: &[f64]| {
        let mut right = load.to_vec();
        right[0] = 0.0;
        space.solve(&natural, right)
    };
    let (warped, flexed) = (free(&warping), [free(&first), free(&second)]);
    let (stressed, lower) = stress_function(outline, &space)?;
    let [about_first, about_second] = outline.second_moments;
    let upper = about_first + about_second - dot(&warped, &warping);
    let product = outline.product_moment;
    let inertia = Matrix2::new(about_second, product, product, about_first);
    let inverse = inertia.try_inverse()?;
    let moments = [&first, &second].map(|load| 0.5 * dot(load, &warped));
    let [up, back] = (inverse * Vector2::from(moments)).into();
    // Twice the products of coordinates and warping.
    let pairs = Matrix2::from_fn(|i, j| dot([&first, &second][i], &flexed[j]));
    let lateral = lateral_loads(&space);
    let lateral = Matrix2::from_fn(|i, j| dot(&lateral[j], &flexed[i]));
    let lateral = 0.25 * (lateral + lateral.transpose());
    let spread = 0.5 * (about_second - about_first);
    let deviator = Matrix2::new(spread, product, product, -spread);
    let warp = 0.5 * pairs;
    let shares = inverse * (warp + lateral) * inverse - deviator * inverse / outline.area;
    let functions: Vec<[Nodal; 2]> = (0..mesh.triangles.len())
        .map(|t| [&warped, &stressed].map(|of| space.local(t, of)))
        .collect();
    let parts = differences(&space, &functions);
    let torsion_constant = 0.5 * (upper + lower);
    let gap: f64 = parts.iter().sum();
    let numbers = ShearNumbers {
        torsion_constant,
        error: 0.5 * gap / torsion_constant,
        shear_center: [-back, up],
        compliance: [inverse * warp * inverse, shares],
    };
    Some(Solved {
        numbers,
        functions,
        parts,
    })
}

/// Loads of the warping function, and twice the coordinates as loads of both flexures.
fn loads(space: &Space<'_>) -> [Vec<f64>; 3] {
    let mut loads = [0; 3].map(|_| vec![0.0; space.len()]);
    for t in 0..space.mesh.triangles.len() {
        let map = Map::new(space.mesh, t);
        let lattice = map.lattice();
        let (z, back) = (lattice.map(|[_, z]| z), lattice.map(|[y, _]| -y));
        let local = map.divergence(space.reference, [&z, &back]);
        space.add(t, &local, &mut loads[0]);
        for k in 0..2 {
            let local = map.load(space.reference, &lattice.map(|at| 2.0 * at[k]));
            space.add(t, &local, &mut loads[1 + k]);
        }
    }
    loads
}

/// Loads by the lateral contraction of a section that bends: integrals of products with gradients.
fn lateral_loads(space: &Space<'_>) -> [Vec<f64>; 2] {
    let mut loads = [0; 2].map(|_| vec![0.0; space.len()]);
    for t in 0..space.mesh.triangles.len() {
        let map = Map::new(space.mesh, t);
        let lattice = map.lattice();
        let apart = lattice.map(|[y, z]| 0.5 * (y * y - z * z));
        let both = lattice.map(|[y, z]| y * z);
        let back = apart.map(|of| -of);
        for (load, field) in loads.iter_mut().zip([[&apart, &both], [&both, &back]]) {
            space.add(t, &map.divergence(space.reference, field), load);
        }
    }
    loads
}

/// The stress function, which is constant around each hole, and the lower bound of the torsion constant.
fn stress_function(outline: &Outline, space: &Space<'_>) -> Option<(Vec<f64>, f64)> {
    let fixed = space.factor(&|number| space.loops()[number].is_some())?;
    let triangles = 0..space.mesh.triangles.len();
    let mut load = vec![0.0; space.len()];
    for t in triangles.clone() {
        let map = Map::new(space.mesh, t);
        space.add(t, &map.load(space.reference, &[2.0; NODES]), &mut load);
    }
    // One function that is 1 around a hole for each of them.
    let hole = |number: usize| {
        let is_on = |of: &Option<usize>| if *of == Some(number) { 1.0 } else { 0.0 };
        let edge: Vec<f64> = space.loops().iter().map(is_on).collect();
        let mut right = space.stiffness_times(&edge);
        for (value, on) in right.iter_mut().zip(space.loops()) {
            *value = if on.is_some() { 0.0 } else { -*value };
        }
        let inner = space.solve(&fixed, right);
        edge.iter()
            .zip(inner)
            .map(|(edge, inner)| edge + inner)
            .collect()
    };
    let holes: Vec<Vec<f64>> = (1..outline.loops.len()).map(hole).collect();
    let mut right = load.clone();
    for (value, on) in right.iter_mut().zip(space.loops()) {
        if on.is_some() {
            *value = 0.0;
        }
    }
    let mut stress = space.solve(&fixed, right);
    let mut lower = dot(&stress, &load);
    if holes.is_empty() {
        return Some((stress, lower));
    }
    let forces: Vec<Vec<f64>> = holes.iter().map(|of| space.stiffness_times(of)).collect();
    let matrix =
        nalgebra::DMatrix::from_fn(holes.len(), holes.len(), |i, j| dot(&holes[i], &forces[j]));
    let areas = holes.iter().zip(outline.holes());
    let loads = areas.map(|(of, area)| dot(of, &load) + 2.0 * area);
    let loads = nalgebra::DVector::from_iterator(holes.len(), loads);
    let constants = matrix.cholesky()?.solve(&loads);
    lower += constants.dot(&loads);
    for (constant, hole) in constants.iter().zip(&holes) {
        for (value, of) in stress.iter_mut().zip(hole) {
            *value += constant * of;
        }
    }
    Some((stress, lower))
}

/// Integrals over each triangle of the square of the difference of both stresses.
fn differences(space: &Space<'_>, functions: &[[Nodal; 2]]) -> Vec<f64> {
    let of = |(t, functions): (usize, &[Nodal; 2])| {
        let map = Map::new(space.mesh, t);
        let points = space.reference.points.iter();
        let squares = points.map(|(shapes, at, weight)| {
            let [warping, stress] = [0, 1].map(|k| Space::gradient(&map, shapes, &functions[k]));
            let [y, z] = map.point(*at);
            let off = [warping[0] - z - stress[1], warping[1] + y + stress[0]];
            weight * map.size * (off[0] * off[0] + off[1] * off[1])
        });
        squares.sum()
    };
    functions.iter().enumerate().map(of).collect()
}
