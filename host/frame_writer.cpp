// Frames to PNG files and to a video, encoded beside the simulation.
#include "host/frame_writer.h"

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "host/video.h"

namespace scree::host {
namespace {

struct Job {
    int number = 0;
    std::shared_ptr<const Image> image;
};

// A bounded queue of frames with its own threads.
class Line {
public:
    Line(std::size_t longest, int threads, std::function<void(const Job&)> work) : longest_(longest), work_(std::move(work)) {
        try {
            for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { run(); });
        } catch (const std::system_error& error) {
            close();  // those that started wait for frames
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
        threads_.clear();  // joins
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
                if (error_) continue;  // after an error the rest is only taken away
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

// Frames of an earlier run would stand behind the last of a shorter one, as if they were its own.
void require_no_frames(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("frame_") || !name.ends_with(".png")) continue;
        throw ImageError(folder.string() + ": holds frames already, such as " + name + "; name another folder, or remove them");
    }
}

int encoders(int asked) {
    if (asked > 0) return asked;
    return std::thread::hardware_concurrency() > 4 ? 2 : 1;
}

}  // namespace

struct FrameWriter::Interior {
    FrameWriterOptions options;
    int frames = 0;
    std::unique_ptr<Video> video;
    std::unique_ptr<Line> pictures, film;
};

FrameWriter::FrameWriter(const FrameWriterOptions& options) : interior_(std::make_unique<Interior>()) {
    interior_->options = options;
    const auto longest = static_cast<std::size_t>(std::max(options.waiting, 1));
    if (!options.folder.empty()) {
        require_writable_folder(options.folder);
        require_no_frames(options.folder);
    }
    if (!options.video.empty()) {
        interior_->video = std::make_unique<Video>(options.video, options.width, options.height, options.frames_per_second);
        interior_->film =
            std::make_unique<Line>(longest, 1, [video = interior_->video.get()](const Job& job) { video->add(*job.image); });
    }
    if (!options.folder.empty()) {
        interior_->pictures =
            std::make_unique<Line>(longest, encoders(options.threads), [folder = options.folder](const Job& job) {
                char name[32];
                std::snprintf(name, sizeof name, "frame_%06d.png", job.number);
                write_png(folder / name, *job.image);
            });
    }
}

FrameWriter::~FrameWriter() {
    try {
        finish();
    } catch (const std::exception&) {
        // The owner is already leaving with its own error, or did not ask.
    }
}

void FrameWriter::add(Image image) {
    const Job job{interior_->frames++, std::make_shared<const Image>(std::move(image))};
    if (interior_->film) interior_->film->add(job);
    if (interior_->pictures) interior_->pictures->add(job);
}

void FrameWriter::finish() {
    if (interior_->pictures) interior_->pictures->close();
    if (interior_->film) interior_->film->close();
    if (interior_->film) interior_->film->rethrow();
    if (interior_->video) interior_->video->finish();
    if (interior_->pictures) interior_->pictures->rethrow();
}

int FrameWriter::frames() const {
    return interior_->frames;
}

}  // namespace scree::host
