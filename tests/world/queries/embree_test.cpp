// Rays against meshes: the distances of Embree, an independent judge, where it is installed (libembree-dev).
#ifdef SCREE_JUDGE_EMBREE
#include <embree3/rtcore.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <vector>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

// Waves of triangles of many sizes, single sided towards +y.
Mesh waves(int columns) {
    Mesh mesh;
    const auto at = [&](int i) { return 0.3f * static_cast<float>(i) + 0.1f * std::sin(static_cast<float>(i)); };
    for (int z = 0; z < columns; ++z)
        for (int x = 0; x < columns; ++x)
            mesh.vertices.push_back({at(x), std::sin(0.4f * at(x)) * std::cos(0.3f * at(z)), at(z)});
    const auto index = [&](int x, int z) { return static_cast<std::uint32_t>(z * columns + x); };
    for (int z = 0; z + 1 < columns; ++z)
        for (int x = 0; x + 1 < columns; ++x) {
            mesh.triangles.push_back({index(x, z), index(x, z + 1), index(x + 1, z + 1)});
            mesh.triangles.push_back({index(x, z), index(x + 1, z + 1), index(x + 1, z)});
        }
    return mesh;
}

struct Judge {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    explicit Judge(const Mesh& mesh) {
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                     3 * sizeof(float), mesh.vertices.size()));
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
            for (int k = 0; k < 3; ++k) vertices[3 * i + static_cast<std::size_t>(k)] = mesh.vertices[i][k];
        auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                       3 * sizeof(unsigned), mesh.triangles.size()));
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) indices[3 * i + k] = mesh.triangles[i][k];
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
    }
    ~Judge() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    // The distance and the normal, towards the side from which the front is seen; infinite if nothing is met.
    std::pair<float, vec3> cast(const RayQuery& ray) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit hit{};
        hit.ray = {.org_x = ray.from.x,
                   .org_y = ray.from.y,
                   .org_z = ray.from.z,
                   .tnear = 0,
                   .dir_x = ray.along.x,
                   .dir_y = ray.along.y,
                   .dir_z = ray.along.z,
                   .time = 0,
                   .tfar = ray.reach,
                   .mask = ~0u,
                   .id = 0,
                   .flags = 0};
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &hit);
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {INFINITY, {}};
        return {hit.ray.tfar, {hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z}};
    }
};

}  // namespace

TEST_CASE("rays meet a mesh within 1e-4 m of where Embree says", "[world]") {
    const Mesh mesh = waves(120);
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = mesh});
    World world(scene, {}, 2);
    const Judge judge(mesh);
    tests::Noise noise(3);
    std::vector<RayQuery> rays;
    while (rays.size() < 50000) {  // from above, on the side of the fronts
        RayQuery ray{.from = vec3(18, 4, 18) + noise.vector() * vec3(16, 1.5f, 16), .along = noise.vector(), .reach = 60};
        if (ray.along.y > -0.05f) continue;
        ray.along = glm::normalize(ray.along);
        rays.push_back(ray);
    }
    const auto hits = world.cast_rays(rays);
    std::size_t met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto [distance, normal] = judge.cast(rays[i]);
        INFO("ray " << i);
        if (!std::isinf(distance) && glm::dot(normal, rays[i].along) > 0) continue;  // a back face, at the rim: not seen here
        REQUIRE(hits[i].has_value() == !std::isinf(distance));
        if (!hits[i]) continue;
        ++met;
        REQUIRE(std::abs(hits[i]->distance - distance) < 1e-4f);
    }
    REQUIRE(met > 35000);
}
#endif
