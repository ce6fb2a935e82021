// Places for grains that are there at the start.
#include "compute/scene/grains/grain_stacks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace scree {

namespace {

constexpr double no_place = std::numeric_limits<double>::infinity();

}

GrainStacks::GrainStacks(const GrainRegion& region, double largest, std::uint64_t seed)
    : gap_(5e-4 * largest), random_(seed, 0xA0000000u) {
    const GrainBox box = box_about(region);
    low_ = glm::dvec3(box.low);
    const glm::dvec3 size = glm::dvec3(box.high) - low_;
    if (const auto* cylinder = std::get_if<GrainCylinder>(&region)) radius_ = static_cast<double>(cylinder->radius);
    constexpr double most_columns = 2e6, columns_of_largest = 6;
    const double wide = std::max(largest / columns_of_largest, std::sqrt(size.x * size.z / most_columns));
    columns_ = static_cast<std::uint32_t>(std::clamp(std::floor(size.x / wide), 1.0, most_columns));
    rows_ = static_cast<std::uint32_t>(std::clamp(std::floor(size.z / wide), 1.0, most_columns));
    wide_x_ = size.x / columns_;
    wide_z_ = size.z / rows_;
    heights_.assign(std::size_t{columns_} * rows_, 0);
    for (std::uint32_t z = 0; z < rows_; ++z)
        for (std::uint32_t x = 0; x < columns_; ++x)
            if (!is_inside(x, z)) heights_[std::size_t{z} * columns_ + x] = no_place;
}

bool GrainStacks::is_inside(std::uint32_t x, std::uint32_t z) const {
    if (radius_ == 0) return true;
    const double far_x = std::max(std::abs(x * wide_x_ - radius_), std::abs((x + 1) * wide_x_ - radius_));
    const double far_z = std::max(std::abs(z * wide_z_ - radius_), std::abs((z + 1) * wide_z_ - radius_));
    return far_x * far_x + far_z * far_z <= radius_ * radius_;
}

std::optional<GrainStacks::Place> GrainStacks::put(const glm::dvec3& box) {
    const auto x = static_cast<std::uint32_t>(std::min(std::ceil((box.x + gap_) / wide_x_), 4e9));
    const auto z = static_cast<std::uint32_t>(std::min(std::ceil((box.z + gap_) / wide_z_), 4e9));
    if (x > columns_ || z > rows_) return std::nullopt;
    std::uint32_t best_x = 0, best_z = 0;
    double least = no_place;
    const auto look = [&](std::uint32_t from_x, std::uint32_t from_z) {
        double top = 0;
        for (std::uint32_t k = from_z; k < from_z + z && top < least; ++k)
            for (std::uint32_t i = from_x; i < from_x + x; ++i) top = std::max(top, heights_[std::size_t{k} * columns_ + i]);
        if (top >= least) return;
        least = top;
        best_x = from_x;
        best_z = from_z;
    };
    constexpr int tries = 24;
    const auto below = [&](std::uint32_t count) {
        return static_cast<std::uint32_t>((std::uint64_t{random_.bits()} * count) >> 32);
    };
    for (int i = 0; i < tries; ++i) {
        const std::uint32_t from_x = below(columns_ - x + 1);
        look(from_x, below(rows_ - z + 1));
    }
    if (least == no_place)  // of a cylinder that is narrow, tries may all be outside
        for (std::uint32_t k = 0; k + z <= rows_; ++k)
            for (std::uint32_t i = 0; i + x <= columns_; ++i) look(i, k);
    if (least == no_place) return std::nullopt;
    const double top = least + box.y + gap_;
    for (std::uint32_t k = best_z; k < best_z + z; ++k)
        std::fill_n(heights_.begin() + static_cast<std::ptrdiff_t>(std::size_t{k} * columns_ + best_x), x, top);
    return Place{low_ + glm::dvec3(best_x * wide_x_, least, best_z * wide_z_), {x * wide_x_ - gap_, box.y, z * wide_z_ - gap_}};
}

GrainBox box_about(const GrainRegion& region) {
    if (const auto* box = std::get_if<GrainBox>(&region)) return *box;
    const auto& cylinder = std::get<GrainCylinder>(region);
    const vec3 half(cylinder.radius, 0, cylinder.radius);
    return {cylinder.base - half, cylinder.base + half + vec3(0, cylinder.height, 0)};
}

double volume_of(const GrainRegion& region) {
    if (const auto* box = std::get_if<GrainBox>(&region)) {
        const glm::dvec3 size = glm::dvec3(box->high) - glm::dvec3(box->low);
        return size.x * size.y * size.z;
    }
    const auto& cylinder = std::get<GrainCylinder>(region);
    return std::numbers::pi * static_cast<double>(cylinder.radius) * static_cast<double>(cylinder.radius) *
           static_cast<double>(cylinder.height);
}

}  // namespace scree
