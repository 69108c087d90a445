#!/usr/bin/env python3
"""The exam of a ROS 2 stack: takes the place of the CAN node, topics at one side and the exam at the other. docs/exam-ros2.md is about it.

    adsdv exam --stdio --timeout 60 --edition 2026 -- python3 exam/examples/ros2_bridge.py
    adsdv exam --stdio --edition 2026 -- python3 exam/examples/ros2_bridge.py --without-ros     # a node within this program
"""
import json
import math
import sys
import time

from stack import CYCLE_S, DONE, DRIVING, FINISHED, GIVE_UP_S, NOT_SELECTED, OFF, READY, RPM_TO_MPS, RUNNING, SELECTED
from stack import Can, read, written

EDITIONS = ("4.0", "2026")
STATES = {1: "OFF", 2: "READY", 3: "DRIVING", 4: "EMERGENCY_BRAKE", 5: "FINISHED"}
# The topics: change them to those of your stack.
STATE, SPEED, COMMAND, COMPLETED, RESET = (
    "/ros_can/state_str", "/ros_can/speed", "/cmd", "/ros_can/mission_completed", "/adsdv_exam/reset")
# The vehicle: what a command for an acceleration comes to.
MASS_KG, WHEEL_M, FULL_BRAKING_MPS2, MOST_NM, MOTOR_RPM = 180.0, 0.25, 8.0, 60.0, 1500
# A node that commands nothing for so long is lost, and in so much real time it has answered.
COMMAND_LOST_S, PATIENCE_S = 0.2, 0.02


class Bridge:
    """Between topics and frames. It knows nothing of ROS."""

    def __init__(self):
        self.can = Can()
        self.acceleration, self.steer_deg, self.commanded_s, self.completed, self.rest_s = 0.0, 0.0, 0.0, False, 0.0

    def hear(self, frames):
        """The frames of 10 ms: what the topics are to say."""
        self.can.receive(frames)
        self.commanded_s += CYCLE_S
        if self.can.state in (OFF, READY):
            self.acceleration, self.steer_deg, self.commanded_s, self.completed, self.rest_s = 0.0, 0.0, 0.0, False, 0.0
        return {"state": STATES.get(self.can.state, "OFF"), "mission": self.can.mission, "speed_mps": self.speed()}

    def speed(self):
        return sum(self.can.rpm) / 4 * RPM_TO_MPS

    def command(self, acceleration_mps2, steer_rad):
        """What the stack asks for, as an AckermannDrive has it."""
        self.acceleration, self.steer_deg, self.commanded_s = acceleration_mps2, math.degrees(steer_rad), 0.0

    def complete(self):
        """The mission is at its end: the car is to stop, and then to say so."""
        self.completed = True

    def frames(self):
        """What the AI Computer sends."""
        can = self.can
        if can.state != DRIVING:
            waits = SELECTED if can.mission and can.state in (OFF, READY) else NOT_SELECTED
            stopped = can.state == FINISHED
            return can.frames(DONE if stopped else waits, 0, 0.0, 0, 0.0, 50 if stopped else 0, self.speed())
        lost = can.silent_s >= GIVE_UP_S or self.commanded_s >= COMMAND_LOST_S
        self.completed = self.completed or can.silent_s >= GIVE_UP_S
        acceleration = -4.0 if lost or self.completed else self.acceleration
        self.rest_s = self.rest_s + CYCLE_S if self.completed and max(can.rpm) < 10 else 0.0
        status = DONE if self.rest_s > 0.5 else RUNNING
        torque = min(MOST_NM, max(0.0, acceleration) * MASS_KG * WHEEL_M / 2)
        brake = round(min(100.0, 100.0 * max(0.0, -acceleration) / FULL_BRAKING_MPS2))
        steer = min(21.0, max(-21.0, self.steer_deg))
        return can.frames(status, 1, torque, MOTOR_RPM if torque else 0, steer, brake, self.speed())


class Within:
    """A node within this program: twenty metres straight on."""

    def __init__(self, bridge):
        self.bridge = bridge
        self.reset()

    def reset(self):
        self.driven_m = 0.0

    def step(self, _, heard):
        if heard["state"] != "DRIVING":
            return self.reset()
        self.driven_m += heard["speed_mps"] * CYCLE_S
        self.bridge.command(min(2.0, 4.0 - heard["speed_mps"]), 0.0)
        if self.driven_m > 20:
            self.bridge.complete()


class Ros:
    """The nodes of a stack, which go by the time of /clock (use_sim_time)."""

    def __init__(self, bridge):
        import rclpy
        from ackermann_msgs.msg import AckermannDriveStamped
        from rosgraph_msgs.msg import Clock
        from std_msgs.msg import Bool, Empty, Float64, String

        rclpy.init()
        self.bridge, self.rclpy, self.node, self.begun_ms, self.now_ms = bridge, rclpy, rclpy.create_node("adsdv_exam"), 0, 0
        self.messages = Clock, String, Float64, Empty
        self.clock = self.node.create_publisher(Clock, "/clock", 10)
        self.state = self.node.create_publisher(String, STATE, 10)
        self.speed = self.node.create_publisher(Float64, SPEED, 10)
        self.resets = self.node.create_publisher(Empty, RESET, 10)
        self.node.create_subscription(AckermannDriveStamped, COMMAND, self.commanded, 10)
        self.node.create_subscription(Bool, COMPLETED, lambda said: said.data and bridge.complete(), 10)

    def commanded(self, said):
        self.answered = True
        self.bridge.command(said.drive.acceleration, said.drive.steering_angle)

    def reset(self):
        self.begun_ms = self.now_ms  # the time of /clock never goes back
        self.resets.publish(self.messages[3]())

    def step(self, time_ms, heard):
        clock, string, number, _ = self.messages
        self.now_ms, self.answered = self.begun_ms + time_ms, False
        now = clock()
        now.clock.sec, now.clock.nanosec = self.now_ms // 1000, self.now_ms % 1000 * 1000000
        self.clock.publish(now)
        self.state.publish(string(data=f"AS:{heard['state']} AMI:{heard['mission']}"))
        self.speed.publish(number(data=heard["speed_mps"]))
        late = time.monotonic() + PATIENCE_S
        while not self.answered and time.monotonic() < late:
            self.rclpy.spin_once(self.node, timeout_sec=max(0.0, late - time.monotonic()))


def main():
    bridge = Bridge()
    nodes = (Within if "--without-ros" in sys.argv else Ros)(bridge)
    for line in sys.stdin:
        asked = json.loads(line)
        if asked["op"] == "hello":
            answer = {"edition": asked["edition"] if asked["edition"] in EDITIONS else EDITIONS[0]}
        elif asked["op"] == "reset":
            bridge.__init__()
            nodes.reset()
            answer = {}
        else:
            nodes.step(asked["t_ms"], bridge.hear(read(asked["frames"])))
            answer = {"frames": written(bridge.frames())}
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
