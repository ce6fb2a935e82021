// Stage declarations match the compiled shaders: tables read and written, and features tested.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "compute/plan/plan.h"
#include "compute/plan/stage_fusion.h"
#include "compute/tables/table_layout.h"
#include "shaders/embedded.h"
#include "shaders/stages/lib/record_layouts.h"
#include "tests/house/vulkan/spirv_access.h"

using namespace scree;

namespace {

const std::vector<std::string> ways = {"", ".bda", ".texels", ".bda.texels"};  // shaders/stages/lib/stage.glsl

std::optional<Table> table_called(std::string_view name) {
    for (std::size_t i = 0; i < table_count; ++i)
        if (table_infos()[i].name == name) return static_cast<Table>(i);
    return std::nullopt;
}

// The table with this buffer of its own; none for the shared buffers of words and quads.
std::optional<Table> table_in(std::size_t buffer) {
    return table_called(buffer_infos()[buffer].name);
}

// The table whose offset is at this place of the parameters.
std::optional<Table> table_that_begins_at(const house::ArrayPlace& place) {
    static const std::vector<std::string> members = [] {
        std::vector<std::string> all;
#define SCREE_RECORD(record, size)
#define SCREE_MEMBER(record, member, offset) \
    if (std::string_view(#record) == "Parameters") all.push_back(#member);
        SCREE_RECORDS(SCREE_RECORD, SCREE_MEMBER)
#undef SCREE_RECORD
#undef SCREE_MEMBER
        return all;
    }();
#define SCREE_TABLE(buffer, name, block, record, length) Table::name,
    static constexpr std::array in_turn{SCREE_WORD_TABLES(SCREE_TABLE) SCREE_QUAD_TABLES(SCREE_TABLE)};
#undef SCREE_TABLE
    if (members.at(place.member) != "table_offsets" || place.at >= in_turn.size()) return std::nullopt;
    return in_turn[place.at];
}

// Accesses per table, merged over storage buffer, uniform texels and storage texels.
std::map<Table, house::BufferAccess> shader_accesses(const house::Accesses& accesses) {
    std::map<Table, house::BufferAccess> all;
    const auto add = [&](std::optional<Table> table, const house::BufferAccess& access) {
        if (!table || *table == Table::parameters) return;
        all[*table].loads |= access.loads;
        all[*table].stores |= access.stores;
        all[*table].atomics |= access.atomics;
    };
    for (const auto& [binding, access] : accesses.of) add(table_in(binding % buffer_count), access);
    for (const auto& [place, access] : accesses.of_place) add(table_that_begins_at(place), access);
    return all;
}

house::Accesses accesses_of_shader(const std::string& name) {
    return house::accesses_of(shaders::find(name), shaders::variant_of(name));
}

const Access* find(const std::vector<Access>& list, Table table) {
    const auto found = std::find_if(list.begin(), list.end(), [&](const Access& access) { return access.table == table; });
    return found == list.end() ? nullptr : &*found;
}

std::string name_of(Table table) {
    return table_infos()[static_cast<std::size_t>(table)].name;
}

// A declared access must occur in at least one variant, since with buffer addresses a few tables have other names.
void require_as_compiled(const StageDeclaration& stage) {
    std::map<Table, house::BufferAccess> in_any;
    for (const std::string& way : ways) {
        INFO("shader " << stage.name << way);
        const house::Accesses accesses = accesses_of_shader(stage.name + way);
        CHECK(accesses.tested_bits == stage.tested_features);
        const auto compiled = shader_accesses(accesses);
        for (const auto& [table, access] : compiled) {
            INFO("table " << name_of(table));
            const Access* written = find(stage.writes, table);
            if (access.loads) CHECK(find(stage.reads, table) != nullptr);
            if (access.stores || access.atomics) CHECK(written != nullptr);
            if (written && written->manner == Manner::by_atomics) CHECK_FALSE(access.stores);
        }
        for (const auto& [table, access] : compiled) {
            in_any[table].loads |= access.loads;
            in_any[table].stores |= access.stores;
            in_any[table].atomics |= access.atomics;
        }
    }
    for (const Access& read : stage.reads) {
        INFO("stage " << stage.name << " reads " << name_of(read.table));
        CHECK((in_any.contains(read.table) && (in_any.at(read.table).loads || in_any.at(read.table).atomics)));
    }
    for (const Access& write : stage.writes) {
        INFO("stage " << stage.name << " writes " << name_of(write.table));
        CHECK((in_any.contains(write.table) && (in_any.at(write.table).stores || in_any.at(write.table).atomics)));
    }
}

}  // namespace

TEST_CASE("house: every stage is declared to read and write what its shader does", "[house]") {
    for (const StageDeclaration& stage : stage_declarations()) {
        require_as_compiled(stage);
        std::set<Table> reads, writes;
        for (const Access& access : stage.reads) CHECK(reads.insert(access.table).second);
        for (const Access& access : stage.writes) CHECK(writes.insert(access.table).second);
    }
}

TEST_CASE("house: every shader of a stage is declared, and stands in a plan", "[house]") {
    const physics::Parameters small{};
    std::set<std::string> declared, planned, recorded, compiled;
    for (const StageDeclaration& stage : stage_declarations()) CHECK(declared.insert(stage.name).second);
    // With joints, stages that are fused in small worlds are separated by others.
    for (const SceneFeatures& features : {SceneFeatures::everything(), SceneFeatures{}}) {
        for (const Stage& stage : plan(2, features)) planned.insert(stage.name);
        for (const Stage& stage : fused(plan(2, features), small, 8)) recorded.insert(stage.name);
    }
    CHECK(declared == planned);
    recorded.insert(planned.begin(), planned.end());
    for (const std::string_view name : shaders::names())
        if (name.find('.') == std::string_view::npos) compiled.insert(std::string(name));
    CHECK(recorded == compiled);
}

TEST_CASE("house: a stage that is several in turn reads and writes no table that none of them does", "[house]") {
    const physics::Parameters small{};
    for (const SceneFeatures& features : {SceneFeatures::everything(), SceneFeatures{}}) {
        for (const Stage& stage : fused(plan(2, features), small, 8)) {
            if (stage.reference) continue;
            for (const std::string& way : ways) {
                INFO("shader " << stage.name << way);
                const house::Accesses accesses = accesses_of_shader(stage.name + way);
                CHECK(accesses.tested_bits == stage.tested_features);
                for (const auto& [table, access] : shader_accesses(accesses)) {
                    INFO("table " << name_of(table));
                    if (access.loads) CHECK(find(stage.reads, table) != nullptr);
                    if (access.stores || access.atomics) CHECK(find(stage.writes, table) != nullptr);
                }
            }
        }
    }
}
