"""Mutated designs: none holds the program, crashes it or is answered without a word.

The designs of tests/designs are changed at one to four places: numbers scaled, negated, made huge, tiny or no number at
all, words exchanged for others written under the same key, keys dropped, tables and lists taken from elsewhere, lists
cut and drawn out; gears have up to 200 teeth. Each is checked by the command line, which may take so many seconds of
processor time; it must answer with a report or with an error that has a reason. Prints each design that fails.

    CENTRODE_BIN=target/debug/centrode python tests/campaigns/hostile.py --designs 2000 --seed 1 --jobs 2
"""

import argparse
import copy
import json
import math
import os
import re
import resource
import subprocess
import sys
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import tomllib

DESIGNS = Path(__file__).parents[1] / "designs"
BIN = os.environ.get("CENTRODE_BIN", "centrode")
MOST_TEETH = 200
MEMORY = 4 << 30
"""Maximum address space of a check, bytes."""


def toml(value):
    """A value as it stands in a design file."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    if isinstance(value, float):
        return "nan" if math.isnan(value) else f"{value!r}".replace("e+", "e")
    return json.dumps(value, ensure_ascii=False)


def text(design):
    """A design as a file."""
    return "".join(f"{json.dumps(key)} = {toml(value)}\n" for key, value in design.items())


def places(table, path=()):
    """Every place of a design that holds a value: the table or list it is in, its key and the keys that lead to it."""
    items = table.items() if isinstance(table, dict) else enumerate(table)
    for key, value in items:
        yield table, key, (*path, key)
        if isinstance(value, (dict, list)):
            yield from places(value, (*path, key))


def number(random, value):
    """Another number in the place of one."""
    whole = isinstance(value, int)
    way = random.integers(10)
    if way < 5:
        changed = value * random.choice([0.3, 0.5, 0.8, 0.95, 1.05, 1.3, 2.0, 3.0])
    elif way == 5:
        changed = -value
    elif way == 6:
        changed = value + random.normal()
    elif way == 7:
        changed = random.choice([0.0, 1.0, -1.0, 1e-9, 1e-3, 1e3, 1e9])
    elif way == 8:
        return float(random.choice([0.0, 1e300, -1e-300, math.inf, math.nan]))
    else:
        return int(random.integers(0, MOST_TEETH + 1))
    return int(min(max(round(changed), -(2**62)), 2**62)) if whole and random.integers(8) else float(changed)


def mutate(random, design, words, tables):
    """Changes a design in place, somewhere."""
    own = [place for place in places(design) if place[2] != ("family",)]
    table, key, path = own[random.integers(len(own))]
    value = table[key]
    name = next((part for part in reversed(path) if isinstance(part, str)), "")
    if isinstance(value, bool):
        table[key] = not value
    elif isinstance(value, (int, float)):
        table[key] = number(random, value)
    elif isinstance(value, str):
        table[key] = str(random.choice(words[name])) if random.integers(6) else value + "x"
    elif isinstance(value, list) and value and random.integers(2):
        at = int(random.integers(len(value)))
        if random.integers(2):
            value.insert(at, copy.deepcopy(value[at]))
        else:
            del value[at]
    elif random.integers(3) == 0:
        del table[key]
    else:
        table[key] = copy.deepcopy(tables[name][random.integers(len(tables[name]))])


def restrain(design):
    """Keeps numbers of teeth to what the campaign promises an answer for."""
    for table, key, _ in list(places(design)):
        value = table[key]
        if key == "tooth_count" and isinstance(value, (int, float)) and value > MOST_TEETH:
            table[key] = MOST_TEETH


def draw(seed, count, shipped, words, tables):
    """The count-th changed design of a seed, and the name of the one it was made of."""
    random = np.random.default_rng([seed, count])
    names = sorted(shipped)
    # Gear pairs are changed most often: they take the longest.
    pairs = [name for name in names if shipped[name]["family"] == "gear-pair"]
    name = str(random.choice(pairs if random.integers(2) else names))
    design = copy.deepcopy(shipped[name])
    for _ in range(random.integers(1, 5)):
        mutate(random, design, words, tables)
    restrain(design)
    return name, text(design)


def check(file, seconds):
    """Checks a design: its faults, and the reason where it is refused."""

    def limits():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))

    run = subprocess.Popen(
        [BIN, "check", "-"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        preexec_fn=limits,
        env={**os.environ, "RAYON_NUM_THREADS": "1", "NO_COLOR": "1"},
    )
    out, errors = run.communicate(file.encode())
    errors = errors.decode(errors="replace").strip()
    if run.returncode in (-24, -9):
        return [f"takes over {seconds} s of processor time"], ""
    faults = []
    if run.returncode not in (0, 1, 2) or "panicked" in errors:
        faults.append(f"ends with {run.returncode}: {errors[-300:]}")
    elif run.returncode == 2 and not errors:
        faults.append("is refused without a word")
    elif run.returncode < 2 and not out:
        faults.append("is answered without a word")
    return faults, errors if run.returncode == 2 else ""


def main():
    """Run the campaign; the exit status tells whether anything failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--designs", type=int, default=400, help="designs to draw")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first design drawn")
    parser.add_argument("--seconds", type=int, default=5, help="processor time a check may take")
    parser.add_argument("--minutes", type=float, default=math.inf, help="time after which no more are drawn")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    shipped = {file.stem: tomllib.loads(file.read_text()) for file in sorted(DESIGNS.glob("*.toml"))}
    words, tables = {}, {}
    for design in shipped.values():
        for table, key, path in places(design):
            name = next((part for part in reversed(path) if isinstance(part, str)), "")
            kind = words if isinstance(table[key], str) else tables
            kind.setdefault(name, []).append(table[key])
    until = time.monotonic() + 60 * options.minutes

    def examine(count):
        if time.monotonic() > until:
            return None
        name, file = draw(options.seed, count, shipped, words, tables)
        return count, name, file, check(file, options.seconds)

    reasons, answered, failed, looked = Counter(), 0, 0, 0
    with ThreadPoolExecutor(options.jobs) as pool:
        for found in pool.map(examine, range(options.first, options.first + options.designs)):
            if found is None:
                continue
            count, name, file, (faults, refusal) = found
            looked += 1
            if faults:
                failed += 1
                print(f"# design {count} of seed {options.seed}, from {name}: {'; '.join(faults)}")
                print(file, flush=True)
            elif refusal:
                # Refusals alike but for their numbers are counted together.
                reasons[re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?", "#", refusal.splitlines()[0])] += 1
            else:
                answered += 1
    for reason, count in reasons.most_common(20):
        print(f"# {count} x {reason}")
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(
        f"# seed {options.seed}: {looked} designs looked at, {answered} answered, {sum(reasons.values())} refused, "
        f"{failed} failed; {1e3 * (children.ru_utime + children.ru_stime) / max(looked, 1):.0f} ms a design"
    )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
