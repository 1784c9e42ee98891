"""Sweeps of any number of any design: equal to single designs, complete, and the same on any executor."""

import math
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import centrode as ct
import numpy as np
import pytest

PAIR = ct.template("gear-pair")
# Two numbers of each family, around those of its template.
NUMBERS = {
    "gear-pair": {"pitch.eccentricity": [0.2, 0.3], "teeth.backlash": [0.04, 0.06]},
    "three-arm": {"arm.tip_distance": [144.0, 146.0], "pitch.radius[0]": [20.0, 22.0]},
    "feeder": {"linkage.crank": [59.5, 59.8], "drive.motor_rpm": [29.0, 31.0]},
    "spiral-shaft": {"radius": [15.0, 16.0], "groove.width": [9.0, 10.0]},
    "moving-box": {"gears.speed_ratio": [2.5, 3.0], "shaft.radius": [15.0, 16.0]},
    "machine": {"bodies.crank.points.A[0]": [14.0, 15.0], "input.speed_rpm": [30.0, 40.0]},
}


def same(a: dict, b: dict) -> bool:
    figures = [name for name in a if name != "error"]
    return (
        a.keys() == b.keys()
        and a["error"].tolist() == b["error"].tolist()
        and all(np.array_equal(a[name], b[name], equal_nan=True) for name in figures)
    )


@pytest.mark.parametrize("family", NUMBERS)
def test_variants_of_every_family_are_the_single_designs(family: str) -> None:
    over = NUMBERS[family]
    text = ct.template(family)
    found = ct.sweep(text, over=over, depth="motion")
    assert found["error"].tolist() == [None, None]
    (first, one), (second, two) = over.items()
    for i in range(2):
        # One number at a time: the response of the design that has the other number.
        design = ct.sweep(text, over={first: one[i], second: two[i]}, depth="motion")
        assert design.keys() <= found.keys()
        for name in found.keys() - {"error"}:
            expected = design.get(name, [math.nan])[0]
            assert np.array_equal(found[name][i], expected, equal_nan=True), name
    mechanism = ct.Mechanism.from_toml(text)
    response = mechanism.response(first, one)
    alone = ct.sweep(mechanism, over={first: one}, depth="motion")
    assert set(alone) == {*response, "error"}
    assert all(np.array_equal(alone[name], values, equal_nan=True) for name, values in response.items())


def test_a_whole_sweep_has_the_figures_of_the_check() -> None:
    found = ct.sweep(PAIR, over={"pitch.eccentricity": [0.2, 0.3], "teeth.backlash": 0.04}, depth="whole")
    for i, eccentricity in enumerate([0.2, 0.3]):
        text = PAIR.replace("eccentricity = 0.25", f"eccentricity = {eccentricity}")
        report = ct.GearPair.from_toml(text.replace("backlash = 0.05", "backlash = 0.04")).check()
        assert set(found) == {*report.values, "error"}
        assert all(found[name][i] == value for name, value in report.values.items())


def test_deeper_sweeps_have_the_figures_of_shallower_ones_and_more() -> None:
    over = {"pitch.eccentricity": [0.2, 0.3]}
    motion, made, whole = (ct.sweep(PAIR, over=over, depth=depth) for depth in ("motion", "made", "whole"))
    assert motion.keys() < made.keys() < whole.keys()
    for name, values in motion.items():
        assert values.tolist() == made[name].tolist() == whole[name].tolist(), name
    for name, values in made.items():
        assert values.tolist() == whole[name].tolist(), name


def test_a_variant_without_a_mechanism_has_nan_and_the_reason() -> None:
    over = {"pitch.eccentricity": [0.3, 1.5, 0.3], "pitch.tooth_count": [23, 23, 2.6]}
    found = ct.sweep(PAIR, over=over)
    good, high, few = found["error"]
    assert good is None
    assert "pitch.eccentricity" in high
    assert "1.5" in high
    # A count is rounded.
    assert few is None or "3" in few
    assert np.isfinite(found["center_distance"]).tolist()[:2] == [True, False]


def test_figures_are_chosen_by_name() -> None:
    over = {"pitch.eccentricity": [0.2, 0.3]}
    assert list(ct.sweep(PAIR, over=over, figures=["ratio_max", "module"])) == ["ratio_max", "module", "error"]
    with pytest.raises(ct.DesignError, match="ratio_maximum"):
        ct.sweep(PAIR, over=over, figures=["ratio_maximum"])


@pytest.mark.parametrize(
    ("over", "error", "message"),
    [
        ({"pitch.eccentricitty": [0.2]}, ct.DesignError, "eccentricity"),
        ({"name": [1.0]}, ct.DesignError, "number"),
        ({"pitch.module": [1.0, 2.0], "teeth.backlash": [0.0]}, ValueError, "1 values|2 values"),
    ],
)
def test_keys_and_lengths_that_do_not_fit_are_refused(over: dict, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        ct.sweep(PAIR, over=over)


def test_progress_is_called_after_every_chunk_and_may_end_the_sweep() -> None:
    seen: list[tuple[int, int]] = []
    over = {"pitch.eccentricity": np.linspace(0.1, 0.3, 10)}
    ct.sweep(PAIR, over=over, chunk=4, progress=lambda done, count: seen.append((done, count)))
    assert seen == [(4, 10), (8, 10), (10, 10)]

    def stop(done: int, count: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ct.sweep(PAIR, over=over, chunk=4, progress=stop)


def test_a_sweep_is_equal_to_the_last_bit_on_any_executor_and_chunk() -> None:
    over = {"pitch.eccentricity": np.linspace(0.1, 1.1, 9), "driver.bore": 10}
    alone = ct.sweep(PAIR, over=over)
    assert sum(reason is not None for reason in alone["error"]) >= 1
    assert same(ct.sweep(PAIR, over=over, chunk=2), alone)
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        assert same(ct.sweep(PAIR, over=over, executor=pool, chunk=4), alone)


def test_a_three_arm_design_has_a_quick_sweep_and_one_of_every_number() -> None:
    text = ct.template("three-arm")
    quick = ct.sweep(text, over={"r1": [20.0, 22.0]})
    deep = ct.sweep(text, over={"r1": [20.0, 22.0]}, depth="motion")
    assert "error" not in quick
    assert quick.keys() < deep.keys()
    for name, values in quick.items():
        assert values == pytest.approx(deep[name], rel=1e-9), name
    assert "error" in ct.sweep(text, over={"work.plant_spacing": [120.0]})


def test_a_gear_pair_is_swept_on_dask() -> None:
    distributed = pytest.importorskip("distributed")
    over = {"pitch.eccentricity": np.linspace(0.1, 0.3, 6)}
    local = {"n_workers": 2, "threads_per_worker": 1, "host": "127.0.0.1", "dashboard_address": None}
    with distributed.LocalCluster(**local) as cluster, distributed.Client(cluster) as client:
        spread = ct.sweep(PAIR, over=over, executor=client.get_executor(), chunk=2)
    assert same(spread, ct.sweep(PAIR, over=over))
