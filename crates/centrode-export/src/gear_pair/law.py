"""Joints by the law of motion; written into each script, so that one file is enough to run it."""

import json

import numpy as np


class Law:
    """Positions of joints over the input's travel, as motion.json describes motion.csv."""

    def __init__(self, folder):
        """Reads both files."""
        about = json.loads((folder / "motion.json").read_text())
        table = np.genfromtxt(folder / about["table"], delimiter=",", names=True)
        self.cycle = about["continuation"]
        self.input = about["input"]
        self.joints = {j["name"]: (table[j["column"]], j["factor"], self.cycle[j["column"]]) for j in about["joints"]}
        self.zero = {j["name"]: j.get("offset", 0.0) for j in about["joints"]}
        self.travel = table[self.input]

    def __call__(self, joint, travel):
        """Position of a joint, linear between rows and repeated beyond them."""
        angles, factor, per_cycle = self.joints[joint]
        whole, rest = np.divmod(travel, self.cycle[self.input])
        return float(factor * (np.interp(rest, self.travel, angles) + whole * per_cycle) + self.zero[joint])
