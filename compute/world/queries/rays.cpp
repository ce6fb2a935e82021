// World: rays in batches, on the runner's device where it takes them, else on the host's threads.
#include <algorithm>
#include <tuple>

#include "compute/parallel/threads.h"
#include "compute/queries.h"
#include "compute/scene/ray_task.h"
#include "compute/world/queries/query_check.h"
#include "compute/world/queries/query_scene.h"
#include "compute/world/world_impl.h"

namespace scree {

namespace {

void check_rays(std::span<const RayQuery> rays, std::size_t copies) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        check_copy("ray", i, rays[i].copy, copies);
        if (!is_finite(rays[i].from)) refuse_query("ray", i, "its origin must be finite");
        if (!is_unit(rays[i].along)) refuse_query("ray", i, "its direction must be of length 1");
        if (!(rays[i].reach > 0)) refuse_query("ray", i, "its reach must be above 0 m");
    }
}

// Rays that the runner casts on its device, and what they meet by body and part.
class DeviceRays {
public:
    DeviceRays(Runner& runner, std::span<const RayQuery> rays, RayTask::Hits wanted,
               std::pair<std::uint64_t, std::uint64_t> moment)
        : queries_(rays) {
        task_.wanted = wanted;
        task_.moment = moment;
        runner.threads().for_each(records_of(rays.size()), [&](std::size_t i) {
            records_[i] = {
                rays[i].from, QueryScene::longest(rays[i].reach), rays[i].along, rays[i].mask, rays[i].solid ? 1u : 0u, 0, 0, 0};
        });
        task_.rays = records_;
        done_ = runner.cast(task_);
    }
    bool done() const { return done_; }
    const RayTask& task() const { return task_; }
    std::optional<QueryHit> hit(std::size_t ray, const physics::QueryMeeting& met, const State& state,
                                const std::vector<std::size_t>& first_parts) const {
        if (met.distance < 0) return std::nullopt;
        const float distance = met.distance > 0 ? met.distance : 0;  // drivers may make it -0
        const RayQuery& query = queries_[ray];
        const std::uint32_t body = state.id_of(state.body_of(met.row));
        const bool part = met.row >= state.fixed().first_part;
        return QueryHit{body, part ? static_cast<std::uint32_t>(met.row - first_parts[body]) : 0u, distance,
                        distance > 0 ? query.from + query.along * distance : query.from, met.normal};
    }

private:
    std::size_t records_of(std::size_t count) {
        records_.resize(count);
        return count;
    }
    std::span<const RayQuery> queries_;
    std::vector<physics::QueryRay> records_;
    RayTask task_;
    bool done_ = false;
};

// A result of each ray: that of the runner's device where it takes rays, else, and where the device leaves one, of the host.
// `from_device` makes what tells the device's results, `from_host` tells one.
template <class Result>
std::vector<Result> results_of(std::span<const RayQuery> rays, RayTask::Hits wanted, const auto& world, const auto& from_device,
                               const auto& from_host) {
    const Threads& threads = world.runner->threads();
    std::vector<Result> results(rays.size());
    if (world.runner->casts(rays.size())) {
        const DeviceRays there(*world.runner, rays, wanted, {world.steps, world.changes});
        if (there.done()) {
            const auto told = from_device(there);
            threads.for_each(rays.size(), [&](std::size_t i) { results[i] = told(i); });
            for (const std::uint32_t i : there.task().left) results[i] = from_host(world.query_scene(), rays[i]);
            return results;
        }
    }
    const QueryScene& bodies = world.query_scene();
    threads.for_each(rays.size(), [&](std::size_t i) { results[i] = from_host(bodies, rays[i]); });
    return results;
}

}  // namespace

std::vector<std::optional<QueryHit>> World::cast_rays(std::span<const RayQuery> rays) const {
    check_rays(rays, copies());
    const Impl& in = whole();
    return results_of<std::optional<QueryHit>>(
        rays, RayTask::Hits::nearest, in,
        [&](const DeviceRays& there) {
            return [&, first_parts = first_part_rows()](std::size_t i) {
                return there.hit(i, there.task().meetings[i], in.state, first_parts);
            };
        },
        [](const QueryScene& bodies, const RayQuery& ray) { return bodies.nearest(ray, false); });
}

std::vector<std::uint8_t> World::rays_hit(std::span<const RayQuery> rays) const {
    check_rays(rays, copies());
    return results_of<std::uint8_t>(
        rays, RayTask::Hits::any, whole(),
        [](const DeviceRays& there) { return [&](std::size_t i) { return there.task().meetings[i].distance >= 0; }; },
        [](const QueryScene& bodies, const RayQuery& ray) { return bodies.nearest(ray, true).has_value(); });
}

QueryLists<QueryHit> World::cast_rays_through(std::span<const RayQuery> rays) const {
    check_rays(rays, copies());
    const Impl& in = whole();
    return joined_lists(results_of<std::vector<QueryHit>>(
        rays, RayTask::Hits::all, in,
        [&](const DeviceRays& there) {
            return [&, first_parts = first_part_rows()](std::size_t i) {
                const RayTask& task = there.task();
                std::vector<QueryHit> list;
                for (std::size_t k = task.starts[i]; k < task.starts[i + 1]; ++k)
                    list.push_back(*there.hit(i, task.meetings[k], in.state, first_parts));
                std::sort(list.begin(), list.end(), QueryScene::nearer);
                return list;
            };
        },
        [](const QueryScene& bodies, const RayQuery& ray) { return bodies.all(ray); }));
}

std::optional<RayHit> World::cast_ray(const Ray& ray) const {
    const float length = glm::length(ray.along);
    if (!std::isfinite(glm::dot(ray.from, ray.from)) || !std::isfinite(length) || !(std::abs(length - 1) < 1e-3f))
        throw std::invalid_argument("ray: it must be finite, and its direction of length 1");
    const RayQuery query{.from = ray.from, .along = ray.along, .solid = false};
    const std::optional<QueryHit> hit = cast_rays({&query, 1}).front();
    if (!hit) return std::nullopt;
    return RayHit{hit->body, hit->distance, hit->point, hit->normal};
}

}  // namespace scree
