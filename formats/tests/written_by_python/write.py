"""Writes the same frames as BLF and MCAP in several variants, and what they are as JSON lines: write.py FOLDER [COUNT]."""
import json, struct, sys
from pathlib import Path

import can
from can.io.blf import BLFWriter
from mcap.writer import CompressionType, IndexType, Writer

folder, count = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 300
BEGIN = 1_790_000_000


def frames():
    for n in range(count):
        sort, time_ns = n % 7, BEGIN * 10**9 + n * 1_250_000
        frame = dict(time_ns=time_ns, channel=n % 3, kind="standard", extended=False, id=0x500 + n % 64,
                     data=bytes((n + k) % 256 for k in range(n % 9)).hex(), tx=n % 2 == 1, len=0, flags=0)
        if sort == 1:
            frame.update(kind="extended", extended=True, id=0x18FF0000 + n % 65536)
        elif sort == 2:
            frame.update(kind="remote", data="", len=n % 9, extended=n % 4 == 0)
        elif sort == 3:
            frame.update(kind="error", id=n % 128, data=bytes(8).hex(), extended=True)
        elif sort == 4:
            size = [0, 8, 12, 16, 20, 24, 32, 48, 64][n % 9]
            frame.update(kind="fd", data=bytes((3 * n + k) % 256 for k in range(size)).hex(), flags=n % 4, extended=n % 5 == 0)
        yield frame


FRAMES = list(frames())
with open(folder / "frames.jsonl", "w") as out:
    for frame in FRAMES:
        print(json.dumps(frame), file=out)

for level in (-1, 0, 1, 9):
    with BLFWriter(str(folder / f"level{level}.blf"), compression_level=level, max_container_size=1000 if count < 10_000 else 131072) as writer:
        for f in FRAMES:
            writer.on_message_received(can.Message(
                timestamp=f["time_ns"] / 1e9, arbitration_id=f["id"], is_extended_id=f["extended"], channel=f["channel"],
                is_remote_frame=f["kind"] == "remote", is_error_frame=f["kind"] == "error", is_fd=f["kind"] == "fd",
                bitrate_switch=bool(f["flags"] & 1), error_state_indicator=bool(f["flags"] & 2), is_rx=not f["tx"],
                dlc=f["len"] if f["kind"] == "remote" else len(f["data"]) // 2, data=None if f["kind"] == "remote" else bytes.fromhex(f["data"])))

HEADER = "std_msgs/Header header\nuint32 id\n"
FRAME = HEADER + "bool is_rtr\nbool is_extended\nbool is_error\nuint8 dlc\nuint8[8] data\n"
FD = HEADER + "bool is_extended\nbool is_error\nuint8 len\nuint8[<=64] data\n"
OTHERS = f"{'=' * 80}\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
OTHERS += f"{'=' * 80}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"


def message(f, ros1, big):
    end, data = ">" if big else "<", bytes.fromhex(f["data"])
    seconds, nanos = divmod(f["time_ns"], 10**9)
    if ros1:
        head = struct.pack("<IIII", 7, seconds, nanos, 3) + b"can"
    else:
        head = struct.pack(end + "IIII", seconds, nanos, 4, 0)[:12] + b"can\0"
    head += struct.pack(end + "I", f["id"])
    if f["kind"] == "fd":
        body = bytes([f["extended"], 0, len(data)])
        body += bytes() if ros1 else bytes(-(len(head) + len(body)) % 4)
        body += struct.pack(end + "I", len(data)) + data
    else:
        body = bytes([f["kind"] == "remote", f["extended"], f["kind"] == "error", f["len"] or len(data)]) + data.ljust(8, b"\0")
    return head + body if ros1 else bytes([0, not big, 0, 0]) + head + body


def mcap(name, ros1=False, big=False, bare=False, **options):
    with open(folder / f"{name}.mcap", "wb") as out:
        writer = Writer(out, chunk_size=4000 if count < 10_000 else 1 << 20, **options)
        writer.start(profile="ros1" if ros1 else "ros2")
        encoding, part = ("ros1", "/") if ros1 else ("cdr", "/msg/")
        scan = writer.register_schema(f"sensor_msgs{part}LaserScan", "ros2msg", b"float32[] ranges\n")
        other = writer.register_channel("/scan", encoding, scan)
        schemas = {fd: writer.register_schema(f"ros2_socketcan_msgs{part}FdFrame" if fd else f"can_msgs{part}Frame", encoding.replace("cdr", "ros2") + "msg",
                                              b"" if bare else ((FD if fd else FRAME) + ("" if ros1 else OTHERS)).encode()) for fd in (False, True)}
        channels = {}
        for f in FRAMES:
            key = (f["channel"], f["tx"], f["kind"] == "fd")
            if key not in channels:
                topic = f"/can{key[0]}/{'to' if key[1] else 'from'}_can_bus{'_fd' if key[2] else ''}"
                channels[key] = writer.register_channel(topic, encoding, schemas[key[2]])
            writer.add_message(channels[key], f["time_ns"] + 50_000, message(f, ros1, big), f["time_ns"])
            if f["id"] % 16 == 0 and count < 10_000:
                writer.add_message(other, f["time_ns"], bytes(100), f["time_ns"])
        writer.finish()


mcap("zstd", compression=CompressionType.ZSTD)
mcap("lz4", compression=CompressionType.LZ4)
mcap("none", compression=CompressionType.NONE, big=True)
mcap("ros1", ros1=True, compression=CompressionType.LZ4)
mcap("bare", bare=True, compression=CompressionType.ZSTD, index_types=IndexType.NONE, use_statistics=False, repeat_channels=False, repeat_schemas=False, use_summary_offsets=False)
mcap("unchunked", use_chunking=False)
