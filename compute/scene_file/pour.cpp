// Grains that come in during a run: how many are due follows from the number of steps, how many have come from the bodies' names.
// So nothing is to be kept beside the world, whichever state it is brought back to.
#include "compute/scene_file/pour.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compute/scene/random.h"
#include "compute/scene/shape_geometry.h"
#include "compute/scene_file/events.h"
#include "compute/scene_file/events_fields.h"
#include "compute/scene_file/fields_write.h"

namespace scree {

namespace {

// Balls about grains that are to come, m.
struct Ball {
    glm::dvec3 centre{0};
    double radius = 0;
};

// Finds balls that overlap, by cells as wide as the largest of them.
class Balls {
public:
    explicit Balls(double largest) : cell_(2 * largest) {}
    bool overlaps(const Ball& ball) const {
        const auto [x, y, z] = place(ball.centre);
        for (std::int64_t i = x - 1; i <= x + 1; ++i)
            for (std::int64_t j = y - 1; j <= y + 1; ++j)
                for (std::int64_t k = z - 1; k <= z + 1; ++k) {
                    const auto found = cells_.find(key(i, j, k));
                    if (found == cells_.end()) continue;
                    for (const Ball& other : found->second) {
                        const double apart = ball.radius + other.radius;
                        const glm::dvec3 way = ball.centre - other.centre;
                        if (glm::dot(way, way) < apart * apart) return true;
                    }
                }
        return false;
    }
    void add(const Ball& ball) {
        const auto [x, y, z] = place(ball.centre);
        cells_[key(x, y, z)].push_back(ball);
    }

private:
    struct Place {
        std::int64_t x, y, z;
    };
    Place place(const glm::dvec3& p) const {
        return {static_cast<std::int64_t>(std::floor(p.x / cell_)), static_cast<std::int64_t>(std::floor(p.y / cell_)),
                static_cast<std::int64_t>(std::floor(p.z / cell_))};
    }
    // Cells that share a key are looked into for nothing, no more.
    static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
        return (static_cast<std::uint64_t>(x) * 73856093u) ^ (static_cast<std::uint64_t>(y) * 19349669u) ^
               (static_cast<std::uint64_t>(z) * 83492791u);
    }
    double cell_;
    std::unordered_map<std::uint64_t, std::vector<Ball>> cells_;
};

// A point at random of the region, in which a ball of this radius is inside of it.
glm::dvec3 point_within(const GrainRegion& region, double radius, SeededRandom& random) {
    const glm::dvec3 part(random.vector(0, 1));
    if (const auto* box = std::get_if<GrainBox>(&region)) {
        const glm::dvec3 low = glm::dvec3(box->low) + radius, high = glm::dvec3(box->high) - radius;
        return low + (high - low) * part;
    }
    const auto& cylinder = std::get<GrainCylinder>(region);
    glm::dvec2 across;
    do {
        const float x = random.between(-1, 1), y = random.between(-1, 1);
        across = {x, y};
    } while (glm::dot(across, across) > 1);
    across *= static_cast<double>(cylinder.radius) - radius;
    const double height = radius + (static_cast<double>(cylinder.height) - 2 * radius) * part.y;
    return glm::dvec3(cylinder.base) + glm::dvec3(across.x, height, across.y);
}

// Whether a ball fits at all.
bool is_wide_enough(const GrainRegion& region, double radius) {
    if (const auto* box = std::get_if<GrainBox>(&region)) {
        const glm::dvec3 size = glm::dvec3(box->high) - glm::dvec3(box->low);
        return std::min({size.x, size.y, size.z}) > 2 * radius;
    }
    const auto& cylinder = std::get<GrainCylinder>(region);
    return static_cast<double>(cylinder.radius) > radius && static_cast<double>(cylinder.height) > 2 * radius;
}

double radius_of(const Body& grain) {
    return 1.0001 * static_cast<double>(bounding_radius(grain.shape));
}

// Which of the balls overlap with bodies of the world.
std::vector<bool> blocked(const std::vector<Ball>& balls, const std::vector<std::size_t>& which, const World& world) {
    std::vector<ShapeOverlap> queries;
    for (const std::size_t i : which)
        queries.push_back({.shape = Sphere{static_cast<float>(balls[i].radius)}, .position = vec3(balls[i].centre)});
    const QueryLists<QueryPart> found = world.overlaps(queries);
    std::vector<bool> all(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) all[i] = !found[i].empty();
    return all;
}

// Places for the next grains, as many as find room, in their order: one behind a grain without room waits with it.
std::vector<Body> with_room(const GrainSupply& supply, std::size_t next, std::size_t end, const World& world) {
    constexpr int rounds = 8, tries = 40;
    const Grains& grains = supply.description();
    SeededRandom random(grains.seed, 0x900000000u + next);
    std::vector<Body> bodies;
    std::vector<Ball> balls;
    std::vector<std::size_t> waiting;
    Balls settled(1.001 * supply.largest_reach());
    const auto find_room = [&](Ball& ball, const Balls& others) {
        for (int i = 0; i < tries; ++i) {
            ball.centre = glm::dvec3(vec3(point_within(grains.region, ball.radius, random)));
            if (!others.overlaps(ball)) return true;
        }
        return false;
    };
    for (int round = 0; round < rounds && (round == 0 || !waiting.empty()); ++round) {
        Balls tried = settled;
        std::vector<std::size_t> found;
        const auto look = [&](std::size_t i) {
            const bool has_room = find_room(balls[i], tried);
            if (has_room) {
                tried.add(balls[i]);
                found.push_back(i);
            } else {
                bodies.resize(std::min(bodies.size(), i));
            }
            return has_room;
        };
        if (round == 0) {
            for (std::size_t i = next; i < end; ++i) {
                bodies.push_back(supply.grain(i));
                balls.push_back({glm::dvec3(0), radius_of(bodies.back())});
                if (!look(balls.size() - 1)) break;
            }
        } else {
            for (const std::size_t i : waiting)
                if (i >= bodies.size() || !look(i)) break;
        }
        const std::vector<bool> in_the_way = blocked(balls, found, world);
        waiting.clear();
        for (std::size_t k = 0; k < found.size(); ++k) {
            if (in_the_way[k])
                waiting.push_back(found[k]);
            else
                settled.add(balls[found[k]]);
        }
    }
    if (!waiting.empty()) bodies.resize(std::min(bodies.size(), waiting.front()));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies[i].name = name_of_poured(grains) + " " + std::to_string(next + i);
        bodies[i].position = vec3(balls[i].centre);
    }
    return bodies;
}

// How many grains have come by a time since the beginning, s, if there is room.
std::size_t due(const GrainSupply& supply, double time) {
    const Grains& grains = supply.description();
    constexpr double rounding = 1 + 1e-9;
    if (grains.count_rate > 0) {
        const double count =
            static_cast<double>(grains.from) + std::floor(time * static_cast<double>(grains.count_rate) * rounding);
        return static_cast<std::size_t>(std::min(count, static_cast<double>(supply.count())));
    }
    const double mass = supply.mass_before(grains.from) + time * static_cast<double>(grains.mass_rate) * rounding;
    std::size_t low = grains.from, high = supply.count();
    while (low < high) {
        const std::size_t middle = low + (high - low + 1) / 2;
        if (supply.mass_before(middle) <= mass)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

}  // namespace

std::string name_of_poured(const Grains& grains) {
    return grains.name.empty() ? "grain" : grains.name;
}

std::shared_ptr<const GrainSupply> supply_of(const Grains& grains, const std::string& place, std::size_t most) {
    static std::mutex mutex;
    static std::deque<std::pair<std::string, std::shared_ptr<const GrainSupply>>> known;
    constexpr std::size_t most_known = 8;
    check_grains(grains, place);
    Text text;
    write_value(text, grains);
    const std::string key = text.take();
    const auto find = [&]() -> std::shared_ptr<const GrainSupply> {
        for (const auto& [described, supply] : known)
            if (described == key) return supply;
        return nullptr;
    };
    {
        const std::lock_guard lock(mutex);
        if (auto found = find()) return found;
    }
    auto made = std::make_shared<const GrainSupply>(grains, place, most);
    const double largest = made->largest_reach();
    if (grains.poured() && !is_wide_enough(grains.region, 1.0001 * largest))
        throw SceneError(place + "/region", "is too narrow for the largest of its grains, which needs " +
                                                text_of(static_cast<float>(2 * largest)) + " m along each axis");
    if (grains.from > made->count()) throw SceneError(place + "/from", "there are " + std::to_string(made->count()) + " grains");
    const std::lock_guard lock(mutex);
    if (auto found = find()) return found;
    known.emplace_front(key, made);
    if (known.size() > most_known) known.pop_back();
    return made;
}

std::size_t poured(const Grains& grains, const Scene& scene) {
    const std::string start = name_of_poured(grains) + " ";
    std::size_t count = grains.from;
    for (const Body& body : scene.bodies) {
        if (!body.name.starts_with(start)) continue;
        std::size_t number = 0;
        const char* const end = body.name.data() + body.name.size();
        const auto [rest, error] = std::from_chars(body.name.data() + start.size(), end, number);
        if (error == std::errc() && rest == end) count = std::max(count, number + 1);
    }
    return count;
}

void pour_due(const Grains& grains, double start, World& world) {
    const double rate = static_cast<double>(world.settings().rate);
    const auto first = static_cast<std::uint64_t>(std::llround(start * rate));
    const auto between = static_cast<std::uint64_t>(std::max(1LL, std::llround(static_cast<double>(grains.interval) * rate)));
    if (world.steps() < first || (world.steps() - first) % between != 0) return;
    const std::shared_ptr<const GrainSupply> supply = supply_of(grains, "/grains");
    const double time = static_cast<double>((world.steps() - first) / between + 1) * static_cast<double>(between) / rate;
    const std::size_t next = poured(grains, world.scene()), end = due(*supply, time);
    if (next >= end) return;
    const std::vector<Body> bodies = with_room(*supply, next, end, world);
    if (!bodies.empty()) world.add_bodies(bodies);
}

}  // namespace scree
