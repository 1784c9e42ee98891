"""Screws of plates and covers: in their holes, clear of all that moves, as other programs read the files."""

import csv
import itertools
import math
import re

import centrode as ct
import numpy as np
import pytest
import tomllib
from conftest import design_file
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.TopAbs import TopAbs_SOLID
from reading import contours, texts
from sample import sampled
from shapely.affinity import affine_transform, translate
from shapely.geometry import Point
from test_assembly_step import Assembly, box, cylinders, every, moved, volume

ARMS = ("three-arm-2021", "three-arm-all-goals", "three-arm-from-poses", "three-arm")
FEEDERS = ("feeder-2022", "feeder-widened", "feeder")
SCREW = re.compile(r"Screw ISO 4762 - M([\d.]+) x ([\d.]+)$")
# Clearance holes of the medium series, ISO 273, and drills of the coarse threads, ISO 2306.
CLEARANCE = {2: 2.4, 2.5: 2.9, 3: 3.4, 4: 4.5, 5: 5.5, 6: 6.6, 8: 9.0}
DRILL = {2: 1.6, 2.5: 2.05, 3: 2.5, 4: 3.3, 5: 4.2, 6: 5.0, 8: 6.8}
PLACE = re.compile(r"^at (-?[\d.]+), (-?[\d.]+)")


def listed(folder):
    """Diameter, length, links and number of the screws of a parts list."""
    with (folder / "parts.csv").open(newline="") as lines:
        for row in csv.DictReader(lines):
            if screw := SCREW.match(row["part"]):
                assert row["supply"] == "bought"
                assert row["files"] == ""
                yield float(screw[1]), float(screw[2]), row["links"].split(), int(row["quantity"])


def places(folder, part, words):
    """Places of the holes of a sheet whose size has some words."""
    found = [text for file in sorted(folder.glob(f"{part}-sheet*.dxf")) for text in texts(file)]
    for text, after in itertools.pairwise(found):
        if re.search(words, text) and (at := PLACE.match(after)):
            yield float(at[1]), float(at[2])


@pytest.mark.parametrize("name", sampled([*ARMS, *FEEDERS]))
def test_every_screw_goes_through_a_hole_into_a_thread_and_its_head_lies_on_the_plate(name, shipped):
    folder = shipped(name, "csv,step")
    assembly = Assembly(folder / "assembly.step")
    solids = [
        (product, solid, box(solid))
        for _, product, place, shape in assembly.pieces
        for solid in every(moved(shape, place), TopAbs_SOLID)
    ]
    screws = [(product, solid) for product, solid, _ in solids if product.startswith("screw-")]
    kinds = list(listed(folder))
    assert len(screws) == sum(number for *_, number in kinds)
    assert len(kinds) == (2 if name in ARMS else 1)
    for product, screw in screws:
        diameter, length = map(float, re.match(r"screw-m([\d.]+)x([\d.]+)", product).groups())
        # Round faces come in halves.
        shank, *_, head = sorted(cylinders(screw), key=lambda found: found[2])
        assert math.isclose(2 * shank[2], diameter)
        assert math.isclose(volume(screw), math.pi * (shank[2] ** 2 * length + head[2] ** 2 * diameter))
        low, high = box(screw)
        through, into = [], []
        for other, body, (under, over) in solids:
            if body is screw or (low > over + 1e-6).any() or (under > high + 1e-6).any():
                continue
            shared = BRepAlgoAPI_Common(screw, body)
            assert shared.IsDone()
            common = volume(shared.Shape())
            radii = [
                radius
                for at, way, radius in cylinders(body)
                if np.linalg.norm(np.cross(at - shank[0], way)) < 1e-6 and abs(way[2]) > 0.999
            ]
            if any(math.isclose(2 * radius, CLEARANCE[diameter], abs_tol=1e-6) for radius in radii):
                through.append(over[2] - under[2])
                assert common < 1e-6, (product, other)
            elif any(math.isclose(2 * radius, DRILL[diameter], abs_tol=1e-6) for radius in radii):
                # The thread is drawn by its drill: the screw reaches into the material by the rest.
                into.append(common / (math.pi / 4 * (diameter**2 - DRILL[diameter] ** 2)))
            else:
                assert common < 1e-6, (product, other)
        assert len(through) == 1, product
        assert len(into) == 1, product
        # As long as the plate is thick and the thread is entered: by a diameter at least.
        assert math.isclose(through[0] + into[0], length, abs_tol=1e-6), product
        assert into[0] > diameter * (1 - 1e-9), product


@pytest.mark.parametrize("name", sampled(ARMS))
def test_screws_are_clear_of_gears_and_arms_and_of_what_moves_in_them(name, shipped):
    folder = shipped(name, "csv,dxf,sheet,step")
    kinds = list(listed(folder))
    (of_carrier,) = [diameter for diameter, _, links, _ in kinds if links == ["carrier"]]
    (of_covers,) = [diameter for diameter, _, links, _ in kinds if links[0] == "arm_0"]
    machine = ct.load(design_file(name, folder))

    def outer(part):
        return max(contours(folder / f"{part}.dxf"), key=lambda polygon: polygon.area)

    def reach(polygon):
        return max(math.hypot(x, y) for x, y in polygon.exterior.coords)

    spacers = list(places(folder, "carrier", rf"Ø{CLEARANCE[of_carrier]:g} H13"))
    assert len(spacers) == 3
    plate = outer("carrier")
    frames = machine.frames(0.0)
    inverse = np.linalg.inv(np.reshape(frames["carrier"], (4, 4)))
    for at in spacers:
        # A spacer, and so the head, lies on the plate.
        assert plate.exterior.distance(Point(at)) > 1.5 * of_carrier - 1e-2
        for link, part in (("sun", "sun"), ("intermediate_", "intermediate"), ("planet_", "planet")):
            for own, frame in frames.items():
                if own.rstrip("0123456789") != link.rstrip("0123456789"):
                    continue
                axis = (inverse @ np.reshape(frame, (4, 4)))[:2, 3]
                assert math.dist(at, axis) > reach(outer(part)) + of_carrier + 1, (own, at)
                if part == "planet":
                    assert math.dist(at, axis) > reach(outer("cover-front")) + of_carrier + 1, (own, at)
    bosses = list(places(folder, "housing", rf"^M{of_covers:g}-6H"))
    assert len(bosses) >= 3
    assert sorted(bosses) == sorted(places(folder, "cover-front", rf"Ø{CLEARANCE[of_covers]:g} H13"))
    assert sorted(bosses) == sorted(places(folder, "cover-rear", rf"Ø{CLEARANCE[of_covers]:g} H13"))
    cover = outer("cover-front")
    discs = [Point(at).buffer(of_covers) for at in bosses]
    for at in bosses:
        # No nearer to the edge than 1.2 diameters of the hole: EN 1993-1-8, 3.5.
        assert math.isclose(cover.exterior.distance(Point(at)), 1.2 * CLEARANCE[of_covers], abs_tol=1e-2), at
        assert math.hypot(*at) > reach(outer("cam")) + of_covers + 0.4, at
    # The rod's drawing has its origin in the hole, the link that of the arm, thrown out.
    stroke = np.ptp(machine.push_rod(np.linspace(0.0, math.tau, 3601)))
    offset = tomllib.loads(design_file(name, folder).read_text())["arm"]["pusher_offset"]
    rod = translate(outer("push-rod"), 0.5 * stroke, -offset)
    moving = {"fork_0": outer("fork"), "push_rod_0": rod}
    for turn in np.linspace(0.0, math.tau, 120, endpoint=False):
        frames = machine.frames(turn)
        arm = np.linalg.inv(np.reshape(frames["arm_0"], (4, 4)))
        for link, polygon in moving.items():
            at = arm @ np.reshape(frames[link], (4, 4))
            there = affine_transform(polygon, [*at[0, :2], *at[1, :2], at[0, 3], at[1, 3]])
            for disc in discs:
                assert there.distance(disc) > 0.4, (link, turn)


@pytest.mark.parametrize("name", sampled(FEEDERS))
def test_spacers_of_a_feeder_are_clear_of_all_links_in_every_place(name, shipped):
    folder = shipped(name, "csv,dxf,sheet,step")
    ((diameter, _, links, number),) = listed(folder)
    assert set(links) == {"frame"}
    spacers = list(places(folder, "frame", rf"Ø{CLEARANCE[diameter]:g} H13"))
    assert number == 2 * len(spacers) == 8
    plate = max(contours(folder / "frame.dxf"), key=lambda polygon: polygon.area)
    for at in spacers:
        assert plate.exterior.distance(Point(at)) > 1.5 * diameter - 1e-2
    discs = [Point(at).buffer(diameter) for at in spacers]
    machine = ct.load(design_file(name, folder))
    at_rest = {link: np.reshape(frame, (4, 4)) for link, frame in machine.frames(0.0).items()}
    # The machine's drawing shows all links where the motion begins.
    bodies = {
        link: max(contours(folder / "assembly.dxf", link), key=lambda polygon: polygon.area)
        for link in ("crank", "coupler", "rocker", "effector", "slider")
    }
    seen = set()
    for turn in np.linspace(0.0, 8 * math.pi, 900, endpoint=False):
        frames = machine.frames(turn)
        seen.add(float(np.reshape(frames["crank"], (4, 4))[0, 0]))
        for link, polygon in bodies.items():
            at = np.reshape(frames[link], (4, 4)) @ np.linalg.inv(at_rest[link])
            there = affine_transform(polygon, [*at[0, :2], *at[1, :2], at[0, 3], at[1, 3]])
            for disc in discs:
                assert there.distance(disc) > 1.5, (link, turn)
    assert min(seen) < -0.99 < 0.99 < max(seen)
    # Behind the frame gears and cams turn about their own shafts.
    for part, axis in (("gear-driven", "crank"), ("gear-driver", "gear-driver"), ("gear-entry-cam", "gear-driver")):
        outline = max(contours(folder / f"{part}.dxf"), key=lambda polygon: polygon.area)
        reach = max(math.hypot(x, y) for x, y in outline.exterior.coords)
        for at in spacers:
            assert math.dist(at, at_rest[axis][:2, 3]) > reach + diameter, (part, at)
