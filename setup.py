"""Builds Cairn and puts it whole into the package: the module, and under `prefix` the program, libraries and modules.

CAIRN_BUILD: a build folder that is configured already, for who has one; otherwise build/python_package is made.
CAIRN_BUILD_AS_IS: 1: what that folder holds is taken, nothing is built.
"""
import os
import pathlib
import shutil
import subprocess
import sys

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent


class WithCairn(build_py):
    """The Python files, and what CMake builds."""

    def run(self) -> None:
        super().run()
        build = pathlib.Path(os.environ.get("CAIRN_BUILD", HERE / "build/python_package"))
        as_is = os.environ.get("CAIRN_BUILD_AS_IS", "0") not in ("", "0")
        if as_is and not (build / "CMakeCache.txt").exists():
            sys.exit(f"CAIRN_BUILD: {build} is no build folder")
        if not (build / "CMakeCache.txt").exists():
            subprocess.run(["cmake", "-S", HERE, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            f"-DCAIRN_PYTHON={sys.executable}", "-DCAIRN_PYTHON_PACKAGE=ON",
                            "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=12"], check=True)
        if not as_is:
            subprocess.run(["cmake", "--build", build], check=True)
        package = pathlib.Path(self.build_lib) / "cairn"
        shutil.rmtree(package / "prefix", ignore_errors=True)
        subprocess.run(["cmake", "--install", build, "--prefix", package.resolve() / "prefix", "--strip"], check=True)
        subprocess.run(["cmake", "--install", build, "--prefix", package.resolve(), "--component", "python"],
                       check=True)
        for headers in ("include", "lib/cmake", "lib/pkgconfig"):  # for authors of modules in C++
            shutil.rmtree(package / "prefix" / headers, ignore_errors=True)


class OfThisMachine(Distribution):
    """Not of all machines."""

    def has_ext_modules(self) -> bool:
        return True


setup(cmdclass={"build_py": WithCairn}, distclass=OfThisMachine, package_data={"cairn": ["py.typed", "*.pyi"]})
