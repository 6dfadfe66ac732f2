"""Builds the two modules of the Python package with CMake, for pip."""

import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext


ROOT = pathlib.Path(__file__).resolve().parent
VERSION = re.search(r"project\(plastron VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


class CMakeExtension(Extension):
    """A module that CMake builds."""

    def __init__(self, name):
        super().__init__(name, sources=[])


class CMakeBuild(build_ext):
    """Builds all modules at once, in a folder beside those of setuptools, and copies what belongs to the package."""

    def run(self):
        build = pathlib.Path(self.build_temp).resolve()
        build.mkdir(parents=True, exist_ok=True)
        options = [
            "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DPLASTRON_BUILD_PYTHON=ON", "-DPLASTRON_BUILD_TESTS=OFF",
            "-DPLASTRON_BUILD_BENCHMARKS=OFF", "-DPLASTRON_UNITY_BATCH=12", f"-DPython3_EXECUTABLE={sys.executable}",
        ]
        subprocess.run(["cmake", "-S", ROOT, "-B", build, *options], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "plastron_python"], check=True)
        target = pathlib.Path(self.get_ext_fullpath("plastron._case")).parent
        target.mkdir(parents=True, exist_ok=True)
        for file in (build / "python" / "plastron").iterdir():
            if file.suffix in (".so", ".pyi"):
                self.copy_file(os.fspath(file), os.fspath(target / file.name))


setup(version=VERSION, ext_modules=[CMakeExtension("plastron._case"), CMakeExtension("plastron._solver")], cmdclass={"build_ext": CMakeBuild})
