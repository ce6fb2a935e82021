// A device under validation, whose messages fail the test.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "host/vulkan/device.h"

namespace scree {

struct Watched {
    std::shared_ptr<host::Device> device;
    explicit Watched(host::DeviceOptions options = {}) {
        options.validation = true;
        device = host::Device::open(options);
    }
    ~Watched() {
        for (const std::string& message : device->validation_messages()) FAIL_CHECK(message);
    }
};

}  // namespace scree
