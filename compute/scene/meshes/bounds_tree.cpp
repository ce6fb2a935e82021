// Building a tree of bounding boxes.
#include "compute/scene/meshes/bounds_tree.h"

#include <limits>
#include <numeric>
#include <utility>

namespace scree {

namespace {

constexpr std::uint32_t most_in_a_leaf = 4;
constexpr std::uint32_t deepest = 60;
constexpr std::size_t bins = 12;

constexpr float infinite = std::numeric_limits<float>::infinity();
const BoundingBox no_box{glm::vec3(infinite), glm::vec3(-infinite)};

BoundingBox joined(const BoundingBox& a, const BoundingBox& b) {
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}
float half_area(const BoundingBox& box) {
    const glm::vec3 d = glm::max(box.upper - box.lower, glm::vec3(0));
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

}  // namespace

BoundsTree::BoundsTree(const std::vector<BoundingBox>& boxes) : boxes_(boxes), items_(boxes.size()) {
    if (boxes.empty()) return;
    std::iota(items_.begin(), items_.end(), 0u);
    nodes_.reserve(boxes.size());
    nodes_.emplace_back().count = static_cast<std::uint32_t>(boxes.size());
    split(0, 0);
    for (std::size_t k = 0; k < items_.size(); ++k) boxes_[k] = boxes[items_[k]];
}

// While the tree is built boxes_ are in the order given.
void BoundsTree::split(std::uint32_t index, std::uint32_t depth) {
    const std::uint32_t first = nodes_[index].first, count = nodes_[index].count;
    BoundingBox all = no_box, centres = no_box;
    const auto centre = [&](std::uint32_t item) { return 0.5f * (boxes_[item].lower + boxes_[item].upper); };
    for (std::uint32_t k = first; k < first + count; ++k) {
        all = joined(all, boxes_[items_[k]]);
        const glm::vec3 c = centre(items_[k]);
        centres = joined(centres, {c, c});
    }
    nodes_[index].box = all;
    if (count <= most_in_a_leaf || depth >= deepest) return;
    const glm::vec3 extent = centres.upper - centres.lower;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    auto middle = items_.begin() + first + count / 2;
    if (extent[axis] > 0) {
        std::array<BoundingBox, bins> box;
        std::array<std::uint32_t, bins> number{};
        box.fill(no_box);
        const float scale = static_cast<float>(bins) * 0.9999f / extent[axis];
        const auto bin_of = [&](std::uint32_t item) {
            return std::min(bins - 1, static_cast<std::size_t>((centre(item)[axis] - centres.lower[axis]) * scale));
        };
        for (std::uint32_t k = first; k < first + count; ++k) {
            const std::size_t bin = bin_of(items_[k]);
            box[bin] = joined(box[bin], boxes_[items_[k]]);
            ++number[bin];
        }
        std::array<float, bins> behind{};  // cost of all bins from this one on
        BoundingBox sum = no_box;
        std::uint32_t items = 0;
        for (std::size_t bin = bins; bin-- > 1;) {
            sum = joined(sum, box[bin]);
            items += number[bin];
            behind[bin] = half_area(sum) * static_cast<float>(items);
        }
        sum = no_box;
        items = 0;
        float best = infinite;
        std::size_t cut = 0;
        for (std::size_t bin = 0; bin + 1 < bins; ++bin) {
            sum = joined(sum, box[bin]);
            items += number[bin];
            const float cost = half_area(sum) * static_cast<float>(items) + behind[bin + 1];
            if (items == 0 || items == count || cost >= best) continue;
            best = cost;
            cut = bin + 1;
        }
        if (cut > 0)
            middle = std::stable_partition(items_.begin() + first, items_.begin() + first + count,
                                           [&](std::uint32_t item) { return bin_of(item) < cut; });
    }
    const auto left = static_cast<std::uint32_t>(middle - items_.begin()) - first;
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    nodes_.emplace_back();
    nodes_[children].first = first;
    nodes_[children].count = left;
    nodes_[children + 1].first = first + left;
    nodes_[children + 1].count = count - left;
    nodes_[index].first = children;
    nodes_[index].count = 0;
    split(children, depth + 1);
    split(children + 1, depth + 1);
}

}  // namespace scree
