// The list of demos.
#include "demos/scenes/demos.h"

#include <algorithm>

#include "demos/scenes/looks.h"

namespace scree::demos {

const std::vector<Demo>& all_demos() {
    static const std::vector<Demo> demos = {
        {"rest", "a sphere, a capsule and a box come to rest on the ground", 4, false, rest},
        {"stack", "ten boxes, placed a little carelessly, stand", 10, false, stack},
        {"tower", "a single column of forty boxes stands", 40, false, tower},
        {"wall", "a wall of sixteen courses in running bond stands", 520, false, wall},
        {"pyramid", "a pyramid of 465 boxes stands", 465, false, pyramid},
        {"seesaw", "equal weights balance; unequal weights tip", 6, false, seesaw},
        {"slopes", "bodies slide, stick and roll down inclines as the formulas say", 8, false, slopes},
        {"cradle", "five spheres in a row pass on a blow", 10, false, cradle},
        {"dominoes", "a winding row of dominoes falls, to the last", 60, false, dominoes},
        {"pile", "boxes fall into a pit and come to rest", 1000, true, pile},
        {"mix", "spheres, capsules and boxes fall into a pit and come to rest", 1000, true, mix},
        {"avalanche", "mixed bodies tumble down a terraced slope", 4000, true, avalanche},
        {"assortment", "bodies of every shape and of varied size fall into a pit and come to rest", 2000, true, assortment},
        {"bins", "twenty stones settle into a bin; many bins at once with --copies", 20, false, bins},
        {"terrain", "bodies of every shape tumble down hills, a height field, and gather in the valley", 600, true, terrain},
        {"fountain", "bodies are born at a nozzle, fall into a basin, and are taken away for ever", 900, true, fountain},
        {"mesh", "bodies of every shape come down a staircase into a bowl, a mesh from a file", 120, true, mesh},
        {"chain", "two chains of twenty links swing, one with a load of a hundred links", 41, false, chain},
        {"bridge", "a hanging bridge of planks bears a dozen crates", 36, false, bridge},
        {"ragdolls", "three hundred figures of eleven limbs fall on steps and come to rest", 3300, true, ragdolls},
        {"pendulums", "pendulums of every kind keep their period and their energy for a minute", 7, false, pendulums},
        {"machine", "a motor turns two gears, a crank and a piston", 18, false, machine},
        {"wrecking", "a heavy ball on a chain breaks through a brick wall", 204, false, wrecking},
        {"glass", "a ball goes through six panes of glass, and stops at the seventh", 8, false, glass},
        {"shatter", "bodies that fall into a pit burst into pieces", 2000, true, shatter},
        {"drive", "a car drives a course with a ramp, a banked curve and things to push", 37, false, drive},
        {"cars", "cars of five bodies drive round and round, each by itself", 100, true, cars},
        {"ring", "a round wall of bricks stands", 2200, true, ring},
        {"gables", "rows of gables, triangular walls of 496 bricks, stand", 1984, true, gables},
        {"net", "a net of balls on joints falls over a round post", 900, true, net},
        {"hopper", "grains by a sieve curve run out of a hopper, at a constant rate", 4000, true, hopper},
        {"ballast", "a sleeper on railway ballast bears a load that comes and goes", 3000, true, ballast},
        {"drum", "a drum turns, and balls cascade in it at an angle that stays", 3000, true, drum},

        {"stack20", "twenty boxes stand", 20, false, stack20, true},
        {"stack80", "eighty boxes stand for a minute, asleep", 80, false, stack80, true},
        {"smallstack", "ten boxes of 0.2 m stand", 10, false, smallstack, true},
        {"ministack", "ten boxes of 2 cm stand", 10, false, ministack, true},
        {"heavytop", "nine boxes carry one that weighs as much as a hundred", 10, false, heavytop, true},
        {"heaviertop", "nine boxes carry one that weighs as much as three hundred", 10, false, heaviertop, true},
        {"scales", "columns of boxes of 1, 2 and 10 cm and a pyramid of 1 cm come to rest", 160, false, scales, true},
        {"coins", "stacks of coins, prisms and plates, ten times as wide as thick, come to rest", 140, false, coins, true},
        {"calm", "a heap of every shape comes to rest, awake", 300, true, calm, true},
        {"pyramid100", "a pyramid of 5,050 boxes stands", 5050, false, pyramid100, true},
        {"cards", "a house of cards, three storeys high, stands", 15, false, cards, true},
        {"jenga", "a tower of eighteen layers of three blocks stands", 54, false, jenga, true},
        {"tray", "a plate of less than half their weight carries 500 boxes", 501, false, tray, true},
        {"pile1m", "boxes of 1 m lie still in a pit, fall asleep, and wake where a ball strikes", 10000, true, pile1m, true},
        {"mix1m", "spheres, capsules and boxes of about 1 m lie still in a pit", 10000, true, mix1m, true},
        {"overlap", "bodies that overlap by half come apart", 10000, true, overlap, true},

        {"solids", "cylinders, cones and hulls stand, stack and roll", 17, false, solids, true},
        {"thresholds", "bodies break on what is just above their threshold, not just below", 32, false, thresholds, true},
        {"roadtest", "cars brake, accelerate, corner and park as the formulas say", 35, false, roadtest, true},
        {"fragments", "bodies that break in empty space keep their momentum", 64, false, fragments, true},

        {"compounds", "tables of five boxes carry columns; a bar tips where its centre of mass says", 14, false, compounds, true},
        {"feet", "columns of tables, benches and stools stand, and lie still", 25, false, feet, true},
        {"rollmesh", "a ball rolls over 10,000 triangles in a plane as over a plane", 1, false, rollmesh, true},
        {"hulls1m", "hulls of 1 m settle in a pit", 10000, true, hulls1m, true},

        {"onset", "boxes begin to slide at the angle atan(mu)", 18, false, onset, true},
        {"hold", "boxes below that angle do not creep", 9, false, hold, true},
        {"steep", "boxes slide and round bodies roll down a steep incline as the formulas say", 9, false, steep, true},
        {"rolling", "rolling resistance brings round bodies to rest where the formula says", 12, false, rolling, true},
        {"yaw", "boxes slide straight down at any yaw", 9, false, yaw, true},
        {"spins", "discs and plates that slide and spin stop where uniform pressure says", 10, false, spins, true},
        {"turntable", "boxes and stacks ride on turntables", 36, false, turntable, true},
        {"arches", "masonry arches stand or fall by their thickness", 96, false, arches, true},
        {"capstan", "ropes round a peg hold or run by their friction", 264, false, capstan, true},
        {"bounce", "bodies bounce to e^2 of the height of their fall", 15, false, bounce, true},
        {"tumbling", "free boxes turn over and keep angular momentum and energy", 3, false, tumbling, true},
        {"swarm", "bodies colliding in empty space keep their momentum", 64, false, swarm, true},
        {"shots", "fast spheres and boxes do not pass a thin wall", 10000, true, shots, true},
        {"joinedshots", "fast bodies on joints do not pass a thin wall", 4000, true, joinedshots, true},
        {"strikes", "fast spheres and boxes do not pass thin plates or small bodies", 1500, true, strikes, true},
        {"blows", "elastic impacts of rows, of joined balls and of pendulums keep their energy", 67, false, blows, true},
        {"pairs", "balls that meet off centre keep their energy", 40, false, pairs, true},
        {"plough", "kinematic plates leave nothing behind", 84, false, plough, true},
    };
    return demos;
}

const Demo* find_demo(std::string_view name) {
    const auto& demos = all_demos();
    const auto found = std::find_if(demos.begin(), demos.end(), [&](const Demo& demo) { return name == demo.name; });
    return found == demos.end() ? nullptr : &*found;
}

void DemoScene::add_others() {
    if (others) others([&](Body body) { scene.bodies.push_back(std::move(body)); });
    others = nullptr;
}

DemoScene build(const Demo& demo, DemoOptions options) {
    DemoScene made = build_streamed(demo, options);
    made.add_others();
    return made;
}

DemoScene build_streamed(const Demo& demo, DemoOptions options) {
    if (options.bodies == 0 || !demo.takes_bodies) options.bodies = demo.bodies;
    DemoScene made = demo.build(options);
    set_look(demo.name, made);
    const vec3 offset(options.offset, 0, options.offset);
    for (Body& body : made.scene.bodies) body.position += offset;
    for (vec3* place : {&made.viewpoint.eye, &made.viewpoint.target, &made.low, &made.high}) *place += offset;
    for (Vehicle& vehicle : made.scene.vehicles)
        for (WayPoint& point : vehicle.route) point.position += offset;
    for (ViewKey& key : made.viewpoint.path) key.eye += offset, key.target += offset;
    if (made.others && options.offset != 0)
        made.others = [others = std::move(made.others), offset](const TakeBody& take) {
            others([&](Body body) {
                body.position += offset;
                take(std::move(body));
            });
        };
    return made;
}

DemoScene awake(DemoScene scene) {
    scene.sleeping = false;
    return scene;
}

}  // namespace scree::demos
