// Errors of the library as those of Python.
#include "compute/checkpoint.h"
#include "compute/scene.h"
#include "demos/program/exit_status.h"
#include "demos/python/module/bindings.h"
#include "host/device_error.h"
#include "host/files/file.h"
#include "host/pictures/image.h"

namespace scree::python {

namespace {

// The package's own kinds of errors, which are Python classes (scree/_errors.py).
template <class... Arguments>
void raise(const char* kind, const Arguments&... arguments) {
    const py::object type = py::module_::import("scree._errors").attr(kind);
    const py::object error = type(arguments...);
    PyErr_SetObject(type.ptr(), error.ptr());
}

}  // namespace

void bind_errors(py::module_&) {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const SceneError& error) {
            raise("SceneError", error.what(), error.pointer);
        } catch (const CheckpointError& error) {
            raise("CheckpointError", error.what());
        } catch (const host::DeviceError& error) {
            raise("DeviceError", error.what());
        } catch (const host::FileError& error) {
            PyErr_SetString(PyExc_OSError, error.what());
        } catch (const host::ImageError& error) {
            PyErr_SetString(PyExc_OSError, error.what());
        } catch (const BeyondMemory& error) {
            PyErr_SetString(PyExc_MemoryError, error.what());
        } catch (const demos::UsageError& error) {
            PyErr_SetString(PyExc_ValueError, error.what());
        }
    });
}

}  // namespace scree::python
