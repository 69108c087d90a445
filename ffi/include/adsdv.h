/* The executable specification of the ADS-DV AI/VCU interface (ADS-DV Software Interface Specification) as a C library.
 * Made by cbindgen from the sources of adsdv-ffi; do not edit.
 *
 * - Editions: adsdv_edition_find has the edition of a version such as "4.0". Where the name of a function ends in `_in`, it
 *   is about the edition that it is given; the function without that is about the default, 3.0. A VCU is of the edition of
 *   its adsdv_machine, and a judge of that of its options.
 * - Memory: the caller owns every struct, and hands over pointers to them. Nothing is allocated but by adsdv_judge_new,
 *   adsdv_recogniser_new and what they make, which adsdv_judge_free and adsdv_recogniser_free free. A pointer must be NULL
 *   or point to as much as its type and comment say; texts end with a NUL.
 * - Errors: a function answers an adsdv_status, 0 for success, and says in an adsdv_error, where one is given, what was
 *   found and what was expected. NULL and fields with any value at all are errors, never undefined behaviour.
 * - Threads: every function may be called from any thread at any time, but a struct, a judge or a recogniser that a call
 *   writes must not be used by another thread meanwhile.
 * - The library never ends the program, prints nothing, and calls nothing back.
 */

#ifndef ADSDV_H
#define ADSDV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The size of the text of an error, with the NUL at its end.
#define ADSDV_ERROR_TEXT 508

// How many frames the VCU of the default edition sends after a step.
#define ADSDV_VCU_FRAMES 9

// Room for the frames that the VCU of any edition sends after a step.
#define ADSDV_MOST_VCU_FRAMES 16

// How many messages the default edition has; adsdv_message_count has those of others.
#define ADSDV_MESSAGES 15

// Room for the signals of any message of any edition.
#define ADSDV_MOST_SIGNALS 32

// How many choices the default edition leaves, of all readings together; adsdv_reading_count has those of others.
#define ADSDV_CHOICES 26

// What a function answers. 0 is success; a function that fails changes nothing but the error, unless its comment says so.
typedef enum adsdv_status {
    // It did what it says.
    ADSDV_OK = 0,
    // A pointer that must not be NULL is, or one is not aligned as its type must be.
    ADSDV_BAD_POINTER = 1,
    // A field of a struct, a signal or an argument has a value that it cannot have.
    ADSDV_BAD_VALUE = 2,
    // There is nothing of that name in the edition: no reading, choice, signal or value.
    ADSDV_UNKNOWN_NAME = 3,
    // No message of the edition has that identifier.
    ADSDV_UNKNOWN_ID = 4,
    // A frame has fewer bytes than the signal or the message needs.
    ADSDV_TOO_SHORT = 5,
    // An array that is to be filled has too few places.
    ADSDV_NO_ROOM = 6,
    // The judge has finished: it takes no more frames.
    ADSDV_FINISHED = 7,
    // A mistake in this library. The object concerned can only be freed.
    ADSDV_INTERNAL = 8,
    // There is no edition of the interface with that version or number.
    ADSDV_UNKNOWN_EDITION = 9,
    // A text of rules is wrong, or they name what the edition has not.
    ADSDV_BAD_RULES = 10,
} adsdv_status;

// State of the Autonomous System (AS_STATE of 520h).
typedef enum adsdv_as_state {
    // AS_OFF
    ADSDV_AS_OFF = 1,
    // AS_READY
    ADSDV_AS_READY = 2,
    // AS_DRIVING
    ADSDV_AS_DRIVING = 3,
    // EMERGENCY_BRAKE
    ADSDV_AS_EMERGENCY_BRAKE = 4,
    // AS_FINISHED
    ADSDV_AS_FINISHED = 5,
} adsdv_as_state;

// State of the Mission Indicator (AMI_STATE of 520h).
typedef enum adsdv_ami_state {
    // NOT_SELECTED
    ADSDV_AMI_NOT_SELECTED = 0,
    // ACCELERATION
    ADSDV_AMI_ACCELERATION = 1,
    // SKIDPAD
    ADSDV_AMI_SKIDPAD = 2,
    // AUTOCROSS
    ADSDV_AMI_AUTOCROSS = 3,
    // TRACK_DRIVE
    ADSDV_AMI_TRACK_DRIVE = 4,
    // STATIC_INSPECTION_A
    ADSDV_AMI_STATIC_INSPECTION_A = 5,
    // STATIC_INSPECTION_B
    ADSDV_AMI_STATIC_INSPECTION_B = 6,
    // AUTONOMOUS_DEMO
    ADSDV_AMI_AUTONOMOUS_DEMO = 7,
} adsdv_ami_state;

// State of the Emergency Braking System (State_EBS of 502h).
typedef enum adsdv_ebs_state {
    // UNAVAILABLE
    ADSDV_EBS_UNAVAILABLE = 1,
    // ARMED
    ADSDV_EBS_ARMED = 2,
    // TRIGGERED
    ADSDV_EBS_TRIGGERED = 3,
} adsdv_ebs_state;

// Status of the mission, as the AI Computer says it (MISSION_STATUS of 510h).
typedef enum adsdv_mission_status {
    // NOT SELECTED
    ADSDV_MISSION_NOT_SELECTED = 0,
    // SELECTED
    ADSDV_MISSION_SELECTED = 1,
    // RUNNING
    ADSDV_MISSION_RUNNING = 2,
    // FINISHED
    ADSDV_MISSION_FINISHED = 3,
} adsdv_mission_status;

// Direction of driving (DIRECTION_REQUEST of 510h).
typedef enum adsdv_direction {
    // NEUTRAL
    ADSDV_DIRECTION_NEUTRAL = 0,
    // FORWARD
    ADSDV_DIRECTION_FORWARD = 1,
} adsdv_direction;

// State of the service brake (State_ServiceBrake of 502h).
typedef enum adsdv_service_brake {
    // DISENGAGED
    ADSDV_SERVICE_BRAKE_DISENGAGED = 1,
    // ENGAGED
    ADSDV_SERVICE_BRAKE_ENGAGED = 2,
    // AVAILABLE
    ADSDV_SERVICE_BRAKE_AVAILABLE = 3,
} adsdv_service_brake;

// Fault that shut the system down first (SHUTDOWN_CAUSE of 520h).
typedef enum adsdv_shutdown_cause {
    // NO SHUTDOWN
    ADSDV_CAUSE_NO_SHUTDOWN = 0,
    // AI COMPUTER REQUEST
    ADSDV_CAUSE_AI_COMPUTER_REQUEST = 1,
    // HVIL OPEN FAULT
    ADSDV_CAUSE_HVIL_OPEN_FAULT = 2,
    // HVIL SHORT FAULT
    ADSDV_CAUSE_HVIL_SHORT_FAULT = 3,
    // EBS FAULT
    ADSDV_CAUSE_EBS_FAULT = 4,
    // OFFBOARD CHARGER FAULT
    ADSDV_CAUSE_OFFBOARD_CHARGER_FAULT = 5,
    // AI COMMS FAULT
    ADSDV_CAUSE_AI_COMMS_FAULT = 6,
    // AUTONOMOUS BRAKING FAULT
    ADSDV_CAUSE_AUTONOMOUS_BRAKING_FAULT = 7,
    // MISSION STATUS FAULT
    ADSDV_CAUSE_MISSION_STATUS_FAULT = 8,
    // CHARGE PROCEDURE FAULT
    ADSDV_CAUSE_CHARGE_PROCEDURE_FAULT = 9,
    // BMS FAULT
    ADSDV_CAUSE_BMS_FAULT = 10,
    // BRAKE PLAUSIBILITY FAULT, since version 4.0
    ADSDV_CAUSE_BRAKE_PLAUSIBILITY_FAULT = 11,
} adsdv_shutdown_cause;

// The enumerations of the interface. Their numbers say the same in all editions; their names need not.
typedef enum adsdv_enumeration {
    // See adsdv_as_state.
    ADSDV_AS_STATE = 0,
    // See adsdv_ami_state.
    ADSDV_AMI_STATE = 1,
    // See adsdv_ebs_state.
    ADSDV_EBS_STATE = 2,
    // See adsdv_mission_status.
    ADSDV_MISSION_STATUS = 3,
    // See adsdv_direction.
    ADSDV_DIRECTION = 4,
    // See adsdv_service_brake.
    ADSDV_SERVICE_BRAKE = 5,
    // See adsdv_shutdown_cause.
    ADSDV_SHUTDOWN_CAUSE = 6,
} adsdv_enumeration;

// How much a finding weighs.
typedef enum adsdv_severity {
    // Against the document, under every reading that is not excluded.
    ADSDV_VIOLATION = 0,
    // Not against the document, or only under some readings; worth a look.
    ADSDV_WARNING = 1,
    // A fact about what was recorded.
    ADSDV_NOTE = 2,
} adsdv_severity;

// What a rule came to.
typedef enum adsdv_rule_verdict {
    // It was kept at least once, and never seen broken.
    ADSDV_RULE_HOLDS = 0,
    // It was broken.
    ADSDV_RULE_BROKEN = 1,
    // The recording does not decide it, or there was nothing to keep it in.
    ADSDV_RULE_UNDECIDED = 2,
} adsdv_rule_verdict;

// A judge of one bus. It is made by adsdv_judge_new and freed by adsdv_judge_free.
typedef struct adsdv_judge adsdv_judge;

// What takes down of the frames of one bus which edition they are of. It is made by adsdv_recogniser_new and freed by
// adsdv_recogniser_free.
typedef struct adsdv_recogniser adsdv_recogniser;

// An edition of the interface by its number, which counts from 0, the oldest first. adsdv_edition_find has it. A number is
// this library's; what is to be kept for another is the version.
typedef uint32_t adsdv_edition;

// What went wrong, in words. A function writes it when it fails, and leaves it alone otherwise. Wherever a function
// takes one, NULL may be given instead.
typedef struct adsdv_error {
    // The status that the function answered, an adsdv_status.
    int32_t status;
    // What was found and what was expected, such as "inputs.asms is 7; expected 0 or 1". UTF-8, with a NUL at its end.
    char text[ADSDV_ERROR_TEXT];
} adsdv_error;

// A VCU: an edition of the interface with an answer to every question that it leaves open. It is eight bytes that can be
// copied, compared and kept.
typedef struct adsdv_machine {
    // The edition.
    adsdv_edition edition;
    // The readings; adsdv_machine_init and adsdv_machine_init_in write them.
    uint32_t readings;
} adsdv_machine;

// What the VCU remembers between two steps. Flags are 0 or 1. It can be copied, compared and kept like any struct.
typedef struct adsdv_control {
    // The state of Figure 2: an adsdv_as_state.
    uint8_t state;
    // AS_READY only: the "Go" switch was seen off, so that a rising edge is accepted.
    uint8_t go_seen_low;
    // AS_DRIVING only, where changes count (fault-trigger=edge): MISSION_STATUS was RUNNING.
    uint8_t was_running;
    // AS_DRIVING only, where changes count (fault-trigger=edge): DIRECTION_REQUEST was FORWARD.
    uint8_t was_forward;
    // The handshake was performed at the last step.
    uint8_t handshake_active;
    // The HANDSHAKE bit that the VCU sends.
    uint8_t handshake_bit;
    // The vehicle must be power-cycled before it can drive again.
    uint8_t power_cycle_needed;
    // The fault that shut the vehicle down first: an adsdv_shutdown_cause.
    uint8_t shutdown_cause;
    // How long the state has lasted, in ms, as far as that matters.
    uint16_t in_state_ms;
    // For how long the HANDSHAKE bit has been unanswered, in ms; it stops counting at the limit.
    uint16_t handshake_unanswered_ms;
} adsdv_control;

// Everything that the VCU sees at one step. Flags are 0 or 1; numbers are raw, in steps of their signal, as on the bus.
// adsdv_inputs_init sets it to a vehicle with everything off, at rest, without a fault; not all of that is 0.
typedef struct adsdv_inputs {
    // The Autonomous System Master Switch is on.
    uint8_t asms;
    // The Tractive System Master Switch is on.
    uint8_t tsms;
    // The mission selected on the Autonomous Mission Indicator: an adsdv_ami_state.
    uint8_t ami;
    // The state of the Emergency Braking System, as it reports it: an adsdv_ebs_state.
    uint8_t ebs;
    // The remote "Go" switch is on.
    uint8_t go;
    // Opens the shutdown circuit (section 3.5): the remote E-stop button is pressed.
    uint8_t remote_estop;
    // Opens the shutdown circuit: the remote E-stop receiver has lost the transmitter.
    uint8_t res_link_lost;
    // Opens the shutdown circuit: an E-stop button on the vehicle is pressed.
    uint8_t vehicle_estop;
    // Opens the shutdown circuit: the inertial crash sensor is activated.
    uint8_t crash_sensor;
    // Opens the shutdown circuit: the VCU detects a critical system fault that has no flag of its own.
    uint8_t critical_fault;
    // Opens the shutdown circuit: the BMS detects a critical fault in the traction battery.
    uint8_t bms_fault;
    // Opens the shutdown circuit: the autonomous driving dongle is not in the Multi-Purpose Port.
    uint8_t mpp_dongle_removed;
    // Reported: HVIL or the shutdown circuit has an open circuit.
    uint8_t hvil_open;
    // Reported: HVIL or the shutdown circuit has a short circuit.
    uint8_t hvil_short;
    // Reported: the Emergency Braking System is faulty.
    uint8_t ebs_fault;
    // Reported: the off-board charger is faulty.
    uint8_t offboard_charger_fault;
    // Reported: the battery is being charged; a fault as soon as ASMS or TSMS is on.
    uint8_t charging;
    // Reported: the traction battery is hot (a warning).
    uint8_t batt_temp_high;
    // Reported: the traction battery's charge is low (a warning).
    uint8_t batt_soc_low;
    // AI Computer, 510h: the answer to the VCU's HANDSHAKE bit.
    uint8_t handshake;
    // AI Computer, 510h: it asks for an emergency stop.
    uint8_t estop_request;
    // AI Computer, 510h: status of the mission, an adsdv_mission_status.
    uint8_t mission_status;
    // AI Computer, 510h: requested direction, an adsdv_direction.
    uint8_t direction_request;
    // AI Computer, 510h: laps; for the data logger.
    uint8_t lap_counter;
    // AI Computer, 510h: cones detected now; for the data logger.
    uint8_t cones_count_actual;
    // AI Computer, 510h: actual speed in km/h; for the data logger.
    uint8_t veh_speed_actual;
    // AI Computer, 510h: demanded speed in km/h; for the data logger.
    uint8_t veh_speed_demand;
    // AI Computer, 514h: requested front brake pressure, in 0.5 %.
    uint8_t hyd_press_f_req;
    // AI Computer, 514h: requested rear brake pressure, in 0.5 %.
    uint8_t hyd_press_r_req;
    // Measured: the hydraulic pressure of the front brakes, in 0.5 %.
    uint8_t hyd_press_f;
    // Measured: the hydraulic pressure of the rear brakes, in 0.5 %.
    uint8_t hyd_press_r;
    // Measured: the speed of the vehicle, in km/h.
    uint8_t speed;
    // AI Computer, 510h: cones detected in all; for the data logger.
    uint16_t cones_count_all;
    // AI Computer, 511h: requested front axle torque, in 0.1 Nm.
    uint16_t front_axle_trq_request;
    // AI Computer, 511h: front motor speed limit, in rpm.
    uint16_t front_motor_speed_max;
    // AI Computer, 512h: requested rear axle torque, in 0.1 Nm.
    uint16_t rear_axle_trq_request;
    // AI Computer, 512h: rear motor speed limit, in rpm.
    uint16_t rear_motor_speed_max;
    // AI Computer, 513h: requested steer angle, positive to the left, in 0.1 degrees.
    int16_t steer_request;
    // For how long there has been no valid 510h, in milliseconds; version 3.0 does not look at it.
    uint16_t status_silence_ms;
    // For how long there has been no valid 511h, in milliseconds; version 3.0 does not look at it.
    uint16_t drive_f_silence_ms;
    // For how long there has been no valid 512h, in milliseconds; version 3.0 does not look at it.
    uint16_t drive_r_silence_ms;
    // For how long there has been no valid 513h, in milliseconds; version 3.0 does not look at it.
    uint16_t steer_silence_ms;
    // For how long there has been no valid 514h, in milliseconds; version 3.0 does not look at it.
    uint16_t brake_silence_ms;
    // Measured: the steer angle, positive to the left, in 0.1 degrees.
    int16_t steer_angle;
    // The largest steer angle that is allowed, in 0.1 degrees.
    uint16_t steer_angle_max;
    // Measured: front left wheel speed, in rpm.
    uint16_t fl_wheel_speed;
    // Measured: front right wheel speed, in rpm.
    uint16_t fr_wheel_speed;
    // Measured: rear left wheel speed, in rpm.
    uint16_t rl_wheel_speed;
    // Measured: rear right wheel speed, in rpm.
    uint16_t rr_wheel_speed;
    // Measured: front left wheel speed pulse count.
    uint16_t fl_pulse_count;
    // Measured: front right wheel speed pulse count.
    uint16_t fr_pulse_count;
    // Measured: rear left wheel speed pulse count.
    uint16_t rl_pulse_count;
    // Measured: rear right wheel speed pulse count.
    uint16_t rr_pulse_count;
    // Measured: the drive torque at the front axle, in 0.1 Nm; negative brakes.
    int16_t front_axle_trq;
    // Measured: the drive torque at the rear axle, in 0.1 Nm; negative brakes.
    int16_t rear_axle_trq;
    // The largest drive torque that is allowed at the front axle, in 0.1 Nm.
    uint16_t front_axle_trq_max;
    // The largest drive torque that is allowed at the rear axle, in 0.1 Nm.
    uint16_t rear_axle_trq_max;
} adsdv_inputs;

// A classic CAN data frame with an 11-bit identifier.
typedef struct adsdv_frame {
    // The identifier.
    uint16_t id;
    // How many bytes of `data` are sent: 0 to 8.
    uint8_t len;
    // The data.
    uint8_t data[8];
} adsdv_frame;

// What a step shows to the outside: the signals of 520h, what reaches the actuators, and which arrow of Figure 2 was
// taken. Flags are 0 or 1; numbers are raw, in steps of their signal, as on the bus.
typedef struct adsdv_outputs {
    // 520h: the state, an adsdv_as_state.
    uint8_t as_state;
    // 520h: the HANDSHAKE bit that the AI Computer is to send back.
    uint8_t handshake;
    // 520h: GO_SIGNAL.
    uint8_t go_signal;
    // 520h: the steering is active.
    uint8_t steering_status;
    // 520h: the VCU asks the AI Computer to shut down.
    uint8_t shutdown_request;
    // 520h: the Autonomous System Master Switch is on.
    uint8_t as_switch_status;
    // 520h: the Tractive System Master Switch is on.
    uint8_t ts_switch_status;
    // 520h: the mission that is selected, an adsdv_ami_state.
    uint8_t ami_state;
    // 520h: the fault that shut the system down, an adsdv_shutdown_cause.
    uint8_t shutdown_cause;
    // 520h: one of the faults is there.
    uint8_t fault_status;
    // 520h: one of the warnings is there.
    uint8_t warning_status;
    // 520h: what the vehicle is operated for, the number of OP_STATE. Sent since 2026.
    uint8_t op_state;
    // 520h: the state of the tractive system, the number of TS_STATE. Sent since 2026.
    uint8_t ts_state;
    // 520h: the stage of the EBS, the number of EBS_STATE. Sent since 2026.
    uint8_t ebs_state;
    // 520h, warning: the traction battery is hot.
    uint8_t warn_batt_temp_high;
    // 520h, warning: the traction battery's charge is low.
    uint8_t warn_batt_soc_low;
    // 520h, fault: the AI Computer asks for an emergency stop.
    uint8_t ai_estop_request;
    // 520h, fault: the shutdown circuit or HVIL is open.
    uint8_t hvil_open_fault;
    // 520h, fault: the shutdown circuit or HVIL has a short circuit.
    uint8_t hvil_short_fault;
    // 520h, fault: the Emergency Braking System is faulty.
    uint8_t ebs_fault;
    // 520h, fault: the off-board charger is faulty.
    uint8_t offboard_charger_fault;
    // 520h, fault: the AI Computer does not answer the handshake.
    uint8_t ai_comms_lost;
    // 520h, fault: NEUTRAL was requested while the vehicle was moving.
    uint8_t autonomous_braking_fault;
    // 520h, fault: FINISHED was declared while the vehicle was moving.
    uint8_t mission_status_fault;
    // 520h, fault: a master switch is on while the battery is being charged.
    uint8_t charge_procedure_fault;
    // 520h, fault: the battery management system reports a critical fault.
    uint8_t bms_fault;
    // 520h, fault: torque and hydraulic braking were requested at once, since version 4.0.
    uint8_t brake_plausibility_fault;
    // Actuators: the direction of driving, an adsdv_direction.
    uint8_t direction;
    // Actuators: the drive torque of the front axle, in 0.1 Nm.
    uint16_t front_axle_trq;
    // Actuators: the speed limit of the front motor, in rpm.
    uint16_t front_motor_speed_max;
    // Actuators: the drive torque of the rear axle, in 0.1 Nm.
    uint16_t rear_axle_trq;
    // Actuators: the speed limit of the rear motor, in rpm.
    uint16_t rear_motor_speed_max;
    // Actuators: the steer angle to go to, in 0.1 degrees; 0 while `steer_active` is.
    int16_t steer;
    // Actuators: there is a steer angle to go to.
    uint8_t steer_active;
    // Actuators: the hydraulic pressure of the front brakes, in 0.5 %.
    uint8_t hyd_press_f;
    // Actuators: the hydraulic pressure of the rear brakes, in 0.5 %.
    uint8_t hyd_press_r;
    // Actuators: the Emergency Braking System is triggered.
    uint8_t ebs_triggered;
    // The state before the step, an adsdv_as_state.
    uint8_t from;
    // An arrow of Figure 2 was taken; all that follows is 0 if not.
    uint8_t taken;
    // Which one: the row of the table of Figure 2, from 0.
    uint8_t row;
    // Which alternative of its guard decided, from 0.
    uint8_t term;
    // The section of the document that describes the arrow, such as "3.7".
    char section[8];
    // The section that the alternative comes from.
    char term_section[8];
} adsdv_outputs;

// A message of the interface.
typedef struct adsdv_message {
    // Its name, such as "VCU2AI_Status".
    char name[32];
    // The section of the document that lists it.
    char section[8];
    // Its identifier.
    uint16_t id;
    // How many bytes it has.
    uint8_t len;
    // Who sends it: 1 for the VCU, 0 for the AI Computer.
    uint8_t from_vcu;
    // How many signals it has.
    uint8_t signals;
} adsdv_message;

// A choice: one answer to a question that the document leaves open.
typedef struct adsdv_reading {
    // As adsdv_machine_init_in reads it, such as "fault-trigger=edge".
    char name[48];
    // The answer in words.
    char text[48];
    // The question in words.
    char question[128];
    // The sections that raise it.
    char section[16];
    // Whether it is what is read where nothing else is said.
    uint8_t is_default;
} adsdv_reading;

// A signal, and what a frame says of it.
typedef struct adsdv_signal {
    // Its name, such as "STEER_ANGLE_deg".
    char name[48];
    // Its unit, such as "deg"; "" where there is none.
    char unit[8];
    // The value in words: by its name, or as a number with its unit, such as "AS_READY" or "-4.9 deg".
    char text[32];
    // The value in its unit, for display and plotting.
    double physical;
    // The value in steps of the signal: what is compared, and what is on the bus.
    int32_t raw;
    // The lowest raw value that is allowed.
    int32_t min;
    // The highest raw value that is allowed. An enumeration need not have all between.
    int32_t max;
    // A step of the signal is `scale_num` / `scale_den` of its unit.
    uint32_t scale_num;
    // See `scale_num`; never 0.
    uint32_t scale_den;
    // The lowest bit of the signal; bit 0 is the lowest of the first byte.
    uint8_t start;
    // How many bits it has.
    uint8_t width;
    // Whether the frame is long enough for the signal. If not, `raw` and `physical` are 0 and `text` is empty.
    uint8_t present;
    // Whether it is there and the document allows its value.
    uint8_t allowed;
} adsdv_signal;

// Which edition the frames fit best, and why.
typedef struct adsdv_recognised {
    // The edition; where the frames do not tell, the one that the recogniser was made with.
    adsdv_edition edition;
    // 1 if it fits better than every other, 0 if another fits as well.
    uint8_t certain;
    // The edition and what tells it, such as "version 4.0: 511h has 4 bytes (3.0: 8)"; behind "but", what does not fit it. The
    // text is the recogniser's; it stays until the next call with it.
    const char *text;
} adsdv_recognised;

// What the judge may assume. adsdv_judge_options_init sets what it assumes where nothing else is said.
typedef struct adsdv_judge_options {
    // How long after a cause its effect may be seen, in ms: the cycle of the VCU and the delay of the bus.
    uint32_t window_ms;
    // For how long a condition must hold before a missing effect is a violation, in ms.
    uint32_t deadline_ms;
    // The edition of the interface to judge by; it is not recognised.
    adsdv_edition edition;
    // How the VCU is known to read the document, as for adsdv_machine_init_in; NULL if nothing is known. A violation is
    // what is one under all readings that are possible.
    const char *readings;
} adsdv_judge_options;

// One thing that the judge found.
typedef struct adsdv_finding {
    // When, in nanoseconds, on the clock of the frames.
    int64_t t_ns;
    // What was seen and what was expected instead. The text is the judge's; it stays until the next call with it.
    const char *message;
    // How much it weighs, an adsdv_severity.
    uint8_t severity;
    // "violation", "warning" or "note".
    char severity_name[12];
    // Who is at fault: "AI", "VCU", or "LOG" for nobody; "OWN" where a rule of adsdv_judge_follow was broken.
    char party[4];
    // The section of the document, or the line of the user's own rules, as "line 3".
    char section[12];
    // What was checked: a stable name such as "transition-due".
    char rule[32];
} adsdv_finding;

// What all of it comes to.
typedef struct adsdv_report {
    // How many frames there were.
    uint64_t frames;
    // How many violations; none means that what was judged keeps to the document.
    uint64_t violations;
    // How many warnings.
    uint64_t warnings;
    // How many notes.
    uint64_t notes;
    // The time from the first frame to the last, in nanoseconds.
    int64_t duration_ns;
} adsdv_report;

// Where a text of rules is wrong.
typedef struct adsdv_rule_place {
    // The line, from 1.
    uint32_t line;
    // The character in it where the trouble begins, from 1.
    uint32_t column;
    // How many characters are meant, at least 1.
    uint32_t width;
} adsdv_rule_place;

// What became of a rule.
typedef struct adsdv_rule_report {
    // How many times it was kept.
    uint64_t held;
    // How many times it was broken.
    uint64_t broken;
    // How many times it came up and stayed undecided.
    uint64_t undecided;
    // Its name. The texts are the judge's; they stay until the next call with it.
    const char *name;
    // What it asks for, as it is written.
    const char *rule;
    // Why it was never decided; empty where it was.
    const char *why;
    // The line that it is in, from 1.
    uint32_t line;
    // What it came to, an adsdv_rule_verdict.
    uint8_t verdict;
    // "holds", "broken" or "never decided".
    char verdict_name[16];
} adsdv_rule_report;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The version of the library, such as "0.1.0". The text is the library's, and stays.
const char *adsdv_version(void);

// The version of the ADS-DV Software Interface Specification that functions without an edition are about: "3.0". The text is
// the library's, and stays. adsdv_edition_version has the others.
const char *adsdv_document_version(void);

// How many editions of the interface there are.
uint32_t adsdv_edition_count(void);

// The version of an edition, such as "4.0"; NULL if there is no edition with that number. The text is the library's, and
// stays.
const char *adsdv_edition_version(adsdv_edition edition);

// The edition that functions without an edition are about: that of adsdv_document_version.
adsdv_edition adsdv_edition_default(void);

// The edition with this version, such as "4.0". A version that there is not is an error (ADSDV_UNKNOWN_EDITION), which names
// those that there are.
enum adsdv_status adsdv_edition_find(const char *version,
                                     adsdv_edition *edition,
                                     struct adsdv_error *error);

// The default edition's name of a value, such as "AS_READY" for 2 of ADSDV_AS_STATE; NULL if the value has none, or there is
// no such enumeration. The text is the library's, and stays.
const char *adsdv_value_name(uint32_t enumeration,
                             int32_t value);

// An edition's name of a value, likewise; NULL if there is no such edition.
const char *adsdv_value_name_in(adsdv_edition edition, uint32_t enumeration, int32_t value);

// The value of a name of the default edition, such as 2 for "AS_READY" of ADSDV_AS_STATE. The name has `length` bytes, and
// needs no NUL.
enum adsdv_status adsdv_value_of_name(uint32_t enumeration,
                                      const char *name,
                                      size_t length,
                                      int32_t *value,
                                      struct adsdv_error *error);

// The value of a name in an edition, likewise. The default edition's name for a value that the edition has is understood.
enum adsdv_status adsdv_value_of_name_in(adsdv_edition edition,
                                         uint32_t enumeration,
                                         const char *name,
                                         size_t length,
                                         int32_t *value,
                                         struct adsdv_error *error);

// A VCU of the default edition that reads the document as this list says, such as
// "fault-trigger=edge power-cycle=not-latched": readings and their choices, with spaces or commas between them. What is not in
// the list is read as the default says; NULL and "" are all defaults. adsdv_reading_at tells which there are.
enum adsdv_status adsdv_machine_init(struct adsdv_machine *machine,
                                     const char *readings,
                                     struct adsdv_error *error);

// A VCU of an edition, likewise. A choice that the edition does not leave is an error (ADSDV_UNKNOWN_NAME);
// adsdv_reading_at_in tells which there are.
enum adsdv_status adsdv_machine_init_in(adsdv_edition edition,
                                        struct adsdv_machine *machine,
                                        const char *readings,
                                        struct adsdv_error *error);

// The VCU after a power cycle: AS_OFF, nothing remembered.
enum adsdv_status adsdv_control_init(struct adsdv_control *control, struct adsdv_error *error);

// A vehicle with everything off, at rest, without a fault, and no message of the AI Computer yet.
enum adsdv_status adsdv_inputs_init(struct adsdv_inputs *inputs, struct adsdv_error *error);

// Takes over what a frame of the AI Computer (510h to 514h) says. `taken`, which may be NULL, is set to 1 if it is one,
// and to 0 if it is any other frame, which changes nothing. A frame with too few bytes or a value that is not allowed
// is an error, and changes nothing either, as if it had not come. A frame that is taken over ends the silence of its
// message; the caller adds the time that passes to each silence before the frames of a step are received. The frame is one of
// the default edition.
enum adsdv_status adsdv_receive(struct adsdv_inputs *inputs,
                                const struct adsdv_frame *frame,
                                uint8_t *taken,
                                struct adsdv_error *error);

// Takes over what a frame of the AI Computer says in an edition, likewise.
enum adsdv_status adsdv_receive_in(adsdv_edition edition,
                                   struct adsdv_inputs *inputs,
                                   const struct adsdv_frame *frame,
                                   uint8_t *taken,
                                   struct adsdv_error *error);

// Whether the AI Computer must not send frames with this identifier (section 2.3 of the default edition).
bool adsdv_is_reserved(uint32_t id);

// Whether the AI Computer must not send frames with this identifier in an edition; false if there is no such edition.
bool adsdv_is_reserved_in(adsdv_edition edition,
                          uint32_t id);

// Begins a frame of the message of the default edition with this identifier: every signal is 0, or the first value of its
// enumeration where that has no 0. adsdv_frame_set sets the others.
enum adsdv_status adsdv_frame_init(struct adsdv_frame *frame,
                                   uint16_t id,
                                   struct adsdv_error *error);

// Begins a frame of the message of an edition, likewise, as long as the edition has it.
enum adsdv_status adsdv_frame_init_in(adsdv_edition edition,
                                      struct adsdv_frame *frame,
                                      uint16_t id,
                                      struct adsdv_error *error);

// Sets a signal of a frame of the default edition, such as "STEER_REQUEST_deg" of 513h, to a raw value: in steps of the
// signal, so that -49 is -4.9 degrees. A value that the edition does not allow is an error. All other bits stay.
enum adsdv_status adsdv_frame_set(struct adsdv_frame *frame,
                                  const char *signal,
                                  int32_t raw,
                                  struct adsdv_error *error);

// Sets a signal of a frame of an edition, likewise. A name that another edition has for it is understood.
enum adsdv_status adsdv_frame_set_in(adsdv_edition edition,
                                     struct adsdv_frame *frame,
                                     const char *signal,
                                     int32_t raw,
                                     struct adsdv_error *error);

// One step of the VCU: what it does when it sees these inputs `dt_ms` milliseconds after its last step.
//
// `machine` says of which edition it is and how the document is read; NULL is the default edition with all defaults. `control`
// is what the VCU remembers, before and then after the step. What the step shows goes to `outputs`, and the frames that the
// VCU of the default edition sends, 520h to 526h, 500h and 502h, to `frames`, which has ADSDV_VCU_FRAMES places; either may be
// NULL. A machine of an edition whose VCU sends another number of frames is refused (ADSDV_NO_ROOM) unless `frames` is NULL:
// adsdv_step_frames tells how many there are.
//
// A field with a value that it cannot have in the edition is an error that names it, and nothing is changed.
enum adsdv_status adsdv_step(const struct adsdv_machine *machine,
                             struct adsdv_control *control,
                             const struct adsdv_inputs *inputs,
                             uint32_t dt_ms,
                             struct adsdv_outputs *outputs,
                             struct adsdv_frame *frames,
                             struct adsdv_error *error);

// One step, like adsdv_step, of a VCU of any edition. The frames that it sends go to `frames`, which has `room` places
// (ADSDV_MOST_VCU_FRAMES are always enough), and their number to `count`; the other places stay as they are. `outputs` may be
// NULL. Too little room is an error (ADSDV_NO_ROOM), and nothing is changed.
enum adsdv_status adsdv_step_frames(const struct adsdv_machine *machine,
                                    struct adsdv_control *control,
                                    const struct adsdv_inputs *inputs,
                                    uint32_t dt_ms,
                                    struct adsdv_outputs *outputs,
                                    struct adsdv_frame *frames,
                                    size_t room,
                                    size_t *count,
                                    struct adsdv_error *error);

// `count` steps of one VCU, one after the other: what `count` calls of adsdv_step do, in a fraction of the time.
//
// `machine` is that of adsdv_step. `control` is what the VCU remembers, before the first step and then after the last. Each step has
// a place of `inputs` and one of `dt_ms`, the milliseconds since the step before; if `dt_ms` is NULL each takes a cycle of the
// edition, 10 ms. What the VCU remembers after each step goes to `controls`, and what each step shows to `outputs`. They have
// `count` places each, or are NULL: what is not wanted takes no time. No array may overlap another.
//
// An error in the inputs of a step names the place and the field, such as "inputs[3].asms is 7; expected 0 or 1", and ends the call
// there: the steps before it are made, `control` is what the VCU remembers after them, and the places from there on stay as they
// are. `done`, which may be NULL, is set to how many steps were made.
enum adsdv_status adsdv_step_n(const struct adsdv_machine *machine,
                               struct adsdv_control *control,
                               const struct adsdv_inputs *inputs,
                               const uint32_t *dt_ms,
                               size_t count,
                               struct adsdv_control *controls,
                               struct adsdv_outputs *outputs,
                               size_t *done,
                               struct adsdv_error *error);

// A step of each of `count` VCUs, as adsdv_step makes it: for many runs at once, or, where all remember the same, for all that one
// VCU might see next.
//
// `machine` is that of adsdv_step, for all of them. Each VCU has a place of `control`, before and then after the step, one of
// `inputs`, and one of `dt_ms` and `outputs`, which are those of adsdv_step_n. No array may overlap another.
//
// An error in what a VCU remembers or sees names its place and the field, such as "control[3].state is 0", and ends the call there:
// the VCUs before it have made their step. `done`, which may be NULL, is set to how many they are.
enum adsdv_status adsdv_step_each(const struct adsdv_machine *machine,
                                  struct adsdv_control *control,
                                  const struct adsdv_inputs *inputs,
                                  const uint32_t *dt_ms,
                                  size_t count,
                                  struct adsdv_outputs *outputs,
                                  size_t *done,
                                  struct adsdv_error *error);

// The messages of the default edition, by ascending identifier: `index` is less than ADSDV_MESSAGES.
enum adsdv_status adsdv_message_at(size_t index, struct adsdv_message *message, struct adsdv_error *error);

// How many messages an edition has; 0 if there is no such edition.
size_t adsdv_message_count(adsdv_edition edition);

// The messages of an edition, by ascending identifier: `index` is less than adsdv_message_count says.
enum adsdv_status adsdv_message_at_in(adsdv_edition edition,
                                      size_t index,
                                      struct adsdv_message *message,
                                      struct adsdv_error *error);

// The choices that the default edition leaves, reading by reading: `index` is less than ADSDV_CHOICES.
enum adsdv_status adsdv_reading_at(size_t index, struct adsdv_reading *reading, struct adsdv_error *error);

// How many choices an edition leaves, of all readings together; 0 if there is no such edition. A reading with a single one is
// settled.
size_t adsdv_reading_count(adsdv_edition edition);

// The choices that an edition leaves, reading by reading: `index` is less than adsdv_reading_count says.
enum adsdv_status adsdv_reading_at_in(adsdv_edition edition,
                                      size_t index,
                                      struct adsdv_reading *reading,
                                      struct adsdv_error *error);

// Reads a frame of any message of the default edition: every signal of it, by ascending bits, into `signals`, which has
// `room` places (ADSDV_MOST_SIGNALS are always enough), and their number into `count`.
//
// A frame with too few bytes or a value that is not allowed is an error (ADSDV_TOO_SHORT, ADSDV_BAD_VALUE) that names
// the first such signal; the signals are written all the same, each with its `present` and `allowed`.
enum adsdv_status adsdv_decode(const struct adsdv_frame *frame,
                               struct adsdv_signal *signals,
                               size_t room,
                               size_t *count,
                               struct adsdv_error *error);

// Reads a frame of any message of an edition, likewise.
enum adsdv_status adsdv_decode_in(adsdv_edition edition,
                                  const struct adsdv_frame *frame,
                                  struct adsdv_signal *signals,
                                  size_t room,
                                  size_t *count,
                                  struct adsdv_error *error);

// Reads one signal of a frame of the default edition by its name, such as "STEER_ANGLE_deg" of 523h. A frame that ends before
// the signal does, or a value that is not allowed, is an error; the signal is written all the same.
enum adsdv_status adsdv_decode_signal(const struct adsdv_frame *frame,
                                      const char *name,
                                      struct adsdv_signal *value,
                                      struct adsdv_error *error);

// Reads one signal of a frame of an edition, likewise. A name that another edition has for it is understood.
enum adsdv_status adsdv_decode_signal_in(adsdv_edition edition,
                                         const struct adsdv_frame *frame,
                                         const char *name,
                                         struct adsdv_signal *value,
                                         struct adsdv_error *error);

// A new recogniser of a bus, which adsdv_recogniser_free must free; NULL if there is an error. Where the frames do not tell,
// the edition is `otherwise`.
struct adsdv_recogniser *adsdv_recogniser_new(adsdv_edition otherwise,
                                              struct adsdv_error *error);

// Frees a recogniser, whose text is gone then. NULL is left alone.
void adsdv_recogniser_free(struct adsdv_recogniser *recogniser);

// Takes down a classic CAN data frame with an 11-bit identifier, as adsdv_judge_frame takes it. Identifiers that are not the
// interface's and any `length` are fine.
enum adsdv_status adsdv_recogniser_frame(struct adsdv_recogniser *recogniser,
                                         int64_t t_ns,
                                         uint32_t id,
                                         const uint8_t *data,
                                         size_t length,
                                         struct adsdv_error *error);

// The edition that fits best what has been taken down so far. A few seconds of a bus tell; more frames may be taken down behind
// it.
enum adsdv_status adsdv_recogniser_recognise(struct adsdv_recogniser *recogniser,
                                             struct adsdv_recognised *found,
                                             struct adsdv_error *error);

// What the judge assumes where nothing else is said; it is of the default edition.
enum adsdv_status adsdv_judge_options_init(struct adsdv_judge_options *options, struct adsdv_error *error);

// A new judge of a bus, which adsdv_judge_free must free; NULL if there is an error. `options` may be NULL: then
// it judges by the default edition.
struct adsdv_judge *adsdv_judge_new(const struct adsdv_judge_options *options,
                                    struct adsdv_error *error);

// Frees a judge, whose texts are gone then. NULL is left alone.
void adsdv_judge_free(struct adsdv_judge *judge);

// Judges a classic CAN data frame with an 11-bit identifier: `t_ns` is its time in nanoseconds on any clock, best since
// the first frame; time may jump. Identifiers that are not the interface's and any `length` are fine.
enum adsdv_status adsdv_judge_frame(struct adsdv_judge *judge,
                                    int64_t t_ns,
                                    uint32_t id,
                                    const uint8_t *data,
                                    size_t length,
                                    struct adsdv_error *error);

// Counts a frame that is not judged (extended, remote, CAN FD, of another bus), and lets time pass.
enum adsdv_status adsdv_judge_other_frame(struct adsdv_judge *judge, int64_t t_ns, struct adsdv_error *error);

// The next thing that the judge found and that was not taken yet: true, and it is in `finding`; or false: there is
// none at present, or a pointer is NULL.
bool adsdv_judge_next(struct adsdv_judge *judge,
                      struct adsdv_finding *finding);

// The end: settles what is still open, which adsdv_judge_next then has, and says what it all comes to. `report` may be
// NULL. A second call says the same.
enum adsdv_status adsdv_judge_finish(struct adsdv_judge *judge,
                                     struct adsdv_report *report,
                                     struct adsdv_error *error);

// Has a judge follow rules of the user's own from now on, beside the document: best before the first frame. `rules` is the text of
// a file of rules. What breaks one is a violation among the findings, of party "OWN", whose section is the line. Rules that it was
// given before are followed no longer.
//
// A text that is wrong, or names what the edition has not, is an error (ADSDV_BAD_RULES) that says of the first mistake what was
// found and what was expected, and how many more there are; `place`, which may be NULL, is where the first is.
enum adsdv_status adsdv_judge_follow(struct adsdv_judge *judge,
                                     const char *rules,
                                     struct adsdv_rule_place *place,
                                     struct adsdv_error *error);

// What became of the rule with this index, from 0 in the order of the text, once the judge has finished: true, and it is in
// `report`; or false: there is none, the judge has not finished, or a pointer is NULL.
bool adsdv_judge_rule(struct adsdv_judge *judge,
                      size_t index,
                      struct adsdv_rule_report *report);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* ADSDV_H */
