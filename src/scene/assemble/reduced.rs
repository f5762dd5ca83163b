//! Models that reduced bodies take of their files.

use crate::elements::reduced::{ModalBasis, PAIRED, ReducedModel};
use crate::scene::Error;
use crate::scene::description::{FixedInterfaceModes, Modes};
use crate::scene::resolved::{Place, Reduced, Resolved};

/// Square of the ratio to the highest natural frequency without static shapes above which modes are critically damped.
const FAST: f64 = 25.0;

/// Interfaces of a body that are acted on: by what is taken of a place.
type OfPlace<'a> = &'a dyn Fn(Place<'_>) -> Option<usize>;

impl Resolved<'_> {
    /// Returns the model that a reduced body takes of its file, and the damping ratios of its modes.
    ///
    /// # Errors
    /// A model whose modes with held interfaces cannot be computed.
    pub(super) fn model_of(&self, reduced: Reduced<'_>) -> Result<(ReducedModel, Vec<f64>), Error> {
        let model = &reduced.body.contained().model;
        let basis = self.basis(reduced)?;
        let is_static = matches!(reduced.body.modes, Modes::FixedInterface(_));
        let given = |eigenvalue: f64| {
            let frequency = eigenvalue.sqrt() / std::f64::consts::TAU;
            reduced.body.damping_ratio.at(frequency)
        };
        let ratios = damping_ratios(&basis, is_static && reduced.body.critically_damped, given);
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
        self.basis_of(reduced, reduced.body.modes)
    }

    /// Returns the basis of these modes.
    fn basis_of(&self, reduced: Reduced<'_>, modes: Modes) -> Result<ModalBasis, Error> {
        let model = &reduced.body.contained().model;
        let Modes::FixedInterface(FixedInterfaceModes { fixed_interface }) = modes else {
            return Ok(model.first_modes(reduced.body.first_modes()));
        };
        let held = self.interfaces_acted_on(&|place| match place {
            Place::Interface(of, index) if of.id == reduced.id => Some(index),
            _ => None,
        });
        let basis = model.fixed_interface_modes(&held, fixed_interface as usize);
        basis.ok_or_else(|| {
            let place = format!("bodies[{}].modes.fixed_interface", reduced.id.index());
            let message = "the natural modes with held interfaces could not be computed: expected \
                           frequencies in the file that differ less";
            Error::new(place, message)
        })
    }

    /// Whether the file of a reduced body lacks second-order displacements of pairs of modes that the body needs, whose number of modes the
    /// planner may have to find.
    pub fn lacks_pairs(&self, reduced: Reduced<'_>) -> bool {
        let modes = if reduced.body.is_open() {
            let fixed_interface = PAIRED as u32;
            Modes::FixedInterface(FixedInterfaceModes { fixed_interface })
        } else {
            reduced.body.modes
        };
        let basis = self.basis_of(reduced, modes);
        basis.is_ok_and(|basis| reduced.body.contained().model.lacks_pairs(&basis))
    }

    /// Lists the interfaces of a reduced body that something acts on, by their indices in the model.
    pub(super) fn interfaces_acted_on(&self, index: OfPlace<'_>) -> Vec<usize> {
        let initial = self.initial_loads.iter();
        let initial = initial.flat_map(|load| load.kind.markers());
        let markers = self.acted_on().into_iter().chain(initial);
        let mut found: Vec<usize> = markers.filter_map(|marker| index(marker.place)).collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

/// Damping ratios of the modes of a basis, from those given for eigenvalues. Static shapes far above the natural modes are critically damped
/// where they may be.
pub(super) fn damping_ratios(
    basis: &ModalBasis,
    may_be_critical: bool,
    given: impl Fn(f64) -> f64,
) -> Vec<f64> {
    let ratio = |eigenvalue: &f64| {
        let is_critical = may_be_critical && *eigenvalue > FAST * basis.highest;
        let given = given(*eigenvalue);
        if is_critical { given.max(1.0) } else { given }
    };
    basis.eigenvalues.iter().map(ratio).collect()
}
