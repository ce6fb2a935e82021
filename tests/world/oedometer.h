// A box of grains under a servo wall, without friction at its walls: the stress along its axis is that of the lid.
#pragma once

#include <string>

#include "compute/scene_file/scene_json.h"

namespace scree::tests {

struct Oedometer {
    std::string density = "1000", gravity = "0", stress = "5000", more = {}, form = R"({"sphere": {}})", size = "0.1",
                fill = "0.33";
    static constexpr std::size_t floor = 0, lid = 5;  // bodies; grains follow
    static constexpr double area = 0.25;              // m^2

    SceneDocument document() const {
        std::string text = R"({"gravity": [0, -)" + gravity + R"(, 0], "bodies": [)";
        for (const char* wall : {R"([0, 1, 0], "offset": 0)", R"([1, 0, 0], "offset": -0.25)", R"([-1, 0, 0], "offset": -0.25)",
                                 R"([0, 0, 1], "offset": -0.25)", R"([0, 0, -1], "offset": -0.25)"})
            text += R"({"motion": "fixed", "friction": 0, "shape": {"plane": {"normal": )" + std::string(wall) + "}}}, ";
        return scene_from_json(text + R"({"name": "lid", "shape": {"box": {"half_extents": [0.25, 0.05, 0.25]}}, "friction": 0,
            "position": [0, 1.6, 0], "density": )" +
                               density + R"(}],
            "exclusions": [{"a": "lid", "b": 1}, {"a": "lid", "b": 2}, {"a": "lid", "b": 3}, {"a": "lid", "b": 4}],
            "grains": [{"size": )" +
                               size + R"(, "fill": )" + fill + R"(, "friction": 0.4, "shapes": [{"form": )" + form + R"(}],
                        "region": {"box": {"lower": [-0.25, 0, -0.25], "upper": [0.25, 0.9, 0.25]}}}],
            "servo_walls": [{"body": "lid", "stress": )" +
                               stress + R"(, "max_speed": 1}])" + more + "}");
    }
};

}  // namespace scree::tests
