// Messages between ranks that share a world: an interface, with ranks as threads of one process
// (compute/distributed/in_process.h) or as processes of MPI (demos/program/mpi; a module of the program).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace scree {

using Bytes = std::vector<std::byte>;

// Another rank has ended: nothing more can be exchanged.
class RankLost : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Every function is collective: all ranks call the same ones in the same order. Each throws RankLost.
class Exchange {
public:
    virtual ~Exchange() = default;
    // Ends all ranks at once, where one cannot go on.
    [[noreturn]] virtual void end_all(int status) = 0;
    virtual int rank() const = 0;   // of this one, from 0
    virtual int ranks() const = 0;  // in all
    // Sends to[r] to each rank r; returns by rank what was sent here.
    virtual std::vector<Bytes> all_to_all(const std::vector<Bytes>& to) = 0;
    // Begins the same where both sides know the lengths: from[r] has that of what rank r sends. Empty messages are not
    // sent. Until finish() `to` and `from` must stay as they are, and nothing else is exchanged.
    virtual void start(const std::vector<Bytes>& to, std::vector<Bytes>& from) = 0;
    virtual void finish() = 0;
    virtual void progress() {}  // in between, lets messages go on where no other thread does
    void all_to_all(const std::vector<Bytes>& to, std::vector<Bytes>& from) {
        start(to, from);
        finish();
    }
    virtual void unite(std::span<std::uint32_t> bits) = 0;   // bitwise or over all ranks
    virtual void add(std::span<std::uint32_t> numbers) = 0;  // sums over all ranks
    // Each rank's bytes, by rank.
    std::vector<Bytes> all_gather(const Bytes& own) {
        return all_to_all(std::vector<Bytes>(static_cast<std::size_t>(ranks()), own));
    }

    std::uint64_t bytes_sent() const { return bytes_sent_; }  // so far, to other ranks
    std::uint64_t messages_sent() const { return messages_sent_; }
    double seconds_waiting() const { return seconds_waiting_; }  // so far, in these functions

protected:
    // Counts the time until its end.
    class Waiting {
    public:
        explicit Waiting(Exchange& exchange) : exchange_(exchange) {}
        ~Waiting() {
            const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin_;
            exchange_.seconds_waiting_ += time.count();
        }
        Waiting(const Waiting&) = delete;
        Waiting& operator=(const Waiting&) = delete;

    private:
        Exchange& exchange_;
        std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    };
    void note_sent(std::size_t bytes) {
        bytes_sent_ += bytes;
        ++messages_sent_;
    }

private:
    std::uint64_t bytes_sent_ = 0, messages_sent_ = 0;
    double seconds_waiting_ = 0;
};

}  // namespace scree
