//! Files that are known, and not read: what they are, and what to do with them.

/// A kind of file that is not read here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Foreign {
    /// How it begins.
    magic: &'static [u8],
    /// What it is.
    pub what: &'static str,
    /// What to do.
    pub hint: &'static str,
}

const PYTHON: &str = "read it with Python, and give the frames to adsdv.check: docs/formats.md shows how";
const CONVERT: &str = "convert it with python-can: pip install 'python-can[mf4]' && can_logconvert run.mf4 run.log; docs/formats.md has more";
const UNPACK: &str = "unpack it first; gzip and Zstandard are unpacked here";

const KNOWN: [Foreign; 15] = [
    Foreign {
        magic: b"SQLite format 3\0",
        what: "an SQLite database, such as a ROS 2 bag (.db3)",
        hint: PYTHON,
    },
    Foreign { magic: b"MDF     ", what: "a measurement file of ASAM (MF4, MDF)", hint: CONVERT },
    Foreign {
        magic: b"UnFinMF ",
        what: "a measurement file of ASAM that was not finished (MF4)",
        hint: CONVERT,
    },
    Foreign { magic: b"#ROSBAG V", what: "a bag of ROS 1", hint: PYTHON },
    Foreign { magic: b"\x0a\x0d\x0d\x0a", what: "a capture of Wireshark (pcapng)", hint: PYTHON },
    Foreign { magic: b"\xd4\xc3\xb2\xa1", what: "a capture of tcpdump (pcap)", hint: PYTHON },
    Foreign { magic: b"\xa1\xb2\xc3\xd4", what: "a capture of tcpdump (pcap)", hint: PYTHON },
    Foreign { magic: b"\x4d\x3c\xb2\xa1", what: "a capture of tcpdump (pcap)", hint: PYTHON },
    Foreign { magic: b"\xa1\xb2\x3c\x4d", what: "a capture of tcpdump (pcap)", hint: PYTHON },
    Foreign { magic: b"PAR1", what: "a Parquet file", hint: PYTHON },
    Foreign { magic: b"\xfd7zXZ\0", what: "compressed with xz", hint: UNPACK },
    Foreign { magic: b"BZh", what: "compressed with bzip2", hint: UNPACK },
    Foreign { magic: b"\x04\x22\x4d\x18", what: "compressed with LZ4", hint: UNPACK },
    Foreign { magic: b"PK\x03\x04", what: "a zip archive", hint: UNPACK },
    Foreign { magic: b"7z\xbc\xaf\x27\x1c", what: "a 7z archive", hint: UNPACK },
];

/// What a file is that begins so, if it is known and not read.
pub(crate) fn find(head: &[u8]) -> Option<Foreign> {
    KNOWN.into_iter().find(|foreign| head.starts_with(foreign.magic))
}
