"""A sweep over a grid as an xarray data set, and a map of the largest tension.

python sweep_xarray.py [--plot FILE.png]
"""

import argparse
from pathlib import Path

import matplotlib.pyplot as plt
from sweeps import OUTPUT, rope, swept

GRID = {"rope.density": "800:2000:13", "rope.tip.force[1]": "-2:2:17"}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plot", type=Path, default=Path("sweep_xarray.png"))
    arguments = parser.parse_args()
    runs = swept(rope(), *(f"{name}={values}" for name, values in GRID.items()))
    # Needs xarray: one dimension for everything that was varied.
    grid = runs.set_index(list(GRID)).to_xarray()
    print(grid[OUTPUT])
    grid[OUTPUT].plot.contourf(levels=20, figsize=(6, 4), cbar_kwargs={"label": "largest tension at the top in N"})
    plt.xlabel("horizontal force at the tip in N")
    plt.ylabel("density of the rope in kg/m$^3$")
    plt.tight_layout()
    plt.savefig(arguments.plot, dpi=120)


if __name__ == "__main__":
    main()
