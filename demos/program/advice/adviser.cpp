// The adviser of runs.
#include "demos/program/advice/adviser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

#include "compute/compile/scene_compiler.h"
#include "compute/scene/shape_geometry.h"
#include "compute/scene/validation/body_validation.h"

namespace scree::demos {

namespace {

// Bodies at rest that press into each other for two seconds by this part of a typical half width: contacts are too soft for the
// load. Stacks that stand measure less than half of it; tall masonry buckles soon above it.
constexpr double deep = 0.06;
constexpr std::uint64_t early_looks[] = {1, 5};  // steps from the start, before what cannot stand has fallen
constexpr double worth_telling = 0.2;            // of the greatest kinetic energy: elastic impacts gain less
constexpr double soft = 0.005;                   // of the height, by which what is too heavy sinks and rises
constexpr double restless_speed = 0.3;           // m/s, of a scene at rest but for jitter

double median_of(std::vector<float> widths) {
    if (widths.empty()) return 0;
    const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
    std::nth_element(widths.begin(), middle, widths.end());
    return static_cast<double>(*middle);
}

// "--substeps 16", twice the present, or a higher rate once substeps are many.
std::string finer(const Settings& settings) {
    if (settings.substeps <= 16) return fmt::format("--substeps {}", 2 * settings.substeps);
    return fmt::format("--rate {:g}", 2 * settings.rate);
}

// "body 9 (\"roof\")"
std::string told(const World& world, std::size_t body) {
    const std::string& name = world.scene().bodies.at(body).name;
    return name.empty() ? fmt::format("body {}", body) : fmt::format("body {} (\"{}\")", body, name);
}

Advice advice_on(const Burden& burden, const World& world) {
    const Settings& settings = world.settings();
    const std::string options = options_for(burden.substeps_a_second, static_cast<double>(settings.rate));
    return {fmt::format("{} bears {:.3g} times its own weight, {} among it; with {} substeps at {:g} Hz it is crushed, or what "
                        "stands on it falls",
                        told(world, burden.body), burden.ratio, told(world, burden.heaviest), settings.substeps, settings.rate),
            options.empty() ? "no setting holds that; make what bears heavier, or what lies on it lighter"
                            : options + " should hold that"};
}

Advice advice_on(const std::vector<Quarantine>& stopped, const World& world) {
    std::string which;
    for (std::size_t i = 0; i < std::min<std::size_t>(stopped.size(), 3); ++i) {
        const Quarantine& one = stopped[i];
        which +=
            fmt::format("{}{} in step {}, found by {}", which.empty() ? "" : "; ", told(world, one.body), one.step, one.stage);
        if (one.joints > 0) which += fmt::format(", on {} joint{}", one.joints, one.joints == 1 ? "" : "s");
    }
    if (stopped.size() > 3) which += "; ...";
    return {fmt::format("{} {} no longer finite and in quarantine, at rest where they last were: {}", stopped.size(),
                        stopped.size() == 1 ? "body is" : "bodies are", which),
            "give them masses, sizes, speeds, springs and distances that are less extreme, or " + finer(world.settings())};
}

// Axes with what may store or give energy.
template <class Visit>
void for_each_spring(const Joint& joint, Visit&& visit) {
    if (const auto* hinge = std::get_if<Hinge>(&joint.kind)) visit(JointAxis::twist, hinge->turn.spring, hinge->turn.motor);
    if (const auto* slider = std::get_if<Slider>(&joint.kind)) visit(JointAxis::x, slider->slide.spring, slider->slide.motor);
    if (const auto* distance = std::get_if<Distance>(&joint.kind)) visit(JointAxis::x, distance->spring, std::optional<Motor>());
    const auto* six = std::get_if<SixDof>(&joint.kind);
    if (!six) return;
    const Axis* axes[] = {&six->x, &six->y, &six->z, &six->twist, &six->swing_y, &six->swing_z};  // by JointAxis
    for (int i = 0; i < 6; ++i) visit(static_cast<JointAxis>(i), axes[i]->spring, axes[i]->motor);
}

// Whether something gives energy to bodies: what moves by itself, motors, engines, and springs that are motors (of a limited
// force, or of an angle of six degrees, which may jump where it has turned half way around). Gravity and other springs store
// energy, which is counted.
bool is_driving(const Body& body) {
    const auto moves = [](vec3 v) { return glm::dot(v, v) > 0; };
    return (body.motion == Motion::kinematic && (moves(body.velocity) || moves(body.angular_velocity))) ||
           moves(body.surface_velocity);
}
bool is_driven_by_more(const Scene& scene) {
    const auto gives = [](const Joint& joint) {
        const bool is_hinge = std::holds_alternative<Hinge>(joint.kind);
        bool any = false;
        for_each_spring(joint, [&](JointAxis axis, const std::optional<Spring>& spring, const std::optional<Motor>& motor) {
            any |=
                motor.has_value() || (spring && spring->speed != 0) ||
                (spring && spring->stiffness > 0 && (spring->max_force < unlimited || (axis >= JointAxis::twist && !is_hinge)));
        });
        return any;
    };
    return scene.fields.any() || !scene.vehicles.empty() || std::ranges::any_of(scene.joints, gives);
}

bool has_spring(const Joint& joint) {
    bool any = false;
    for_each_spring(joint, [&](JointAxis, const std::optional<Spring>& spring, const std::optional<Motor>&) {
        any |= spring && spring->stiffness > 0;
    });
    return any;
}

struct Stored {
    double energy = 0;  // J, of springs
    double unsure = 0;  // J, by which it may be wrong, as coordinates are rounded
};

Stored stored_in_springs(const World& world) {
    const std::vector<Joint>& joints = world.scene().joints;
    Stored found;
    const std::vector<JointState> states = world.joints();
    const std::vector<BodyState> bodies = world.bodies();
    const auto reach = [&](std::size_t body) {
        return body == the_world ? 0.0 : static_cast<double>(glm::length(bodies.at(body).position));
    };
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (states[i].broken) continue;
        for_each_spring(joints[i], [&](JointAxis axis, const std::optional<Spring>& spring, const std::optional<Motor>&) {
            if (!spring) return;
            const double stretch = static_cast<double>(states[i].coordinates[static_cast<std::size_t>(axis)] - spring->rest);
            const double rounding = 1e-6 * (1 + reach(joints[i].a) + reach(joints[i].b) + std::abs(stretch) +
                                            static_cast<double>(std::abs(spring->rest)));
            const double stiffness = static_cast<double>(spring->stiffness);
            found.energy += 0.5 * stiffness * stretch * stretch;
            found.unsure += stiffness * rounding * (std::abs(stretch) + rounding);
        });
    }
    return found;
}

}  // namespace

Adviser::Adviser(const World& world, bool commanded, bool sees_contacts)
    : Adviser(world, commanded, sees_contacts, world.scene(),
              [&](const VisitBody& visit) { std::ranges::for_each(world.scene().bodies, visit); }) {}

Adviser::Adviser(const World& world, const StreamedScene& scene, bool commanded, bool sees_contacts)
    : Adviser(world, commanded, sees_contacts, scene.scene, [&](const VisitBody& visit) {
          BodyValidation validation;  // makes the forms of hulls
          std::size_t index = 0;
          scene.for_each_body([&](Body body) {
              validation.check_passing(body, index++);
              visit(body);
          });
      }) {}

Adviser::Adviser(const World& world, bool commanded, bool sees_contacts, const Scene& scene,
                 const std::function<void(const VisitBody&)>& for_each_body)
    : sees_contacts_(sees_contacts),
      has_springs_(std::ranges::any_of(scene.joints, has_spring)),
      steps_between_(static_cast<std::uint64_t>(std::max(1L, std::lround(world.settings().rate)))) {
    std::vector<float> half_widths;
    bool is_driven = is_driven_by_more(scene);
    for_each_body([&](const Body& body) {
        is_driven |= is_driving(body);
        if (body.motion == Motion::dynamic) half_widths.push_back(least_half_width(body.shape));
    });
    closed_ = !commanded && !is_driven;
    dynamic_ = half_widths.size();
    half_width_ = median_of(std::move(half_widths));
}

Adviser::Sample Adviser::sample_of(const World& world, const Statistics& statistics) const {
    return {world.time(), statistics.penetration_resting, statistics.max_speed, statistics.asleep};
}

void Adviser::after_step(const World& world) {
    const bool second = world.steps() % steps_between_ == 0;
    if (second) {
        const Statistics statistics = world.statistics();
        samples_.push_back(sample_of(world, statistics));
        if (closed_) look_at_energy(world, statistics);
    }
    if (second || std::ranges::find(early_looks, world.steps()) != std::end(early_looks)) look_at_burdens(world);
}

// From the least so far: what falls, slides and breaks loses energy. Overlapping bodies are pushed apart in the first second, and
// soft contacts under a great weight give back what they took: a gain without cause is one that moves bodies.
void Adviser::look_at_energy(const World& world, const Statistics& statistics) {
    const Stored springs = has_springs_ ? stored_in_springs(world) : Stored{};
    const double energy = statistics.kinetic_energy + statistics.potential_energy + springs.energy;
    const double given_back = soft * std::abs(statistics.potential_energy) + springs.unsure;
    least_ = samples_.size() == 1 ? energy : std::min(least_, energy);
    const double gain = std::min(energy - least_ - given_back, statistics.kinetic_energy);
    if (samples_.size() > 1 && gain > worth_telling * moved_with_ && gain > gained_) gained_ = gain, gained_at_ = world.time();
    if (gained_ == 0) moved_with_ = std::max(moved_with_, statistics.kinetic_energy);
}

// What lasts from one look to the next: what falls and rolls bears much for a moment.
void Adviser::look_at_burdens(const World& world) {
    if (!sees_contacts_) return;
    std::vector<Burden> now = overburdened(world);
    for (const Burden& one : now) {
        const auto before = std::ranges::find(burdens_, one.body, &Burden::body);
        if (before == burdens_.end()) continue;
        const Burden& greater = one.ratio < before->ratio ? *before : one;
        if (!burden_ || greater.substeps_a_second > burden_->substeps_a_second) burden_ = greater;
    }
    burdens_ = std::move(now);
}

int Adviser::steps_to_next(const World& world) const {
    const std::uint64_t to_second = steps_between_ - world.steps() % steps_between_;
    const auto* early = std::ranges::upper_bound(early_looks, world.steps());
    return static_cast<int>(early == std::end(early_looks) ? to_second : std::min(*early - world.steps(), to_second));
}

std::vector<Advice> Adviser::advice(const World& world, const Statistics& last) const {
    std::vector<Advice> all;
    const Settings& settings = world.settings();
    std::vector<Sample> samples = samples_;
    if (samples.empty() || samples.back().time < world.time()) samples.push_back(sample_of(world, last));
    // Lasting penetration of what rests: what falls or rolls passes through moments of more.
    const Sample* worst = nullptr;
    double lasting = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double both = std::min(samples[i - 1].penetration, samples[i].penetration);
        if (both > lasting) lasting = both, worst = &samples[i];
    }
    if (burden_) all.push_back(advice_on(*burden_, world));
    if (!burden_ && worst && lasting > deep * half_width_) {
        all.push_back(
            {fmt::format("contacts give way: {:.3g} mm of penetration at {:.3g} s, {:.0f}% of a typical body's half width; "
                         "tall stacks may buckle",
                         lasting * 1e3, worst->time, 100 * lasting / half_width_),
             finer(settings) + " makes contacts four times as stiff"});
    }
    const std::vector<Quarantine> stopped = world.quarantines();
    if (!stopped.empty()) all.push_back(advice_on(stopped, world));
    if (gained_ > 0) {
        all.push_back(
            {fmt::format("energy grew without a cause, by {:.3g} J until {:.3g} s, where bodies had moved with at most "
                         "{:.3g} J: neither springs nor motors, what moves by itself, vehicles, wind, water or commands gave it",
                         gained_, gained_at_, moved_with_),
             finer(settings) + " keeps energy better"});
    }
    if (last.spin_limited > 0) {
        all.push_back(
            {fmt::format("the limit of rotation, {:.3g} rad a substep, was reached {} times: bodies turn slower than they "
                         "should",
                         settings.max_turn, last.spin_limited),
             finer(settings) + " raises the limit"});
    }
    if (last.max_speed > 0.999 * static_cast<double>(settings.max_speed)) {
        all.push_back({fmt::format("the limit of speed, {:g} m/s, was reached", settings.max_speed),
                       "\"settings\": {\"max_speed\": ...} in the scene file raises it"});
    }
    const bool may_sleep = settings.sleeping && dynamic_ > 0 && samples.size() >= 3;
    const auto restless = [&](const Sample& sample) {
        return sample.speed > static_cast<double>(settings.sleep_speed) && sample.speed < restless_speed &&
               sample.asleep * 2 < dynamic_;
    };
    if (may_sleep && std::all_of(samples.end() - 3, samples.end(), restless)) {
        all.push_back({fmt::format("for two seconds nothing was faster than {:.2g} m/s, yet only {} of {} bodies sleep",
                                   restless_speed, last.asleep, dynamic_),
                       finer(settings) + " calms jitter; rolling_resistance stops what rolls on"});
    }
    return all;
}

}  // namespace scree::demos
