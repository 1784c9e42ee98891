"""Times the conversion of both gears of the 2018 pair to solids of build123d, from the cut pair on.

    python benches/cad_parts.py              # build123d; needs centrode[build123d]
    python benches/cad_parts.py --cadquery   # in an environment with CadQuery

Processor time of one thread; the first conversion, which also imports the kernel, is left out.
"""

import argparse
import statistics
import time
from pathlib import Path

import centrode as ct

DESIGN = Path(__file__).parents[1] / "tests" / "designs" / "elliptic-pair-2018.toml"


def milliseconds(call, times):
    """Processor time of each of some calls."""
    found = []
    for _ in range(times):
        start = time.process_time()
        call()
        found.append(1e3 * (time.process_time() - start))
    return found


def main():
    """Prints the figures."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--cadquery", action="store_true", help="CadQuery in the place of build123d")
    parser.add_argument("--times", type=int, default=50, help="conversions (50)")
    options = parser.parse_args()
    adapter = ct.cadquery if options.cadquery else ct.build123d
    pair = ct.load(DESIGN)

    def parts():
        return adapter.part(pair.driver), adapter.part(pair.driven)

    def edges():
        return pair.driver.solid(), pair.driven.solid()

    parts()
    for name, call in (("edges alone", edges), ("both gears", parts)):
        found = milliseconds(call, options.times)
        print(f"{name}: {statistics.median(found):.1f} ms, minimum {min(found):.1f}, maximum {max(found):.1f}")
    sides = sum(len(contour) for solid in edges() for contour in solid.contours)
    print(f"{sides} edges in {adapter.__name__}, {options.times} times")


if __name__ == "__main__":
    main()
