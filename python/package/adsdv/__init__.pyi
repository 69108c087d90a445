"""The executable specification of the ADS-DV AI/VCU interface. What is meant by each name, its docstring says.

Names with an underscore are for type checkers alone; the module does not have them.
"""

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, Literal, Protocol, TypedDict, final, overload

from typing_extensions import Buffer, Unpack

__version__: str
INTERFACE_VERSION: str

class AdsdvError(ValueError): ...
class InputError(AdsdvError): ...
class RulesError(InputError):
    line: int
    column: int
    mistakes: list[_RuleMistake]
    more: int

class _RuleMistake(TypedDict):
    line: int
    column: int
    width: int
    why: str

class CodecError(AdsdvError): ...
class StackError(AdsdvError): ...
class LogError(AdsdvError): ...

# What has a buffer: a structured array of NumPy, bytearray, memoryview, array.array, and more.
_Rows = Buffer
_Of = Literal["inputs", "outputs", "control"]

_Ami = Literal[
    "NOT_SELECTED",
    "ACCELERATION",
    "SKIDPAD",
    "AUTOCROSS",
    "TRACK_DRIVE",
    "STATIC_INSPECTION_A",
    "STATIC_INSPECTION_B",
    "AUTONOMOUS_DEMO",
    "NOT SELECTED",
    "TRACK DRIVE",
    "STATIC INSPECTION A",
    "STATIC INSPECTION B",
    "AUTONOMOUS DEMO",
]
_AsState = Literal["AS_OFF", "AS_READY", "AS_DRIVING", "EMERGENCY_BRAKE", "AS_FINISHED"]
_Direction = Literal["NEUTRAL", "FORWARD"]
_Ebs = Literal["UNAVAILABLE", "ARMED", "TRIGGERED"]
_MissionStatus = Literal["NOT SELECTED", "SELECTED", "RUNNING", "FINISHED"]
_ShutdownCause = Literal[
    "NO SHUTDOWN",
    "AI COMPUTER REQUEST",
    "HVIL OPEN FAULT",
    "HVIL SHORT FAULT",
    "EBS FAULT",
    "OFFBOARD CHARGER FAULT",
    "AI COMMS FAULT",
    "AUTONOMOUS BRAKING FAULT",
    "MISSION STATUS FAULT",
    "CHARGE PROCEDURE FAULT",
    "BMS FAULT",
    "NO_SHUTDOWN",
    "AI_COMPUTER_REQUEST",
    "HVIL_OPEN_FAULT",
    "HVIL_SHORT_FAULT",
    "EBS_FAULT",
    "OFFBOARD_CHARGER_FAULT",
    "AI_COMMS_FAULT",
    "AUTONOMOUS_BRAKING_FAULT",
    "MISSION_STATUS_FAULT",
    "CHARGE_PROCEDURE_FAULT",
    "BMS_FAULT",
    "BRAKE_PLAUSIBILITY_FAULT",
]

# AS_INIT is a name of 520h since 2026; it counts as AS_OFF, and no step of a Vcu shows it.
_ShownAsState = Literal["AS_INIT", "AS_OFF", "AS_READY", "AS_DRIVING", "EMERGENCY_BRAKE", "AS_FINISHED"]
_OpState = Literal["OP_INIT", "OP_PUSHBAR", "OP_AUTO", "OP_CHARGE", "OP_FAULT"]
_TsState = Literal["TS_INIT", "TS_PRECHARGE", "TS_ACTIVATE", "TS_RUNNING", "TS_SHUTDOWN", "TS_FAULT"]
_EbsStage = Literal[
    "EBS_INIT", "EBS_CHARGING", "EBS_ARMED", "EBS_TRIGGERED", "EBS_DISCHARGING", "EBS_FAULT"
]

_Path = str | os.PathLike[str]
_Log = str | os.PathLike[str] | bytes | bytearray | memoryview | Iterable[str] | Iterable[bytes]
_Data = bytes | bytearray | memoryview | Sequence[int]
_Readings = Mapping[str, str]

class _Inputs(TypedDict, total=False):
    asms: bool
    tsms: bool
    ami: _Ami
    ebs: _Ebs
    go: bool
    remote_estop: bool
    res_link_lost: bool
    vehicle_estop: bool
    crash_sensor: bool
    critical_fault: bool
    bms_fault: bool
    mpp_dongle_removed: bool
    hvil_open: bool
    hvil_short: bool
    ebs_fault: bool
    offboard_charger_fault: bool
    charging: bool
    batt_temp_high: bool
    batt_soc_low: bool
    handshake: bool
    estop_request: bool
    mission_status: _MissionStatus
    direction_request: _Direction
    front_axle_trq_request: int
    front_motor_speed_max: int
    rear_axle_trq_request: int
    rear_motor_speed_max: int
    steer_request: int
    hyd_press_f_req: int
    hyd_press_r_req: int
    status_silence_ms: int
    drive_f_silence_ms: int
    drive_r_silence_ms: int
    steer_silence_ms: int
    brake_silence_ms: int
    steer_angle: int
    fl_wheel_speed: int
    fr_wheel_speed: int
    rl_wheel_speed: int
    rr_wheel_speed: int

class _OutputsOfAll(TypedDict):
    as_state: _ShownAsState
    handshake: bool
    go_signal: bool
    steering_status: bool
    shutdown_cause: _ShutdownCause
    as_switch_status: bool
    ts_switch_status: bool
    ami_state: _Ami
    shutdown_request: bool
    fault_status: bool
    ai_estop_request: bool
    hvil_open_fault: bool
    hvil_short_fault: bool
    ebs_fault: bool
    offboard_charger_fault: bool
    ai_comms_lost: bool
    autonomous_braking_fault: bool
    mission_status_fault: bool
    charge_procedure_fault: bool
    bms_fault: bool
    warning_status: bool
    warn_batt_temp_high: bool
    warn_batt_soc_low: bool
    front_axle_trq: int
    front_motor_speed_max: int
    rear_axle_trq: int
    rear_motor_speed_max: int
    direction: _Direction
    hyd_press_f: int
    hyd_press_r: int
    ebs_triggered: bool
    steer: int | None

class _Outputs(_OutputsOfAll, total=False):
    brake_plausibility_fault: bool
    op_state: _OpState
    ts_state: _TsState
    ebs_state: _EbsStage

class _Control(TypedDict):
    state: _AsState
    in_state_ms: int
    go_seen_low: bool
    was_running: bool
    was_forward: bool
    handshake_active: bool
    handshake_bit: bool
    handshake_unanswered_ms: int
    power_cycle_needed: bool
    shutdown_cause: _ShutdownCause

class _ControlGiven(TypedDict, total=False):
    state: _AsState
    in_state_ms: int
    go_seen_low: bool
    was_running: bool
    was_forward: bool
    handshake_active: bool
    handshake_bit: bool
    handshake_unanswered_ms: int
    power_cycle_needed: bool
    shutdown_cause: _ShutdownCause

class _Message(TypedDict):
    name: str
    id: int
    sender: Literal["AI", "VCU"]
    signals: dict[str, float]
    raw: dict[str, int]
    names: dict[str, str]

_Transition = TypedDict(
    "_Transition",
    {
        "t": float,
        "from": _AsState,
        "to": _AsState,
        "section": str,
        "justified": Literal["true", "false", "unknown"],
    },
)

class _Evidence(TypedDict):
    t: float
    id: str

class _Finding(TypedDict):
    t: float
    severity: Literal["violation", "warning", "note"]
    party: Literal["AI", "VCU", "LOG", "OWN"]
    section: str
    rule: str
    requirements: list[str]
    message: str
    seen: str
    expected: str | None
    unless: str | None
    evidence: list[_Evidence]

class _Response(TypedDict):
    count: int
    min: float
    median: float
    p99: float
    max: float

class _Recognised(TypedDict):
    certain: bool
    evidence: list[str]
    against: list[str]

class _ReportOfAll(TypedDict):
    schema: int
    edition: str
    frames: int
    duration_s: float
    transitions: list[_Transition]
    findings: list[_Finding]
    handshake_response_ms: _Response | None
    verdict: Literal["conforms", "violates"]

class _Breach(TypedDict):
    t: float
    seen: str

class _RuleOfAll(TypedDict):
    name: str
    line: int
    rule: str
    verdict: Literal["holds", "broken", "never decided"]
    held: int
    broken: int
    undecided: int
    breaches: list[_Breach]

class _Rule(_RuleOfAll, total=False):
    note: str
    why: str

class _Report(_ReportOfAll, total=False):
    recognised: _Recognised
    rules: list[_Rule]

class _InputField(TypedDict):
    key: str
    part: str
    kind: Literal["flag", "name", "number"]
    min: int | None
    max: int | None
    names: list[str] | None
    unit: str
    default: bool | str | int

class _OutputField(TypedDict):
    key: str
    kind: Literal["flag", "name", "number"]
    min: int | None
    max: int | None
    names: list[str] | None
    nullable: bool

class _Signal(TypedDict):
    message: str
    id: int
    sender: Literal["AI", "VCU"]
    length: int
    signal: str
    start: int
    width: int
    signed: bool
    scale: float
    unit: str
    min: int
    max: int
    values: dict[int, str]
    doc: str

class _Reading(TypedDict):
    id: str
    section: str
    question: str
    choices: dict[str, str]
    default: str

_Outcome = Literal["pass", "fail", "not exercised"]
_Sends = Iterable[tuple[int, _Data]]
_Step = Callable[[int, list[tuple[int, bytes]]], _Sends]

class _Stack(Protocol):
    # By their places, whatever they are called.
    def step(self, t_ms: int, frames: list[tuple[int, bytes]], /) -> _Sends: ...

_MakesStack = Callable[[], _Stack] | Callable[[], _Step]

class _Requirement(TypedDict):
    id: str
    section: str
    about: str

class _Examined(_Requirement):
    outcome: _Outcome
    accepted: str | None
    findings: list[int]
    why: str | None

class _ExamScenario(TypedDict):
    name: str
    about: str
    quick: bool

class _ScenarioOutcome(TypedDict):
    name: str
    about: str
    duration: float
    frames: int
    findings: int
    exercised: list[str]
    stuck: str | None

class _Action(TypedDict):
    t: float
    did: str

class _Sent(TypedDict):
    t: float
    by: Literal["AI", "VCU"]
    frame: str

class _ExamFindingOfAll(TypedDict):
    scenario: str
    t: float
    section: str
    rule: str
    requirements: list[str]
    accepted: bool
    seen: str
    expected: str
    operator: list[_Action]
    car: str
    frames: list[_Sent]
    shortest: str | None

class _ExamFinding(_ExamFindingOfAll, total=False):
    trace: str

class _ExamReport(TypedDict):
    schema: int
    edition: str
    program: list[str]
    scenarios: list[_ScenarioOutcome]
    requirements: list[_Examined]
    findings: list[_ExamFinding]
    slowest_answer_ms: float | None
    notes: list[str]
    unused: list[str]
    passes: bool

@final
class Control:
    def __new__(
        cls, fields: Mapping[str, Any] | None = None, /, **keywords: Unpack[_ControlGiven]
    ) -> Control: ...
    @property
    def state(self) -> _AsState: ...
    @property
    def in_state_ms(self) -> int: ...
    @property
    def go_seen_low(self) -> bool: ...
    @property
    def was_running(self) -> bool: ...
    @property
    def was_forward(self) -> bool: ...
    @property
    def handshake_active(self) -> bool: ...
    @property
    def handshake_bit(self) -> bool: ...
    @property
    def handshake_unanswered_ms(self) -> int: ...
    @property
    def power_cycle_needed(self) -> bool: ...
    @property
    def shutdown_cause(self) -> _ShutdownCause: ...
    def to_dict(self) -> _Control: ...
    def __hash__(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...

@final
class Machine:
    def __new__(cls, readings: _Readings | None = None, edition: str | None = None) -> Machine: ...
    @property
    def edition(self) -> str: ...
    @property
    def readings(self) -> dict[str, str]: ...
    def step(
        self,
        control: Control,
        inputs: Mapping[str, Any] | None = None,
        dt_ms: int | None = None,
        **keywords: Unpack[_Inputs],
    ) -> Step: ...
    def step_n(
        self,
        control: Control,
        inputs: _Rows,
        dt_ms: int | _Rows | None = None,
        *,
        controls: _Rows | None = None,
        outputs: _Rows | None = None,
    ) -> Control: ...
    def step_each(
        self,
        controls: _Rows,
        inputs: _Rows,
        dt_ms: int | _Rows | None = None,
        *,
        outputs: _Rows | None = None,
    ) -> None: ...
    def __hash__(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...

@final
class Vcu:
    control: Control
    def __new__(cls, readings: _Readings | None = None, edition: str | None = None) -> Vcu: ...
    @property
    def state(self) -> _AsState: ...
    @property
    def machine(self) -> Machine: ...
    def step(
        self,
        inputs: Mapping[str, Any] | None = None,
        dt_ms: int | None = None,
        **keywords: Unpack[_Inputs],
    ) -> Step: ...
    def receive(self, id: int, data: _Data) -> bool: ...
    def reset(self) -> None: ...

@final
class Step:
    @property
    def control(self) -> Control: ...
    @property
    def outputs(self) -> _Outputs: ...
    @property
    def before(self) -> _AsState: ...
    @property
    def state(self) -> _AsState: ...
    @property
    def row(self) -> int | None: ...
    @property
    def section(self) -> str | None: ...
    @property
    def conditions(self) -> list[str]: ...

@final
class Judge:
    def __new__(
        cls,
        *,
        readings: _Readings | None = None,
        window_ms: int | None = None,
        deadline_ms: int | None = None,
        edition: str | None = None,
        rules: str | None = None,
    ) -> Judge: ...
    @property
    def edition(self) -> str: ...
    @property
    def state(self) -> _AsState | None: ...
    @property
    def handshake_response_ms(self) -> _Response | None: ...
    def frame(self, time: float, id: int, data: _Data) -> None: ...
    def news(self) -> tuple[list[_Transition], list[_Finding]]: ...
    def finish(self) -> Report: ...

@final
class Report:
    def __new__(cls, report: Mapping[str, Any], /) -> Report: ...
    @property
    def edition(self) -> str: ...
    @property
    def recognised(self) -> _Recognised | None: ...
    @property
    def verdict(self) -> Literal["conforms", "violates"]: ...
    @property
    def transitions(self) -> list[_Transition]: ...
    @property
    def findings(self) -> list[_Finding]: ...
    @property
    def violations(self) -> list[_Finding]: ...
    @property
    def rules(self) -> list[_Rule]: ...
    @property
    def frames(self) -> int: ...
    @property
    def duration_s(self) -> float: ...
    @property
    def handshake_response_ms(self) -> _Response | None: ...
    def to_dict(self) -> _Report: ...
    def __eq__(self, other: object) -> bool: ...

@final
class Table:
    @property
    def column_names(self) -> list[str]: ...
    def columns(self) -> dict[str, list[Any]]: ...
    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...
    def __len__(self) -> int: ...

@final
class Reports:
    @property
    def paths(self) -> list[str]: ...
    @property
    def errors(self) -> dict[str, AdsdvError | OSError]: ...
    @property
    def passed_over(self) -> list[str]: ...
    @property
    def worst_first(self) -> list[str]: ...
    @property
    def logs(self) -> Table: ...
    @property
    def findings(self) -> Table: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, index: int, /) -> Report: ...
    @overload
    def __getitem__(self, index: slice, /) -> tuple[Report, ...]: ...
    def __iter__(self) -> Iterator[Report]: ...

@final
class ExamReport:
    @property
    def edition(self) -> str: ...
    @property
    def passes(self) -> bool: ...
    @property
    def verdict(self) -> Literal["passes", "fails"]: ...
    @property
    def requirements(self) -> list[_Examined]: ...
    @property
    def failed(self) -> list[_Examined]: ...
    def requirement(self, id: str) -> _Examined: ...
    @property
    def findings(self) -> list[_ExamFinding]: ...
    @property
    def scenarios(self) -> list[_ScenarioOutcome]: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def slowest_answer_ms(self) -> float | None: ...
    @property
    def logs(self) -> dict[str, bytes]: ...
    def explain(self, id: str | None = None) -> str: ...
    def to_dict(self) -> _ExamReport: ...
    def to_json(self) -> str: ...
    def __eq__(self, other: object) -> bool: ...

def exam(
    stack: _MakesStack | Sequence[str | os.PathLike[str]],
    *,
    edition: str | None = None,
    only: str | Iterable[str] | None = None,
    quick: bool = False,
    scenario: str | None = None,
    runs: int | None = None,
    seed: int | None = None,
    shrink: int | None = None,
    mission_time: float | None = None,
    timeout: float | None = None,
    time_limit: float | None = None,
    logs: bool | str | os.PathLike[str] | None = None,
) -> ExamReport: ...
def exam_requirements(edition: str | None = None) -> list[_Requirement]: ...
def exam_scenarios() -> list[_ExamScenario]: ...
def check(
    log: _Log,
    *,
    readings: _Readings | None = None,
    window_ms: int | None = None,
    deadline_ms: int | None = None,
    interface: str | None = None,
    edition: str | None = None,
    rules: str | None = None,
) -> Report: ...
def check_many(
    paths: _Path | Iterable[_Path],
    *,
    readings: _Readings | None = None,
    window_ms: int | None = None,
    deadline_ms: int | None = None,
    interface: str | None = None,
    edition: str | None = None,
    rules: str | None = None,
    progress: Callable[[int, int, int, int], object] | None = None,
    threads: int | None = None,
) -> Reports: ...
def editions() -> list[str]: ...
def dtype(of: _Of, edition: str | None = None) -> list[tuple[str, str]]: ...
def numbers(of: _Of, key: str, edition: str | None = None) -> dict[str, int]: ...
def rows(of: _Of, count: int, edition: str | None = None) -> bytearray: ...
def decode(id: int, data: _Data, edition: str | None = None) -> _Message: ...
def encode(
    message: str | int, /, *, edition: str | None = None, **signals: float | str
) -> tuple[int, bytes]: ...
def frames(step: Step) -> list[tuple[int, bytes]]: ...
def is_reserved(id: int, edition: str | None = None) -> bool: ...
def inputs(edition: str | None = None) -> list[_InputField]: ...
def outputs(edition: str | None = None) -> list[_OutputField]: ...
def messages(edition: str | None = None) -> list[_Signal]: ...
def readings(edition: str | None = None) -> list[_Reading]: ...
