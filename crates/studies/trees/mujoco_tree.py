"""MuJoCo: joint angles, accelerations from the factored inertia matrix. Nothing acts but gravity."""

import time

import mujoco
import mujoco.rollout
import numpy as np

# What becomes unstable is told by its states, not in a file.
mujoco.set_mju_user_warning(lambda message: None)

INTEGRATORS = {"rk4": "RK4", "implicitfast": "implicitfast"}


def model_of(tree, integrator, step):
    """The model: no contacts, no constraints, no armature, no damping."""
    numbers = lambda values: " ".join(repr(float(value)) for value in values)
    text = [
        f'<mujoco><option timestep="{step!r}" integrator="{integrator}" gravity="{numbers(tree.gravity)}">'
        '<flag contact="disable" constraint="disable" warmstart="disable" autoreset="disable" sensor="disable"/>'
        '</option><compiler autolimits="false" balanceinertia="false" boundmass="0" boundinertia="0"/><worldbody>'
    ]
    children = {}
    for place, link in enumerate(tree.links):
        children.setdefault(link.parent, []).append(place)
    pending = [("open", place) for place in children[-1]]
    while pending:
        what, place = pending.pop()
        if what == "close":
            text.append("</body>")
            continue
        link = tree.links[place]
        full = link.inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        text.append(
            f'<body name="{link.name}" pos="{numbers(link.joint - tree.base(link))}">'
            f'<inertial pos="{numbers(link.centre - link.joint)}" mass="{link.mass!r}" fullinertia="{numbers(full)}"/>'
            f'<joint type="hinge" axis="{numbers(link.axis)}" armature="0" damping="0"/>'
        )
        pending.append(("close", place))
        pending.extend(("open", child) for child in children.get(place, []))
    text.append("</worldbody></mujoco>")
    return mujoco.MjModel.from_xml_string("".join(text))


def run(tree, options):
    """Steps in one call of `rollout`, which loops in C; places are worked out afterwards from the states."""
    step, every = options["step"], options["every"]
    model = model_of(tree, INTEGRATORS[options["method"]], step)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    count = round(options["stop_time"] / step)
    kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
    first = np.empty(mujoco.mj_stateSize(model, kind))
    mujoco.mj_getState(model, data, first, kind)
    states = np.empty((1, count, first.size))
    begun = time.thread_time()
    mujoco.rollout.rollout(model, data, first[None], state=states, nstep=count)
    cpu = time.thread_time() - begun
    if not np.isfinite(states).all():
        return {"good": False, "failure": "unstable"}
    path, stride = [], round(every / step)
    offset = tree.point - tree.links[-1].joint
    for state in states[0, stride - 1 :: stride]:
        mujoco.mj_setState(model, data, state, kind)
        mujoco.mj_kinematics(model, data)
        path.append((data.xpos[-1] + data.xmat[-1].reshape(3, 3) @ offset).tolist())
    return {"cpu_time": cpu, "path": path, "good": True}


def accelerate(tree, angles, rates, calls):
    """CPU time of `mj_forward`, s, without that of a call from Python, and the acceleration."""
    model = model_of(tree, "RK4", 1e-3)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = angles, rates
    mujoco.mj_forward(model, data)
    empty, work = mujoco.mj_isSparse, mujoco.mj_forward
    begun = time.thread_time()
    for _ in range(calls):
        work(model, data)
    middle = time.thread_time()
    for _ in range(calls):
        empty(model)
    whole = middle - begun - (time.thread_time() - middle)
    return whole / calls, data.qacc.tolist()
