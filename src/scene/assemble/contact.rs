//! Contacts of markers and of bodies with surfaces.

use super::{Builder, unit};
use crate::bodies::PANELS;
use crate::bodies::{Marker, RigidRod};
use crate::elements::Element;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::vector;
use crate::scene::description::Surface;
use crate::scene::resolved::{Cable, ContactBody, Form, ResolvedContact};
use crate::system::loads::{self, AppliedLoad, ContactPoint};

impl<const D: usize> Builder<'_, D> {
    pub(super) fn contact(&self, contact: &ResolvedContact<'_>) -> AppliedLoad<D> {
        let places = match contact.by {
            ContactBody::Marker(marker) => vec![ContactPoint {
                marker: self.marker(marker),
                weight: 1.0,
            }],
            ContactBody::Cable(cable) => self.places(cable),
        };
        let [stiffness, damping] = contact.sizes;
        AppliedLoad::Contact(Box::new(loads::Contact {
            places,
            surface: surface(&contact.surface),
            stiffness,
            damping,
            friction: contact.friction,
            slip_velocity: contact.slip_velocity.unwrap_or_default(),
        }))
    }

    /// The Gauss points of the elements of a cable, or of even parts of one that does not bend.
    fn places(&self, cable: Cable<'_>) -> Vec<ContactPoint> {
        let body = cable.id.body;
        match cable.id.form {
            Form::Chain(chain) => {
                let chain = &self.parts.bodies.lines()[chain];
                let elements = chain.elements().iter().enumerate();
                let places = elements.flat_map(|(j, element)| {
                    GAUSS_5.map(|point| ContactPoint {
                        marker: Marker::within(body, chain, j, point.at),
                        weight: point.weight * element.length(),
                    })
                });
                places.collect()
            }
            Form::Rod(rod) => {
                let RigidRod { node, length, .. } = self.parts.bodies.rods()[rod];
                let part = length / PANELS as f64;
                let places = (0..PANELS).flat_map(|panel| {
                    GAUSS_5.map(|point| {
                        let arm = (panel as f64 + point.at) * part - 0.5 * length;
                        ContactPoint {
                            marker: Marker::rigid(body, node, [arm, 0.0]),
                            weight: point.weight * part,
                        }
                    })
                });
                places.collect()
            }
        }
    }
}

fn surface<const D: usize>(of: &Surface) -> loads::ContactSurface<D> {
    match of {
        Surface::Plane { point, normal } => loads::ContactSurface::Plane {
            point: vector(point.full()),
            normal: unit(normal.full()),
        },
        Surface::Circle { center, radius } | Surface::Sphere { center, radius } => {
            loads::ContactSurface::Round {
                center: vector(center.full()),
                axis: None,
                radius: *radius,
            }
        }
        Surface::Cylinder {
            point,
            axis,
            radius,
        } => loads::ContactSurface::Round {
            center: vector(point.full()),
            axis: Some(unit(axis.full())),
            radius: *radius,
        },
    }
}
