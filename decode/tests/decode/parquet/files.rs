//! What a file is beside its rows: types, what it says of itself, groups, and what becomes of it where it cannot be written.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::{self, Write};

use adsdv_decode::{Catalog, Database, DecodeError, Table, parquet, parquet_messages};
use adsdv_spec::Edition;
use parquet::file::reader::FileReader as _;

use super::{SOURCE, logs, messages, open, run, table};
use crate::frames::catalog;

#[test]
fn a_column_of_a_signal_has_its_type() {
    let (_, log, catalog) = logs().pop().expect("the nasty one");
    let types = |file: &str, bytes: &[u8]| {
        let reader = open(file, bytes);
        let schema = reader.metadata().file_metadata().schema_descr_ptr();
        let column = |column: &parquet::schema::types::ColumnDescPtr| {
            format!("{}: {} {}", column.name(), column.physical_type(), column.converted_type())
        };
        schema.columns().iter().map(column).collect::<Vec<_>>()
    };
    let head = ["time: INT64 NONE", "interface: BYTE_ARRAY UTF8"];
    let nasty = types("types-nasty", &messages(&log, &catalog)["Nasty.parquet"]);
    assert_eq!(
        nasty,
        [&head[..], &["Large: FIXED_LEN_BYTE_ARRAY DECIMAL", "Minus: INT64 INT_64", "time_2: BOOLEAN NONE"]]
            .concat()
    );
    let (_, log, catalog) = logs().swap_remove(2);
    let files = messages(&log, &catalog);
    assert_eq!(types("types-wide", &files["Wide.parquet"]), [&head[..], &["All: INT64 UINT_64"]].concat());
    assert_eq!(
        types("types-inverter", &files["Inverter.parquet"]),
        [
            &head[..],
            &[
                "Speed: DOUBLE NONE",
                "Voltage: DOUBLE NONE",
                "Mode: INT64 INT_64",
                "Mode_name: BYTE_ARRAY UTF8",
                "Temperature: DOUBLE NONE",
                "Counter: INT64 INT_64",
            ]
        ]
        .concat()
    );
}

#[test]
fn a_file_says_what_it_is_of() {
    let log = "(1.0) can0 18FF50E5#00280A0000000005\n(1.0) can0 7FF#\n";
    let database = Database::read("team.dbc", include_bytes!("../team.dbc")).expect("a database");
    let catalog = Catalog::with(&Edition::V2026, &[database]);
    let keys = |name: &str, file: &[u8]| {
        let reader = open(name, file);
        let keys = reader.metadata().file_metadata().key_value_metadata().expect("keys").clone();
        keys.into_iter().map(|key| (key.key, key.value.unwrap_or_default())).collect::<BTreeMap<_, _>>()
    };
    let of_all = keys("keys", &table(log, &catalog, Table::Signals));
    let version = env!("CARGO_PKG_VERSION");
    let expected = [("adsdv.version", version), ("adsdv.edition", "2026"), ("adsdv.source", SOURCE)];
    assert_eq!(of_all, expected.map(|(key, value)| (key.to_owned(), value.to_owned())).into());
    let mut of_message = keys("keys-message", &messages(log, &catalog)["Inverter.parquet"]);
    let units = of_message.remove("adsdv.units").expect("units");
    assert_eq!(units, "{\"Speed\":\"rpm\",\"Temperature\":\"°C\",\"Voltage\":\"V\"}");
    assert_eq!(of_message.remove("adsdv.id").as_deref(), Some("18FF50E5"));
    assert_eq!(of_message.remove("adsdv.message").as_deref(), Some("Inverter"));
    assert_eq!(of_message, of_all);
}

/// What is in memory is bounded by rows, and by bytes where rows are long.
#[test]
fn a_group_has_a_bounded_number_of_rows_and_bytes() {
    let catalog = catalog(&Edition::V2026);
    let groups = |name: &str, file: &[u8]| {
        let reader = open(name, file);
        reader
            .metadata()
            .row_groups()
            .iter()
            .map(parquet::file::metadata::RowGroupMetaData::num_rows)
            .collect::<Vec<_>>()
    };
    let mut log = String::new();
    for frame in 0..10_000 {
        let _ = writeln!(log, "(1.{frame:06}) can0 520#0000010000000000");
    }
    let of_signals = groups("groups", &table(&log, &catalog, Table::Signals));
    let signals = catalog.named("VCU2AI_Status").expect("a message").signals.len();
    assert_eq!(usize::try_from(of_signals.iter().sum::<i64>()), Ok(10_000 * signals));
    let most = (1 << 17) + i64::try_from(signals).expect("few");
    assert!(of_signals.len() > 1 && of_signals.iter().all(|&rows| rows <= most), "{of_signals:?}");

    let mut log = String::new();
    for frame in 0..2500 {
        let _ = writeln!(log, "(1.{frame:06}) {frame:x>8000} 520#00");
    }
    let of_frames = groups("groups-long", &table(&log, &catalog, Table::Frames));
    assert!(of_frames.len() > 1 && of_frames.iter().all(|&rows| rows <= 1100), "{of_frames:?}");
}

/// A disk that is full.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let left = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
        self.0 = left;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_writer_that_fails_is_an_error_wherever_it_does() {
    let (_, log, catalog) = logs().swap_remove(0);
    let size = table(&log, &catalog, Table::Signals).len();
    for room in [0, 4, size / 2, size - 1] {
        let mut sink = parquet(Table::Signals, &catalog, Full(room), SOURCE).expect("it was built in");
        let error = run(&log, &catalog, &mut *sink).expect_err("there is no room");
        let DecodeError::Sink(error) = error else { panic!("{error:?}") };
        assert_eq!(error.0.kind(), io::ErrorKind::StorageFull, "{room}");
    }
    let mut sink = parquet(Table::Signals, &catalog, Full(size), SOURCE).expect("it was built in");
    assert!(run(&log, &catalog, &mut *sink).is_ok());
    let mut sink = parquet_messages(&catalog, |_| Err::<Full, _>(io::ErrorKind::StorageFull.into()), SOURCE)
        .expect("built in");
    assert!(matches!(run(&log, &catalog, &mut *sink), Err(DecodeError::Sink(_))));
}
