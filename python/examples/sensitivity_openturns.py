"""Sobol' indices by OpenTURNS: the same question as in sensitivity_salib.py, answered by a polynomial chaos.

python sensitivity_openturns.py [--samples N]
"""

import argparse

import openturns as ot
from sweeps import OUTPUT, rope, sampled

BOUNDS = {"rope.density": (800, 2000), "rope.youngs_modulus": (1e8, 4e8), "rope.tip.force[1]": (-2, 2)}
DEGREE = 4


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--samples", type=int, default=128)
    arguments = parser.parse_args()
    inputs = ot.JointDistribution([ot.Uniform(low, high) for low, high in BOUNDS.values()])
    points = ot.LowDiscrepancyExperiment(ot.SobolSequence(), inputs, arguments.samples).generate()
    runs = sampled(rope(), list(BOUNDS), points)
    values = ot.Sample([[value] for value in runs[OUTPUT]])
    basis = ot.OrthogonalProductPolynomialFactory([ot.LegendreFactory()] * len(BOUNDS))
    terms = basis.getEnumerateFunction().getStrataCumulatedCardinal(DEGREE)
    strategy = ot.FixedStrategy(basis, terms)
    chaos = ot.FunctionalChaosAlgorithm(points, values, inputs, strategy, ot.LeastSquaresStrategy())
    chaos.run()
    indices = ot.FunctionalChaosSobolIndices(chaos.getResult())
    for number, name in enumerate(BOUNDS):
        print(
            f"{name}: first order {indices.getSobolIndex(number):.2f}, total {indices.getSobolTotalIndex(number):.2f}"
        )


if __name__ == "__main__":
    main()
