"""A small map of a finished mission, made once for all tests."""
import pathlib
import subprocess

import pytest

import cairn
from cairn import _native

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(_native.prefix) / "bin" / "cairn"


@pytest.fixture(scope="session")
def office(tmp_path_factory):
    """The folder of the run of config/missions/office.yaml."""
    folder = tmp_path_factory.mktemp("office")
    subprocess.run([PROGRAM, "run", SOURCE / "config/missions/office.yaml", "--out", folder], check=True,
                   stdout=subprocess.DEVNULL)
    return folder


@pytest.fixture
def map_file(office):
    return office / "office.cairn"


@pytest.fixture
def office_map(map_file):
    return cairn.load(map_file)
