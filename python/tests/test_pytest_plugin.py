"""The plugin of pytest: a test that asks for adsdv_exam is one for each requirement."""

import re
import xml.etree.ElementTree

import adsdv
import pytest

pytest_plugins = ["pytester"]

OTHERS = "nothing-else"

SILENT = """
import pytest

class Silent:
    def step(self, t_ms, frames):
        return []
"""


def ids(edition):
    return [one["id"] for one in adsdv.exam_requirements(edition)] + [OTHERS]


@pytest.fixture
def run(pytester, root):
    """Runs pytest on the text of a test, beside the example of a stack; the outcomes by the names of the tests."""
    pytester.makepyfile(stack=(root / "exam/examples/stack.py").read_text(encoding="utf-8"))

    def run(text, *arguments):
        pytester.makepyfile(test_it=text)
        result = pytester.inline_run("-p", "no:cacheprovider", "-ra", *arguments)
        told = {}
        for report in result.getreports("pytest_runtest_logreport"):
            if report.when == "call" or report.outcome != "passed":
                outcome = "xfailed" if hasattr(report, "wasxfail") else report.outcome
                text = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr or "")
                told[report.nodeid.partition("::")[2]] = (outcome, text)
        return told

    return run


def outcomes(told):
    return {name: outcome for name, (outcome, _) in told.items()}


@pytest.mark.parametrize("edition", adsdv.editions())
def test_each_requirement_is_a_test_with_the_outcome_of_the_report(run, root, pytester, edition):
    told = run(
        f"""
        from stack import Stack

        def test_my_stack(adsdv_exam):
            report = adsdv_exam(lambda: Stack("{edition}"))
            assert report.passes and adsdv_exam.edition == "{edition}" == report.edition
        """,
        "--adsdv-quick",
        f"--adsdv-edition={edition}",
    )
    pytester.syspathinsert()
    from stack import Stack

    report = adsdv.exam(lambda: Stack(edition), edition=edition, quick=True)
    expected = {one["id"]: {"pass": "passed", "not exercised": "skipped"}[one["outcome"]] for one in report.requirements}
    assert outcomes(told) == {f"test_my_stack[{id}]": outcome for id, outcome in {**expected, OTHERS: "passed"}.items()}
    assert told["test_my_stack[MSG-11]"][1] == (
        "Skipped: not exercised: any value is allowed, and nobody here knows which one is true"
    )


def test_what_fails_has_the_words_of_the_report_and_no_traceback(run):
    told = run(SILENT + "def test_my_stack(adsdv_exam):\n    adsdv_exam(Silent, only='ready')\n")
    outcome, text = told["test_my_stack[RDY-7]"]
    report = adsdv.exam(lambda: lambda t_ms, frames: [], only="ready")
    title = "RDY-7 confirms the mission that is selected (section 3.1, edition 3.0)"
    assert (outcome, text) == ("failed", f"{title}\n{report.explain('RDY-7')}")
    counts = [list(outcomes(told).values()).count(one) for one in ("passed", "failed", "skipped")]
    kinds = [one["outcome"] for one in report.requirements]
    assert counts == [kinds.count("pass") + 1, kinds.count("fail"), kinds.count("not exercised")]


def test_the_counts_are_told(pytester):
    pytester.makepyfile(SILENT + "def test_my_stack(adsdv_exam):\n    adsdv_exam(Silent)\n")
    result = pytester.runpytest("-p", "no:cacheprovider", "--adsdv-only=ready", "-rf")
    report = adsdv.exam(lambda: lambda t_ms, frames: [], only="ready", shrink=0)
    kinds = [one["outcome"] for one in report.requirements]
    result.assert_outcomes(passed=kinds.count("pass") + 1, failed=kinds.count("fail"), skipped=kinds.count("not exercised"))
    result.stdout.fnmatch_lines(["FAILED *::test_my_stack[[]RDY-7[]] - Failed: RDY-7*"])


def test_one_requirement_can_be_chosen(run):
    text = SILENT + "def test_my_stack(adsdv_exam):\n    adsdv_exam(Silent)\n"
    assert outcomes(run(text, "--adsdv-only=ready", "-k", "RDY-7")) == {"test_my_stack[RDY-7]": "failed"}
    told = run(text, "--adsdv-only=ready", "-k", "HS-5 or nothing-else")
    assert outcomes(told) == {"test_my_stack[HS-5]": "failed", f"test_my_stack[{OTHERS}]": "passed"}


COUNTS = """
import pathlib

made = pathlib.Path(__file__).with_name("made")

def make():
    with made.open("a") as file:
        file.write("x")
    return lambda t_ms, frames: []
"""


def test_the_exam_of_a_function_is_held_once(run, pytester):
    run(
        SILENT + COUNTS + "\ndef test_it(adsdv_exam):\n    adsdv_exam(lambda: make(), only='ready', shrink=0)\n"
        "\ndef test_other(adsdv_exam):\n    adsdv_exam(make, only=['no-mission', 'ready'], shrink=0)\n",
    )
    assert (pytester.path / "made").read_text() == "x" * 3


def test_other_parameters_and_other_calls_have_exams_of_their_own(run, pytester):
    told = run(
        SILENT + COUNTS + "\n@pytest.mark.parametrize('name', ['ready', 'no-mission'])\n"
        "def test_it(adsdv_exam, name):\n    adsdv_exam(make, only=name, shrink=0)\n",
        "-k",
        "MSG-11 or MSG-12",
    )
    assert (pytester.path / "made").read_text() == "x" * 2
    assert sorted(told) == [f"test_it[{name}-{id}]" for name in ["no-mission", "ready"] for id in ["MSG-11", "MSG-12"]]
    told = run(
        SILENT + "from stack import Stack\n"
        "def test_it(adsdv_exam):\n    assert adsdv_exam(lambda: Stack('3.0')).passes\n    adsdv_exam(Silent)\n",
        "--adsdv-only=ready",
        "-k",
        "RDY-7",
    )
    assert outcomes(told) == {"test_it[RDY-7]": "failed"}


def test_the_marker_the_configuration_and_the_command_line_say_how(run, pytester):
    text = SILENT + """
seen = []

@pytest.mark.adsdv(edition=["3.0", "4.0"], only="ready", shrink=0)
def test_both(adsdv_exam):
    report = adsdv_exam(Silent)
    names = [one["name"] for one in report.scenarios]
    assert (adsdv_exam.edition, names) == (report.edition, ["ready"])

def test_usual(adsdv_exam):
    report = adsdv_exam(Silent, shrink=0)
    assert (report.edition, [one["name"] for one in report.scenarios]) == ("2026", ["no-mission", "random-0", "random-1"])
"""
    pytester.makeini("[pytest]\nadsdv_edition = 2026\nadsdv_only = no-mission random\nadsdv_runs = 2\n")
    told = run(text, "-k", "MSG-11 or MSG-98")
    assert {name for name in told if "both" in name} == {
        f"test_both[{edition}-{id}]" for edition in ["3.0", "4.0"] for id in ["MSG-11", "MSG-98"] if id in ids(edition)
    }
    # What is said of the report itself is asserted where nothing has failed before.
    told = run(text.replace("adsdv_exam(Silent", "adsdv_exam(Silent, accept={}"), "-k", "nothing-else")
    assert set(outcomes(told).values()) == {"passed"} and len(told) == 3
    told = run(text, "--adsdv-edition=4.0", "-k", "test_both and RDY-7")
    assert list(told) == ["test_both[RDY-7]"]
    told = run(text.replace('["ready"])', '["no-mission"])'), "--adsdv-only=no-mission", "--adsdv-edition=3.0", "-k", "both and nothing-else")
    assert outcomes(told) == {f"test_both[{OTHERS}]": "passed"}
    told = run(text.replace('["ready"])', "names) and len(names) == 5"), "--adsdv-quick", "-k", "both and nothing-else")
    assert set(outcomes(told).values()) == {"passed"}


def test_a_stack_that_raises_fails_a_test_of_its_own(run):
    told = run(
        """
        class Raises:
            def step(self, t_ms, frames):
                return [(0x510, speed)]

        def test_my_stack(adsdv_exam):
            adsdv_exam(Raises)
        """,
        "--adsdv-only=ready",
    )
    outcome, text = told[f"test_my_stack[{OTHERS}]"]
    assert outcome == "failed" and "the stack raised NameError: name 'speed' is not defined" in text
    assert "in step\n    return [(0x510, speed)]" in text
    assert "passed" not in outcomes(told).values()
    assert told["test_my_stack[RDY-7]"] == (
        "skipped",
        "Skipped: not exercised: no scenario came so far; the stack failed in 1 scenario",
    )


def test_what_may_fail_is_accepted(run, recwarn):
    text = SILENT + """
@pytest.mark.adsdv(accept={"RDY-7": "by hand until June", "MSG-11": "nobody counts laps"}, only="ready", shrink=0)
def test_my_stack(adsdv_exam):
    adsdv_exam(Silent)
"""
    told = run(text, "-k", "RDY-7 or HS-5 or MSG-11")
    assert outcomes(told) == {"test_my_stack[MSG-11]": "skipped", "test_my_stack[HS-5]": "failed", "test_my_stack[RDY-7]": "xfailed"}


def test_what_is_accepted_for_nothing_is_a_warning(pytester):
    pytester.makepyfile(SILENT + "def test_my_stack(adsdv_exam):\n    adsdv_exam(Silent, accept={'ID-20': 'x', 'nothing-else': 'y'})\n")
    result = pytester.runpytest("-p", "no:cacheprovider", "--adsdv-only=ready", "-k", "nothing-else")
    result.assert_outcomes(passed=1, warnings=1)
    result.stdout.fnmatch_lines(["*nothing-else is accepted, and does not fail: take it out of accept*"])


@pytest.mark.parametrize(
    "mark, error",
    [
        ("edition='5.0'", "\"edition\" is '5.0'; expected one of \"3.0\""),
        ("accept={'RDY-8': 'x'}", "accept has 'RDY-8'; expected the id of a requirement of edition 3.0, such as 'RDY-7'"),
        ("'4.0'", "has ('4.0',); expected keywords, such as edition='4.0'"),
    ],
)
def test_a_marker_that_is_wrong_is_said(pytester, mark, error):
    pytester.makepyfile(SILENT + f"@pytest.mark.adsdv({mark})\ndef test_my_stack(adsdv_exam):\n    adsdv_exam(Silent)\n")
    result = pytester.runpytest("-p", "no:cacheprovider")
    assert result.ret not in (0, 1)
    assert error in result.stdout.str() + result.stderr.str()
    assert "INTERNALERROR" not in result.stdout.str()


def test_no_verdict_is_an_error_of_each_test_and_waits_once(run):
    told = run(
        """
        import sys

        # Within four seconds Python starts on a busy machine as well.
        def test_my_stack(adsdv_exam):
            adsdv_exam([sys.executable, "-c", "input(); open('started', 'a').write('x'); input()"], timeout=4)
        """
    )
    assert set(outcomes(told).values()) == {"failed"} and len(told) == len(ids("3.0"))
    assert all("adsdv.StackError: " in text for _, text in told.values())
    assert open("started").read() == "x"


def test_logs_are_in_a_folder_for_each_exam(run, pytester):
    text = SILENT + """
@pytest.mark.adsdv(edition=["3.0", "4.0"])
def test_it(adsdv_exam):
    adsdv_exam(Silent, shrink=0)
"""
    run(text, "--adsdv-only=ready", "--adsdv-logs=logs", "-k", "RDY-7")
    logs = sorted(str(one.relative_to(pytester.path)) for one in pytester.path.glob("logs/**/*.log"))
    assert logs == ["logs/test_it-3.0/ready.log", "logs/test_it-4.0/ready.log"]


def test_junit_has_the_requirement_and_the_edition(pytester):
    pytester.makepyfile(SILENT + "def test_my_stack(adsdv_exam):\n    adsdv_exam(Silent, shrink=0)\n")
    pytester.runpytest("-p", "no:cacheprovider", "--adsdv-only=ready", "-k", "RDY-7", "--junitxml=out.xml")
    tree = xml.etree.ElementTree.parse(pytester.path / "out.xml")
    properties = {one.get("name"): one.get("value") for one in tree.iter("property")}
    assert properties == {"adsdv_edition": "3.0", "adsdv_requirement": "RDY-7"}


def test_a_fixture_that_is_asked_for_by_name_is_one_test(run):
    told = run(
        SILENT + "from stack import Stack\n"
        "def test_good(request):\n    request.getfixturevalue('adsdv_exam')(lambda: Stack('3.0'), only='ready')\n"
        "def test_bad(request):\n    request.getfixturevalue('adsdv_exam')(lambda: Stack('4.0'), only='ready', shrink=0)\n"
        "def test_raises(request):\n    request.getfixturevalue('adsdv_exam')(lambda: 1 / 0, only='ready', shrink=0)\n"
    )
    assert outcomes(told) == {"test_good": "passed", "test_bad": "failed", "test_raises": "failed"}


def test_a_call_cannot_have_another_edition_than_its_test(run):
    told = run(SILENT + "def test_it(adsdv_exam):\n    adsdv_exam(Silent, edition='4.0', only='ready')\n", "-k", "RDY-7")
    outcome, text = told["test_it[RDY-7]"]
    assert outcome == "failed"
    assert "adsdv_exam got edition='4.0', and this is a test of 3.0; expected it where tests are made: @pytest.mark" in text


def test_the_example_of_the_readme_is_true(run, root, pytester):
    text = (root / "python/README.md").read_text(encoding="utf-8")
    [example] = [one for one in re.findall("```python\n(.*?)```", text, re.DOTALL) if "adsdv_exam" in one]
    pytester.makepyfile(my_stack=(root / "exam/examples/stack.py").read_text(encoding="utf-8"))
    told = run(example, "--adsdv-quick")
    assert set(outcomes(told).values()) == {"passed", "skipped"}
    assert len(told) == sum(len(ids(edition)) for edition in ["4.0", "2026"]), list(told)
