//! Models that reduced bodies take of their files.

use crate::elements::reduced::{ModalBasis, ReducedModel};
use crate::scene::Error;
use crate::scene::description::{FixedInterfaceModes, Modes};
use crate::scene::resolved::{Place, Reduced, Resolved};

/// Square of the ratio to the highest natural frequency without static shapes above which modes are critically damped.
const FAST: f64 = 25.0;

impl Resolved<'_> {
    /// Returns the model that a reduced body takes of its file, and the damping ratios of its modes.
    ///
    /// # Errors
    /// A model whose modes with held interfaces cannot be computed.
    pub(super) fn model_of(&self, reduced: Reduced<'_>) -> Result<(ReducedModel, Vec<f64>), Error> {
        let model = &reduced.body.contained().model;
        let basis = self.basis(reduced)?;
        let is_settled = |eigenvalue: f64| {
            let is_static = matches!(reduced.body.modes, Modes::FixedInterface(_));
            is_static && reduced.body.critically_damped && eigenvalue > FAST * basis.highest
        };
        let ratio = |eigenvalue: &f64| {
            let frequency = eigenvalue.sqrt() / std::f64::consts::TAU;
            let given = reduced.body.damping_ratio.at(frequency);
            if is_settled(*eigenvalue) {
                given.max(1.0)
            } else {
                given
            }
        };
        let ratios = basis.eigenvalues.iter().map(ratio).collect();
        // The arrays of the file are taken bit for bit where all its modes are.
        let is_whole = basis == model.first_modes(model.modes()) && basis.paired == model.paired;
        let taken = if is_whole {
            model.clone()
        } else {
            model.in_basis(&basis)
        };
        Ok((taken, ratios))
    }

    /// Returns the basis of the modes that a reduced body takes of its file.
    ///
    /// # Errors
    /// As [`Self::model_of`].
    pub(super) fn basis(&self, reduced: Reduced<'_>) -> Result<ModalBasis, Error> {
        let model = &reduced.body.contained().model;
        let Modes::FixedInterface(FixedInterfaceModes { fixed_interface }) = reduced.body.modes
        else {
            return Ok(model.first_modes(reduced.body.first_modes()));
        };
        let held = self.interfaces_acted_on(reduced);
        let basis = model.fixed_interface_modes(&held, fixed_interface as usize);
        basis.ok_or_else(|| {
            let place = format!("bodies[{}].modes.fixed_interface", reduced.id.index());
            let message = "the natural modes with held interfaces could not be computed: expected \
                           frequencies in the file that differ less";
            Error::new(place, message)
        })
    }

    /// Lists the interfaces of a reduced body that joints, motions, loads and ports act on, by their indices in the model.
    fn interfaces_acted_on(&self, reduced: Reduced<'_>) -> Vec<usize> {
        let of_joints = self.joints.iter().flat_map(|joint| joint.ends.markers());
        let driven = self.motions.iter();
        let of_motions = driven.flat_map(|motion| motion.driven.quantity().place.markers());
        let of_loads = self
            .loads
            .iter()
            .flat_map(|load| load.kind.place().markers());
        let of_ports = self.ports.iter().map(|port| port.marker);
        let markers = of_joints.chain(of_motions).chain(of_loads).chain(of_ports);
        let mut found: Vec<usize> = markers
            .filter_map(|marker| match marker.place {
                Place::Interface(of, index) if of.id == reduced.id => Some(index),
                _ => None,
            })
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}
