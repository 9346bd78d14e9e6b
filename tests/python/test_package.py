"""`pip install` from the source tree, with what Debian has."""
import importlib.util
import os
import pathlib
import subprocess
import sys

import pytest

from cairn import _native
from conftest import SOURCE

BUILD = pathlib.Path(_native.prefix)


@pytest.mark.skipif(importlib.util.find_spec("pip") is None or importlib.util.find_spec("ensurepip") is None,
                    reason="pip or venv is not installed (python3-pip, python3-venv)")
@pytest.mark.skipif(not (BUILD / "CMakeCache.txt").exists(), reason="the package is not that of a build tree")
def test_pip_installs_the_package_in_a_virtual_environment(tmp_path):
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv"], check=True)
    python = tmp_path / "venv/bin/python"
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    # The tree is built: nothing of it is built again, and nothing comes from the network.
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-build-isolation", "--no-index", SOURCE],
                   check=True, env={**environment, "CAIRN_BUILD": str(BUILD), "CAIRN_BUILD_AS_IS": "1"})
    mission = SOURCE / "config/missions/office.yaml"
    script = (f"import cairn; run = cairn.run({str(mission)!r}, out='out', set={{'at_most_s': 5}});"
              "print(cairn.__file__); print(run.map().grid.shape)")
    told = subprocess.run([python, "-c", script], check=True, capture_output=True, text=True, env=environment,
                          cwd=tmp_path).stdout
    assert told.startswith(str(tmp_path / "venv"))
