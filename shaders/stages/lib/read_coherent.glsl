// READ(table, i) of what the threads of a fused stage write for each other: texels that a barrier brings up to date.
//
// A uniform texel buffer need not show before the next dispatch what this one writes. A storage texel buffer shows it, and
// lavapipe takes 16 bytes of it at once too.
#ifndef SCREE_STAGES_READ_COHERENT_GLSL
#define SCREE_STAGES_READ_COHERENT_GLSL

#define SCREE_PLACE(index, name, block, record, length) const int name##_place = index;
SCREE_BUFFERS(SCREE_PLACE)

// After the bindings of the tables themselves and of their texels.
#define SCREE_DECLARE_COHERENT(name) \
    layout(set = 0, binding = 2 * BUFFERS + name##_place, rgba32ui) coherent readonly uniform uimageBuffer name##_coherent;
SCREE_DECLARE_COHERENT(poses)
SCREE_DECLARE_COHERENT(velocities)
SCREE_DECLARE_COHERENT(masses)
SCREE_DECLARE_COHERENT(forces)
SCREE_DECLARE_COHERENT(impulses)
SCREE_DECLARE_COHERENT(slots)

#define SCREE_COHERENT_TEXEL(table, i) imageLoad(table##_coherent, int(i))

#endif
