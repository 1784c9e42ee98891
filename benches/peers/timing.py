"""How long a call takes, and how that is written."""

import time


def best(action, least=3, span=1.0):
    """Shortest of several runs, in seconds, and the last answer."""
    times, start = [], time.perf_counter()
    while len(times) < least or (time.perf_counter() - start < span and len(times) < 2000):
        begin = time.perf_counter()
        answer = action()
        times.append(time.perf_counter() - begin)
    return min(times), answer


def worked(action, span=1.0):
    """Seconds of work a run, all threads together, and the last answer: what else the machine does does not count.

    The mean of as many runs as take so many seconds of work, after one that does not count: the clock of a process
    goes on by ticks where its threads change.
    """
    answer = action()
    runs, begin = 0, time.process_time()
    while time.process_time() - begin < span:
        answer = action()
        runs += 1
    return (time.process_time() - begin) / runs, answer


def seconds(value):
    if value is None:
        return "-"
    return f"{value * 1e3:.3g} ms" if value < 1 else f"{value:.2f} s"


def times(theirs, ours):
    return f"{theirs / ours:.3g} x"
