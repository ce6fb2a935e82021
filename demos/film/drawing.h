// Drawing of a world: the choice of the canvas, and the tables that it draws from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "compute/tables/state.h"
#include "compute/world.h"
#include "demos/program/backend.h"
#include "demos/program/copies.h"
#include "host/canvas/canvas.h"

namespace scree::demos {

// Bodies grouped by shape. Of copies of a scene those that are shown; a plane of the first of them is that of all.
// `parts`: convex parts in place of skins.
host::ShapeInstances instances_of(const World& world, const CopiesShown& shown = {}, bool parts = false);
// Of a share the bodies that the rank moves, and on request those that do not move, which every rank has.
host::ShapeInstances instances_of(const World::Share& share, bool with_still);
// Tables of a world that is simulated on the CPU.
host::BodyTables tables_of(const State& state);
// Of each body its linear colour and 1, or zeros: BodyTables::colors.
std::vector<glm::vec4> colors_of(const Scene& scene);

class Drawing {
public:
    // `canvas` is a value of --canvas. Throws UsageError where that canvas is not available, naming the package to
    // install. `from_host`: draws from host memory wherever the simulation runs, for update(poses).
    Drawing(const std::string& canvas, const Backend& machine, World& world, const host::CanvasOptions& options,
            const CopiesShown& shown = {}, bool from_host = false);

    host::Canvas& canvas() { return *canvas_; }
    void update();  // to be called before a picture: takes the world's current tables, with added bodies
    void update(const std::vector<physics::Pose>& poses);  // the same with other poses of its rows; reads them until finish()
    std::uint32_t contacts() const;                        // contacts at the last update
    vec3 position_of(std::size_t body) const;
    // Whether a picture may be drawn while the next steps run. Not when both use one queue: the steps would wait for
    // it, and their measured time would include it.
    bool beside_steps() const { return !from_device_; }

private:
    std::unique_ptr<host::Canvas> make_canvas() const;
    host::BodyTables tables_of_copies(const std::vector<physics::Pose>& poses);

    World& world_;
    std::string word_;
    Backend machine_;
    host::CanvasOptions options_;
    CopiesShown shown_;
    std::vector<glm::vec4> colors_;  // of each body: linear, 1; w 0: none
    // Of the copies that are shown, side by side.
    std::vector<physics::Pose> poses_;
    std::vector<physics::Bounds> bounds_;
    std::vector<physics::Contact> contacts_shown_;
    std::vector<physics::Joint> joints_;
    std::uint64_t arrangements_ = 0;  // of the bodies that the canvas was made for
    std::unique_ptr<host::Canvas> canvas_;
    bool from_device_ = false;  // draws from the simulation's tables on the device
    std::uint32_t contacts_ = 0;
};

}  // namespace scree::demos
