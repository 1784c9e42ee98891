"""Profile error of a toothed outline, from the law of gearing alone.

A flank point Q cut by a rack of pressure angle alpha lies on a line through the pitch point P(s) at
angle alpha to the tangent T; the flank crosses the pitch curve at arc length s + PQ/cos alpha. Every
point of one flank must give the same crossing, and flanks of one side must be one pitch apart.
"""

import math

import numpy as np


def focal_ellipse(k, perimeter):
    """Arc-length table of the ellipse about its focus: s, point, tangent at many parameters."""
    t = np.linspace(0, 2 * math.pi, 1 << 14, endpoint=False)
    speed = np.sqrt(1 - (k * np.cos(t)) ** 2)
    series = np.fft.rfft(speed)
    mean = series[0].real / t.size
    size = perimeter / (2 * math.pi * mean)

    n = np.arange(1, 40)
    a = 2 * series[1:40].real / t.size
    b = -2 * series[1:40].imag / t.size

    def arc(t):
        waves = (a / n * np.sin(np.multiply.outer(t, n)) + b / n * (1 - np.cos(np.multiply.outer(t, n)))).sum(-1)
        return size * (mean * t + waves)

    def point(t):
        return size * np.stack([k + np.cos(t), math.sqrt(1 - k * k) * np.sin(t)], -1)

    def tangent(t):
        d = np.stack([-np.sin(t), math.sqrt(1 - k * k) * np.cos(t)], -1)
        return d / np.linalg.norm(d, axis=-1, keepdims=True)

    return arc, point, tangent


def crossings(outline, curve, alpha, reach, side):
    """Arc lengths where the flanks through the outline's points cross the pitch curve, and which points."""
    arc, point, tangent = curve
    table = np.linspace(0, 2 * math.pi, 4096, endpoint=False)
    places = point(table)
    nearest = np.array([np.argmin(((places - q) ** 2).sum(-1)) for q in outline])
    t = table[nearest]
    for _ in range(6):  # foot of the normal: (Q - P).T = 0
        step = 1e-6
        miss = ((outline - point(t)) * tangent(t)).sum(-1)
        slope = (((outline - point(t + step)) * tangent(t + step)).sum(-1) - miss) / step
        t = t - miss / slope
    height = ((outline - point(t)) * np.stack([tangent(t)[:, 1], -tangent(t)[:, 0]], -1)).sum(-1)
    flank = np.abs(height) < reach
    q, t = outline[flank], t[flank]

    def off(t):  # distance of Q from the line of action through P(t)
        along = tangent(t)
        normal = np.stack([along[:, 1], -along[:, 0]], -1)
        gap = q - point(t)
        return (gap * (math.sin(alpha) * along - side * math.cos(alpha) * normal)).sum(-1)

    for _ in range(40):
        step = 1e-7
        slope = (off(t + step) - off(t - step)) / (2 * step)
        t = t - np.clip(off(t) / slope, -0.05, 0.05)
    along = tangent(t)
    normal = np.stack([along[:, 1], -along[:, 0]], -1)
    gap = ((q - point(t)) * (math.cos(alpha) * along + side * math.sin(alpha) * normal)).sum(-1)
    good = np.abs(off(t)) < 1e-12 * 1e3
    return arc(t[good]) + gap[good] / math.cos(alpha), np.flatnonzero(flank)[good]


def profile_error(outline, curve, alpha, pitch, reach):
    """Maximum distance, mm along the normal, of points and chord midpoints from true flanks."""
    middle = 0.5 * (outline + np.roll(outline, -1, 0))
    step = np.linalg.norm(np.roll(outline, -1, 0) - outline, axis=-1)
    worst = 0.0
    for points, keep in ((outline, slice(None)), (middle, step < 0.2 * reach)):
        points = points[keep]
        for side in (1, -1):
            s, _ = crossings(points, curve, alpha, reach, side)
            # The other side's flanks give crossings all over: a true side clusters once per pitch.
            turn = s / pitch
            centre = cluster(turn)
            away = (turn - centre + 0.5) % 1 - 0.5
            mine = np.abs(away) < 2e-3
            worst = max(worst, np.ptp(away[mine]) * pitch * math.cos(alpha) / 2)
    return worst


def cluster(turn):
    """Where, within one pitch, most of the crossings lie."""
    counts, edges = np.histogram(turn % 1, bins=2000, range=(0, 1))
    best = np.argmax(counts + np.roll(counts, 1) + np.roll(counts, -1))
    near = (turn - edges[best] + 0.5) % 1 - 0.5
    return edges[best] + np.median(near[np.abs(near) < 2e-3])
