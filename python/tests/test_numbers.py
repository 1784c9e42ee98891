"""Numbers no function has an answer for are refused by name, in and out of arrays; nothing answers with NaN."""

import inspect
import math
import warnings

import centrode as ct
import numpy as np
import pytest

NEVER = [math.nan, math.inf, -math.inf]


@pytest.fixture(scope="module")
def machines():
    pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    feeder = ct.Feeder.from_toml(ct.template("feeder"))
    return {
        "pair": pair,
        "gear": pair.driver,
        "shaft": ct.SpiralShaft(holes=4, amplitude=1.2),
        "arms": ct.ThreeArm.from_toml(ct.template("three-arm")),
        "box": ct.MovingBox(speed_ratio=3),
        "feeder": feeder,
        "six-bar": feeder.six_bar,
    }


@pytest.mark.parametrize("diameter", [0, -1, *NEVER])
def test_a_pin_has_a_diameter(machines, diameter):
    with pytest.raises(ct.DesignError, match="diameter must be"):
        machines["gear"].over_pins(diameter)


@pytest.mark.parametrize("value", NEVER)
def test_an_angle_is_finite(machines, value):
    found = set()
    for machine in machines.values():
        for name in dir(machine):
            method = getattr(machine, name)
            if name.startswith("_") or not callable(method):
                continue
            first = next(iter(inspect.signature(method).parameters), None)
            if first not in ("phi", "theta"):
                continue
            found.add(name)
            for given in (value, [0.0, value], np.array([[0.1], [value]])):
                with pytest.raises(ValueError, match=r"must be a finite number, not (NaN|inf|-inf)"):
                    method(given)
    assert {"ratio", "driven_angle", "lead_angle", "tip", "pose", "force", "joint_forces", "effector_angle"} <= found


@pytest.mark.parametrize("value", NEVER)
@pytest.mark.parametrize("name", ["start", "stop"])
@pytest.mark.parametrize("machine", ["shaft", "box"])
def test_a_way_has_two_finite_ends(machines, machine, name, value):
    with pytest.raises(ValueError, match=f"{name} must be a finite number"):
        machines[machine].moved(**{"start": 0.0, "stop": 1.0, name: value})


def answers(found):
    """Every number of a record, a list or an array."""
    if isinstance(found, dict):
        found = list(found.values())
    elif hasattr(found, "__dataclass_fields__"):
        found = [getattr(found, name) for name in found.__dataclass_fields__]
    if isinstance(found, (list, tuple)):
        return [number for part in found for number in answers(part)]
    if isinstance(found, np.ndarray):
        return found.ravel().tolist() if found.dtype.kind == "f" else []
    return [found] if isinstance(found, float) else []


@pytest.mark.parametrize("value", [0.0, -1.0, 1e300, 1e-300, *NEVER])
def test_no_number_makes_anything_answer_with_nan(machines, value):
    """Each number of each method replaced in turn: refused by a ValueError, or answered without NaN or a panic."""
    warnings.simplefilter("ignore")
    skipped = {"export", "optimise", "write", "step", "stl", "threemf", "response", "variants", "files", "check"}
    tried = set()
    for title, machine in machines.items():
        for name in dir(machine):
            method = getattr(machine, name)
            if name.startswith("_") or name in skipped or not callable(method):
                continue
            parameters = inspect.signature(method).parameters.values()
            needed = {p.name: 1.0 for p in parameters if p.default is p.empty}
            for parameter in parameters:
                tried.add((title, name, parameter.name))
                try:
                    found = method(**{**needed, parameter.name: value})
                except (ValueError, TypeError, OverflowError):
                    continue
                # Where a pin finds no rest a sentence stands instead of numbers.
                told = all(getattr(found, "faults", [None]))
                assert told or not any(math.isnan(number) for number in answers(found)), (title, name, parameter.name)
    assert len(tried) > 60


@pytest.mark.parametrize("module", [1e300, 1e155, 1e-160, 1e-300])
@pytest.mark.parametrize("kind", ["circle", "ellipse"])
def test_a_size_no_power_of_which_is_a_number_is_refused_by_its_key(kind, module):
    options = {"eccentricity": 0.2} if kind == "ellipse" else {}
    with pytest.raises(
        ct.PitchError, match=r"module gives a pitch curve .* mm long; the length must be 1e-50 to 1e50 mm"
    ):
        ct.GearPair(getattr(ct.pitch, kind)(module=module, tooth_count=20, **options))
