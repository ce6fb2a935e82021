// Pictures of a world on several ranks, each of which draws its own bodies.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compute/distributed/exchange.h"
#include "compute/world.h"
#include "host/canvas/canvas.h"

namespace scree::demos {

// Joins the parts of pictures by messages between ranks. Each rank joins a range of the pixels.
class RankParts final : public host::PictureParts {
public:
    explicit RankParts(Exchange& exchange) : exchange_(exchange) {}
    bool is_first() const override { return exchange_.rank() == 0; }
    void unite(std::span<float> depths) override;
    void compose(std::span<std::uint32_t> colors, std::span<const float> depths) override;

private:
    Exchange& exchange_;
};

// Collective: whether it holds on all ranks.
bool all_ranks(Exchange& exchange, bool own);

// The part of a rank: a canvas of OpenGL ES, which takes the rank's bodies for each picture.
class PartDrawing {
public:
    // Collective. On all ranks alike, none where one of them has no such canvas or `options` are beyond it.
    static std::unique_ptr<PartDrawing> make(World& world, const host::CanvasOptions& options);

    std::string canvas() const { return canvas_->name(); }

    // All these are collective, of a world that is shared out.
    struct Moment {
        vec3 followed{0};            // position of the body that was asked for
        std::uint32_t contacts = 0;  // of all ranks
    };
    Moment look(std::optional<std::size_t> followed) const;
    // The whole picture on the first rank, an empty image on the others.
    host::Image draw(const host::Camera& camera, const host::ColorScale& scale, const std::string& caption, vec3 low, vec3 high);

private:
    PartDrawing(World& world, std::unique_ptr<host::Canvas> canvas);
    World& world_;
    RankParts parts_;
    std::unique_ptr<host::Canvas> canvas_;
};

}  // namespace scree::demos
