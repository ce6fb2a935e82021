// A file: a head with the hashes of mesh and wishes, the corners of each part, and a checksum of all before it.
#include "compute/scene/meshes/decomposition_cache.h"

#include <xxhash.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "host/files/file.h"

namespace scree {

namespace {

constexpr std::uint64_t magic = 0x3173'7472'6170'6373u;  // "scparts1"; another number for another way to decompose
constexpr std::uintmax_t most_bytes = 1 << 20;

struct Head {
    std::uint64_t magic, mesh, mesh_again, wanted, vertices, triangles, parts, enough, closed, thin, inside_out;
    double error, hull_error, volume;
    double centre[3], inertia[9];
};
static_assert(std::is_trivially_copyable_v<Head>);

Head head_of(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles, const Decomposition& wanted) {
    const auto hash = [&](std::uint64_t seed) {
        const std::uint64_t of_vertices = XXH64(vertices.data(), vertices.size_bytes(), seed);
        return XXH64(triangles.data(), triangles.size_bytes(), of_vertices);
    };
    Head head{};
    head.magic = magic;
    head.mesh = hash(1);
    head.mesh_again = hash(2);
    std::uint32_t error = 0;
    std::memcpy(&error, &wanted.error, sizeof error);
    head.wanted = (std::uint64_t{error} << 32) | (std::uint64_t{wanted.parts} << 16) | wanted.vertices;
    head.vertices = vertices.size();
    head.triangles = triangles.size();
    return head;
}

std::filesystem::path file_of(const Head& head) {
    const std::filesystem::path folder = decomposition_folder();
    if (folder.empty()) return {};
    char name[64];
    std::snprintf(name, sizeof name, "%016llx%016llx.parts", static_cast<unsigned long long>(head.mesh),
                  static_cast<unsigned long long>(head.mesh_again ^ head.wanted * 0x9E3779B97F4A7C15u));
    return folder / name;
}

// Folders of SCREE_CACHE that could not be written, and what is still to be told of them.
struct Unusable {
    std::mutex lock;
    std::set<std::filesystem::path> folders;
    std::string reason;
};
Unusable& unusable() {
    static Unusable all;
    return all;
}

void note_unusable(const std::filesystem::path& folder) {
    const char* given = std::getenv("SCREE_CACHE");
    if (!given || !*given) return;  // nobody asked for it
    const std::lock_guard held(unusable().lock);
    if (!unusable().folders.insert(folder).second) return;
    std::error_code failed;
    const bool other = std::filesystem::exists(folder, failed) && !std::filesystem::is_directory(folder, failed);
    unusable().reason = "SCREE_CACHE: \"" + folder.string() + "\" " + (other ? "is no folder" : "cannot be written") +
                        "; convex parts are not kept";
}

}  // namespace

std::filesystem::path decomposition_folder() {
    if (const char* given = std::getenv("SCREE_CACHE"); given && *given)
        return std::string(given) == "off" ? std::filesystem::path() : std::filesystem::path(given);
    const std::filesystem::path folder = host::cache_folder();
    return folder.empty() ? folder : folder / "parts";
}

bool take_from_cache(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles, const Decomposition& wanted,
                     ConvexParts& made) {
    const Head expected = head_of(vertices, triangles, wanted);
    const std::filesystem::path file = file_of(expected);
    std::error_code failed;
    if (file.empty() || !std::filesystem::is_regular_file(file, failed)) return false;
    std::string bytes;
    try {
        bytes = host::read_regular(file, most_bytes);
    } catch (const host::FileError&) {
        return false;
    }
    if (bytes.size() < sizeof(Head) + 8) return false;
    std::uint64_t checksum = 0;
    std::memcpy(&checksum, bytes.data() + bytes.size() - 8, 8);
    bytes.resize(bytes.size() - 8);
    Head head;
    std::memcpy(&head, bytes.data(), sizeof head);
    if (checksum != XXH64(bytes.data(), bytes.size(), 3) || head.magic != magic || head.mesh != expected.mesh ||
        head.mesh_again != expected.mesh_again || head.wanted != expected.wanted || head.vertices != expected.vertices ||
        head.triangles != expected.triangles || head.parts == 0 || head.parts > 256)
        return false;
    glm::vec3 lower(1e30f), upper(-1e30f);
    for (const glm::vec3& v : vertices) lower = glm::min(lower, v), upper = glm::max(upper, v);
    const glm::vec3 rounding = (upper - lower) * 1e-5f + 1e-6f;
    ConvexParts read;
    std::size_t at = sizeof head;
    const auto take = [&](void* to, std::size_t size) {
        if (bytes.size() - at < size) return false;
        std::memcpy(to, bytes.data() + at, size);
        at += size;
        return true;
    };
    for (std::uint64_t i = 0; i < head.parts; ++i) {
        std::uint64_t corners = 0;
        if (!take(&corners, sizeof corners) || corners < 4 || corners > wanted.vertices) return false;
        std::vector<glm::vec3>& part = read.parts.emplace_back(corners);
        if (!take(part.data(), corners * sizeof(glm::vec3))) return false;
        for (const glm::vec3& v : part)
            if (!glm::all(glm::greaterThanEqual(v, lower - rounding)) || !glm::all(glm::lessThanEqual(v, upper + rounding)))
                return false;
    }
    if (at != bytes.size()) return false;
    read.error = head.error;
    read.hull_error = head.hull_error;
    read.enough = (head.enough & 1u) != 0;
    read.given_up = (head.enough & 2u) != 0;
    read.closed = head.closed;
    read.thin = head.thin;
    read.inside_out = head.inside_out != 0;
    read.volume = head.volume;
    for (int i = 0; i < 3; ++i) read.centre[i] = head.centre[i];
    for (int i = 0; i < 9; ++i) read.inertia[i / 3][i % 3] = head.inertia[i];
    if (!(read.volume > 0) || !(read.inertia[0][0] > 0) || !std::isfinite(read.volume + glm::dot(read.centre, read.centre)))
        return false;
    made = std::move(read);
    return true;
}

void put_in_cache(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles, const Decomposition& wanted,
                  const ConvexParts& made) {
    Head head = head_of(vertices, triangles, wanted);
    const std::filesystem::path file = file_of(head);
    if (file.empty()) return;
    head.parts = made.parts.size();
    head.enough = (made.enough ? 1u : 0u) | (made.given_up ? 2u : 0u);
    head.closed = made.closed;
    head.thin = made.thin;
    head.inside_out = made.inside_out;
    head.error = made.error;
    head.hull_error = made.hull_error;
    head.volume = made.volume;
    for (int i = 0; i < 3; ++i) head.centre[i] = made.centre[i];
    for (int i = 0; i < 9; ++i) head.inertia[i] = made.inertia[i / 3][i % 3];
    std::string bytes(reinterpret_cast<const char*>(&head), sizeof head);
    for (const std::vector<glm::vec3>& part : made.parts) {
        const std::uint64_t corners = part.size();
        bytes.append(reinterpret_cast<const char*>(&corners), sizeof corners);
        bytes.append(reinterpret_cast<const char*>(part.data()), part.size() * sizeof(glm::vec3));
    }
    const std::uint64_t checksum = XXH64(bytes.data(), bytes.size(), 3);
    bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
    try {
        host::make_folder(file.parent_path());
        host::write_atomically(file, std::string_view(bytes));
    } catch (const host::FileError&) {
        // A cache is no result: the next run makes the parts anew.
        note_unusable(file.parent_path());
    }
}

std::string unusable_cache() {
    const std::lock_guard held(unusable().lock);
    return std::exchange(unusable().reason, {});
}

}  // namespace scree
