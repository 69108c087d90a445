//! A plain vehicle: first order everywhere, and obedient.
//!
//! It is there so that wheel speeds and the steer angle follow what reaches the actuators; it is no model of the ADS-DV. What
//! the document does not say (mass, wheels, how fast an actuator is) is [`Physics`], and, but for the gears, made up to be
//! plausible.

use adsdv_spec::Actuation;
use adsdv_spec::messages::{
    AxleTorque, AxleTorqueRequest, BrakePressure, DirectionRequest, MotorSpeedMax, SpeedKmh, SteerAngle,
    SteerAngleMax, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds, WheelSpeed,
};

/// What the simulation is made of. None of it comes from the document.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Physics {
    /// The mass, in kilograms.
    pub mass_kg: f64,
    /// The radius of a wheel, in metres.
    pub wheel_radius_m: f64,
    /// The turns of a motor for each turn of its wheels.
    pub gear_ratio: f64,
    /// The distance between the axles, in metres.
    pub wheelbase_m: f64,
    /// The distance between the wheels of an axle, in metres.
    pub track_m: f64,
    /// What full pressure on both axles takes off the speed, in metres per second squared.
    pub full_braking_mps2: f64,
    /// What rolling takes off the speed, in metres per second squared.
    pub rolling_mps2: f64,
    /// What air takes off the speed: this much for each square of metres per second, in metres per second squared.
    pub drag_per_m: f64,
    /// The time constant of motors and brakes, in milliseconds.
    pub force_lag_ms: f64,
    /// The time constant of the steering, in milliseconds.
    pub steer_lag_ms: f64,
    /// How fast the steer angle changes at most, in degrees a second.
    pub steer_rate_degps: f64,
    /// Pulses of a wheel speed sensor in one turn.
    pub pulses_per_turn: f64,
}

impl Physics {
    /// A small racing car.
    pub const DEFAULT: Self = Self {
        mass_kg: 180.0,
        wheel_radius_m: 0.25,
        // The ADS-DV's own: 4000 rpm of a motor are 1143 rpm of a wheel.
        gear_ratio: 3.5,
        wheelbase_m: 1.53,
        track_m: 1.2,
        full_braking_mps2: 8.0,
        rolling_mps2: 0.2,
        drag_per_m: 0.003,
        force_lag_ms: 60.0,
        steer_lag_ms: 120.0,
        steer_rate_degps: 90.0,
        pulses_per_turn: 20.0,
    };

    /// How many turns a minute the wheels make at a metre per second.
    pub(crate) fn rpm_per_mps(&self) -> f64 {
        60.0 / (std::f64::consts::TAU * self.wheel_radius_m)
    }

    /// The speed at which a motor or a wheel turns as fast as the document lets it, in metres per second.
    fn top_mps(&self) -> f64 {
        let of_a_motor = MotorSpeedMax::MAX.to_physical() / self.gear_ratio;
        of_a_motor.min(WheelSpeed::MAX.to_physical()) / self.rpm_per_mps()
    }
}

/// The vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vehicle {
    physics: Physics,
    /// Metres per second, never backwards.
    speed: f64,
    /// Degrees of the bicycle model, positive to the left.
    steer: f64,
    /// Newton metres at the axles; negative brakes.
    front_trq: f64,
    rear_trq: f64,
    /// Percent of the highest pressure.
    front_brake: f64,
    rear_brake: f64,
    /// Turns of each wheel: front left, front right, rear left, rear right.
    turns: [f64; 4],
    /// Metres.
    distance: f64,
}

impl Vehicle {
    /// A vehicle at rest, wheels straight.
    pub const fn new(physics: Physics) -> Self {
        Self {
            physics,
            speed: 0.0,
            steer: 0.0,
            front_trq: 0.0,
            rear_trq: 0.0,
            front_brake: 0.0,
            rear_brake: 0.0,
            turns: [0.0; 4],
            distance: 0.0,
        }
    }

    /// Its speed, in metres per second.
    pub const fn speed_mps(&self) -> f64 {
        self.speed
    }

    /// How far it has come, in metres.
    pub const fn distance_m(&self) -> f64 {
        self.distance
    }

    /// Obeys its actuators for a while.
    pub fn advance(&mut self, asked: &Actuation, dt_ms: u32) {
        let physics = self.physics;
        let dt_ms = f64::from(dt_ms);
        let forces = share(dt_ms, physics.force_lag_ms);
        let torque = |request: AxleTorqueRequest, limit: MotorSpeedMax| match asked.direction {
            DirectionRequest::Neutral => 0.0,
            // The request has a size only; beyond the speed limit of the motor it brakes (section 2.1).
            DirectionRequest::Forward if self.wheel_rpm() * physics.gear_ratio > limit.to_physical() => {
                -request.to_physical()
            }
            DirectionRequest::Forward => request.to_physical(),
        };
        let front_trq = torque(asked.front_axle_trq, asked.front_motor_speed_max);
        let rear_trq = torque(asked.rear_axle_trq, asked.rear_motor_speed_max);
        approach(&mut self.front_trq, front_trq, forces);
        approach(&mut self.rear_trq, rear_trq, forces);
        approach(&mut self.front_brake, asked.hyd_press_f.to_physical(), forces);
        approach(&mut self.rear_brake, asked.hyd_press_r.to_physical(), forces);
        if let Some(steer) = asked.steer {
            let wanted = (steer.to_physical() - self.steer) * share(dt_ms, physics.steer_lag_ms);
            let most = physics.steer_rate_degps * dt_ms / 1000.0;
            self.steer += wanted.clamp(-most, most);
        }
        self.roll(dt_ms / 1000.0);
    }

    fn roll(&mut self, dt: f64) {
        let physics = self.physics;
        let pushed = (self.front_trq + self.rear_trq) / physics.wheel_radius_m / physics.mass_kg;
        let braked = (self.front_brake + self.rear_brake) / 200.0 * physics.full_braking_mps2;
        // Brakes and friction stop a vehicle; they do not push it back.
        let held = braked + physics.rolling_mps2 + physics.drag_per_m * self.speed * self.speed;
        let before = self.speed;
        self.speed = (self.speed + (pushed - held) * dt).clamp(0.0, physics.top_mps());
        let distance = f64::midpoint(before, self.speed) * dt;
        self.distance += distance;
        let factors = self.wheel_factors();
        for (turns, factor) in self.turns.iter_mut().zip(factors) {
            *turns += distance * factor / (std::f64::consts::TAU * physics.wheel_radius_m);
        }
    }

    /// The mean speed of the wheels, in turns a minute.
    fn wheel_rpm(&self) -> f64 {
        self.speed * self.physics.rpm_per_mps()
    }

    /// How much further each wheel goes in a turn than the middle of the rear axle.
    fn wheel_factors(&self) -> [f64; 4] {
        let Physics { wheelbase_m, track_m, .. } = self.physics;
        // To the left the left wheels are the inner ones.
        let curvature = self.steer.to_radians().tan() / wheelbase_m;
        let side = curvature * track_m / 2.0;
        let front = |side: f64| (1.0 + side).hypot(curvature * wheelbase_m);
        [front(-side), front(side), 1.0 - side, 1.0 + side]
    }

    /// Writes what the sensors say.
    pub fn measure(&self, seen: &mut adsdv_spec::Vehicle) {
        let [fl, fr, rl, rr] =
            self.wheel_factors().map(|factor| WheelSpeed::clamped(rounded(self.wheel_rpm() * factor)));
        let counts = self.turns.map(|turns| pulse_count(turns * self.physics.pulses_per_turn));
        let wheel_counts = {
            let [fl_pulse_count, fr, rl, rr] = counts;
            Vcu2AiWheelCounts { fl_pulse_count, fr_pulse_count: fr, rl_pulse_count: rl, rr_pulse_count: rr }
        };
        *seen = adsdv_spec::Vehicle {
            steer_angle: SteerAngle::from_deg(self.steer).unwrap_or_default(),
            steer_angle_max: SteerAngleMax::MAX,
            wheel_speeds: Vcu2AiWheelSpeeds {
                fl_wheel_speed: fl,
                fr_wheel_speed: fr,
                rl_wheel_speed: rl,
                rr_wheel_speed: rr,
            },
            wheel_counts,
            front_axle_trq: AxleTorque::from_nm(self.front_trq).unwrap_or_default(),
            rear_axle_trq: AxleTorque::from_nm(self.rear_trq).unwrap_or_default(),
            front_axle_trq_max: AxleTorqueRequest::MAX,
            rear_axle_trq_max: AxleTorqueRequest::MAX,
            hyd_press_f: BrakePressure::from_pct(self.front_brake).unwrap_or_default(),
            hyd_press_r: BrakePressure::from_pct(self.rear_brake).unwrap_or_default(),
            speed: SpeedKmh::clamped(rounded(self.speed * 3.6)),
        };
    }
}

/// How much of the way to its goal something of the first order goes in this time.
fn share(dt_ms: f64, lag_ms: f64) -> f64 {
    1.0 - (-dt_ms / lag_ms).exp()
}

fn approach(value: &mut f64, goal: f64, share: f64) {
    *value += (goal - *value) * share;
}

/// The nearest whole number. Quantities keep it in their range.
#[expect(clippy::cast_possible_truncation, reason = "a cast keeps what is too much at the limit")]
fn rounded(value: f64) -> i32 {
    value.round() as i32
}

/// A counter of 16 bits that begins again when it is full.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is kept in range before")]
fn pulse_count(pulses: f64) -> u16 {
    pulses.floor().rem_euclid(65536.0) as u16
}
