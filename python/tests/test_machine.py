"""Machine, Control, Step and Vcu."""

import copy
import pickle
import re

import adsdv
import pytest

READY = dict(asms=True, tsms=True, ami="TRACK_DRIVE", ebs="ARMED", mission_status="SELECTED")


def drive(vcu, steps, **inputs):
    """Steps with an AI Computer that answers the handshake; returns the sections taken."""
    bit, sections = False, []
    for _ in range(steps):
        step = vcu.step(inputs, 10, handshake=bit)
        bit = step.outputs["handshake"]
        if step.section:
            sections.append((step.outputs["as_state"], step.section))
    return sections


def test_a_mission_takes_the_arrows_of_figure_2():
    vcu = adsdv.Vcu()
    assert drive(vcu, 501, **READY) == [("AS_READY", "3.1")]
    assert vcu.control.go_seen_low
    assert drive(vcu, 1, **READY, go=True) == [("AS_DRIVING", "3.2")]
    driving = dict(READY, go=True, mission_status="RUNNING", direction_request="FORWARD", fl_wheel_speed=300)
    assert drive(vcu, 100, **driving, front_axle_trq_request=500, steer_request=-49) == []
    outputs = vcu.step(driving, 10, front_axle_trq_request=500, steer_request=-49).outputs
    assert (outputs["front_axle_trq"], outputs["steer"], outputs["direction"]) == (500, -49, "FORWARD")
    stopped = dict(READY, go=True, mission_status="FINISHED")
    assert drive(vcu, 1, **stopped) == [("AS_FINISHED", "3.3")]
    assert drive(vcu, 1, tsms=True) == [("AS_OFF", "3.4")]


def test_an_unanswered_handshake_is_lost_after_50_ms():
    vcu = adsdv.Vcu()
    lost = [vcu.step(dt_ms=10, tsms=True).outputs["ai_comms_lost"] for _ in range(6)]
    assert lost == [False] * 5 + [True]


def test_a_step_is_a_pure_function():
    machine, control = adsdv.Machine(), adsdv.Control()
    first = machine.step(control, READY, 10)
    second = machine.step(control, READY, 10)
    assert control == adsdv.Control()
    assert first.control == second.control != control
    assert first.outputs == second.outputs
    assert (first.before, first.state, first.row) == ("AS_OFF", "AS_READY", 0)
    assert "AS master switch ON" in first.conditions
    first.outputs["as_state"] = "changed"
    assert first.outputs == second.outputs


def test_the_cycle_is_10_ms_unless_it_is_said():
    machine, control = adsdv.Machine(), adsdv.Control(state="AS_READY")
    assert machine.step(control, READY).control.in_state_ms == 10
    assert machine.step(control, READY, 25).control.in_state_ms == 25
    assert machine.step(control, READY, 4_294_967_295).control.in_state_ms == 5000
    assert machine.step(control, READY, dt_ms=0).control.in_state_ms == 0


def test_what_is_not_given_is_at_its_default():
    defaults = {field["key"]: field["default"] for field in adsdv.inputs()}
    machine = adsdv.Machine()
    for control in [adsdv.Control(), adsdv.Control(state="AS_DRIVING"), adsdv.Control(state="AS_FINISHED")]:
        assert machine.step(control).outputs == machine.step(control, defaults).outputs
        assert machine.step(control).control == machine.step(control, **defaults).control


def test_every_value_of_every_input_is_taken_and_no_other():
    vcu = adsdv.Vcu()
    for field in adsdv.inputs():
        if field["kind"] == "flag":
            good, bad = [True, False, 1, 0], [2, -1, 1.0, "true", None, [], 2**70]
        elif field["kind"] == "name":
            good, bad = field["names"], ["", field["names"][0].lower(), 99, True, None, "\ud800", 1.0]
        else:
            good = [field["min"], field["max"], 0]
            bad = [field["min"] - 1, field["max"] + 1, 0.5, True, "0", None, 2**70, -(2**70)]
        for value in good:
            vcu.step({field["key"]: value})
        for value in bad:
            with pytest.raises(adsdv.InputError, match=f'^"{field["key"]}" is .*; expected '):
                vcu.step({field["key"]: value})


def test_names_may_be_numbers():
    assert adsdv.Vcu().step(ami=4).outputs["ami_state"] == "TRACK_DRIVE"


def test_keys_are_those_of_the_protocol(root):
    text = (root / "oracle/PROTOCOL.md").read_text(encoding="utf-8")
    _, inputs, outputs = re.split(r"^## (?:Inputs|Outputs)$", text, flags=re.MULTILINE)
    for table, fields in [(inputs, adsdv.inputs()), (outputs, adsdv.outputs())]:
        rows = re.findall(r"^\| (`.*?) \|", table, flags=re.MULTILINE)
        keys = [key for row in rows for key in re.findall(r"`(\w+)`", row)]
        assert sorted(keys) == sorted(field["key"] for field in fields)


def test_outputs_have_the_keys_and_values_of_the_protocol():
    outputs = adsdv.Vcu().step().outputs
    assert list(outputs) == [field["key"] for field in adsdv.outputs()]
    for field in adsdv.outputs():
        value = outputs[field["key"]]
        if value is None:
            assert field["nullable"]
        else:
            assert type(value) is {"flag": bool, "name": str, "number": int}[field["kind"]]
            assert field["kind"] != "name" or value in field["names"]


def test_keys_are_given_once_and_known():
    vcu = adsdv.Vcu()
    with pytest.raises(adsdv.InputError, match='^"asms" is there twice; expected each key once$'):
        vcu.step({"asms": True}, asms=True)
    with pytest.raises(adsdv.InputError, match='^there is no key "asm"; expected one of asms, tsms, ami, '):
        vcu.step(asm=True)
    with pytest.raises(adsdv.InputError, match="^a key is 1; expected a str$"):
        vcu.step({1: True})
    with pytest.raises(TypeError, match="expected a dict"):
        vcu.step([("asms", True)])
    assert vcu.control == adsdv.Control()


def test_controls_are_values():
    control = adsdv.Machine().step(adsdv.Control(), READY, 10).control
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        assert pickle.loads(pickle.dumps(control, protocol)) == control
    assert copy.deepcopy(control) == control == adsdv.Control(control.to_dict())
    assert hash(copy.copy(control)) == hash(control)
    assert control != adsdv.Control() and control != "AS_READY"
    assert eval(repr(control), {"Control": adsdv.Control}) == control
    assert {key: getattr(control, key) for key in control.to_dict()} == control.to_dict()
    assert set(control.to_dict()) < set(dir(control))
    with pytest.raises(AttributeError, match="a Control has no attribute 'statr'"):
        control.statr
    with pytest.raises(AttributeError):
        control.state = "AS_OFF"


def test_a_control_takes_what_there_is_and_nothing_else():
    assert adsdv.Control(in_state_ms=65535).in_state_ms == 65535
    for wrong in [dict(in_state_ms=65536), dict(in_state_ms=-1), dict(state="OFF"), dict(was_running=2)]:
        with pytest.raises(adsdv.InputError, match="expected"):
            adsdv.Control(**wrong)
    with pytest.raises(adsdv.InputError, match="there is no key"):
        adsdv.Control(stat="AS_OFF")


def test_readings_decide():
    driving = adsdv.Control(state="AS_DRIVING")
    inputs = dict(asms=True, go=True, mission_status="FINISHED", rr_wheel_speed=11)
    level, edge = adsdv.Machine(), adsdv.Machine({"fault-trigger": "edge"})
    assert level.step(driving, inputs).section == "3.7"
    assert edge.step(driving, inputs, direction_request="FORWARD").section is None
    assert level.readings == {reading["id"]: reading["default"] for reading in adsdv.readings()}
    assert edge.readings["fault-trigger"] == "edge"
    assert repr(edge) == "Machine({'fault-trigger': 'edge'})"
    assert edge != level == pickle.loads(pickle.dumps(level))
    assert pickle.loads(pickle.dumps(edge)) == edge and hash(edge) == hash(copy.copy(edge))
    assert adsdv.Vcu({"fault-trigger": "edge"}).machine == edge


def test_readings_are_known():
    with pytest.raises(adsdv.InputError, match='"fault": no such reading; expected one of mission-selected, '):
        adsdv.Machine({"fault": "edge"})
    with pytest.raises(adsdv.InputError, match="'slope': no such choice of fault-trigger; expected one of level, edge"):
        adsdv.Vcu(readings={"fault-trigger": "slope"})
    with pytest.raises(TypeError, match="expected a dict"):
        adsdv.Machine("fault-trigger=edge")


def test_a_vcu_remembers_what_it_received():
    vcu = adsdv.Vcu()
    assert vcu.receive(*adsdv.encode("AI2VCU_Brake", HYD_PRESS_F_REQ_pct=50, HYD_PRESS_R_REQ_pct=25))
    assert not vcu.receive(0x520, b"")
    with pytest.raises(adsdv.CodecError, match=r"AI2VCU_Brake \(514h\) has 1 bytes, needs 2"):
        vcu.receive(0x514, b"\x01")
    vcu.control = adsdv.Control(state="AS_READY")
    outputs = vcu.step(asms=True, hyd_press_r_req=10).outputs
    assert (outputs["hyd_press_f"], outputs["hyd_press_r"]) == (100, 10)
    vcu.reset()
    assert vcu.control == adsdv.Control() and vcu.state == "AS_OFF"
    vcu.control = adsdv.Control(state="AS_READY")
    assert vcu.step(asms=True).outputs["hyd_press_f"] == 0
