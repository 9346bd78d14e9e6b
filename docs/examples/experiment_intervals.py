#!/usr/bin/env python3
"""An experiment, analysed with 95 % intervals: Wilson's of a share, and one of a mean by resampling the runs.

    PYTHONPATH=build/release/python docs/examples/experiment_intervals.py out/intervals 6
"""
import math
import pathlib
import sys

import numpy as np

import cairn

CONFIG = pathlib.Path(__file__).resolve().parents[2] / "config"


def wilson(good: int, of: int, z: float = 1.959964) -> tuple[float, float]:
    """The interval of a share of which `good` in `of` were seen."""
    share = good / of
    middle = (share + z * z / (2 * of)) / (1 + z * z / of)
    half = z / (1 + z * z / of) * math.sqrt(share * (1 - share) / of + z * z / (4 * of * of))
    return max(0.0, middle - half), min(1.0, middle + half)


def resampled_mean(values: np.ndarray, samples: int = 10_000, seed: int = 1) -> tuple[float, float]:
    """The interval of a mean: that of the means of samples drawn from the values, as many each."""
    draw = np.random.default_rng(seed).integers(len(values), size=(samples, len(values)))
    low, high = np.quantile(values[draw].mean(axis=1), [0.025, 0.975])
    return float(low), float(high)


def main(folder: pathlib.Path, seeds: int) -> dict[str, tuple[float, float, float]]:
    found = cairn.experiment(CONFIG / "experiments/first_mission.yaml", out=folder, set={"seeds.count": seeds})
    rows = found.figures["rows"]
    good = sum(row["good"] for row in rows)
    time_s = np.array([row["time_s"] for row in rows])
    error_m = np.array([row["worst_error_m"] for row in rows])
    intervals = {
        "share of good runs": (good / len(rows), *wilson(good, len(rows))),
        "mean time, s": (float(time_s.mean()), *resampled_mean(time_s)),
        "mean of the worst error, m": (float(error_m.mean()), *resampled_mean(error_m)),
    }
    for name, (value, low, high) in intervals.items():
        print(f"{name}: {value:.3f} ({low:.3f} - {high:.3f}), {len(rows)} runs")
    return intervals


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/intervals"),
         int(sys.argv[2]) if len(sys.argv) > 2 else 6)
