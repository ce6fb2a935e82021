// Pointer tracking from variables to loads, stores and atomics (SPIR-V specification 1.5, sections 3.32.8, 3.32.10
// and 3.32.18).
#include "tests/house/vulkan/spirv_access.h"

#include <optional>

#include "host/spirv/spirv.h"

namespace scree::house {

namespace {

enum Opcode : std::uint16_t {
    op_constant_true = 41,
    op_constant_false = 42,
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
    op_image_fetch = 95,
    op_image = 100,
    op_bitcast = 124,
    op_i_add = 128,
    op_i_equal = 170,
    op_bitwise_and = 199,
    op_atomic_load = 227,
    op_atomic_store = 228,
    op_atomic_last = 242,  // OpAtomicXor
    op_label = 248,
    op_branch = 249,
    op_branch_conditional = 250,
    op_switch = 251,
};
enum Decoration : std::uint32_t { spec_id = 1, binding = 33 };
enum StorageClass : std::uint32_t { uniform = 2 };

struct Reader {
    Accesses found;
    std::map<std::uint32_t, std::uint32_t> bindings, constants, spec_ids;
    std::map<std::uint32_t, std::uint32_t> origins;  // binding that a pointer or image originates from
    std::set<std::uint32_t> addresses;               // the uniform block of buffer addresses
    // Components of the parameters' arrays that ids refer to: pointers to components, values loaded from them, pointers at
    // such offsets.
    std::map<std::uint32_t, ArrayPlace> place_pointers, begins, table_pointers;

    void follow(std::uint32_t result, std::uint32_t from) {
        if (const auto origin = origins.find(from); origin != origins.end()) origins[result] = origin->second;
    }
    // Records an access through a pointer.
    void note(std::uint32_t pointer, bool BufferAccess::*kind) {
        if (const auto origin = origins.find(pointer); origin != origins.end()) found.of[origin->second].*kind = true;
        if (const auto table = table_pointers.find(pointer); table != table_pointers.end())
            found.of_place[table->second].*kind = true;
    }
    static void carry(std::map<std::uint32_t, ArrayPlace>& what, std::uint32_t result, std::uint32_t from) {
        if (const auto known = what.find(from); known != what.end()) what[result] = known->second;
    }

    void chain(std::span<const std::uint32_t> w) {
        if (addresses.contains(w[3]) && w.size() > 4)
            origins[w[2]] = constants.at(w[4]);
        else
            follow(w[2], w[3]);
        carry(table_pointers, w[2], w[3]);
        const auto origin = origins.find(w[2]);
        if (origin == origins.end()) return;
        // parameters.at[0].member[element].component
        if (origin->second == 0 && w.size() == 9 && constants.contains(w[7]) && constants.contains(w[8]))
            place_pointers[w[2]] = {constants.at(w[6]), 4 * constants.at(w[7]) + constants.at(w[8])};
        for (const std::uint32_t index : w.subspan(4))
            if (const auto begin = begins.find(index); begin != begins.end()) table_pointers[w[2]] = begin->second;
    }
    // Records the load `w`; loading a buffer address is no access.
    void load(std::span<const std::uint32_t> w, bool is_address) {
        follow(w[2], w[3]);
        if (const auto place = place_pointers.find(w[3]); place != place_pointers.end()) begins[w[2]] = place->second;
        if (!is_address) note(w[3], &BufferAccess::loads);
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
            case op_bitcast:
                carry(begins, w[2], w[3]);
                break;
            case op_i_add:
                carry(begins, w[2], w[3]);
                carry(begins, w[2], w[4]);
                break;
            case op_image_fetch:
                if (const auto begin = begins.find(w[4]); begin != begins.end()) found.of_place[begin->second].loads = true;
                break;
            case op_load:
                load(w, pointer_types.contains(w[1]));
                break;
            case op_store:
                note(w[1], &BufferAccess::stores);
                break;
            default:
                if (instruction.opcode < op_atomic_load || instruction.opcode > op_atomic_last) break;
                note(w[instruction.opcode == op_atomic_store ? 1 : 3], &BufferAccess::atomics);
        }
    }
};

// Basic blocks that are reachable when the constant with SpecId 3 is `variant`.
class Blocks {
public:
    Blocks(const std::vector<host::SpirvInstruction>& instructions, std::uint32_t variant) {
        std::map<std::uint32_t, std::uint32_t> constants;
        std::map<std::uint32_t, bool> known;
        std::uint32_t label = 0;
        for (const host::SpirvInstruction& each : instructions) {
            const std::span<const std::uint32_t> w = each.words;
            if (each.opcode == op_decorate && w[2] == spec_id && w[3] == 3) constants[w[1]] = variant;
            if (each.opcode == op_constant) constants[w[2]] = w[3];
            if (each.opcode == op_constant_true || each.opcode == op_constant_false)
                known[w[2]] = each.opcode == op_constant_true;
            if (each.opcode == op_spec_constant_op && w[3] == op_i_equal && constants.contains(w[4]) && constants.contains(w[5]))
                known[w[2]] = constants[w[4]] == constants[w[5]];
            if (each.opcode == op_label) {
                if (label == 0) reached_.insert(w[1]);  // all calls are inlined, so the first block is the entry point's
                label = w[1];
            }
            if (each.opcode == op_branch) follows_[label] = {w[1]};
            if (each.opcode == op_branch_conditional)
                follows_[label] = known.contains(w[1]) ? std::set{known[w[1]] ? w[2] : w[3]} : std::set{w[2], w[3]};
            if (each.opcode == op_switch) {
                follows_[label] = {w[2]};
                for (std::size_t k = 4; k < w.size(); k += 2) follows_[label].insert(w[k]);
            }
        }
        for (std::set<std::uint32_t> fresh = reached_; !fresh.empty();) {
            std::set<std::uint32_t> next;
            for (const std::uint32_t one : fresh)
                for (const std::uint32_t other : follows_[one])
                    if (reached_.insert(other).second) next.insert(other);
            fresh = std::move(next);
        }
    }
    bool reaches(std::uint32_t label) const { return reached_.contains(label); }

private:
    std::map<std::uint32_t, std::set<std::uint32_t>> follows_;
    std::set<std::uint32_t> reached_;
};

}  // namespace

Accesses accesses_of(std::span<const std::uint32_t> words, std::uint32_t variant) {
    constexpr std::uint16_t op_type_pointer = 32;
    const auto instructions = host::spirv_instructions(words);
    std::set<std::uint32_t> pointer_types;
    for (const host::SpirvInstruction& each : instructions)
        if (each.opcode == op_type_pointer) pointer_types.insert(each.words[1]);
    Reader reader;
    const Blocks blocks(instructions, variant);
    bool reached = true;  // instructions before the first block
    for (const host::SpirvInstruction& each : instructions) {
        if (each.opcode == op_label) reached = blocks.reaches(each.words[1]);
        if (reached) reader.read(each, pointer_types);
    }
    return reader.found;
}

}  // namespace scree::house
