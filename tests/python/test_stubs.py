"""The stubs say what the modules are."""
import os
import subprocess
import sys

import cairn


# pybind11's classes have a metaclass of their own, and take any arguments where they cannot be made from Python.
NOT_CHECKED = r"""
cairn\._native\.[A-Z]\w+
cairn\._native\.[A-Z]\w+\.__init__
"""


def test_the_stubs_fit_the_modules(tmp_path):
    (tmp_path / "not_checked").write_text(NOT_CHECKED)
    done = subprocess.run([sys.executable, "-m", "mypy.stubtest", "cairn._native", "--allowlist", "not_checked"],
                          cwd=tmp_path, capture_output=True, text=True, check=False,
                          env={**os.environ, "MYPYPATH": os.path.dirname(os.path.dirname(cairn.__file__))})
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_package_is_typed_as_it_is_called(tmp_path):
    (tmp_path / "use.py").write_text("import cairn\nlength: float = cairn.load('x').plan('a', (1.0, 2.0)).length_m\n"
                                     "wrong: str = cairn.load('x').plan('a', 'b').length_m\n")
    done = subprocess.run([sys.executable, "-m", "mypy", "use.py"], cwd=tmp_path, capture_output=True, text=True,
                          check=False,
                          env={**os.environ, "MYPYPATH": os.path.dirname(os.path.dirname(cairn.__file__))})
    assert "use.py:3" in done.stdout and "use.py:2" not in done.stdout, done.stdout + done.stderr


def test_all_that_is_public_is_described():
    for name in cairn.__all__:
        assert getattr(cairn, name).__doc__, name
