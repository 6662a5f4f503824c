//! The parts of a ZIP file between the contents (APPNOTE 6.3.9, sections 4.3.7 to 4.3.16), with
//! sizes of 64 bits throughout.

/// One member: its name, the checksum and size of its bytes, and where its head starts.
pub(super) struct Entry {
    pub name: String,
    pub checksum: u32,
    pub size: u64,
    pub start: u64,
}

/// Bytes of the fixed part of the head of a member.
pub(super) const HEAD: u64 = 30;

/// Bytes of the extra part of a head, with the sizes.
pub(super) const EXTRA: u64 = 20;

/// Version of the format that is needed for sizes of 64 bits.
const VERSION: u16 = 45;

/// Names are in UTF-8.
const FLAGS: u16 = 1 << 11;

/// 1 January 1980, the day on which all members were changed: archives hold no time.
const DAY: u16 = 1 << 5 | 1;

/// Stands for a number that is elsewhere, with 64 bits.
const ELSEWHERE: u32 = u32::MAX;

/// The head of a member as far as it must be read to know the rest.
pub(super) struct Head {
    pub bytes: Vec<u8>,
    pub checksum: u32,
    pub name_length: u16,
}

impl Head {
    /// Reads a head; `None` when this is the beginning of something else.
    pub(super) fn parse(bytes: &[u8]) -> Option<Self> {
        let checksum = u32::from_le_bytes(bytes.get(14..18)?.try_into().ok()?);
        let name_length = u16::from_le_bytes(bytes.get(26..28)?.try_into().ok()?);
        bytes.starts_with(b"PK\x03\x04").then(|| Self {
            bytes: bytes.to_owned(),
            checksum,
            name_length,
        })
    }
}

/// The size in the extra part of a head.
pub(super) fn size_in(extra: &[u8]) -> u64 {
    extra.get(4..12).and_then(|size| size.try_into().ok()).map_or(0, u64::from_le_bytes)
}

impl Entry {
    /// The head that stands before the bytes of the member.
    pub(super) fn head(&self) -> Vec<u8> {
        let mut head = b"PK\x03\x04".to_vec();
        put16(&mut head, &[VERSION]);
        self.put_common(&mut head, EXTRA as u16);
        head.extend(self.name.as_bytes());
        put16(&mut head, &[1, 16]);
        put64(&mut head, &[self.size, self.size]);
        head
    }

    /// What the directory says of the member.
    fn record(&self) -> Vec<u8> {
        let mut record = b"PK\x01\x02".to_vec();
        put16(&mut record, &[VERSION, VERSION]);
        self.put_common(&mut record, 28);
        // No comment, first disk, no attributes.
        put16(&mut record, &[0, 0, 0]);
        put32(&mut record, &[0, ELSEWHERE]);
        record.extend(self.name.as_bytes());
        put16(&mut record, &[1, 24]);
        put64(&mut record, &[self.size, self.size, self.start]);
        record
    }

    /// What heads and records have in common.
    fn put_common(&self, bytes: &mut Vec<u8>, extra: u16) {
        put16(bytes, &[FLAGS, 0, 0, DAY]);
        put32(bytes, &[self.checksum, ELSEWHERE, ELSEWHERE]);
        put16(bytes, &[self.name.len() as u16, extra]);
    }
}

/// Everything after the members, which end at byte `start`.
pub(super) fn tail(entries: &[Entry], start: u64) -> Vec<u8> {
    let mut tail: Vec<u8> = entries.iter().flat_map(Entry::record).collect();
    let (count, size) = (entries.len() as u64, tail.len() as u64);
    tail.extend(b"PK\x06\x06");
    put64(&mut tail, &[44]);
    put16(&mut tail, &[VERSION, VERSION]);
    put32(&mut tail, &[0, 0]);
    put64(&mut tail, &[count, count, size, start]);
    tail.extend(b"PK\x06\x07");
    put32(&mut tail, &[0]);
    put64(&mut tail, &[start + size]);
    put32(&mut tail, &[1]);
    tail.extend(b"PK\x05\x06");
    put16(&mut tail, &[0, 0, u16::MAX, u16::MAX]);
    put32(&mut tail, &[ELSEWHERE, ELSEWHERE]);
    put16(&mut tail, &[0]);
    tail
}

fn put16(bytes: &mut Vec<u8>, values: &[u16]) {
    values.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
}

fn put32(bytes: &mut Vec<u8>, values: &[u32]) {
    values.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
}

fn put64(bytes: &mut Vec<u8>, values: &[u64]) {
    values.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
}
