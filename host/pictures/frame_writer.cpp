// Frame output as PNG files, video, preview and raw pixels, encoded on threads of its own.
#include "host/pictures/frame_writer.h"

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <regex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "host/pictures/raw_frames.h"
#include "host/pictures/video.h"
#include "host/system/files.h"

namespace scree::host {
namespace {

struct Job {
    int number = 0;
    std::shared_ptr<const Image> image;
    std::shared_ptr<const std::vector<ExrLayer>> layers;
};

// A bounded queue of frames with its worker threads.
class Line {
public:
    Line(std::size_t longest, int threads, std::function<void(const Job&)> work) : longest_(longest), work_(std::move(work)) {
        try {
            for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { run(); });
        } catch (const std::system_error& error) {
            close();  // release the threads that have started and wait for frames
            throw ImageError(std::string("frames: no thread to encode them: ") + error.what());
        }
    }
    ~Line() { close(); }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;

    void add(Job job) {
        std::unique_lock lock(mutex_);
        room_.wait(lock, [&] { return jobs_.size() < longest_ || error_; });
        if (error_) std::rethrow_exception(error_);
        if (closed_) throw ImageError("frames: the writer is finished, no more can be added");
        jobs_.push_back(std::move(job));
        arrived_.notify_one();
    }
    void close() {
        {
            const std::lock_guard lock(mutex_);
            closed_ = true;
        }
        arrived_.notify_all();
        threads_.clear();  // joins the threads
    }
    void rethrow() {
        const std::lock_guard lock(mutex_);
        if (error_) std::rethrow_exception(error_);
    }

private:
    void run() {
        for (;;) {
            Job job;
            {
                std::unique_lock lock(mutex_);
                arrived_.wait(lock, [&] { return !jobs_.empty() || closed_; });
                if (jobs_.empty()) return;
                job = std::move(jobs_.front());
                jobs_.pop_front();
                if (error_) continue;  // after an error, drain the queue without encoding
            }
            room_.notify_one();
            try {
                work_(job);
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (!error_) error_ = std::current_exception();
                room_.notify_all();
            }
        }
    }

    std::size_t longest_;
    std::function<void(const Job&)> work_;
    std::mutex mutex_;
    std::condition_variable arrived_, room_;
    std::deque<Job> jobs_;
    bool closed_ = false;
    std::exception_ptr error_;
    std::vector<std::jthread> threads_;
};

// Frames, their channels and annotations, of an earlier run. A shorter one would leave the later of them, as if its own.
std::vector<std::filesystem::path> frames_in(const std::filesystem::path& folder, const std::string& name) {
    static const std::regex named("(frame|depth|ids|parts|normals|flow)_[0-9]{6,}\\.(png|exr|npy)|annotations\\.json");
    static const std::regex numbered("[0-9]{6,}\\.png");
    const std::regex& of_frame = name.empty() ? numbered : named;
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (std::regex_match(entry.path().filename().string(), of_frame)) found.push_back(entry.path());
    return found;
}

// Holds a folder for one run at a time: the frames of two would mix. Where a file system has no locks it holds nothing.
class Claim {
public:
    Claim() = default;
    ~Claim() {
        if (folder_ >= 0) close_file(folder_);
    }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;
    void take(const std::filesystem::path& folder) {
        folder_ = hold_folder(folder);
        if (folder_ < 0 && errno == EWOULDBLOCK)
            throw ImageError(folder.string() + ": another run writes its frames there; name another folder");
    }

private:
    int folder_ = -1;
};

Clip clip_of(const std::filesystem::path& preview) {
    if (preview.extension() == ".gif") return Clip::gif;
    if (preview.extension() == ".webp") return Clip::webp;
    throw ImageError(preview.string() + ": a preview is a .gif or a .webp; name a file such as scree.gif");
}

// Requires the extension .mp4, since ffmpeg is asked for that format. Paths that are no regular files are refused
// later, with that reason.
void require_film(const std::filesystem::path& video) {
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(video, ignored);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return;
    if (video.extension() != ".mp4") throw ImageError(video.string() + ": a video is an .mp4; name a file such as scree.mp4");
}

int encoders(int asked) {
    if (asked > 0) return asked;
    return std::thread::hardware_concurrency() > 4 ? 2 : 1;
}

}  // namespace

struct FrameWriter::Impl {
    FrameWriterOptions options;
    int frames = 0;
    std::unique_ptr<Video> video, preview;
    std::unique_ptr<RawFrames> raw;
    Claim folder;
    struct Output {
        std::unique_ptr<Line> line;
        std::function<void()> finish;  // finishes the sink of the line; may be empty
    };
    std::vector<Output> outputs;  // destroyed before the sinks that they write to

    void add_output(int threads, std::function<void(const Job&)> work, std::function<void()> finish) {
        const auto longest = static_cast<std::size_t>(std::max(options.waiting, 1));
        outputs.push_back({std::make_unique<Line>(longest, threads, std::move(work)), std::move(finish)});
    }
    void add_video(std::unique_ptr<Video>& owner, const std::filesystem::path& path, Clip clip) {
        owner = std::make_unique<Video>(path,
                                        VideoShape{options.width, options.height, options.bits, options.frames_per_second, clip});
        Video* const to = owner.get();
        add_output(
            1, [to](const Job& job) { to->add(*job.image); }, [to] { to->finish(); });
    }
};

FrameWriter::FrameWriter(const FrameWriterOptions& options) : interior_(std::make_unique<Impl>()) {
    Impl& in = *interior_;
    in.options = options;
    std::vector<std::filesystem::path> earlier;
    if (!options.video.empty()) require_film(options.video);
    const Clip preview = options.preview.empty() ? Clip::gif : clip_of(options.preview);
    if (!options.folder.empty()) {
        require_writable_folder(options.folder);
        in.folder.take(options.folder);
        earlier = frames_in(options.folder, options.name);
        if (!earlier.empty() && !options.overwrite)
            throw ImageError(options.folder.string() + ": holds frames already, such as " + earlier[0].filename().string() +
                             "; name another folder, or remove them (--overwrite does)");
    }
    if (!options.raw.empty()) {
        in.raw = std::make_unique<RawFrames>(options.raw);
        RawFrames* const raw = in.raw.get();
        in.add_output(
            1, [raw](const Job& job) { raw->add(*job.image); }, [raw] { raw->finish(); });
    }
    if (!options.video.empty()) in.add_video(in.video, options.video, Clip::film);
    if (!options.preview.empty()) in.add_video(in.preview, options.preview, preview);
    if (!options.folder.empty()) {
        const auto write = [folder = options.folder, begin = options.name, alpha = options.alpha,
                            exr = options.exr](const Job& job) {
            char name[32];
            std::snprintf(name, sizeof name, "%06d.%s", job.number, exr ? "exr" : "png");
            if (exr) return write_exr(folder / (begin + name), *job.image, alpha, *job.layers);
            write_png(folder / (begin + name), alpha ? straight(*job.image) : *job.image);
        };
        in.add_output(encoders(options.threads), write, {});
    }
    for (const std::filesystem::path& frame : earlier) std::filesystem::remove(frame);
}

FrameWriter::~FrameWriter() {
    if (interior_->frames == 0) return;  // existing files are not replaced
    try {
        finish();
    } catch (const std::exception&) {
        // The owner is unwinding from its own error, or did not call finish().
    }
}

void FrameWriter::add(Image image, std::vector<ExrLayer> layers) {
    const Job job{interior_->frames++, std::make_shared<const Image>(std::move(image)),
                  std::make_shared<const std::vector<ExrLayer>>(std::move(layers))};
    for (const Impl::Output& output : interior_->outputs) output.line->add(job);
}

void FrameWriter::finish() {
    // Close every output before reporting the first error, so that the others are complete.
    std::exception_ptr first;
    for (const Impl::Output& output : interior_->outputs) {
        output.line->close();
        try {
            output.line->rethrow();
            if (output.finish) output.finish();
        } catch (const std::exception&) {
            if (!first) first = std::current_exception();
        }
    }
    if (first) std::rethrow_exception(first);
}

int FrameWriter::frames() const {
    return interior_->frames;
}

}  // namespace scree::host
