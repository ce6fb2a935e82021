// Annotations of frames as data sets of BOP have them.
#include "demos/film/bop_annotations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>

#include "host/canvas/frame.h"
#include "host/files/file.h"
#include "host/pictures/channel_files.h"

namespace scree::demos {

namespace {

constexpr double mm = 1000;  // in a m

// The camera as OpenCV has it: x to the right, y down, z ahead, and pixels' centres at whole numbers.
struct CvCamera {
    glm::dmat3 turn;  // of the world's axes
    glm::dvec3 eye;
    double fx, fy, cx, cy;  // pixels
};

CvCamera cv_of(const host::Camera& camera, int width, int height) {
    const host::PixelRays rays = host::pixel_rays(camera, width, height);
    const glm::dvec3 right(rays.right), down(rays.down), corner(rays.corner);
    const double across = glm::length(right), below = glm::length(down);
    const glm::dmat3 axes(right / across, down / below, glm::dvec3(rays.forward));
    return {glm::transpose(axes),
            glm::dvec3(rays.eye),
            1 / across,
            1 / below,
            -glm::dot(corner, right) / (across * across) - 0.5,
            -glm::dot(corner, down) / (below * below) - 0.5};
}

std::string rows_of(const glm::dmat3& m) {
    std::string text;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            fmt::format_to(std::back_inserter(text), "{}{:.9g}", text.empty() ? "[" : ", ", m[column][row] + 0.0);
    return text + "]";
}
std::string text_of(const glm::dvec3& v) {
    return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x + 0.0, v.y + 0.0, v.z + 0.0);
}
std::string text_of(const PixelBox& box) {
    if (box.empty()) return "[-1, -1, -1, -1]";
    return fmt::format("[{}, {}, {}, {}]", box.least.x, box.least.y, box.greatest.x - box.least.x + 1,
                       box.greatest.y - box.least.y + 1);
}

std::uint16_t depth_level(float depth) {
    const double rounded = std::round(mm * static_cast<double>(depth));
    return rounded <= 65535 ? static_cast<std::uint16_t>(std::max(rounded, 1.0)) : std::uint16_t{0};
}

// Pixels whose depth the file tells.
std::size_t valid_in(const PixelRuns& runs, const std::vector<float>& depth, int width, int height) {
    std::size_t count = 0;
    const auto rows = static_cast<std::uint32_t>(height), columns = static_cast<std::uint32_t>(width);
    for (const PixelRun& run : runs)
        for (std::uint32_t i = run.first; i < run.first + run.count; ++i)
            count += depth_level(depth[std::size_t{i % rows} * columns + i / rows]) != 0 ? 1 : 0;
    return count;
}

// Files of an earlier run.
void remove_earlier(const std::filesystem::path& folder, const std::string& pattern, bool overwrite) {
    const std::regex names(pattern);
    std::error_code none;
    std::vector<std::filesystem::path> found;
    for (std::filesystem::directory_iterator entry(folder, none), end; !none && entry != end; entry.increment(none))
        if (std::regex_match(entry->path().filename().string(), names)) found.push_back(entry->path());
    if (!found.empty() && !overwrite)
        throw host::ImageError(found[0].string() +
                               ": is of a data set already; name another folder, or remove it (--overwrite does)");
    for (const std::filesystem::path& file : found) std::filesystem::remove(file, none);
}

}  // namespace

// Per frame, each an object by the frame's number.
struct BopAnnotations::Files {
    explicit Files(const std::filesystem::path& scene)
        : camera(scene / "scene_camera.json"), poses(scene / "scene_gt.json"), info(scene / "scene_gt_info.json") {}
    host::GrowingFile camera, poses, info;
};

BopAnnotations::BopAnnotations(const PictureOptions& options)
    : set_(options.frames),
      scene_(set_ / bop_scene),
      width_(options.width),
      height_(options.height),
      depth_(scene_ / "depth"),
      mask_(scene_ / "mask"),
      mask_visib_(scene_ / "mask_visib"),
      of_models_(set_ / "models"),
      models_(set_ / "models") {
    for (const char* folder : {"depth", "mask", "mask_visib"}) {
        host::make_folder(scene_ / folder);
        remove_earlier(scene_ / folder, "[0-9]{6,}(_[0-9]{6,})?\\.png", options.overwrite);
    }
    host::make_folder(set_ / "models");
    remove_earlier(set_ / "models", "obj_[0-9]{6,}\\.ply|models_info\\.json", options.overwrite);
    remove_earlier(scene_, "scene_(camera|gt|gt_info)\\.json", options.overwrite);
    files_ = std::make_unique<Files>(scene_);
}

BopAnnotations::~BopAnnotations() = default;

void BopAnnotations::write_depth(const Silhouettes& seen) const {
    std::vector<std::uint16_t> levels(seen.depth.size());
    std::transform(seen.depth.begin(), seen.depth.end(), levels.begin(), depth_level);
    host::write_png16(scene_ / "depth" / fmt::format("{:06}.png", frames_), width_, height_, 1, levels);
}

void BopAnnotations::write_mask(const char* folder, int number, const PixelRuns& runs) const {
    const auto rows = static_cast<std::uint32_t>(height_), columns = static_cast<std::uint32_t>(width_);
    std::vector<std::uint8_t> levels(std::size_t{rows} * columns);
    for (const PixelRun& run : runs)
        for (std::uint32_t i = run.first; i < run.first + run.count; ++i)
            levels[std::size_t{i % rows} * columns + i / rows] = 255;
    host::write_png8(scene_ / folder / fmt::format("{:06}_{:06}.png", frames_, number), width_, height_, levels);
}

void BopAnnotations::add(DrawnLabels& drawn, const host::Camera& camera) {
    const World& world = drawn.world();
    const Silhouettes seen = silhouettes_of(drawn, camera, width_, height_);
    const CvCamera cv = cv_of(camera, width_, height_);
    std::vector<std::size_t> bodies;
    for (const Silhouette& one : seen.bodies) bodies.push_back(one.body);
    const std::vector<BodyFrame> frames = world.origins(bodies);
    std::string poses, info;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const Silhouette& one = seen.bodies[k];
        const vec4& q = frames[k].orientation;
        const glm::dquat turn(static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
                              static_cast<double>(q.z));
        const char* before = k == 0 ? "" : ",";
        fmt::format_to(std::back_inserter(poses), "{}\n  {{\"cam_R_m2c\": {}, \"cam_t_m2c\": {}, \"obj_id\": {}, \"body\": {}}}",
                       before, rows_of(cv.turn * glm::mat3_cast(glm::normalize(turn))),
                       text_of(cv.turn * (glm::dvec3(frames[k].position) - cv.eye) * mm), models_.number_of(world, one.body),
                       one.body);
        const std::size_t visible = count_of(one.seen);
        fmt::format_to(std::back_inserter(info),
                       "{}\n  {{\"bbox_obj\": {}, \"bbox_visib\": {}, \"px_count_all\": {}, \"px_count_valid\": {}, "
                       "\"px_count_visib\": {}, \"visib_fract\": {:.6g}}}",
                       before, text_of(one.box), text_of(box_of(one.seen, height_)), one.pixels,
                       valid_in(one.whole, seen.depth, width_, height_), visible,
                       static_cast<double>(visible) / static_cast<double>(one.pixels));
        write_mask("mask", static_cast<int>(k), one.whole);
        write_mask("mask_visib", static_cast<int>(k), one.seen);
    }
    write_depth(seen);
    const std::string head = fmt::format("{}\n\"{}\": ", frames_ == 0 ? "{" : ",", frames_);
    files_->poses.append(head + "[" + poses + "]");
    files_->info.append(head + "[" + info + "]");
    files_->camera.append(head +
                          fmt::format("{{\"cam_K\": [{:.9g}, 0, {:.9g}, 0, {:.9g}, {:.9g}, 0, 0, 1], \"depth_scale\": 1.0, "
                                      "\"cam_R_w2c\": {}, \"cam_t_w2c\": {}}}",
                                      cv.fx, cv.cx, cv.fy, cv.cy, rows_of(cv.turn), text_of(cv.turn * -cv.eye * mm)));
    if (frames_ == 0)
        camera_ = fmt::format(
            "{{\"cx\": {:.9g}, \"cy\": {:.9g}, \"depth_scale\": 1.0, \"fx\": {:.9g}, \"fy\": {:.9g}, \"height\": {}, \"width\": "
            "{}}}\n",
            cv.cx, cv.cy, cv.fx, cv.fy, height_, width_);
    ++frames_;
}

void BopAnnotations::finish() {
    std::string info;
    int number = 0;
    for (const ModelFiles::Model& model : models_.models()) {
        const glm::dvec3 size = model.high - model.low;
        fmt::format_to(std::back_inserter(info),
                       "{}\n\"{}\": {{\"diameter\": {:.9g}, \"min_x\": {:.9g}, \"min_y\": {:.9g}, \"min_z\": {:.9g}, \"size_x\": "
                       "{:.9g}, \"size_y\": {:.9g}, \"size_z\": {:.9g}, \"name\": {}}}",
                       number == 0 ? "" : ",", number + 1, model.diameter, model.low.x, model.low.y, model.low.z, size.x, size.y,
                       size.z, nlohmann::json(model.name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
        ++number;
    }
    host::write_atomically(set_ / "models" / "models_info.json", "{" + info + "\n}\n");
    if (!camera_.empty()) host::write_atomically(set_ / "camera.json", camera_);
    for (host::GrowingFile* file : {&files_->camera, &files_->info, &files_->poses}) {
        file->append(std::string_view(frames_ == 0 ? "{}\n" : "\n}\n"));
        file->commit();
    }
}

}  // namespace scree::demos
