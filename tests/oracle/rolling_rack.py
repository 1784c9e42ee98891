"""The envelope of a rack rolling on a pitch curve, found numerically from the envelope condition.

The rack's frame at roll `t`: origin where the pitch line's abscissa 0 lies, `u` along the tangent,
`y` outward. A rack point fixed at `(u, y)` moves with the frame; where that motion is along the
rack's own profile, the profile touches the gear. No formula for the contact point is assumed.
"""

from mpmath import cos, diff, findroot, mp, mpf, pi, sin, sqrt, tan


class BasicRack:
    """ISO 53 profile A: pressure angle 20 degrees, 1 m above, 1.25 m below, tip radius 0.38 m."""

    addendum_coefficient = mpf(1)
    dedendum_coefficient = mpf("1.25")
    tip_radius_coefficient = mpf("0.38")

    def __init__(self, module):
        self.module = module
        self.alpha = pi / 9
        self.addendum = self.addendum_coefficient * module
        self.dedendum = self.dedendum_coefficient * module
        self.tip_radius = self.tip_radius_coefficient * module
        # Center of the tip's rounding from the flank's pitch point: `along` into the rack tooth.
        self.depth = self.dedendum - self.tip_radius
        self.along = self.depth * tan(self.alpha) + self.tip_radius / cos(self.alpha)


class RollingRack:
    """A rack rolling on the curve `point(t)` with arc length `arc(t)`, both counter-clockwise."""

    def __init__(self, rack, point, arc):
        self.rack, self.point, self.arc = rack, point, arc

    def frame(self, t):
        dx = diff(lambda v: self.point(v)[0], t)
        dy = diff(lambda v: self.point(v)[1], t)
        size = sqrt(dx * dx + dy * dy)
        return (dx / size, dy / size), (dy / size, -dx / size)

    def place(self, t, u, y):
        """Where rack point (u, y) is when the rack has rolled to `t`."""
        (px, py), along = self.point(t), u - self.arc(t)
        tangent, normal = self.frame(t)
        return px + along * tangent[0] + y * normal[0], py + along * tangent[1] + y * normal[1]

    def motion(self, t, u, y):
        """Its velocity in `t`, as components along the tangent and the normal."""
        # A central difference of step h is wrong by h^2: 40 digits from a step of 20 at 80.
        with mp.workdps(80):
            step = mpf(10) ** -20
            (x0, y0), (x1, y1) = self.place(t - step, u, y), self.place(t + step, u, y)
            vx, vy = (x1 - x0) / (2 * step), (y1 - y0) / (2 * step)
        tangent, normal = self.frame(t)
        return vx * tangent[0] + vy * tangent[1], vx * normal[0] + vy * normal[1]

    def flank(self, pitch_arc, side, y, t):
        """Flank point cut at rack height `y`; `pitch_arc` is where the flank crosses the pitch curve.

        `side` is +1 on the flank of a gear tooth that comes last counter-clockwise, -1 on the first.
        Returns the roll and the point; `t` is a first guess.
        """
        slope = tan(self.rack.alpha)
        u = pitch_arc - side * y * slope

        def across(v):  # motion across the flank, whose direction is (-side tan alpha, 1)
            a, b = self.motion(v, u, y)
            return a + side * slope * b

        root = findroot(across, (t, t + mpf("0.01")), tol=mpf(10) ** -36)
        return root, self.place(root, u, y)

    def fillet(self, pitch_arc, side, beta, t):
        """Fillet point cut by the rounded tip where its normal is `beta` from straight down."""
        rack = self.rack
        u = pitch_arc + side * (rack.along - rack.tip_radius * sin(beta))
        y = -rack.depth - rack.tip_radius * cos(beta)

        def across(v):  # motion along the rounding's normal (-side sin beta, -cos beta)
            a, b = self.motion(v, u, y)
            return side * sin(beta) * a + cos(beta) * b

        root = findroot(across, (t, t + mpf("0.01")), tol=mpf(10) ** -36)
        return root, self.place(root, u, y)


def involute(angle):
    """inv(angle) = tan(angle) - angle."""
    return tan(angle) - angle


def turned(point, angle):
    """A point turned about the origin."""
    x, y = point
    return x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)
