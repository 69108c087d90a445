//! What a program sees of its inputs.

use adsdv_spec::Inputs;
use adsdv_spec::messages::WheelSpeed;

use crate::deviation::Wheels;
use crate::rest::Rest;

/// The inputs as deviations let a program see them.
pub(crate) fn as_seen(deviations: &[Rest], inputs: &Inputs) -> Inputs {
    let mut seen = *inputs;
    for rest in deviations {
        if let Rest::Ignores { field } = rest {
            (field.set)(&mut seen, (field.get)(&Inputs::default()));
        }
        if let Rest::Wheels(wheels) = rest {
            let speeds = &mut seen.vehicle.wheel_speeds;
            let each =
                [speeds.fl_wheel_speed, speeds.fr_wheel_speed, speeds.rl_wheel_speed, speeds.rr_wheel_speed];
            let counts = match wheels {
                Wheels::All => each.iter().map(|wheel| wheel.raw()).min(),
                Wheels::Only(wheel) => each.get(usize::from(*wheel)).map(|wheel| wheel.raw()),
            };
            let counts = WheelSpeed::clamped(counts.unwrap_or_default());
            (speeds.fl_wheel_speed, speeds.fr_wheel_speed) = (counts, counts);
            (speeds.rl_wheel_speed, speeds.rr_wheel_speed) = (counts, counts);
        }
    }
    seen
}
