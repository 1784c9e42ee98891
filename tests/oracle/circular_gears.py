"""Circular gears cut by the ISO 53 A rack: exact involute, tip-radius trochoid and undercut."""

from figures import write
from mpmath import acos, atan2, cos, diff, findroot, mp, mpf, pi, quad, sin, sqrt, tan
from rolling_rack import BasicRack, RollingRack, involute


def half_angle_of_flank(radius, base, tooth_count):
    """Half the angle of a tooth at a radius, on the involute."""
    return pi / (2 * tooth_count) + involute(pi / 9) - involute(acos(base / radius))


def case(tooth_count, module):
    module = mpf(module)
    rack = BasicRack(module)
    pitch_radius = module * tooth_count / 2
    base, tip = pitch_radius * cos(rack.alpha), pitch_radius + rack.addendum
    root = pitch_radius - rack.dedendum
    roll = RollingRack(
        rack,
        lambda t: (pitch_radius * cos(t), pitch_radius * sin(t)),
        lambda t: pitch_radius * t,
    )
    flank_arc = pi * module / 4  # the tooth is centered on the x axis

    def trochoid(beta):
        guess = (flank_arc + rack.along + rack.depth * tan(beta)) / pitch_radius
        x, y = roll.fillet(flank_arc, 1, beta, guess)[1]
        return sqrt(x * x + y * y), atan2(y, x)

    def overshoot(beta):
        """Trochoid angle beyond the involute at the same radius: positive outside the tooth."""
        radius, angle = trochoid(beta)
        return angle - half_angle_of_flank(radius, base, tooth_count)

    # The rack's straight flank ends where its rounding begins; it cuts the involute down to there.
    end = -rack.depth - rack.tip_radius * sin(rack.alpha)
    foot = -end / (sin(rack.alpha) * cos(rack.alpha))  # roll from that contact to the pitch point
    undercut = foot * cos(rack.alpha) > base * tan(rack.alpha)
    if undercut:
        # Between the base circle and the rounding's end the trochoid comes out through the involute.
        high = pi / 2 - rack.alpha
        above_base = findroot(lambda b: trochoid(b)[0] - base, (high / 2, high), solver="anderson", tol=mpf(10) ** -60)
        above_base += mpf(10) ** -25
        assert overshoot(above_base) < 0 < overshoot(high)
        join_beta = findroot(overshoot, (above_base, high), solver="anderson", tol=mpf(10) ** -50)
    else:
        join_beta = pi / 2 - rack.alpha
        assert abs(overshoot(join_beta)) < mpf(10) ** -20
    join, _ = trochoid(join_beta)

    flank = [
        [r, half_angle_of_flank(r, base, tooth_count)] for r in (join + (tip - join) * mpf(i) / 12 for i in range(13))
    ]
    fillet = [list(trochoid(join_beta * mpf(i) / 12)) for i in range(13)]
    tip_angle = flank[-1][1]

    def swept(beta):
        radius, _ = trochoid(beta)
        return radius**2 / 2 * diff(lambda b: trochoid(b)[1], beta, h=mpf(10) ** -10)

    land = trochoid(mpf(0))[1]
    with mp.workdps(24):
        under_fillet = -quad(swept, [0, join_beta])
    area = (
        2
        * tooth_count
        * (
            tip**2 / 2 * tip_angle
            + quad(lambda r: r / 2 * tan(acos(base / r)), [join, tip])
            + under_fillet
            + root**2 / 2 * (pi / tooth_count - land)
        )
    )
    assert abs(fillet[0][0] - root) < mpf(10) ** -20
    return {
        "tooth_count": tooth_count,
        "module": module,
        "pitch_radius": pitch_radius,
        "base_radius": base,
        "tip_radius": tip,
        "root_radius": root,
        "undercut": bool(undercut),
        "join_radius": join,
        "tip_half_angle": tip_angle,
        "root_half_angle": land,
        "area": area,
        "flank": flank,
        "fillet": fillet,
    }


if __name__ == "__main__":
    write(
        "circular_gears",
        """ISO 53 A rack (20 degrees, 1, 1.25, 0.38), no profile shift, no backlash. mm, rad.
flank, fillet: rows of radius and angle from the tooth's center line; flank from where it meets the fillet to the
  tip, fillet from the root circle to there. With undercut the two cross there, else they are tangent.
area: the whole gear's profile, mm^2.""",
        [case(23, "2.25"), case(12, "2"), case(17, "1"), case(18, "1"), case(40, "1.5")],
    )
