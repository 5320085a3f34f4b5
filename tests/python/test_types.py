"""Stubs and docstrings say what there is."""

import ast
import importlib.util
import inspect
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import lkao
import lkao._lkao as extension
import meshes

USER = """
import numpy as np
import lkao

values = lkao.occlusion([[0, 0, 0]], [[0, 0, 0]], np.zeros((1, 3)), (0, 1, 0), radius=1.0)
lkao.AmbientOcclusion(lkao.Scene(values, values), 64, radius="2")
"""


def test_extension_is_what_its_stub_says():
    stub = ast.parse((Path(lkao.__file__).parent / "_lkao.pyi").read_text())
    compared = []

    def names_in(body):
        kinds = (ast.FunctionDef, ast.ClassDef)
        return {node.name: node for node in body if isinstance(node, kinds)}

    def names_of(thing):
        return {name for name in vars(thing) if not name.startswith("_")}

    def compare(owner, node):
        is_property = "property" in [getattr(decorator, "id", "") for decorator in node.decorator_list]
        assert isinstance(inspect.getattr_static(owner, node.name), property) == is_property, node.name
        if is_property:
            return
        # pybind11 says the signature at the top: names stand before colons that are in no type's brackets.
        signature = re.match(rf"{node.name}\((.*)\) -> ", getattr(owner, node.name).__doc__)[1]
        while "[" in signature:
            signature = re.sub(r"\[[^\[\]]*\]", "", signature)
        names = re.findall(r"(?:^|, )(\w+): ", signature)
        assert names == [argument.arg for argument in node.args.args], node.name
        compared.append(node.name)

    for name, node in names_in(stub.body).items():
        if isinstance(node, ast.FunctionDef):
            compare(extension, node)
        elif hasattr(extension, name) or name != "Rasterizer":  # there where lkao is built with OpenGL
            members = names_in(node.body)
            its_class = getattr(extension, name)
            assert names_of(its_class) == {member for member in members if not member.startswith("_")}, name
            for member in members.values():
                compare(its_class, member)
    assert names_of(extension) - {"version"} <= set(names_in(stub.body)) and len(compared) > 25


def test_package_is_strict_and_users_see_its_types(tmp_path):
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("needs mypy")
    package = Path(lkao.__file__).parent
    (tmp_path / "user.py").write_text(USER)
    result = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", tmp_path / "cache", package, tmp_path / "user.py"],
        env=dict(os.environ, MYPYPATH=str(package.parent)),
        stdout=subprocess.PIPE,
        text=True,
        cwd=tmp_path,
    )
    lines = result.stdout.splitlines()
    assert len(lines) == 2 and 'incompatible type "str"; expected "float"' in lines[0], result.stdout


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
