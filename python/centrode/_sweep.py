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

# Default chunks: checks of some seconds, and variants of some tens of milliseconds.
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
    """Evaluate many designs with an executor.

    Many designs: each design gets the whole check. The result is a list in the same order, with the figures of each
    design by name, both of goals and of the report; None if there is no mechanism.

    One three-arm design with `over`: its variants in these parameters, about twenty microseconds each. The result is
    that of `ThreeArm.sweep`; NaN for a variant with a number that a design file does not allow.

    The numbers do not depend on the executor and on the chunk. If an executor breaks, for example because a worker of a
    process pool was killed, only the chunks without a result are computed again.

    Args:
        designs: Design files as text, or mechanisms; with `over` one three-arm design.
        over: Values by parameter: arrays of one length, or single numbers, as for `ThreeArm.sweep`.
        inputs: As for `ThreeArm.sweep`.
        executor: Any `concurrent.futures.Executor`, such as that of `dask.distributed.Client.get_executor()`; or a
            function that makes one: it is called again if an executor breaks, and its executors are shut down at the
            end. Default: this process.
        chunk: Designs per task; default: 32, and 4096 with `over`.
        attempts: Maximum number of attempts per chunk if executors break.

    Raises:
        BrokenExecutor: The executor broke, and no attempt or no function for another one is left.

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
        raise TypeError("designs must be several designs, or over must be given")
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
    """The results of all chunks, in order; a broken executor is replaced by another one."""
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
    """Submit every chunk without a result to a pool, and store each result."""
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
