// The options that commands share, and their words.
#include "demos/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

#include "demos/pictures.h"

namespace scree::demos {

namespace {

double number_of(const std::string& word, const char* option, const char* such_as = "") {
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

std::pair<std::string, std::string> halves(const std::string& word, char mark, const char* option, const char* form) {
    const auto at = word.find(mark, 1);
    if (at == word.npos) throw CLI::ValidationError(option, fmt::format("\"{}\" is not of the form {}", word, form));
    return {word.substr(0, at), word.substr(at + 1)};
}

void set_size(PictureOptions& options, const std::string& word) {
    const auto [width, height] = halves(word, 'x', "--size", "WIDTHxHEIGHT");
    const auto pixels_of = [](const std::string& side) {
        const double pixels = number_of(side, "--size");
        if (pixels != std::floor(pixels) || pixels < 16 || pixels > 16384) {
            throw CLI::ValidationError("--size", "each side must be a whole number of pixels between 16 and 16384, is " + side);
        }
        return static_cast<int>(pixels);
    };
    options.width = pixels_of(width);
    options.height = pixels_of(height);
}

void set_range(PictureOptions& options, const std::string& word) {
    const auto [low, high] = halves(word, ':', "--color-range", "LOW:HIGH");
    const auto bound_of = [](const std::string& bound) {
        const double value = number_of(bound, "--color-range");
        if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())) {
            throw CLI::ValidationError("--color-range",
                                       fmt::format("the number {} is out of range, which ends at 3.4e38", bound));
        }
        return static_cast<float>(value);
    };
    options.color_range = {bound_of(low), bound_of(high)};
    if (!(options.color_range->first < options.color_range->second)) {
        throw CLI::ValidationError("--color-range", "LOW must be below HIGH, is " + word);
    }
}

// As CLI::Range, which lets NaN pass.
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

// One of some words, or a message that names the nearest.
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

}  // namespace

Settings SceneOptions::settings() const {
    Settings settings;
    settings.rate = rate;
    settings.substeps = substeps;
    settings.sleeping = sleeping;
    return settings;
}

int SceneOptions::step_count(double default_seconds) const {
    if (steps) return *steps;
    return static_cast<int>(std::max(1L, std::lround(seconds.value_or(default_seconds) * static_cast<double>(rate))));
}

std::size_t count_of(const std::string& word) {
    std::string digits = word;
    double scale = 1;
    if (!word.empty()) {
        const char last = word.back();
        scale = last == 'k' || last == 'K' ? 1e3 : last == 'm' || last == 'M' ? 1e6 : last == 'g' || last == 'G' ? 1e9 : 1;
        if (scale > 1) digits.pop_back();
    }
    const double value = number_of(digits, "--bodies", ", such as 500, 10k or 1M") * scale;
    if (value < 1 || value > 1e15 || value != std::floor(value)) {
        throw CLI::ValidationError("--bodies", fmt::format("must be a whole number of at least 1, is \"{}\"", word));
    }
    return static_cast<std::size_t>(value);
}

std::uint64_t seed_of(const std::string& word) {
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), seed);
    if (error != std::errc() || end != word.data() + word.size()) {
        throw CLI::ValidationError("--seed", fmt::format("must be a whole number between 0 and {}, is \"{}\"",
                                                         std::numeric_limits<std::uint64_t>::max(), word));
    }
    return seed;
}

std::vector<std::size_t> counts_of(const std::string& list) {
    std::vector<std::size_t> counts;
    std::size_t from = 0;
    while (from <= list.size()) {
        const std::size_t to = std::min(list.find(',', from), list.size());
        counts.push_back(count_of(list.substr(from, to - from)));
        from = to + 1;
    }
    return counts;
}

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t least = 1 + word.size() / 3;  // farther words are no help
    for (const std::string& candidate : known) {
        std::vector<std::size_t> row(candidate.size() + 1);  // Levenshtein's distance, row by row
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

void add_options(CLI::App& command, MachineOptions& options) {
    command
        .add_option("--backend", options.backend,
                    "auto (a GPU, else a software Vulkan device, else the processor), vulkan or cpu")
        ->check(one_of({"auto", "vulkan", "cpu"}))
        ->group("Where");
    command.add_option("--device", options.device, "the Vulkan device: its index or part of its name (see scree devices)")
        ->group("Where");
    command.add_option("--threads", options.threads, "of the cpu backend; 0 is one a core")
        ->check(CLI::Range(0, 1024))
        ->group("Where");
    command.add_flag("--validate", options.validate, "check every Vulkan call with the validation layers (slow)")->group("Where");
}

void add_options(CLI::App& command, SceneOptions& options) {
    command.add_option("scene", options.name, "a demo (see scree list) or a scene file, NAME.json")->required();
    auto* steps = command.add_option("--steps", options.steps, "how many steps")->check(CLI::Range(1, 1000000000))->group("What");
    command
        .add_option("--seconds", options.seconds,
                    "how long, in simulated seconds (default: until the demo's promise can be judged)")
        ->check(between(1e-3, 1e6))
        ->excludes(steps)
        ->group("What");
    command.add_option("--rate", options.rate, "steps a second")->check(between(10.0, 1000.0))->group("What");
    command.add_option("--substeps", options.substeps, "of a step; more make taller stacks stand")
        ->check(CLI::Range(1, 64))
        ->group("What");
    command.add_flag("!--no-sleep", options.sleeping, "bodies at rest stay awake")->group("What");
    command
        .add_option_function<std::string>(
            "--bodies", [&options](const std::string& word) { options.bodies = count_of(word); },
            "how many; 10k and 1M are understood")
        ->group("What");
    command
        .add_option_function<std::string>(
            "--seed", [&options](const std::string& word) { options.seed = seed_of(word); },
            "of the random numbers that a demo is built with")
        ->group("What");
}

void add_options(CLI::App& command, PictureOptions& options) {
    const char* group = "Pictures";
    command.add_option("--frames", options.frames, "a folder for frame_000000.png and so on")->group(group);
    command.add_option("--video", options.video, "a video file, NAME.mp4 (needs ffmpeg)")->group(group);
    command
        .add_option_function<std::string>(
            "--size", [&options](const std::string& word) { set_size(options, word); }, "of a picture, WIDTHxHEIGHT (1280x720)")
        ->group(group);
    command.add_option("--fps", options.fps, "pictures for each simulated second, at most --rate")
        ->check(between(0.1, 1000.0))
        ->group(group);
    command.add_option("--color", options.color, "what colour tells")->check(one_of(color_words()))->group(group);
    command.add_option("--color-map", options.color_map, "how it tells it")->check(one_of(color_map_words()))->group(group);
    command
        .add_option_function<std::string>(
            "--color-range", [&options](const std::string& word) { set_range(options, word); },
            "LOW:HIGH in the unit of --color (default: from 0 to what a typical body would have after falling over the scene's "
            "height)")
        ->group(group);
    command
        .add_option(
            "--show", options.show,
            "what else to draw, a list parted by commas: contacts (their points, and along the normal how hard they push)")
        ->check(one_of({"contacts"}))
        ->delimiter(',')
        ->expected(1)
        ->take_all()
        ->group(group);
    command
        .add_option("--canvas", options.canvas,
                    "what draws: vulkan, gl (OpenGL ES) or auto (vulkan on the device that simulates; for the processor gl, and "
                    "vulkan where there is no gl); the pictures look the same")
        ->check(one_of({"auto", "vulkan", "gl"}))
        ->group(group);
    command.add_flag("!--no-legend", options.legend, "no scale and caption in the picture")->group(group);
}

}  // namespace scree::demos
