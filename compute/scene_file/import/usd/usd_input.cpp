// What a layer over a USD file must know of it.
#include "compute/scene_file/import/usd/usd_input.h"

#include <algorithm>

#include "compute/scene_file/import/usd/usd_physics.h"

namespace scree::imports {

namespace {

UsdInstancer instancer_of(const UsdStage& stage, const UsdPrim& prim) {
    UsdInstancer made{prim.path, stage.value(prim, "positions").numbers, stage.value(prim, "orientationsf").numbers};
    if (made.orientations.empty()) made.orientations = stage.value(prim, "orientations").numbers;
    const std::size_t count = made.positions.size() / 3;
    if (made.orientations.size() == 4 * count) return made;
    made.orientations.clear();
    for (std::size_t i = 0; i < count; ++i) made.orientations.insert(made.orientations.end(), {1, 0, 0, 0});
    return made;
}

}  // namespace

UsdInput usd_input(const std::filesystem::path& path, const ImportOptions& options) {
    Folder folder(path, options);
    Notes notes;
    const UsdStage stage(path.filename().string(), folder, notes);
    const UsdUnits units = units_of(stage);
    UsdInput input;
    input.default_prim = stage.metadata("defaultPrim", std::string());
    input.up_axis = units.z_up ? "Z" : "Y";
    input.meters = units.meters, input.kilograms = units.kilograms;
    input.time_codes = stage.metadata("timeCodesPerSecond", stage.metadata("framesPerSecond", 24.0));
    if (!(input.time_codes > 0 && input.time_codes <= 1e9)) input.time_codes = 24;
    input.start = stage.metadata("startTimeCode", 0.0);
    const Placed root = root_of(units, options);
    const UsdFound found = found_in(stage, units, nullptr, notes, static_cast<std::size_t>(-1));
    for (const UsdRigid& rigid : found.bodies) {
        UsdBodyPrim body;
        body.path = rigid.path;
        const Placed placed = placed_of(rigid.world);
        body.stretch = matrix_of(inverse(placed)) * rigid.world;
        body.placed = root * placed;
        body.above = matrix_of(root) * (rigid.instancer ? rigid.of_instancer : rigid.above);
        body.carrier = rigid.carrier, body.resets = rigid.resets;
        for (const UsdPrim* one = rigid.prim; one && !rigid.instancer; one = one->parent)
            if (one->instance) body.instances.push_back(one->path);
        if (rigid.instancer) {
            body.instancer = rigid.instancer->path;
            body.instance = rigid.instance, body.within = rigid.within;
            const auto known = std::any_of(input.instancers.begin(), input.instancers.end(),
                                           [&](const UsdInstancer& one) { return one.path == body.instancer; });
            if (!known) input.instancers.push_back(instancer_of(stage, *rigid.instancer));
        }
        input.bodies.push_back(std::move(body));
    }
    return input;
}

}  // namespace scree::imports
