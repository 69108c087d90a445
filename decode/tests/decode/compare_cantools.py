"""Compares what adsdv decoded with what cantools decodes: DBC, LOG of candump -L, JSON Lines of adsdv."""

import json
import math
import sys

import cantools

dbc, log, decoded = sys.argv[1:]
database = cantools.database.load_file(dbc, encoding="utf-8")
alike = 0
with open(log) as log, open(decoded) as decoded:
    for line, ours in zip(log, decoded, strict=True):
        ident, data = line.split()[2].split("#")
        ours = json.loads(ours)
        message = database.get_message_by_frame_id(int(ident, 16))
        data = bytes.fromhex(data)
        numbers = message.decode(data, decode_choices=False)
        names = message.decode(data)
        assert ours["message"] == message.name and ours["id"] == ident, (line, ours)
        assert set(ours["signals"]) == set(numbers), (line, set(ours["signals"]) ^ set(numbers))
        for name, number in numbers.items():
            signal, row = ours["signals"][name], message.get_signal_by_name(name)
            value = signal["value"]
            if value is None:
                assert not math.isfinite(number), (line, name, number)
            else:
                # A fraction is exact here, and the nearest float there.
                assert math.isclose(value, number, rel_tol=1e-14, abs_tol=1e-300), (line, name, value, number)
            assert signal.get("unit", "") == (row.unit or ""), (line, name, signal)
            named = names[name]
            named = str(named) if isinstance(named, cantools.database.namedsignalvalue.NamedSignalValue) else None
            assert signal.get("name") == named, (line, name, signal, named)
        alike += 1
print(f"{alike} frames are alike")
