#!/usr/bin/env python3
"""A landmark category of your own, recognised in a world of your own.

    PYTHONPATH=build/release/python docs/examples/recognise_template.py out/recognise
"""
import pathlib
import shutil
import sys

import cairn

CONFIG = pathlib.Path(__file__).resolve().parents[2] / "config"

# The outline of a landmark: an L-shaped pillar. A category needs no more than that.
TEMPLATE = """\
category: corner_pillar
polygon_m: [[0, 0], [0.6, 0], [0.6, 0.25], [0.25, 0.25], [0.25, 0.6], [0, 0.6]]
"""

# A room with one of them, and a square that is a landmark of another category.
WORLD = """\
bounds_m: [[0, 0], [6, 5]]
walls:
  - {points_m: [[0, 0], [6, 0], [6, 5], [0, 5], [0, 0]], surface: rough}
objects:
  - {template: corner_pillar, at_m: [3.6, 2.6], angle_deg: 30}
  - {template: square, at_m: [1.5, 3.5], angle_deg: 15}
"""

MISSION = """\
mission: recognise
seed: 3
robot: {config}/robots/pioneer1.yaml
world: world.yaml
start: {{at_m: [0.6, 0.6], angle_deg: 0}}
sensor:    {{plugin: simulated_robot}}
localizer: {{plugin: odometry_compass}}
map:       {{plugin: muriel, cell_m: 0.05}}
detector:  {{plugin: template_matcher, templates: templates, coarse_cells: 5}}
planner:   {{plugin: hybrid}}
steps:
  - explore: {{until_known_ratio: 0.95, at_most_s: 900}}
  - save: recognise.cairn
"""


def write_files(folder: pathlib.Path) -> pathlib.Path:
    """The mission with all that it needs; returns its file."""
    templates = folder / "templates"
    templates.mkdir(parents=True, exist_ok=True)
    shutil.copy(CONFIG / "templates/square.yaml", templates)
    (templates / "corner_pillar.yaml").write_text(TEMPLATE)
    (folder / "world.yaml").write_text(WORLD)
    mission = folder / "recognise.yaml"
    mission.write_text(MISSION.format(config=CONFIG))
    return mission


def main(folder: pathlib.Path) -> cairn.Map:
    run = cairn.run(write_files(folder), out=folder / "run")
    print(f"{run.outcome} after {run.report['time_s']:.0f} s of the mission's clock")
    map = run.map()
    for landmark in map.landmarks:
        x, y, _ = landmark.pose
        print(f"{landmark.label}: {landmark.category} at ({x:.2f}, {y:.2f}), degree {landmark.degree:.2f}")
    map.picture(folder / "map.png", title="a template of your own")
    return map


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/recognise"))
