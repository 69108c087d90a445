//! What the VCU sees at a step, and which faults that is.
#![expect(clippy::inline_always, reason = "for speed, as in machine.rs")]

use crate::bus::Bus;
use crate::derives::data;
use crate::faults::{Fault, Faults};
use crate::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AmiState, AnyMessage, AxleTorque,
    AxleTorqueRequest, BrakePressure, DecodeError, EbsState, Frame, SpeedKmh, SteerAngle, SteerAngleMax,
    Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
};
use crate::silence::AiSilence;

data!(
    /// Everything that the VCU sees at one step. The default is a vehicle with everything off, at rest, without a fault.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct Inputs {
        /// The Autonomous System Master Switch is on.
        pub asms: bool,
        /// The Tractive System Master Switch is on.
        pub tsms: bool,
        /// The mission selected on the Autonomous Mission Indicator.
        pub ami: AmiState,
        /// The state of the Emergency Braking System, as it reports it.
        pub ebs: EbsState,
        /// The remote "Go" switch is on.
        pub go: bool,
        /// What opens the shutdown circuit.
        pub sdc: ShutdownCircuit,
        /// Faults and warnings that other controllers report.
        pub reports: Reports,
        /// The last valid messages of the AI Computer; the default stands for none yet.
        pub ai: AiMessages, //= D-35
        /// How long ago these messages came.
        pub ai_silence: AiSilence,
        /// What the vehicle's sensors measure.
        pub vehicle: Vehicle,
    }
);

data!(
    /// The causes of an open shutdown circuit (section 3.5). Each is true while it holds the circuit open.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct ShutdownCircuit {
        /// The remote E-stop button is pressed.
        pub remote_estop: bool, //= RTE-2
        /// The remote E-stop receiver has lost the transmitter.
        pub res_link_lost: bool, //= RTE-3
        /// An E-stop button on the vehicle is pressed.
        pub vehicle_estop: bool, //= RTE-4
        /// The inertial crash sensor is activated.
        pub crash_sensor: bool, //= RTE-5
        /// The VCU detects a critical system fault that has no flag of its own.
        pub critical_fault: bool, //= RTE-6
        /// The BMS detects a critical fault in the traction battery.
        pub bms_fault: bool, //= RTE-7
        /// The autonomous driving dongle is not in the Multi-Purpose Port.
        pub mpp_dongle_removed: bool, //= RTE-8
    }
);

data!(
    /// Faults and warnings that reach the VCU from elsewhere (the fault diagnostics of 520h, section 2.2).
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct Reports {
        /// HVIL or the shutdown circuit has an open circuit.
        pub hvil_open: bool,
        /// HVIL or the shutdown circuit has a short circuit.
        pub hvil_short: bool,
        /// The Emergency Braking System is faulty.
        pub ebs_fault: bool,
        /// The off-board charger is faulty.
        pub offboard_charger_fault: bool,
        /// The battery is being charged: a fault as soon as ASMS or TSMS is on.
        pub charging: bool,
        /// The traction battery is hot (a warning).
        pub batt_temp_high: bool,
        /// The traction battery's charge is low (a warning).
        pub batt_soc_low: bool,
    }
);

data!(
    /// The AI Computer's messages that the VCU acts on (section 2.1).
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct AiMessages {
        /// 510h.
        pub status: Ai2VcuStatus,
        /// 511h.
        pub drive_f: Ai2VcuDriveF,
        /// 512h.
        pub drive_r: Ai2VcuDriveR,
        /// 513h.
        pub steer: Ai2VcuSteer,
        /// 514h.
        pub brake: Ai2VcuBrake,
    }
);

impl AiMessages {
    /// The identifiers of these messages, ascending.
    pub const IDS: [u16; 5] =
        [Ai2VcuStatus::ID, Ai2VcuDriveF::ID, Ai2VcuDriveR::ID, Ai2VcuSteer::ID, Ai2VcuBrake::ID];

    /// Takes over what a frame of the bus says, and tells whether it is one of these messages.
    ///
    /// A frame that does not decode changes nothing, as if it had not come; the error says what is wrong with it.
    ///
    /// ```
    /// use adsdv_spec::{AiMessages, Edition};
    /// let (mut ai, bus) = (AiMessages::default(), Edition::V3_0.bus);
    /// assert_eq!(ai.receive(&bus, 0x513, &[0x9C, 0xFF]), Ok(true)); // -10.0 degrees
    /// assert_eq!(ai.steer.steer_request.raw(), -100);
    /// assert!(ai.receive(&bus, 0x513, &[0xF1, 0x00]).is_err()); // 24.1 degrees
    /// assert_eq!(ai.steer.steer_request.raw(), -100);
    /// assert_eq!(ai.receive(&bus, 0x520, &[]), Ok(false)); // the VCU's
    /// ```
    ///
    /// # Errors
    ///
    /// Fails if it is one of these messages and does not decode.
    pub fn receive(&mut self, bus: &Bus, id: u16, data: &[u8]) -> Result<bool, DecodeError> {
        self.receive_with(|id, data| bus.decode(id, data), id, data)
    }

    /// The same, for who knows how frames are read: [`Bus::read`] of an edition.
    ///
    /// # Errors
    ///
    /// As [`receive`](Self::receive).
    pub fn receive_with(
        &mut self,
        read: impl FnOnce(u16, &[u8]) -> Result<AnyMessage, DecodeError>,
        id: u16,
        data: &[u8],
    ) -> Result<bool, DecodeError> {
        //= D-20
        if !Self::IDS.contains(&id) {
            return Ok(false);
        }
        Ok(self.take(read(id, data)?))
    }

    /// Takes over a message, and tells whether it is one of these.
    pub const fn take(&mut self, message: AnyMessage) -> bool {
        match message {
            AnyMessage::Ai2VcuStatus(status) => self.status = status,
            AnyMessage::Ai2VcuDriveF(drive_f) => self.drive_f = drive_f,
            AnyMessage::Ai2VcuDriveR(drive_r) => self.drive_r = drive_r,
            AnyMessage::Ai2VcuSteer(steer) => self.steer = steer,
            AnyMessage::Ai2VcuBrake(brake) => self.brake = brake,
            _ => return false,
        }
        true
    }

    /// The messages, in the order of their identifiers.
    pub fn all(&self) -> [AnyMessage; 5] {
        [self.status.into(), self.drive_f.into(), self.drive_r.into(), self.steer.into(), self.brake.into()]
    }

    /// The frames of an edition, in the order of their identifiers.
    pub fn frames(&self, bus: &Bus) -> impl Iterator<Item = Frame> + use<> {
        let bus = *bus;
        self.all().into_iter().filter_map(move |message| bus.encode(message))
    }
}

data!(
    /// What the vehicle's sensors and controllers measure. All but the steer angle and the wheel speeds is only reported.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct Vehicle {
        /// The actual steer angle, positive to the left.
        pub steer_angle: SteerAngle,
        /// The largest steer angle that is allowed.
        pub steer_angle_max: SteerAngleMax,
        /// The wheel speeds (525h).
        pub wheel_speeds: Vcu2AiWheelSpeeds,
        /// The pulse counts of the wheel speed sensors (526h).
        pub wheel_counts: Vcu2AiWheelCounts,
        /// The actual drive torque at the front axle.
        pub front_axle_trq: AxleTorque,
        /// The actual drive torque at the rear axle.
        pub rear_axle_trq: AxleTorque,
        /// The largest drive torque that is allowed at the front axle.
        pub front_axle_trq_max: AxleTorqueRequest,
        /// The largest drive torque that is allowed at the rear axle.
        pub rear_axle_trq_max: AxleTorqueRequest,
        /// The actual hydraulic pressure of the front brakes.
        pub hyd_press_f: BrakePressure,
        /// The actual hydraulic pressure of the rear brakes.
        pub hyd_press_r: BrakePressure,
        /// The actual speed of the vehicle.
        pub speed: SpeedKmh,
    }
);

impl Inputs {
    /// The inputs nearest to these that an edition's messages can hold: steer angles within its own range, which may be
    /// narrower than that of all editions.
    ///
    /// ```
    /// use adsdv_spec::{Edition, Inputs};
    /// use adsdv_spec::messages::SteerAngle;
    /// let mut inputs = Inputs::default();
    /// inputs.ai.steer.steer_request = SteerAngle::MAX;
    /// assert_eq!(inputs.held_by(&Edition::V3_0.bus).ai.steer.steer_request.to_string(), "24 deg");
    /// ```
    #[must_use]
    pub fn held_by(mut self, bus: &Bus) -> Self {
        let within = |id, field, raw: i32| {
            let signal = bus.message(id).and_then(|message| message.signal_of(field));
            signal.map_or(raw, |signal| raw.clamp(signal.min, signal.max))
        };
        let Self { ai: AiMessages { steer, .. }, vehicle, .. } = &mut self;
        let (asked, told) = (Ai2VcuSteer::ID, Vcu2AiSteer::ID);
        steer.steer_request = SteerAngle::clamped(within(asked, "steer_request", steer.steer_request.raw()));
        vehicle.steer_angle = SteerAngle::clamped(within(told, "steer_angle", vehicle.steer_angle.raw()));
        vehicle.steer_angle_max =
            SteerAngleMax::clamped(within(told, "steer_angle_max", vehicle.steer_angle_max.raw()));
        self
    }

    /// The faults that the inputs alone decide.
    #[inline(always)]
    pub const fn faults(&self) -> Faults {
        let sdc = &self.sdc;
        let reports = &self.reports;
        // What opens the circuit without a number of its own is reported as an open circuit: see "Decisions" in
        // REQUIREMENTS.md.
        // Without branches, which are slower here than what they would spare.
        //= D-12, D-14
        let open = reports.hvil_open
            | sdc.remote_estop
            | sdc.res_link_lost
            | sdc.vehicle_estop
            | sdc.crash_sensor
            | sdc.critical_fault
            | sdc.mpp_dongle_removed;
        Faults::when(Fault::AiComputerRequest, self.ai.status.estop_request)
            .union(Faults::when(Fault::HvilOpenFault, open))
            .union(Faults::when(Fault::HvilShortFault, reports.hvil_short))
            .union(Faults::when(Fault::EbsFault, reports.ebs_fault))
            .union(Faults::when(Fault::OffboardChargerFault, reports.offboard_charger_fault))
            .union(Faults::when(Fault::ChargeProcedureFault, reports.charging && (self.asms || self.tsms)))
            .union(Faults::when(Fault::BmsFault, sdc.bms_fault))
    }
}
