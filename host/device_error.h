// Errors of graphics devices.
#pragma once

#include <stdexcept>

namespace scree::host {

// Missing driver, no such device, or a failed device call. The message names the remedy.
struct DeviceError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The device stopped in the midst of its work, whatever was asked of it.
struct DeviceLost : DeviceError {
    using DeviceError::DeviceError;
};

}  // namespace scree::host
