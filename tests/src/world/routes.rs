ROUTES    /// Sets all four wheel speeds.
    pub fn wheels(&mut self, rpm: i32) {
        let speed = WheelSpeed::clamped(rpm);
        self.inputs.vehicle.wheel_speeds = Vcu2AiWheelSpeeds {
            fl_wheel_speed: speed,
            fr_wheel_speed: speed,
            rl_wheel_speed: speed,
            rr_wheel_speed: speed,
        };
    }

    /// The operator prepares: everything that leads to AS_READY but ASMS.
    pub fn prepare(&mut self) {
        self.wait(300);
        self.inputs.tsms = true;
        self.inputs.ami = AmiState::TrackDrive;
        self.inputs.ebs = EbsState::Armed;
        self.wait(500);
        self.ai.status.mission_status = MissionStatus::Selected;
        self.wait(500);
    }

    /// To AS_READY.
    pub fn ready(&mut self) {
        self.prepare();
        self.inputs.asms = true;
        self.wait(500);
    }

    /// To AS_READY, with the dwell over.
    pub fn dwelt(&mut self) {
        self.ready();
        self.wait(6000);
    }

    /// To AS_DRIVING, with the wheels turning.
    pub fn driving(&mut self) {
        self.dwelt();
        self.inputs.go = true;
        self.wait(500);
        self.ai.status.mission_status = MissionStatus::Running;
        self.ai.status.direction_request = DirectionRequest::Forward;
        self.wait(500);
        self.wheels(200);
        self.wait(1000);
    }

    /// To AS_DRIVING, stopped again.
    pub fn stopped(&mut self) {
        self.driving();
        self.wheels(0);
        self.wait(500);
    }

    /// To AS_FINISHED.
    pub fn finished(&mut self) {
        self.stopped();
        self.ai.status.mission_status = MissionStatus::Finished;
        self.wait(500);
    }

