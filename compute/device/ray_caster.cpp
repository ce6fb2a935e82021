// Rays on a device: the tree is built when the first batch after a change comes.
#include "compute/device/ray_caster.h"

#include <algorithm>
#include <bit>

#include "host/vulkan/transfer.h"
#include "shaders/embedded.h"

namespace scree {

namespace {

constexpr std::uint32_t bindings = 13;       // shaders/queries/tables.glsl
constexpr std::uint32_t rows_of_a_leaf = 4;  // likewise, to `head`
constexpr std::uint32_t rows_of_a_run = 32;
constexpr std::uint32_t digit_values = 16;
constexpr std::uint32_t digits_of_a_key = 8;
constexpr std::uint32_t head = 8;
constexpr std::size_t bytes_of_a_box = 32;
constexpr std::size_t most_at_once = std::size_t{1} << 20;  // rays: 48 MiB
// Rounds after which a thread begins none. A software device ends a shader's loops after 65,535, those of eight rays
// together; a round takes up to 1,000 more, by four hulls of 124 faces.
constexpr std::uint32_t rounds_of_a_processor = 7000, rounds_of_a_gpu = 1u << 20;
constexpr std::uint32_t most_hits_at_once = 1u << 20;  // of lists of all hits: 32 MiB

enum Step : std::uint32_t { nearest, any, count, all };

std::vector<host::Access> accesses() {
    std::vector<host::Access> made(bindings);
    made[0].uniform = true;
    return made;
}
std::uint32_t runs_of(std::uint32_t rows) {
    return (rows + rows_of_a_run - 1) / rows_of_a_run;
}
std::uint32_t leaves_of(std::uint32_t rows) {
    return std::bit_ceil(std::max(1u, (rows + rows_of_a_leaf - 1) / rows_of_a_leaf));
}

}  // namespace

RayCaster::RayCaster(std::shared_ptr<host::Device> device, std::uint32_t group_size)
    : device_(std::move(device)), group_size_(group_size) {
    layout_ = std::make_shared<host::BindingSetLayout>(device_, bindings, sizeof(Push), host::Reach::bound, accesses());
    for (const char* name : {"key_rows", "sort_rows", "scan_digits", "box_rows", "cast_rays"})
        pipelines_.try_emplace(name, layout_, name, shaders::find(std::string(name) + ".query"), std::vector{group_size_});
}

bool RayCaster::takes(const Tables& tables) const {
    const auto bindable = [&](std::size_t bytes) { return bytes <= device_->report().largest_binding; };
    for (const host::Buffer* table : {tables.properties, tables.poses, tables.quads, tables.words})
        if (!bindable(table->bytes())) return false;
    const std::uint32_t most_groups = device_->limits().maxComputeWorkGroupCount[0];
    return tables.rows > 0 && bindable(2 * bytes_of_a_box * rows_of_a_leaf * leaves_of(tables.rows)) &&
           rows_of_a_leaf * leaves_of(tables.rows) / group_size_ < most_groups && most_at_once / group_size_ < most_groups;
}

void RayCaster::make_room(host::Buffer& buffer, const char* name, std::size_t bytes) {
    if (buffer && buffer.bytes() >= bytes) return;
    bound_ = nullptr;
    buffer = {};  // freed before the new one is allocated
    buffer = host::Buffer(device_, name, bytes);
}

void RayCaster::bind() {
    make_room(rays_, "rays", sizeof(physics::QueryRay));
    make_room(meetings_, "ray hits", sizeof(physics::QueryMeeting));
    make_room(starts_, "ray hit starts", sizeof(std::uint32_t));
    if (bound_) return;
    const Tables& t = *tables_;
    bound_ = std::make_unique<host::BindingSet>(
        layout_, std::vector<const host::Buffer*>{t.parameters, t.properties, t.poses, t.quads, t.words, &sorted_, &sorted_next_,
                                                  &digits_, &row_boxes_, &node_boxes_, &rays_, &meetings_, &starts_});
}

void RayCaster::run(host::CommandBuffer& commands, const char* shader, std::uint32_t threads, std::uint32_t items,
                    std::uint32_t step, std::uint32_t first) {
    const Push push{items,
                    leaves_,
                    step,
                    (tables_->filters ? 1u : 0u) | (tables_->reordered ? 2u : 0u),
                    device_->report().is_processor ? rounds_of_a_processor : rounds_of_a_gpu,
                    first};
    commands.bind(pipelines_.at(shader), *bound_);
    commands.push(&push, sizeof push);
    commands.dispatch((threads + group_size_ - 1) / group_size_);
    commands.barrier();
}

void RayCaster::build(const Tables& tables) {
    if (tables_ != tables) bound_ = nullptr;
    tables_ = tables;
    leaves_ = leaves_of(tables.rows);
    const std::uint32_t rows = tables.rows, runs = runs_of(rows), counts = digit_values * runs;
    const std::uint32_t scan_threads = (counts + 15) / 16;
    make_room(sorted_, "rows by place", 8ull * rows);
    make_room(sorted_next_, "rows by place, next", 8ull * rows);
    make_room(digits_, "digits of places", 4ull * (head + counts + scan_threads / group_size_ + 1));
    make_room(row_boxes_, "boxes of rows", bytes_of_a_box * rows_of_a_leaf * leaves_);
    make_room(node_boxes_, "boxes of a tree", bytes_of_a_box * 2 * leaves_);
    bind();
    host::CommandBuffer commands(device_);
    commands.zero(digits_);
    commands.barrier();
    for (std::uint32_t step = 0; step < 2; ++step) run(commands, "key_rows", rows, rows, step);
    for (std::uint32_t digit = 0; digit < digits_of_a_key; ++digit) {
        run(commands, "sort_rows", runs, rows, 2 * digit);
        run(commands, "scan_digits", scan_threads, rows, 0);
        run(commands, "scan_digits", 1, rows, 1);
        run(commands, "scan_digits", scan_threads, rows, 2);
        run(commands, "sort_rows", runs, rows, 2 * digit + 1);
    }
    run(commands, "box_rows", rows_of_a_leaf * leaves_, rows, 0);
    for (std::uint32_t level = leaves_; level > 0; level /= 2) run(commands, "box_rows", level, rows, level);
    commands.end();
    device_->submit_and_wait({commands.handle()});
}

void RayCaster::submit_cast(std::uint32_t first, std::uint32_t end, std::uint32_t step) {
    bind();
    host::CommandBuffer commands(device_);
    run(commands, "cast_rays", end - first, end, step, first);
    commands.end();
    device_->submit_and_wait({commands.handle()});
}

void RayCaster::cast_nearest(std::uint32_t rays, RayTask& task, std::size_t first) {
    make_room(meetings_, "ray hits", rays * sizeof(physics::QueryMeeting));
    submit_cast(0, rays, task.wanted == RayTask::Hits::any ? any : nearest);
    task.meetings.resize(first + rays);
    const std::span<physics::QueryMeeting> made = std::span(task.meetings).subspan(first);
    host::download(device_, std::vector{host::Download{std::as_writable_bytes(made), &meetings_}});
    for (std::size_t i = 0; i < rays; ++i)
        if (made[i].distance == physics::RAY_TOO_LONG) task.left.push_back(static_cast<std::uint32_t>(first + i));
}

// Counts first, then as many rays at once as have room for their hits.
void RayCaster::cast_through(std::uint32_t rays, RayTask& task, std::size_t first) {
    make_room(starts_, "ray hit starts", (rays + 1) * sizeof(std::uint32_t));
    submit_cast(0, rays, count);
    std::vector<std::uint32_t> counts(rays), starts(rays + 1);
    host::download(device_, std::vector{host::Download{std::as_writable_bytes(std::span(counts)), &starts_}});
    for (std::uint32_t begin = 0, end = 0; begin < rays; begin = end) {
        std::uint32_t hits = 0;
        for (; end < rays; ++end) {
            const bool too_many = counts[end] > most_hits_at_once;  // or NONE: it took too long
            if (!too_many && hits + counts[end] > most_hits_at_once) break;
            if (too_many) task.left.push_back(static_cast<std::uint32_t>(first + end));
            starts[end] = hits;
            hits += too_many ? 0 : counts[end];
        }
        starts[end] = hits;
        const std::size_t before = task.meetings.size();
        for (std::uint32_t i = begin; i < end; ++i) task.starts.push_back(before + starts[i]);
        if (hits == 0) continue;
        make_room(meetings_, "ray hits", hits * sizeof(physics::QueryMeeting));
        const auto of_these = std::as_bytes(std::span(starts).subspan(begin, end - begin + 1));
        host::upload(device_, std::vector{host::Upload{of_these, &starts_, begin * sizeof(std::uint32_t)}});
        submit_cast(begin, end, all);
        task.meetings.resize(before + hits);
        const auto made = std::as_writable_bytes(std::span(task.meetings).subspan(before));
        host::download(device_, std::vector{host::Download{made, &meetings_}});
    }
}

void RayCaster::cast(const Tables& tables, RayTask& task) {
    if (tables_ != tables || built_at_ != task.moment) {
        tables_.reset();  // until it is built
        build(tables);
        built_at_ = task.moment;
    }
    const bool through = task.wanted == RayTask::Hits::all;
    for (std::size_t first = 0; first < task.rays.size(); first += most_at_once) {
        const std::span<const physics::QueryRay> rays =
            task.rays.subspan(first, std::min(most_at_once, task.rays.size() - first));
        make_room(rays_, "rays", rays.size_bytes());
        host::upload(device_, std::vector{host::Upload{std::as_bytes(rays), &rays_}});
        const auto number = static_cast<std::uint32_t>(rays.size());
        through ? cast_through(number, task, first) : cast_nearest(number, task, first);
    }
    if (through) task.starts.push_back(task.meetings.size());
}

}  // namespace scree
