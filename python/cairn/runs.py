"""Missions and experiments."""
from __future__ import annotations

import json
import os
import pathlib
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Optional

from cairn import _native
from cairn.maps import File, Map, load
from cairn.plans import setting_texts


@dataclass(frozen=True)
class Run:
    """How a mission has ended.

    outcome: "done", or why it ended early; reason: a sentence. folder holds report.json and the map. report is what
    report.json holds.
    """

    outcome: str
    reason: str
    folder: pathlib.Path
    report: dict[str, Any]

    @property
    def done(self) -> bool:
        """Whether all steps succeeded."""
        return self.outcome == "done"

    @property
    def map_file(self) -> Optional[pathlib.Path]:
        """The saved map; None: it could not be saved."""
        name = self.report.get("map", "")
        return self.folder / name if name else None

    def map(self) -> Map:
        """Loads the saved map. Raises MapError."""
        return load(self.map_file if self.map_file is not None else self.folder)


def run(mission: File, *, out: Optional[File] = None, seed: Optional[int] = None,
        set: Optional[Mapping[str, object]] = None, on_tick: Optional[Callable[[_native.Tick], object]] = None,
        pace: float = 0.0) -> Run:
    """Runs a mission in this process and returns when it has ended.

    out: the folder of its map and report; without one a temporary folder, which stays. set: settings over those of the
    file, `{"watchdog_s": 5}`. on_tick is called after each tick, from another thread; the mission waits for it. What it
    raises cancels the mission and is raised here. Ctrl-C cancels it too: the robot stops, the map is saved,
    KeyboardInterrupt is raised. pace: seconds of the mission in a second, at most; 0: as fast as the machine.

    Raises FileError (with file, line, column), ModuleError.
    """
    folder = pathlib.Path(os.fspath(out) if out is not None else tempfile.mkdtemp(prefix="cairn_run_"))
    report = json.loads(_native.run(os.fspath(mission), str(folder), seed, setting_texts(set or {}), on_tick, pace))
    return Run(report["outcome"], report["reason"], folder, report)


@dataclass(frozen=True)
class Experiment:
    """What an experiment has found: its table as Markdown, all figures as in table.json, the folder of its runs."""

    table: str
    figures: Any
    folder: pathlib.Path


def experiment(file: File, *, out: File = "out/experiment", set: Optional[Mapping[str, object]] = None,
               on_run: Optional[Callable[[int, int], object]] = None) -> Experiment:
    """Runs an experiment, as many missions at a time as there are cores (at most eight).

    set: settings over those of the file. on_run(ended, runs) is called after each run. Ctrl-C cancels the runs and
    raises KeyboardInterrupt. Raises FileError, ModuleError.
    """
    table, figures = _native.experiment(os.fspath(file), os.fspath(out), setting_texts(set or {}), on_run)
    return Experiment(table, json.loads(figures), pathlib.Path(os.fspath(out)))
