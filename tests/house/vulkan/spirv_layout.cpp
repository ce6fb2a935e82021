// Parser of names, types and decorations of a SPIR-V module (SPIR-V specification 1.5, sections 3.20, 3.32.2, 3.32.3
// and 3.32.6).
#include "tests/house/vulkan/spirv_layout.h"

#include <map>
#include <utility>

#include "host/spirv/spirv.h"

namespace scree::house {

namespace {

enum Opcode : std::uint16_t {
    op_name = 5,
    op_member_name = 6,
    op_type_int = 21,
    op_type_float = 22,
    op_type_vector = 23,
    op_type_array = 28,
    op_type_runtime_array = 29,
    op_type_struct = 30,
    op_type_pointer = 32,
    op_variable = 59,
    op_decorate = 71,
    op_member_decorate = 72,
};
enum Decoration : std::uint32_t { block = 2, array_stride = 6, binding = 33, offset = 35 };

using Key = std::pair<std::uint32_t, std::uint32_t>;  // type id and member index

struct Module {
    std::map<std::uint32_t, std::string> names;
    std::map<Key, std::string> member_names;
    std::map<Key, std::uint32_t> offsets;
    std::map<std::uint32_t, std::uint32_t> strides, bindings;  // by array type; by variable
    std::map<std::uint32_t, bool> blocks;
    std::map<std::uint32_t, std::vector<std::uint32_t>> structs;         // member types
    std::map<std::uint32_t, std::uint32_t> elements;                     // element types of array types
    std::map<std::uint32_t, std::pair<std::string, std::size_t>> plain;  // scalars and vectors: name, bytes
    std::map<std::uint32_t, std::uint32_t> pointees;                     // types that pointer types point to
    std::map<std::uint32_t, std::uint32_t> struct_bindings;              // binding of the variable that points to the struct
};

std::string text_at(std::span<const std::uint32_t> words) {
    std::string text;
    for (const std::uint32_t word : words) {
        for (int byte = 0; byte < 4; ++byte) {
            const char c = static_cast<char>(word >> (8 * byte) & 0xFF);
            if (c == 0) return text;
            text += c;
        }
    }
    return text;
}

void read_decoration(Module& module, std::span<const std::uint32_t> w) {
    if (w[2] == block) module.blocks[w[1]] = true;
    if (w[2] == array_stride) module.strides[w[1]] = w[3];
    if (w[2] == binding) module.bindings[w[1]] = w[3];
}

void read(Module& module, const host::SpirvInstruction& instruction) {
    const std::span<const std::uint32_t> w = instruction.words;
    switch (instruction.opcode) {
        case op_name:
            module.names[w[1]] = text_at(w.subspan(2));
            break;
        case op_member_name:
            module.member_names[{w[1], w[2]}] = text_at(w.subspan(3));
            break;
        case op_decorate:
            read_decoration(module, w);
            break;
        case op_member_decorate:
            if (w[3] == offset) module.offsets[{w[1], w[2]}] = w[4];
            break;
        case op_type_int:
            module.plain[w[1]] = {w[3] != 0 ? "int" : "uint", w[2] / 8};
            break;
        case op_type_float:
            module.plain[w[1]] = {"float", w[2] / 8};
            break;
        case op_type_vector: {
            const auto& component = module.plain[w[2]];
            const std::string prefix = component.first == "float" ? "" : component.first.substr(0, 1);
            module.plain[w[1]] = {prefix + "vec" + std::to_string(w[3]), component.second * w[3]};
            break;
        }
        case op_type_array:
        case op_type_runtime_array:
            module.elements[w[1]] = w[2];
            break;
        case op_type_struct:
            module.structs[w[1]] = {w.begin() + 2, w.end()};
            break;
        case op_type_pointer:
            module.pointees[w[1]] = w[3];
            break;
        case op_variable:
            if (module.bindings.count(w[2]) != 0) module.struct_bindings[module.pointees[w[1]]] = module.bindings[w[2]];
            break;
        default:
            break;
    }
}

std::string name_of(const Module& module, std::uint32_t type) {
    const auto plain = module.plain.find(type);
    if (plain != module.plain.end()) return plain->second.first;
    const auto name = module.names.find(type);
    return name != module.names.end() ? name->second : "";
}

StructLayout struct_layout(const Module& module, std::uint32_t type, const std::vector<std::uint32_t>& member_types) {
    StructLayout layout;
    layout.name = name_of(module, type);
    layout.is_block = module.blocks.count(type) != 0;
    const auto bound = module.struct_bindings.find(type);
    if (bound != module.struct_bindings.end()) layout.binding = bound->second;
    for (std::uint32_t i = 0; i < member_types.size(); ++i) {
        MemberLayout member;
        const auto name = module.member_names.find({type, i});
        if (name != module.member_names.end()) member.name = name->second;
        member.offset = module.offsets.at({type, i});
        const auto element = module.elements.find(member_types[i]);
        if (element != module.elements.end()) {
            member.element = name_of(module, element->second);
            member.stride = module.strides.at(member_types[i]);
        }
        layout.members.push_back(member);
    }
    return layout;
}

}  // namespace

Layout layout_of(std::span<const std::uint32_t> words) {
    Module module;
    for (const host::SpirvInstruction& instruction : host::spirv_instructions(words)) read(module, instruction);

    Layout layout;
    // Structs used only within functions have no offsets.
    for (const auto& [type, members] : module.structs) {
        if (module.offsets.count({type, 0}) != 0) layout.structs.push_back(struct_layout(module, type, members));
    }
    for (const auto& [type, stride] : module.strides) {
        const std::uint32_t element = module.elements.at(type);
        const auto plain = module.plain.find(element);
        layout.arrays.push_back({name_of(module, element), plain != module.plain.end() ? plain->second.second : 0, stride});
    }
    return layout;
}

}  // namespace scree::house
