"""check and Report."""

import concurrent.futures
import copy
import gzip
import json
import os
import pickle
import signal
import subprocess
import sys

import adsdv
import pytest
import written


def test_a_conforming_mission(mission):
    report = adsdv.check(mission)
    assert (report.verdict, report.violations, report.frames) == ("conforms", [], 33940)
    assert report.duration_s == pytest.approx(25.996, abs=0.001)
    assert [(one["from"], one["to"], one["justified"]) for one in report.transitions] == [
        ("AS_OFF", "AS_READY", "true"),
        ("AS_READY", "AS_DRIVING", "true"),
        ("AS_DRIVING", "AS_FINISHED", "true"),
        ("AS_FINISHED", "AS_OFF", "true"),
    ]
    answers = {key: round(value, 2) for key, value in report.handshake_response_ms.items()}
    assert answers == {"count": 2423, "min": 2.42, "median": 5.39, "p99": 5.68, "max": 17.07}


def test_finished_at_speed_violates(finished):
    report = adsdv.check(str(finished))
    assert report.verdict == "violates"
    assert [(one["rule"], one["party"], one["section"]) for one in report.violations] == [
        ("finished-while-moving", "AI", "4"),
        ("fault-flag-unfounded", "VCU", "2.2"),
    ]


@pytest.mark.parametrize(
    "options, arguments",
    [
        ({}, []),
        ({"readings": {"go-edge": "edge"}}, ["--reading=go-edge=edge"]),
        ({"edition": "3.0", "readings": {"fault-trigger": "edge"}}, ["--edition=3.0", "--reading=fault-trigger=edge"]),
        *[({"edition": edition}, [f"--edition={edition}"]) for edition in adsdv.editions()],
        ({"window_ms": 0, "deadline_ms": 1}, ["--window=0", "--deadline=1"]),
        ({"interface": "vcan0"}, ["--interface=vcan0"]),
    ],
)
def test_reports_are_those_of_the_command(command, any_log, options, arguments):
    environment = {key: value for key, value in os.environ.items() if key != "ADSDV_EDITION"}
    judge = [command, "check", "--json", any_log, *arguments]
    run = subprocess.run(judge, capture_output=True, check=False, env=environment)
    assert run.returncode in (0, 1), run.stderr
    printed = json.loads(run.stdout)
    report = adsdv.check(any_log, **options)
    shared = {key: value for key, value in printed.items() if key in report.to_dict()}
    assert set(printed) - set(shared) == {"stays", "go_presses", "margins", "exercised"}
    assert report.to_dict() == shared == json.loads(json.dumps(report.to_dict()))
    assert adsdv.Report(printed) == report


def test_the_edition_is_recognised_unless_it_is_named(any_log):
    report = adsdv.check(any_log)
    assert report.edition != "3.0" and report.recognised["certain"]
    assert "511h has 4 bytes (3.0: 8)" in report.recognised["evidence"]
    for edition in adsdv.editions():
        named = adsdv.check(any_log, edition=edition)
        assert (named.edition, named.recognised) == (edition, None)
    assert adsdv.check(any_log, edition="3.0").findings != report.findings


def test_a_log_that_does_not_tell_its_edition_is_judged_by_the_default():
    report = adsdv.check(["(1.0) can0 520#0000010000000000"])
    assert (report.edition, report.recognised["certain"]) == (adsdv.INTERFACE_VERSION, False)
    assert any(finding["rule"] == "edition" for finding in report.findings)


def test_readings_are_those_of_the_edition_that_is_judged_by(any_log):
    settled = {"readings": {"fault-trigger": "edge"}}
    assert adsdv.check(any_log, edition="3.0", **settled).frames > 0
    recognised = adsdv.check(any_log).edition
    for edition, options in [(recognised, settled), ("4.0", {"edition": "4.0", **settled})]:
        with pytest.raises(adsdv.InputError) as error:
            adsdv.check(any_log, **options)
        assert str(error.value) == f"\"fault-trigger\" is 'edge'; expected in edition {edition} level"


@pytest.mark.parametrize("log, conforms, violates", written.DECIDED)
def test_options_reach_the_judge(log, conforms, violates):
    assert adsdv.check(log, **conforms).verdict == "conforms"
    assert adsdv.check(log, **violates).verdict == "violates"


def test_the_interface_is_chosen():
    log = written.due() + ["(2.0) vcan1 520#0000010000000000"]
    assert adsdv.check(log).verdict == "violates"
    assert adsdv.check(log, interface="vcan1").verdict == "conforms"


def test_a_log_comes_from_anywhere(any_log, tmp_path):
    report = adsdv.check(any_log)
    data = any_log.read_bytes()
    lines = data.decode().splitlines()
    packed = tmp_path / "log.gz"
    packed.write_bytes(gzip.compress(data, 1))
    with_ends = data.splitlines(keepends=True)
    for source in [str(any_log), data, bytearray(data), memoryview(data), lines, iter(lines), with_ends]:
        assert adsdv.check(source) == report
    with open(any_log, encoding="utf-8") as text, open(any_log, "rb") as binary, gzip.open(packed) as unpacked:
        for source in [text, binary, unpacked]:
            assert adsdv.check(source) == report


def test_a_last_line_without_an_end_is_cut_off_only_where_lines_have_ends():
    first, last = "(1.0) can0 520#0000010000000000", "(1.01) can0 520#00"
    cut_off = "line 2: the log ends in the middle of frame 520h; expected a line feed at its end"

    def messages(log):
        return [one["message"] for one in adsdv.check(log).findings if one["rule"] == "broken-line"]

    assert messages(f"{first}\n{last}".encode()) == [cut_off]
    assert messages([f"{first}\n", last]) == [cut_off]
    assert messages([first, last]) == []
    assert messages([last, first]) == []


def test_a_broken_line_is_a_finding():
    report = adsdv.check(["rubbish", "(1.0) can0 520#0000010000000000", b"\xff\xfe"])
    assert [one["message"] for one in report.findings if one["rule"] == "broken-line"] == [
        'line 1, column 1: found "rubbish", expected a time such as (1436509052.249713)',
        'line 3, column 1: found "\\xff\\xfe", expected a time such as (1436509052.249713)',
    ]


@pytest.mark.parametrize(
    "log, options, message",
    [
        (b"", {}, "the log is empty; expected lines of candump -L, such as (1.000000) can0 520#0000010000000000"),
        ([], {}, "the log is empty; "),
        (b"a\nb\n", {}, 'no readable frame in 2 lines; line 1, column 1: found "a", expected a time such as '),
        (
            b"(1.0) can0 520#0000010000000000\n",
            {"interface": "can1"},
            "no data frame with an 11-bit identifier on interface can1; the log has can0",
        ),
    ],
)
def test_a_log_with_nothing_to_judge_is_an_error(log, options, message):
    with pytest.raises(adsdv.LogError) as error:
        adsdv.check(log, **options)
    assert str(error.value).startswith(message)
    assert isinstance(error.value, ValueError)


def test_what_cannot_be_read_is_an_os_error(tmp_path):
    missing = tmp_path / "missing.log"
    with pytest.raises(FileNotFoundError) as error:
        adsdv.check(missing)
    assert (error.value.errno, error.value.filename) == (2, missing)
    with pytest.raises(OSError) as error:
        adsdv.check(tmp_path)
    if os.name == "posix":
        assert isinstance(error.value, IsADirectoryError)
    with pytest.raises(OSError):
        adsdv.check("\0")


@pytest.mark.parametrize(
    "options, message",
    [
        ({"window_ms": -1}, '"window_ms" is -1; expected a whole number from 0 to 60000'),
        ({"deadline_ms": 60001}, '"deadline_ms" is 60001; expected a whole number from 0 to 60000'),
        ({"window_ms": 1.5}, '"window_ms" is 1.5; expected a whole number from 0 to 60000'),
        ({"readings": {"go-edge": "late"}}, "'late': no such choice of go-edge; expected one of seen-low, edge"),
        ({"edition": "2.9"}, "\"edition\" is '2.9'; expected one of " + ", ".join(f'"{one}"' for one in adsdv.editions())),
        ({"edition": 3.0}, "\"edition\" is 3.0; expected one of " + ", ".join(f'"{one}"' for one in adsdv.editions())),
    ],
)
def test_options_that_there_are_not_are_refused(options, message):
    with pytest.raises(adsdv.InputError) as error:
        adsdv.check(b"", **options)
    assert str(error.value) == message


def test_lines_that_are_none_are_refused():
    with pytest.raises(adsdv.InputError, match="^line 2 of the log is 5; expected a str or bytes$"):
        adsdv.check(["(1.0) can0 520#00", 5])
    with pytest.raises(TypeError, match="^a log is a path, bytes, or lines; this is 5$"):
        adsdv.check(5)


def test_an_exception_of_the_lines_comes_through():
    class Broken(Exception):
        pass

    def lines():
        yield "(1.0) can0 520#0000010000000000"
        raise Broken("on purpose")

    with pytest.raises(Broken, match="on purpose"):
        adsdv.check(lines())


def test_four_threads_judge_as_one_does(mission):
    report = adsdv.check(mission)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        assert list(pool.map(adsdv.check, [mission] * 16)) == [report] * 16


def test_four_processes_judge_as_one_does(finished):
    report = adsdv.check(finished)
    with concurrent.futures.ProcessPoolExecutor(4) as pool:
        assert list(pool.map(adsdv.check, [finished] * 8)) == [report] * 8
        with pytest.raises(adsdv.LogError, match="the log is empty"):
            pool.submit(adsdv.check, b"").result()


def in_a_process(code, *arguments):
    """What a program prints that must not hang."""
    command = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=True).stdout


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes")
def test_other_threads_run_while_a_log_is_judged(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    code = """
import adsdv, sys, threading
judging = threading.Thread(target=lambda: print(adsdv.check(sys.argv[1]).frames))
judging.start()
with open(sys.argv[1], "wb") as log:
    log.write(b"(1.0) can0 520#0000010000000000\\n")
    log.flush()
    assert judging.is_alive()
judging.join()
"""
    assert in_a_process(code, pipe) == "1\n"


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="there are no timers")
def test_judging_can_be_interrupted():
    code = """
import adsdv, signal
def interrupt(*_):
    raise KeyboardInterrupt
signal.signal(signal.SIGALRM, interrupt)
signal.setitimer(signal.ITIMER_REAL, 0.2)
try:
    adsdv.check("/dev/zero")
except KeyboardInterrupt:
    print("interrupted")
"""
    assert in_a_process(code) == "interrupted\n"


def test_reports_are_values(any_log, mission):
    report = adsdv.check(any_log)
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        assert pickle.loads(pickle.dumps(report, protocol)) == report
    assert copy.deepcopy(report) == report == adsdv.Report(json.loads(json.dumps(report.to_dict())))
    assert report != adsdv.check(["(1.0) can0 520#0000010000000000"]) and report != report.to_dict()
    assert repr(report).startswith(f"<adsdv.Report: {report.verdict}, ")


def test_a_report_is_whole():
    recognised = adsdv.check(["(1.0) can0 520#0000010000000000"]).to_dict()
    assert adsdv.Report(recognised).recognised == recognised["recognised"]
    with pytest.raises(adsdv.InputError, match='^"recognised" is 1; '):
        adsdv.Report({**recognised, "recognised": 1})
    whole = {key: value for key, value in recognised.items() if key != "recognised"}
    assert adsdv.Report(whole).recognised is None
    with pytest.raises(adsdv.InputError, match='^"schema" is 2; '):
        adsdv.Report({**whole, "schema": 2})
    for key in whole:
        with pytest.raises(adsdv.InputError, match=f'^there is no "{key}"; expected a whole report$'):
            adsdv.Report({other: value for other, value in whole.items() if other != key})
        with pytest.raises(adsdv.InputError, match=f'^"{key}" is '):
            adsdv.Report({**whole, key: object()})
    with pytest.raises(adsdv.InputError, match='^there is no key "found"; expected one of schema, '):
        adsdv.Report({**whole, "found": 1})
    with pytest.raises(TypeError):
        adsdv.Report(5)


def test_findings_are_a_table(finished):
    pandas = pytest.importorskip("pandas")
    report = adsdv.check(finished)
    findings = pandas.DataFrame(report.findings)
    assert list(findings.columns) == [
        *("t", "severity", "party", "section", "rule", "requirements", "message"),
        *("seen", "expected", "unless", "evidence"),
    ]
    assert findings.groupby("severity").size()["violation"] == len(report.violations)
    assert len(pandas.DataFrame(report.transitions)) == len(report.transitions)
