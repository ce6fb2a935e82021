// Random programs: making, running and reducing them.
#include "tests/world/random_program.h"

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <span>
#include <utility>

#include "compute/checkpoint.h"
#include "compute/distributed/in_process.h"
#include "compute/scene_file/scene_json.h"
#include "compute/tables/state.h"

namespace scree::tests {

namespace {

// The same numbers with every standard library.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : bits_(seed) { bits_.discard(3); }
    std::size_t below(std::size_t n) { return bits_() % n; }
    bool one_in(std::size_t n) { return below(n) == 0; }
    float between(float low, float high) { return low + (high - low) * static_cast<float>(bits_() >> 8) / 16777216.0f; }
    vec3 vector(float most) { return {between(-most, most), between(-most, most), between(-most, most)}; }
    std::uint32_t seed() { return static_cast<std::uint32_t>(bits_()); }
    bool rotors = false;  // axes of joints have armature

private:
    std::mt19937 bits_;
};

SimpleShape simple_shape(Dice& dice) {
    const float size = dice.between(0.15f, 0.6f);
    const auto about = [&] { return size * dice.between(0.4f, 1); };
    switch (dice.below(7)) {
        case 0:
            return Sphere{size};
        case 1:
            return Capsule{about(), dice.one_in(8) ? 0 : about()};
        case 2:
            return Cylinder{about(), about()};
        case 3:
            return Cone{about(), about()};
        case 4:
            return Ellipsoid{{about(), about(), about()}};
        case 5: {
            Hull hull;
            for (std::size_t n = 5 + dice.below(8); n-- > 0;) hull.points.push_back(dice.vector(size));
            return hull;
        }
        default:
            return Box{{about(), about(), about()}};
    }
}

Material material(Dice& dice) {
    Material made;
    made.friction = dice.between(0, 1);
    if (dice.one_in(3)) made.restitution = dice.between(0, 1);
    if (dice.one_in(3)) made.rolling_resistance = dice.between(0, 0.05f);
    if (dice.one_in(5)) made.static_friction = made.friction + 0.2f;
    if (dice.one_in(6)) made.spinning_resistance = 0.01f;
    if (dice.one_in(8)) made.surface_velocity = dice.vector(2);
    if (dice.one_in(5)) made.friction_rule = static_cast<CombineRule>(dice.below(8));
    return made;
}

Body body(Dice& dice, float width) {
    Body made;
    std::visit([&](auto&& shape) { made.shape = shape; }, simple_shape(dice));
    if (dice.one_in(6)) {
        Compound compound;
        for (std::size_t n = 1 + dice.below(4); n-- > 0;)
            compound.parts.push_back({.shape = simple_shape(dice), .position = dice.vector(0.4f)});
        if (dice.one_in(3)) compound.parts.front().material = material(dice);
        if (compound.parts.size() > 1 && dice.one_in(4)) compound.parts.back().role = dice.one_in(2) ? Role::sensor : Role::drawn;
        made.shape = compound;
    }
    made.position = {dice.between(-width, width), dice.between(0.3f, 4), dice.between(-width, width)};
    made.orientation = {dice.vector(1), 0.3f};
    if (dice.one_in(3)) made.velocity = dice.vector(dice.one_in(5) ? 60 : 4);
    if (dice.one_in(3)) made.angular_velocity = dice.vector(6);
    made.density = dice.one_in(6) ? dice.between(50, 20000) : 1000;
    const Material own = material(dice);
    made.friction = own.friction;
    made.restitution = own.restitution;
    made.rolling_resistance = own.rolling_resistance;
    made.static_friction = own.static_friction;
    made.surface_velocity = own.surface_velocity;
    made.friction_rule = own.friction_rule;
    if (dice.one_in(6)) made.linear_damping = made.angular_damping = 0.3f;
    if (dice.one_in(8)) made.gravity_scale = dice.between(-0.2f, 2);
    if (dice.one_in(6)) made.filter = Filter{1u << dice.below(3), 7u, static_cast<std::int32_t>(dice.below(5)) - 2};
    if (dice.one_in(10)) made.motion = Motion::kinematic, made.velocity = dice.vector(1);
    const bool round = std::holds_alternative<Sphere>(made.shape) || std::holds_alternative<Cylinder>(made.shape);
    if (round && dice.one_in(6)) made.tyre.emplace();
    if (std::holds_alternative<Box>(made.shape) && made.motion == Motion::dynamic && dice.one_in(3))
        made.fracture = Fracture{.impulse = dice.between(20, 3000),
                                 .cutting = dice.one_in(2) ? Cutting::boxes : Cutting::voronoi,
                                 .pieces = 2 + dice.below(5),
                                 .depth = 1 + dice.below(2),
                                 .seed = dice.seed()};
    return made;
}

Axis axis(Dice& dice) {
    Axis made;
    if (dice.one_in(2)) made.limits = Limits{dice.between(-1, 0), dice.between(0, 1)};
    if (dice.one_in(3)) made.spring = Spring{dice.between(0, 5000), dice.between(0, 100), dice.between(-0.5f, 0.5f)};
    if (dice.one_in(4)) made.motor = Motor{dice.between(-4, 4), dice.between(0, 300)};
    if (!made.motor && dice.one_in(4)) made.friction = dice.between(0, 20);
    if (dice.rotors && dice.one_in(3)) made.armature = dice.between(0, 4);
    return made;
}

JointKind joint_kind(Dice& dice) {
    switch (dice.below(7)) {
        case 0:
            return Hinge{axis(dice)};
        case 1:
            return Slider{axis(dice)};
        case 2:
            return Fixed{};
        case 3:
            return Distance{dice.between(0, 0.5f), dice.between(0.6f, 2)};
        case 4:
            return ConeTwist{dice.between(0.1f, 2), {-0.5f, 0.5f}, dice.between(0, 2)};
        case 5: {
            SixDof six;
            six.x.locked = six.y.locked = true;
            six.z = axis(dice);
            six.twist = axis(dice);
            return six;
        }
        default:
            return Ball{dice.one_in(2) ? 0 : dice.between(0, 5)};
    }
}

Body ground(Dice& dice) {
    Body made;
    made.motion = Motion::fixed;
    if (dice.one_in(3)) {
        HeightField hills;
        hills.columns = hills.rows = 9;
        hills.spacing = 1.5f;
        for (int i = 0; i < 81; ++i) hills.heights.push_back(dice.between(-0.4f, 0.2f));
        made.shape = hills;
    } else {
        made.shape = Plane{};
    }
    return made;
}

Scene random_scene(Dice& dice) {
    Scene scene;
    if (dice.one_in(6)) scene.gravity = dice.vector(5);
    scene.bodies.push_back(ground(dice));
    const std::size_t count = 3 + dice.below(dice.one_in(4) ? 60 : 14);
    const float width = 0.5f + 0.18f * static_cast<float>(count);
    for (std::size_t i = 0; i < count; ++i) scene.bodies.push_back(body(dice, std::min(width, 4.0f)));
    if (dice.one_in(4)) scene.fields.wind.emplace().velocity = dice.vector(10);
    if (dice.one_in(5)) scene.fields.water.emplace().offset = dice.between(0, 1.5f);
    if (dice.one_in(6)) scene.fields.attractors.push_back({dice.vector(3), dice.between(-50, 50)});
    if (dice.one_in(2)) {
        std::vector<std::size_t> dynamic;
        for (std::size_t i = 1; i <= count; ++i)
            if (scene.bodies[i].motion == Motion::dynamic && !scene.bodies[i].fracture) dynamic.push_back(i);
        for (std::size_t n = dice.below(10); n-- > 0 && dynamic.size() > 1;) {
            const std::size_t a = dynamic[dice.below(dynamic.size())], b = dynamic[dice.below(dynamic.size())];
            if (a == b) continue;
            const vec3 anchor = (scene.bodies[a].position + scene.bodies[b].position) * 0.5f;
            const JointKind kind = joint_kind(dice);
            scene.joints.push_back(joint_at(scene, kind, dice.one_in(5) ? the_world : a, b, anchor, {0, 0.6f, 0.8f}));
            if (dice.one_in(4)) scene.joints.back().break_force = dice.between(50, 5000);
            scene.joints.back().collide = dice.one_in(5);
        }
    }
    return scene;
}

struct Performer {
    World& world;
    std::optional<std::vector<std::byte>>& mark;

    std::size_t any(Dice& dice) const { return dice.below(world.scene().bodies.size()); }
    void perform(const Act& act) const {
        Dice dice(act.seed);
        switch (act.kind) {
            case ActKind::add_bodies: {
                std::vector<Body> born;
                for (std::size_t n = 1 + dice.below(3); n-- > 0;) born.push_back(body(dice, 2));
                world.add_bodies(born);
                break;
            }
            case ActKind::remove_body:
                world.remove_body(any(dice));
                break;
            case ActKind::grip: {
                const std::size_t body = any(dice);
                const vec3 at = dice.vector(0.2f), hand = dice.vector(3) + vec3(0, 2, 0);
                world.grip(body, at, hand);
                break;
            }
            case ActKind::release:
                world.release(dice.below(2));
                break;
            case ActKind::shove: {
                const std::size_t body = any(dice);
                world.apply_impulse(body, dice.vector(dice.one_in(3) ? 50000 : 500));
                break;
            }
            case ActKind::teleport:
                world.set_bodies(std::vector{BodyChange{.body = any(dice), .position = dice.vector(2) + vec3(0, 3, 0)}});
                break;
            case ActKind::save:
                mark = world.save();
                break;
            case ActKind::restore:
                if (mark) world.restore(*mark);
                break;
            case ActKind::reorder:
                world.reorder();
                break;
            case ActKind::motion: {
                const std::size_t body = any(dice);
                world.set_motion(body, static_cast<Motion>(dice.below(3)));
                break;
            }
            case ActKind::material: {
                const std::size_t body = any(dice);
                world.set_material(body, material(dice));
                break;
            }
            case ActKind::filter: {
                const std::size_t body = any(dice);
                world.set_filter(body, Filter{1u << dice.below(3), static_cast<std::uint32_t>(dice.below(8)), 0});
                break;
            }
            case ActKind::exclusion: {
                const std::size_t a = any(dice), b = any(dice);
                world.set_exclusion(a, b, !dice.one_in(3));
                break;
            }
            case ActKind::add_joint: {
                const std::size_t a = any(dice), b = any(dice);
                const JointKind kind = joint_kind(dice);
                world.add_joint(world.joint_at(kind, dice.one_in(4) ? the_world : a, b, world.body(b).position));
                break;
            }
            case ActKind::remove_joint:
                if (!world.scene().joints.empty()) world.remove_joint(dice.below(world.scene().joints.size()));
                break;
            case ActKind::spring: {
                if (world.scene().joints.empty()) break;
                const std::size_t joint = dice.below(world.scene().joints.size());
                const JointAxis axis = dice.one_in(2) ? JointAxis::twist : JointAxis::x;
                world.set_spring(joint, axis, {dice.between(0, 1000), 5, 0.2f});
                break;
            }
            case ActKind::explode: {
                const vec3 centre = dice.vector(2);
                world.explode(centre, 3, dice.between(1, 20));
                break;
            }
            case ActKind::gravity:
                world.set_gravity(dice.one_in(4) ? vec3(0) : dice.vector(12));
                break;
            case ActKind::substeps:
                world.set_substeps(static_cast<int>(1 + dice.below(10)));
                break;
            case ActKind::sleep:
                world.set_sleeping(dice.one_in(2));
                break;
            case ActKind::fields: {
                Fields fields;
                if (dice.one_in(2)) fields.wind.emplace().velocity = dice.vector(20);
                if (dice.one_in(2)) fields.water.emplace().offset = dice.between(0, 2);
                world.set_fields(fields);
                break;
            }
            case ActKind::target:
                world.move_bodies(std::vector{BodyTarget{.body = any(dice), .position = dice.vector(2), .steps = 20}});
                break;
            case ActKind::velocity: {
                const std::size_t body = any(dice);
                const vec3 velocity = dice.vector(10), spin = dice.vector(10);
                world.set_velocity(body, velocity, spin);
                break;
            }
            case ActKind::count:
                break;
        }
    }
};

// Of what they tell.
std::string hash_of_joints(const World& world) {
    std::uint64_t hash = 0;
    const auto add = [&](float value) { hash = hash * 1099511628211u + physics::floatBitsToUint(value); };
    for (const JointState& joint : world.joints()) {
        for (const vec3& v : {joint.force, joint.torque}) add(v.x), add(v.y), add(v.z);
        for (const float value : {joint.max_force, joint.max_torque, joint.broken ? 1.0f : 0.0f, joint.gap}) add(value);
        for (const float coordinate : joint.coordinates) add(coordinate);
    }
    return hash_text(hash);
}

// The first line in which they differ; both may be shorter.
std::optional<std::size_t> first_difference(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
        if (i >= a.size() || i >= b.size() || a[i] != b[i]) return i;
    return std::nullopt;
}

}  // namespace

RandomProgram random_program(std::uint32_t seed) {
    RandomProgram made;
    for (std::uint32_t attempt = 0;; ++attempt) {
        Dice dice(seed * 977 + attempt * 31);
        dice.rotors = seed % 2 == 0;  // odd programs, 22817 among them, keep what they drew before there were rotors
        made.scene = random_scene(dice);
        try {
            (void)checked(made.scene);  // flat hulls, joints whose frames do not fit
        } catch (const SceneError&) {
            continue;
        }
        made.settings.substeps = static_cast<int>(1 + dice.below(8));
        if (dice.one_in(3)) made.settings.pairs_at_first = made.settings.contacts_at_first = 8;  // grow
        made.settings.sleep_time = dice.one_in(2) ? 0.1f : 0.5f;
        made.steps = static_cast<int>(10 + dice.below(50));
        for (std::size_t n = dice.below(25); n-- > 0;)
            made.acts.push_back({dice.below(static_cast<std::size_t>(made.steps)),
                                 static_cast<ActKind>(dice.below(static_cast<std::size_t>(ActKind::count))), dice.seed()});
        std::ranges::stable_sort(made.acts, {}, &Act::step);
        return made;
    }
}

namespace {

// On ranks of a streamed scene.
World world_of(const RandomProgram& program, std::unique_ptr<Runner> runner) {
    if (!runner->ranks()) return {program.scene, program.settings, std::move(runner)};
    StreamedScene streamed{program.scene};
    streamed.scene.bodies.clear();
    streamed.others = [&bodies = program.scene.bodies](const TakeBody& take) { std::ranges::for_each(bodies, take); };
    return {streamed, program.settings, std::move(runner)};
}

}  // namespace

std::vector<std::string> trace_of(const RandomProgram& program, std::unique_ptr<Runner> runner) {
    World world = world_of(program, std::move(runner));
    std::optional<std::vector<std::byte>> mark;
    std::vector<std::string> lines;
    std::size_t next = 0;
    for (int step = 0; step < program.steps; ++step) {
        std::string line;
        for (; next < program.acts.size() && program.acts[next].step <= static_cast<std::uint64_t>(step); ++next) {
            try {
                Performer{world, mark}.perform(program.acts[next]);
            } catch (const std::exception& error) {
                line += std::string(error.what()) + "; ";
            }
        }
        world.step();
        lines.push_back(line + hash_text(world.state_hash()) + " contacts " + std::to_string(world.state().counted().contacts));
    }
    lines.push_back("joints " + hash_of_joints(world));
    const Statistics last = world.statistics();
    std::uint64_t hash = 0;
    for (const std::byte byte : world.save()) hash = hash * 1099511628211u + std::to_integer<std::uint64_t>(byte);
    lines.push_back("saved " + hash_text(hash) + " not finite " + std::to_string(last.not_finite));
    return lines;
}

std::vector<std::string> steps_of(const RandomProgram& program, std::unique_ptr<Runner> runner) {
    std::vector<std::string> lines = trace_of(program, std::move(runner));
    lines.pop_back();
    return lines;
}

Trace steps_on_ranks(int ranks, std::function<std::unique_ptr<Runner>(const std::shared_ptr<Exchange>&)> make) {
    return [ranks, make = std::move(make)](const RandomProgram& program) {
        std::vector<std::vector<std::string>> seen(static_cast<std::size_t>(ranks));
        run_in_process(ranks, [&](const std::shared_ptr<Exchange>& exchange) {
            seen[static_cast<std::size_t>(exchange->rank())] = steps_of(program, make(exchange));
        });
        for (const std::vector<std::string>& lines : seen)
            for (std::size_t i = 0; i < lines.size(); ++i)
                if (lines[i] != seen[0][i]) seen[0][i] += " parted";
        return seen[0];
    };
}

std::string difference(RandomProgram& program, const MakeRunner& one, const MakeRunner& other) {
    return difference(
        program, [&](const RandomProgram& tried) { return trace_of(tried, one()); },
        [&](const RandomProgram& tried) { return trace_of(tried, other()); });
}

std::string difference(RandomProgram& program, const Trace& one, const Trace& other) {
    const auto differs = [&](const RandomProgram& tried) { return first_difference(one(tried), other(tried)); };
    if (!differs(program)) return {};
    const auto keep_if_differs = [&](RandomProgram smaller) {
        try {
            const auto line = differs(smaller);
            if (!line) return false;
            smaller.steps = std::min(smaller.steps, static_cast<int>(*line) + 1);
            program = std::move(smaller);
            return true;
        } catch (const std::exception&) {
            return false;
        }
    };
    keep_if_differs(program);
    for (bool again = true; again;) {
        again = false;
        for (std::size_t i = program.acts.size(); i-- > 0;) {
            RandomProgram smaller = program;
            smaller.acts.erase(smaller.acts.begin() + static_cast<std::ptrdiff_t>(i));
            again |= keep_if_differs(smaller);
        }
        for (std::size_t i = program.scene.joints.size(); i-- > 0;) {
            RandomProgram smaller = program;
            smaller.scene.joints.erase(smaller.scene.joints.begin() + static_cast<std::ptrdiff_t>(i));
            again |= keep_if_differs(smaller);
        }
        for (std::size_t i = program.scene.bodies.size(); i-- > 0;) {
            RandomProgram smaller = program;
            Scene& scene = smaller.scene;
            scene.bodies.erase(scene.bodies.begin() + static_cast<std::ptrdiff_t>(i));
            std::erase_if(scene.joints, [&](const Joint& joint) { return joint.a == i || joint.b == i; });
            for (Joint& joint : scene.joints)
                for (std::size_t* end : {&joint.a, &joint.b}) *end -= *end != the_world && *end > i;
            again |= keep_if_differs(smaller);
        }
    }
    const std::vector<std::string> a = one(program), b = other(program);
    const std::size_t line = first_difference(a, b).value_or(0);
    const auto at = [&](const std::vector<std::string>& lines) { return line < lines.size() ? lines[line] : "nothing"; };
    return "after step " + std::to_string(line + 1) + ": " + at(a) + " and " + at(b) + "\n" + text_of(program);
}

std::string text_of(const RandomProgram& program) {
    std::string text =
        "substeps " + std::to_string(program.settings.substeps) + ", steps " + std::to_string(program.steps) + ", acts";
    for (const Act& act : program.acts)
        text += " {" + std::to_string(act.step) + ", " + std::to_string(static_cast<int>(act.kind)) + ", " +
                std::to_string(act.seed) + "}";
    return text + "\n" + scene_to_json(program.scene);
}

}  // namespace scree::tests
