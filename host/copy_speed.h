// Memory copy bandwidth: the upper bound for stages that only move bytes.
#pragma once

#include <memory>

namespace scree::host {

class Device;

// Bytes per second, reads plus writes (a copy of n bytes moves 2 n); the best of a few copies larger than the caches.
double processor_copy_speed(int threads);                         // memcpy on `threads` threads (0: one per core)
double device_copy_speed(const std::shared_ptr<Device>& device);  // between two buffers, by command or shader. Throws DeviceError

}  // namespace scree::host
