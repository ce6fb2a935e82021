// Bonds by proximity: pairs of near bodies from a grid of their centres.
#include "compute/bonds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "compute/scene/error_reason.h"
#include "compute/scene/portable_math.h"
#include "compute/scene/validation/bond_validation.h"
#include "compute/scene/validation/validator.h"
#include "compute/schema/bonding.h"
#include "compute/schema/check.h"

namespace scree {

namespace {

bool is_called_by(const std::string& name, const std::string& wanted) {
    if (wanted.empty() || name == wanted) return true;
    return name.size() > wanted.size() + 1 && name.starts_with(wanted) && name[wanted.size()] == ' ' &&
           std::all_of(name.begin() + static_cast<std::ptrdiff_t>(wanted.size()) + 1, name.end(),
                       [](char c) { return c >= '0' && c <= '9'; });
}

struct NearBall {
    std::size_t body;
    glm::dvec3 centre;
    double radius;
};
using BallCell = std::array<std::int64_t, 3>;

}  // namespace

std::size_t add_bonds(Scene& scene, const Bonding& bonding, const std::string& place) {
    try {
        Bonding values = bonding;
        schema::check_fields(Examination{}, values);
    } catch (const SceneError& error) {
        throw SceneError(place + error.pointer, reason_of(error));
    }
    const bool balls_only = std::all_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& body) {
        return std::holds_alternative<Sphere>(body.shape) || std::holds_alternative<Plane>(body.shape);
    });
    Scene proper;  // where hulls and compounds have their centres of mass
    if (!balls_only) {
        proper.bodies = scene.bodies;
        proper = checked(std::move(proper));
    }
    const std::vector<Body>& bodies = balls_only ? scene.bodies : proper.bodies;
    const std::string &first = bonding.bodies, &second = bonding.with.empty() ? bonding.bodies : bonding.with;
    std::vector<NearBall> balls;
    std::vector<std::uint8_t> groups;
    bool any_first = false, any_second = false;
    double widest = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const bool in_first = is_called_by(bodies[i].name, first), in_second = is_called_by(bodies[i].name, second);
        any_first |= in_first;
        any_second |= in_second;
        const double radius = in_first || in_second ? radius_as_ball(bodies[i]) : 0;
        if (!(radius > 0)) continue;
        balls.push_back({i, glm::dvec3(bodies[i].position), radius});
        groups.push_back(static_cast<std::uint8_t>((in_first ? 1 : 0) | (in_second ? 2 : 0)));
        widest = std::max(widest, radius);
    }
    if (!any_first) throw SceneError(place + "/bodies", "no body is called \"" + first + "\" or \"" + first + " 0\"");
    if (!any_second) throw SceneError(place + "/with", "no body is called \"" + second + "\" or \"" + second + " 0\"");
    const double width = (2 + static_cast<double>(bonding.gap)) * widest * 1.000001;
    const auto cell_of = [&](const glm::dvec3& at) {
        return BallCell{static_cast<std::int64_t>(std::floor(at.x / width)), static_cast<std::int64_t>(std::floor(at.y / width)),
                        static_cast<std::int64_t>(std::floor(at.z / width))};
    };
    std::map<BallCell, std::vector<std::size_t>> cells;
    std::set<std::pair<std::size_t, std::size_t>> bonded;
    for (const Bond& one : scene.bonds) bonded.insert(std::minmax(one.a, one.b));
    for (std::size_t i = 0; i < balls.size(); ++i) {
        for (const double x : {balls[i].centre.x, balls[i].centre.y, balls[i].centre.z})
            if (!(std::abs(x) <= 1e6))
                throw SceneError("/bodies/" + std::to_string(balls[i].body) + "/position", "must be within 1000000 m of 0");
        cells[cell_of(balls[i].centre)].push_back(i);
    }
    const std::size_t before = scene.bonds.size();
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const NearBall& a = balls[i];
        const BallCell cell = cell_of(a.centre);
        near.clear();
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z)
                    if (const auto found = cells.find({cell[0] + x, cell[1] + y, cell[2] + z}); found != cells.end())
                        for (const std::size_t k : found->second)
                            if (k > i) near.push_back(k);
        std::sort(near.begin(), near.end());
        for (const std::size_t k : near) {
            const NearBall& b = balls[k];
            const bool wanted = ((groups[i] & 1) && (groups[k] & 2)) || ((groups[i] & 2) && (groups[k] & 1));
            const double least = std::min(a.radius, b.radius),
                         reach = a.radius + b.radius + static_cast<double>(bonding.gap) * least;
            const glm::dvec3 apart = b.centre - a.centre;
            const double squared = glm::dot(apart, apart);
            const bool moves = bodies[a.body].motion == Motion::dynamic || bodies[b.body].motion == Motion::dynamic;
            if (!wanted || !moves || squared > reach * reach || !(squared > 0)) continue;
            if (!bonded.insert({a.body, b.body}).second) continue;
            Bond bond;
            bond.a = a.body;
            bond.b = b.body;
            bond.radius = static_cast<float>(static_cast<double>(bonding.radius) * least);
            bond.stiffness = bonding.stiffness;
            bond.damping = bonding.damping;
            bond.tension = bonding.tension;
            bond.shear = bonding.shear;
            scene.bonds.push_back(bond);
        }
    }
    return scene.bonds.size() - before;
}

}  // namespace scree
