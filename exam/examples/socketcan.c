/* An AI Computer in C on SocketCAN, with nothing but the system's sockets: it drives for three seconds, and stops. For 4.0 and 2026.
 *
 *     cc -O2 -o socketcan exam/examples/socketcan.c
 *     adsdv exam --namespace --edition 2026 --quick -- ./socketcan vcan0
 */
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { OFF = 1, READY, DRIVING, EMERGENCY, FINISHED };
enum { NOT_SELECTED, SELECTED, RUNNING, DONE };

static int can, heard, handshake, state = OFF, mission, moving, driven_ms, rest_ms;

static long long now_us(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000000LL + now.tv_nsec / 1000;
}

/* A socket on the interface of this name; -1 if there is none, and the system's error. */
static int open_can(const char *name) {
    struct ifreq request;
    struct sockaddr_can address;
    int opened = socket(PF_CAN, SOCK_RAW, CAN_RAW);
    if (opened < 0) {
        return -1;
    }
    memset(&request, 0, sizeof request);
    strncpy(request.ifr_name, name, IFNAMSIZ - 1);
    if (ioctl(opened, SIOCGIFINDEX, &request) < 0) {
        return -1;
    }
    memset(&address, 0, sizeof address);
    address.can_family = AF_CAN;
    address.can_ifindex = request.ifr_ifindex;
    return bind(opened, (struct sockaddr *)&address, sizeof address) < 0 ? -1 : opened;
}

static void receive(const struct can_frame *frame) {
    if (frame->can_id == 0x520 && frame->can_dlc >= 3) {
        heard = 1;
        handshake = frame->data[0] & 1;
        state = frame->data[2] & 15;
        mission = frame->data[2] >> 4;
        if (state == 0) {
            state = OFF; /* AS_INIT of the vehicle of 2026 */
        }
    } else if (frame->can_id == 0x525 && frame->can_dlc == 8) {
        moving = 0;
        for (int wheel = 0; wheel < 4; wheel++) {
            moving |= frame->data[2 * wheel] + 256 * frame->data[2 * wheel + 1] >= 10;
        }
    }
}

/* A message with two numbers of 16 bits, of which the second may be none of its bytes. */
static void send_can(int id, int length, int first, int second) {
    struct can_frame frame;
    memset(&frame, 0, sizeof frame);
    frame.can_id = (canid_t)id;
    frame.can_dlc = (unsigned char)length;
    frame.data[0] = first & 255;
    frame.data[1] = first >> 8;
    frame.data[2] = second & 255;
    frame.data[3] = second >> 8;
    if (write(can, &frame, sizeof frame) != (ssize_t)sizeof frame) {
        perror("write");
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
        return;
    }
    send_can(0x501, 6, 0, 0);
    send_can(0x510, 8, handshake | (status << 4 | forward << 6) << 8, 0);
    send_can(0x511, 4, 10 * torque, torque ? 1500 : 0);
    send_can(0x512, 4, 10 * torque, torque ? 1500 : 0);
    send_can(0x513, 2, 0, 0);
    send_can(0x514, 2, 2 * brake | 2 * brake << 8, 0);
}

int main(int count, char **words) {
    if (count != 2 || (can = open_can(words[1])) < 0) {
        perror(count == 2 ? words[1] : "usage: socketcan INTERFACE");
        return 1;
    }
    long long next = now_us();
    for (;;) {
        long long left = next - now_us();
        if (left <= 0) {
            step();
            next += 10000;
            if (next < now_us()) {
                next = now_us(); /* what it was late with is not made up for */
            }
            continue;
        }
        fd_set readable;
        struct timeval wait = {0, (suseconds_t)left};
        FD_ZERO(&readable);
        FD_SET(can, &readable);
        if (select(can + 1, &readable, NULL, NULL, &wait) > 0) {
            struct can_frame frame;
            if (read(can, &frame, sizeof frame) == (ssize_t)sizeof frame) {
                receive(&frame);
            }
        }
    }
}
