"""Runs centrode and its peers on the same cases and prints one table of ratios."""

import argparse
import math
import os
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import centrode as ct
import ezdxf
import flanks
from timing import best, seconds, times

ALPHA = math.radians(20)
K = 1 / (2 + math.sqrt(3))


@dataclass
class Case:
    """One pair, as each tool wants it."""

    name: str
    module: float
    teeth: int
    pitch: Callable[[], ct.Pitch]
    toml: str
    peer: dict
    mean_ratio: tuple[int, int] = (1, 1)
    eccentricity: float | None = None


CASES = [
    Case(
        "2018 ellipse, z 23",
        2.25,
        23,
        lambda: ct.pitch.ellipse(eccentricity=K, module=2.25, tooth_count=23),
        f'[pitch]\nkind = "ellipse"\neccentricity = {K!r}\nmodule = 2.25\ntooth_count = 23\n',
        {"centrode": f"1/(1-{K!r}*cos(phi))"},
        eccentricity=K,
    ),
    Case(
        "law, two lobes, z 24",
        1.5,
        24,
        lambda: ct.pitch.from_transmission("phi - 0.08*sin(2*phi)", module=1.5, tooth_count=24),
        '[pitch]\nkind = "transmission"\nexpression = "phi - 0.08*sin(2*phi)"\nmodule = 1.5\ntooth_count = 24\n',
        {"law": "phi - 0.08*sin(2*phi)"},
    ),
    Case(
        "radius, two lobes, z 20",
        1.0,
        20,
        lambda: ct.pitch.polar("1 + 0.08*cos(2*phi)", module=1.0, tooth_count=20),
        '[pitch]\nkind = "polar"\nexpression = "1 + 0.08*cos(2*phi)"\nmodule = 1.0\ntooth_count = 20\n',
        {"centrode": "1 + 0.08*cos(2*phi)"},
    ),
    Case(
        "five lobes 2:5, z 100",
        1.0,
        100,
        lambda: ct.pitch.polar("1 + 0.08*cos(5*phi)", module=1.0, tooth_count=100),
        'mean_ratio = [2, 5]\n[pitch]\nkind = "polar"\nexpression = "1 + 0.08*cos(5*phi)"\n'
        "module = 1.0\ntooth_count = 100\n",
        {"centrode": "1 + 0.08*cos(5*phi)", "advance": 5 * math.pi},
        mean_ratio=(2, 5),
    ),
]


def peer_pair(case, folder):
    import ncgears

    keywords = {
        "teeth": case.teeth,
        "module": case.module,
        "dedendum_factor": 1.25,
        "fillet_factor": 0.38,
        "output_directory": folder,
    }
    if "law" in case.peer:
        return ncgears.generate(case.peer["law"], **keywords)
    advance = case.peer.get("advance", 2 * math.pi)
    return ncgears.generate_from_centrode(case.peer["centrode"], target_cycle_delta=advance, **keywords)


def peer_command(case, folder):
    command = ["ncgears", "--teeth", str(case.teeth), "--module", str(case.module)]
    if "centrode" in case.peer:
        command.append("--centrode")
    if "advance" in case.peer:
        command += ["--cycle-delta", repr(case.peer["advance"])]
    command += [case.peer.get("centrode") or case.peer["law"], "--output", folder, "--dxf", f"{folder}/pair.dxf"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def our_pair(case):
    pair = ct.GearPair(case.pitch(), mean_ratio=case.mean_ratio)
    return pair, pair.check()


def our_command(case, folder):
    design, out = Path(folder, "pair.toml"), Path(folder, "out")
    design.write_text('family = "gear-pair"\n' + case.toml)
    command = [os.environ["CENTRODE_BIN"], "export", design, "--to", out, "--format", "dxf,svg,stl,csv,urdf"]
    done = subprocess.run([*command, "--tolerance", "0.001"], stdout=subprocess.DEVNULL)
    # Status 1: the files are written, and the check has found an error.
    if done.returncode not in (0, 1):
        done.check_returncode()
    return out


def vertices(path):
    """Most vertices of one closed polyline in a DXF."""
    lines = ezdxf.readfile(path).modelspace().query("LWPOLYLINE POLYLINE")
    return max(len(line) for line in lines)


def profile(case, outline):
    if case.eccentricity is None:
        return None
    length = math.pi * case.module * case.teeth
    curve = flanks.focal_ellipse(case.eccentricity, length)
    return flanks.profile_error(outline, curve, ALPHA, length / case.teeth, 0.5 * case.module)


def number(value):
    """As a table shows it: counts in full, measured figures to two digits."""
    if value is None:
        return "-"
    return str(value) if isinstance(value, int) else f"{value:.1e}"


def compare(case, alone):
    with tempfile.TemporaryDirectory() as folder:
        ours, (our, report) = best(lambda: our_pair(case))
        our_whole, out = best(lambda: our_command(case, folder))
        # The profile of the finer outline takes a minute.
        outline = our.driver.outline(tolerance=1e-4 if alone else 1e-7)
        mine = {
            "generate + prove": ours,
            "whole command to files": our_whole,
            "points / arcs per gear in DXF": max(vertices(out / f"{gear}.dxf") for gear in ("driver", "driven")),
            "points of its outline": len(outline),
            "transmission error, rad": report.values["transmission_error_max"],
            "profile error, mm": profile(case, outline),
            "errors of the check": sum(finding.severity == "error" for finding in report.findings),
        }
        theirs = {} if alone else peer_figures(case, our, folder)
    show(case.name, "ncgears", mine, theirs)


def peer_figures(case, our, folder):
    """The same figures of the peer's pair, which must be ours."""
    took, pair = best(lambda: peer_pair(case, folder), least=2, span=0)
    whole, _ = best(lambda: peer_command(case, folder), least=1, span=0)
    assert math.isclose(pair.center_distance, our.center_distance, rel_tol=1e-9), "not the same pair"
    return {
        "generate + prove": took,
        "whole command to files": whole,
        "points / arcs per gear in DXF": vertices(f"{folder}/pair.dxf"),
        "points of its outline": len(pair.drive_outline),
        "transmission error, rad": pair.maximum_transmission_error,
        "profile error, mm": profile(case, pair.drive_outline),
    }


def circular(alone):
    module, teeth = 2.25, 23
    pitch = ct.pitch.circle(module=module, tooth_count=teeth)
    generate, pair = best(lambda: ct.GearPair(pitch))
    prove, _ = best(lambda: ct.GearPair(pitch).check())
    mine = {
        "generate (ours: both gears)": generate,
        "generate + prove": prove,
        "edges / segments per gear": len(pair.driver.outline(tolerance=1e-3)),
    }
    theirs = {}
    if not alone:
        from py_gearworks import SpurGear

        took, wire = best(lambda: SpurGear(teeth, module=module).build_boundary_wire())
        theirs = {"generate (ours: both gears)": took, "edges / segments per gear": len(wire.edges())}
    show("circle, z 23", "py_gearworks", mine, theirs)


def show(name, peer, mine, theirs):
    """A table of figures by name, those of time with the ratio of theirs to ours."""
    print(f"\n{name:28} {peer:>14} {'centrode':>14} {'ratio':>10}", flush=True)
    for what, our in mine.items():
        their = theirs.get(what)
        timed = what.startswith(("generate", "whole"))
        shown = seconds if timed else number
        ratio = times(their, our) if timed and their is not None else "-"
        print(f"  {what:26} {shown(their):>14} {shown(our):>14} {ratio:>10}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="the 2018 pair and one circular gear")
    parser.add_argument("--alone", action="store_true", help="centrode without the peers, its outline coarse")
    options = parser.parse_args()
    for case in CASES[:1] if options.quick else CASES:
        compare(case, options.alone)
    circular(options.alone)


if __name__ == "__main__":
    main()
