"""The scripts in docs/examples run, and find what their pages say."""
import importlib.util
import os
import subprocess

import pytest

from conftest import PROGRAM, SOURCE

EXAMPLES = SOURCE / "docs/examples"


def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_template_of_ones_own_is_recognised(tmp_path):
    map = example("recognise_template").main(tmp_path)
    pillars = [landmark for landmark in map.landmarks if landmark.category == "corner_pillar"]
    assert len(pillars) == 1
    assert (tmp_path / "map.png").exists()


def test_plans_are_drawn(map_file, tmp_path):
    pytest.importorskip("matplotlib")
    plans = example("plan_and_plot").main(map_file, tmp_path / "plans.png")
    assert plans and all(plan.solved for plan in plans)
    assert (tmp_path / "plans.png").read_bytes().startswith(b"\x89PNG")


def test_intervals_hold_their_figures(tmp_path):
    intervals = example("experiment_intervals").main(tmp_path, 3)
    assert set(intervals) == {"share of good runs", "mean time, s", "mean of the worst error, m"}
    for value, low, high in intervals.values():
        assert low <= value <= high


def test_wilsons_interval_is_that_of_the_books():
    low, high = example("experiment_intervals").wilson(9, 10)
    assert low == pytest.approx(0.5958, abs=1e-4) and high == pytest.approx(0.9821, abs=1e-4)


def test_the_job_array_runs_the_shard_of_its_task(tmp_path):
    def task(number, **more):
        environment = {**os.environ, "CAIRN": str(PROGRAM), "SLURM_ARRAY_TASK_ID": number, **more}
        return subprocess.run([EXAMPLES / "experiment.sbatch", SOURCE / "config/experiments/first_mission.yaml",
                               tmp_path, "--set", "seeds.count=2"], env=environment, capture_output=True, text=True,
                              check=False)

    second = task("2", SLURM_ARRAY_TASK_MAX="2")
    assert second.returncode == 0, second.stderr
    assert (tmp_path / "seed_2/row.json").exists() and not (tmp_path / "seed_1/row.json").exists()
    merged = subprocess.run([PROGRAM, "experiment", SOURCE / "config/experiments/first_mission.yaml", "--out", tmp_path,
                             "--set", "seeds.count=2", "--merge"], capture_output=True, text=True, check=False)
    assert merged.returncode == 1 and "1 of 2 runs are missing" in merged.stderr
    assert task("1", SHARDS="2").returncode == 0
    assert (tmp_path / "seed_1/row.json").exists()


def test_processes_of_mpirun_share_an_experiment(tmp_path):
    experiment = [PROGRAM, "experiment", SOURCE / "config/experiments/first_mission.yaml", "--set", "seeds.count=2"]
    subprocess.run([*experiment, "--out", tmp_path / "whole"], check=False, stdout=subprocess.DEVNULL)
    for rank in ("0", "1"):
        assert not (tmp_path / "parts/table.md").exists()
        subprocess.run([*experiment, "--out", tmp_path / "parts"], check=False, stdout=subprocess.DEVNULL,
                       env={**os.environ, "OMPI_COMM_WORLD_RANK": rank, "OMPI_COMM_WORLD_SIZE": "2"})
    for table in ("table.md", "table.json"):
        assert (tmp_path / "parts" / table).read_bytes() == (tmp_path / "whole" / table).read_bytes()
