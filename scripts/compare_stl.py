"""One property of a recorded run, by `adsdv check --rules` and by RTAMT, a monitor of signal temporal logic.

usage: python scripts/compare_stl.py [LOG...]

The property: once MISSION_STATUS is FINISHED, AS_STATE is AS_FINISHED within 100 ms. RTAMT gets what `adsdv decode` makes of the log,
sampled every 10 ms; what that takes is not counted. Of adsdv all of `check` is counted, which reads the log and judges the document as well.

Needs RTAMT (pip install rtamt). ADSDV names the program; without it, target/release/adsdv.
Exit status: 0 both say the same of each log, 1 they do not, 2 something is missing.
"""

import csv
import io
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

RULE = "finished: after MISSION_STATUS is FINISHED, AS_STATE is AS_FINISHED within 100 ms\n"
STEP_S = 0.01
RUNS = 5
LOGS = ["tests/logs/mission.log", "tests/logs/finished-while-moving.log"]
# The signals of the property, and the raw values that it asks about.
MISSION_STATUS, FINISHED = "MISSION_STATUS", 3
AS_STATE, AS_FINISHED = "AS_STATE", 5


def sampled(adsdv: str, log: str) -> dict[str, list[float]]:
    """The signals of the property as they stand at each step."""
    text = subprocess.run([adsdv, "decode", "--format", "csv", log], capture_output=True, check=True, text=True).stdout
    steps: list[tuple[float, float, float]] = []
    held = {MISSION_STATUS: 0.0, AS_STATE: 0.0}
    begin = following = None
    for row in csv.DictReader(io.StringIO(text)):
        now = float(row["time_s"])
        if begin is None:
            begin = following = now
        while now >= following:
            steps.append((following - begin, held[MISSION_STATUS], held[AS_STATE]))
            following += STEP_S
        if row["signal"] in held and row["message"] in ("VCU2AI_Status", "AI2VCU_Status"):
            held[row["signal"]] = float(row["value"])
    return {
        "time": list(range(len(steps))),
        "mission": [mission for _, mission, _ in steps],
        "state": [state for _, _, state in steps],
    }


def by_rtamt(signals: dict[str, list[float]]) -> tuple[bool, float]:
    """Whether the property holds, and the least time that it took."""
    import rtamt

    best = float("inf")
    for _ in range(RUNS):
        monitor = rtamt.StlDiscreteTimeSpecification()
        monitor.declare_var("mission", "float")
        monitor.declare_var("state", "float")
        monitor.set_sampling_period(10, "ms", 0.1)
        bound = f"mission > {FINISHED - 0.5}", f"state > {AS_FINISHED - 0.5} and state < {AS_FINISHED + 0.5}"
        monitor.spec = f"always((rise({bound[0]})) implies (eventually[0:10]({bound[1]})))"
        begun = time.process_time()
        monitor.parse()
        robustness = monitor.evaluate(signals)
        best = min(best, time.process_time() - begun)
    return robustness[0][1] >= 0, best


def by_adsdv(adsdv: str, log: str, rules: str) -> tuple[bool, float]:
    """Whether the rule holds, and the least time that judging all of the log took."""
    best = float("inf")
    for _ in range(RUNS):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run = subprocess.run([adsdv, "check", "--json", "--rules", rules, log], capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        best = min(best, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    (rule,) = json.loads(run.stdout)["rules"]
    return rule["verdict"] == "holds", best


def main() -> int:
    adsdv = os.environ.get("ADSDV", "target/release/adsdv")
    try:
        import rtamt  # noqa: F401
    except ImportError:
        print("compare_stl: RTAMT is not installed; try: pip install rtamt", file=sys.stderr)
        return 2
    same = True
    with tempfile.NamedTemporaryFile("w", suffix=".rules") as rules:
        rules.write(RULE)
        rules.flush()
        for log in sys.argv[1:] or LOGS:
            signals = sampled(adsdv, log)
            ours, ours_s = by_adsdv(adsdv, log, rules.name)
            theirs, theirs_s = by_rtamt(signals)
            same &= ours == theirs
            print(f"{log}: {len(signals['time'])} samples")
            print(f"  adsdv check --rules  {'holds ' if ours else 'broken'}  {ours_s * 1000:7.1f} ms, with reading the log and judging the document")
            print(f"  RTAMT                {'holds ' if theirs else 'broken'}  {theirs_s * 1000:7.1f} ms, for the property alone")
            print(f"  adsdv takes {ours_s / theirs_s:.2f} of the time")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
