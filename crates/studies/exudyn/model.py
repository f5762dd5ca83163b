"""A scene of planar cables or of pinned rigid bodies in the product's format, as a system of Exudyn: the same data,
from the same file."""

import re

import exudyn as exu
import numpy as np
from exudyn.advancedUtilities import CreateSymbolicUserFunction
from exudyn.itemInterface import (
    CartesianSpringDamper,
    CoordinateConstraint,
    GenericJoint,
    LoadForceVector,
    LoadMassProportional,
    LoadTorqueVector,
    MarkerBodyMass,
    MarkerBodyPosition,
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    MarkerNodePosition,
    MarkerNodeRigid,
    NodePoint2DSlope1,
    NodePointGround,
    NodeRigidBody2D,
    ObjectANCFCable2D,
    ObjectGenericODE2,
    ObjectGround,
    ObjectJointRevolute2D,
    ObjectRigidBody2D,
    SensorMarker,
    SensorNode,
)

esym = exu.symbolic


class Model:
    """The system, and what a run needs to know about it."""

    def __init__(self, scene, options):
        self.container = exu.SystemContainer()
        self.mbs = self.container.AddSystem()
        self.scene, self.options = scene, options
        self.markers = {}
        # Markers of rigid bodies and where they are.
        self.points = {}
        # Functions of time must live as long as the system.
        self.kept = []
        ground = self.mbs.AddNode(NodePointGround(referenceCoordinates=[0, 0, 0]))
        self.fixed = self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
        for body in scene["bodies"]:
            if body["element"] == "rigid":
                self.rigid(body)
            elif options.get("rigid"):
                self.rigid(stiff(body, scene.get("masses", [])))
            else:
                self.cable(body)
        for mass in [] if options.get("rigid") else scene.get("masses", []):
            self.mass(mass)
        for joint in scene.get("joints", []):
            self.joint(joint)
        for motion in scene.get("motions", []):
            self.drive(motion)
        for load in scene.get("loads", []):
            self.load(load)
        kept = {"storeInternal": True, "outputVariableType": exu.OutputVariableType.Position}
        if options["marker"] in self.points:
            marker, _ = self.points[options["marker"]]
            sensor = SensorMarker(markerNumber=marker, **kept)
        else:
            sensor = SensorNode(nodeNumber=self.markers[options["marker"]], **kept)
        self.sensor = self.mbs.AddSensor(sensor)
        self.mbs.Assemble()

    def rigid(self, body):
        """A rigid body with its weight."""
        place, angle = np.array(body["position"]), body["angle"]
        motion = body.get("motion", {"velocity": [0.0, 0.0], "spin": 0.0})
        node = self.mbs.AddNode(
            NodeRigidBody2D(
                referenceCoordinates=[*place, angle],
                initialVelocities=[*motion["velocity"], motion["spin"]],
            )
        )
        number = self.mbs.AddObject(
            ObjectRigidBody2D(physicsMass=body["mass"], physicsInertia=body["inertia"], nodeNumber=node)
        )
        centre = self.mbs.AddMarker(MarkerNodePosition(nodeNumber=node))
        weight = [body["mass"] * component for component in self.scene["gravity"]]
        self.mbs.AddLoad(LoadForceVector(markerNumber=centre, loadVector=[*weight, 0.0]))
        axes = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        for name, point in body["markers"].items():
            marker = self.mbs.AddMarker(MarkerBodyPosition(bodyNumber=number, localPosition=[*point, 0.0]))
            self.points[f"{body['name']}.{name}"] = marker, place + axes @ point

    def pin(self, first, second):
        """A pin between rigid bodies, or to the ground where the second one is."""
        marker, place = self.points[second]
        if first == "ground":
            ground = self.mbs.AddObject(ObjectGround())
            other = self.mbs.AddMarker(MarkerBodyPosition(bodyNumber=ground, localPosition=[*place, 0.0]))
        else:
            other, _ = self.points[first]
        self.mbs.AddObject(ObjectJointRevolute2D(markerNumbers=[other, marker]))

    def slide(self, marker):
        """A slide of a point of a rigid body along the x axis."""
        number, place = self.points[marker]
        ground = self.mbs.AddObject(ObjectGround())
        base = self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=ground, localPosition=[*place, 0.0]))
        body = self.mbs.GetMarker(number)
        here = MarkerBodyRigid(bodyNumber=body["bodyNumber"], localPosition=body["localPosition"])
        here = self.mbs.AddMarker(here)
        self.mbs.AddObject(GenericJoint(markerNumbers=[base, here], constrainedAxes=[0, 1, 0, 0, 0, 0]))

    def cable(self, body):
        """Nodes, elements and weight of a cable."""
        material, section = body["material"], body["section"]
        count = self.options["elements"] * body.get("share", 1)
        modulus = self.options.get("youngs_modulus", material["youngs_modulus"])
        density = self.options.get("density", material["density"])
        weight = density * section["area"]
        if "line" in body["shape"]:
            length, states = straight(body, count)
        else:
            length, states = hanging(self.scene, body, count, modulus * section["area"], weight)
        nodes = []
        for place, velocity in states:
            node = NodePoint2DSlope1(referenceCoordinates=place, initialVelocities=velocity)
            nodes.append(self.mbs.AddNode(node))
        for left, right in zip(nodes, nodes[1:]):
            element = self.mbs.AddObject(
                ObjectANCFCable2D(
                    length=length / count,
                    massPerLength=weight,
                    bendingStiffness=modulus * section["second_moment"],
                    axialStiffness=modulus * section["area"],
                    useReducedOrderIntegration=self.options.get("integration", 0),
                    nodeNumbers=[left, right],
                )
            )
            self.weight(element, body["name"], weight)
        for name, where in body["markers"].items():
            index = where * count
            if abs(index - round(index)) < 1e-9:
                self.markers[f"{body['name']}.{name}"] = nodes[round(index)]

    def weight(self, element, body, mass):
        """Gravity and loads along the cable, mass being that of a length."""
        loads = [load for load in self.scene.get("loads", []) if load.get("body") == body]
        if not any(self.scene["gravity"]) and not loads:
            return
        marker = self.mbs.AddMarker(MarkerBodyMass(bodyNumber=element))
        gravity = [*self.scene["gravity"], 0.0]
        number = self.mbs.AddLoad(LoadMassProportional(markerNumber=marker, loadVector=gravity))
        if loads:
            parts = [function_of_time(value) for value in loads[0]["value"]]
            self.vary(number, lambda t: [gravity[i] + parts[i](t, esym) / mass for i in range(2)])

    def mass(self, mass):
        """A mass at a node, with its weight."""
        weight = [mass["mass"] * component for component in self.scene["gravity"]]
        self.weigh(self.markers[mass["marker"]], [0, 1], mass["mass"], [*weight, 0.0, 0.0])

    def weigh(self, node, axes, mass, force=(0.0, 0.0, 0.0, 0.0)):
        """Inertia on coordinates of a node: a mass point of its own would need multipliers."""
        matrix = np.diag([mass if axis in axes else 0.0 for axis in range(4)])
        self.mbs.AddObject(ObjectGenericODE2(nodeNumbers=[node], massMatrix=matrix, forceVector=list(force)))

    def coordinate(self, node, coordinate):
        return self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate))

    def joint(self, joint):
        """Pins and slides along an axis, on coordinates."""
        first, second = joint["markers"]
        if joint["kind"] == "revolute" and second in self.points:
            self.pin(first, second)
            return
        slides = joint["kind"] == "point_on_line" and joint["direction"] == [1.0, 0.0]
        if slides and first == "ground" and second in self.points:
            self.slide(second)
            return
        if joint["kind"] == "revolute":
            axes = [0, 1]
        elif slides:
            axes = [1]
        else:
            raise ValueError(f"joint {joint['name']}: expected a pin or a slide along x")
        if first == "ground" and self.options.get("heavy"):
            # The explicit solvers divide by the inertia without the joint; a heavy node is held by its inertia.
            self.weigh(self.markers[second], axes, self.options["heavy"])
            return
        if self.options.get("heavy"):
            # Between bodies: a spring that gives way by 10 nm per newton.
            ends = [self.mbs.AddMarker(MarkerNodePosition(nodeNumber=self.markers[end])) for end in (first, second)]
            self.mbs.AddObject(CartesianSpringDamper(markerNumbers=ends, stiffness=[1e8, 1e8, 0.0]))
            return
        for axis in axes:
            other = self.fixed if first == "ground" else self.coordinate(self.markers[first], axis)
            here = self.coordinate(self.markers[second], axis)
            self.mbs.AddObject(CoordinateConstraint(markerNumbers=[other, here]))

    def drive(self, motion):
        """A pin that turns as told."""
        joint = next(j for j in self.scene["joints"] if j["name"] == motion["joint"])
        node = self.markers[joint["markers"][1]]
        angle = function_of_time(motion["value"])
        ground = self.mbs.AddObject(ObjectGround())
        base = self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=ground))
        here = self.mbs.AddMarker(MarkerNodeRigid(nodeNumber=node))

        def offset(mbs, t, itemNumber, offsetUserFunctionParameters):
            zero = 0.0 * t
            return [zero, zero, zero, zero, zero, angle(t, esym)]

        joint = self.mbs.AddObject(GenericJoint(markerNumbers=[base, here], constrainedAxes=[0, 0, 0, 0, 0, 1]))
        function = CreateSymbolicUserFunction(self.mbs, offset, "offsetUserFunction", joint)
        self.mbs.SetObjectParameter(joint, "offsetUserFunction", function)
        self.kept.append(function)

    def load(self, load):
        """A force or moment at a node."""
        if load["kind"] == "distributed_force":
            return
        node = self.markers[load["marker"]]
        if load["kind"] == "force":
            marker = self.mbs.AddMarker(MarkerNodePosition(nodeNumber=node))
            number = self.mbs.AddLoad(LoadForceVector(markerNumber=marker))
            parts = [function_of_time(value) for value in load["value"]]
            self.vary(number, lambda t: [part(t, esym) for part in parts])
        elif load["kind"] == "moment":
            marker = self.mbs.AddMarker(MarkerNodeRigid(nodeNumber=node))
            number = self.mbs.AddLoad(LoadTorqueVector(markerNumber=marker))
            part = function_of_time(load["value"])
            self.vary(number, lambda t: [0.0 * t, 0.0 * t, part(t, esym)])
        else:
            raise ValueError(f"load {load['name']}: expected a force, a moment or a load along a cable")

    def vary(self, number, components):
        """Makes a load a function of time that needs no Python while it runs."""

        def function(mbs, t, loadVector):
            return (components(t) + [0.0 * t])[:3]

        function = CreateSymbolicUserFunction(self.mbs, function, "loadVectorUserFunction", number)
        self.mbs.SetLoadParameter(number, "loadVectorUserFunction", function)
        self.kept.append(function)


def straight(body, count):
    """Length, and coordinates and velocities of the nodes, of a straight cable in rigid motion."""
    start, end = (np.array(body["shape"]["line"][key]) for key in ("from", "to"))
    length = np.linalg.norm(end - start)
    slope = (end - start) / length
    motion = body.get("motion", {"velocity": [0.0, 0.0], "spin": 0.0})
    states = []
    for part in np.linspace(0.0, 1.0, count + 1):
        arm, spin = part * (end - start), motion["spin"]
        velocity = np.array(motion["velocity"]) + spin * np.array([-arm[1], arm[0]])
        turning = spin * np.array([-slope[1], slope[0]])
        states.append(([*(start + arm), *slope], [*velocity, *turning]))
    return length, states


def stiff(body, masses):
    """A straight cable with the masses at its markers as a rigid body."""
    start, end = (np.array(body["shape"]["line"][key]) for key in ("from", "to"))
    length = np.linalg.norm(end - start)
    axis = (end - start) / length
    own = body["material"]["density"] * body["section"]["area"] * length
    parts = [(own, 0.5 * length)]
    for mass in masses:
        name, marker = mass["marker"].split(".")
        if name == body["name"]:
            parts.append((mass["mass"], body["markers"][marker] * length))
    whole = sum(part for part, _ in parts)
    centre = sum(part * at for part, at in parts) / whole
    motion = body.get("motion", {"velocity": [0.0, 0.0], "spin": 0.0})
    velocity = np.array(motion["velocity"]) + motion["spin"] * centre * np.array([-axis[1], axis[0]])
    return {
        "name": body["name"],
        "mass": whole,
        "inertia": own * length**2 / 12 + sum(part * (at - centre) ** 2 for part, at in parts),
        "position": (start + centre * axis).tolist(),
        "angle": np.arctan2(axis[1], axis[0]),
        "motion": {"velocity": velocity.tolist(), "spin": motion["spin"]},
        "markers": {name: [where * length - centre, 0.0] for name, where in body["markers"].items()},
    }


def hanging(scene, body, count, stiffness, weight):
    """The same of a cable without bending stiffness that hangs between its ends under gravity and the
    loads along it at the start: the elastic catenary, Irvine 1981, in a frame where the load points down."""
    if scene.get("initial") != "static_equilibrium" or body["section"]["second_moment"] != 0.0:
        raise ValueError(f"body {body['name']}: expected a curved cable without bending stiffness, in equilibrium")
    arc = body["shape"]["arc"]
    loads = [load["value"] for load in scene.get("loads", []) if load.get("body") == body["name"]]
    pull = weight * np.array(scene["gravity"])
    pull = pull + sum(np.array([function_of_time(value)(0.0, None) for value in load]) for load in loads)
    force = np.linalg.norm(pull)
    down = pull / force
    axes = np.array([[-down[1], down[0]], -down])
    across, up = axes @ (np.array(arc["to"]) - np.array(arc["from"]))
    length = arc["length"]

    def shape(level, climb, s):
        """Place, slope at s: tension (level, climb + force s)."""
        rise = climb + force * s
        tension, first = np.hypot(level, rise), np.hypot(level, climb)
        x = level / stiffness * s + level / force * (np.arcsinh(rise / level) - np.arcsinh(climb / level))
        y = (rise**2 - climb**2) / (2 * force * stiffness) + (tension - first) / force
        stretch = 1.0 / stiffness + 1.0 / tension
        return np.array([x, y]), np.array([level, rise]) * stretch

    unknowns = np.array([0.5 * force * length, -0.5 * force * length])
    for _ in range(50):
        miss = shape(*unknowns, length)[0] - [across, up]
        steps = 1e-7 * force * length * np.eye(2)
        tangent = [(shape(*(unknowns + step), length)[0] - shape(*(unknowns - step), length)[0]) for step in steps]
        unknowns = unknowns - np.linalg.solve(np.array(tangent).T / (2e-7 * force * length), miss)
    states = []
    for s in np.linspace(0.0, length, count + 1):
        place, slope = shape(*unknowns, s)
        states.append(([*(np.array(arc["from"]) + place @ axes), *(slope @ axes)], [0.0] * 4))
    return length, states


def function_of_time(value):
    """A number, a table or an expression of the scene format, of a number and nothing or a symbol and `esym`."""
    if isinstance(value, (int, float)):
        return lambda t, _: value + 0.0 * t
    if isinstance(value, str):
        code = compile(re.sub(r"\^", "**", value), "expression", "eval")
        names = ["sin", "cos", "tanh", "exp", "sqrt"]
        return lambda t, m: eval(code, {"t": t, "PI": np.pi, **{n: getattr(m, n) for n in names}})
    table = value["table"]
    slopes = [0.0] + [(b[1] - a[1]) / (b[0] - a[0]) for a, b in zip(table, table[1:])] + [0.0]
    kinks = [(point[0], right - left) for point, left, right in zip(table, slopes, slopes[1:])]

    def linear(t, m):
        most = max if m is None else m.max
        return table[0][1] + sum(change * most(t - at, 0.0 * t) for at, change in kinks)

    return linear
