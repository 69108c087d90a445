"""conform/examples/adapter.py, which speaks the protocol of PROTOCOL.md."""

import json
import random
import re
import subprocess
import sys

import adsdv
import pytest


@pytest.fixture
def adapter(root):
    return root / "conform/examples/adapter.py"


def about(edition=None):
    """What it says of itself: the outputs that an edition has."""
    return {"outputs": list(adsdv.Vcu(edition=edition).step({}, 0).outputs)}


def start(adapter, *arguments):
    command = [sys.executable, adapter, *arguments]
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def scenario(seed, steps, edition=None):
    """Requests of random inputs, with some resets, and the reference VCU's answers; after a hello, if an edition is named."""
    rng, vcu = random.Random(seed), adsdv.Vcu(edition=edition)
    if edition:
        yield {"op": "hello", "edition": edition}, {"edition": edition, **about(edition)}
    for number in range(steps):
        if number == 0 or rng.random() < 0.01:
            vcu.reset()
            yield {"op": "reset"}, {}
        inputs = {}
        for field in rng.sample(adsdv.inputs(edition), rng.randint(0, 12)):
            values = {"flag": [True], "name": field["names"], "number": [field["min"], field["max"], 0]}
            inputs[field["key"]] = rng.choice(values[field["kind"]])
        dt_ms = rng.choice([0, 10, 10, 10, 5000])
        yield {"op": "step", "dt_ms": dt_ms, **inputs}, vcu.step(inputs, dt_ms).outputs


def test_it_is_short(adapter):
    assert len(adapter.read_text(encoding="utf-8").splitlines()) < 100


@pytest.mark.parametrize("edition", [None, *adsdv.editions()])
def test_it_answers_line_by_line(adapter, edition):
    with start(adapter) as program:
        for number, (request, expected) in enumerate(scenario(1, 300, edition)):
            program.stdin.write(json.dumps(request, separators=(",", ":")) + "\n")
            program.stdin.flush()
            if number == 0 and not edition:
                assert json.loads(program.stdout.readline()) == about()
            assert json.loads(program.stdout.readline()) == expected


def test_many_lines_may_be_waiting(adapter):
    requests, expected = zip(*scenario(2, 2000))
    with start(adapter) as program:
        out, err = program.communicate("".join(json.dumps(request) + "\n" for request in requests), timeout=60)
    assert [json.loads(line) for line in out.splitlines()] == [about(), *expected]
    assert (err, program.returncode) == ("", 0)


def test_the_conversation_of_the_protocol_is_its_own(adapter, root):
    """The example in PROTOCOL.md, whose answers may leave outputs out."""
    text = (root / "conform/PROTOCOL.md").read_text(encoding="utf-8")
    example = re.search(r"```console\n(.*?)```", text, re.DOTALL).group(1).splitlines()
    requests = [line[2:] for line in example if line.startswith("> ")]
    answers = [json.loads(line[2:]) for line in example if line.startswith("< ")]
    with start(adapter) as program:
        out, _ = program.communicate("\n".join(requests) + "\n", timeout=60)
    told = [json.loads(line) for line in out.splitlines()]
    assert len(told) == len(answers) > 1
    for whole, part in zip(told, answers):
        assert {**whole, **part} == whole


def test_readings_are_arguments(adapter):
    with start(adapter, "go-signal=raw") as program:
        out, _ = program.communicate('{"op":"reset"}\n{"op":"step","dt_ms":10,"go":true}\n', timeout=60)
    assert json.loads(out.splitlines()[2])["go_signal"] is True


def test_an_edition_that_it_is_not_of_is_answered_with_its_own(adapter):
    with start(adapter) as program:
        out, err = program.communicate('{"op":"hello","edition":"2.9"}\n{"op":"hello"}\n', timeout=60)
    assert [json.loads(line) for line in out.splitlines()] == [{"edition": "3.0", **about()}] * 2
    assert (err, program.returncode) == ("", 0)


OTHERS = [(edition, {}) for edition in adsdv.editions()] + [
    (edition, {reading["id"]: choice})
    for edition in adsdv.editions()
    for reading in adsdv.readings(edition)
    for choice in reading["choices"]
    if choice != reading["default"]
]


@pytest.mark.parametrize("edition, readings", OTHERS, ids=str)
def test_it_conforms_and_its_readings_are_recognised(command, adapter, edition, readings):
    arguments = [f"{reading}={choice}" for reading, choice in readings.items()]
    conform = [command, "conform", "--edition", edition, "--json", "--", sys.executable, adapter, *arguments]
    run = subprocess.run(conform, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    assert json.loads(run.stdout)["readings"] == adsdv.Machine(readings, edition).readings


@pytest.mark.parametrize(
    "line, error",
    [
        ("rubbish", "line 2: Expecting value"),
        ('{"op":"stop"}', "line 2: \"op\" is 'stop'; expected \"hello\", \"reset\" or \"step\""),
        ('{"op":"step","dt_ms":10,"asm":1}', 'line 2: there is no key "asm"; expected one of asms, '),
    ],
)
def test_bad_lines_end_it_with_a_reason(adapter, line, error):
    with start(adapter) as program:
        out, err = program.communicate(f'{{"op":"reset"}}\n{line}\n', timeout=60)
    assert out.splitlines()[1:] == ["{}"] and err.startswith(error) and program.returncode == 1
