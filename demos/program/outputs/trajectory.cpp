// Trajectories of scree run.
#include "demos/program/outputs/trajectory.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>

#include "compute/tables/state.h"
#include "demos/program/exit_status.h"
#include "demos/program/options/option_parsing.h"
#include "demos/program/options/output_check.h"
#include "demos/program/outputs/table.h"
#include "host/files/growing_file.h"
#include "host/files/npy_file.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

// A body at a moment.
struct TrajectorySample {
    std::size_t body = 0;
    BodyState state;
    double kinetic_energy = 0, potential_energy = 0;  // J, as of Statistics
    glm::dvec3 momentum{0};                           // kg m/s
};

// What writes samples.
class Writer {
public:
    virtual ~Writer() = default;
    virtual void add(double seconds, const std::vector<TrajectorySample>& samples) = 0;
    virtual void finish() = 0;
};

class NpzWriter final : public Writer {
public:
    NpzWriter(const std::string& path, const std::vector<std::size_t>& bodies)
        : file_(path),
          time_(file_.add_array("time", "f8", {})),
          ids_(file_.add_array("body", "i8", {})),
          exists_(file_.add_array("exists", "b1", {bodies.size()})),
          position_(file_.add_array("position", "f4", {bodies.size(), 3})),
          orientation_(file_.add_array("orientation", "f4", {bodies.size(), 4})),
          velocity_(file_.add_array("velocity", "f4", {bodies.size(), 3})),
          angular_velocity_(file_.add_array("angular_velocity", "f4", {bodies.size(), 3})),
          kinetic_(file_.add_array("kinetic_energy", "f8", {bodies.size()})),
          potential_(file_.add_array("potential_energy", "f8", {bodies.size()})),
          momentum_(file_.add_array("momentum", "f8", {bodies.size(), 3})) {
        file_.append(ids_, std::vector<std::int64_t>(bodies.begin(), bodies.end()));
    }
    void add(double seconds, const std::vector<TrajectorySample>& samples) override {
        file_.append(time_, std::vector<double>{seconds});
        column<std::uint8_t>(exists_, samples,
                             [](const TrajectorySample& s) { return static_cast<std::uint8_t>(s.state.exists); });
        column<vec3>(position_, samples, [](const TrajectorySample& s) { return s.state.position; });
        column<vec4>(orientation_, samples, [](const TrajectorySample& s) { return s.state.orientation; });
        column<vec3>(velocity_, samples, [](const TrajectorySample& s) { return s.state.velocity; });
        column<vec3>(angular_velocity_, samples, [](const TrajectorySample& s) { return s.state.angular_velocity; });
        column<double>(kinetic_, samples, [](const TrajectorySample& s) { return s.kinetic_energy; });
        column<double>(potential_, samples, [](const TrajectorySample& s) { return s.potential_energy; });
        column<glm::dvec3>(momentum_, samples, [](const TrajectorySample& s) { return s.momentum; });
    }
    void finish() override { file_.finish(); }

private:
    template <class Value, class Take>
    void column(std::size_t array, const std::vector<TrajectorySample>& samples, const Take& take) {
        std::vector<Value> values(samples.size());
        std::transform(samples.begin(), samples.end(), values.begin(), take);
        file_.append(array, values);
    }
    host::NpzFile file_;
    std::size_t time_, ids_, exists_, position_, orientation_, velocity_, angular_velocity_, kinetic_, potential_, momentum_;
};

class CsvWriter final : public Writer {
public:
    CsvWriter(const std::string& path, const Scene& scene) : file_(path) {
        for (const Body& body : scene.bodies) names_.push_back(csv_text(body.name));
        file_.append(std::string_view(
            "time,body,name,exists,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz,kinetic_energy,potential_energy,px,py,pz\n"));
    }
    void add(double seconds, const std::vector<TrajectorySample>& samples) override {
        fmt::memory_buffer lines;
        for (const TrajectorySample& s : samples) {
            const BodyState& b = s.state;
            fmt::format_to(std::back_inserter(lines),
                           "{:.9g},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}\n",
                           seconds, s.body, names_[s.body], b.exists ? 1 : 0, b.position.x, b.position.y, b.position.z,
                           b.orientation.x, b.orientation.y, b.orientation.z, b.orientation.w, b.velocity.x, b.velocity.y,
                           b.velocity.z, b.angular_velocity.x, b.angular_velocity.y, b.angular_velocity.z, s.kinetic_energy,
                           s.potential_energy, s.momentum.x, s.momentum.y, s.momentum.z);
        }
        file_.append(std::string_view(lines.data(), lines.size()));
    }
    void finish() override { file_.commit(); }

private:
    host::GrowingFile file_;
    std::vector<std::string> names_;
};

std::size_t body_named(const std::string& word, const Scene& scene) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error == std::errc() && end == word.data() + word.size()) {
        if (index < scene.bodies.size()) return index;
        throw UsageError(fmt::format("--trajectory-bodies {}: the scene has {}, counted from 0", word,
                                     counted(scene.bodies.size(), "body", "bodies")));
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].name == word) return i;
        if (!scene.bodies[i].name.empty()) names.push_back(scene.bodies[i].name);
    }
    const std::string near = nearest(word, names);
    throw UsageError(fmt::format("--trajectory-bodies {}: there is no body of that name{}", word,
                                 near.empty() ? "" : ", nearest: \"" + near + "\""));
}

std::vector<std::size_t> chosen(const std::vector<std::string>& words, const Scene& scene) {
    std::vector<std::size_t> bodies;
    for (const std::string& word : words) bodies.push_back(body_named(word, scene));
    if (!words.empty()) return bodies;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (scene.bodies[i].motion != Motion::fixed) bodies.push_back(i);
    return bodies;
}

}  // namespace

struct Trajectory::Impl {
    std::vector<std::size_t> bodies;
    std::uint64_t every;
    std::unique_ptr<Writer> writer;

    // Masses, as of the step, and what they make of a state.
    struct Mass {
        double mass = 0;
        glm::dvec3 inertia{0};  // kg m^2, principal
    };
    std::vector<Mass> masses;
    std::optional<std::uint64_t> arrangements;

    void note_masses(const World& world) {
        if (arrangements == world.arrangements()) return;
        arrangements = world.arrangements();
        masses.assign(bodies.size(), {});
        const State& state = world.state();
        const auto inverse = [](float value) { return value > 0 ? 1.0 / double{value} : 0.0; };
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const physics::BodyProperties& body = state.properties[state.row_of(bodies[i])];
            masses[i] = {inverse(body.inverse_mass),
                         {inverse(body.inverse_inertia.x), inverse(body.inverse_inertia.y), inverse(body.inverse_inertia.z)}};
        }
    }
    TrajectorySample sample_of(std::size_t i, const BodyState& state, vec3 gravity) const {
        TrajectorySample sample{bodies[i], state};
        if (!state.exists) return sample;
        const Mass& mass = masses[i];
        const glm::dvec3 v(state.velocity);
        const glm::dvec3 spin(physics::rotate_back(state.orientation, state.angular_velocity));
        sample.kinetic_energy = 0.5 * (mass.mass * glm::dot(v, v) + glm::dot(spin * spin, mass.inertia));
        sample.potential_energy = -mass.mass * glm::dot(glm::dvec3(gravity), glm::dvec3(state.position));
        sample.momentum = mass.mass * v;
        return sample;
    }
};

Trajectory::Trajectory(const TrajectoryOptions& options, const World& world) : interior_(std::make_unique<Impl>()) {
    interior_->bodies = chosen(options.bodies, world.scene());
    interior_->every = static_cast<std::uint64_t>(options.every);
    if (options.file.ends_with(".npz"))
        interior_->writer = std::make_unique<NpzWriter>(options.file, interior_->bodies);
    else
        interior_->writer = std::make_unique<CsvWriter>(options.file, world.scene());
}
Trajectory::~Trajectory() = default;

int Trajectory::steps_until_due(const World& world) const {
    return static_cast<int>(interior_->every - world.steps() % interior_->every);
}

void Trajectory::after_step(const World& world) {
    Impl& in = *interior_;
    if (world.steps() % in.every != 0) return;
    in.note_masses(world);
    const std::vector<BodyState> states = world.bodies();
    std::vector<TrajectorySample> samples;
    samples.reserve(in.bodies.size());
    for (std::size_t i = 0; i < in.bodies.size(); ++i)
        samples.push_back(in.sample_of(i, states[in.bodies[i]], world.scene().gravity));
    in.writer->add(world.time(), samples);
}

void Trajectory::finish() {
    interior_->writer->finish();
}

void add_options(CLI::App& command, TrajectoryOptions& options) {
    const char* group = "Trajectory";
    command
        .add_option(
            "--trajectory", options.file,
            "Poses, velocities, energies and momenta over time: FILE.npz, numpy's arrays by time and body, or FILE.csv, a "
            "line of each moment and body.")
        ->group(group);
    command
        .add_option("--trajectory-bodies", options.bodies,
                    "Whose, by name or index, separated by commas. Default: all that may move, pieces included.")
        ->delimiter(',')
        ->expected(1)
        ->take_all()
        ->group(group);
    command.add_option("--trajectory-every", options.every, "Steps from one moment to the next. Default: 1.")
        ->check(CLI::Range(1, 1000000))
        ->group(group);
}

void require_sense(const CLI::App& command, const TrajectoryOptions& options) {
    for (const char* option : {"--trajectory-bodies", "--trajectory-every"})
        if (options.file.empty() && command.count(option) != 0)
            throw UsageError(fmt::format("{}: no trajectory is asked for; add --trajectory FILE.npz", option));
    if (options.file.empty()) {
        if (command.count("--trajectory") != 0) throw UsageError("--trajectory: the name is empty; name a file");
        return;
    }
    if (!options.file.ends_with(".npz") && !options.file.ends_with(".csv"))
        throw UsageError(
            fmt::format("--trajectory {}: a trajectory is an .npz or a .csv; name a file such as run.npz", options.file));
    require_writable_file("--trajectory", options.file);
}

}  // namespace scree::demos
