"""Missions with modules in Python, run in this interpreter."""
import subprocess
import sys

import pytest

import cairn
from conftest import PROGRAM, SOURCE

EXAMPLES = SOURCE / "docs/examples/python_modules"

pytestmark = pytest.mark.skipif(not list((PROGRAM.parent.parent / "lib/cairn").glob("python_module.so")),
                                reason="python_module is not built")

STEP = """\
class It:
    def __init__(self, context):
        self.ticks = 0

    def tick(self, world, ask):
        self.ticks += 1
        if self.ticks == 20:
            {what}
        return "running", "on its way"
"""


def mission_with_step(folder, what):
    (folder / "it.py").write_text(STEP.format(what=what))
    file = folder / "mission.yaml"
    file.write_text(f"""\
mission: python
robot: {SOURCE}/config/robots/pioneer1.yaml
world: {EXAMPLES}/pillars_world.yaml
start: {{at_m: [1, 1.2]}}
sensor: {{plugin: simulated_robot}}
localizer: {{plugin: odometry_compass}}
map: {{plugin: bayes, cell_m: 0.05}}
watchdog_s: 0.5
steps:
  - python: {{file: it.py, class: It}}
""")
    return file


def test_the_map_is_the_same_bytes_as_the_programs(tmp_path):
    run = cairn.run(EXAMPLES / "pillars.yaml", out=tmp_path / "here")
    assert run.done, run.reason
    assert [landmark.category for landmark in run.map().landmarks] == ["pillar", "pillar"]
    subprocess.run([PROGRAM, "run", EXAMPLES / "pillars.yaml", "--out", tmp_path / "there"], check=True,
                   stdout=subprocess.DEVNULL)
    assert run.map_file.read_bytes() == (tmp_path / "there/pillars.cairn").read_bytes()


def test_an_exception_is_reported_with_its_trace(tmp_path):
    run = cairn.run(mission_with_step(tmp_path, "self.halted"), out=tmp_path / "out")
    assert run.outcome == "module_fault"
    assert "it.py:8:13: AttributeError: 'It' object has no attribute 'halted'\nTraceback" in run.reason
    assert run.map_file.exists()


def test_a_mistake_has_its_place(tmp_path):
    mission = mission_with_step(tmp_path, "pass")
    (tmp_path / "it.py").write_text("class It:\n    def tick(self:\n")
    with pytest.raises(cairn.FileError) as caught:
        cairn.run(mission, out=tmp_path / "out")
    assert caught.value.file.endswith("it.py") and caught.value.line == 2


def test_a_loop_without_end_is_given_up(tmp_path):
    mission = mission_with_step(tmp_path, "while True: pass")
    script = f"import cairn, os; print(cairn.run({str(mission)!r}, out={str(tmp_path / 'out')!r}).reason, flush=True); os._exit(0)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120, check=True)
    assert "has not returned from stage behaviour" in done.stdout
    assert (tmp_path / "out/python.cairn").exists()
