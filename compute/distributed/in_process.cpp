// Ranks as threads of one process.
#include "compute/distributed/in_process.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace scree {

namespace {

// Where the ranks of a process meet.
class MeetingPoint {
public:
    explicit MeetingPoint(int ranks) : mail(static_cast<std::size_t>(ranks)), words(mail.size()), ranks_(ranks) {}
    void wait() {
        std::unique_lock lock(mutex_);
        if (lost_) throw RankLost("another rank has ended");
        const std::uint64_t round = round_;
        if (++waiting_ == ranks_) {
            waiting_ = 0;
            ++round_;
            met_.notify_all();
            return;
        }
        met_.wait(lock, [&] { return lost_ || round_ != round; });
        if (round_ == round) throw RankLost("another rank has ended");
    }
    // The first exception is the one that counts.
    void lose(std::exception_ptr reason) {
        const std::lock_guard lock(mutex_);
        if (!lost_) reason_ = std::move(reason);
        lost_ = true;
        met_.notify_all();
    }
    void rethrow() const {
        if (reason_) std::rethrow_exception(reason_);
    }
    std::vector<std::vector<Bytes>> mail;           // by sender, then by receiver
    std::vector<std::vector<std::uint32_t>> words;  // by sender

private:
    std::mutex mutex_;
    std::condition_variable met_;
    std::exception_ptr reason_;
    int ranks_, waiting_ = 0;
    std::uint64_t round_ = 0;
    bool lost_ = false;
};

class InProcessExchange : public Exchange {
public:
    InProcessExchange(MeetingPoint& point, int rank) : point_(point), rank_(rank) {}
    [[noreturn]] void end_all(int) override { throw RankLost("a rank ends all"); }
    int rank() const override { return rank_; }
    int ranks() const override { return static_cast<int>(point_.mail.size()); }
    std::vector<Bytes> swap(const std::vector<Bytes>& to) override {
        std::vector<Bytes> from(point_.mail.size());
        swap(to, from);
        return from;
    }
    void swap(const std::vector<Bytes>& to, std::vector<Bytes>& from) override {
        const auto own = static_cast<std::size_t>(rank_);
        for (std::size_t r = 0; r < to.size(); ++r)
            if (r != own && !to[r].empty()) note_sent(to[r].size());
        point_.mail[own] = to;
        point_.wait();
        for (std::size_t r = 0; r < from.size(); ++r) from[r] = point_.mail[r][own];
        point_.wait();
    }
    void unite(std::span<std::uint32_t> bits) override {
        reduce(bits, [](std::uint32_t a, std::uint32_t b) { return a | b; });
    }
    void add(std::span<std::uint32_t> numbers) override {
        reduce(numbers, [](std::uint32_t a, std::uint32_t b) { return a + b; });
    }

private:
    template <class Combine>
    void reduce(std::span<std::uint32_t> values, const Combine& combine) {
        const auto own = static_cast<std::size_t>(rank_);
        point_.words[own].assign(values.begin(), values.end());
        point_.wait();
        for (std::size_t r = 0; r < point_.words.size(); ++r)
            for (std::size_t k = 0; r != own && k < values.size(); ++k) values[k] = combine(values[k], point_.words[r][k]);
        point_.wait();
    }
    MeetingPoint& point_;
    int rank_;
};

}  // namespace

void run_in_process(int ranks, const std::function<void(const std::shared_ptr<Exchange>&)>& work) {
    MeetingPoint point(ranks);
    std::vector<std::thread> threads;
    for (int rank = 0; rank < ranks; ++rank)
        threads.emplace_back([&point, &work, rank] {
            try {
                work(std::make_shared<InProcessExchange>(point, rank));
            } catch (...) {
                point.lose(std::current_exception());
            }
        });
    for (std::thread& thread : threads) thread.join();
    point.rethrow();
}

}  // namespace scree
