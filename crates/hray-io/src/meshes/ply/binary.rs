//! PLY as binary numbers, of either order of bytes.

use super::super::polygons::Polygons;
use super::super::problem::{Outcome, Problem};
use super::header::{Element, Encoding, Header, Property, Scalar};
use super::{COMPONENTS, Layout, Use, add, no_such_vertex, note_unused, use_of};
use hray_core::Mesh;

pub(super) fn read(bytes: &[u8], header: &Header, notes: &mut Vec<String>) -> Outcome<Polygons> {
    let mut reader = Reader { bytes, at: header.body, is_big: header.encoding == Encoding::BigEndian };
    let mut polygons = Polygons::default();
    let vertices = header.element(b"vertex").map_or(0, |element| element.count);
    for element in header.elements.iter().filter(|element| !element.properties.is_empty()) {
        reader.check_count(element, header.encoding)?;
        match use_of(element) {
            (Use::Vertices, _) => reader.vertices(element, &mut polygons)?,
            (Use::Nothing, _) => {
                note_unused(element, notes);
                match element.stride() {
                    // That many bytes are there: they were counted.
                    Some(stride) => reader.at += stride * element.count as usize,
                    None => {
                        for _ in 0..element.count {
                            for property in &element.properties {
                                reader.skip(property, element)?;
                            }
                        }
                    }
                }
            }
            (of, list) => reader.faces(element, of, list, vertices, &mut polygons)?,
        }
    }
    let left = bytes.len().saturating_sub(reader.at);
    if left > 0 {
        notes.push(format!(
            "at byte {}: {left} bytes come after the last of what the header announces; they are not read",
            reader.at
        ));
    }
    Ok(polygons)
}

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    is_big: bool,
}

impl<'a> Reader<'a> {
    fn left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at)
    }

    /// Refuses what cannot be there.
    fn check_count(&self, element: &Element, encoding: Encoding) -> Outcome<()> {
        let least = element.least_bytes(encoding) as u64;
        if element.count.saturating_mul(least) > self.left() as u64 {
            let what = format!(
                "the header says that {} of `{}` follow, of {least} bytes or more each, but the file has only {} \
                 bytes more",
                element.count,
                String::from_utf8_lossy(&element.name),
                self.left()
            );
            return Err(Problem::byte(self.at, what));
        }
        Ok(())
    }

    fn take(&mut self, count: usize, property: &Property, element: &Element) -> Outcome<&'a [u8]> {
        let bytes = self.at.checked_add(count).and_then(|end| self.bytes.get(self.at..end));
        let Some(bytes) = bytes else {
            let what = format!(
                "`{}` of `{}` takes {count} bytes, but the file has only {} more",
                String::from_utf8_lossy(&property.name),
                String::from_utf8_lossy(&element.name),
                self.left()
            );
            return Err(Problem::byte(self.at, what));
        };
        self.at += count;
        Ok(bytes)
    }

    /// The bytes of the values of a property: of a list all.
    fn values(&mut self, property: &Property, element: &Element) -> Outcome<&'a [u8]> {
        let Some(kind) = property.length else { return self.take(property.kind.size(), property, element) };
        let start = self.at;
        let bytes = self.take(kind.size(), property, element)?;
        let length = number(kind, bytes, self.is_big);
        if length < 0.0 {
            return Err(Problem::byte(start, format!("the length of a list cannot be {length}")));
        }
        // 2^32 at most, of 8 bytes at most.
        let size = (length as u64).saturating_mul(property.kind.size() as u64);
        self.take(usize::try_from(size).unwrap_or(usize::MAX), property, element)
    }

    fn skip(&mut self, property: &Property, element: &Element) -> Outcome<()> {
        self.values(property, element).map(|_| ())
    }

    fn vertices(&mut self, element: &Element, polygons: &mut Polygons) -> Outcome<()> {
        let layout = Layout::of(element);
        if !layout.has_positions() {
            return Err(Problem::byte(self.at, "the vertices have no properties x, y and z"));
        }
        layout.reserve(element.count as usize, polygons);
        let Some(stride) = element.stride() else { return self.uneven_vertices(element, &layout, polygons) };
        // The offset, the kind and the place of what is kept.
        let mut columns = Vec::new();
        let mut offset = 0;
        for (property, place) in element.properties.iter().zip(&layout.places) {
            columns.extend(place.map(|place| (offset, property.kind, place)));
            offset += property.kind.size();
        }
        let size = stride * element.count as usize;
        let bytes = self.bytes.get(self.at..self.at + size).unwrap_or_default();
        for chunk in bytes.chunks_exact(stride) {
            let mut vertex = [0.0; COMPONENTS];
            for &(offset, kind, place) in &columns {
                let rest = chunk.get(offset..).unwrap_or_default();
                if let Some(slot) = vertex.get_mut(place) {
                    *slot = match (kind, rest.first_chunk()) {
                        (Scalar::F32, Some(four)) if self.is_big => f32::from_be_bytes(*four),
                        (Scalar::F32, Some(four)) => f32::from_le_bytes(*four),
                        _ => layout.component(place, kind, number(kind, rest, self.is_big)),
                    };
                }
            }
            layout.push(&vertex, polygons);
        }
        self.at += size;
        Ok(())
    }

    /// Vertices that have lists.
    fn uneven_vertices(
        &mut self,
        element: &Element,
        layout: &Layout,
        polygons: &mut Polygons,
    ) -> Outcome<()> {
        for _ in 0..element.count {
            let mut vertex = [0.0; COMPONENTS];
            for (property, place) in element.properties.iter().zip(&layout.places) {
                let bytes = self.values(property, element)?;
                if let Some(slot) = place.and_then(|place| vertex.get_mut(place)) {
                    let value = number(property.kind, bytes, self.is_big);
                    *slot = layout.component(place.unwrap_or(0), property.kind, value);
                }
            }
            layout.push(&vertex, polygons);
        }
        Ok(())
    }

    fn faces(
        &mut self,
        element: &Element,
        of: Use,
        list: Option<usize>,
        vertices: u64,
        polygons: &mut Polygons,
    ) -> Outcome<()> {
        let mut count = element.count;
        if let [Property { length: Some(Scalar::U8), kind: Scalar::I32 | Scalar::U32, .. }] =
            element.properties[..]
            && of == Use::Faces
        {
            count -= self.triangles(count, vertices, polygons)?;
        }
        let (mut corners, mut scratch): (Vec<i64>, Vec<u32>) = (Vec::new(), Vec::new());
        for _ in 0..count {
            let start = self.at;
            for (place, property) in element.properties.iter().enumerate() {
                let bytes = self.values(property, element)?;
                if Some(place) == list {
                    corners.clear();
                    let numbers = bytes.chunks_exact(property.kind.size());
                    corners.extend(numbers.map(|bytes| number(property.kind, bytes, self.is_big) as i64));
                    add(of, &corners, vertices, &mut scratch, polygons)
                        .map_err(|what| Problem::byte(start, format!("of this face, {what}")))?;
                }
            }
        }
        Ok(())
    }

    /// Faces of three corners with nothing else to them, which is what most files have, up to the first that is not; how
    /// many they were.
    fn triangles(&mut self, count: u64, vertices: u64, polygons: &mut Polygons) -> Outcome<u64> {
        const SIZE: usize = 13;
        let most = count.min(Mesh::MOST_TRIANGLES as u64) as usize;
        let bytes = self.bytes.get(self.at..).unwrap_or_default();
        polygons.triangles.reserve(most.min(bytes.len() / SIZE));
        let is_big = self.is_big;
        let corner =
            |bytes: [u8; 4]| if is_big { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) };
        let mut read = 0;
        for face in bytes.chunks_exact(SIZE).take(most) {
            let Some(&[3, a0, a1, a2, a3, b0, b1, b2, b3, c0, c1, c2, c3]) = face.first_chunk::<SIZE>()
            else {
                break;
            };
            let corners = [[a0, a1, a2, a3], [b0, b1, b2, b3], [c0, c1, c2, c3]].map(corner);
            if let Some(vertex) = corners.into_iter().find(|vertex| u64::from(*vertex) >= vertices) {
                let what = no_such_vertex(vertex.into(), vertices);
                return Err(Problem::byte(self.at + read * SIZE, format!("of this face, {what}")));
            }
            polygons.triangles.push(corners);
            read += 1;
        }
        self.at += read * SIZE;
        Ok(read as u64)
    }
}

/// A number at the start of bytes, which are there.
fn number(kind: Scalar, bytes: &[u8], is_big: bool) -> f64 {
    fn order<const N: usize>(bytes: &[u8], is_big: bool) -> [u8; N] {
        let mut array = bytes.first_chunk::<N>().copied().unwrap_or([0; N]);
        if is_big {
            array.reverse();
        }
        array
    }
    match kind {
        Scalar::I8 => i8::from_le_bytes(order(bytes, is_big)).into(),
        Scalar::U8 => u8::from_le_bytes(order(bytes, is_big)).into(),
        Scalar::I16 => i16::from_le_bytes(order(bytes, is_big)).into(),
        Scalar::U16 => u16::from_le_bytes(order(bytes, is_big)).into(),
        Scalar::I32 => i32::from_le_bytes(order(bytes, is_big)).into(),
        Scalar::U32 => u32::from_le_bytes(order(bytes, is_big)).into(),
        Scalar::F32 => f32::from_le_bytes(order(bytes, is_big)).into(),
        Scalar::F64 => f64::from_le_bytes(order(bytes, is_big)),
    }
}
