// Bodies of convex parts in place of meshes.
#include "compute/scene/meshes/decomposed.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <mutex>

#include "compute/scene/meshes/decomposition_cache.h"
#include "compute/scene/meshes/mesh.h"

namespace scree {

namespace {

using glm::dmat3;
using glm::uvec3;

struct Made {
    std::vector<vec3> vertices;
    std::vector<uvec3> triangles;
    Decomposition wanted;
    std::shared_ptr<const ConvexParts> parts;
};
constexpr std::size_t most_kept = 256;

struct Kept {
    std::mutex lock;
    std::deque<Made> made;
    std::function<void(const std::string&, double)> tell;
    std::function<bool()> stop;
};
Kept& kept() {
    static Kept all;
    return all;
}

bool equal(const Made& made, std::span<const vec3> vertices, std::span<const uvec3> triangles, const Decomposition& wanted) {
    return made.wanted == wanted && made.vertices.size() == vertices.size() && made.triangles.size() == triangles.size() &&
           std::memcmp(made.vertices.data(), vertices.data(), vertices.size_bytes()) == 0 &&
           std::memcmp(made.triangles.data(), triangles.data(), triangles.size_bytes()) == 0;
}

// Tells after half a second, then every two; stops when that is asked for.
std::function<void(double)> teller(std::function<void(const std::string&, double)> tell, std::function<bool()> stop,
                                   std::size_t triangles) {
    if (!tell && !stop) return {};
    using Clock = std::chrono::steady_clock;
    return [tell = std::move(tell), stop = std::move(stop),
            what = "decomposing a mesh of " + std::to_string(triangles) + " triangles",
            next = Clock::now() + std::chrono::milliseconds(500)](double done) mutable {
        if (stop && stop()) throw DecompositionStopped(what + ": stopped");
        const Clock::time_point now = Clock::now();
        if (!tell || now < next) return;
        next = now + std::chrono::seconds(2);
        tell(what, done);
    };
}

std::string percent(double share) {
    const auto tenths = static_cast<long>(share * 1000 + 0.5);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + "%";
}

}  // namespace

void tell_of_decompositions(std::function<void(const std::string&, double)> tell) {
    const std::lock_guard held(kept().lock);
    kept().tell = std::move(tell);
}

void stop_decompositions_if(std::function<bool()> stop) {
    const std::lock_guard held(kept().lock);
    kept().stop = std::move(stop);
}

std::shared_ptr<const ConvexParts> convex_parts(std::span<const vec3> vertices, std::span<const uvec3> triangles,
                                                const Decomposition& wanted) {
    Kept& all = kept();
    std::function<void(const std::string&, double)> tell;
    std::function<bool()> stop;
    const auto find = [&]() -> std::shared_ptr<const ConvexParts> {
        const std::lock_guard held(all.lock);
        tell = all.tell;
        stop = all.stop;
        for (const Made& one : all.made)
            if (equal(one, vertices, triangles, wanted)) return one.parts;
        return nullptr;
    };
    if (auto known = find()) return known;
    auto made = std::make_shared<ConvexParts>();
    if (!take_from_cache(vertices, triangles, wanted, *made)) {
        *made = decompose(vertices, triangles, wanted, teller(tell, stop, triangles.size()));
        put_in_cache(vertices, triangles, wanted, *made);
    }
    const std::lock_guard held(all.lock);
    all.made.push_back({{vertices.begin(), vertices.end()}, {triangles.begin(), triangles.end()}, wanted, made});
    if (all.made.size() > most_kept) all.made.pop_front();
    return made;
}

std::string summary_of(const ConvexParts& made) {
    std::string text = "is " + std::to_string(made.parts.size()) + (made.parts.size() == 1 ? " convex part" : " convex parts") +
                       "; their surface is within " + percent(made.error) +
                       " of its size of the mesh's (that of its hull: " + percent(made.hull_error) + ")";
    if (made.given_up) text += "; to cut it up takes too long, as where faces cross: mend it, or allow a larger \"error\"";
    if (!made.enough) text += "; more \"parts\" would be nearer";
    if (made.closed > 0) text += "; " + std::to_string(made.closed) + " open edges are closed by flat lids";
    if (made.inside_out) text += "; faces that pointed inward are turned";
    if (made.thin > 0)
        text +=
            "; " + std::to_string(made.thin) + " parts thinner than 0.001 m, or than a thousandth of their length, are left out";
    return text;
}

Compound compound_of(const ConvexParts& made, std::shared_ptr<const Mesh> skin) {
    Compound compound;
    for (const std::vector<vec3>& corners : made.parts) {
        Part& part = compound.parts.emplace_back();
        part.shape = Hull{corners};
        part.skinned = true;
    }
    compound.skins.push_back({std::move(skin)});
    return compound;
}

void decompose_mesh(const Examination& body, Body& b, CheckedShapes& shapes, std::vector<std::string>* notes) {
    Mesh mesh = std::get<Mesh>(std::move(b.shape));
    const Decomposition wanted = mesh.decompose.value_or(Decomposition{});
    const Examination at = body.part("/shape/mesh");
    at.between("/decompose/error", wanted.error, 0.002f, 0.5f, "");
    at.between("/decompose/parts", static_cast<float>(wanted.parts), 1, 256, "");
    at.between("/decompose/vertices", static_cast<float>(wanted.vertices), 8, 64, "");
    if (b.fracture) body.refuse("/fracture", "a mesh cannot break; break a hull, or make its pieces bodies of their own");
    mesh.decompose.reset();
    std::shared_ptr<const ConvexParts> made;
    std::shared_ptr<const Mesh> skin;
    try {
        made = convex_parts(mesh.vertices, mesh.triangles, wanted);
        skin = shapes.skin(std::make_shared<const Mesh>(std::move(mesh)));
    } catch (const MeshError& error) {
        at.refuse(error.place, error.what());
    } catch (const DecompositionError& error) {
        at.refuse("", error.what());
    }
    const bool is_first = std::ranges::find(shapes.decomposed, made) == shapes.decomposed.end();
    if (is_first) shapes.decomposed.push_back(made);
    if (is_first && notes) {
        const std::size_t crossing = crossing_triangles(*skin->form);
        notes->push_back(at.place() + ": " + summary_of(*made) +
                         (crossing == 0 ? ""
                                        : "; " + std::to_string(crossing) +
                                              " triangles cut through others: what their solids share has its mass twice"));
        if (const std::string why = unusable_cache(); !why.empty()) notes->push_back(at.place() + ": " + why);
    }
    if (!b.inertial) {
        const double density = static_cast<double>(b.density);
        const dmat3 axes = principal_axes(made->inertia), along = glm::transpose(axes) * made->inertia * axes;
        Inertial& own = b.inertial.emplace();
        own.mass = static_cast<float>(made->volume * density);
        own.centre = vec3(made->centre);
        if (2 * std::max({along[0][0], along[1][1], along[2][2]}) > 1.001 * (along[0][0] + along[1][1] + along[2][2]))
            at.refuse(
                "",
                "its faces cross so that it encloses no body, some of its volume counting as negative; mend it, or use its hull");
        own.inertia = vec3(glm::dvec3(along[0][0], along[1][1], along[2][2]) * density);
        const glm::dquat turn = glm::normalize(glm::quat_cast(axes));
        own.frame = vec4(glm::dvec4(turn.x, turn.y, turn.z, turn.w));
    }
    b.shape = compound_of(*made, std::move(skin));
}

}  // namespace scree
