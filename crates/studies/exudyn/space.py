"""A scene of rods, beams, rigid and reduced bodies in space in the product's format, as a system of Exudyn's geometrically
exact beams and floating frames: the same data, from the same file. What these beams have beside rods, compliance in shear and
rotary inertia, can be divided (`stiffer`)."""

import numpy as np
from exudyn import BeamSection
from exudyn.advancedUtilities import CreateSymbolicUserFunction
from exudyn.itemInterface import (
    CoordinateConstraint,
    GenericJoint,
    LoadForceVector,
    LoadMassProportional,
    LoadTorqueVector,
    MarkerBodyMass,
    MarkerBodyRigid,
    MarkerNodePosition,
    MarkerNodeRigid,
    NodeRigidBodyEP,
    NodeRigidBodyRotVecLG,
    ObjectBeamGeometricallyExact,
    ObjectGround,
    ObjectJointRevoluteZ,
    ObjectJointSpherical,
    ObjectRigidBody,
)

import floating_frame
from model import Model, esym, function_of_time

# Shear coefficients of a section that says none.
SHEAR = [5 / 6, 5 / 6]


class SpaceModel(Model):
    """Rods, clamps of their ends, forces and moments at nodes; rigid bodies and what joins them to each other and to rods."""

    def __init__(self, scene, options):
        # Axes of bodies at the start; joints about an axis: markers, and what takes their axes to its.
        self.axes, self.hinges = {}, {}
        super().__init__(scene, options)

    def cable(self, body):
        """Nodes, elements and weight of a rod; a reduced body."""
        if body["element"] == "reduced":
            return floating_frame.add(self, body)
        line = body["shape"]["line"]
        start, end = (np.array(line[key], dtype=float) for key in ("from", "to"))
        count, length = max(round(self.options["elements"] * body.get("share", 1)), 1), np.linalg.norm(end - start)
        axes = axes_of(end - start, body["axis"])
        nodes = []
        for part in np.linspace(0.0, 1.0, count + 1):
            velocity, spin = moving(body.get("motion", {}), axes[:, 0], part, length)
            place = start + part * (end - start)
            nodes.append(self.node(place, axes, velocity, spin))
        for left, right in zip(nodes, nodes[1:]):
            element = self.mbs.AddObject(
                ObjectBeamGeometricallyExact(
                    nodeNumbers=[left, right], length=length / count, sectionData=self.section(body)
                )
            )
            if any(self.scene["gravity"]):
                marker = self.mbs.AddMarker(MarkerBodyMass(bodyNumber=element))
                self.mbs.AddLoad(LoadMassProportional(markerNumber=marker, loadVector=self.scene["gravity"]))
        for name, where in body["markers"].items():
            # One that no node is at is none of this mesh.
            if abs(where * count - round(where * count)) < 1e-9:
                self.markers[f"{body['name']}.{name}"] = nodes[round(where * count)]
        self.axes[body["name"]] = axes

    def rigid(self, body):
        """A rigid body that stands still at the start."""
        place, mass = np.array(body["position"], dtype=float), body["mass"]
        node = self.node(place, np.eye(3), np.zeros(3), np.zeros(3))
        number = self.mbs.AddObject(
            ObjectRigidBody(physicsMass=mass, physicsInertia=[*body["inertia"], 0.0, 0.0, 0.0], nodeNumber=node)
        )
        if any(self.scene["gravity"]):
            marker = self.mbs.AddMarker(MarkerBodyMass(bodyNumber=number))
            self.mbs.AddLoad(LoadMassProportional(markerNumber=marker, loadVector=self.scene["gravity"]))
        for name, point in body["markers"].items():
            marker = self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=number, localPosition=point))
            self.points[f"{body['name']}.{name}"] = marker, place + point
        self.axes[body["name"]] = np.eye(3)

    def section(self, body):
        """Stiffnesses and inertia about the axis, the first and the second axis of the section."""
        material, section = body["material"], body["section"]
        area, stiffer = section["area"], self.options.get("stiffer", 1.0)
        young, shear, density = (material[key] for key in ("youngs_modulus", "shear_modulus", "density"))
        first, second = section["second_moments"]
        result = BeamSection()
        result.massPerLength = density * area
        result.inertia = density * np.diag([first + second, first / stiffer, second / stiffer])
        across = [factor * shear * area * stiffer for factor in section.get("shear_factors", SHEAR)]
        twisting = shear * section["torsion_constant"]
        result.stiffnessMatrix = np.diag([young * area, *across, twisting, young * first, young * second])
        return result

    def node(self, place, axes, velocity, spin):
        """A node with a velocity and a spin in global axes."""
        local = axes.T @ spin
        if self.options.get("nodes", "parameters") == "vectors":
            turn = rotation_vector(axes)
            node = NodeRigidBodyRotVecLG(referenceCoordinates=[*place, *turn], initialVelocities=[*velocity, *local])
        else:
            turn = quaternion(axes)
            rates = 0.5 * times(turn, [0.0, *local])
            node = NodeRigidBodyEP(referenceCoordinates=[*place, *turn], initialVelocities=[*velocity, *rates])
        return self.mbs.AddNode(node)

    def joint(self, joint):
        """Clamps to the ground, and other joints by multipliers."""
        first, second = joint["markers"]
        if joint["kind"] == "weld" and first == "ground":
            return self.clamp(second)
        ends = [self.end(end, self.points.get(second)) for end in (first, second)]
        markers, axes = [marker for marker, _ in ends], [axes for _, axes in ends]
        turned = dict(zip(("rotationMarker0", "rotationMarker1"), axes))
        if joint["kind"] == "weld":
            self.mbs.AddObject(GenericJoint(markerNumbers=markers, **turned))
        elif joint["kind"] == "spherical":
            self.mbs.AddObject(ObjectJointSpherical(markerNumbers=markers))
        elif joint["kind"] == "revolute":
            # Its axis is the third one.
            normal = axes_of(np.array(joint["direction"], dtype=float), np.roll(joint["direction"], 1))[:, [1, 2, 0]]
            turned = {name: axes @ normal for name, axes in turned.items()}
            self.mbs.AddObject(ObjectJointRevoluteZ(markerNumbers=markers, **turned))
            self.hinges[joint["name"]] = markers, turned
        else:
            raise ValueError(f"joint {joint['name']}: expected a weld, a spherical or a revolute joint")

    def end(self, name, other):
        """A marker for a joint, and what takes global axes to its own; the ground is where the other end is."""
        if name == "ground":
            ground = self.mbs.AddObject(ObjectGround())
            return self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=ground, localPosition=other[1])), np.eye(3)
        axes = self.axes[name.split(".")[0]].T
        if name in self.points:
            return self.points[name][0], axes
        return self.mbs.AddMarker(MarkerNodeRigid(nodeNumber=self.markers[name])), axes

    def drive(self, motion):
        """Turns a joint about its axis as told."""
        markers, turned = self.hinges[motion["joint"]]
        angle = function_of_time(motion["value"])

        def offset(mbs, t, itemNumber, offsetUserFunctionParameters):
            zero = 0.0 * t
            return [zero, zero, zero, zero, zero, angle(t, esym)]

        number = self.mbs.AddObject(GenericJoint(markerNumbers=markers, constrainedAxes=[0, 0, 0, 0, 0, 1], **turned))
        function = CreateSymbolicUserFunction(self.mbs, offset, "offsetUserFunction", number)
        self.mbs.SetObjectParameter(number, "offsetUserFunction", function)
        self.kept.append(function)

    def clamp(self, second):
        """A clamp of an end to the ground. Of Euler parameters the first follows from the others."""
        skipped = self.options.get("nodes", "parameters") == "parameters"
        for coordinate in [0, 1, 2] + [axis + skipped for axis in (3, 4, 5)]:
            here = self.coordinate(self.markers[second], coordinate)
            self.mbs.AddObject(CoordinateConstraint(markerNumbers=[self.fixed, here]))

    def load(self, load):
        """A force or a moment in global axes at a node."""
        node, parts = self.markers[load["marker"]], [function_of_time(value) for value in load["value"]]
        if load["kind"] == "force":
            number = self.mbs.AddLoad(LoadForceVector(markerNumber=self.mbs.AddMarker(MarkerNodePosition(nodeNumber=node))))
        elif load["kind"] == "moment":
            number = self.mbs.AddLoad(LoadTorqueVector(markerNumber=self.mbs.AddMarker(MarkerNodeRigid(nodeNumber=node))))
        else:
            raise ValueError(f"load {load['name']}: expected a force or a moment")
        self.vary(number, lambda t: [part(t, esym) for part in parts])


def axes_of(way, given):
    """Axes of a section as columns: the tangent, and what is given made normal to it."""
    tangent = way / np.linalg.norm(way)
    first = np.array(given, dtype=float)
    first -= tangent * (tangent @ first)
    first /= np.linalg.norm(first)
    return np.column_stack([tangent, first, np.cross(tangent, first)])


def moving(motion, tangent, part, length):
    """Velocity, and spin of the section, at a part of the length at the start: the section stays normal to the line."""
    spin = np.array(motion.get("spin", [0.0] * 3), dtype=float)
    deforming = [course(value) for value in motion.get("deformation", ["0"] * 3)]
    s, step = part * length, 1e-6 * length
    at = lambda s: np.array([value(s / length) for value in deforming])
    velocity = np.array(motion.get("velocity", [0.0] * 3)) + np.cross(spin, s * tangent) + at(s)
    bending = (at(s + step) - at(s - step)) / (2 * step)
    return velocity, spin + np.cross(tangent, bending)


def course(value):
    """An expression of `s`, the part of the length."""
    code = compile(str(value), "expression", "eval")
    return lambda s: eval(code, {"s": s, "PI": np.pi, "sin": np.sin, "cos": np.cos})


def quaternion(axes):
    """Euler parameters of a rotation that is less than half a turn."""
    real = 0.5 * np.sqrt(1.0 + np.trace(axes))
    turned = [axes[2, 1] - axes[1, 2], axes[0, 2] - axes[2, 0], axes[1, 0] - axes[0, 1]]
    return np.array([real, *(np.array(turned) / (4.0 * real))])


def rotation_vector(axes):
    """The rotation vector of the same."""
    real, *turned = quaternion(axes)
    size = np.linalg.norm(turned)
    return np.array(turned) * (2.0 * np.arctan2(size, real) / size if size > 0.0 else 2.0)


def times(a, b):
    """The product of two quaternions."""
    (p, u), (q, v) = ((x[0], np.array(x[1:])) for x in (a, b))
    return np.array([p * q - u @ v, *(p * v + q * u + np.cross(u, v))])
