"""Opens what adsdv decoded in DuckDB, pandas, polars and pyvcd, and compares with its JSON Lines: the FOLDER with all of it.

Runs there what the DOCUMENT shows, as well.
"""

import io
import json
import math
import os
import sys
from collections import defaultdict
from contextlib import redirect_stdout
from pathlib import Path

import duckdb
import pandas
import polars
from vcd.reader import TokenKind, tokenize

folder, document = Path(sys.argv[1]), Path(sys.argv[2])
frames = [json.loads(line) for line in open(folder / "run.jsonl")]

# Of each signal of each message: its values in their order.
series = defaultdict(list)
names = defaultdict(list)
for frame in frames:
    for signal, cell in frame.get("signals", {}).items():
        series[frame["message"], signal].append(cell["value"])
        names[frame["message"], signal].append(cell.get("name"))
rows = sum(map(len, series.values()))
sums = {key: math.fsum(values) for key, values in series.items()}


def alike(what, ours, theirs=sums):
    assert set(ours) == set(theirs), (what, set(ours) ^ set(theirs))
    for key, value in theirs.items():
        assert math.isclose(ours[key], value, rel_tol=1e-9, abs_tol=1e-9), (what, key, ours[key], value)


def nanoseconds(text):
    seconds, fraction = str(text).split(".")
    return int(seconds) * 10**9 + int(fraction.ljust(9, "0"))


# JSON numbers are floats here, and the text has every digit.
times = [nanoseconds(line.split(":", 1)[1].split(",", 1)[0]) for line in open(folder / "run.jsonl")]
con = duckdb.connect()
query = lambda text: con.execute(text).fetchall()


def signals():
    """A row for each signal, in Parquet."""
    file = f"{folder}/run.parquet"
    types = {name: kind for name, kind, *_ in query(f"DESCRIBE SELECT * FROM '{file}'")}
    assert types == {
        "time": "TIMESTAMP_NS", "interface": "VARCHAR", "id": "VARCHAR", "kind": "VARCHAR", "message": "VARCHAR",
        "signal": "VARCHAR", "value": "DOUBLE", "exact": "DECIMAL(38,0)", "name": "VARCHAR", "unit": "VARCHAR",
        "data": "BLOB",
    }, types  # fmt: skip
    assert query(f"SELECT count(*), count(signal), count(value) FROM '{file}'") == [(rows, rows, rows)]
    assert query(f"SELECT min(epoch_ns(time)), max(epoch_ns(time)) FROM '{file}'") == [(min(times), max(times))]
    found = query(f"SELECT message, signal, sum(value) FROM '{file}' GROUP BY ALL")
    alike("DuckDB", {(message, signal): value for message, signal, value in found})
    named = sum(name is not None for cells in names.values() for name in cells)
    assert query(f"SELECT count(name) FROM '{file}'") == [(named,)]

    table = pandas.read_parquet(file, engine="pyarrow")
    assert len(table) == rows and table["time"].dtype == "datetime64[ns]" and table["value"].dtype == "float64"
    alike("pandas", table.groupby(["message", "signal"])["value"].sum().to_dict())
    assert table["time"].astype("int64").min() == min(times)

    table = polars.read_parquet(file)
    assert table.height == rows and table.schema["time"] == polars.Datetime("ns") and table.schema["value"] == polars.Float64
    found = table.group_by("message", "signal").agg(polars.col("value").sum()).rows()
    alike("polars", {(message, signal): value for message, signal, value in found})


def of_frames():
    """A row for each frame, in Parquet."""
    file = f"{folder}/frames.parquet"
    expected = [(at, frame["id"], frame.get("message"), bytes.fromhex(frame["data"])) for at, frame in zip(times, frames)]
    assert query(f"SELECT epoch_ns(time), id, message, data FROM '{file}'") == expected
    assert query(f"SELECT DISTINCT interface, kind, extended FROM '{file}'") == [("vcan0", "CAN", False)]
    table = pandas.read_parquet(file, engine="pyarrow")
    assert list(zip(table["time"].astype("int64"), table["id"], table["message"], table["data"])) == expected
    table = polars.read_parquet(file).select(polars.col("time").cast(polars.Int64), "id", "message", "data")
    assert table.rows() == expected


def messages():
    """A file for each message."""
    files = {file.stem: str(file) for file in (folder / "run").iterdir()}
    assert set(files) == {message for message, _ in series}
    for (message, signal), values in series.items():
        file = files[message]
        name = f"{signal}_name" if any(names[message, signal]) else "NULL"
        found = query(f"SELECT {signal}, {name} FROM '{file}'")
        assert found == list(zip(values, names[message, signal])), (message, signal)
        assert pandas.read_parquet(file, engine="pyarrow")[signal].tolist() == values, (message, signal)
        assert polars.read_parquet(file)[signal].to_list() == values, (message, signal)
    status = pandas.read_parquet(files["VCU2AI_Status"], engine="pyarrow").dtypes
    assert (status["GO_SIGNAL"], status["AS_STATE"]) == ("bool", "int64")


def csv():
    """CSV, as the help says that it is read."""
    file = str(folder / "run.csv")
    read = f"read_csv('{file}', types={{'id': 'VARCHAR'}})"
    types = {name: kind for name, kind, *_ in query(f"DESCRIBE SELECT * FROM {read}")}
    assert (types["time_s"], types["id"], types["value"]) == ("DOUBLE", "VARCHAR", "DOUBLE"), types
    assert query(f"SELECT count(*) FROM {read} WHERE id IS NOT NULL") == [(rows,)]
    alike("CSV in DuckDB", {(m, s): v for m, s, v in query(f"SELECT message, signal, sum(value) FROM {read} GROUP BY ALL")})
    table = pandas.read_csv(file, dtype={"id": str})
    assert (table["time_s"].dtype, table["value"].dtype) == ("float64", "float64") and set(table["id"]) == {f["id"] for f in frames}
    alike("CSV in pandas", table.groupby(["message", "signal"])["value"].sum().to_dict())
    # What the help warns of.
    assert pandas.read_csv(file)["id"].dtype == "int64"


def vcd():
    """Waves: x before a signal comes, and each of its values behind that."""
    scope, codes, changes = [], {}, defaultdict(list)
    with open(folder / "run.vcd", "rb") as file:
        for token in tokenize(file):
            if token.kind is TokenKind.SCOPE:
                scope.append(token.scope.ident)
            elif token.kind is TokenKind.UPSCOPE:
                scope.pop()
            elif token.kind is TokenKind.VAR:
                codes[tuple(scope), token.var.reference] = (token.var.id_code, token.var.size)
            elif token.kind is TokenKind.CHANGE_SCALAR:
                changes[token.scalar_change.id_code].append(token.scalar_change.value)
            elif token.kind is TokenKind.CHANGE_VECTOR:
                changes[token.vector_change.id_code].append(token.vector_change.value)
            elif token.kind is TokenKind.CHANGE_REAL:
                changes[token.real_change.id_code].append(token.real_change.value)
            elif token.kind is TokenKind.CHANGE_STRING:
                changes[token.string_change.id_code].append(token.string_change.value)
    for (message, signal), values in series.items():
        code, size = codes[(message,), signal]
        first, *found = changes[code]
        unknown = math.isnan(first) if isinstance(first, float) else set(first) == {"x"} and len(first) in (1, size)
        assert unknown, (message, signal, first)
        expected = [value for value, before in zip(values, [None, *values]) if value != before]
        # Wires have the bits of a number with a sign as those of one without.
        found = [float(value) for value in found]
        wraps = [value + 2**size if value < 0 and not isinstance(first, float) else value for value in expected]
        assert found == wraps, (message, signal, found[:5], wraps[:5])
    # The state is written again where what blocks its arrows changes.
    states = names["VCU2AI_Status", "AS_STATE"]
    found = [state for state in changes[codes[("state",), "AS_STATE"][0]] if state != "unknown"]
    once = lambda states: [state for state, before in zip(states, [None, *states]) if state != before]
    assert once(found) == once(states), (once(found), once(states))


def documented():
    """What the document shows runs, and prints something for each."""
    section = document.read_text().split("\n## What `decode` writes")[1]
    code = section.split("```python\n")[1].split("\n```")[0]
    os.chdir(folder)
    with redirect_stdout(io.StringIO()) as printed:
        exec(code, {})
    assert printed.getvalue().count("AS_OFF") >= 2 and "STEER_REQUEST" in printed.getvalue(), printed.getvalue()


for check in (signals, of_frames, messages, csv, vcd, documented):
    check()
print(f"{rows} rows are alike")
