"""Runs the pendulum under fmpy with another density: python run.py"""

from fmpy import simulate_fmu

swing = simulate_fmu("pendulum.fmu", start_values={"rod.density": 5000.0})
print(swing.dtype.names)
print(swing["time"][-1], swing["rod.tip.position[1]"][-1], swing["rod.tip.position[2]"][-1])
