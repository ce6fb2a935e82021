// Features of a scene, by which stages and shader code are left out.
#pragma once

namespace scree {

struct SceneFeatures {
    bool convex = false;        // some body is a general convex shape
    bool hulls = false;         // some body is a hull
    bool triangles = false;     // there are meshes or height fields
    bool moving_parts = false;  // there are moving compounds or meshes
    bool joints = false;
    bool breaking = false;  // some body may break
    bool vehicles = false;
    bool bounces = false;    // some body has restitution
    bool rolls = false;      // some body has rolling resistance
    bool round = false;      // there are spheres or capsules
    bool tyres = false;      // some body has a tyre
    bool reordered = false;  // rows differ from ids
    bool fields = false;     // there is wind, water or an attractor
    bool surfaces = false;   // some material has more than friction, restitution and rolling resistance
    bool cohesion = false;   // some material is cohesive
    bool filters = false;    // some body has a collision filter or an excluded partner
    bool sums = false;       // contacts sum their impulses over the step
    bool copies = false;     // there are several copies of the scene
    bool gravities = false;  // whose gravity differs
    bool blocks = false;     // there are compounds or meshes: pairs of bodies in several contacts
    bool ghosts = false;     // rows of other ranks are marked (State::marks_foreign)
    bool bonds = false;      // there are bonds between bodies
    bool periodic = false;   // there is a periodic cell
    static SceneFeatures everything() {
        return {.convex = true,
                .hulls = true,
                .triangles = true,
                .moving_parts = true,
                .joints = true,
                .breaking = true,
                .vehicles = true,
                .bounces = true,
                .rolls = true,
                .round = true,
                .tyres = true,
                .reordered = true,
                .fields = true,
                .surfaces = true,
                .cohesion = true,
                .filters = true,
                .sums = true,
                .copies = true,
                .gravities = true,
                .blocks = true,
                .ghosts = true,
                .bonds = true,
                .periodic = true};
    }
    bool operator==(const SceneFeatures&) const = default;
};
static_assert(sizeof(SceneFeatures) == 23 * sizeof(bool));  // everything() names all

}  // namespace scree
