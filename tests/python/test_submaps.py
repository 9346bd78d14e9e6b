"""Submaps of laser SLAM in saved maps."""
import json
import subprocess

import numpy as np
import pytest

import cairn
from conftest import PROGRAM, SOURCE


@pytest.fixture(scope="module")
def slam_file(tmp_path_factory):
    """A short drive of the office with a laser."""
    folder = tmp_path_factory.mktemp("slam")
    subprocess.run([PROGRAM, "run", SOURCE / "config/missions/office_laser.yaml", "--out", folder, "--set",
                    "localizer.plugin=submap_graph", "--set", "at_most_s=60"], check=False, stdout=subprocess.DEVNULL)
    return folder / "office_laser.cairn"


def test_submaps_are_arrays_with_poses_and_stamps(slam_file):
    submaps = cairn.load(slam_file).submaps
    assert len(submaps) >= 2
    for submap in submaps:
        assert submap.grid.dtype == np.uint8 and submap.grid.ndim == 2
        assert submap.nodes.shape == (len(submap.stamps_s), 3)
        assert tuple(submap.nodes[0]) == submap.pose
        assert np.all(np.diff(submap.stamps_s) > 0)
    with pytest.raises(ValueError):
        submaps[0].grid[0, 0] = 1


def test_a_submap_lies_on_the_walls_of_the_map(slam_file):
    map = cairn.load(slam_file)
    submap = map.submaps[0]
    rows, columns = np.nonzero(submap.grid >= 3)
    x = submap.origin_m[0] + submap.cell_m * (columns + 0.5)
    y = submap.origin_m[1] + submap.cell_m * (rows + 0.5)
    at_x, at_y, heading = submap.pose
    seen = np.stack([at_x + np.cos(heading) * x - np.sin(heading) * y, at_y + np.sin(heading) * x + np.cos(heading) * y])
    probability = map.grid.probability()
    occupied = 0
    for place_x, place_y in seen.T:
        column = int((place_x - map.grid.origin_m[0]) / map.grid.cell_m)
        row = int((place_y - map.grid.origin_m[1]) / map.grid.cell_m)
        near = probability[max(row - 2, 0):row + 3, max(column - 2, 0):column + 3]
        occupied += near.size > 0 and near.max() > 0.5
    assert len(rows) > 50
    assert occupied > 0.9 * len(rows)


def test_a_submap_outlives_its_map(slam_file):
    grid = cairn.load(slam_file).submaps[0].grid
    assert grid.sum() > 0


def test_saving_keeps_them_and_info_counts_them(slam_file, tmp_path):
    map = cairn.load(slam_file)
    map.save(tmp_path / "again.cairn")
    again = cairn.load(tmp_path / "again.cairn")
    for before, after in zip(map.submaps, again.submaps, strict=True):
        assert before.pose == after.pose
        np.testing.assert_array_equal(before.grid, after.grid)
    info = json.loads(subprocess.run([PROGRAM, "map", "info", slam_file, "--json"], check=True, capture_output=True).stdout)
    assert info["schema"] == 2
    assert info["submaps"] == len(map.submaps)
    assert subprocess.run([PROGRAM, "map", "check", slam_file], check=False, stdout=subprocess.DEVNULL).returncode == 0


def test_a_map_without_submaps_has_none(office_map):
    assert office_map.submaps == []
