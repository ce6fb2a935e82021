// Values and combinations of a sweep.
#include "demos/program/sweep/sweep_plan.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "demos/program/options/option_parsing.h"

namespace scree::demos {

namespace {

constexpr std::size_t most_values = 1'000'000;  // of a key, and combinations

[[noreturn]] void refuse_values(const std::string& word, const std::string& reason) {
    throw CLI::ValidationError("--set", fmt::format("{}: {}", word, reason));
}

// Commas within brackets and quotes belong to a value.
std::vector<std::string> list_of(const std::string& text) {
    std::vector<std::string> values{""};
    int depth = 0;
    bool quoted = false;
    for (const char c : text) {
        if (c == '"') quoted = !quoted;
        if (!quoted && (c == '[' || c == '{')) ++depth;
        if (!quoted && (c == ']' || c == '}')) --depth;
        if (c == ',' && depth == 0 && !quoted)
            values.emplace_back();
        else
            values.back() += c;
    }
    return values;
}

std::vector<std::string> whole_numbers(const std::string& word, const std::string& low, const std::string& high) {
    long long first = 0, last = 0;
    const auto parse = [&](const std::string& text, long long& out) {
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
        if (error != std::errc() || end != text.data() + text.size())
            refuse_values(word,
                          fmt::format("\"{}\" is no whole number; A..B are whole numbers, A:B:N N numbers from A to B", text));
    };
    parse(low, first), parse(high, last);
    if (last < first) refuse_values(word, "A..B counts upwards");
    if (static_cast<unsigned long long>(last) - static_cast<unsigned long long>(first) >= most_values)
        refuse_values(word, "more than 1000000 values");
    std::vector<std::string> values;
    for (long long i = first; i <= last; ++i) values.push_back(std::to_string(i));
    return values;
}

// N values from A to B, both included; with "log" of equal ratio.
std::vector<std::string> spaced(const std::string& word, const std::string& low, const std::string& high, std::string count) {
    const bool by_ratio = count.ends_with("log");
    if (by_ratio) count.resize(count.size() - 3);
    const double a = number_of(low, "--set"), b = number_of(high, "--set"), n = number_of(count, "--set");
    if (!(n >= 1 && n <= static_cast<double>(most_values)) || n != std::floor(n))
        refuse_values(word, "N of A:B:N is a whole number of 1 to 1000000");
    if (by_ratio && !(a > 0 && b > 0)) refuse_values(word, "values of equal ratio lie above 0");
    std::vector<std::string> values;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        const double t = n == 1 ? 0 : static_cast<double>(i) / (n - 1);
        const double value = by_ratio ? a * std::pow(b / a, t) : a + (b - a) * t;
        values.push_back(fmt::format("{:.9g}", i > 0 && i + 1 == static_cast<std::size_t>(n) ? b : value));
    }
    return values;
}

}  // namespace

SweptKey swept_key_of(const std::string& word) {
    const std::size_t equals = word.find('=');
    if (equals == word.npos || equals == 0 || equals + 1 == word.size())
        refuse_values(word, "is KEY=VALUES, such as bodies/3/friction=0.1:1:10, seed=1..20 or substeps=4,8,16");
    SweptKey key{word.substr(0, equals), {}};
    for (const std::string& item : list_of(word.substr(equals + 1))) {
        const bool plain = !item.empty() && item.find_first_not_of("0123456789.+-eE:log") == item.npos;
        const std::size_t dots = item.find(".."), first = item.find(':'),
                          second = first == item.npos ? first : item.find(':', first + 1);
        std::vector<std::string> values{item};
        if (item.empty()) refuse_values(word, "a value is empty");
        if (plain && dots != item.npos) values = whole_numbers(word, item.substr(0, dots), item.substr(dots + 2));
        if (plain && first != item.npos && second == item.npos)
            refuse_values(word, "N is missing: A:B:N is N numbers from A to B");
        if (plain && second != item.npos)
            values = spaced(word, item.substr(0, first), item.substr(first + 1, second - first - 1), item.substr(second + 1));
        key.values.insert(key.values.end(), values.begin(), values.end());
        if (key.values.size() > most_values) refuse_values(word, "more than 1000000 values");
    }
    return key;
}

std::size_t run_count(const std::vector<SweptKey>& keys) {
    std::size_t count = 1;
    for (const SweptKey& key : keys) {
        if (count > most_values / key.values.size()) refuse_values(key.key, "with it there are more than 1000000 runs");
        count *= key.values.size();
    }
    return count;
}

std::vector<std::string> values_of_run(const std::vector<SweptKey>& keys, std::size_t index) {
    std::vector<std::string> values(keys.size());
    for (std::size_t k = keys.size(); k-- > 0;) {
        values[k] = keys[k].values[index % keys[k].values.size()];
        index /= keys[k].values.size();
    }
    return values;
}

std::vector<std::string> arguments_of_run(const std::vector<SweptKey>& keys, std::size_t index, const std::string& scene,
                                          const std::vector<std::string>& further) {
    static const std::vector<std::string> options = {"seed",    "bodies", "rate",    "substeps", "steps",
                                                     "seconds", "device", "threads", "backend",  "keyframe"};
    const std::vector<std::string> values = values_of_run(keys, index);
    std::vector<std::string> arguments = {"run", scene};
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (std::find(options.begin(), options.end(), keys[k].key) != options.end())
            arguments.insert(arguments.end(), {"--" + keys[k].key, values[k]});
        else
            arguments.insert(arguments.end(), {"--set", keys[k].key + "=" + values[k]});
    }
    arguments.insert(arguments.end(), further.begin(), further.end());
    return arguments;
}

Shard shard_of(const std::string& word) {
    const std::size_t slash = word.find('/');
    Shard shard;
    if (slash != word.npos) {
        const double number = number_of(word.substr(0, slash), "--shard"), count = number_of(word.substr(slash + 1), "--shard");
        if (number >= 1 && number <= count && count <= 1e6 && number == std::floor(number) && count == std::floor(count)) {
            shard.number = static_cast<std::size_t>(number), shard.count = static_cast<std::size_t>(count);
            return shard;
        }
    }
    throw CLI::ValidationError("--shard", fmt::format("is K/N with K from 1 to N, such as 2/8, is \"{}\"", word));
}

}  // namespace scree::demos
