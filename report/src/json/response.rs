//! How fast the AI Computer answered the handshake.

use adsdv_oracle::judge::ResponseTimes;
use serde::Serialize;

use super::number::to_microseconds;

#[derive(Serialize)]
pub(super) struct ResponseJson {
    count: u64,
    min: f64,
    median: f64,
    p99: f64,
    max: f64,
}

impl ResponseJson {
    pub(super) fn of(times: &ResponseTimes) -> Option<Self> {
        Some(Self {
            count: times.count(),
            min: to_microseconds(times.min_ms()?),
            median: to_microseconds(times.quantile_ms(0.5)?),
            p99: to_microseconds(times.quantile_ms(0.99)?),
            max: to_microseconds(times.max_ms()?),
        })
    }
}
