"""What is installed works elsewhere, and so does a wheel."""

import os
import subprocess
import sys

import numpy as np

import meshes

USE = """
import lkao
values = lkao.bake([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], radius=1.0)
file = lkao.MeshFile("leaf.gltf")  # its image is read by what lies beside the module
print(lkao.__file__, (values == 0).all() and file.holes is not None and not file.remarks)
"""


def use(folder):
    V, F = meshes.wall()
    clear = np.zeros((2, 2), np.uint8)
    meshes.write_gltf(folder / "leaf.gltf", V, F, V[:, :2], clear, {"alphaMode": "MASK"})
    said = subprocess.run(
        [sys.executable, "-c", USE],
        env=dict(os.environ, PYTHONPATH=str(folder)),
        cwd=folder,
        check=True,
        stdout=subprocess.PIPE,
        text=True,
    )
    file, is_right = said.stdout.split()
    assert file.startswith(str(folder)) and is_right == "True"


def test_installed_package_works(tmp_path):
    command = ["cmake", "--install", meshes.BUILD, "--component", "lkao_python", "--prefix", tmp_path, "--strip"]
    subprocess.run([*map(str, command), "--config", meshes.CONFIG], check=True, stdout=subprocess.DEVNULL)
    (package,) = (path.parent for path in tmp_path.rglob("lkao/__init__.py"))
    assert {"_lkao.pyi", "py.typed"} <= {path.name for path in package.iterdir()}
    use(package.parent)


def test_wheel_works(tmp_path):
    environment = dict(os.environ, LKAO_PYTHON_BUILD=str(meshes.BUILD))
    command = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--no-index", "--quiet"]
    source = tmp_path / "source"
    source.mkdir()
    for name in ("src/python", "include/lkao/version_numbers.h"):  # setuptools leaves files beside what it builds
        target = source / name
        target.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(["cp", "-r", meshes.SOURCE / name, target], check=True)
    subprocess.run([*command, "-w", tmp_path, source / "src/python"], env=environment, check=True)
    (wheel,) = tmp_path.glob("lkao-*.whl")
    folder = tmp_path / "installed"
    install = [sys.executable, "-m", "pip", "install", "--no-deps", "--no-index", "--quiet", "--target", folder, wheel]
    subprocess.run(list(map(str, install)), check=True)
    use(folder)
