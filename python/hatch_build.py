"""Puts what is compiled into the wheel and says in its tag which platform that is for."""

import os
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

# Folder with `flexbody` (or `flexbody.exe`) and `fmu/binaries/...`; by default where it lies in the package.
PRODUCT = "FLEXBODY_WHEEL_PRODUCT"
# Platform tag of the wheel, such as `manylinux_2_17_x86_64`.
PLATFORM = "FLEXBODY_WHEEL_PLATFORM"
INSIDE = "flexbody/product"


class ProductHook(BuildHookInterface):
    def initialize(self, version, build_data):
        if version == "editable":
            # Works on the sources themselves, with a program that lies elsewhere.
            return
        product = Path(os.environ.get(PRODUCT) or Path(self.root, "src", INSIDE)).absolute()
        programs = [product / name for name in ["flexbody", "flexbody.exe"] if (product / name).is_file()]
        libraries = [path for path in product.glob("fmu/binaries/*/*") if path.is_file()]
        if not programs:
            raise RuntimeError(
                f"expected the program flexbody in {product} ({PRODUCT}); `cargo xtask wheel` puts it there"
            )
        if not libraries:
            raise RuntimeError(f"expected libraries for FMUs in {product / 'fmu' / 'binaries'}, found none")
        platform = os.environ.get(PLATFORM)
        if not platform:
            raise RuntimeError(f"expected the platform tag of the wheel in {PLATFORM}, such as manylinux_2_17_x86_64")
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{platform}"
        for path in product.rglob("*"):
            if path.is_file():
                build_data["force_include"][str(path)] = f"{INSIDE}/{path.relative_to(product).as_posix()}"
