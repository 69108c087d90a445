//! The records of the format, as <https://mcap.dev/spec> has them: a kind, a length, and fields in little endian.

/// How a file begins, and ends.
pub(super) const MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// What stands before the body of a record.
pub(super) const HEAD: usize = 9;

/// The kinds that are written.
pub(super) mod kind {
    pub(in super::super) const HEADER: u8 = 0x01;
    pub(in super::super) const FOOTER: u8 = 0x02;
    pub(in super::super) const SCHEMA: u8 = 0x03;
    pub(in super::super) const CHANNEL: u8 = 0x04;
    pub(in super::super) const MESSAGE: u8 = 0x05;
    pub(in super::super) const CHUNK: u8 = 0x06;
    pub(in super::super) const MESSAGE_INDEX: u8 = 0x07;
    pub(in super::super) const CHUNK_INDEX: u8 = 0x08;
    pub(in super::super) const STATISTICS: u8 = 0x0B;
    pub(in super::super) const SUMMARY_OFFSET: u8 = 0x0E;
    pub(in super::super) const DATA_END: u8 = 0x0F;
}

/// Appends a record; its length is known when its body is.
pub(super) fn put_record(out: &mut Vec<u8>, kind: u8, body: impl FnOnce(&mut Vec<u8>)) {
    out.push(kind);
    put_counted(out, body);
}

/// Appends something with its length in bytes before it, in 64 bits.
pub(super) fn put_counted(out: &mut Vec<u8>, body: impl FnOnce(&mut Vec<u8>)) {
    let at = out.len();
    out.extend_from_slice(&[0; 8]);
    let begin = out.len();
    body(out);
    let len = (out.len() - begin) as u64;
    if let Some(place) = out.get_mut(at..begin) {
        place.copy_from_slice(&len.to_le_bytes());
    }
}

/// Appends a text with its length in 32 bits before it; none is longer.
pub(super) fn put_text(out: &mut Vec<u8>, text: &[u8]) {
    put_len(out, text.len());
    out.extend_from_slice(text);
}

/// Appends a length in 32 bits.
pub(super) fn put_len(out: &mut Vec<u8>, len: usize) {
    put_u32(out, u32::try_from(len).unwrap_or(u32::MAX));
}

/// Appends pairs of numbers of 16 and of 64 bits, as a map.
pub(super) fn put_map(out: &mut Vec<u8>, pairs: &[(u16, u64)]) {
    put_len(out, pairs.len() * (2 + 8));
    for (key, value) in pairs {
        put_u16(out, *key);
        put_u64(out, *value);
    }
}

pub(super) fn put_u16(out: &mut Vec<u8>, number: u16) {
    out.extend_from_slice(&number.to_le_bytes());
}

pub(super) fn put_u32(out: &mut Vec<u8>, number: u32) {
    out.extend_from_slice(&number.to_le_bytes());
}

pub(super) fn put_u64(out: &mut Vec<u8>, number: u64) {
    out.extend_from_slice(&number.to_le_bytes());
}
