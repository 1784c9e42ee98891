"""Proofs of the strong laws: the certificate of each with fitted teeth, and the result of the proof checker.

    CENTRODE_BIN=target/debug/centrode python tests/campaigns/law_proofs.py

Needs what `tools/proof_checker.py` needs. Prints a line a law, with the checker's processor time; ends with status 1 if
a certificate is refused. A law without a certificate is told with the reason.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import tomllib

ROOT = Path(__file__).parents[2]
BIN = os.environ.get("CENTRODE_BIN", "centrode")


def design(law):
    """The design file of a law."""
    return f"""family = "gear-pair"
name = {json.dumps(law["name"].replace(" ", "-"))}
mean_ratio = {law.get("mean_ratio", [1, 1])}
[pitch]
kind = "polar"
expression = {json.dumps(law["radius"])}
module = 1.0
tooth_count = {law["teeth"]}
[teeth]
addendum = "fitted"
"""


def run(*command):
    """What a command prints, its status and the processor time it takes."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime - before.ru_utime


def main():
    """Run the campaign."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--laws", type=int, help="number of laws, from the first on (all)")
    options = parser.parse_args()
    laws = tomllib.loads((ROOT / "tests/published/data/strong_laws.toml").read_text())
    (laws,) = (value for value in laws.values() if isinstance(value, list))
    laws = laws[: options.laws]
    refused = 0
    with tempfile.TemporaryDirectory() as folder:
        file, proof = Path(folder) / "law.toml", Path(folder) / "law.proof"
        for law in laws:
            file.write_text(design(law))
            written, _ = run(BIN, "prove", file, "-o", proof)
            if written.returncode:
                print(f"{law['name']}: no certificate: {written.stderr.strip()}", flush=True)
                continue
            checked, seconds = run(sys.executable, ROOT / "tools/proof_checker.py", proof, file)
            refused += checked.returncode != 0
            print(f"{law['name']}: {checked.stdout.splitlines()[0]} ({seconds:.0f} s)", flush=True)
    print(f"# {len(laws)} laws, {refused} certificates refused")
    return refused > 0


if __name__ == "__main__":
    sys.exit(main())
