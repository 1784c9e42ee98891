"""Searching for better mechanisms, responses, and sweeps over executors."""

import math
import os
import pickle
import signal
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import centrode as ct
import numpy as np
import pytest

SHIPPED = Path(__file__).parents[2] / "tests" / "designs" / "three-arm-all-goals.toml"


def tilted() -> ct.ThreeArm:
    held = ", ".join(f'"r{i}", "theta{i}"' for i in range(1, 13))
    text = SHIPPED.read_text(encoding="utf-8").replace("carrier_start_deg = 89.214", "carrier_start_deg = 109")
    return ct.ThreeArm.from_toml(f"{text}\n[optimise]\nhold = [{held}]\n")


def test_the_guide_mends_a_tilt_and_says_how() -> None:
    arms = tilted()
    assert not all(goal.met for goal in arms.goals())
    seen: list[tuple[int, float, float]] = []
    found = arms.optimise(evaluations=300, progress=lambda *at: seen.append(at))
    assert found.reached
    assert found.ended == "target"
    assert found.steps
    assert all(goal.met for goal in found.mechanism.goals())
    assert seen == sorted(seen)
    assert "carrier_start 109" in found.steps[0]


def test_a_callback_ends_the_search_or_raises_out_of_it() -> None:
    found = ct.ThreeArm.from_toml(ct.template("three-arm")).optimise("de", population=20, progress=lambda *at: False)
    assert found.ended == "stopped"
    assert found.evaluations < 2000

    def angry(*at: float) -> None:
        raise KeyError("enough")

    with pytest.raises(KeyError, match="enough"):
        ct.ThreeArm.from_toml(ct.template("three-arm")).optimise("de", population=20, progress=angry)


def test_words_and_designs_without_a_search_are_refused() -> None:
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    with pytest.raises(ct.DesignError):
        arms.optimise("luck")  # type: ignore[arg-type]
    for method in ("guided", "de"):
        with pytest.raises(ct.MechanismError, match="at least 1 evaluation"):
            arms.optimise(method, evaluations=0)
    round_ = ct.ThreeArm(
        ct.pitch.circle(radius=40), carrier_start=1.5, bend=-0.9, arm_mounting_angle=-0.5, tip_distance=145,
        pusher_offset=65,
    )  # fmt: skip
    with pytest.raises(ct.MechanismError):
        round_.optimise("de")


def test_a_response_is_that_of_the_designs() -> None:
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    heights = arms.response("r1", [15.0, 21.0])["trajectory-height"]
    assert heights[1] == arms.trajectory_height
    assert heights[0] > heights[1]
    gap = arms.response("arm.tip_distance", [-1.0, 145.0])["pick-angle"]
    assert math.isnan(gap[0])
    assert np.isclose(gap[1], arms.clamp_angle(math.radians(20)))
    with pytest.raises(ct.DesignError):
        arms.response("arm.nothing", [1.0])


RADII = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24]


def designs(count: int) -> list[str]:
    text = ct.template("three-arm")
    return [text.replace("tip_distance = 145", f"tip_distance = {140 + 10 * i / count}") for i in range(count)]


@pytest.fixture(scope="module")
def alone() -> list[dict[str, float] | None]:
    """Figures of the designs, swept without an executor."""
    return ct.sweep(designs(4))


def test_a_sweep_is_the_same_on_any_executor(alone) -> None:
    texts = designs(4)
    assert all(figures is not None for figures in alone)
    with ThreadPoolExecutor(2) as pool:
        assert ct.sweep(texts, executor=pool, chunk=2) == alone
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        assert ct.sweep(texts, executor=pool, chunk=1) == alone


def killed_once(flag: str) -> None:
    """A worker's start that kills the first worker."""
    try:
        os.close(os.open(flag, os.O_CREAT | os.O_EXCL))
    except FileExistsError:
        return
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.skipif(os.name != "posix", reason="kills a process")
def test_a_killed_worker_loses_nothing(tmp_path: Path, alone) -> None:
    flag = str(tmp_path / "killed")

    def pool() -> ProcessPoolExecutor:
        return ProcessPoolExecutor(2, mp_context=get_context("spawn"), initializer=killed_once, initargs=(flag,))

    assert ct.sweep(designs(4), executor=pool, chunk=1) == alone
    assert Path(flag).exists()


def grid(count: int) -> dict[str, object]:
    chance = np.random.default_rng(7)
    over: dict[str, object] = {f"r{i + 1}": r * chance.uniform(0.9, 1.1, count) for i, r in enumerate(RADII)}
    return over | {"bend": chance.uniform(-60, -45, count), "tip_distance": 146}


def test_variants_are_those_of_the_designs() -> None:
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    over = {"r1": [20.0, 22.0, -90.0], "bend": [-53.0, -50.0, -53.0], "tip_distance": 146}
    found = arms.sweep(over)
    assert set(found) == {
        *("pick-angle", "push-angle", "angle-difference", "gearbox-clearance", "trajectory-height", "module"),
        *("center_distance", "pitch_length"),
    }
    for i in range(2):
        text = ct.template("three-arm").replace("radius = [21,", f"radius = [{over['r1'][i]},")
        text = text.replace("bend_deg = -53", f"bend_deg = {over['bend'][i]}").replace("145", "146")
        (figures,) = ct.sweep([text])
        assert figures is not None
        for name, values in found.items():
            assert values[i] == pytest.approx(figures[name], rel=1e-9), name
    # The third is no mechanism.
    assert all(math.isnan(values[2]) for values in found.values())
    assert list(arms.sweep({})["trajectory-height"].round(4)) == [370.8206]


def test_variants_with_numbers_that_no_file_may_hold_have_no_figures() -> None:
    text = ct.template("three-arm")
    radii = [0.0, -5.0, -1e-9, 1e-9, 5.0]
    sound = [math.isfinite(height) for height in ct.sweep(text, over={"r1": radii})["trajectory-height"]]
    files = ct.sweep([text.replace("radius = [21,", f"radius = [{r},") for r in radii])
    assert sound == [figures is not None for figures in files] == [False, False, False, True, True]
    angles = [19.0, 20.0, 20.001, 44.0, 76.0]
    sound = [math.isfinite(height) for height in ct.sweep(text, over={"theta2": angles})["trajectory-height"]]
    assert sound == [False, False, True, True, False]


def test_variants_are_the_same_on_any_executor() -> None:
    text, over = ct.template("three-arm"), grid(1000)
    alone = ct.sweep(text, over=over)
    assert np.isfinite(alone["pick-angle"]).sum() > 500
    with ThreadPoolExecutor(2) as pool:
        spread = ct.sweep(text, over=over, executor=pool, chunk=300)
    assert set(spread) == set(alone)
    for name, values in alone.items():
        assert np.array_equal(spread[name], values, equal_nan=True), name


@pytest.mark.parametrize(
    ("over", "inputs", "message"),
    [
        ({"r13": [1.0]}, 360, "12 control points"),
        ({"nonsense": [1.0]}, 360, "nonsense"),
        ({"r1": [1.0, 2.0], "r2": [1.0, 2.0, 3.0]}, 360, "r2 has 3 values, but r1 has 2"),
        ({"r1": [[1.0]]}, 360, "r1 must be a number or a list"),
        ({"bend": [1.0], "gamma0": [1.0]}, 360, "given twice"),
        ({"r1": [1.0]}, 0, "inputs must be"),
    ],
)
def test_variants_that_cannot_be_are_refused(over: dict[str, object], inputs: int, message: str) -> None:
    arms = ct.ThreeArm.from_toml(ct.template("three-arm"))
    with pytest.raises((ValueError, ct.DesignError), match=message):
        arms.sweep(over, inputs=inputs)


def test_a_sweep_tells_designs_and_variants_apart() -> None:
    text = ct.template("three-arm")
    with pytest.raises(TypeError, match="several designs"):
        ct.sweep(text)  # type: ignore[call-overload]
    with pytest.raises(TypeError, match="one design"):
        ct.sweep([text], over={"r1": [1.0]})  # type: ignore[call-overload]


def test_what_is_found_travels() -> None:
    found = tilted().optimise("de", evaluations=20, population=10)
    again = pickle.loads(pickle.dumps(found))
    assert again == found


def test_a_sweep_runs_on_dask(alone) -> None:
    distributed = pytest.importorskip("distributed")
    texts = designs(4)
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        pool = client.get_executor()
        assert ct.sweep(texts, executor=pool, chunk=2) == alone
        over = grid(500)
        spread = ct.sweep(texts[0], over=over, executor=pool, chunk=100)
        for name, values in ct.sweep(texts[0], over=over).items():
            assert np.array_equal(spread[name], values, equal_nan=True), name


@pytest.mark.parametrize("method", ["guided", "de", "ga", "cma-es"])
def test_a_population_too_small_is_refused_by_name(method):
    for made in (ct.Feeder.from_toml(ct.template("feeder")), ct.ThreeArm.from_toml(ct.template("three-arm"))):
        with pytest.raises(ct.Error, match="population is 0, but it must be at least 5"):
            made.optimise(method, population=0)
