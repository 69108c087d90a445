#!/usr/bin/env python3
"""A program under test for `adsdv conform`: the protocol of PROTOCOL.md, around the specification itself.

    adsdv conform [--edition 4.0] -- python3 conform/examples/adapter.py [READING=CHOICE ...]

It needs the module adsdv (folder python/ of this project). For a VCU of your own, write a class like `VcuUnderTest`.
"""

import json
import sys

import adsdv


class VcuUnderTest:
    """What is to be judged: here, the reference VCU. Replace the methods by calls of your own."""

    def __init__(self, readings):
        # All is about 3.0 until a hello says otherwise.
        self.readings, self.edition, self.vcu = readings, "3.0", None

    def about(self):
        """What it says of itself before its first answer, as far as it is so: the "inputs" and "outputs" that it has, "cycle_ms" if
        it steps at a fixed cycle, and "clock": "wall" if it goes by a clock."""
        return {"outputs": list(adsdv.Vcu(edition=self.edition).step({}, 0).outputs)}

    def hello(self, edition):
        """All that follows is about this edition. Tells which one this VCU is of: if it has only one, always that."""
        if edition in adsdv.editions():
            self.edition = edition
        return self.edition

    def reset(self):
        """Begins anew, as after a power cycle."""
        self.vcu = adsdv.Vcu(self.readings, self.edition)

    def step(self, dt_ms, inputs):
        """Steps once. `inputs` has what is not at its default; the answer has as many outputs as there are."""
        if self.vcu is None:
            self.reset()
        return self.vcu.step(inputs, dt_ms).outputs


def answer(vcu, request):
    """The answer to one request, as a dict."""
    operation = request.pop("op", None)
    if operation == "hello":
        return {"edition": vcu.hello(request.get("edition")), **vcu.about()}
    if operation == "reset":
        vcu.reset()
        return {}
    if operation == "step":
        return vcu.step(request.pop("dt_ms", None), request)
    raise ValueError(f'"op" is {operation!r}; expected "hello", "reset" or "step"')


def main():
    """Answers line by line until the input ends."""
    vcu = VcuUnderTest(dict(argument.split("=", 1) for argument in sys.argv[1:]))
    for number, line in enumerate(sys.stdin, start=1):
        try:
            request = json.loads(line)
            if number == 1 and request.get("op") != "hello":
                # Nobody asks for an edition, so that it speaks of itself in a line of its own.
                print(json.dumps(vcu.about()))
            print(json.dumps(answer(vcu, request)), flush=True)
        except ValueError as error:
            sys.exit(f"line {number}: {error}")


if __name__ == "__main__":
    main()
