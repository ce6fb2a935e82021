// memcpy bandwidth of the processor.
#include "host/copy_speed.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <thread>
#include <vector>

namespace scree::host {

double processor_copy_speed(int threads) {
    const auto count = static_cast<std::size_t>(threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency()));
    const std::size_t part = (std::size_t{256} << 20) / count;
    std::vector<std::vector<std::byte>> from(count), to(count);
    for (std::size_t k = 0; k < count; ++k) {
        from[k].assign(part, std::byte{1});
        to[k].assign(part, std::byte{2});
    }
    double best = 0;
    for (int repetition = 0; repetition < 6; ++repetition) {
        const auto start = std::chrono::steady_clock::now();
        std::vector<std::thread> all;
        for (std::size_t k = 0; k < count; ++k) all.emplace_back([&, k] { std::memcpy(to[k].data(), from[k].data(), part); });
        for (std::thread& thread : all) thread.join();
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        best = std::max(best, 2 * static_cast<double>(part * count) / seconds);
    }
    return best;
}

}  // namespace scree::host
