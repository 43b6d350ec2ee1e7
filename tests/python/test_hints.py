"""The hints for type checkers say what the module has."""

import ast
import inspect
import pathlib
import pydoc

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


def said(function):
    """Names of a function in the hints, as inspect.Parameter has kinds, and its defaults where they are literals."""
    kinds, arguments = inspect.Parameter, function.args
    positional = arguments.posonlyargs + arguments.args
    names = {argument.arg: kinds.POSITIONAL_OR_KEYWORD for argument in positional}
    names |= {argument.arg: kinds.KEYWORD_ONLY for argument in arguments.kwonlyargs}
    defaults = dict(zip([argument.arg for argument in positional[len(positional) - len(arguments.defaults):]],
                        arguments.defaults))
    defaults |= {argument.arg: default for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults) if default}
    return names, {name: ast.literal_eval(default) for name, default in defaults.items()}


def is_same(default, other):
    """Whether two defaults mean the same: one number stands for all three."""
    if other is ... or default is ...:
        return True
    if isinstance(default, (tuple, list)) and isinstance(other, (int, float)):
        return all(part == other for part in default)
    return list(default) == list(other) if isinstance(default, (tuple, list)) else default == other


SIGNED = ([(name, getattr(celltrace, name), node) for name, node in FUNCTIONS.items() if name != "srgb"]
          + [(f"{name}.{item.name}", getattr(celltrace, name) if item.name == "__init__"
              else getattr(getattr(celltrace, name), item.name), item)
             for name, node in CLASSES.items() for item in node.body if isinstance(item, ast.FunctionDef)
             and all(getattr(decorator, "id", "") == "staticmethod" for decorator in item.decorator_list)
             and item.name not in ("replace", "__new__", "_repr_png_")])


@pytest.mark.parametrize("name, made, node", SIGNED, ids=[name for name, *_ in SIGNED])
def test_signatures_are_those_of_the_hints(name, made, node):
    parameters = dict(inspect.signature(made).parameters)
    names, defaults = said(node)
    names.pop("self", None)
    parameters.pop("self", None)
    assert {name: parameter.kind for name, parameter in parameters.items()} == names
    for name, parameter in parameters.items():
        assert (parameter.default is inspect.Parameter.empty) == (name not in defaults), name
        if name in defaults:
            assert is_same(parameter.default, defaults[name]), name


def test_signatures_of_what_replace_takes():
    parameters = inspect.signature(celltrace.Sphere.replace).parameters
    assert list(parameters) == ["centre", "radius"]
    assert all(parameter.kind == inspect.Parameter.KEYWORD_ONLY for parameter in parameters.values())


def test_help_names_every_keyword():
    for name, made in (("render", celltrace.render), ("Session", celltrace.Session)):
        text = pydoc.plain(pydoc.render_doc(made))
        for keyword in inspect.signature(made).parameters:
            assert name == "Session" and keyword == "scene" or f"{keyword}" in text.split("\n\n", 1)[1], keyword
    assert "loop-steps" in celltrace.render.__doc__ and "library_paths: " in celltrace.render.__doc__


def test_docstrings():
    for name in public(celltrace.__all__):
        assert getattr(celltrace, name).__doc__, name
