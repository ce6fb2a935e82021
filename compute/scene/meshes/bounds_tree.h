// A tree of bounding boxes, for queries: binary, split where the surface area heuristic is least (Wald 2007).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "shaders/physics/collide/ray.h"

namespace scree {

struct BoundingBox {
    glm::vec3 lower{0}, upper{0};  // m
};

class BoundsTree {
public:
    BoundsTree() = default;
    explicit BoundsTree(const std::vector<BoundingBox>& boxes);

    // Calls visit(box) with the index of each box that overlaps another one.
    template <class Visit>
    void for_each_overlap(const BoundingBox& around, const Visit& visit) const {
        if (nodes_.empty()) return;
        Stack stack;
        stack.push(0, 0);
        while (!stack.empty()) {
            const Node& node = nodes_[stack.pop().node];
            if (!overlap(node.box, around)) continue;
            if (node.count == 0) {
                stack.push(node.first, 0);
                stack.push(node.first + 1, 0);
            }
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
                if (overlap(boxes_[k], around)) visit(items_[k]);
        }
    }
    // Calls visit(box, near) for the boxes that a ray meets within `reach`, near ones first as far as the tree knows; `near`
    // is where it enters the box, m, and visit may lower `reach`. Boxes are extended by `grow`.
    template <class Visit>
    void for_each_met(glm::vec3 from, glm::vec3 along, glm::vec3 grow, const float& reach, const Visit& visit) const {
        if (nodes_.empty()) return;
        const Slabs slabs(from, along, grow);
        Stack stack;
        if (const float at = slabs.enter(nodes_[0].box, reach); at <= reach) stack.push(0, at);
        while (!stack.empty()) {
            const auto [index, near] = stack.pop();
            if (near > reach) continue;
            const Node& node = nodes_[index];
            if (node.count > 0) {
                for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
                    if (const float at = slabs.enter(boxes_[k], reach); at <= reach) visit(items_[k], at);
                continue;
            }
            const float one = slabs.enter(nodes_[node.first].box, reach), other = slabs.enter(nodes_[node.first + 1].box, reach);
            const bool swap = one <= other;  // the nearer one is taken up first
            if (const float far = swap ? other : one; far <= reach) stack.push(node.first + (swap ? 1 : 0), far);
            if (const float close = swap ? one : other; close <= reach) stack.push(node.first + (swap ? 0 : 1), close);
        }
    }

private:
    struct Node {
        BoundingBox box;
        std::uint32_t first = 0;  // of its items; or of its two nodes
        std::uint32_t count = 0;  // items; 0: none, but two nodes
    };
    struct Stack {
        struct Entry {
            std::uint32_t node;
            float near;
        };
        std::array<Entry, 128> entries;  // the tree is at most 64 levels deep
        std::size_t size = 0;
        bool empty() const { return size == 0; }
        void push(std::uint32_t node, float near) { entries[size++] = {node, near}; }
        Entry pop() { return entries[--size]; }
    };
    // Entry of a ray into boxes, as on a device.
    struct Slabs {
        glm::vec3 from, inverse, grow;
        Slabs(glm::vec3 f, glm::vec3 along, glm::vec3 g) : from(f), inverse(physics::ray_inverse3(along)), grow(g) {}
        float enter(const BoundingBox& box, float reach) const {
            return physics::entry_into_box(box.lower - grow, box.upper + grow, from, inverse, reach);
        }
    };
    static bool overlap(const BoundingBox& a, const BoundingBox& b) {
        return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
               a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
    }
    void split(std::uint32_t node, std::uint32_t depth);

    std::vector<Node> nodes_;
    std::vector<BoundingBox> boxes_;    // in the order of items_
    std::vector<std::uint32_t> items_;  // index of each box as given
};

}  // namespace scree
