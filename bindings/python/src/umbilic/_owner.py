"""What stands in front of an object of the library's: it can be closed, and used in a `with` statement."""

from __future__ import annotations

from types import TracebackType
from typing import TypeVar

from . import _native as native

Self = TypeVar("Self", bound="Owner")


class Owner:
    """Holds a handle until it is closed; calls and arrays that hold it as well keep the memory for themselves."""

    _name = ""
    _held: native.Handle | None

    @property
    def handle(self) -> native.Handle:
        """For calls of this package."""
        held = self._held
        if held is None:
            raise ValueError(f"the {self._name} is closed")
        return held

    @property
    def closed(self) -> bool:
        return self._held is None

    def close(self) -> None:
        """Frees the memory, once no call and no array needs it any more. More than once is fine."""
        self._held = None

    def __enter__(self: Self) -> Self:
        _ = self.handle  # refuses what is closed
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
