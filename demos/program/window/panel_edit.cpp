// The panel's part about the selected body: what it does, its material, mass and motion, its joints; and joining.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "compute/scene/shape_geometry.h"
#include "compute/schema/body.h"
#include "compute/schema/joint.h"
#include "demos/program/options/units.h"
#include "demos/program/window/panel.h"
#include "demos/program/window/widgets.h"

namespace scree::demos {

namespace {

constexpr double look_every = 0.25;  // s: reading all contacts of a large world takes a while
constexpr std::size_t most_joints_shown = 8;

bool has_mass(const Body& body) {
    const bool surface = std::holds_alternative<Plane>(body.shape) || std::holds_alternative<Mesh>(body.shape) ||
                         std::holds_alternative<HeightField>(body.shape);
    return !surface && !body.fracture && body.piece_of == no_body;
}

std::string kind_word(const JointKind& kind) {
    std::string word = schema::alternatives<JointKind>.keys[kind.index()];
    std::replace(word.begin(), word.end(), '_', ' ');
    return word;
}

}  // namespace

void Panel::look_at(const World& world, std::size_t body) {
    if (looked_body_ == body && ImGui::GetTime() - looked_at_ <= look_every && ImGui::GetTime() >= looked_at_) return;
    points_ = contact_points_of(world, body);
    joints_.clear();
    const std::vector<Joint>& joints = world.scene().joints;
    for (std::size_t j = 0; j < joints.size() && joints_.size() < most_joints_shown; ++j) {
        if (joints[j].a != body && joints[j].b != body) continue;
        const JointState now = world.joint(j);
        if (now.broken) continue;
        joints_.push_back({j, joints[j].a == body ? joints[j].b : joints[j].a, glm::length(now.force)});
    }
    looked_body_ = body;
    looked_at_ = ImGui::GetTime();
}

// What the body had when the world began, or, of an added one, when it was first selected.
const Panel::Coefficients& Panel::at_first(const Session& session, std::size_t body) {
    if (first_beginning_ != session.beginnings()) first_.clear();
    first_beginning_ = session.beginnings();
    const World& world = session.world();
    const BodyHandle handle = world.handle_of(body);
    const auto [kept, fresh] = first_.try_emplace({handle.index, handle.generation});
    if (fresh) {
        const std::vector<Body>& of_scene = session.subject().scene.bodies;
        const Body& from = body < of_scene.size() && handle.generation == 0 ? of_scene[body] : world.scene().bodies[body];
        kept->second = {from.friction, from.restitution, from.rolling_resistance,
                        has_mass(from) ? mass_properties(from).mass : 0};
    }
    return kept->second;
}

// A slider that is performed when it is let go, so that a recording has one command of it. Returns the new value.
std::optional<float> Panel::edits(const char* label, float now, float by_default, float low, float high, const char* form,
                                  bool logarithmic) {
    const bool mine = dragged_label_ == label;
    float value = mine ? dragged_ : now;
    const int flags = ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    if (ImGui::SliderFloat(label, &value, low, high, form, flags)) {
        dragged_ = value;
        dragged_label_ = label;
    }
    std::optional<float> wanted;
    if (ImGui::IsItemDeactivatedAfterEdit()) wanted = dragged_;
    if (!ImGui::IsItemActive() && dragged_label_ == label) dragged_label_.clear();
    float reset = now;
    if (resets(label, reset, by_default)) wanted = reset;
    return wanted;
}

void Panel::show_body_edits(Session& session, Interaction& interaction, std::size_t body) {
    const World& world = session.world();
    const Body& now = world.scene().bodies[body];
    const Coefficients first = at_first(session, body);
    if (const auto value = edits("friction", now.friction, first.friction, 0, 2, "%.2f", false))
        interaction.perform(SetMaterial{.body = body, .friction = value});
    if (const auto value = edits("restitution", now.restitution, first.restitution, 0, 1, "%.2f", false))
        interaction.perform(SetMaterial{.body = body, .restitution = value});
    const float arm = std::holds_alternative<Plane>(now.shape) ? 0.1f : 0.2f * bounding_radius(now.shape);
    if (const auto value =
            edits("rolling", now.rolling_resistance, first.rolling, 0, std::max(arm, first.rolling), "%.3f m", false))
        interaction.perform(SetMaterial{.body = body, .rolling_resistance = value});
    if (has_mass(now) && first.mass > 0) {
        const float mass = mass_properties(now).mass;
        const std::string form = with_unit(dragged_label_ == "mass" ? dragged_ : mass, "kg");
        if (const auto value = edits("mass", mass, first.mass, 1e-3f * first.mass, 1e3f * first.mass, form.c_str(), true))
            interaction.perform(SetMass{body, *value});
    }
    static const std::vector<std::string> words(schema::words<Motion>.begin(), schema::words<Motion>.end());
    Motion motion = now.motion;
    if (choose("motion", words, motion)) interaction.perform(SetMotion{body, motion});
    ImGui::Checkbox("follow", &interaction.follows);
    ImGui::SameLine();
    if (ImGui::Button("duplicate")) interaction.duplicate_selected();
    ImGui::SameLine();
    if (ImGui::Button("delete")) interaction.remove_selected();
}

void Panel::show_joints(Session& session, Interaction& interaction) {
    const Scene& scene = session.world().scene();
    std::optional<std::size_t> cut;
    for (const JointOfBody& joint : joints_) {
        if (joint.index >= scene.joints.size()) continue;
        const std::string other = joint.other == the_world ? "the world" : name_of(scene, joint.other);
        say_line(fmt::format("{} to {}, {}", kind_word(scene.joints[joint.index].kind), other, with_prefix(joint.force, "N")));
        ImGui::SameLine();
        ImGui::PushID(static_cast<int>(joint.index));
        if (ImGui::SmallButton("cut")) cut = joint.index;
        ImGui::PopID();
    }
    if (!cut) return;
    interaction.perform(Unjoin{*cut});
    looked_at_ = -1;
    joints_.clear();
}

void Panel::show_joining(Interaction& interaction) {
    if (!ImGui::TreeNodeEx("join", ImGuiTreeNodeFlags_None)) return;
    choose("joint", join_words(), interaction.join_kind);
    if (interaction.join_kind == JoinKind::hinge || interaction.join_kind == JoinKind::slider)
        choose("axis", join_axis_words(), interaction.join_axis);
    if (!interaction.joining() && ImGui::Button("join two bodies")) interaction.begin_joining();
    ImGui::TreePop();
}

void Panel::show_selected(Session& session, Interaction& interaction) {
    const std::optional<std::size_t> selected = interaction.selected();
    if (!selected) {
        points_.clear();
        joints_.clear();
        looked_body_.reset();
        return;
    }
    // A window of its own, in the upper right corner.
    ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x - 8, 8), ImGuiCond_Always, ImVec2(1, 0));
    ImGui::SetNextWindowBgAlpha(0.78f);
    ImGui::Begin("selected body", nullptr,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoMove);
    ImGui::PushItemWidth(ems(10));
    World& world = session.world();
    const Scene& scene = world.scene();
    const BodyState state = world.body(*selected);
    const Body& body = scene.bodies[*selected];
    look_at(world, *selected);
    double force = 0;
    std::vector<std::size_t> others;
    for (const ContactPoint& point : points_) {
        force += static_cast<double>(point.force);
        if (std::find(others.begin(), others.end(), point.other) == others.end()) others.push_back(point.other);
    }
    say_line(name_of(scene, *selected) + (state.asleep ? ", asleep" : ""));
    if (body.motion == Motion::dynamic) {
        const vec3 p = state.velocity * mass_properties(body).mass;
        say_line("momentum " + with_unit(glm::length(p), "kg m/s"));
        say_line(fmt::format("    ({}, {}, {})", short_number(p.x), short_number(p.y), short_number(p.z)));
    }
    say_line(with_unit(glm::length(state.velocity), "m/s") + ", " + with_unit(glm::length(state.angular_velocity), "rad/s"));
    say_line(fmt::format("touches {} in {} points, {}", others.size(), points_.size(), with_prefix(force, "N")));
    show_body_edits(session, interaction, *selected);
    show_joints(session, interaction);
    ImGui::PopItemWidth();
    ImGui::End();
}

}  // namespace scree::demos
