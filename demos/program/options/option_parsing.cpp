// Parsing of command line values.
#include "demos/program/options/option_parsing.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

namespace scree::demos {

double number_of(const std::string& word, const char* option, const char* such_as) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) {
        throw CLI::ValidationError(option, fmt::format("the number {} is out of range", word));
    }
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
        throw CLI::ValidationError(option, fmt::format("\"{}\" is not a number{}", word, such_as));
    }
    return value;
}

float float_of(const std::string& word, const char* option) {
    const double value = number_of(word, option);
    if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())) {
        throw CLI::ValidationError(option, fmt::format("the number {} is out of range, which ends at 3.4e38", word));
    }
    return static_cast<float>(value);
}

glm::vec3 vector_of(const std::string& word, const char* option) {
    glm::vec3 vector(0);
    std::size_t from = 0;
    for (glm::length_t i = 0; i < 3; ++i) {
        const std::size_t to = std::min(word.find(',', from), word.size());
        if ((i < 2) != (to < word.size()))
            throw CLI::ValidationError(option, fmt::format("\"{}\" is not of the form X,Y,Z", word));
        vector[i] = float_of(word.substr(from, to - from), option);
        from = to + 1;
    }
    return vector;
}

std::pair<std::string, std::string> halves(const std::string& word, char mark, const char* option, const char* form) {
    const auto at = word.find(mark, 1);
    if (at == word.npos) throw CLI::ValidationError(option, fmt::format("\"{}\" is not of the form {}", word, form));
    return {word.substr(0, at), word.substr(at + 1)};
}

std::string counted(std::size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

CLI::Validator between(double low, double high) {
    return CLI::Validator(
        [low, high](std::string& word) {
            double value = 0;
            const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
            const bool whole = error == std::errc() && end == word.data() + word.size();
            return whole && value >= low && value <= high ? ""
                                                          : fmt::format("must be between {:g} and {:g}, is {}", low, high, word);
        },
        "");
}

CLI::Validator one_of(std::vector<std::string> known) {
    std::string all;
    for (const std::string& word : known) all += (all.empty() ? "" : ", ") + word;
    return CLI::Validator(
        [known = std::move(known), all](std::string& word) {
            if (std::find(known.begin(), known.end(), word) != known.end()) return std::string();
            const std::string near = nearest(word, known);
            return fmt::format("unknown value \"{}\"{}; known: {}", word, near.empty() ? "" : ", nearest: \"" + near + "\"", all);
        },
        "");
}

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t least = 1 + word.size() / 3;  // reject distant words
    for (const std::string& candidate : known) {
        std::vector<std::size_t> row(candidate.size() + 1);  // Levenshtein distance, row by row
        std::iota(row.begin(), row.end(), 0u);
        for (std::size_t i = 1; i <= word.size(); ++i) {
            std::size_t diagonal = std::exchange(row[0], i);
            for (std::size_t j = 1; j <= candidate.size(); ++j) {
                const std::size_t changed = diagonal + (word[i - 1] != candidate[j - 1]);
                diagonal = std::exchange(row[j], std::min({changed, row[j] + 1, row[j - 1] + 1}));
            }
        }
        if (row.back() > least || (row.back() == least && !best.empty())) continue;
        least = row.back();
        best = candidate;
    }
    return best;
}

}  // namespace scree::demos
