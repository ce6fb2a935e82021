// The progress bar.
#include "demos/program/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "demos/program/console.h"
#include "host/system/files.h"

namespace scree::demos {

std::string duration(double seconds) {
    if (seconds < 1e-3) return fmt::format("{:.0f} us", seconds * 1e6);
    if (seconds < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
    if (seconds < 60) return fmt::format("{:.1f} s", seconds);
    const long whole = static_cast<long>(seconds + 0.5);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

Progress::Progress(std::string what, long total, const char* unit, bool quiet, long begun)
    : what_(std::move(what)),
      total_(std::max(total, 1L)),
      begun_(begun),
      unit_(unit),
      quiet_(quiet),
      terminal_(host::is_terminal(2)) {}

Progress::~Progress() {
    if (shown_ && terminal_) say("\r\033[K");
}

void Progress::done(long count) {
    if (quiet_) return;
    const auto now = Clock::now();
    const auto pause = terminal_ ? std::chrono::milliseconds(150) : std::chrono::milliseconds(10000);
    if (now - last_ < pause) return;
    last_ = now;
    show(count, std::chrono::duration<double>(now - start_).count());
}

void Progress::show(long count, double seconds) {
    shown_ = true;
    const double part = static_cast<double>(count) / static_cast<double>(total_);
    const double rate = static_cast<double>(count - begun_) / std::max(seconds, 1e-9);
    const std::string left =
        count > begun_ && count < total_ ? duration(static_cast<double>(total_ - count) / rate) + " left" : "";
    const std::string text =
        fmt::format("{} {:3.0f}%  {}/{} {}  {:.3g}/s  {}", what_, 100 * part, count, total_, unit_, rate, left);
    if (!terminal_) {
        say("{}\n", text);
        return;
    }
    constexpr int width = 24;
    const int filled = std::clamp(static_cast<int>(part * width), 0, width);
    say("\r\033[K[{}{}] {}", std::string(static_cast<std::size_t>(filled), '#'),
        std::string(static_cast<std::size_t>(width - filled), '.'), text);
    std::fflush(stderr);
}

}  // namespace scree::demos
