// Field table of a scene's picture style.
#pragma once

#include <array>

#include "compute/scene_file/picture_style.h"
#include "compute/schema/field.h"

namespace scree::schema {

template <>
inline constexpr auto words<ShownQuantity> =
    std::array{"momentum",         "speed",           "spin",     "kinetic-energy", "height",   "body", "plain",
               "angular-momentum", "contact-impulse", "contacts", "sleep",          "material", "own"};
template <>
inline constexpr auto words<ShownMap> = std::array{"ember", "plasma", "inferno", "viridis", "cividis", "turbo", "batlow"};
template <>
inline constexpr auto words<ShownScale> = std::array{"auto", "linear", "root", "log"};
template <>
inline constexpr auto words<ShownSky> = std::array{"day", "evening", "overcast", "studio", "night"};
template <>
inline constexpr auto words<Overlay> = std::array{"contacts", "velocities", "joints", "boxes", "cells", "sleep", "parts"};

template <>
inline constexpr auto table<PictureStyle> = table_of(
    "picture", "How pictures show the scene unless the command line says otherwise",
    field("color", &PictureStyle::color, "Quantity shown by colour"), field("color_map", &PictureStyle::map, "Colour map"),
    field("color_scale", &PictureStyle::scale,
          "Places of values on the colour map: linear, root (square root), log, or auto: root for momentum, energy and impulses"),
    field("color_range", &PictureStyle::range, {}, "",
          "Lowest and highest value, in the unit of the quantity; equal: from the scene and its first seconds"),
    field("show", &PictureStyle::show, at_least(0), "overlays", "Overlays"),
    field("sky", &PictureStyle::sky, "Light and background"),
    field("sun_azimuth", &PictureStyle::sun_azimuth, within(360), "degrees", "Where the sun stands: about y, from z towards x"),
    field("sun_elevation", &PictureStyle::sun_elevation, between(3, 90), "degrees",
          "Height of the sun above the horizon; 0: where that sky has it, whatever sun_azimuth"));

}  // namespace scree::schema
