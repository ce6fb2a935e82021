// What a drawing shows at each pixel, by body and part: the labels of its canvas (host/canvas/labels.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "compute/world.h"
#include "demos/film/channels.h"
#include "demos/film/drawing.h"
#include "host/canvas/labels.h"

namespace scree::demos {

// Bodies and parts by rows of the tables of bodies.
class RowNames {
public:
    explicit RowNames(const World& world);
    struct Name {
        std::size_t body = 0, part = 0;
    };
    Name operator[](std::uint32_t row) const;

private:
    std::vector<std::uint32_t> bodies_;                          // by row, of rows of bodies
    std::vector<std::pair<std::size_t, std::uint32_t>> begins_;  // first rows of parts, and whose; in order
};

class DrawnLabels {
public:
    // `parts`: the drawing shows convex parts in place of skins.
    DrawnLabels(World& world, Drawing& drawing, bool parts) : world_(world), drawing_(drawing), parts_(parts) {}

    // What the drawing shows as of its last update(). Throws host::DeviceError where the device draws no labels.
    std::unique_ptr<host::Labels> label(const host::Camera& camera, const host::LabelRequest& request);
    Channels channels(const host::Camera& camera, int width, int height, const ChannelChoice& choice, const Before& before);
    const RowNames& names();
    const World& world() const { return world_; }

private:
    World& world_;
    Drawing& drawing_;
    bool parts_;
    std::optional<RowNames> names_;
    std::uint64_t arrangements_ = 0;  // of names_
    bool skins_ = false;              // are shown
};

}  // namespace scree::demos
