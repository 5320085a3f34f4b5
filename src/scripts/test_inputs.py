"""What the answers of a test program hang on, as one key."""

import os
import shutil
import subprocess
import time

from stamps import files_in, key_of

# The beginnings of variables that change what a program does.
VARIABLES = ("LKAO_", "GTEST_", "MESA_", "LIBGL_", "EGL_", "GALLIUM_", "LP_", "ASAN_", "LSAN_", "UBSAN_", "TSAN_")


def surroundings(build_folder):
    """What all programs run on: packages, variables, shared scenes (by size and time, as they are large)."""
    # Where packages are not known, nothing is taken to be as before.
    packages = subprocess.check_output(["dpkg-query", "-W"], text=True) if shutil.which("dpkg-query") else time.time()
    variables = sorted(pair for pair in os.environ.items() if pair[0].startswith(VARIABLES))
    with open(os.path.join(build_folder, "CMakeCache.txt"), encoding="utf-8") as cache:
        folders = [line.strip().split("=", 1)[1] for line in cache if line.startswith("LKAO_SHARED_DIR:")]
    scenes = [file for folder in folders if os.path.isdir(folder) for file in files_in(folder)]
    return [packages, variables, [(file, os.stat(file).st_size, os.stat(file).st_mtime_ns) for file in scenes]]


def program_key(program, commands, around):
    """Of a program, the commands and variables that run its tests, the shared objects beside it, and what it reads,
    which lkao_test writes into a file."""
    folder = os.path.dirname(program)
    paths = [program] + sorted(os.path.join(folder, name) for name in os.listdir(folder) if ".so" in name)
    if os.path.exists(program + ".reads"):
        with open(program + ".reads", encoding="utf-8") as file:
            paths += file.read().splitlines()
    return key_of([commands, around], paths)
