// Images, PNG files, frames and videos on disk.
#include "host/pictures/image.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>

#include "host/files/file.h"
#include "host/files/partial_file.h"
#include "host/pictures/frame_writer.h"
#include "host/pictures/raw_frames.h"
#include "host/pictures/video.h"
#include "tests/temporary_folder.h"

using namespace scree::host;
using scree::tests::TemporaryFolder;

namespace {

Image pattern(int width, int height, int seed, bool opaque = true) {
    Image image{width, height, {}};
    for (int i = 0; i < width * height * 4; ++i) {
        const int level = i % 4 == 3 && opaque ? 255 : (i * (seed * 2 + 7)) % 251;
        image.rgba.push_back(static_cast<std::uint8_t>(level));
    }
    return image;
}

int files_in(const std::filesystem::path& folder) {
    int count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
    return count;
}

std::string output_of(const std::string& command) {
    std::string text;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
    for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) text += static_cast<char>(c);
    return text;
}

// Replaces PATH for the object's lifetime.
class OtherPath {
public:
    explicit OtherPath(const std::string& path) : before_(std::getenv("PATH")) { ::setenv("PATH", path.c_str(), 1); }
    ~OtherPath() { ::setenv("PATH", before_.c_str(), 1); }
    OtherPath(const OtherPath&) = delete;
    OtherPath& operator=(const OtherPath&) = delete;

private:
    std::string before_;
};

}  // namespace

TEST_CASE("a PNG gives back the pixels it was made from", "[image]") {
    const bool opaque = GENERATE(true, false);
    const TemporaryFolder folder;
    const Image image = pattern(37, 23, 1, opaque);
    write_png(folder.path() / "a.png", image);
    const Image read = read_png(folder.path() / "a.png");
    CHECK(read.width == 37);
    CHECK(read.height == 23);
    CHECK(read.rgba == image.rgba);
    CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("a PNG of 16 bits gives back all of them", "[image]") {
    const TemporaryFolder folder;
    Image image = pattern(74, 23, 1, GENERATE(true, false));  // two bytes per channel if 16 bits
    image.width = 37;
    image.bits = 16;
    write_png(folder.path() / "a.png", image);
    const Image read = read_png(folder.path() / "a.png");
    CHECK(read.width == 37);
    CHECK(read.bits == 16);
    CHECK(read.rgba == image.rgba);
}

TEST_CASE("half floats of linear light become sRGB of 16 bits", "[image]") {
    // 0, 1, 1/2, 2^-14, -1, infinity, 2; alpha becomes opaque.
    const std::vector<std::uint16_t> halves{0x0000, 0x3C00, 0x3800, 0, 0x0400, 0xBC00, 0x7C00, 0x4000};
    const Image image = image_of_halves(2, 1, halves);
    const auto level = [&](std::size_t i) {
        std::uint16_t value = 0;
        std::memcpy(&value, &image.rgba[2 * i], 2);
        return value;
    };
    CHECK(level(0) == 0);
    CHECK(level(1) == 65535);
    CHECK(level(2) == std::lround(65535 * (1.055 * std::pow(0.5, 1 / 2.4) - 0.055)));
    CHECK(level(3) == 65535);
    CHECK(level(4) == std::lround(65535 * 12.92 / 16384));
    CHECK(level(5) == 0);
    CHECK(level(6) == 65535);
    CHECK(rgb_bytes(image).size() == 12);
    CHECK_THROWS_WITH(image_of_halves(3, 1, halves), Catch::Contains("3 x 1"));
}

TEST_CASE("raw frames are the pixels and nothing else", "[image]") {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "frames.rgb";
    FrameWriter writer({.folder = {}, .raw = path, .width = 5, .height = 4});
    for (int i = 0; i < 3; ++i) writer.add(pattern(5, 4, i));
    CHECK_FALSE(std::filesystem::exists(path));
    writer.finish();
    CHECK(files_in(folder.path()) == 1);
    const std::string bytes = read_text(path);
    REQUIRE(bytes.size() == 3 * 5 * 4 * 3);
    for (int i = 0; i < 3; ++i) {
        const std::vector<std::uint8_t> expected = rgb_bytes(pattern(5, 4, i));
        CHECK(bytes.substr(static_cast<std::size_t>(i) * 60, 60) == std::string(expected.begin(), expected.end()));
    }
}

TEST_CASE("raw frames that nobody finished, or that nobody reads, leave no file", "[image]") {
    const TemporaryFolder folder;
    {
        RawFrames raw(folder.path() / "frames.rgb");
        raw.add(pattern(4, 4, 1));
        CHECK(files_in(folder.path()) == 1);
    }
    CHECK(files_in(folder.path()) == 0);
    CHECK_THROWS_WITH(RawFrames(folder.path()), Catch::Contains("is a folder"));
    CHECK_THROWS_WITH(RawFrames("/proc/none/frames.rgb"), Catch::Contains("/proc/none"));
    CHECK_THROWS_WITH(RawFrames("/dev/full").add(pattern(4, 4, 1)), Catch::Contains("No space left"));
}

TEST_CASE("what is unfinished can be removed at once", "[image]") {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "half") << "half";
    std::ofstream(folder.path() / "whole") << "whole";
    const Unfinished half(folder.path() / "half");
    { const Unfinished whole(folder.path() / "whole"); }
    remove_unfinished();
    CHECK_FALSE(std::filesystem::exists(folder.path() / "half"));
    CHECK(std::filesystem::exists(folder.path() / "whole"));
}

TEST_CASE("a preview is a small animated picture, of a kind that its name says", "[image]") {
    if (std::system("command -v ffprobe ffmpeg > /dev/null") != 0) {
        WARN("ffmpeg is not installed: skipped");
        return;
    }
    const TemporaryFolder folder;
    const std::string name = GENERATE("clip.gif", "clip.webp");
    const std::filesystem::path path = folder.path() / name;
    FrameWriter writer({.folder = {}, .preview = path, .frames_per_second = 30, .width = 640, .height = 96});
    for (int i = 0; i < 20; ++i) writer.add(pattern(640, 96, i));
    writer.finish();
    CHECK(files_in(folder.path()) == 1);
    if (name == "clip.gif") {
        const std::string seen = output_of(
            "ffprobe -v error -count_frames -show_entries stream=nb_read_frames,width,height -of default=noprint_wrappers=1 " +
            path.string());
        CHECK_THAT(seen, Catch::Contains("width=480") && Catch::Contains("height=72") && Catch::Contains("nb_read_frames=10"));
    } else {
        const std::string bytes = read_text(path);  // RIFF....WEBPVP8X, then a chunk per frame
        CHECK(bytes.substr(8, 4) == "WEBP");
        CHECK(bytes.find("ANIM") != std::string::npos);
        CHECK(bytes.find("ANMF") != bytes.rfind("ANMF"));
    }
    CHECK_THROWS_WITH(FrameWriter({.folder = {}, .preview = folder.path() / "clip.png"}),
                      Catch::Contains(".gif") && Catch::Contains(".webp"));
}

TEST_CASE("pictures that cannot be read or written say which file and why", "[image]") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(write_png(folder.path() / "none" / "a.png", pattern(4, 4, 1)), Catch::Contains("none/a.png"));
    CHECK_THROWS_WITH(read_png(folder.path() / "none.png"), Catch::Contains("none.png") && Catch::Contains("No such file"));
    std::ofstream(folder.path() / "text.png") << "this is no picture";
    CHECK_THROWS_WITH(read_png(folder.path() / "text.png"), Catch::Contains("not a readable PNG"));
    CHECK_THROWS_AS(png_bytes(Image{4, 4, {}}), ImageError);
}

TEST_CASE("frames are written in order under their numbers", "[image]") {
    const TemporaryFolder folder;
    FrameWriter writer({.folder = folder.path() / "made" / "here", .width = 16, .height = 16, .threads = 3, .waiting = 2});
    for (int i = 0; i < 20; ++i) writer.add(pattern(16, 16, i));
    writer.finish();
    CHECK(writer.frames() == 20);
    CHECK_THROWS_AS(writer.add(pattern(16, 16, 0)), ImageError);
    CHECK(files_in(folder.path() / "made" / "here") == 20);
    for (int i = 0; i < 20; ++i) {
        char name[32];
        std::snprintf(name, sizeof name, "frame_%06d.png", i);
        CHECK(read_png(folder.path() / "made" / "here" / name).rgba == pattern(16, 16, i).rgba);
    }
}

TEST_CASE("a folder for frames that cannot be used is refused at once", "[image]") {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "file") << "in the way";
    CHECK_THROWS_WITH(FrameWriter({.folder = folder.path() / "file"}), Catch::Contains("file"));
    CHECK_THROWS_WITH(FrameWriter({.folder = folder.path() / "file" / "below"}), Catch::Contains("below"));
    CHECK_THROWS_WITH(FrameWriter({.folder = "/proc/frames"}), Catch::Contains("/proc/frames"));
}

TEST_CASE("an error of an encoder reaches the one who adds or finishes", "[image]") {
    const TemporaryFolder folder;
    FrameWriter writer({.folder = folder.path() / "gone", .width = 8, .height = 8});
    std::filesystem::remove_all(folder.path() / "gone");
    const auto work = [&] {
        for (int i = 0; i < 50; ++i) writer.add(pattern(8, 8, i));
        writer.finish();
    };
    CHECK_THROWS_WITH(work(), Catch::Contains("frame_0000"));
}

TEST_CASE("a video has as many frames as were added", "[image]") {
    if (std::system("command -v ffprobe ffmpeg > /dev/null") != 0) {
        WARN("ffmpeg is not installed: skipped");
        return;
    }
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "clip.mp4";
    {
        FrameWriter writer({.folder = {}, .video = path, .frames_per_second = 25, .width = 65, .height = 48});
        for (int i = 0; i < 30; ++i) writer.add(pattern(65, 48, i));
        CHECK_FALSE(std::filesystem::exists(path));
        writer.finish();
    }
    CHECK(files_in(folder.path()) == 1);
    const std::string seen = output_of(
        "ffprobe -v error -count_frames -select_streams v -show_entries stream=nb_read_frames,width,height,"
        "r_frame_rate,pix_fmt -of default=noprint_wrappers=1 " +
        path.string());
    CHECK_THAT(seen, Catch::Contains("nb_read_frames=30"));
    CHECK_THAT(seen, Catch::Contains("width=64") && Catch::Contains("height=48"));
    CHECK_THAT(seen, Catch::Contains("r_frame_rate=25/1") && Catch::Contains("pix_fmt=yuv420p"));
}

TEST_CASE("without ffmpeg a video is refused at once and told how to get it", "[image]") {
    const TemporaryFolder folder;
    const OtherPath empty(folder.path().string());
    CHECK_THROWS_WITH(FrameWriter({.folder = {}, .video = folder.path() / "clip.mp4"}),
                      Catch::Contains("ffmpeg not found") && Catch::Contains("apt-get install ffmpeg"));
    CHECK(files_in(folder.path()) == 0);
}

TEST_CASE("what ffmpeg says reaches the message when it fails", "[image]") {
    const TemporaryFolder folder;
    {
        std::ofstream script(folder.path() / "ffmpeg");
        script << "#!/bin/sh\necho 'the disk is on fire' >&2\nexit 3\n";
    }
    std::filesystem::permissions(folder.path() / "ffmpeg", std::filesystem::perms::owner_all);
    const OtherPath path(folder.path().string());
    const auto work = [&] {
        Video video(folder.path() / "clip.mp4", {.width = 64, .height = 64});
        for (int i = 0; i < 100; ++i) video.add(pattern(64, 64, i));
        video.finish();
    };
    CHECK_THROWS_WITH(work(), Catch::Contains("clip.mp4") && Catch::Contains("the disk is on fire"));
    CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("an unfinished video leaves no file", "[image]") {
    if (std::system("command -v ffmpeg > /dev/null") != 0) {
        WARN("ffmpeg is not installed: skipped");
        return;
    }
    const TemporaryFolder folder;
    {
        Video video(folder.path() / "clip.mp4", {.width = 64, .height = 64});
        video.add(pattern(64, 64, 1));
        CHECK_THROWS_WITH(video.add(pattern(32, 64, 1)), Catch::Contains("32 x 64"));
        Image deep = pattern(128, 64, 1);
        deep.width = 64;
        deep.bits = 16;
        CHECK_THROWS_WITH(video.add(deep), Catch::Contains("16 bits"));
    }
    CHECK(files_in(folder.path()) == 0);
    CHECK_THROWS_AS(Video("/proc/none/clip.mp4", {.width = 64, .height = 64}), ImageError);
    CHECK_THROWS_AS(Video(folder.path(), {.width = 64, .height = 64}), ImageError);
}
