// A video file, encoded by ffmpeg from frames sent through a pipe.
#include "host/video.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <sstream>
#include <string>
#include <vector>

extern char** environ;

namespace scree::host {
namespace {

std::string find_ffmpeg() {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::string candidate = (folder.empty() ? "." : folder) + "/ffmpeg";
        if (::access(candidate.c_str(), X_OK) == 0) return candidate;
    }
    throw ImageError("ffmpeg not found: apt-get install ffmpeg, or leave out --video");
}

// The file that links lead to, so that it is replaced and not the link. Throws ImageError unless that is a file or nothing yet.
std::filesystem::path target_of(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    const auto refuse = [&](const char* why) {
        throw ImageError(path.string() + ": " + why + "; name a file such as scree.mp4");
    };
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status)) refuse("is a folder");
    if (fs::is_regular_file(status)) return fs::canonical(path);
    if (fs::exists(status)) refuse("is not a regular file, and only such can be replaced by a whole video");
    fs::path target = path;
    for (int links = 0; fs::is_symlink(target, ignored); ++links) {  // to what is not there yet
        if (links == 40) refuse("is a link that leads in a circle");
        target = target.parent_path() / fs::read_symlink(target);
    }
    return target;
}

// Writing to a program that has ended raises SIGPIPE; this turns it into an error of write() for this thread alone.
class PipeSignalHeld {
public:
    PipeSignalHeld() {
        sigemptyset(&pipe_);
        sigaddset(&pipe_, SIGPIPE);
        sigset_t pending;
        sigpending(&pending);
        was_pending_ = sigismember(&pending, SIGPIPE) == 1;
        pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    ~PipeSignalHeld() {
        const timespec now{};
        if (!was_pending_) sigtimedwait(&pipe_, nullptr, &now);
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    PipeSignalHeld(const PipeSignalHeld&) = delete;
    PipeSignalHeld& operator=(const PipeSignalHeld&) = delete;

private:
    sigset_t pipe_{};
    sigset_t before_{};
    bool was_pending_ = false;
};

}  // namespace

struct Video::Interior {
    std::filesystem::path path, target, partial;
    int width = 0, height = 0;
    pid_t process = -1;
    int pipe = -1;    // to ffmpeg's input
    int errors = -1;  // what ffmpeg says, an unnamed file

    void start(const std::string& program, double frames_per_second);
    int wait();
    [[noreturn]] void fail();
    void discard();
};

void Video::Interior::start(const std::string& program, double frames_per_second) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw ImageError(std::string("ffmpeg: no pipe: ") + std::strerror(errno));
    pipe = ends[1];
    errors = ::memfd_create("ffmpeg", MFD_CLOEXEC);
    std::ostringstream rate;
    rate.imbue(std::locale::classic());
    rate << frames_per_second;
    std::vector<std::string> words{
        program, "-hide_banner", "-loglevel", "error", "-nostdin", "-y", "-f", "rawvideo", "-pixel_format", "rgba", "-video_size",
        std::to_string(width) + "x" + std::to_string(height), "-framerate", rate.str(), "-i", "pipe:0", "-vf",
        // The default would tag nothing and convert by BT.601, which players of HD video misread.
        "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", "-colorspace", "bt709", "-color_primaries",
        "bt709", "-color_trc", "bt709", "-c:v", "libx264", "-preset", "fast", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags",
        "+faststart", "-f", "mp4", partial.string()};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    if (errors >= 0) posix_spawn_file_actions_adddup2(&actions, errors, 2);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    // Its own group: Ctrl-C is for the simulation, which then finishes or discards the video itself.
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    const int error = posix_spawn(&process, program.c_str(), &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[0]);
    if (error != 0) {
        process = -1;
        discard();
        throw ImageError(program + ": cannot be started: " + std::strerror(error));
    }
}

int Video::Interior::wait() {
    if (pipe >= 0) ::close(pipe);
    pipe = -1;
    int status = 0;
    if (process > 0) {
        while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
        }
    }
    process = -1;
    return status;
}

void Video::Interior::fail() {
    wait();
    std::string said(4096, '\0');
    const ssize_t n = errors >= 0 ? ::pread(errors, said.data(), said.size(), 0) : 0;
    said.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    while (!said.empty() && said.back() == '\n') said.pop_back();
    discard();
    throw ImageError(path.string() + ": ffmpeg failed: " + (said.empty() ? "it ended early and said nothing" : said));
}

void Video::Interior::discard() {
    if (process > 0) ::kill(process, SIGKILL);
    wait();
    if (errors >= 0) ::close(errors);
    errors = -1;
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
}

Video::Video(const std::filesystem::path& path, int width, int height, double frames_per_second)
    : interior_(std::make_unique<Interior>()) {
    if (width < 2 || height < 2 || !(frames_per_second > 0)) {
        throw ImageError(path.string() + ": a video needs at least 2 x 2 pixels and a positive frame rate");
    }
    const std::filesystem::path target = target_of(path);
    const std::string program = find_ffmpeg();
    require_writable_folder(target.parent_path());
    interior_->path = path;
    interior_->target = target;
    interior_->partial = target.string() + ".part" + std::to_string(::getpid());
    interior_->width = width;
    interior_->height = height;
    interior_->start(program, frames_per_second);
}

Video::~Video() {
    interior_->discard();
}

void Video::add(const Image& image) {
    if (interior_->pipe < 0) throw ImageError(interior_->path.string() + ": the video is closed");
    if (image.width != interior_->width || image.height != interior_->height) {
        throw ImageError(interior_->path.string() + ": a frame is " + std::to_string(image.width) + " x " +
                         std::to_string(image.height) + " pixels, the video " + std::to_string(interior_->width) + " x " +
                         std::to_string(interior_->height));
    }
    const PipeSignalHeld held;
    const std::uint8_t* from = image.rgba.data();
    std::size_t left = image.rgba.size();
    while (left > 0) {
        const ssize_t written = ::write(interior_->pipe, from, left);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) interior_->fail();
        from += written;
        left -= static_cast<std::size_t>(written);
    }
}

void Video::finish() {
    if (interior_->process < 0) return;
    const int status = interior_->wait();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) interior_->fail();
    std::error_code error;
    std::filesystem::rename(interior_->partial, interior_->target, error);
    if (error) throw ImageError(interior_->path.string() + ": cannot be written: " + error.message());
}

}  // namespace scree::host
