/* Many steps in one call: a mission over its whole length, and all that a VCU might see next. */
#include <stdio.h>

#include "adsdv.h"

enum { STEPS = 1000, SWITCHES = 7 };

static adsdv_inputs inputs[STEPS];
static adsdv_control after[STEPS];

static const char *state(const adsdv_control *control) {
    return adsdv_value_name(ADSDV_AS_STATE, control->state);
}

int main(void) {
    adsdv_control control, next[1 << SWITCHES];
    adsdv_error error;
    size_t done, i;
    unsigned state_before, running = 0;

    /* One VCU for ten seconds, of 10 ms each: switched on, "Go" after six seconds, and an E-stop after nine. */
    for (i = 0; i < STEPS; i++) {
        adsdv_inputs_init(&inputs[i], NULL);
        inputs[i].asms = inputs[i].tsms = 1;
        inputs[i].ebs = ADSDV_EBS_ARMED;
        inputs[i].ami = ADSDV_AMI_TRACK_DRIVE;
        inputs[i].handshake = i % 2; /* the AI Computer answers each step with the bit of the one before */
        inputs[i].mission_status = i < 610 ? ADSDV_MISSION_SELECTED : ADSDV_MISSION_RUNNING;
        inputs[i].go = i >= 600;
        inputs[i].remote_estop = i >= 900;
    }
    adsdv_control_init(&control, NULL);
    state_before = control.state;
    if (adsdv_step_n(NULL, &control, inputs, NULL, STEPS, after, NULL, NULL, &error)) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    for (i = 0; i < STEPS; i++) {
        if (after[i].state != state_before) printf("%5.2f s: %s\n", (double)i / 100, state(&after[i]));
        state_before = after[i].state;
    }

    /* What it may do next where it drives: a step of each of 128 VCUs that remember the same and see something else. */
    for (i = 0; i < 1 << SWITCHES; i++) {
        next[i] = after[899];
        inputs[i] = inputs[899];
        inputs[i].asms = i & 1;
        inputs[i].tsms = i >> 1 & 1;
        inputs[i].hvil_open = i >> 2 & 1;
        inputs[i].ebs_fault = i >> 3 & 1;
        inputs[i].charging = i >> 4 & 1;
        inputs[i].estop_request = i >> 5 & 1;
        inputs[i].batt_soc_low = i >> 6 & 1;
    }
    if (adsdv_step_each(NULL, next, inputs, NULL, 1 << SWITCHES, NULL, NULL, &error)) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    for (i = 0; i < 1 << SWITCHES; i++) running += next[i].state == ADSDV_AS_DRIVING;
    printf("of %d steps from AS_DRIVING %u stay there\n", 1 << SWITCHES, running);

    /* What is wrong with an input is said with its place, and the steps before it are made. */
    inputs[3].asms = 7;
    if (adsdv_step_n(NULL, &control, inputs, NULL, STEPS, NULL, NULL, &done, &error)) {
        printf("error %d after %d steps: %s\n", (int)error.status, (int)done, error.text);
    }
    return 0;
}
