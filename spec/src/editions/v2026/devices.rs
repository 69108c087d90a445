//! What else is on the bus of the vehicle of 2026, by its database: the remote control, the touchscreen, the joystick, the GPS and
//! inertial unit, and what the VCU tells them.
//!
//! The database declares every signal of one bit signed; such a flag is 0 or 1 here. It also has a message without a frame
//! (`C0000000h`), in which the touchscreen keeps counters of its own: that is not on the bus, and not here.

use super::super::v4_0::MISSIONS;
use crate::messages::DeviceMessage;
use crate::messages::device::devices;

// The names of numbers, as the database has them.
const COMMANDS: &[(i32, &str)] =
    &[(1, "Start"), (2, "Stop"), (128, "Pre-operational"), (129, "Reset node"), (130, "Reset communication")];
const NODES: &[(i32, &str)] = &[(0, "ALL_NODES"), (1, "RES_NODE"), (4, "UMB_NODE")];
const FALSE_TRUE: &[(i32, &str)] = &[(0, "FALSE"), (1, "TRUE")];
const OFF_ON: &[(i32, &str)] = &[(0, "OFF"), (1, "ON")];
const AXES: &[(i32, &str)] = &[(0, "undefined"), (1, "X Axis"), (2, "Y Axis"), (3, "Z Axis")];
const ORIENTATIONS: &[(i32, &str)] = &[
    (0, "flat"),
    (1, "flat upside down"),
    (2, "landscape left"),
    (3, "landscape right"),
    (4, "portrait"),
    (5, "portrait upside down"),
];
const ANTENNA: &[(i32, &str)] = &[(0, "INIT"), (1, "DONTKNOW"), (2, "OK"), (3, "SHORT"), (4, "OPEN")];
const NAVIGATION: &[(i32, &str)] = &[(0, "INIT"), (1, "NONE"), (2, "2D"), (3, "3D")];
const COMPASS: &[(i32, &str)] = &[(0, "INIT"), (69, "East"), (78, "North"), (83, "South"), (87, "West")];
const OFF_ON_OF_THE_UNIT: &[(i32, &str)] = &[(0, "Off"), (1, "On")];
const FALSE_TRUE_OF_THE_UNIT: &[(i32, &str)] = &[(0, "False"), (1, "True")];
const WEEKDAYS: &[(i32, &str)] = &[
    (0, "Monday"),
    (1, "Tuesday"),
    (2, "Wednesday"),
    (3, "Thursday"),
    (4, "Friday"),
    (5, "Saturday"),
    (6, "Sunday"),
];
const GYRO_SCALES: &[(i32, &str)] = &[(0, "±250 °/s"), (1, "±500 °/s"), (2, "±2000 °/s"), (3, "±2000 °/s")];
const ACCELERATION_SCALES: &[(i32, &str)] = &[(1, "±2 G"), (2, "±4 G"), (3, "±8 G"), (4, "±16 G")];
const MONTHS: &[(i32, &str)] = &[
    (1, "January"),
    (2, "February"),
    (3, "March"),
    (4, "April"),
    (5, "May"),
    (6, "June"),
    (7, "July"),
    (8, "August"),
    (9, "September"),
    (10, "October"),
    (11, "November"),
    (12, "December"),
];
const CALIBRATION: &[(i32, &str)] = &[(0, "0 G"), (1, "+1 G"), (2, "-1 G")];

//= MSG-115, D-70
/// Every message of the devices, by ascending identifier.
pub(super) const DEVICES: &[DeviceMessage] = devices! {
    "NMT" 0x000 from Vcu, 2 bytes, every 100 ms {
        "CMD" 0|8 Unsigned, 1.0, 0.0, 0.0 to 255.0, of COMMANDS;
        "NODE_ID" 8|8 Unsigned, 1.0, 0.0, 0.0 to 255.0, of NODES;
    }

    "SYNC" 0x080 from Vcu, 0 bytes, every 5 ms {}

    "RES_EMCY" 0x081 from Res, 8 bytes, every 10 ms {
        "RES_EEC" 0|16 Unsigned, 1.0, 0.0, 0.0 to 65535.0;
        "RES_ER" 16|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "RES_Fault_ID" 24|16 Unsigned, 1.0, 0.0, 0.0 to 65535.0;
    }

    "UMB_EMCY" 0x084 from Joystick, 8 bytes, every 100 ms {
        "UMB_EEC" 0|16 Unsigned, 1.0, 0.0, 0.0 to 65535.0;
        "UMB_ER" 16|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "UMB_Fault_ID" 24|16 Unsigned, 1.0, 0.0, 0.0 to 65535.0;
    }

    "OPUS2VCU_FB" 0x123 from Opus, 1 bytes, every 100 ms {
        "AMI_STATE" 0|4 Unsigned, 1.0, 0.0, 0.0 to 15.0, of MISSIONS;
        "BRK_DISCH_REQ" 4|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of FALSE_TRUE;
        "CHARGE_REQ" 5|1 Unsigned, 1.0, 0.0, 0.0 to 1.0;
    }

    "RES_TPDO" 0x181 from Res, 8 bytes, every 10 ms {
        "ESTOP_STATUS" 0|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of OFF_ON;
        "K2_SWITCH_GO_STATUS" 1|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of OFF_ON;
        "K3_SWITCH_STATUS" 2|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of OFF_ON;
        "RADIO_STRENGTH" 48|8 Unsigned, 1.0, 0.0, 0.0 to 255.0, "%";
    }

    "UMB_PDO1" 0x184 from Joystick, 2 bytes, every 5 ms {
        "BTN_TOP" 0|1 Unsigned, 1.0, 0.0, 0.0 to 1.0;
        "BTN_BTM" 3|1 Unsigned, 1.0, 0.0, 0.0 to 1.0;
    }

    "UMB_PDO2" 0x284 from Joystick, 4 bytes, every 100 ms {
        "YPOS" 0|16 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "XPOS" 16|16 Unsigned, 1.0, 0.0, 0.0 to 255.0;
    }

    "VCU2OPUS_1" 0x300 from Vcu, 8 bytes, every 10 ms {
        "KL15_ADC" 0|16 Unsigned, 0.001, 0.0, 0.0 to 65.535, "V";
        "VBAT_ADC" 16|16 Unsigned, 0.001, 0.0, 0.0 to 65.535, "V";
        "AUX_HV" 32|16 Unsigned, 0.001, 0.0, 0.0 to 65.535, "V";
        "LEM_500A_ADC" 48|16 Unsigned, 0.25, -625.0, -625.0 to 15758.75, "A";
    }

    "VCU2OPUS_2" 0x301 from Vcu, 8 bytes, every 10 ms {
        "EBS_FRONT_ACC_PRESS" 0|16 Signed, 0.01, 0.0, -327.68 to 327.67, "Bar";
        "EBS_REAR_ACC_PRESS" 16|16 Signed, 0.01, 0.0, -327.68 to 327.67, "Bar";
        "EBS_FRONT_CALIPER_PRESS" 32|16 Signed, 0.01, 0.0, -327.68 to 327.67, "Bar";
        "EBS_REAR_CALIPER_PRESS" 48|16 Signed, 0.01, 0.0, -327.68 to 327.67, "Bar";
    }

    "VCU2OPUS_3" 0x302 from Vcu, 8 bytes, every 10 ms {
        "EBS_TEST_BITFIELD" 0|16 Unsigned, 1.0, 0.0, 0.0 to 65535.0;
        "EBS_TEST_BITFIELD_LATCHED" 16|16 Unsigned, 1.0, 0.0, 0.0 to 65535.0;
    }

    "BMC_Acceleration" 0x600 from PcanGps, 8 bytes, no cycle {
        "Acceleration_X" 0|16 Signed, 3.91, 0.0, -20000.0 to 20000.0, "mG";
        "Acceleration_Y" 16|16 Signed, 3.91, 0.0, -20000.0 to 20000.0, "mG";
        "Acceleration_Z" 32|16 Signed, 3.91, 0.0, -20000.0 to 20000.0, "mG";
        "Temperature" 48|8 Signed, 0.5, 24.0, -40.0 to 87.5, "°C";
        "VerticalAxis" 56|2 Unsigned, 1.0, 0.0, 0.0 to 3.0, of AXES;
        "Orientation" 58|3 Unsigned, 1.0, 0.0, 0.0 to 7.0, of ORIENTATIONS;
    }

    "L3GD20_Rotation_A" 0x610 from PcanGps, 8 bytes, no cycle {
        "Rotation_X" 0|32 Float, 1.0, 0.0, -4000.0 to 4000.0, "°/s";
        "Rotation_Y" 32|32 Float, 1.0, 0.0, -4000.0 to 4000.0, "°/s";
    }

    "L3GD20_Rotation_B" 0x611 from PcanGps, 4 bytes, no cycle {
        "Rotation_Z" 0|32 Float, 1.0, 0.0, -4000.0 to 4000.0, "°/s";
    }

    "GPS_Status" 0x620 from PcanGps, 3 bytes, no cycle {
        "GPS_AntennaStatus" 0|8 Unsigned, 1.0, 0.0, 0.0 to 255.0, of ANTENNA;
        "GPS_NumSatellites" 8|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "GPS_NavigationMethod" 16|8 Unsigned, 1.0, 0.0, 0.0 to 255.0, of NAVIGATION;
    }

    "GPS_CourseSpeed" 0x621 from PcanGps, 8 bytes, no cycle {
        "GPS_Course" 0|32 Float, 1.0, 0.0, -3.4e38 to 3.4e38, "°";
        "GPS_Speed" 32|32 Float, 1.0, 0.0, -3.4e38 to 3.4e38, "km/h";
    }

    "GPS_PositionLongitude" 0x622 from PcanGps, 7 bytes, no cycle {
        "GPS_Longitude_Minutes" 0|32 Float, 1.0, 0.0, -3.4e38 to 3.4e38, "'";
        "GPS_Longitude_Degree" 32|16 Unsigned, 1.0, 0.0, 0.0 to 359.0, "°";
        "GPS_IndicatorEW" 48|8 Unsigned, 1.0, 0.0, 0.0 to 255.0, of COMPASS;
    }

    "GPS_PositionLatitude" 0x623 from PcanGps, 7 bytes, no cycle {
        "GPS_Latitude_Minutes" 0|32 Float, 1.0, 0.0, -3.4e38 to 3.4e38, "'";
        "GPS_Latitude_Degree" 32|16 Unsigned, 1.0, 0.0, 0.0 to 359.0, "°";
        "GPS_IndicatorNS" 48|8 Unsigned, 1.0, 0.0, 0.0 to 255.0, of COMPASS;
    }

    "GPS_PositionAltitude" 0x624 from PcanGps, 4 bytes, no cycle {
        "GPS_Altitude" 0|32 Float, 1.0, 0.0, -3.4e38 to 3.4e38, "m";
    }

    "GPS_Delusions_A" 0x625 from PcanGps, 8 bytes, no cycle {
        "GPS_PDOP" 0|32 Float, 1.0, 0.0, -3.4e38 to 3.4e38;
        "GPS_HDOP" 32|32 Float, 1.0, 0.0, -3.4e38 to 3.4e38;
    }

    "GPS_Delusions_B" 0x626 from PcanGps, 4 bytes, no cycle {
        "GPS_VDOP" 0|32 Float, 1.0, 0.0, -3.4e38 to 3.4e38;
    }

    "GPS_DateTime" 0x627 from PcanGps, 6 bytes, no cycle {
        "UTC_Year" 0|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "UTC_Month" 8|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "UTC_DayOfMonth" 16|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "UTC_Hour" 24|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "UTC_Minute" 32|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "UTC_Second" 40|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
    }

    "BMC_MagneticField" 0x628 from PcanGps, 6 bytes, no cycle {
        "MagneticField_X" 0|16 Signed, 0.3, 0.0, -9830.4 to 9830.1, "µT";
        "MagneticField_Y" 16|16 Signed, 0.3, 0.0, -9830.4 to 9830.1, "µT";
        "MagneticField_Z" 32|16 Signed, 0.3, 0.0, -9830.4 to 9830.1, "µT";
    }

    "IO" 0x630 from PcanGps, 1 bytes, no cycle {
        "Din1_Status" 0|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of OFF_ON_OF_THE_UNIT;
        "Din2_Status" 1|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of OFF_ON_OF_THE_UNIT;
        "Dout_Status" 2|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of OFF_ON_OF_THE_UNIT;
        "SD_Present" 3|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of FALSE_TRUE_OF_THE_UNIT;
        "GPS_PowerStatus" 4|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of OFF_ON_OF_THE_UNIT;
        "Device_ID" 5|3 Unsigned, 1.0, 0.0, 0.0 to 7.0;
    }

    "RTC_DateTime" 0x640 from PcanGps, 8 bytes, no cycle {
        "RTC_Sec" 0|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "RTC_Min" 8|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "RTC_Hour" 16|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "RTC_DayOfWeek" 24|8 Unsigned, 1.0, 0.0, 0.0 to 255.0, of WEEKDAYS;
        "RTC_DayOfMonth" 32|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "RTC_Month" 40|8 Unsigned, 1.0, 0.0, 0.0 to 255.0;
        "RTC_Year" 48|16 Unsigned, 1.0, 0.0, 0.0 to 65535.0;
    }

    "Out_IO" 0x650 from PcanGps, 1 bytes, no cycle {
        "Dout_Set" 0|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of OFF_ON_OF_THE_UNIT;
        "GPS_SetPower" 1|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of OFF_ON_OF_THE_UNIT;
    }

    "Out_PowerOff" 0x651 from PcanGps, 1 bytes, no cycle {
        "Device_PowerOff" 0|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of FALSE_TRUE_OF_THE_UNIT;
    }

    "Out_Gyro" 0x652 from PcanGps, 1 bytes, no cycle {
        "Gyro_SetScale" 0|2 Unsigned, 1.0, 0.0, 0.0 to 3.0, "°/s", of GYRO_SCALES;
    }

    "Out_BMC_AccScale" 0x653 from PcanGps, 1 bytes, no cycle {
        "Acc_SetScale" 0|3 Unsigned, 1.0, 0.0, 0.0 to 7.0, of ACCELERATION_SCALES;
    }

    "Out_SaveConfig" 0x654 from PcanGps, 1 bytes, no cycle {
        "Config_SaveToEEPROM" 0|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of FALSE_TRUE_OF_THE_UNIT;
    }

    "Out_RTC_SetTime" 0x655 from PcanGps, 8 bytes, no cycle {
        "RTC_SetSec" 0|8 Unsigned, 1.0, 0.0, 0.0 to 59.0;
        "RTC_SetMin" 8|8 Unsigned, 1.0, 0.0, 0.0 to 59.0;
        "RTC_SetHour" 16|8 Unsigned, 1.0, 0.0, 0.0 to 23.0;
        "RTC_SetDayOfWeek" 24|8 Unsigned, 1.0, 0.0, 0.0 to 6.0, of WEEKDAYS;
        "RTC_SetDayOfMonth" 32|8 Unsigned, 1.0, 0.0, 1.0 to 31.0;
        "RTC_SetMonth" 40|8 Unsigned, 1.0, 0.0, 1.0 to 12.0, of MONTHS;
        "RTC_SetYear" 48|16 Unsigned, 1.0, 0.0, 1900.0 to 2099.0;
    }

    "Out_RTC_TimeFromGPS" 0x656 from PcanGps, 1 bytes, no cycle {
        "RTC_SetTimeFromGPS" 0|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of FALSE_TRUE_OF_THE_UNIT;
    }

    "Out_Acc_FastCalibration" 0x657 from PcanGps, 4 bytes, no cycle {
        "Acc_SetCalibTarget_X" 0|2 Unsigned, 1.0, 0.0, 0.0 to 3.0, of CALIBRATION;
        "Acc_SetCalibTarget_Y" 8|2 Unsigned, 1.0, 0.0, 0.0 to 3.0, of CALIBRATION;
        "Acc_SetCalibTarget_Z" 16|2 Unsigned, 1.0, 0.0, 0.0 to 3.0, of CALIBRATION;
        "Acc_StartFastCalib" 24|1 Unsigned, 1.0, 0.0, 0.0 to 1.0, of FALSE_TRUE_OF_THE_UNIT;
    }
};
