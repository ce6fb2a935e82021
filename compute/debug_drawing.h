// A world as lines and points, for an engine's own drawing of it: edges of shapes, contacts, joints, boxes.
//
//     for (const scree::DebugLine& line : scree::debug_drawing(world).lines) ...
#pragma once

#include <cstdint>
#include <vector>

#include "compute/scene.h"

namespace scree {

class World;

struct DebugLine {
    vec3 from{0}, to{0};  // m
    vec3 color{1};        // red, green, blue in sRGB, 0 to 1
};
struct DebugPoint {
    vec3 position{0};  // m
    vec3 color{1};     // likewise
};
struct DebugDrawing {
    std::vector<DebugLine> lines;    // of all bodies in their order, then contacts, joints and boxes
    std::vector<DebugPoint> points;  // likewise
};

// What is drawn.
struct DebugWanted {
    // Edges of shapes in Body::color, else fixed ones in grey, kinematic ones in blue, others in white, asleep in a darker tone,
    // sensors in yellow. Of a plane a grid of 20 m.
    bool shapes = true;
    // Of each point of a contact that touches a yellow point, a white line along the normal (to the body b of ContactState), and
    // lines by the normal force (red) and friction (green) on b. Of a speculative one the point alone, in grey.
    bool contacts = true;
    // Grey lines from the bodies to their anchors, which are points, magenta between anchors that are apart, and the axes x, y
    // and z of the frame in A in red, green and blue.
    bool joints = true;
    // Boxes about bodies and parts as they are now, in dark green; the broadphase's are larger by what the next step may move.
    bool boxes = false;
    int segments = 24;                  // of a circle, 3 to 360
    float line_length = 0.2f;           // of normals and axes, m, 0 to 1e6
    float force_length = 1e-4f;         // m per N, 0 to 1e6
    std::vector<std::size_t> bodies{};  // only these, contacts and joints of one of them; none: all
};

// Reads all bodies, and contacts and joints if wanted. Throws std::invalid_argument for values out of range, std::out_of_range
// for a body.
DebugDrawing debug_drawing(const World& world, const DebugWanted& wanted = {});

}  // namespace scree
