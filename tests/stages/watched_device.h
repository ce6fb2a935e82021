// A device under validation, whose messages fail the test. Tests in one process share those of default options, and what these
// have compiled, which takes most of a small test's time.
#pragma once

#include <catch2/catch.hpp>
#include <map>
#include <memory>
#include <string>

#include "host/vulkan/device.h"

namespace scree {

class Watched {
public:
    // `which`: of several devices at the same time, such as those of ranks.
    explicit Watched(int which = 0) : device(shared(which)), before_(device->validation_messages().size()) {}
    explicit Watched(const host::DeviceOptions& options) : device(open(options)) {}
    Watched(const Watched&) = delete;
    Watched& operator=(const Watched&) = delete;
    ~Watched() {
        const auto messages = device->validation_messages();
        for (std::size_t i = before_; i < messages.size(); ++i) FAIL_CHECK(messages[i]);
    }

    const std::shared_ptr<host::Device> device;

private:
    static std::shared_ptr<host::Device> open(host::DeviceOptions options) {
        options.validation = true;
        return host::Device::open(options);
    }
    static std::shared_ptr<host::Device> shared(int which) {
        static auto& devices = *new std::map<int, std::shared_ptr<host::Device>>;  // at the end the layer's own data goes first
        std::shared_ptr<host::Device>& device = devices[which];
        if (!device) device = open({});
        return device;
    }

    const std::size_t before_ = 0;
};

}  // namespace scree
