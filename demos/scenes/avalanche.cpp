// The avalanche: stones of mixed shape and size slide down a steep slope and terraces onto a plain.
#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random_bodies.h"
#include "demos/scenes/scene_builder.h"

namespace scree::demos {

namespace {

constexpr float smallest_reach = 0.15f, largest_reach = 0.36f;  // m, bounding radius
constexpr float cell = 2 * largest_reach;
constexpr int terraces = 5;

// The valley, m. All lengths grow with the square root of the stones' initial area, so a million look like four
// thousand.
struct Valley {
    explicit Valley(std::size_t count)
        : columns(std::max(6, static_cast<int>(std::lround(1.45 * portable::cbrt(static_cast<double>(count)))))),
          length(cell * static_cast<float>(columns)),
          half_width(0.5f * length + 0.3f),
          layers(std::ceil(static_cast<float>(count) / static_cast<float>(columns * columns))),
          thickness(0.06f * length),
          wall(cell * (layers + 0.5f)),
          tread(0.15f * length),
          riser(0.13f * length),
          incline(42 * degrees) {}

    float terrace_top() const { return riser * static_cast<float>(terraces); }
    float edge() const { return -tread * static_cast<float>(terraces); }  // x of the incline's lower end; the terraces end at 0
    float surface(float x) const { return terrace_top() + (edge() - x) * portable::tan(incline); }

    int columns;  // columns of stones, along the slope and across
    float length, half_width;
    float layers;  // layers of stones
    float thickness;
    float wall;  // height above the incline: that of the stones
    float tread, riser;
    float incline;  // rad
};

void add_walls(Scene& scene, vec3 centre, vec3 half, float friction, vec4 turn, const Valley& valley) {
    for (const float side : {-1.0f, 1.0f}) {
        centre.z = side * (valley.half_width + half.z);
        scene.bodies.push_back(fixed_box(centre, half, friction, turn));
    }
}

void add_valley(Scene& scene, const Valley& v) {
    const float t = v.thickness, friction = 0.25f;
    scene.bodies.push_back(ground(0.7f));
    // The incline's surface passes through (edge, terrace_top) and extends past the last stone to an upright wall.
    const vec3 out(portable::sin(v.incline), portable::cos(v.incline), 0),
        down(portable::cos(v.incline), -portable::sin(v.incline), 0);
    const float half_length = 0.5f * (v.length / portable::cos(v.incline) + 2 * cell);
    const vec4 turn = turned({0, 0, 1}, -v.incline);
    const vec3 middle = vec3(v.edge(), v.terrace_top(), 0) - down * half_length;
    scene.bodies.push_back(fixed_box(middle - out * t, {half_length, t, v.half_width}, friction, turn));
    add_walls(scene, middle + out * (0.5f * (v.wall - t)), {half_length, 0.5f * (v.wall + t), 0.4f * t}, friction, turn, v);
    const float back = v.edge() - v.length - 0.1f, back_wall = 0.5f * (v.wall / portable::cos(v.incline) + t);
    scene.bodies.push_back(
        fixed_box({back - 0.4f * t, v.surface(back) - t + back_wall, 0}, {0.4f * t, back_wall, v.half_width}, friction));
    for (int i = 0; i < terraces; ++i) {
        const float top = v.riser * static_cast<float>(terraces - i);
        const float x = v.edge() + v.tread * (static_cast<float>(i) + 0.5f);
        scene.bodies.push_back(fixed_box({x, top / 2, 0}, {v.tread / 2, top / 2, v.half_width}, friction));
        add_walls(scene, {x, top / 2 + t, 0}, {v.tread / 2, top / 2 + t, 0.4f * t}, friction, {0, 0, 0, 1}, v);
    }
}

// Mean height lost by the stones, as a fraction of their initial height.
Claim comes_down(double part) {
    return at_least("height lost, of that at the start", part, "", "of all stones together", [](const Trace& trace) {
        double started = 0, fallen = 0;
        for (std::size_t i = 0; i < trace.end.size(); ++i) {
            if (trace.scene.bodies[i].motion != Motion::dynamic) continue;
            started += trace.start[i].position.y;
            fallen += trace.start[i].position.y - trace.end[i].position.y;
        }
        return started > 0 ? fallen / started : 0;
    });
}

}  // namespace

DemoScene avalanche(const DemoOptions& options) {
    const Valley v(options.bodies);
    Scene scene;
    add_valley(scene, v);
    const auto stones = [v, count = options.bodies, seed = options.seed](const TakeBody& take) {
        Random random(seed);
        // Random offsets within the cell, larger for smaller stones, so that the lattice does not show.
        const auto stray = [](float reach, Random& dice) { return dice.vector(-1, 1) * ((largest_reach - reach) * 0.577f); };
        const auto side = static_cast<std::size_t>(v.columns);
        for (std::size_t i = 0; i < count; ++i) {
            const float reach = random.between(smallest_reach, largest_reach);
            Body stone = random_mixed(reach, random);
            const float x = v.edge() - cell * (static_cast<float>(i % side) + 0.5f);
            const float z = cell * (static_cast<float>(i / side % side) - 0.5f * static_cast<float>(side - 1));
            const float above = cell * (static_cast<float>(i / (side * side)) + 0.75f) / portable::cos(v.incline);
            stone.position = vec3(x, v.surface(x) + above, z) + stray(reach, random);
            stone.density = 2600;
            stone.friction = 0.35f;
            take(std::move(stone));
        }
    };
    const float back = v.edge() - v.length, top = v.surface(back) + cell * (v.layers + 1), run_out = 0.5f * v.length;
    const vec3 low(back, 0, -v.half_width), high(2 * run_out, top, v.half_width);
    std::vector<vec3> seen;
    for (const float z : {-v.half_width, v.half_width}) {
        // Below the run-out there is room for legend and caption.
        for (const vec3& point : {vec3(back - 0.1f * v.length, 1.1f * top, z), vec3(v.edge(), v.terrace_top(), z),
                                  vec3(1.6f * run_out, 0, z), vec3(run_out, -0.12f * v.length, z)})
            seen.push_back(point);
    }
    const float seconds = 12 * std::sqrt(std::max(1.0f, v.length / 16.6f));  // fall times grow with the square root of lengths
    const float far = 20 * v.length;
    DemoScene made{std::move(scene),
                   view_of(seen, 24, 28),
                   low,
                   high,
                   seconds,
                   Promise(because(comes_down(0.4), any_number), all_within({-far, 0, -far}, {far, far, far}),
                           because(penetration_below(0.1), any_number), energy_never_rises(0.001))
                       .watching_energy()};
    made.others = stones;
    return made;
}

}  // namespace scree::demos
