/* The editions of the interface: what there is, and what a VCU of each does while nobody answers its handshake. */
#include <stdio.h>

#include "adsdv.h"

static adsdv_error error;

static int failed(void) {
    fprintf(stderr, "%s\n", error.text);
    return 1;
}

int main(void) {
    adsdv_edition edition;
    for (edition = 0; edition < adsdv_edition_count(); edition++) {
        adsdv_machine machine;
        adsdv_control control;
        adsdv_inputs inputs;
        adsdv_outputs outputs;
        adsdv_frame frames[ADSDV_MOST_VCU_FRAMES], drive;
        size_t sent;
        int ms = 0;

        adsdv_control_init(&control, NULL);
        adsdv_inputs_init(&inputs, NULL);
        inputs.tsms = 1; /* the handshake is performed, and nobody answers it */
        if (adsdv_machine_init_in(edition, &machine, NULL, &error)) return failed();
        do {
            if (adsdv_step_frames(&machine, &control, &inputs, 10, &outputs, frames, ADSDV_MOST_VCU_FRAMES, &sent,
                                  &error)) return failed();
            ms += 10;
        } while (!outputs.ai_comms_lost);
        if (adsdv_frame_init_in(edition, &drive, 0x511, &error)) return failed();
        printf("%s: %d frames a cycle, 511h has %d bytes, communication lost after %d ms\n",
               adsdv_edition_version(edition), (int)sent, drive.len, ms);
    }
    if (adsdv_edition_find("2.9", &edition, &error)) printf("error %d: %s\n", (int)error.status, error.text);
    return 0;
}
