//! Parquet, read back: the tables hold what CSV and text hold, in the types that they have.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, Cursor, Write};
use std::path::Path;
use std::rc::Rc;

use adsdv_decode::{
    Catalog, Database, DecodeError, Options, Recording, Sink, Summary, Table, parquet, parquet_messages,
};
use adsdv_spec::Edition;
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::{Field, Row};

use crate::formats::EVERYTHING;
use crate::frames::{Format, catalog, decode, random};

const SOURCE: &str = "run.log";

/// Whole numbers that no double is, and none that 64 bits hold; a bit, and a column that has the name of another.
const NASTY: &str = "\
BO_ 1 Nasty: 16 T
 SG_ Large : 0|64@1+ (3,-1) [0|0] \"\" T
 SG_ Minus : 64|63@1- (1,0) [0|0] \"m\" T
 SG_ time : 127|1@1+ (1,0) [0|0] \"\" T
BO_ 2 nasty: 8 T
 SG_ Double : 0|64@1- (1,0) [0|0] \"\" T
SIG_VALTYPE_ 2 Double : 2;
";
const NASTY_LOG: &str = "\
(1.000000001) can0 001##0FFFFFFFFFFFFFFFF0100000000000040
(1.000000002) can1 001##3010000000000000001000000000000C0
(1.000000003) can0 001##00100000000000000
(1.000000004) can0 002#000000000000F07F
(1.000000005) can0 002#000000000000F87F
(1.000000006) can0 002#9A9999999999B93F
(-1.000000006) can0 001#00
";

/// A recorded mission.
pub(crate) fn mission() -> String {
    fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/logs/mission.log")).expect("a log")
}

/// A log with what decodes it.
fn logs() -> Vec<(&'static str, String, Catalog)> {
    let with = |dbc: &str| {
        let database = Database::read("team.dbc", dbc.as_bytes()).expect("a database");
        Catalog::with(&Edition::V2026, &[database])
    };
    let team = with(include_str!("team.dbc"));
    vec![
        ("mission", mission(), catalog(&Edition::V4_0)),
        ("everything", EVERYTHING.to_owned(), catalog(&Edition::V2026)),
        ("team", random(&team, 50), team),
        ("nasty", NASTY_LOG.to_owned(), with(NASTY)),
    ]
}

/// Runs a log through a sink.
fn run(log: &str, catalog: &Catalog, sink: &mut dyn Sink) -> Result<Summary, DecodeError> {
    let opened = adsdv_formats::open(Cursor::new(log.to_owned())).expect("a log");
    let options = Options { edition: Some(catalog.edition()), ..Options::default() };
    Recording::begin(opened, &options).expect("a frame").decode(catalog, sink, |_| {})
}

/// The file of a table.
pub(crate) fn table(log: &str, catalog: &Catalog, table: Table) -> Vec<u8> {
    let mut file = Vec::new();
    let mut sink = parquet(table, catalog, &mut file, SOURCE).expect("it was built in");
    run(log, catalog, &mut *sink).expect("a vector takes everything");
    drop(sink);
    file
}

/// Bytes that several hold.
#[derive(Clone, Default)]
struct Shared(std::sync::Arc<std::sync::Mutex<Vec<u8>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().expect("nobody panicked").write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The file of each message.
pub(crate) fn messages(log: &str, catalog: &Catalog) -> BTreeMap<String, Vec<u8>> {
    let files = Rc::new(RefCell::new(BTreeMap::new()));
    let made = Rc::clone(&files);
    let create = move |name: &str| {
        let file = Shared::default();
        assert!(made.borrow_mut().insert(name.to_owned(), file.clone()).is_none(), "{name} is made twice");
        Ok(file)
    };
    let mut sink = parquet_messages(catalog, create, SOURCE).expect("it was built in");
    run(log, catalog, &mut *sink).expect("a vector takes everything");
    drop(sink);
    let files = files.take();
    files.into_iter().map(|(name, file)| (name, file.0.lock().expect("nobody panicked").clone())).collect()
}

/// Opens what was written. The name has to be the test's own.
fn open(name: &str, file: &[u8]) -> SerializedFileReader<File> {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.parquet"));
    fs::write(&path, file).expect("the folder for tests can be written");
    SerializedFileReader::new(File::open(path).expect("the file is there")).expect("a Parquet file")
}

fn rows(name: &str, file: &[u8]) -> Vec<Row> {
    let rows = open(name, file).into_iter().collect::<Result<_, _>>();
    rows.expect("rows")
}

fn field<'a>(row: &'a Row, name: &str) -> &'a Field {
    let mut columns = row.get_column_iter();
    columns.find(|(column, _)| *column == name).unwrap_or_else(|| panic!("no column {name}")).1
}

/// A cell as text, as CSV has it; nothing for a null.
fn text(field: &Field) -> String {
    match field {
        Field::Null => String::new(),
        Field::Str(text) => text.clone(),
        Field::Bytes(bytes) => bytes.data().iter().fold(String::new(), |mut text, byte| {
            let _ = write!(text, "{byte:02X}");
            text
        }),
        Field::Long(number) => number.to_string(),
        Field::ULong(number) => number.to_string(),
        Field::Double(number) => number.to_string(),
        Field::Bool(is) => u8::from(*is).to_string(),
        Field::Int(number) => number.to_string(),
        Field::Decimal(number) => {
            i128::from_be_bytes(number.data().try_into().expect("16 bytes")).to_string()
        }
        other => panic!("{other:?}"),
    }
}

fn cell(row: &Row, name: &str) -> String {
    text(field(row, name))
}

/// A time as text.
fn time(row: &Row) -> String {
    let Field::Long(time) = *field(row, "time") else { panic!("{row:?}") };
    let sign = if time < 0 { "-" } else { "" };
    let (seconds, rest) = (time.unsigned_abs() / 1_000_000_000, time.unsigned_abs() % 1_000_000_000);
    if rest.is_multiple_of(1000) {
        format!("{sign}{seconds}.{:06}", rest / 1000)
    } else {
        format!("{sign}{seconds}.{rest:09}")
    }
}

/// A number of a text; what is none is one that is not finite.
fn number(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|number| number.is_finite())
}

#[test]
fn a_row_of_signals_is_a_row_of_csv() {
    for (name, log, catalog) in logs() {
        let (csv, ..) = decode(&log, &catalog, Format::Csv);
        let rows = rows(&format!("signals-{name}"), &table(&log, &catalog, Table::Signals));
        assert_eq!(rows.len(), csv.lines().count() - 1, "{name}");
        for (row, line) in rows.iter().zip(csv.lines().skip(1)) {
            let ours = |column| cell(row, column);
            let theirs: Vec<_> = line.split(',').collect();
            let [at, interface, id, message, signal, value, unit, named] = theirs[..] else {
                panic!("{line}")
            };
            let head = [time(row), ours("interface"), ours("id"), ours("signal"), ours("unit")];
            assert_eq!(head, [at, interface, id, signal, unit], "{name}: {line}");
            let special = ["remote frame", "error frame", "CAN XL frame"].contains(&message);
            assert_eq!(if special { ours("kind") } else { ours("message") }, message, "{name}: {line}");
            if signal.is_empty() {
                assert_eq!((ours("data").as_str(), ours("value").as_str()), (named, ""), "{name}: {line}");
                continue;
            }
            assert_eq!((ours("name").as_str(), field(row, "data")), (named, &Field::Null), "{name}: {line}");
            assert_eq!(number(&ours("value")), number(value), "{name}: {line}");
            // An integer that is not that of its double is there as a decimal, digit by digit.
            let exact = value.parse::<i128>().ok().filter(|exact| {
                #[expect(clippy::cast_possible_truncation, reason = "that is what is looked for")]
                let double = number(value).expect("a number") as i128;
                double != *exact
            });
            assert_eq!(
                ours("exact"),
                exact.map(|exact| exact.to_string()).unwrap_or_default(),
                "{name}: {line}"
            );
        }
    }
}

#[test]
fn what_no_double_is_has_a_decimal_and_floats_that_are_no_numbers_stay() {
    let (_, log, catalog) = logs().pop().expect("the nasty one");
    let rows = rows("nasty", &table(&log, &catalog, Table::Signals));
    let exact: Vec<_> = rows.iter().map(|row| cell(row, "exact")).filter(|text| !text.is_empty()).collect();
    assert_eq!(exact, ["55340232221128654844", "-4611686018427387903", "-4611686018427387903"]);
    let of_double = rows.iter().filter(|row| cell(row, "signal") == "Double");
    let values: Vec<_> = of_double.map(|row| cell(row, "value")).collect();
    assert_eq!(values, ["inf", "NaN", "0.1"]);
}

#[test]
fn a_row_of_frames_is_the_frame() {
    for (name, log, catalog) in logs() {
        let (text, ..) = decode(&log, &catalog, Format::SingleLine);
        let rows = rows(&format!("frames-{name}"), &table(&log, &catalog, Table::Frames));
        let frames = || text.lines().filter(|line| !line.starts_with("DROPCOUNT"));
        assert_eq!(rows.len(), frames().count(), "{name}");
        for (row, line) in rows.iter().zip(frames()) {
            let ours = |column| cell(row, column);
            let (frame, decoded) = line.split_once(" :: ").expect("a decoded line");
            let (seconds, micros) =
                time(row).split_once('.').map(|(a, b)| (a.to_owned(), b.to_owned())).expect("a point");
            let (sign, seconds) =
                seconds.strip_prefix('-').map_or(("", seconds.as_str()), |seconds| ("-", seconds));
            let mut line = format!("({sign}{seconds:0>10}.{micros}) {} ", ours("interface"));
            let extended = *field(row, "extended") == Field::Bool(true);
            assert_eq!(extended, ours("id").len() == 8, "{frame}");
            let (id, data) = (ours("id"), ours("data"));
            let _ = match ours("kind").as_str() {
                "CAN" => write!(line, "{id}#{data}"),
                "CAN FD" => write!(line, "{id}##{:X}{data}", ours("flags").parse::<u8>().expect("flags")),
                "remote frame" => write!(line, "{id}#R{}", ours("length")),
                // As candump has them: with the bit that says so.
                "error frame" => write!(line, "2{}#{data}", &id[1..]),
                other => panic!("{other}"),
            };
            let _ = match ours("direction").as_str() {
                "" => Ok(()),
                "rx" => write!(line, " R"),
                "tx" => write!(line, " T"),
                other => panic!("{other}"),
            };
            assert_eq!(line, frame, "{name}");
            if ours("kind") != "remote frame" {
                assert_eq!(ours("length"), (data.len() / 2).to_string(), "{frame}");
            }
            let message = decoded.split_once('(').map_or("", |(message, _)| message);
            assert_eq!(ours("message"), if message.contains(' ') { "" } else { message }, "{frame}");
        }
    }
}

/// The rows of a message's table, a row for each cell that is no null, as those of CSV.
fn long(name: &str, file: &[u8], signals: &[String]) -> Vec<String> {
    let mut long = Vec::new();
    for row in rows(name, file) {
        for (column, cell) in row.get_column_iter() {
            let Some(signal) =
                signals.iter().find(|signal| *signal == column || format!("{signal}_2") == *column)
            else {
                continue;
            };
            if *cell == Field::Null {
                continue;
            }
            let named = row.get_column_iter().find(|(other, _)| **other == format!("{column}_name"));
            let named = named.map(|(_, name)| text(name)).unwrap_or_default();
            let value = number(&text(cell));
            if column != "time" {
                long.push(format!(
                    "{},{},{signal},{value:?},{named}",
                    time(&row),
                    text(field(&row, "interface"))
                ));
            }
        }
    }
    long
}

#[test]
fn the_tables_of_messages_have_every_signal() {
    for (name, log, catalog) in logs() {
        let (csv, ..) = decode(&log, &catalog, Format::Csv);
        let mut expected: BTreeMap<&str, Vec<String>> = BTreeMap::new();
        for line in csv.lines().skip(1) {
            let cells: Vec<_> = line.split(',').collect();
            let [at, interface, _, message, signal, value, _, named] = cells[..] else { panic!("{line}") };
            let rows = expected.entry(message).or_default();
            if !signal.is_empty() {
                rows.push(format!("{at},{interface},{signal},{:?},{named}", number(value)));
            }
        }
        let mut files = messages(&log, &catalog);
        let unknown = files.remove("unknown_frames.parquet");
        assert_eq!(unknown.is_some(), expected.remove("").is_some(), "{name}");
        expected.retain(|message, _| !message.ends_with(" frame"));
        assert_eq!(files.len(), expected.len(), "{name}");
        for (message, lines) in expected {
            let file = if message == "nasty" { "nasty_002".to_owned() } else { message.to_owned() };
            let of_message = catalog.named(message).expect("a message");
            let signals: Vec<_> = of_message.signals.iter().map(|signal| signal.name.to_string()).collect();
            let bytes = &files[&format!("{file}.parquet")];
            assert!(long(&format!("{name}-{file}"), bytes, &signals) == lines, "{name}: {message}");
        }
    }
}

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
    let database = Database::read("team.dbc", include_bytes!("team.dbc")).expect("a database");
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
