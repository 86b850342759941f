"""Spaces of actions and observations: Gymnasium's, or, where it is not
installed, as much of them as environments need."""
import random
from collections.abc import Sequence
from typing import Any

try:
    import numpy
except ImportError:
    numpy = None  # type: ignore[assignment]

try:
    from gymnasium.spaces import Box as _Box, Discrete as _Discrete
except ImportError:
    _Box = _Discrete = None


class PlainDiscrete:
    """The actions 0 to n - 1."""

    def __init__(self, n: int, seed: int | None = None):
        self.n = n
        self.shape: tuple[int, ...] = ()
        self.dtype = numpy.dtype("int64") if numpy else int
        self._random = random.Random(seed)

    def seed(self, seed: int | None = None) -> None:
        self._random = random.Random(seed)

    def sample(self, mask: Sequence[int] | None = None) -> int:
        """Any action; with a mask any of those that it has a 1 for."""
        allowed = [k for k in range(self.n) if mask is None or mask[k]]
        return self._random.choice(allowed or [0])

    def contains(self, x: Any) -> bool:
        try:
            return int(x) == x and 0 <= x < self.n
        except (TypeError, ValueError):
            return False

    __contains__ = contains

    def __eq__(self, other: object) -> bool:
        return isinstance(other, PlainDiscrete) and other.n == self.n

    def __repr__(self) -> str:
        return f"Discrete({self.n})"


class PlainBox:
    """Vectors between two bounds."""

    def __init__(self, low: Sequence[float], high: Sequence[float],
                 seed: int | None = None):
        self.low, self.high = vector(low), vector(high)
        self.shape = (len(low),)
        self.dtype = numpy.dtype("float32") if numpy else float
        self._random = random.Random(seed)

    def seed(self, seed: int | None = None) -> None:
        self._random = random.Random(seed)

    def sample(self) -> Any:
        return vector([self._random.uniform(a, b)
                       for a, b in zip(self.low, self.high)])

    def contains(self, x: Any) -> bool:
        if numpy and (not isinstance(x, numpy.ndarray)
                      or x.dtype != self.dtype):
            return False
        return len(x) == len(self.low) and all(
            a <= v <= b for a, v, b in zip(self.low, x, self.high))

    __contains__ = contains

    def __eq__(self, other: object) -> bool:
        return (isinstance(other, PlainBox)
                and list(other.low) == list(self.low)
                and list(other.high) == list(self.high))

    def __repr__(self) -> str:
        return f"Box({min(self.low)}, {max(self.high)}, {self.shape}, float32)"


def vector(values: Sequence[float]) -> Any:
    """A float32 array; a list where numpy is not installed."""
    return numpy.array(values, "float32") if numpy else list(values)


def mask(values: Sequence[int]) -> Any:
    """An int8 array, as `Discrete.sample` takes it; or a list."""
    return numpy.array(values, "int8") if numpy else list(values)


def discrete(n: int) -> Any:
    """The space of the actions 0 to n - 1."""
    return _Discrete(n) if _Discrete else PlainDiscrete(n)


def box(low: Sequence[float], high: Sequence[float]) -> Any:
    """The space of vectors between two bounds."""
    if not _Box:
        return PlainBox(low, high)
    return _Box(vector(low), vector(high), dtype=numpy.float32)
