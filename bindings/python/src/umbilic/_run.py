"""How a call is carried out: threads, vectors, lists, progress; and how a callback's exception comes out."""

from __future__ import annotations

import atexit
import threading
import time
from collections.abc import Generator
from typing import Any, Callable

from . import _native as native
from ._arrays import IndexArray, address, unsigned
from .errors import Error
from .names import number

Progress = Callable[[float], object]


class Run:
    """The struct `umb_run` of a call, and what a progress callback has raised during it.

    On the main thread every call has a callback, if only for the interpreter to look for signals: so Ctrl-C ends long
    ones.
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
        main = threading.get_ident() == threading.main_thread().ident
        self._guest = progress is not None and not main
        self.struct = native.Run(
            threads=unsigned(threads, "threads"),
            simd=number("simd", simd),
            vertices=None if vertices is None else address(vertices),
            vertex_count=0 if vertices is None else len(vertices),
        )
        if main or self._guest:
            self._watch = _watch(progress, self.raised, self._guest)
            next(self._watch)
            self.struct.progress, self.struct.user = native.PROGRESS, self._watch

    def call(self, function: Any, *arguments: Any) -> None:
        try:
            if self._guest:
                _guests.add(self)
                _end_if_the_interpreter_does()
            native.call(function, *arguments)
        except Error:
            if not self.raised:
                raise
        finally:
            _guests.discard(self)
        # Also if the wish to cancel came too late to be heard. Taken away, because its traceback leads back here: arrays
        # of the call would stay until the garbage is collected.
        if self.raised:
            raise self.raised.pop()


# Up to Python 3.13 an interpreter that ends unwinds the other threads as they come back to it, daemon threads. Out of a
# callback that leads through the library, which cannot have it and ends the process. So no such thread is in a callback
# by then: the calls that have one end first.

_guests: set[Run] = set()
_ending = threading.Event()
_PATIENCE = 5.0  # seconds, for those that wait for something in their callbacks


@atexit.register
def _end_calls() -> None:
    _ending.set()
    latest = time.monotonic() + _PATIENCE
    while _guests and time.monotonic() < latest:
        time.sleep(0.001)


def _end_if_the_interpreter_does() -> None:
    if _ending.is_set():
        raise SystemExit  # which ends a thread without a word


def _watch(progress: Progress | None, raised: list[BaseException], guest: bool) -> Generator[int, float, None]:
    """Takes the fraction done at each callback and answers with 1 to cancel."""
    stop = 0
    while True:
        try:
            fraction = yield stop
            if guest:
                _end_if_the_interpreter_does()
            if progress is not None and not raised:
                progress(fraction)
        except GeneratorExit:
            return
        except BaseException as error:  # KeyboardInterrupt too
            raised.append(error)
            stop = 1


def topology_options(threads: int, simd: str) -> Any:
    return native.sized(native.TopologyOptions, threads=unsigned(threads, "threads"), simd=number("simd", simd))
