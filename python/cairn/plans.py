"""Questions to planners and their answers."""
from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from cairn import _native

Place = Union[str, Tuple[float, float], _native.Landmark]
"""A place by name (as `cairn plan` takes it), a point (x m, y m), or a landmark."""


@dataclass(frozen=True)
class Plan:
    """The answer to a question: the fields of `cairn plan --json`.

    outcome is "solved", or why there is no path ("no_route", "goal_blocked", "unknown_place", ...); reason is a sentence.
    path: (N, 3) float64, x m, y m, heading rad; N is 0 without a path. trajectory, where it was asked for:
    (N, 6) float64, time s, x m, y m, heading rad, v m/s, w rad/s. landmarks are ids ("L17"), routes are numbers.
    """

    outcome: str
    reason: str
    cost_m: float
    length_m: float
    length_lower_bound_m: Optional[float]
    landmarks: list[str]
    routes: list[int]
    path: npt.NDArray[np.float64]
    clearance_m: float
    margin_m: float
    driving_time_s: Optional[float]
    time_ms: dict[str, float]
    settled: int
    alternatives: list[dict[str, Any]]
    segments: list[dict[str, Any]]
    explanation: Optional[dict[str, Any]]
    trajectory: Optional[npt.NDArray[np.float64]]

    @property
    def solved(self) -> bool:
        """Whether the path leads to the goal."""
        return self.outcome == "solved"


def plan_of(answer: tuple[str, npt.NDArray[np.float64], npt.NDArray[np.float64]]) -> Plan:
    """From what the native planner returns."""
    text, path, trajectory = answer
    fields = json.loads(text)
    has_trajectory = "trajectory" in fields
    for name in ("id", "path", "trajectory"):
        fields.pop(name, None)
    optional = {"alternatives": [], "segments": [], "explanation": None}
    return Plan(**{**optional, **fields}, path=path, trajectory=trajectory if has_trajectory else None)


def place_text(place: Place) -> str:
    """As `cairn plan` takes it."""
    if isinstance(place, str):
        return place
    if isinstance(place, _native.Landmark):
        return f"L{place.id}"
    x, y = place[0], place[1]
    return f"{float(x)!r},{float(y)!r}"


def setting_text(key: str, value: object) -> str:
    """key=value as `--set` takes it."""
    if isinstance(value, bool):
        value = "true" if value else "false"
    elif isinstance(value, (list, tuple)):
        value = json.dumps(list(value))
    return f"{key}={value}"


def setting_texts(settings: Mapping[str, object]) -> list[str]:
    """key=value each."""
    return [setting_text(key, value) for key, value in settings.items()]


QUESTION_KEYS = ("via", "avoid", "closed", "alternatives", "cost", "explain", "trajectory")


def question_of(from_: Place, to: Place, *, via: Iterable[Place] = (), avoid: Iterable[str] = (),
                closed: Iterable[Union[str, int]] = (), alternatives: int = 0, cost: str = "length",
                explain: bool = False, trajectory: bool = False) -> _native.Question:
    """For the native planner."""
    return _native.Question(from_=place_text(from_), to=place_text(to), via=[place_text(place) for place in via],
                            avoid=[place_text(place) for place in avoid], closed=[str(route) for route in closed],
                            alternatives=alternatives, cost=cost, explain=explain, trajectory=trajectory)
