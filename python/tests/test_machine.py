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


@pytest.mark.parametrize("edition", adsdv.editions())
def test_every_value_of_every_input_is_taken_and_no_other(edition):
    vcu = adsdv.Vcu(edition=edition)
    for field in adsdv.inputs(edition):
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
    text = (root / "conform/PROTOCOL.md").read_text(encoding="utf-8")
    _, inputs, outputs = re.split(r"^## (?:Inputs|Outputs)$", text, flags=re.MULTILINE)
    for table, of_edition in [(inputs, adsdv.inputs), (outputs, adsdv.outputs)]:
        rows = re.findall(r"^\| (`.*?) \|", table, flags=re.MULTILINE)
        keys = [key for row in rows for key in re.findall(r"`(\w+)`", row)]
        assert sorted(keys) == sorted({field["key"] for edition in adsdv.editions() for field in of_edition(edition)})


@pytest.mark.parametrize("edition", adsdv.editions())
def test_outputs_have_the_keys_and_values_of_the_protocol(edition):
    outputs = adsdv.Vcu(edition=edition).step().outputs
    assert list(outputs) == [field["key"] for field in adsdv.outputs(edition)]
    for field in adsdv.outputs(edition):
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


def test_machines_are_of_an_edition():
    older, newer = adsdv.Machine(edition="3.0"), adsdv.Machine(edition="4.0")
    assert (older.edition, newer.edition) == ("3.0", "4.0")
    assert adsdv.Machine() == adsdv.Machine(edition=adsdv.INTERFACE_VERSION) == older != newer
    for machine in [older, newer, adsdv.Machine({"go-edge": "edge"}, "4.0")]:
        assert pickle.loads(pickle.dumps(machine)) == machine == copy.deepcopy(machine)
        assert eval(repr(machine), {"Machine": adsdv.Machine}) == machine
    assert repr(newer) == "Machine(edition='4.0')"
    assert adsdv.Vcu(edition="4.0").machine == newer
    assert newer.readings == {reading["id"]: reading["default"] for reading in adsdv.readings("4.0")} != older.readings
    assert len({older, newer}) == 2


@pytest.mark.parametrize("edition", ["2.9", "", "4", "V4_0", 4.0, True, b"4.0", "\ud800", ["4.0"]])
def test_an_edition_that_there_is_not_is_refused_with_those_that_there_are(edition):
    versions = ", ".join(f'"{version}"' for version in adsdv.editions())
    for call in [
        lambda: adsdv.Machine(edition=edition),
        lambda: adsdv.Vcu({}, edition),
        lambda: adsdv.inputs(edition),
        lambda: adsdv.outputs(edition),
        lambda: adsdv.messages(edition),
        lambda: adsdv.readings(edition),
        lambda: adsdv.decode(0x513, bytes(8), edition),
        lambda: adsdv.encode(0x513, edition=edition),
        lambda: adsdv.is_reserved(0, edition),
        lambda: adsdv.check(b"", edition=edition),
        lambda: adsdv.Judge(edition=edition),
    ]:
        with pytest.raises(adsdv.InputError) as error:
            call()
        assert str(error.value).startswith('"edition" is ') and str(error.value).endswith("expected one of " + versions)


def unanswered(edition, cycles):
    """Whether communication is lost, cycle by cycle, while the AI Computer answers no handshake."""
    vcu = adsdv.Vcu(edition=edition)
    return [vcu.step(dt_ms=10, tsms=True).outputs["ai_comms_lost"] for _ in range(cycles)]


def test_an_answer_to_the_handshake_after_60_ms_is_late_in_3_0_alone():
    assert unanswered("3.0", 7)[-1] and not unanswered("4.0", 7)[-1]
    assert not unanswered("4.0", 10)[-1] and unanswered("4.0", 11)[-1]


def test_a_missing_message_is_an_input_of_4_0_alone():
    silent = dict(tsms=True, handshake=True, brake_silence_ms=100)
    vcu = adsdv.Vcu(edition="4.0")
    # The watch begins with the handshake.
    vcu.step(dt_ms=10, tsms=True)
    lost = adsdv.Machine(edition="4.0").step(vcu.control, silent, 10).outputs
    assert lost["ai_comms_lost"]
    with pytest.raises(adsdv.InputError, match='^there is no key "brake_silence_ms" in edition 3.0; expected one of asms, '):
        adsdv.Machine(edition="3.0").step(adsdv.Control(), silent)


def test_names_are_those_of_the_edition_and_those_of_3_0_are_understood():
    newer = adsdv.Vcu(edition="4.0")
    for ami in ["TRACK DRIVE", "TRACK_DRIVE", 4]:
        assert newer.step(ami=ami).outputs["ami_state"] == "TRACK DRIVE"
    with pytest.raises(adsdv.InputError, match="^\"ami\" is 'TRACK DRIVE'; expected one of \"NOT_SELECTED\""):
        adsdv.Vcu(edition="3.0").step(ami="TRACK DRIVE")
    with pytest.raises(adsdv.InputError, match='^"steer_angle" is 211; expected a whole number from -210 to 210$'):
        newer.step(steer_angle=211)


def test_a_control_that_the_edition_cannot_have_is_refused():
    newest = adsdv.Control(shutdown_cause="BRAKE_PLAUSIBILITY_FAULT")
    assert newest == adsdv.Control(shutdown_cause="BRAKE PLAUSIBILITY FAULT") == adsdv.Control(shutdown_cause=11)
    assert adsdv.Machine(edition="4.0").step(newest).outputs["shutdown_cause"] == "BRAKE_PLAUSIBILITY_FAULT"
    vcu = adsdv.Vcu(edition="4.0")
    vcu.control = newest
    refused = "^\"shutdown_cause\" is \"BRAKE PLAUSIBILITY FAULT\"; expected in edition 3.0 one of \"NO SHUTDOWN\""
    with pytest.raises(adsdv.InputError, match=refused):
        adsdv.Machine(edition="3.0").step(newest)
    vcu = adsdv.Vcu(edition="3.0")
    with pytest.raises(adsdv.InputError, match=refused):
        vcu.control = newest
    assert vcu.control == adsdv.Control()


def test_readings_are_known():
    with pytest.raises(adsdv.InputError, match='"fault": no such reading; expected one of mission-selected, '):
        adsdv.Machine({"fault": "edge"})
    with pytest.raises(adsdv.InputError, match="'slope': no such choice of fault-trigger; expected one of level, edge"):
        adsdv.Vcu(readings={"fault-trigger": "slope"})
    with pytest.raises(TypeError, match="expected a dict"):
        adsdv.Machine("fault-trigger=edge")
    for make in [adsdv.Machine, adsdv.Vcu]:
        with pytest.raises(adsdv.InputError, match="^\"fault-trigger\" is 'edge'; expected in edition 4.0 level$"):
            make({"fault-trigger": "edge"}, "4.0")


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
