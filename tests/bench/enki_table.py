#!/usr/bin/env python3
"""What is recognised in Enki, by DDS and by the serial protocol, beside what is recognised in Cairn's own simulator.

    cmake --build build/release --target cairn enki_pioneer enki_ros2
    tests/bench/enki_table.py build/release out/enki [WORLDS [AT_ONCE [LOCALIZER]]]

Each world has two rooms of 4 x 4.4 m and a door, and in each room two landmarks (circle, square, triangle) at any
angle. Its number is the seed. The same file is the world of Enki and of the simulator, the same robot file its robot,
the same steps the mission's. Enki's ranges and wheels err less than the robot file says: "errors as in Enki" is the
simulator with neither noise nor lost echoes nor errors of the odometry. Live runs take as long as the robot takes;
so many go on AT_ONCE, with 0 none. A run that is there already is not made again.

A landmark is right when it is paired with a true one of its category within 0.30 m. Intervals: 95 %, of Wilson; of
differences, bootstrap over the worlds. Needs nothing but Python.
"""
import concurrent.futures
import json
import math
import pathlib
import random
import statistics
import sys

from enki_runs import CONFIG, run_live, run_simulated

TOLERANCE_M = 0.30
KINDS = ("circle", "square", "triangle")
WIDTH_M, HEIGHT_M, DOOR_M = 8.0, 4.4, 1.1
START_M = (0.6, 0.6)
NAMES = {"ros2": "Enki, DDS", "serial": "Enki, serial", "simulated": "simulator, the robot file's errors",
         "exact": "simulator, errors as in Enki"}


def world_of(seed):
    """Its text, the landmarks as (category, x, y), and the heading of the start."""
    draw = random.Random(seed)
    door = draw.uniform(0.9, HEIGHT_M - 0.9 - DOOR_M)
    clear = [(START_M, 1.2), ((WIDTH_M / 2, door + DOOR_M / 2), 1.3)]
    kinds = ["square"] + draw.choices(KINDS, k=3)  # the mission goes to a square
    draw.shuffle(kinds)
    landmarks = []
    for room, kind in zip((0, 0, 1, 1), kinds):
        while True:
            at = (draw.uniform(0.95, 3.05) + room * WIDTH_M / 2, draw.uniform(0.95, HEIGHT_M - 0.95))
            if all(math.dist(at, other) >= gap for other, gap in clear):
                break
        clear.append((at, 1.5))
        landmarks.append((kind, *at, draw.uniform(0, 360)))
    half = 0.05
    lines = [f"bounds_m: [[0, 0], [{WIDTH_M}, {HEIGHT_M}]]", "walls:",
             f"  - {{points_m: [[0, 0], [{WIDTH_M}, 0], [{WIDTH_M}, {HEIGHT_M}], [0, {HEIGHT_M}], [0, 0]], "
             "surface: rough}", "objects:"]
    for low, high in ((0, door), (door + DOOR_M, HEIGHT_M)):
        left, right = WIDTH_M / 2 - half, WIDTH_M / 2 + half
        lines.append(f"  - {{polygon_m: [[{left}, {low:.3f}], [{right}, {low:.3f}], [{right}, {high:.3f}], "
                     f"[{left}, {high:.3f}]]}}")
    lines += [f"  - {{template: {kind}, at_m: [{x:.3f}, {y:.3f}], angle_deg: {angle:.0f}}}"
              for kind, x, y, angle in landmarks]
    return "\n".join(lines) + "\n", [landmark[:3] for landmark in landmarks], draw.choice([0, 45, 90])


def exact_robot(folder):
    text = (CONFIG / "robots/pioneer3dx_serial.yaml").read_text()
    kept = [line for line in text.splitlines() if not line.startswith(("odometry:", "ranges:"))]
    kept += ["odometry: {distance_ratio: 0, distance_bias_ratio: 0, heading_deg_per_m: 0}",
             "ranges: {noise_m: 0, noise_ratio: 0, dropped_ratio: 0, crosstalk_ratio: 0}"]
    file = folder / "exact.yaml"
    file.write_text("\n".join(kept) + "\n")
    return file


def run(build, out, where, seed, localizer):
    folder = out / where / f"seed_{seed}"
    result = folder / "result.json"
    if result.exists():
        return json.loads(result.read_text())
    text, _, heading = world_of(seed)
    world = out / f"world_{seed}.yaml"
    settings = {"world": world, "seed": seed, "start": f"{{at_m: [{START_M[0]}, {START_M[1]}], angle_deg: {heading}}}"}
    if localizer:
        settings["localizer"] = f"{{plugin: {localizer}}}"
    if where == "exact":
        settings["robot"] = out / "exact.yaml"
    if where in ("ros2", "serial"):
        ended = run_live(build, where, folder, settings)
    else:
        ended = run_simulated(build, folder, settings)
    result.write_text(json.dumps(ended))
    print(f"{where} {seed}: {ended['report']['outcome']}, {ended['wall_s']:.0f} s", file=sys.stderr, flush=True)
    return ended


def score(found, true):
    """Right, found, true, and the errors of those that are right; the nearest pairs first."""
    pairs = sorted((math.dist((f["x_m"], f["y_m"]), t[1:]), i, j) for i, f in enumerate(found)
                   for j, t in enumerate(true) if f["category"] == t[0])
    paired, errors = (set(), set()), []
    for error, i, j in pairs:
        if error <= TOLERANCE_M and i not in paired[0] and j not in paired[1]:
            paired[0].add(i)
            paired[1].add(j)
            errors.append(error)
    return len(errors), len(found), len(true), errors


def wilson(right, of):
    if of == 0:
        return "none"
    z, p = 1.96, right / of
    middle = (p + z * z / (2 * of)) / (1 + z * z / of)
    half = z / (1 + z * z / of) * math.sqrt(p * (1 - p) / of + z * z / (4 * of * of))
    return f"{p:.3f} ({max(0, middle - half):.3f} - {min(1, middle + half):.3f})"


def difference(scores, others, column):
    """Of precision (column 1) or recall (2), with its interval."""
    def ratio(these, seeds):
        return sum(these[s][0] for s in seeds) / max(1, sum(these[s][column] for s in seeds))
    seeds = sorted(set(scores) & set(others))
    draw = random.Random(1)
    drawn = sorted(ratio(scores, some) - ratio(others, some)
                   for some in (draw.choices(seeds, k=len(seeds)) for _ in range(4000)))
    return f"{ratio(scores, seeds) - ratio(others, seeds):+.3f} ({drawn[100]:+.3f} to {drawn[-101]:+.3f})"


def row(where, runs, scores):
    right, found, true = (sum(s[column] for s in scores.values()) for column in range(3))
    errors = [error for s in scores.values() for error in s[3]]
    home = [math.dist(run["at"][:2], START_M) for run in runs.values() if "at" in run]
    touches = (sum(run["at"][2] for run in runs.values()) if home
               else sum(run["report"].get("collisions", 0) for run in runs.values()))
    times = [run["report"].get("time_s", 0) for run in runs.values()]
    done = sum(run["exit"] == 0 for run in runs.values())
    print(f"| {NAMES[where]} | {done} of {len(runs)} | {true} | {wilson(right, found)} | {wilson(right, true)} | "
          f"{statistics.median(errors) if errors else math.nan:.3f} | {f'{max(home):.2f}' if home else ''} | {touches} | "
          f"{statistics.median(times):.0f} |")


def main():
    build, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    worlds = int(sys.argv[3]) if len(sys.argv) > 3 else 12
    at_once = int(sys.argv[4]) if len(sys.argv) > 4 else 4
    localizer = sys.argv[5] if len(sys.argv) > 5 else None
    out.mkdir(parents=True, exist_ok=True)
    exact_robot(out)
    truth = {}
    for seed in range(1, worlds + 1):
        text, truth[seed], _ = world_of(seed)
        (out / f"world_{seed}.yaml").write_text(text)
    live = ("ros2", "serial") if at_once > 0 else ()
    runs = {where: {} for where in (*live, "simulated", "exact")}
    for group, at_once_here in ((live, max(1, at_once)), (("simulated", "exact"), 1)):
        with concurrent.futures.ThreadPoolExecutor(at_once_here) as pool:
            begun = {(where, seed): pool.submit(run, build, out, where, seed, localizer) for seed in truth for where in group}
        for (where, seed), ended in begun.items():
            runs[where][seed] = ended.result()
    scores = {where: {seed: score(run["report"]["landmarks"], truth[seed]) for seed, run in of_seed.items()}
              for where, of_seed in runs.items()}
    print("| where | done | true landmarks | precision | recall | median error m | worst at home m | touches | "
          "median s |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|")
    for where in runs:
        row(where, runs[where], scores[where])
    if live:
        print("\n| difference | precision | recall |\n|---|---:|---:|")
    for where in live:
        for other in ("simulated", "exact"):
            print(f"| {NAMES[where]} − {NAMES[other]} | {difference(scores[where], scores[other], 1)} | "
                  f"{difference(scores[where], scores[other], 2)} |")


main()
