// The demos: named scenes, each with a view of it and a promise of what will have happened at its end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "compute/scene.h"
#include "compute/scene_file/scene_json.h"
#include "demos/scenes/script.h"
#include "demos/suite/common_checks.h"

namespace scree::demos {

struct DemoOptions {
    std::size_t bodies = 0;  // wanted; scenes of a fixed size ignore it
    std::uint64_t seed = 1;
    float offset = 0;  // m along x and z, of everything: far from the origin positions are coarse
};

struct DemoScene {
    Scene scene;
    Viewpoint viewpoint;
    vec3 low, high;  // corners of where it happens, m
    float seconds;   // until the promise can be judged
    Promise promise;
    bool sleeping = true;     // bodies at rest may fall asleep; scenes that shall stand awake say no
    Script before_step = {};  // what happens during the run; a scene file cannot say it
};

struct Demo {
    const char* name;
    const char* line;    // what it shows, one line
    std::size_t bodies;  // dynamic bodies by default
    bool takes_bodies;   // --bodies changes how many
    DemoScene (*build)(const DemoOptions&);
    bool trial = false;  // made for the stability suite: listed after those made to be looked at, and checked at full size
};

const std::vector<Demo>& all_demos();
const Demo* find_demo(std::string_view name);            // null if there is none
DemoScene build(const Demo& demo, DemoOptions options);  // bodies 0: the default
DemoScene awake(DemoScene scene);                        // nobody falls asleep in it

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
DemoScene terrain(const DemoOptions&);
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

DemoScene stack20(const DemoOptions&);
DemoScene stack80(const DemoOptions&);
DemoScene smallstack(const DemoOptions&);
DemoScene heavytop(const DemoOptions&);
DemoScene pyramid100(const DemoOptions&);
DemoScene cards(const DemoOptions&);
DemoScene jenga(const DemoOptions&);
DemoScene tray(const DemoOptions&);
DemoScene pile1m(const DemoOptions&);
DemoScene mix1m(const DemoOptions&);
DemoScene overlap(const DemoOptions&);
DemoScene solids(const DemoOptions&);
DemoScene compounds(const DemoOptions&);
DemoScene rollmesh(const DemoOptions&);
DemoScene hulls1m(const DemoOptions&);
DemoScene onset(const DemoOptions&);
DemoScene hold(const DemoOptions&);
DemoScene steep(const DemoOptions&);
DemoScene rolling(const DemoOptions&);
DemoScene bounce(const DemoOptions&);
DemoScene tumbling(const DemoOptions&);
DemoScene swarm(const DemoOptions&);
DemoScene shots(const DemoOptions&);
DemoScene strikes(const DemoOptions&);
DemoScene thresholds(const DemoOptions&);
DemoScene fragments(const DemoOptions&);
DemoScene roadtest(const DemoOptions&);

}  // namespace scree::demos
