//! What a program sees of its inputs.

use adsdv_spec::Inputs;
use adsdv_spec::messages::WheelSpeed;

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
            let counts = WheelSpeed::clamped(wheels.counted(each.map(WheelSpeed::raw)));
            (speeds.fl_wheel_speed, speeds.fr_wheel_speed) = (counts, counts);
            (speeds.rl_wheel_speed, speeds.rr_wheel_speed) = (counts, counts);
        }
    }
    let opens = |rest: &Rest| matches!(*rest, Rest::Opens { field, raw } if (field.get)(inputs) == raw);
    // One of those that open it, whichever: what counts is that it is open.
    seen.sdc.vehicle_estop |= deviations.iter().any(opens);
    seen
}
