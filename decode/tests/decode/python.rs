//! The interpreter that has what our files are held against: cantools, mcap and jsonschema.
//!
//! It is `ADSDV_PYTHON`; without it these tests say that they are left out, unless `ADSDV_REQUIRE_PYTHON_CAN` is 1.

/// The interpreter, if there is one.
pub(crate) fn python() -> Option<String> {
    let python = std::env::var("ADSDV_PYTHON").ok().filter(|python| !python.is_empty());
    if python.is_none() {
        assert_ne!(
            std::env::var("ADSDV_REQUIRE_PYTHON_CAN").as_deref(),
            Ok("1"),
            "ADSDV_PYTHON has to name an interpreter with cantools, mcap and jsonschema"
        );
        eprintln!("left out: ADSDV_PYTHON names no interpreter with cantools, mcap and jsonschema");
    }
    python
}
