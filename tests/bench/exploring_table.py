#!/usr/bin/env python3
"""How far and how long exploring was to 95 % known, by the rule that chose the frontiers.

    build/release/bin/cairn experiment config/experiments/exploring.yaml --out out/exploring
    tests/bench/exploring_table.py out/exploring

Known is an area: the whole is the least that any of the rules had known at its end on that seed, so that all of them
come to 95 % of it. Intervals are 95 % bootstrap intervals of the mean difference to the first rule, seed by seed.
Needs nothing but Python.
"""
import json, math, pathlib, random, re, sys

LINE = re.compile(r"^([\d.]+) s: at \((-?[\d.]+), (-?[\d.]+)\): ([\d.]+) m2$")


def steps_of(report):
    """(time s, distance m, known m2) a line that the mission has said."""
    steps, way, last = [], 0.0, None
    for event in report["events"]:
        found = LINE.match(event)
        if not found:
            continue
        here = (float(found[2]), float(found[3]))
        way += math.dist(last, here) if last else 0.0
        last = here
        steps.append((float(found[1]), way, float(found[4])))
    return steps


def first_at(steps, area):
    return next((time, way) for time, way, known in steps if known >= area)


def interval(differences):
    draw = random.Random(1)
    means = sorted(sum(draw.choices(differences, k=len(differences))) / len(differences) for _ in range(4000))
    return means[100], means[-101]


def main(folder):
    runs = {}
    for file in pathlib.Path(folder).glob("*/*/seed_*/report.json"):
        seed = int(file.parent.name.removeprefix("seed_"))
        report = json.loads(file.read_text())
        runs.setdefault(seed, {})[file.parent.parent.name] = (steps_of(report), report)
    rules = sorted({rule for of_seed in runs.values() for rule in of_seed}, key=lambda rule: (rule != "nearest", rule))
    runs = {seed: of_seed for seed, of_seed in runs.items() if len(of_seed) == len(rules)}
    print(f"{len(runs)} seeds: {min(runs)} to {max(runs)}")
    print("| rule | s to 95 % | against the first | m to 95 % | against the first | m2 at the end | s to the end | m to "
          "the end |")
    print("|---|---|---|---|---|---|---|---|")
    firsts = {}
    for seed, of_seed in runs.items():
        whole = min(steps[-1][2] for steps, _ in of_seed.values())
        firsts[seed] = {rule: first_at(steps, 0.95 * whole) for rule, (steps, _) in of_seed.items()}
    for rule in rules:
        cells = []
        for kind in (0, 1):
            values = [firsts[seed][rule][kind] for seed in runs]
            less = [firsts[seed][rule][kind] - firsts[seed][rules[0]][kind] for seed in runs]
            low, high = interval(less)
            mean = sum(values) / len(values)
            cells.append(f"{mean:.1f}")
            cells.append("" if rule == rules[0] else f"{sum(less) / len(less):+.1f} ({low:+.1f} to {high:+.1f})")
        ends = [of_seed[rule] for of_seed in runs.values()]
        cells.append(f"{sum(steps[-1][2] for steps, _ in ends) / len(ends):.1f}")
        cells.append(f"{sum(report['time_s'] for _, report in ends) / len(ends):.0f}")
        cells.append(f"{sum(report['distance_m'] for _, report in ends) / len(ends):.1f}")
        print(f"| {rule} | " + " | ".join(cells) + " |")


main(sys.argv[1])
