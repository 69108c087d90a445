//! Every line of every plot over the whole recording, as the lowest and the highest value of each of many short times: the first
//! picture, however long the recording is.

use std::collections::HashMap;

use adsdv_spec::Bus;
use adsdv_spec::messages::SignalDef;
use serde::Serialize;

use crate::answers::Answer;
use crate::packed::Packer;
use crate::plots::{PlotJson, Source};
use crate::recording::{Kept, Recording};
use crate::time::micros;

/// So many times: about as many as a screen has columns.
const BUCKETS: u16 = 1000;

/// The picture of the whole.
#[derive(Serialize)]
pub(crate) struct OverviewJson {
    buckets: u16,
    /// How long each is, in microseconds.
    width: i64,
    packed: String,
}

/// The lowest and the highest value of each bucket; none where nothing came.
struct Line {
    source: Source,
    signal: Option<&'static SignalDef>,
    lowest: Vec<f32>,
    highest: Vec<f32>,
    /// When a frame of the message came last.
    last: Option<i64>,
}

impl Line {
    fn of(source: Source, bus: &Bus) -> Self {
        let signal = match source {
            Source::Signal { id, signal } => bus.message(id).and_then(|message| message.signal(signal)),
            Source::Period { .. } | Source::Answer => None,
        };
        let empty = vec![f32::NAN; BUCKETS.into()];
        Self { source, signal, lowest: empty.clone(), highest: empty, last: None }
    }

    /// The value that a frame of the message brings.
    fn value(&mut self, frame: &Kept) -> Option<f64> {
        if let Some(signal) = self.signal {
            return signal.raw(frame.data()).map(|raw| signal.physical(raw));
        }
        let now = micros(frame.t_ns);
        self.last.replace(now).map(|last| milliseconds(now - last))
    }

    #[allow(clippy::cast_possible_truncation, reason = "precise enough for a picture")]
    fn add(&mut self, bucket: usize, value: f64) {
        let value = value as f32;
        // The smaller of a number and of what is none is the number.
        if let Some(lowest) = self.lowest.get_mut(bucket) {
            *lowest = lowest.min(value);
        }
        if let Some(highest) = self.highest.get_mut(bucket) {
            *highest = highest.max(value);
        }
    }
}

/// The picture of the whole, with the lines in the order of the plots.
pub(crate) fn overview(
    recording: &Recording,
    answers: &[Answer],
    bus: &Bus,
    plots: &[PlotJson],
) -> OverviewJson {
    let sources = plots.iter().flat_map(|plot| &plot.lines).map(|line| line.source);
    let mut lines: Vec<Line> = sources.map(|source| Line::of(source, bus)).collect();
    let mut of_message: HashMap<u16, Vec<usize>> = HashMap::new();
    for (place, line) in lines.iter().enumerate() {
        match line.source {
            Source::Signal { id, .. } | Source::Period { id } => {
                of_message.entry(id).or_default().push(place);
            }
            Source::Answer => {}
        }
    }
    let width = micros(recording.end_ns) / i64::from(BUCKETS) + 1;
    let bucket = |t_ns: i64| usize::try_from(micros(t_ns) / width).unwrap_or_default();
    for frame in &recording.frames {
        for place in of_message.get(&frame.id).into_iter().flatten() {
            let Some(line) = lines.get_mut(*place) else { continue };
            if let Some(value) = line.value(frame) {
                line.add(bucket(frame.t_ns), value);
            }
        }
    }
    for line in lines.iter_mut().filter(|line| line.source == Source::Answer) {
        for answer in answers {
            line.add(bucket(answer.t_ns), milliseconds(micros(answer.took_ns)));
        }
    }
    let mut packer = Packer::default();
    for value in lines.iter().flat_map(|line| line.lowest.iter().chain(&line.highest)) {
        packer.float(*value);
    }
    OverviewJson { buckets: BUCKETS, width, packed: packer.pack() }
}

#[allow(clippy::cast_precision_loss, reason = "a duration for a picture")]
fn milliseconds(us: i64) -> f64 {
    us as f64 / 1e3
}
