"""Checks whether the goldens hold what they held at another commit, however their lines are laid out.

python tests/golden/equal.py HEAD~1
"""

import json
import pathlib
import subprocess
import sys

FOLDER = pathlib.Path(__file__).parent


def before(commit: str, name: str) -> object:
    """The golden of that commit, `None` if it had none."""
    file = f"{commit}:./{name}"
    shown = subprocess.run(["git", "show", file], cwd=FOLDER, capture_output=True, check=False)
    return json.loads(shown.stdout) if shown.returncode == 0 else None


def main() -> None:
    commit = sys.argv[1]
    listed = ["git", "ls-tree", "--name-only", commit, "./"]
    names = subprocess.run(listed, cwd=FOLDER, capture_output=True, check=True, text=True).stdout.split()
    names = {name for name in names if name.endswith(".json")} | {path.name for path in FOLDER.glob("*.json")}
    now = {path.name: json.loads(path.read_bytes()) for path in FOLDER.glob("*.json")}
    differing = [name for name in sorted(names) if before(commit, name) != now.get(name)]
    sys.exit("\n".join(differing) if differing else print(f"{len(names)} goldens are equal"))


if __name__ == "__main__":
    main()
