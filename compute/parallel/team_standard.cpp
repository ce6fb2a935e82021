// A few threads of the standard library, started when a loop first wants them and kept for the loops of all worlds.
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <list>
#include <mutex>
#include <system_error>
#include <thread>

#include "compute/parallel/team.h"

namespace scree {

namespace {

thread_local std::size_t this_slot = 0;

// A loop under way: threads take pieces of it until none is left.
class Loop {
public:
    Loop(std::size_t n, std::size_t piece, std::size_t most, const Team::Range& range)
        : n_(n), piece_(piece), most_(most), range_(range) {}

    void work(std::size_t slot) {
        const std::size_t before = std::exchange(this_slot, slot);  // of the loop around this one
        try {
            for (;;) {
                const std::size_t first = next_.fetch_add(piece_);
                if (first >= n_) break;
                range_(first, std::min(n_, first + piece_));
            }
        } catch (...) {
            next_ = n_;
            const std::lock_guard lock(mutex_);
            if (!thrown_) thrown_ = std::current_exception();
        }
        this_slot = before;
    }
    void rethrow() const {
        if (thrown_) std::rethrow_exception(thrown_);
    }

    // Under the lock of the workers.
    bool wants_more() const { return joined_ < most_ && next_ < n_; }
    std::size_t join() {
        ++inside_;
        return joined_++;
    }
    bool leave() { return --inside_ == 0; }
    bool is_empty() const { return inside_ == 0; }

private:
    std::size_t n_, piece_, most_;
    const Team::Range& range_;
    std::atomic<std::size_t> next_{0};
    std::size_t joined_ = 1, inside_ = 0;  // the caller has slot 0
    std::mutex mutex_;
    std::exception_ptr thrown_;
};

class Workers {
public:
    void run(Loop& loop, std::size_t threads) {
        std::unique_lock lock(mutex_);
        start(threads - 1);
        const auto place = loops_.insert(loops_.end(), &loop);
        lock.unlock();
        for (std::size_t k = 1; k < threads; ++k) there_is_work_.notify_one();
        loop.work(0);
        lock.lock();
        loops_.erase(place);
        left_.wait(lock, [&] { return loop.is_empty(); });
        lock.unlock();
        loop.rethrow();
    }
    // Never destroyed: its threads wait until the process ends.
    static Workers& all() {
        static Workers& workers = *new Workers;
        return workers;
    }

private:
    // Fewer where the system gives no more: the caller of a loop does the work alone.
    void start(std::size_t count) {
        for (; count_ < count; ++count_) try {
                std::thread([this] { serve(); }).detach();
            } catch (const std::system_error&) {
                return;
            }
    }
    [[noreturn]] void serve() {
        std::unique_lock lock(mutex_);
        for (;;) {
            auto found = loops_.end();
            there_is_work_.wait(lock, [&] {
                found = std::find_if(loops_.begin(), loops_.end(), [](const Loop* loop) { return loop->wants_more(); });
                return found != loops_.end();
            });
            Loop& loop = **found;
            const std::size_t slot = loop.join();
            lock.unlock();
            loop.work(slot);
            lock.lock();
            if (loop.leave()) left_.notify_all();
        }
    }

    std::mutex mutex_;
    std::condition_variable there_is_work_, left_;
    std::list<Loop*> loops_;
    std::size_t count_ = 0;
};

}  // namespace

struct Team::Threads {
    std::size_t count;
};

int Team::most(int wanted) {
#if defined(__EMSCRIPTEN_PTHREADS__)
    // A browser starts no thread while a call is in the module: those of its pool are all there are.
    return std::min(wanted, std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
#elif defined(__EMSCRIPTEN__)
    return std::min(wanted, 1);
#else
    return wanted;
#endif
}

Team::Team(int threads) : threads_(std::make_unique<Threads>(Threads{static_cast<std::size_t>(threads)})) {}
Team::~Team() = default;

void Team::loop(std::size_t n, std::size_t least, const Range& range) const {
    // Pieces enough that a thread which comes late or is held up leaves its share to the others.
    constexpr std::size_t pieces_a_thread = 4;
    Loop loop(n, std::max(least, n / (pieces_a_thread * threads_->count)), threads_->count, range);
    Workers::all().run(loop, threads_->count);
}

std::size_t Team::slot() {
    return this_slot;
}

std::size_t Team::slots() const {
    return threads_->count;
}

// Parts are sorted, then merged two by two.
void Team::sort(std::vector<std::pair<std::uint64_t, std::uint32_t>>& keys) const {
    constexpr std::size_t short_list = 4096;
    std::size_t parts = 1;
    while (parts < threads_->count) parts *= 2;
    if (keys.size() < short_list) parts = 1;
    const auto at = [&](std::size_t part) { return keys.begin() + static_cast<std::ptrdiff_t>(keys.size() * part / parts); };
    if (parts == 1) return std::sort(keys.begin(), keys.end());
    loop(parts, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t part = first; part < last; ++part) std::sort(at(part), at(part + 1));
    });
    for (std::size_t width = 1; width < parts; width *= 2)
        loop(parts / (2 * width), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t pair = first; pair < last; ++pair) {
                const std::size_t begin = 2 * width * pair;
                std::inplace_merge(at(begin), at(begin + width), at(begin + 2 * width));
            }
        });
}

}  // namespace scree
