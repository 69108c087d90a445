/* A complete adapter in C for `adsdv conform`, around the specification as a C library.
 *
 *     cargo build --release -p adsdv-ffi
 *     cc -O2 -Iffi/include conform/examples/adapter.c target/release/libadsdv.a -lpthread -ldl -lm -o adapter
 *     adsdv conform [--edition 4.0] -- ./adapter
 *
 * Put your own VCU in place of adsdv_step. conform/PROTOCOL.md says what the lines mean.
 */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "adsdv.h"

/* The keys of the protocol, which are the fields of the structs, too. */
#define FLAGS(X) X(asms) X(tsms) X(go) X(remote_estop) X(res_link_lost) X(vehicle_estop) X(crash_sensor) \
    X(critical_fault) X(bms_fault) X(mpp_dongle_removed) X(hvil_open) X(hvil_short) X(ebs_fault) \
    X(offboard_charger_fault) X(charging) X(batt_temp_high) X(batt_soc_low) X(handshake) X(estop_request)
#define NUMBERS(X) X(front_axle_trq_request) X(rear_axle_trq_request) X(front_motor_speed_max) \
    X(rear_motor_speed_max) X(steer_request) X(steer_angle) X(hyd_press_f_req) X(hyd_press_r_req) \
    X(fl_wheel_speed) X(fr_wheel_speed) X(rl_wheel_speed) X(rr_wheel_speed) X(status_silence_ms) \
    X(drive_f_silence_ms) X(drive_r_silence_ms) X(steer_silence_ms) X(brake_silence_ms)
#define NAMES(X) X(ami, ADSDV_AMI_STATE) X(ebs, ADSDV_EBS_STATE) X(mission_status, ADSDV_MISSION_STATUS) \
    X(direction_request, ADSDV_DIRECTION)
#define OUTPUTS(X) X(as_state) X(handshake) X(go_signal) X(steering_status) X(shutdown_request) \
    X(as_switch_status) X(ts_switch_status) X(ami_state) X(shutdown_cause) X(fault_status) X(warning_status) \
    X(warn_batt_temp_high) X(warn_batt_soc_low) X(ai_estop_request) X(hvil_open_fault) X(hvil_short_fault) \
    X(ebs_fault) X(offboard_charger_fault) X(ai_comms_lost) X(autonomous_braking_fault) \
    X(mission_status_fault) X(charge_procedure_fault) X(bms_fault) X(front_axle_trq) X(front_motor_speed_max) \
    X(rear_axle_trq) X(rear_motor_speed_max) X(direction) X(hyd_press_f) X(hyd_press_r) X(ebs_triggered)

static adsdv_machine machine;
static adsdv_control control;
static adsdv_error error;
static int has_plausibility, has_states; /* whether the edition has brake_plausibility_fault, op_state and its like */

static void check(adsdv_status status) {
    if (status != ADSDV_OK) {
        fprintf(stderr, "adapter: %s\n", error.text);
        exit(1);
    }
}

/* The value of an enumeration whose name begins here. */
static int value_of(unsigned enumeration, const char *name) {
    int32_t value;
    check(adsdv_value_of_name_in(machine.edition, enumeration, name, strcspn(name, "\""), &value, &error));
    return value;
}

/* What follows a key; NULL if the line does not have it. */
static const char *after(const char *line, const char *key) {
    const char *found = strstr(line, key);
    return found ? found + strlen(key) : NULL;
}

/* The VCU is one of this edition from now on. */
static void become(adsdv_edition edition) {
    adsdv_frame frame;
    check(adsdv_machine_init_in(edition, &machine, NULL, &error));
    check(adsdv_control_init(&control, &error));
    check(adsdv_frame_init_in(edition, &frame, 0x520, &error));
    has_plausibility = !adsdv_frame_set_in(edition, &frame, "BRAKE_PLAUSIBILITY_FAULT", 0, NULL);
    has_states = !adsdv_frame_set_in(edition, &frame, "OP_STATE", 0, NULL);
}

/* What it says of itself; one with a fixed cycle adds "cycle_ms":10, one that goes by a clock "clock":"wall". */
static void about(void) {
#define QUOTED(key) "\"" #key "\","
    printf("\"outputs\":[" OUTPUTS(QUOTED));
    if (has_plausibility) printf(QUOTED(brake_plausibility_fault));
    if (has_states) printf(QUOTED(op_state) QUOTED(ts_state) QUOTED(ebs_state));
    fputs("\"steer\"]}\n", stdout);
}

/* What follows is about this edition; an edition that there is not is answered with the one that this VCU is of. */
static void hello(const char *line) {
    char version[16] = "";
    const char *at = after(line, "\"edition\":\"");
    adsdv_edition edition;
    if (at) strncat(version, at, strcspn(at, "\"") < sizeof version ? strcspn(at, "\"") : 0);
    if (adsdv_edition_find(version, &edition, NULL) == ADSDV_OK) become(edition);
    printf("{\"edition\":\"%s\",", adsdv_edition_version(machine.edition));
    about();
}

static void step(const char *line) {
    adsdv_inputs inputs;
    adsdv_outputs outputs;
    const char *at = after(line, "\"dt_ms\":");
    uint32_t dt_ms = at ? (uint32_t)strtoul(at, NULL, 10) : 0;
    check(adsdv_inputs_init(&inputs, &error)); /* what is not in the line is at its default */
#define FLAG(key) inputs.key = strstr(line, "\"" #key "\":true") != NULL;
#define NUMBER(key) if ((at = after(line, "\"" #key "\":"))) inputs.key = atoi(at);
#define NAME(key, of) if ((at = after(line, "\"" #key "\":\""))) inputs.key = value_of(of, at);
    FLAGS(FLAG) NUMBERS(NUMBER) NAMES(NAME)
    check(adsdv_step(&machine, &control, &inputs, dt_ms, &outputs, NULL, &error));
    /* Names may be given as their numbers, and flags as 1 and 0. */
#define FORMAT(key) "\"" #key "\":%d,"
#define VALUE(key) outputs.key,
    printf("{" OUTPUTS(FORMAT) "%s", OUTPUTS(VALUE) "");
    if (has_plausibility) printf(FORMAT(brake_plausibility_fault), outputs.brake_plausibility_fault);
    if (has_states) printf(FORMAT(op_state) FORMAT(ts_state) FORMAT(ebs_state), outputs.op_state, outputs.ts_state, outputs.ebs_state);
    fputs("\"steer\":", stdout);
    if (outputs.steer_active) printf("%d}\n", outputs.steer);
    else puts("null}");
}

int main(void) {
    static char buffer[1 << 16], answers[1 << 16]; /* no line is longer than some hundred bytes */
    size_t filled = 0;
    ssize_t got;
    setvbuf(stdout, answers, _IOFBF, sizeof answers);
    adsdv_edition first;
    check(adsdv_edition_find("3.0", &first, &error)); /* what all is about without a hello */
    become(first);
    int is_first = 1;
    /* Whoever asks waits for what has been answered so far: it is flushed before every wait for more. */
    while (fflush(stdout) == 0 && (got = read(STDIN_FILENO, buffer + filled, sizeof buffer - 1 - filled)) > 0) {
        char *line = buffer, *end;
        buffer[filled += (size_t)got] = '\0';
        for (; (end = strchr(line, '\n')) != NULL; line = end + 1) {
            *end = '\0';
            if (is_first && !strstr(line, "\"op\":\"hello\"")) putchar('{'), about(); /* nobody asks for an edition */
            is_first = 0;
            if (strstr(line, "\"op\":\"hello\"")) hello(line);
            else if (strstr(line, "\"op\":\"step\"")) step(line);
            else check(adsdv_control_init(&control, &error)), puts("{}");
        }
        memmove(buffer, line, filled -= (size_t)(line - buffer));
    }
    return 0;
}
