//! Parquet, read back: the tables hold what CSV and text hold, in the types that they have.

mod contents;
mod files;

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
use parquet::file::reader::SerializedFileReader;
use parquet::record::{Field, Row};

use crate::formats::EVERYTHING;
use crate::frames::{catalog, random};

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
    let team = with(include_str!("../team.dbc"));
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
