"""Errors and warnings of scenes."""

import warnings

import celltrace
import pytest


def test_an_error_knows_its_place(tmp_path):
    path = tmp_path / "wrong.pov"
    path.write_text("sphere { 0, 1 }\n  sfere { 0, 1 }\n")
    with pytest.raises(celltrace.Error, match=r"wrong\.pov:2:3: error: ") as caught:
        celltrace.render(path)
    assert isinstance(caught.value, RuntimeError) and isinstance(caught.value, celltrace.SceneError)
    assert (caught.value.file, caught.value.line, caught.value.column) == (str(path), 2, 3)


def test_all_that_was_found_is_told():
    text = '#warning "careful"\nsphere { 0, 1 }\nmedia { }\nheight_field { png "a.png" }\nsfere'
    with pytest.raises(celltrace.SceneError) as caught:
        celltrace.Scene.from_text(text, message=lambda _: None)
    findings = caught.value.findings
    assert [finding.line for finding in findings if finding.severity == "error"][0] == caught.value.line
    assert any(finding.severity == "warning" and "careful" in finding.text for finding in findings)
    assert all(finding.file == "<string>" and finding.column >= 1 for finding in findings)


def test_other_errors_have_no_place(tmp_path):
    with pytest.raises(celltrace.InputError, match="none.png") as caught:
        celltrace.load(tmp_path / "none.png")
    assert (caught.value.file, caught.value.line, caught.value.column) == (None, None, None)


def test_warnings_are_pythons():
    text = '#warning "careful" #debug "told"'
    with pytest.warns(UserWarning, match="<string>:1:.*careful"):
        celltrace.Scene.from_text(text)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning, match="careful"):
            celltrace.Scene.from_text(text)
        heard = []
        celltrace.Scene.from_text(text, message=heard.append)
    assert any("careful" in line for line in heard) and "told" in heard


def test_what_a_message_function_raises_comes_through():
    def complain(_):
        raise LookupError("mine")
    with pytest.raises(LookupError, match="mine"):
        celltrace.Scene.from_text('#debug "x"', message=complain)


def test_lenient_reading_leaves_out():
    text = "ovus { threshold 1 sphere { 0, 1, 1 } } sphere { 0, 1 }"
    with pytest.raises(celltrace.SceneError, match="not supported"):
        celltrace.Scene.from_text(text)
    with pytest.warns(UserWarning, match="ovus"):
        assert len(celltrace.Scene.from_text(text, lenient=True).objects) == 1
