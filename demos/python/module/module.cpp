// The Python module scree._native: what the package scree (../scree) is made of.
#include "demos/python/module/bindings.h"

PYBIND11_MODULE(_native, module) {
    module.doc() = "The simulator behind the package scree; use scree, not this.";
    module.attr("version") = SCREE_VERSION;
#ifdef SCREE_WITH_VULKAN
    module.attr("has_vulkan") = true;
#else
    module.attr("has_vulkan") = false;
#endif
    scree::python::bind_errors(module);
    scree::python::bind_scenes(module);
    scree::python::bind_worlds(module);
}
