/* An AI Computer in C, with nothing but the standard library: it drives for three seconds, and stops. For 4.0 and 2026.
 *
 *     cc -O2 -o minimal exam/examples/minimal.c && adsdv exam --stdio --edition 4.0 -- ./minimal
 */
#include <stdio.h>
#include <string.h>

enum { OFF = 1, READY, DRIVING, EMERGENCY, FINISHED };
enum { NOT_SELECTED, SELECTED, RUNNING, DONE };

static int heard, handshake, state, mission, moving, driven_ms, rest_ms;

/* A byte of a frame, of which the hex digits are given. */
static int byte(const char *digits, int place) {
    unsigned value = 0;
    sscanf(digits + 2 * place, "%2x", &value);
    return (int)value;
}

/* "520#..." is looked for with its quotation mark, so that no data is taken for an identifier. */
static void receive(const char *line) {
    const char *frame = line;
    while ((frame = strstr(frame, "\"520#")) != NULL) {
        frame += 5;
        heard = 1;
        handshake = byte(frame, 0) & 1;
        state = byte(frame, 2) & 15;
        mission = byte(frame, 2) >> 4;
        if (state == 0) {
            state = OFF; /* AS_INIT of the vehicle of 2026 */
        }
    }
    frame = line;
    while ((frame = strstr(frame, "\"525#")) != NULL) {
        frame += 5;
        moving = 0;
        for (int wheel = 0; wheel < 4; wheel++) {
            moving |= byte(frame, 2 * wheel) + 256 * byte(frame, 2 * wheel + 1) >= 10;
        }
    }
}

static void step(void) {
    int status = NOT_SELECTED, forward = 0, torque = 0, brake = 0;
    switch (state) {
    case OFF:
    case READY:
        driven_ms = rest_ms = 0;
        status = mission ? SELECTED : NOT_SELECTED;
        break;
    case DRIVING:
        forward = 1;
        driven_ms += 10;
        torque = driven_ms < 3000 ? 30 : 0;
        brake = driven_ms < 3000 ? 0 : 50;
        rest_ms = brake && !moving ? rest_ms + 10 : 0;
        status = rest_ms > 500 ? DONE : RUNNING;
        break;
    case FINISHED:
        status = DONE;
        brake = 50;
        break;
    default:
        break;
    }
    if (!heard) {
        puts("{\"frames\":[]}");
        return;
    }
    int nm = 10 * torque, rpm = torque ? 1500 : 0;
    printf("{\"frames\":[\"501#000000000000\",\"510#%02X%02X000000000000\",", handshake, status << 4 | forward << 6);
    printf("\"511#%02X%02X%02X%02X\",", nm & 255, nm >> 8, rpm & 255, rpm >> 8);
    printf("\"512#%02X%02X%02X%02X\",", nm & 255, nm >> 8, rpm & 255, rpm >> 8);
    printf("\"513#0000\",\"514#%02X%02X\"]}\n", 2 * brake, 2 * brake);
}

int main(void) {
    static char line[1 << 16];
    while (fgets(line, sizeof line, stdin) != NULL) {
        if (strstr(line, "\"hello\"")) {
            puts(strstr(line, "\"2026\"") ? "{\"edition\":\"2026\"}" : "{\"edition\":\"4.0\"}");
        } else if (strstr(line, "\"reset\"")) {
            heard = handshake = mission = moving = driven_ms = rest_ms = 0;
            state = OFF;
            puts("{}");
        } else {
            receive(line);
            step();
        }
        fflush(stdout);
    }
    return 0;
}
