"""Sobol' indices by SALib: which parameter the largest tension in a rope depends on.

python sensitivity_salib.py [--samples N] [--scheduler ADDRESS|local]
"""

import argparse

from SALib.analyze import sobol
from SALib.sample import sobol as samples
from sweeps import OUTPUT, rope, sampled

PROBLEM = {
    "names": ["rope.density", "rope.youngs_modulus", "rope.tip.force[1]"],
    "bounds": [[800, 2000], [1e8, 4e8], [-2, 2]],
    "num_vars": 3,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--samples", type=int, default=64, help="a power of 2; runs are 5 times as many")
    parser.add_argument("--scheduler", help="Dask scheduler to run on")
    arguments = parser.parse_args()
    points = samples.sample(PROBLEM, arguments.samples, calc_second_order=False, seed=1)
    options = ["--scheduler", arguments.scheduler] if arguments.scheduler else []
    runs = sampled(rope(), PROBLEM["names"], points, options)
    found = sobol.analyze(PROBLEM, runs[OUTPUT].to_numpy(), calc_second_order=False, seed=1)
    for number, name in enumerate(PROBLEM["names"]):
        first, total = found["S1"][number], found["ST"][number]
        print(f"{name}: first order {first:.2f} +- {found['S1_conf'][number]:.2f}, total {total:.2f}")


if __name__ == "__main__":
    main()
