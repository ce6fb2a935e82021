// The compiled shaders: exact float arithmetic, and record layouts equal to C++.
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "host/spirv/spirv.h"
#include "shaders/embedded.h"
#include "shaders/physics/base/records.h"
#include "shaders/stages/lib/record_layouts.h"
#include "shaders/stages/lib/tables.h"
#include "tests/house/vulkan/spirv_layout.h"

namespace {

using namespace scree;
using house::Layout;

bool is_by_address(std::string_view name) {
    return name.find(".bda") != std::string_view::npos;
}

// Stages in every variant of table access (shaders/stages/lib/stage.glsl).
std::vector<std::string_view> stage_names() {
    std::vector<std::string_view> names;
    for (const std::string_view name : shaders::names()) {
        if (name.find('.') == std::string_view::npos || is_by_address(name) || name.ends_with(".texels")) names.push_back(name);
    }
    return names;
}

struct Record {
    std::size_t size;
    std::map<std::string, std::size_t> offsets;  // bytes, per member
};

// Layouts of all records in C++.
const std::map<std::string, Record>& records() {
    static const std::map<std::string, Record> table = [] {
        std::map<std::string, Record> all;
#define SCREE_RECORD(record, bytes) all[#record].size = sizeof(physics::record);
#define SCREE_MEMBER(record, member, offset) all[#record].offsets[#member] = offsetof(physics::record, member);
        SCREE_RECORDS(SCREE_RECORD, SCREE_MEMBER)
#undef SCREE_MEMBER
#undef SCREE_RECORD
        return all;
    }();
    return table;
}

// Record and binding of each block, from the list of tables that C++ and GLSL share.
struct TableEntry {
    std::uint32_t binding;
    std::string record;
    std::size_t size;
};
std::map<std::string, TableEntry> tables() {
    using namespace physics;
#define SCREE_ENTRY(binding, name, block, record, length) {#block, {binding, #record, sizeof(record)}},
    std::map<std::string, TableEntry> all = {SCREE_BUFFERS(SCREE_ENTRY)};
#undef SCREE_ENTRY
#define SCREE_ENTRY(binding, name, block, record, length) all[#block] = {binding, "uvec4", sizeof(uvec4)};
    SCREE_GROUPED_TABLES(SCREE_ENTRY)
#undef SCREE_ENTRY
    // The table of pairs' memory before pairs are written (shaders/stages/lib/partner_cache.glsl).
    all["PartnerCacheTable"] = {all.at("PairsTable").binding, "uvec4", sizeof(uvec4)};
    return all;
}

}  // namespace

TEST_CASE("house: no stage has an instruction whose bits depend on the device", "[house]") {
    REQUIRE(stage_names().size() > 10);
    for (const std::string_view name : stage_names()) {
        for (const std::string& instruction : host::inexact_instructions(shaders::find(name)))
            FAIL_CHECK(name << ": " << instruction);
    }
}

TEST_CASE("house: no float operation of a stage may be contracted", "[house]") {
    constexpr std::uint16_t op_decorate = 71;
    constexpr std::uint32_t no_contraction = 42;
    // FNegate, FAdd, FSub, FMul, FDiv, FRem, FMod, VectorTimesScalar to OuterProduct, Dot.
    const std::set<std::uint16_t> float_arithmetic = {127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148};
    std::size_t seen = 0;
    for (const std::string_view name : stage_names()) {
        std::set<std::uint32_t> decorated;
        const auto instructions = host::spirv_instructions(shaders::find(name));
        for (const host::SpirvInstruction& i : instructions) {
            if (i.opcode == op_decorate && i.words[2] == no_contraction) decorated.insert(i.words[1]);
        }
        for (const host::SpirvInstruction& i : instructions) {
            if (float_arithmetic.count(i.opcode) == 0) continue;
            ++seen;
            if (decorated.count(i.words[2]) == 0) FAIL_CHECK(name << ": " << host::spirv_name(i.opcode) << " may be contracted");
        }
    }
    REQUIRE(seen > 100);
}

TEST_CASE("house: records lie in memory alike in C++ and in the shaders", "[house]") {
    std::set<std::string> seen;
    for (const std::string_view name : stage_names()) {
        const Layout layout = house::layout_of(shaders::find(name));
        for (const house::StructLayout& type : layout.structs) {
            if (type.is_block) continue;
            INFO("shader " << name << ", struct " << type.name);
            const auto found = records().find(type.name);
            if (found == records().end()) {
                FAIL_CHECK("is not in records.h");
                continue;
            }
            seen.insert(type.name);
            for (const house::MemberLayout& member : type.members) {
                INFO("member " << member.name);
                const auto offset = found->second.offsets.find(member.name);
                if (offset == found->second.offsets.end()) {
                    FAIL_CHECK("is not in records.h");
                } else {
                    CHECK(member.offset == offset->second);
                }
            }
            CHECK(type.members.size() == found->second.offsets.size());
        }
        for (const house::ArrayLayout& array : layout.arrays) {
            INFO("shader " << name << ", array of " << array.element);
            const auto found = records().find(array.element);
            CHECK(array.stride == (found == records().end() ? array.element_bytes : found->second.size));
        }
    }
    CHECK(seen.size() > 8);
    for (const auto& [name, record] : records()) {
        INFO("record " << name);
        // Records of words only may have other sizes, as no vector aligns them.
        CHECK((record.size % 16 == 0 || name == "Candidate"));
    }
}

TEST_CASE("house: the readers of records take each member from where C++ has it", "[house]") {
#define SCREE_RECORD(record, bytes) CHECK(sizeof(physics::record) == bytes);
#define SCREE_MEMBER(record, member, offset) CHECK(offsetof(physics::record, member) == offset);
    SCREE_RECORDS(SCREE_RECORD, SCREE_MEMBER)
#undef SCREE_MEMBER
#undef SCREE_RECORD
}

TEST_CASE("house: every block of a stage is a table of the step, at its binding", "[house]") {
    const auto expected = tables();
    for (const std::string_view name : stage_names()) {
        if (is_by_address(name)) continue;
        for (const house::StructLayout& type : house::layout_of(shaders::find(name)).structs) {
            if (!type.is_block || type.binding == house::no_binding) continue;
            INFO("shader " << name << ", block " << type.name);
            const bool is_long = type.name.ends_with("Long");  // the same table, to be written in words of 64 bits
            const auto found = expected.find(is_long ? type.name.substr(0, type.name.size() - 4) : type.name);
            if (found == expected.end()) {
                FAIL_CHECK("is no table of shaders/stages/lib/tables.h");
                continue;
            }
            CHECK(type.binding == found->second.binding);
            REQUIRE(type.members.size() == 1);
            if (is_long) {
                CHECK(type.members[0].stride == 16);
                CHECK(found->second.size % 16 == 0);
                continue;
            }
            CHECK(type.members[0].element == found->second.record);
            CHECK(type.members[0].stride == found->second.size);
        }
    }
}

TEST_CASE("house: the host chooses the workgroup size of every stage", "[house]") {
    constexpr std::uint16_t op_decorate = 71;
    constexpr std::uint32_t spec_id = 1;
    for (const std::string_view name : stage_names()) {
        std::set<std::uint32_t> ids;
        for (const host::SpirvInstruction& i : host::spirv_instructions(shaders::find(name))) {
            if (i.opcode == op_decorate && i.words[2] == spec_id) ids.insert(i.words[3]);
        }
        INFO("shader " << name);
        // Some use the scene's features (shaders/stages/lib/features.glsl).
        ids.erase(1);
        // Fused stages: whether the workgroup is one subgroup (shaders/stages/lib/fused.glsl).
        ids.erase(2);
        // Stages that share a module: VARIANT.
        ids.erase(3);
        CHECK(ids == std::set<std::uint32_t>{0});
    }
}
