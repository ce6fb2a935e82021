// A stage of bodies to draw in canvas tests.
#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <vector>

#include "host/canvas/canvas.h"
#include "host/vulkan/buffer.h"
#include "host/vulkan/device.h"
#include "shaders/physics/base/records.h"

namespace scree::host {

using physics::BodyProperties;
using physics::Bounds;
using physics::Contact;
using physics::ContactImpulse;
using physics::Pose;
using physics::Velocity;

inline std::shared_ptr<Device> validated_device() {
    static const std::shared_ptr<Device> device = [] {
        DeviceOptions options;
        options.validation = true;
        return Device::open(options);
    }();
    return device;
}

// Tables of bodies, and pictures of them by a canvas.
class Stage {
public:
    void add(scree::physics::uint shape, vec3 size, vec3 position, vec3 velocity = vec3(0), float mass = 1,
             glm::vec4 turn = {0, 0, 0, 1}) {
        const auto index = static_cast<std::uint32_t>(traits_.size());
        BodyProperties properties{};
        properties.shape = shape;
        properties.size = size;
        properties.inverse_mass = mass > 0 ? 1 / mass : 0;
        properties.motion = mass > 0 ? scree::physics::MOTION_DYNAMIC : scree::physics::MOTION_FIXED;
        traits_.push_back(properties);
        poses_.push_back({position, 0, turn});
        velocities_.push_back({velocity, 0, vec3(0), 0});
        std::vector<std::uint32_t>* const lists[] = {&shapes_.spheres, &shapes_.capsules, &shapes_.boxes, &shapes_.planes};
        lists[shape]->push_back(index);
    }
    // Adds a contact between the last two bodies, with normal impulse `push`, N s.
    void add_touch(vec3 point, vec3 normal, float push) {
        Contact touch{};
        touch.b = static_cast<std::uint32_t>(traits_.size()) - 1;
        touch.a = touch.b - 1;
        touch.count = 1;
        touch.normal = normal;
        touch.center_offset = poses_[touch.b].position - poses_[touch.a].position;
        touch.points[0] = glm::vec4(point - poses_[touch.a].position, 0);
        touch.orientation_a = poses_[touch.a].orientation;
        touch.orientation_b = poses_[touch.b].orientation;
        touches_.push_back(touch);
        ContactImpulse impulse{};
        impulse.normal.x = push;
        pushes_.push_back(impulse);
    }
    // Contacts of bodies: end of each body's slots, and 2 * contact + side of each slot.
    void set_slots(std::vector<std::uint32_t> ends, std::vector<std::uint32_t> sides) {
        slot_ends_ = std::move(ends);
        slot_sides_ = std::move(sides);
    }
    BodyProperties& properties(std::size_t body) { return traits_.at(body); }
    Velocity& velocity(std::size_t body) { return velocities_.at(body); }
    void set_rest(std::size_t body, std::uint32_t rest) {
        rests_.resize(traits_.size());
        rests_.at(body) = rest;
    }
    void set_bounds(std::size_t body, vec3 lower, vec3 upper, std::uint32_t level) {
        bounds_.resize(traits_.size());
        bounds_.at(body) = {lower, level, upper, 0};
    }
    // Adds a hinge about the joint's x axis between two bodies (NONE: the world), at anchors in their frames.
    physics::Joint& add_hinge(std::uint32_t a, vec3 anchor_a, std::uint32_t b, vec3 anchor_b) {
        physics::Joint joint{};
        joint.a = a;
        joint.b = b;
        joint.anchor_a = anchor_a;
        joint.anchor_b = anchor_b;
        joint.frame_a = joint.frame_b = {0, 0, 0, 1};
        for (std::size_t k = 0; k < 6; ++k) joint.axes[k].mode = k == 3 ? 0 : scree::physics::AXIS_LOCKED;
        return joints_.emplace_back(joint);
    }
    void color(std::vector<glm::vec4> colors) { colors_ = std::move(colors); }  // of the first bodies
    void add_ground() { add(scree::physics::SHAPE_PLANE, {0, 1, 0}, vec3(0), vec3(0), 0); }

    std::unique_ptr<Canvas> canvas(const CanvasOptions& options) {
        const std::shared_ptr<Device> device = validated_device();
        traits_.resize(traits_.size() + 1);  // avoids empty tables
        poses_.resize(traits_.size());
        velocities_.resize(traits_.size());
        table(device, traits_table_, traits_);
        table(device, poses_table_, poses_);
        table(device, velocities_table_, velocities_);
        BodyTables tables{&traits_table_, &poses_table_, &velocities_table_};
        slot_ends_.resize(traits_.size(), slot_ends_.empty() ? 0 : slot_ends_.back());
        slot_sides_.resize(slot_sides_.size() + 1);
        rests_.resize(traits_.size());
        bounds_.resize(traits_.size());
        ids_.resize(traits_.size());
        std::iota(ids_.begin(), ids_.end(), 0u);
        table(device, slot_ends_table_, slot_ends_);
        table(device, slot_sides_table_, slot_sides_);
        table(device, rests_table_, rests_);
        table(device, bounds_table_, bounds_);
        table(device, ids_table_, ids_);
        tables.slot_ends = &slot_ends_table_;
        tables.slot_sides = &slot_sides_table_;
        tables.sleep_states = &rests_table_;
        tables.bounds = &bounds_table_;
        tables.ids = &ids_table_;
        colors_.resize(traits_.size(), glm::vec4(0));
        tables.colors = colors_;  // from host memory
        tables.joint_count = static_cast<std::uint32_t>(joints_.size());
        joints_.emplace_back().b = 1;  // past the valid records
        table(device, joints_table_, joints_);
        joints_.pop_back();
        tables.joints = &joints_table_;
        if (options.marks || !pushes_.empty()) {
            tables.touch_count = static_cast<std::uint32_t>(touches_.size());
            touches_.emplace_back().count = 4;  // past the valid records
            pushes_.resize(touches_.size());
            table(device, touches_table_, touches_);
            table(device, pushes_table_, pushes_);
            tables.touches = &touches_table_;
            tables.pushes = &pushes_table_;
        }
        std::unique_ptr<Canvas> canvas = make_vulkan_canvas(device, shapes_, options);
        canvas->set_tables(tables);
        return canvas;
    }
    Image picture(const CanvasOptions& options, const Camera& camera, const ColorScale& scale = {},
                  const std::string& caption = "") {
        return canvas(options)->draw(camera, scale, caption, vec3(-4, 0, -4), vec3(4, 4, 4));
    }

private:
    template <typename Record>
    static void table(const std::shared_ptr<Device>& device, Buffer& buffer, const std::vector<Record>& records) {
        buffer = Buffer(device, "bodies", records.size() * sizeof(Record));
        buffer.write(records.data(), buffer.bytes());
    }

    std::vector<BodyProperties> traits_;
    std::vector<Pose> poses_;
    std::vector<Velocity> velocities_;
    ShapeInstances shapes_;
    std::vector<Contact> touches_;
    std::vector<ContactImpulse> pushes_;
    std::vector<glm::vec4> colors_;
    std::vector<std::uint32_t> slot_ends_, slot_sides_, rests_, ids_;
    std::vector<Bounds> bounds_;
    std::vector<physics::Joint> joints_;
    Buffer slot_ends_table_, slot_sides_table_, rests_table_, bounds_table_, ids_table_, joints_table_;
    Buffer traits_table_, poses_table_, velocities_table_, touches_table_, pushes_table_;
};

struct Pixel {
    int r = 0, g = 0, b = 0, a = 0;
    bool operator==(const Pixel&) const = default;
    int sum() const { return r + g + b; }
};

inline Pixel at(const Image& image, int x, int y) {
    const std::size_t i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
    return {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2], image.rgba[i + 3]};
}

// Whether two pixels differ by more than rounding errors.
inline bool differ(const Pixel& a, const Pixel& b) {
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) > 24;
}

inline CanvasOptions small(int samples, bool shadows = true, bool legend = false) {
    CanvasOptions options;
    options.width = 320;
    options.height = 200;
    options.samples = samples;
    options.shadows = shadows;
    options.legend = legend;
    return options;
}

inline const Camera AHEAD{.eye = {0, 2, 10}, .target = {0, 2, 0}, .vertical_fov = 40};

inline void require_no_messages() {
    const std::vector<std::string> messages = validated_device()->validation_messages();
    for (const std::string& message : messages) UNSCOPED_INFO(message);
    REQUIRE(messages.empty());
}

}  // namespace scree::host
