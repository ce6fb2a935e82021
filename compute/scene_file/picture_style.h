// How a scene is shown in pictures unless the user says otherwise. The simulation does not use it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace scree {

enum class ShownQuantity {
    momentum,
    speed,
    spin,
    kinetic_energy,
    height,
    body,
    plain,
    angular_momentum,
    contact_impulse,
    contacts,
    sleep,
    material,
    own  // the body's color
};
enum class ShownMap { ember, plasma, inferno, viridis, cividis, turbo, batlow };
enum class ShownScale {
    automatic,   // root for momentum, energy and impulses, linear for all others
    linear,      // place = value / range
    root,        // place = sqrt(value / range): small values are seen beside large ones
    logarithmic  // from a thousandth of the range's upper end unless the range says
};
enum class ShownSky { day, evening, overcast, studio, night };
enum class Overlay { contacts, velocities, joints, boxes, cells, sleep, parts };

struct PictureStyle {
    ShownQuantity color = ShownQuantity::momentum;
    ShownMap map = ShownMap::ember;
    ShownScale scale = ShownScale::automatic;
    glm::vec2 range{0};  // low and high in the quantity's unit; equal: from the scene
    std::vector<Overlay> show;
    ShownSky sky = ShownSky::day;
    float sun_azimuth = 0;    // degrees about y, from z towards x
    float sun_elevation = 0;  // degrees above the horizon, 3 to 90; 0: the sun (or moon) stands where that sky has it

    bool operator==(const PictureStyle&) const = default;
};

}  // namespace scree
