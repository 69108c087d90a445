"""Writes the same frames with every writer of python-can that is compared, and what they are as JSON lines.

    python write.py DIRECTORY

Each file is run.NAME; reference.jsonl has a frame on each line, the times in nanoseconds.
"""

import json
import os
import random
import sys
import time

os.environ["TZ"] = "UTC"
time.tzset()

import can  # noqa: E402  (the time zone counts when it is loaded)
from can.io.trc import TRCFileVersion  # noqa: E402

START_NS = 1_795_209_995_234_358_000


def trc_1_0(path):
    writer = can.TRCWriter(path)
    writer.file_version = TRCFileVersion.V1_0
    return writer


WRITERS = {
    "asc": can.ASCWriter,
    "trc": can.TRCWriter,
    "1-0.trc": trc_1_0,
    "csv": can.CSVWriter,
}


def frames():
    """Frames of every kind, in an order that is the same each time."""
    choose = random.Random(20261125)
    time_ns = START_NS
    for number in range(600):
        # Now and then two at the same time, and now and then nothing for a while.
        time_ns += choose.choice([0, 1_000, 230_000, 10_000_000, 10_000_000, 3_600_000_000_000])
        kind = choose.choice(["data"] * 6 + ["fd", "fd", "remote", "error"]) if number else "data"
        extended = choose.random() < 0.3
        frame = {
            "time_ns": time_ns,
            "kind": kind,
            "extended": extended,
            "id": choose.choice([0, 1, 0x520, 0x7FF] + [0x800, 0x18FF50E5, 0x1FFFFFFF] * extended),
            "channel": choose.choice([0, 0, 0, 1, 10]),
            "rx": choose.random() < 0.7,
            "len": choose.randint(0, 8),
            "data": "",
            "brs": False,
            "esi": False,
        }
        if kind == "fd":
            frame["len"] = choose.choice([0, 1, 8, 12, 16, 20, 24, 32, 48, 64])
            frame["brs"], frame["esi"] = choose.random() < 0.5, choose.random() < 0.5
        if kind == "error":
            frame["extended"], frame["id"], frame["len"] = True, 4, 8
        if kind != "remote":
            frame["data"] = bytes(choose.randrange(256) for _ in range(frame["len"])).hex()
        yield frame


def message(frame):
    return can.Message(
        timestamp=frame["time_ns"] / 1e9,
        arbitration_id=frame["id"],
        is_extended_id=frame["extended"],
        is_remote_frame=frame["kind"] == "remote",
        is_error_frame=frame["kind"] == "error",
        is_fd=frame["kind"] == "fd",
        bitrate_switch=frame["brs"],
        error_state_indicator=frame["esi"],
        is_rx=frame["rx"],
        channel=frame["channel"],
        dlc=frame["len"],
        data=bytes.fromhex(frame["data"]) if frame["kind"] != "remote" else None,
        check=True,
    )


def main(directory):
    all_frames = list(frames())
    with open(os.path.join(directory, "reference.jsonl"), "w", encoding="ascii") as reference:
        for frame in all_frames:
            print(json.dumps(frame), file=reference)
    for name, writer_of in WRITERS.items():
        with writer_of(os.path.join(directory, f"run.{name}")) as writer:
            for frame in all_frames:
                writer.on_message_received(message(frame))


main(sys.argv[1])
