// Opcodes and decorations of SPIR-V that the tests read (specification 1.5, sections 3.20 and 3.32).
#pragma once

#include <cstdint>

namespace scree::house {

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
    op_member_decorate = 72,
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
enum Decoration : std::uint32_t { spec_id = 1, block = 2, array_stride = 6, binding = 33, offset = 35 };

}  // namespace scree::house
