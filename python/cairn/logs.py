"""Recorded logs as arrays."""
from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Optional

import numpy as np
import numpy.typing as npt

from cairn import _native
from cairn.maps import File
from cairn.plans import setting_texts


@dataclass(frozen=True)
class Log:
    """What a log holds: N observations with M ranges in all.

    stamp_s: (N,), rising. odometry: (N, 3), x m, y m, heading rad, since the start. compass_rad: (N,), NaN where there
    is none. The ranges of observation i are those from first_range[i] to first_range[i + 1]: range_m (M,), inf for no
    echo, -inf for nearer than can be measured, NaN for a bad reading; max_m (M,); sensor_pose (M, 3), where the beam
    begins and points in the robot's frame; sensor (M,), the number of the transducer.
    """

    stamp_s: npt.NDArray[np.float64]
    odometry: npt.NDArray[np.float64]
    compass_rad: npt.NDArray[np.float64]
    first_range: npt.NDArray[np.int64]
    range_m: npt.NDArray[np.float64]
    max_m: npt.NDArray[np.float64]
    sensor_pose: npt.NDArray[np.float64]
    sensor: npt.NDArray[np.int32]

    def __len__(self) -> int:
        return len(self.stamp_s)

    def ranges(self, observation: int) -> slice:
        """Which ranges are of that observation: `log.range_m[log.ranges(5)]`."""
        return slice(int(self.first_range[observation]), int(self.first_range[observation + 1]))


def read_log(file: File, plugin: str = "laser_log", *, robot: Optional[File] = None,
             set: Optional[Mapping[str, object]] = None) -> Log:
    """Reads a log to its end by one of the log modules (docs/logs.md): `carmen_log`, `player_log`, `json_log`, ...

    robot: the robot file, for logs of sonars that do not say where these are. set: settings of the module.
    Raises FileError (with file, line, column of the mistake), ModuleError.
    """
    settings = {"file": os.path.abspath(os.fspath(file)), **(set or {})}
    return Log(*_native.read_log(plugin, setting_texts(settings), "" if robot is None else os.fspath(robot)))
