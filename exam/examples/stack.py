#!/usr/bin/env python3
"""An AI Computer in the shape of a team's stack: mission logic, controller, CAN layer.

    adsdv exam --stdio -- python3 exam/examples/stack.py

From Python, adsdv.exam(Stack) examines the class itself, and python/README.md has it as a test of pytest.
"""
import json
import struct
import sys

OFF, READY, DRIVING, EMERGENCY, FINISHED = 1, 2, 3, 4, 5
NOT_SELECTED, SELECTED, RUNNING, DONE = 0, 1, 2, 3
CYCLE_S, RPM_TO_MPS, GIVE_UP_S = 0.01, 2 * 3.14159 * 0.25 / 60, 0.05


class Can:
    """What the VCU said last, and the frames of what is said to it."""

    def __init__(self, edition="4.0"):
        self.length = 8 if edition == "3.0" else 0  # in 3.0 all that the VCU reads has 8 bytes
        self.heard, self.handshake, self.state, self.mission, self.rpm, self.silent_s = False, 0, OFF, 0, (0,) * 4, 0.0

    def receive(self, frames):
        self.silent_s += CYCLE_S
        for identifier, data in frames:
            if identifier == 0x520:
                self.heard, self.silent_s = True, 0.0
                self.handshake, self.state, self.mission = data[0] & 1, data[2] & 15, data[2] >> 4
                self.state = self.state or OFF  # the vehicle of 2026 has an AS_INIT
            elif identifier == 0x525:
                self.rpm = struct.unpack("<4H", data)

    def frames(self, status, forward, torque_nm, motor_rpm, steer_deg, brake_pct, speed_mps):
        if not self.heard:
            return []
        drive = struct.pack("<HH", int(10 * torque_nm), motor_rpm)
        messages = {
            0x510: bytes([self.handshake, status << 4 | forward << 6, 0, 0, 0, 0, int(speed_mps * 3.6), 0]),
            0x511: drive,
            0x512: drive,
            0x513: struct.pack("<h", int(10 * steer_deg)),
            0x514: bytes([2 * brake_pct] * 2),
        }
        return [(0x501, bytes(6))] + [(one, data.ljust(self.length, b"\0")) for one, data in messages.items()]


class Controller:
    """Torque for a speed, and the brake for a stop."""

    def control(self, speed_mps, wanted_mps):
        if wanted_mps == 0:
            return 0.0, 0, 50
        return min(60.0, max(0.0, 40.0 * (wanted_mps - speed_mps))), 1500, 0


class Mission:
    """Twenty metres, then a stop. What is around the car a real stack would ask its perception."""

    def __init__(self):
        self.driven_m, self.rest_s, self.status = 0.0, 0.0, NOT_SELECTED

    def step(self, can, speed_mps):
        """The mission status, and the speed that is wanted; None where nothing is requested."""
        if can.state in (OFF, READY):
            self.__init__()
            return SELECTED if can.mission else NOT_SELECTED, None
        if can.state != DRIVING:
            return (DONE, 0) if can.state == FINISHED else (NOT_SELECTED, None)
        self.driven_m += speed_mps * CYCLE_S
        if self.driven_m < 20 and can.silent_s < GIVE_UP_S:
            return RUNNING, 4
        self.driven_m = 20.0
        self.rest_s = self.rest_s + CYCLE_S if max(can.rpm) < 10 else 0.0
        return (DONE if self.rest_s > 0.5 else RUNNING), 0


class Stack:
    """All of it: asked every 10 ms for the frames that it sends, with those that have come since."""

    def __init__(self, edition="4.0"):
        self.can, self.controller, self.mission = Can(edition), Controller(), Mission()

    def step(self, t_ms, frames):
        self.can.receive(frames)
        speed = sum(self.can.rpm) / 4 * RPM_TO_MPS
        status, wanted = self.mission.step(self.can, speed)
        torque, motor, brake = self.controller.control(speed, wanted) if wanted is not None else (0.0, 0, 0)
        forward = int(self.can.state == DRIVING)
        return self.can.frames(status, forward, torque, motor, 0.0, brake, speed)


def read(texts):
    """Frames from the text of the protocol."""
    frames = [text.split("#") for text in texts]
    return [(int(identifier, 16), bytes.fromhex(data)) for identifier, data in frames]


def written(frames):
    """And to it."""
    return [f"{identifier:03X}#{data.hex().upper()}" for identifier, data in frames]


def main():
    for line in sys.stdin:
        asked = json.loads(line)
        if asked["op"] == "hello":
            edition = asked["edition"]
            answer = {"edition": edition} if edition in ("3.0", "4.0", "2026") else {}
        elif asked["op"] == "reset":
            stack, answer = Stack(edition), {}
        else:
            answer = {"frames": written(stack.step(asked["t_ms"], read(asked["frames"])))}
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
