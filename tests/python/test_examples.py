"""The scripts in docs/examples run, and find what their pages say."""
import importlib.util
import os
import re
import shutil
import signal
import subprocess
import sys
import time

import pytest

from conftest import PROGRAM, SOURCE

EXAMPLES = SOURCE / "docs/examples"


def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_readmes_screen_prints_what_it_says(tmp_path):
    subprocess.run([PROGRAM, "run", SOURCE / "config/missions/office.yaml", "--seed", "7", "--out",
                    tmp_path / "out/office"], check=True, stdout=subprocess.DEVNULL)
    (tmp_path / "config").symlink_to(SOURCE / "config")
    section = (SOURCE / "README.md").read_text().split("### In Python\n")[1].split("\n### ")[0]
    _, script, between, printed, _ = re.split(r"^```.*\n", section, flags=re.MULTILINE)
    assert not between.strip() and len(script.splitlines()) <= 11
    told = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True, cwd=tmp_path)
    assert told.stdout == printed


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


EXPERIMENT = """experiment: maps
missions: [drive.yaml]
seeds: {{from: 5, count: {count}}}
hold_out_every: 5
baseline: textbook
variants: [{{name: textbook}}, {{name: clamped, set: [map.clamp_nat=3]}}]
"""
DRIVE = """mission: drive
robot: {config}/robots/pioneer1_true_pose.yaml
world: {config}/worlds/mapping_smooth_hallway.yaml
start: {{at_m: [1.727, 1.774]}}
sensor: {{plugin: simulated_robot}}
localizer: {{plugin: odometry_compass}}
map: {{plugin: bayes}}
steps: [drive: [[2.4, 1.8]]]
"""


def short_experiment(folder, count):
    (folder / "drive.yaml").write_text(DRIVE.format(config=SOURCE / "config"))
    (folder / "maps.yaml").write_text(EXPERIMENT.format(count=count))
    return [PROGRAM, "experiment", folder / "maps.yaml", "--out"]


def ranks(command, count):
    """The same as mpirun does it, without mpirun."""
    return [subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                             env={**os.environ, "OMPI_COMM_WORLD_RANK": str(rank), "OMPI_COMM_WORLD_SIZE": str(count)})
            for rank in range(count)]


def same_tables(folder, whole):
    return all((folder / table).read_bytes() == (whole / table).read_bytes() for table in ("table.md", "table.json"))


def test_ranks_share_an_experiment(tmp_path):
    experiment = short_experiment(tmp_path, 8)
    subprocess.run([*experiment, tmp_path / "whole"], check=True, stdout=subprocess.DEVNULL)
    told = [process.communicate()[1] for process in ranks([*experiment, tmp_path / "parts"], 3)]
    assert same_tables(tmp_path / "parts", tmp_path / "whole")
    own = [int(re.search(r"; (\d+) of 16 were its own", text).group(1)) for text in told]
    assert sum(own) == 16
    assert not list((tmp_path / "parts").glob(".ranks_*"))


def test_a_rank_that_is_killed_costs_its_runs_only_and_they_are_told(tmp_path):
    experiment = short_experiment(tmp_path, 400)
    processes = ranks([*experiment, tmp_path / "parts"], 2)
    while len(list((tmp_path / "parts/drive/textbook").glob("seed_*/row.json"))) < 5:
        time.sleep(0.01)
    os.kill(processes[0].pid, signal.SIGKILL)
    processes[0].communicate()
    told = processes[1].communicate()[1]
    assert processes[1].returncode == (1 if "missing: " in told else 0)
    missing = 800 - len(list((tmp_path / "parts/drive").glob("*/seed_*/row.json")))
    assert missing <= 8, "those that it was running"
    assert told.count("missing: ") == missing
    assert (tmp_path / "parts/table.md").exists()


@pytest.mark.skipif(shutil.which("mpirun") is None, reason="mpirun is not installed (openmpi-bin)")
def test_mpirun_starts_ranks(tmp_path):
    experiment = short_experiment(tmp_path, 8)
    mpirun = ["mpirun", "--enable-recovery", "--oversubscribe", "-n", "2"]
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    subprocess.run([*experiment, tmp_path / "whole"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([*mpirun, *experiment, tmp_path / "parts"], check=True, stdout=subprocess.DEVNULL, env=environment)
    assert same_tables(tmp_path / "parts", tmp_path / "whole")
