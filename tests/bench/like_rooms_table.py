#!/usr/bin/env python3
"""Loops that are closed where rooms look alike: are they loops?

    tests/bench/like_rooms_table.py OUT [FIRST_SEED [RUNS]]

Two kinds of random worlds, in turn: `rooms`, two rooms with the same furniture, side by side along a hall; `doors`, a
corridor with four to six like rooms behind like doors. A robot with worn wheels explores and comes back: `laser`,
turtlebot3_worn.yaml, without compass, with the settings of slam_home.yaml; `sonar`, pioneer3dx.yaml with the odometry
and the compass of pioneer1_worn.yaml, and the settings of slam_sonar.yaml. A closure of the saved map is false when it
puts its two nodes more than 1 m or 30 degrees from where they truly were to each other, and poor from half of that on.
The rooms are 2.4 m wide or more. What is told of the pose is the error of poses.tum, after the last correction, of the
robot's place against its true one.
"""
import concurrent.futures, json, math, pathlib, random, sqlite3, statistics, subprocess, sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CAIRN = ROOT / "build/release/bin/cairn"
FALSE_M, FALSE_DEG = 1, 30
WORN = ("odometry: {distance_ratio: 0.03, distance_bias_ratio: 0.02, heading_deg_per_m: 2}\n"
        "compass: {noise_deg: 2, local_bias_deg: 5, local_bias_scale_m: 2}\n")  # as in pioneer1_worn.yaml
LOCALIZERS = {
    "laser": "localizer: {plugin: submap_graph, sweep_s: 0.2}",
    "sonar": """localizer: {plugin: submap_graph, gather_m: 5, submap_m: 8, widest_half_beam_deg: 20, longest_m: 5,
  surface_cell_m: 0.3, echo_sigma_m: 0.1, odometry_ratio: 0.05, odometry_deg_per_m: 2}
loop_closer: {plugin: submap_correlation, field_sigma_m: 0.15, max_window_m: 3, min_score: 0.6}""",
}
MISSION = """mission: like_rooms
seed: {seed}
robot: {robot}
world: world.yaml
start: {{at_m: [{x:.2f}, {y:.2f}], angle_deg: 0}}
sensor: {{plugin: simulated_robot}}
{localizer}
map: {{plugin: muriel, cell_m: 0.05}}
planner: {{plugin: hybrid}}
at_most_s: 1000
record: run.log
steps:
  - force_success: {{explore: {{until_known_ratio: 1, at_most_s: 600}}}}
  - force_success: {{timeout: {{after_s: 300, do: {{goto: {{at_m: [{x:.2f}, {y:.2f}]}}}}}}}}
"""


def box(x, y, w, h):
    corners = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
    points = ", ".join(f"[{corner[0]:.2f}, {corner[1]:.2f}]" for corner in corners)
    return f"  - {{polygon_m: [{points}], surface: rough}}"


def world_of(kind, seed):
    """The world's text, and where the robot begins in its hall."""
    dice = random.Random(f"{kind} {seed}")
    rooms = 2 if kind == "rooms" else dice.randint(4, 6)
    width = dice.uniform(3.2, 5) if kind == "rooms" else dice.uniform(2.4, 3.4)
    depth = dice.uniform(3, 4.5) if kind == "rooms" else dice.uniform(2.4, 3.4)
    hall = dice.uniform(1.4, 2)
    door = dice.uniform(0.9, 1.1)
    door_at = dice.uniform(0.4, width - door - 0.4)
    furniture = []  # within a room, along its walls, not before its door
    for _ in range(dice.randint(1, 3)):
        w, h = dice.uniform(0.4, 0.9), dice.uniform(0.3, 0.6)
        furniture.append((dice.choice([0, width - w]), dice.uniform(1.2, depth - h), w, h))
    walls = [f"[[0, {-hall:.2f}], [{rooms * width:.2f}, {-hall:.2f}], [{rooms * width:.2f}, {depth:.2f}], "
             f"[0, {depth:.2f}], [0, {-hall:.2f}]]"]
    boxes = []
    for room in range(rooms):
        left = room * width
        walls += [f"[[{left:.2f}, 0], [{left + door_at:.2f}, 0]]",
                  f"[[{left + door_at + door:.2f}, 0], [{left + width:.2f}, 0]]"]
        if room > 0:
            walls.append(f"[[{left:.2f}, 0], [{left:.2f}, {depth:.2f}]]")
        boxes += [box(left + x, y, w, h) for x, y, w, h in furniture]
    text = (f"bounds_m: [[0, {-hall:.2f}], [{rooms * width:.2f}, {depth:.2f}]]\nwalls:\n" +
            "".join(f"  - {{points_m: {points}, surface: rough}}\n" for points in walls) +
            "objects:\n" + "\n".join(boxes) + "\n")
    return text, (0.6, -hall / 2)


def robot_of(kind, folder):
    if kind == "laser":
        return ROOT / "config/robots/turtlebot3_worn.yaml"
    lines = (ROOT / "config/robots/pioneer3dx.yaml").read_text().splitlines(keepends=True)
    path = folder / "robot.yaml"
    path.write_text("".join(line for line in lines if not line.startswith(("odometry:", "compass:"))) + WORN)
    return path


def true_poses(log):
    poses = []
    for line in log.read_text().splitlines():
        if line.startswith("TRUEPOS"):
            words = line.split()
            poses.append((float(words[-3]), float(words[1]), float(words[2]), float(words[3])))
    return poses


def at(poses, stamp_s):
    return min(poses, key=lambda pose: abs(pose[0] - stamp_s))[1:]


def between(a, b):
    dx, dy, turn = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    return (math.cos(a[2]) * dx + math.sin(a[2]) * dy, math.cos(a[2]) * dy - math.sin(a[2]) * dx,
            math.remainder(turn, 2 * math.pi))


def closures_of(saved, poses):
    """How many are believed, and how many of those are poor, and false."""
    with sqlite3.connect(saved) as database:
        stamps = dict(database.execute("SELECT number, stamp_s FROM submap_nodes"))
        edges = database.execute("SELECT from_node, to_node, x_m, y_m, theta_rad FROM submap_edges "
                                 "WHERE closure = 1 AND believed = 1").fetchall()
    poor = false = 0
    for start, end, x, y, turn in edges:
        truth = between(at(poses, stamps[start]), at(poses, stamps[end]))
        off_m = math.hypot(truth[0] - x, truth[1] - y)
        off_deg = abs(math.degrees(math.remainder(truth[2] - turn, 2 * math.pi)))
        off = max(off_m / FALSE_M, off_deg / FALSE_DEG)
        poor += 0.5 < off <= 1
        false += off > 1
    return len(edges), poor, false


def pose_errors(tum, poses):
    """After the last correction, in m, one pose a second."""
    errors, last_s = [], -1
    for line in tum.read_text().splitlines():
        words = [float(word) for word in line.split()]
        if words[0] < last_s + 1:
            continue
        last_s = words[0]
        truth = at(poses, words[0])
        errors.append(math.hypot(words[1] - truth[0], words[2] - truth[1]))
    return errors


def one_run(job):
    robot, world, seed, out = job
    folder = out / robot / world / str(seed)
    result = folder / "row.json"
    if result.exists():
        return json.loads(result.read_text())
    folder.mkdir(parents=True, exist_ok=True)
    text, start = world_of(world, seed)
    (folder / "world.yaml").write_text(text)
    (folder / "mission.yaml").write_text(MISSION.format(seed=seed, robot=robot_of(robot, folder), x=start[0],
                                                        y=start[1], localizer=LOCALIZERS[robot]))
    done = subprocess.run([CAIRN, "run", folder / "mission.yaml", "--out", folder, "--json"], capture_output=True,
                          text=True)
    if not done.stdout.startswith("{"):
        sys.exit(f"{folder}: {done.stderr}")
    report = json.loads(done.stdout)
    poses = true_poses(folder / "run.log")
    closures, poor, false = closures_of(folder / "like_rooms.cairn", poses)
    errors = pose_errors(folder / "poses.tum", poses) if (folder / "poses.tum").exists() else []
    row = {"robot": robot, "world": world, "seed": seed, "closures": closures, "poor": poor, "false": false,
           "moves": report.get("map_moves", 0), "distance_m": report["distance_m"], "known": report["explored_ratio"],
           "error_m": statistics.median(errors) if errors else report["pose_error"]["median_m"],
           "worst_m": max(errors) if errors else report["pose_error"]["worst_m"]}
    result.write_text(json.dumps(row))
    return row


def main():
    out = pathlib.Path(sys.argv[1]).resolve()
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 50
    jobs = [(robot, world, seed, out) for robot in LOCALIZERS for world in ("rooms", "doors")
            for seed in range(first, first + runs)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(one_run, jobs))
    print("| robot | worlds | runs | driven m, mean | closures | poor | false | runs with a false one | position after "
          "the last correction: median of medians m | worst m |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|")
    for robot in LOCALIZERS:
        for world in ("rooms", "doors"):
            of = [row for row in rows if row["robot"] == robot and row["world"] == world]
            print(f"| {robot} | {world} | {len(of)} | {statistics.mean(row['distance_m'] for row in of):.0f} | "
                  f"{sum(row['closures'] for row in of)} | {sum(row['poor'] for row in of)} | "
                  f"{sum(row['false'] for row in of)} | "
                  f"{sum(row['false'] > 0 for row in of)} | {statistics.median(row['error_m'] for row in of):.3f} | "
                  f"{max(row['worst_m'] for row in of):.2f} |")
    for row in rows:
        if row["false"]:
            print(f"  {row['robot']}, {row['world']}, seed {row['seed']}: {row['false']} of {row['closures']} false")


if __name__ == "__main__":
    main()
