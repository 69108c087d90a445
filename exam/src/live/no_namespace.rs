//! Network namespaces on systems that have none.

use super::error::LiveError;

/// There are none here.
///
/// # Errors
///
/// Always.
pub fn prepare() -> Result<(), LiveError> {
    Err(LiveError::new(
        "--namespace",
        "only Linux has network namespaces",
        "try adsdv exam --stdio, which needs no CAN",
    ))
}

pub(super) fn enter(_: &str) -> Result<(), LiveError> {
    prepare()
}
