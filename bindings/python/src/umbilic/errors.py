"""What goes wrong: the library's statuses as exceptions, with its message and the offending element."""

from __future__ import annotations

from enum import IntEnum


class Status(IntEnum):
    """What a call of the library came to: `Error.status`."""

    OK = 0
    NULL_POINTER = 1
    STRUCT_SIZE = 2
    UNKNOWN_FIELD = 3
    UNKNOWN_CONSTANT = 4
    STRIDE = 5
    MISALIGNED = 6
    SIZE = 7
    OFFSETS = 8
    INDEX_OUT_OF_RANGE = 9
    NON_FINITE = 10
    TOO_LARGE = 11
    NOT_APPLICABLE = 12
    OPTION_OUT_OF_RANGE = 13
    OUT_OF_MEMORY = 100
    CANCELLED = 101
    INTERNAL = 900

    @classmethod
    def _missing_(cls, value: object) -> Status | None:
        """What later libraries may have."""
        if not isinstance(value, int):
            return None
        later = int.__new__(cls, value)
        later._name_, later._value_ = f"STATUS_{value}", value
        return later


class Error(Exception):
    """The library refused a call, or could not carry it out.

    `status` is a `Status`; `element` the offending corner, face, vertex or value, as the message says, or
    None. What this package itself refuses (shapes, types, unknown names) is a plain TypeError or ValueError.

    >>> import umbilic
    >>> try:
    ...     umbilic.Topology([[0, 1, 3]], vertex_count=3)
    ... except umbilic.Error as error:
    ...     print(type(error).__name__, error.status.name, error.element)
    IndexOutOfRange INDEX_OUT_OF_RANGE 2
    """

    status: Status
    element: int | None

    def __init__(self, message: str, status: int, element: int | None = None) -> None:
        # All of them, so that a pickle holds all of them.
        super().__init__(message, status, element)
        self.status = Status(status)
        self.element = element

    def __str__(self) -> str:
        return str(self.args[0])


class InvalidArgument(Error, ValueError):
    """A mistake of the caller."""


class IndexOutOfRange(InvalidArgument, IndexError):
    """An index is negative, or not below the number of what it counts."""


class OutOfMemory(Error, MemoryError):
    """No memory for a buffer."""


def from_native(message: str, status: int, element: int | None) -> Error:
    if status == Status.INDEX_OUT_OF_RANGE:
        return IndexOutOfRange(message, status, element)
    if status == Status.OUT_OF_MEMORY:
        return OutOfMemory(message, status, element)
    return (InvalidArgument if 0 < status < 100 else Error)(message, status, element)
