// The camera of each picture as JSON, for programs that put pictures together or learn from them.
#pragma once

#include <string>

#include "host/canvas/camera.h"

namespace scree::demos {

class CameraTrack {
public:
    CameraTrack(int width, int height) : width_(width), height_(height) {}

    void add(double seconds, const host::Camera& camera);
    // One object: size, conventions, and per picture its time, pose, matrices (rows of four) and focal lengths (pixels).
    std::string json() const;

private:
    int width_, height_;
    int count_ = 0;
    std::string frames_;
};

}  // namespace scree::demos
