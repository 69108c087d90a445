//! Bytes in base64 (RFC 4648, section 4).

/// Decodes up to a room's bytes; how many they are. `None` if there are more, or if the text is anything else.
pub(crate) fn decode(text: &[u8], room: &mut [u8]) -> Option<usize> {
    let (groups, []) = text.as_chunks::<4>() else { return None };
    let mut places = room.iter_mut();
    let mut len = 0;
    for (index, group) in groups.iter().enumerate() {
        let padding = group.iter().rev().take_while(|byte| **byte == b'=').count();
        if padding > 2 || padding > 0 && index + 1 < groups.len() {
            return None;
        }
        let (values, _) = group.split_at_checked(4 - padding)?;
        let mut word = 0_u32;
        for byte in values {
            word = word << 6 | u32::from(value(*byte)?);
        }
        word <<= 6 * padding;
        let [_, bytes @ ..] = word.to_be_bytes();
        for byte in bytes.into_iter().take(3 - padding) {
            *places.next()? = byte;
            len += 1;
        }
    }
    Some(len)
}

fn value(byte: u8) -> Option<u8> {
    match byte {
        b'A'..=b'Z' => Some(byte - b'A'),
        b'a'..=b'z' => Some(byte - b'a' + 26),
        b'0'..=b'9' => Some(byte - b'0' + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_decoded_or_refused() {
        let cases: [(&str, Option<&[u8]>); 14] = [
            ("", Some(b"")),
            ("Zg==", Some(b"f")),
            ("Zm8=", Some(b"fo")),
            ("Zm9v", Some(b"foo")),
            ("Zm9vYmFy", Some(b"foobar")),
            ("+/8AAQ==", Some(&[0xFB, 0xFF, 0, 1])),
            ("Zm9vYmFyZg==", None),
            ("Zg", None),
            ("Zg=", None),
            ("Z===", None),
            ("====", None),
            ("Zg==Zg==", None),
            ("Z m8", None),
            ("Zm=v", None),
        ];
        for (text, bytes) in cases {
            let mut room = [0; 6];
            let len = decode(text.as_bytes(), &mut room);
            assert_eq!(len.and_then(|len| room.get(..len)), bytes, "{text}");
        }
    }
}
