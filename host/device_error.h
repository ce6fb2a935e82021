// What goes wrong between the program and a graphics device.
#pragma once

#include <stdexcept>

namespace scree::host {

// No driver, no such device, or a call to it that failed. The message says what to do about it.
struct DeviceError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace scree::host
