/* Tells which edition of the interface a log of `candump -L`, or a live bus, speaks: candump -L can0 | ./recognise. */
#include <stdio.h>
#include <string.h>

#include "adsdv.h"

int main(void) {
    adsdv_error error;
    adsdv_recogniser *recogniser = adsdv_recogniser_new(adsdv_edition_default(), &error);
    adsdv_recognised recognised;
    adsdv_status status = ADSDV_OK;
    char line[256];

    if (!recogniser) return fprintf(stderr, "%s\n", error.text), 1;
    while (status == ADSDV_OK && fgets(line, sizeof line, stdin)) {
        /* A line such as "(1795209995.234358) vcan0 520#0000010000000000". */
        long long seconds;
        unsigned micros, id, byte;
        uint8_t data[8];
        size_t length = 0;
        const char *hex = strchr(line, '#');

        if (!hex || sscanf(line, "(%lld.%u) %*s %3x#", &seconds, &micros, &id) != 3) continue;
        while (length < sizeof data && sscanf(hex + 1 + 2 * length, "%2x", &byte) == 1) data[length++] = (uint8_t)byte;
        status = adsdv_recogniser_frame(recogniser, (seconds * 1000000 + micros) * 1000, id, data, length, &error);
    }
    if (status == ADSDV_OK) status = adsdv_recogniser_recognise(recogniser, &recognised, &error);
    if (status == ADSDV_OK) printf("%s\n", recognised.text);
    else fprintf(stderr, "%s\n", error.text);
    adsdv_recogniser_free(recogniser);
    return status != ADSDV_OK;
}
