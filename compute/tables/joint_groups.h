// Groups of joint blocks of equal structure, which SIMD loops solve several at a time, one per lane.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/tables/block_shape.h"
#include "shaders/physics/base/records.h"

namespace scree {

// Follows from the tables of joints and blocks as long as no joint is added or removed.
struct JointGroups {
    struct Group {
        std::size_t first_shape;  // of its joints, in `shapes`
        std::uint32_t joints, bodies, tiles;
        std::size_t first, last;  // in `blocks`
    };
    std::vector<JointShape> shapes;
    std::vector<Group> groups;
    std::vector<std::uint32_t> blocks;    // group by group; within one, those whose axes have the same modes together
    std::vector<std::uint32_t> group_of;  // by position in `blocks`
    std::vector<std::size_t> cuts;        // of `blocks`, into parts of one group each that fill all lanes if they can

    BlockShape shape(const Group& group) const {
        return {shapes.data() + group.first_shape, group.joints, group.bodies, group.tiles};
    }
};

JointGroups joint_groups(const std::vector<physics::Joint>& joints, const std::vector<physics::JointBlock>& blocks,
                         std::uint32_t count);
// Whether the groups are those of these tables.
bool have_groups(const JointGroups& groups, const std::vector<physics::Joint>& joints,
                 const std::vector<physics::JointBlock>& blocks, std::uint32_t count);

}  // namespace scree
