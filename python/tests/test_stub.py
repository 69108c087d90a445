"""The stub says what the module has, and nothing else."""

import ast
import inspect
import subprocess
import sys
from pathlib import Path

import adsdv
import pytest

STUB = Path(adsdv.__file__).parent / "__init__.pyi"
TREE = ast.parse(STUB.read_text(encoding="utf-8"))


def names(body):
    """The names that a body defines."""
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            yield node.name, node
        elif isinstance(node, ast.AnnAssign):
            yield node.target.id, node
        elif isinstance(node, ast.Assign):
            yield node.targets[0].id, node


TOP = dict(names(TREE.body))


def public(name):
    return not name.startswith("_") or name == "__version__"


def members(name):
    return {member for member, _ in names(TOP[name].body)}


def test_the_wheel_is_typed(root):
    assert (STUB.parent / "py.typed").exists()
    assert STUB.read_bytes() == (root / "python/package/adsdv/__init__.pyi").read_bytes()


def test_names_are_those_of_the_module():
    assert {name for name in TOP if public(name)} == set(adsdv.__all__)


@pytest.mark.parametrize("name", [name for name in adsdv.__all__ if inspect.isclass(getattr(adsdv, name))])
def test_members_are_those_of_the_class(name):
    thing = getattr(adsdv, name)
    if issubclass(thing, Exception):
        assert [base.id for base in TOP[name].bases] == [thing.__base__.__name__]
        return
    there = dir(adsdv.Control() if thing is adsdv.Control else thing)
    assert {member for member in members(name) if public(member)} == {member for member in there if public(member)}
    own = vars(thing).keys() & {"__eq__", "__hash__"}
    assert members(name) & {"__eq__", "__hash__"} == {one for one in own if vars(thing)[one] is not None}


def test_parameters_are_those_of_the_functions():
    def check(node, thing):
        given = [argument.arg for argument in node.args.posonlyargs + node.args.args + node.args.kwonlyargs]
        given += [node.args.kwarg.arg] if node.args.kwarg else []
        assert [name for name in given if name != "self"] == [
            name for name in inspect.signature(thing).parameters if name != "self"
        ]

    checked = 0
    for name, node in TOP.items():
        if isinstance(node, ast.FunctionDef):
            check(node, getattr(adsdv, name))
            checked += 1
        elif isinstance(node, ast.ClassDef) and public(name):
            for member, method in names(node.body):
                if isinstance(method, ast.FunctionDef) and public(member) and not method.decorator_list:
                    check(method, getattr(getattr(adsdv, name), member))
                    checked += 1
    assert checked > 15


def literals(name):
    return [constant.value for constant in ast.walk(TOP[name].value) if isinstance(constant, ast.Constant)]


def annotations(name):
    """The keys of a dict with their annotations: those of what it extends come first."""
    extended = [annotations(base.id) for base in TOP[name].bases if base.id != "TypedDict"]
    own = {key: ast.unparse(node.annotation) for key, node in names(TOP[name].body)}
    return {**(extended[0] if extended else {}), **own}


@pytest.mark.parametrize("name, table", [("_Inputs", adsdv.inputs), ("_Outputs", adsdv.outputs)])
def test_keys_and_values_are_those_of_the_tables_of_all_editions(name, table):
    of_all = [{field["key"]: field for field in table(edition)} for edition in adsdv.editions()]
    stub = annotations(name)
    assert set(stub) == set().union(*of_all)
    if name == "_Outputs":
        assert set(annotations("_OutputsOfAll")) == set.intersection(*(set(keys) for keys in of_all))
    for key, annotation in stub.items():
        fields = [keys[key] for keys in of_all if key in keys]
        if fields[0]["kind"] == "name":
            assert set(literals(annotation)) == {value for field in fields for value in field["names"]}
        else:
            expected = {"flag": "bool", "number": "int"}[fields[0]["kind"]]
            assert annotation == expected + (" | None" if fields[0].get("nullable") else "")


def test_dicts_have_the_keys_that_the_stub_says(finished):
    report = adsdv.check(finished, rules="calm: never moving and ASMS off")
    exam = adsdv.exam(lambda: lambda t_ms, frames: [], only="ready", shrink=0)
    for name, dict in [
        ("_Control", adsdv.Control().to_dict()),
        ("_ControlGiven", adsdv.Control().to_dict()),
        ("_Message", adsdv.decode(0x513, bytes(8))),
        ("_Finding", report.findings[0]),
        ("_Response", report.handshake_response_ms),
        ("_Recognised", report.recognised),
        ("_RuleOfAll", report.rules[0]),
        ("_ReportOfAll", adsdv.check(finished, edition=report.edition).to_dict()),
        ("_InputField", adsdv.inputs()[0]),
        ("_OutputField", adsdv.outputs()[0]),
        ("_Signal", adsdv.messages()[0]),
        ("_Reading", adsdv.readings()[0]),
        ("_Requirement", adsdv.exam_requirements()[0]),
        ("_ExamScenario", adsdv.exam_scenarios()[0]),
        ("_ScenarioOutcome", exam.scenarios[0]),
        ("_Action", exam.findings[-1]["operator"][0]),
        ("_Sent", exam.findings[-1]["frames"][0]),
        ("_ExamReport", exam.to_dict()),
    ]:
        assert [key for key, _ in names(TOP[name].body)] == list(dict), name
    assert set(annotations("_Report")) == set(report.to_dict())
    assert set(annotations("_Examined")) == set(exam.requirements[0])
    assert set(annotations("_ExamFindingOfAll")) == set(exam.findings[-1])
    failed = adsdv.exam(object, only="ready").findings[0]
    raised = adsdv.exam(lambda: 1 / 0, only="ready").findings[0]
    assert set(annotations("_ExamFinding")) == set(raised) == {*failed, "trace"}
    transition = TOP["_Transition"].value.args[1].keys
    assert [key.value for key in transition] == list(report.transitions[0])


def test_mypy_agrees(tmp_path):
    pytest.importorskip("mypy")
    example = Path(__file__).with_name("typed_example.py")
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path), str(example)]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
