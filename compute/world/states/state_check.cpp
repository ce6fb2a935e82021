// Checks of the tables in a checkpoint. Whoever writes a checkpoint by hand gives it the right hash as well, so that
// indices are checked before a step follows them.
#include "compute/world/states/state_check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string>

#include "compute/checkpoint.h"
#include "compute/schema/body.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/collide/shape_data.h"
#include "shaders/physics/collide/triangle.h"
#include "shaders/physics/joint/joint_coupling.h"

namespace scree {

namespace {

using physics::NONE;

// Bounds that span more cells of the coarsest level than a few would be searched without end.
constexpr float most_cells = static_cast<float>(1u << (physics::LEVELS - 1));

class Check {
public:
    Check(const SavedTables& saved, const State& own) : saved_(saved), own_(own), p_(saved.parameters) {}

    void all() {
        check_parameters();
        check_rows();
        check_bodies();
        check_contacts();
        check_joints();
        check_joint_lists();
        check_vehicles();
        check_fractures();
        check_exclusions();
        check_surfaces();
        check_bonds();
        for (std::size_t k = 0; k < saved_.parts.size(); ++k)
            require(is_pose(saved_.parts[k].position, saved_.parts[k].orientation), "part", k, "has a pose that is not finite");
    }

private:
    [[noreturn]] static void refuse(const std::string& what) { throw CheckpointError("the checkpoint is damaged: " + what); }
    static void require(bool holds, const char* table, std::size_t index, const char* reason) {
        if (!holds) refuse(std::string(table) + " " + std::to_string(index) + " " + reason);
    }
    static bool finite(std::initializer_list<float> numbers) {
        return std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); });
    }
    static bool finite(const physics::vec3& v) { return finite({v.x, v.y, v.z}); }
    static bool in(physics::uint index, std::size_t size) { return index < size; }
    static bool in_or_none(physics::uint index, std::size_t size) { return index == NONE || index < size; }
    // Whether `count` records from `first` on are in a table.
    static bool run_in(physics::uint first, physics::uint count, std::size_t size) {
        return first <= size && count <= size - first;
    }

    void check_parameters() const {
        const physics::Parameters& now = own_.fixed();
        if (!std::has_single_bit(p_.buckets) || p_.buckets > State::buckets_for(std::max(p_.bodies, now.bodies)))
            refuse("its grid has " + std::to_string(p_.buckets) + " buckets");
        if (p_.copies != now.copies || p_.bodies_of_copy != now.bodies_of_copy || p_.attractors > physics::MOST_ATTRACTORS)
            refuse("its copies or attractors are not those of the scene");
        const bool sound = finite({p_.cell, p_.inverse_cell, p_.air_density, p_.water_offset, p_.water_density, p_.water_damping,
                                   p_.attractor_radius}) &&
                           finite(p_.wind) && finite(p_.water_normal) && finite(p_.water_velocity) && p_.cell > 0 &&
                           p_.inverse_cell == 1 / p_.cell;
        if (!sound) refuse("its grid or its fields have numbers that are not finite");
        const auto is_period = [&](int k) {
            return (p_.period[k] == 0 && p_.half_period[k] == 1e30f && p_.inverse_period[k] == 0 && p_.cell_rate[k] == 0) ||
                   (p_.period[k] >= 0.005f && p_.half_period[k] == 0.5f * p_.period[k] &&
                    p_.inverse_period[k] == 1 / p_.period[k]);
        };
        if (!finite(p_.period) || !finite(p_.cell_centre) || !finite(p_.cell_rate) || !is_period(0) || !is_period(1) ||
            !is_period(2))
            refuse("its periodic cell has sizes or rates that no scene has");
        if ((p_.air_density != 0 || p_.water_density != 0) && saved_.immersions.size() < saved_.body_count)
            refuse("it says of " + std::to_string(saved_.immersions.size()) + " bodies alone how they meet air and water");
    }

    void check_rows() const {
        std::vector<bool> taken(saved_.rows.empty() ? 0 : p_.first_part);
        for (std::size_t id = 0; id < saved_.rows.size(); ++id) {
            require(!taken[saved_.rows[id]], "body", id, "is in the row of another");
            taken[saved_.rows[id]] = true;
        }
    }

    physics::uvec4 quad(std::size_t place) const {
        return place < saved_.at_start.hulls ? own_.hulls[place] : saved_.hulls[place - saved_.at_start.hulls];
    }
    // The layout of shape_data.h.
    bool is_hull(std::size_t place, bool triangle) const {
        const std::size_t size = saved_.at_start.hulls + saved_.hulls.size();
        if (place >= size) return false;
        const physics::uvec4 head = quad(place);
        const std::size_t vertices = head.x, faces = head.y, across = head.z;
        if (vertices < 3 || vertices > physics::MOST_CORNERS || faces < 1 || faces > 2 * physics::MOST_CORNERS) return false;
        if (across != 0 && across != 2 && across != 4) return false;
        const std::size_t cells = physics::cells_of(head.z);
        const std::size_t first_face = place + 1 + vertices + faces, list = first_face + faces + 2 * cells;
        if (list > size) return false;
        const physics::uvec4 last = quad(first_face + faces - 1);
        const std::size_t corners = std::size_t{last.x} + last.y;
        if (corners > 16 * physics::MOST_CORNERS || list + (corners + 15) / 16 > size) return false;
        for (std::size_t face = 0; face < faces; ++face) {
            const physics::uvec4 one = quad(first_face + face);
            if (one.y < 3 || std::size_t{one.x} + one.y > corners) return false;
        }
        for (std::size_t k = 0; k < corners; ++k)
            if (physics::byte_of(quad(list + k / 16), static_cast<physics::uint>(k % 16)) >= vertices) return false;
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const physics::uvec4 near = quad(first_face + faces + 2 * cell), over = quad(first_face + faces + 2 * cell + 1);
            if (!lists(near, 1, physics::LISTED_VERTICES, vertices) || !lists(over, 2, physics::LISTED_FACES, faces))
                return false;
        }
        return !triangle || (vertices == 3 && place + physics::FIRST_LIMIT + 3 <= size);
    }
    // Whether the bytes from `first` on, as many as byte 0 says, are indices below `end`.
    static bool lists(const physics::uvec4& sixteen, physics::uint first, physics::uint most, std::size_t end) {
        const physics::uint count = physics::byte_of(sixteen, 0);
        if (count > most) return false;
        for (physics::uint k = 0; k < count; ++k)
            if (physics::byte_of(sixteen, first + k) >= end) return false;
        return true;
    }

    // The layout of seam.h.
    bool is_seams(std::size_t place) const {
        const std::size_t size = saved_.at_start.hulls + saved_.hulls.size();
        if (place >= size) return false;
        const std::size_t solids = quad(place).x;
        ++place;
        for (std::size_t k = 0; k < solids; ++k) {
            if (place >= size) return false;
            const physics::uvec4 head = quad(place);
            if (head.x > 2 * physics::MOST_CORNERS || head.y > physics::MOST_CORNERS) return false;
            place += std::size_t{1} + head.x + head.y;
        }
        return solids > 0 && place <= size;
    }

    // Bound on the width of a row's bounds in a step, m.
    float reach_of(std::size_t row, const physics::BodyProperties& body) const {
        const bool part = row >= p_.first_part && in(body.owner, p_.first_part);
        const physics::Velocity velocity = saved_.velocities[part ? body.owner : row];
        const float lever = part ? length(saved_.parts[row - p_.first_part].position) : 0;
        const float reach = 4 * length(body.size);  // not less than the width of any shape
        const float turn = length(velocity.angular) * p_.dt;
        const float way = (p_.max_speed + length(velocity.linear)) * p_.dt + (turn + turn * turn) * lever;
        return 4 * (reach + p_.speculative + way);
    }
    static float length(const physics::vec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

    void check_shape(std::size_t row, const physics::BodyProperties& body) {
        const bool hull = body.shape == physics::SHAPE_HULL, triangle = body.shape == physics::SHAPE_TRIANGLE;
        require(body.shape <= physics::SHAPE_NONE, "row", row, "has a shape that is not known");
        require(body.shape != physics::SHAPE_NONE || !physics::is_large(body), "row", row, "is large and has no shape");
        if ((hull || triangle) && known_hulls_.insert({body.shape_data, triangle}).second)
            require(is_hull(body.shape_data, triangle), "row", row, "has a hull that does not fit the table of hulls");
        require(physics::tyre_of(body) <= saved_.at_start.tyres + saved_.tyres.size(), "row", row,
                "has a tyre that the table of tyres lacks");
        require((body.flags >> physics::ROW_SURFACE_SHIFT) <= saved_.surfaces.size(), "row", row,
                "has a material that the table of surfaces lacks");
    }

    static bool is_factor(float scale) { return schema::field_of(&Body::gravity_scale).range.holds(scale); }
    static bool is_pose(const physics::vec3& position, const physics::vec4& q) {
        return finite(position) && std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 1e-3f;
    }

    void check_bodies() {
        for (std::size_t row = 0; row < p_.bodies; ++row) {
            const physics::BodyProperties body = saved_.properties[row];
            const bool part = row >= p_.first_part;
            const physics::uint motion = body.motion & ~(part ? physics::MOTION_OF_PART : 0u);
            require(motion <= physics::MOTION_QUARANTINED, "row", row, "has a motion that is not known");
            require(part ? in(body.owner, p_.first_part) || (body.motion & physics::MOTION_OF_PART) == 0 : body.owner == row,
                    "row", row, "belongs to a body that is none");
            require(in_or_none(body.fracture, saved_.fractures.size()), "row", row,
                    "breaks into what the table of fractures lacks");
            require(in_or_none(body.joints, saved_.joints.size()), "row", row, "is on a joint that is none");
            require(finite(body.size) && finite(body.inverse_inertia) && is_factor(body.gravity_scale) &&
                        finite({body.inverse_mass, body.friction, body.restitution, body.rolling_resistance, body.gravity_scale,
                                body.linear_damping, body.angular_damping}),
                    "row", row, "has sizes, masses or a material that are not finite");
            require(body.restitution >= 0 && body.restitution <= 1, "row", row, "has a restitution that is not between 0 and 1");
            check_shape(row, body);
            const physics::uint seams = part && physics::is_part(body) ? saved_.parts[row - p_.first_part].seams : 0;
            require(seams == 0 || !known_seams_.insert(seams).second || is_seams(seams - 1), "row", row,
                    "has seams that do not fit the table of hulls");
            const bool in_grid = !physics::is_large(body) && body.shape != physics::SHAPE_NONE && !physics::is_apart(body);
            require(!in_grid || (body.shape != physics::SHAPE_PLANE && reach_of(row, body) * p_.inverse_cell < most_cells), "row",
                    row, "spans too many cells of the grid");
            const physics::Pose pose = saved_.poses[row];
            const physics::Velocity velocity = saved_.velocities[row];
            require(is_pose(pose.position, pose.orientation) && finite({pose.low_x, velocity.low_y, velocity.low_z}) &&
                        finite(velocity.linear) && finite(velocity.angular),
                    "row", row, "has a pose or velocity that is not finite");
        }
    }

    void check_contacts() const {
        physics::uint before = 0;
        for (std::size_t row = 0; row <= p_.bodies; ++row) {
            const physics::uint first = saved_.first_contacts[row];
            require(first >= before && first <= saved_.counts.contacts, "row", row, "has contacts that are none");
            before = first;
        }
        for (std::size_t i = 0; i < saved_.counts.contacts; ++i) {
            const physics::Contact contact = saved_.contacts[i];
            require(in(contact.a, p_.bodies) && in(contact.b, p_.bodies) && contact.a != contact.b, "contact", i,
                    "is of a body that is none");
            require(contact.count >= 1 && contact.count <= 4, "contact", i, "has more than four points, or none");
        }
    }

    void check_joints() const {
        const std::size_t bodies = p_.first_part;
        std::size_t first_joint = 0, first_body = 0;
        for (std::size_t k = 0; k < p_.joint_blocks; ++k) {
            const physics::JointBlock block = saved_.joint_blocks[k];
            require(block.first_joint == first_joint && block.joints <= physics::MAX_BLOCK_JOINTS &&
                        run_in(block.first_joint, block.joints, saved_.joints.size()),
                    "joint block", k, "does not follow the one before it in the table of joints");
            require(block.first_body == first_body && block.bodies <= 2 * block.joints &&
                        run_in(block.first_body, block.bodies, saved_.block_bodies.size()),
                    "joint block", k, "does not follow the one before it in the table of block bodies");
            require(block.couplings <= block.joints && (block.couplings == 0 || block.joints <= physics::MAX_COUPLED_BLOCK),
                    "joint block", k, "has more couplings than there is room for");
            first_joint += block.joints;
            first_body += block.bodies;
            for (std::size_t j = block.first_joint; j < first_joint; ++j) {
                check_joint(j, block);
                check_coupling(j, block);
            }
        }
        std::vector<physics::uint> blocks_of(bodies);
        for (std::size_t m = 0; m < first_body; ++m) {
            require(in(saved_.block_bodies[m].body, bodies), "block body", m, "is none");
            ++blocks_of[saved_.block_bodies[m].body];
        }
        for (std::size_t m = 0; m < first_body; ++m)
            require(saved_.block_bodies[m].blocks == blocks_of[saved_.block_bodies[m].body], "block body", m,
                    "is in another number of blocks than it says");
    }
    void check_joint(std::size_t j, const physics::JointBlock& block) const {
        const physics::Joint joint = saved_.joints[j];
        const auto in_block = [&](physics::uint member) {
            return member == NONE || (member >= block.first_body && member - block.first_body < block.bodies);
        };
        require(in_or_none(joint.a, p_.first_part) && in_or_none(joint.b, p_.first_part), "joint", j,
                "is of a body that is none");
        require(in_block(joint.block_body_a) && in_block(joint.block_body_b), "joint", j, "is of a body of another block");
        require(joint.fill_in <= physics::MAX_FILL_IN, "joint", j, "has more fill-in than there is room for");
        for (physics::uint k = 0; k < joint.fill_in; ++k)
            require(joint.fill_in_of[k] > j && joint.fill_in_of[k] - block.first_joint < block.joints, "joint", j,
                    "fills in equations of another block");
        require(in_or_none(joint.next_a, saved_.joints.size()) && in_or_none(joint.next_b, saved_.joints.size()), "joint", j,
                "is followed in a body's list by what is no joint");
    }
    // The couplings are the last joints of their block, and couple the others.
    void check_coupling(std::size_t j, const physics::JointBlock& block) const {
        const physics::Joint joint = saved_.joints[j];
        const std::size_t inner = block.first_joint + block.joints - block.couplings;
        const bool couples = (joint.flags & physics::JOINT_COUPLES) != 0;
        require(couples == (j >= inner), "joint", j, "is a coupling among joints, or a joint among couplings");
        if (!couples) return;
        const physics::uint terms = physics::terms_of_coupling(joint.flags);
        require(terms <= ((joint.flags & physics::JOINT_CURVED) != 0 ? 4u : 8u) && joint.fill_in == 0 && joint.a == NONE &&
                    joint.b == NONE && joint.block_body_a == NONE && joint.block_body_b == NONE,
                "joint", j, "is a coupling of more than there is room for, or of bodies");
        require(physics::reach_of_coupling(joint.flags) <= physics::FARTHEST_REACH, "joint", j,
                "is a coupling that reaches too far");
        for (const physics::JointAxis& axis : joint.axes)
            require(axis.mode == 0, "joint", j, "is a coupling with axes of its own");
        for (physics::uint t = 0; t < terms; ++t) {
            const physics::uint of = physics::joint_of_term(joint.fill_in_of[t]), k = physics::axis_of_term(joint.fill_in_of[t]);
            require(of >= block.first_joint && of < inner && k < 6, "joint", j, "couples what is no joint of its block");
            const physics::Joint coupled = saved_.joints[of];
            require(coupled.axes[k].mode != 0, "joint", j, "couples an axis that has no row");
        }
    }
    // A body's list names each of its joints once.
    void check_joint_lists() const {
        std::vector<std::uint8_t> named(saved_.joints.size());
        for (std::size_t row = 0; row < p_.first_part; ++row) {
            physics::uint j = saved_.properties[row].joints;
            while (j != NONE) {
                const physics::Joint joint = saved_.joints[j];
                require((joint.a == row || joint.b == row) && ++named[j] <= 2, "row", row,
                        "has a list of joints that is none of its own");
                j = joint.a == row ? joint.next_a : joint.next_b;
            }
        }
    }

    void check_vehicles() const {
        for (std::size_t k = 0; k < p_.vehicles; ++k) {
            const physics::Vehicle vehicle = saved_.vehicles[k];
            const physics::VehicleDynamics& dynamics = vehicle.dynamics;
            require(in(dynamics.chassis, p_.first_part) && dynamics.wheels <= physics::MOST_WHEELS, "vehicle", k,
                    "has a chassis that is none, or too many wheels");
            require(run_in(dynamics.route, dynamics.points, own_.way_points.size()) &&
                        (dynamics.points == 0 || dynamics.next <= dynamics.points),
                    "vehicle", k, "has a route that is none");
            for (physics::uint w = 0; w < dynamics.wheels; ++w)
                require(in(vehicle.wheel[w].joint, saved_.joints.size()) && in(vehicle.wheel[w].body, p_.first_part), "vehicle",
                        k, "has a wheel that is none");
        }
    }

    void check_fractures() const {
        for (std::size_t k = 0; k < saved_.fractures.size(); ++k) {
            const physics::Fracturing fracture = saved_.fractures[k];
            require(run_in(fracture.first_row, fracture.count, p_.first_part) &&
                        run_in(fracture.first_pose, fracture.count, saved_.at_start.pieces + saved_.pieces.size()),
                    "fracture", k, "has fragments that are none");
        }
    }

    void check_exclusions() const {
        for (std::size_t k = 0; k < saved_.exclusions.size(); ++k)
            require(saved_.exclusions[k].y == NONE || saved_.exclusions[k].y < k, "exclusion", k, "is followed by one behind it");
        for (std::size_t row = 0; row < saved_.filters.size(); ++row)
            require(in_or_none(saved_.filters[row].w, saved_.exclusions.size()), "row", row,
                    "has excluded partners that are none");
    }

    void check_bonds() const {
        require(p_.bonds == own_.bonds.size() && p_.bonded == own_.bond_ends.size() && saved_.bonds.size() == p_.bonds &&
                    saved_.bond_states.size() == p_.bonds,
                "bond", p_.bonds, "is not of the scene");
        for (std::size_t k = 0; k < saved_.bonds.size(); ++k) {
            const physics::Bond one = saved_.bonds[k];
            require(in(one.a, p_.first_part) && in(one.b, p_.first_part) && one.place_a == own_.bonds[k].place_a &&
                        one.place_b == own_.bonds[k].place_b,
                    "bond", k, "is of a body that is none");
        }
    }

    void check_surfaces() const {
        for (std::size_t k = 0; k < saved_.surfaces.size(); ++k) {
            const physics::Surface one = saved_.surfaces[k];
            require(one.cohesion >= 0 && one.cohesion <= 1e6f && one.curvature >= 0 && one.curvature <= 1e9f &&
                        std::isfinite(one.cohesion_range),
                    "surface", k, "has a cohesion that is out of range");
            require(saved_.surfaces[k].friction_rule <= physics::COMBINE_OVERRIDING_AVERAGE &&
                        saved_.surfaces[k].restitution_rule <= physics::COMBINE_OVERRIDING_AVERAGE,
                    "surface", k, "combines by a rule that is not known");
        }
    }

    const SavedTables& saved_;
    const State& own_;
    const physics::Parameters& p_;
    std::set<std::pair<physics::uint, bool>> known_hulls_;
    std::set<physics::uint> known_seams_;
};

}  // namespace

void check_tables(const SavedTables& saved, const State& own) {
    Check(saved, own).all();
}

}  // namespace scree
