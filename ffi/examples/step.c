/* A first example: the vehicle is switched on, and the VCU goes to AS_READY. */
#include <stdio.h>

#include "adsdv.h"

int main(void) {
    adsdv_control control;
    adsdv_inputs inputs;
    adsdv_outputs outputs;
    adsdv_frame frames[ADSDV_VCU_FRAMES];
    adsdv_error error;

    adsdv_control_init(&control, NULL); /* after a power cycle */
    adsdv_inputs_init(&inputs, NULL);   /* everything off */
    inputs.asms = inputs.tsms = 1;
    inputs.ebs = ADSDV_EBS_ARMED;
    inputs.ami = ADSDV_AMI_TRACK_DRIVE;
    inputs.mission_status = ADSDV_MISSION_SELECTED;

    if (adsdv_step(NULL, &control, &inputs, 10, &outputs, frames, &error) != ADSDV_OK) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    printf("%s by section %s; ", adsdv_value_name(ADSDV_AS_STATE, outputs.as_state), outputs.section);
    printf("the first frame is %X, its third byte %02X\n", (unsigned)frames[0].id, (unsigned)frames[0].data[2]);

    inputs.ami = 9; /* no such mission */
    if (adsdv_step(NULL, &control, &inputs, 10, &outputs, NULL, &error) != ADSDV_OK) {
        printf("error %d: %s\n", (int)error.status, error.text);
    }
    return 0;
}
