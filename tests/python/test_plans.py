"""Plans on a saved map, against the program's."""
import json
import subprocess
import threading

import numpy as np
import pytest

import cairn
from conftest import PROGRAM


def planned_by_the_program(map_file, *options):
    done = subprocess.run([PROGRAM, "plan", map_file, "--json", *options], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, check=False)
    return json.loads(done.stdout)


@pytest.mark.parametrize("planner", ["hybrid", "landmark_search", "ompl"])
def test_a_plan_is_the_programs(office_map, map_file, planner):
    from_, to = ("0.6,0.6", "nearest square") if planner != "landmark_search" else ("L1", "L2")
    theirs = planned_by_the_program(map_file, "--from", from_, "--to", to, "--planner", planner)
    ours = office_map.plan(from_, to, planner=planner)
    assert ours.outcome == theirs["outcome"]
    np.testing.assert_array_equal(ours.path, np.array(theirs["path"]).reshape(-1, 3))
    for field in ("cost_m", "length_m", "length_lower_bound_m", "landmarks", "routes", "clearance_m", "margin_m",
                  "driving_time_s", "reason"):
        assert getattr(ours, field) == theirs[field], field


def test_alternatives_explanation_and_trajectory_are_given_when_asked_for(office_map):
    landmarks = office_map.landmarks
    bare = office_map.plan(landmarks[0], landmarks[1])
    assert bare.trajectory is None and bare.explanation is None and bare.alternatives == []
    plan = office_map.plan(landmarks[0], landmarks[1], explain=True, trajectory=True)
    assert plan.trajectory.shape[1] == 6
    np.testing.assert_allclose(plan.trajectory[-1, 1:3], plan.path[-1, :2], atol=1e-6)
    assert np.all(np.diff(plan.trajectory[:, 0]) > 0)
    assert plan.explanation["cost_by"] == "length"


def test_a_place_that_is_not_known_is_an_outcome(office_map):
    plan = office_map.plan((0.6, 0.6), "L4711")
    assert not plan.solved and plan.outcome == "unknown_place"
    assert plan.path.shape == (0, 3)
    assert "L4711" in plan.reason


def test_wrong_settings_are_errors_that_name_them(office_map):
    with pytest.raises(cairn.FileError, match="no_such_setting"):
        office_map.plan((0.6, 0.6), "L1", set={"no_such_setting": 1})
    with pytest.raises(ValueError, match="length, time or clearance"):
        office_map.plan((0.6, 0.6), "L1", cost="lenght")
    with pytest.raises(cairn.FileError, match="did you mean \"hybrid\"|hybrid"):
        office_map.plan((0.6, 0.6), "L1", planner="hybird")
    with pytest.raises(KeyError, match="form"):
        office_map.plan_many([{"form": "L1", "to": "L2"}])


def test_many_plans_are_those_asked_one_by_one(office_map):
    points = [(0.6, 0.6), (1.0, 2.0), (2.5, 1.0)]
    questions = [(point, landmark) for point in points for landmark in office_map.landmarks]
    many = office_map.plan_many(questions)
    assert len(many) == len(questions)
    for (from_, to), plan in zip(questions, many):
        alone = office_map.plan(from_, to)
        assert plan.outcome == alone.outcome
        np.testing.assert_array_equal(plan.path, alone.path)
    assert any(plan.solved for plan in many)


def test_other_threads_run_while_plans_are_made(office_map):
    questions = [((0.6, 0.6), landmark) for landmark in office_map.landmarks] * 20
    office_map.plan(*questions[0])  # prepared
    counted = [0]
    done = threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1

    counter = threading.Thread(target=count)
    counter.start()
    before = counted[0]
    office_map.plan_many(questions, jobs=1)
    during = counted[0] - before
    done.set()
    counter.join()
    assert during > 100
