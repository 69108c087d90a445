/* The AS state machine of the ADS-DV Software Interface Specification 3.0, sections 2.4 and 3,
 * with any AI Computer, any driver and any fault. Written by adsdv from its table; not to be edited.
 *
 *     spin -a vcu.pml
 *     gcc -O2 -DSAFETY -DNOREDUCE -DNOCOMP -o pan pan.c
 *     ./pan -m1000000 -w20
 *
 * pan prints "violated: NAME" for each property that some step breaks, and "reached: NAME" for each arrow, cause and
 * mission that is seen, once each and in no order. It goes on to the end all the same: "states, stored" is the number of
 * control states that can be reached, and the transitions are the steps out of all of them, and one power cycle each.
 * The result counts only if pan did not stop early: no "error:", no "max search depth too small".
 *
 * A state is the control state between two cycles. A cycle is atomic: the inputs are chosen, then the step is made. The
 * inputs are hidden, for they are no part of the state. The rows of a state stand in the order in which they are evaluated:
 * within a d_step, Spin takes the first option that it can take.
 *
 * In every cycle those conditions are chosen that can still matter, and one fault that opens the shutdown circuit. The
 * others cannot matter, but for the cause; they are off.
 */

/* The states, and where the time in each stops counting, in milliseconds. */
#define AS_OFF 1
#define AS_READY 2
#define AS_DRIVING 3
#define EMERGENCY_BRAKE 4
#define AS_FINISHED 5
#define LIMIT_AS_OFF 0
#define LIMIT_AS_READY 80
#define LIMIT_AS_DRIVING 0
#define LIMIT_EMERGENCY_BRAKE 80
#define LIMIT_AS_FINISHED 0
#define CYCLE_MS 10
#define HANDSHAKE_MS 50

/* The times of the document, by which the properties go. */
#define DOCUMENT_READY_DWELL_MS 80
#define DOCUMENT_EBS_TIMER_MS 80
#define DOCUMENT_HANDSHAKE_MS 50

/* The readings that say what a step is; those that say which rows there are have chosen them already. */
#define FAULT_EDGE 0  /* fault-trigger=edge */
#define GO_EDGE_ENOUGH 0  /* go-edge=edge */
#define GO_RAW 0  /* go-signal=raw */
#define HANDSHAKE_ALWAYS 0  /* handshake-active=always */
#define POWER_CYCLE_LATCHED 1  /* power-cycle=latched */

/* SHUTDOWN_CAUSE. */
#define NO_SHUTDOWN 0
#define CAUSE_AI_ESTOP_REQUEST 1
#define CAUSE_HVIL_OPEN_FAULT 2
#define CAUSE_HVIL_SHORT_FAULT 3
#define CAUSE_EBS_FAULT 4
#define CAUSE_OFFBOARD_CHARGER_FAULT 5
#define CAUSE_AI_COMMS_LOST 6
#define CAUSE_AUTONOMOUS_BRAKING_FAULT 7
#define CAUSE_MISSION_STATUS_FAULT 8
#define CAUSE_CHARGE_PROCEDURE_FAULT 9
#define CAUSE_BMS_FAULT 10

/* The control state: what the VCU remembers between two steps. */
unsigned state : 3 = AS_OFF;
unsigned in_state_ms : 7;   /* how long the state has lasted */
bit go_seen_low;             /* AS_READY: "Go" was seen off, so that its rising edge counts (3.2, item 3) */
bit handshake_active;
bit handshake_bit;           /* the HANDSHAKE bit that the VCU sends (2.4) */
unsigned unanswered_ms : 6;  /* for how long that bit has been unanswered */
bit power_cycle_needed;      /* after an emergency (3.9) */
unsigned shutdown_cause : 4; /* the first cause of an emergency (2.2) */
#if FAULT_EDGE
bit was_running;             /* AS_DRIVING: MISSION_STATUS was RUNNING */
bit was_forward;             /* AS_DRIVING: DIRECTION_REQUEST was FORWARD */
#else
#define was_running 0
#define was_forward 0
#endif

/* Within a step: the state that it leads to, and what was before it. */
hidden byte next;
hidden byte before;
hidden byte cause_before;
hidden byte armed_before;     /* go_seen_low */
hidden int lasted_ms;        /* how long the state before has lasted now */

/* The inputs of a step, chosen anew in each cycle: conditions, and faults by their flags in 520h. */
hidden byte asms;  /* AS master switch ON */
hidden byte tsms;  /* TS master switch ON */
hidden byte ami_selected;  /* AMI mission selected */
hidden byte mission_selected;  /* MISSION_STATUS == SELECTED */
hidden byte mission_running;  /* MISSION_STATUS == RUNNING */
hidden byte mission_finished;  /* MISSION_STATUS == FINISHED */
hidden byte ebs_armed;  /* EBS_state == ARMED */
hidden byte front_torque_zero;  /* front axle torque request == 0 */
hidden byte rear_torque_zero;  /* rear axle torque request == 0 */
hidden byte steer_request_zero;  /* steer angle request == 0 */
hidden byte steer_straight;  /* abs(steer angle) < 5 deg */
hidden byte direction_neutral;  /* DIRECTION_REQUEST == NEUTRAL */
hidden byte go_on;  /* "Go" signal ON */
hidden byte moving;  /* a wheel speed > 10 rpm */
hidden byte at_rest;  /* all wheel speeds < 10 rpm */
hidden byte ai_handshake;  /* AI HANDSHAKE == 1 */
hidden byte AI_ESTOP_REQUEST;
hidden byte HVIL_OPEN_FAULT;
hidden byte HVIL_SHORT_FAULT;
hidden byte EBS_FAULT;
hidden byte OFFBOARD_CHARGER_FAULT;
hidden byte CHARGE_PROCEDURE_FAULT;
hidden byte BMS_FAULT;
#define sdc_open (HVIL_OPEN_FAULT || HVIL_SHORT_FAULT || EBS_FAULT || OFFBOARD_CHARGER_FAULT || CHARGE_PROCEDURE_FAULT || BMS_FAULT)
#define ai_estop (AI_ESTOP_REQUEST)
#define ATOMS (asms << 2 | tsms << 3 | ami_selected << 4 | mission_selected << 5 | \
    mission_running << 6 | mission_finished << 7 | ebs_armed << 9 | front_torque_zero << 12 | \
    rear_torque_zero << 13 | steer_request_zero << 15 | steer_straight << 16 | direction_neutral << 17 | \
    go_on << 19 | moving << 21 | at_rest << 22 | ai_handshake << 23)
#define FAULTS (AI_ESTOP_REQUEST << 1 | HVIL_OPEN_FAULT << 2 | HVIL_SHORT_FAULT << 3 | EBS_FAULT << 4 | \
    OFFBOARD_CHARGER_FAULT << 5 | CHARGE_PROCEDURE_FAULT << 9 | BMS_FAULT << 10)

/* The conditions that the control state decides, some of them together with the inputs. */
#define dwell_elapsed (state == AS_READY && in_state_ms + CYCLE_MS >= LIMIT_AS_READY)
#define ebs_timer_complete (state == EMERGENCY_BRAKE && in_state_ms + CYCLE_MS >= LIMIT_EMERGENCY_BRAKE)
#define go_edge (go_seen_low && go_on)
#define mission_finished_edge (was_running && mission_finished)
#define direction_neutral_edge (was_forward && direction_neutral)
#define ai_comms_lost (handshake_active && unanswered_ms >= HANDSHAKE_MS)

/* What several properties speak of, in the document's words. */
#define document_comms_lost (handshake_active && unanswered_ms >= DOCUMENT_HANDSHAKE_MS)
#define dwelled (lasted_ms >= DOCUMENT_READY_DWELL_MS)
#define braked (lasted_ms >= DOCUMENT_EBS_TIMER_MS)
#define nothing_requested (front_torque_zero && rear_torque_zero && steer_request_zero && steer_straight && direction_neutral)
#define go_lawful (dwelled && nothing_requested && !go_on)
#define reason_to_brake (sdc_open || ai_estop || document_comms_lost || (before == AS_DRIVING && \
    (!asms || !go_on || ((mission_finished || direction_neutral) && moving))))
#define limit(of) ((of) == AS_FINISHED -> LIMIT_AS_FINISHED : \
    ((of) == EMERGENCY_BRAKE -> LIMIT_EMERGENCY_BRAKE : \
    ((of) == AS_DRIVING -> LIMIT_AS_DRIVING : \
    ((of) == AS_READY -> LIMIT_AS_READY : \
    ((of) == AS_OFF -> LIMIT_AS_OFF : \
    0)))))

/* The properties.
 *
 * figure-2-arrows: The state changes only along an arrow of Figure 2
 * ready-switches: AS_READY is entered only with ASMS and TSMS on and the EBS ARMED
 * ready-ami: AS_READY is entered only with a mission selected on the AMI
 * ready-mission-status: AS_READY is entered only with MISSION_STATUS SELECTED
 * ready-due: AS_READY is entered as soon as all of its conditions hold, unless a power cycle is needed
 * driving-dwell: AS_DRIVING is entered only after 5 s in AS_READY
 * driving-requests: AS_DRIVING is entered only with zero torque and steering requests, straight wheels and NEUTRAL
 * driving-go: AS_DRIVING is entered only when "Go" comes on, just after it was seen off while all else held
 * driving-due: AS_DRIVING is entered at the accepted edge of "Go", unless AS_READY has to be left otherwise
 * driving-sdc: An open shutdown circuit in AS_DRIVING leads to EMERGENCY_BRAKE
 * driving-asms: ASMS off in AS_DRIVING leads to EMERGENCY_BRAKE
 * driving-go-off: "Go" off in AS_DRIVING leads to EMERGENCY_BRAKE
 * driving-finished: FINISHED while moving leads to EMERGENCY_BRAKE
 * driving-neutral: NEUTRAL while moving leads to EMERGENCY_BRAKE
 * driving-comms: A handshake or a message that is lost in AS_DRIVING leads to EMERGENCY_BRAKE
 * driving-estop: ESTOP_REQUEST in AS_DRIVING leads to EMERGENCY_BRAKE
 * ready-sdc: An open shutdown circuit in AS_READY leads to EMERGENCY_BRAKE
 * finished-sdc: An open shutdown circuit in AS_FINISHED leads to EMERGENCY_BRAKE
 * ready-asms: ASMS off leads out of AS_READY
 * finished-asms: ASMS off leads out of AS_FINISHED
 * ready-comms: A handshake or a message that is lost in AS_READY leads to EMERGENCY_BRAKE
 * finished-comms: A handshake or a message that is lost in AS_FINISHED leads to EMERGENCY_BRAKE
 * ready-estop: ESTOP_REQUEST in AS_READY leads to EMERGENCY_BRAKE
 * finished-estop: ESTOP_REQUEST in AS_FINISHED leads to EMERGENCY_BRAKE
 * comms-tsms: With TSMS off, no silence of the AI Computer causes an emergency
 * finished-at-rest: AS_FINISHED is entered only with FINISHED and all wheels at rest
 * finished-due: FINISHED with all wheels at rest leads to AS_FINISHED, unless the vehicle has to brake
 * brake-founded: EMERGENCY_BRAKE is entered only for a reason that the document names
 * off-founded: AS_READY and AS_FINISHED are left for AS_OFF only with ASMS off
 * actuators: Drive and steering requests reach the actuators only in AS_DRIVING, with ASMS and "Go" on and the shutdown circuit closed
 * go-signal: GO_SIGNAL is 1 exactly in AS_DRIVING while "Go" is on, once its rising edge has been accepted
 * brake-time: EMERGENCY_BRAKE lasts at least 15 s
 * brake-asms: EMERGENCY_BRAKE is left only with ASMS off
 * brake-due: EMERGENCY_BRAKE is left for AS_OFF when it has lasted 15 s and ASMS is off
 * power-cycle: After EMERGENCY_BRAKE, AS_READY and all that follows need a power cycle
 * shutdown-cause: SHUTDOWN_CAUSE is never 0 after an emergency, and never changes
 * control-invariant: The control state keeps its invariant; the handshake and the time in a state are counted as they pass
 */

/* What is found is printed once, and is no part of the state. */
c_decl {
    static char printed[61];
    static void tell(int place, const char *what) {
        if (!printed[place]) {
            printed[place] = 1;
            puts(what);
        }
    }
}
#define FOUND(place, what, when) if :: when -> c_code { tell(place, what); } :: else fi

#if FAULT_EDGE
#define CONTROL now.state, now.in_state_ms, now.go_seen_low, now.was_running, now.was_forward, \
    now.handshake_active, now.handshake_bit, now.unanswered_ms, now.power_cycle_needed, now.shutdown_cause
#else
#define CONTROL now.state, now.in_state_ms, now.go_seen_low, 0, 0, \
    now.handshake_active, now.handshake_bit, now.unanswered_ms, now.power_cycle_needed, now.shutdown_cause
#endif

/* With spin -DSTATES -a, pan prints each control state. */
#ifdef STATES
#define SHOW_STATE c_code { printf("state: %d %d %d %d %d %d %d %d %d %d\n", CONTROL); };
#else
#define SHOW_STATE
#endif

/* With spin -DSTEPS -a, pan prints each step: the control state before it, the inputs as bits, and the one after it. */
#ifdef STEPS
c_decl { static char begun[128]; }
#define BEGIN_STEP c_code { snprintf(begun, sizeof begun, "%d %d %d %d %d %d %d %d %d %d", CONTROL); };
#define END_STEP ; c_code { printf("step: %s %d %d %d %d %d %d %d %d %d %d %d %d\n", begun, ATOMS, FAULTS, CONTROL); }
#else
#define BEGIN_STEP
#define END_STEP
#endif

/* A choice: everything is off, but for what is chosen. */
inline all_off() {
    asms = 0; tsms = 0; ami_selected = 0; mission_selected = 0; mission_running = 0;
    mission_finished = 0; ebs_armed = 0; front_torque_zero = 0; rear_torque_zero = 0; steer_request_zero = 0;
    steer_straight = 0; direction_neutral = 0; go_on = 0; moving = 0; at_rest = 0;
    ai_handshake = 0; AI_ESTOP_REQUEST = 0; HVIL_OPEN_FAULT = 0; HVIL_SHORT_FAULT = 0; EBS_FAULT = 0;
    OFFBOARD_CHARGER_FAULT = 0; CHARGE_PROCEDURE_FAULT = 0; BMS_FAULT = 0
}
#define any_of_1(a) if :: skip :: a = 1 fi
#define any_of_2(a, b) if :: skip :: a = 1 :: b = 1 :: a = 1; b = 1 fi
#define any_of_3(a, b, c) \
    if :: skip :: a = 1 :: b = 1 :: c = 1 :: a = 1; b = 1 :: a = 1; c = 1 :: b = 1; c = 1 :: a = 1; b = 1; c = 1 fi

/* The handshake (2.4): an edge of the VCU's bit waits for the same bit of the AI Computer. The first active step does not
 * count as time without an answer. */
inline handshake() {
    if
    :: !(HANDSHAKE_ALWAYS || tsms) -> handshake_active = 0; handshake_bit = 0; unanswered_ms = 0
    :: else ->
        if
        :: ai_handshake == handshake_bit -> handshake_bit = !handshake_bit; unanswered_ms = 0
        :: else ->
            unanswered_ms = (!handshake_active -> 0 :
                (unanswered_ms + CYCLE_MS < HANDSHAKE_MS -> unanswered_ms + CYCLE_MS : HANDSHAKE_MS))
        fi;
        handshake_active = 1
    fi
}

/* What a step remembers; limit_ms is where the time in the state before stops counting. "Go" is armed while it is off
 * and, unless any rising edge counts, all else holds that AS_DRIVING needs. */
inline remember(limit_ms) {
    go_seen_low = (next == AS_READY && !go_on && dwell_elapsed && front_torque_zero && rear_torque_zero && steer_request_zero &&
            steer_straight && direction_neutral);
#if FAULT_EDGE
    was_running = (next == AS_DRIVING && mission_running);
    was_forward = (next == AS_DRIVING && !direction_neutral);
#endif
    in_state_ms = (next != before -> 0 : (lasted_ms < limit_ms -> lasted_ms : limit_ms));
    state = next
}

inline step_AS_OFF() {
    d_step {
        BEGIN_STEP
        before = AS_OFF; cause_before = shutdown_cause; armed_before = go_seen_low;
        lasted_ms = in_state_ms + CYCLE_MS;
        handshake();
        if
        /* 3.1: AS master switch ON and TS master switch ON and AMI mission selected and MISSION_STATUS == SELECTED
         *   and EBS_state == ARMED and no power cycle needed */
        :: asms && tsms && ami_selected && mission_selected &&
            ebs_armed && !power_cycle_needed -> next = AS_READY
        :: else -> next = AS_OFF
        fi;
        remember(LIMIT_AS_OFF);
        FOUND(0, "violated: figure-2-arrows",
            !(state == AS_READY || state == AS_OFF));
        FOUND(1, "violated: ready-switches",
            state == AS_READY && !(asms && tsms && ebs_armed));
        FOUND(2, "violated: ready-ami",
            state == AS_READY && !(ami_selected));
        FOUND(3, "violated: ready-mission-status",
            state == AS_READY && !(mission_selected));
        FOUND(4, "violated: ready-due",
            !(state == AS_READY) && cause_before == NO_SHUTDOWN && asms && tsms && ami_selected && mission_selected && ebs_armed);
        FOUND(7, "violated: driving-go",
            !(before == AS_READY && state == AS_DRIVING -> armed_before && go_on :
            (state != AS_READY -> !go_seen_low :
            go_seen_low == (before == AS_READY && go_lawful)
            || (go_seen_low && in_state_ms + CYCLE_MS < DOCUMENT_READY_DWELL_MS))));
        FOUND(28, "violated: comms-tsms",
            !(tsms || shutdown_cause == cause_before || shutdown_cause != CAUSE_AI_COMMS_LOST));
        FOUND(31, "violated: brake-founded",
            !(state != EMERGENCY_BRAKE || reason_to_brake));
        FOUND(33, "violated: actuators",
            !(state != AS_DRIVING || (asms && go_on && !sdc_open)));
        FOUND(34, "violated: go-signal",
            !(!go_on || (state == AS_DRIVING -> before == AS_DRIVING || armed_before : !GO_RAW)));
        FOUND(38, "violated: power-cycle",
            !(cause_before == NO_SHUTDOWN || state == AS_OFF || state == EMERGENCY_BRAKE));
        FOUND(39, "violated: shutdown-cause",
            !(cause_before == NO_SHUTDOWN -> (shutdown_cause != NO_SHUTDOWN) == (state == EMERGENCY_BRAKE)
            : shutdown_cause == cause_before));
        FOUND(40, "violated: control-invariant",
            !(in_state_ms == (state == before -> (lasted_ms < limit(before) -> lasted_ms : limit(before)) : 0)
            && in_state_ms <= limit(state) && unanswered_ms <= HANDSHAKE_MS
            && (handshake_active || (!handshake_bit && unanswered_ms == 0))
            && (!go_seen_low || (state == AS_READY && (GO_EDGE_ENOUGH || in_state_ms >= LIMIT_AS_READY)))
            && ((FAULT_EDGE && state == AS_DRIVING) || !(was_running || was_forward))
            && (shutdown_cause != NO_SHUTDOWN || state != EMERGENCY_BRAKE)
            && power_cycle_needed == (shutdown_cause != NO_SHUTDOWN && POWER_CYCLE_LATCHED)
            && (!power_cycle_needed || state == EMERGENCY_BRAKE || state == AS_OFF)));
        if
        :: state != before || shutdown_cause != cause_before ->
            FOUND(42, "reached: arrow-3.1", state == AS_READY);
            FOUND(51, "reached: cause-1", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AI_ESTOP_REQUEST);
            FOUND(52, "reached: cause-2", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_HVIL_OPEN_FAULT);
            FOUND(53, "reached: cause-3", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_HVIL_SHORT_FAULT);
            FOUND(54, "reached: cause-4", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_EBS_FAULT);
            FOUND(55, "reached: cause-5", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_OFFBOARD_CHARGER_FAULT);
            FOUND(56, "reached: cause-6", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AI_COMMS_LOST);
            FOUND(57, "reached: cause-7", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AUTONOMOUS_BRAKING_FAULT);
            FOUND(58, "reached: cause-8", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_MISSION_STATUS_FAULT);
            FOUND(59, "reached: cause-9", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_CHARGE_PROCEDURE_FAULT);
            FOUND(60, "reached: cause-10", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_BMS_FAULT);
            skip
        :: else
        fi
        END_STEP
    }
}

inline step_AS_READY() {
    d_step {
        BEGIN_STEP
        before = AS_READY; cause_before = shutdown_cause; armed_before = go_seen_low;
        lasted_ms = in_state_ms + CYCLE_MS;
        handshake();
        if
        /* 3.5: SDC open
         * or AI_COMMS_LOST (2.4)
         * or ESTOP_REQUEST == 1 (2.1) */
        :: sdc_open || ai_comms_lost || ai_estop -> next = EMERGENCY_BRAKE;
            power_cycle_needed = POWER_CYCLE_LATCHED;
            if
            :: shutdown_cause != NO_SHUTDOWN
            :: ai_estop -> shutdown_cause = CAUSE_AI_ESTOP_REQUEST
            :: HVIL_OPEN_FAULT -> shutdown_cause = CAUSE_HVIL_OPEN_FAULT
            :: HVIL_SHORT_FAULT -> shutdown_cause = CAUSE_HVIL_SHORT_FAULT
            :: EBS_FAULT -> shutdown_cause = CAUSE_EBS_FAULT
            :: OFFBOARD_CHARGER_FAULT -> shutdown_cause = CAUSE_OFFBOARD_CHARGER_FAULT
            :: ai_comms_lost -> shutdown_cause = CAUSE_AI_COMMS_LOST
            :: CHARGE_PROCEDURE_FAULT -> shutdown_cause = CAUSE_CHARGE_PROCEDURE_FAULT
            :: BMS_FAULT -> shutdown_cause = CAUSE_BMS_FAULT
            :: else
            fi
        /* 3.6: AS master switch OFF */
        :: !asms -> next = AS_OFF
        /* 3.2: 0.08 second timer elapsed and front axle torque request == 0 and rear axle torque request == 0 and steer angle request == 0
         *   and abs(steer angle) < 5 deg and DIRECTION_REQUEST == NEUTRAL and "Go" signal OFF -> ON */
        :: dwell_elapsed && front_torque_zero && rear_torque_zero && steer_request_zero &&
            steer_straight && direction_neutral && go_edge -> next = AS_DRIVING
        :: else -> next = AS_READY
        fi;
        remember(LIMIT_AS_READY);
        FOUND(0, "violated: figure-2-arrows",
            !(state == EMERGENCY_BRAKE || state == AS_OFF || state == AS_DRIVING || state == AS_READY));
        FOUND(5, "violated: driving-dwell",
            state == AS_DRIVING && !(dwelled));
        FOUND(6, "violated: driving-requests",
            state == AS_DRIVING && !(front_torque_zero && rear_torque_zero && steer_request_zero && steer_straight &&
            direction_neutral));
        FOUND(7, "violated: driving-go",
            !(before == AS_READY && state == AS_DRIVING -> armed_before && go_on :
            (state != AS_READY -> !go_seen_low :
            go_seen_low == (before == AS_READY && go_lawful)
            || (go_seen_low && in_state_ms + CYCLE_MS < DOCUMENT_READY_DWELL_MS))));
        FOUND(8, "violated: driving-due",
            !(state == AS_DRIVING) && dwelled && armed_before && go_on && asms && nothing_requested && !reason_to_brake);
        FOUND(20, "violated: ready-sdc",
            !(state == EMERGENCY_BRAKE) && sdc_open);
        FOUND(22, "violated: ready-asms",
            !(state == AS_OFF || state == EMERGENCY_BRAKE) && !asms);
        FOUND(24, "violated: ready-comms",
            !(state == EMERGENCY_BRAKE) && document_comms_lost);
        FOUND(26, "violated: ready-estop",
            !(state == EMERGENCY_BRAKE) && ai_estop);
        FOUND(28, "violated: comms-tsms",
            !(tsms || shutdown_cause == cause_before || shutdown_cause != CAUSE_AI_COMMS_LOST));
        FOUND(31, "violated: brake-founded",
            !(state != EMERGENCY_BRAKE || reason_to_brake));
        FOUND(32, "violated: off-founded",
            !(state != AS_OFF || !asms));
        FOUND(33, "violated: actuators",
            !(state != AS_DRIVING || (asms && go_on && !sdc_open)));
        FOUND(34, "violated: go-signal",
            !(!go_on || (state == AS_DRIVING -> before == AS_DRIVING || armed_before : !GO_RAW)));
        FOUND(38, "violated: power-cycle",
            !(cause_before == NO_SHUTDOWN || state == AS_OFF || state == EMERGENCY_BRAKE));
        FOUND(39, "violated: shutdown-cause",
            !(cause_before == NO_SHUTDOWN -> (shutdown_cause != NO_SHUTDOWN) == (state == EMERGENCY_BRAKE)
            : shutdown_cause == cause_before));
        FOUND(40, "violated: control-invariant",
            !(in_state_ms == (state == before -> (lasted_ms < limit(before) -> lasted_ms : limit(before)) : 0)
            && in_state_ms <= limit(state) && unanswered_ms <= HANDSHAKE_MS
            && (handshake_active || (!handshake_bit && unanswered_ms == 0))
            && (!go_seen_low || (state == AS_READY && (GO_EDGE_ENOUGH || in_state_ms >= LIMIT_AS_READY)))
            && ((FAULT_EDGE && state == AS_DRIVING) || !(was_running || was_forward))
            && (shutdown_cause != NO_SHUTDOWN || state != EMERGENCY_BRAKE)
            && power_cycle_needed == (shutdown_cause != NO_SHUTDOWN && POWER_CYCLE_LATCHED)
            && (!power_cycle_needed || state == EMERGENCY_BRAKE || state == AS_OFF)));
        if
        :: state != before || shutdown_cause != cause_before ->
            FOUND(43, "reached: arrow-3.5", state == EMERGENCY_BRAKE);
            FOUND(44, "reached: arrow-3.6", state == AS_OFF);
            FOUND(45, "reached: arrow-3.2", state == AS_DRIVING);
            FOUND(51, "reached: cause-1", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AI_ESTOP_REQUEST);
            FOUND(52, "reached: cause-2", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_HVIL_OPEN_FAULT);
            FOUND(53, "reached: cause-3", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_HVIL_SHORT_FAULT);
            FOUND(54, "reached: cause-4", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_EBS_FAULT);
            FOUND(55, "reached: cause-5", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_OFFBOARD_CHARGER_FAULT);
            FOUND(56, "reached: cause-6", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AI_COMMS_LOST);
            FOUND(57, "reached: cause-7", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AUTONOMOUS_BRAKING_FAULT);
            FOUND(58, "reached: cause-8", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_MISSION_STATUS_FAULT);
            FOUND(59, "reached: cause-9", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_CHARGE_PROCEDURE_FAULT);
            FOUND(60, "reached: cause-10", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_BMS_FAULT);
            skip
        :: else
        fi
        END_STEP
    }
}

inline step_AS_DRIVING() {
    d_step {
        BEGIN_STEP
        before = AS_DRIVING; cause_before = shutdown_cause; armed_before = go_seen_low;
        lasted_ms = in_state_ms + CYCLE_MS;
        handshake();
        if
        /* 3.7: SDC open
         * or "Go" signal OFF
         * or AS master switch OFF
         * or MISSION_STATUS == FINISHED and a wheel speed > 10 rpm
         * or DIRECTION_REQUEST == NEUTRAL and a wheel speed > 10 rpm
         * or AI_COMMS_LOST (2.4)
         * or ESTOP_REQUEST == 1 (2.1) */
        :: sdc_open || !go_on || !asms || (mission_finished && moving) ||
            (direction_neutral && moving) || ai_comms_lost || ai_estop -> next = EMERGENCY_BRAKE;
            power_cycle_needed = POWER_CYCLE_LATCHED;
            if
            :: shutdown_cause != NO_SHUTDOWN
            :: ai_estop -> shutdown_cause = CAUSE_AI_ESTOP_REQUEST
            :: !go_on || !asms || HVIL_OPEN_FAULT -> shutdown_cause = CAUSE_HVIL_OPEN_FAULT
            :: HVIL_SHORT_FAULT -> shutdown_cause = CAUSE_HVIL_SHORT_FAULT
            :: EBS_FAULT -> shutdown_cause = CAUSE_EBS_FAULT
            :: OFFBOARD_CHARGER_FAULT -> shutdown_cause = CAUSE_OFFBOARD_CHARGER_FAULT
            :: ai_comms_lost -> shutdown_cause = CAUSE_AI_COMMS_LOST
            :: direction_neutral && moving -> shutdown_cause = CAUSE_AUTONOMOUS_BRAKING_FAULT
            :: mission_finished && moving -> shutdown_cause = CAUSE_MISSION_STATUS_FAULT
            :: CHARGE_PROCEDURE_FAULT -> shutdown_cause = CAUSE_CHARGE_PROCEDURE_FAULT
            :: BMS_FAULT -> shutdown_cause = CAUSE_BMS_FAULT
            :: else
            fi
        /* 3.3: MISSION_STATUS == FINISHED and all wheel speeds < 10 rpm */
        :: mission_finished && at_rest -> next = AS_FINISHED
        :: else -> next = AS_DRIVING
        fi;
        remember(LIMIT_AS_DRIVING);
        FOUND(0, "violated: figure-2-arrows",
            !(state == EMERGENCY_BRAKE || state == AS_FINISHED || state == AS_DRIVING));
        FOUND(7, "violated: driving-go",
            !(before == AS_READY && state == AS_DRIVING -> armed_before && go_on :
            (state != AS_READY -> !go_seen_low :
            go_seen_low == (before == AS_READY && go_lawful)
            || (go_seen_low && in_state_ms + CYCLE_MS < DOCUMENT_READY_DWELL_MS))));
        FOUND(9, "violated: driving-sdc",
            !(state == EMERGENCY_BRAKE) && sdc_open);
        FOUND(10, "violated: driving-asms",
            !(state == EMERGENCY_BRAKE) && !asms);
        FOUND(11, "violated: driving-go-off",
            !(state == EMERGENCY_BRAKE) && !go_on);
        FOUND(12, "violated: driving-finished",
            !(state == EMERGENCY_BRAKE) && mission_finished && moving);
        FOUND(13, "violated: driving-neutral",
            !(state == EMERGENCY_BRAKE) && direction_neutral && moving);
        FOUND(14, "violated: driving-comms",
            !(state == EMERGENCY_BRAKE) && document_comms_lost);
        FOUND(15, "violated: driving-estop",
            !(state == EMERGENCY_BRAKE) && ai_estop);
        FOUND(28, "violated: comms-tsms",
            !(tsms || shutdown_cause == cause_before || shutdown_cause != CAUSE_AI_COMMS_LOST));
        FOUND(29, "violated: finished-at-rest",
            state == AS_FINISHED && !(mission_finished && at_rest));
        FOUND(30, "violated: finished-due",
            !(state == AS_FINISHED) && mission_finished && at_rest && !reason_to_brake);
        FOUND(31, "violated: brake-founded",
            !(state != EMERGENCY_BRAKE || reason_to_brake));
        FOUND(33, "violated: actuators",
            !(state != AS_DRIVING || (asms && go_on && !sdc_open)));
        FOUND(34, "violated: go-signal",
            !(!go_on || (state == AS_DRIVING -> before == AS_DRIVING || armed_before : !GO_RAW)));
        FOUND(38, "violated: power-cycle",
            !(cause_before == NO_SHUTDOWN || state == AS_OFF || state == EMERGENCY_BRAKE));
        FOUND(39, "violated: shutdown-cause",
            !(cause_before == NO_SHUTDOWN -> (shutdown_cause != NO_SHUTDOWN) == (state == EMERGENCY_BRAKE)
            : shutdown_cause == cause_before));
        FOUND(40, "violated: control-invariant",
            !(in_state_ms == (state == before -> (lasted_ms < limit(before) -> lasted_ms : limit(before)) : 0)
            && in_state_ms <= limit(state) && unanswered_ms <= HANDSHAKE_MS
            && (handshake_active || (!handshake_bit && unanswered_ms == 0))
            && (!go_seen_low || (state == AS_READY && (GO_EDGE_ENOUGH || in_state_ms >= LIMIT_AS_READY)))
            && ((FAULT_EDGE && state == AS_DRIVING) || !(was_running || was_forward))
            && (shutdown_cause != NO_SHUTDOWN || state != EMERGENCY_BRAKE)
            && power_cycle_needed == (shutdown_cause != NO_SHUTDOWN && POWER_CYCLE_LATCHED)
            && (!power_cycle_needed || state == EMERGENCY_BRAKE || state == AS_OFF)));
        if
        :: state != before || shutdown_cause != cause_before ->
            FOUND(46, "reached: arrow-3.7", state == EMERGENCY_BRAKE);
            FOUND(47, "reached: arrow-3.3", state == AS_FINISHED);
            FOUND(51, "reached: cause-1", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AI_ESTOP_REQUEST);
            FOUND(52, "reached: cause-2", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_HVIL_OPEN_FAULT);
            FOUND(53, "reached: cause-3", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_HVIL_SHORT_FAULT);
            FOUND(54, "reached: cause-4", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_EBS_FAULT);
            FOUND(55, "reached: cause-5", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_OFFBOARD_CHARGER_FAULT);
            FOUND(56, "reached: cause-6", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AI_COMMS_LOST);
            FOUND(57, "reached: cause-7", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AUTONOMOUS_BRAKING_FAULT);
            FOUND(58, "reached: cause-8", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_MISSION_STATUS_FAULT);
            FOUND(59, "reached: cause-9", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_CHARGE_PROCEDURE_FAULT);
            FOUND(60, "reached: cause-10", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_BMS_FAULT);
            skip
        :: else
        fi
        END_STEP
    }
}

inline step_EMERGENCY_BRAKE() {
    d_step {
        BEGIN_STEP
        before = EMERGENCY_BRAKE; cause_before = shutdown_cause; armed_before = go_seen_low;
        lasted_ms = in_state_ms + CYCLE_MS;
        handshake();
        if
        /* 3.9: EBS timer complete and AS master switch OFF */
        :: ebs_timer_complete && !asms -> next = AS_OFF
        :: else -> next = EMERGENCY_BRAKE
        fi;
        remember(LIMIT_EMERGENCY_BRAKE);
        FOUND(0, "violated: figure-2-arrows",
            !(state == AS_OFF || state == EMERGENCY_BRAKE));
        FOUND(7, "violated: driving-go",
            !(before == AS_READY && state == AS_DRIVING -> armed_before && go_on :
            (state != AS_READY -> !go_seen_low :
            go_seen_low == (before == AS_READY && go_lawful)
            || (go_seen_low && in_state_ms + CYCLE_MS < DOCUMENT_READY_DWELL_MS))));
        FOUND(28, "violated: comms-tsms",
            !(tsms || shutdown_cause == cause_before || shutdown_cause != CAUSE_AI_COMMS_LOST));
        FOUND(33, "violated: actuators",
            !(state != AS_DRIVING || (asms && go_on && !sdc_open)));
        FOUND(34, "violated: go-signal",
            !(!go_on || (state == AS_DRIVING -> before == AS_DRIVING || armed_before : !GO_RAW)));
        FOUND(35, "violated: brake-time",
            !(state == EMERGENCY_BRAKE || braked));
        FOUND(36, "violated: brake-asms",
            state == AS_OFF && !(!asms));
        FOUND(37, "violated: brake-due",
            !(state == AS_OFF) && braked && !asms);
        FOUND(38, "violated: power-cycle",
            !(cause_before == NO_SHUTDOWN || state == AS_OFF || state == EMERGENCY_BRAKE));
        FOUND(39, "violated: shutdown-cause",
            !(cause_before == NO_SHUTDOWN -> (shutdown_cause != NO_SHUTDOWN) == (state == EMERGENCY_BRAKE)
            : shutdown_cause == cause_before));
        FOUND(40, "violated: control-invariant",
            !(in_state_ms == (state == before -> (lasted_ms < limit(before) -> lasted_ms : limit(before)) : 0)
            && in_state_ms <= limit(state) && unanswered_ms <= HANDSHAKE_MS
            && (handshake_active || (!handshake_bit && unanswered_ms == 0))
            && (!go_seen_low || (state == AS_READY && (GO_EDGE_ENOUGH || in_state_ms >= LIMIT_AS_READY)))
            && ((FAULT_EDGE && state == AS_DRIVING) || !(was_running || was_forward))
            && (shutdown_cause != NO_SHUTDOWN || state != EMERGENCY_BRAKE)
            && power_cycle_needed == (shutdown_cause != NO_SHUTDOWN && POWER_CYCLE_LATCHED)
            && (!power_cycle_needed || state == EMERGENCY_BRAKE || state == AS_OFF)));
        if
        :: state != before || shutdown_cause != cause_before ->
            FOUND(48, "reached: arrow-3.9", state == AS_OFF);
            FOUND(51, "reached: cause-1", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AI_ESTOP_REQUEST);
            FOUND(52, "reached: cause-2", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_HVIL_OPEN_FAULT);
            FOUND(53, "reached: cause-3", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_HVIL_SHORT_FAULT);
            FOUND(54, "reached: cause-4", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_EBS_FAULT);
            FOUND(55, "reached: cause-5", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_OFFBOARD_CHARGER_FAULT);
            FOUND(56, "reached: cause-6", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AI_COMMS_LOST);
            FOUND(57, "reached: cause-7", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AUTONOMOUS_BRAKING_FAULT);
            FOUND(58, "reached: cause-8", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_MISSION_STATUS_FAULT);
            FOUND(59, "reached: cause-9", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_CHARGE_PROCEDURE_FAULT);
            FOUND(60, "reached: cause-10", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_BMS_FAULT);
            skip
        :: else
        fi
        END_STEP
    }
}

inline step_AS_FINISHED() {
    d_step {
        BEGIN_STEP
        before = AS_FINISHED; cause_before = shutdown_cause; armed_before = go_seen_low;
        lasted_ms = in_state_ms + CYCLE_MS;
        handshake();
        if
        /* 3.8: SDC open
         * or AI_COMMS_LOST (2.4)
         * or ESTOP_REQUEST == 1 (2.1) */
        :: sdc_open || ai_comms_lost || ai_estop -> next = EMERGENCY_BRAKE;
            power_cycle_needed = POWER_CYCLE_LATCHED;
            if
            :: shutdown_cause != NO_SHUTDOWN
            :: ai_estop -> shutdown_cause = CAUSE_AI_ESTOP_REQUEST
            :: HVIL_OPEN_FAULT -> shutdown_cause = CAUSE_HVIL_OPEN_FAULT
            :: HVIL_SHORT_FAULT -> shutdown_cause = CAUSE_HVIL_SHORT_FAULT
            :: EBS_FAULT -> shutdown_cause = CAUSE_EBS_FAULT
            :: OFFBOARD_CHARGER_FAULT -> shutdown_cause = CAUSE_OFFBOARD_CHARGER_FAULT
            :: ai_comms_lost -> shutdown_cause = CAUSE_AI_COMMS_LOST
            :: CHARGE_PROCEDURE_FAULT -> shutdown_cause = CAUSE_CHARGE_PROCEDURE_FAULT
            :: BMS_FAULT -> shutdown_cause = CAUSE_BMS_FAULT
            :: else
            fi
        /* 3.4: AS master switch OFF */
        :: !asms -> next = AS_OFF
        :: else -> next = AS_FINISHED
        fi;
        remember(LIMIT_AS_FINISHED);
        FOUND(0, "violated: figure-2-arrows",
            !(state == EMERGENCY_BRAKE || state == AS_OFF || state == AS_FINISHED));
        FOUND(7, "violated: driving-go",
            !(before == AS_READY && state == AS_DRIVING -> armed_before && go_on :
            (state != AS_READY -> !go_seen_low :
            go_seen_low == (before == AS_READY && go_lawful)
            || (go_seen_low && in_state_ms + CYCLE_MS < DOCUMENT_READY_DWELL_MS))));
        FOUND(21, "violated: finished-sdc",
            !(state == EMERGENCY_BRAKE) && sdc_open);
        FOUND(23, "violated: finished-asms",
            !(state == AS_OFF || state == EMERGENCY_BRAKE) && !asms);
        FOUND(25, "violated: finished-comms",
            !(state == EMERGENCY_BRAKE) && document_comms_lost);
        FOUND(27, "violated: finished-estop",
            !(state == EMERGENCY_BRAKE) && ai_estop);
        FOUND(28, "violated: comms-tsms",
            !(tsms || shutdown_cause == cause_before || shutdown_cause != CAUSE_AI_COMMS_LOST));
        FOUND(31, "violated: brake-founded",
            !(state != EMERGENCY_BRAKE || reason_to_brake));
        FOUND(32, "violated: off-founded",
            !(state != AS_OFF || !asms));
        FOUND(33, "violated: actuators",
            !(state != AS_DRIVING || (asms && go_on && !sdc_open)));
        FOUND(34, "violated: go-signal",
            !(!go_on || (state == AS_DRIVING -> before == AS_DRIVING || armed_before : !GO_RAW)));
        FOUND(38, "violated: power-cycle",
            !(cause_before == NO_SHUTDOWN || state == AS_OFF || state == EMERGENCY_BRAKE));
        FOUND(39, "violated: shutdown-cause",
            !(cause_before == NO_SHUTDOWN -> (shutdown_cause != NO_SHUTDOWN) == (state == EMERGENCY_BRAKE)
            : shutdown_cause == cause_before));
        FOUND(40, "violated: control-invariant",
            !(in_state_ms == (state == before -> (lasted_ms < limit(before) -> lasted_ms : limit(before)) : 0)
            && in_state_ms <= limit(state) && unanswered_ms <= HANDSHAKE_MS
            && (handshake_active || (!handshake_bit && unanswered_ms == 0))
            && (!go_seen_low || (state == AS_READY && (GO_EDGE_ENOUGH || in_state_ms >= LIMIT_AS_READY)))
            && ((FAULT_EDGE && state == AS_DRIVING) || !(was_running || was_forward))
            && (shutdown_cause != NO_SHUTDOWN || state != EMERGENCY_BRAKE)
            && power_cycle_needed == (shutdown_cause != NO_SHUTDOWN && POWER_CYCLE_LATCHED)
            && (!power_cycle_needed || state == EMERGENCY_BRAKE || state == AS_OFF)));
        if
        :: state != before || shutdown_cause != cause_before ->
            FOUND(41, "reached: whole-mission", state == AS_OFF && shutdown_cause == NO_SHUTDOWN);
            FOUND(49, "reached: arrow-3.8", state == EMERGENCY_BRAKE);
            FOUND(50, "reached: arrow-3.4", state == AS_OFF);
            FOUND(51, "reached: cause-1", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AI_ESTOP_REQUEST);
            FOUND(52, "reached: cause-2", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_HVIL_OPEN_FAULT);
            FOUND(53, "reached: cause-3", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_HVIL_SHORT_FAULT);
            FOUND(54, "reached: cause-4", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_EBS_FAULT);
            FOUND(55, "reached: cause-5", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_OFFBOARD_CHARGER_FAULT);
            FOUND(56, "reached: cause-6", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AI_COMMS_LOST);
            FOUND(57, "reached: cause-7", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_AUTONOMOUS_BRAKING_FAULT);
            FOUND(58, "reached: cause-8", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_MISSION_STATUS_FAULT);
            FOUND(59, "reached: cause-9", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_CHARGE_PROCEDURE_FAULT);
            FOUND(60, "reached: cause-10", cause_before == NO_SHUTDOWN && shutdown_cause == CAUSE_BMS_FAULT);
            skip
        :: else
        fi
        END_STEP
    }
}

active proctype vcu() {
    do
    :: atomic {
        state == AS_OFF ->
        SHOW_STATE
        all_off();
        any_of_1(asms);
        any_of_3(tsms, ami_selected, mission_selected);
        any_of_3(ebs_armed, go_on, ai_handshake);
        step_AS_OFF()
    }
    :: atomic {
        state == AS_READY && in_state_ms < 60 ->
        SHOW_STATE
        all_off();
        any_of_3(asms, tsms, go_on);
        any_of_3(ai_handshake, AI_ESTOP_REQUEST, HVIL_OPEN_FAULT);
        step_AS_READY()
    }
    :: atomic {
        state == AS_READY && in_state_ms >= 60 ->
        SHOW_STATE
        all_off();
        any_of_2(asms, tsms);
        any_of_3(front_torque_zero, rear_torque_zero, steer_request_zero);
        any_of_3(steer_straight, direction_neutral, go_on);
        any_of_3(ai_handshake, AI_ESTOP_REQUEST, HVIL_OPEN_FAULT);
        step_AS_READY()
    }
    :: atomic {
        state == AS_DRIVING ->
        SHOW_STATE
        all_off();
        if :: skip
           :: moving = 1
           :: at_rest = 1 fi;
        any_of_2(asms, tsms);
        any_of_3(mission_finished, direction_neutral, go_on);
        any_of_3(ai_handshake, AI_ESTOP_REQUEST, HVIL_OPEN_FAULT);
        step_AS_DRIVING()
    }
    :: atomic {
        state == EMERGENCY_BRAKE && in_state_ms < 70 ->
        SHOW_STATE
        all_off();
        any_of_3(tsms, go_on, ai_handshake);
        step_EMERGENCY_BRAKE()
    }
    :: atomic {
        state == EMERGENCY_BRAKE && in_state_ms >= 70 ->
        SHOW_STATE
        all_off();
        any_of_1(asms);
        any_of_3(tsms, go_on, ai_handshake);
        step_EMERGENCY_BRAKE()
    }
    :: atomic {
        state == AS_FINISHED ->
        SHOW_STATE
        all_off();
        any_of_3(asms, tsms, go_on);
        any_of_3(ai_handshake, AI_ESTOP_REQUEST, HVIL_OPEN_FAULT);
        step_AS_FINISHED()
    }
    :: d_step {
        state != AS_OFF || handshake_active || power_cycle_needed || shutdown_cause != NO_SHUTDOWN ->
        state = AS_OFF; in_state_ms = 0; go_seen_low = 0; handshake_active = 0; handshake_bit = 0; unanswered_ms = 0;
        power_cycle_needed = 0; shutdown_cause = NO_SHUTDOWN
#if FAULT_EDGE
        ; was_running = 0; was_forward = 0
#endif
       }
    od
}
