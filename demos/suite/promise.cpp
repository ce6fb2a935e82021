// Judging promises: measured values against limits.
#include "demos/suite/promise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scree::demos {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

std::string amount(double value, const std::string& unit) {
    return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit);
}

}  // namespace

Row Claim::operator()(const Trace& trace) const {
    const double value = measure(trace);
    return {what, promised, amount(value, unit), low <= value && value <= high, value, low, high, unit, by_clock, reason};
}

bool Row::is_sharp() const {
    if (std::isfinite(low) && std::isfinite(high)) return true;
    return std::isfinite(high) ? high <= 2 * value : value <= 2 * low;
}

Claim by_clock(Claim claim) {
    claim.by_clock = true;
    return claim;
}

Claim because(Claim claim, std::string reason) {
    if (!reason.empty()) claim.reason = std::move(reason);
    return claim;
}

Claim over_ending(Claim claim, double seconds) {
    claim.ending = seconds;
    return claim;
}

Claim over_last_second(Claim claim) {
    claim.last_second = true;
    return claim;
}

Claim at_most(std::string what, double limit, std::string unit, std::string how, Measure measure) {
    std::string promised = "at most " + amount(limit, unit);
    return {std::move(what), std::move(promised), -unbounded, limit, std::move(unit), std::move(how), std::move(measure)};
}

Claim at_least(std::string what, double limit, std::string unit, std::string how, Measure measure) {
    std::string promised = "at least " + amount(limit, unit);
    return {std::move(what), std::move(promised), limit, unbounded, std::move(unit), std::move(how), std::move(measure)};
}

Claim between(std::string what, double low, double high, std::string unit, std::string how, Measure measure) {
    std::string promised = fmt::format("{:.4g} to {}", low, amount(high, unit));
    return {std::move(what), std::move(promised), low, high, std::move(unit), std::move(how), std::move(measure)};
}

Claim close_to(std::string what, double expected, double tolerance, std::string unit, std::string how, Measure measure) {
    std::string promised = fmt::format("{} +- {:.2g}", amount(expected, unit), tolerance);
    return {std::move(what), std::move(promised), expected - tolerance, expected + tolerance,
            std::move(unit), std::move(how),      std::move(measure)};
}

bool Span::holds(std::uint64_t step, double rate) const {
    const double time = static_cast<double>(step) / rate, half_step = 0.5 / rate;
    if (time < from - half_step || time > to + half_step) return false;
    const double stride = std::max(1.0, std::round(rate / per_second));
    return step % static_cast<std::uint64_t>(stride) == 0;
}

bool Promise::samples(std::uint64_t step, double rate) const {
    return std::any_of(sampled_.begin(), sampled_.end(), [&](const Span& span) { return span.holds(step, rate); });
}

bool Promise::keeps(std::uint64_t step, double rate) const {
    return std::any_of(kept_.begin(), kept_.end(),
                       [&](double time) { return std::llround(time * rate) == static_cast<long long>(step); });
}

double Promise::ending() const {
    double longest = 0;
    for (const Claim& claim : claims_) longest = std::max(longest, claim.ending);
    return longest;
}

bool Promise::keeps_last_second() const {
    return std::any_of(claims_.begin(), claims_.end(), [](const Claim& claim) { return claim.last_second; });
}

std::vector<Row> Promise::judge(const Trace& trace) const {
    std::vector<Row> rows = demos::judge(claims_, trace);
    for (Row& row : demos::judge(soundness(), trace)) rows.push_back(std::move(row));
    return rows;
}

Claim finite() {
    return at_most("bodies that are not finite", 0, "", "position, orientation and velocity at the end",
                   [](const Trace& trace) { return static_cast<double>(trace.statistics.not_finite); });
}

std::vector<Claim> soundness() {
    return {finite(), at_most("bodies below the ground", 0, "", "centres behind a plane of the scene at the end",
                              [](const Trace& trace) { return static_cast<double>(trace.statistics.below_ground); })};
}

std::vector<Row> judge(const std::vector<Claim>& claims, const Trace& trace) {
    std::vector<Row> rows;
    for (const Claim& claim : claims) rows.push_back(claim(trace));
    return rows;
}

bool all_pass(const std::vector<Row>& rows) {
    return std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.pass; });
}

}  // namespace scree::demos
