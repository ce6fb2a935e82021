// Options of pictures.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>

#include "compute/scene_file/hex_color.h"
#include "demos/film/annotations.h"
#include "demos/film/channels.h"
#include "demos/film/style.h"
#include "demos/program/exit_status.h"
#include "demos/program/options/option_parsing.h"
#include "demos/program/options/options.h"

namespace scree::demos {

namespace {

void set_size(PictureOptions& options, const std::string& word) {
    const auto [width, height] = halves(word, 'x', "--size", "WIDTHxHEIGHT");
    const auto pixels_of = [](const std::string& side) {
        const double pixels = number_of(side, "--size");
        if (pixels != std::floor(pixels) || pixels < 16 || pixels > 16384) {
            throw CLI::ValidationError("--size", "each side must be a whole number of pixels between 16 and 16384, is " + side);
        }
        return static_cast<int>(pixels);
    };
    options.width = pixels_of(width);
    options.height = pixels_of(height);
}

void set_range(PictureOptions& options, const std::string& word) {
    const auto [low, high] = halves(word, ':', "--color-range", "LOW:HIGH");
    options.color_range = {float_of(low, "--color-range"), float_of(high, "--color-range")};
    if (!(options.color_range->first < options.color_range->second)) {
        throw CLI::ValidationError("--color-range", "LOW must be below HIGH, is " + word);
    }
}

void set_camera(CameraOptions& options, const std::string& list) {
    const std::vector<std::string> known = {"fit", "orbit", "follow", "chase", "still"};
    for (std::size_t from = 0, to = 0; from <= list.size(); from = to + 1) {
        to = std::min(list.find(',', from), list.size());
        const std::string word = list.substr(from, to - from);
        const std::size_t colon = std::min(word.find(':'), word.size());
        const std::string name = word.substr(0, colon);
        const std::string rest = colon < word.size() ? word.substr(colon + 1) : "";
        if (const std::string wrong = one_of(known)(name); !wrong.empty()) throw CLI::ValidationError("--camera", wrong);
        if ((name == "fit" || name == "still") && colon < word.size())
            throw CLI::ValidationError("--camera", name + " takes no value");
        if (name == "fit") options.fit = true;
        if (name == "still") options.still = true;
        if (name == "orbit") {
            options.orbit = rest.empty() ? 20.0 : number_of(rest, "--camera", ", such as orbit:20");
            if (std::abs(*options.orbit) < 0.1 || std::abs(*options.orbit) > 1e6) {
                throw CLI::ValidationError("--camera",
                                           "orbit: a turn takes between 0.1 and 1e6 s, or as many negative for the "
                                           "other way round; is " +
                                               rest);
            }
        }
        if (name == "follow" || name == "chase") {
            if (rest.empty())
                throw CLI::ValidationError("--camera", fmt::format("{0} needs a body: {0}:NAME or {0}:INDEX", name));
            options.follow = rest;
            options.chase = name == "chase";
        }
    }
}

void set_sun(PictureOptions& options, const std::string& word) {
    const auto [azimuth, elevation] = halves(word, ',', "--sun", "AZIMUTH,ELEVATION");
    options.sun = {float_of(azimuth, "--sun"), float_of(elevation, "--sun")};
    if (!(std::abs(options.sun->first) <= 360))
        throw CLI::ValidationError("--sun", "AZIMUTH must be between -360 and 360 degrees, is " + azimuth);
    if (!(options.sun->second >= 3 && options.sun->second <= 90))
        throw CLI::ValidationError("--sun", "ELEVATION must be between 3 and 90 degrees, is " + elevation);
}

void set_blur(PictureOptions& options, const std::string& word) {
    const std::size_t comma = std::min(word.find(','), word.size());
    options.shutter = float_of(word.substr(0, comma), "--motion-blur");
    if (!(options.shutter > 0 && options.shutter <= 1))
        throw CLI::ValidationError("--motion-blur", "SHUTTER must be above 0 and at most 1, is " + word.substr(0, comma));
    if (comma == word.size()) return;
    const std::string count = word.substr(comma + 1);
    const double samples = number_of(count, "--motion-blur");
    if (samples != std::floor(samples) || samples < 2 || samples > 64)
        throw CLI::ValidationError("--motion-blur", "SAMPLES must be a whole number from 2 to 64, is " + count);
    options.shutter_samples = static_cast<int>(samples);
}

void set_moment(PictureOptions& options, const std::string& word) {
    options.from = number_of(word, "--frame-at");
    if (!(options.from >= 0 && options.from <= 1e6))
        throw CLI::ValidationError("--frame-at", "must be between 0 and 1e6 s, is " + word);
    options.until = options.from;
}

void set_moments(PictureOptions& options, const std::string& word) {
    const auto [from, until] = halves(word, ':', "--frame-range", "FROM:TO");
    options.from = number_of(from, "--frame-range");
    options.until = number_of(until, "--frame-range");
    if (!(options.from >= 0 && options.from < *options.until && *options.until <= 1e6))
        throw CLI::ValidationError("--frame-range", "must be FROM:TO with 0 <= FROM < TO <= 1e6 s, is " + word);
}

using Set = std::function<void(const std::string&)>;

void add_camera(CLI::App& command, CameraOptions& options) {
    const char* group = "Camera";
    command
        .add_option_function<std::string>(
            "--camera", Set([&options](const std::string& word) { set_camera(options, word); }),
            "Camera motion, separated by commas: fit (frame the whole scene), orbit[:SECONDS] (circle the target, one turn in "
            "20 s by default), follow:BODY (by name or index), chase:BODY (from behind its way), still (the scene's camera "
            "without its motion). Default: the camera of the scene.")
        ->group(group);
    command
        .add_option_function<std::string>("--eye",
                                          Set([&options](const std::string& word) { options.eye = vector_of(word, "--eye"); }),
                                          "Camera position X,Y,Z, m; relative to the body if both follow and --target are given.")
        ->group(group);
    command
        .add_option_function<std::string>(
            "--target", Set([&options](const std::string& word) { options.target = vector_of(word, "--target"); }),
            "Point X,Y,Z that the camera looks at, m.")
        ->group(group);
    command.add_option("--fov", options.vertical_fov, "Vertical field of view, degrees. Default: the scene's, mostly 45.")
        ->check(between(1, 170))
        ->group(group);
    command.add_flag("--orthographic", options.orthographic, "Orthographic projection; the target keeps its size.")->group(group);
}

void add_outputs(CLI::App& command, PictureOptions& options) {
    const char* group = "Pictures";
    command.add_option("--frames", options.frames, "Folder for frame_000000.png and so on.")->group(group);
    command
        .add_flag("--overwrite", options.overwrite, "Remove frames and channels of an earlier run from the folder of --frames.")
        ->group(group);
    command
        .add_option(
            "--frame-files", options.frame_files,
            "png, or exr: linear light in half floats, with the channels of --channels as layers of floats: Z, ids.X, parts.X, "
            "normals.X to .Z, flow.X and .Y. Default: png.")
        ->check(one_of({"png", "exr"}))
        ->group(group);
    command
        .add_option("--png-depth", options.bits,
                    "Bits per channel that frames are drawn with, 8 or 16 (needs Vulkan). Default: 8, for EXR files 16.")
        ->check(CLI::IsMember({8, 16}))
        ->group(group);
    command.add_option("--video", options.video, "Video file, NAME.mp4 (needs ffmpeg).")->group(group);
    command.add_option("--preview", options.preview, "Small animated picture, NAME.gif or NAME.webp (needs ffmpeg).")
        ->group(group);
    command
        .add_option("--raw", options.raw,
                    "Raw pixels, rgb24 (rgb48 with --png-depth 16), to a file, a pipe or - (standard output): scree run mix "
                    "--raw - | ffmpeg -f rawvideo -pixel_format rgb24 -video_size 1280x720 -framerate 30 -i - mix.mkv")
        ->group(group);
    command
        .add_option("--html", options.html,
                    "A page, NAME.html, that plays the run in any browser without a network: bodies from all sides, and their "
                    "momentum, speed and forces over time. Poses are within a few thousandths of a body's size; the page tells "
                    "its errors. Takes --fps (as near as whole steps allow), --color and its like, --show, --sky, --sun and the "
                    "camera. Contacts are recorded of at most 2000 bodies, or with --show contacts.")
        ->group(group);
    command
        .add_option("--cameras", options.cameras,
                    "JSON file with the camera of each picture: pose, world-to-camera matrix, focal length in pixels.")
        ->group(group);
    command
        .add_option("--channels", options.channels,
                    "Channels of each frame as files beside it, separated by commas: depth (m, along the optical axis), ids (of "
                    "bodies), parts (of compounds, triangles of meshes), normals (of the world), flow (pixels since the frame "
                    "before). Of what the frame shows at pixel centres; needs --frames.")
        ->check(one_of(channel_words()))
        ->delimiter(',')
        ->expected(1)
        ->take_all()
        ->group(group);
    command
        .add_option(
            "--channel-files", options.channel_files,
            "Files of --channels: npy (float32 and int32; nothing is inf, -1 or 0), png (16 bits: depth in mm, ids and "
            "parts + 1, 0 for nothing, normals from -1 to 1, flow 64 levels a pixel about 32768), or both. Default: both.")
        ->check(one_of({"npy", "png", "both"}))
        ->group(group);
    command
        .add_option(
            "--annotations", options.annotations,
            "Labels of each frame of dynamic bodies, exact at pixel centres, to train with: coco (boxes, masks, areas and "
            "visibility in annotations.json beside the frames), or bop (a data set with poses, models, depth and masks; "
            "frames are train/000000/rgb/000000.png). Frames have neither legend nor caption then; needs --frames.")
        ->check(one_of(annotation_words()))
        ->group(group);
    command
        .add_option_function<std::string>("--size", Set([&options](const std::string& word) { set_size(options, word); }),
                                          "Picture size in pixels, WIDTHxHEIGHT. Default: 1280x720.")
        ->group(group);
    command.add_option("--fps", options.fps, "Frames per simulated second, at most --rate. Default: 30.")
        ->check(between(0.1, 1000.0))
        ->group(group);
    CLI::Option* const at = command
                                .add_option_function<std::string>(
                                    "--frame-at", Set([&options](const std::string& word) { set_moment(options, word); }),
                                    "One picture alone, of this simulated time, s, as frame_000000.png. Without "
                                    "--seconds and --steps the run ends there.")
                                ->group(group);
    command
        .add_option_function<std::string>("--frame-range",
                                          Set([&options](const std::string& word) { set_moments(options, word); }),
                                          "Pictures from one simulated time to another alone, FROM:TO, s. Without --seconds and "
                                          "--steps the run ends there.")
        ->excludes(at)
        ->group(group);
}

}  // namespace

// Options of pictures that say something of a page, too.
static bool is_of_pages(const std::string& option) {
    for (const char* known :
         {"--html", "--fps", "--color", "--color-map", "--color-range", "--color-scale", "--show", "--sky", "--sun"})
        if (option == known) return true;
    return false;
}

// What frames of BOP are not.
static void require_bop(const PictureOptions& options) {
    const auto refuse = [](const char* option, const char* reason) {
        throw UsageError(fmt::format("--annotations bop: not with {}: {}", option, reason));
    };
    if (options.frame_files == "exr") refuse("--frame-files exr", "its frames are PNG files");
    if (options.bits == 16) refuse("--png-depth 16", "its frames have 8 bits");
    if (options.background == "none") refuse("--background none", "its frames have no transparency");
    if (options.camera.orthographic) refuse("--orthographic", "its cameras have a focal length");
    if (!options.channels.empty()) refuse("--channels", "it has depth and masks itself; run again for others");
}

void PictureOptions::require_sense(const CLI::App& command) const {
    for (const char* option : {"--frames", "--video", "--preview", "--raw", "--html", "--cameras", "--report"}) {
        for (const std::string& name : command.get_option(option)->results())
            if (name.empty()) throw UsageError(fmt::format("{}: the name is empty; name a file or a folder", option));
    }
    if (!channels.empty() && frames.empty()) throw UsageError("--channels: are files beside frames; add --frames DIR");
    if (!annotations.empty() && frames.empty()) throw UsageError("--annotations: are files beside frames; add --frames DIR");
    if (annotations == "bop") require_bop(*this);
    if (frames.empty() && overwrite) throw UsageError("--overwrite: no frames are asked for; add --frames DIR");
    if (frames.empty() && command.count("--frame-files") != 0)
        throw UsageError("--frame-files: no frames are asked for; add --frames DIR");
    if (frame_files == "exr" && command.count("--channel-files") != 0)
        throw UsageError("--channel-files: with --frame-files exr the channels are layers of the frames; leave it out");
    if (channels.empty() && command.count("--channel-files") != 0)
        throw UsageError("--channel-files: no channels are asked for; add --channels depth,ids");
    for (const char* option : {"--video", "--preview", "--raw"}) {
        if (background == "none" && command.count(option) != 0)
            throw UsageError(fmt::format("--background none: {} has no transparency; write --frames alone", option));
    }
    if (wanted()) return;
    for (const CLI::Option* option : command.get_options()) {
        const std::string& group = option->get_group();
        if (option->count() == 0 || (group != "Pictures" && group != "Camera")) continue;
        if (!html.empty() && (group == "Camera" || is_of_pages(option->get_name()))) continue;
        const CLI::Option* const vtk = command.get_option_no_throw("--vtk");
        if (option->get_name() == "--fps" && vtk && vtk->count() > 0) continue;
        throw UsageError(option->get_name() + ": no pictures are asked for; add --frames, --video, --preview or --raw" +
                         (is_of_pages(option->get_name()) || group == "Camera" ? ", or --html" : ""));
    }
}

void add_options(CLI::App& command, PictureOptions& options) {
    add_outputs(command, options);
    const char* group = "Pictures";
    command
        .add_option("--color", options.color,
                    "Quantity shown by colour. contact-impulse: sum over the body's contacts in one substep; sleep: how long the "
                    "body has "
                    "been still; material: friction, restitution and density; own: the colours of the scene file. Default: the "
                    "scene's, mostly momentum.")
        ->check(one_of(color_words()))
        ->group(group);
    command
        .add_option(
            "--color-map", options.color_map,
            "Colour map: ember (light grey for 0, then yellow, red, violet), plasma, inferno, viridis, cividis, batlow (dark "
            "for 0), turbo (a rainbow). Default: the scene's, mostly ember.")
        ->check(one_of(color_map_words()))
        ->group(group);
    command
        .add_option_function<std::string>("--color-range", Set([&options](const std::string& word) { set_range(options, word); }),
                                          "Colour range LOW:HIGH in the unit of --color. Default: the scene's; else from 0 to "
                                          "what 95% of the bodies stay below "
                                          "in the first 2 s (simulated beforehand on the CPU where that is a short work), or in "
                                          "a fall over the scene's height.")
        ->group(group);
    command
        .add_option(
            "--color-scale", options.color_scale,
            "Colour scale: linear; root (square root: small values are seen beside large ones); log (from a thousandth of "
            "the range's upper end unless --color-range says); auto (root for momentum, energy and impulses). Default: "
            "the scene's, mostly auto.")
        ->check(one_of(color_scale_words()))
        ->group(group);
    std::vector<std::string> shown = overlay_words();
    shown.emplace_back("none");
    command
        .add_option(
            "--show", options.show,
            "Overlays, separated by commas: contacts (points, with the normal force as a line), velocities (arrows, the way "
            "in 0.2 s), joints (anchors and axes; blue without force, yellow at ten times the lighter body's weight, red at a "
            "hundred times), boxes (AABBs over the next step), cells (occupied broadphase cells), sleep (sleepers dull and "
            "blue), parts (of meshes that move their convex parts), none. Default: the scene's, mostly none.")
        ->check(one_of(shown))
        ->delimiter(',')
        ->expected(1)
        ->take_all()
        ->group(group);
    command
        .add_option("--samples", options.samples,
                    "Samples per pixel, 1, 4, 9 or 16: pictures are drawn 2, 3 or 4 times as wide and high, and averaged. "
                    "Default: 1, with smoothed edges.")
        ->check(CLI::IsMember({1, 4, 9, 16}))
        ->group(group);
    command
        .add_option_function<std::string>("--motion-blur", Set([&options](const std::string& word) { set_blur(options, word); }),
                                          "Motion blur, SHUTTER[,SAMPLES]: each picture is the mean of SAMPLES (8) pictures of "
                                          "the moments of the last SHUTTER (above 0, at most 1) of the time between pictures, "
                                          "with bodies interpolated between steps. The camera stands still meanwhile.")
        ->group(group);
    command
        .add_option("--sky", options.sky,
                    "Light and background: day, evening (a low, warm sun), overcast (faint shadows), studio (light grey), "
                    "night (moonlight). Default: the scene's, mostly day.")
        ->check(one_of(sky_words()))
        ->group(group);
    command
        .add_option(
            "--background", options.background,
            "sky, or none: frames are transparent but for bodies, overlays, legend and caption. Planes leave the shadows on "
            "them, black and as opaque as they are dark; there is no haze. Or a colour to lay the same over, #rrggbb or #rgb "
            "(quoted in a shell). Default: sky.")
        ->check([](const std::string& word) {
            if (word == "sky" || word == "none" || color_of_hex(word)) return std::string();
            return fmt::format("must be sky, none or a colour in hexadecimal digits, '#rrggbb' or '#rgb'; is '{}'", word);
        })
        ->group(group);
    command
        .add_option_function<std::string>("--sun", Set([&options](const std::string& word) { set_sun(options, word); }),
                                          "Where the sun stands, AZIMUTH,ELEVATION, degrees: about y from z towards x, and "
                                          "above the horizon (3 to 90). Default: the scene's, or the sky's.")
        ->group(group);
    command
        .add_option("--canvas", options.canvas,
                    "Renderer: vulkan, gl (OpenGL ES), or auto (vulkan on the device that simulates; with --backend cpu gl, or "
                    "vulkan where there is no gl). Both draw the same picture. Default: auto.")
        ->check(one_of({"auto", "vulkan", "gl"}))
        ->group(group);
    command.add_flag("!--no-legend", options.legend, "Leave the colour legend out.")->group(group);
    command.add_flag("!--no-caption", options.caption, "Leave out the caption (name, time, bodies, contacts, device).")
        ->group(group);
    add_camera(command, options.camera);
}

}  // namespace scree::demos
