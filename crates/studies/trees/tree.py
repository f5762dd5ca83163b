"""An open tree of rigid bodies on revolute joints, in the product's format, as links that any program with joint angles
takes. All frames stand along the global axes at the start, each at the joint that carries its link."""

import numpy as np


class Link:
    """A body with the joint that carries it: `parent` (-1 is the ground), `joint` and `axis` in global axes, `mass`,
    `centre` and `inertia` about it, all as at the start."""

    def __init__(self, body):
        self.name = body["name"]
        self.axes = rotation(body.get("orientation", {}).get("rotation_vector", [0.0, 0.0, 0.0]))
        self.mass, self.centre = body["mass"], np.array(body["position"], float)
        self.inertia = self.axes @ np.diag(body["inertia"]) @ self.axes.T
        self.points = {name: self.centre + self.axes @ point for name, point in body["markers"].items()}


def rotation(vector):
    """Rodrigues' formula."""
    angle = np.linalg.norm(vector)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = np.array(vector) / angle
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * skew + (1.0 - np.cos(angle)) * skew @ skew


class Tree:
    """Links in an order in which parents come first."""

    def __init__(self, scene, marker):
        self.gravity = np.array(scene["gravity"], float)
        self.links = [Link(body) for body in scene["bodies"]]
        known = {link.name: place for place, link in enumerate(self.links)}
        for joint in scene["joints"]:
            if joint["kind"] != "revolute":
                raise ValueError(f"joint {joint['name']}: expected a revolute one")
            first, second = joint["markers"]
            body, point = second.split(".")
            link = self.links[known[body]]
            link.parent = -1 if first == "ground" else known[first.split(".")[0]]
            link.joint = link.points[point]
            # Said in the frame of the first body.
            frame = np.eye(3) if link.parent < 0 else self.links[link.parent].axes
            link.axis = frame @ joint["direction"] / np.linalg.norm(joint["direction"])
        body, point = marker.split(".")
        if known[body] != len(self.links) - 1:
            raise ValueError(f"marker {marker}: expected one of the last body")
        self.point = self.links[-1].points[point]

    def base(self, link):
        """Where the frame of its parent is at the start."""
        return np.zeros(3) if link.parent < 0 else self.links[link.parent].joint
