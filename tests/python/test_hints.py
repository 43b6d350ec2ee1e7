"""The hints for type checkers say what the module has."""

import ast
import pathlib

import celltrace
import pytest

HINTS = ast.parse((pathlib.Path(celltrace.__file__).parent / "__init__.pyi").read_text())
CLASSES = {node.name: node for node in HINTS.body if isinstance(node, ast.ClassDef)}
FUNCTIONS = {node.name: node for node in HINTS.body if isinstance(node, ast.FunctionDef)}


def public(names):
    return {name for name in names if not name.startswith("_")}


def members(node):
    names = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
    return names | {item.target.id for item in node.body if isinstance(item, ast.AnnAssign)}


def test_names():
    assert public(celltrace.__all__) == set(CLASSES) | set(FUNCTIONS)
    assert celltrace.__version__.count(".") == 2


def test_members():
    for name, node in CLASSES.items():
        if not issubclass(getattr(celltrace, name), Exception):
            assert public(vars(getattr(celltrace, name))) == public(members(node)), name


def test_fields_come_in_the_order_of_arguments():
    for name, node in CLASSES.items():
        if "replace" not in members(node) or name == "Session":
            continue
        init = next(item for item in node.body if isinstance(item, ast.FunctionDef) and item.name == "__init__")
        arguments = [argument.arg for argument in init.args.args[1:]]
        properties = [item.name for item in node.body
                      if isinstance(item, ast.FunctionDef) and item.decorator_list
                      and getattr(item.decorator_list[0], "id", "") == "property"]
        assert arguments == properties, name
        made = getattr(celltrace, name)()
        defaults = getattr(celltrace, name)(*[getattr(made, argument) for argument in arguments])
        assert made == defaults, name


def test_defaults():
    for name, node in CLASSES.items():
        if "replace" not in members(node) or name == "Session":
            continue
        init = next(item for item in node.body if isinstance(item, ast.FunctionDef) and item.name == "__init__")
        said = {argument.arg: default for argument, default in zip(init.args.args[1:], init.args.defaults)}
        kwargs = {argument: ast.literal_eval(default) for argument, default in said.items()
                  if not (isinstance(default, ast.Constant) and default.value is ...)}
        assert getattr(celltrace, name)(**kwargs) == getattr(celltrace, name)(), name


def test_keywords_are_taken():
    def given(function):
        return {argument.arg: ast.literal_eval(default)
                for argument, default in zip(function.args.kwonlyargs, function.args.kw_defaults)
                if not (isinstance(default, ast.Constant) and default.value is ...)}
    methods = {(name, item.name): item for name, node in CLASSES.items() for item in node.body
               if isinstance(item, ast.FunctionDef)}
    scene = celltrace.Scene()
    session = celltrace.Session(scene, **given(methods["Session", "__init__"]))
    session.set_picture(**{name.arg: None if name.arg in ("region", "antialiasing") else 8
                           for name in methods["Session", "set_picture"].args.kwonlyargs})
    assert session.render(**given(methods["Session", "render"])).shape == (8, 8, 4)
    for name in ("from_file", "from_text"):
        keywords = given(methods["Scene", name])
        assert set(keywords) == set(given(methods["Scene", "from_text"]))
    celltrace.Scene.from_text("sphere { 0, 1 }", **keywords)
    with pytest.raises(celltrace.InputError, match="none.pov"):
        celltrace.render("none.pov", **given(FUNCTIONS["render"]))


def test_docstrings():
    for name in public(celltrace.__all__):
        assert getattr(celltrace, name).__doc__, name
