// Resolution of a window's pictures on software devices, which draw larger ones too slowly.
#pragma once

namespace scree::demos {

class PictureDetail {
public:
    // `adapts`: false on a GPU, which draws every pixel.
    explicit PictureDetail(bool adapts = false) : adapts_(adapts) {}

    // To be called after each picture with the time it took to draw, s, and whether anything moves. Returns whether the
    // divisor changed.
    bool drawn(double seconds, bool moves);
    float divisor() const { return divisors[level_]; }  // of width and height

private:
    static constexpr float divisors[] = {1, 1.5f, 2, 3};
    static constexpr int levels = 4;

    bool adapts_ = false;
    int level_ = 0;
    int count_ = 0;     // pictures at this level
    double mean_ = 0;   // s, smoothed
    double still_ = 0;  // pictures without motion
};

}  // namespace scree::demos
