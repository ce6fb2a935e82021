// MuJoCo in the race, at default settings (Newton solver, pyramidal cones, at most 100 iterations, seldom reached),
// one thread. MuJoCo is built for robots: its constraint matrices (rows by degrees of freedom) are sized with 32
// bits, so piles of more than some hundreds of bodies do not fit. It has no restitution and no damping per body.
#include <mujoco/mujoco.h>

#include <cstring>
#include <limits>
#include <sstream>

#include "tests/peers/engine.h"

namespace scree::peers {

namespace {

struct Release {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
};

void require_known(const Body& body, float friction) {
    if (body.friction != friction) throw Unsupported("unequal frictions, of which MuJoCo takes the greater and not the mean");
    if (body.motion == Motion::kinematic) throw Unsupported("a kinematic body, which the race does not drive");
    if (body.restitution > 0) throw Unsupported("restitution, which MuJoCo's contacts do not have");
    if (body.linear_damping > 0 || body.angular_damping > 0) throw Unsupported("damping, which MuJoCo's free bodies do not have");
    if (body.gravity_scale != 1) throw Unsupported("gravity of a body's own");
}

std::ostream& operator<<(std::ostream& text, vec3 v) {
    return text << v.x << ' ' << v.y << ' ' << v.z;
}

// The axis of MuJoCo's planes and capsules is z, that of scree's capsules y.
void write_geom(std::ostream& text, const Body& body) {
    text << "<geom density='" << body.density << "' condim='" << (body.rolling_resistance > 0 ? 6 : 3) << "' friction='"
         << body.friction << " 0 " << body.rolling_resistance << "' ";
    if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
        text << "type='sphere' size='" << sphere->radius << "'";
    } else if (const auto* capsule = std::get_if<Capsule>(&body.shape)) {
        text << "type='capsule' size='" << capsule->radius << ' ' << capsule->half_height << "' zaxis='0 1 0'";
    } else if (const auto* box = std::get_if<Box>(&body.shape)) {
        text << "type='box' size='" << box->half_extents << "'";
    } else if (const auto* plane = std::get_if<Plane>(&body.shape)) {
        text << "type='plane' size='0 0 1' zaxis='" << plane->normal << "' pos='" << plane->normal * plane->offset << "'";
    } else {
        throw Unsupported("a cylinder, cone or hull, which the race does not translate");
    }
    text << "/>";
}

std::string model_text(const Scene& scene) {
    std::ostringstream text;
    text.precision(std::numeric_limits<float>::max_digits10);
    text << "<mujoco><option timestep='" << step_seconds << "' gravity='" << scene.gravity << "'/><worldbody>";
    for (const Body& body : scene.bodies) {
        require_known(body, scene.bodies.front().friction);
        const bool plane = std::holds_alternative<Plane>(body.shape);
        const vec4 q = body.orientation;
        text << "<body pos='" << (plane ? vec3(0) : body.position) << "' quat='";
        if (plane) {
            text << "1 0 0 0'>";
        } else {
            text << q.w << ' ' << q.x << ' ' << q.y << ' ' << q.z << "'>";
        }
        if (body.motion == Motion::dynamic) text << "<freejoint/>";
        write_geom(text, body);
        text << "</body>\n";
    }
    text << "</worldbody></mujoco>";
    return text.str();
}

std::unique_ptr<mjModel, Release> load(const std::string& text) {
    constexpr const char* name = "scene.xml";
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char error[1000] = "";
    std::unique_ptr<mjModel, Release> model(mj_loadXML(name, files.get(), error, sizeof error));
    mj_deleteVFS(files.get());
    if (!model) throw Unsupported(error);
    return model;
}

class Mujoco : public Engine {
public:
    explicit Mujoco(const Scene& scene) : scene_(scene) {
        for (const Body& body : scene.bodies) moving_ += body.motion == Motion::dynamic;
        require_room();
        mju_user_warning = [](const char*) {};  // suppresses MuJoCo's log file; relevant warnings are checked here
        model_ = load(model_text(scene));
        // MuJoCo drops contacts beyond its preallocated number, which would make it look faster; so grow until all
        // fit.
        for (begin(); overflowed(); begin()) rows_of_a_body_ *= 1.3;
        rows_of_a_body_ *= 1.5;  // room for further contacts during the run
        begin();
    }

    std::string name() const override { return std::string("MuJoCo ") + mj_versionString() + ", 1 thread"; }
    void step() override {
        mj_step(model_.get(), data_.get());
        if (overflowed()) throw Unsupported("more contacts than it was given room for");
    }
    std::vector<Pose> poses() const override {
        std::vector<Pose> all;
        for (int i = 1; i < model_->nbody; ++i) {  // body 0 is the world
            const mjtNum *place = data_->xpos + 3 * i, *turn = data_->xquat + 4 * i;
            all.push_back({vec3(place[0], place[1], place[2]), vec4(turn[1], turn[2], turn[3], turn[0])});
        }
        return all;
    }
    std::size_t points() const override { return static_cast<std::size_t>(data_->ncon); }

private:
    double rows() const { return rows_of_a_body_ * static_cast<double>(moving_) + 256; }

    // mjData's largest parts are efc_J, efc_JT (rows by degrees of freedom) and efc_AR (rows by rows), with their column indices.
    void require_room() const {
        const double freedoms = 6.0 * static_cast<double>(moving_);
        const double bytes = 24 * rows() * freedoms + 12 * rows() * rows();
        constexpr double most_bytes = 2147483647.0;  // limit of int
        if (bytes <= most_bytes) return;
        std::ostringstream text;
        text.precision(3);
        text << "its matrices would take more than " << bytes / 1e9 << " GB, and it counts bytes up to 2.15 GB";
        throw Unsupported(text.str());
    }

    void begin() {
        require_room();
        model_->njmax = static_cast<int>(rows());
        model_->nconmax = static_cast<int>(rows() / 3);
        model_->nstack = 128 * 1024 * 1024;  // in doubles
        data_.reset();
        data_.reset(mj_makeData(model_.get()));
        if (!data_) throw Unsupported("beyond memory");
        set_velocities();
        mj_forward(model_.get(), data_.get());
    }

    bool overflowed() const {
        return data_->warning[mjWARN_CONTACTFULL].number > 0 || data_->warning[mjWARN_CNSTRFULL].number > 0;
    }

    // qvel of free bodies: linear velocity in world axes, angular velocity in body axes.
    void set_velocities() {
        mjtNum* speed = data_->qvel;
        for (const Body& body : scene_.bodies) {
            if (body.motion != Motion::dynamic) continue;
            const mjtNum spin[3] = {body.angular_velocity.x, body.angular_velocity.y, body.angular_velocity.z};
            const vec4 q = body.orientation;
            const mjtNum back[4] = {q.w, -q.x, -q.y, -q.z};
            for (int k = 0; k < 3; ++k) speed[k] = body.velocity[k];
            mju_rotVecQuat(speed + 3, spin, back);
            speed += 6;
        }
    }

    Scene scene_;
    std::size_t moving_ = 0;
    double rows_of_a_body_ = 8;  // constraint rows per body, initial estimate
    std::unique_ptr<mjModel, Release> model_;
    std::unique_ptr<mjData, Release> data_;
};

}  // namespace

std::unique_ptr<Engine> make_mujoco(const Scene& scene) {
    return std::make_unique<Mujoco>(scene);
}

}  // namespace scree::peers
