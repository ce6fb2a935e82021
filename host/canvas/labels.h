// Labels of a picture: which body is seen at the centre of each pixel, how far away and with what normal.
//
// They are drawn by the device with the same bodies as the picture. Hulls and meshes are their triangles; of round bodies and
// boxes each fragment follows its pixel's ray by the law of rays (shaders/physics/collide/ray.h), so that outlines are exact at
// any zoom. Small bodies, which pictures widen to a pixel, have their own size.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "host/canvas/canvas_plan.h"
#include "host/canvas/draw_geometry.h"

namespace scree::host {

struct LabelRequest {
    int width = 0, height = 0;  // pixels
    bool pixels = true;         // what is seen
    bool covers = false;        // what covers each pixel
    glm::ivec2 shift{0};        // of a picture so many pictures to the right of the camera's and below it
};

struct Cover {
    std::uint32_t row = 0, pixel = 0;  // counted row by row from the upper left
};

struct LabelledPixel {
    glm::vec2 folded;   // see normal_of()
    float depth;        // m along the optical axis; infinite: nothing
    std::uint32_t row;  // of the body tables, of a triangle of a mesh its own; no_row: nothing
};
constexpr std::uint32_t no_row = 0xFFFFFFFF;
vec3 normal_of(const LabelledPixel& pixel);  // of the surface, in the world, unit, outward

struct Labels {
    std::vector<LabelledPixel> pixels;  // row by row from the upper left
    // Each pixel of each dynamic body, also of a hidden one, in any order, and once for each of its surfaces there.
    std::vector<Cover> covers;
};

// The draws of labels and of covers: graphics state, meshes and runs.
const std::vector<Draw>& label_draws();
bool lists_covers(const Draw& draw);
// Instances of such a draw.
std::uint32_t instances_of(const Draw& draw, const Scenery& scenery);

// The list of covers in device memory: their number, the room for them, and Cover one after the other.
struct CoverHead {
    std::uint32_t count = 0, room = 0;
};
// How a list of what covers a picture's pixels is drawn: in as many bands of rows as fit.
class CoverBands {
public:
    explicit CoverBands(int height) : height_(height), rows_(height) {}
    bool done() const { return first_ >= height_; }
    int first() const { return first_; }
    int end() const { return first_ + rows_ < height_ ? first_ + rows_ : height_; }
    std::uint32_t room() const { return room_; }
    // After a band was drawn. False: it did not fit, and is to be drawn anew, with other bounds or more room.
    bool take(std::uint32_t count);

private:
    static constexpr std::uint32_t most = 1u << 23;
    int height_, first_ = 0, rows_;
    std::uint32_t room_ = 1u << 18;
};

}  // namespace scree::host
