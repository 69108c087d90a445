//! A deviation by its id.

use adsdv_conform::protocol::{INPUTS, SHOWN};
use adsdv_spec::mutation::{Change, Threshold, Time};
use adsdv_spec::{AsState, Edition};

use crate::deviation::Deviation;

impl Deviation {
    /// The deviation with this [id](Self::id), with any number in the place of one; `None` if no deviation has it.
    ///
    /// ```
    /// use adsdv_diagnosis::Deviation;
    /// use adsdv_spec::Edition;
    ///
    /// let late = Deviation::find(&Edition::V3_0, "ready-driving:late:2").unwrap();
    /// assert_eq!(late.text(&Edition::V3_0).to_string(), "AS_READY -> AS_DRIVING 2 steps late");
    /// assert_eq!(Deviation::find(&Edition::V3_0, "ready-driving:early"), None);
    /// ```
    pub fn find(edition: &Edition, id: &str) -> Option<Self> {
        let is_it = |one: &Self| one.id(edition) == id;
        Self::every(edition).into_iter().find(is_it).or_else(|| with_numbers(id).into_iter().find(is_it))
    }
}

/// All deviations that have the number, or the key and the value, that an id ends with.
fn with_numbers(id: &str) -> Vec<Deviation> {
    let last = id.rsplit(':').next().unwrap_or_default();
    let mut all = Vec::new();
    if let Ok(by) = last.trim_end_matches("ms").parse() {
        let times = [Time::ReadyDwell, Time::EbsTimer, Time::Handshake];
        let thresholds = [Threshold::WheelSpeed, Threshold::Straight, Threshold::Missed];
        all.extend(times.map(|time| Deviation::Changed(Change::Time(time, by))));
        all.extend(thresholds.map(|threshold| Deviation::Changed(Change::Threshold(threshold, by))));
    }
    let arrows = || AsState::ALL.into_iter().flat_map(|from| AsState::ALL.map(|to| (from, to)));
    if let Ok(steps) = last.parse() {
        all.extend(arrows().map(|(from, to)| Deviation::Late { from, to, steps }));
    }
    let Some((key, raw)) = last.split_once('=') else { return all };
    if let (Ok(value), Ok(raw)) = (key.parse(), raw.parse()) {
        all.extend(written(id).map(|key| Deviation::Writes { key, value, raw }));
        all.extend(AsState::ALL.map(|from| Deviation::Causes { from, value, raw }));
    }
    let (key, is) = key.strip_suffix('!').map_or((key, true), |key| (key, false));
    let Ok(raw) = raw.parse() else { return all };
    if let Some(field) = INPUTS.iter().find(|field| field.key == key) {
        let key = field.key;
        all.extend(arrows().map(|(from, to)| Deviation::Needs { from, to, key, raw, is }));
        all.extend(arrows().map(|(from, to)| Deviation::Also { from, to, key, raw }));
    }
    if let Some(field) = SHOWN.iter().find(|field| field.key == key) {
        let key = field.key;
        all.extend(AsState::ALL.map(|state| Deviation::Shows { state, key, raw }));
    }
    all
}

/// The key of the output that is written otherwise, by such an id.
fn written(id: &str) -> Option<&'static str> {
    let key = id.strip_prefix("writes:")?.split(':').next()?;
    SHOWN.iter().map(|field| field.key).find(|known| *known == key)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_deviation_has_an_id_of_its_own_by_which_it_is_found() {
        let of_edition = |edition: &Edition| {
            let mut ids = std::collections::HashSet::new();
            for deviation in Deviation::every(edition) {
                let id = deviation.id(edition);
                assert!(ids.insert(id.clone()), "two have the id {id}");
                assert_eq!(Deviation::find(edition, &id), Some(deviation), "{id}");
            }
        };
        std::thread::scope(|scope| {
            for edition in Edition::ALL {
                scope.spawn(move || of_edition(edition));
            }
        });
    }

    #[test]
    fn no_text_denies_twice() {
        for edition in Edition::ALL {
            let every = Deviation::every(edition).into_iter();
            let texts: Vec<String> = every.map(|deviation| deviation.text(edition).to_string()).collect();
            let twice = texts.iter().find(|text| text.contains("not need no "));
            assert_eq!(twice, None, "{}", edition.version);
            assert!(texts.iter().any(|text| text == "AS_OFF -> AS_READY even with power cycle needed"));
        }
    }

    #[test]
    fn numbers_may_be_any() {
        let edition = Edition::DEFAULT;
        for id in [
            "handshake:+451ms",
            "wheel-speed:-7",
            "off-ready:late:9",
            "driving:shows:shutdown_cause=77",
            "writes:as_state:5=0",
        ] {
            assert_eq!(Deviation::find(edition, id).map(|found| found.id(edition)).as_deref(), Some(id));
        }
        for id in ["", "handshake", "off-ready:late:-1", "off-ready:needs:gas=1", "off:shows:as_state=x"] {
            assert_eq!(Deviation::find(edition, id), None, "{id}");
        }
    }
}
