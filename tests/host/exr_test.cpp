// EXR files: what is written is read back, and what they cannot hold is refused.
#include <tinyexr.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>

#include "host/canvas/colors.h"
#include "host/pictures/exr_file.h"
#include "host/pictures/frame_writer.h"
#include "tests/temporary_folder.h"

using namespace scree::host;

namespace {

// The channels of a file as floats, by name.
std::map<std::string, std::vector<float>> channels_of(const std::vector<std::uint8_t>& file) {
    EXRVersion version;
    REQUIRE(ParseEXRVersionFromMemory(&version, file.data(), file.size()) == TINYEXR_SUCCESS);
    EXRHeader header;
    InitEXRHeader(&header);
    const char* error = nullptr;
    REQUIRE(ParseEXRHeaderFromMemory(&header, &version, file.data(), file.size(), &error) == TINYEXR_SUCCESS);
    for (int k = 0; k < header.num_channels; ++k) {
        const bool light = std::string(header.channels[k].name).size() == 1 && header.channels[k].name[0] != 'Z';
        CHECK(header.pixel_types[k] == (light ? TINYEXR_PIXELTYPE_HALF : TINYEXR_PIXELTYPE_FLOAT));
        header.requested_pixel_types[k] = TINYEXR_PIXELTYPE_FLOAT;
    }
    EXRImage image;
    InitEXRImage(&image);
    REQUIRE(LoadEXRImageFromMemory(&image, &header, file.data(), file.size(), &error) == TINYEXR_SUCCESS);
    std::map<std::string, std::vector<float>> made;
    for (int k = 0; k < header.num_channels; ++k) {
        std::vector<float>& to = made[header.channels[k].name];
        to.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
        std::memcpy(to.data(), image.images[k], to.size() * sizeof(float));
    }
    FreeEXRImage(&image);
    FreeEXRHeader(&header);
    return made;
}

}  // namespace

TEST_CASE("an EXR file has the light of a picture, its alpha and its layers", "[image]") {
    Image image{3, 2, std::vector<std::uint8_t>(24)};
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = static_cast<std::uint8_t>(10 * i);
    const std::vector<ExrLayer> layers{{"Z", {1, 2, 3, 4, 5, INFINITY}}, {"ids.X", {-1, 0, 1, 70001, 2, 3}}};
    const auto read = channels_of(exr_bytes(image, true, layers));
    REQUIRE(read.size() == 6);
    CHECK(read.at("Z") == layers[0].values);
    CHECK(read.at("ids.X") == layers[1].values);
    const std::string letters = "RGBA";
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t i = 0; i < 6; ++i) {
            const float level = static_cast<float>(image.rgba[4 * i + k]) / 255.0f;
            const float light = k == 3 ? level : linear_from_srgb(level);
            CHECK(std::abs(read.at(letters.substr(k, 1))[i] - light) <= 0.0005f * light + 1e-7f);
        }
    CHECK(channels_of(exr_bytes(image, false)).size() == 3);
    CHECK_THROWS_AS(exr_bytes(image, false, std::vector<ExrLayer>{{"Z", {1}}}), ImageError);
    CHECK_THROWS_AS(exr_bytes(Image{3, 2, {}}, false), ImageError);
}

TEST_CASE("frames are written as EXR files if asked, and not beside others", "[image]") {
    const scree::tests::TemporaryFolder place;
    FrameWriterOptions options;
    options.folder = place / "f";
    options.exr = true;
    {
        FrameWriter writer(options);
        writer.add(Image{1, 1, {255, 255, 255, 255}}, {{"Z", {7}}});
        writer.finish();
    }
    const std::string file = place.read("f/frame_000000.exr");
    CHECK(channels_of({file.begin(), file.end()}).at("Z") == std::vector<float>{7});
    CHECK_THROWS_AS(FrameWriter(options), ImageError);
}
