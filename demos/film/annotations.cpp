// The choice of annotations, and where their frames lie.
#include "demos/film/annotations.h"

#include "demos/film/bop_annotations.h"
#include "demos/film/coco_annotations.h"

namespace scree::demos {

const std::vector<std::string>& annotation_words() {
    static const std::vector<std::string> words = {"coco", "bop"};
    return words;
}

std::filesystem::path folder_of_frames(const PictureOptions& options) {
    if (options.annotations != "bop" || options.frames.empty()) return options.frames;
    return std::filesystem::path(options.frames) / bop_scene / "rgb";
}

std::string name_of_frames(const PictureOptions& options) {
    return options.annotations == "bop" ? "" : "frame_";
}

std::unique_ptr<Annotations> make_annotations(const PictureOptions& options) {
    if (options.annotations == "coco") return std::make_unique<CocoAnnotations>(options);
    if (options.annotations == "bop") return std::make_unique<BopAnnotations>(options);
    return nullptr;
}

}  // namespace scree::demos
