// The compiled shaders: float arithmetic that every device does alike, and records that lie in memory as in C++.
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
#include "shaders/stages/lib/tables.h"
#include "tests/house/vulkan/spirv_layout.h"

namespace {

using namespace scree;
using house::Layout;

bool is_far(std::string_view name) {
    return name.find(".far") != std::string_view::npos;
}

// In every way of reaching the tables (shaders/stages/lib/stage.glsl).
std::vector<std::string_view> stage_names() {
    std::vector<std::string_view> names;
    for (const std::string_view name : shaders::names()) {
        if (name.find('.') == std::string_view::npos || is_far(name) || name.ends_with(".texels")) names.push_back(name);
    }
    return names;
}

struct Record {
    std::size_t size;
    std::map<std::string, std::size_t> offsets;  // bytes, by member
};

// Every record that a buffer holds. A member that is missing here, or a record, is found out by the test.
const std::map<std::string, Record>& records() {
    using namespace physics;
#define M(member) \
    { #member, offsetof(R, member) }
    static const std::map<std::string, Record> table = [] {
        std::map<std::string, Record> all;
        {
            using R = Traits;
            all["Traits"] = {sizeof(R),
                             {M(size), M(shape), M(inverse_inertia), M(inverse_mass), M(friction), M(restitution),
                              M(rolling_resistance), M(gravity_scale), M(linear_damping), M(angular_damping), M(motion), M(large),
                              M(owner), M(fracture), M(joints), M(shape_data)}};
        }
        {
            using R = Pose;
            all["Pose"] = {sizeof(R), {M(position), M(rest_x), M(orientation)}};
        }
        {
            using R = Velocity;
            all["Velocity"] = {sizeof(R), {M(linear), M(rest_y), M(angular), M(rest_z)}};
        }
        {
            using R = Mass;
            all["Mass"] = {sizeof(R), {M(xx), M(xy), M(xz), M(yy), M(yz), M(zz), M(inverse_mass), M(split)}};
        }
        {
            using R = Load;
            all["Load"] = {sizeof(R), {M(acceleration), M(kept), M(angular_acceleration), M(blows)}};
        }
        {
            using R = Action;
            all["Action"] = {sizeof(R),
                             {M(body), M(flags), M(pad0), M(pad1), M(force), M(pad2), M(torque), M(pad3), M(impulse), M(pad4),
                              M(angular_impulse), M(pad5), M(velocity), M(pad6), M(angular_velocity), M(pad7)}};
        }
        {
            using R = Grip;
            all["Grip"] = {sizeof(R),
                           {M(anchor), M(body), M(target), M(bias_rate), M(mass_scale), M(most), M(spin_kept), M(pad0)}};
        }
        {
            using R = Manifold;
            all["Manifold"] = {sizeof(R), {M(normal), M(features), M(points)}};
        }
        {
            using R = Touch;
            all["Touch"] = {sizeof(R), {M(manifold), M(count), M(pad0), M(pad1), M(pad2)}};
        }
        {
            using R = Bounds;
            all["Bounds"] = {sizeof(R), {M(lower), M(level), M(upper), M(bucket), M(flight)}};
        }
        {
            using R = CellEntry;
            all["CellEntry"] = {sizeof(R), {M(lower), M(body), M(upper), M(level)}};
        }
        {
            using R = Candidate;
            all["Candidate"] = {sizeof(R), {M(owner), M(other)}};
        }
        {
            using R = Pair;
            all["Pair"] = {sizeof(R), {M(a), M(b), M(kind), M(previous)}};
        }
        {
            using R = Contact;
            all["Contact"] = {
                sizeof(R),
                {M(a), M(b), M(count), M(features), M(normal), M(age), M(d), M(load), M(points), M(turn_a), M(turn_b)}};
        }
        {
            using R = Impulse;
            all["Impulse"] = {
                sizeof(R),
                {M(normal), M(separation), M(approach), M(friction), M(twist), M(rolling), M(slipped), M(d), M(pressed)}};
        }
        {
            using R = Constraint;
            all["Constraint"] = {
                sizeof(R),
                {M(a), M(b), M(slot_a), M(slot_b), M(normal), M(friction), M(arms), M(centre), M(reach), M(rolling_resistance),
                 M(restitution), M(count), M(anchor), M(radius_a), M(radius_b), M(pair), M(leave)}};
        }
        {
            using R = Slot;
            all["Slot"] = {sizeof(R), {M(linear), M(carries), M(angular), M(told)}};
        }
        {
            using R = Flight;
            all["Flight"] = {sizeof(R), {M(position), M(pad0), M(orientation), M(stops), M(struck), M(pad1)}};
        }
        {
            using R = JointAxis;
            all["JointAxis"] = {sizeof(R), {M(mode), M(lower), M(upper), M(stiffness), M(damping), M(rest), M(speed), M(most)}};
        }
        {
            using R = JointRow;
            all["JointRow"] = {sizeof(R),
                               {M(direction), M(place), M(arm_a), M(drift), M(arm_b), M(give), M(drive), M(stop), M(drive_change),
                                M(stop_change)}};
        }
        {
            using R = physics::Joint;
            all["Joint"] = {sizeof(R), {M(a),
                                        M(b),
                                        M(member_a),
                                        M(member_b),
                                        M(anchor_a),
                                        M(flags),
                                        M(anchor_b),
                                        M(next_a),
                                        M(frame_a),
                                        M(frame_b),
                                        M(axes),
                                        M(break_force),
                                        M(break_torque),
                                        M(next_b),
                                        M(links),
                                        M(links_to),
                                        M(block_joints),
                                        M(block_members),
                                        M(first_of_block),
                                        M(restless),
                                        M(pins),
                                        M(broken),
                                        M(solved),
                                        M(pad0),
                                        M(force),
                                        M(greatest_force),
                                        M(torque),
                                        M(greatest_torque),
                                        M(member),
                                        M(slot),
                                        M(pressed),
                                        M(blocks),
                                        M(mass),
                                        M(velocity),
                                        M(rows),
                                        M(solution),
                                        M(diagonal),
                                        M(coupling)}};
        }
        {
            using R = VehicleWheel;
            all["VehicleWheel"] = {sizeof(R),
                                   {M(joint), M(body), M(radius), M(ahead), M(aside), M(torque), M(power), M(drag), M(brake),
                                    M(hand_brake), M(skid), M(steers)}};
        }
        {
            using R = Handling;
            all["Handling"] = {sizeof(R),
                               {M(chassis),  M(wheels),  M(route),      M(points),   M(frame), M(top_speed), M(back_speed),
                                M(tightest), M(turning), M(lateral),    M(loops),    M(speed), M(curvature), M(throttle),
                                M(brake),    M(steer),   M(hand_brake), M(by_route), M(next),  M(passed),    M(pad0)}};
        }
        {
            using R = physics::Vehicle;
            all["Vehicle"] = {sizeof(R), {M(handling), M(wheel)}};
        }
        {
            using R = Parameters;
            all["Parameters"] = {sizeof(R),
                                 {M(gravity),
                                  M(dt),
                                  M(h),
                                  M(inverse_h),
                                  M(bias_rate),
                                  M(mass_scale),
                                  M(impulse_scale),
                                  M(push_speed),
                                  M(inverse_relaxation),
                                  M(speculative),
                                  M(restitution_threshold),
                                  M(max_speed),
                                  M(max_spin),
                                  M(cell),
                                  M(inverse_cell),
                                  M(bodies),
                                  M(buckets),
                                  M(pair_capacity),
                                  M(contact_capacity),
                                  M(group_size),
                                  M(group_shift),
                                  M(actions),
                                  M(redo),
                                  M(wake_all),
                                  M(sleep_steps),
                                  M(sleep_speed),
                                  M(friction_factor),
                                  M(least_restitution),
                                  M(held),
                                  M(first_part),
                                  M(joint_blocks),
                                  M(vehicles),
                                  M(cell_ends_begin),
                                  M(pair_starts_begin),
                                  M(slot_ends_begin),
                                  M(first_contacts_begin),
                                  M(rests_begin),
                                  M(ids_begin),
                                  M(strains_begin),
                                  M(touching_begin),
                                  M(pairs_by_kind_begin),
                                  M(solved_contacts_begin),
                                  M(kind_starts_begin),
                                  M(contact_starts_begin),
                                  M(carried_begin),
                                  M(slot_sides_begin),
                                  M(scan_sums_begin),
                                  M(hulls_begin),
                                  M(parts_begin),
                                  M(fractures_begin),
                                  M(pieces_begin),
                                  M(tyres_begin),
                                  M(way_points_begin),
                                  M(pad0),
                                  M(grips)}};
        }
        {
            using R = Counts;
            all["Counts"] = {sizeof(R),
                             {M(pairs), M(contacts), M(levels), M(overflow), M(required_pairs), M(required_contacts), M(steps),
                              M(pairs_coarse), M(levels_stirring), M(large_stirring), M(sleepers), M(solved), M(kind_first),
                              M(fast), M(broken), M(pad0), M(pad1), M(arguments)}};
        }
        return all;
    }();
#undef M
    return table;
}

// The record and binding of each block, from the list that C++ and GLSL share, and of what lies in a table until that is made
// (shaders/stages/lib/partner_cache.glsl).
struct TableEntry {
    std::uint32_t binding;
    std::string record;
    std::size_t size;
};
std::map<std::string, TableEntry> tables() {
    using namespace physics;
#define SCREE_ENTRY(binding, name, block, record, length) {#block, {binding, #record, sizeof(record)}},
    std::map<std::string, TableEntry> all = {SCREE_BUFFERS(SCREE_ENTRY)};
    all["PartnerCacheTable"] = {all.at("PairsTable").binding, "uvec4", sizeof(uvec4)};
    return all;
#undef SCREE_ENTRY
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
                FAIL_CHECK("has no row in the table of records");
                continue;
            }
            seen.insert(type.name);
            for (const house::MemberLayout& member : type.members) {
                INFO("member " << member.name);
                const auto offset = found->second.offsets.find(member.name);
                if (offset == found->second.offsets.end()) {
                    FAIL_CHECK("has no row in the table of records");
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
        // A record of nothing but words may be shorter: no vector aligns it.
        CHECK((record.size % 16 == 0 || name == "Candidate"));
    }
}

TEST_CASE("house: every block of a stage is a table of the step, at its binding", "[house]") {
    const auto expected = tables();
    for (const std::string_view name : stage_names()) {
        if (is_far(name)) continue;
        for (const house::StructLayout& type : house::layout_of(shaders::find(name)).structs) {
            if (!type.is_block || type.binding == house::no_binding) continue;
            INFO("shader " << name << ", block " << type.name);
            const auto found = expected.find(type.name);
            if (found == expected.end()) {
                FAIL_CHECK("is no table of shaders/stages/lib/tables.h");
                continue;
            }
            CHECK(type.binding == found->second.binding);
            REQUIRE(type.members.size() == 1);
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
        // And, of some, what there is in the scene (shaders/stages/lib/features.glsl).
        ids.erase(1);
        // And, of those that are several in turn, whether the workgroup is one subgroup (shaders/stages/lib/fused.glsl).
        ids.erase(2);
        CHECK(ids == std::set<std::uint32_t>{0});
    }
}
