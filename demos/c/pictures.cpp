// The C interface: pictures with their channels, and exports of animations.
#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <tuple>
#include <utility>

#include "demos/c/json.h"
#include "demos/c/objects.h"
#include "demos/film/channels.h"
#include "demos/film/pictures.h"
#include "demos/film/style.h"
#include "host/pictures/channel_files.h"
#include "host/pictures/image.h"

namespace scree::c {

using namespace json_reading;

namespace {

// Canvases kept for the next picture: of two sizes, say, that take turns.
constexpr std::size_t most_easels = 2;
constexpr int most_pixels = 16384;  // a side

host::Camera camera_of(const Viewpoint& view) {
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
    std::size_t samples = 1;  // per pixel
};

int factor_of(std::size_t samples) {
    for (const std::size_t factor : {1, 2, 3, 4})
        if (factor * factor == samples) return static_cast<int>(factor);
    refuse("samples: must be 1, 4, 9 or 16 per pixel, is " + std::to_string(samples));
}

Look look_of(const SceneDocument& shown, const char* text) {
    Look look;
    look.style = shown.picture.value_or(PictureStyle{});
    if (text == nullptr) return look;
    const Place place = root / "picture";
    json given = json_given(text, "look_json");
    if (!given.is_object()) json_reading::refuse(place, "must be an object, is " + kind(given));
    const auto take = [&](const char* key, auto& out) {
        optional(given, place, key, out);
        given.erase(key);
    };
    take("caption", look.caption);
    take("canvas", look.canvas);
    take("legend", look.legend);
    take("shadows", look.shadows);
    take("samples", look.samples);
    const Names canvases{"auto", "vulkan", "gl"};
    if (std::find(canvases.begin(), canvases.end(), look.canvas) == canvases.end())
        json_reading::refuse(place / "canvas", unknown("canvas", look.canvas, canvases));
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
           a.boxes == b.boxes && a.cells == b.cells && a.joints == b.joints && a.sleep == b.sleep && a.parts == b.parts &&
           a.mark_push == b.mark_push && a.joint_pull == b.joint_pull;
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

void require_pixels(int width, int height) {
    if (width < 1 || height < 1 || width > most_pixels || height > most_pixels)
        refuse("width and height: must be between 1 and " + std::to_string(most_pixels) + " pixels, are " +
               std::to_string(width) + " and " + std::to_string(height));
}

template <class Value>
void write(const std::vector<Value>& values, Value* to) {
    if (to != nullptr) std::copy(values.begin(), values.end(), to);
}

void render(WorldObject& object, const scree_picture& wanted) {
    require_pixels(wanted.width, wanted.height);
    if (!(wanted.seconds_before >= 0 && wanted.seconds_before <= 1e6)) refuse("seconds_before: must be between 0 and 1e6 s");
    const std::optional<std::size_t> copy = copy_of(object.world, wanted.copy);
    const host::Camera camera = wanted.camera_json != nullptr ? camera_given(wanted.camera_json, "camera_json")
                                                              : camera_of(object.as_subject().viewpoint);
    const Look look = look_of(object.shown, wanted.look_json);
    const demos::Before before{
        wanted.camera_before_json != nullptr ? camera_given(wanted.camera_before_json, "camera_before_json") : camera,
        static_cast<float>(wanted.seconds_before)};
    const demos::ChannelChoice choice{wanted.depth != nullptr, wanted.body != nullptr, wanted.part != nullptr,
                                      wanted.normal != nullptr, wanted.flow != nullptr};
    std::vector<std::uint8_t> color;
    demos::Channels made;
    if (wanted.color != nullptr) color = host::rgb_bytes(colour_picture(object, camera, wanted.width, wanted.height, look, copy));
    if (choice.any())
        made = demos::channels_of(object.world, camera, wanted.width, wanted.height, choice, before, copy.value_or(0));
    write(color, wanted.color);
    write(made.depth, wanted.depth);
    write(made.body, wanted.body);
    write(made.part, wanted.part);
    write(made.normal, wanted.normal);
    write(made.flow, wanted.flow);
}

std::vector<std::uint8_t> png_of(const void* pixels, int width, int height, int channels, int bits) {
    const std::size_t values =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
    if (bits == 16) {
        std::vector<std::uint16_t> words(values);
        std::memcpy(words.data(), pixels, values * sizeof(std::uint16_t));
        return host::png16_bytes(width, height, channels, words);
    }
    const std::size_t step = static_cast<std::size_t>(channels);
    host::Image image{width, height, std::vector<std::uint8_t>(values / step * 4, 255), 8};
    for (std::size_t i = 0; i < image.rgba.size() / 4; ++i)
        for (std::size_t k = 0; k < 3; ++k) image.rgba[4 * i + k] = static_cast<const std::uint8_t*>(pixels)[step * i + k % step];
    return host::png_bytes(image);
}

}  // namespace

host::Camera camera_given(const char* text, const char* name) {
    const Viewpoint view = value_from<Viewpoint>(json_given(text, name), "camera");
    schema::check_fields(root / "camera", view);
    return camera_of(view);
}

PictureStyle style_given(const SceneDocument& shown, const char* look_json) {
    return look_of(shown, look_json).style;
}

}  // namespace scree::c

using namespace scree;
using namespace scree::c;

scree_result scree_world_render(scree_world* world, const scree_picture* picture) {
    return called([&] {
        const UsedWorld used(world);
        scree_picture wanted{};
        copy_sized(&wanted, sizeof wanted, picture, "picture");
        render(*used, wanted);
    });
}

scree_result scree_world_canvas_name(scree_world* world, const char** name) {
    return called([&] {
        given(name, "name");
        const UsedWorld used(world);
        *name = kept_text(used->easels.empty() ? "" : used->easels.front().drawing->canvas().name());
    });
}

scree_result scree_world_suggested_camera(scree_world* world, const char** camera_json) {
    return called([&] {
        given(camera_json, "camera_json");
        const UsedWorld used(world);
        Viewpoint plain;
        const Viewpoint& view = used->as_subject().viewpoint;
        std::tie(plain.eye, plain.target, plain.vertical_fov, plain.orthographic) =
            std::tie(view.eye, view.target, view.vertical_fov, view.orthographic);
        Text text;
        write_value(text, plain);
        *camera_json = kept_text(text.take());
    });
}

scree_result scree_pixel_rays(const char* camera_json, int width, int height, float* from, float* along) {
    return called([&] {
        given(from, "from");
        given(along, "along");
        require_pixels(width, height);
        const std::vector<RayQuery> rays = demos::rays_through_pixels(camera_given(camera_json, "camera_json"), width, height);
        for (std::size_t i = 0; i < rays.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                from[3 * i + static_cast<std::size_t>(k)] = rays[i].from[k];
                along[3 * i + static_cast<std::size_t>(k)] = rays[i].along[k];
            }
    });
}

scree_result scree_png(const void* pixels, int width, int height, int channels, int bits, scree_array* bytes) {
    return called([&] {
        given(bytes, "bytes");
        given_array(pixels, 1, "pixels");
        require_pixels(width, height);
        if (bits != 8 && bits != 16) refuse("bits: must be 8 or 16, are " + std::to_string(bits));
        if (channels != 1 && channels != 3) refuse("channels: must be 1 or 3, are " + std::to_string(channels));
        *bytes = kept_array(png_of(pixels, width, height, channels, bits));
    });
}

scree_result scree_world_export(scree_world* world, const char* path, int every, int clips, scree_export** made) {
    return called([&] {
        given(made, "made");
        const UsedWorld used(world);
        const std::string name = text_of(path, "path");
        if (!name.ends_with(".glb") && !name.ends_with(".usda")) refuse("path: must end with .glb or .usda, is \"" + name + "\"");
        if (every < 1) refuse("every: must be at least 1 step, is " + std::to_string(every));
        if (clips < 0) refuse("clips: must be at least 0 moments, is " + std::to_string(clips));
        if (clips > 0 && !name.ends_with(".usda")) refuse("clips: are of a .usda");
        const auto file = std::make_shared<demos::Animation>(demos::ExportOptions{name, every, false, clips}, used->world);
        file->write();
        *made = handle_of(std::make_shared<ExportObject>(ExportObject{used.shared(), file}));
        used->exports.push_back(file);
    });
}

scree_result scree_export_close(scree_export* made) {
    return called([&] {
        const std::shared_ptr<ExportObject> object = object_of(made);
        if (const std::shared_ptr<WorldObject> world = object->world.lock()) {
            const std::unique_lock lock(world->in_use, std::try_to_lock);
            if (!lock.owns_lock()) throw Failure(SCREE_BUSY, "a call is in the export's world");
            object->file->write();  // refused, it may be closed again
            std::erase(world->exports, object->file);
        }
        ended(HandleKind::export_file, made);
    });
}
