//! Memory that a scene will take, about: it is asked for before anything is built.

use crate::scene::resolved::{BodyReference, Resolved};
use crate::scene::{Error, LineModel, Model};

// Memory in the plane and in space, bytes, a third more than measured with thousands of each, factors of the implicit method with them.
/// Memory of a cable element.
const BYTES_OF_CABLE: [usize; 2] = [8_000, 12_000];
/// Memory of a rod element.
const BYTES_OF_ROD: [usize; 2] = [24_000, 36_000];
/// Memory of a beam element.
const BYTES_OF_BEAM: [usize; 2] = [24_000, 46_000];
/// Memory of a rigid body.
const BYTES_OF_BODY: [usize; 2] = [12_000, 21_000];
/// Memory of a pair of modes of a reduced body: its terms of inertia, coupling and displacements, and factors.
const BYTES_OF_MODES: usize = 1_000;
/// Memory of an element of a plate or shell.
const BYTES_OF_PATCH: usize = 100_000;
/// Memory of a joint, a gear or a motion.
const BYTES_OF_JOINT: [usize; 2] = [18_000, 20_000];

impl Resolved<'_> {
    /// Allocates the memory that a scene will take, and frees it again. A later allocation that fails would end the
    /// process.
    ///
    /// # Errors
    /// The memory is not available.
    pub(super) fn reserve(&self) -> Result<(), Error> {
        let (elements, bodies) = (self.scene.elements(), self.bodies.len());
        let bytes = self.bytes();
        Vec::<u8>::new().try_reserve_exact(bytes).map_err(|_| {
            let wanted = bytes.div_ceil(1_000_000);
            let message = format!(
                "expected memory for {elements} elements in {bodies} bodies ({wanted} MB), found less"
            );
            Error::new("bodies", message)
        })
    }

    /// Memory that bodies and joints take, bytes, about.
    fn bytes(&self) -> usize {
        let place = usize::from(self.scene.dimension == 3);
        let of_body = |body: &BodyReference<'_>| match body {
            BodyReference::Cable(cable) if cable.body.model != Model::Rigid => {
                let count = cable.body.elements.unwrap_or(1) as usize;
                let each = match cable.body.sections {
                    LineModel::Cable => BYTES_OF_CABLE,
                    LineModel::Kirchhoff => BYTES_OF_ROD,
                    LineModel::Reissner => BYTES_OF_BEAM,
                };
                count.saturating_mul(each[place])
            }
            BodyReference::Reduced(reduced) => {
                let modes = reduced.body.first_modes();
                BYTES_OF_BODY[place] + modes * modes * BYTES_OF_MODES
            }
            BodyReference::Plate(plate) => {
                let count = usize::try_from(plate.body.elements()).unwrap_or(usize::MAX);
                count.saturating_mul(BYTES_OF_PATCH)
            }
            BodyReference::Rigid(_) | BodyReference::Cable(_) => BYTES_OF_BODY[place],
        };
        let bodies = self.bodies.iter().map(of_body);
        let joints = self.holders.iter().map(|_| BYTES_OF_JOINT[place]);
        bodies.chain(joints).fold(0, usize::saturating_add)
    }
}
