#!/usr/bin/env python3
"""Plans on a saved map, drawn with matplotlib.

    PYTHONPATH=build/release/python docs/examples/plan_and_plot.py out/office/office.cairn out/plans.png
"""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")  # a file, no window
import matplotlib.pyplot as plt

import cairn


def main(map_file: pathlib.Path, picture: pathlib.Path) -> list[cairn.Plan]:
    map = cairn.load(map_file)
    grid = map.grid
    rows, columns = grid.shape
    left, bottom = grid.origin_m
    extent = (left, left + columns * grid.cell_m, bottom, bottom + rows * grid.cell_m)

    # From each landmark to each other, on all cores.
    pairs = [(a, b) for a in map.landmarks for b in map.landmarks if a.id != b.id]
    plans = map.plan_many(pairs)

    figure, axes = plt.subplots(figsize=(8, 7))
    axes.imshow(grid.probability(), origin="lower", extent=extent, cmap="gray_r", vmin=0, vmax=1)
    for (a, b), plan in zip(pairs, plans):
        print(f"{a.label} -> {b.label}: {plan.outcome}, {plan.length_m:.2f} m")
        if plan.solved:
            axes.plot(plan.path[:, 0], plan.path[:, 1], linewidth=1.5)
    for landmark in map.landmarks:
        axes.annotate(f"{landmark.label} {landmark.category}", landmark.pose[:2], ha="center")
    axes.set_xlabel("x, m")
    axes.set_ylabel("y, m")
    figure.savefig(picture, dpi=120)
    return plans


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "plans.png"))
