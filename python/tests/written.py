"""Logs that are written for a test, of one frame of 520h every 10 ms."""

ASMS, BOTH = "02", "06"


def status(cycle, state, switches=BOTH):
    """A line of 520h: the number of the state, and the switches that are on."""
    return f"({1 + cycle / 100:.2f}) can0 520#00{switches}0{state}0000000000"


def due():
    """From 0.4 to 0.6 s, AS_READY goes on with the AS master switch off, against section 3.6."""
    return [status(cycle, 2, ASMS if cycle < 40 else "00") for cycle in range(60)]


def late():
    """AS_READY is left for AS_OFF 30 ms after the AS master switch was off for 20 ms."""
    return [status(cycle, 2 if cycle < 44 else 1, "00" if cycle in (40, 41) else ASMS) for cycle in range(60)]


def unselected():
    """AS_READY though no mission is selected but by MISSION_STATUS, as Figure 2 alone allows."""
    lines = []
    for cycle in range(60):
        lines += [f"({1 + cycle / 100:.2f}) can0 510#0010000000000000", status(cycle, 1 if cycle < 40 else 2)]
    return lines


#: Options that decide about a log: the log, options under which it conforms, and options under which it violates.
DECIDED = [
    (due(), {"deadline_ms": 500}, {"deadline_ms": 100}),
    (due(), {"deadline_ms": 500}, {}),
    (late(), {}, {"window_ms": 10}),
    (unselected(), {}, {"readings": {"mission-selected": "both"}}),
    (unselected(), {"readings": {"mission-selected": "status"}}, {"readings": {"mission-selected": "ami"}}),
]
