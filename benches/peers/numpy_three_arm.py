"""Figures of many three-arm mechanisms at once, in NumPy: as fast as whole-array arithmetic gets them.

A block of designs is one array: the sun's closed quadratic B-spline in the plane of polar angle and radius, the
centre distance by Newton's method for all designs together, and both stages read out of a table of the transmission
function, with its exact slope, by cubics. Knows nothing of centrode.
"""

from dataclasses import dataclass

import numpy as np

PANELS = 16
"""Parts of each polynomial piece of the pitch curve: the table's width."""
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(3)


@dataclass(frozen=True)
class Machine:
    """What all designs of a block share; angles in rad, lengths in mm. The carrier turns clockwise."""

    carrier_start: float
    bend: float
    mounting: float
    tip_distance: float
    pusher_offset: float
    picking: float
    planting: float
    planting_depth: float
    housing_offset: float
    teeth: int


class Block:
    """So many inputs of so many designs at a time; everything that does not hang on the design is laid out once."""

    def __init__(self, machine: Machine, inputs: int) -> None:
        self.machine, self.inputs = machine, inputs
        theta = np.linspace(0, 2 * np.pi, inputs, endpoint=False)
        # The bend's reference, picking and planting are read with the path.
        self.theta = np.concatenate([theta, [abs(machine.bend), machine.picking, machine.planting]])
        edge = np.arange(PANELS) / PANELS
        self.edges = _basis(edge)
        self.quadrature = _basis((edge[:, None] + (0.5 + 0.5 * _NODES) / PANELS).ravel())
        carrier = machine.carrier_start - theta + 0.5 * machine.bend
        self.leg = 2 * np.cos(0.5 * machine.bend) * np.array([np.cos(carrier), np.sin(carrier)])

    def figures(self, angle: np.ndarray, radius: np.ndarray) -> dict[str, np.ndarray]:
        """Figures by name of designs given by rows of control points."""
        machine, (count, _) = self.machine, angle.shape
        around = [np.roll(angle, 1, 1), angle, np.roll(angle, -1, 1)]
        around[0][:, 0] -= 2 * np.pi
        around[2][:, -1] += 2 * np.pi
        angles = np.stack(around, 2)
        radii = np.stack([np.roll(radius, 1, 1), radius, np.roll(radius, -1, 1)], 2)
        # Quadrature points: (design, panel, node), and the angle's and radius' slopes by panel.
        slope, r = angles @ self.quadrature[1], radii @ self.quadrature[0]
        shape = (count, -1, len(_NODES))
        slope, r = slope.reshape(shape), r.reshape(shape)
        dr = (radii @ self.quadrature[1]).reshape(shape)
        weights = 0.5 * _WEIGHTS / PANELS
        length = np.sqrt((r * slope) ** 2 + dr**2).reshape(count, -1) @ np.tile(weights, r.shape[1])
        most, least = _extremes(radii)
        a = self._center_distance(slope * weights, r, most)
        distance = a[:, None]
        # Transmission function at the panels' edges.
        driven = ((slope * weights * r) / (distance[..., None] - r)).sum(2).cumsum(1)
        driven = np.concatenate([np.zeros((count, 1)), driven], 1)
        phi = (angles @ self.edges[0]).reshape(count, -1)
        rate = (angles @ self.edges[1]).reshape(count, -1)
        r = (radii @ self.edges[0]).reshape(count, -1)
        pull = rate * r / (distance - r)
        table = _Table(phi, driven, rate, pull)
        # Reckoned from the polar angle zero.
        zero = table.driven(np.zeros((count, 1)))
        met = table.driven(np.broadcast_to(-self.theta, (count, self.theta.size))) - zero
        chi = table.polar(np.concatenate([np.zeros((count, 1)), met], 1) - machine.bend - np.pi + zero)
        bent = machine.carrier_start + machine.bend
        # At the input |bend| the sun's body has met the intermediate gear by the reference.
        reference = -met[:, self.inputs]
        arm = bent - self.theta - reference[:, None] + chi[:, :1] - chi[:, 1:]
        tip = arm[:, : self.inputs] + machine.mounting
        y = distance * self.leg[1] + machine.tip_distance * np.sin(tip)
        top, bottom = _crest(y), -_crest(-y)
        clamp = machine.mounting + np.arcsin(machine.pusher_offset / machine.tip_distance)
        at_work = np.remainder(arm[:, self.inputs + 1 :] + clamp + np.pi, 2 * np.pi) - np.pi
        pick, push = at_work[:, 0], -at_work[:, 1]
        planet = 2 * a * np.cos(0.5 * machine.bend) + most
        swept = np.maximum(np.maximum(most, 2 * a - least), planet)
        ground = bottom + machine.planting_depth
        return {
            "center-distance": a,
            "pick-angle": pick,
            "push-angle": push,
            "angle-difference": pick + push,
            "gearbox-clearance": -swept - machine.housing_offset - ground,
            "trajectory-height": top - bottom,
            "module": length / (np.pi * machine.teeth),
        }

    @staticmethod
    def _center_distance(weight: np.ndarray, r: np.ndarray, most: np.ndarray) -> np.ndarray:
        """Where the driven curve closes after one turn, between the maximum radius and three times it.

        A bisection brings Newton's method near: the integral falls steeply close to the maximum radius.
        """
        count = len(r)
        weight, r = weight.reshape(count, -1), r.reshape(count, -1)
        low, high = most * (1 + 1e-9), 3 * most
        for _ in range(6):
            a = 0.5 * (low + high)
            short = (weight * r / (a[:, None] - r)).sum(1) > 2 * np.pi
            low, high = np.where(short, a, low), np.where(short, high, a)
        a = 0.5 * (low + high)
        for _ in range(12):
            share = weight * r / (a[:, None] - r)
            miss = share.sum(1) - 2 * np.pi
            step = miss / (share / (a[:, None] - r)).sum(1)
            a = np.clip(a + step, low, high)
            if np.abs(step).max() < 1e-12 * a.max():
                break
        return a


class _Table:
    """The transmission function of each design, by the spline's parameter: polar angle and driven angle."""

    def __init__(self, phi, driven, rate, pull):
        count, self.width = phi.shape
        self.start = phi[:, :1]
        self.turn = driven[:, :1], driven[:, -1:]
        whole = 2 * np.pi
        phi = np.concatenate([phi, phi[:, :1] + whole], 1)
        rate = np.concatenate([rate, rate[:, :1]], 1) / PANELS
        pull = np.concatenate([pull, pull[:, :1]], 1) / PANELS
        # Rows one behind the other, so that one search serves all designs.
        self.apart = 8.0 * np.arange(count)[:, None]
        self.offset = (self.width + 1) * np.arange(count)[:, None]
        self.phi, self.f = (phi.ravel(), rate.ravel()), (driven.ravel(), pull.ravel())
        self.by_phi = (phi - self.start + self.apart).ravel()
        self.by_driven = (driven + self.apart).ravel()

    def driven(self, phi):
        """Driven angle from the table's start at polar angles."""
        turns = np.floor((phi - self.start) / (2 * np.pi))
        within = phi - self.start - 2 * np.pi * turns
        return self._read(within, self.by_phi, self.phi, self.f, self.start) + 2 * np.pi * turns

    def polar(self, driven):
        """Polar angle at driven angles from the table's start."""
        turns = np.floor(driven / (2 * np.pi))
        within = driven - 2 * np.pi * turns
        return self._read(within, self.by_driven, self.f, self.phi, 0.0) + 2 * np.pi * turns

    def _read(self, at, ordered, given, wanted, start):
        """`wanted` where `given` is `at`: both are cubics of the parameter, the first is solved by Newton's method."""
        cell = np.searchsorted(ordered, (at + self.apart).ravel(), side="right").reshape(at.shape) - 1
        cell = np.clip(cell, self.offset, self.offset + self.width - 1)
        value, rate = given
        at = at + start
        # Cubic of the given angle on the cell, in powers of the share of it.
        first, slope, last, end = value[cell], rate[cell], value[cell + 1], rate[cell + 1]
        rise = last - first
        square, cube = 3 * rise - 2 * slope - end, slope + end - 2 * rise
        t = (at - first) / rise
        for _ in range(2):
            miss = first + t * (slope + t * (square + t * cube)) - at
            t -= miss / (slope + t * (2 * square + 3 * t * cube))
        value, rate = wanted
        first, slope, last, end = value[cell], rate[cell], value[cell + 1], rate[cell + 1]
        rise = last - first
        return first + t * (slope + t * (3 * rise - 2 * slope - end + t * (slope + end - 2 * rise)))


def _basis(t):
    """Values and slopes of the three uniform quadratic B-splines that make a piece, (3, N) each."""
    value = 0.5 * np.array([(1 - t) ** 2, 1 + 2 * t * (1 - t), t**2])
    return value, np.array([t - 1, 1 - 2 * t, t])


def _extremes(radii):
    """Maximum and minimum radius of each design: at the pieces' ends, and where a piece has its vertex."""
    before, middle, after = np.moveaxis(radii, 2, 0)
    bend, slope = before - 2 * middle + after, middle - before
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.where(bend == 0, 0.0, -slope / bend)
    t = np.clip(t, 0.0, 1.0)
    vertex = 0.5 * (before + middle) + t * (slope + 0.5 * bend * t)
    start = 0.5 * (before + middle)
    return np.maximum(vertex, start).max(1), np.minimum(vertex, start).min(1)


def _crest(y):
    """Maximum value of a periodic curve: the quartic's crest through the five samples around the maximum."""
    row, best = np.arange(len(y)), y.argmax(1)
    a, b, c, d, e = (y[row, (best + k) % y.shape[1]] for k in (-2, -1, 0, 1, 2))
    one, two = (8 * (d - b) - (e - a)) / 12, (16 * (b + d) - (a + e) - 30 * c) / 24
    three, four = ((e - a) - 2 * (d - b)) / 12, ((a + e) - 4 * (b + d) + 6 * c) / 24
    t = -one / (2 * two)
    for _ in range(2):
        t -= (one + t * (2 * two + t * (3 * three + 4 * t * four))) / (2 * two + t * (6 * three + 12 * t * four))
    return c + t * (one + t * (two + t * (three + t * four)))
