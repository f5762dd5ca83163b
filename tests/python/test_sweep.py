"""`flexbody sweep` on threads and on a cluster: one table, to the bit."""

import os
import signal
import subprocess
import sys
import time

import pytest
from test_cluster import children

VARY = ["--vary", "rod.density=5000:6000:60", "--vary", "gravity[2]=-9,-9.81"]


def start(program, swing, output, *options):
    command = [program, "sweep", swing, *VARY, "--stop-time", "1", "--output", output, *options]
    environment = {**os.environ, "FLEXBODY_PYTHON": sys.executable}
    return subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True)


def finish(process):
    _, printed = process.communicate(timeout=300)
    assert process.returncode == 0, printed
    return printed


def lines(journal):
    return journal.read_bytes().count(b"\n") if journal.exists() else 0


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="finds workers in /proc")
def test_a_cluster_gives_the_bits_of_threads_whatever_is_killed(program, swing, tmp_path):
    threads, cluster = (tmp_path / f"{name}.parquet" for name in ("threads", "cluster"))
    series = [tmp_path / f"{name}.series.parquet" for name in ("threads", "cluster")]
    finish(start(program, swing, threads, "--series", series[0]))
    process = start(program, swing, cluster, "--series", series[1], "--scheduler", "local", "--jobs", "3")
    journal = cluster.with_name(cluster.name + ".runs")
    until = time.monotonic() + 120
    while lines(journal) < 12 and process.poll() is None and time.monotonic() < until:
        time.sleep(0.01)
    workers = children(process)
    assert workers, "no worker is left to be killed"
    os.kill(workers[0], signal.SIGKILL)
    finish(process)
    assert cluster.read_bytes() == threads.read_bytes()
    assert series[1].read_bytes() == series[0].read_bytes()
    assert not journal.exists()
