// Running cases of granular media, and what they are built of.
#include "demos/validate/granular/granular.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compute/scene/portable_math.h"
#include "compute/scene/random.h"

namespace scree::demos {

GranularLab::GranularLab(std::function<std::unique_ptr<Runner>()> make_runner, GranularOptions options,
                         std::function<bool()> go_on)
    : make_runner_(std::move(make_runner)), options_(options), go_on_(std::move(go_on)) {}

World GranularLab::world(const Scene& scene, float rate, int substeps) const {
    Settings settings;
    settings.rate = options_.rate.value_or(rate);
    settings.substeps = options_.substeps.value_or(substeps);
    settings.sleeping = false;
    return World(scene, settings, make_runner_());
}

void GranularLab::run(World& world, double seconds, const std::function<void()>& after_step) const {
    const long steps = std::max(1L, std::lround(seconds * static_cast<double>(world.settings().rate)));
    for (long i = 0; i < steps; ++i) {
        if (go_on_ && !go_on_()) throw Stopped();
        world.step();
        if (after_step) after_step();
    }
}

double GranularLab::scale(std::size_t usual) const {
    if (options_.bodies == 0) return 1;
    return portable::cbrt(static_cast<double>(options_.bodies) / static_cast<double>(usual));
}

double GranularResult::mean(std::size_t figure) const {
    double sum = 0;
    for (const GranularMeasured& seed : seeds) sum += seed.figures.at(figure);
    return sum / static_cast<double>(seeds.size());
}

double GranularResult::spread(std::size_t figure) const {
    if (seeds.size() < 2) return 0;
    const double middle = mean(figure);
    double sum = 0;
    for (const GranularMeasured& seed : seeds) sum += (seed.figures.at(figure) - middle) * (seed.figures.at(figure) - middle);
    return std::sqrt(sum / static_cast<double>(seeds.size() - 1));
}

bool GranularResult::pass(std::size_t figure) const {
    const double middle = mean(figure);
    return middle >= of->figures.at(figure).low && middle <= of->figures.at(figure).high;  // not if it is no number
}

bool GranularResult::pass() const {
    for (std::size_t i = 0; i < of->figures.size(); ++i)
        if (!pass(i)) return false;
    return true;
}

PlotOf GranularResult::plot() const {
    PlotOf plot = of->plot;
    if (seeds.empty()) return plot;
    for (const PlotSeries& line : seeds.front().theory) plot.lines.push_back(line);
    for (std::size_t s = 0; s < seeds.front().points.size(); ++s) {
        PlotSeries means{seeds.front().points[s].name, {}};
        for (std::size_t i = 0; i < seeds.front().points[s].points.size(); ++i) {
            std::vector<PlotPoint> of_seeds;
            for (const GranularMeasured& seed : seeds)
                if (i < seed.points.at(s).points.size()) of_seeds.push_back(seed.points[s].points[i]);
            const double n = static_cast<double>(of_seeds.size());
            PlotPoint mean;
            for (const PlotPoint& point : of_seeds) {
                mean.x += point.x / n;
                mean.y += point.y / n;
            }
            for (const PlotPoint& point : of_seeds) mean.bar += (point.y - mean.y) * (point.y - mean.y) / std::max(1.0, n - 1);
            mean.bar = std::sqrt(mean.bar);
            means.points.push_back(mean);
        }
        plot.points.push_back(std::move(means));
    }
    return plot;
}

GranularResult validate(const GranularCase& granular, const GranularLab& lab, const std::function<void()>& done) {
    GranularResult result{&granular, {}};
    for (std::uint64_t seed = 1; seed <= lab.options().seeds; ++seed) {
        result.seeds.push_back(granular.measure(lab, seed));
        if (done) done();
    }
    return result;
}

std::vector<GranularCase> all_granular_cases() {
    std::vector<GranularCase> all;
    for (auto* group : {column_cases, discharge_cases, heap_cases, drum_cases, cut_cases, triaxial_cases}) {
        std::vector<GranularCase> some = group();
        std::move(some.begin(), some.end(), std::back_inserter(all));
    }
    return all;
}

namespace granular {

Body wall(vec3 normal, float offset, float friction) {
    Body body;
    body.motion = Motion::fixed;
    body.shape = Plane{normal, offset};
    body.friction = friction;
    body.friction_rule = CombineRule::minimum;  // the wall's, if it is smoother than the grains
    return body;
}

void add_walls(Scene& scene, float half_x, float half_z, float friction) {
    scene.bodies.push_back(wall({1, 0, 0}, -half_x, friction));
    scene.bodies.push_back(wall({-1, 0, 0}, -half_x, friction));
    scene.bodies.push_back(wall({0, 0, 1}, -half_z, friction));
    scene.bodies.push_back(wall({0, 0, -1}, -half_z, friction));
}

Grains grains_of(std::size_t count, std::uint64_t seed, float friction, const GrainRegion& region) {
    Grains grains;
    grains.name = "grain";
    grains.sieve = {{0.9f * d, 0}, {1.1f * d, 100}};
    grains.density = density;
    grains.material.friction = friction;
    grains.seed = seed;
    grains.region = region;
    grains.count = count;
    return grains;
}

double add_grains(Scene& scene, const Grains& grains, const std::function<void(Body&)>& change) {
    double volume = 0;
    GrainSupply(grains).place([&](Body body) {
        if (change) change(body);
        scene.bodies.push_back(std::move(body));
        volume += volume_of(scene, scene.bodies.size() - 1);
    });
    return volume;
}

double pour(const GranularLab& lab, World& world, const Grains& grains, float half_x, float half_z) {
    const GrainSupply supply(grains);
    const double area = 4 * static_cast<double>(half_x) * static_cast<double>(half_z);
    const int across = static_cast<int>(2 * half_x / (1.25f * d)), along = static_cast<int>(2 * half_z / (1.25f * d));
    const glm::vec2 pitch(2 * half_x / static_cast<float>(across), 2 * half_z / static_cast<float>(along));
    SeededRandom random(grains.seed);
    const auto jitter = [&] { return random.between(-0.06f, 0.06f) * d; };
    double volume = 0;
    for (std::size_t next = 0; next < supply.count();) {
        const float height = static_cast<float>(volume / (0.57 * area)) + 2 * d;
        std::vector<Body> layer;
        for (int place = 0; place < across * along && next < supply.count(); ++place) {
            Body body = supply.grain(next++);
            body.position = {-half_x + pitch.x * (static_cast<float>(place % across) + 0.5f) + jitter(), height,
                             -half_z + pitch.y * (static_cast<float>(place / across) + 0.5f) + jitter()};
            volume += static_cast<double>(mass_properties(body).mass) / static_cast<double>(body.density);
            layer.push_back(std::move(body));
        }
        world.add_bodies(layer);
        lab.run(world, 0.15);
    }
    return volume;
}

double volume_of(const Scene& scene, std::size_t body) {
    const Body& that = scene.bodies.at(body);
    return static_cast<double>(mass_properties(that).mass) / static_cast<double>(that.density);
}

Line fit(const std::vector<PlotPoint>& points) {
    const double n = static_cast<double>(points.size());
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const PlotPoint& point : points) {
        x += point.x / n;
        y += point.y / n;
    }
    for (const PlotPoint& point : points) {
        xx += (point.x - x) * (point.x - x);
        xy += (point.x - x) * (point.y - y);
    }
    return {xy / xx, y - xy / xx * x};
}

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value / static_cast<double>(values.size());
    return sum;
}

}  // namespace granular

}  // namespace scree::demos
