// Runs of many copies of a scene: their options, and how copies differ.
#include "demos/program/copies.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "compute/schema/body.h"
#include "compute/schema/range_text.h"
#include "demos/program/exit_status.h"
#include "demos/program/options/option_parsing.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/scene_builder.h"
#include "shaders/physics/collide/grid.h"

namespace scree::demos {

namespace {

constexpr std::size_t most_shown = 64;  // unless asked for
constexpr schema::Range gravities{0, 1e4};

struct Variation {
    std::string key;
    double from = 0, to = 0;
};

template <class Field>
constexpr bool is_number = std::is_same_v<decltype(Field::member), float Body::*>;

std::vector<std::string> keys_of_variations() {
    std::vector<std::string> keys{"gravity", "seed"};
    schema::for_each_field<Body>([&](const auto& field) {
        if constexpr (is_number<std::decay_t<decltype(field)>>) keys.emplace_back(field.key);
    });
    return keys;
}

void require_within(const Variation& one, const schema::Range& range, const char* unit) {
    for (const double value : {one.from, one.to})
        if (!range.holds(value)) throw UsageError("--vary " + one.key + ": " + out_of_range(value, range, unit));
}

Variation variation_of(const std::string& word) {
    const std::size_t sign = word.find('=');
    Variation made{word.substr(0, sign)};
    if (const std::string wrong = one_of(keys_of_variations())(made.key); !wrong.empty()) throw UsageError("--vary: " + wrong);
    if (made.key == "seed") {
        if (sign != word.npos) throw UsageError("--vary seed: takes no range; the seeds are those from --seed on");
        return made;
    }
    if (sign == word.npos) throw UsageError(fmt::format("--vary {0}: needs a range, such as {0}=0.2:0.8", word));
    const auto [from, to] = halves(word.substr(sign + 1), ':', "--vary", "KEY=FROM:TO");
    made.from = number_of(from, "--vary");
    made.to = number_of(to, "--vary");
    if (made.key == "gravity") require_within(made, gravities, "m/s^2");
    schema::for_each_field<Body>([&](const auto& field) {
        if constexpr (is_number<std::decay_t<decltype(field)>>)
            if (made.key == field.key) require_within(made, field.range, field.unit);
    });
    return made;
}

void vary(Scene& scene, const Variation& one, float value) {
    if (one.key == "gravity") {
        const float before = glm::length(scene.gravity);
        scene.gravity = before > 0 ? scene.gravity * (value / before) : vec3(0, -value, 0);
        return;
    }
    schema::for_each_field<Body>([&](const auto& field) {
        if constexpr (is_number<std::decay_t<decltype(field)>>)
            if (one.key == field.key)
                for (Body& body : scene.bodies) body.*field.member = value;
    });
}

}  // namespace

vec3 CopiesShown::offset(std::size_t copy) const {
    if (count < 2 || !shows(copy)) return vec3(0);
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    const std::size_t place = copy - first;
    return pitch * vec3(static_cast<float>(place % columns), 0, static_cast<float>(place / columns));
}

void add_options(CLI::App& command, CopyOptions& options) {
    const char* group = "Copies";
    command
        .add_option_function<std::string>(
            "--copies",
            [&options](const std::string& word) {
                options.copies = count_of(word, "--copies");
                if (options.copies > physics::MOST_COPIES)
                    throw CLI::ValidationError("--copies", fmt::format("must be at most {}, is {}", physics::MOST_COPIES, word));
            },
            "Number of copies of the scene, such as 1k, which are simulated at once: each to the same bits as the scene alone.")
        ->group(group);
    command
        .add_option(
            "--vary", options.vary,
            "How copies differ, from the first to the last: KEY=FROM:TO, of all bodies (friction, restitution, density and "
            "the like, in the unit of scene files) or gravity, m/s^2; seed: each copy of a demo has the next seed. Several "
            "with commas or by repeating the option.")
        ->delimiter(',')
        ->group(group);
    command.add_option("--copy", options.copy, "The copy in pictures and in --save. Default: the first ones, side by side.")
        ->group(group);
    command
        .add_option("--mosaic", options.mosaic,
                    fmt::format("Number of copies in pictures, side by side. Default: all, at most {}.", most_shown))
        ->check(CLI::Range(1, 65536))
        ->group(group);
}

void require_sense(const CLI::App& command, const CopyOptions& options) {
    if (options.copies == 0) {
        for (const char* option : {"--vary", "--copy", "--mosaic"})
            if (command.count(option) != 0)
                throw UsageError(fmt::format("{}: is of copies of the scene; add --copies N", option));
        return;
    }
    for (const char* option : {"--input", "--resume", "--checkpoint", "--channels", "--annotations", "--export"})
        if (command.count(option) != 0)
            throw UsageError(fmt::format("{}: is of one scene, not of copies; leave out --copies", option));
    if (command.count("--save") != 0 && !options.copy) throw UsageError("--save: is of one copy; say which with --copy");
    if (options.copy && *options.copy >= options.copies)
        throw UsageError(fmt::format("--copy {}: there are {} copies, from 0 on", *options.copy, options.copies));
    if (options.copy && options.mosaic) throw UsageError("--copy and --mosaic: pictures show one copy, or several");
}

void require_sense(const CopyOptions& options, const LoadedScene& subject) {
    if (options.copies == 0) return;
    if (subject.before_step)
        throw UsageError(fmt::format("--copies: {} acts on its bodies over time, which copies do not", subject.name));
    require_memory_for(subject.scene.bodies.size() * options.copies);
}

VaryCopy vary_of(const CopyOptions& options, const SceneOptions& scene) {
    std::vector<Variation> all;
    for (const std::string& word : options.vary) all.push_back(variation_of(word));
    if (all.empty()) return {};
    const bool seeds = std::any_of(all.begin(), all.end(), [](const Variation& one) { return one.key == "seed"; });
    const Demo* demo = seeds ? find_demo(scene.name) : nullptr;
    if (seeds && !demo) throw UsageError("--vary seed: is of demos; a scene file has no seed");
    return [all, demo, scene, copies = options.copies](std::size_t copy, Scene& varied) {
        if (demo) varied = build(*demo, {scene.bodies, scene.seed + copy}).scene;
        const double part = copies > 1 ? static_cast<double>(copy) / static_cast<double>(copies - 1) : 0;
        for (const Variation& one : all)
            if (one.key != "seed") vary(varied, one, static_cast<float>(one.from + part * (one.to - one.from)));
    };
}

CopiesShown shown_of(const CopyOptions& options, LoadedScene& subject) {
    CopiesShown shown;
    if (options.copies == 0) return shown;
    shown.first = options.copy.value_or(0);
    shown.count = options.copy ? 1 : std::min(options.copies, options.mosaic ? options.mosaic : most_shown);
    if (shown.count == 1) return shown;
    shown.pitch = 1.15f * (subject.high - subject.low);
    const auto across = static_cast<float>(std::ceil(std::sqrt(static_cast<double>(shown.count))));
    const float rows = std::ceil(static_cast<float>(shown.count) / across);
    subject.high += shown.pitch * vec3(across - 1, 0, rows - 1);
    subject.viewpoint = view_of(subject.low, subject.high, 35, 45);
    return shown;
}

}  // namespace scree::demos
