"""The far side of `flexbody sweep --scheduler`: runs of a unit on the workers of a Dask cluster.

    python -m flexbody.cluster --scheduler ADDRESS|local [--workers N] FMU

The plan of the runs comes from standard input, a line of JSON that says what they have in common and one a run; a line
of JSON for every run goes to standard output as soon as it is finished.
"""

import argparse
import contextlib
import json
import os
import queue
import sys
import threading
import uuid
from pathlib import Path

import dask
from distributed import Client, LocalCluster
from fmpy import read_model_description

from flexbody._errors import Error
from flexbody._unit import UnitPlugin, result, work

# Tasks for every thread of a worker: one at work, one that waits.
AHEAD = 2
# How long a task takes, about, s: many short runs are one task, since a task costs some ms whatever it does.
TASK = 0.5
# Most runs of a task, and most lines that are read ahead.
MOST = 100
# How long the first worker may take to come, s.
PATIENCE = 60
# How often a run is tried whose workers die.
TRIES = 3
# What ends the queue of finished runs.
END = object()


def parsed(arguments):
    parser = argparse.ArgumentParser(prog="python -m flexbody.cluster", description=__doc__.splitlines()[0])
    parser.add_argument("--scheduler", required=True, help="address of a Dask scheduler, or `local`")
    parser.add_argument("--workers", type=int, default=0, help="workers of a local cluster; one a core where it is 0")
    parser.add_argument("fmu", type=Path, help="the unit to run")
    return parser.parse_args(arguments)


def connected(scheduler, workers):
    """A client, and the cluster that it made."""
    dask.config.set({"distributed.scheduler.allowed-failures": TRIES})
    if scheduler != "local":
        return Client(scheduler, timeout=PATIENCE), None
    cluster = LocalCluster(
        n_workers=workers or os.cpu_count(),
        threads_per_worker=1,
        processes=True,
        host="127.0.0.1",
        dashboard_address=None,
    )
    return Client(cluster), cluster


def checked(plan, fmu):
    """The plan of all runs, once it is sure that the unit has its variables."""
    known = {variable.name for variable in read_model_description(str(fmu)).modelVariables}
    for name in [*plan["inputs"], *plan["outputs"], *plan["fixed"]]:
        if name not in known:
            raise Error(f"{name}: {fmu} has no variable of this name")
    return plan


class Reader(threading.Thread):
    """Reads ahead, but not far."""

    def __init__(self, lines):
        super().__init__(daemon=True)
        self.lines = lines
        self.read = queue.Queue(MOST)

    def run(self):
        try:
            for line in self.lines:
                if line.strip():
                    self.read.put(json.loads(line))
            self.read.put(END)
        except Exception as error:
            self.read.put(error)

    def some(self, count):
        """Runs that are there, at most so many; waits for the first. What ends them comes alone."""
        found = [self.read.get()]
        while is_run(found[-1]) and len(found) < count and not self.read.empty():
            found.append(self.read.get())
        last = None if is_run(found[-1]) else found.pop()
        return found, last


def is_run(item):
    return isinstance(item, dict)


class Feeder(threading.Thread):
    """Hands runs to the cluster, never more at a time than it has room for."""

    def __init__(self, client, sweep, lines, room):
        super().__init__(daemon=True)
        self.client = client
        self.sweep = sweep
        self.reader = Reader(lines)
        self.room = threading.Semaphore(room)
        self.finished = queue.SimpleQueue()
        self.tasks = 0
        # Runs of a task; as many as go into the time of one, once it is known how long a run takes.
        self.size = 1

    def run(self):
        self.reader.start()
        last = None
        while last is None:
            self.room.acquire()
            runs, last = self.reader.some(self.size)
            if runs:
                self._submit(runs)
        self.finished.put(last)

    def _submit(self, runs):
        future = self.client.submit(work, self.sweep, runs, key=f"{self.sweep}-{runs[0]['run']}")
        self.tasks += 1
        future.add_done_callback(lambda future: self.finished.put((runs, future)))

    def results(self):
        """A line for every run, in the order in which tasks end."""
        last = None
        done = 0
        while last is None or done < self.tasks:
            item = self.finished.get()
            if isinstance(item, tuple):
                done += 1
                yield from self._lines(*item)
                self.room.release()
            elif item is END:
                last = item
            else:
                raise Error(f"standard input: {item}")

    def _lines(self, runs, future):
        if future.cancelled():
            raise Error("the scheduler is gone")
        error = future.exception()
        if error:
            return [result(run["run"], {"error": str(error)}) for run in runs]
        lines, seconds = future.result()
        self.size = max(1, min(MOST, int(TASK * len(runs) / max(seconds, 1e-9))))
        future.release()
        return lines


def sweep(arguments, lines, output):
    plan = checked(json.loads(next(lines)), arguments.fmu)
    client, cluster = connected(arguments.scheduler, arguments.workers)
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
        # Others may sweep on the same cluster.
        name = f"flexbody-{uuid.uuid4().hex}"
        client.register_plugin(UnitPlugin(name, arguments.fmu.read_bytes(), plan))
        threads = sum(client.nthreads().values())
        feeder = Feeder(client, name, lines, AHEAD * max(threads, arguments.workers))
        feeder.start()
        try:
            for line in feeder.results():
                print(line, file=output, flush=True)
        finally:
            closed(client, name)
    finally:
        closed(client)
        if cluster is not None:
            closed(cluster)


def closed(what, name=None):
    """Ends a client or a cluster, or takes the unit from the workers: whatever goes wrong then, results are out."""
    with contextlib.suppress(Exception):
        if name is None:
            what.close()
        elif what.status == "running":
            what.unregister_worker_plugin(name)


def own_output():
    """Standard output for results alone: what workers and libraries print goes to standard error."""
    output = os.fdopen(os.dup(1), "w", encoding="utf-8", newline="\n")
    os.dup2(2, 1)
    return output


def main():
    arguments = parsed(None)
    try:
        sweep(arguments, iter(sys.stdin), own_output())
    except (BrokenPipeError, KeyboardInterrupt):
        # No one reads any more, or waits for threads that read.
        os._exit(1)
    except (Error, OSError, ValueError, ImportError) as error:
        print(f"flexbody.cluster: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
