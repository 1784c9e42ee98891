"""Certificates of `centrode prove`, read by `tools/proof_checker.py`, which shares no code with them."""

import copy
import json
import math
import re
import subprocess
import sys
from itertools import pairwise
from types import SimpleNamespace

import centrode as ct
import flint
import jsonschema
import pytest
import shapely
from conftest import ROOT
from shapely import affinity

sys.path.insert(0, str(ROOT / "tools"))
import proof_checker
from proof import floats
from proof.balls import TERMS
from proof.box import Box
from proof.contour import Contour

DESIGNS = ROOT / "tests" / "designs"
CHECKER = ROOT / "tools" / "proof_checker.py"

DESIGN = """
family = "gear-pair"

[pitch]
kind = "limacon"
mean_radius = 16
amplitude = 0.5
lobes = 1
module = 2
tooth_count = 16

[teeth]
backlash = {backlash}

[tool]
kind = "rack"
pressure_angle_deg = 25
tip_radius_coefficient = 0.3
"""


def checked(*arguments):
    """The answer of the checker: its exit status and output."""
    done = subprocess.run([sys.executable, CHECKER, *arguments], capture_output=True, text=True, check=False)
    assert done.stderr == "", done.stderr
    return done.returncode, done.stdout


@pytest.fixture(scope="module")
def design(tmp_path_factory):
    file = tmp_path_factory.mktemp("proof") / "pair.toml"
    file.write_text(DESIGN.format(backlash=0.04))
    return file


@pytest.fixture(scope="module")
def file(design, run):
    path = design.with_suffix(".proof")
    run("prove", design, "-o", path)
    return path


@pytest.fixture
def proof(file):
    return json.loads(file.read_text())


def test_the_checker_accepts_the_proof_of_a_pair(file, design):
    status, answer = checked(file, design)
    assert status == 0, answer
    assert answer.startswith("proved: ")
    # Pushed on and back the driven gear stands half of its backlash to either side of the law.
    assert "each error at every angle within 8.0e-10 rad" in answer


@pytest.mark.parametrize("module", [1e-6, 1e6])
def test_the_proof_of_a_pair_of_any_size_is_accepted(module, run, tmp_path):
    design, path = tmp_path / "pair.toml", tmp_path / "pair.proof"
    design.write_text(f'family = "gear-pair"\npitch = {{ kind = "circle", module = {module}, tooth_count = 24 }}\n')
    run("prove", design, "-o", path)
    status, answer = checked(path, design)
    assert status == 0, answer


@pytest.fixture(scope="module")
def round_file(tmp_path_factory, run):
    path = tmp_path_factory.mktemp("round") / "pair.proof"
    run("prove", ROOT / "tests" / "designs" / "circular-pair.toml", "-o", path)
    return path


def test_a_sector_stands_for_all_where_contours_and_law_repeat(round_file):
    # 24 on 36 teeth: one pitch of 72 in the cycle of three turns.
    proof = json.loads(round_file.read_text())
    assert proof["sectors"] == 72
    assert proof["stretches"][-1]["to"] == proof["cycle"] / 72
    status, answer = checked(round_file)
    assert status == 0, answer
    assert "at every angle of 3 turns of the driver" in answer


def test_a_defect_in_another_sector_is_found(round_file, tmp_path):
    proof = json.loads(round_file.read_text())
    piece = proof["driven"][len(proof["driven"]) // 2]
    for power, share in ((0, 1), (2, -2), (4, 1)):
        piece[power][0] += share * 1e-6
    path = tmp_path / "spoilt.proof"
    path.write_text(json.dumps(proof))
    status, answer = checked(path)
    assert status == 1
    assert "from sector to sector" in answer


def test_seats_that_touch_at_a_turning_place_are_not_taken_to_cross(monkeypatch):
    width = flint.arb(4e-10)
    monkeypatch.setattr(proof_checker, "PAIR", SimpleNamespace(width=width))
    # From 0, where it turns, to 4e-6.
    values = proof_checker.spread(flint.arb_poly([1e-6, 2e-6, 1e-6]))
    assert -width / 8 < values.lower() <= 0
    assert 4e-6 <= values.upper() < 4e-6 + width / 8


def along_a_piece(piece, beside):
    """Contour of a piece and two straight ones by way of a point next to it."""
    start, stop = (sum(c * end**k for k, c in enumerate(piece)) for end in (-1, 1))
    lines = [[(a + b) / 2, (b - a) / 2] for a, b in pairwise((stop, beside, start))]
    return Contour([[(c.real, c.imag) for c in map(complex, p)] for p in (piece, *lines)], "gear")


def test_parts_that_meet_are_not_taken_to_lie_on_either_side_of_a_strip():
    # The driven gear turns by t^2 / 2 on an axis 8 mm away, so that the middle of its turn is longer than one.
    turns = [Box.turning(None, flint.arb_poly(angle), radius) for angle, radius in (([0], 8), ([0, 0, 0.5], 1))]
    series = [[near[k] for k in range(TERMS)] + [far[TERMS]] for near, far in turns]
    motion = floats.Motion(*series, 2.0, 1e-12)
    assert abs(motion.b) > 1.02
    along = motion.b / abs(motion.b)
    # A bulge of 20 mm that ends where the point of the driven gear is at t = 0.
    piece = [9 - along - 20j * along, along, 20j * along]
    driver = along_a_piece(piece, 9 + 10j * along).part(0, -1.0, 1.0)
    driven = along_a_piece([1, 0.001], 1 + 0.001j).part(0, -1.0, 1.0)
    box = SimpleNamespace(between=motion)
    assert not Box.is_beside(box, driver, driven, motion.reach(driven.centre), 1.0, 0.0)
    # Moved off by more than the strip is thick it is next to it.
    moved = [piece[0] - 60j * along, *piece[1:]]
    driver = along_a_piece(moved, 9 - 50j * along).part(0, -1.0, 1.0)
    assert Box.is_beside(box, driver, driven, motion.reach(driven.centre), 1.0, 0.0)


def test_a_part_that_all_but_stands_still_has_no_strip():
    contour = along_a_piece([1, 5e-324 * (1 + 1j), 1e-9, 1e-9], 1 + 1j)
    assert contour.part(0, -1.0, 1.0).along is None
    assert contour.part(1, -1.0, 1.0).along is not None


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("module", 2.0),
        ("law_rounding", 1e-15),
        ("law_rounding", 0),
        ("tooth_count", 16),
        ("Driver", []),
        ("driver ", []),
        ("", 1),
        ("comment", "checked by hand"),
        ("certified", True),
        ("format2", None),
    ],
)
def test_a_key_that_nothing_checks_is_rejected(key, value, proof, tmp_path):
    path = tmp_path / "more.proof"
    path.write_text(json.dumps({**proof, key: value}))
    assert checked(path) == (1, f"rejected: the file has the key {key!r}, which nothing checks\n")


def test_a_file_holds_what_the_checker_knows_and_no_more(proof):
    assert set(proof) == proof_checker.KEYS


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("format", "proof"),
        ("version", 2),
        ("center_distance", 32.001),
        ("center_distance", 0),
        ("cycle", 6.2831),
        ("half_width", 1e-2),
        ("half_width", 0),
        ("sectors", 2),
        ("stretches", []),
        ("driver", []),
        ("driven", []),
        ("law", {}),
    ],
)
def test_a_wrong_value_of_a_key_is_rejected(key, value, proof, tmp_path):
    path = tmp_path / "other.proof"
    assert proof[key] != value
    path.write_text(json.dumps({**proof, key: value}))
    status, answer = checked(path)
    assert (status, answer[:10]) == (1, "rejected: ")


def test_a_proof_is_of_one_design(file, design):
    other = design.with_name("other.toml")
    other.write_text(DESIGN.format(backlash=0.05))
    assert checked(file, other) == (1, "rejected: the proof is of another design\n")


def test_the_file_keeps_its_schema_and_its_bytes(file, design, run, proof):
    jsonschema.validate(proof, json.loads(run("schema", "proof").stdout))
    assert proof["design"] == design.read_text()
    again = file.with_name("again.proof")
    run("prove", design, "-o", again)
    assert again.read_bytes() == file.read_bytes()


def test_the_prover_keeps_off_the_design(design, run):
    done = run("prove", design, "-o", design, check=False)
    assert done.returncode == 2
    assert "is the design" in done.stderr


@pytest.mark.parametrize("name", ["spiral-shaft-2018", "jansen-leg", "feeder-2022"])
def test_a_machine_without_gears_that_mesh_all_along_has_no_proof(name, run, tmp_path):
    done = run("prove", DESIGNS / f"{name}.toml", "-o", tmp_path / "x.proof", check=False)
    assert done.returncode == 2
    assert "none of its gear pairs is in mesh over the whole cycle" in done.stderr
    assert not (tmp_path / "x.proof").exists()


def test_each_pair_of_a_machine_gets_a_file(run, tmp_path):
    design = DESIGNS / "two-stage.toml"
    done = run("prove", design, "-o", tmp_path / "train.proof")
    files = [tmp_path / f"train-{name}.proof" for name in ("first", "second")]
    assert done.stdout.split() == [str(file) for file in files]
    proofs = [json.loads(file.read_text()) for file in files]
    assert [proof["pair"] for proof in proofs] == ["first", "second"]
    assert {proof["design"] for proof in proofs} == {design.read_text()}
    assert proofs[0]["driver"] != proofs[1]["driver"]


def test_the_proof_of_a_pair_of_a_machine_is_accepted(run, tmp_path):
    design, file = DESIGNS / "index-table.toml", tmp_path / "advance.proof"
    run("prove", design, "--pair", "advance", "-o", file)
    status, answer = checked(file, design)
    assert status == 0, answer
    assert answer.startswith("proved: the contours in the file hold each other at every angle of ")
    assert "errors are relative to the law in the file\n" in answer


def test_a_pair_that_is_not_there_is_told(run, tmp_path):
    done = run("prove", DESIGNS / "two-stage.toml", "--pair", "third", "-o", tmp_path / "x.proof", check=False)
    assert done.returncode == 2
    assert done.stderr == 'error: there is no pair "third"; there are first, second\n'
    assert not list(tmp_path.iterdir())


def test_python_proves_a_pair_of_a_machine(run, tmp_path):
    machine = ct.load(DESIGNS / "two-stage.toml")
    with pytest.raises(ct.MechanismError, match="several pairs: name one of first, second"):
        machine.prove(tmp_path / "x.proof")
    path = machine.prove(tmp_path / "x.proof", pair="second")
    run("prove", DESIGNS / "two-stage.toml", "--pair", "second", "-o", tmp_path / "y.proof")
    mine, other = (json.loads(p.read_text()) for p in (path, tmp_path / "y.proof"))
    assert mine.pop("design") == machine.to_toml()
    del other["design"]
    assert mine == other
    with pytest.raises(ct.MechanismError, match='no pair "third"'):
        machine.prove(tmp_path / "x.proof", pair="third")


def free(pair, phi, turns):
    """Ranges of turns off the law's driven angle in which the outlines do not overlap, by polygons."""
    driver, driven = (shapely.Polygon(gear.outline(1e-4)) for gear in (pair.driver, pair.driven))
    shapely.prepare(driver)
    law, out, was = pair.driven_angle(phi), [], False
    for turn in turns:
        angle = phi + law + turn
        cos, sin = math.cos(angle), math.sin(angle)
        axis = pair.center_distance * math.cos(phi), pair.center_distance * math.sin(phi)
        is_free = not driver.intersects(affinity.affine_transform(driven, [cos, -sin, sin, cos, *axis]))
        if is_free and not was:
            out.append([turn, turn])
        elif is_free:
            out[-1][1] = turn
        was = is_free
    return out


def test_teeth_that_meet_in_the_play_are_told_before_a_file_is_written(run, tmp_path):
    design = DESIGNS / "transplanter-pair-2021.toml"
    done = run("prove", design, "-o", tmp_path / "x.proof", check=False)
    assert done.returncode == 2
    assert not (tmp_path / "x.proof").exists()
    told = re.search(
        r"angle (\S+) rad the driven gear, pushed forward, jumps by (\S+) rad: driver tooth 22 hits driven tooth 21 "
        r"within the backlash, at \((\S+), (\S+)\) mm",
        done.stderr,
    )
    phi, turn, x, y = map(float, told.groups())
    pair, turns = ct.load(design), [k * 5e-5 for k in range(-50, 20)]
    # Before it there is one backlash; after it something stands in its midst, so far from where the gear stood.
    assert len(free(pair, phi - 1e-4, turns)) == 1
    low, high = free(pair, phi + 5e-4, turns)
    assert low[0] + turn == pytest.approx(high[0], abs=1.5e-4)
    # It stands at the corners of tips, where the outlines turn by more than 40 degrees.
    outline = pair.driver.outline(1e-4)
    nearest = min(range(len(outline)), key=lambda i: math.dist(outline[i], (x, y)))
    assert math.dist(outline[nearest], (x, y)) < 1e-3
    # The quick check tells it, too.
    (found,) = [finding for finding in pair.check().findings if finding.rule == "seat-jump"]
    assert found.place.input == pytest.approx(phi, abs=1e-6)
    assert found.measured == pytest.approx(turn, rel=1e-3)


def touching(proof):
    """A flank piece of the driver that holds the driven gear, by number."""
    stretch = proof["stretches"][1]
    return stretch["meetings"][stretch["held_by"][0]]["pieces"][0]


def bulge(proof):
    """A flank that stands 1 um out, smooth at its ends."""
    piece = proof["driver"][touching(proof)]
    # Along its middle the contour runs by the tangent there; what lies right of it is outside.
    tangent = piece[1]
    length = (tangent[0] ** 2 + tangent[1] ** 2) ** 0.5
    outward = [1e-3 * tangent[1] / length, -1e-3 * tangent[0] / length]
    # (1 - u^2)^2
    for power, share in ((0, 1), (2, -2), (4, 1)):
        for k in (0, 1):
            piece[power][k] += share * outward[k]


def vertex(proof):
    proof["driven"][5][0][0] += 1e-3


def fillet(proof):
    del proof["driver"][touching(proof) - 1]


def axis(proof):
    proof["center_distance"] += 1e-3


def box(proof):
    del proof["stretches"][len(proof["stretches"]) // 2]


def bound(proof):
    proof["half_width"] = 1e-14


def seat(proof):
    for series in proof["stretches"][1]["seats"]:
        series[0] += 1e-9


def law(proof):
    proof["law"]["pieces"][0][0] += 1e-8


def swapped(proof):
    for stretch in proof["stretches"]:
        stretch["seats"].reverse()


def cycle(proof):
    last = proof["stretches"].pop()
    proof["cycle"] = last["from"]


def sector(proof):
    """One half that stands for both, of gears without such a symmetry."""
    half = proof["cycle"] / 2
    proof["stretches"] = [s for s in proof["stretches"] if s["from"] < half]
    proof["stretches"][-1]["to"] = half
    proof["sectors"] = 2


def corner(proof):
    """A corner that is none of both gears'."""
    stretch = proof["stretches"][1]
    stretch["meetings"][stretch["held_by"][0]]["corner"] = -2


def piece(proof):
    for meeting in proof["stretches"][1]["meetings"]:
        meeting["pieces"][1] -= len(proof["driven"])


def side(proof):
    for meeting in proof["stretches"][1]["meetings"]:
        meeting["side"] -= 2


def coefficient(proof):
    proof["law"]["pieces"][0].append(None)


def stranger(proof):
    proof["driver"][3][2][1] = "1"


def hollow(proof):
    proof["stretches"] = []


def nothing(proof):
    proof.clear()


@pytest.mark.parametrize(
    "defect",
    [
        bulge,
        vertex,
        fillet,
        axis,
        box,
        bound,
        seat,
        law,
        swapped,
        cycle,
        sector,
        corner,
        piece,
        side,
        coefficient,
        stranger,
        hollow,
        nothing,
    ],
    ids=lambda defect: defect.__name__,
)
def test_the_checker_rejects_a_planted_defect(defect, proof, tmp_path):
    spoilt = copy.deepcopy(proof)
    defect(spoilt)
    path = tmp_path / "spoilt.proof"
    path.write_text(json.dumps(spoilt))
    status, answer = checked(path)
    assert (status, answer.split(":")[0]) == (1, "rejected"), answer


@pytest.mark.parametrize("defect", [corner, piece], ids=lambda defect: defect.__name__)
def test_hints_of_what_is_not_there_are_refused_as_such(defect, proof, tmp_path):
    defect(proof)
    path = tmp_path / "spoilt.proof"
    path.write_text(json.dumps(proof))
    status, answer = checked(path)
    assert (status, answer[:22]) == (1, "rejected: a meeting is"), answer


def test_a_driven_gear_that_jumps_a_tooth_and_back_is_rejected(run, tmp_path):
    path, teeth = tmp_path / "circular-pair.proof", 36
    run("prove", DESIGNS / "circular-pair.toml", "-o", path)
    proof = json.loads(path.read_text())
    stretch, count = proof["stretches"][5], len(proof["driven"])
    for series in stretch["seats"]:
        series[0] += 2 * math.pi / teeth
    for meeting in stretch["meetings"]:
        meeting["pieces"][1] = (meeting["pieces"][1] - count // teeth) % count
    path.write_text(json.dumps(proof))
    assert checked(path) == (1, f"rejected: a seat jumps at {stretch['from']} rad\n")


@pytest.mark.parametrize(("low", "high"), [(-0.5, 1.0005), (-1.0005, 0.5), (-1.0005, 1.0005)])
def test_a_place_that_may_lie_beyond_either_end_leaves_its_piece(low, high):
    corners = [0, 1, 1 + 1j, 1j]
    sides = zip(corners, corners[1:] + corners[:1], strict=True)
    square = Contour(
        [[[((a + b) / 2).real, ((a + b) / 2).imag], [((b - a) / 2).real, ((b - a) / 2).imag]] for a, b in sides],
        "square",
    )
    off = square.beyond(0, flint.arb(low).union(flint.arb(high)), flint.arb(0))
    # Round a square corner: as far off as it is beyond, along and across.
    assert off > 5e-4 / 2
    assert square.beyond(0, flint.arb(-0.5).union(flint.arb(0.5)), flint.arb(0)) == 0


@pytest.mark.parametrize("text", ["", "{", '{"format": NaN}', '{"format": 1e400}', "[" * 100_000, "[]", "null"])
def test_a_file_that_is_no_proof_is_rejected(text, tmp_path):
    path = tmp_path / "x.proof"
    path.write_text(text)
    status, answer = checked(path)
    assert (status, answer.split(":")[0]) == (1, "rejected"), answer


def test_a_file_that_is_missing_is_an_error(tmp_path):
    assert checked(tmp_path / "x.proof")[0] == 2
