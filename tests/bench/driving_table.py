#!/usr/bin/env python3
"""Missions in random worlds with movers, doors and faults: what they touched, and which places they reached.

    tests/bench/driving_table.py --from 101 --count 100 --out out/driving [--build build/release] [--goals 3]

The worlds are those of `cairn experiment` (framework/host/random_world.hpp); goals are random places clear of everything
fixed by 0.45 m. Writes a line a run and the sums at the end. Needs nothing but Python.
"""
import argparse, json, math, pathlib, random, re, subprocess
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
RADII_M = {"circle": 0.35, "square": 0.45, "triangle": 0.5}  # of the templates, generously
FAULTS = "{per_hour: {dead: 20, stuck: 20, slip: 0, compass_jump: 0, silent: 20, kidnap: 0}, for_s: 8}"

MISSION = """mission: random_drive
robot: {robot}
world: world.yaml
start: {{at_m: [0.6, 0.6], angle_deg: 0}}
sensor: {{plugin: simulated_robot, random_faults: {faults}}}
localizer: {{plugin: odometry_compass}}
map: {{plugin: muriel, cell_m: 0.05}}
planner: {{plugin: hybrid, route: {{plugin: ompl}}}}
autosave: {{every_s: 0}}
steps:
  - always: {{explore: {{until_known_ratio: 0.97, at_most_s: {explore_s}, look_closer_m: 0}}}}
{goals}"""
GOAL = "  - always: {{goto: {{at_m: [{x:.2f}, {y:.2f}]}}}}\n"


def worlds(args, seeds):
    experiment = args.out / "worlds.yaml"
    mission = args.out / "templates.yaml"
    config = ROOT / "config"
    mission.write_text(f"mission: worlds\nrobot: {config}/robots/pioneer1.yaml\nworld: {config}/worlds/office.yaml\n"
                       "start: {at_m: [0.6, 0.6], angle_deg: 0}\nsensor: {plugin: simulated_robot}\n"
                       "localizer: {plugin: odometry_compass}\nmap: {plugin: muriel, cell_m: 0.2}\n"
                       f"detector: {{plugin: template_matcher, templates: {config}/templates, coarse_cells: 2, rendering: ideal}}\n"
                       "steps:\n  - wait: 0.1\n")
    experiment.write_text(f"experiment: recognition\nmissions: [{mission.name}]\nseeds: {{from: {seeds[0]}, count: {len(seeds)}}}\n"
                          f"worlds: {{most_movers: {args.movers}, most_doors: {args.doors}}}\n"
                          f"variants:\n  - {{name: one, specular_ratio: {args.specular}}}\n")
    subprocess.run([args.cairn, "experiment", experiment, "--out", args.out / "worlds"], check=False, capture_output=True)


def without_templates(world):
    """The same outlines as plain obstacles: no detector is needed to drive past them."""
    def outline(match):
        scale = float(match[2])
        if match[1] == "circle":
            return f"circle_diameter_m: {0.5 * scale:.3f}"
        corners = {"square": [(-0.25, -0.25), (0.25, -0.25), (0.25, 0.25), (-0.25, 0.25)],
                   "triangle": [(-0.3, -0.1732), (0.3, -0.1732), (0, 0.3464)]}[match[1]]
        return "polygon_m: [" + ", ".join(f"[{scale * x:.3f}, {scale * y:.3f}]" for x, y in corners) + "]"
    return re.sub(r"template: (\w+), scale: ([\d.]+)", outline, world)


def numbers(text):
    return [float(n) for n in re.findall(r"-?\d+\.?\d*", text)]


def free_places(world, count, rng):
    things, segments = [], []
    size = numbers(re.search(r"bounds_m: (.*)", world)[1])[2:]
    for line in world.splitlines():
        if line.startswith("  - {points_m"):
            n = numbers(line.split("surface")[0])
            segments.append(n[:4])
        at = re.search(r"at_m: \[([-\d.]+), ([-\d.]+)\]", line)
        if not at or "path_m" in line:
            continue
        template = re.search(r"template: (\w+)", line)
        circle = re.search(r"circle_diameter_m: ([\d.]+)", line)
        radius = RADII_M[template[1]] if template else 0.5 * float(circle[1]) if circle else 0.8
        things.append((float(at[1]), float(at[2]), radius))

    def clear(x, y):
        for a, b, r in things:
            if math.hypot(x - a, y - b) < r + 0.45:
                return False
        for x0, y0, x1, y1 in segments:
            dx, dy = x1 - x0, y1 - y0
            t = max(0, min(1, ((x - x0) * dx + (y - y0) * dy) / max(1e-9, dx * dx + dy * dy)))
            if math.hypot(x - x0 - t * dx, y - y0 - t * dy) < 0.45:
                return False
        return True

    places = []
    while len(places) < count:
        x, y = rng.uniform(0.4, size[0] - 0.4), rng.uniform(0.4, size[1] - 0.4)
        if clear(x, y):
            places.append((x, y))
    return places


def run(args, seed):
    found = list((args.out / "worlds").rglob(f"seed_{seed}/world.yaml"))
    folder = args.out / f"seed_{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    world = found[0].read_text()
    if args.carts:
        world = re.sub(r"(pause_s: [\d.]+)}", r"\1, waits: false}", world)
    (folder / "world.yaml").write_text(without_templates(world))
    places = free_places(world, args.goals, random.Random(seed))
    (folder / "mission.yaml").write_text(MISSION.format(
        robot=args.robot, faults=args.faults, explore_s=args.explore_s,
        goals="".join(GOAL.format(x=x, y=y) for x, y in places)))
    with open(folder / "stdout.json", "w") as out:
        subprocess.run([args.cairn, "run", folder / "mission.yaml", "--seed", str(seed), "--out", folder, "--json"],
                       stdout=out, stderr=subprocess.DEVNULL)
    report = json.loads((folder / "report.json").read_text())
    goals = [n for n in report["nodes"] if n["kind"] == "goto"]
    bad = [c for c in report["contacts"] if c["speed_mps"] > 0.05 and c["could_be_seen"]]
    failed = [g["reason"] for g in goals if g["outcome"] != "success"]
    summary = json.loads((folder / "stdout.json").read_text())
    print(f"seed {seed}: {report['outcome']} {len(goals) - len(failed)}/{args.goals} goals, {report['time_s']:.0f} s, "
          f"contacts {len(report['contacts'])}, bad {[(c['time_s'], round(c['speed_mps'], 3)) for c in bad]}, "
          f"stop layer {report['stop_layer']}, wall {summary['wall_s']:.1f} s", *("\n    " + f for f in failed), flush=True)
    return len(goals) - len(failed), len(bad), len(report["contacts"])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--from", dest="first", type=int, default=1)
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--goals", type=int, default=3)
    parser.add_argument("--movers", type=int, default=3)
    parser.add_argument("--carts", action="store_true", help="movers do not wait for the robot")
    parser.add_argument("--doors", type=int, default=1)
    parser.add_argument("--specular", type=float, default=0.0)
    parser.add_argument("--explore-s", type=float, default=400)
    parser.add_argument("--faults", default=FAULTS)
    parser.add_argument("--robot", default=str(ROOT / "config/robots/pioneer1.yaml"))
    parser.add_argument("--build", default=str(ROOT / "build/release"))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    args = parser.parse_args()
    args.out = args.out.resolve()
    args.out.mkdir(parents=True, exist_ok=True)
    args.cairn = f"{args.build}/bin/cairn"
    seeds = list(range(args.first, args.first + args.count))
    if not all(list((args.out / "worlds").rglob(f"seed_{s}/world.yaml")) for s in seeds):
        worlds(args, seeds)
    with ThreadPoolExecutor(args.jobs) as pool:
        rows = list(pool.map(lambda seed: run(args, seed), seeds))
    reached, bad, contacts = (sum(column) for column in zip(*rows))
    print(f"{len(rows)} missions: {reached} of {len(rows) * args.goals} goals reached, {contacts} contacts, {bad} of them "
          "faster than 0.05 m/s and to be seen")


if __name__ == "__main__":
    main()
