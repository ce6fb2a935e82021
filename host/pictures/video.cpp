// A video file or an animated picture, encoded by ffmpeg from frames sent through a pipe.
#include "host/pictures/video.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "host/files/partial_file.h"
#include "host/system/files.h"
#include "host/system/libraries.h"
#include "host/system/processes.h"

namespace scree::host {
namespace {

std::filesystem::path find_ffmpeg() {
    if (const auto found = find_program("ffmpeg")) return *found;
    throw ImageError(std::string("ffmpeg not found: ") + ffmpeg_cure + ", or leave out --video and --preview");
}

// Resolves symbolic links, so that the target is replaced and not the link. Throws ImageError unless the target is a
// regular file or does not exist.
std::filesystem::path target_of(const std::filesystem::path& path, const char* such_as) {
    namespace fs = std::filesystem;
    const auto refuse = [&](const char* why) {
        throw ImageError(path.string() + ": " + why + "; name a file such as " + such_as);
    };
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status)) refuse("is a folder");
    if (fs::is_regular_file(status)) return fs::canonical(path);
    if (fs::exists(status)) refuse("is not a regular file, and only such can be replaced by a whole video");
    fs::path target = path;
    for (int links = 0; fs::is_symlink(target, ignored); ++links) {  // dangling links
        if (links == 40) refuse("is a symbolic link that leads back to itself");
        target = target.parent_path() / fs::read_symlink(target);
    }
    return target;
}

using Words = std::vector<std::string>;

std::string decimal(double number) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << number;
    return text.str();
}

// ffmpeg's output options.
Words output_of(const VideoShape& shape) {
    const std::string smaller = "fps=" + decimal(std::min(shape.frames_per_second, 15.0)) +
                                ",scale=" + std::to_string(std::min(shape.width, 480)) + ":-1:flags=lanczos";
    if (shape.clip == Clip::webp) return {"-vf", smaller, "-c:v", "libwebp_anim", "-quality", "75", "-loop", "0", "-f", "webp"};
    if (shape.clip == Clip::gif) {
        // The palette is computed from the first 8 s, because ffmpeg keeps the frames in memory until it is known. A
        // palette per frame would make the file eight times as large.
        const std::string colored =
            ",split[a][b];[a]trim=end=8,palettegen[p];[b][p]paletteuse=dither=bayer:bayer_scale=4:diff_mode=rectangle";
        return {"-filter_complex", smaller + colored, "-loop", "0", "-f", "gif"};
    }
    return {"-vf",
            // By default ffmpeg converts by BT.601 without tags, which players of HD video take for BT.709.
            "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", "-colorspace", "bt709",
            "-color_primaries", "bt709", "-color_trc", "bt709", "-c:v", "libx264", "-preset", "fast", "-crf", "18", "-pix_fmt",
            "yuv420p", "-movflags", "+faststart", "-f", "mp4"};
}

// ffmpeg's command line: raw frames from standard input to the file.
Words command_of(const std::string& program, const VideoShape& shape, const std::string& file) {
    const char* sixteen = std::endian::native == std::endian::little ? "rgba64le" : "rgba64be";
    Words words{program,
                "-hide_banner",
                "-loglevel",
                "error",
                "-nostdin",
                "-y",
                "-f",
                "rawvideo",
                "-pixel_format",
                shape.bits == 16 ? sixteen : "rgba",
                "-video_size",
                std::to_string(shape.width) + "x" + std::to_string(shape.height),
                "-framerate",
                decimal(shape.frames_per_second),
                "-i",
                "pipe:0"};
    const Words output = output_of(shape);
    words.insert(words.end(), output.begin(), output.end());
    // A name alone could be an option or an address ("-x.mp4", "tcp://...").
    words.push_back("file:" + std::filesystem::absolute(file).string());
    return words;
}

const char* example_of(Clip clip) {
    return clip == Clip::film ? "scree.mp4" : clip == Clip::gif ? "scree.gif" : "scree.webp";
}

}  // namespace

struct Video::Impl {
    std::filesystem::path path, target, partial;
    VideoShape shape;
    std::optional<Unfinished> unfinished;
    ProcessId process = -1;
    int pipe = -1;    // to ffmpeg's input
    int errors = -1;  // ffmpeg's standard error, an unnamed file
    int claim = -1;   // holds the lock of the partial file, which ffmpeg opens itself

    void start(const std::filesystem::path& program);
    ChildEnd wait();
    [[noreturn]] void fail();
    void discard();
    void release() {
        if (claim >= 0) close_file(claim);
        claim = -1;
    }
};

void Video::Impl::start(const std::filesystem::path& program) {
    int ends[2];
    if (!make_pipe(ends)) throw ImageError(std::string("ffmpeg: no pipe: ") + std::strerror(errno));
    pipe = ends[1];
    errors = create_in_memory();
    process = start_child(program, command_of(program.string(), shape, child_output(partial)), {ends[0], errors, partial});
    const int error = errno;
    close_file(ends[0]);
    if (process < 0) {
        discard();
        throw ImageError(program.string() + ": cannot be started: " + std::strerror(error));
    }
    unfinished.emplace(partial, process);
}

ChildEnd Video::Impl::wait() {
    if (pipe >= 0) close_file(pipe);
    pipe = -1;
    ChildEnd end;
    if (process > 0) end = wait_for_child(process);
    process = -1;
    if (unfinished) unfinished.emplace(partial);  // registered without a writer: ffmpeg has exited
    return end;
}

void Video::Impl::fail() {
    wait();
    std::string said(4096, '\0');
    const std::ptrdiff_t n = errors >= 0 && go_to_begin(errors) ? read_some(errors, said.data(), said.size()) : 0;
    said.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    while (!said.empty() && said.back() == '\n') said.pop_back();
    discard();
    throw ImageError(path.string() + ": ffmpeg failed: " + (said.empty() ? "it exited early without a message" : said));
}

void Video::Impl::discard() {
    if (process > 0) end_process(process);
    wait();
    if (errors >= 0) close_file(errors);
    errors = -1;
    std::error_code ignored;
    if (claim >= 0) std::filesystem::remove(partial, ignored);
    release();
    unfinished.reset();
}

Video::Video(const std::filesystem::path& path, const VideoShape& shape) : interior_(std::make_unique<Impl>()) {
    if (shape.width < 2 || shape.height < 2 || !(shape.frames_per_second > 0)) {
        throw ImageError(path.string() + ": a video needs at least 2 x 2 pixels and a positive frame rate");
    }
    const std::filesystem::path target = target_of(path, example_of(shape.clip));
    const std::filesystem::path program = find_ffmpeg();
    require_writable_folder(target.parent_path());
    interior_->path = path;
    interior_->target = target;
    interior_->partial = partial_name(target);
    interior_->shape = shape;
    interior_->claim = create_held(interior_->partial);
    if (interior_->claim < 0) throw ImageError(path.string() + ": cannot be written: " + std::strerror(errno));
    interior_->start(program);
}

Video::~Video() {
    interior_->discard();
}

void Video::add(const Image& image) {
    if (interior_->pipe < 0) throw ImageError(interior_->path.string() + ": the video is closed");
    const VideoShape& shape = interior_->shape;
    if (image.width != shape.width || image.height != shape.height || image.bits != shape.bits) {
        const auto words = [](int width, int height, int bits) {
            return std::to_string(width) + " x " + std::to_string(height) + " pixels of " + std::to_string(bits) + " bits";
        };
        throw ImageError(interior_->path.string() + ": a frame has " + words(image.width, image.height, image.bits) +
                         ", the video " + words(shape.width, shape.height, shape.bits));
    }
    if (write_all(interior_->pipe, image.rgba.data(), image.rgba.size()) != 0) interior_->fail();
}

void Video::finish() {
    if (interior_->process < 0) return;
    const ChildEnd end = interior_->wait();
    if (end.by_signal || end.status != 0) interior_->fail();
    std::error_code error;
    std::filesystem::rename(interior_->partial, interior_->target, error);
    if (error) throw ImageError(interior_->path.string() + ": cannot be written: " + error.message());
    interior_->release();
    interior_->unfinished.reset();
}

}  // namespace scree::host
