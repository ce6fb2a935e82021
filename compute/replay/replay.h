// Recordings of user input: what was simulated, and which command was issued before which step. Replay gives the same
// state on every processor, bit for bit.
//
//     {"scree_input": 1,
//      "scene": "wall",                    demo or scene file
//      "bodies": 0, "seed": 1,             of a demo (bodies 0: its default)
//      "rate": 60, "substeps": 8, "sleeping": true,   initial settings
//      "start_hash": "0123456789abcdef",   of the state before the first step; optional
//      "steps": 600,                       of the whole recording
//      "end_hash": "0123456789abcdef",     of the state after them; optional
//      "acts": [                           in order; "step": number of steps done before the command
//       {"step": 3, "grab": {"grip": 0, "body": 17, "anchor": [0, 0.5, 0], "target": [1, 2, 3]}},
//       {"step": 4, "drag": {"grip": 0, "target": [1, 2.5, 3]}},
//       {"step": 9, "release": {"grip": 0}},
//       {"step": 9, "add": {"shape": {"sphere": {"radius": 0.3}}, "position": [0, 2, 9], "velocity": [0, 3, -15]}},
//       {"step": 9, "join": {"kind": {"ball": {}}, "a": 17, "b": 18, "anchor_a": [0, 0.5, 0], "anchor_b": [0, -0.5, 0]}},
//       {"step": 15, "unjoin": {"joint": 0}},
//       {"step": 16, "set_material": {"body": 17, "friction": 0.2}},
//       {"step": 16, "set_mass": {"body": 17, "mass": 20}},
//       {"step": 17, "set_motion": {"body": 18, "motion": "fixed"}},
//       {"step": 18, "remove": {"body": 19}},
//       {"step": 20, "push": {"body": 17, "force": [500, 0, 0]}},
//       {"step": 30, "explode": {"centre": [0, 0, 0], "radius": 5, "speed": 10}},
//       {"step": 40, "turn": {"gravity": [0, -1.6, 0], "substeps": 4, "friction_factor": 0.5, "least_restitution": 0.9,
//                             "sleeping": false}}
//       {"step": 50, "drive": {"vehicle": 0, "throttle": 1, "brake": 0, "steer": -0.5, "hand_brake": 0}},
//       {"step": 90, "righten": {"vehicle": 0}}
//     ]}
//
// Anchors are in body frames; "add" takes a body and "join" a joint as in a scene file (bodies by index, anchors in
// body frames), "turn" (settings) and "set_material" any of their keys; "drive" lasts until the next one. SI units.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compute/replay/user_commands.h"

namespace scree::replay {

struct Input {
    std::string scene;
    std::size_t bodies = 0;
    std::uint64_t seed = 1;
    float rate = 60;
    int substeps = 12;
    bool sleeping = true;
    std::optional<std::uint64_t> start_hash, end_hash;
    std::uint64_t steps = 0;
    std::vector<TimedAct> acts;  // ascending by step
};

std::string json_of(const Input& input);

// Throws SceneError with the JSON pointer of an invalid value, or line and column of a syntax error.
Input input_from_json(std::string_view text);

// Replay, in a world of the same scene and settings:
//     require_start(input, world);
//     for (perform_due(input, world); world.steps() < input.steps; perform_due(input, world)) world.step();
//
// Throws SceneError, at /start_hash, if the world's initial state differs from the recorded one. No check once the
// world has stepped.
void require_start(const Input& input, const World& world);
// Performs the commands due at the world's step count. Throws SceneError, at the command, if it does not fit the world.
void perform_due(const Input& input, World& world);

}  // namespace scree::replay
