// Sphere and capsule meshes for round.vert.
#include "host/canvas/meshes.h"

#include <cmath>

namespace scree::host {
namespace {

constexpr double PI = 3.14159265358979323846;

glm::vec4 on_circle(int corner, int corners, double share, double stretch) {
    const double angle = 2 * PI * corner / corners;
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), static_cast<float>(share),
            static_cast<float>(stretch)};
}

void add(RoundMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

}  // namespace

RoundMesh sphere_mesh(int corners) {
    RoundMesh mesh;
    // Rings from the silhouette inwards, each with half the vertices of the previous one.
    const double shares[] = {1.0, 0.86, 0.59, 0.34, 0.19};
    const double stretch = std::sqrt(2 * PI / corners / std::sin(2 * PI / corners));
    std::uint32_t outer = 0;
    int count = corners;
    for (int i = 0; i < count; ++i) mesh.directions.push_back(on_circle(i, count, shares[0], stretch));
    for (std::size_t ring = 1; ring < std::size(shares) && count % 2 == 0 && count >= 12; ++ring) {
        const auto inner = static_cast<std::uint32_t>(mesh.directions.size());
        const int half = count / 2;
        for (int i = 0; i < half; ++i) mesh.directions.push_back(on_circle(i, half, shares[ring], stretch));
        for (int i = 0; i < half; ++i) {
            const auto at = static_cast<std::uint32_t>(i);
            const auto next = static_cast<std::uint32_t>((i + 1) % half);
            add(mesh, inner + at, outer + 2 * at, outer + 2 * at + 1);
            add(mesh, inner + at, outer + 2 * at + 1, inner + next);
            add(mesh, inner + next, outer + 2 * at + 1, outer + 2 * next);
        }
        outer = inner;
        count = half;
    }
    const auto pole = static_cast<std::uint32_t>(mesh.directions.size());
    mesh.directions.emplace_back(1, 0, 0, stretch);
    for (int i = 0; i < count; ++i) {
        add(mesh, pole, outer + static_cast<std::uint32_t>(i), outer + static_cast<std::uint32_t>((i + 1) % count));
    }
    return mesh;
}

RoundMesh capsule_mesh(int corners) {
    RoundMesh mesh;
    const int rings = corners >= 32 ? 8 : corners >= 16 ? 4 : corners >= 10 ? 3 : 2;  // per hemisphere
    // From the upper to the lower pole; the equator twice, once for each cap.
    for (int cap = 1; cap >= -1; cap -= 2) {
        for (int k = 0; k <= rings; ++k) {
            const int ring = cap > 0 ? k : rings - k;
            const double polar = 0.5 * PI * ring / rings;
            for (int i = 0; i < corners; ++i) {
                const double angle = 2 * PI * i / corners;
                mesh.directions.emplace_back(std::sin(polar) * std::cos(angle), cap * std::cos(polar),
                                             std::sin(polar) * std::sin(angle), cap);
            }
        }
    }
    const int rows = 2 * (rings + 1);
    for (int row = 0; row + 1 < rows; ++row) {
        for (int i = 0; i < corners; ++i) {
            const auto a = static_cast<std::uint32_t>(row * corners + i);
            const auto b = static_cast<std::uint32_t>(row * corners + (i + 1) % corners);
            const auto c = a + static_cast<std::uint32_t>(corners);
            const auto d = b + static_cast<std::uint32_t>(corners);
            if (row > 0) add(mesh, a, b, c);  // at the poles one of the two triangles is degenerate
            if (row + 2 < rows) add(mesh, b, d, c);
        }
    }
    return mesh;
}

}  // namespace scree::host
