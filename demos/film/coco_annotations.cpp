// Annotations of frames as COCO's data sets of objects have them.
#include "demos/film/coco_annotations.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "demos/film/silhouettes.h"

namespace scree::demos {

namespace {

std::string json_word(const std::string& word) {
    return nlohmann::json(word).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// Numbers of pixels outside and inside in turn, column by column.
std::string counts_of(const PixelRuns& runs, std::size_t pixels) {
    std::string text;
    std::size_t end = 0;
    for (const PixelRun& run : runs) {
        fmt::format_to(std::back_inserter(text), "{}{},{}", text.empty() ? "" : ",", run.first - end, run.count);
        end = run.first + run.count;
    }
    if (end < pixels) fmt::format_to(std::back_inserter(text), "{}{}", text.empty() ? "" : ",", pixels - end);
    return text;
}

}  // namespace

CocoAnnotations::CocoAnnotations(const PictureOptions& options)
    : width_(options.width),
      height_(options.height),
      ending_(options.frame_files),
      file_(std::filesystem::path(options.frames) / "annotations.json") {
    file_.append("{\"annotations\": [");
}

void CocoAnnotations::add(DrawnLabels& drawn, const host::Camera& camera) {
    const World& world = drawn.world();
    const Silhouettes seen = silhouettes_of(drawn, camera, width_, height_);
    const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    std::string text;
    for (const Silhouette& one : seen.bodies) {
        if (one.seen.empty()) continue;
        const Body& body = world.scene().bodies[one.body];
        const PixelBox box = box_of(one.seen, height_);
        const std::size_t area = count_of(one.seen);
        const glm::ivec2 size = box.greatest - box.least + 1;
        fmt::format_to(
            std::back_inserter(text),
            "{}\n {{\"id\": {}, \"image_id\": {}, \"category_id\": {}, \"bbox\": [{}, {}, {}, {}], \"area\": {}, "
            "\"iscrowd\": 0, \"visibility\": {:.6g}, \"body\": {}, \"name\": {},\n  \"segmentation\": {{\"size\": [{}, "
            "{}], \"counts\": [{}]}}}}",
            annotations_ == 0 ? "" : ",", annotations_ + 1, frames_, categories_.number_of(body), box.least.x, box.least.y,
            size.x, size.y, area, static_cast<double>(area) / static_cast<double>(one.pixels), one.body, json_word(body.name),
            height_, width_, counts_of(one.seen, pixels));
        ++annotations_;
    }
    file_.append(text);
    fmt::format_to(std::back_inserter(images_),
                   "{}\n {{\"id\": {}, \"file_name\": \"frame_{:06}.{}\", \"width\": {}, \"height\": {}, \"time\": {:.9g}}}",
                   frames_ == 0 ? "" : ",", frames_, frames_, ending_, width_, height_, world.time());
    ++frames_;
}

void CocoAnnotations::finish() {
    std::string categories;
    int number = 0;
    for (const std::string& name : categories_.names()) {
        fmt::format_to(std::back_inserter(categories), "{}\n {{\"id\": {}, \"name\": {}, \"supercategory\": \"body\"}}",
                       number == 0 ? "" : ",", number + 1, json_word(name));
        ++number;
    }
    file_.append("],\n\"images\": [" + images_ + "],\n\"categories\": [" + categories + "],\n\"licenses\": [],\n");
    file_.append(
        std::string_view("\"info\": {\"description\": \"Frames of scree run; masks are run lengths, uncompressed, of what "
                         "is seen. visibility: area over that of the whole silhouette\"}}\n"));
    file_.commit();
}

}  // namespace scree::demos
