"""docs/season.md: its own code judges a season on the cluster that Dask makes of one machine."""

import os
import re
import shutil
import subprocess
import sys

import adsdv
import pytest


@pytest.fixture
def page(root):
    return (root / "docs/season.md").read_text(encoding="utf-8")


def programs(page):
    """The programs of the page, by the names that their first lines say."""
    return dict(re.findall(r"```python\n# (\w+\.py)\n(.*?)```", page, re.DOTALL))


def test_the_page_judges_a_season_with_dask(page, root, tmp_path):
    pytest.importorskip("distributed")
    polars = pytest.importorskip("polars")
    pytest.importorskip("pyarrow")
    logs, out = tmp_path / "logs", tmp_path / "season"
    for name in ["a/mission.log", "a/finished-while-moving.log", "b/mission.log"]:
        (logs / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(root / "tests/logs" / (logs / name).name, logs / name)
    (logs / "b/damaged.log.gz").write_bytes(b"\x1f\x8b damaged")
    for name, text in programs(page).items():
        (tmp_path / name).write_text(text)

    def run():
        command = [sys.executable, "with_dask.py", str(logs), str(out)]
        environment = {**os.environ, "DASK_DISTRIBUTED__DASHBOARD__LINK": "", "DASK_DISTRIBUTED__SCHEDULER__DASHBOARD__STATUS__TASK_STREAM_LENGTH": "0"}
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False, env=environment)
        assert done.returncode == 0, done.stderr
        return done.stdout.splitlines()

    printed = run()
    assert len(printed) == 4 and printed[-1].startswith("4 of 4: ")
    alone = adsdv.check_many(logs)
    for table in ["logs", "findings"]:
        written = polars.read_parquet(out / table / "*.parquet").to_dicts()
        columns = getattr(alone, table).columns()
        rows = [dict(zip(columns, row)) for row in zip(*columns.values())]
        by_path = sorted(rows, key=lambda row: row["path"])
        assert sorted(written, key=lambda row: row["path"]) == by_path and len(rows) > 3
    # What was done is not done again, and what was not is.
    kept = {file: file.stat().st_mtime_ns for file in out.rglob("*.parquet")}
    gone = next(file for file in kept if file.parent.name == "logs")
    gone.unlink()
    run()
    anew = {file for file in kept if file.stat().st_mtime_ns != kept[file]}
    assert {file.name for file in anew} == {gone.name} and not list(out.rglob("*.part"))


def test_the_page_names_the_columns_that_there_are(page):
    reports = adsdv.check_many([])
    for name, table in [("logs", reports.logs), ("findings", reports.findings)]:
        row = next(line for line in page.splitlines() if line.startswith(f"| `{name}` | "))
        assert re.findall(r"`(\w+)`", row)[1:] == table.column_names
