"""Judge, which judges a live bus."""

import re

import adsdv
import pytest
import written

OFF, READY = bytes.fromhex("0000010000000000"), bytes.fromhex("0000020000000000")


def frames(log):
    """The frames of a log, read without adsdv."""
    for line in log:
        time, id, data = re.fullmatch(r"\((\d+\.\d+)\) \S+ ([0-9A-F]{3})#((?:[0-9A-F]{2})*)", line).groups()
        yield float(time), int(id, 16), bytes.fromhex(data)


@pytest.mark.parametrize("edition", adsdv.editions())
def test_a_log_frame_by_frame_is_judged_as_a_whole(any_log, edition):
    judge = adsdv.Judge(edition=edition)
    assert judge.edition == edition
    for time, id, data in frames(any_log.read_text().splitlines()):
        judge.frame(time, id, data)
    responses = judge.handshake_response_ms
    live, report = judge.finish(), adsdv.check(any_log, edition=edition)
    assert responses == live.handshake_response_ms

    def events(report):
        return [
            [{**one, "t": round(one["t"], 5)} for one in list_of] for list_of in (report.transitions, report.findings)
        ]

    assert (live.frames, live.verdict, events(live)) == (report.frames, report.verdict, events(report))


def test_news_come_once(any_log):
    judge, told = adsdv.Judge(), ([], [])
    default = adsdv.INTERFACE_VERSION
    for count, frame in enumerate(frames(any_log.read_text().splitlines())):
        judge.frame(*frame)
        if count % 100 == 0:
            for all, news in zip(told, judge.news()):
                all.extend(news)
    rest, report = judge.finish(), adsdv.check(any_log, edition=default)
    assert (rest.edition, rest.recognised) == (default, None)
    assert len(told[0]) + len(rest.transitions) == len(report.transitions)
    assert len(told[1]) + len(rest.findings) == len(report.findings)


@pytest.mark.parametrize("log, conforms, violates", written.DECIDED)
def test_options_reach_the_judge(log, conforms, violates):
    def verdict(options):
        judge = adsdv.Judge(**options)
        for frame in frames(log):
            judge.frame(*frame)
        return judge.finish().verdict

    assert (verdict(conforms), verdict(violates)) == ("conforms", "violates")


def test_readings_are_those_of_the_edition():
    with pytest.raises(adsdv.InputError, match="^\"fault-trigger\" is 'edge'; expected in edition 4.0 level$"):
        adsdv.Judge(readings={"fault-trigger": "edge"}, edition="4.0")
    with pytest.raises(adsdv.InputError, match="^\"edition\" is '2.9'; expected one of \"3.0\", "):
        adsdv.Judge(edition="2.9")


def test_the_state_is_that_which_was_seen_last():
    judge = adsdv.Judge()
    assert judge.state is None
    judge.frame(5, 0x520, OFF)
    assert judge.state == "AS_OFF"
    judge.frame(5.01, 0x520, READY)
    assert (judge.state, repr(judge)) == ("AS_READY", "<adsdv.Judge: AS_READY>")
    report = judge.finish()
    assert [(one["t"], one["to"]) for one in report.transitions] == [(0.01, "AS_READY")]
    assert judge.state is None and repr(judge) == "<adsdv.Judge: finished>"


def test_a_judge_that_has_finished_is_of_no_more_use():
    judge = adsdv.Judge()
    judge.finish()
    for use in [judge.finish, judge.news, lambda: judge.frame(1, 0x520, OFF), lambda: judge.handshake_response_ms]:
        with pytest.raises(adsdv.InputError, match=r"^this judge has finished; expected a new one: adsdv\.Judge\(\)$"):
            use()


@pytest.mark.parametrize("time", [float("nan"), float("inf"), -0.001, 1e300, None, "1", 9223372037])
def test_times_are_seconds(time):
    with pytest.raises(adsdv.InputError, match='^"time" is .*; expected seconds, from 0 to 9223372036$'):
        adsdv.Judge().frame(time, 0x520, OFF)


def test_identifiers_have_11_bits_and_data_is_bytes():
    judge = adsdv.Judge()
    for id in [-1, 0x800, 2**40, "520", None, True]:
        with pytest.raises(adsdv.InputError, match='^"id" is .*; expected a whole number from 0 to 2047$'):
            judge.frame(1, id, OFF)
    with pytest.raises(adsdv.InputError, match='^"data" is '):
        judge.frame(1, 0x520, "00")
    judge.frame(1, 0x520, bytearray(OFF))
    assert judge.finish().frames == 1


def test_time_may_jump():
    judge = adsdv.Judge()
    for time in [9223372036, 0, 9223372036, 0.5, 1e9]:
        judge.frame(time, 0x520, OFF)
        judge.frame(time, 0x510, bytes(8))
    assert judge.finish().frames == 10
