"""The plugin of pytest: a test that asks for adsdv_exam is a test of its own for each requirement of the AI Computer.

    def test_my_stack(adsdv_exam):
        adsdv_exam(MyStack)

The exam is held when the first of these tests calls it; the others take from the same report. Nothing is decided here: a
requirement passes, fails with what adsdv.ExamReport.explain says, or is skipped where it was not exercised, with the reason.
"""

import re
import warnings
from pathlib import Path

import pytest

import adsdv

#: The test of what is wrong beside the requirements, such as a stack that raises.
OTHERS = "nothing-else"

#: What can be said of an exam on the command line (--adsdv-quick), in the configuration (adsdv_quick) and in the marker (quick): how
#: the command line takes it, the type of the configuration, and what it is.
OPTIONS = {
    "edition": ({"metavar": "EDITION"}, "args", f"the edition of the interface: {', '.join(adsdv.editions())}"),
    "quick": ({"action": "store_true", "default": None}, "bool", "only the few scenarios that show most"),
    "only": ({"metavar": "NAME", "action": "append"}, "args", "only the scenarios whose names begin so"),
    "runs": ({"metavar": "N", "type": int}, "string", "how many scenarios by chance follow"),
    "seed": ({"metavar": "N", "type": int}, "string", "the seed of these"),
    "logs": ({"metavar": "DIR"}, "string", "the directory for the logs of the scenarios, in a folder for each test"),
}

#: What else the marker and a call of adsdv_exam take, beside what adsdv.exam does.
ACCEPT = "accept"

REPORTS = pytest.StashKey()


def pytest_addoption(parser):
    group = parser.getgroup("adsdv", "exams of AI Computers (adsdv)")
    for name, (how, kind, about) in OPTIONS.items():
        group.addoption(f"--adsdv-{name}", dest=f"adsdv_{name}", help=about, **how)
        parser.addini(f"adsdv_{name}", about, type=kind, default=None)


def pytest_configure(config):
    config.addinivalue_line(
        "markers",
        "adsdv(edition=..., quick=..., only=..., accept={id: why}, ...): how a test with adsdv_exam examines, by the keywords of "
        "adsdv.exam; edition may be a list, and accept has the requirements that may fail",
    )
    config.stash[REPORTS] = {}


def options(config, node):
    """What is said of the exams of a test: the command line goes before its marker, and that before the configuration."""
    said = {}
    for name, (_, kind, _) in OPTIONS.items():
        value = config.getini(f"adsdv_{name}")
        if value:
            said[name] = int(value) if name in ("runs", "seed") else value
    for marker in reversed(list(node.iter_markers("adsdv"))):
        if marker.args:
            raise pytest.UsageError(f"adsdv of {node.nodeid} has {marker.args!r}; expected keywords, such as edition='4.0'")
        said.update(marker.kwargs)
    for name in OPTIONS:
        value = config.getoption(f"adsdv_{name}")
        if value is not None:
            said[name] = value
    # Only one of them can be meant: that of the command line.
    if config.getoption("adsdv_quick") and not config.getoption("adsdv_only"):
        said.pop("only", None)
    elif config.getoption("adsdv_only") and not config.getoption("adsdv_quick"):
        said.pop("quick", None)
    return said


def editions(said):
    """The editions that a test is about, one or some."""
    given = said.get("edition")
    given = given if isinstance(given, (list, tuple)) else [given]
    return [adsdv.INTERFACE_VERSION if edition is None else edition for edition in given]


# Behind the parameters of the test's own, each of which has an exam.
@pytest.hookimpl(trylast=True)
def pytest_generate_tests(metafunc):
    if "adsdv_exam" not in metafunc.fixturenames:
        return
    node = metafunc.definition
    said = options(metafunc.config, node)
    every = editions(said)
    tests, ids = [], []
    for edition in every:
        try:
            known = [one["id"] for one in adsdv.exam_requirements(edition)]
        except adsdv.InputError as error:
            raise pytest.UsageError(f"{node.nodeid}: {error}") from None
        for one in [*known, OTHERS]:
            ids.append(one if len(every) == 1 else f"{edition}-{one}")
            tests.append((edition, one, ids[-1]))
    unknown = [id for id in said.get(ACCEPT) or {} if id not in [one for _, one, _ in tests]]
    if unknown:
        raise pytest.UsageError(
            f"{node.nodeid}: accept has {unknown[0]!r}; expected the id of a requirement of edition {' or '.join(every)}, such as "
            f"'RDY-7', or {OTHERS!r}"
        )
    metafunc.parametrize("adsdv_exam", tests, ids=ids, indirect=True)


@pytest.fixture
def adsdv_exam(request):
    """Examines a stack, the AI Computer, and reports each requirement as a test: adsdv_exam(MyStack).

    It takes what adsdv.exam takes, and returns its report. The exam is held by the first test of a function that calls it; the
    others take its report. The marker adsdv says how: @pytest.mark.adsdv(edition="4.0", quick=True).
    """
    return Exam(request)


class Exam:
    """What a test calls: the edition that it is about, and the id of its requirement."""

    def __init__(self, request):
        self._request, self._calls = request, 0
        self._options = options(request.config, request.node)
        # Who asks by request.getfixturevalue has no parameter: that is one test of all requirements.
        usual = (editions(self._options)[0], None, "")
        self.edition, self.requirement, self._id = getattr(request, "param", usual)

    def __repr__(self):
        return f"<adsdv_exam: edition {self.edition}, {self.requirement or 'all requirements'}>"

    def __call__(self, stack, **given):
        __tracebackhide__ = True
        if given.get("edition", self.edition) != self.edition:
            raise pytest.UsageError(
                f"adsdv_exam got edition={given['edition']!r}, and this is a test of {self.edition}; expected it where tests are "
                f"made: @pytest.mark.adsdv(edition={given['edition']!r})"
            )
        given = {**self._options, **given, "edition": self.edition}
        accept = given.pop(ACCEPT, None) or {}
        report = self._report(stack, given)
        self._request.node.user_properties += [("adsdv_edition", self.edition), ("adsdv_requirement", self.requirement)]
        if self.requirement is None:
            for one in [*(one["id"] for one in report.failed), OTHERS]:
                self._judge(report, one, accept)
        else:
            self._judge(report, self.requirement, accept)
        return report

    def _judge(self, report, id, accept):
        __tracebackhide__ = True
        if id == OTHERS:
            title, outcome = "findings that are against no single requirement", "pass"
            text = report.explain()
            outcome = "fail" if text else "pass"
        else:
            one = report.requirement(id)
            title, outcome = f"{id} {one['about']} (section {one['section']}, edition {report.edition})", one["outcome"]
            text = report.explain(id)
        if outcome == "fail" and id in accept:
            pytest.xfail(f"accepted: {accept[id]}")
        if outcome == "fail":
            pytest.fail(f"{title}\n{text}", pytrace=False)
        if id in accept:
            warnings.warn(pytest.PytestWarning(f"{id} is accepted, and does not fail: take it out of accept"), stacklevel=3)
        if outcome == "not exercised":
            pytest.skip(f"not exercised: {one['why']}")

    def _report(self, stack, given):
        """The report of this call: that of the same call of another test of the function, if there was one."""
        __tracebackhide__ = True
        node = self._request.node
        # A stack may be a function that is made in the test, anew each time: so it is its place that tells it.
        function = getattr(node, "originalname", None) or node.name
        others = getattr(getattr(node, "callspec", None), "id", "")
        others = others.removesuffix(self._id).strip("-")
        key = (node.parent.nodeid, function, others, self.edition, self._calls)
        self._calls += 1
        reports = node.config.stash[REPORTS]
        if key not in reports:
            if isinstance(given.get("logs"), (str, Path)):
                name = "-".join([function, *([others] if others else []), self.edition])
                name = name if self._calls == 1 else f"{name}-{self._calls}"
                given["logs"] = Path(given["logs"]) / re.sub(r"[^\w.-]+", "_", name)
            try:
                reports[key] = adsdv.exam(stack, **given)
            except Exception as error:
                # Whoever asks next gets the same answer, and waits for no timeout again.
                reports[key] = error
        if isinstance(reports[key], Exception):
            raise reports[key].with_traceback(None)
        return reports[key]
