"""A program with types, for mypy --strict: what is right passes, and every `type: ignore` is needed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import adsdv


def ready(machine: adsdv.Machine) -> adsdv.Control:
    step: adsdv.Step = machine.step(adsdv.Control(state="AS_OFF"), {"asms": True}, 10, tsms=True, ami="TRACK_DRIVE")
    torque: int = step.outputs["front_axle_trq"]
    steer: int | None = step.outputs["steer"]
    if steer is None or torque == 0:
        return step.control
    return adsdv.Control(in_state_ms=torque)


def findings(log: Path) -> list[str]:
    report = adsdv.check(log, readings={"fault-trigger": "edge"}, window_ms=30)
    first: float = report.transitions[0]["t"]
    return [f"{first} {finding['rule']}" for finding in report.violations]


def season(logs: list[Path]) -> dict[str, list[str]]:
    reports = adsdv.check_many("logs", progress=lambda done, total, read, size: print(done / total), threads=2)
    reports = adsdv.check_many(logs) if reports.errors else reports
    first: adsdv.Report = reports[0]
    rest: tuple[adsdv.Report, ...] = reports[1:]
    worst: str = reports.worst_first[0]
    assert len(reports) == len(rest) + 1 and worst and len(reports.logs.columns()["path"])
    return {path: [finding["rule"] for finding in report.findings] for path, report in zip(reports.paths, [first, *rest])}


def live(frames: list[tuple[float, int, bytes]]) -> adsdv.Report:
    judge = adsdv.Judge()
    for time, id, data in frames:
        judge.frame(time, id, data)
    return judge.finish()


def codec() -> tuple[int, bytes]:
    message = adsdv.decode(*adsdv.encode("AI2VCU_Steer", STEER_REQUEST_deg=-10.0))
    angle: float = message["signals"]["STEER_REQUEST_deg"]
    return adsdv.encode(0x513, STEER_REQUEST_deg=angle)


def many(machine: adsdv.Machine) -> adsdv.Control:
    inputs, controls = adsdv.rows("inputs", 100, machine.edition), adsdv.rows("control", 100, machine.edition)
    machine.step_each(controls, memoryview(inputs), dt_ms=10, outputs=adsdv.rows("outputs", 100, machine.edition))
    armed: int = adsdv.numbers("inputs", "ebs")["ARMED"]
    first: tuple[str, str] = adsdv.dtype("inputs")[0]
    assert armed and first
    return machine.step_n(adsdv.Control(), inputs, controls=controls)


def editions() -> list[bool]:
    newer = adsdv.Vcu(edition="4.0").step(ami="TRACK DRIVE", brake_silence_ms=100).outputs
    fault: bool = newer.get("brake_plausibility_fault", False)
    return [fault, *(adsdv.is_reserved(0x120, edition) for edition in adsdv.editions())]


class Stack:
    def step(self, t_ms: int, frames: list[tuple[int, bytes]]) -> list[tuple[int, bytes]]:
        return [(id, data) for id, data in frames if t_ms > 0]


def silent() -> Callable[[int, list[tuple[int, bytes]]], list[tuple[int, bytes]]]:
    return lambda t_ms, frames: []


def exam() -> list[str]:
    report = adsdv.exam(Stack, edition="4.0", only=["ready"], logs=Path("logs"))
    report = adsdv.exam(silent, quick=True, mission_time=30, logs=True) if report.passes else report
    report = adsdv.exam(["python3", Path("stack.py")], runs=7, timeout=0.5)
    lasted: float = report.scenarios[0]["duration"]
    found = [f"{lasted} {finding['seen']} {finding.get('trace')}" for finding in report.findings]
    return [*found, report.explain("RDY-7"), *(one["why"] or one["id"] for one in report.failed)]


vcu = adsdv.Vcu()
vcu.control = ready(vcu.machine)
vcu.step(asms="on")  # type: ignore[arg-type]
vcu.step(ami="TRACK-DRIVE")  # type: ignore[arg-type]
vcu.step(asm=True)  # type: ignore[call-arg]
vcu.step().outputs["as_stat"]  # type: ignore[typeddict-item]
vcu.state = "AS_OFF"  # type: ignore[misc]
adsdv.Control(state="OFF")  # type: ignore[arg-type]
adsdv.check_many(5)  # type: ignore[arg-type]
adsdv.check_many("logs", progress=lambda done: None)  # type: ignore[arg-type,misc]
adsdv.check(5)  # type: ignore[arg-type]
adsdv.Vcu(edition=4.0)  # type: ignore[arg-type]
adsdv.encode(1.5)  # type: ignore[arg-type]
adsdv.rows("input", 1)  # type: ignore[arg-type]
vcu.machine.step_n(adsdv.Control(), 5)  # type: ignore[arg-type]
adsdv.exam(Stack())  # type: ignore[arg-type]
adsdv.exam(lambda: 5)  # type: ignore[arg-type]
