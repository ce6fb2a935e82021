// Worlds: pictures with their channels as arrays.
#include <pybind11/stl.h>

#include <algorithm>
#include <cstring>

#include "compute/scene_file/document_fields.h"
#include "compute/scene_file/fields_read.h"
#include "demos/film/channels.h"
#include "demos/film/pictures.h"
#include "demos/film/style.h"
#include "demos/python/module/world_object.h"
#include "host/pictures/channel_files.h"
#include "host/pictures/image.h"

namespace scree::python {

namespace {

// Canvases kept for the next picture: of two sizes, say, that take turns.
constexpr std::size_t most_easels = 2;

host::Camera camera_of(const std::string& text) {
    const Viewpoint view = [&] {
        using namespace json_reading;
        Viewpoint read;
        read_value(json_of(text), root / "camera", read, "", {});
        schema::check_fields(root / "camera", read);
        return read;
    }();
    host::Camera camera;
    camera.eye = view.eye;
    camera.target = view.target;
    camera.vertical_fov = view.vertical_fov;
    camera.orthographic = view.orthographic;
    return camera;
}

struct Look {  // of a colour picture
    PictureStyle style;
    std::string caption, canvas = "auto";
    bool legend = false, shadows = true;
    int samples = 1;
};

int factor_of(int samples) {
    for (const int factor : {1, 2, 3, 4})
        if (factor * factor == samples) return factor;
    throw py::value_error("samples: must be 1, 4, 9 or 16 per pixel, is " + std::to_string(samples));
}

Look look_of(const SceneDocument& shown, const std::string& text) {
    using namespace json_reading;
    const Place place = root / "picture";
    json given = json_of(text);
    Look look;
    const auto take = [&](const char* key, auto& out) {
        if (const auto found = given.find(key); found != given.end()) {
            out = found->get<std::remove_reference_t<decltype(out)>>();
            given.erase(found);
        }
    };
    take("caption", look.caption);
    take("canvas", look.canvas);
    take("legend", look.legend);
    take("shadows", look.shadows);
    take("samples", look.samples);
    look.style = shown.picture.value_or(PictureStyle{});
    // Another quantity has a range and a scale of its own.
    if (given.contains("color") && given["color"] != demos::word_of(look.style.color)) {
        PictureStyle plain;
        std::tie(plain.sky, plain.sun_azimuth, plain.sun_elevation) =
            std::tuple(look.style.sky, look.style.sun_azimuth, look.style.sun_elevation);
        look.style = plain;
    }
    if (given.contains("show")) look.style.show.clear();
    only(given, place, keys_of<PictureStyle>());
    read_fields(given, place, look.style);
    schema::check_fields(place, look.style);
    return look;
}

bool alike(const host::CanvasOptions& a, const host::CanvasOptions& b) {
    return a.width == b.width && a.height == b.height && a.legend == b.legend && a.smooth == b.smooth && a.shadows == b.shadows &&
           a.sky == b.sky && a.toward_sun == b.toward_sun && a.marks == b.marks && a.velocities == b.velocities &&
           a.boxes == b.boxes && a.cells == b.cells && a.joints == b.joints && a.sleep == b.sleep && a.mark_push == b.mark_push &&
           a.joint_pull == b.joint_pull;
}

demos::Drawing& drawing_for(WorldObject& object, const host::CanvasOptions& options, const std::string& canvas,
                            std::optional<std::size_t> copy) {
    std::vector<Easel>& easels = object.easels;
    const auto found = std::find_if(easels.begin(), easels.end(), [&](const Easel& one) {
        return one.canvas == canvas && one.copy == copy && alike(one.options, options);
    });
    if (found != easels.end()) {
        std::rotate(easels.begin(), found, found + 1);
    } else {
        if (easels.size() == most_easels) easels.pop_back();
        demos::CopiesShown shown;
        if (copy) shown = {.first = *copy, .count = 1};
        easels.insert(easels.begin(), {options, canvas, copy,
                                       std::make_unique<demos::Drawing>(canvas, object.machine, object.world, options, shown)});
    }
    return *easels.front().drawing;
}

host::Image colour_picture(WorldObject& object, const host::Camera& camera, int width, int height, const Look& look,
                           std::optional<std::size_t> copy) {
    const int factor = factor_of(look.samples);
    host::CanvasOptions options;
    options.width = width * factor;
    options.height = height * factor;
    options.legend = look.legend;
    options.shadows = look.shadows;
    options.smooth = look.samples == 1;
    demos::show_overlays(look.style, object.world, options);
    demos::show_light(look.style, options);
    demos::Drawing& drawing = drawing_for(object, options, look.canvas, copy);
    drawing.update();
    const demos::LoadedScene& subject = object.as_subject();
    const host::ColorScale scale = demos::scale_of(look.style, subject, object.world.settings(), false);
    host::Image drawn = drawing.canvas().draw(camera, scale, look.caption, subject.low, subject.high);
    return factor > 1 ? host::reduced(drawn, factor) : drawn;
}

template <class Value>
py::array array_of(const std::vector<Value>& values, std::vector<py::ssize_t> shape) {
    py::array_t<Value> made(std::move(shape));
    std::memcpy(made.mutable_data(), values.data(), values.size() * sizeof(Value));
    return made;
}

py::dict render(WorldObject& object, const std::string& camera_text, int width, int height,
                const std::vector<std::string>& channels, const std::string& look_text, const std::string& camera_before,
                double seconds_before, std::optional<std::size_t> copy) {
    if (width < 1 || height < 1 || width > 16384 || height > 16384)
        throw py::value_error("size: each side must be between 1 and 16384 pixels");
    Use world(object);
    if (copy) world->gravity_of(*copy);  // throws if there is none
    const host::Camera camera = camera_of(camera_text);
    const Look look = look_of(object.shown, look_text);
    const auto wants = [&](const char* name) { return std::find(channels.begin(), channels.end(), name) != channels.end(); };
    const demos::ChannelChoice choice{wants("depth"), wants("body"), wants("part"), wants("normal"), wants("flow")};
    const demos::Before before{camera_before.empty() ? camera : camera_of(camera_before), static_cast<float>(seconds_before)};
    host::Image picture;
    demos::Channels made;
    {
        const py::gil_scoped_release unlocked;
        if (wants("color")) picture = colour_picture(object, camera, width, height, look, copy);
        if (choice.any()) made = demos::channels_of(*world, camera, width, height, choice, before, copy.value_or(0));
    }
    py::dict arrays;
    if (wants("color")) arrays["color"] = array_of(host::rgb_bytes(picture), {height, width, 3});
    if (choice.depth) arrays["depth"] = array_of(made.depth, {height, width});
    if (choice.body) arrays["body"] = array_of(made.body, {height, width});
    if (choice.part) arrays["part"] = array_of(made.part, {height, width});
    if (choice.normal) arrays["normal"] = array_of(made.normal, {height, width, 3});
    if (choice.flow) arrays["flow"] = array_of(made.flow, {height, width, 2});
    return arrays;
}

// PNG of (height, width, 3) bytes, or of (height, width) or (height, width, 3) numbers of 16 bits.
py::bytes png(const py::array& pixels) {
    const auto height = static_cast<int>(pixels.shape(0)), width = static_cast<int>(pixels.shape(1));
    const py::ssize_t channels = pixels.ndim() == 3 ? pixels.shape(2) : 1;
    std::vector<std::uint8_t> bytes;
    if (pixels.dtype().is(py::dtype::of<std::uint16_t>()) || pixels.dtype().itemsize() == 2) {
        const auto values = py::array_t<std::uint16_t, py::array::c_style | py::array::forcecast>(pixels);
        bytes = host::png16_bytes(width, height, static_cast<int>(channels),
                                  std::span(values.data(), static_cast<std::size_t>(values.size())));
    } else {
        const auto values = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>(pixels);
        if (channels != 3) throw py::value_error("a picture of bytes has the shape (height, width, 3)");
        host::Image image{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(values.size()) / 3 * 4, 255), 8};
        for (std::size_t i = 0; i < image.rgba.size() / 4; ++i) std::memcpy(&image.rgba[4 * i], values.data() + 3 * i, 3);
        bytes = host::png_bytes(image);
    }
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void bind_pictures(py::module_& module, WorldClass& of_world) {
    of_world.def("render", &render)
        .def("canvas_name",
             [](WorldObject& object) { return object.easels.empty() ? "" : object.easels.front().drawing->canvas().name(); })
        .def("suggested_camera", [](WorldObject& object) {
            Use world(object);
            const Viewpoint& view = object.as_subject().viewpoint;
            return py::make_tuple(py::make_tuple(view.eye.x, view.eye.y, view.eye.z),
                                  py::make_tuple(view.target.x, view.target.y, view.target.z), view.vertical_fov,
                                  view.orthographic);
        });
    module.def("png", &png);
    module.def("pixel_rays", [](const std::string& camera_text, int width, int height) {
        if (width < 1 || height < 1) throw py::value_error("size: each side must be at least 1 pixel");
        const std::vector<RayQuery> rays = demos::rays_through_pixels(camera_of(camera_text), width, height);
        Floats from({height, width, 3}), along({height, width, 3});
        for (std::size_t i = 0; i < rays.size(); ++i)
            for (glm::length_t k = 0; k < 3; ++k) {
                from.mutable_data()[3 * i + static_cast<std::size_t>(k)] = rays[i].from[k];
                along.mutable_data()[3 * i + static_cast<std::size_t>(k)] = rays[i].along[k];
            }
        return py::make_tuple(from, along);
    });
}

}  // namespace scree::python
