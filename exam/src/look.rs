//! What is seen of both sides at a cycle: all that an expectation may be about.

use std::collections::VecDeque;

use adsdv_can::car::Car;
use adsdv_can::demo::wire::Node;
use adsdv_spec::messages::{
    Ai2LogDynamics2, Ai2VcuStatus, AmiState, AnyMessage, AsState, DirectionRequest, Frame, MissionStatus,
    Vcu2AiStatus,
};
use adsdv_spec::{AiMessages, Atom, Atoms, Edition};

/// The messages that the AI Computer sends (section 2.1): what it tells the VCU, and what it tells the logger.
pub(crate) const SENT: [u16; 6] = {
    let [status, drive_f, drive_r, steer, brake] = AiMessages::IDS;
    [status, drive_f, drive_r, steer, brake, Ai2LogDynamics2::ID]
};

/// The time in which frames are counted, in milliseconds.
const COUNTED_MS: u64 = 1000;
/// For so long what the VCU said counts, in milliseconds.
const FRESH_MS: u64 = 100;

/// What is seen at the end of a cycle.
#[derive(Clone, Debug)]
pub struct Look {
    /// The time since the start of the scenario, in milliseconds.
    pub time_ms: u64,
    /// The AS state; `None` while the VCU is without power.
    pub state: Option<AsState>,
    /// For how long it has lasted, in milliseconds.
    pub state_ms: u64,
    /// For how long the AI Computer has run and heard the VCU, in milliseconds; `None` before.
    pub runs_ms: Option<u64>,
    /// 520h as the VCU said it last, if that is not long ago.
    pub vcu: Option<Vcu2AiStatus>,
    /// 510h as the AI Computer said it last.
    pub ai: Option<Ai2VcuStatus>,
    /// All that the AI Computer says to the VCU; at its defaults where it said nothing.
    pub requests: AiMessages,
    /// What holds of these requests, of the wheels and of the steering.
    pub atoms: Atoms,
    /// Whether "Go" was turned on when the five seconds of AS_READY were over, and still is.
    pub go_in_time: bool,
    /// Whether the vehicle has moved since AS_DRIVING began.
    pub has_moved: bool,
    /// Whether brakes were requested when it moved last in AS_DRIVING.
    pub braked: bool,
    /// How much later than it was sent something may be seen, in milliseconds: nothing in simulated time.
    pub(crate) jitter_ms: u64,
    /// When each message of [`SENT`] came last.
    last: [Option<u64>; SENT.len()],
    /// When each of them came in the last second.
    counted: [VecDeque<u64>; SENT.len()],
    go: bool,
    vcu_ms: u64,
}

impl Look {
    pub(crate) fn new() -> Self {
        Self {
            time_ms: 0,
            state: None,
            state_ms: 0,
            runs_ms: None,
            vcu: None,
            ai: None,
            requests: AiMessages::default(),
            atoms: Atoms::default(),
            go_in_time: false,
            has_moved: false,
            braked: false,
            jitter_ms: 0,
            last: [None; SENT.len()],
            counted: std::array::from_fn(|_| VecDeque::new()),
            go: false,
            vcu_ms: 0,
        }
    }

    /// A frame was on the bus.
    pub(crate) fn frame(&mut self, edition: &Edition, from: Node, frame: &Frame) {
        match from {
            Node::Vcu => {
                if let Ok(AnyMessage::Vcu2AiStatus(status)) = edition.bus.decode(frame.id, frame.data()) {
                    self.vcu = Some(status);
                    self.vcu_ms = self.time_ms;
                }
            }
            Node::Ai => {
                if let Some(place) = SENT.iter().position(|id| *id == frame.id) {
                    self.last[place] = Some(self.time_ms);
                    self.counted[place].push_back(self.time_ms);
                }
                // What does not decode is for the judge to tell.
                let _ = self.requests.receive(&edition.bus, frame.id, frame.data());
                if let Ok(AnyMessage::Ai2VcuStatus(status)) = edition.bus.decode(frame.id, frame.data()) {
                    self.ai = Some(status);
                }
            }
        }
    }

    /// The cycle that began at this time is over.
    pub(crate) fn cycle(&mut self, time_ms: u64, car: &Car, stack_runs: bool) {
        let cycle_ms = u64::from(car.cycle_ms());
        let state = car.outputs().map(|outputs| outputs.state);
        if self.state == state {
            self.state_ms += cycle_ms;
        } else {
            (self.state, self.state_ms) = (state, 0);
        }
        self.time_ms = time_ms + cycle_ms;
        if self.time_ms > self.vcu_ms + FRESH_MS {
            self.vcu = None;
        }
        self.runs_ms = match self.runs_ms {
            Some(runs_ms) => Some(runs_ms + cycle_ms),
            None => (stack_runs && self.vcu.is_some()).then_some(0),
        };
        for times in &mut self.counted {
            while times.front().is_some_and(|time| time + COUNTED_MS < self.time_ms) {
                times.pop_front();
            }
        }
        let thresholds = &car.machine().edition().rules.thresholds;
        let AiMessages { status, drive_f, drive_r, steer, brake } = &self.requests;
        self.atoms = status
            .atoms()
            .union(drive_f.atoms())
            .union(drive_r.atoms())
            .union(steer.atoms())
            .union(brake.atoms())
            .union(car.inputs().vehicle.wheel_speeds.atoms(thresholds))
            .union(car.inputs().vehicle.steer_angle.atoms(thresholds));
        self.follow_go(car);
        self.follow_wheels();
    }

    fn follow_go(&mut self, car: &Car) {
        let dwell_ms = u64::from(car.machine().edition().rules.timing.ready_dwell_ms);
        let go = car.inputs().go;
        let rises = go && !self.go;
        let in_time = self.state == Some(AsState::Ready) && self.state_ms > dwell_ms;
        self.go_in_time = go && (self.go_in_time || rises && in_time);
        self.go = go;
    }

    fn follow_wheels(&mut self) {
        if self.state != Some(AsState::Driving) {
            (self.has_moved, self.braked) = (false, false);
        } else if self.is_moving() {
            self.has_moved = true;
            self.braked = !self.atoms.has(Atom::BrakeRequestZero);
        }
    }

    /// Whether the AS state is this one.
    pub fn is(&self, state: AsState) -> bool {
        self.state == Some(state)
    }

    /// Whether a wheel turns faster than 10 rpm, as the VCU shows it.
    pub fn is_moving(&self) -> bool {
        self.atoms.has(Atom::Moving)
    }

    /// Whether all wheels turn slower than that.
    pub fn is_at_rest(&self) -> bool {
        self.atoms.has(Atom::AtRest)
    }

    /// Whether the steering is as straight as AS_DRIVING needs it: in AS_READY no AI Computer can turn it.
    pub fn is_straight(&self) -> bool {
        self.atoms.has(Atom::SteerStraight)
    }

    /// Whether the AI Computer requests the service brake.
    pub fn brakes(&self) -> bool {
        !self.atoms.has(Atom::BrakeRequestZero)
    }

    /// Whether the AI Computer says this of its mission.
    pub fn says(&self, status: MissionStatus) -> bool {
        self.ai.is_some_and(|ai| ai.mission_status == status)
    }

    /// Whether the AI Computer requests FORWARD.
    pub fn is_forward(&self) -> bool {
        self.ai.is_some_and(|ai| ai.direction_request == DirectionRequest::Forward)
    }

    /// Whether the VCU shows a mission that is selected on the AMI.
    pub fn shows_mission(&self) -> bool {
        self.vcu.is_some_and(|vcu| vcu.ami_state != AmiState::NotSelected)
    }

    /// Whether the VCU waits for an answer to its HANDSHAKE bit.
    pub fn is_unanswered(&self) -> bool {
        self.runs_ms.is_some()
            && self.vcu.is_some_and(|vcu| self.ai.is_none_or(|ai| ai.handshake != vcu.handshake))
    }

    /// Whether a message of the AI Computer has come.
    pub fn has_come(&self, id: u16) -> bool {
        self.last_of(id).is_some()
    }

    /// For how long, at least, a message that has come before has not come now, in milliseconds.
    pub fn silent_ms(&self, id: u16) -> u64 {
        self.last_of(id).map_or(0, |last| self.time_ms.saturating_sub(last + self.jitter_ms))
    }

    /// How many frames of a message came in the last second.
    pub fn rate(&self, id: u16) -> usize {
        let place = SENT.iter().position(|sent| *sent == id);
        place.and_then(|place| self.counted.get(place)).map_or(0, VecDeque::len)
    }

    fn last_of(&self, id: u16) -> Option<u64> {
        let place = SENT.iter().position(|sent| *sent == id)?;
        *self.last.get(place)?
    }

    /// What the AI Computer says, in words.
    pub fn words(&self) -> String {
        let state = self.state.map_or("a VCU without power", AsState::name);
        let Some(ai) = self.ai else { return format!("no 510h that can be read, in {state}") };
        let mut words = format!("MISSION_STATUS {}, {} in {state}", ai.mission_status, ai.direction_request);
        let AiMessages { drive_f, drive_r, steer, brake, .. } = &self.requests;
        let requests = [
            (
                "front torque",
                drive_f.front_axle_trq_request.raw(),
                drive_f.front_axle_trq_request.to_string(),
            ),
            ("rear torque", drive_r.rear_axle_trq_request.raw(), drive_r.rear_axle_trq_request.to_string()),
            ("steer", steer.steer_request.raw(), steer.steer_request.to_string()),
            ("front brake", brake.hyd_press_f_req.raw(), brake.hyd_press_f_req.to_string()),
            ("rear brake", brake.hyd_press_r_req.raw(), brake.hyd_press_r_req.to_string()),
        ];
        let requested = requests.into_iter().filter(|(_, raw, _)| *raw != 0);
        words.extend(requested.map(|(what, _, value)| format!(", {what} {value}")));
        words
    }
}
