"""How much faster many steps in one call are than a loop of single calls: of the same steps, in one run.

    pip install . numpy && python bench_batch.py
"""

import random
import time

import adsdv
import numpy

STEPS = 20_000


def best(work, runs):
    """The least of a few runs: what else the machine does only adds to it."""
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times) / STEPS


def inputs(edition):
    """A mission in which any input changes now and then, as rows and as dicts."""
    chance = random.Random(1)
    rows = numpy.frombuffer(adsdv.rows("inputs", STEPS, edition), adsdv.dtype("inputs", edition))
    rows["asms"] = rows["tsms"] = True
    rows["ebs"] = adsdv.numbers("inputs", "ebs", edition)["ARMED"]
    rows["ami"] = 4
    for field in adsdv.inputs(edition):
        if field["kind"] == "number":
            rows[field["key"]] = [chance.randint(max(field["min"], 0), min(field["max"], 90)) for _ in range(STEPS)]
        elif field["kind"] == "flag":
            rows[field["key"]] ^= [chance.random() < 0.01 for _ in range(STEPS)]
    keys = rows.dtype.names
    return rows, [dict(zip(keys, row)) for row in rows.tolist()]


def main():
    for edition in adsdv.editions():
        rows, dicts = inputs(edition)
        machine, start = adsdv.Machine(edition=edition), adsdv.Control()
        outputs = numpy.zeros(STEPS, adsdv.dtype("outputs", edition))
        controls = numpy.frombuffer(adsdv.rows("control", STEPS, edition), adsdv.dtype("control", edition))

        def loop(show):
            control = start
            for row in dicts:
                step = machine.step(control, row, 10)
                control = step.control
                if show:
                    step.outputs

        single = best(lambda: loop(False), 5)
        for name, of_one, work in [
            ("step_n", single, lambda: machine.step_n(start, rows, 10)),
            ("step_each", single, lambda: machine.step_each(controls, rows, 10)),
            ("step_n with outputs", best(lambda: loop(True), 5), lambda: machine.step_n(start, rows, 10, outputs=outputs)),
        ]:
            many = best(work, 50)
            print(f"{edition}: {name} takes {many * 1e9:.0f} ns a step, a loop of single calls {of_one * 1e9:.0f} ns: "
                  f"{of_one / many:.0f} times")


if __name__ == "__main__":
    main()
