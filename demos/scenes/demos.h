// The demos: named scenes, each with a camera and a promise that is checked at the end of its run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "compute/scene.h"
#include "compute/scene_file/scene_json.h"
#include "compute/scene_stream.h"
#include "demos/scenes/script.h"
#include "demos/suite/common_checks.h"

namespace scree::demos {

struct DemoOptions {
    std::size_t bodies = 0;  // requested number; scenes of a fixed size ignore it
    std::uint64_t seed = 1;
    float offset = 0;  // m along x and z, of the whole scene: tests precision far from the origin
};

struct DemoScene {
    Scene scene;
    Viewpoint viewpoint;
    vec3 low, high;  // bounding box of the action, m
    float seconds;   // duration of the run after which the promise is judged
    Promise promise;
    bool sleeping = true;     // false in scenes that must stand awake
    Script before_step = {};  // scripted actions during the run; not part of a scene file
    PictureStyle picture = {};
    // The bodies behind those of `scene`, one after the other, as of StreamedScene (compute/scene_stream.h); build() adds them.
    std::function<void(const TakeBody& take)> others = {};
    void add_others();  // to the scene's bodies
};

struct Demo {
    const char* name;
    const char* line;    // one-line description
    std::size_t bodies;  // dynamic bodies by default
    bool takes_bodies;   // --bodies changes how many
    DemoScene (*build)(const DemoOptions&);
    bool trial = false;  // a scene of the stability suite: listed after the gallery's demos and checked at full size
};

const std::vector<Demo>& all_demos();
const Demo* find_demo(std::string_view name);                     // null if unknown
DemoScene build(const Demo& demo, DemoOptions options);           // bodies 0: the default
DemoScene build_streamed(const Demo& demo, DemoOptions options);  // with `others` apart
DemoScene awake(DemoScene scene);                                 // the scene with sleep off

DemoScene rest(const DemoOptions&);
DemoScene stack(const DemoOptions&);
DemoScene tower(const DemoOptions&);
DemoScene wall(const DemoOptions&);
DemoScene pyramid(const DemoOptions&);
DemoScene seesaw(const DemoOptions&);
DemoScene slopes(const DemoOptions&);
DemoScene cradle(const DemoOptions&);
DemoScene dominoes(const DemoOptions&);
DemoScene pile(const DemoOptions&);
DemoScene mix(const DemoOptions&);
DemoScene avalanche(const DemoOptions&);
DemoScene assortment(const DemoOptions&);
DemoScene bins(const DemoOptions&);
DemoScene terrain(const DemoOptions&);
DemoScene fountain(const DemoOptions&);
DemoScene mesh(const DemoOptions&);
DemoScene chain(const DemoOptions&);
DemoScene bridge(const DemoOptions&);
DemoScene ragdolls(const DemoOptions&);
DemoScene pendulums(const DemoOptions&);
DemoScene machine(const DemoOptions&);
DemoScene wrecking(const DemoOptions&);
DemoScene glass(const DemoOptions&);
DemoScene shatter(const DemoOptions&);
DemoScene drive(const DemoOptions&);
DemoScene cars(const DemoOptions&);
DemoScene ring(const DemoOptions&);
DemoScene gables(const DemoOptions&);
DemoScene net(const DemoOptions&);
DemoScene hopper(const DemoOptions&);
DemoScene ballast(const DemoOptions&);
DemoScene drum(const DemoOptions&);

DemoScene stack20(const DemoOptions&);
DemoScene stack80(const DemoOptions&);
DemoScene smallstack(const DemoOptions&);
DemoScene ministack(const DemoOptions&);
DemoScene heavytop(const DemoOptions&);
DemoScene heaviertop(const DemoOptions&);
DemoScene scales(const DemoOptions&);
DemoScene coins(const DemoOptions&);
DemoScene calm(const DemoOptions&);
DemoScene pyramid100(const DemoOptions&);
DemoScene cards(const DemoOptions&);
DemoScene jenga(const DemoOptions&);
DemoScene tray(const DemoOptions&);
DemoScene pile1m(const DemoOptions&);
DemoScene mix1m(const DemoOptions&);
DemoScene overlap(const DemoOptions&);
DemoScene solids(const DemoOptions&);
DemoScene compounds(const DemoOptions&);
DemoScene feet(const DemoOptions&);
DemoScene rollmesh(const DemoOptions&);
DemoScene hulls1m(const DemoOptions&);
DemoScene onset(const DemoOptions&);
DemoScene hold(const DemoOptions&);
DemoScene steep(const DemoOptions&);
DemoScene rolling(const DemoOptions&);
DemoScene yaw(const DemoOptions&);
DemoScene spins(const DemoOptions&);
DemoScene turntable(const DemoOptions&);
DemoScene arches(const DemoOptions&);
DemoScene capstan(const DemoOptions&);
DemoScene bounce(const DemoOptions&);
DemoScene tumbling(const DemoOptions&);
DemoScene swarm(const DemoOptions&);
DemoScene shots(const DemoOptions&);
DemoScene joinedshots(const DemoOptions&);
DemoScene strikes(const DemoOptions&);
DemoScene blows(const DemoOptions&);
DemoScene pairs(const DemoOptions&);
DemoScene plough(const DemoOptions&);
DemoScene thresholds(const DemoOptions&);
DemoScene fragments(const DemoOptions&);
DemoScene roadtest(const DemoOptions&);

}  // namespace scree::demos
