// Grains: a supply whose every beginning follows the sieve curve, and its places at the start.
#include "compute/grains.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "compute/scene/double_quaternion.h"
#include "compute/scene/error_reason.h"
#include "compute/scene/grains/grain_shapes.h"
#include "compute/scene/grains/grain_stacks.h"
#include "compute/scene/portable_math.h"
#include "compute/scene/random.h"
#include "compute/scene/shape_geometry.h"
#include "compute/schema/range_text.h"

namespace scree {

namespace {

constexpr std::size_t most_grains = 100'000'000;
constexpr double curve_tolerance = 1;  // % of the mass, of a curve

// Grains of one shape and one interval of the curve: their part of the mass, and what comes next.
struct GrainClass {
    std::uint32_t shape = 0;
    double low = 0, high = 0;  // m
    double part = 0;           // of the mass
    double given = 0;          // kg so far
    double next_size = 0, next_mass = 0;
    std::uint32_t next_form = 0;
    double phase = 0;  // of the sequence of sizes, 0 to 1
    std::uint32_t first_form = 0;
};

// Rounded on the host alone, and the same everywhere: only operations that IEEE 754 rounds exactly.
double cubed_size(double x) {
    return x * x * x;
}

double top_of(const GrainRegion& region) {
    return static_cast<double>(box_about(region).high.y);
}

struct GrainExtent {
    glm::dvec3 low{0}, high{0};
};
GrainExtent extent_of(const Body& body) {
    const glm::dquat back = glm::conjugate(glm::normalize(double_quaternion(body.orientation)));
    GrainExtent box;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 along(0);
        along[axis] = 1;
        const glm::dvec3 inside = back * along;
        box.high[axis] = reach_along(body.shape, inside);
        box.low[axis] = -reach_along(body.shape, -inside);
    }
    return box;
}

}  // namespace

struct GrainSupply::Impl {
    Grains asked;
    std::string where;
    std::vector<float> sizes;
    std::vector<std::uint32_t> forms;           // of grains: of hulls the form of that size, else the shape
    std::vector<double> before{0};              // kg, of the grains before each, and of all
    std::vector<std::vector<UnitGrain>> units;  // by shape
    struct Form {
        Shape shape;       // of a hull: of its size, checked
        bool unit = true;  // to be scaled
    };
    std::vector<Form> made;
    double highest = 0, reach = 0;  // m

    void make_classes(std::vector<GrainClass>& classes);
    void prepare(GrainClass& one);
    Shape shape_of(std::size_t index) const;
};

// Sizes of a hull are the middles of parts of the interval, each with every variant of the family.
void GrainSupply::Impl::make_classes(std::vector<GrainClass>& classes) {
    std::vector<GrainShape> shapes = asked.shapes;
    if (shapes.empty()) shapes.emplace_back();
    std::vector<SievePoint> curve = asked.sieve;
    if (curve.empty()) curve = {{asked.size, 0}, {asked.size, 100}};
    double all = 0;
    for (const GrainShape& shape : shapes) all += static_cast<double>(shape.share);
    for (std::uint32_t s = 0; s < shapes.size(); ++s) {
        const std::string place = where + "/shapes/" + std::to_string(s) + "/form";
        units.push_back(unit_grains(shapes[s].form, asked.seed + s, place));
        for (std::size_t i = 1; i < curve.size(); ++i) {
            const double passing = static_cast<double>(curve[i].passing) - static_cast<double>(curve[i - 1].passing);
            if (passing == 0) continue;
            GrainClass one{s, static_cast<double>(curve[i - 1].size), static_cast<double>(curve[i].size)};
            one.part = 0.01 * passing * static_cast<double>(shapes[s].share) / all;
            SeededRandom random(asked.seed, 0xC0000000u + classes.size());
            one.phase = static_cast<double>(random.unit());
            one.first_form = static_cast<std::uint32_t>(made.size());
            Scene scene;
            if (std::holds_alternative<Hull>(units[s].front().shape)) {
                for (int k = 0; k < (one.low == one.high ? 1 : hull_sizes); ++k)
                    for (const UnitGrain& unit : units[s])
                        scene.bodies.push_back(
                            {.shape = scaled(unit, one.low * portable::pow(one.high / one.low, (k + 0.5) / hull_sizes))});
            } else {  // the smallest and the largest are checked
                for (const double size : {one.low, one.high}) scene.bodies.push_back({.shape = scaled(units[s].front(), size)});
            }
            try {
                scene = checked(std::move(scene));
            } catch (const SceneError& error) {
                throw SceneError(place, "a grain of this shape and a size of " + plain(one.low) + " to " + plain(one.high) +
                                            " m cannot be: " + reason_of(error));
            }
            for (const Body& body : scene.bodies) reach = std::max(reach, static_cast<double>(bounding_radius(body.shape)));
            if (std::holds_alternative<Hull>(units[s].front().shape))
                for (Body& body : scene.bodies) made.push_back({std::move(body.shape), false});
            else
                made.push_back({units[s].front().shape, true});
            classes.push_back(one);
        }
    }
}

// The next grain of a class. Mass is spread evenly over the logarithm of size, hence numbers as size^-3; of these the golden
// ratio's multiples take even parts.
void GrainSupply::Impl::prepare(GrainClass& one) {
    constexpr double golden = 0.6180339887498949, inside = 1e-4;
    one.phase += golden;
    if (one.phase >= 1) one.phase -= 1;
    const double u = std::clamp(one.phase, inside, 1 - inside);
    const double small = 1 / cubed_size(one.low), large = 1 / cubed_size(one.high);
    double size = one.low;
    if (one.low != one.high) size = std::max(portable::cbrt(1 / (small + (large - small) * u)), one.low * (1 + 1e-6));
    const std::vector<UnitGrain>& family = units[one.shape];
    std::size_t variant = 0;
    one.next_form = one.first_form;
    if (!made[one.first_form].unit) {
        variant = sizes.size() % family.size();
        int step = 0;
        if (one.low != one.high) {
            step = std::clamp(static_cast<int>(hull_sizes * portable::log(size / one.low) / portable::log(one.high / one.low)), 0,
                              hull_sizes - 1);
            size = one.low * portable::pow(one.high / one.low, (step + 0.5) / hull_sizes);
        }
        one.next_form += static_cast<std::uint32_t>(static_cast<std::size_t>(step) * family.size() + variant);
    }
    one.next_size = size;
    one.next_mass = family[variant].volume * cubed_size(size) * static_cast<double>(asked.density);
}

Shape GrainSupply::Impl::shape_of(std::size_t index) const {
    const Form& form = made[forms[index]];
    return form.unit ? scaled({form.shape, 0}, static_cast<double>(sizes[index])) : form.shape;
}

GrainSupply::GrainSupply(const Grains& grains, const std::string& place, std::size_t most) : impl_(std::make_unique<Impl>()) {
    check_grains(grains, place);
    most = std::min(most, most_grains);
    Impl& in = *impl_;
    in.asked = grains;
    in.where = place;
    std::vector<GrainClass> classes;
    in.make_classes(classes);
    for (GrainClass& one : classes) in.prepare(one);
    const double asked = grains.fill > 0
                             ? static_cast<double>(grains.fill) * volume_of(grains.region) * static_cast<double>(grains.density)
                             : static_cast<double>(grains.mass);
    const auto refuse = [&] {
        throw SceneError(
            place, "these are more than " + std::to_string(most) +
                       " grains, which is what fits into the memory here, or may be in one scene; ask for fewer or larger ones");
    };
    double least = 0;  // number of grains, if all were as heavy as can be
    for (const GrainClass& one : classes) {
        double volume = 0;
        for (const UnitGrain& unit : in.units[one.shape]) volume = std::max(volume, unit.volume);
        least += asked * one.part / (volume * cubed_size(one.high) * static_cast<double>(grains.density));
    }
    if (grains.count > most || least > static_cast<double>(most)) refuse();
    // That which is furthest behind its part of the mass, judged with half of its next grain.
    const auto standing = [](const GrainClass& one) { return (one.given + 0.5 * one.next_mass) / one.part; };
    using Turn = std::pair<double, std::size_t>;
    std::priority_queue<Turn, std::vector<Turn>, std::greater<>> turns;
    for (std::size_t i = 0; i < classes.size(); ++i) turns.emplace(standing(classes[i]), i);
    while (grains.count == 0 || in.sizes.size() < grains.count) {
        const std::size_t index = turns.top().second;
        GrainClass& next = classes[index];
        if (grains.count == 0 && !in.sizes.empty() && in.before.back() + 0.5 * next.next_mass > asked) break;
        if (in.sizes.size() == most) refuse();
        turns.pop();
        in.sizes.push_back(static_cast<float>(next.next_size));
        in.forms.push_back(next.next_form);
        in.before.push_back(in.before.back() + next.next_mass);
        next.given += next.next_mass;
        in.prepare(next);
        turns.emplace(standing(next), index);
    }
}

GrainSupply::~GrainSupply() = default;
GrainSupply::GrainSupply(GrainSupply&&) noexcept = default;
GrainSupply& GrainSupply::operator=(GrainSupply&&) noexcept = default;

const Grains& GrainSupply::description() const {
    return impl_->asked;
}
std::size_t GrainSupply::count() const {
    return impl_->sizes.size();
}
double GrainSupply::mass() const {
    return impl_->before.back();
}
double GrainSupply::mass_before(std::size_t index) const {
    return impl_->before.at(index);
}
double GrainSupply::sieve_size(std::size_t index) const {
    return static_cast<double>(impl_->sizes.at(index));
}

double GrainSupply::largest_reach() const {
    return impl_->reach;
}

Body GrainSupply::grain(std::size_t index) const {
    const Impl& in = *impl_;
    SeededRandom random(in.asked.seed, index);
    Body body;
    if (!in.asked.name.empty()) body.name = in.asked.name + " " + std::to_string(index);
    body.shape = in.shape_of(index);
    const vec4 turn = random.orientation();
    body.orientation = single_quaternion(glm::normalize(double_quaternion(turn)));
    body.density = in.asked.density;
    set_material(body, in.asked.material);
    body.rolling_resistance += static_cast<float>(0.5 * sieve_size(index) * static_cast<double>(in.asked.rolling));
    body.velocity = in.asked.velocity;
    body.color = in.asked.color;
    return body;
}

void GrainSupply::place(const std::function<void(Body)>& take) const {
    Impl& in = *impl_;
    double largest = 0;
    for (std::size_t i = 0; i < count(); ++i) {
        const GrainExtent box = extent_of(grain(i));
        const glm::dvec3 size = box.high - box.low;
        largest = std::max({largest, size.x, size.y, size.z});
    }
    GrainStacks stacks(in.asked.region, largest, in.asked.seed);
    for (std::size_t i = 0; i < count(); ++i) {
        Body body = grain(i);
        const GrainExtent box = extent_of(body);
        const glm::dvec3 size = box.high - box.low;
        const std::optional<GrainStacks::Place> place = stacks.put(size);
        if (!place)
            throw SceneError(in.where + "/region", "is too narrow for its largest grain, which is " + plain(largest) + " m long");
        SeededRandom random(in.asked.seed, 0x7000000000u + i);
        body.position = vec3(place->low - box.low + (place->size - size) * glm::dvec3(random.vector(0, 1)));
        in.highest = std::max(in.highest, static_cast<double>(body.position.y) + box.high.y);
        take(std::move(body));
    }
}

double GrainSupply::top() const {
    return std::max(top_of(impl_->asked.region), impl_->highest);
}

std::vector<double> GrainSupply::passing() const {
    std::vector<double> found;
    for (const SievePoint& point : impl_->asked.sieve) {
        double mass = 0;
        for (std::size_t i = 0; i < count(); ++i)
            if (impl_->sizes[i] <= point.size) mass += impl_->before[i + 1] - impl_->before[i];
        found.push_back(100 * mass / this->mass());
    }
    return found;
}

double GrainSupply::error() const {
    const std::vector<SievePoint>& curve = impl_->asked.sieve;
    std::vector<double> sizes, asked;  // also between the points of the curve, where hulls have sizes on both sides
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const double low = static_cast<double>(curve[i - 1].size), high = static_cast<double>(curve[i].size);
        const double before = static_cast<double>(curve[i - 1].passing), after = static_cast<double>(curve[i].passing);
        for (int k = 1; k <= hull_sizes; ++k) {
            const double part = static_cast<double>(k) / hull_sizes;
            sizes.push_back(k == hull_sizes ? high : low * portable::pow(high / low, part));
            asked.push_back(before + part * (after - before));
        }
    }
    std::vector<double> masses(sizes.size() + 1, 0);
    for (std::size_t i = 0; i < count(); ++i) {
        const auto at = std::lower_bound(sizes.begin(), sizes.end(), sieve_size(i)) - sizes.begin();
        masses[static_cast<std::size_t>(at)] += impl_->before[i + 1] - impl_->before[i];
    }
    double most = 0, below = 0;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        below += masses[k];
        most = std::max(most, std::abs(100 * below / mass() - asked[k]));
    }
    return most;
}

std::vector<std::string> GrainSupply::notes() const {
    std::vector<std::string> told;
    const auto rounded = [](double value) { return plain(std::round(value * 100) / 100); };
    if (const double off = error(); off > curve_tolerance)
        told.push_back(impl_->where + ": " + std::to_string(count()) + " grains miss the sieve curve by " + rounded(off) +
                       " % of the mass; more grains follow it within 1 %");
    const double own = top_of(impl_->asked.region);
    if (impl_->highest > own)
        told.push_back(impl_->where + ": the grains begin apart from one another, up to a height of " + rounded(impl_->highest) +
                       " m, above the region's " + rounded(own) + " m");
    return told;
}

}  // namespace scree
