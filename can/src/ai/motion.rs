//! How the vehicle moves, as the AI Computer takes it from wheel speeds and steer angle.

use adsdv_spec::messages::{Acceleration, Ai2LogDynamics2, YawRate};

use super::measured::Measured;
use crate::car::Physics;

/// The time constant that takes the steps out of the measured speed, in milliseconds.
const SMOOTHING_MS: f64 = 100.0;

/// How the vehicle moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Motion {
    /// Metres per second.
    pub(super) speed_mps: f64,
    /// The same without the steps of the measurement.
    smooth_mps: f64,
    /// Metres per second squared.
    longitudinal: f64,
    lateral: f64,
    /// Degrees per second.
    yaw_rate: f64,
}

impl Motion {
    pub(super) fn measure(&mut self, measured: &Measured, physics: &Physics, dt_ms: u32) {
        let speeds = &measured.wheel_speeds;
        let rear = [speeds.rl_wheel_speed, speeds.rr_wheel_speed];
        let rpm = rear.iter().map(|speed| speed.to_physical()).sum::<f64>() / 2.0;
        self.speed_mps = rpm / physics.rpm_per_mps();
        // Smoothed over 100 ms, the slope is what is still missing, divided by that time.
        self.longitudinal = (self.speed_mps - self.smooth_mps) * 1000.0 / SMOOTHING_MS;
        self.smooth_mps +=
            (self.speed_mps - self.smooth_mps) * (1.0 - (-f64::from(dt_ms) / SMOOTHING_MS).exp());
        let curvature = measured.steer_angle.to_physical().to_radians().tan() / physics.wheelbase_m;
        self.lateral = self.speed_mps * self.speed_mps * curvature;
        self.yaw_rate = (self.speed_mps * curvature).to_degrees();
    }

    /// What the AI Computer sends to the data logger.
    pub(super) fn logged(&self) -> Ai2LogDynamics2 {
        let acceleration = |mps2: f64| Acceleration::from_mps2(mps2).unwrap_or_default();
        Ai2LogDynamics2 {
            accel_longitudinal: acceleration(self.longitudinal),
            accel_lateral: acceleration(self.lateral),
            yaw_rate: YawRate::from_degps(self.yaw_rate).unwrap_or_default(),
        }
    }
}
