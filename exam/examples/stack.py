#!/usr/bin/env python3
"""An AI Computer in the shape of a team's stack: mission logic, controller, CAN layer. For 4.0 and the vehicle of 2026.

    adsdv exam --stdio -- python3 exam/examples/stack.py
"""
import json
import struct
import sys

OFF, READY, DRIVING, EMERGENCY, FINISHED = 1, 2, 3, 4, 5
NOT_SELECTED, SELECTED, RUNNING, DONE = 0, 1, 2, 3
CYCLE_S, RPM_TO_MPS, GIVE_UP_S = 0.01, 2 * 3.14159 * 0.25 / 60, 0.05


class Can:
    """What the VCU said last, and the frames of what is said to it."""

    def __init__(self):
        self.heard, self.handshake, self.state, self.mission, self.rpm, self.silent_s = False, 0, OFF, 0, (0,) * 4, 0.0

    def receive(self, frames):
        self.silent_s += CYCLE_S
        for frame in frames:
            identifier, data = frame.split("#")
            data = bytes.fromhex(data)
            if identifier == "520":
                self.heard, self.silent_s = True, 0.0
                self.handshake, self.state, self.mission = data[0] & 1, data[2] & 15, data[2] >> 4
                self.state = self.state or OFF  # the vehicle of 2026 has an AS_INIT
            elif identifier == "525":
                self.rpm = struct.unpack("<4H", data)

    def frames(self, status, forward, torque_nm, motor_rpm, steer_deg, brake_pct, speed_mps):
        if not self.heard:
            return []
        drive = struct.pack("<HH", int(10 * torque_nm), motor_rpm)
        messages = {
            "501": bytes(6),
            "510": bytes([self.handshake, status << 4 | forward << 6, 0, 0, 0, 0, int(speed_mps * 3.6), 0]),
            "511": drive,
            "512": drive,
            "513": struct.pack("<h", int(10 * steer_deg)),
            "514": bytes([2 * brake_pct] * 2),
        }
        return [f"{identifier}#{data.hex().upper()}" for identifier, data in messages.items()]


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


def main():
    for line in sys.stdin:
        asked = json.loads(line)
        if asked["op"] == "hello":
            answer = {"edition": asked["edition"] if asked["edition"] in ("4.0", "2026") else "4.0"}
        elif asked["op"] == "reset":
            can, controller, mission, answer = Can(), Controller(), Mission(), {}
        else:
            can.receive(asked["frames"])
            speed = sum(can.rpm) / 4 * RPM_TO_MPS
            status, wanted = mission.step(can, speed)
            torque, motor, brake = controller.control(speed, wanted) if wanted is not None else (0.0, 0, 0)
            forward = int(can.state == DRIVING)
            answer = {"frames": can.frames(status, forward, torque, motor, 0.0, brake, speed)}
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
