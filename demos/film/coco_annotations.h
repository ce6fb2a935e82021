// Annotations of frames as COCO's data sets of objects have them: boxes, areas and masks in one JSON file.
// https://cocodataset.org/#format-data
#pragma once

#include <string>

#include "demos/film/annotations.h"
#include "demos/film/model_objects.h"
#include "host/files/growing_file.h"

namespace scree::demos {

class CocoAnnotations : public Annotations {
public:
    explicit CocoAnnotations(const PictureOptions& options);
    void add(DrawnLabels& drawn, const host::Camera& camera) override;
    void finish() override;

private:
    int width_, height_;
    std::string ending_;      // of frames
    host::GrowingFile file_;  // DIR/annotations.json; annotations first, since they come with the frames
    std::string images_;      // the list of images
    int frames_ = 0;
    std::size_t annotations_ = 0;
    Categories categories_;
};

}  // namespace scree::demos
