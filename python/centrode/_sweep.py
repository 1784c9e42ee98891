import os
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import BrokenExecutor, Executor, Future, as_completed
from typing import Any, Literal, TypeAlias, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._centrode import Mechanism, ThreeArm, _load, _sweep
from ._error import DesignError, Error

Figures: TypeAlias = dict[str, float]
Columns: TypeAlias = dict[str, NDArray[Any]]
Pool: TypeAlias = Executor | Callable[[], Executor] | None
Progress: TypeAlias = Callable[[int, int], object] | None
Values: TypeAlias = dict[str, NDArray[np.float64]]

Ask = TypeVar("Ask")
Answer = TypeVar("Answer")

# Default chunks: checks of some seconds, and variants of some tens of milliseconds.
_DESIGNS = 32
_VARIANTS = 4096
# Default chunks of the variants of any design, per core: some tenths of a second.
_PER_CORE = {"motion": 512, "made": 64, "whole": 16}


@overload
def sweep(
    designs: Iterable[str | Mechanism],
    *,
    over: None = None,
    executor: Pool = None,
    chunk: int | None = None,
    attempts: int = 3,
    progress: Progress = None,
) -> list[Figures | None]: ...


@overload
def sweep(
    designs: str | Mechanism,
    *,
    over: Mapping[str, ArrayLike],
    depth: Literal["motion", "made", "whole"] | None = None,
    figures: Iterable[str] | None = None,
    inputs: int | None = None,
    executor: Pool = None,
    chunk: int | None = None,
    attempts: int = 3,
    progress: Progress = None,
) -> Columns: ...


def sweep(
    designs: Iterable[str | Mechanism] | str | Mechanism,
    *,
    over: Mapping[str, ArrayLike] | None = None,
    depth: Literal["motion", "made", "whole"] | None = None,
    figures: Iterable[str] | None = None,
    inputs: int | None = None,
    executor: Pool = None,
    chunk: int | None = None,
    attempts: int = 3,
    progress: Progress = None,
) -> list[Figures | None] | Columns:
    """Evaluate many designs, on all cores or with an executor.

    One design with `over`: its variants in any of its numbers. The result has an array for each goal and figure, by its
    name in the report. A figure is NaN if the variant gives no mechanism or lacks this figure. The array "error" has
    the reason why a variant gives no mechanism, otherwise None.

    A three-arm design swept over parameters of `ThreeArm.sweep`, without `depth` and `figures`, has the result of that
    method instead: eight figures, about twenty microseconds per variant, NaN without a reason.

    Many designs: each design gets the whole check. The result is a list in the same order, with the figures of each
    design by name, both of goals and of the report; None if there is no mechanism.

    The numbers do not depend on the executor and on the chunk. If an executor breaks, for example because a worker of a
    process pool was killed, only the chunks without a result are computed again.

    Args:
        designs: Design files as text, or mechanisms; with `over` one design of any family.
        over: Values by key of the design file, such as "pitch.eccentricity" or "pitch.radius[3]", or by parameter, such
            as "r1": arrays of one length, or single numbers, in the units of the file. Counts are rounded.
        depth: Depth of the check with `over`. "motion", the default: goals and figures that need no teeth; "made": for
            a gear pair also its teeth as cut, without their contact; "whole": everything that `check` reports.
        figures: Names of the figures in the result; default: all.
        inputs: As for `ThreeArm.sweep`, and only there; default: 360.
        executor: Any `concurrent.futures.Executor`, such as that of `dask.distributed.Client.get_executor()`; or a
            function that makes one: it is called again if an executor breaks, and its executors are shut down at the
            end. Default: this process.
        chunk: Designs per task; default: some tenths of a second of work.
        attempts: Maximum number of attempts per chunk if executors break.
        progress: Called after each chunk with the number of designs that are done and the number of all.

    Raises:
        DesignError: A key of `over` is not that of a number, or no variant has a figure of `figures`.
        BrokenExecutor: The executor broke, and no attempt or no function for another one is left.

    >>> import centrode as ct
    >>> pair = ct.GearPair(ct.pitch.ellipse(eccentricity=0.3, module=2, tooth_count=31))
    >>> found = ct.sweep(pair, over={"pitch.eccentricity": [0.1, 0.3, 1.5], "pitch.module": 3})
    >>> found["ratio_max"].round(4).tolist()
    [1.2222, 1.8571, nan]
    >>> [reason is None for reason in found["error"]]
    [True, True, False]
    >>> text = ct.template("three-arm")
    >>> ct.sweep(text, over={"r1": [15, 21, 27]})["trajectory-height"].round(1).tolist()
    [377.8, 370.8, 363.1]
    >>> one, none = ct.sweep([text, "family = 1"])
    >>> round(one["trajectory-height"], 4), none
    (370.8206, None)
    """
    if (chunk is not None and chunk < 1) or attempts < 1:
        raise ValueError(f"chunk and attempts must be at least 1, not {chunk} and {attempts}")
    spread = _Spread(executor, chunk, attempts, progress)
    if over is not None:
        if not isinstance(designs, str | Mechanism):
            raise TypeError("with over, designs must be one design")
        return _variants(designs, over, depth, figures, inputs, spread)
    if isinstance(designs, str | Mechanism):
        raise TypeError("designs must be several designs, or over must be given")
    if depth is not None or figures is not None or inputs is not None:
        raise TypeError("depth, figures and inputs need over")
    texts = [_text(number, design) for number, design in enumerate(designs)]
    return [found for part in spread.over(_figures, len(texts), _DESIGNS, lambda at: texts[at]) for found in part]


def _text(number: int, design: str | Mechanism) -> str:
    """The design file of one of many designs."""
    if isinstance(design, str):
        return design
    if isinstance(design, Mechanism):
        return design.to_toml()
    raise TypeError(f"designs[{number}] must be a design file as text or a mechanism, not {type(design).__name__}")


def _variants(
    design: str | Mechanism,
    over: Mapping[str, ArrayLike],
    depth: Literal["motion", "made", "whole"] | None,
    figures: Iterable[str] | None,
    inputs: int | None,
    spread: "_Spread",
) -> Columns:
    given: Values = {name: np.asarray(values, dtype=float) for name, values in over.items()}
    count = max((len(values) for values in given.values() if values.ndim == 1), default=1)
    uneven = any(values.ndim > 1 or (values.ndim == 1 and len(values) != count) for values in given.values())

    def cut(at: slice) -> Values:
        return {name: values[at] if values.ndim else values for name, values in given.items()}

    if depth is None and figures is None and (arms := _arms(design, given, inputs)) is not None:
        inputs = 360 if inputs is None else inputs
        # Lists of different lengths are refused there.
        if uneven:
            return arms.sweep(given, inputs=inputs)
        text = arms.to_toml()
        columns = spread.over(_of_arms, count, _VARIANTS, lambda at: (text, cut(at), inputs))
        return {name: np.concatenate([part[name] for part in columns]) for name in columns[0]}
    if inputs is not None:
        raise TypeError("inputs is for a three-arm design without depth and figures")
    text, depth = _text(0, design), depth or "motion"
    # Errors are reported here rather than by a worker.
    _sweep(text.encode(), given if uneven else {name: values.flat[:0] for name, values in given.items()}, depth)
    cores = 1 if spread.executor else os.cpu_count() or 1
    parts = spread.over(_of_any, count, cores * _PER_CORE[depth], lambda at: (text, cut(at), depth))
    return _joined(parts, None if figures is None else list(figures))


def _arms(design: str | Mechanism, given: Values, inputs: int | None) -> ThreeArm | None:
    """The three-arm mechanism, if its own sweep has these parameters."""
    if isinstance(design, str):
        try:
            loaded = _load(design.encode()) if "three-arm" in design else None
        except Error:
            return None
    else:
        loaded = design
    if not isinstance(loaded, ThreeArm):
        return None
    first = {name: values.flat[:1] for name, values in given.items()}
    try:
        loaded.sweep(first, inputs=360 if inputs is None else inputs)
    except DesignError:
        if inputs is not None:
            raise
        return None
    return loaded


def _of_arms(part: tuple[str, Values, int]) -> Columns:
    """The figures of some three-arm variants in this process."""
    text, columns, inputs = part
    return ThreeArm.from_toml(text).sweep(columns, inputs=inputs)


def _of_any(part: tuple[str, Values, Literal["motion", "made", "whole"]]) -> tuple[Columns, list[str | None]]:
    """The figures of some variants in this process, and the reasons why there are none."""
    text, columns, depth = part
    return _sweep(text.encode(), columns, depth)


def _joined(parts: list[tuple[Columns, list[str | None]]], figures: list[str] | None) -> Columns:
    """The columns of all parts, with NaN where a part lacks a figure."""
    known = list(dict.fromkeys(name for columns, _ in parts for name in columns))
    reasons = np.array([reason for _, part in parts for reason in part], dtype=object)
    unknown = [name for name in figures or () if name not in known]
    if unknown and known:
        raise DesignError(f"unknown figure {unknown[0]!r}; known figures are {', '.join(known)}", "figures")

    def column(name: str) -> NDArray[np.float64]:
        return np.concatenate([columns.get(name, np.full(len(part), np.nan)) for columns, part in parts])

    return {name: column(name) for name in (known if figures is None else figures)} | {"error": reasons}


class _Spread:
    """How chunks are computed: in this process, or by an executor that is replaced by another one if it breaks."""

    def __init__(self, executor: Pool, chunk: int | None, attempts: int, progress: Progress) -> None:
        self.executor = executor
        self.chunk = chunk
        self.attempts = attempts
        self.progress = progress

    def over(self, work: Callable[[Ask], Answer], count: int, chunk: int, ask: Callable[[slice], Ask]) -> list[Answer]:
        """The results of all chunks of `count` designs, in order."""
        size = self.chunk or chunk
        starts = range(0, count, size) or range(1)
        asks = {start: ask(slice(start, min(start + size, count))) for start in starts}
        answers: dict[int, Answer] = {}

        def store(start: int, answer: Answer) -> None:
            answers[start] = answer
            if self.progress is not None:
                self.progress(min(len(answers) * size, count), count)

        if self.executor is None:
            for start, part in asks.items():
                store(start, work(part))
        else:
            self._ask(self.executor, work, asks, answers, store)
        return [answers[start] for start in starts]

    def _ask(
        self,
        executor: Executor | Callable[[], Executor],
        work: Callable[[Ask], Answer],
        asks: dict[int, Ask],
        answers: dict[int, Answer],
        store: Callable[[int, Answer], None],
    ) -> None:
        for attempt in range(self.attempts):
            pool = executor if isinstance(executor, Executor) else executor()
            try:
                _submit(pool, work, {at: part for at, part in asks.items() if at not in answers}, store)
                return
            except BrokenExecutor:
                if isinstance(executor, Executor) or attempt + 1 == self.attempts:
                    raise
            finally:
                if not isinstance(executor, Executor):
                    pool.shutdown(cancel_futures=True)


def _submit(
    pool: Executor, work: Callable[[Ask], Answer], asks: dict[int, Ask], store: Callable[[int, Answer], None]
) -> None:
    """Submit chunks to a pool, and store each result."""
    asked: dict[Future[Answer], int] = {}
    broken: BrokenExecutor | None = None
    for at, part in asks.items():
        try:
            asked[pool.submit(work, part)] = at
        except BrokenExecutor as error:
            broken = error
            break
    for future in as_completed(asked):
        try:
            answer = future.result()
        except BrokenExecutor as error:
            broken = error
        else:
            store(asked[future], answer)
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
