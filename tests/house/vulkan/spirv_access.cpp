// Follows pointers from variables to loads, stores and atomics (SPIR-V specification 1.5, sections 3.32.8, 3.32.10 and 3.32.18).
#include "tests/house/vulkan/spirv_access.h"

#include <optional>

#include "host/spirv/spirv.h"

namespace scree::house {

namespace {

enum Opcode : std::uint16_t {
    op_constant = 43,
    op_spec_constant = 50,
    op_spec_constant_op = 52,
    op_variable = 59,
    op_image_texel_pointer = 60,
    op_load = 61,
    op_store = 62,
    op_access_chain = 65,
    op_in_bounds_access_chain = 66,
    op_decorate = 71,
    op_copy_object = 83,
    op_sampled_image = 86,
    op_image = 100,
    op_bitwise_and = 199,
    op_atomic_load = 227,
    op_atomic_store = 228,
    op_atomic_last = 242,  // OpAtomicXor
};
enum Decoration : std::uint32_t { spec_id = 1, binding = 33 };
enum StorageClass : std::uint32_t { uniform = 2 };

struct Reader {
    Accesses found;
    std::map<std::uint32_t, std::uint32_t> bindings, constants, spec_ids;
    std::map<std::uint32_t, std::uint32_t> origins;  // binding of what a pointer, or an image, leads to
    std::set<std::uint32_t> addresses;               // the uniform block of them: its members are other buffers

    void follow(std::uint32_t result, std::uint32_t from) {
        if (const auto origin = origins.find(from); origin != origins.end()) origins[result] = origin->second;
    }
    BufferAccess* at(std::uint32_t pointer) {
        const auto origin = origins.find(pointer);
        return origin == origins.end() ? nullptr : &found.of[origin->second];
    }

    void chain(std::span<const std::uint32_t> w) {
        if (addresses.contains(w[3]) && w.size() > 4)
            origins[w[2]] = constants.at(w[4]);
        else
            follow(w[2], w[3]);
    }
    // Of an address itself nothing is read but where to go on.
    void load(std::span<const std::uint32_t> w, bool is_address) {
        follow(w[2], w[3]);
        if (BufferAccess* access = at(w[3]); access && !is_address) access->loads = true;
    }
    void read(const host::SpirvInstruction& instruction, const std::set<std::uint32_t>& pointer_types) {
        const std::span<const std::uint32_t> w = instruction.words;
        switch (instruction.opcode) {
            case op_decorate:
                if (w[2] == binding) bindings[w[1]] = w[3];
                if (w[2] == spec_id) found.constants.insert(w[3]), spec_ids[w[1]] = w[3];
                break;
            case op_constant:
                constants[w[2]] = w[3];
                break;
            case op_spec_constant_op:
                if (w[3] == op_bitwise_and && spec_ids.contains(w[4]) && spec_ids[w[4]] == 1)
                    found.tested_bits |= constants.at(w[5]);
                break;
            case op_variable:
                if (!bindings.contains(w[2])) break;
                if (w[3] == uniform && bindings[w[2]] == 0) addresses.insert(w[2]);
                origins[w[2]] = bindings[w[2]];
                break;
            case op_access_chain:
            case op_in_bounds_access_chain:
                chain(w);
                break;
            case op_copy_object:
            case op_sampled_image:
            case op_image:
                follow(w[2], w[3]);
                break;
            case op_load:
                load(w, pointer_types.contains(w[1]));
                break;
            case op_store:
                if (BufferAccess* access = at(w[1])) access->stores = true;
                break;
            default:
                if (instruction.opcode < op_atomic_load || instruction.opcode > op_atomic_last) break;
                if (BufferAccess* access = at(w[instruction.opcode == op_atomic_store ? 1 : 3])) access->atomics = true;
        }
    }
};

}  // namespace

Accesses accesses_of(std::span<const std::uint32_t> words) {
    constexpr std::uint16_t op_type_pointer = 32;
    const auto instructions = host::spirv_instructions(words);
    std::set<std::uint32_t> pointer_types;
    for (const host::SpirvInstruction& each : instructions)
        if (each.opcode == op_type_pointer) pointer_types.insert(each.words[1]);
    Reader reader;
    for (const host::SpirvInstruction& each : instructions) reader.read(each, pointer_types);
    return reader.found;
}

}  // namespace scree::house
