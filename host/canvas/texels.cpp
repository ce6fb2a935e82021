// Images of surfaces as a table of texels, with coarser levels.
#include "host/canvas/texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "host/canvas/srgb_levels.h"

namespace scree::host {

namespace {

// Square roots of linear light, in ten bits each, red lowest.
constexpr std::uint32_t most_root = 1023;
std::uint32_t root_of(float light) {
    return static_cast<std::uint32_t>(most_root * std::sqrt(light) + 0.5f);
}

struct Level {
    int width = 1, height = 1;  // pixels
    std::vector<std::uint32_t> texels;
};

Level finest_level(const SurfaceImage& image) {
    std::vector<std::uint8_t> bytes;
    try {
        bytes = decoded(image);
    } catch (const FileError&) {
        return {1, 1, {~0u >> 2}};  // white: it was sound when it was read
    }
    std::array<std::uint32_t, 256> roots{};
    for (std::size_t i = 0; i < roots.size(); ++i) roots[i] = root_of(light_of_levels()[i]);
    Level level{image.width, image.height, {}};
    level.texels.reserve(bytes.size() / 4);
    for (std::size_t i = 0; i + 3 < bytes.size(); i += 4)
        level.texels.push_back(roots[bytes[i]] | roots[bytes[i + 1]] << 10 | roots[bytes[i + 2]] << 20);
    return level;
}

// Of half the size: means of the light of two by two texels; of an odd row or column the last one is left out.
Level halved(const Level& fine) {
    Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
    const auto at = [&](int x, int y) {
        return fine.texels[static_cast<std::size_t>(std::min(y, fine.height - 1)) * static_cast<std::size_t>(fine.width) +
                           static_cast<std::size_t>(std::min(x, fine.width - 1))];
    };
    for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x) {
            std::uint32_t texel = 0;
            for (int channel = 0; channel < 30; channel += 10) {
                float sum = 0;
                for (const std::uint32_t one :
                     {at(2 * x, 2 * y), at(2 * x + 1, 2 * y), at(2 * x, 2 * y + 1), at(2 * x + 1, 2 * y + 1)}) {
                    const float root = static_cast<float>(one >> channel & most_root) / most_root;
                    sum += root * root;
                }
                texel |= root_of(std::min(0.25f * sum, 1.0f)) << channel;
            }
            coarse.texels.push_back(texel);
        }
    return coarse;
}

// The last table, since a canvas is made anew whenever bodies come.
struct LastTable {
    std::mutex lock;
    std::vector<CanvasTexture> textures;
    std::size_t most = 0;
    std::vector<std::uint32_t> table;
};
LastTable& last_table() {
    static LastTable last;
    return last;
}

std::size_t texels_at(const SurfaceImage& image, int lost) {
    return static_cast<std::size_t>(std::max(1, image.width >> lost)) *
           static_cast<std::size_t>(std::max(1, image.height >> lost));
}

}  // namespace

std::vector<std::uint32_t> texels_of(const std::vector<CanvasTexture>& textures, std::size_t most) {
    if (textures.empty()) return {};
    LastTable& last = last_table();
    const std::lock_guard held(last.lock);
    if (last.textures == textures && last.most == most) return last.table;
    std::vector<const SurfaceImage*> images;
    for (const CanvasTexture& one : textures)
        if (std::find(images.begin(), images.end(), one.image.get()) == images.end()) images.push_back(one.image.get());
    std::vector<int> lost(images.size(), 0);  // levels
    std::size_t all = textures.size() * texture_words;
    const auto share = [&](std::size_t i) { return texels_at(*images[i], lost[i]) * 4 / 3 + 32; };
    for (std::size_t i = 0; i < images.size(); ++i) all += share(i);
    while (all > most) {
        std::size_t largest = 0;
        for (std::size_t i = 1; i < images.size(); ++i)
            if (texels_at(*images[i], lost[i]) > texels_at(*images[largest], lost[largest])) largest = i;
        if (images.empty() || texels_at(*images[largest], lost[largest]) == 1) break;
        all -= share(largest);
        ++lost[largest];
        all += share(largest);
    }
    std::vector<std::uint32_t> table(textures.size() * texture_words);
    for (std::size_t i = 0; i < images.size(); ++i) {
        Level level = finest_level(*images[i]);
        for (int k = 0; k < lost[i]; ++k) level = halved(level);
        std::vector<std::uint32_t> head{static_cast<std::uint32_t>(level.width), static_cast<std::uint32_t>(level.height), 0, 0};
        for (;;) {
            head.push_back(static_cast<std::uint32_t>(table.size()));
            table.insert(table.end(), level.texels.begin(), level.texels.end());
            if (level.texels.size() == 1) break;
            level = halved(level);
        }
        head[2] = static_cast<std::uint32_t>(head.size() - 4);
        for (std::size_t t = 0; t < textures.size(); ++t) {
            if (textures[t].image.get() != images[i]) continue;
            head[3] = static_cast<std::uint32_t>(textures[t].across) + 4 * static_cast<std::uint32_t>(textures[t].down);
            std::copy(head.begin(), head.end(), table.begin() + static_cast<std::ptrdiff_t>(t * texture_words));
        }
    }
    last.textures = textures;
    last.most = most;
    last.table = table;
    return table;
}

}  // namespace scree::host
