// Opcodes of the SPIR-V specification 1.6. Internal to spirv/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace scree::host {

constexpr std::size_t header_words = 5;

enum Opcode : std::uint16_t {
    op_source_continued = 2,
    op_source = 3,
    op_source_extension = 4,
    op_string = 7,
    op_line = 8,
    op_extension = 10,
    op_extended_import = 11,
    op_extended = 12,
    op_entry_point = 15,
    op_execution_mode = 16,
    op_capability = 17,
    op_specialised = 52,
    op_function = 54,
    op_decorate = 71,
    op_no_line = 317,
    op_module_processed = 330,
};

// Decodes a literal string operand.
std::string literal(std::span<const std::uint32_t> words);

}  // namespace scree::host
