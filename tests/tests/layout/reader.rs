//! Two readers of records in compiled modules, and what is expected of them.

use std::collections::BTreeMap;

use rasray_shaders_glsl::Shader;
use rasray_shaders_glsl::layout::layouts;
use spirq::entry_point::EntryPoint;
use spirq::reflect_cfg::ReflectConfig;
use spirq::ty::Type;
use spirq::var::Variable;

/// A member: name, offset, size.
pub type Member = (String, usize, usize);

/// A record as a reader of modules sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    pub members: Vec<Member>,
    pub size: usize,
    pub stride: Option<usize>,
}

/// Records that the product's own reader finds.
pub fn read_by_us(shader: &Shader) -> BTreeMap<String, Record> {
    layouts(&shader.words())
        .into_iter()
        .map(|layout| {
            let members = layout.members.iter().map(|m| (m.name.clone(), m.offset as usize, m.size as usize));
            let record = Record {
                members: members.collect(),
                size: layout.size() as usize,
                stride: layout.stride.map(|stride| stride as usize),
            };
            (layout.name, record)
        })
        .collect()
}

const OP_CONSTANT_NULL: u32 = 46;
const OP_SPEC_CONSTANT_OP: u32 = 52;

/// The module with expressions of specialisation constants replaced by zeros: no layout depends on
/// them, and spirq does not know all their operations.
pub fn without_constant_expressions(words: &[u32]) -> Vec<u32> {
    let (header, mut rest) = words.split_at(5);
    let mut kept = header.to_vec();
    while let Some(&first) = rest.first() {
        let (instruction, after) = rest.split_at(((first >> 16).max(1) as usize).min(rest.len()));
        if first & 0xFFFF == OP_SPEC_CONSTANT_OP {
            kept.extend([3 << 16 | OP_CONSTANT_NULL, instruction[1], instruction[2]]);
        } else {
            kept.extend_from_slice(instruction);
        }
        rest = after;
    }
    kept
}

fn reflected(shader: &Shader) -> Vec<EntryPoint> {
    ReflectConfig::new()
        .spv(without_constant_expressions(&shader.words()))
        .ref_all_rscs(true)
        .reflect()
        .unwrap_or_else(|error| panic!("{shader:?}: {error}"))
}

/// Records that an independent reader finds.
pub fn read_by_spirq(shader: &Shader) -> BTreeMap<String, Record> {
    let mut found = BTreeMap::new();
    for variable in reflected(shader).iter().flat_map(|entry_point| &entry_point.vars) {
        if let Variable::Descriptor { ty, .. } | Variable::PushConstant { ty, .. } = variable {
            collect(ty, None, &mut found);
        }
    }
    found
}

pub fn collect(ty: &Type, stride: Option<usize>, found: &mut BTreeMap<String, Record>) {
    match ty {
        Type::Array(array) => collect(&array.element_ty, array.stride, found),
        Type::Struct(record) => {
            let members = record.members.iter().map(|member| {
                let name = member.name.clone().unwrap_or_default();
                // A run-time array has no size of its own.
                (name, member.offset.unwrap_or(usize::MAX), member.ty.nbyte().unwrap_or(0))
            });
            let members: Vec<Member> = members.collect();
            let size = members.last().map_or(0, |(_, offset, size)| offset + size);
            for member in &record.members {
                collect(&member.ty, None, found);
            }
            let name = record.name.clone().unwrap_or_default();
            let known = found.entry(name).or_insert(Record { members, size, stride });
            known.stride = known.stride.or(stride);
        }
        _ => {}
    }
}

/// Difference between a record and Rust's; `None` if there is none.
pub fn difference(record: Option<&Record>, members: &[Member], size: usize) -> Option<String> {
    let Some(record) = record else {
        return Some("the module does not have it".to_owned());
    };
    if record.members != members {
        return Some(format!("members {:?}, expected {members:?}", record.members));
    }
    if record.size != size {
        return Some(format!("{} bytes, expected {size}", record.size));
    }
    match record.stride {
        Some(stride) if stride != size => Some(format!("stride {stride}, expected {size}")),
        _ => None,
    }
}

/// The name of a module's push constants, as the independent reader finds them; none where it has none.
pub fn push_constants(shader: &Shader) -> Option<String> {
    reflected(shader).iter().flat_map(|entry_point| &entry_point.vars).find_map(|variable| match variable {
        Variable::PushConstant { ty: Type::Struct(record), .. } => record.name.clone(),
        _ => None,
    })
}
