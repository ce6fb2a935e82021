// Ranks as processes of MPI (MPI: A Message-Passing Interface Standard, version 3.1).
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "compute/distributed/exchange.h"
#include "demos/program/mpi/module.h"

namespace scree::demos {

namespace {

constexpr std::size_t most_at_once = std::size_t{1} << 30;  // lengths are ints

class MpiExchange : public Exchange {
public:
    MpiExchange() {
        int threads = 0;
        // Errors end all ranks with a message of MPI's: its usual way.
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &threads);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
    }
    ~MpiExchange() override { MPI_Finalize(); }
    [[noreturn]] void end_all(int status) override {
        MPI_Abort(MPI_COMM_WORLD, status);
        std::abort();
    }
    int rank() const override { return rank_; }
    int ranks() const override { return ranks_; }
    Neighbours neighbours() const {
        MPI_Comm here;
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &here);
        Neighbours found;
        MPI_Comm_size(here, &found.count);
        MPI_Comm_rank(here, &found.place);
        MPI_Comm_free(&here);
        return found;
    }
    std::vector<Bytes> all_to_all(const std::vector<Bytes>& to) override {
        std::vector<std::uint64_t> sent, received(to.size());
        for (const Bytes& one : to) sent.push_back(one.size());
        {
            const Waiting waiting(*this);
            MPI_Alltoall(sent.data(), 1, MPI_UINT64_T, received.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
        }
        std::vector<Bytes> from(to.size());
        for (std::size_t r = 0; r < from.size(); ++r) from[r].resize(received[r]);
        Exchange::all_to_all(to, from);
        return from;
    }
    void start(const std::vector<Bytes>& to, std::vector<Bytes>& from) override {
        const Waiting waiting(*this);
        const auto in_pieces = [&](std::size_t bytes, const auto& transfer) {
            for (std::size_t at = 0; at < bytes; at += most_at_once)
                transfer(at, static_cast<int>(std::min(most_at_once, bytes - at)), &requests_.emplace_back());
        };
        for (int r = 0; r < ranks_; ++r) {
            Bytes& in = from[static_cast<std::size_t>(r)];
            if (r == rank_)
                in = to[static_cast<std::size_t>(r)];
            else
                in_pieces(in.size(), [&](std::size_t at, int length, MPI_Request* request) {
                    MPI_Irecv(&in[at], length, MPI_BYTE, r, 0, MPI_COMM_WORLD, request);
                });
        }
        for (int r = 0; r < ranks_; ++r) {
            const Bytes& out = to[static_cast<std::size_t>(r)];
            if (r == rank_ || out.empty()) continue;
            note_sent(out.size());
            in_pieces(out.size(), [&](std::size_t at, int length, MPI_Request* request) {
                MPI_Isend(&out[at], length, MPI_BYTE, r, 0, MPI_COMM_WORLD, request);
            });
        }
    }
    void progress() override {
        const Waiting waiting(*this);
        int done = 0;
        MPI_Testall(static_cast<int>(requests_.size()), requests_.data(), &done, MPI_STATUSES_IGNORE);
        if (done) requests_.clear();
    }
    void finish() override {
        const Waiting waiting(*this);
        MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
        requests_.clear();
    }
    void unite(std::span<std::uint32_t> bits) override { reduce(bits, MPI_BOR); }
    void add(std::span<std::uint32_t> numbers) override { reduce(numbers, MPI_SUM); }

private:
    void reduce(std::span<std::uint32_t> values, MPI_Op operation) {
        const Waiting waiting(*this);
        MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_UINT32_T, operation, MPI_COMM_WORLD);
    }
    int rank_ = 0, ranks_ = 1;
    std::vector<MPI_Request> requests_;  // of what start() has begun
};

}  // namespace

extern "C" __attribute__((visibility("default"))) Exchange* scree_join_neighbours(Neighbours* neighbours) {
    auto exchange = std::make_unique<MpiExchange>();
    *neighbours = exchange->neighbours();
    return exchange.release();
}

}  // namespace scree::demos
