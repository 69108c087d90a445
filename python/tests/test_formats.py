"""Recordings in other formats than that of candump -L, and what is around them."""

import gzip
from pathlib import Path

import adsdv
import pytest

ROOT = Path(__file__).resolve().parents[2]
MISSION = ROOT / "tests" / "logs" / "mission.log"
SAMPLES = ROOT / "formats" / "tests" / "samples"


def test_a_compressed_log_is_judged_like_the_log(tmp_path):
    packed = tmp_path / "run"
    packed.write_bytes(gzip.compress(MISSION.read_bytes()))
    expected = adsdv.check(MISSION)
    assert adsdv.check(packed) == expected
    assert adsdv.check(packed.read_bytes()) == expected


@pytest.mark.parametrize("sample", sorted(SAMPLES.iterdir()), ids=lambda sample: sample.name)
def test_every_format_is_read(sample):
    assert adsdv.check(sample).frames > 3


def test_a_compressed_log_that_was_cut_off_is_no_verdict(tmp_path):
    packed = gzip.compress(MISSION.read_bytes())
    with pytest.raises(OSError, match="cannot read on after line"):
        adsdv.check(packed[: len(packed) // 2])


def test_a_file_that_is_known_and_not_read_says_what_it_is():
    with pytest.raises(adsdv.LogError, match="SQLite database.*read it with Python"):
        adsdv.check(b"SQLite format 3\0")


def test_the_frames_of_another_reader_are_lines():
    text = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
    code = text.split("```python\n")[1].split("```")[0]
    names = {}
    exec(code.replace("import can ", "# ").rsplit("\n\n\nprint", 1)[0], names)

    class Message:
        is_extended_id = is_remote_frame = is_error_frame = is_fd = False
        timestamp, arbitration_id, data = 1.5, 0x520, bytes([0, 0, 1, 0, 0, 0, 0, 0])

    assert list(names["lines"]([Message()])) == ["(1.500000) can0 520#0000010000000000"]
    assert adsdv.check(names["lines"]([Message()])).frames == 1
