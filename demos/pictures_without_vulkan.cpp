// No pictures in a build without Vulkan.
#include "demos/pictures.h"

namespace scree::demos {

struct Pictures::Interior {};

Pictures::Pictures(const PictureOptions&, const Machine& machine, const Subject&, World&) {
    device_for_pictures(machine);  // says why not
}
Pictures::~Pictures() = default;
void Pictures::after_step() {}
void Pictures::finish() {}
int Pictures::count() const {
    return 0;
}
PictureTimes Pictures::times() const {
    return {};
}

const std::vector<std::string>& color_words() {
    static const std::vector<std::string> words = {"momentum"};
    return words;
}

const std::vector<std::string>& color_map_words() {
    static const std::vector<std::string> words = {"plasma"};
    return words;
}

}  // namespace scree::demos
