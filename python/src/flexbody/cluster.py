"""The far side of `flexbody sweep --scheduler`: runs of a unit on the workers of a Dask cluster.

    python -m flexbody.cluster --scheduler ADDRESS|local [--workers N] FMU

The plan of the runs comes from standard input, a line of JSON that says what they have in common and one a run; a line
of JSON for every run goes to standard output as soon as it is finished.
"""

import argparse
import json
import os
import queue
import sys
import threading
import uuid
from pathlib import Path

from flexbody._errors import Error

# Runs that wait at a worker, so that it is never idle, nor the memory full of plans.
AHEAD = 4
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
    import dask
    from distributed import Client, LocalCluster

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
    from fmpy import read_model_description

    known = {variable.name for variable in read_model_description(str(fmu)).modelVariables}
    for name in [*plan["inputs"], *plan["outputs"], *plan["fixed"]]:
        if name not in known:
            raise Error(f"{name}: {fmu} has no variable of this name")
    return plan


class Feeder(threading.Thread):
    """Hands runs to the cluster, never more at a time than it has room for."""

    def __init__(self, client, name, lines, room):
        super().__init__(daemon=True)
        self.client = client
        self.name_of_sweep = name
        self.lines = lines
        self.room = threading.Semaphore(room)
        self.finished = queue.SimpleQueue()
        self.number = 0

    def run(self):
        from flexbody._unit import work

        try:
            for line in self.lines:
                if line.strip():
                    run = json.loads(line)
                    self.room.acquire()
                    key = f"{self.name_of_sweep}-{run['run']}"
                    future = self.client.submit(work, self.name_of_sweep, run, key=key)
                    self.number += 1
                    future.add_done_callback(lambda future, run=run: self.finished.put((run["run"], future)))
        except Exception as error:
            self.finished.put(error)
        self.finished.put(END)

    def results(self):
        """A line for every run, in the order in which they end."""
        from flexbody._unit import result

        left = None
        done = 0
        while left is None or done < left:
            item = self.finished.get()
            if item is END:
                left = self.number
                continue
            if isinstance(item, Exception):
                raise item
            number, future = item
            done += 1
            if future.cancelled():
                raise Error("the scheduler is gone")
            error = future.exception()
            yield result(number, {"error": str(error)}) if error else future.result()
            future.release()
            self.room.release()


def sweep(arguments, lines, output):
    plan = checked(json.loads(next(lines)), arguments.fmu)
    client, cluster = connected(arguments.scheduler, arguments.workers)
    try:
        from flexbody._unit import UnitPlugin

        client.wait_for_workers(1, timeout=PATIENCE)
        # Others may sweep on the same cluster.
        name = f"flexbody-{uuid.uuid4().hex}"
        client.register_plugin(UnitPlugin(name, arguments.fmu.read_bytes(), plan))
        threads = sum(client.nthreads().values())
        feeder = Feeder(client, name, lines, AHEAD * max(threads, arguments.workers))
        feeder.start()
        for line in feeder.results():
            print(line, file=output, flush=True)
        client.unregister_worker_plugin(name)
    finally:
        client.close()
        if cluster is not None:
            cluster.close()


def own_output():
    """Standard output for results alone: what workers and libraries print goes to standard error."""
    output = os.fdopen(os.dup(1), "w", encoding="utf-8", newline="\n")
    os.dup2(2, 1)
    return output


def main():
    arguments = parsed(None)
    try:
        sweep(arguments, iter(sys.stdin), own_output())
    except BrokenPipeError:
        # No one reads any more.
        os._exit(1)
    except (Error, OSError, ValueError, ImportError) as error:
        print(f"flexbody.cluster: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
