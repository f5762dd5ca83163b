"""The usual loop: `fmpy.simulate_fmu` once for every value of a parameter. Prints how long it took, s.

Run: python crates/studies/simulate_loop.py FMU NAME FROM TO COUNT STOP_TIME STEP
"""

import sys
import time

import fmpy

fmu, name = sys.argv[1:3]
first, last, count, stop_time, step = map(float, sys.argv[3:])
started = time.perf_counter()
for run in range(round(count)):
    value = first + (last - first) * run / (count - 1)
    result = fmpy.simulate_fmu(fmu, start_values={name: value}, stop_time=stop_time, output_interval=step)
    final, least, largest = ({n: pick(result[n]) for n in result.dtype.names} for pick in (lambda v: v[-1], min, max))
print(time.perf_counter() - started)
