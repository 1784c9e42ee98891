from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import BrokenExecutor, Executor, Future, wait
from typing import TypeAlias, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._centrode import Mechanism, ThreeArm, _load
from ._error import Error

Figures: TypeAlias = dict[str, float]
Columns: TypeAlias = dict[str, NDArray[np.float64]]
Pool: TypeAlias = Executor | Callable[[], Executor] | None

Ask = TypeVar("Ask")
Answer = TypeVar("Answer")

# Handed over at once, by default: some seconds' checks, some tens of milliseconds' variants.
_DESIGNS = 32
_VARIANTS = 4096


@overload
def sweep(
    designs: Iterable[str | Mechanism],
    *,
    over: None = None,
    executor: Pool = None,
    chunk: int | None = None,
    attempts: int = 3,
) -> list[Figures | None]: ...


@overload
def sweep(
    designs: str | ThreeArm,
    *,
    over: Mapping[str, ArrayLike],
    inputs: int = 360,
    executor: Pool = None,
    chunk: int | None = None,
    attempts: int = 3,
) -> Columns: ...


def sweep(
    designs: Iterable[str | Mechanism] | str | ThreeArm,
    *,
    over: Mapping[str, ArrayLike] | None = None,
    inputs: int = 360,
    executor: Pool = None,
    chunk: int | None = None,
    attempts: int = 3,
) -> list[Figures | None] | Columns:
    """Look at many designs, spread over an executor.

    Many designs: each is checked as a whole; the answer has the figures of each by name, goals and report alike, in
    order, and None where there is no mechanism. One three-arm design with `over`: its variants in these parameters,
    about twenty microseconds each; the answer is that of `ThreeArm.sweep`, with NaN for a variant whose numbers a
    design file may not have.

    The numbers are those of one process, whatever the executor and the chunk. Each chunk's answer is kept as it comes:
    where an executor breaks, such as a process pool of which a worker was killed, only the chunks without an answer are
    asked again.

    Args:
        designs: Design files as text, or mechanisms; with `over` one three-arm design.
        over: Values by parameter: arrays of one length, or single numbers, as `ThreeArm.sweep` takes them.
        inputs: As `ThreeArm.sweep` takes them.
        executor: Any `concurrent.futures.Executor`, as of `dask.distributed.Client.get_executor()`; or what makes one,
            which is asked for another where one breaks, and shut down at the end. Left out, this process.
        chunk: Designs handed over at once, 32 if left out; with `over` 4096.
        attempts: How often in all a chunk is tried where executors break.

    Raises:
        BrokenExecutor: It broke, and there is no other.

    >>> import centrode as ct
    >>> text = ct.template("three-arm")
    >>> one, none = ct.sweep([text, "family = 1"])
    >>> round(one["trajectory-height"], 4), none
    (370.8206, None)
    >>> ct.sweep(text, over={"r1": [15, 21, 27]})["trajectory-height"].round(1).tolist()
    [377.8, 370.8, 363.1]
    """
    if chunk is None:
        chunk = _DESIGNS if over is None else _VARIANTS
    if chunk < 1 or attempts < 1:
        raise ValueError(f"chunk and attempts must be at least 1, not {chunk} and {attempts}")
    if over is not None:
        if not isinstance(designs, str | ThreeArm):
            raise TypeError("with over, designs must be one three-arm design")
        return _variants(designs, over, inputs, executor, chunk, attempts)
    if isinstance(designs, str | ThreeArm):
        raise TypeError("designs must be several designs, or over must say what varies")
    texts = [_text(number, design) for number, design in enumerate(designs)]
    if executor is None:
        return _figures(texts)
    chunks = [texts[i : i + chunk] for i in range(0, len(texts), chunk)]
    return [figures for part in _spread(_figures, chunks, executor, attempts) for figures in part]


def _text(number: int, design: str | Mechanism) -> str:
    """The design file of one of many designs."""
    if isinstance(design, str):
        return design
    if isinstance(design, Mechanism):
        return design.to_toml()
    raise TypeError(f"designs[{number}] must be a design file as text or a mechanism, not {type(design).__name__}")


def _variants(
    design: str | ThreeArm,
    over: Mapping[str, ArrayLike],
    inputs: int,
    executor: Pool,
    chunk: int,
    attempts: int,
) -> Columns:
    arms = ThreeArm.from_toml(design) if isinstance(design, str) else design
    # Errors are reported here rather than by a worker.
    given = {name: np.asarray(values, dtype=float) for name, values in over.items()}
    arms.sweep({name: values.flat[:1] for name, values in given.items()}, inputs=inputs)
    count = max((len(values) for values in given.values() if values.ndim == 1), default=1)
    if executor is None or count <= chunk:
        return arms.sweep(given, inputs=inputs)
    if any(values.ndim > 1 or (values.ndim == 1 and len(values) != count) for values in given.values()):
        return arms.sweep(given, inputs=inputs)
    text = arms.to_toml()
    starts = range(0, count, chunk)
    parts = [(text, {name: v[i : i + chunk] if v.ndim else v for name, v in given.items()}, inputs) for i in starts]
    columns = _spread(_part, parts, executor, attempts)
    return {name: np.concatenate([column[name] for column in columns]) for name in columns[0]}


def _part(part: tuple[str, Columns, int]) -> Columns:
    """The figures of some variants in this process."""
    text, columns, inputs = part
    return ThreeArm.from_toml(text).sweep(columns, inputs=inputs)


def _spread(
    work: Callable[[Ask], Answer], chunks: list[Ask], executor: Executor | Callable[[], Executor], attempts: int
) -> list[Answer]:
    """The answers to all chunks, in order, as often as an executor breaks with another one."""
    answers: dict[int, Answer] = {}
    for attempt in range(attempts):
        pool = executor if isinstance(executor, Executor) else executor()
        try:
            _ask(pool, work, chunks, answers)
            break
        except BrokenExecutor:
            if isinstance(executor, Executor) or attempt + 1 == attempts:
                raise
        finally:
            if not isinstance(executor, Executor):
                pool.shutdown(cancel_futures=True)
    return [answers[i] for i in range(len(chunks))]


def _ask(pool: Executor, work: Callable[[Ask], Answer], chunks: list[Ask], answers: dict[int, Answer]) -> None:
    """Ask a pool for every chunk without an answer, and keep each answer as it comes."""
    asked: dict[Future[Answer], int] = {}
    broken: BrokenExecutor | None = None
    for index, chunk in enumerate(chunks):
        if index not in answers:
            try:
                asked[pool.submit(work, chunk)] = index
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
