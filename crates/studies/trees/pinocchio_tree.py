"""Pinocchio: joint angles and the articulated-body algorithm, called from C++ that is compiled for this processor."""

import ctypes
import functools
import hashlib
import pathlib
import subprocess
import sysconfig

import numpy as np

SOURCE = pathlib.Path(__file__).with_name("aba.cpp")
INCLUDE = pathlib.Path(sysconfig.get_path("purelib")) / "cmeel.prefix" / "include"
FLAGS = ["-std=c++17", "-O3", "-march=native", "-DNDEBUG", "-shared", "-fPIC", f"-I{INCLUDE}", f"-I{INCLUDE / 'eigen3'}"]
# As Pinocchio's own build files ask for.
FLAGS += ["-DBOOST_MPL_LIMIT_LIST_SIZE=30", "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS"]
NUMBERS = np.ctypeslib.ndpointer(np.float64, flags="C")
PARENTS = np.ctypeslib.ndpointer(np.int32, flags="C")


@functools.cache
def library(folder):
    """The compiled source, compiled where that has not been done."""
    mark = hashlib.sha256(SOURCE.read_bytes() + " ".join(FLAGS).encode()).hexdigest()[:16]
    file = pathlib.Path(folder) / f"aba-{mark}.so"
    if not file.exists():
        partial = file.with_suffix(".partial")
        subprocess.run(["g++", *FLAGS, str(SOURCE), "-o", str(partial)], check=True, capture_output=True)
        partial.rename(file)
    made = ctypes.CDLL(str(file))
    handle, whole = ctypes.c_void_p, ctypes.c_long
    made.make.argtypes, made.make.restype = [ctypes.c_int, PARENTS, NUMBERS, NUMBERS], handle
    made.march.argtypes = [handle, ctypes.c_double, whole, whole, NUMBERS, NUMBERS]
    made.accelerate.argtypes = [handle, NUMBERS, NUMBERS, NUMBERS, whole]
    made.march.restype = made.accelerate.restype = ctypes.c_double
    made.drop.argtypes = [handle]
    return made


class Model:
    """A tree in the library's hands."""

    def __init__(self, tree, folder):
        self.library, self.tree = library(folder), tree
        parents = np.array([link.parent for link in tree.links], np.int32)
        row = lambda link: [
            *(link.joint - tree.base(link)),
            *link.axis,
            link.mass,
            *(link.centre - link.joint),
            *link.inertia.flat,
        ]
        links = np.array([row(link) for link in tree.links])
        self.handle = self.library.make(len(parents), parents, links, tree.gravity)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.library.drop(self.handle)


def run(tree, options):
    """Steps of Runge-Kutta's method of order 4."""
    step, every = options["step"], options["every"]
    count, stride = round(options["stop_time"] / step), round(every / step)
    path = np.zeros((count // stride, 3))
    with Model(tree, options["folder"]) as model:
        point = tree.point - tree.links[-1].joint
        cpu = model.library.march(model.handle, step, count, stride, point, path)
    if not np.isfinite(path).all():
        return {"good": False, "failure": "unstable"}
    return {"good": True, "cpu_time": cpu, "path": path.tolist()}


def accelerate(tree, angles, rates, calls, folder):
    """CPU time of `aba`, s, and the acceleration."""
    found = np.zeros(len(angles))
    with Model(tree, folder) as model:
        time = model.library.accelerate(model.handle, np.array(angles), np.array(rates), found, calls)
    return time, found.tolist()
