//! Rigid bodies of space with the masses that are lumped at their markers: these move the centre of mass and add inertia, and
//! belong to the body, so that its mass is constant along its own axes.

use nalgebra::{Matrix3, Vector3};

use crate::scene::Inertia;
use crate::scene::resolved::{Place, Resolved, Rigid};

/// A rigid body of space that rotates, with all that moves with it.
pub(crate) struct RotatingSolid {
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass in the body's frame, m.
    pub center: Vector3<f64>,
    /// Principal moments of inertia about the centre of mass, kg m^2.
    pub moments: [f64; 3],
    /// Principal axes in the body's frame, as columns.
    pub axes: Matrix3<f64>,
}

/// Inertia of a mass that is so far away (parallel axes): `m (r^2 - r r^T)`.
fn parallel(mass: f64, way: &Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::identity() * way.norm_squared() - way * way.transpose()) * mass
}

impl RotatingSolid {
    /// A point of the body, in its frame, along the principal axes from the centre of mass, m.
    pub fn along(&self, point: [f64; 3]) -> [f64; 3] {
        self.directed((Vector3::from(point) - self.center).into())
    }

    /// A direction in the body's frame along the principal axes.
    pub fn directed(&self, way: [f64; 3]) -> [f64; 3] {
        (self.axes.transpose() * Vector3::from(way)).into()
    }
}

impl Resolved<'_> {
    /// A rigid body of space with the masses at its markers.
    pub(crate) fn solid(&self, rigid: Rigid<'_>) -> RotatingSolid {
        let body = rigid.body;
        let lumped: Vec<(f64, Vector3<f64>)> = (self.masses.iter())
            .filter_map(|mass| match mass.marker.place {
                Place::Point(of, point) if of.id == rigid.id => Some((mass.mass, point.into())),
                _ => None,
            })
            .collect();
        let moments = lumped.iter().map(|(mass, point)| point * *mass);
        let mass = body.mass() + lumped.iter().map(|(mass, _)| mass).sum::<f64>();
        let center = moments.sum::<Vector3<f64>>() / mass;
        let inertia = if lumped.is_empty() {
            body.inertia()
        } else {
            let own = body.inertia().tensor() + parallel(body.mass(), &center);
            let tensor = (lumped.iter()).fold(own, |sum, (mass, point)| {
                sum + parallel(*mass, &(point - center))
            });
            let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| tensor[(i, j)]));
            Inertia::Tensor(rows)
        };
        let (moments, axes) = inertia.principal();
        RotatingSolid {
            mass,
            center,
            moments,
            axes,
        }
    }
}
