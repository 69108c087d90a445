//! `import adsdv`, whose Python is in `package/adsdv`: the specification of the ADS-DV AI/VCU interface, and the judge of its logs, from Python.
//!
//! ```text
//! edition.rs   editions, and what an edition lets say
//! machine.rs   Machine, Vcu: steps        control.rs   Control: what a VCU remembers
//! batch/       many steps in one call, on rows in buffers: dtype, rows, Machine.step_n, Machine.step_each
//! step.rs      Step: what a step did      codec.rs     decode, encode, frames, is_reserved
//! check.rs     check: judges a log        source.rs    what a log can be read from
//! many/        check_many: judges many logs  (reports.rs Reports, table.rs Table)
//! judge.rs     Judge: judges a live bus   report.rs    Report: what a judge says
//! rules.rs     a team's own rules
//! exam/        exam: examines a stack  (stack.rs in Python or a program; report.rs ExamReport)
//! tables.rs    inputs, outputs, messages, readings as lists of flat dicts
//! value.rs     Python's values from and to the specification's
//! error.rs     the exceptions
//! ```
//!
//! Nothing is decided here: each function takes Python's values apart, asks the specification or the oracle, and makes
//! Python's values of the answer. The documentation of what Python sees is Python's: its examples are doctests.

mod batch;
mod check;
mod codec;
mod control;
mod edition;
mod error;
mod exam;
mod judge;
mod machine;
mod many;
mod report;
mod rules;
mod source;
mod step;
mod tables;
mod value;

use pyo3::prelude::*;

/// The executable specification of the ADS-DV AI/VCU interface.
///
/// The state machine of the Vehicle Control Unit (VCU), the codec of its CAN messages, and the judge of recorded logs.
///
/// A VCU that steps:
///
/// >>> import adsdv
/// >>> vcu = adsdv.Vcu()
/// >>> step = vcu.step(asms=True, tsms=True, ami="TRACK_DRIVE", ebs="ARMED", mission_status="SELECTED")
/// >>> step.outputs["as_state"], step.section
/// ('AS_READY', '3.1')
///
/// A log that is judged:
///
/// >>> log = b"(1.000000) can0 520#0000010000000000\n(1.010000) can0 520#0000020000000000\n"
/// >>> adsdv.check(log).transitions
/// [{'t': 0.01, 'from': 'AS_OFF', 'to': 'AS_READY', 'section': '3.1', 'justified': 'unknown'}]
///
/// There is more than one edition of the interface, of which adsdv.editions() has the versions. Whatever depends on the
/// edition takes it as `edition`; where it is not said, it is that of adsdv.INTERFACE_VERSION, but check recognises it:
///
/// >>> adsdv.Vcu(edition="4.0").machine.edition
/// '4.0'
///
/// Whatever is given that is not what was expected is an AdsdvError, which is a ValueError; whatever cannot be read is an
/// OSError. Both say what was found, and what would have been right.
#[pymodule(name = "_adsdv")]
fn adsdv(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    error::add(module)?;
    edition::add(module)?;
    module.add_class::<control::Control>()?;
    module.add_class::<machine::Machine>()?;
    module.add_class::<machine::Vcu>()?;
    module.add_class::<step::Step>()?;
    module.add_class::<judge::Judge>()?;
    module.add_class::<report::Report>()?;
    module.add_function(wrap_pyfunction!(check::check, module)?)?;
    batch::add(module)?;
    many::add(module)?;
    exam::add(module)?;
    codec::add(module)?;
    tables::add(module)
}
