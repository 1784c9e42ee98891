"""Joints by the laws of motion; written into each script, so that one file is enough to run it."""

import json

import numpy as np


class Law:
    """Positions and rates of joints over the travel of the input, as motion.json describes motion.csv."""

    def __init__(self, folder):
        """Reads both files."""
        self.about = json.loads((folder / "motion.json").read_text())
        self.table = np.genfromtxt(folder / self.about["table"], delimiter=",", names=True, deletechars="")
        # Lists: single values are read from them faster than from arrays.
        self.values = {name: self.table[name].tolist() for name in self.table.dtype.names}
        self.period = self.about["input"]["period_rad"]
        self.speed = self.about["input"]["speed_rad_per_s"]
        self.step = self.period / (self.about["rows"] - 1)
        self.joints = {joint["name"]: joint for joint in self.about["joints"]}
        self.advance = {column["name"]: column["advance"] for column in self.about["columns"]}

    def row(self, travel):
        """Whole periods behind a travel, the row before it, and the share of the step after that."""
        whole, rest = divmod(travel, self.period)
        row = min(int(rest / self.step), self.about["rows"] - 2)
        return whole, row, rest / self.step - row

    def read(self, joint, travel):
        """Position and rate of a joint by cubic Hermite; rad or m, by rad of the input."""
        about, advance = self.joints[joint], self.advance[self.joints[joint]["column"]]
        whole, row, x = self.row(travel)
        h, factor = self.step, about["factor"]
        a, b = (factor * value for value in self.values[about["column"]][row : row + 2])
        if about["rate"] is None:
            va = vb = factor * advance / self.period
        else:
            va, vb = (about["rate_factor"] * value for value in self.values[about["rate"]][row : row + 2])
        place = (1 + 2 * x) * (1 - x) ** 2 * a + x * x * (3 - 2 * x) * b + h * x * (1 - x) * ((1 - x) * va - x * vb)
        rate = 6 * x * (1 - x) * (b - a) / h + (1 - x) * (1 - 3 * x) * va + x * (3 * x - 2) * vb
        return place + whole * factor * advance + about["offset"], rate

    def row_of(self, joint, travel):
        """Position of a joint as the row next to a travel has it, with nothing read between rows."""
        about, count = self.joints[joint], self.about["rows"] - 1
        whole, row = divmod(round(travel / self.step), count)
        place = self.values[about["column"]][row] + whole * self.advance[about["column"]]
        return about["factor"] * place + about["offset"]

    def __call__(self, joint, travel):
        """Position of a joint, rad or m."""
        return self.read(joint, travel)[0]

    def rate(self, joint, travel):
        """Rate of a joint by the input, rad/rad or m/rad."""
        return self.read(joint, travel)[1]

    def value(self, column, travel):
        """A column, by straight lines between rows."""
        whole, row, x = self.row(travel)
        a, b = self.values[column][row : row + 2]
        return a + (b - a) * x + whole * self.advance[column]

    def travel(self, joint, position, near):
        """Travel, nearest to one, at which a joint that never turns back has a position; by its cubics."""
        sense = self.advance[self.joints[joint]["column"]] * self.joints[joint]["factor"]
        low, high = near - 0.1 * self.period, near + 0.1 * self.period
        for _ in range(60):
            place, rate = self.read(joint, near)
            off = place - position
            low, high = (low, near) if off * sense > 0 else (near, high)
            step = off / rate
            if abs(step) < 1e-12:
                return near - step
            near = near - step if low < near - step < high else 0.5 * (low + high)
        return near

    def check(self, place):
        """Greatest distance, m, of the points from their columns, by a function from a point to its place in a pose."""
        off = 0.0
        for point in self.about["points"]:
            columns = [self.table[column] for column in point["columns"]]
            for travel, *path in zip(self.table[self.about["input"]["column"]], *columns, strict=True):
                found = place(point, travel)[: len(path)]
                off = max(off, float(np.linalg.norm(found - 1e-3 * np.array(path))))
        return off
