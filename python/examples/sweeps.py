"""What the examples of sweeps share: a rope with a weight, and the way to `flexbody sweep` and back."""

import csv
import tempfile
from pathlib import Path

import flexbody
import pandas
from flexbody.scene import (
    AxialForceOutput,
    Cable,
    Circle,
    Experiment,
    ForceInput,
    Line,
    Mass,
    Material,
    PositionOutput,
    Revolute,
    Scene,
    Section,
)

LENGTH = 2.0  # m
RADIUS = 0.005  # m
WEIGHT = 0.5  # kg
OUTPUT = "rope.top.axial_force.max"


def rope():
    """A rope with a weight at its tip, let go at an angle."""
    return Scene(
        name="swung_rope",
        dimension=2,
        gravity=[0, -9.81],
        bodies=[
            Cable(
                name="rope",
                elements=8,
                material=Material(density=1200, youngs_modulus=2e8, damping_time=1e-3),
                section=Section(shape=Circle(radius=RADIUS)),
                shape=Line(from_=[0, 0], to=[0.6 * LENGTH, -0.8 * LENGTH]),
                markers={"top": 0, "tip": 1},
                axial="critically_damped",
            )
        ],
        masses=[Mass(marker="rope.tip", mass=WEIGHT)],
        joints=[Revolute(name="hook", markers=["ground", "rope.top"])],
        inputs=[ForceInput(marker="rope.tip")],
        outputs=[PositionOutput(marker="rope.tip"), AxialForceOutput(marker="rope.top")],
        experiment=Experiment(stop_time=2, step=0.02),
    )


def swept(scene, *vary, options=()):
    """A row for every run: what was varied, and of every output its value at the end, its least and its largest."""
    with tempfile.TemporaryDirectory() as folder:
        scene_file, results = Path(folder, "scene.json"), Path(folder, "runs.parquet")
        scene.to_file(scene_file)
        named = [word for what in vary for word in ["--vary", what]]
        flexbody.run("sweep", scene_file, *named, "--output", results, *options)
        runs = pandas.read_parquet(results)
    failed = runs[runs["error"].notna()]
    if len(failed):
        raise flexbody.Error(f"{len(failed)} of {len(runs)} runs failed; the first: {failed['error'].iloc[0]}")
    return runs.sort_values("run")


def sampled(scene, names, samples, options=()):
    """The same for samples, a row of values for every run."""
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder, "samples.csv")
        with table.open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(names)
            # Shortest texts that read back to the same bits.
            writer.writerows([[repr(float(value)) for value in row] for row in samples])
        return swept(scene, *(f"{name}=@{table}" for name in names), options=options)
