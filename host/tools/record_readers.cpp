// Code generation from record layouts.
#include "host/tools/record_readers.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <utility>

namespace scree::host {
namespace {

bool has_reader(const Record& record) {
    return record.bytes == 4 || record.bytes == 8 || record.bytes % 16 == 0;
}

const Record* find(const std::vector<Record>& records, const std::string& name) {
    const auto found = std::find_if(records.begin(), records.end(), [&](const Record& record) { return record.name == name; });
    return found == records.end() ? nullptr : &*found;
}

// GLSL expression of a scalar or vector at a byte offset of the record, from the texels t0, t1, ... (uvec4).
std::string value_of(const std::string& type, std::size_t byte) {
    const bool vector = std::isdigit(static_cast<unsigned char>(type.back())) != 0;
    const std::size_t lanes = vector ? static_cast<std::size_t>(type.back() - '0') : 1;
    const std::size_t lane = byte / 4 % 4;
    const std::string texel = "t" + std::to_string(byte / 16);
    const std::string words = lanes == 4 ? texel : texel + "." + std::string("xyzw").substr(lane, lanes);
    if (type == "float" || type.starts_with("vec")) return "uintBitsToFloat(" + words + ")";
    return type.starts_with('u') ? words : type + "(" + words + ")";
}

std::string constructor_of(const std::vector<Record>& records, const Record& record, std::size_t byte);

std::string element_of(const std::vector<Record>& records, const std::string& type, std::size_t byte) {
    const Record* record = find(records, type);
    return record ? constructor_of(records, *record, byte) : value_of(type, byte);
}

std::string constructor_of(const std::vector<Record>& records, const Record& record, std::size_t byte) {
    std::string text = record.name + "(", separator;
    for (const RecordMember& member : record.members) {
        std::string value;
        for (std::size_t i = 0; i < std::max<std::size_t>(member.count, 1); ++i)
            value += (i > 0 ? ", " : "") + element_of(records, member.type, byte + member.offset + i * member.stride);
        if (member.count > 0) value = member.type + "[" + std::to_string(member.count) + "](" + value + ")";
        text += std::exchange(separator, ", ") + value;
    }
    return text + ")";
}

std::string place_of(std::size_t texels, std::size_t texel) {
    return "PLACE(" + std::to_string(texels) + "u, i, " + std::to_string(texel) + "u)";
}

// A mask of its texels is one word.
bool has_writer(const Record& record) {
    return record.bytes % 16 == 0 && record.bytes / 16 <= 32;
}

// Adds the scalars and vectors of a value of a type at a byte offset to the words of the texels that they are in.
void take_apart(const std::vector<Record>& records, const std::string& type, const std::string& value, std::size_t byte,
                std::vector<std::string>& words) {
    if (const Record* record = find(records, type)) {
        for (const RecordMember& member : record->members) {
            const std::string name = value + "." + member.name;
            if (member.count == 0) take_apart(records, member.type, name, byte + member.offset, words);
            for (std::size_t i = 0; i < member.count; ++i)
                take_apart(records, member.type, name + "[" + std::to_string(i) + "]", byte + member.offset + i * member.stride,
                           words);
        }
        return;
    }
    std::string& texel = words[byte / 16];
    texel += (texel.empty() ? "" : ", ") + (type == "float" || type.starts_with("vec") ? "floatBitsToUint(" + value + ")"
                                            : type == "int"                            ? "uint(" + value + ")"
                                                                                       : value);
}

// Writes the texels of the members in the mask `members`, and the bits of each member in it.
std::string writer_of(const std::vector<Record>& records, const Record& record) {
    const std::size_t texels = record.bytes / 16;
    std::string text;
    for (std::size_t m = 0; m < record.members.size(); ++m) {
        const std::size_t next = m + 1 < record.members.size() ? record.members[m + 1].offset : record.bytes;
        std::uint32_t bits = 0;
        for (std::size_t texel = record.members[m].offset / 16; 16 * texel < next; ++texel) bits |= 1u << texel;
        text += "#define MEMBER_OF_" + record.name + "_" + record.members[m].name + " " + std::to_string(bits) + "u\n";
    }
    text += "#define SCREE_WRITER_" + record.name + "(table, STORE, PLACE) \\\n    void write_##table(uint i, " + record.name +
            " r, uint members) { \\\n";
    std::vector<std::string> words(texels);
    take_apart(records, record.name, "r", 0, words);
    for (std::size_t k = 0; k < texels; ++k)
        text += "        if ((members & " + std::to_string(1u << k) + "u) != 0u) STORE(table, " + place_of(texels, k) +
                ", uvec4(" + words[k] + ")); \\\n";
    return text + "    }\n";
}

std::string reader_of(const std::vector<Record>& records, const Record& record) {
    const std::size_t texels = std::max<std::size_t>(1, record.bytes / 16);
    std::string text =
        "#define SCREE_READER_" + record.name + "(table, TEXEL, PLACE) \\\n    " + record.name + " read_##table(uint i) { \\\n";
    for (std::size_t k = 0; k < texels; ++k)
        text += "        uvec4 t" + std::to_string(k) + " = TEXEL(table, " + place_of(texels, k) + "); \\\n";
    return text + "        return " + constructor_of(records, record, 0) + "; \\\n    }\n";
}

}  // namespace

std::string readers_of(const std::vector<Record>& records, const std::string& source) {
    std::string text = "// Records put together from texels, and taken apart. Made from " + source +
                       " when the project is built.\n#ifndef SCREE_RECORD_READERS_GLSL\n#define SCREE_RECORD_READERS_GLSL\n";
    for (const Record& record : records) {
        if (has_writer(record)) text += writer_of(records, record);
        if (has_reader(record))
            text += reader_of(records, record);
        else
            text += "// No reader: " + record.name + ", whose " + std::to_string(record.bytes) + " bytes are no whole texels.\n";
    }
    return text + "#endif\n";
}

std::string layouts_of(const std::vector<Record>& records, const std::string& source) {
    std::string text = "// Where std430 puts the members of records. Made from " + source +
                       " when the project is built.\n#pragma once\n\n#define SCREE_RECORDS(RECORD, MEMBER)";
    for (const Record& record : records) {
        text += " \\\n    RECORD(" + record.name + ", " + std::to_string(record.bytes) + ")";
        for (const RecordMember& member : record.members)
            text += " \\\n    MEMBER(" + record.name + ", " + member.name + ", " + std::to_string(member.offset) + ")";
    }
    return text + "\n";
}

}  // namespace scree::host
