//! Arrays of numbers in the buffers of a glTF file (glTF 2.0, section 3.6.2).

use super::super::problem::{Outcome, Problem};
use super::Reader;

/// The kind of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// A component at the start of bytes, which are there. Whole numbers that stand for shares are divided by the most
    /// that their kind holds.
    fn number(self, bytes: &[u8], is_normalized: bool) -> f32 {
        fn of<const N: usize>(bytes: &[u8]) -> [u8; N] {
            bytes.first_chunk().copied().unwrap_or([0; N])
        }
        let (value, most) = match self {
            Self::F32 => return f32::from_le_bytes(of(bytes)),
            Self::U32 => return u32::from_le_bytes(of(bytes)) as f32,
            Self::I8 => (f32::from(i8::from_le_bytes(of(bytes))), 127.0),
            Self::U8 => (f32::from(u8::from_le_bytes(of(bytes))), 255.0),
            Self::I16 => (f32::from(i16::from_le_bytes(of(bytes))), 32767.0),
            Self::U16 => (f32::from(u16::from_le_bytes(of(bytes))), 65535.0),
        };
        if is_normalized { (value / most).max(-1.0) } else { value }
    }
}

/// An array of elements of several components each.
pub(super) struct Array<'a> {
    bytes: &'a [u8],
    stride: usize,
    pub(super) count: usize,
    component: Component,
    is_normalized: bool,
}

impl Array<'_> {
    fn element(&self, index: usize) -> &[u8] {
        self.bytes.get(index * self.stride..).unwrap_or_default()
    }

    /// The first components of an element; 0 where it has fewer bytes.
    pub(super) fn floats<const N: usize>(&self, index: usize) -> [f32; N] {
        let element = self.element(index);
        let size = self.component.size();
        std::array::from_fn(|place| {
            let bytes = element.get(place * size..).unwrap_or_default();
            self.component.number(bytes, self.is_normalized)
        })
    }

    /// An element as an index.
    pub(super) fn index(&self, index: usize) -> u32 {
        let element = self.element(index);
        match (self.component, element) {
            (Component::U8, [a, ..]) => (*a).into(),
            (Component::U16, [a, b, ..]) => u16::from_le_bytes([*a, *b]).into(),
            (Component::U32, [a, b, c, d, ..]) => u32::from_le_bytes([*a, *b, *c, *d]),
            _ => u32::MAX,
        }
    }
}

impl Reader<'_> {
    /// The array of an accessor, whose elements have as many components as one of the kinds that are allowed. All of its
    /// bytes are there.
    pub(super) fn array(&self, accessor: usize, kinds: &[&str], user: &str) -> Outcome<Array<'_>> {
        let place = format!("accessors[{accessor}]");
        let wrong = |what: String| Problem::part(&place, what);
        let found = self.document.accessors.get(accessor);
        let found = found.ok_or_else(|| {
            let count = self.document.accessors.len();
            Problem::part(
                user,
                format!("it names accessor {accessor}, but there are {count}, counted from 0"),
            )
        })?;
        let components = match &found.kind[..] {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            kind => return Err(wrong(format!("{user} cannot use elements of the type {kind:?}"))),
        };
        if !kinds.contains(&&found.kind[..]) {
            return Err(wrong(format!(
                "its elements are {}, and {user} needs {}",
                found.kind,
                kinds.join(" or ")
            )));
        }
        let component = match found.component_type {
            5120 => Component::I8,
            5121 => Component::U8,
            5122 => Component::I16,
            5123 => Component::U16,
            5125 => Component::U32,
            5126 => Component::F32,
            other => return Err(wrong(format!("there is no componentType {other}"))),
        };
        if found.sparse.is_some() {
            return Err(wrong(
                "it is sparse, which is not read; export the file without sparse accessors".into(),
            ));
        }
        let Some(view) = found.buffer_view else {
            return Err(wrong("it has no bufferView, so it has no data".into()));
        };
        let (bytes, stride) = self.view(view, &place)?;
        let size = components * component.size();
        let stride = stride.unwrap_or(size);
        if stride < size {
            return Err(wrong(format!("its elements take {size} bytes, but its byteStride is {stride}")));
        }
        // The last element needs no more than its own bytes.
        let end = match found.count {
            0 => Some(found.byte_offset),
            count => (count - 1)
                .checked_mul(stride)
                .and_then(|n| n.checked_add(size)?.checked_add(found.byte_offset)),
        };
        if end.is_none_or(|end| end > bytes.len()) {
            return Err(wrong(format!(
                "{} elements, {stride} bytes apart, from byte {} on do not fit into bufferViews[{view}], which has {} \
                 bytes",
                found.count,
                found.byte_offset,
                bytes.len()
            )));
        }
        let bytes = bytes.get(found.byte_offset..).unwrap_or_default();
        Ok(Array { bytes, stride, count: found.count, component, is_normalized: found.normalized })
    }

    /// The bytes of a view of a buffer, and how far its elements are apart.
    fn view(&self, view: usize, user: &str) -> Outcome<(&[u8], Option<usize>)> {
        let found = self.document.buffer_views.get(view);
        let found = found.ok_or_else(|| {
            let count = self.document.buffer_views.len();
            Problem::part(user, format!("it names bufferView {view}, but there are {count}, counted from 0"))
        })?;
        let place = format!("bufferViews[{view}]");
        let Some(buffer) = self.buffers.get(found.buffer) else {
            let count = self.buffers.len();
            let what = format!("it names buffer {}, but there are {count}, counted from 0", found.buffer);
            return Err(Problem::part(place, what));
        };
        let end = found.byte_offset.checked_add(found.byte_length);
        let bytes = end.and_then(|end| buffer.get(found.byte_offset..end));
        let bytes = bytes.ok_or_else(|| {
            let what = format!(
                "{} bytes from byte {} on do not fit into buffers[{}], which has {}",
                found.byte_length,
                found.byte_offset,
                found.buffer,
                buffer.len()
            );
            Problem::part(&place, what)
        })?;
        Ok((bytes, found.byte_stride))
    }
}
