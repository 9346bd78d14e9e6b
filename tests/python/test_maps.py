"""Saved maps as arrays and objects."""
import pathlib
import subprocess

import numpy as np
import pytest

import cairn
from cairn import _native

PROGRAM = pathlib.Path(_native.prefix) / "bin" / "cairn"


def test_a_tile_is_a_read_only_view_of_the_map_itself(office_map):
    tiles = office_map.grid.tiles
    (x, y), tile = tiles[0]
    assert tile.shape == (64, 64) and tile.dtype == np.int16
    assert (x % 64, y % 64) == (0, 0)
    with pytest.raises(ValueError):
        tile[0, 0] = 1
    again = office_map.grid.tiles[0][1]
    assert tile.__array_interface__["data"] == again.__array_interface__["data"]


def test_a_tile_outlives_its_map(map_file):
    tile = cairn.load(map_file).grid.tiles[0][1]
    assert np.any(tile != 0) or np.all(tile == 0)  # reads all of it
    assert tile.sum() == cairn.load(map_file).grid.tiles[0][1].sum()


def test_the_whole_grid_is_what_its_tiles_hold(office_map):
    grid = office_map.grid
    whole = grid.log_odds()
    first_x, first_y = grid.first_cell
    assert whole.shape == grid.shape
    expected = np.zeros(whole.shape)
    for (x, y), tile in grid.tiles:
        for row in range(64):
            for column in range(64):
                at = (y + row - first_y, x + column - first_x)
                if 0 <= at[0] < whole.shape[0] and 0 <= at[1] < whole.shape[1]:
                    expected[at] = tile[row, column] / 256.0
    np.testing.assert_array_equal(whole, expected.astype(np.float32))


def test_probability_log_odds_and_ol_agree(office_map):
    grid = office_map.grid
    probability = grid.probability()
    np.testing.assert_allclose(probability, 1.0 / (1.0 + np.exp(-grid.log_odds())), atol=1e-6)
    np.testing.assert_array_equal(grid.ol() > 127, np.floor(255 * probability.astype(np.float64)) > 127)
    assert grid.ol().min() < 100 and grid.ol().max() > 150  # free and occupied cells are there


def test_the_origin_is_the_corner_of_the_first_cell(office_map):
    grid = office_map.grid
    landmark = office_map.landmarks[0]
    x, y, _ = landmark.pose
    column = int((x - grid.origin_m[0]) / grid.cell_m)
    row = int((y - grid.origin_m[1]) / grid.cell_m)
    around = grid.probability()[row - 8:row + 9, column - 8:column + 9]
    assert around.max() > 0.65  # its outline


def test_landmarks_and_routes_refer_to_each_other(office_map):
    ids = [landmark.id for landmark in office_map.landmarks]
    assert ids == sorted(ids) and len(ids) >= 3
    assert office_map.landmarks[0].category
    for route in office_map.routes:
        assert route.from_ in ids and route.to in ids
        assert route.trajectory.shape[1] == 3
        assert route.cost_m > 0


def test_a_printed_tag_has_its_family_and_number(tmp_path):
    (tmp_path / "tags.graphml").write_text(
        '<graphml xmlns="http://graphml.graphdrawing.org/xmlns"><key id="x" for="node" attr.name="x" attr.type="double"/>'
        '<key id="y" for="node" attr.name="y" attr.type="double"/>'
        '<key id="t" for="node" attr.name="april_tag" attr.type="string"/><graph edgedefault="directed">'
        '<node id="n1"><data key="x">1</data><data key="y">2</data><data key="t">tag 25h9 7</data></node>'
        '<node id="n2"><data key="x">3</data><data key="y">2</data></node></graph></graphml>')
    subprocess.run([PROGRAM, "map", "import", tmp_path / "tags.graphml", "-o", tmp_path / "tags.cairn"], check=True,
                   stdout=subprocess.DEVNULL)
    assert [landmark.marker for landmark in cairn.load(tmp_path / "tags.cairn").landmarks] == [("25h9", 7), None]


def test_a_name_finds_its_landmark_and_is_saved(office_map, tmp_path):
    landmark = office_map.landmarks[0]
    office_map.name(landmark, "the mug")
    office_map.save(tmp_path / "named.cairn")
    again = cairn.load(tmp_path / "named.cairn")
    assert again.landmarks[0].name == "the mug"
    assert again.plan((0.6, 0.6), "the mug").solved


def test_a_name_that_cannot_be_given_says_why(office_map):
    with pytest.raises(cairn.CairnError, match="looks like an id"):
        office_map.name(office_map.landmarks[0], "L99")
    with pytest.raises(cairn.CairnError, match='there is no landmark and no cluster "L999"'):
        office_map.name("L999", "x")


def test_a_file_that_is_no_map_says_so(tmp_path):
    file = tmp_path / "no.cairn"
    file.write_text("no map")
    with pytest.raises(cairn.MapError, match="no.cairn"):
        cairn.load(file)
    with pytest.raises(cairn.MapError, match="missing.cairn"):
        cairn.load(tmp_path / "missing.cairn")


def test_a_picture_is_a_png(office_map, tmp_path):
    plan = office_map.plan((0.6, 0.6), "nearest square")
    bare = office_map.picture()
    with_plan = office_map.picture(tmp_path / "plan.png", plan=plan, title="to a square")
    assert bare.startswith(b"\x89PNG\r\n") and with_plan.startswith(b"\x89PNG\r\n")
    assert bare != with_plan
    assert (tmp_path / "plan.png").read_bytes() == with_plan
    assert office_map._repr_png_() == bare
