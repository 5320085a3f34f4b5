"""The wheel's extension module, made by CMake; everything else is in pyproject.toml.

LKAO_PYTHON_BUILD names a build folder of lkao to go on with; without it one is made in build/. CMAKE_ARGS are added to
CMake's arguments, LKAO_BUILD_GL=OFF among them for machines without EGL.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]


def version():
    header = (ROOT / "include/lkao/version_numbers.h").read_text()
    return ".".join(re.findall(r"define LKAO_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header))


class CMakeBuild(build_ext):
    """Builds the one extension, and puts it where setuptools looks for it."""

    def build_extension(self, extension):
        build = Path(os.environ.get("LKAO_PYTHON_BUILD") or Path(self.build_temp).resolve() / "lkao")
        if "LKAO_PYTHON_BUILD" not in os.environ:
            options = ["CMAKE_BUILD_TYPE=Release", f"Python_EXECUTABLE={sys.executable}", "LKAO_BUILD_PYTHON=ON"]
            options += ["LKAO_BUILD_C=OFF", "LKAO_BUILD_TESTS=OFF", "LKAO_BUILD_BENCH=OFF", "LKAO_INSTALL=OFF"]
            options += ["LKAO_UNITY_BUILD=ON"]
            arguments = [argument for option in options for argument in ("-D", option)]
            more = shlex.split(os.environ.get("CMAKE_ARGS", ""))
            subprocess.run(["cmake", "-S", ROOT, "-B", build, *arguments, *more], check=True)
            if not (build / "src/python").exists():
                sys.exit("lkao: its Python package needs python3-dev and pybind11-dev")
        # Without a number, make starts all compilers at once, which no memory is enough for.
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", build, "--target", "lkao_python", "--parallel", jobs], check=True)
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        for module in (build / "python/lkao").glob("_lkao*.so"):
            shutil.copy2(module, target)
        shutil.copy2(build / "python/lkao/lkao_image_codec.so", target.parent)


setup(version=version(), ext_modules=[Extension("lkao._lkao", sources=[])], cmdclass={"build_ext": CMakeBuild})
