// READ(table, i) of tables that threads of a fused stage write for each other: storage texels, coherent across a
// barrier.
//
// A uniform texel buffer need not show this dispatch's writes before the next one. A storage texel buffer does, and
// lavapipe too fetches its 16 bytes at once.
#ifndef SCREE_STAGES_READ_COHERENT_GLSL
#define SCREE_STAGES_READ_COHERENT_GLSL

#define SCREE_PLACE(index, name, block, record, length) const int name##_place = index;
SCREE_BUFFERS(SCREE_PLACE)

// Behind the bindings of the buffers and of their texels.
#define SCREE_DECLARE_COHERENT(name) \
    layout(set = 0, binding = 2 * BUFFERS + name##_place, rgba32ui) coherent readonly uniform uimageBuffer name##_coherent;
SCREE_DECLARE_COHERENT(poses)
SCREE_DECLARE_COHERENT(velocities)
SCREE_DECLARE_COHERENT(masses)
SCREE_DECLARE_COHERENT(forces)
SCREE_DECLARE_COHERENT(impulses)
SCREE_DECLARE_COHERENT(impacts)
SCREE_DECLARE_COHERENT(slots)

#define SCREE_COHERENT_TEXEL(table, i) imageLoad(table##_coherent, int(i))

#endif
