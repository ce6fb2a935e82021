// How fast memory is copied: what work that does no more than move bytes reaches at best.
#pragma once

#include <memory>

namespace scree::host {

class Device;

// Bytes a second, read and written together (a copy of n bytes moves 2 n); the best of a few copies of more than caches hold.
double processor_copy_speed(int threads);                         // memcpy in so many threads (0: one a core)
double device_copy_speed(const std::shared_ptr<Device>& device);  // from buffer to buffer. Throws DeviceError

}  // namespace scree::host
