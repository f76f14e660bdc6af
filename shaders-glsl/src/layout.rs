//! Reader of the layout of buffer structs in SPIR-V: member names, offsets and sizes.
//!
//! It understands only the types that layout tests need: scalars, vectors, matrices, arrays and structs with
//! explicit offsets.

use std::collections::HashMap;

const OP_NAME: u32 = 5;
const OP_MEMBER_NAME: u32 = 6;
const OP_TYPE_INT: u32 = 21;
const OP_TYPE_FLOAT: u32 = 22;
const OP_TYPE_VECTOR: u32 = 23;
const OP_TYPE_MATRIX: u32 = 24;
const OP_TYPE_ARRAY: u32 = 28;
const OP_TYPE_RUNTIME_ARRAY: u32 = 29;
const OP_TYPE_STRUCT: u32 = 30;
const OP_CONSTANT: u32 = 43;
const OP_DECORATE: u32 = 71;
const OP_MEMBER_DECORATE: u32 = 72;
const DECORATION_ARRAY_STRIDE: u32 = 6;
const DECORATION_OFFSET: u32 = 35;

/// Member of a struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// Name in GLSL.
    pub name: String,
    /// Offset from the start of the struct, bytes.
    pub offset: u32,
    /// Size in bytes; 0 for a runtime array.
    pub size: u32,
}

/// Layout of a struct with explicit offsets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Name in GLSL.
    pub name: String,
    /// Members in order.
    pub members: Vec<Member>,
    /// Stride of the struct in an array, bytes, if the module has such an array.
    pub stride: Option<u32>,
}

impl Layout {
    /// Returns the number of bytes up to the end of the last member.
    pub fn size(&self) -> u32 {
        self.members.last().map_or(0, |member| member.offset + member.size)
    }
}

enum Type {
    Bytes(u32),
    Vector(u32, u32),
    Array(u32, Option<u32>),
    Struct(Vec<u32>),
}

/// Returns the layouts of the structs with offsets that a module declares. A name may occur more than once
/// (GLSL structs that are also used outside buffers have a twin without offsets, which is left out).
pub fn layouts(words: &[u32]) -> Vec<Layout> {
    let mut names: HashMap<u32, String> = HashMap::new();
    let mut member_names: HashMap<(u32, u32), String> = HashMap::new();
    let mut offsets: HashMap<(u32, u32), u32> = HashMap::new();
    let mut strides: HashMap<u32, u32> = HashMap::new();
    let mut types: HashMap<u32, Type> = HashMap::new();
    let mut constants: HashMap<u32, u32> = HashMap::new();
    let mut order = Vec::new();
    let mut at = 5;
    while at < words.len() {
        let count = (words[at] >> 16) as usize;
        let Some(w) = words.get(at..at + count).filter(|w| !w.is_empty()) else {
            break;
        };
        match (words[at] & 0xFFFF, count) {
            (OP_NAME, 3..) => {
                names.insert(w[1], text(&w[2..]));
            }
            (OP_MEMBER_NAME, 4..) => {
                member_names.insert((w[1], w[2]), text(&w[3..]));
            }
            (OP_DECORATE, 4) if w[2] == DECORATION_ARRAY_STRIDE => {
                strides.insert(w[1], w[3]);
            }
            (OP_MEMBER_DECORATE, 5) if w[3] == DECORATION_OFFSET => {
                offsets.insert((w[1], w[2]), w[4]);
            }
            (OP_TYPE_INT | OP_TYPE_FLOAT, 3..) => {
                types.insert(w[1], Type::Bytes(w[2] / 8));
            }
            (OP_TYPE_VECTOR | OP_TYPE_MATRIX, 4) => {
                types.insert(w[1], Type::Vector(w[2], w[3]));
            }
            (OP_TYPE_ARRAY, 4) => {
                types.insert(w[1], Type::Array(w[2], Some(w[3])));
            }
            (OP_TYPE_RUNTIME_ARRAY, 3) => {
                types.insert(w[1], Type::Array(w[2], None));
            }
            (OP_TYPE_STRUCT, 2..) => {
                types.insert(w[1], Type::Struct(w[2..].to_vec()));
                order.push(w[1]);
            }
            (OP_CONSTANT, 4) => {
                constants.insert(w[2], w[3]);
            }
            _ => {}
        }
        at += count.max(1);
    }
    let sizes = Sizes { types: &types, constants: &constants, strides: &strides, offsets: &offsets };
    let mut found = Vec::new();
    for id in order {
        let Some(Type::Struct(members)) = types.get(&id) else { continue };
        if members.is_empty() || !(0..members.len() as u32).all(|m| offsets.contains_key(&(id, m))) {
            continue;
        }
        let members = members
            .iter()
            .enumerate()
            .map(|(index, &member)| Member {
                name: member_names.get(&(id, index as u32)).cloned().unwrap_or_default(),
                offset: offsets[&(id, index as u32)],
                size: sizes.of(member),
            })
            .collect();
        let stride = types.iter().find_map(|(array, kind)| match kind {
            Type::Array(element, _) if *element == id => strides.get(array).copied(),
            _ => None,
        });
        found.push(Layout { name: names.get(&id).cloned().unwrap_or_default(), members, stride });
    }
    found
}

struct Sizes<'a> {
    types: &'a HashMap<u32, Type>,
    constants: &'a HashMap<u32, u32>,
    strides: &'a HashMap<u32, u32>,
    offsets: &'a HashMap<(u32, u32), u32>,
}

impl Sizes<'_> {
    fn of(&self, id: u32) -> u32 {
        match self.types.get(&id) {
            Some(Type::Bytes(bytes)) => *bytes,
            Some(Type::Vector(element, count)) => self.of(*element) * count,
            Some(Type::Array(element, Some(length))) => {
                let stride = self.strides.get(&id).copied().unwrap_or_else(|| self.of(*element));
                stride * self.constants.get(length).copied().unwrap_or(0)
            }
            Some(Type::Struct(members)) => members.last().map_or(0, |last| {
                self.offsets.get(&(id, members.len() as u32 - 1)).copied().unwrap_or(0) + self.of(*last)
            }),
            _ => 0,
        }
    }
}

fn text(words: &[u32]) -> String {
    let bytes: Vec<u8> = words.iter().flat_map(|w| w.to_le_bytes()).take_while(|&b| b != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}
