// Pictures of a world that is shared out: each rank draws its own bodies, and the whole has the pixels of one rank's.
#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <vector>

#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "demos/film/drawing.h"
#include "demos/film/rank_parts.h"
#include "demos/scenes/demos.h"

using namespace scree;

TEST_CASE("ranks that draw their own bodies make the picture of one, pixel by pixel", "[ranks][canvas]") {
    demos::DemoScene built = demos::build(*demos::find_demo("mix"), {.bodies = 120});
    for (const Body& body : demos::build(*demos::find_demo("bins"), {}).scene.bodies)  // hulls
        if (!std::holds_alternative<Plane>(body.shape)) {
            built.scene.bodies.push_back(body);
            built.scene.bodies.back().position += vec3(9, 0, 0);
        }
    host::CanvasOptions options;
    options.width = 320;
    options.height = 200;
    options.samples = 1;
    host::Camera camera;
    camera.eye = {14, 12, 14};
    camera.target = {3, 0, 0};
    const vec3 low(-6, 0, -6), high(14, 5, 6);
    World alone(built.scene, {}, make_reference_runner(1));
    alone.step(60);
    const std::size_t followed = built.scene.bodies.size() - 1;
    for (const host::ColorBy by : {host::ColorBy::momentum, host::ColorBy::contact_impulse, host::ColorBy::body}) {
        host::ColorScale scale;
        scale.by = by;
        const auto canvas = host::make_gl_canvas(demos::instances_of(alone), options);
        canvas->set_tables(demos::tables_of(alone.state()));
        const host::Image expected = canvas->draw(camera, scale, "as one", low, high);
        for (const int ranks : {2, 3}) {
            host::Image seen;
            std::vector<demos::PartDrawing::Moment> moments(static_cast<std::size_t>(ranks));
            std::vector<std::uint8_t> shared(moments.size()), others_empty(moments.size());
            run_in_process(ranks, [&](const std::shared_ptr<Exchange>& exchange) {
                World world(built.scene, {}, make_distributed_runner(exchange));
                const auto rank = static_cast<std::size_t>(exchange->rank());
                const auto part = demos::PartDrawing::make(world, options);
                world.step(60);
                shared[rank] = part != nullptr && world.share().has_value();
                if (!demos::all_ranks(*exchange, shared[rank] != 0)) return;
                moments[rank] = part->look(followed);
                host::Image drawn = part->draw(camera, scale, rank == 0 ? "as one" : "", low, high);
                others_empty[rank] = rank == 0 || drawn.rgba.empty();
                if (rank == 0) seen = std::move(drawn);
            });
            INFO(ranks << " ranks, colour " << static_cast<int>(by));
            REQUIRE(shared == std::vector<std::uint8_t>(shared.size(), 1));
            CHECK(others_empty == std::vector<std::uint8_t>(shared.size(), 1));
            for (const demos::PartDrawing::Moment& moment : moments) {
                CHECK(moment.contacts == alone.state().counted().contacts);
                CHECK(moment.followed == alone.body(followed).position);
            }
            const bool equal_pixels = seen.rgba == expected.rgba;
            CHECK(equal_pixels);
        }
    }
}
