"""A sweep of many three-arm designs in one process and on Dask's distributed scheduler, its workers on this machine.

    python benches/sweep_on_dask.py [--designs 100000] [--workers 2]

Prints the time of each, the share of the workers that was of use, and whether the numbers are the same; then once more
with a worker killed while the sweep runs.
"""

import os

# A process is one core here: the workers are what is compared.
os.environ["RAYON_NUM_THREADS"] = "1"

import argparse
import signal
import threading
import time
from collections.abc import Callable

import centrode as ct
import numpy as np
from distributed import Client, LocalCluster
from numpy.typing import NDArray

RADII = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24]


def variants(count: int) -> dict[str, NDArray[np.float64]]:
    """All twelve radii, bend and tip's distance, each by chance around the published set."""
    chance = np.random.default_rng(2021)
    over = {f"r{i + 1}": radius * chance.uniform(0.9, 1.1, count) for i, radius in enumerate(RADII)}
    return over | {"bend": chance.uniform(-60, -45, count), "tip_distance": chance.uniform(135, 155, count)}


def timed(work: Callable[[], dict[str, NDArray[np.float64]]]) -> tuple[float, dict[str, NDArray[np.float64]]]:
    start = time.perf_counter()
    found = work()
    return time.perf_counter() - start, found


def same(a: dict[str, NDArray[np.float64]], b: dict[str, NDArray[np.float64]]) -> bool:
    return a.keys() == b.keys() and all(np.array_equal(a[name], b[name], equal_nan=True) for name in a)


def main() -> None:
    words = argparse.ArgumentParser(description="Sweep on one process and on Dask.")
    words.add_argument("--designs", type=int, default=100_000)
    words.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    asked = words.parse_args()
    text, over = ct.template("three-arm"), variants(asked.designs)
    alone, wanted = timed(lambda: ct.sweep(text, over=over))
    good = int(np.isfinite(wanted["pick-angle"]).sum())
    print(f"{asked.designs} designs, {good} of them mechanisms")
    print(f"one process      {alone:7.2f} s  {asked.designs / alone:9.0f} designs/s")
    with (
        LocalCluster(
            n_workers=asked.workers, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
        ) as cluster,
        Client(cluster) as client,
    ):
        pool = client.get_executor(pure=False)
        # Imports and the first look are not what is timed.
        client.run(lambda: ct.sweep(text, over={"r1": [21.0]}))
        spread, found = timed(lambda: ct.sweep(text, over=over, executor=pool))
        share = alone / spread / asked.workers
        print(f"{asked.workers} workers        {spread:7.2f} s  {asked.designs / spread:9.0f} designs/s", end="")
        print(f"  efficiency {share:.2f}  same numbers: {same(wanted, found)}")
        victim = next(iter(client.run(os.getpid).values()))
        killer = threading.Timer(spread / 3, os.kill, (victim, signal.SIGKILL))
        killer.start()
        killed, found = timed(lambda: ct.sweep(text, over=over, executor=pool))
        killer.join()
        gone = victim not in client.run(os.getpid).values()
        print(f"a worker killed  {killed:7.2f} s  gone: {gone}  same numbers: {same(wanted, found)}")


if __name__ == "__main__":
    main()
