#!/usr/bin/env python3
"""Robots that are put down anywhere in a mapped world: do they find themselves?

    tests/bench/kidnapped_table.py OUT [RUNS [WORLD...]]
    tests/bench/kidnapped_table.py OUT RUNS --homes RUN...
    tests/bench/kidnapped_table.py OUT RUNS --worlds RUN...

Each world is mapped once by `explore`. Then RUNS robots begin at random places and headings, and know nothing but the
map and a compass. Starts that the map does not hold as free are a group of their own: there is nothing to be found.

RUN is the folder of a run of config/experiments/tags.yaml: a home with tags, as that run has mapped it. Robots begin at
places that its map holds as free: half of them anywhere, half in front of a tag (1 to 2.5 m, up to 45 degrees aslant,
turned up to 20 degrees off it); each twice, with the tags of the map and without. By shapes a pose is believed after
4 m at the earliest: who finds itself before has done so by tags.

With --worlds, RUN is the folder of a run of config/experiments/recognition.yaml: a random world with landmarks. Robots
begin at places that its map holds as free.
"""
import concurrent.futures, json, math, pathlib, random, re, statistics, subprocess, sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CAIRN = ROOT / "build/release/bin/cairn"
WRONG_M = 0.5
AT_MOST_M = 60
SHAPES_NEED_M = 4
WORLDS = {  # robot, start of the run that maps it, box of the starts
    "office": ("pioneer1", (0.6, 0.6), (0, 0, 6, 5)),
    "my_flat": ("pioneer1", (0.8, 0.8), (0, 0, 8.4, 8)),
    "building": ("pioneer1", (0.8, 6), (0, 0, 18, 12)),
    "joined_rooms": ("pioneer1", (0.6, 0.6), (0, 0, 12, 5)),
    "two_rooms": ("pioneer1", (0.6, 0.6), (0, 0, 12, 6)),
    "hallway": ("pioneer1", (0.6, 0.6), (0, -0.3, 12, 2.7)),
    "store_room": ("pioneer1", (0.6, 0.6), (0, 0, 9, 5)),
    "twins": ("pioneer1", (0.6, 0.6), (0, 0, 8, 6)),
    "turtlebot_home": ("turtlebot3", (0.6, 2.6), (0, 0, 7, 6)),
}
MISSION = """mission: kidnapped
seed: 1
robot: {root}/config/robots/{robot}.yaml
world: {root}/config/worlds/{world}.yaml
start: {{at_m: [{x}, {y}], angle_deg: {angle}}}
sensor: {{plugin: simulated_robot}}
localizer: {{plugin: odometry_compass}}
map: {{plugin: muriel, cell_m: 0.05}}
detector: {{plugin: template_matcher, templates: {root}/config/templates, coarse_cells: 5}}
planner: {{plugin: hybrid}}
steps:
{steps}
"""


def run(folder, world, start, angle, steps, *options):
    folder.mkdir(parents=True, exist_ok=True)
    mission = folder / "mission.yaml"
    mission.write_text(MISSION.format(root=ROOT, robot=WORLDS[world][0], world=world, x=start[0], y=start[1],
                                      angle=angle, steps=steps))
    done = subprocess.run([CAIRN, "run", mission, "--out", folder, "--json", *options], capture_output=True, text=True)
    return json.loads(done.stdout) if done.stdout.startswith("{") else None


def map_world(out, world):
    if not (out / f"map_{world}/kidnapped.cairn").exists():
        run(out / f"map_{world}", world, WORLDS[world][1], 0, "  - explore: {until_known_ratio: 0.97, at_most_s: 3000}")


def kidnap(out, world, i):
    places = random.Random(f"{world} {i}")
    x0, y0, x1, y1 = WORLDS[world][2]
    map_file = out / f"map_{world}/kidnapped.cairn"
    while True:
        start = (round(places.uniform(x0, x1), 2), round(places.uniform(y0, y1), 2))
        summary = run(out / f"{world}_{i}", world, start, places.randrange(360),
                      f"  - find_myself: {{at_most_m: {AT_MOST_M}}}\n  - wait: 1", "--localize-in", str(map_file),
                      "--seed", str(100 + i))
        if summary is None or "cannot start" in summary["reason"]:
            continue  # in a wall
        plan = subprocess.run([CAIRN, "plan", map_file, "--from", f"{start[0]},{start[1]}", "--to",
                               f"{WORLDS[world][1][0]},{WORLDS[world][1][1]}", "--radius-m", "0.1", "--json"],
                              capture_output=True, text=True)
        found = summary["localisation"]
        return {"world": world, "run": i, "start": start, "is_mapped": plan.returncode == 0, "is_found": "found_s" in found,
                "driven_m": found["driven_m"], "error_m": summary.get("pose_error", {}).get("last_m"),
                "touches": summary["collisions"], "reason": summary["reason"]}


HOME = """mission: kidnapped
seed: 1
robot: {folder}/robot.yaml
world: {folder}/world.yaml
start: {{at_m: [{x}, {y}], angle_deg: {angle}}}
sensor: {{plugin: simulated_robot}}
localizer: {{plugin: odometry_compass}}
map: {{plugin: muriel, cell_m: 0.05}}
planner: {{plugin: hybrid}}
{markers}steps:
  - find_myself: {{at_most_m: {at_most_m}}}
  - wait: 1
"""


TRIED_PLACES = 200
RANDOM_WORLD = """mission: kidnapped
seed: 1
robot: {root}/config/robots/pioneer1.yaml
world: {folder}/world.yaml
start: {{at_m: [{x}, {y}], angle_deg: {angle}}}
sensor: {{plugin: simulated_robot}}
localizer: {{plugin: odometry_compass}}
map: {{plugin: muriel, cell_m: 0.05, false_echo_per_m: 2}}
detector: {{plugin: template_matcher, templates: {root}/config/templates, sizes: [1, 1.07], coarse_cells: 5, degrees: above_threshold}}
planner: {{plugin: hybrid}}
steps:
  - find_myself: {{at_most_m: {at_most_m}}}
  - wait: 1
"""


def place_before_tag(places, tag):
    number, x, y, facing = tag
    distance, aside = places.uniform(1.0, 2.5), math.radians(facing + places.uniform(-45, 45))
    return ((round(x + distance * math.cos(aside), 2), round(y + distance * math.sin(aside), 2)),
            round(math.degrees(aside) + 180 + places.uniform(-20, 20)) % 360)


# Its summary; none where the robot cannot start.
def run_lost(folder, mission, map_file, i):
    (folder / "mission.yaml").write_text(mission)
    done = subprocess.run([CAIRN, "run", folder / "mission.yaml", "--out", folder, "--json", "--localize-in", map_file,
                           "--seed", str(100 + i)], capture_output=True, text=True)
    summary = json.loads(done.stdout) if done.stdout.startswith("{") else None
    return None if summary is None or "cannot start" in summary["reason"] else summary


def kidnap_at_home(out, home, i, has_markers):
    world = (home / "world.yaml").read_text()
    width, height = (float(word) for word in re.search(r"bounds_m: \[\[0, 0\], \[(\S+), (\S+)\]\]", world).groups())
    tags = [tuple(map(float, tag))
            for tag in re.findall(r"- {id: (\d+), at_m: \[(\S+), (\S+)\], facing_deg: (\S+), height_m", world)]
    map_file = home / "tagged_homes.cairn"
    places = random.Random(f"{home.name} {i}")
    folder = out / f"{home.name}_{i}_{'tags' if has_markers else 'shapes'}"
    folder.mkdir(parents=True, exist_ok=True)
    while True:
        start, angle = (round(places.uniform(0, width), 2), round(places.uniform(0, height), 2)), places.randrange(360)
        if i % 2 == 1:
            start, angle = place_before_tag(places, places.choice(tags))
        plan = subprocess.run([CAIRN, "plan", map_file, "--from", f"{start[0]},{start[1]}", "--to",
                               f"tag {tags[0][0]:.0f}", "--radius-m", "0.25", "--json"], capture_output=True, text=True)
        if plan.returncode != 0:
            continue  # in a wall, or not in the map
        markers = "markers: {detector: {plugin: april_tags, size_m: 0.16}}\n" if has_markers else ""
        mission = HOME.format(folder=home, x=start[0], y=start[1], angle=angle, markers=markers, at_most_m=AT_MOST_M)
        summary = run_lost(folder, mission, map_file, i)
        if summary is None:
            continue
        found = summary["localisation"]
        return {"home": home.name, "run": i, "is_before_tag": i % 2 == 1, "has_markers": has_markers,
                "is_found": "found_s" in found, "found_s": found.get("found_s"), "driven_m": found["driven_m"],
                "error_m": summary.get("pose_error", {}).get("last_m"), "touches": summary["collisions"]}


def kidnap_in_random_world(out, world, i):
    width, height = map(float, re.search(r"bounds_m: \[\[0, 0\], \[(\S+), (\S+)\]\]",
                                         (world / "world.yaml").read_text()).groups())
    map_file = world / "recognition.cairn"
    places = random.Random(f"{world.name} {i}")
    folder = out / f"{world.name}_{i}"
    folder.mkdir(parents=True, exist_ok=True)
    for _ in range(TRIED_PLACES):
        start, angle = (round(places.uniform(0, width), 2), round(places.uniform(0, height), 2)), places.randrange(360)
        place = f"{start[0]},{start[1]}"
        is_free = subprocess.run([CAIRN, "plan", map_file, "--from", place, "--to", place, "--radius-m", "0.25"],
                                 capture_output=True).returncode == 0
        if not is_free:
            continue  # in a wall, or not in the map
        mission = RANDOM_WORLD.format(root=ROOT, folder=world, x=start[0], y=start[1], angle=angle, at_most_m=AT_MOST_M)
        summary = run_lost(folder, mission, map_file, i)
        if summary is None:
            continue
        landmarks = json.loads(subprocess.run([CAIRN, "map", "info", map_file, "--json"], capture_output=True).stdout)
        found = summary["localisation"]
        return {"world": world.name, "run": i, "start": start, "landmarks": landmarks["landmarks"],
                "is_found": "found_s" in found, "driven_m": found["driven_m"],
                "error_m": summary.get("pose_error", {}).get("last_m"), "touches": summary["collisions"]}
    raise SystemExit(f"{world}: none of {TRIED_PLACES} places is free in its map")


def print_random_worlds_table(rows):
    print("| landmarks in the map | worlds | put down | found | within 15 m | wrongly believed | driven m, median, most | "
          "error m, median, most | touches |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|")
    groups = [("none", lambda n: n == 0), ("1", lambda n: n == 1), ("2 or more", lambda n: n >= 2), ("all", lambda n: True)]
    for name, is_in in groups:
        mine = [row for row in rows if is_in(row["landmarks"])]
        right = [row for row in mine if row["is_found"] and row["error_m"] <= WRONG_M]
        of = lambda key: (f"{statistics.median(r[key] for r in right):.2f}, {max(r[key] for r in right):.2f}"
                          if right else "")
        print(f"| {name} | {len({row['world'] for row in mine})} | {len(mine)} | {len(right)} | "
              f"{sum(row['driven_m'] <= 15 for row in right)} | {sum(row['is_found'] for row in mine) - len(right)} | "
              f"{of('driven_m')} | {of('error_m')} | {sum(row['touches'] for row in mine)} |")


def kidnap_in_random_worlds(out, runs, worlds):
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(lambda job: kidnap_in_random_world(out, *job), [(w, i) for w in worlds for i in range(runs)]))
    (out / "worlds.json").write_text(json.dumps(rows, indent=1))
    print_random_worlds_table(rows)


def print_homes_table(rows):
    print("| robots | put down | found | wrongly believed | by tags | driven m, median, most | s, median, most | "
          "error m, median, most | touches |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|")
    for is_before_tag in (True, False):
        for has_markers in (True, False):
            mine = [row for row in rows if row["has_markers"] == has_markers and row["is_before_tag"] == is_before_tag]
            right = [row for row in mine if row["is_found"] and row["error_m"] <= WRONG_M]
            of = lambda key: (f"{statistics.median(r[key] for r in right):.2f}, {max(r[key] for r in right):.2f}"
                              if right else "")
            print(f"| {'in front of a tag' if is_before_tag else 'anywhere'}, {'with' if has_markers else 'without'} tags | "
                  f"{len(mine)} | {len(right)} | {sum(row['is_found'] for row in mine) - len(right)} | "
                  f"{sum(row['driven_m'] < SHAPES_NEED_M for row in right)} | {of('driven_m')} | {of('found_s')} | "
                  f"{of('error_m')} | {sum(row['touches'] for row in mine)} |")


def kidnap_at_homes(out, runs, homes):
    jobs = [(home, i, has_markers) for home in homes for i in range(runs) for has_markers in (True, False)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(lambda job: kidnap_at_home(out, *job), jobs))
    (out / "homes.json").write_text(json.dumps(rows, indent=1))
    print_homes_table(rows)


def print_table(rows):
    print("| world | starts in the map | found | within 15 m | wrongly believed | driven m, median, most | error m, median, most |"
          " starts outside | of these believed | touches |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|")
    for world in dict.fromkeys(row["world"] for row in rows):
        mine = [row for row in rows if row["world"] == world]
        inside = [row for row in mine if row["is_mapped"]]
        outside = [row for row in mine if not row["is_mapped"]]
        right = [row for row in inside if row["is_found"] and row["error_m"] <= WRONG_M]
        wrong = sum(row["is_found"] for row in inside) - len(right)
        of = lambda key: f"{statistics.median(r[key] for r in right):.2f}, {max(r[key] for r in right):.2f}" if right else ""
        print(f"| {world} | {len(inside)} | {len(right)} | {sum(r['driven_m'] <= 15 for r in right)} | {wrong} | "
              f"{of('driven_m')} | {of('error_m')} | {len(outside)} | {sum(r['is_found'] for r in outside)} | "
              f"{sum(r['touches'] for r in mine)} |")


def main():
    out = pathlib.Path(sys.argv[1]).resolve()
    runs = int(sys.argv[2]) if len(sys.argv) > 2 else 10
    if sys.argv[3:4] == ["--homes"]:
        kidnap_at_homes(out, runs, [pathlib.Path(folder).resolve() for folder in sys.argv[4:]])
        return
    if sys.argv[3:4] == ["--worlds"]:
        kidnap_in_random_worlds(out, runs, [pathlib.Path(folder).resolve() for folder in sys.argv[4:]])
        return
    worlds = sys.argv[3:] or list(WORLDS)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda world: map_world(out, world), worlds))
        rows = list(pool.map(lambda job: kidnap(out, *job), [(w, i) for w in worlds for i in range(runs)]))
    (out / "rows.json").write_text(json.dumps(rows, indent=1))
    print_table(rows)


main()
