// Annotations of frames as data sets of BOP, the benchmark for poses of objects, have them: a folder with models, pictures,
// depth, masks and poses. https://github.com/thodan/bop_toolkit/blob/master/docs/bop_datasets_format.md
#pragma once

#include <filesystem>
#include <string>

#include "demos/film/annotations.h"
#include "demos/film/model_objects.h"
#include "demos/film/silhouettes.h"
#include "demos/program/options/output_check.h"
#include "host/files/growing_file.h"

namespace scree::demos {

// The folder of a run in the data set.
inline const std::filesystem::path bop_scene = std::filesystem::path("train") / "000000";

class BopAnnotations : public Annotations {
public:
    explicit BopAnnotations(const PictureOptions& options);
    ~BopAnnotations() override;
    void add(DrawnLabels& drawn, const host::Camera& camera) override;
    void finish() override;

private:
    struct Files;
    void write_depth(const Silhouettes& seen) const;
    void write_mask(const char* folder, int number, const PixelRuns& runs) const;

    std::filesystem::path set_, scene_;
    int width_, height_, frames_ = 0;
    OutputFolder depth_, mask_, mask_visib_, of_models_;  // removed again if nothing comes
    std::unique_ptr<Files> files_;
    ModelFiles models_;
    std::string camera_;  // camera.json
};

}  // namespace scree::demos
