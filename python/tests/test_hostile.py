"""Whatever is given, an error is an Exception with a message: never a panic, which is none."""

import io
import random

import adsdv
import pytest


class Endless(list):
    """A list that says it is longer than any memory."""

    def __len__(self):
        return 2**62


THINGS = [
    None, True, False, 0, 1, -1, 7, 0x513, 0x520, 0x7FF, 0x800, 2**31, 2**32, 2**63, 2**64, -(2**70), 0.0, 1.5, 1e308,
    float("nan"), float("inf"), "", "a", "AS_OFF", "AI2VCU_Steer", "4.0", "\0", "\ud800", "x" * 10_000, b"", b"\xff", bytes(8),
    bytes(9), bytearray(8), memoryview(b"12345678"), [], [0], [256], [-1], ["(1.0) can0 520#00"], (), {}, {"a": 1},
    {"asms": True}, {"state": "AS_READY"}, {1: 2}, {"fault-trigger": "edge"}, {"fault-trigger": None}, set(), object(),
    object, len, range(3), range(10**18), range(0, 2**62, 2**54), Endless([1, 2]), iter([b"x"]), adsdv.Control(), adsdv.Machine(), adsdv.Vcu().step(), Exception("x"),
]  # fmt: skip

CALLS = [
    lambda a, b, c: adsdv.Control(a, state=b),
    lambda a, b, c: adsdv.Control(in_state_ms=a, handshake_unanswered_ms=b, shutdown_cause=c),
    lambda a, b, c: adsdv.Machine(a),
    lambda a, b, c: adsdv.Machine().step(adsdv.Control(), a, b),
    lambda a, b, c: adsdv.Machine().step(a, b, c),
    lambda a, b, c: adsdv.Vcu().step(dt_ms=a, asms=b, steer_angle=c),
    lambda a, b, c: adsdv.Vcu().step(ami=a, mission_status=b, handshake=c),
    lambda a, b, c: adsdv.Vcu().receive(a, b),
    lambda a, b, c: setattr(adsdv.Vcu(), "control", a),
    lambda a, b, c: adsdv.decode(a, b),
    lambda a, b, c: adsdv.encode(a, STEER_REQUEST_deg=b),
    lambda a, b, c: adsdv.encode(0x520, AS_STATE=a, HANDSHAKE=b, SHUTDOWN_CAUSE=c),
    lambda a, b, c: adsdv.frames(a),
    lambda a, b, c: adsdv.is_reserved(a),
    lambda a, b, c: adsdv.check(a if a != "a" else b, window_ms=b, interface=c),
    lambda a, b, c: adsdv.check([a, b, c]),
    lambda a, b, c: adsdv.check(b"(1.0) can0 520#00", readings=a, deadline_ms=b, interface=c),
    lambda a, b, c: adsdv.Judge(readings=a, window_ms=b, deadline_ms=c),
    lambda a, b, c: adsdv.Judge().frame(a, b, c),
    lambda a, b, c: adsdv.Report(a),
    lambda a, b, c: adsdv.Vcu(a, b),
    lambda a, b, c: adsdv.Judge(readings=a, edition=b),
    lambda a, b, c: adsdv.decode(a, b, c),
    lambda a, b, c: adsdv.encode(a, edition=b, STEER_REQUEST_deg=c),
    lambda a, b, c: adsdv.check(b"(1.0) can0 520#00", edition=a, readings=b),
    lambda a, b, c: adsdv.exam(a, only="ready", shrink=0, edition=b, timeout=c),
    lambda a, b, c: adsdv.exam(lambda: lambda t_ms, frames: a, only="ready", shrink=b, logs=c if c is True else None),
    lambda a, b, c: adsdv.exam(lambda: lambda t_ms, frames: [(a, b), c], scenario="0.05 end", shrink=0, seed=a, mission_time=b),
    lambda a, b, c: adsdv.exam(lambda: a, only=b, quick=True, scenario=c, shrink=0),
    lambda a, b, c: adsdv.exam(lambda: a, scenario="0.05 end", shrink=0).requirement(b) and adsdv.exam_requirements(c),
    lambda a, b, c: adsdv.ExamReport(a, b, c),
    lambda a, b, c: adsdv.readings(a) and adsdv.inputs(b) and adsdv.messages(c),
]


@pytest.mark.parametrize("call", range(len(CALLS)))
def test_anything_may_be_given(call):
    rng = random.Random(call)
    cases = [(thing, thing, thing) for thing in THINGS] + [rng.choices(THINGS, k=3) for _ in range(2000)]
    refused = 0
    for case in cases:
        try:
            CALLS[call](*case)
        except (ValueError, TypeError, OSError) as error:
            assert str(error)
            refused += 1
    assert refused


def test_any_log_may_be_given():
    rng = random.Random(5)
    line = b"(1795209995.234358) vcan0 520#0000010000000000\n"
    for _ in range(2000):
        log = bytearray(line * rng.randint(1, 4))
        for _ in range(rng.randint(0, 6)):
            log[rng.randrange(len(log))] = rng.randrange(256)
        try:
            report = adsdv.check(log)
        except adsdv.LogError as error:
            assert str(error)
        else:
            assert report.frames > 0
            # Whether a single line without an end is cut off, lines do not tell.
            assert b"\n" not in log or report == adsdv.check(io.BytesIO(log))


def test_any_frame_may_come():
    rng = random.Random(6)
    judge, vcu, ids = adsdv.Judge(), adsdv.Vcu(), [signal["id"] for signal in adsdv.messages()]
    for _ in range(20_000):
        frame = rng.choice(ids), rng.randbytes(rng.randint(0, 10))
        judge.frame(rng.uniform(0, 100), *frame)
        try:
            adsdv.decode(*frame)
            vcu.receive(*frame)
        except adsdv.CodecError as error:
            assert str(error)
        vcu.step(dt_ms=rng.randrange(10**6))
    assert judge.finish().frames == 20_000


class Meddler:
    """A number that does something when it is read."""

    def __init__(self, number, meddle):
        self.number, self.meddle = number, meddle

    def __index__(self):
        self.meddle()
        return self.number

    def __float__(self):
        return float(self.__index__())


def test_arguments_may_meddle():
    vcu, judge = adsdv.Vcu(), adsdv.Judge()
    inputs = {}
    inputs.update(steer_angle=Meddler(5, lambda: inputs.update({f"k{len(inputs)}": 1})), go=True)
    assert vcu.step(inputs).outputs["as_state"] == "AS_OFF"
    vcu.step(steer_angle=Meddler(5, lambda: vcu.step(asms=True)))
    judge.frame(Meddler(1, lambda: judge.frame(0, 0x520, bytes(8))), 0x520, bytes(8))
    with pytest.raises(adsdv.InputError, match="this judge has finished"):
        judge.frame(2, Meddler(0x520, judge.finish), bytes(8))


def test_reports_may_lie_about_their_length():
    whole = adsdv.check(["(1.0) can0 520#0000010000000000"]).to_dict()
    report = adsdv.Report({**whole, "findings": Endless(whole["findings"])})
    assert report.violations == [] and "2 notes" in repr(report)


def test_things_that_cannot_be_printed_are_named():
    class Unprintable:
        def __repr__(self):
            raise RuntimeError("no")

    with pytest.raises(adsdv.InputError, match='^"asms" is an object of type Unprintable; expected true or false$'):
        adsdv.Vcu().step(asms=Unprintable())
    with pytest.raises(adsdv.InputError, match=r'^"asms" is \'x{59}\.\.\.; expected true or false$'):
        adsdv.Vcu().step(asms="x" * 1000)
