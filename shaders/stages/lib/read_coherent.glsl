// READ(table, i) of what the threads of a fused stage write for each other: texels that a barrier brings up to date.
//
// A uniform texel buffer need not show before the next dispatch what this one writes. A storage texel buffer shows it, and
// lavapipe takes 16 bytes of it at once too.
#ifndef SCREE_STAGES_READ_NOW_GLSL
#define SCREE_STAGES_READ_NOW_GLSL

#define SCREE_PLACE(index, name, block, record, length) const int name##_place = index;
SCREE_BUFFERS(SCREE_PLACE)

// After the bindings of the tables themselves and of their texels.
#define SCREE_DECLARE_NOW(name) \
    layout(set = 0, binding = 2 * BUFFERS + name##_place, rgba32ui) coherent readonly uniform uimageBuffer name##_now;
SCREE_DECLARE_NOW(poses)
SCREE_DECLARE_NOW(velocities)
SCREE_DECLARE_NOW(masses)
SCREE_DECLARE_NOW(loads)
SCREE_DECLARE_NOW(impulses)
SCREE_DECLARE_NOW(slots)

#define NOW(name, i) uintBitsToFloat(imageLoad(name##_now, int(i)))

Pose read_poses(uint i) {
    vec4 position = NOW(poses, 2u * i);
    return Pose(vec3(position), position.w, NOW(poses, 2u * i + 1u));
}
Velocity read_velocities(uint i) {
    vec4 linear = NOW(velocities, 2u * i), angular = NOW(velocities, 2u * i + 1u);
    return Velocity(vec3(linear), linear.w, vec3(angular), angular.w);
}
Mass read_masses(uint i) {
    vec4 first = NOW(masses, 2u * i), second = NOW(masses, 2u * i + 1u);
    return Mass(first.x, first.y, first.z, first.w, second.x, second.y, second.z, second.w);
}
Load read_loads(uint i) {
    vec4 linear = NOW(loads, 2u * i), angular = NOW(loads, 2u * i + 1u);
    return Load(vec3(linear), linear.w, vec3(angular), angular.w);
}
Impulse read_impulses(uint i) {
    vec4 friction = NOW(impulses, 6u * i + 3u), rolling = NOW(impulses, 6u * i + 4u), d = NOW(impulses, 6u * i + 5u);
    return Impulse(NOW(impulses, 6u * i), NOW(impulses, 6u * i + 1u), NOW(impulses, 6u * i + 2u), vec3(friction), friction.w,
                   vec3(rolling), rolling.w, vec3(d), d.w);
}
Slot read_slots(uint i) {
    vec4 linear = NOW(slots, 2u * i), angular = NOW(slots, 2u * i + 1u);
    return Slot(vec3(linear), linear.w, vec3(angular), angular.w);
}

#endif
