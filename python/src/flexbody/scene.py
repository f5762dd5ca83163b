"""Scenes as Python objects: what scenes/scene.schema.json says, with the same names.

Made by generate_models.py; changes here would be lost. Keys that are words of Python end in `_` (`from_`, `for_`).
What a scene must obey beyond this is checked by the program.
"""

from __future__ import annotations

from pydantic import ConfigDict, Field, StrictBool, StrictFloat, StrictInt, StrictStr
from flexbody._part import Part, under_one_of
from typing import Annotated, Literal
from typing_extensions import TypeAliasType


class About(Part):
    """
    Whose model this is and under which terms it may be used, as the model description says it to every importer. The
    library that runs it is licensed apart (`documentation/licenses` of the FMU). At most 1000 characters each.
    """

    author: StrictStr | None = None
    """
    Name and organization of who made it.
    """
    copyright: StrictStr | None = None
    """
    Copyright of the model, such as `(c) 2026 The firm`.
    """
    description: StrictStr | None = None
    """
    Subject of the model.
    """
    license: StrictStr | None = None
    """
    The terms under which it may be used.
    """
    version: StrictStr | None = None
    """
    Version of the model.
    """


Along = TypeAliasType("Along", Literal["global", "body"])
"""
Axes along which components of an output are.

- `global`: Global axes.
- `body`: Axes of the frame of the rigid body; of a joint, of the first body that it joins. Names of such variables end in
`_body`, so that both can be read.
"""


Auto = TypeAliasType("Auto", Literal["auto"])
"""
The word for a number that is left to the planner.

- `auto`: As many as the accuracy asks for.
"""


Axial = TypeAliasType("Axial", Literal["waves", "critically_damped"])
"""
Treatment of axial vibrations of a cable.

- `waves`: Axial vibrations decay as the material says: never where it has no damping.
- `critically_damped`: Axial vibrations are damped critically: Kelvin-Voigt damping of the rate of axial strain alone, with the time `2 / omega_1`
(`damping_time` where that is longer), so that the first axial mode is damped critically. `omega_1` is `pi c / L`,
or `pi c / (2 L)` where joints or motions hold one end only; `c` the speed of sound. Bending is not touched, nor
slow stretching; what is lost is counted in `energy.dissipated`. For forces that ring from loads or speeds that
begin at once, where no one asked for the ringing.
"""


CoordinateKind = TypeAliasType("CoordinateKind", Literal["displacement", "angle"])
"""
A coordinate of a joint by name.

- `displacement`: The way along its line from the first marker or its point, m.
- `angle`: The angle about its axis, rad.
"""


Course = TypeAliasType("Course", Literal["ramp", "step", "sine"])
"""
Ways from a value to another.

- `ramp`: A smooth ramp over the first tenth of the experiment, and one back over a tenth after its half.
- `step`: A jump after a tenth of the experiment, and one back after its half.
- `sine`: To and fro as a cosine, three times.
"""


DampingRatioNumber = TypeAliasType(
    "DampingRatioNumber",
    Annotated[StrictFloat, Field(ge=0.0, title="DampingRatioNumber")],
)
"""
One ratio of all modes.
"""


DampingRatioRow = TypeAliasType("DampingRatioRow", Annotated[list[StrictFloat], Field(max_length=2, min_length=2)])


DampingRatioRows = TypeAliasType(
    "DampingRatioRows",
    Annotated[list[DampingRatioRow], Field(title="DampingRatioRows")],
)
"""
Pairs of a frequency, Hz, and the ratio there.
"""


DampingRatio = TypeAliasType("DampingRatio", DampingRatioNumber | DampingRatioRows)
"""
Damping ratio of the modes of a free body.
"""


ElementsCount = TypeAliasType("ElementsCount", Annotated[StrictInt, Field(ge=0, title="ElementsCount")])
"""
Number of elements.
"""


Elements = TypeAliasType("Elements", Auto | ElementsCount)
"""
A number of elements, or the word that leaves it to the planner.
"""


class Experiment(Part):
    """
    Default experiment of the FMU.
    """

    stop_time: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Stop time, s.
    """
    step: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Communication step, s.
    """


class FixedInterfaceModes(Part):
    """
    Modes in the basis of Craig and Bampton within the modes of the file: static shapes of the interfaces that joints, motions, loads and ports
    act on, and natural modes with these interfaces held.
    """

    fixed_interface: Annotated[StrictInt, Field(ge=0)]
    """
    Number of natural modes with held interfaces, beside the static shapes.
    """


Freedom = TypeAliasType("Freedom", Literal["x", "y", "z", "rotation_x", "rotation_y", "rotation_z"])
"""
A translation or a rotation that a joint leaves free.

- `x`: Along the first axis.
- `y`: Along the second axis.
- `z`: Along the third axis.
- `rotation_x`: About the first axis.
- `rotation_y`: About the second axis.
- `rotation_z`: About the third axis.
"""


class Gear(Part):
    """
    A gear between two joints: `c2 = ratio c1`, of their coordinates from the start on.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    joints: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    The joints: the angle of those with an axis, else the displacement.
    """
    ratio: StrictFloat
    """
    How much the coordinate of the second changes with that of the first: 1, m/rad, rad/m; negative where they rotate opposite ways.
    """


InertiaNumber = TypeAliasType("InertiaNumber", Annotated[StrictFloat, Field(ge=0.0, title="InertiaNumber")])
"""
In the plane; 0 is a particle, in space too.
"""


InertiaComponents = TypeAliasType(
    "InertiaComponents",
    Annotated[list[StrictFloat], Field(max_length=3, min_length=3, title="InertiaComponents")],
)
"""
Moments about the axes of the body's frame.
"""


InertiaRow = TypeAliasType("InertiaRow", Annotated[list[StrictFloat], Field(max_length=3, min_length=3)])


InertiaRows = TypeAliasType(
    "InertiaRows",
    Annotated[list[InertiaRow], Field(max_length=3, min_length=3, title="InertiaRows")],
)
"""
Tensor in the body's frame, by rows; products of inertia are minus the integrals of `x y` and so on.
"""


Inertia = TypeAliasType("Inertia", InertiaNumber | InertiaComponents | InertiaRows)
"""
Inertia about the centre of mass, kg m^2.
"""


InitialState = TypeAliasType("InitialState", Literal["undeformed", "static_equilibrium", "steady"])
"""
States by name.

- `undeformed`: The unstressed shapes.
- `static_equilibrium`: The equilibrium under gravity, loads and the start values of the inputs, motions held where they start. It is
stable where loads have a potential: an unstable one, as that of a straight column above its buckling load, is
left to where gravity pulls, else up or to the right. Follower forces have none; there it is where all forces balance.
- `steady`: Equilibrium in the motion that all bodies start with, by motions, joints and their own `motion`: a steady rotation about
one point, in space one axis, with centrifugal forces, or a translation. What rotates starts stretched and does not ring.
"""


class ForceInput(Part):
    """
    Force at a marker, N.
    """

    kind: Literal["force"] = "force"
    marker: StrictStr
    """
    Marker that the force acts at, `body.marker`.
    """
    follower: StrictBool | None = None
    """
    Whether the components rotate with the marker. They are then along and to the left of its direction in the plane, and along the
    axes of the body's frame in space.
    """
    start: list[StrictFloat] = []
    """
    Components of the force before the master sets it, N; zeros by default.
    """


class MomentInput(Part):
    """
    Moment at a marker, counter-clockwise, N m.
    """

    kind: Literal["moment"] = "moment"
    marker: StrictStr
    """
    Marker that the moment acts at, `body.marker`.
    """
    follower: StrictBool | None = None
    """
    Whether the components rotate with the marker, along the axes of the body's frame; in space only.
    """
    start: list[StrictFloat] = []
    """
    Moment before the master sets it, N m: one value in the plane, three in space; zeros by default.
    """


class TorqueInput(Part):
    """
    Moment on the second marker of a joint, opposite on its first, N m.
    """

    kind: Literal["torque"] = "torque"
    joint: StrictStr
    """
    Name of the joint with an axis that the torque acts about.
    """
    start: list[StrictFloat] = []
    """
    Torque before the master sets it, N m: one value; 0 by default.
    """


class DistributedForceInput(Part):
    """
    Force in global axes per reference length of a cable, rod or beam, N/m.
    """

    kind: Literal["distributed_force"] = "distributed_force"
    body: StrictStr
    """
    Name of the cable, rod or beam that the force acts along.
    """
    start: list[StrictFloat] = []
    """
    Components of the force per reference length before the master sets it, N/m; zeros by default.
    """


class DistributedMomentInput(Part):
    """
    Moment per reference length of a rod or beam, N m/m.
    """

    kind: Literal["distributed_moment"] = "distributed_moment"
    body: StrictStr
    """
    Name of the rod or beam that the moment acts along.
    """
    follower: StrictBool | None = None
    """
    Whether the components rotate with the sections, along their axes; in space only.
    """
    start: list[StrictFloat] = []
    """
    Moment per reference length before the master sets it, N m/m: one value in the plane, three in space; zeros by default.
    """


class PressureInput(Part):
    """
    Pressure on a plate or shell, Pa.
    """

    kind: Literal["pressure"] = "pressure"
    body: StrictStr
    """
    Name of the plate or shell that the pressure acts on.
    """
    start: list[StrictFloat] = []
    """
    Pressure before the master sets it, along the normal, Pa: one value; 0 by default.
    """


class AreaForceInput(Part):
    """
    Force in global axes per area of a plate or shell, N/m^2.
    """

    kind: Literal["area_force"] = "area_force"
    body: StrictStr
    """
    Name of the plate or shell that the force acts on.
    """
    start: list[StrictFloat] = []
    """
    Components of the force per area before the master sets it, N/m^2; zeros by default.
    """


class RestLengthInput(Part):
    """
    Length at rest of a spring-damper, m.
    """

    kind: Literal["rest_length"] = "rest_length"
    load: StrictStr
    """
    Name of the spring-damper or rope whose length is set.
    """
    start: list[StrictFloat] = []
    """
    Length before the master sets it, m: one value; by default the length of the spring-damper.
    """


class ReleaseInput(Part):
    """
    Whether a joint lets go: it does, for good, in the first step that begins with more than 0.
    """

    kind: Literal["release"] = "release"
    joint: StrictStr
    """
    Name of the joint that is released.
    """
    start: list[StrictFloat] = []
    """
    Value before the master sets it: one value; 0 by default, which holds the joint.
    """


class LatchInput(Part):
    """
    Whether a latch may close: above 0 it may, else it is open. Read at the start of each communication step.
    """

    kind: Literal["latch"] = "latch"
    latch: StrictStr
    """
    Name of the latch that is armed and opened.
    """
    start: list[StrictFloat] = []
    """
    Value before the master sets it: one value; 1 by default, which arms the latch.
    """


class FrictionInput(Part):
    """
    Force of a joint friction against sliding, N on a displacement and N m on an angle.
    """

    kind: Literal["friction"] = "friction"
    load: StrictStr
    """
    Name of the joint friction whose force is set.
    """
    start: list[StrictFloat] = []
    """
    Force before the master sets it, N or N m: one value; by default that of the load.
    """


class ControlInput(Part):
    """
    Value `u` of a force law, in the unit that its expression gives it.
    """

    kind: Literal["control"] = "control"
    load: StrictStr
    """
    Name of the force law whose `u` is set.
    """
    start: list[StrictFloat] = []
    """
    Value before the master sets it: one value; 0 by default.
    """


class CurrentInput(Part):
    """
    Velocity of a fluid in global axes, m/s.
    """

    kind: Literal["current"] = "current"
    load: StrictStr
    """
    Name of the load of kind `fluid` or `airfoil` whose velocity is set.
    """
    start: list[StrictFloat] = []
    """
    Components of the velocity before the master sets it, m/s; by default those of the load.
    """


Input = TypeAliasType(
    "Input",
    Annotated[
        ForceInput
        | MomentInput
        | TorqueInput
        | DistributedForceInput
        | DistributedMomentInput
        | PressureInput
        | AreaForceInput
        | RestLengthInput
        | ReleaseInput
        | LatchInput
        | FrictionInput
        | ControlInput
        | CurrentInput,
        Field(discriminator="kind"),
    ],
)
"""
A load that the master sets.
"""


Integrator = TypeAliasType(
    "Integrator",
    Literal["auto", "radau", "rk4", "dopri853", "verlet", "rkn43", "rkn64"],
)
"""
Integrators by name.

- `auto`: An explicit method or the implicit one, whichever gets further with the same work while it runs.
- `radau`: Radau IIA of order 5, implicit: for stiff scenes.
- `rk4`: Runge-Kutta of order 4 with an embedded order 3, explicit: for soft scenes with damping or
constraints.
- `dopri853`: Runge-Kutta of Dormand and Prince of order 8 with embedded orders 5 and 3, explicit: for soft scenes with damping or
constraints at tight tolerances.
- `verlet`: Velocity Verlet of order 2, explicit: for soft scenes at loose tolerances.
- `rkn43`: Runge-Kutta-Nystrom of order 4 with an embedded order 3, explicit: for soft scenes.
- `rkn64`: Runge-Kutta-Nystrom of order 6 with an embedded order 4, explicit: for soft scenes at tight tolerances.
"""


Interpolation = TypeAliasType("Interpolation", Literal["linear", "spline"])
"""
Ways from point to point of a table.

- `linear`: Straight from point to point, the end values held outside. The velocity of a motion jumps at every
point: the drive strikes the bodies there.
- `spline`: A smooth cubic spline.
"""


class OrientationJoint(Part):
    """
    Holds the direction, in space how bodies stand to each other.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["orientation"] = "orientation"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    """
    angle: StrictFloat | None = None
    """
    In the plane only: angle from the direction of the first marker to that of the second, rad; by default the angle at the start.
    The direction of `ground` is 0.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class PointOnCable(Part):
    """
    Holds the marker on the line of a cable.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["point_on_cable"] = "point_on_cable"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Name of the cable, then the `body.marker` on its line.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Clamped(Part):
    """
    Holds an edge of a plate or shell, and the normal along it, on the ground, on a rigid body or on another edge. On the ground and on a
    rigid body the edge may not stretch; beside it the surface may. Two edges keep the angle between both surfaces. A rod or beam along
    the edge stiffens it: its line is that of the edge, and its sections rotate about it with the surface.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["clamped"] = "clamped"
    edges: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    `ground`, a marker of a body with axes, a rod or beam along the edge (a stiffener), or an edge at the same place; then the
    edge: `body.s1=0`, `body.s1=1`, `body.s2=0`, `body.s2=1`, or another line of the mesh, such as `body.s1=0.5`.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Pinned(Part):
    """
    Holds an edge of a plate or shell on the ground, on a rigid body or on another edge. The surface may rotate about the edge. The line
    of a cable, rod or beam along the edge is that of the edge.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["pinned"] = "pinned"
    edges: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    `ground`, a marker of a body with axes, a cable, rod or beam along the edge, or an edge at the same place; then the edge:
    `body.s1=0`, `body.s1=1`, `body.s2=0`, `body.s2=1`, or another line of the mesh, such as `body.s1=0.5`.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Smooth(Part):
    """
    Continues a plate or shell smoothly beyond an edge by another one, or by its own opposite edge.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["smooth"] = "smooth"
    edges: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Two edges at the same place, of different bodies or of one that closes: `body.s1=0`, `body.s1=1`, `body.s2=0` or `body.s2=1`.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Latch(Part):
    """
    A latch: it closes when the coordinate of a joint passes a value, and holds it there. It closes as in a plastic impact: no
    energy is won, and momentum is kept where nothing holds the bodies.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    joint: StrictStr
    """
    The joint whose coordinate is held.
    """
    at: StrictFloat | None = None
    """
    Value of the coordinate that the latch holds, m or rad; by default that in the shapes and positions of the scene.
    """
    closed: StrictBool | None = None
    """
    Whether it is closed at the start. The scene is then put together with the coordinate at `at`.
    """
    coordinate: CoordinateKind | None = None
    """
    Which coordinate of the joint; by default the angle of one with an axis, else the displacement.
    """
    from_time: Annotated[StrictFloat, Field(ge=0.0)] = 0.0
    """
    Time from which on it may close, s.
    """
    least_force: StrictFloat | None = None
    """
    Least force on the coordinate (N, or N m for an angle): below it the latch opens. By default there is none.
    """
    most_force: StrictFloat | None = None
    """
    Largest force on the coordinate (N, or N m for an angle): above it the latch opens. By default there is none.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which it opens for good, s.
    """


SpringItem = TypeAliasType("SpringItem", Annotated[list[StrictFloat], Field(max_length=2, min_length=2)])


DamperItem = TypeAliasType("DamperItem", Annotated[list[StrictFloat], Field(max_length=2, min_length=2)])


class JointSpringLoad(Part):
    """
    Spring and damper side by side on a coordinate of a joint.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["joint_spring"] = "joint_spring"
    joint: StrictStr
    """
    Name of the joint that the spring acts in.
    """
    coordinate: CoordinateKind | None = None
    """
    Coordinate of the joint that the spring acts on; by default the displacement of a joint that has one, else the angle.
    """
    damping: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Damping, N s/m for a displacement and N m s/rad for an angle; 0 by default.
    """
    rest: StrictFloat | None = None
    """
    Coordinate at which the spring is unloaded, m or rad; by default the coordinate at the start.
    """
    stiffness: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Stiffness, N/m for a displacement and N m/rad for an angle; 0 by default. A stiffness or a damping is needed.
    """


class BushingLoad(Part):
    """
    Springs and dampers between two bodies in space, three along and three about the axes of the first one's body (of ground: the
    global ones), from how they stand at the start: the rotation is measured by its vector, angle along axis.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["bushing"] = "bushing"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the bushing connects: `ground` or `body.marker`, then `body.marker`.
    """
    rotational_damping: Annotated[list[StrictFloat] | None, Field(max_length=3, min_length=3)] = None
    """
    Damping about the three axes, N m s/rad; zeros by default.
    """
    rotational_stiffness: Annotated[list[StrictFloat] | None, Field(max_length=3, min_length=3)] = None
    """
    Stiffness about the three axes, N m/rad; zeros by default.
    """
    translational_damping: Annotated[list[StrictFloat] | None, Field(max_length=3, min_length=3)] = None
    """
    Damping along the three axes, N s/m; zeros by default.
    """
    translational_stiffness: Annotated[list[StrictFloat] | None, Field(max_length=3, min_length=3)] = None
    """
    Stiffness along the three axes, N/m; zeros by default.
    """


class JointLimitLoad(Part):
    """
    One-sided springs and dampers on a coordinate of a joint, beyond a lower limit, an upper one or both, without friction; the
    force is continuous in time (Hunt and Crossley 1975).
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["joint_limit"] = "joint_limit"
    joint: StrictStr
    """
    Name of the joint whose coordinate is limited.
    """
    stiffness: Annotated[StrictFloat, Field(ge=0.0)]
    """
    Stiffness `k` beyond a limit, N/m for a displacement and N m/rad for an angle.
    """
    coordinate: CoordinateKind | None = None
    """
    Coordinate of the joint that is limited; by default the displacement of a joint that has one, else the angle.
    """
    damping: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Damping `a` in the force `k d (1 + a d')` at the coordinate `d` beyond a limit, s/m or s/rad; 0 by default.
    """
    lower: StrictFloat | None = None
    """
    Least coordinate without force, m or rad; by default there is no lower limit. One of both limits is needed.
    """
    upper: StrictFloat | None = None
    """
    Largest coordinate without force, m or rad; by default there is no upper limit.
    """


class Mass(Part):
    """
    A mass lumped at a marker.
    """

    marker: StrictStr
    """
    Where it sits: `body.marker`.
    """
    mass: Annotated[StrictFloat, Field(ge=0.0)]
    """
    Mass, kg.
    """
    inertia: Annotated[StrictFloat, Field(ge=0.0)] = 0.0
    """
    Moment of inertia that rotates with the slope, kg m^2; markers of cables only.
    """


class MasterInput(Part):
    """
    A motion that the master sets.
    """

    input: Annotated[StrictInt, Field(ge=0, le=2)]
    """
    Rates that the master sets besides the value: 0 none, 1 the rate, 2 rate and acceleration. A rate that is never set is 0: a unit whose
    value moves all the same says so once. Tables of inputs (`flexbody simulate --input`) need no rates: those of the curve are taken.
    """


class Material(Part):
    """
    Material of a cable.
    """

    damping_ratio: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    In place of `damping_time`: damping ratio of the first mode of the scene, about its start, in which at least half of the energy is
    strain of this body. Packaging makes of it the `damping_time` with which the body gives the mode this ratio; a mode of twice the
    frequency has about twice the ratio.
    """
    damping_time: Annotated[StrictFloat, Field(ge=0.0)] = 0.0
    """
    Kelvin-Voigt damping: ratio of viscosity to stiffness, s.
    """
    density: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Density, kg/m^3.
    """
    shear_modulus: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Shear modulus of rods and beams, Pa.
    """
    youngs_modulus: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Young's modulus, Pa.
    """


MeshComponents = TypeAliasType(
    "MeshComponents",
    Annotated[list[Elements], Field(max_length=2, min_length=2, title="MeshComponents")],
)
"""
Numbers of elements along `s1` and `s2`.
"""


Mesh = TypeAliasType("Mesh", Auto | MeshComponents)
"""
Numbers of elements in JSON: two, each an integer or `"auto"`, or that word for both.
"""


class Method(Part):
    """
    Integrator.
    """

    integrator: Integrator = "auto"
    """
    Integrator.
    """
    work_limit: StrictFloat = 1000000000.0
    """
    Most work of one communication step: evaluations (of accelerations and tangents, factorizations and
    solves) times parts (elements, masses and constraints, and four). A step that takes more ends where it
    is. A billion takes about a minute.
    """


Model = TypeAliasType("Model", Literal["auto", "flexible", "rigid", "modal"])
"""
Whether a cable bends and stretches.

- `auto`: Flexible, unless its number of elements is left to the planner, which finds that another model changes no output by more than
the error wanted: then it says `rigid` or `modal` here.
- `flexible`: Flexible.
- `rigid`: Rigid: a rod, uniform along its length. In the plane, straight, and not deforming at the start. Axial
force and bending moment follow from its balance with inertia; strain and curvature are refused, as is what slides
along it. Elements, Young's modulus, second moment and damping have no effect and are no parameters of its unit.
- `modal`: Reduced to `modes`: it moves freely, and deflections are exact to second order (beyond a tenth of its length a run says so). Of
straight lines that are not twisted at rest: rods and beams, in the plane cables that resist bending and beams. Strains, section forces and stresses are not read of it, and nothing
acts or slides along it but gravity. Static shapes far above the natural modes are critically damped. Elements have no effect.
"""


ModesCount = TypeAliasType("ModesCount", Annotated[StrictInt, Field(ge=0, title="ModesCount")])
"""
So many first ones.
"""


class ModesUpTo(Part):
    """
    Modes up to a frequency.
    """

    up_to: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Highest natural frequency of the free body, Hz.
    """


ModesWord = TypeAliasType("ModesWord", Literal["all", "auto"])
"""
A word that says which modes are taken.

- `all`: All modes of the file.
- `auto`: As many natural modes with held interfaces as the error wanted needs, found by trial runs; none where the body may be rigid.
"""


class RotationVector(Part):
    """
    Rotated from the global axes about an axis, in global components, by its length as angle, rad.
    """

    rotation_vector: Annotated[list[StrictFloat], Field(max_length=3, min_length=3)]
    """
    Rotated from the global axes about an axis, in global components, by its length as angle, rad.
    """


class Cardan(Part):
    """
    Rotated about x, then about the y axis as it is then, then about the z axis as it is then (Cardan angles), rad.
    """

    cardan: Annotated[list[StrictFloat], Field(max_length=3, min_length=3)]
    """
    Rotated about x, then about the y axis as it is then, then about the z axis as it is then (Cardan angles), rad.
    """


class Euler(Part):
    """
    Rotated about z, then about the x axis as it is then, then about the z axis as it is then (Euler's angles: precession,
    nutation, spin), rad.
    """

    euler: Annotated[list[StrictFloat], Field(max_length=3, min_length=3)]
    """
    Rotated about z, then about the x axis as it is then, then about the z axis as it is then (Euler's angles: precession,
    nutation, spin), rad.
    """


MatrixItem = TypeAliasType("MatrixItem", Annotated[list[StrictFloat], Field(max_length=3, min_length=3)])


class Matrix(Part):
    """
    Matrix by rows; its columns are the axes of the frame in global components, orthonormal to 1e-6.
    """

    matrix: Annotated[list[MatrixItem], Field(max_length=3, min_length=3)]
    """
    Matrix by rows; its columns are the axes of the frame in global components, orthonormal to 1e-6.
    """


class Quaternion(Part):
    """
    Quaternion `[w, x, y, z]`, the real part first, of any length but zero.
    """

    quaternion: Annotated[list[StrictFloat], Field(max_length=4, min_length=4)]
    """
    Quaternion `[w, x, y, z]`, the real part first, of any length but zero.
    """


Orientation = TypeAliasType(
    "Orientation",
    Annotated[
        RotationVector | Cardan | Euler | Matrix | Quaternion,
        under_one_of("rotation_vector", "cardan", "euler", "matrix", "quaternion"),
    ],
)
"""
How the frame of a body stands.
"""


class PositionOutput(Part):
    """
    Position of a marker, m.
    """

    kind: Literal["position"] = "position"
    marker: StrictStr
    """
    Marker at which the quantity is read, `body.marker`.
    """


class VelocityOutput(Part):
    """
    Velocity of a marker; rate of the displacement of a joint, m/s.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "x-either": [
                {"must": ["joint"], "may": []},
                {"must": ["marker"], "may": []},
            ]
        },
    )
    kind: Literal["velocity"] = "velocity"
    joint: StrictStr | None = None
    """
    Name of the joint along a line whose displacement has the rate that is read.
    """
    marker: StrictStr | None = None
    """
    Marker whose rate is read, `body.marker`.
    """


class AccelerationOutput(Part):
    """
    Acceleration of a marker; rate of the velocity of a joint, m/s^2.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "x-either": [
                {"must": ["joint"], "may": []},
                {"must": ["marker"], "may": []},
            ]
        },
    )
    kind: Literal["acceleration"] = "acceleration"
    joint: StrictStr | None = None
    """
    Name of the joint along a line whose displacement has the rate that is read.
    """
    marker: StrictStr | None = None
    """
    Marker whose rate is read, `body.marker`.
    """


class DisplacementOutput(Part):
    """
    Way of the second marker of a joint along its line from the first marker or the point, m; not where that line belongs to a
    cable.
    """

    kind: Literal["displacement"] = "displacement"
    joint: StrictStr
    """
    Name of the joint along a line.
    """


class DeflectionOutput(Part):
    """
    Deflection of a marker of a cable, rod, beam or reduced body, m: its place less where it would be if the body were rigid. The rigid body is
    carried by the frame at the marker `from`; without that it is the drawn body where it fits the present one best, in the mean
    of the squared distances along its length. Components are along the axes of the scene as the rigid body carries them. The frame
    at a marker is that of the section, of a cable its tangent: in space the drawn one taken to the present one by the smallest
    rotation. The best fit of a cable that is drawn straight in space rotates by the smallest rotation too. Without `from` the mean axes
    of its modes carry a reduced body, and a rod whose `model` is `modal`. Zero of a body whose `model` is `rigid`. A winch lengthens
    the drawn body.
    """

    kind: Literal["deflection"] = "deflection"
    marker: StrictStr
    """
    Marker of the cable, rod or beam whose deflection is read, `body.marker`.
    """
    from_: StrictStr | None = None
    """
    Another marker of the same body, whose frame carries the rigid body that `marker` is compared with, `body.marker`. By default
    the rigid body is the drawn one where it fits the present one best.
    """


class DirectionOutput(Part):
    """
    Direction at a marker: the unit vector along the cable, or along the first axis of a rigid body, which must have
    inertia.
    """

    kind: Literal["direction"] = "direction"
    marker: StrictStr
    """
    Marker at which the quantity is read, `body.marker`.
    """


class AngleOutput(Part):
    """
    Direction at a marker, or direction of the second marker of a revolute joint less
    that of its first, rad, counted on over full turns.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "x-either": [
                {"must": ["joint"], "may": []},
                {"must": ["marker"], "may": []},
            ]
        },
    )
    kind: Literal["angle"] = "angle"
    joint: StrictStr | None = None
    """
    Name of the joint with an axis whose angle is read.
    """
    marker: StrictStr | None = None
    """
    Marker whose direction is read in the plane, `body.marker`.
    """


class OrientationOutput(Part):
    """
    How a rigid body or the section of a rod in space stands: the matrix whose columns are the axes of its frame in global components, by rows.
    """

    kind: Literal["orientation"] = "orientation"
    marker: StrictStr
    """
    Marker of the rigid body, rod or beam whose frame is read, `body.marker`.
    """


class QuaternionOutput(Part):
    """
    How a rigid body or the section of a rod in space stands, as a unit quaternion, scalar first: `w >= 0` at the start, and from there on without jumps, so that it changes
    its sign with every full turn.
    """

    kind: Literal["quaternion"] = "quaternion"
    marker: StrictStr
    """
    Marker of the rigid body, rod or beam whose frame is read, `body.marker`.
    """


class RotationVectorOutput(Part):
    """
    How a rigid body or the section of a rod in space stands, as a rotation vector: the angle along the axis, rad. The angle is at most pi; where a body rotates on beyond,
    the vector jumps to its opposite.
    """

    kind: Literal["rotation_vector"] = "rotation_vector"
    marker: StrictStr
    """
    Marker of the rigid body, rod or beam whose frame is read, `body.marker`.
    """


class AngularVelocityOutput(Part):
    """
    Rate of the angle, rad/s; in space the angular velocity of a rigid body or of the section of a rod (`axes`).
    """

    model_config = ConfigDict(
        json_schema_extra={
            "x-either": [
                {"must": ["joint"], "may": []},
                {"must": ["marker"], "may": ["axes"]},
            ]
        },
    )
    kind: Literal["angular_velocity"] = "angular_velocity"
    joint: StrictStr | None = None
    """
    Name of the joint with an axis whose angle has the rate that is read.
    """
    axes: Along | None = None
    """
    Axes along which the components are, in space only.
    """
    marker: StrictStr | None = None
    """
    Marker of the body or section whose rotation is read, `body.marker`.
    """


class AngularAccelerationOutput(Part):
    """
    Rate of the angular velocity, rad/s^2.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "x-either": [
                {"must": ["joint"], "may": []},
                {"must": ["marker"], "may": ["axes"]},
            ]
        },
    )
    kind: Literal["angular_acceleration"] = "angular_acceleration"
    joint: StrictStr | None = None
    """
    Name of the joint with an axis whose angle has the rate that is read.
    """
    axes: Along | None = None
    """
    Axes along which the components are, in space only.
    """
    marker: StrictStr | None = None
    """
    Marker of the body or section whose rotation is read, `body.marker`.
    """


class StrainOutput(Part):
    """
    Axial strain at a marker of a cable that bends, in the strain measure of the body. Where a load or joint acts, that after it.
    """

    kind: Literal["strain"] = "strain"
    marker: StrictStr
    """
    Marker of the flexible cable, rod or beam at which the strain is read, `body.marker`.
    """


class CurvatureOutput(Part):
    """
    Curvature at a marker of a cable that bends, in the strain measure of the body, 1/m; in space its size. At a marker of a plate or
    shell the change of curvature, 1/m: components 11, 22 and twice 12 along the axes of its section, positive where the surface
    curves towards its normal.
    """

    kind: Literal["curvature"] = "curvature"
    marker: StrictStr
    """
    Marker of the flexible cable, rod or beam, or of the plate or shell, at which the curvature is read, `body.marker`. That of a pad is
    read in its middle.
    """


class AxialForceOutput(Part):
    """
    Axial force at a marker of a cable, N: the part of the section force along the tangent, tension
    positive, from the balance of forces with inertia. Where a load or joint acts, that after it.
    """

    kind: Literal["axial_force"] = "axial_force"
    marker: StrictStr
    """
    Marker of the cable, rod or beam at which the section force is read, `body.marker`.
    """


class BendingMomentOutput(Part):
    """
    Bending moment at a marker of a cable, N m: of the part after on the part before, positive where
    curvature is, from the balance of moments with inertia; of a rod the whole moment, with the torque. Where a load or joint acts,
    that after it. At a marker of a plate or shell the moment per length, N m/m: components 11, 22 and 12 along the axes of its section,
    positive where curvature is, with that of damping.
    """

    kind: Literal["bending_moment"] = "bending_moment"
    marker: StrictStr
    """
    Marker of the cable, rod or beam, or of the plate or shell, at which the bending moment is read, `body.marker`. That of a pad is read
    in its middle.
    """


class MembraneStrainOutput(Part):
    """
    Strain of the middle surface at a marker of a plate or shell: components 11, 22 and twice 12 along the axes of its section.
    """

    kind: Literal["membrane_strain"] = "membrane_strain"
    marker: StrictStr
    """
    Marker of the plate or shell whose section is read, `body.marker`. That of a pad is read in its middle.
    """


class MembraneForceOutput(Part):
    """
    Force per length in a plate or shell at a marker, N/m: components 11, 22 and 12 along the axes of its section, tension positive,
    with that of damping.
    """

    kind: Literal["membrane_force"] = "membrane_force"
    marker: StrictStr
    """
    Marker of the plate or shell whose section is read, `body.marker`. That of a pad is read in its middle.
    """


class SurfaceStressOutput(Part):
    """
    Stress at the bottom and at the top of a plate or shell at a marker, Pa: components 11, 22 and 12 along the axes of its section,
    tension positive, with that of damping, and the equivalent stresses of von Mises. The normal of the surface points to the top. Not
    of sections that are given as `stiffness`. Derivatives of the equivalent stress are zero where there is no stress.
    """

    kind: Literal["surface_stress"] = "surface_stress"
    marker: StrictStr
    """
    Marker of the plate or shell whose section is read, `body.marker`. That of a pad is read in its middle.
    """


Ply = TypeAliasType("Ply", Annotated[StrictInt, Field(ge=1)])


class PlyStressOutput(Part):
    """
    Stress at the bottom and at the top of `plies` of a plate or shell with a `laminate` at a marker, Pa: along the fibres, across them
    and shear, tension positive, with that of damping.
    """

    kind: Literal["ply_stress"] = "ply_stress"
    marker: StrictStr
    """
    Marker of the plate or shell whose plies are read, `body.marker`. That of a pad is read in its middle.
    """
    plies: Annotated[list[Ply], Field(max_length=200, min_length=1)]
    """
    Numbers of the plies, from 1 at the bottom on. Names of their variables hold these.
    """


class TorqueOutput(Part):
    """
    Torque about the tangent at a marker of a rod, N m: of the part after on the part before, positive where the twist is, from the
    balance of moments with inertia. Where a load or joint acts, that after it.
    """

    kind: Literal["torque"] = "torque"
    marker: StrictStr
    """
    Marker of the rod or beam at which the torque is read, `body.marker`.
    """


Point = TypeAliasType("Point", Annotated[list[StrictFloat], Field(max_length=2, min_length=1)])


class StressOutput(Part):
    """
    Normal stress at `points` of the section at a marker of a rod or beam, or of a cable in the plane, Pa, tension positive:
    `N / A + M1 z / I1 - M2 y / I2` of the force across the section and of the moments about its axes, from the balance of forces
    with inertia, so with what damps. Per area without stress, and without what a curved shape without stress makes of it (a part of
    about height over radius). Not of sections that are given as `stiffness` or have a `coupling`, where moments alone do not say it.
    Where a load or joint acts, that after it.
    """

    kind: Literal["stress"] = "stress"
    marker: StrictStr
    """
    Marker of the rod or beam, or of the cable in the plane, whose section is read, `body.marker`.
    """
    points: Annotated[list[Point], Field(max_length=100, min_length=1)]
    """
    Points of the section, m: one variable for each point, in this order. In space a point is `[y, z]` along the first and the second
    axis of the section from the line of the body. In the plane it is `[y]`, to the left of the direction of the line.
    """


class TorsionStressOutput(Part):
    """
    Shear stress by torsion at `points` of the section at a marker of a rod or beam, Pa, with the sign of the torque: that of
    Saint-Venant in the shape of the section (`T r / J` in a circle or tube). Shear by transverse forces and what a clamp that
    prevents warping adds are not in it. Of sections with a shape.
    """

    kind: Literal["torsion_stress"] = "torsion_stress"
    marker: StrictStr
    """
    Marker of the rod or beam whose section is read, `body.marker`.
    """
    points: Annotated[list[Point], Field(max_length=100, min_length=1)]
    """
    Points of the section, m: one variable for each point, in this order. A point is `[y, z]` along the first and the second axis of
    the section from the line of the body.
    """


class StressTensorOutput(Part):
    """
    Stress at a gauge of a reduced body, Pa: the components `xx`, `yy`, `zz`, `xy`, `xz`, `yz` along the file's axes as the body carries
    them, and the equivalent stress of von Mises. They are the stresses of the modes in the file times the strains of the modes, without
    what damps. Derivatives of the equivalent stress are zero where there is no stress.
    """

    kind: Literal["stress_tensor"] = "stress_tensor"
    gauge: StrictStr
    """
    Gauge of the reduced body at which the stress is read, `body.gauge`.
    """


class ConnectivityForceOutput(Part):
    """
    Force that the part of a cable before a marker exerts on the part after it, global axes, N.
    """

    kind: Literal["connectivity_force"] = "connectivity_force"
    marker: StrictStr
    """
    Marker of the cable, rod or beam at which the section force is read, `body.marker`.
    """


class TravelOutput(Part):
    """
    Where along the cable a joint of kind `point_on_cable` stands: length from the first end, m.
    """

    kind: Literal["travel"] = "travel"
    joint: StrictStr
    """
    Name of the joint of kind `point_on_cable`.
    """


class ReactionOutput(Part):
    """
    Force of a joint on its second marker, or of a motion, N (`axes`).
    """

    model_config = ConfigDict(
        json_schema_extra={
            "x-either": [
                {"must": ["motion"], "may": []},
                {"must": ["joint"], "may": ["axes"]},
            ]
        },
    )
    kind: Literal["reaction"] = "reaction"
    motion: StrictStr | None = None
    """
    Name of the motion whose driving force or moment is read.
    """
    axes: Along | None = None
    """
    Axes along which the components are, in space only.
    """
    joint: StrictStr | None = None
    """
    Name of the joint whose reaction is read.
    """


class ReactionMomentOutput(Part):
    """
    Moment of a joint on its second marker, or of a motion, N m (`axes`).
    """

    model_config = ConfigDict(
        json_schema_extra={
            "x-either": [
                {"must": ["motion"], "may": []},
                {"must": ["joint"], "may": ["axes"]},
            ]
        },
    )
    kind: Literal["reaction_moment"] = "reaction_moment"
    motion: StrictStr | None = None
    """
    Name of the motion whose driving force or moment is read.
    """
    axes: Along | None = None
    """
    Axes along which the components are, in space only.
    """
    joint: StrictStr | None = None
    """
    Name of the joint whose reaction is read.
    """


class GearForceOutput(Part):
    """
    Force of a gear on the displacement of its second joint, N; on the coordinate of the first acts minus the ratio times that.
    """

    kind: Literal["gear_force"] = "gear_force"
    gear: StrictStr
    """
    Name of the gear.
    """


class GearTorqueOutput(Part):
    """
    Torque of a gear on the angle of its second joint, N m; on the coordinate of the first acts minus the ratio times that.
    """

    kind: Literal["gear_torque"] = "gear_torque"
    gear: StrictStr
    """
    Name of the gear.
    """


class LatchForceOutput(Part):
    """
    Force of a closed latch on the displacement of its joint, N; 0 while it is open.
    """

    kind: Literal["latch_force"] = "latch_force"
    latch: StrictStr
    """
    Name of the latch.
    """


class LatchTorqueOutput(Part):
    """
    Torque of a closed latch on the angle of its joint, N m; 0 while it is open.
    """

    kind: Literal["latch_torque"] = "latch_torque"
    latch: StrictStr
    """
    Name of the latch.
    """


class LatchStateOutput(Part):
    """
    State of a latch: 1 while it is closed, 0 while it is open.
    """

    kind: Literal["latch_state"] = "latch_state"
    latch: StrictStr
    """
    Name of the latch.
    """


class LoadForceOutput(Part):
    """
    Force of a load on its second marker, N: of a `spring_damper`, a `bushing`, a `table_spring` or `force_law` between markers or on a
    displacement, a `joint_spring`, `joint_limit` or `joint_friction` on a displacement; of a `contact` on its marker or on the whole body; of an `airfoil`.
    """

    kind: Literal["load_force"] = "load_force"
    load: StrictStr
    """
    Name of the load.
    """


class LoadMomentOutput(Part):
    """
    Moment of a load on its second marker, N m: of a `bushing`, a `table_spring`, `force_law`, `joint_spring`, `joint_limit` or `joint_friction` on an
    angle.
    """

    kind: Literal["load_moment"] = "load_moment"
    load: StrictStr
    """
    Name of the load.
    """


class TensionOutput(Part):
    """
    Tension of a load that pulls along a line, N, negative where it pushes: of a `reeving`, a `spring_damper`, a `table_spring` or
    `force_law` between markers.
    """

    kind: Literal["tension"] = "tension"
    load: StrictStr
    """
    Name of the load.
    """


class LengthOutput(Part):
    """
    Length of the line that a load pulls along, m, and its rate: the distance of both markers of a `spring_damper`, a `table_spring` or a
    `force_law`, the path of a `reeving`.
    """

    kind: Literal["length"] = "length"
    load: StrictStr
    """
    Name of the load.
    """


class EnergyOutput(Part):
    """
    Kinetic, strain and gravitational energy, and that of springs where there are any, J.
    """

    kind: Literal["energy"] = "energy"


class WorkOutput(Part):
    """
    Work done by loads, inputs and motions since the start, and energy lost in dampers, J.
    """

    kind: Literal["work"] = "work"


class MomentumOutput(Part):
    """
    Linear momentum, N s, and angular momentum about the origin, N m s.
    """

    kind: Literal["momentum"] = "momentum"


class CenterOfMassOutput(Part):
    """
    Centre of mass of the scene, m.
    """

    kind: Literal["center_of_mass"] = "center_of_mass"


class ResolutionOutput(Part):
    """
    How well meshes carry the shapes that cables, rods, beams, plates and shells have: the error in position that they make now, estimated from jumps of
    curvature at nodes and from the angles that elements bend by, over the error wanted (`accuracy.error`, or ten times the tolerance). Above 1 more elements are
    needed, which is said once in the log of every run. Within a factor of five on most scenes; what a mesh did before, errors of time,
    a cable of one element that is clamped at both ends, and stretching of surfaces do not count.
    """

    kind: Literal["resolution"] = "resolution"


class ResidualOutput(Part):
    """
    Largest residual of the constraints, relative: of positions and of velocities.
    """

    kind: Literal["residual"] = "residual"


class NaturalFrequencyOutput(Part):
    """
    Natural frequencies of the scene at rest in the initial configuration, rad/s, without dampers; an unstable
    mode is a negative number. In a rotating frame the imaginary parts of the eigenvalues without dampers. Refused
    where a force follows its marker, and where cables, rods or beams rotate initially or by a prescribed motion: see `eigenvalue`.
    """

    kind: Literal["natural_frequency"] = "natural_frequency"
    count: Annotated[StrictInt, Field(ge=0)]
    """
    Number of natural frequencies, from 1 to 100, lowest first; at most as many as the scene has.
    """
    body: StrictStr | None = None
    """
    Name of the body, in a scene with one body only. The names of the variables then begin with it.
    """


class EigenvalueOutput(Part):
    """
    Eigenvalues `s = -decay_rate + i frequency` of small motions `c e^(s t)` about the initial state, as
    `decay_rate` in 1/s, negative where the motion grows, and `frequency` in rad/s, slowest (least size of `s`) first;
    conjugate pairs once, real ones (`frequency` 0) each by itself. With dampers, gyroscopic forces and forces that
    follow, inputs held. Of a state in motion or out of equilibrium they are those of the equations of motion at
    that instant, as seen from the frame of the scene; cables that rotate initially are refused: describe them in a frame
    that rotates with them (`rotation`); so are thin rods of space and reduced bodies that rotate initially.
    """

    kind: Literal["eigenvalue"] = "eigenvalue"
    count: Annotated[StrictInt, Field(ge=0)]
    """
    Number of eigenvalues, from 1 to 100, slowest first; at most as many as the scene has.
    """
    body: StrictStr | None = None
    """
    Name of the body, in a scene with one body only. The names of the variables then begin with it.
    """


Output = TypeAliasType(
    "Output",
    Annotated[
        PositionOutput
        | VelocityOutput
        | AccelerationOutput
        | DisplacementOutput
        | DeflectionOutput
        | DirectionOutput
        | AngleOutput
        | OrientationOutput
        | QuaternionOutput
        | RotationVectorOutput
        | AngularVelocityOutput
        | AngularAccelerationOutput
        | StrainOutput
        | CurvatureOutput
        | AxialForceOutput
        | BendingMomentOutput
        | MembraneStrainOutput
        | MembraneForceOutput
        | SurfaceStressOutput
        | PlyStressOutput
        | TorqueOutput
        | StressOutput
        | TorsionStressOutput
        | StressTensorOutput
        | ConnectivityForceOutput
        | TravelOutput
        | ReactionOutput
        | ReactionMomentOutput
        | GearForceOutput
        | GearTorqueOutput
        | LatchForceOutput
        | LatchTorqueOutput
        | LatchStateOutput
        | LoadForceOutput
        | LoadMomentOutput
        | TensionOutput
        | LengthOutput
        | EnergyOutput
        | WorkOutput
        | MomentumOutput
        | CenterOfMassOutput
        | ResolutionOutput
        | ResidualOutput
        | NaturalFrequencyOutput
        | EigenvalueOutput,
        Field(discriminator="kind"),
    ],
)
"""
A quantity that the master reads.
"""


class Pad(Part):
    """
    Pad of a marker: position and orientation are means over it, and forces are spread over it.
    """

    at: Annotated[list[StrictFloat], Field(max_length=2, min_length=2)]
    """
    Middle of the pad, `[s1, s2]`.
    """
    pad: Annotated[list[StrictFloat], Field(max_length=2, min_length=2)]
    """
    Lengths along `s1` and `s2`, m; what is beyond the edges does not count.
    """


PatchMarkerComponents = TypeAliasType(
    "PatchMarkerComponents",
    Annotated[
        list[StrictFloat],
        Field(max_length=2, min_length=2, title="PatchMarkerComponents"),
    ],
)
"""
A point `[s1, s2]`.
"""


PatchMarker = TypeAliasType("PatchMarker", PatchMarkerComponents | Pad)
"""
A marker on a plate or shell.
"""


class PatchMaterial(Part):
    """
    Isotropic material of a plate or shell.
    """

    youngs_modulus: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Young's modulus, Pa.
    """
    poisson_ratio: Annotated[StrictFloat, Field(gt=-1.0, lt=0.5)]
    """
    Poisson's ratio, between -1 and 0.5.
    """
    density: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Density, kg/m^3.
    """
    damping_time: Annotated[StrictFloat, Field(ge=0.0)] = 0.0
    """
    Kelvin-Voigt damping: ratio of viscosity to stiffness, s.
    """


AItem = TypeAliasType("AItem", Annotated[list[StrictFloat], Field(max_length=3, min_length=3)])


DItem = TypeAliasType("DItem", Annotated[list[StrictFloat], Field(max_length=3, min_length=3)])


BItem = TypeAliasType("BItem", Annotated[list[StrictFloat], Field(max_length=3, min_length=3)])


class PatchStiffness(Part):
    """
    Stiffness of a section of a plate or shell: forces `N = A e - B k` and moments `M = D k - B e` per length, of strains `e` of the middle
    surface and curvatures `k`, each along the first axis, along the second and of shear (engineering). The strain at a height is `e - z k`.
    """

    A: Annotated[list[AItem], Field(max_length=3, min_length=3)]
    """
    Membrane stiffness, N/m.
    """
    D: Annotated[list[DItem], Field(max_length=3, min_length=3)]
    """
    Bending stiffness, N m.
    """
    B: Annotated[list[BItem], Field(max_length=3, min_length=3)] = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
    ]
    """
    Coupling, N; zero where nothing is said.
    """


PatchThicknessNumber = TypeAliasType(
    "PatchThicknessNumber",
    Annotated[StrictFloat, Field(gt=0.0, title="PatchThicknessNumber")],
)
"""
Thickness all over, m.
"""


PatchThicknessExpression = TypeAliasType(
    "PatchThicknessExpression",
    Annotated[StrictStr, Field(title="PatchThicknessExpression")],
)
"""
Expression in `s1` and `s2`, m.
"""


PatchThickness = TypeAliasType("PatchThickness", PatchThicknessNumber | PatchThicknessExpression)
"""
Thickness of a plate or shell.
"""


class PlyMaterial(Part):
    """
    Orthotropic material of a ply.
    """

    youngs_modulus: Annotated[list[StrictFloat], Field(max_length=2, min_length=2)]
    """
    Young's moduli along both axes, Pa.
    """
    poisson_ratio: StrictFloat
    """
    Poisson's ratio: contraction along the second axis by tension along the first.
    """
    shear_modulus: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Shear modulus in the plane, Pa.
    """
    density: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Density, kg/m^3.
    """


class ForcePort(Part):
    """
    A force comes in, the motion of the marker goes out.
    """

    name: StrictStr
    """
    Name, with which those of its variables begin: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    marker: StrictStr
    """
    Where it is, `body.marker`.
    """
    kind: Literal["force"] = "force"
    rotation: StrictBool | None = None
    """
    Whether a moment comes in and the rotation of the marker goes out too.
    """


class MotionPort(Part):
    """
    A motion comes in, the force that the scene exerts on the outside goes out.
    """

    name: StrictStr
    """
    Name, with which those of its variables begin: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    marker: StrictStr
    """
    Where it is, `body.marker`.
    """
    kind: Literal["motion"] = "motion"
    damping: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Damping of a damper beside the spring, N s/m.
    """
    rotation: StrictBool | None = None
    """
    Whether a rotation comes in and a moment goes out too. A rotational stiffness or damping implies it.
    """
    rotational_damping: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    With a stiffness or a damping only: damping beside the rotational spring, N m s/rad.
    """
    rotational_stiffness: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    With a stiffness or a damping only: stiffness of a spring between the orientation that comes in and that of the marker, N m/rad.
    """
    stiffness: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Stiffness of a spring between the point that comes in and the marker, N/m; by default the marker follows the point. With a
    stiffness or a damping the marker stays free.
    """


Port = TypeAliasType("Port", Annotated[ForcePort | MotionPort, Field(discriminator="kind")])
"""
A marker that a master couples to another unit: one set of inputs and outputs, one terminal.
"""


class Rectangle(Part):
    """
    Rectangle.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "rectangle"},
    )
    width: StrictFloat
    """
    Edge along the first axis, m.
    """
    height: StrictFloat
    """
    Edge along the second axis, m.
    """


class Ellipse(Part):
    """
    Ellipse.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "ellipse"},
    )
    width: StrictFloat
    """
    Diameter along the first axis, m.
    """
    height: StrictFloat
    """
    Diameter along the second axis, m.
    """


class Circle(Part):
    """
    Circle.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "circle"},
    )
    radius: StrictFloat
    """
    Radius, m.
    """


class Tube(Part):
    """
    Circle with a round hole in its middle.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "tube"},
    )
    radius: StrictFloat
    """
    Outer radius, m.
    """
    inner_radius: StrictFloat
    """
    Radius of the hole, m.
    """


class HollowEllipse(Part):
    """
    Ellipse with a hole of the same proportions in its middle.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "hollow_ellipse"},
    )
    width: StrictFloat
    """
    Diameter along the first axis, m.
    """
    height: StrictFloat
    """
    Diameter along the second axis, m.
    """
    inner_width: StrictFloat
    """
    Diameter of the hole along the first axis, m. Along the second it is the same part of the height.
    """


class Box(Part):
    """
    Box with edges along the axes of the frame.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "box"},
    )
    size: Annotated[list[StrictFloat], Field(max_length=3, min_length=3)]
    """
    Lengths of the edges along x, y and z, m.
    """


class IProfile(Part):
    """
    Letter I: a web along the second axis between two equal flanges along the first.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "i"},
    )
    width: StrictFloat
    """
    Length of the flanges along the first axis, m.
    """
    height: StrictFloat
    """
    Whole height along the second axis, m.
    """
    web_thickness: StrictFloat
    """
    Thickness of the web, m.
    """
    flange_thickness: StrictFloat
    """
    Thickness of each flange, m.
    """


class Channel(Part):
    """
    Channel: a web along the second axis, from whose ends two equal flanges go along the first axis, to its positive side.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "c"},
    )
    width: StrictFloat
    """
    Length of the flanges with the web, m.
    """
    height: StrictFloat
    """
    Whole height along the second axis, m.
    """
    web_thickness: StrictFloat
    """
    Thickness of the web, m.
    """
    flange_thickness: StrictFloat
    """
    Thickness of each flange, m.
    """


class TProfile(Part):
    """
    Letter T: a flange along the first axis, from whose middle a web goes down, to the negative side of the second axis.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "t"},
    )
    width: StrictFloat
    """
    Length of the flange along the first axis, m.
    """
    height: StrictFloat
    """
    Whole height along the second axis, m.
    """
    web_thickness: StrictFloat
    """
    Thickness of the web, m.
    """
    flange_thickness: StrictFloat
    """
    Thickness of the flange, m.
    """


class Angle(Part):
    """
    Angle: a leg along the second axis, from whose lower end another goes along the first axis, to its positive side.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "l"},
    )
    width: StrictFloat
    """
    Length of the leg along the first axis with the other one, m.
    """
    height: StrictFloat
    """
    Length of the leg along the second axis with the other one, m.
    """
    web_thickness: StrictFloat
    """
    Thickness of the leg along the second axis, m.
    """
    flange_thickness: StrictFloat
    """
    Thickness of the leg along the first axis, m.
    """


OutlineItem = TypeAliasType("OutlineItem", Annotated[list[StrictFloat], Field(max_length=2, min_length=2)])


Hole = TypeAliasType("Hole", Annotated[list[StrictFloat], Field(max_length=2, min_length=2)])


class Polygon(Part):
    """
    Polygon, with holes that are polygons. Its corners are about any origin: the centroid comes to the line.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "polygon"},
    )
    outline: Annotated[list[OutlineItem], Field(max_length=200, min_length=3)]
    """
    Corners around it, in either direction: first and second coordinate, m.
    """
    holes: list[list[Hole]] = []
    """
    Corners around each hole.
    """


Profile = TypeAliasType(
    "Profile",
    Annotated[
        Rectangle | Ellipse | Circle | Tube | HollowEllipse | Box | IProfile | Channel | TProfile | Angle | Polygon,
        under_one_of("rectangle", "ellipse", "circle", "tube", "hollow_ellipse", "box", "i", "c", "t", "l", "polygon"),
    ],
)
"""
Shape of a cross section, from which its numbers follow. Its centroid is on the line of the body. Axes are those of the section of a rod; a
cable in the plane has the first across the plane, so that its height lies in it.
"""


InertiaItem = TypeAliasType("InertiaItem", Annotated[list[StrictFloat], Field(max_length=6, min_length=6)])


StiffnessItem = TypeAliasType("StiffnessItem", Annotated[list[StrictFloat], Field(max_length=6, min_length=6)])


class Section(Part):
    """
    Cross section of a cable or a rod: its shape, or its numbers.
    """

    about: Annotated[list[StrictFloat] | None, Field(max_length=2, min_length=2)] = None
    """
    Where both are given about: coordinates along the first and the second axis from the line of the body, m.
    """
    area: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Area, m^2.
    """
    axial_coupling: Annotated[list[StrictFloat] | None, Field(max_length=3, min_length=3)] = None
    """
    Stiffness of rods that couples stretching with twist, with bending about the first axis and with bending about the second, N m; none
    where nothing is said. The axial force is the first times the twist, and so on: ropes of wires untwist when they are pulled. An
    elastic centre at `[y, z]` is `[0, E A z, -E A y]`, with second moments about the line and `coupling` `-E A y z` of both bendings.
    """
    coupling: Annotated[list[StrictFloat] | None, Field(max_length=3, min_length=3)] = None
    """
    Stiffness of rods of layered or otherwise anisotropic material that couples twist with bending about the first axis, twist
    with bending about the second, and both bendings, N m^2; none where nothing is said. Torque is the first times the curvature
    about the first axis, and so on.
    """
    inertia: Annotated[list[InertiaItem] | None, Field(max_length=6, min_length=6)] = None
    """
    Mass and inertia per length of beams with `stiffness`, in the same order: kg/m, kg, kg m. The centre of mass is on the line, and
    the section lies across it.
    """
    second_moment: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Second moment of area of cables and of planar beams, m^4; 0 is a cable without bending stiffness.
    """
    second_moments: Annotated[list[StrictFloat] | None, Field(max_length=2, min_length=2)] = None
    """
    Second moments of area of rods and beams in space for bending about the first and about the second axis of the section, m^4.
    """
    shape: Profile | None = None
    """
    Shape of the section, from which all numbers follow. Without it the numbers are given.
    """
    shear_factor: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Ratio of the area that carries shear to the area, for beams in the plane.
    """
    shear_factors: Annotated[list[StrictFloat] | None, Field(max_length=2, min_length=2)] = None
    """
    Ratios, for beams in space, of the areas that carry shear along the first and along the second axis to the area. Of a shape, where
    nothing is said, those of Cowper, which take the material's ratio of Poisson.
    """
    stiffness: Annotated[list[StiffnessItem] | None, Field(max_length=6, min_length=6)] = None
    """
    Whole stiffness matrix of the section of beams, instead of a shape or numbers and of the moduli of the material. Symmetric, in the
    order axial force, shear along the first axis, along the second, torque, moment about the first axis, about the second; N, N m, N m^2.
    In the plane, which the first axis is across, axial force, shear along the second and moment about the first count.
    """
    torsion_constant: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Torsion constant (of Saint-Venant) of rods and beams in space, m^4; of a circle its polar second moment.
    """


class Cylinder(Part):
    """
    Cylinder.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "cylinder"},
    )
    radius: StrictFloat
    """
    Radius, m.
    """
    length: StrictFloat
    """
    Length along the axis, m.
    """
    axis: Annotated[list[StrictFloat], Field(max_length=3, min_length=3)] = [
        0.0,
        0.0,
        1.0,
    ]
    """
    Direction of its axis in the frame, of any length but zero.
    """


class Sphere(Part):
    """
    Sphere.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "sphere"},
    )
    radius: StrictFloat
    """
    Radius, m.
    """


class TubeSolid(Part):
    """
    Cylinder with a round hole all along its axis.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "tube"},
    )
    radius: StrictFloat
    """
    Outer radius, m.
    """
    inner_radius: StrictFloat
    """
    Radius of the hole, m.
    """
    length: StrictFloat
    """
    Length along the axis, m.
    """
    axis: Annotated[list[StrictFloat], Field(max_length=3, min_length=3)] = [
        0.0,
        0.0,
        1.0,
    ]
    """
    Direction of its axis in the frame, of any length but zero.
    """


Solid = TypeAliasType(
    "Solid", Annotated[Box | Cylinder | Sphere | TubeSolid, under_one_of("box", "cylinder", "sphere", "tube")]
)
"""
Shape of a rigid body, its centre at the origin of the body's frame. Lists have three components, in the plane too.
"""


SpinNumber = TypeAliasType("SpinNumber", Annotated[StrictFloat, Field(title="SpinNumber")])
"""
In the plane.
"""


SpinComponents = TypeAliasType(
    "SpinComponents",
    Annotated[list[StrictFloat], Field(max_length=3, min_length=3, title="SpinComponents")],
)
"""
In space.
"""


Spin = TypeAliasType("Spin", SpinNumber | SpinComponents)
"""
An angular velocity: a number in the plane, counter-clockwise, three components in space, rad/s.
"""


class Station(Part):
    """
    The cross section at a place along a body. Between two stations shapes of one kind change their sizes linearly, numbers
    change linearly themselves; two stations at one place are a step.
    """

    at: Annotated[StrictFloat, Field(ge=0.0, le=1.0)]
    """
    Material coordinate: 0 is the first end, 1 the last.
    """
    section: Section
    """
    Cross section there.
    """
    twist: StrictFloat = 0.0
    """
    Angle of rods and beams about the tangent by which the section's axes are rotated there, without stress, from where they would be
    untwisted, rad.
    """


Strain = TypeAliasType(
    "Strain",
    Literal["thetaPrime", "GreenLagrange_FrenetKappa", "engStrain_FrenetKappa"],
)
"""
Strain measures by name; they agree only for small strains.

- `thetaPrime`: Stretch `|r'| - 1` and rotation per reference length: geometrically exact beam theory.
- `GreenLagrange_FrenetKappa`: Green-Lagrange axial strain and the curvature of the deformed line.
- `engStrain_FrenetKappa`: Stretch `|r'| - 1` and the curvature of the deformed line.
"""


TableItem = TypeAliasType("TableItem", Annotated[list[StrictFloat], Field(max_length=2, min_length=2)])


class Table(Part):
    """
    A table over time.
    """

    table: list[TableItem]
    """
    Times (s, increasing) and values.
    """
    interpolation: Interpolation | None = None
    """
    Curve between the points; by default `spline` for a motion and `linear` for all else.
    """
    slopes: Annotated[list[StrictFloat] | None, Field(max_length=2, min_length=2)] = None
    """
    Rates of a spline at its first and last point, with which it goes on outside, 1/s; 0 where nothing is
    said: at rest before and after.
    """


ValueNumber = TypeAliasType("ValueNumber", Annotated[StrictFloat, Field(title="ValueNumber")])
"""
Constant.
"""


ValueExpression = TypeAliasType("ValueExpression", Annotated[StrictStr, Field(title="ValueExpression")])
"""
Expression in `t`, e.g. `0.1*sin(2*PI*t)`: numbers, `PI`, `E`, `+ - * / ^`, `< <= > >=` (1 or 0), `sin`, `cos`,
`tan`, `asin`, `acos`, `atan`, `atan2(y, x)`, `sinh`, `cosh`, `tanh`, `exp`, `ln`, `log2`, `log10`, `sqrt`, `abs`,
`sign`, `step` (1 from zero on), `min`, `max`, `if(c, a, b)` (`a` where `c` is positive). No step leads
across a kink or a jump. A motion must not jump; where its velocity does, the drive strikes the bodies. Of loads
that are distributed along a body also in its material coordinate `s`, 0 at the first end and 1 at the last.
"""


Value = TypeAliasType("Value", ValueNumber | ValueExpression | Table)
"""
A number, an expression in the time `t` (s), or a table over time.
"""


Vector = TypeAliasType("Vector", Annotated[list[StrictFloat], Field(max_length=3, min_length=2)])
"""
Components of a vector or a point: `[x, y]` in the plane, `[x, y, z]` in space.
"""


class InitialMotion(Part):
    """
    Rigid motion of a body at the start.
    """

    deformation: Annotated[list[StrictStr] | None, Field(max_length=3, min_length=2)] = None
    """
    Velocity of deformation, m/s, beside both: its components as expressions in the material coordinate `s`,
    0 at the first end and 1 at the last, e.g. `["0", "sin(PI*s)"]`; of plates and shells in `s1` and `s2`, e.g. `["0", "0", "s1*s2"]`.
    Cables, rods, beams, plates and shells only. Sections of rods and beams rotate with the line.
    """
    spin: Spin = 0.0
    """
    Angular velocity, counter-clockwise in the plane, in global axes in space, rad/s.
    """
    velocity: Vector | None = None
    """
    Velocity of the first end of a cable, of the centre of mass of a rigid body or of the origin of a reduced body's file, m/s; zero by default.
    """


class InputCourse(Part):
    """
    Profile of an input in the experiment that is planned for: `value`, or a ramp `from` one value `to` another.
    """

    input: StrictStr
    """
    Name of the input, with its index where it is a component.
    """
    course: Course | None = None
    """
    How it goes there: `ramp` where nothing is said.
    """
    duration: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Time that a ramp takes from the start on, s; it then stays. Where nothing is said it takes a tenth of the experiment, and goes back
    after half of it.
    """
    from_: StrictFloat | None = None
    """
    Value that it starts from.
    """
    to: StrictFloat | None = None
    """
    Value that it goes to.
    """
    value: Value | None = None
    """
    Profile in time, beside which no other key stands: a number, an expression in `t`, or a table, straight from point to point unless it
    says `spline`. A driven motion has the rates of this course, where they are inputs without one.
    """


class Revolute(Part):
    """
    Holds the position, in space also an axis of rotation. A spring and a damper may act against the rotation.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["revolute"] = "revolute"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    """
    angle: StrictFloat | None = None
    """
    With `stiffness` or `damping` only: angle at which the spring is unloaded, rad; by default the angle at the start.
    """
    damping: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Damping of rotation, N m s/rad; by default there is no damper.
    """
    direction: Vector | None = None
    """
    Axis of rotation, required in space and absent in the plane. It is given in the axes of the first marker's body at the start:
    of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    """
    point: Vector | None = None
    """
    With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """
    stiffness: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Stiffness of a spring against rotation, N m/rad; by default there is no spring.
    """


class Spherical(Part):
    """
    Holds the position, in space: a ball in its socket.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["spherical"] = "spherical"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    """
    point: Vector | None = None
    """
    With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Universal(Part):
    """
    Holds the position and a right angle between an axis of each body, in space: a cross between two forks.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["universal"] = "universal"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    """
    direction: Vector
    """
    Axis of the cross that is fixed in the first body. It is given in the axes of the first marker's body at the start:
    of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    """
    second_direction: Vector
    """
    Axis of the cross that is fixed in the second body, perpendicular to `direction` and in the same axes.
    """
    point: Vector | None = None
    """
    With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class ConstantVelocity(Part):
    """
    Holds the position and lets both bodies rotate alike about an axis of each, in space: the homokinetic joint of drive shafts.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["constant_velocity"] = "constant_velocity"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    """
    direction: Vector
    """
    Axis of the first shaft. It is given in the axes of the first marker's body at the start:
    of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    """
    point: Vector | None = None
    """
    With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """
    second_direction: Vector | None = None
    """
    Axis of the second shaft in the same axes and sense, less than a right angle from `direction`; by default `direction`.
    """


class Weld(Part):
    """
    Holds the position and the direction, in space how bodies stand to each other.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["weld"] = "weld"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    """
    angle: StrictFloat | None = None
    """
    In the plane only: angle from the direction of the first marker to that of the second, rad; by default the angle at the start.
    The direction of `ground` is 0.
    """
    point: Vector | None = None
    """
    With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class PointOnLine(Part):
    """
    Holds the marker on a line of the first one, which may move. The marker rotates freely.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["point_on_line"] = "point_on_line"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or the `body.marker` that carries the line, then the `body.marker` on the line.
    """
    direction: Vector
    """
    Direction of the line. It is given in the axes of the first marker's body at the start: of `ground` the global axes, of a rod
    or beam the tangent and both axes of its section.
    """
    point: Vector | None = None
    """
    With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Cylindrical(Part):
    """
    Holds the marker on a line of the first one, in space, and lets it rotate about that line only.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["cylindrical"] = "cylindrical"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or the `body.marker` that carries the line, then the `body.marker` on the line.
    """
    direction: Vector
    """
    Direction of the line, which is the axis of rotation too. It is given in the axes of the first marker's body at the start:
    of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    """
    point: Vector | None = None
    """
    With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Screw(Part):
    """
    Holds the marker on a line of the first one, in space, along which it goes as it rotates about it.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["screw"] = "screw"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or the `body.marker` of a rigid body that carries the axis, then the `body.marker` on it.
    """
    direction: Vector
    """
    Axis of the screw. It is given in the axes of the first marker's body at the start: of `ground` the global axes.
    """
    pitch: StrictFloat
    """
    Displacement along the axis for each full turn, m; negative for a left-handed thread.
    """
    point: Vector | None = None
    """
    With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Prismatic(Part):
    """
    Holds the marker on a line of the first one, and the direction, in space how bodies stand to each other.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["prismatic"] = "prismatic"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or the `body.marker` that carries the line, then the `body.marker` on the line.
    """
    angle: StrictFloat | None = None
    """
    In the plane only: angle from the direction of the first marker to that of the second, rad; by default the angle at the start.
    The direction of `ground` is 0.
    """
    direction: Vector | None = None
    """
    Direction of the line, required in space; in the plane by default the direction of the first marker. It is given in the axes of
    the first marker's body at the start: of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    """
    point: Vector | None = None
    """
    With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Planar(Part):
    """
    Holds the marker in a plane of the first one, in space, and lets it rotate in that plane only.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["planar"] = "planar"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or the `body.marker` that carries the plane, then the `body.marker` in the plane.
    """
    direction: Vector
    """
    Normal of the plane, which is the axis of rotation too. It is given in the axes of the first marker's body at the start:
    of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    """
    point: Vector | None = None
    """
    With `ground` only: a point of the plane on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Distance(Part):
    """
    Holds the distance.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["distance"] = "distance"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers at the ends of the link: `ground` or `body.marker`, then `body.marker`.
    """
    length: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Length of the link, m; by default the distance of its ends at the start.
    """
    point: Vector | None = None
    """
    With `ground` only: end of the link on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Generic(Part):
    """
    Holds, in space, what `free` does not name.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["generic"] = "generic"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    """
    free: list[Freedom]
    """
    Translations along and rotations about the axes of the first marker's body that are free. The joint holds all others. With
    `ground` these are the global axes. Of two free rotations the first is about the axis of the first body.
    """
    point: Vector | None = None
    """
    With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


class Symmetry(Part):
    """
    Holds an edge of a plate or shell in a plane of symmetry, and the normal of the surface there.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["symmetry"] = "symmetry"
    edges: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    `ground`, then the edge, `body.s1=0`, `body.s1=1`, `body.s2=0` or `body.s2=1`.
    """
    normal: Vector
    """
    Normal of the plane of symmetry, of any length. The edge lies in the plane, and the surface crosses it at a right angle.
    """
    release_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    """


Joint = TypeAliasType(
    "Joint",
    Annotated[
        Revolute
        | Spherical
        | Universal
        | ConstantVelocity
        | Weld
        | PointOnLine
        | Cylindrical
        | Screw
        | Prismatic
        | Planar
        | OrientationJoint
        | Distance
        | PointOnCable
        | Generic
        | Clamped
        | Pinned
        | Smooth
        | Symmetry,
        Field(discriminator="kind"),
    ],
)
"""
A joint between two markers.
"""


class LaminatePly(Part):
    """
    Ply of a laminate.
    """

    material: PlyMaterial
    """
    Orthotropic material.
    """
    thickness: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Thickness, m.
    """
    angle: StrictFloat = 0.0
    """
    Angle of the first axis of the material from that of the laminate, counter-clockwise about the normal, rad.
    """


class SpringDamperLoad(Part):
    """
    Spring and damper side by side between two points.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["spring_damper"] = "spring_damper"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Ends of the spring: `ground` or `body.marker`, then `body.marker`.
    """
    damping: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Damping, N s/m; 0 by default.
    """
    length: Value | None = None
    """
    Length at rest, m; by default the distance of the ends at the start.
    """
    point: Vector | None = None
    """
    With `ground` only: end of the spring on the ground, m; by default the position of the second marker at the start.
    """
    stiffness: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Stiffness, N/m; 0 by default. A stiffness or a damping is needed.
    """


class TableSpringLoad(Part):
    """
    Spring and damper side by side between two points, whose forces are tables over length and over its rate.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["table_spring"] = "table_spring"
    spring: Annotated[list[SpringItem], Field(min_length=2)]
    """
    Force of the spring against growth, by the length or the coordinate: two points `[m, N]` or more (`[rad, N m]` of an angle), in
    increasing order. The curve through them is cubic and monotone where they are, and straight outside.
    """
    coordinate: CoordinateKind | None = None
    """
    Coordinate of the joint that the load acts on; by default the displacement of a joint that has one, else the angle.
    """
    damper: Annotated[list[DamperItem] | None, Field(min_length=2)] = None
    """
    Force of the damper against growth, by the rate: points `[m/s, N]` as of `spring` (`[rad/s, N m]` of an angle), one of them `[0, 0]`;
    by default there is no damper.
    """
    joint: StrictStr | None = None
    """
    Name of the joint on whose coordinate the load acts.
    """
    markers: Annotated[list[StrictStr] | None, Field(max_length=2, min_length=2)] = None
    """
    Ends: `ground` or `body.marker`, then `body.marker`. The load acts along the line between them. Either these or `joint`.
    """
    point: Vector | None = None
    """
    With `ground` only: end on the ground, m; by default the position of the second marker at the start.
    """


class ReevingLoad(Part):
    """
    A rope of given stiffness and without mass that runs over points without friction, and onto a drum. It has one tension all along:
    hook blocks, tackles, hoists, cable robots. Slack, it has none.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["reeving"] = "reeving"
    markers: Annotated[list[StrictStr], Field(max_length=30, min_length=2)]
    """
    Points that the rope runs over, in order from one of its ends to the other: `ground` or `body.marker`, from 2 to 30.
    """
    axial_stiffness: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Axial stiffness of the rope, `E A`, N.
    """
    damping_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Kelvin-Voigt damping: ratio of viscosity to stiffness, s; 0 by default. The viscous part of the tension is at most as large as the
    elastic part.
    """
    drum: StrictStr | None = None
    """
    Name of a joint with an angle that rotates a drum. The drum winds up the rope from either of its ends.
    """
    drum_radius: StrictFloat | None = None
    """
    Radius of the drum, m: a positive angle of the joint winds up, of a negative radius it pays out. Needed with `drum`.
    """
    length: Value | None = None
    """
    Length of the rope without stress, m; by default that of its path at the start. A drum winds up from it.
    """
    points: list[Vector] = []
    """
    Points on the ground, one for each `ground` among `markers` in their order, m.
    """


class ForceLawLoad(Part):
    """
    A force by an expression in a length or a coordinate of a joint, in its rate, in the time and in a value that an input sets: drag
    torques, bump stops, dampers with knees, actuators.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["force_law"] = "force_law"
    force: StrictStr
    """
    Force against growth of the length or of the coordinate, N, or N m on an angle: an expression in the length or coordinate `x` (m or
    rad), its rate `v` (m/s or rad/s), the time `t` (s) and the value `u` of an input `control`.
    """
    coordinate: CoordinateKind | None = None
    """
    Coordinate of the joint that the load acts on; by default the displacement of a joint that has one, else the angle.
    """
    joint: StrictStr | None = None
    """
    Name of the joint on whose coordinate the load acts.
    """
    markers: Annotated[list[StrictStr] | None, Field(max_length=2, min_length=2)] = None
    """
    Ends: `ground` or `body.marker`, then `body.marker`. The load acts along the line between them. Either these or `joint`.
    """
    point: Vector | None = None
    """
    With `ground` only: end on the ground, m; by default the position of the second marker at the start.
    """


class JointFrictionLoad(Part):
    """
    Dry friction on a coordinate of a joint: Coulomb's, with a larger force at rest and its fall by Stribeck where they are given. What
    sticks stands still until a force overcomes it.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["joint_friction"] = "joint_friction"
    joint: StrictStr
    """
    Name of the joint that has friction.
    """
    force: Value
    """
    Force against sliding, N for a displacement and N m for an angle. A number, an expression in `t` or a table; where it is negative
    there is no friction.
    """
    coordinate: CoordinateKind | None = None
    """
    Coordinate of the joint with friction; by default the displacement of a joint that has one, else the angle.
    """
    static_ratio: Annotated[StrictFloat | None, Field(ge=1.0)] = None
    """
    Largest force while the coordinate sticks, in parts of that against sliding; 1 by default.
    """
    stribeck_speed: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Speed `w` of sliding over which the force falls from the largest one to that against sliding, m/s or rad/s: by `exp(-(v/w)^2)` (Stribeck); 0
    by default, for at once.
    """


class FluidLoad(Part):
    """
    A fluid that streams past a cable, rod or beam: drag, added mass, inertia of the fluid and buoyancy per reference length (Morison
    and others 1950). The added mass counts in all directions alike.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["fluid"] = "fluid"
    body: StrictStr
    """
    Name of the cable, rod, beam, plate or shell that the fluid streams past.
    """
    density: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Density of the fluid, kg/m^3.
    """
    added_mass: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Coefficient of added mass of a line: the mass of fluid that moves along, divided by the mass of displaced fluid; 0 by default.
    """
    area: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Area of the section of a line that displaces fluid, m^2; by default the area of a circle of this `diameter`.
    """
    buoyancy: StrictBool | None = True
    """
    Whether the weight of the displaced fluid lifts the body; true by default.
    """
    current: Annotated[list[Value] | None, Field(max_length=3, min_length=2)] = None
    """
    Velocity of the fluid in global axes, m/s; zero by default. Expressions may contain the material coordinate `s` of a line, which is
    0 at the first end and 1 at the last, and the coordinates `s1` and `s2` of a plate or shell, each from 0 to 1.
    """
    diameter: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Diameter of a line for drag, m; by default the outer diameter of a circle or tube, else that of a circle with the area of the section.
    """
    drag: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Coefficient of drag across a line, for the area `diameter` times length, or along the normal of a plate or shell, for its area; 0 by
    default.
    """
    tangential_drag: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Coefficient of drag along a line, for the area `pi diameter` times length, or in the surface of a plate or shell, both sides
    together, for its area; 0 by default.
    """


class AirfoilLoad(Part):
    """
    An airfoil, as a strip at a marker or along a rod or beam: lift, drag and moment by the angle of attack and the rate of pitch,
    quasi-steady. A rigid body with drag alone is one too.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["airfoil"] = "airfoil"
    chord_direction: Vector
    """
    Direction from the leading to the trailing edge, of any length: along the axes of the frame of a rigid body, or of the section of a
    rod or beam (tangent, first axis, second axis). In the plane along the direction of the marker and to its left.
    """
    chord: Value
    """
    Chord, m: a number above 0. Along a body also a table over its material coordinate `s`, which is 0 at the first end and 1 at the last,
    or an expression in `s`; there is no airfoil where it is 0.
    """
    density: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Density of the air, kg/m^3.
    """
    lift: Value
    """
    Coefficient of lift for chord times span: a number, a table over the angle of attack in rad, whose ends hold outside of it, or an
    expression in the angle of attack `a` (rad, between -pi and pi), in the reduced rate of pitch `q`, nose up, in the time `t` and along a
    body in `s`. `q` is the rate in rad/s times the chord over twice the speed of the air.
    """
    ahead: Value | None = None
    """
    Distance of the aerodynamic centre ahead of the marker, or of the line of the body, towards the leading edge, over the chord: a
    number, along a body also a table over `s` or an expression in it; 0 by default.
    """
    body: StrictStr | None = None
    """
    Name of the rod or beam, in the plane also of the cable, that is an airfoil all along.
    """
    drag: Value | None = None
    """
    Coefficient of drag for chord times span, as `lift`; 0 by default.
    """
    lift_direction: Vector | None = None
    """
    In space, direction of the lift at no angle of attack, along the same axes, of any length. What of it is along the chord does not
    count. In the plane it is the chord rotated left.
    """
    marker: StrictStr | None = None
    """
    Marker of a strip: of a rigid body with inertia, of a rod or beam, or of a cable in the plane. Either this or `body` is needed.
    """
    moment: Value | None = None
    """
    Coefficient of the moment about the aerodynamic centre, nose up, for the square of the chord times span, as `lift`; 0 by default.
    """
    span: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Length of a strip at a marker along the span, m.
    """
    wind: Annotated[list[Value] | None, Field(max_length=3, min_length=2)] = None
    """
    Velocity of the air in global axes, m/s; zero by default. Along a body expressions may contain `s`.
    """


LoadValueComponents = TypeAliasType(
    "LoadValueComponents",
    Annotated[list[Value], Field(max_length=3, min_length=2, title="LoadValueComponents")],
)
"""
The components of a vector.
"""


LoadValue = TypeAliasType("LoadValue", Value | LoadValueComponents)
"""
Values of a load: one of a moment, as many as dimensions of a force.
"""


Modes = TypeAliasType("Modes", ModesWord | ModesCount | ModesUpTo | FixedInterfaceModes)
"""
Modes of a reduced model that are taken.
"""


MotionValueComponents = TypeAliasType(
    "MotionValueComponents",
    Annotated[list[Value], Field(max_length=4, min_length=2, title="MotionValueComponents")],
)
"""
The components of a position, or the parts of a quaternion.
"""


MotionValue = TypeAliasType("MotionValue", Value | MotionValueComponents | MasterInput)
"""
Course of a driven motion.
"""


class RectangleSurface(Part):
    """
    Rectangle or parallelogram, flat.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "rectangle"},
    )
    corner: Vector
    """
    Corner where `s1` and `s2` are 0, m.
    """
    edges: Annotated[list[Vector], Field(max_length=2, min_length=2)]
    """
    Edges along `s1` and `s2` from there, m.
    """


class QuadrilateralSurface(Part):
    """
    Four corners with straight edges; lines between opposite edges are straight.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "quadrilateral"},
    )
    corners: Annotated[list[Vector], Field(max_length=4, min_length=4)]
    """
    Corners one after the other, m: at `[0, 0]`, `[1, 0]`, `[1, 1]` and `[0, 1]`.
    """


class AnnulusSurface(Part):
    """
    Sector of a ring, flat: `s1` outwards, `s2` around.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "annulus"},
    )
    center: Vector
    """
    Centre, m.
    """
    normal: Vector
    """
    Normal, of any length.
    """
    start: Vector
    """
    Direction of the edge `s2 = 0` from the centre, of any length; its part along the normal does not count.
    """
    radii: Annotated[list[StrictFloat], Field(max_length=2, min_length=2)]
    """
    Inner and outer radius, m.
    """
    angle: StrictFloat
    """
    Angle of the sector, counter-clockwise about the normal, rad.
    """


class CylinderSectorSurface(Part):
    """
    Sector of a cylinder: `s1` around, `s2` along the axis. The normal points away from the axis.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "cylinder"},
    )
    from_: Vector
    """
    Where its axis begins, m.
    """
    to: Vector
    """
    Where its axis ends, m.
    """
    radius: StrictFloat
    """
    Radius, m.
    """
    start: Vector
    """
    Direction of the edge `s1 = 0` from the axis, of any length; its part along the axis does not count.
    """
    angle: StrictFloat
    """
    Angle of the sector, counter-clockwise about the axis, rad.
    """


class ConeSectorSurface(Part):
    """
    Sector of a cone: `s1` around, `s2` along the axis. The normal points away from the axis.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "cone"},
    )
    from_: Vector
    """
    Where its axis begins, m.
    """
    to: Vector
    """
    Where its axis ends, m.
    """
    radii: Annotated[list[StrictFloat], Field(max_length=2, min_length=2)]
    """
    Radii at both ends of the axis, m.
    """
    start: Vector
    """
    Direction of the edge `s1 = 0` from the axis, of any length; its part along the axis does not count.
    """
    angle: StrictFloat
    """
    Angle of the sector, counter-clockwise about the axis, rad.
    """


class SphereSectorSurface(Part):
    """
    Sector of a sphere between two latitudes: `s1` around the axis, `s2` from the first latitude to the second. The normal points outwards.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "sphere"},
    )
    center: Vector
    """
    Centre, m.
    """
    radius: StrictFloat
    """
    Radius, m.
    """
    axis: Vector
    """
    Axis from the centre to the upper pole, of any length.
    """
    start: Vector
    """
    Direction of the edge `s1 = 0`, of any length; its part along the axis does not count.
    """
    latitudes: Annotated[list[StrictFloat], Field(max_length=2, min_length=2)]
    """
    Latitudes from the equator, the second above the first, rad. Poles collapse an edge and are refused.
    """
    angle: StrictFloat
    """
    Angle of the sector, counter-clockwise about the axis, rad.
    """


class RuledSurface(Part):
    """
    Straight lines between two smooth curves: `s1` along the curves, `s2` from the first to the second.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "ruled"},
    )
    curves: Annotated[list[list[Vector]], Field(max_length=2, min_length=2)]
    """
    Points of both curves, m, at least two each: splines go through them, at even steps of `s1`.
    """


class PointsSurface(Part):
    """
    Smooth surface through a grid of points.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "points"},
    )
    grid: list[list[Vector]]
    """
    Points, m: a list for each of the even steps of `s1`, in each a point for each of those of `s2`; at least two of both.
    """


PatchSurface = TypeAliasType(
    "PatchSurface",
    Annotated[
        RectangleSurface
        | QuadrilateralSurface
        | AnnulusSurface
        | CylinderSectorSurface
        | ConeSectorSurface
        | SphereSectorSurface
        | RuledSurface
        | PointsSurface,
        under_one_of("rectangle", "quadrilateral", "annulus", "cylinder", "cone", "sphere", "ruled", "points"),
    ],
)
"""
Middle surface of a plate or shell. Its normal is that of the lines along `s1` and `s2`, in this order. Plates take those that are flat.
"""


class Line(Part):
    """
    Straight line.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "line"},
    )
    from_: Vector
    """
    First end, m.
    """
    to: Vector
    """
    Last end, m.
    """


class Arc(Part):
    """
    Circular arc that bulges to the right of the way from `from` to `to`: drawn from left to
    right it sags. In space it sags towards -z in the upright plane through both ends, and the cable has no
    bending stiffness.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "arc"},
    )
    from_: Vector
    """
    First end, m.
    """
    to: Vector
    """
    Last end, m.
    """
    length: StrictFloat
    """
    Length along the arc, m; more than the distance between the ends.
    """


class Helix(Part):
    """
    Circular helix in space: of rods, and of cables without bending stiffness.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "helix"},
    )
    from_: Vector
    """
    Where its axis begins, m.
    """
    to: Vector
    """
    Where its axis ends, m.
    """
    radius: Annotated[StrictFloat, Field(gt=0.0)]
    """
    Distance of the line from the axis, m.
    """
    turns: StrictFloat
    """
    Number of turns; positive of a right-handed helix, negative of a left-handed one.
    """
    start: Vector
    """
    Direction from the axis to the first end, of any length; what of it is along the axis does not count.
    """


Shape = TypeAliasType("Shape", Annotated[Line | Arc | Helix, under_one_of("line", "arc", "helix")])
"""
Unstressed shape of a cable.
"""


class PlaneSurface(Part):
    """
    Plane, in the plane a straight line; the ground is below.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "plane"},
    )
    point: Vector
    """
    A point of it, m.
    """
    normal: Vector
    """
    Direction away from the ground, of any length but zero.
    """


class CircleSurface(Part):
    """
    Circle, in the plane.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "circle"},
    )
    center: Vector
    """
    Centre, m.
    """
    radius: StrictFloat
    """
    Radius, m.
    """


class SphereSurface(Part):
    """
    Sphere, in space.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "sphere"},
    )
    center: Vector
    """
    Centre, m.
    """
    radius: StrictFloat
    """
    Radius, m.
    """


class CylinderSurface(Part):
    """
    Cylinder without end, in space.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-key": "cylinder"},
    )
    point: Vector
    """
    A point of its axis, m.
    """
    axis: Vector
    """
    Direction of its axis, of any length but zero.
    """
    radius: StrictFloat
    """
    Radius, m.
    """


Surface = TypeAliasType(
    "Surface",
    Annotated[
        PlaneSurface | CircleSurface | SphereSurface | CylinderSurface,
        under_one_of("plane", "circle", "sphere", "cylinder"),
    ],
)
"""
Surface of the ground that is touched from outside; it stands still.
"""


class Accuracy(Part):
    """
    Accuracy that is requested: an error, from which meshes and the tolerance follow while packaging, or a tolerance.
    """

    error: StrictFloat | None = None
    """
    Error wanted of every output over the default experiment, relative to its own largest change: of positions, angles and directions
    from where the scene draws them, of all else from zero. What hardly changes is held to a thousandth of like outputs of its body.
    By default 1e-3 where numbers of elements are left to the planner. Where nothing is left to it, what warnings and the output
    `resolution` are measured by: ten times the tolerance where nothing is said.
    """
    input_profiles: Annotated[list[InputCourse], Field(validate_default=True)] = []
    """
    Profiles of inputs in the experiment that is planned for; inputs that are not named keep their start values.
    """
    notes: list[StrictStr] = []
    """
    Notes of the planner on errors that it could not keep and on inputs that it held: written by it, told by units when they are instantiated.
    """
    of: list[StrictStr] = []
    """
    Names of the outputs that count, without indices; by default all but energies, work and residuals.
    """
    relative_tolerance: StrictFloat | None = None
    """
    Error in time that a step may make, relative to the length of the body (root mean square
    over its mass). By default 1e-4; 1e-7 in a scene without cables, which then keeps its energy to
    0.1 % over a thousand swings or turns. Beside `error`, from which it follows, only where numbers of elements are
    given.
    """


class Cable(Part):
    """
    Flexible, of ANCF cables: two nodes with position and slope; stretches and bends, does not
    shear. Where `model` says so, a rigid rod.
    """

    element: Literal["cable"] = "cable"
    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    material: Material
    """
    Material.
    """
    shape: Shape
    """
    Unstressed shape, and the configuration at the start.
    """
    axial: Axial = "waves"
    """
    Treatment of axial vibrations.
    """
    axis: Vector | None = None
    """
    First axis of the section at the first end of rods and beams in space, of any length; its part along the tangent does not count. From
    there sections are untwisted, but for what `stations` say. Where nothing is said it is level, and the second axis (`height` of a
    rectangle) stands as upright as the line lets it: against the scene's gravity, or along `z` without gravity. Of an upright line it is
    then along `y`, or along `z` where that is the line.
    """
    elements: Elements = "auto"
    """
    Number of elements; `"auto"`, or nothing said, is as many as the accuracy asks for, found while packaging.
    """
    markers: dict[str, StrictFloat] = {}
    """
    Named material coordinates: 0 is the first end, 1 the last.
    """
    model: Model = "auto"
    """
    Whether it bends and stretches.
    """
    modes: Annotated[StrictInt | None, Field(ge=0)] = None
    """
    Natural modes of model `modal` with held interfaces, beside the static shapes of the markers that joints, motions, loads and ports act
    on; 0 takes the static shapes alone.
    """
    motion: Annotated[InitialMotion, Field(validate_default=True)] = {"spin": 0.0}
    """
    Rigid motion at the start; velocity of the first end.
    """
    section: Section | None = None
    """
    Cross section, where it is the same all along.
    """
    stations: Annotated[list[Station], Field(validate_default=True)] = []
    """
    Cross sections that change along the body, from its first end to its last; instead of `section`.
    """
    strain: Strain = "thetaPrime"
    """
    Strain measure.
    """


class Rod(Part):
    """
    Flexible line of which the sections rotate about the tangent: bends about two axes with their own stiffness, and twists; does not
    shear. In space.
    """

    element: Literal["rod"] = "rod"
    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    material: Material
    """
    Material.
    """
    shape: Shape
    """
    Unstressed shape, and the configuration at the start.
    """
    axial: Axial = "waves"
    """
    Treatment of axial vibrations.
    """
    axis: Vector | None = None
    """
    First axis of the section at the first end of rods and beams in space, of any length; its part along the tangent does not count. From
    there sections are untwisted, but for what `stations` say. Where nothing is said it is level, and the second axis (`height` of a
    rectangle) stands as upright as the line lets it: against the scene's gravity, or along `z` without gravity. Of an upright line it is
    then along `y`, or along `z` where that is the line.
    """
    elements: Elements = "auto"
    """
    Number of elements; `"auto"`, or nothing said, is as many as the accuracy asks for, found while packaging.
    """
    markers: dict[str, StrictFloat] = {}
    """
    Named material coordinates: 0 is the first end, 1 the last.
    """
    model: Model = "auto"
    """
    Whether it bends and stretches.
    """
    modes: Annotated[StrictInt | None, Field(ge=0)] = None
    """
    Natural modes of model `modal` with held interfaces, beside the static shapes of the markers that joints, motions, loads and ports act
    on; 0 takes the static shapes alone.
    """
    motion: Annotated[InitialMotion, Field(validate_default=True)] = {"spin": 0.0}
    """
    Rigid motion at the start; velocity of the first end.
    """
    section: Section | None = None
    """
    Cross section, where it is the same all along.
    """
    stations: Annotated[list[Station], Field(validate_default=True)] = []
    """
    Cross sections that change along the body, from its first end to its last; instead of `section`.
    """
    strain: Strain = "thetaPrime"
    """
    Strain measure.
    """


class Beam(Part):
    """
    Flexible line of which the sections rotate freely: shears too, with the rotary inertia of its sections.
    """

    element: Literal["beam"] = "beam"
    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    material: Material
    """
    Material.
    """
    shape: Shape
    """
    Unstressed shape, and the configuration at the start.
    """
    axial: Axial = "waves"
    """
    Treatment of axial vibrations.
    """
    axis: Vector | None = None
    """
    First axis of the section at the first end of rods and beams in space, of any length; its part along the tangent does not count. From
    there sections are untwisted, but for what `stations` say. Where nothing is said it is level, and the second axis (`height` of a
    rectangle) stands as upright as the line lets it: against the scene's gravity, or along `z` without gravity. Of an upright line it is
    then along `y`, or along `z` where that is the line.
    """
    elements: Elements = "auto"
    """
    Number of elements; `"auto"`, or nothing said, is as many as the accuracy asks for, found while packaging.
    """
    markers: dict[str, StrictFloat] = {}
    """
    Named material coordinates: 0 is the first end, 1 the last.
    """
    model: Model = "auto"
    """
    Whether it bends and stretches.
    """
    modes: Annotated[StrictInt | None, Field(ge=0)] = None
    """
    Natural modes of model `modal` with held interfaces, beside the static shapes of the markers that joints, motions, loads and ports act
    on; 0 takes the static shapes alone.
    """
    motion: Annotated[InitialMotion, Field(validate_default=True)] = {"spin": 0.0}
    """
    Rigid motion at the start; velocity of the first end.
    """
    section: Section | None = None
    """
    Cross section, where it is the same all along.
    """
    stations: Annotated[list[Station], Field(validate_default=True)] = []
    """
    Cross sections that change along the body, from its first end to its last; instead of `section`.
    """
    strain: Strain = "thetaPrime"
    """
    Strain measure.
    """


class AutoBody(Part):
    """
    A cable, a rod or a beam, as needed: a cable where nothing asks for its sections; else in space a rod; a beam
    where shear moves an output by more than the error wanted, or whole matrices are given. Takes the keys of all three; those
    that the element chosen has no use for are not used. Found while packaging; the page of the unit says why.
    """

    element: Literal["auto"] = "auto"
    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    material: Material
    """
    Material.
    """
    shape: Shape
    """
    Unstressed shape, and the configuration at the start.
    """
    axial: Axial = "waves"
    """
    Treatment of axial vibrations.
    """
    axis: Vector | None = None
    """
    First axis of the section at the first end of rods and beams in space, of any length; its part along the tangent does not count. From
    there sections are untwisted, but for what `stations` say. Where nothing is said it is level, and the second axis (`height` of a
    rectangle) stands as upright as the line lets it: against the scene's gravity, or along `z` without gravity. Of an upright line it is
    then along `y`, or along `z` where that is the line.
    """
    elements: Elements = "auto"
    """
    Number of elements; `"auto"`, or nothing said, is as many as the accuracy asks for, found while packaging.
    """
    markers: dict[str, StrictFloat] = {}
    """
    Named material coordinates: 0 is the first end, 1 the last.
    """
    model: Model = "auto"
    """
    Whether it bends and stretches.
    """
    modes: Annotated[StrictInt | None, Field(ge=0)] = None
    """
    Natural modes of model `modal` with held interfaces, beside the static shapes of the markers that joints, motions, loads and ports act
    on; 0 takes the static shapes alone.
    """
    motion: Annotated[InitialMotion, Field(validate_default=True)] = {"spin": 0.0}
    """
    Rigid motion at the start; velocity of the first end.
    """
    section: Section | None = None
    """
    Cross section, where it is the same all along.
    """
    stations: Annotated[list[Station], Field(validate_default=True)] = []
    """
    Cross sections that change along the body, from its first end to its last; instead of `section`.
    """
    strain: Strain = "thetaPrime"
    """
    Strain measure.
    """


class RigidBody(Part):
    """
    Rigid.
    """

    element: Literal["rigid"] = "rigid"
    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    position: Vector
    """
    Centre of mass at the start, m.
    """
    angle: StrictFloat = 0.0
    """
    Direction of the body's frame at the start, counter-clockwise, rad.
    """
    density: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Density of that shape, kg/m^3, instead of `mass` and `inertia`.
    """
    inertia: Inertia | None = None
    """
    Inertia about the centre of mass, kg m^2: a number in the plane; in space the moments about the axes of the body's
    frame, or the whole tensor. Zero (and where nothing is said) is a particle, which does not rotate.
    """
    markers: dict[str, Vector] = {}
    """
    Named points in the body's frame, whose origin is the centre of mass, m.
    """
    mass: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Mass, kg; or `shape` and `density`.
    """
    motion: Annotated[InitialMotion, Field(validate_default=True)] = {"spin": 0.0}
    """
    Motion at the start; velocity of the centre of mass.
    """
    orientation: Orientation | None = None
    """
    In space: how the body's frame stands at the start; along the global axes where nothing is said.
    """
    shape: Solid | None = None
    """
    Shape. With `density` it gives mass and inertia. Beside `mass` and `inertia` it is drawn only.
    """


class ReducedBody(Part):
    """
    Finite element model reduced to modes, from a file. It moves freely, with small deformations.
    """

    element: Literal["reduced"] = "reduced"
    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    file: StrictStr
    """
    File of the reduced model, beside the scene: letters, digits, `_`, `-` and `.`, folders before `/`; its name ends in `.safetensors`.
    """
    position: Vector
    """
    Place of the origin of the file's axes at the start, m.
    """
    critically_damped: StrictBool | None = None
    """
    Whether modes that static shapes add far above the others (more than five times their highest frequency) are critically damped, with
    `"fixed_interface"` or `"auto"`: they answer and do not ring.
    """
    damping_ratio: DampingRatio = 0.0
    """
    Damping ratio of the modes of the free body: a number, or pairs of a frequency (Hz) and the ratio there, linear between them and
    constant outside.
    """
    gauges: dict[str, StrictStr] | None = None
    """
    Named points whose stress outputs read: names of stresses in the file.
    """
    markers: dict[str, StrictStr] = {}
    """
    Named interfaces of the file.
    """
    modes: Annotated[Modes, Field(validate_default=True)] = "all"
    """
    Modes that are taken, in the order of their frequencies; with 0 the body is rigid.
    """
    motion: Annotated[InitialMotion, Field(validate_default=True)] = {"spin": 0.0}
    """
    Motion at the start; velocity of the origin of the file's axes.
    """
    orientation: Orientation | None = None
    """
    How the file's axes stand at the start; along the global axes where nothing is said. In the plane a rotation about the third axis.
    """
    sha256: StrictStr | None = None
    """
    SHA-256 of the file, hexadecimal in lower case. A file with another one is refused. Written out when a scene is read.
    """


class Plate(Part):
    """
    Thin plate, flat without stress: stretches and bends. In space.
    """

    element: Literal["plate"] = "plate"
    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    surface: PatchSurface
    """
    Middle surface without stress, also the configuration at the start. Coordinates `s1` and `s2` run over it from 0 to 1.
    """
    area_density: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Mass per area, kg/m^2, with `stiffness`.
    """
    axis_angle: StrictFloat = 0.0
    """
    Angle of the first axis of `laminate` or `stiffness` from the lines along `s1`, counter-clockwise about the normal, rad.
    """
    damping_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Kelvin-Voigt damping of `laminate` or `stiffness`: ratio of viscosity to stiffness, s.
    """
    laminate: Annotated[list[LaminatePly], Field(validate_default=True)] = []
    """
    Plies from the bottom to the top, along the normal of the surface; instead of `material` and `thickness`.
    """
    markers: Annotated[dict[str, PatchMarker], Field(validate_default=True)] = {}
    """
    Named points: `[s1, s2]`, or one with a pad.
    """
    material: PatchMaterial | None = None
    """
    Isotropic material, with `thickness`.
    """
    mesh: Mesh = "auto"
    """
    Numbers of elements along `s1` and `s2`, each from 1 to 200; `"auto"` for one of them or for both, or nothing said, is as many as the
    accuracy asks for, found while packaging. Edges that are joined have one number of elements.
    """
    motion: Annotated[InitialMotion, Field(validate_default=True)] = {"spin": 0.0}
    """
    Rigid motion at the start; velocity of the corner at `s1 = 0`, `s2 = 0`.
    """
    stiffness: PatchStiffness | None = None
    """
    Stiffness of a section as matrices; instead of `material` and `thickness`.
    """
    thickness: PatchThickness | None = None
    """
    Thickness, m, with `material`: a number, or an expression in the coordinates `s1` and `s2` of the surface, each from 0 to 1.
    """


class Shell(Part):
    """
    Thin shell, flat or curved without stress: stretches and bends. In space.
    """

    element: Literal["shell"] = "shell"
    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    surface: PatchSurface
    """
    Middle surface without stress, also the configuration at the start. Coordinates `s1` and `s2` run over it from 0 to 1.
    """
    area_density: Annotated[StrictFloat | None, Field(gt=0.0)] = None
    """
    Mass per area, kg/m^2, with `stiffness`.
    """
    axis_angle: StrictFloat = 0.0
    """
    Angle of the first axis of `laminate` or `stiffness` from the lines along `s1`, counter-clockwise about the normal, rad.
    """
    damping_time: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Kelvin-Voigt damping of `laminate` or `stiffness`: ratio of viscosity to stiffness, s.
    """
    laminate: Annotated[list[LaminatePly], Field(validate_default=True)] = []
    """
    Plies from the bottom to the top, along the normal of the surface; instead of `material` and `thickness`.
    """
    markers: Annotated[dict[str, PatchMarker], Field(validate_default=True)] = {}
    """
    Named points: `[s1, s2]`, or one with a pad.
    """
    material: PatchMaterial | None = None
    """
    Isotropic material, with `thickness`.
    """
    mesh: Mesh = "auto"
    """
    Numbers of elements along `s1` and `s2`, each from 1 to 200; `"auto"` for one of them or for both, or nothing said, is as many as the
    accuracy asks for, found while packaging. Edges that are joined have one number of elements.
    """
    motion: Annotated[InitialMotion, Field(validate_default=True)] = {"spin": 0.0}
    """
    Rigid motion at the start; velocity of the corner at `s1 = 0`, `s2 = 0`.
    """
    stiffness: PatchStiffness | None = None
    """
    Stiffness of a section as matrices; instead of `material` and `thickness`.
    """
    thickness: PatchThickness | None = None
    """
    Thickness, m, with `material`: a number, or an expression in the coordinates `s1` and `s2` of the surface, each from 0 to 1.
    """


Body = TypeAliasType(
    "Body",
    Annotated[
        Cable | Rod | Beam | AutoBody | RigidBody | ReducedBody | Plate | Shell,
        Field(discriminator="element"),
    ],
)
"""
A body; `element` says of which kind.
"""


class ForceLoad(Part):
    """
    Force at a marker, N.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["force"] = "force"
    marker: StrictStr
    """
    Marker that the force acts at, `body.marker`.
    """
    value: LoadValue
    """
    Components of the force, N: two in the plane, three in space.
    """
    follower: StrictBool | None = None
    """
    Whether the components rotate with the marker. They are then along and to the left of its direction in the plane, and along the
    axes of the body's frame in space.
    """


class MomentLoad(Part):
    """
    Moment at a marker, counter-clockwise in the plane, N m. In space it keeps its global axes where it does not follow. A moment in
    space is not conservative: its work depends on the path of the rotation.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["moment"] = "moment"
    marker: StrictStr
    """
    Marker that the moment acts at, `body.marker`.
    """
    value: LoadValue
    """
    Moment, N m: one value in the plane, three components in space.
    """
    follower: StrictBool | None = None
    """
    Whether the components rotate with the marker, along the axes of the body's frame; in space only.
    """


class TorqueLoad(Part):
    """
    Moment on the second marker of a joint about its axis, opposite on its first, N m.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["torque"] = "torque"
    joint: StrictStr
    """
    Name of the joint with an axis that the torque acts about.
    """
    value: LoadValue
    """
    Torque on the second marker, N m: one value.
    """


class DistributedForceLoad(Part):
    """
    Force in global axes per reference length of a cable, rod or beam, N/m.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["distributed_force"] = "distributed_force"
    body: StrictStr
    """
    Name of the cable, rod or beam that the force acts along.
    """
    value: LoadValue
    """
    Components of the force per reference length, N/m: two in the plane, three in space. Expressions may contain the material
    coordinate `s` of the body, which is 0 at the first end and 1 at the last.
    """


class DistributedMomentLoad(Part):
    """
    Moment per reference length of a rod or beam, N m/m: its power is that with the angular velocities of the sections. It keeps its
    global axes where it does not follow. In space it is not conservative: its work depends on the path of the rotations.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["distributed_moment"] = "distributed_moment"
    body: StrictStr
    """
    Name of the rod or beam that the moment acts along.
    """
    value: LoadValue
    """
    Moment per reference length, N m/m: one value in the plane, three components in space. Expressions may contain the material
    coordinate `s` of the body, which is 0 at the first end and 1 at the last.
    """
    follower: StrictBool | None = None
    """
    Whether the components rotate with the sections, along their axes; in space only.
    """


class PressureLoad(Part):
    """
    Pressure along the normal of a plate or shell, which follows it, by its present area, Pa.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["pressure"] = "pressure"
    body: StrictStr
    """
    Name of the plate or shell that the pressure acts on.
    """
    value: LoadValue
    """
    Pressure along the normal, Pa: one value. Expressions may contain the coordinates `s1` and `s2` of the body, each from 0 to 1.
    """


class AreaForceLoad(Part):
    """
    Force in global axes per area of a plate or shell without stress, N/m^2.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["area_force"] = "area_force"
    body: StrictStr
    """
    Name of the plate or shell that the force acts on.
    """
    value: LoadValue
    """
    Components of the force per area, N/m^2. Expressions may contain the coordinates `s1` and `s2` of the body, each from 0 to 1.
    """


class ContactLoad(Part):
    """
    Contact of a marker, or of the line of a cable, rod or beam, with a surface of the ground: a one-sided spring and damper along the
    normal (Hunt and Crossley 1975) and friction along the surface, which is none at rest, so that an equilibrium has none.
    """

    model_config = ConfigDict(
        json_schema_extra={"x-either": [{"must": ["marker"], "may": []}, {"must": ["body"], "may": []}]},
    )
    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["contact"] = "contact"
    stiffness: Annotated[StrictFloat, Field(ge=0.0)]
    """
    Stiffness `k` of the surface, N/m at a marker; N/m per reference length along a line, per reference area of a plate or shell.
    """
    surface: Surface
    """
    Surface that is touched, in the frame of the body that it belongs to.
    """
    damping: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Damping `a` in the normal force `k d (1 + a d')` at the depth `d` below the surface, s/m; 0 by default.
    """
    friction: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Coulomb's coefficient of friction `mu`; 0 by default.
    """
    marker: StrictStr | None = None
    """
    Marker that touches the surface, `body.marker`.
    """
    radius: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    Distance at which it touches, m: radius of a ball or wheel about the marker, half the thickness of a body; 0 by default. With a
    radius, friction rotates the rigid body of a marker. Bodies along a line take friction on their line.
    """
    slip_velocity: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    With friction only: `w` in the friction `mu N v / sqrt(v^2 + w^2)` at the velocity `v` along the surface, m/s. A contact that
    would stick creeps at a fraction of it, unless `tangential_stiffness` is given.
    """
    static_ratio: Annotated[StrictFloat | None, Field(ge=1.0)] = None
    """
    With `tangential_stiffness` only: largest friction while the marker sticks, in parts of `mu N`; 1 by default.
    """
    surface_of: StrictStr | None = None
    """
    Name of the rigid body with inertia that the surface belongs to, such as a pulley, in whose frame the surface is given. By default
    it belongs to the ground.
    """
    tangential_damping: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    With `tangential_stiffness` only: damping along the surface while the marker sticks, N s/m; 0 by default.
    """
    tangential_stiffness: Annotated[StrictFloat | None, Field(ge=0.0)] = None
    """
    With friction only, at a marker: stiffness along the surface while the marker sticks, N/m. It sticks where its speed falls to
    `slip_velocity`, and rests without creep. It slides where the force of this stiffness exceeds the largest friction. By default
    nothing sticks.
    """
    body: StrictStr | None = None
    """
    Name of the cable, rod or beam whose line, or of the plate or shell whose middle surface touches the surface.
    """


Load = TypeAliasType(
    "Load",
    Annotated[
        ForceLoad
        | MomentLoad
        | TorqueLoad
        | DistributedForceLoad
        | DistributedMomentLoad
        | PressureLoad
        | AreaForceLoad
        | SpringDamperLoad
        | TableSpringLoad
        | ReevingLoad
        | ForceLawLoad
        | JointSpringLoad
        | BushingLoad
        | JointLimitLoad
        | JointFrictionLoad
        | FluidLoad
        | AirfoilLoad
        | ContactLoad,
        Field(discriminator="kind"),
    ],
)
"""
A load as written in the scene, with its name.
"""


class Loaded(Part):
    """
    A state and loads that act only while it is looked for: what is bent or plucked by them is let go at the start.
    """

    state: InitialState
    """
    The state.
    """
    loads: Annotated[list[Load], Field(validate_default=True)] = []
    """
    Loads that act only while it is looked for, beside all others; no springs.
    """


class AngleMotion(Part):
    """
    Direction of a marker, or direction of the second marker of a joint less that of its first,
    rad.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "x-either": [
                {"must": ["joint"], "may": []},
                {"must": ["marker"], "may": []},
            ]
        },
    )
    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["angle"] = "angle"
    value: MotionValue
    """
    Course of the angle in time, rad.
    """
    joint: StrictStr | None = None
    """
    Name of the joint with an axis whose angle is driven.
    """
    marker: StrictStr | None = None
    """
    Marker whose direction is driven in the plane, `body.marker`.
    """


class PositionMotion(Part):
    """
    Position of a marker, m.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["position"] = "position"
    marker: StrictStr
    """
    Marker whose position is driven, `body.marker`.
    """
    value: MotionValue
    """
    Course of the position in time, m: two components in the plane, three in space.
    """


class OrientationMotion(Part):
    """
    In space how a rigid body stands: the quaternion, scalar first, of the frame of a marker's body in global axes, of any
    length and either sign. As an input with rates: the angular velocity and the angular acceleration, in global axes.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["orientation"] = "orientation"
    marker: StrictStr
    """
    Marker of the rigid body whose orientation is driven, `body.marker`.
    """
    value: MotionValue
    """
    Course of the quaternion in time: its four parts, scalar first.
    """


class DisplacementMotion(Part):
    """
    Displacement along the line of a point on a line, a prismatic, a cylindrical joint or a screw from its first marker or its point, m; not where
    that line belongs to a cable.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["displacement"] = "displacement"
    joint: StrictStr
    """
    Name of the joint whose displacement is driven.
    """
    value: MotionValue
    """
    Course of the displacement in time, m.
    """


class DistanceMotion(Part):
    """
    Distance between two markers, or of a marker from a point of the ground, m: a hydraulic cylinder, a screw jack.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["distance"] = "distance"
    markers: Annotated[list[StrictStr], Field(max_length=2, min_length=2)]
    """
    Markers whose distance is driven: `ground` or `body.marker`, then `body.marker`.
    """
    value: MotionValue
    """
    Course of the distance in time, m: above 0.
    """
    point: Vector | None = None
    """
    With `ground` only: end on the ground, m; by default the position of the second marker at the start.
    """


class WinchMotion(Part):
    """
    Length that a winch at a marker, an end of a cable, has paid out since the start, m; negative where it has taken in. The mass of the
    cable changes with it. What is on the winch has no part in the scene; what acts between its ends acts all along it: `distributed_force`
    (where `s` is the share of the length now), `contact`, `fluid` without added mass.
    """

    name: StrictStr
    """
    Name: a letter or `_`, then letters, digits and `_`; at most 100.
    """
    kind: Literal["winch"] = "winch"
    marker: StrictStr
    """
    Marker at the end of the cable where the winch is, `body.marker`.
    """
    value: MotionValue
    """
    Course of the length paid out in time, m; 0 at the start.
    """


Motion = TypeAliasType(
    "Motion",
    Annotated[
        AngleMotion | PositionMotion | OrientationMotion | DisplacementMotion | DistanceMotion | WinchMotion,
        Field(discriminator="kind"),
    ],
)
"""
A driven motion.
"""


Initial = TypeAliasType("Initial", InitialState | Loaded)
"""
Where the simulation starts from: a state by its name, or a state and loads that act only while it is looked
for. Joints that bodies as described do not fit are closed: bodies are moved as a whole, and where that is not
enough, cables start deformed, with the least strain energy. From there bodies start with their `motion`.
"""


class Scene(Part):
    """
    A scene: bodies, joints, what drives and loads them, what goes in and what comes out.
    """

    name: StrictStr
    """
    Name of the scene and of the FMU: letters, digits, `_` and `-`; at most 100.
    """
    dimension: Annotated[StrictInt, Field(ge=2, le=3)]
    """
    Dimension: 2 in the plane, 3 in space. Cables in space stretch and bend, isotropically, and know no torsion.
    """
    bodies: list[Body]
    """
    Bodies; at least one.
    """
    about: About | None = None
    """
    Whose model it is.
    """
    accuracy: Annotated[Accuracy, Field(validate_default=True)] = {"relative_tolerance": None}
    """
    Accuracy that is requested.
    """
    experiment: Annotated[Experiment, Field(validate_default=True)] = {
        "step": 0.01,
        "stop_time": 1.0,
    }
    """
    Default experiment of the FMU.
    """
    gears: Annotated[list[Gear], Field(validate_default=True)] = []
    """
    Gears between joints.
    """
    gravity: Vector | None = None
    """
    Gravitational acceleration, m/s^2; zero by default.
    """
    initial: Annotated[Initial, Field(validate_default=True)] = "undeformed"
    """
    Where the simulation starts from.
    """
    inputs: Annotated[list[Input], Field(validate_default=True)] = []
    """
    Loads that the master sets.
    """
    joints: Annotated[list[Joint], Field(validate_default=True)] = []
    """
    Joints to ground and between bodies.
    """
    latches: Annotated[list[Latch], Field(validate_default=True)] = []
    """
    Latches on joints.
    """
    loads: Annotated[list[Load], Field(validate_default=True)] = []
    """
    Loads that the scene itself knows.
    """
    masses: Annotated[list[Mass], Field(validate_default=True)] = []
    """
    Masses lumped at markers.
    """
    method: Annotated[Method, Field(validate_default=True)] = {
        "integrator": "auto",
        "work_limit": 1000000000.0,
    }
    """
    Integrator, where the automatic choice is not wanted.
    """
    motions: Annotated[list[Motion], Field(validate_default=True)] = []
    """
    Driven positions, angles and displacements.
    """
    outputs: Annotated[list[Output], Field(validate_default=True)] = []
    """
    Quantities that the master reads.
    """
    ports: Annotated[list[Port], Field(validate_default=True)] = []
    """
    Markers that the master couples to other units.
    """
    rotation: Spin = 0.0
    """
    Angular velocity of the frame that the scene is described in, about its origin, rad/s: a number in the plane,
    counter-clockwise, three components in space. Gravity and the ground rotate with the frame.
    """
