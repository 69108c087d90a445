"""check_many, Reports and Table."""

import gzip
import json
import os
import shutil
import signal
import subprocess
import threading
from pathlib import Path

import adsdv
import pytest
from test_check import in_a_process


@pytest.fixture
def season(root, tmp_path):
    """A folder with two logs, one of which violates, in formats and folders, beside a file that is none."""
    folder = tmp_path / "season"
    (folder / "sub").mkdir(parents=True)
    packed = (root / "tests/logs/finished-while-moving.log").read_bytes()
    (folder / "a.log.gz").write_bytes(gzip.compress(packed, 1))
    shutil.copy(root / "tests/logs/mission.log", folder / "sub/b.log")
    (folder / "sub/README.txt").write_text("no log")
    (folder / ".hidden").write_text("(1.0) can0 520#00")
    return folder


@pytest.mark.parametrize(
    "options, arguments",
    [({}, []), ({"edition": "4.0", "window_ms": 1}, ["--edition=4.0", "--window=1"])],
)
def test_reports_are_those_of_check_and_of_the_command(command, season, options, arguments):
    paths = [season, season / "missing.log", season / "a.log.gz"]
    environment = {key: value for key, value in os.environ.items() if key != "ADSDV_EDITION"}
    judge = [command, "check", "--json", *paths, *arguments]
    run = subprocess.run(judge, capture_output=True, check=False, env=environment)
    assert run.returncode == 2, run.stderr
    printed = [json.loads(line) for line in run.stdout.splitlines()]
    reports = adsdv.check_many(paths, **options)
    assert [line["log"] for line in printed] == reports.logs.columns()["path"]
    assert reports.paths == [line["log"] for line in printed if "error" not in line]
    assert list(reports.errors) == [line["log"] for line in printed if "error" in line]
    judged = [line for line in printed if "error" not in line]
    for line, path, report in zip(judged, reports.paths, reports):
        shared = {key: value for key, value in line.items() if key in report.to_dict()}
        assert json.dumps(shared) == json.dumps(report.to_dict())
        assert report == adsdv.check(path, **options)
    assert reports.worst_first[0] == str(season / "missing.log")


def test_one_of_all_kinds(season):
    cut = season / "cut.log.gz"
    cut.write_bytes((season / "a.log.gz").read_bytes()[:60_000])
    foreign = season / "x.db3"
    foreign.write_bytes(b"SQLite format 3\0" + bytes(100))
    reports = adsdv.check_many(season)
    names = ["a.log.gz", "cut.log.gz", "sub/b.log", "x.db3"]
    paths = [str(season / name) for name in names]
    assert repr(reports) == "<adsdv.Reports: 4 logs: 2 unreadable, 1 violating, 1 conforming>"
    logs = reports.logs.columns()
    assert logs["path"] == paths
    assert logs["verdict"] == ["violates", "unreadable", "conforms", "unreadable"]
    assert logs["violations"] == [2, 0, 0, 0] and logs["states"][3] == []
    assert logs["states"][2] == ["AS_OFF", "AS_READY", "AS_DRIVING", "AS_FINISHED"]
    assert logs["edition"][3] is None and logs["edition_certain"] == [True, True, True, None]
    assert logs["handshake_p99_ms"][2] == reports[2].handshake_response_ms["p99"]
    # Of what is cut off, what is there is judged, and the error is that of check.
    assert reports.paths == paths[:3] and list(reports.errors) == [paths[1], paths[3]]
    assert logs["frames"] == [report.frames for report in reports] + [0] and 0 < logs["frames"][1] < logs["frames"][0]
    for path, error in reports.errors.items():
        with pytest.raises(type(error)) as alone:
            adsdv.check(path)
        assert str(alone.value) == str(error) and str(error) in logs["error"]
    assert reports.passed_over == [str(season / "sub/README.txt")]
    assert reports.worst_first == [paths[1], paths[3], paths[0], paths[2]]


def test_it_is_a_sequence_of_reports(season):
    reports = adsdv.check_many([season, season / "a.log.gz"], threads=3)
    assert len(reports) == 3 == len(list(reports))
    assert reports[0] == reports[-1] == reports[2] != reports[1] and list(reports[:2]) == list(reports)[:2]
    assert all(isinstance(report, adsdv.Report) for report in reports)
    with pytest.raises(IndexError):
        reports[3]


def test_findings_have_a_row_each(season):
    reports = adsdv.check_many(season)
    findings = reports.findings.columns()
    rows = [
        {"path": path, **{key: value for key, value in finding.items() if key != "evidence"}}
        for path, report in zip(reports.paths, reports)
        for finding in report.findings
    ]
    assert rows == [dict(zip(findings, row)) for row in zip(*findings.values())]
    assert list(findings) == reports.findings.column_names and len(reports.findings) == len(rows)


def test_paths_are_of_any_kind(season):
    one = str(season / "a.log.gz")
    for paths in [one, Path(one), [one], (Path(one),), iter([one]), {one}, str(season / "*.gz")]:
        assert adsdv.check_many(paths).paths == [one]
    assert len(adsdv.check_many([])) == len(adsdv.check_many([]).logs) == 0


@pytest.mark.parametrize(
    "paths, options, error, message",
    [
        (5, {}, TypeError, "^paths are a path, or an iterable of paths; this is 5$"),
        (b"(1.0) can0 520#00", {}, TypeError, "^paths are a path, or an iterable of paths; this is b'"),
        ([5], {}, TypeError, "^paths are a path, or an iterable of paths; this is 5$"),
        ("no-such-*.log", {}, adsdv.InputError, "^no-such-.*no pattern that names some: nothing matches$"),
        ([], {"threads": 0}, adsdv.InputError, '^"threads" is 0; expected a whole number from 1 to 1024$'),
        ([], {"progress": 5}, adsdv.InputError, '^"progress" is 5; expected something that can be called, or None$'),
        ([], {"window_ms": -1}, adsdv.InputError, '^"window_ms" is -1; '),
        ([], {"rules": "calm: never sped > 5"}, adsdv.RulesError, "line 1"),
    ],
)
def test_arguments_that_are_wrong_are_refused(paths, options, error, message):
    with pytest.raises(error, match=message):
        adsdv.check_many(paths, **options)


def test_that_there_is_no_log_is_an_error(tmp_path):
    (tmp_path / "README.txt").write_text("no log")
    with pytest.raises(adsdv.LogError, match="^there is no log in .*, and 1 file without a frame; expected "):
        adsdv.check_many(tmp_path)


def test_what_one_log_has_not_is_the_error_of_that_log(season, mission):
    old = season / "old.log"
    old.write_text("(1.0) can0 520#0000010000000000\n")
    reports = adsdv.check_many([mission, old], readings={"fault-trigger": "edge"})
    assert reports.paths == [str(old)] and list(reports.errors) == [str(mission)]
    assert isinstance(reports.errors[str(mission)], adsdv.InputError)


def test_progress_is_told_by_the_thread_that_asked(season):
    told = []
    adsdv.check_many([season] * 5, progress=lambda *numbers: told.append((threading.get_ident(), numbers)))
    assert {thread for thread, _ in told} == {threading.get_ident()}
    numbers = [numbers for _, numbers in told]
    size = 5 * sum(file.stat().st_size for file in season.rglob("[!.]*") if file.is_file())
    assert numbers == sorted(numbers) and numbers[-1] == (15, 15, size, size)
    assert {done for done, *_ in numbers} >= set(range(1, 16))


def test_what_progress_raises_stops_the_work(season):
    calls = []

    def progress(*numbers):
        calls.append(numbers)
        raise ZeroDivisionError("on purpose")

    before = threading.active_count()
    with pytest.raises(ZeroDivisionError, match="on purpose"):
        adsdv.check_many([season] * 1000, progress=progress)
    assert len(calls) == 1 and threading.active_count() == before


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes")
@pytest.mark.parametrize("threads", [1, 2])
def test_as_many_logs_are_read_at_once_as_threads_says(tmp_path, threads):
    pipes = [tmp_path / "a", tmp_path / "b"]
    for pipe in pipes:
        os.mkfifo(pipe)
    code = """
import adsdv, os, sys, threading, time
a, b, threads = sys.argv[1:]
frame, second = b"(1.0) can0 520#0000010000000000\\n", None
judging = threading.Thread(target=lambda: print(len(adsdv.check_many([a, b], threads=int(threads)))))
judging.start()
with open(a, "wb") as first:
    for _ in range(50):
        try:
            # It can be opened once somebody reads it.
            second = second or os.open(b, os.O_WRONLY | os.O_NONBLOCK)
        except OSError:
            time.sleep(0.02)
    print("one after the other" if second is None else "at once", flush=True)
    first.write(frame)
second = second or os.open(b, os.O_WRONLY)
os.write(second, frame)
os.close(second)
judging.join()
"""
    expected = {1: "one after the other\n2\n", 2: "at once\n2\n"}
    assert in_a_process(code, *pipes, threads) == expected[threads]


def test_python_runs_meanwhile(mission):
    ticks = []
    ended = threading.Event()

    def count():
        while not ended.wait(0.001):
            ticks.append(None)

    counting = threading.Thread(target=count)
    counting.start()
    adsdv.check_many([mission] * 60)
    ended.set()
    counting.join()
    assert len(ticks) > 5


def bomb(folder, kind):
    """A small file that unpacks to very much."""
    if kind == "gzip":
        packed = folder / "bomb.gz"
        line = b"(1.000000) can0 520#0000010000000000\n" * 50_000
        # Members behind each other are one file.
        packed.write_bytes(gzip.compress(line, 9) * 20_000)
    else:
        # A frame of Zstandard with a window of 1 MiB, and blocks of the same byte, 128 KiB each.
        packed = folder / "bomb.zst"
        block = ((128 * 1024) << 3 | 1 << 1).to_bytes(3, "little") + b"\n"
        packed.write_bytes(b"\x28\xb5\x2f\xfd\x00\x50" + block * 4_000_000)
    return packed


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="there are no timers")
@pytest.mark.parametrize("kind", ["gzip", "zstd"])
@pytest.mark.parametrize("call", ["check(sys.argv[1])", "check_many([sys.argv[1]] * 3)", "check_many(sys.argv[1], threads=1)"])
def test_a_compressed_log_can_be_interrupted(tmp_path, call, kind):
    code = f"""
import adsdv, signal, sys, time
def interrupt(*_):
    raise KeyboardInterrupt
signal.signal(signal.SIGALRM, interrupt)
signal.setitimer(signal.ITIMER_REAL, 0.5)
begun = time.monotonic()
try:
    print(adsdv.{call})
except KeyboardInterrupt:
    print("interrupted" if time.monotonic() - begun < 2 else time.monotonic() - begun)
"""
    assert in_a_process(code, bomb(tmp_path, kind)) == "interrupted\n"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes")
@pytest.mark.parametrize("first", [b"", b"(1.0) can0 520#0000010000000000\n", gzip.compress(b"(1.0) can0 520#00\n")[:-4]])
def test_a_pipe_that_gives_nothing_can_be_interrupted(tmp_path, first):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    code = """
import adsdv, os, signal, sys
def interrupt(*_):
    raise KeyboardInterrupt
kept = os.open(sys.argv[1], os.O_RDWR)
os.write(kept, bytes.fromhex(sys.argv[2]))
signal.signal(signal.SIGALRM, interrupt)
signal.setitimer(signal.ITIMER_REAL, 0.3, 0.3)
try:
    adsdv.check(sys.argv[1])
except KeyboardInterrupt:
    print("interrupted", flush=True)
os._exit(0)
"""
    assert in_a_process(code, pipe, first.hex()) == "interrupted\n"


def test_it_works_in_a_process_that_was_forked(mission):
    code = """
import adsdv, os, sys
first = adsdv.check_many(sys.argv[1])
child = os.fork()
if child == 0:
    os._exit(0 if adsdv.check_many(sys.argv[1])[0] == first[0] else 3)
print(os.waitpid(child, 0)[1])
"""
    if not hasattr(os, "fork"):
        pytest.skip("there is no fork")
    assert in_a_process(code, mission) == "0\n"


def test_polars_takes_the_tables(season):
    polars = pytest.importorskip("polars")
    reports = adsdv.check_many(season)
    for table in [reports.logs, reports.findings]:
        frame = polars.DataFrame(table)
        assert frame.to_dict(as_series=False) == table.columns() == polars.DataFrame(table.columns()).to_dict(as_series=False)


def test_pyarrow_takes_the_tables_and_parquet_keeps_them(season, tmp_path):
    pyarrow = pytest.importorskip("pyarrow")
    parquet = pytest.importorskip("pyarrow.parquet")
    reports = adsdv.check_many(season)
    for table in [reports.logs, reports.findings]:
        arrow = pyarrow.table(table)
        arrow.validate(full=True)
        assert arrow.to_pydict() == table.columns() and arrow.column_names == table.column_names
        parquet.write_table(arrow, tmp_path / "table.parquet")
        assert parquet.read_table(tmp_path / "table.parquet").to_pydict() == table.columns()
    capsule = reports.findings.__arrow_c_stream__()
    del reports, capsule  # A stream that nobody reads is let go.


def test_pandas_takes_the_tables(season):
    pandas = pytest.importorskip("pandas")
    table = adsdv.check_many(season).findings
    frame = pandas.DataFrame(table.columns())
    assert list(frame.columns) == table.column_names and len(frame) == len(table)
    if hasattr(pandas.DataFrame, "from_arrow"):
        pytest.importorskip("pyarrow")
        assert list(pandas.DataFrame.from_arrow(table)["message"]) == table.columns()["message"]
