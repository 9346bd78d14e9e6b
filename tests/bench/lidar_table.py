#!/usr/bin/env python3
"""What a tick costs against the beams of a laser: a table and a chart (docs/results/lidar.md).

    tests/bench/lidar_table.py out/lidar [--old PROGRAM] [--beams 7,60,180,...] [--chart docs/results/pictures/lidar_ticks.svg]

Each run explores the office for a minute with all modules: a laser of 270 degrees and 20 scans a second, a scan each
tick. A program that knows no `lasers:` (--old) gets the beams as sonars of no width that fire together. The programs
take turns, so that what else the machine does meets both. Needs nothing but Python.
"""
import argparse, json, os, pathlib, subprocess, sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIELD_DEG = 270

ROBOT = """name: laser of {beams} beams
radius_m: 0.22
limits: {{max_v_mps: 0.4, max_w_degps: 100, max_acceleration_mps2: 0.5, max_turn_acceleration_degps2: 200}}
odometry: {{distance_ratio: 0.01, heading_deg_per_m: 0.5}}
compass: {{noise_deg: 2}}
"""

MISSION = """mission: lidar_ticks
seed: 7
robot: {robot}
world: {root}/config/worlds/office.yaml
start: {{at_m: [0.6, 0.6], angle_deg: 0}}
sensor: {{plugin: simulated_robot, tick_s: 0.05}}
localizer: {{plugin: odometry_compass}}
map: {{plugin: muriel, cell_m: 0.05}}
detector: {{plugin: template_matcher, templates: {root}/config/templates, rendering: ideal, coarse_cells: 5}}
planner: {{plugin: hybrid}}
at_most_s: 60
steps:
  - explore: {{until_known_ratio: 1, at_most_s: 55}}
"""


def robot_with_laser(beams):
    half = FIELD_DEG / 2
    return ROBOT.format(beams=beams) + (
        f"lasers:\n  - {{x_m: 0.1, y_m: 0, first_angle_deg: {-half}, last_angle_deg: {half}, beams: {beams}, "
        "min_m: 0.05, max_m: 8, rate_hz: 20, noise_m: 0.01}\n")


def robot_with_rays(beams):
    text = ROBOT.format(beams=beams) + "ranges: {noise_m: 0.01, noise_ratio: 0, dropped_ratio: 0, crosstalk_ratio: 0}\n"
    text += "firing: {period_s: 0}\nsonars:\n"
    for i in range(beams):
        angle = -FIELD_DEG / 2 + FIELD_DEG * i / (beams - 1)
        text += f"  - {{x_m: 0.1, y_m: 0, angle_deg: {angle:.6f}, half_beam_deg: 0, min_m: 0.05, max_m: 8}}\n"
    return text


def run(program, robot_text, folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "robot.yaml").write_text(robot_text)
    (folder / "mission.yaml").write_text(MISSION.format(robot=folder / "robot.yaml", root=ROOT))
    done = subprocess.run([program, "run", str(folder / "mission.yaml"), "--out", str(folder)], capture_output=True)
    if not (folder / "timing.json").exists():
        sys.exit(done.stderr.decode())
    return json.loads((folder / "timing.json").read_text())


def stage(times, name):
    return next((t for t in times if t["stage"] == name), None)


def listed_ratio(times):
    """Of a tick's time, what its stages account for; sums of own times where the program knows them."""
    tick = stage(times, "tick")
    if "own_s" in tick:
        return 1 - tick["own_s"] / tick["total_s"]
    inside = ("localizer", "map", "detector", "behaviour", "drive")
    return sum(t["total_s"] for t in times if t["stage"] in inside) / tick["total_s"]


def row(beams, times):
    tick, sensor = stage(times, "tick"), stage(times, "sensor")
    return {"beams": beams, "median_ms": tick["median_us"] / 1e3, "p99_ms": tick["p99_us"] / 1e3,
            "mean_ms": 1e3 * tick["total_s"] / tick["count"], "listed": listed_ratio(times),
            "sensor_ms": sensor["median_us"] / 1e3}


def chart(series, file):
    """Median tick against beams, both logarithmic."""
    import math
    left, top, width, height = 70, 20, 520, 300
    beams = [r["beams"] for _, rows, _ in series for r in rows]
    values = [r["median_ms"] for _, rows, _ in series for r in rows]
    x_low, x_high = math.log10(min(beams)), math.log10(max(beams))
    y_low, y_high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    x_of = lambda b: left + width * (math.log10(b) - x_low) / (x_high - x_low)
    y_of = lambda v: top + height * (y_high - math.log10(v)) / (y_high - y_low)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="780" height="{top + height + 60}" '
           'font-family="sans-serif" font-size="13">',
           '<rect width="100%" height="100%" fill="white"/>']
    for power in range(y_low, y_high + 1):
        y = y_of(10 ** power)
        out.append(f'<line x1="{left}" y1="{y:.1f}" x2="{left + width}" y2="{y:.1f}" stroke="#ddd"/>'
                   f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{10.0 ** power:g}</text>')
    for b in sorted(set(beams)):
        out.append(f'<text x="{x_of(b):.1f}" y="{top + height + 18}" text-anchor="middle" font-size="11">{b}</text>')
    y = y_of(2.0)
    out.append(f'<line x1="{left}" y1="{y:.1f}" x2="{left + width}" y2="{y:.1f}" stroke="#888" stroke-dasharray="4 4"/>'
               f'<text x="{left + width + 12}" y="{y + 4:.1f}" fill="#666">2 ms</text>')
    for k, (name, rows, colour) in enumerate(series):
        points = " ".join(f'{x_of(r["beams"]):.1f},{y_of(r["median_ms"]):.1f}' for r in rows)
        out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>')
        out += [f'<circle cx="{x_of(r["beams"]):.1f}" cy="{y_of(r["median_ms"]):.1f}" r="3" fill="{colour}"/>'
                for r in rows]
        out.append(f'<rect x="{left + width + 12}" y="{top + 22 * k}" width="12" height="12" fill="{colour}"/>'
                   f'<text x="{left + width + 30}" y="{top + 11 + 22 * k}">{name}</text>')
    out.append(f'<text x="{left + width / 2}" y="{top + height + 42}" text-anchor="middle">beams of a scan</text>'
               f'<text transform="translate(18 {top + height / 2}) rotate(-90)" text-anchor="middle">'
               'median tick, ms</text></svg>')
    pathlib.Path(file).write_text("\n".join(out) + "\n")


def print_table(title, rows):
    print(f"\n{title}\n\n| beams | tick, median | mean | p99 | stages / tick | simulated sensor |\n"
          "|---:|---:|---:|---:|---:|---:|")
    for r in rows:
        print(f"| {r['beams']} | {r['median_ms']:.3f} ms | {r['mean_ms']:.3f} ms | {r['p99_ms']:.2f} ms | "
              f"{100 * r['listed']:.1f} % | {r['sensor_ms']:.3f} ms |")


def print_stages(beams, times):
    tick = stage(times, "tick")
    print(f"\nStages of a tick with {beams} beams\n\n| stage | own time a tick, mean | a call, median | p99 |\n"
          "|---|---:|---:|---:|")
    for t in times:
        if t["stage"] in ("tick", "sensor") or "own_s" not in t:
            continue
        print(f"| {t['stage']} {t['module']} | {1e6 * t['own_s'] / tick['count']:.1f} us | {t['median_us']:.1f} us | "
              f"{t['p99_us']:.1f} us |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/cairn"))
    parser.add_argument("--old", help="a program to compare with")
    parser.add_argument("--old-up-to", type=int, default=700, help="most beams that it is asked for")
    parser.add_argument("--beams", default="7,60,180,360,660,1080,1500,2000")
    parser.add_argument("--chart")
    asked = parser.parse_args()
    out = asked.out.resolve()
    rows, old_rows, stages = [], [], {}
    for beams in map(int, asked.beams.split(",")):
        stages[beams] = run(asked.program, robot_with_laser(beams), out / f"laser{beams}")
        rows.append(row(beams, stages[beams]))
        if asked.old and beams <= asked.old_up_to:
            old_rows.append(row(beams, run(asked.old, robot_with_rays(beams), out / f"rays{beams}")))
    print_table("This program", rows)
    if old_rows:
        print_table("The other program", old_rows)
    print_stages(1080 if 1080 in stages else max(stages), stages.get(1080, stages[max(stages)]))
    if asked.chart:
        series = [("this program", rows, "#1a6fb0")]
        if old_rows:
            series.append(("before", old_rows, "#c0504d"))
        chart(series, asked.chart)


main()
