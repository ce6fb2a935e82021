// Groups of joint blocks of equal structure.
#include "compute/tables/joint_groups.h"

#include <algorithm>
#include <map>
#include <span>

#include "shaders/physics/joint/joint_block.h"

namespace scree {

namespace {

using Words = std::vector<std::uint32_t>;

std::uint32_t from(std::uint32_t body, std::uint32_t first) {
    return body == physics::NONE ? physics::NONE : body - first;
}

// The numbers of bodies and joints, and of each joint its bodies and links.
Words structure_of(const physics::JointBlock& block, std::span<const physics::Joint> joints) {
    Words words{block.joints, block.bodies};
    for (const physics::Joint& joint : joints) {
        words.insert(words.end(),
                     {from(joint.block_body_a, block.first_body), from(joint.block_body_b, block.first_body), joint.fill_in});
        for (std::uint32_t l = 0; l < joint.fill_in; ++l) words.push_back(joint.fill_in_of[l] - block.first_joint);
    }
    if (block.couplings != 0) words.push_back(block.couplings);
    return words;
}
Words modes_of(std::span<const physics::Joint> joints) {
    Words words;
    for (const physics::Joint& joint : joints) {
        words.push_back(joint.flags);
        for (const physics::JointAxis& axis : joint.axes) words.push_back(axis.mode);
    }
    return words;
}

std::vector<JointShape> shapes_of(const physics::JointBlock& block, std::span<const physics::Joint> joints) {
    std::vector<JointShape> shapes;
    std::uint32_t tiles = 0;
    for (const physics::Joint& joint : joints) {
        const auto ends = [&](const physics::Joint& other) {
            return physics::shared_ends(other.block_body_a, other.block_body_b, joint.block_body_a, joint.block_body_b);
        };
        JointShape& shape = shapes.emplace_back();
        shape.a = static_cast<std::int32_t>(from(joint.block_body_a, block.first_body));
        shape.b = static_cast<std::int32_t>(from(joint.block_body_b, block.first_body));
        shape.first_tile = tiles;
        shape.links = joint.fill_in;
        shape.own_ends = ends(joint);
        for (std::uint32_t l = 0; l < joint.fill_in; ++l) {
            shape.link[l] = joint.fill_in_of[l] - block.first_joint;
            shape.ends[l] = ends(joints[shape.link[l]]);
        }
        tiles += 1 + joint.fill_in;
    }
    return shapes;
}

bool has_shape(const physics::Joint& joint, const physics::JointBlock& block, const JointShape& shape) {
    if (static_cast<std::int32_t>(from(joint.block_body_a, block.first_body)) != shape.a ||
        static_cast<std::int32_t>(from(joint.block_body_b, block.first_body)) != shape.b || joint.fill_in != shape.links)
        return false;
    for (std::uint32_t l = 0; l < shape.links; ++l)
        if (joint.fill_in_of[l] - block.first_joint != shape.link[l]) return false;
    return true;
}

}  // namespace

bool have_groups(const JointGroups& groups, const std::vector<physics::Joint>& joints,
                 const std::vector<physics::JointBlock>& blocks, std::uint32_t count) {
    if (groups.blocks.size() != count) return false;
    for (const JointGroups::Group& group : groups.groups)
        for (std::size_t at = group.first; at < group.last; ++at) {
            const physics::JointBlock& block = blocks[groups.blocks[at]];
            if (block.joints != group.joints || block.bodies != group.bodies) return false;
            for (std::uint32_t j = 0; j < block.joints; ++j)
                if (!has_shape(joints[block.first_joint + j], block, groups.shapes[group.first_shape + j])) return false;
        }
    return true;
}

JointGroups joint_groups(const std::vector<physics::Joint>& joints, const std::vector<physics::JointBlock>& blocks,
                         std::uint32_t count) {
    std::map<Words, std::map<Words, Words>> found;  // blocks by structure and modes
    const auto joints_of = [&](std::uint32_t b) { return std::span(joints).subspan(blocks[b].first_joint, blocks[b].joints); };
    for (std::uint32_t b = 0; b < count; ++b) found[structure_of(blocks[b], joints_of(b))][modes_of(joints_of(b))].push_back(b);
    JointGroups groups;
    for (const auto& [structure, by_modes] : found) {
        const std::uint32_t one = by_modes.begin()->second.front();
        const std::vector<JointShape> shapes = shapes_of(blocks[one], joints_of(one));
        JointGroups::Group group{groups.shapes.size(), blocks[one].joints, blocks[one].bodies, 0, groups.blocks.size(), 0};
        for (const JointShape& shape : shapes) group.tiles += 1 + shape.links;
        for (const auto& [modes, equal] : by_modes) groups.blocks.insert(groups.blocks.end(), equal.begin(), equal.end());
        group.last = groups.blocks.size();
        groups.group_of.resize(group.last, static_cast<std::uint32_t>(groups.groups.size()));
        groups.shapes.insert(groups.shapes.end(), shapes.begin(), shapes.end());
        for (std::size_t cut = group.first; cut < group.last; cut += most_equal_blocks) groups.cuts.push_back(cut);
        groups.groups.push_back(group);
    }
    groups.cuts.push_back(groups.blocks.size());
    return groups;
}

}  // namespace scree
