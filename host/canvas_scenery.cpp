// What a canvas knows of a scene before its first picture, on whatever it draws: instances and meshes.
#include "host/canvas_scenery.h"

#include "host/canvas_meshes.h"

namespace scree::host {

Scenery::Scenery(const ShapeInstances& bodies) {
    std::size_t shape = 0;
    for (const auto* list : {&bodies.spheres, &bodies.capsules, &bodies.boxes, &bodies.planes}) {
        shapes[shape++] = {static_cast<std::uint32_t>(instances.size()), static_cast<std::uint32_t>(list->size())};
        instances.insert(instances.end(), list->begin(), list->end());
    }
    if (instances.empty()) instances.push_back(0);

    const auto add = [&](Mesh as, const RoundMesh& round) {
        const auto first_direction = static_cast<std::uint32_t>(directions.size());
        meshes[static_cast<std::size_t>(as)] = {static_cast<std::uint32_t>(indices.size()),
                                                static_cast<std::uint32_t>(round.indices.size())};
        directions.insert(directions.end(), round.directions.begin(), round.directions.end());
        for (const std::uint32_t index : round.indices) indices.push_back(first_direction + index);
    };
    const int corners = round_corners(bodies.spheres.size() + bodies.capsules.size());
    add(Mesh::sphere, sphere_mesh(corners));
    add(Mesh::capsule, capsule_mesh(corners / 2));
}

Run Scenery::items(Items kind, std::uint32_t marks, std::uint32_t quads) const {
    switch (kind) {
        case Items::spheres:
            return shapes[0];
        case Items::capsules:
            return shapes[1];
        case Items::boxes:
            return shapes[2];
        case Items::planes:
            return shapes[3];
        case Items::marks:
            return {0, marks};
        case Items::quads:
            return {0, quads};
        case Items::one:
            break;
    }
    return {0, 1};
}

}  // namespace scree::host
