// Checks what is asked to be measured, and names it.
#include <cmath>
#include <set>
#include <string>

#include "compute/measures.h"

namespace scree {

namespace {

constexpr float farthest = 1e6f, largest_size = 1e6f;  // m

[[noreturn]] void refuse(const std::string& place, const std::string& reason) {
    throw SceneError(place, reason);
}

void require_within(vec3 point, const std::string& place) {
    for (int k = 0; k < 3; ++k)
        if (!(std::abs(point[k]) <= farthest)) refuse(place + "/" + std::to_string(k), "must be between -1e6 and 1e6 m");
}
void require_size(float size, const std::string& place) {
    if (!(size > 0 && size <= largest_size)) refuse(place, "must be above 0 and at most 1e6 m");
}
void require_below(vec3 lower, vec3 upper, const std::string& place) {
    require_within(lower, place + "/lower");
    require_within(upper, place + "/upper");
    for (int k = 0; k < 3; ++k)
        if (!(lower[k] < upper[k])) refuse(place + "/upper/" + std::to_string(k), "must be above that of \"lower\"");
}

void check(const MeasureBox& box, const std::string& place) {
    require_below(box.lower, box.upper, place + "/box");
}
void check(const MeasureCylinder& cylinder, const std::string& place) {
    require_within(cylinder.from, place + "/cylinder/from");
    require_within(cylinder.to, place + "/cylinder/to");
    if (cylinder.from == cylinder.to) refuse(place + "/cylinder/to", "must differ from \"from\"");
    require_size(cylinder.radius, place + "/cylinder/radius");
}
void check(const MeasureSphere& ball, const std::string& place) {
    require_within(ball.centre, place + "/sphere/centre");
    require_size(ball.radius, place + "/sphere/radius");
}

void check(const MeasureGrid& grid, const std::string& place) {
    require_below(grid.lower, grid.upper, place);
    for (int k = 0; k < 3; ++k) require_size(grid.cell[k], place + "/cell/" + std::to_string(k));
    const glm::uvec3 count = cells_of(grid);
    const double all = double(count.x) * double(count.y) * double(count.z);
    if (all > double(most_measured_cells))
        refuse(place + "/cell", "makes more than " + std::to_string(most_measured_cells) + " cells; make them larger");
}

void check(const MeasureGate& gate, const std::string& place) {
    require_within(gate.centre, place + "/centre");
    require_within(gate.u, place + "/u");
    require_within(gate.v, place + "/v");
    const glm::dvec3 u(gate.u), v(gate.v);
    const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
    if (!(uu > 0)) refuse(place + "/u", "must not be of length 0");
    if (!(vv > 0)) refuse(place + "/v", "must not be of length 0");
    if (uv * uv > 1e-6 * uu * vv) refuse(place + "/v", "must be at right angles to \"u\"");
}

void check(const MeasuredBody& measured, const Scene& scene, const std::string& place) {
    if (measured.body >= scene.bodies.size())
        refuse(place + "/body", "there is no body " + std::to_string(measured.body) + "; the scene has " +
                                    std::to_string(scene.bodies.size()) + ", counted from 0");
    if (scene.bodies[measured.body].role != Role::solid) refuse(place + "/body", "is no solid body, and has no contacts");
    if (measured.about) require_within(*measured.about, place + "/about");
}

}  // namespace

std::string name_of_region(const MeasureRequest& request, std::size_t region) {
    const std::string& name = request.regions[region].name;
    return name.empty() ? "region " + std::to_string(region) : name;
}
std::string name_of_gate(const MeasureRequest& request, std::size_t gate) {
    const std::string& name = request.gates[gate].name;
    return name.empty() ? "gate " + std::to_string(gate) : name;
}
std::string name_of_load(const MeasureRequest& request, std::size_t body, const Scene& scene) {
    const auto name_of = [&](std::size_t i) {
        const std::size_t index = request.bodies[i].body;
        const std::string& name = scene.bodies[index].name;
        return name.empty() ? "body " + std::to_string(index) : name;
    };
    const std::string name = name_of(body);
    std::size_t before = 0;
    for (std::size_t i = 0; i < body; ++i) before += name_of(i) == name;
    return before == 0 ? name : name + " " + std::to_string(before + 1);
}

void check_measures(const MeasureRequest& request, const Scene& scene, const std::string& at) {
    if (!(request.interval >= 0 && request.interval <= 1e6f)) refuse(at + "/interval", "must be between 0 and 1e6 s");
    if (request.grid) check(*request.grid, at + "/grid");
    std::set<std::string> names{"all"};
    const auto require_new = [&](const std::string& name, const std::string& place) {
        if (!names.insert(name).second)
            refuse(place, "the name \"" + name + "\" is taken" + (name == "all" ? ": by the whole of the grains" : ""));
    };
    for (std::size_t i = 0; i < request.regions.size(); ++i) {
        const std::string place = at + "/regions/" + std::to_string(i);
        std::visit([&](const auto& one) { check(one, place + "/shape"); }, request.regions[i].shape);
        require_new(name_of_region(request, i), place + "/name");
    }
    for (std::size_t i = 0; i < request.gates.size(); ++i) {
        const std::string place = at + "/gates/" + std::to_string(i);
        check(request.gates[i], place);
        require_new(name_of_gate(request, i), place + "/name");
    }
    for (std::size_t i = 0; i < request.bodies.size(); ++i) check(request.bodies[i], scene, at + "/bodies/" + std::to_string(i));
}

}  // namespace scree
