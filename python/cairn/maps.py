"""Saved maps."""
from __future__ import annotations

import os
import pathlib
import tempfile
from collections.abc import Iterable, Mapping
from typing import Any, Optional, Union

from cairn import _native
from cairn.plans import QUESTION_KEYS, Place, Plan, plan_of, question_of, setting_texts

File = Union[str, "os.PathLike[str]"]

_KEPT_PLANNERS = 8


class Map:
    """A saved map in memory; `cairn.load` makes it.

    Threads may share it. Arrays and plans keep what they were made of when its names change.
    """

    def __init__(self, native: _native.Map) -> None:
        self._native = native
        self._planners: dict[object, _native.Planner] = {}

    @property
    def file(self) -> str:
        """Where it was loaded from."""
        return self._native.file

    @property
    def properties(self) -> dict[str, str]:
        """What the mission that saved it has written down: mission, seed, robot_radius_m, ..."""
        return self._native.properties

    @property
    def grid(self) -> _native.Grid:
        """The occupancy grid (OG1)."""
        return _native.grid_of(self._native)

    @property
    def landmarks(self) -> list[_native.Landmark]:
        """By rising id."""
        return _native.landmarks_of(self._native)

    @property
    def routes(self) -> list[_native.Route]:
        """By rising id; they are directed."""
        return _native.routes_of(self._native)

    @property
    def clusters(self) -> list[_native.Cluster]:
        """Of all levels, by rising id."""
        return _native.clusters_of(self._native)

    @property
    def submaps(self) -> list[_native.Submap]:
        """Of laser SLAM (`submap_graph`), by rising anchor; empty for maps of other localizers."""
        return _native.submaps_of(self._native)

    def plan(self, from_: Place, to: Place, *, planner: str = "hybrid", via: Iterable[Place] = (),
             avoid: Iterable[str] = (), closed: Iterable[Union[str, int]] = (), alternatives: int = 0,
             cost: str = "length", explain: bool = False, trajectory: bool = False, robot: Optional[File] = None,
             radius_m: Optional[float] = None, margin_m: Optional[float] = None, budget_ms: Optional[float] = None,
             seed: int = 1, set: Optional[Mapping[str, object]] = None, **settings: object) -> Plan:
        """Plans a path, as `cairn plan` does.

        set and settings are the planner's settings: `set={"path.margin_m": 0.1}`, or by keyword where the name has no
        dot. That there is no path is an outcome, not an exception. Other threads of Python run meanwhile. The first
        call with a planner and its settings prepares it; later ones share that.

        Raises ValueError (a cost of no such name), FileError (settings, robot file), ModuleError.
        """
        question = question_of(from_, to, via=via, avoid=avoid, closed=closed, alternatives=alternatives, cost=cost,
                               explain=explain, trajectory=trajectory)
        made = self._planner(planner, {**(set or {}), **settings}, robot, radius_m, margin_m, budget_ms, seed)
        return plan_of(made.plan(question))

    def plan_many(self, questions: Iterable[Union[tuple[Place, Place], Mapping[str, Any]]], *, planner: str = "hybrid",
                  jobs: int = 0, robot: Optional[File] = None, radius_m: Optional[float] = None,
                  margin_m: Optional[float] = None, budget_ms: Optional[float] = None, seed: int = 1,
                  set: Optional[Mapping[str, object]] = None, **settings: object) -> list[Plan]:
        """Plans for many questions on all cores, or by as many threads as `jobs` says; answers in the same order.

        A question is (from, to), or a mapping with "from", "to" and any of "via", "avoid", "closed", "alternatives",
        "cost", "explain", "trajectory". All else is as in plan(), and so are the answers but for their times.

        Raises KeyError and TypeError (a question that is none), and what plan() raises.
        """
        asked = [_question_of(question) for question in questions]
        made = self._planner(planner, {**(set or {}), **settings}, robot, radius_m, margin_m, budget_ms, seed)
        return [plan_of(answer) for answer in made.plan_many(asked, jobs)]

    def name(self, what: Union[str, _native.Landmark], name: str) -> None:
        """Names a landmark or a cluster, in memory; "" takes its name away.

        Raises CairnError: there is nothing of that id or name, or the name cannot be given.
        """
        self._native.name(f"L{what.id}" if isinstance(what, _native.Landmark) else what, name)
        self._planners.clear()

    def save(self, file: Optional[File] = None) -> None:
        """Writes it, in one step, to that file or to where it was loaded from. Raises MapError."""
        self._native.save(os.fspath(file) if file is not None else self.file)

    def picture(self, file: Optional[File] = None, *, plan: Optional[Plan] = None, title: Optional[str] = None,
                longer_side_px: float = 930.0) -> bytes:
        """Draws it with its graph, and the path of a plan on top. Returns a PNG, and writes it to file if there is one.

        Raises CairnError: the file cannot be written.
        """
        path = [] if plan is None else plan.path.tolist()
        passed = [] if plan is None else [int(label[1:]) for label in plan.landmarks]
        words = title if title is not None else pathlib.Path(self.file).name
        with tempfile.TemporaryDirectory(prefix="cairn_picture_") as folder:
            target = os.fspath(file) if file is not None else os.path.join(folder, "map.png")
            _native.draw(self._native, target, words, path, passed, longer_side_px)
            return pathlib.Path(target).read_bytes()

    def _repr_png_(self) -> bytes:
        return self.picture()

    def __repr__(self) -> str:
        height, width = self.grid.shape
        return f"<Map {self.file}: {width} x {height} cells, {len(self.landmarks)} landmarks, {len(self.routes)} routes>"

    def _planner(self, planner: str, settings: Mapping[str, object], robot: Optional[File], radius_m: Optional[float],
                 margin_m: Optional[float], budget_ms: Optional[float], seed: int) -> _native.Planner:
        texts = setting_texts(settings)
        robot_file = "" if robot is None else os.fspath(robot)
        key = (planner, tuple(texts), robot_file, radius_m, margin_m, budget_ms, seed)
        made = self._planners.get(key)
        if made is None:
            made = _native.Planner(self._native, planner, texts, robot_file, radius_m, margin_m, budget_ms, seed)
            if len(self._planners) >= _KEPT_PLANNERS:
                self._planners.clear()
            self._planners[key] = made
        return made


def _question_of(question: Union[tuple[Place, Place], Mapping[str, Any]]) -> _native.Question:
    if not isinstance(question, Mapping):
        from_, to = question
        return question_of(from_, to)
    unknown = [key for key in question if key not in ("from", "to", *QUESTION_KEYS)]
    if unknown:
        raise KeyError(f"a question knows no {unknown[0]!r}: it has from, to, {', '.join(QUESTION_KEYS)}")
    return question_of(question["from"], question["to"], **{key: question[key] for key in QUESTION_KEYS if key in question})


def load(file: File) -> Map:
    """Loads a saved map (*.cairn). Raises MapError with the file and what is wrong with it."""
    return Map(_native.load(os.fspath(file)))
