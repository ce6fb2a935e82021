// Ranks as threads of one process.
#include "compute/distributed/in_process.h"

#include <array>
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
    explicit MeetingPoint(int ranks) : words(static_cast<std::size_t>(ranks)), ranks_(ranks) {
        for (auto& box : mail) box.resize(words.size());
    }
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
    std::array<std::vector<std::vector<Bytes>>, 2> mail;  // two boxes in turn: by sender, then by receiver
    std::vector<std::vector<std::uint32_t>> words;        // by sender

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
    int ranks() const override { return static_cast<int>(point_.words.size()); }
    std::vector<Bytes> all_to_all(const std::vector<Bytes>& to) override {
        std::vector<Bytes> from(to.size());
        start(to, from);
        take([](Bytes& into, const Bytes& mail) { into = mail; });
        return from;
    }
    void start(const std::vector<Bytes>& to, std::vector<Bytes>& from) override {
        const auto own = static_cast<std::size_t>(rank_);
        for (std::size_t r = 0; r < to.size(); ++r)
            if (r != own && !to[r].empty()) note_sent(to[r].size());
        point_.mail[box_][own] = to;
        from_ = &from;
    }
    void finish() override {
        take([](Bytes& into, const Bytes& mail) {
            if (into.size() != mail.size()) throw RankLost("a message from another rank has another length");
            into = mail;
        });
    }
    void unite(std::span<std::uint32_t> bits) override {
        reduce(bits, [](std::uint32_t a, std::uint32_t b) { return a | b; });
    }
    void add(std::span<std::uint32_t> numbers) override {
        reduce(numbers, [](std::uint32_t a, std::uint32_t b) { return a + b; });
    }

private:
    // A box is filled again when all have emptied the other, and so this one before.
    template <class Take>
    void take(const Take& put_in) {
        const Waiting waiting(*this);
        point_.wait();
        for (std::size_t r = 0; r < from_->size(); ++r)
            put_in((*from_)[r], point_.mail[box_][r][static_cast<std::size_t>(rank_)]);
        box_ = 1 - box_;
    }
    template <class Combine>
    void reduce(std::span<std::uint32_t> values, const Combine& combine) {
        const Waiting waiting(*this);
        const auto own = static_cast<std::size_t>(rank_);
        point_.words[own].assign(values.begin(), values.end());
        point_.wait();
        for (std::size_t r = 0; r < point_.words.size(); ++r)
            for (std::size_t k = 0; r != own && k < values.size(); ++k) values[k] = combine(values[k], point_.words[r][k]);
        point_.wait();
    }
    MeetingPoint& point_;
    int rank_;
    std::size_t box_ = 0;
    std::vector<Bytes>* from_ = nullptr;  // where to put what start() has begun to exchange
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
