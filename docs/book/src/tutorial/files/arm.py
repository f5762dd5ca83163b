import flexbody
import numpy as np
from flexbody.reduction import Interface
from flexbody.reduction.readers.scikit_fem import Solid
from skfem import Basis, ElementHex2, ElementVector, MeshHex

# A flat arm of plastic: 0.3 m along x, 30 mm along y, 6 mm along z.
mesh = MeshHex.init_tensor(np.linspace(0, 0.3, 11), np.linspace(-0.015, 0.015, 3), np.linspace(-0.003, 0.003, 2))
solid = Solid(
    Basis(mesh, ElementVector(ElementHex2())),
    youngs_modulus=2e9,
    poissons_ratio=0.35,
    density=1150,
)
along = solid.model.nodes[:, 0]
arm = flexbody.reduce(
    solid.model.mass,
    solid.model.stiffness,
    solid.model.nodes,
    {
        "root": Interface(np.flatnonzero(along < 1e-9), kind="rigid", held="frame"),
        "tip": Interface(np.flatnonzero(along > 0.3 - 1e-9), held="position"),
    },
    dofs=solid.model.dofs,
    modes=4,
    quadratic_force=solid.quadratic_force,
    source="arm of the tutorial",
)
arm.save("arm.safetensors")
print(arm.describe())
