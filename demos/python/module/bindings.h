// The parts of the Python module scree._native, and what they share.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/scene_file/json_reading.h"
#include "compute/scene_file/scene_json.h"

namespace scree::python {

namespace py = pybind11;
using glm::vec3;
using glm::vec4;

// Arrays as the package hands them over: float32 and int64, in C order.
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

// Classes are of Python's own kind, as the stubs say: none has static properties, for which pybind11 has another.
inline py::metaclass plain_class() {
    return py::metaclass(py::handle(reinterpret_cast<PyObject*>(&PyType_Type)));
}

// A scene that is being described.
struct Description {
    SceneDocument document;
    std::vector<std::string> notes;  // what was changed or left out in reading it
};

// Becomes MemoryError, with its words.
struct BeyondMemory : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The first two of that name.
template <class Things>
std::vector<std::size_t> first_named(const Things& things, std::size_t count, const std::string& name) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < count && found.size() < 2; ++i)
        if (things[i].name == name) found.push_back(i);
    return found;
}
template <class Things>
std::vector<std::string> all_names(const Things& things, std::size_t count) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) names.push_back(things[i].name);
    return names;
}

void bind_errors(py::module_& module);
void bind_scenes(py::module_& module);
void bind_worlds(py::module_& module);

// Throws SceneError with the place in the text.
nlohmann::json json_of(const std::string& text);

// The place of a whole text, in errors.
inline const json_reading::Place root{nullptr, nullptr, 0};

py::dict settings_dict(const Settings& settings);

// A structured array, with a record of each item.
template <class Item, class ToRecord>
py::array records_of(const std::vector<Item>& items, ToRecord to_record) {
    py::array_t<decltype(to_record(items.front()))> made(static_cast<py::ssize_t>(items.size()));
    std::transform(items.begin(), items.end(), made.mutable_data(), to_record);
    return made;
}

// Requires `array` to have the shape (n, width), or (n,) for a width of 0; the package has shaped it, so this is for those
// who call past it.
inline void require_shape(const py::array& array, py::ssize_t n, py::ssize_t width, const char* name) {
    const bool right = width == 0 ? array.ndim() == 1 && array.shape(0) == n
                                  : array.ndim() == 2 && array.shape(0) == n && array.shape(1) == width;
    if (!right) throw py::value_error(std::string(name) + ": has another shape than its bodies, rays or shapes");
}
inline vec3 vec3_at(const float* values, std::size_t i) {
    return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}
inline vec4 vec4_at(const float* values, std::size_t i) {
    return {values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]};
}

}  // namespace scree::python
