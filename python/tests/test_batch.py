"""Many steps in one call are what as many calls are, on rows in any buffer."""

import array
import random
import struct

import adsdv
import pytest

EDITIONS = adsdv.editions()
FORMATS = {"|b1": "?", "|u1": "B", "<u2": "H", "<i2": "h", "<i4": "i"}


def layout(of, edition):
    """The keys of a row, and what reads and writes it."""
    dtype = adsdv.dtype(of, edition)
    return [key for key, _ in dtype], struct.Struct("<" + "".join(FORMATS[kind] for _, kind in dtype))


def pack(of, edition, rows):
    """Dicts of numbers as rows."""
    keys, row = layout(of, edition)
    return bytearray(b"".join(row.pack(*(values[key] for key in keys)) for values in rows))


def unpack(of, edition, rows):
    keys, row = layout(of, edition)
    return [dict(zip(keys, values)) for values in row.iter_unpack(rows)]


def number(of, edition, key, value):
    """The number of a value, where it is a name."""
    return adsdv.numbers(of, key, edition)[value] if isinstance(value, str) else value


def some_inputs(chance, edition):
    """What leads a VCU through its states, with anything else now and then, by names."""
    inputs = {"asms": True, "tsms": True, "ebs": "ARMED", "ami": chance.choice(list(adsdv.numbers("inputs", "ami", edition)))}
    inputs["mission_status"] = chance.choice(["SELECTED", "SELECTED", "RUNNING", "RUNNING", "FINISHED"])
    inputs["direction_request"] = chance.choice(["NEUTRAL", "FORWARD"])
    inputs["go"] = chance.random() < 0.5
    inputs["handshake"] = chance.random() < 0.5
    for field in adsdv.inputs(edition):
        if field["key"] not in inputs:
            inputs[field["key"]] = field["default"]
        if chance.random() < 0.02:
            some = {"flag": [False, True], "name": field["names"], "number": [field["min"], 0, 9, 50, field["max"]]}
            inputs[field["key"]] = chance.choice(some[field["kind"]])
    return inputs


def script(chance, edition, count):
    steps = [some_inputs(chance, edition) for _ in range(count)]
    rows = [{key: number("inputs", edition, key, value) for key, value in inputs.items()} for inputs in steps]
    return steps, pack("inputs", edition, rows), array.array("I", [chance.choice([0, 10, 10, 40, 5000]) for _ in steps])


def remembered(control, edition):
    return {key: number("control", edition, key, value) for key, value in control.to_dict().items()}


def shown(step, edition):
    row = {}
    for field in adsdv.outputs(edition):
        value = step.outputs[field["key"]]
        row[field["key"]] = 0 if value is None else number("outputs", edition, field["key"], value)
        if field["nullable"]:
            row[field["key"] + "_active"] = value is not None
    return {**row, "row": -1 if step.row is None else step.row}


@pytest.mark.parametrize("edition", EDITIONS)
@pytest.mark.parametrize("readings", [{}, {"power-cycle": "not-latched"}])
def test_many_steps_are_as_many_calls(edition, readings):
    chance, states = random.Random(5), set()
    machine = adsdv.Machine(readings, edition=edition)
    for _ in range(20):
        steps, rows, dt_ms = script(chance, edition, 60)
        control, controls, outputs = adsdv.Control(), [], []
        for inputs, dt in zip(steps, dt_ms):
            step = machine.step(control, inputs, dt)
            control = step.control
            controls.append(remembered(control, edition))
            outputs.append(shown(step, edition))
            states.add(step.state)
        kept, said = adsdv.rows("control", len(steps), edition), adsdv.rows("outputs", len(steps), edition)
        assert machine.step_n(adsdv.Control(), rows, dt_ms, controls=kept, outputs=said) == control
        assert unpack("control", edition, kept) == controls
        assert unpack("outputs", edition, said) == outputs
        assert machine.step_n(adsdv.Control(), rows, dt_ms) == control
        # The same from each of these control states.
        before = adsdv.rows("control", 1, edition) + kept[: -len(kept) // len(steps)]
        machine.step_each(before, rows, dt_ms, outputs=said)
        assert (before, unpack("outputs", edition, said)) == (kept, outputs)
    assert len(states) >= 4


@pytest.mark.parametrize("edition", EDITIONS)
def test_a_time_is_a_cycle_or_a_number_for_all_or_one_for_each(edition):
    machine, (_, rows, _) = adsdv.Machine(edition=edition), script(random.Random(6), edition, 50)
    control = adsdv.Control()
    assert machine.step_n(control, rows) == machine.step_n(control, rows, 10)
    assert machine.step_n(control, rows, 10) == machine.step_n(control, rows, array.array("I", [10] * 50))
    assert machine.step_n(control, rows, 0) != machine.step_n(control, rows, 10)
    assert machine.step_n(control, b"") == control


def test_rows_are_as_the_lists_of_a_single_step_say():
    for edition in EDITIONS:
        assert [key for key, _ in adsdv.dtype("inputs", edition)] == [field["key"] for field in adsdv.inputs(edition)]
        usual = unpack("inputs", edition, adsdv.rows("inputs", 2, edition))
        names = {field["key"]: field["default"] for field in adsdv.inputs(edition)}
        assert usual == [{key: number("inputs", edition, key, value) for key, value in names.items()}] * 2
        assert [key for key, _ in adsdv.dtype("control", edition)] == list(adsdv.Control().to_dict())
        assert unpack("control", edition, adsdv.rows("control", 1, edition)) == [remembered(adsdv.Control(), edition)]
    assert "brake_plausibility_fault" in dict(adsdv.dtype("outputs", "4.0"))
    assert "brake_plausibility_fault" not in dict(adsdv.dtype("outputs"))


@pytest.mark.parametrize(
    "field, raw, text",
    [
        ("asms", 2, 'inputs[4]: "asms" is 2; expected 0 or 1'),
        ("ebs", 0, 'inputs[4]: "ebs" is 0; expected 1 = UNAVAILABLE, 2 = ARMED, 3 = TRIGGERED'),
        ("steer_angle", 241, 'inputs[4]: "steer_angle" is 241; expected a whole number from -240 to 240'),
    ],
)
def test_an_error_names_the_row_and_the_field_and_nothing_is_written(field, raw, text):
    keys, row = layout("inputs", "3.0")
    rows = adsdv.rows("inputs", 6)
    begin = struct.calcsize("<" + "".join(FORMATS[kind] for _, kind in adsdv.dtype("inputs")[: keys.index(field)]))
    rows[4 * row.size + begin : 4 * row.size + begin + 1] = bytes([raw])
    machine, controls, outputs = adsdv.Machine(), adsdv.rows("control", 6), adsdv.rows("outputs", 6)
    before = bytes(controls)
    for call in [
        lambda: machine.step_n(adsdv.Control(), rows, controls=controls, outputs=outputs),
        lambda: machine.step_each(controls, rows, outputs=outputs),
    ]:
        with pytest.raises(adsdv.InputError) as error:
            call()
        assert str(error.value) == text
        assert (controls, outputs) == (before, bytes(len(outputs)))


def test_what_a_vcu_cannot_remember_is_refused():
    _, row = layout("control", "3.0")
    controls = adsdv.rows("control", 3)
    controls[row.size] = 6
    with pytest.raises(adsdv.InputError, match=r'controls\[1\]: "state" is 6; expected 1 = AS_OFF, 2 = AS_READY, '):
        adsdv.Machine().step_each(controls, adsdv.rows("inputs", 3))
    cause = adsdv.Control(shutdown_cause="BRAKE_PLAUSIBILITY_FAULT")
    with pytest.raises(adsdv.InputError, match="shutdown_cause"):
        adsdv.Machine().step_n(cause, adsdv.rows("inputs", 3))
    rows = pack("control", "4.0", [remembered(cause, "4.0")])
    with pytest.raises(adsdv.InputError, match=r'controls\[0\]: "shutdown_cause" is 11; expected 0 = '):
        adsdv.Machine().step_each(rows, adsdv.rows("inputs", 1))


@pytest.mark.parametrize(
    "call, text",
    [
        (lambda m, c: m.step_n(c, 5), '"inputs" is 5; expected rows of adsdv.dtype("inputs", "3.0"), or their bytes'),
        (lambda m, c: m.step_n(c, b"abc"), '"inputs" has 3 bytes, which no number of rows of '),
        (lambda m, c: m.step_n(c, array.array("d", [1.0])), "\"inputs\" has items of the format 'd'; expected rows of "),
        (lambda m, c: m.step_n(c, adsdv.rows("inputs", 2), outputs=adsdv.rows("outputs", 3)),
         '"outputs" has 3 rows; expected 2, one for each of "inputs"'),
        (lambda m, c: m.step_n(c, adsdv.rows("inputs", 2), controls=bytes(adsdv.rows("control", 2))),
         '"controls" cannot be written; expected a buffer that can, such as a bytearray'),
        (lambda m, c: m.step_each(adsdv.rows("control", 2), adsdv.rows("inputs", 3)), '"controls" has 2 rows; expected 3'),
        (lambda m, c: m.step_each(bytes(adsdv.rows("control", 2)), adsdv.rows("inputs", 2)), '"controls" cannot be written'),
        (lambda m, c: m.step_n(c, adsdv.rows("inputs", 2), -1), '"dt_ms" is -1; expected a whole number from 0 to '),
        (lambda m, c: m.step_n(c, adsdv.rows("inputs", 2), array.array("d", [1, 2])),
         "\"dt_ms\" has 2 items of the format \"d\"; expected 2 of \"I\" (numpy.uint32), one for each of \"inputs\""),
        (lambda m, c: m.step_n(c, adsdv.rows("inputs", 2), array.array("I", [1])), '"dt_ms" has 1 items'),
        (lambda m, c: adsdv.dtype("input"), "\"of\" is 'input'; expected \"inputs\", \"outputs\" or \"control\""),
        (lambda m, c: adsdv.rows("inputs", -1), '"count" is -1; expected a whole number from 0 to '),
        (lambda m, c: adsdv.numbers("inputs", "asms"), "\"key\" is 'asms'; expected one of ami, ebs, mission_status, "),
        (lambda m, c: adsdv.dtype("inputs", "2.9"), "\"edition\" is '2.9'; expected one of "),
    ],
)
def test_what_cannot_be_rows_is_refused(call, text):
    with pytest.raises(adsdv.InputError) as error:
        call(adsdv.Machine(), adsdv.Control())
    assert str(error.value).startswith(text)


class TestNumpy:
    """Structured arrays of NumPy."""

    numpy = None

    @pytest.fixture(autouse=True)
    def _numpy(self):
        TestNumpy.numpy = pytest.importorskip("numpy")

    @pytest.mark.parametrize("edition", EDITIONS)
    def test_an_array_is_its_bytes(self, edition):
        numpy, machine = self.numpy, adsdv.Machine(edition=edition)
        _, rows, dt_ms = script(random.Random(7), edition, 200)
        array = numpy.frombuffer(rows, adsdv.dtype("inputs", edition))
        controls = numpy.zeros(200, adsdv.dtype("control", edition))
        outputs = numpy.zeros(200, adsdv.dtype("outputs", edition))
        last = machine.step_n(adsdv.Control(), array, numpy.array(dt_ms, "u4"), controls=controls, outputs=outputs)
        kept, said = adsdv.rows("control", 200, edition), adsdv.rows("outputs", 200, edition)
        assert machine.step_n(adsdv.Control(), rows, dt_ms, controls=kept, outputs=said) == last
        assert (controls.tobytes(), outputs.tobytes()) == (kept, said)
        assert len(set(outputs["as_state"].tolist())) > 1
        # Inputs may have gaps, and stand in more than one dimension.
        assert machine.step_n(adsdv.Control(), array[::2]) == machine.step_n(adsdv.Control(), array[::2].copy())
        square = controls.reshape(20, 10)
        machine.step_each(square, array.reshape(20, 10))
        assert square.shape == (20, 10)

    def test_another_dtype_is_refused(self):
        numpy, machine = self.numpy, adsdv.Machine()
        for wrong in [
            numpy.zeros(3, adsdv.dtype("control")),
            numpy.zeros(3, [(key, kind.replace("<", ">")) for key, kind in adsdv.dtype("inputs")]),
            numpy.zeros(3, numpy.dtype(adsdv.dtype("inputs"), align=True)),
            numpy.zeros(3, adsdv.dtype("inputs", "4.0")),
            numpy.zeros(10, "f8"),
        ]:
            with pytest.raises(adsdv.InputError, match='"inputs" has the dtype .*; expected rows of adsdv.dtype'):
                machine.step_n(adsdv.Control(), wrong)

    def test_what_cannot_be_filled_is_refused(self):
        numpy, machine, inputs = self.numpy, adsdv.Machine(), adsdv.rows("inputs", 3)
        outputs = numpy.zeros(6, adsdv.dtype("outputs"))
        with pytest.raises(adsdv.InputError, match='"outputs" has gaps between its rows'):
            machine.step_n(adsdv.Control(), inputs, outputs=outputs[::2])
        fixed = numpy.zeros(3, adsdv.dtype("outputs"))
        fixed.flags.writeable = False
        with pytest.raises(adsdv.InputError, match='"outputs" cannot be written'):
            machine.step_n(adsdv.Control(), inputs, outputs=fixed)
