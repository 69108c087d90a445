"""What scripts/compare-decode.sh measures with: writes recordings, reads them with other programs' readers, and takes times.

    compare_decode.py write FOLDER LOG COPIES   the log, repeated, in every format; prints how many frames each has
    compare_decode.py read FILE                 reads it with python-can, or the reader of MCAP; prints its seconds of processor time
    compare_decode.py dump DBC LOG              what `cantools decode` does with a log of candump
    compare_decode.py time RUNS COMMAND         a command of the shell; prints its least seconds of processor time, and of the clock
"""

import os
import resource
import subprocess
import sys
import time
from pathlib import Path

GAP_S = 2


def write(folder, log, copies):
    """The same frames as every tool writes them."""
    import can
    from can.io.blf import BLFWriter
    from mcap.writer import CompressionType, Writer

    frames = list(can.CanutilsLogReader(log))
    length = frames[-1].timestamp - frames[0].timestamp + GAP_S
    writers = [
        can.ASCWriter(folder / "run.asc"),
        BLFWriter(folder / "run.blf"),
        can.TRCWriter(folder / "run.trc"),
        can.CSVWriter(folder / "run.csv"),
        can.CanutilsLogWriter(folder / "run.log"),
    ]
    for copy in range(copies):
        for frame in frames:
            moved = can.Message(
                timestamp=frame.timestamp + copy * length,
                arbitration_id=frame.arbitration_id,
                is_extended_id=False,
                data=frame.data,
                channel=0,
            )
            for writer in writers:
                writer.on_message_received(moved)
    for writer in writers:
        writer.stop()

    definition = (
        "std_msgs/Header header\nuint32 id\nbool is_rtr\nbool is_extended\nbool is_error\nuint8 dlc\nuint8[8] data\n"
        f"{'=' * 80}\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
        f"{'=' * 80}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
    )
    for name in ("zstd", "lz4", "none"):
        with open(folder / f"run-{name}.mcap", "wb") as file:
            writer = Writer(file, compression=CompressionType[name.upper()])
            writer.start(profile="ros2")
            schema = writer.register_schema("can_msgs/msg/Frame", "ros2msg", definition.encode())
            channel = writer.register_channel("/from_can_bus", "cdr", schema)
            for copy in range(copies):
                for frame in frames:
                    time_ns = round((frame.timestamp + copy * length) * 1e9)
                    seconds, nanos = divmod(time_ns, 10**9)
                    body = b"\0\1\0\0" + seconds.to_bytes(4, "little") + nanos.to_bytes(4, "little")
                    body += b"\4\0\0\0can\0" + frame.arbitration_id.to_bytes(4, "little")
                    body += bytes([0, 0, 0, len(frame.data)]) + bytes(frame.data).ljust(8, b"\0")
                    writer.add_message(channel, time_ns, body, time_ns)
            writer.finish()
    print(len(frames) * copies)


def read(file):
    """Every frame, as a user of the library gets it; the time of importing the library is not counted."""
    if file.suffix == ".mcap":
        from mcap.reader import make_reader
        from mcap_ros2.decoder import DecoderFactory

        begin = time.process_time()
        with open(file, "rb") as source:
            reader = make_reader(source, decoder_factories=[DecoderFactory()])
            count = sum(len(message.data) >= 0 for *_, message in reader.iter_decoded_messages())
    elif file.suffix == ".records":
        from mcap.reader import make_reader

        begin = time.process_time()
        with open(file.with_suffix(".mcap"), "rb") as source:
            count = sum(1 for _ in make_reader(source).iter_messages())
    else:
        import can

        begin = time.process_time()
        with can.LogReader(file) as reader:
            count = sum(len(message.data) >= 0 for message in reader)
    took = time.process_time() - begin
    print(f"{took:.6f} {count}")


def dump(dbc, log):
    """`cantools decode`, in this process, so that neither program's start is counted."""
    import cantools

    sys.argv = ["cantools", "decode", "--single-line", dbc]
    with open(log) as lines, open(os.devnull, "w") as nowhere:
        printed, sys.stdin, sys.stdout = sys.stdout, lines, nowhere
        begin = time.process_time()
        cantools._main()
        took = time.process_time() - begin
        sys.stdout = printed
    print(f"{took:.6f}")


def least(runs, command):
    """The least of several runs; the time of the processor is that of all processes of the command."""
    best = [float("inf")] * 2
    for _ in range(runs):
        before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        shell = ["bash", "-c", f"set -o pipefail; {command}"]
        status = subprocess.run(shell, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
        clock, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
        # 1 says that the log has findings, which a log put together from copies has.
        if status not in (0, 1):
            sys.exit(f"{command!r} ended with {status}")
        processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        best = [min(best[0], processor), min(best[1], clock)]
    print(f"{best[0]:.6f} {best[1]:.6f}")


match sys.argv[1:]:
    case ["write", folder, log, copies]:
        write(Path(folder), log, int(copies))
    case ["read", file]:
        read(Path(file))
    case ["dump", dbc, log]:
        dump(dbc, log)
    case ["time", runs, command]:
        least(int(runs), command)
    case _:
        sys.exit(__doc__)
