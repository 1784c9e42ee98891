"""Gears on pitch curves that swing about as often as there are teeth, or more often: the processor time of each check.

CENTRODE_BIN=target/debug/centrode python tests/campaigns/swings.py
"""

import argparse
import os
import resource
import subprocess
import tempfile
from pathlib import Path

TEETH = (10, 40, 200)
SWINGS = (1, 2, 4, 10, 25)
SHARPNESS = (0.5, 3, 8, 30)
MODULE = 2


def design(teeth: int, per_tooth: int, sharpness: float, addendum: str) -> str | None:
    """Design of a pair whose radius oscillates this often per tooth; None if the radius would come near zero.

    On a circle the amplitude would give arcs so many times smaller than a module.
    """
    waves = per_tooth * teeth + 3
    amplitude = sharpness * teeth / (MODULE * waves**2)
    if amplitude > 0.5:
        return None
    return f"""family = "gear-pair"
[pitch]
kind = "polar"
module = {MODULE}
expression = "1 + {amplitude:.9f}*cos({waves}*phi)"
tooth_count = {teeth}
[teeth]
addendum = "{addendum}"
backlash = 0.05
"""


def seconds(command: str, text: str, folder: Path) -> tuple[float, str]:
    """Processor time of a check, s, and the line that tells what was refused, if anything was."""
    file = folder / "pair.toml"
    file.write_text(text)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ended = subprocess.run([command, "check", file], capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    refused = ended.stderr.partition("\n")[0] if ended.returncode > 1 else ""
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, refused


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--command", default=os.environ.get("CENTRODE_BIN", "centrode"))
    parser.add_argument("--teeth", type=int, nargs="+", default=TEETH, help="tooth counts")
    options = parser.parse_args()
    command = options.command
    kinds = [(z, n, s, a) for z in options.teeth for n in SWINGS for s in SHARPNESS for a in ("full", "fitted")]
    times = []
    with tempfile.TemporaryDirectory() as folder:
        for kind in kinds:
            text = design(*kind)
            if text is None:
                continue
            time, refused = seconds(command, text, Path(folder))
            times.append(time)
            print(*kind, f"{time:.2f} s", refused, flush=True)
    print(f"{len(times)} designs; longest {max(times):.1f} s, {sum(time > 5 for time in times)} over 5 s")


if __name__ == "__main__":
    main()
