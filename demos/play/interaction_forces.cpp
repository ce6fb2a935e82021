// Grabbing, throwing, adding and pushing bodies, and explosions.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "demos/play/interaction.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

constexpr float push_acceleration = 20;  // m/s^2, of an arrow key: twice gravity, which overcomes friction

Shape shape_of(Kind kind, float size) {
    if (kind == Kind::sphere) return Sphere{size};
    if (kind == Kind::capsule) return Capsule{0.6f * size, 0.8f * size};
    return Box{vec3(size)};
}

}  // namespace

std::optional<RayHit> Interaction::hit_under_pointer() {
    return session_.world().cast_ray(eye_.ray(x_, y_, extent_));
}

void Interaction::grab(const RayHit& hit) {
    const BodyState body = session_.world().body(hit.body);
    Hold hold;
    hold.body = hit.body;
    hold.anchor = physics::rotate_back(body.orientation, hit.point - body.position);
    hold.target = hit.point;
    hold.start = body.position;
    hold.depth = glm::dot(hit.point - eye_.position(), eye_.forward());
    perform(Grab{hold.grip, hold.body, hold.anchor, hold.target});
    if (!message_.empty()) return;
    hold_ = hold;
    motion_ = Motion::holds;
}

void Interaction::grab_body(std::size_t body) {
    if (motion_ != Motion::none || !has_body(session_.world(), body)) return;
    if (session_.world().scene().bodies[body].motion != scree::Motion::dynamic) return;
    std::optional<RayHit> hit = hit_under_pointer();
    if (!hit || hit->body != body) hit = RayHit{.body = body, .point = session_.world().body(body).position};
    selected_ = body;
    grab(*hit);
}

void Interaction::drag() {
    const Ray ray = eye_.ray(x_, y_, extent_);
    const vec3 target = ray.from + ray.along * (hold_->depth / std::max(0.05f, glm::dot(ray.along, eye_.forward())));
    if (target == hold_->target) return;
    hold_->target = target;
    perform(Drag{hold_->grip, target});
}

void Interaction::let_go() {
    handled_.push_back({hold_->body, hold_->start, session_.world().body(hold_->body).position});
    perform(Release{hold_->grip});
    hold_.reset();
}

std::vector<Handled> Interaction::handled() {
    std::vector<Handled> all = handled_;
    if (hold_) all.push_back({hold_->body, hold_->start, session_.world().body(hold_->body).position});
    return all;
}

std::optional<Pull> Interaction::pull() {
    if (!hold_) return std::nullopt;
    const BodyState body = session_.world().body(hold_->body);
    const GripSpring spring;
    Pull pull;
    pull.body = hold_->body;
    pull.from = body.position + physics::rotate(body.orientation, hold_->anchor);
    pull.to = hold_->target;
    const float omega = 2 * std::numbers::pi_v<float> * spring.hertz;
    const float acceleration = std::min(omega * omega * glm::length(pull.to - pull.from), spring.max_acceleration);
    const Body& held = session_.world().scene().bodies[hold_->body];
    pull.strength = acceleration / spring.max_acceleration;
    pull.force = acceleration * mass_properties(held).mass;
    return pull;
}

float Interaction::size_of_a_new_body() const {
    return std::clamp(0.03f * eye_.distance(), 0.05f, 5.0f);
}

void Interaction::throw_body(Kind kind) {
    const float size = size_of_a_new_body();
    const Ray ray = eye_.ray(x_, y_, extent_);
    Body body;
    body.name = "thrown";
    body.shape = shape_of(kind, size);
    body.position = ray.from + ray.along * (3 * size);
    body.velocity = ray.along * std::clamp(1.5f * eye_.distance(), 5.0f, 100.0f);
    perform(Add{body});
    if (message_.empty()) ++thrown_;
}

void Interaction::add(Kind kind) {
    const float size = size_of_a_new_body();
    Body body;
    body.name = "added";
    body.shape = shape_of(kind, size);
    // Drops the body onto whatever is in the centre of the view, or onto what is stacked there.
    const World& world = session_.world();
    const std::optional<RayHit> seen = world.cast_ray(eye_.ray(0.5 * extent_.width, 0.5 * extent_.height, extent_));
    const vec3 middle = seen ? seen->point : eye_.target();
    const std::optional<RayHit> highest = world.cast_ray({middle + vec3(0, 1000, 0), vec3(0, -1, 0)});
    body.position = (highest ? highest->point : middle) + vec3(0, 3 * size, 0);
    perform(Add{body});
}

void Interaction::explode() {
    const std::optional<RayHit> hit = hit_under_pointer();
    const vec3 centre = hit ? hit->point : eye_.target();
    perform(Explode{centre, 0.3f * eye_.distance(), std::clamp(0.8f * eye_.distance(), 3.0f, 60.0f)});
}

void Interaction::push_selected() {
    if (!selected_ || held_keys_.empty() || vehicle()) return;
    using enum host::Key;
    const vec3 ahead = glm::normalize(glm::cross(vec3(0, 1, 0), eye_.right()));
    const std::array<std::pair<host::Key, vec3>, 6> directions{{{left, -eye_.right()},
                                                                {right, eye_.right()},
                                                                {up, ahead},
                                                                {down, -ahead},
                                                                {page_up, {0, 1, 0}},
                                                                {page_down, {0, -1, 0}}}};
    vec3 push(0);
    for (const auto& [pressed, direction] : directions) {
        if (held_keys_.count(pressed) != 0) push += direction;
    }
    const Body& body = session_.world().scene().bodies[*selected_];
    if (push == vec3(0) || body.motion != scree::Motion::dynamic) return;
    perform(Push{*selected_, push * (push_acceleration * mass_properties(body).mass)});
}

}  // namespace scree::demos
