"""Stubs and docstrings say what there is."""

import importlib.util
import inspect
import os
import subprocess
import sys
from pathlib import Path

import pytest

import lkao
import meshes

USER = """
import numpy as np
import lkao

values: np.ndarray = lkao.occlusion([[0, 0, 0]], [[0, 0, 0]], np.zeros((1, 3)), (0, 1, 0), radius=1.0)
lkao.AmbientOcclusion(lkao.Scene(values, values), 64, radius="2")
"""


def tool(module, *arguments, **options):
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("needs mypy")
    package = Path(lkao.__file__).parent
    environment = dict(os.environ, MYPYPATH=str(package.parent))
    return subprocess.run(
        [sys.executable, "-m", module, *map(str, arguments)],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        **options,
    )


def test_extension_is_what_its_stub_says(tmp_path):
    # Of functions of the extension their own docstrings tell the arguments: see the next test.
    result = tool("mypy.stubtest", "lkao._lkao", "--ignore-missing-stub", cwd=tmp_path)
    assert result.returncode == 0, result.stdout


def test_arguments_of_the_extension_are_those_of_its_stub():
    import ast
    import re

    import lkao._lkao as extension

    stub = ast.parse((Path(lkao.__file__).parent / "_lkao.pyi").read_text())
    compared = 0

    def compare(owner, function):
        nonlocal compared
        doc = getattr(owner, function.name).__doc__ or ""
        signature = re.match(rf"{function.name}\((.*)\) -> ", doc)
        if signature is None or "property" in [getattr(d, "id", "") for d in function.decorator_list]:
            return
        # Names before colons that are not inside of a type.
        names = re.findall(r"(?:^|, )(\w+): ", re.sub(r"\[[^\[\]]*\]", "", re.sub(r"\[[^\[\]]*\]", "", signature[1])))
        assert names == [argument.arg for argument in function.args.args], f"{function.name}: {names}"
        compared += 1

    for node in stub.body:
        if isinstance(node, ast.FunctionDef):
            compare(extension, node)
        elif isinstance(node, ast.ClassDef) and hasattr(extension, node.name):
            for inner in node.body:
                if isinstance(inner, ast.FunctionDef):
                    compare(getattr(extension, node.name), inner)
    assert compared > 25


def test_package_passes_a_strict_check(tmp_path):
    package = Path(lkao.__file__).parent
    result = tool("mypy", "--strict", "--cache-dir", tmp_path / "cache", package, cwd=tmp_path)
    assert result.returncode == 0, result.stdout


def test_users_see_types(tmp_path):
    (tmp_path / "user.py").write_text(USER)
    result = tool("mypy", "--cache-dir", tmp_path / "cache", tmp_path / "user.py", cwd=tmp_path)
    assert 'incompatible type "str"; expected "float"' in result.stdout, result.stdout
    assert "Found 1 error" in result.stdout, result.stdout


def test_everything_public_says_what_it_is():
    silent = []
    for name in lkao.__all__:
        thing = getattr(lkao, name)
        members = inspect.getmembers(thing, inspect.isfunction) if inspect.isclass(thing) else []
        public = [(f"{name}.{member}", value) for member, value in members if not member.startswith("_")]
        silent += [where for where, value in [(name, thing), *public] if not inspect.getdoc(value)]
    assert silent == []
    assert "(n, 3)" in lkao.Scene.__doc__ and "unit of V" in lkao.AmbientOcclusion.__doc__


def test_version_is_that_of_the_library():
    header = (meshes.SOURCE / "include/lkao/version_numbers.h").read_text()
    assert all(f" {number}\n" in header for number in lkao.__version__.split("."))
