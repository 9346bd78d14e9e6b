"""A sensor: observations of a CSV file with the columns stamp_s, x_m, y_m, heading_rad and range_0, range_1, ...

A range_N is the reading of the robot's transducer N in metres: empty where that has not fired, inf without an echo.
"""
import csv
import math


class CsvReplay:
    def __init__(self, context, file):
        with open(context.path(file), newline="") as text:
            self.rows = list(csv.DictReader(text))
        self.at = 0
        if not self.rows:
            raise ValueError(f"{file} has no observation")
        self.columns = [name for name in self.rows[0] if name.startswith("range_")]
        self.first = pose_in(self.rows[0])

    def start(self):
        """Where the robot begins, in the map."""
        return self.first

    def next(self):
        """The next observation; None: there are no more."""
        if self.at == len(self.rows):
            return None
        row = self.rows[self.at]
        self.at += 1
        pose = pose_in(row)
        return {
            "stamp_s": float(row["stamp_s"]),
            "odometry": relative(self.first, pose),  # since the start
            "compass_rad": pose[2],
            "sensors": [int(name.removeprefix("range_")) for name in self.columns],
            "ranges_m": [float(row[name]) if row[name] else math.nan for name in self.columns],
        }


def pose_in(row):
    return float(row["x_m"]), float(row["y_m"]), float(row["heading_rad"])


def relative(first, pose):
    """The pose as seen from the first one."""
    dx, dy = pose[0] - first[0], pose[1] - first[1]
    cosine, sine = math.cos(first[2]), math.sin(first[2])
    return cosine * dx + sine * dy, cosine * dy - sine * dx, math.remainder(pose[2] - first[2], 2 * math.pi)
