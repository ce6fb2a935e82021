// Reading and writing what is measured.
#include "compute/scene_file/measures_json.h"

#include "compute/scene_file/fields_read.h"
#include "compute/scene_file/fields_write.h"
#include "compute/scene_file/json_text.h"
#include "compute/scene_file/measures_fields.h"

namespace scree {

MeasureRequest measures_from_json(std::string_view text, const Scene& scene) {
    using namespace json_reading;
    const Place root{nullptr, nullptr, 0};
    MeasureRequest request;
    read_value(parsed(text), root, request, "", NamedThings{numbers_of(scene.bodies), {}});
    check_measures(request, scene, "");
    return request;
}

std::string measures_to_json(const MeasureRequest& request) {
    Text text;
    write_value(text, request);
    return text.take();
}

}  // namespace scree
