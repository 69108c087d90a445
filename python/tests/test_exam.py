"""exam and ExamReport: a stack in Python, and a program that speaks the protocol."""

import importlib.util
import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import adsdv
import pytest

EDITIONS = adsdv.editions()


@pytest.fixture(scope="module")
def example(root):
    """exam/examples/stack.py, in the shape of a team's stack."""
    spec = importlib.util.spec_from_file_location("stack", root / "exam/examples/stack.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def silent():
    return lambda t_ms, frames: []


def outcomes(report):
    return {one["id"]: one["outcome"] for one in report.requirements}


@pytest.mark.parametrize("edition", EDITIONS)
def test_a_correct_stack_passes(example, edition):
    report = adsdv.exam(lambda: example.Stack(edition), edition=edition)
    assert report.passes is True and report.verdict == "passes", report.explain()
    assert (report.findings, report.failed, report.explain(), report.notes) == ([], [], "", [])
    assert report.edition == edition and len(report.scenarios) == len(adsdv.exam_scenarios())
    assert list(outcomes(report).values()).count("pass") > 40
    assert report.slowest_answer_ms < 50
    assert [one["id"] for one in report.requirements] == [one["id"] for one in adsdv.exam_requirements(edition)]


@pytest.mark.parametrize("edition", EDITIONS)
def test_a_silent_stack_fails_with_the_requirement(edition):
    report = adsdv.exam(silent, edition=edition, only="ready")
    assert not report.passes and report.verdict == "fails"
    assert outcomes(report)["RDY-7"] == "fail" and outcomes(report)["FIN-1"] == "not exercised"
    assert report.requirement("FIN-1")["why"] == "no scenario came so far"
    first = report.findings[report.requirement("RDY-7")["findings"][0]]
    assert (first["rule"], first["scenario"], first["requirements"]) == ("not-done", "ready", ["RDY-7"])
    assert first["shortest"] == "0 ami TRACK_DRIVE\n0.5 asms on\n+1.53 end\n"
    text = report.explain("RDY-7")
    assert text.startswith(f"{first['seen']}; expected {first['expected']}\nscenario  ready: ")
    assert text.endswith(f"shortest scenario, for adsdv exam --scenario:\n{first['shortest']}".rstrip())
    assert "\nframes    " in text and report.explain("FIN-1") == report.explain() == ""
    again = adsdv.exam(silent, edition=edition, scenario=first["shortest"], shrink=0)
    assert outcomes(again)["RDY-7"] == "fail" and again.findings[0]["shortest"] is None


def test_a_stack_is_made_afresh_for_each_scenario_and_told_the_time_and_the_frames(example):
    made = []

    class Stack(example.Stack):
        def __init__(self):
            super().__init__("4.0")
            self.told = []
            made.append(self)

        def step(self, t_ms, frames):
            self.told.append((t_ms, frames))
            return tuple(super().step(t_ms, frames))

    report = adsdv.exam(Stack, edition="4.0", only=["ready", "no-mission"])
    assert report.passes and [one["name"] for one in report.scenarios] == ["no-mission", "ready"]
    assert len(made) == 2
    times = [t_ms for t_ms, _ in made[1].told]
    assert times == list(range(4, 4010, 10))
    identifier, data = next(frame for frame in made[1].told[0][1] if frame[0] == 0x520)
    assert type(identifier) is int and type(data) is bytes and len(data) == 8


def test_a_stack_may_be_a_function_and_frames_lists_of_what_is_bytes(example):
    kinds = [bytes, bytearray, memoryview, list]

    def make():
        stack = example.Stack("4.0")
        return lambda t_ms, frames: ([one, kinds[one % 4](data)] for one, data in stack.step(t_ms, frames))

    assert adsdv.exam(make, edition="4.0", only="ready").passes


class Raises:
    def __init__(self):
        self.steps = 0

    def step(self, t_ms, frames):
        self.steps += 1
        if self.steps > 100:
            return [(0x510, {}["speed"])]
        return []


def test_what_a_stack_raises_is_a_finding_of_its_scenario():
    report = adsdv.exam(Raises, edition="4.0", only=["ready", "no-mission"])
    assert not report.passes and [one["duration"] for one in report.scenarios] == [1.0, 1.0]
    failed = [one for one in report.findings if one["rule"] == "stack-failed"]
    assert [one["scenario"] for one in failed] == ["no-mission", "ready"]
    first = failed[0]
    assert (first["t"], first["requirements"], first["seen"]) == (1.004, [], "the stack raised KeyError: 'speed'")
    assert first["trace"].startswith("Traceback (most recent call last):\n")
    assert "in step\n    return [(0x510, {}[\"speed\"])]\n" in first["trace"] and first["trace"].endswith("\nKeyError: 'speed'\n")
    assert first["shortest"].endswith("end\n")
    text = report.explain()
    assert text.startswith("the stack raised KeyError: 'speed'; expected no exception\nscenario  no-mission: ")
    assert "(2 scenarios in all)" in text and first["trace"] in text
    assert all("trace" not in one for one in report.findings if one["rule"] != "stack-failed")
    # What it did before is judged, and of what it did not come to is said why.
    assert outcomes(report)["HS-5"] == "fail" and outcomes(report)["RDY-7"] == "not exercised"
    assert report.requirement("FIN-1")["why"] == "no scenario came so far; the stack failed in 2 scenarios"
    assert "failed" not in report.requirement("MSG-11")["why"]


def test_a_stack_that_cannot_be_made_has_failed():
    def make():
        raise OSError("no model\n of the track")

    report = adsdv.exam(make, only="ready")
    assert [one["seen"] for one in report.findings] == ["the stack raised OSError: no model"]
    assert report.findings[0]["trace"].endswith("OSError: no model\n of the track\n")
    report = adsdv.exam(lambda: 5, only="ready")
    assert report.findings[0]["seen"] == "what makes the stack returned 5"
    assert "step(t_ms, frames)" in report.findings[0]["expected"] and "trace" not in report.findings[0]


FRAME = "an (identifier, data), with an identifier from 0 to 0x7FF and data of up to 8 bytes"


@pytest.mark.parametrize(
    "sent, seen, expected",
    [
        (None, "the stack returned None", "a list of the frames that it sends"),
        (5, "the stack returned 5", "a list of the frames that it sends"),
        ("510#00", "the stack sends '5'", FRAME),
        ([0x510], "the stack sends 1296", FRAME),
        ([(0x510,)], "the stack sends (1296,)", FRAME),
        ([(0x510, b"", 1)], "the stack sends (1296, b'', 1)", FRAME),
        ([(0x510, b"")] + [(0x800, b"")], "the stack sends (2048, b'')", FRAME),
        ([(-1, b"")], "the stack sends (-1, b'')", FRAME),
        ([(True, b"")], "the stack sends (True, b'')", FRAME),
        ([("510", b"")], "the stack sends ('510', b'')", FRAME),
        ([(1296.0, b"")], "the stack sends (1296.0, b'')", FRAME),
        ([(0x510, bytes(9))], f"the stack sends (1296, {bytes(9)})", FRAME),
        ([(0x510, "00")], "the stack sends (1296, '00')", FRAME),
        ([(0x510, [256])], "the stack sends (1296, [256])", FRAME),
        ([(0x510, None)], "the stack sends (1296, None)", FRAME),
        ({0x510: b""}, "the stack sends 1296", FRAME),
        (iter(lambda: (0x510, b""), 0), "the stack sends more than 1000 frames in 10 ms", "each of its messages once"),
    ],
)
def test_what_are_no_frames_is_a_finding(sent, seen, expected):
    report = adsdv.exam(lambda: lambda t_ms, frames: sent, edition="4.0", only="ready", shrink=0)
    finding = report.findings[-1]
    assert (finding["rule"], finding["t"], finding["seen"]) == ("stack-failed", 0.004, seen)
    assert finding["expected"].startswith(expected) and "trace" not in finding


def test_what_is_no_exception_ends_the_exam():
    for end in [KeyboardInterrupt("enough"), SystemExit(3)]:

        def step(t_ms, frames, end=end):
            raise end

        with pytest.raises(type(end)) as raised:
            adsdv.exam(lambda: step)
        assert raised.value is end


@pytest.fixture
def listening():
    """Ctrl-C counts, also where the tests run in the background of a shell, which has them ignore it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.skipif(sys.platform == "win32", reason="there is no such signal")
def test_ctrl_c_ends_the_exam_of_a_stack_and_of_a_program(root, listening):
    # What is no Python never looks for signals itself.
    program = [sys.executable, str(root / "exam/examples/stack.py")]
    for stack in [lambda: lambda t_ms, frames: [], program]:
        alarm = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        started = time.monotonic()
        alarm.start()
        with pytest.raises(KeyboardInterrupt):
            adsdv.exam(stack, edition="4.0", runs=100_000, shrink=0)
        assert time.monotonic() - started < 60


def test_other_threads_run_meanwhile(root):
    counted = []
    done = threading.Event()

    def count():
        while not done.is_set():
            counted.append(1)
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    adsdv.exam([sys.executable, str(root / "exam/examples/stack.py")], edition="4.0", only="ready")
    during = len(counted)
    done.set()
    thread.join()
    assert during > 20


def test_reports_are_those_of_the_command(command, example, root):
    program = [sys.executable, str(root / "exam/examples/stack.py")]
    environment = {key: value for key, value in os.environ.items() if key != "ADSDV_EDITION"}
    for options, arguments, stack in [
        ({"quick": True}, ["--quick"], example.Stack),
        ({"only": "ready", "runs": 3, "seed": 7}, ["--only", "ready", "--runs=3", "--seed=7"], None),
        ({"only": ["random", "ready"], "runs": 2}, ["--only=random", "--only=ready", "--runs=2"], example.Stack),
        ({"only": "mission-skidpad", "mission_time": 3}, ["--only=mission-skidpad", "--mission-time=3"], example.Stack),
    ]:
        run = [command, "exam", "--json", "--stdio", "--edition=4.0", *arguments, "--", *program]
        printed = subprocess.run(run, capture_output=True, check=False, env=environment)
        assert printed.returncode in (0, 1), printed.stderr
        report = adsdv.exam(program, edition="4.0", **options)
        assert report.to_json() + "\n" == printed.stdout.decode()
        if stack:
            inside = adsdv.exam(stack, edition="4.0", **options)
            assert {**inside.to_dict(), "program": program} == json.loads(printed.stdout)


def test_logs_are_in_the_report_or_in_a_directory(tmp_path):
    told = adsdv.exam(silent, edition="4.0", only="ready", logs=True).logs
    assert next(iter(told)) == "ready" and "finding-1" in told
    assert adsdv.check(told["ready"], edition="4.0").frames == adsdv.exam(silent, edition="4.0", only="ready").scenarios[0]["frames"]
    folder = tmp_path / "all" / "logs"
    report = adsdv.exam(silent, edition="4.0", only="ready", logs=folder)
    assert report.logs == {}
    assert {one.stem: one.read_bytes() for one in folder.glob("*.log")} == told
    assert (folder / "finding-1.txt").read_text().endswith("end\n")
    file = tmp_path / "file"
    file.write_text("")
    with pytest.raises(OSError) as wrong:
        adsdv.exam(silent, only="ready", logs=file / "logs")
    assert wrong.value.filename == str(file / "logs")
    (tmp_path / "ready.log").mkdir()
    with pytest.raises(IsADirectoryError) as wrong:
        adsdv.exam(silent, only="ready", logs=str(tmp_path))
    assert wrong.value.filename == str(tmp_path / "ready.log")


def test_a_report_can_be_compared_and_pickled():
    report = adsdv.exam(silent, only="ready", logs=True)
    copy = pickle.loads(pickle.dumps(report))
    assert copy == report and copy.explain("RDY-7") == report.explain("RDY-7") and copy.logs == report.logs
    assert report != adsdv.exam(silent, only="no-mission") and report != 5
    assert json.loads(report.to_json()) == report.to_dict()
    assert repr(report).startswith("<adsdv.ExamReport: fails, ")
    with pytest.raises(adsdv.InputError, match="\"id\" is 'RDY-8'; expected one of those of adsdv.exam_requirements()"):
        report.requirement("RDY-8")


def program(text):
    return [sys.executable, "-c", text]


HELLO = 'import sys, time\nfor line in sys.stdin:\n    print(\'{"edition":"4.0"}\' if "hello" in line else %s, flush=True)'


def test_a_program_without_a_verdict_is_an_error(tmp_path):
    def examined(stack, **options):
        return adsdv.exam(stack, edition="4.0", only="ready", **options)

    with pytest.raises(FileNotFoundError) as wrong:
        examined(["no-such-program"])
    assert wrong.value.filename == "no-such-program"
    with pytest.raises(PermissionError):
        examined([tmp_path])
    with pytest.raises(adsdv.StackError, match="(?s)^not the answer to a hello: .*received  hello\n  hint  "):
        examined(program("print('hello'); input()"))
    with pytest.raises(adsdv.StackError, match="(?s)no key \"frames\".*at 0.000 s\n  sent      {\"op\":\"step\""):
        examined(program(HELLO % "'{}'"))
    # Within four seconds Python starts on a busy machine as well.
    with pytest.raises(adsdv.StackError, match="(?s)no answer.*stderr    ready.*raise timeout$"):
        examined(program("import sys; print('ready', file=sys.stderr); input(); input()"), timeout=4)
    with pytest.raises(adsdv.StackError, match="the program is of edition 3.0; expected 4.0"):
        examined(program("input(); print('{\"edition\":\"3.0\"}', flush=True); input()"))


@pytest.mark.parametrize(
    "options, error",
    [
        ({"stack": "python3 stack.py"}, r"\"stack\" is 'python3 stack.py'; expected what makes a stack, such as its class, or a prog"),
        ({"stack": []}, r'"stack" is \[\]; expected what makes'),
        ({"stack": ["python3", 5]}, "expected what makes a stack"),
        ({"stack": Raises()}, "expected what makes it afresh for each scenario, such as its class"),
        ({"only": "redy"}, "\"only\": no scenario begins with \"redy\"; expected one of no-mission, ready, "),
        ({"only": 5}, '"only" is 5; expected the beginning of a scenario'),
        ({"only": []}, '"only" is'),
        ({"quick": True, "only": "ready"}, "\"only\" and \"quick\" are given"),
        ({"scenario": "0 end\n", "runs": 1}, "\"scenario\" is given, and "),
        ({"scenario": "0 fly\n"}, "(?s)\"scenario\" is no scenario\nline 1, column 3: "),
        ({"scenario": 5}, '"scenario" is 5; expected the text of a scenario'),
        ({"edition": "5.0"}, "\"edition\" is '5.0'"),
        ({"runs": -1}, '"runs" is -1; expected a whole number from 0 to 100000'),
        ({"seed": 2**64}, '"seed" is 18446744073709551616; expected'),
        ({"shrink": 1.5}, '"shrink" is 1.5'),
        ({"mission_time": 0}, '"mission_time" is 0; expected seconds, from 0.001 to 86400'),
        ({"timeout": "5"}, "\"timeout\" is '5'"),
        ({"time_limit": float("nan")}, '"time_limit" is nan'),
        ({"logs": 5}, '"logs" is 5; expected True'),
    ],
)
def test_what_is_given_is_checked(options, error):
    with pytest.raises(adsdv.InputError, match=error):
        adsdv.exam(**{"stack": silent, "only": None if "scenario" in options or "quick" in options else "ready", **options})


def test_scenarios_and_requirements_are_listed():
    scenarios = adsdv.exam_scenarios()
    assert [one["name"] for one in scenarios][:2] == ["no-mission", "ready"]
    report = adsdv.exam(silent, quick=True, shrink=0)
    assert [one["name"] for one in report.scenarios] == [one["name"] for one in scenarios if one["quick"]]
    of_all = [{one["id"] for one in adsdv.exam_requirements(edition)} for edition in EDITIONS]
    assert len({frozenset(ids) for ids in of_all}) == len(EDITIONS)
