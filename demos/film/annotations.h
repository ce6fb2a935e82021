// Annotations of the frames of a run, as data sets for learning have them: COCO's for detection and segmentation, BOP's for
// poses. Annotated are the dynamic bodies; all others are background.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "demos/film/drawn_labels.h"
#include "demos/program/options/options.h"
#include "host/canvas/camera.h"

namespace scree::demos {

class Annotations {
public:
    virtual ~Annotations() = default;
    // Of what is drawn, for the next frame. Throws host::DeviceError, host::FileError, host::ImageError.
    virtual void add(DrawnLabels& drawn, const host::Camera& camera) = 0;
    virtual void finish() = 0;  // gives the files their names; without it there are none
};

const std::vector<std::string>& annotation_words();  // of --annotations: coco, bop

// The folder of a run's frames, and how their files begin: of BOP those of its layout within --frames.
std::filesystem::path folder_of_frames(const PictureOptions& options);
std::string name_of_frames(const PictureOptions& options);

// What --annotations asks for; null: nothing. Call it when the folder of frames is known to hold none, or is to be overwritten.
std::unique_ptr<Annotations> make_annotations(const PictureOptions& options);

}  // namespace scree::demos
