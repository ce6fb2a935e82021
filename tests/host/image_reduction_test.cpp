// Reduction of images in linear light.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>

#include "host/canvas/colors.h"
#include "host/pictures/image.h"

using namespace scree::host;

TEST_CASE("a reduced image has the mean light of its blocks", "[image]") {
    Image image{4, 2, std::vector<std::uint8_t>(4 * 2 * 4, 255), 8};
    for (int k = 0; k < 3; ++k)
        image.rgba[static_cast<std::size_t>(k)] = image.rgba[20 + static_cast<std::size_t>(k)] = 0;  // a checkered block
    const Image half = reduced(image, 2);
    REQUIRE(half.width == 2);
    REQUIRE(half.height == 1);
    const int mean = half.rgba[0];  // half the light, not level 128
    CHECK(std::abs(mean - 188) <= 1);
    CHECK(half.rgba[4] == 255);
    CHECK(srgb_byte(0.5f) == 188);
    CHECK(reduced(image, 1).rgba == image.rgba);
    CHECK_THROWS_AS(reduced(image, 3), ImageError);
}

TEST_CASE("the mean of images is that of their light", "[image]") {
    for (const int bits : {8, 16}) {
        const std::size_t bytes = bits / 8;
        const Image white{1, 1, std::vector<std::uint8_t>(4 * bytes, 255), bits};
        Image black = white;  // opaque
        std::fill_n(black.rgba.begin(), static_cast<std::ptrdiff_t>(3 * bytes), std::uint8_t{0});
        MeanImage mean;
        mean.add(black);
        mean.add(white);
        const Image half = mean.image();
        REQUIRE(half.bits == bits);
        REQUIRE(half.rgba.size() == 4 * bytes);
        CHECK(std::abs(int{half.rgba[bytes - 1]} - 188) <= 1);  // the higher byte
        CHECK(half.rgba.back() == 255);
        CHECK_THROWS_AS(mean.add(Image{2, 1, std::vector<std::uint8_t>(8 * bytes, 0), bits}), ImageError);
        MeanImage same;
        for (int i = 0; i < 3; ++i) same.add(half);
        CHECK(same.image().rgba == half.rgba);
    }
}

TEST_CASE("a level stays itself when reduced", "[image]") {
    for (int level = 0; level < 256; ++level) {
        Image image{2, 2, std::vector<std::uint8_t>(16, static_cast<std::uint8_t>(level)), 8};
        CHECK(int{reduced(image, 2).rgba[0]} == level);
    }
    const std::uint16_t level = 12345;
    Image fine{2, 2, std::vector<std::uint8_t>(32, 255), 16};
    for (std::size_t i = 0; i < 16; ++i) std::memcpy(&fine.rgba[2 * i], &level, 2);
    std::uint16_t mean = 0;
    std::memcpy(&mean, reduced(fine, 2).rgba.data(), 2);
    CHECK(std::abs(int{mean} - int{level}) <= 1);
}

TEST_CASE("a mean of clear and opaque pixels is as opaque as there are opaque ones, and its straight colour is theirs",
          "[image]") {
    Image image{2, 2, std::vector<std::uint8_t>(16)};
    for (const std::size_t k : {0, 1, 2, 3}) image.rgba[k] = k == 3 ? 255 : 200;
    const Image mean = reduced(image, 2);
    CHECK(int{mean.rgba[3]} == 64);
    const Image made = straight(mean);
    CHECK(std::abs(int{made.rgba[0]} - 200) <= 1);
    CHECK(made.rgba[3] == mean.rgba[3]);
    MeanImage sum;
    sum.add(image);
    sum.add(Image{2, 2, std::vector<std::uint8_t>(16)});
    CHECK(int{sum.image().rgba[3]} == 128);
    CHECK(std::abs(int{straight(sum.image()).rgba[1]} - 200) <= 1);
}
