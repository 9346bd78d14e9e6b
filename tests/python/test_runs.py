"""Missions and experiments from Python."""
import os
import signal
import threading
import time

import pytest

import cairn
from conftest import SOURCE

MISSION = SOURCE / "config/missions/office.yaml"


def test_a_mission_is_the_same_as_the_programs(office, tmp_path):
    ticks = []
    run = cairn.run(MISSION, out=tmp_path, on_tick=ticks.append)
    assert run.done and run.outcome == "done"
    theirs = (office / "office.cairn").read_bytes()
    assert run.map_file.read_bytes() == theirs
    assert len(ticks) > 100
    assert ticks[-1].time_s > ticks[0].time_s
    assert ticks[-1].landmarks == len(run.map().landmarks)
    x, y, _ = ticks[-1].true_pose
    assert abs(x - ticks[-1].pose[0]) < 0.5 and abs(y - ticks[-1].pose[1]) < 0.5


def test_settings_and_seed_are_those_given(tmp_path):
    run = cairn.run(MISSION, out=tmp_path, seed=7, set={"at_most_s": 2.0})
    assert not run.done
    assert run.report["seed"] == 7


def test_what_on_tick_raises_cancels_the_mission_and_is_raised(tmp_path):
    def refuse(tick):
        if tick.time_s > 1.0:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        cairn.run(MISSION, out=tmp_path, on_tick=refuse)
    assert (tmp_path / "office.cairn").exists()


def test_ctrl_c_cancels_a_mission(tmp_path):
    def interrupt(tick):
        if not interrupted and tick.time_s > 1.0:
            interrupted.append(tick.time_s)
            os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.002)

    interrupted = []
    with pytest.raises(KeyboardInterrupt):
        cairn.run(MISSION, out=tmp_path, on_tick=interrupt)
    assert (tmp_path / "office.cairn").exists()


def test_a_mistake_in_a_mission_has_its_place(tmp_path):
    file = tmp_path / "mission.yaml"
    file.write_text("mission: x\nrobt: a.yaml\n")
    with pytest.raises(cairn.FileError) as caught:
        cairn.run(file)
    assert caught.value.file == str(file)
    assert caught.value.line == 2 and caught.value.column >= 1
    assert "robot" in str(caught.value)


def test_an_experiment_gives_its_table(tmp_path):
    ended = []
    found = cairn.experiment(SOURCE / "config/experiments/first_mission.yaml", out=tmp_path,
                             set={"seeds.count": 2}, on_run=lambda done, of: ended.append((done, of)))
    assert ended[-1] == (2, 2)
    assert (tmp_path / "table.md").read_text() == found.table
    assert found.figures
    assert threading.active_count() == 1
