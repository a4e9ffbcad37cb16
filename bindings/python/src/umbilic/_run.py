"""How a call is carried out: threads, vectors, lists, progress; and how a callback's exception comes out."""

from __future__ import annotations

from collections.abc import Generator
from typing import Any, Callable

from . import _native as native
from ._arrays import IndexArray, address, unsigned
from .errors import Error
from .names import number

Progress = Callable[[float], object]


class Run:
    """The struct `umb_run` of a call, and what a progress callback has raised during it.

    Every call has a callback, if only for the interpreter to look for signals: so Ctrl-C ends long ones.
    """

    def __init__(
        self,
        threads: int = 0,
        simd: str = "best",
        progress: Progress | None = None,
        vertices: IndexArray | None = None,
    ) -> None:
        self.raised: list[BaseException] = []
        if progress is not None and not callable(progress):
            raise TypeError("progress is not callable")
        self._watch = _watch(progress, self.raised)
        next(self._watch)
        self.struct = native.Run(
            threads=unsigned(threads, "threads"),
            simd=number("simd", simd),
            vertices=None if vertices is None else address(vertices),
            vertex_count=0 if vertices is None else len(vertices),
            progress=native.PROGRESS,
            user=self._watch,
        )

    def call(self, function: Any, *arguments: Any) -> None:
        try:
            native.call(function, *arguments)
        except Error:
            if not self.raised:
                raise
        # Also if the wish to cancel came too late to be heard. Taken away, because its traceback leads back here: arrays
        # of the call would stay until the garbage is collected.
        if self.raised:
            raise self.raised.pop()


def _watch(progress: Progress | None, raised: list[BaseException]) -> Generator[int, float, None]:
    """Takes the fraction done at each callback and answers with 1 to cancel."""
    stop = 0
    while True:
        try:
            fraction = yield stop
            if progress is not None and not raised:
                progress(fraction)
        except GeneratorExit:
            return
        except BaseException as error:  # KeyboardInterrupt too
            raised.append(error)
            stop = 1


def topology_options(threads: int, simd: str) -> Any:
    return native.sized(native.TopologyOptions, threads=unsigned(threads, "threads"), simd=number("simd", simd))
