from collections.abc import Callable, Iterable
from concurrent.futures import BrokenExecutor, Executor, Future, wait
from typing import TypeAlias

from ._centrode import GearPair, MovingBox, SpiralShaft, ThreeArm, _load
from ._error import Error

Figures: TypeAlias = dict[str, float]


def sweep(
    designs: Iterable[str | GearPair | ThreeArm | SpiralShaft | MovingBox],
    *,
    executor: Executor | Callable[[], Executor] | None = None,
    chunk: int = 32,
    attempts: int = 3,
) -> list[Figures | None]:
    """Check many designs, spread over an executor: the figures of each by name, goals and report alike, in order.

    The numbers are those of one process, whatever the executor and the chunk. Each chunk's answer is kept as it comes:
    where an executor breaks, such as a process pool of which a worker was killed, only the chunks without an answer are
    asked again.

    Args:
        designs: Design files as text, or mechanisms.
        executor: Any `concurrent.futures.Executor`, as of `dask.distributed.Client.get_executor()`; or what makes one,
            which is asked for another where one breaks, and shut down at the end. Left out, this process.
        chunk: Designs handed over at once.
        attempts: How often in all a chunk is tried where executors break.

    Returns:
        For each design the figures by name; None where it gives no mechanism.

    Raises:
        BrokenExecutor: It broke, and there is no other.

    >>> import centrode as ct
    >>> text = ct.template("three-arm")
    >>> one, none = ct.sweep([text, "family = 1"])
    >>> round(one["trajectory-height"], 4), none
    (370.8206, None)
    """
    if chunk < 1 or attempts < 1:
        raise ValueError(f"chunk and attempts must be at least 1, not {chunk} and {attempts}")
    texts = [design if isinstance(design, str) else design.to_toml() for design in designs]
    if executor is None:
        return _figures(texts)
    chunks = [texts[i : i + chunk] for i in range(0, len(texts), chunk)]
    answers: dict[int, list[Figures | None]] = {}
    for attempt in range(attempts):
        pool = executor if isinstance(executor, Executor) else executor()
        try:
            _ask(pool, chunks, answers)
            break
        except BrokenExecutor:
            if isinstance(executor, Executor) or attempt + 1 == attempts:
                raise
        finally:
            if not isinstance(executor, Executor):
                pool.shutdown(cancel_futures=True)
    return [figures for i in range(len(chunks)) for figures in answers[i]]


def _ask(pool: Executor, chunks: list[list[str]], answers: dict[int, list[Figures | None]]) -> None:
    """Ask a pool for every chunk without an answer, and keep each answer as it comes."""
    asked: dict[Future[list[Figures | None]], int] = {}
    broken: BrokenExecutor | None = None
    for index, texts in enumerate(chunks):
        if index not in answers:
            try:
                asked[pool.submit(_figures, texts)] = index
            except BrokenExecutor as error:
                broken = error
                break
    wait(asked)
    for future, index in asked.items():
        try:
            answers[index] = future.result()
        except BrokenExecutor as error:
            broken = error
    if broken is not None:
        raise broken


def _figures(texts: list[str]) -> list[Figures | None]:
    """The figures of designs in this process."""
    return [_of(text) for text in texts]


def _of(text: str) -> Figures | None:
    try:
        report = _load(text.encode()).check()
    except Error:
        return None
    figures = dict(report.values)
    figures.update((goal.name, goal.value) for goal in report.goals if goal.value is not None)
    return figures
