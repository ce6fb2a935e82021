// Building blocks of demo scenes: grounds, fixed boxes, rotations, and cameras that frame the action.
#pragma once

#include <vector>

#include "compute/scene.h"
#include "compute/scene_file/scene_json.h"

namespace scree::demos {

constexpr float degrees = 0.017453292f;  // rad

vec4 turned(vec3 unit_axis, float angle);  // quaternion; angle in rad

// A regular prism of this many sides about the y axis; radius to its corners, m.
Hull prism(int sides, float radius, float half_height);

Body ground(float friction = 0.6f);  // the plane y = 0
Body fixed_box(vec3 centre, vec3 half_extents, float friction = 0.6f, vec4 orientation = vec4(0, 0, 0, 1));
Body box_at(vec3 position, vec3 half_extents, vec4 orientation = vec4(0, 0, 0, 1));

// Adds a body of this shape and returns its index.
std::size_t add_body(Scene& scene, Shape shape, vec3 position, vec4 orientation = vec4(0, 0, 0, 1));

// Adds four fixed walls around the floor between -half and half (x, z), from y = 0 to half.y.
void add_pit(Scene& scene, vec3 half, float thickness, float friction = 0.6f);

// A camera that sees all points in a 16:9 frame, from `azimuth` (degrees; 0: from +z, 90: from +x) and `elevation`
// (degrees).
Viewpoint view_of(const std::vector<vec3>& points, float azimuth, float elevation);
// The same for the eight corners of a box.
Viewpoint view_of(vec3 low, vec3 high, float azimuth, float elevation);

}  // namespace scree::demos
