// The range of the colour scale: one for all pictures of a run, so that colours can be compared and do not flicker.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compute/world.h"
#include "demos/program/loaded_scene.h"

namespace scree::demos {

// From 0 to what nearly all bodies stay below: a high percentile of their greatest values, so that a single fast or
// heavy body does not dim all others, rounded to two steps or less of a digit. The values are those of the first two
// seconds, simulated beforehand on the CPU, if that is a short work; else, of a fall over three tenths of the scene's
// height. For height: from the bottom to the top of the scene.
// `rehearses`: false to leave the simulation out.
std::pair<float, float> color_range(const LoadedScene& subject, const Settings& settings, const std::string& quantity,
                                    bool rehearses = true);

// The range of a logarithmic scale: from a thousandth of its end.
std::pair<float, float> logarithmic_range(std::pair<float, float> range);

// The value that nearly all stay below: without the greatest twentieth, and of six and more without the greatest. 0 for
// no values.
double nearly_greatest(std::vector<double> values);

// Upper end of a range in a window, where nobody knows what comes: it follows what is measured, late and in large steps.
class MeasuredRange {
public:
    explicit MeasuredRange(float high = 0) : high_(high) {}
    // `value`: nearly_greatest() of the bodies now; `seconds`: since the last call. Returns whether the range changed.
    bool update(double value, double seconds);
    float high() const { return high_; }

private:
    float high_ = 0;
    double below_ = 0;  // s for which all values have been below a sixth of the range
    double most_ = 0;   // greatest value in that time
};

// The values of a quantity of all dynamic bodies, at present; empty for quantities without a range of their own.
std::vector<double> values_now(const World& world, const std::string& quantity);

}  // namespace scree::demos
