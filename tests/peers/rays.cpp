// Rays into a heap: scree against brute force on every ray, against a device, and against Bullet's rayTest in speed.
#include <btBulletCollisionCommon.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "compute/device/device_runner.h"
#include "compute/parallel/threads.h"
#include "compute/queries.h"
#include "compute/scene/shape_geometry.h"
#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

using Hits = std::vector<std::optional<QueryHit>>;

double seconds_of(const auto& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// From anywhere in the box around all bodies, and a little beyond, in any direction.
std::vector<RayQuery> rays_into(const std::vector<BodyState>& bodies, std::size_t count) {
    vec3 low(1e30f), high(-1e30f);
    for (const BodyState& body : bodies) low = glm::min(low, body.position), high = glm::max(high, body.position);
    tests::Noise noise(5);
    std::vector<RayQuery> rays;
    while (rays.size() < count) {
        RayQuery ray;
        ray.from = (low + high) * 0.5f + noise.vector() * ((high - low) * 0.5f + 2.0f);
        const vec3 along = noise.vector();
        if (glm::length(along) < 0.1f) continue;
        ray.along = glm::normalize(along);
        ray.reach = 100;
        rays.push_back(ray);
    }
    return rays;
}

// Every ray against every body: a sphere around it first, widely, then its shape.
class Brute {
public:
    Brute(const Scene& scene, const std::vector<BodyState>& states) : scene_(scene), states_(states) {
        for (std::size_t i = 0; i < states.size(); ++i) {
            const bool is_plane = std::holds_alternative<Plane>(scene.bodies[i].shape);
            x_.push_back(states[i].position.x), y_.push_back(states[i].position.y), z_.push_back(states[i].position.z);
            const float reach = is_plane ? 1e9f : 1.01f * radius_of(scene.bodies[i].shape) + 0.01f;
            reach2_.push_back(reach * reach);
        }
    }
    std::optional<QueryHit> nearest(const RayQuery& ray) const {
        std::optional<QueryHit> found;
        std::array<std::uint8_t, 1024> near;
        for (std::size_t first = 0; first < x_.size(); first += near.size()) {
            const std::size_t count = std::min(near.size(), x_.size() - first);
            std::uint8_t any = 0;
            for (std::size_t k = 0; k < count; ++k) {
                const float x = x_[first + k] - ray.from.x, y = y_[first + k] - ray.from.y, z = z_[first + k] - ray.from.z;
                const float along = x * ray.along.x + y * ray.along.y + z * ray.along.z;
                const float square = x * x + y * y + z * z;
                const bool beside = square - along * along * 1.0001f <= reach2_[first + k] + 1e-3f;
                const bool ahead = along >= 0 || square <= reach2_[first + k];
                near[k] = static_cast<std::uint8_t>(beside & ahead);
                any |= near[k];
            }
            for (std::size_t k = 0; any && k < count; ++k)
                if (near[k]) offer(found, ray, first + k);
        }
        return found;
    }

private:
    static float radius_of(const Shape& shape) {
        if (const auto* box = std::get_if<Box>(&shape)) return glm::length(box->half_extents);
        if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
        if (const auto* capsule = std::get_if<Capsule>(&shape)) return capsule->radius + capsule->half_height;
        return 1e9f;
    }
    void offer(std::optional<QueryHit>& found, const RayQuery& ray, std::size_t i) const {
        const Shape& shape = scene_.bodies[i].shape;
        QueryHit hit{i, 0, 0, {}, {}};
        if (!contains(shape, states_[i].position, states_[i].orientation, ray.from)) {
            const std::optional<float> at = ray_distance(shape, states_[i].position, states_[i].orientation, ray.from, ray.along);
            if (!at || *at > ray.reach) return;
            hit.distance = *at;
        }
        if (!found || hit.distance < found->distance) found = hit;  // of equal ones the lowest body
    }
    const Scene& scene_;
    const std::vector<BodyState>& states_;
    std::vector<float> x_, y_, z_, reach2_;
};

btVector3 vector_of(vec3 v) {
    return {v.x, v.y, v.z};
}

// The same bodies in Bullet, without dynamics.
class InBullet {
public:
    InBullet(const Scene& scene, const std::vector<BodyState>& states) {
        for (std::size_t i = 0; i < states.size(); ++i) {
            const Shape& shape = scene.bodies[i].shape;
            if (const auto* box = std::get_if<Box>(&shape))
                shapes_.push_back(std::make_unique<btBoxShape>(vector_of(box->half_extents)));
            else if (const auto* sphere = std::get_if<Sphere>(&shape))
                shapes_.push_back(std::make_unique<btSphereShape>(sphere->radius));
            else if (const auto* capsule = std::get_if<Capsule>(&shape))
                shapes_.push_back(std::make_unique<btCapsuleShape>(capsule->radius, 2 * capsule->half_height));
            else if (const auto* plane = std::get_if<Plane>(&shape))
                shapes_.push_back(std::make_unique<btStaticPlaneShape>(vector_of(plane->normal), plane->offset));
            else
                throw std::runtime_error("a shape that is not translated for Bullet");
            bodies_.push_back(std::make_unique<btCollisionObject>());
            const vec4 q = states[i].orientation;
            bodies_.back()->setWorldTransform(btTransform(btQuaternion(q.x, q.y, q.z, q.w), vector_of(states[i].position)));
            bodies_.back()->setCollisionShape(shapes_.back().get());
            world_.addCollisionObject(bodies_.back().get());
        }
    }
    ~InBullet() {
        for (const auto& body : bodies_) world_.removeCollisionObject(body.get());
    }
    std::size_t cast(const std::vector<RayQuery>& rays) {
        std::size_t hits = 0;
        for (const RayQuery& ray : rays) {
            const btVector3 from = vector_of(ray.from), to = vector_of(ray.from + ray.along * ray.reach);
            btCollisionWorld::ClosestRayResultCallback result(from, to);
            world_.rayTest(from, to, result);
            hits += result.hasHit();
        }
        return hits;
    }

private:
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btCollisionObject>> bodies_;
};

bool equal(const std::optional<QueryHit>& a, const std::optional<QueryHit>& b) {
    return a.has_value() == b.has_value() && (!a || (a->body == b->body && a->part == b->part && a->distance == b->distance));
}

std::size_t differing(const Hits& a, const Hits& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += !equal(a[i], b[i]);
    return count;
}

// A world on the first device.
struct OnDevice {
    DeviceRunner* runner;
    World world;
    OnDevice(const Scene& scene, const std::vector<std::byte>& mark)
        : OnDevice(scene, std::make_unique<DeviceRunner>(host::Device::open())) {
        world.restore(mark);
    }

private:
    OnDevice(const Scene& scene, std::unique_ptr<DeviceRunner> made)
        : runner(made.get()), world(scene, {}, std::unique_ptr<Runner>(std::move(made))) {}
};

// Milliseconds: of the first batch of 1 ray after a change, trees included, then medians by batch length.
void print_batches(OnDevice& there, const std::vector<std::byte>& mark, std::span<const RayQuery> rays) {
    constexpr std::size_t never = std::numeric_limits<std::size_t>::max();
    fmt::print("{}: ms of a batch, cast on the host and on the device\n", there.runner->device());
    const auto measured = [&](std::size_t from, std::size_t batch, bool first) {
        there.runner->cast_rays_from(from);
        std::vector<double> times;
        for (int k = 0; k < (batch > 100000 ? 3 : 7); ++k) {
            if (first) there.world.restore(mark);
            times.push_back(1e3 * seconds_of([&] { (void)there.world.cast_rays(rays.first(batch)); }));
        }
        std::ranges::nth_element(times, times.begin() + std::ssize(times) / 2);
        return times[times.size() / 2];
    };
    for (const bool first : {true, false})
        for (std::size_t batch = 1; batch <= rays.size(); batch *= batch < 10000 ? 100 : 10)
            fmt::print("  {:8} rays{} {:10.3f} {:10.3f}\n", batch, first ? ", first after a change" : "                       ",
                       measured(never, batch, first), measured(1, batch, first));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Rays into a heap: brute force on every ray, a device, and Bullet's rayTest. Exit status 1: some ray differs");
    int bodies = 100000, steps = 20;
    std::size_t count = 1000000, checked = std::numeric_limits<std::size_t>::max();
    bool on_device = false;
    app.add_option("--bodies", bodies, "how many (100000)");
    app.add_option("--rays", count, "how many (1000000)");
    app.add_option("--steps", steps, "before the rays (20)");
    app.add_option("--check", checked, "rays that brute force is to find, too (all)");
    app.add_flag("--device", on_device, "compare with rays cast on the first Vulkan device, and time both");
    CLI11_PARSE(app, argc, argv);
    checked = std::min(checked, count);
    std::setvbuf(stdout, nullptr, _IOLBF, 0);

    const Scene scene = tests::packed(bodies);
    World world(scene, {}, 2), single(scene, {}, 1);
    world.step(steps);
    const std::vector<std::byte> mark = world.save();
    single.restore(mark);
    const std::vector<BodyState> states = world.bodies();
    const std::vector<RayQuery> rays = rays_into(states, count);
    Hits hits, of_one;
    const double tree = seconds_of([&] { (void)world.cast_rays(std::span(rays).first(1)); });
    (void)single.cast_rays(std::span(rays).first(1));
    const double two = seconds_of([&] { hits = world.cast_rays(rays); });
    const double one = seconds_of([&] { of_one = single.cast_rays(rays); });
    InBullet bullet(world.scene(), states);
    std::size_t bullet_hits = 0;
    const double theirs = seconds_of([&] { bullet_hits = bullet.cast(rays); });
    const auto met = static_cast<std::size_t>(std::ranges::count_if(hits, [](const auto& hit) { return hit.has_value(); }));
    const double n = static_cast<double>(count);
    fmt::print("{} rays into {} bodies: {} meet one; the tree takes {:.0f} ms\n", count, bodies, met, tree * 1e3);
    fmt::print("scree, 2 threads  {:8.0f} rays/s  {:.2f} of Bullet's\n", n / two, theirs / two);
    fmt::print("scree, 1 thread   {:8.0f} rays/s  {:.2f}\n", n / one, theirs / one);
    fmt::print("Bullet, 1 thread  {:8.0f} rays/s  ({} meet one; rays from within a body are other ones)\n", n / theirs,
               bullet_hits);
    std::size_t wrong = differing(hits, of_one);
    fmt::print("1 and 2 threads differ on {} rays\n", wrong);
    if (on_device) {
        OnDevice there(scene, mark);
        there.runner->cast_rays_from(1);
        const std::size_t differ = differing(hits, there.world.cast_rays(rays));
        fmt::print("{} differs on {} rays\n", there.runner->device(), differ);
        wrong += differ;
        print_batches(there, mark, rays);
    }
    const Brute brute(world.scene(), states);
    std::atomic<std::size_t> missed = 0;
    const double slow = seconds_of(
        [&] { Threads(0).for_each(checked, [&](std::size_t i) { missed += !equal(hits[i], brute.nearest(rays[i])); }); });
    fmt::print("brute force differs on {} of {} rays ({:.0f} s)\n", missed.load(), checked, slow);
    return wrong + missed == 0 ? 0 : 1;
}
