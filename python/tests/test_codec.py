"""decode, encode, frames and is_reserved."""

import random

import adsdv
import pytest



def by_id(edition):
    """The signals of each message."""
    messages = {}
    for signal in adsdv.messages(edition):
        messages.setdefault(signal["id"], []).append(signal)
    return messages


MESSAGES = by_id(adsdv.INTERFACE_VERSION)
EVERY = [(edition, id) for edition in adsdv.editions() for id in by_id(edition)]


def test_there_are_all_messages_of_the_document():
    older = [*range(0x500, 0x503), *range(0x510, 0x515), *range(0x520, 0x527)]
    assert list(MESSAGES) == list(by_id("3.0")) == older
    assert list(by_id("4.0")) == [0x120, *older]


def test_no_signal_is_called_as_the_edition_is():
    for edition in adsdv.editions():
        assert all(signal["signal"] not in ("edition", "message") for signal in adsdv.messages(edition))


@pytest.mark.parametrize("edition, id", EVERY)
def test_what_is_encoded_is_decoded(edition, id):
    rng = random.Random(id)
    signals = by_id(edition)[id]
    for _ in range(200):
        raw = {
            signal["signal"]: rng.choice(list(signal["values"]) or [rng.randint(signal["min"], signal["max"])])
            for signal in signals
        }
        physical = {signal["signal"]: raw[signal["signal"]] * signal["scale"] for signal in signals}
        frame = adsdv.encode(id, edition=edition, **physical)
        message = adsdv.decode(*frame, edition)
        assert (message["raw"], message["id"]) == (raw, id) == (raw, frame[0])
        assert len(frame[1]) == signals[0]["length"]
        assert message["signals"] == pytest.approx(physical)
        assert adsdv.encode(message["name"], edition=edition, **message["signals"]) == frame
        assert adsdv.encode(id, edition=edition, **{**message["signals"], **message["names"]}) == frame


def test_a_frame_is_as_long_as_the_edition_has_it():
    assert adsdv.encode(0x511, FRONT_AXLE_TRQ_REQUEST_Nm=195)[1].hex() == "9e07000000000000"
    assert adsdv.encode(0x511, edition="4.0", FRONT_AXLE_TRQ_REQUEST=195)[1].hex() == "9e070000"


def test_what_an_edition_cannot_say_is_refused():
    for call, message in [
        (lambda: adsdv.decode(0x120, bytes(8)), "120h is not the identifier of a message of section 2"),
        (lambda: adsdv.encode("VCU_STATUS"), 'there is no message "VCU_STATUS"; expected one of VCU2LOG_Dynamics1, '),
        (
            lambda: adsdv.encode(0x520, BRAKE_PLAUSIBILITY_FAULT=1),
            'VCU2AI_Status (520h) has no signal "BRAKE_PLAUSIBILITY_FAULT"; expected one of HANDSHAKE, ',
        ),
        (
            lambda: adsdv.encode(0x520, AS_STATE=1, SHUTDOWN_CAUSE=11),
            "VCU2AI_Status (520h): SHUTDOWN_CAUSE is 11, allowed: 0 = NO SHUTDOWN, ",
        ),
        (
            lambda: adsdv.encode(0x513, edition="4.0", STEER_REQUEST_deg=21.1),
            "AI2VCU_Steer (513h): STEER_REQUEST is 21.1 deg (raw 211), allowed: -21 to 21 deg (raw -210 to 210)",
        ),
        (
            lambda: adsdv.decode(0x513, (-211).to_bytes(2, "little", signed=True), "4.0"),
            "AI2VCU_Steer (513h): STEER_REQUEST is -21.1 deg (raw -211), allowed: -21 to 21 deg",
        ),
    ]:
        with pytest.raises(adsdv.CodecError) as error:
            call()
        assert str(error.value).startswith(message)


def test_frames_are_those_of_the_edition_of_the_step():
    for edition in adsdv.editions():
        sent = dict(adsdv.frames(adsdv.Vcu(edition=edition).step()))
        assert set(sent) == {signal["id"] for signal in adsdv.messages(edition) if signal["sender"] == "VCU"}
        for id, data in sent.items():
            assert len(data) == by_id(edition)[id][0]["length"]
    newer = dict(adsdv.frames(adsdv.Vcu(edition="4.0").step()))
    assert (len(newer[0x521]), len(newer[0x524])) == (6, 5) and 0x120 in newer


def test_bits_are_where_the_database_has_them():
    id, data = adsdv.encode("AI2VCU_Status", ESTOP_REQUEST=True, MISSION_STATUS="FINISHED", DIRECTION_REQUEST="FORWARD")
    assert (id, data.hex()) == (0x510, "0071000000000000")
    assert adsdv.encode(0x511, FRONT_AXLE_TRQ_REQUEST_Nm=195)[1].hex() == "9e07000000000000"
    assert adsdv.encode(0x523, STEER_ANGLE_deg=-1)[1].hex()[:4] == "f6ff"


def test_the_names_of_other_editions_are_understood():
    assert adsdv.encode("VCU2AI_Speeds", FL_WHEEL_SPEED=10) == adsdv.encode(0x525, FL_WHEEL_SPEED_rpm=10)


def test_what_is_not_given_is_at_its_default():
    for id, data in adsdv.frames(adsdv.Vcu().step()):
        message = adsdv.decode(id, data)
        given = {"State_service_brake": message["raw"]["State_service_brake"]} if id == 0x502 else {}
        assert adsdv.encode(id, **given) == (id, data)


def test_data_may_be_any_bytes():
    message = adsdv.decode(0x513, b"\x9c\xff")
    for data in [bytearray(b"\x9c\xff"), memoryview(b"\x9c\xff"), [0x9C, 0xFF], (0x9C, 0xFF), b"\x9c\xff" + bytes(62)]:
        assert adsdv.decode(0x513, data) == message


def test_names_and_numbers_are_there():
    message = adsdv.decode(0x520, bytes.fromhex("0000430000000000"))
    assert message["sender"] == "VCU" and message["name"] == "VCU2AI_Status"
    assert message["names"]["AS_STATE"] == "AS_DRIVING" and message["raw"]["AS_STATE"] == 3
    assert message["signals"]["AS_STATE"] == 3 and type(message["signals"]["AS_STATE"]) is int
    assert adsdv.decode(0x514, b"\x05\x00")["signals"] == {"HYD_PRESS_F_REQ_pct": 2.5, "HYD_PRESS_R_REQ_pct": 0.0}


@pytest.mark.parametrize(
    "id, data, message",
    [
        (0x527, b"", "527h is not the identifier of a message of section 2"),
        (0x513, b"\x00", "AI2VCU_Steer (513h) has 1 bytes, needs 2: STEER_REQUEST_deg is the first signal that "),
        (0x520, bytes(8), "VCU2AI_Status (520h): AS_STATE is 0, allowed: 1 = AS_OFF, 2 = AS_READY, "),
    ],
)
def test_data_that_is_no_message_is_refused(id, data, message):
    with pytest.raises(adsdv.CodecError) as error:
        adsdv.decode(id, data)
    assert str(error.value).startswith(message)


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: adsdv.decode(0x800, b""), '"id" is 2048; expected a whole number from 0 to 2047'),
        (lambda: adsdv.decode("513", b""), '"id" is \'513\'; expected a whole number from 0 to 2047'),
        (lambda: adsdv.decode(0x513, "9cff"), '"data" is \'9cff\'; expected bytes, or a list of whole numbers '),
        (lambda: adsdv.decode(0x513, [256]), '"data" is [256]; expected bytes, or a list of whole numbers from 0 to '),
        (lambda: adsdv.encode("AI2VCU"), 'there is no message "AI2VCU"; expected one of VCU2LOG_Dynamics1, '),
        (lambda: adsdv.encode(0x527), "527h is not the identifier of a message of section 2"),
        (
            lambda: adsdv.encode(0x513, STEER=0),
            'AI2VCU_Steer (513h) has no signal "STEER"; expected one of STEER_REQUEST_deg',
        ),
        (
            lambda: adsdv.encode(0x513, STEER_REQUEST_deg=24.1),
            "AI2VCU_Steer (513h): STEER_REQUEST_deg is 24.1 deg (raw 241), allowed: -24 to 24 deg (raw -240 to 240)",
        ),
        (
            lambda: adsdv.encode(0x513, STEER_REQUEST_deg=float("nan")),
            "AI2VCU_Steer (513h): STEER_REQUEST_deg is nan; expected a number from -24 to 24 deg",
        ),
        (
            lambda: adsdv.encode(0x513, STEER_REQUEST_deg=True),
            "AI2VCU_Steer (513h): STEER_REQUEST_deg is True; expected a number from -24 to 24 deg",
        ),
        (
            lambda: adsdv.encode(0x510, MISSION_STATUS="DONE"),
            "AI2VCU_Status (510h): MISSION_STATUS is 'DONE'; expected \"NOT SELECTED\" or 0, \"SELECTED\" or 1, ",
        ),
        (lambda: adsdv.encode(0x520, AS_STATE=0), "VCU2AI_Status (520h): AS_STATE is 0, allowed: 1 = AS_OFF, "),
        (lambda: adsdv.is_reserved(-1), '"id" is -1; expected a whole number from 0 to 2047'),
    ],
)
def test_what_there_is_not_is_refused(call, message):
    with pytest.raises(adsdv.AdsdvError) as error:
        call()
    assert str(error.value).startswith(message)
    assert isinstance(error.value, ValueError)


def test_reserved_identifiers_are_those_of_section_2_3():
    reserved = [id for id in range(0x800) if adsdv.is_reserved(id)]
    assert (len(reserved), reserved[0], reserved[-1]) == (85, 0x000, 0x705)
    assert not any(adsdv.is_reserved(id) for id in MESSAGES)
    newer = {id for id in range(0x800) if adsdv.is_reserved(id, "4.0")}
    assert set(reserved) - newer == {0x100, 0x201} and newer - set(reserved) > {0x600, 0x660}
