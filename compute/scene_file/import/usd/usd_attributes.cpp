// Values of attributes of a composed USD scene, and transforms.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/portable_math.h"
#include "compute/scene_file/import/usd/usd_stage.h"

namespace scree::imports {

namespace {

constexpr double degree = std::numbers::pi / 180;

const UsdValue& only(const UsdValue& samples) {
    return samples.samples->front().second;
}

bool finite(const std::vector<double>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::abs(x) <= 1e30; });
}

// By right angles exactly.
dmat3 turned_about(int axis, double degrees) {
    const double turns = degrees / 90;
    const bool right = turns == std::round(turns) && std::abs(turns) < 1e9;
    const auto quarter = right ? static_cast<int>(std::fmod(turns, 4) + 4) % 4 : 0;
    const double c = right ? (quarter == 0 ? 1 : quarter == 2 ? -1 : 0) : portable::cos(std::fmod(degrees, 360) * degree);
    const double s = right ? (quarter == 1 ? 1 : quarter == 3 ? -1 : 0) : portable::sin(std::fmod(degrees, 360) * degree);
    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
    dmat3 turn(1);
    turn[y][y] = c, turn[y][z] = s, turn[z][y] = -s, turn[z][z] = c;
    return turn;
}

}  // namespace

double UsdStage::metadata(const std::string& name, double otherwise) const {
    const UsdValue value = metadata(name);
    return value.kind == UsdValue::Kind::numbers && !value.numbers.empty() ? value.numbers[0] : otherwise;
}
std::string UsdStage::metadata(const std::string& name, const std::string& otherwise) const {
    const UsdValue value = metadata(name);
    return value.kind == UsdValue::Kind::texts && !value.texts.empty() ? value.texts[0] : otherwise;
}

UsdValue UsdStage::value(const UsdPrim& prim, const std::string& name) const {
    for (const UsdSite& site : prim.sites) {
        const std::string path = site.path + "." + name;
        for (const UsdStack::Entry& one : site.stack->layers) {
            look(prim, 1);
            const UsdSpec* spec = one.layer->find(path);
            if (!spec) continue;
            const UsdValue samples = one.layer->value(*spec, "timeSamples");
            if (samples.kind == UsdValue::Kind::samples && !samples.samples->empty()) {
                look(prim, samples.samples->size());
                const double offset = site.offset + site.scale * one.offset, scale = site.scale * one.scale;
                UsdValue found = time ? sample_at(samples, (*time - offset) / scale) : only(samples);
                return found.kind == UsdValue::Kind::blocked ? UsdValue{} : found;
            }
            UsdValue value = one.layer->value(*spec, "default");
            if (value.kind == UsdValue::Kind::blocked) return {};
            look(prim, value.numbers.size() / 2 + value.texts.size());
            if (value.kind != UsdValue::Kind::none) return value;
        }
    }
    return {};
}

bool UsdStage::moves(const UsdPrim& prim, const std::string& name) const {
    for (const UsdSite& site : prim.sites)
        for (const UsdStack::Entry& one : site.stack->layers) {
            const UsdSpec* spec = one.layer->find(site.path + "." + name);
            if (!spec) continue;
            const UsdValue samples = one.layer->value(*spec, "timeSamples");
            if (samples.kind == UsdValue::Kind::samples) return samples.samples->size() > 1;
            if (one.layer->has(*spec, "default")) return false;
        }
    return false;
}

double UsdStage::number(const UsdPrim& prim, const std::string& name, double otherwise) const {
    const UsdValue found = value(prim, name);
    if (found.kind == UsdValue::Kind::none) return otherwise;
    if (found.kind != UsdValue::Kind::numbers || found.numbers.size() != 1) refuse(at(prim), name + ": must be a number");
    if (std::isnan(found.numbers[0])) refuse(at(prim), name + ": is no number");
    return found.numbers[0];
}

bool UsdStage::flag(const UsdPrim& prim, const std::string& name, bool otherwise) const {
    return number(prim, name, otherwise ? 1 : 0) != 0;
}

std::string UsdStage::text(const UsdPrim& prim, const std::string& name, const std::string& otherwise) const {
    const UsdValue found = value(prim, name);
    if (found.kind == UsdValue::Kind::none) return otherwise;
    if (found.kind != UsdValue::Kind::texts || found.texts.size() != 1) refuse(at(prim), name + ": must be a word");
    return found.texts[0];
}

std::optional<dvec3> UsdStage::vector(const UsdPrim& prim, const std::string& name) const {
    const UsdValue found = value(prim, name);
    if (found.kind == UsdValue::Kind::none) return std::nullopt;
    if (found.kind != UsdValue::Kind::numbers || found.numbers.size() != 3) refuse(at(prim), name + ": must be three numbers");
    return dvec3(found.numbers[0], found.numbers[1], found.numbers[2]);
}

std::optional<dquat> UsdStage::turn(const UsdPrim& prim, const std::string& name) const {
    const UsdValue found = value(prim, name);
    if (found.kind == UsdValue::Kind::none) return std::nullopt;
    if (found.kind != UsdValue::Kind::numbers || found.numbers.size() != 4 || !finite(found.numbers))
        refuse(at(prim), name + ": must be a quaternion, four numbers");
    const dquat q(found.numbers[0], found.numbers[1], found.numbers[2], found.numbers[3]);
    if (!(glm::length(q) > 1e-9)) return std::nullopt;
    return glm::normalize(q);
}

// One of xformOpOrder, "xformOp:translate:pivot" for instance.
glm::dmat4 UsdStage::operation(const UsdPrim& prim, const std::string& name) const {
    const std::string kind = name.substr(8, name.find(':', 8) - 8);
    const UsdValue found = value(prim, name);
    glm::dmat4 matrix(1);
    if (found.kind == UsdValue::Kind::none) return matrix;
    const auto& n = found.numbers;
    const auto need = [&](std::size_t count) {
        if (found.kind != UsdValue::Kind::numbers || n.size() != count || !finite(n))
            refuse(at(prim), name + ": must be " + std::to_string(count) + " numbers within 1e30");
    };
    const auto turn = [&](const dmat3& by) { matrix = glm::dmat4(by); };
    static const std::string axes = "XYZ";
    if (kind == "translate") {
        need(3);
        matrix[3] = glm::dvec4(n[0], n[1], n[2], 1);
    } else if (kind == "scale") {
        need(3);
        for (int k = 0; k < 3; ++k) matrix[k][k] = n[static_cast<std::size_t>(k)];
    } else if (kind == "orient") {
        need(4);
        const dquat q(n[0], n[1], n[2], n[3]);
        if (!(glm::length(q) > 1e-9)) refuse(at(prim), name + ": is a quaternion of length 0");
        turn(glm::mat3_cast(glm::normalize(q)));
    } else if (kind == "transform") {
        need(16);
        for (int k = 0; k < 16; ++k) matrix[k / 4][k % 4] = n[static_cast<std::size_t>(k)];
        if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1)
            refuse(at(prim), name + ": is no affine map");
    } else if (kind.size() == 10 && kind.starts_with("translate") && axes.find(kind[9]) != axes.npos) {
        need(1);
        matrix[3][static_cast<int>(axes.find(kind[9]))] = n[0];
    } else if (kind.size() == 6 && kind.starts_with("scale") && axes.find(kind[5]) != axes.npos) {
        need(1);
        const auto k = static_cast<int>(axes.find(kind[5]));
        matrix[k][k] = n[0];
    } else if (kind.size() == 7 && kind.starts_with("rotate") && axes.find(kind[6]) != axes.npos) {
        need(1);
        turn(turned_about(static_cast<int>(axes.find(kind[6])), n[0]));
    } else if (kind.size() == 9 && kind.starts_with("rotate") && kind.find_first_not_of(axes, 6) == kind.npos) {
        need(3);
        dmat3 all(1);
        for (std::size_t k = 6; k < 9; ++k) all = turned_about(static_cast<int>(axes.find(kind[k])), n[axes.find(kind[k])]) * all;
        turn(all);
    } else {
        refuse(at(prim), "xformOpOrder: \"" + name.substr(0, 60) + "\" is of no kind that is known");
    }
    return matrix;
}

glm::dmat4 UsdStage::local(const UsdPrim& prim, bool& resets) const {
    glm::dmat4 matrix(1);
    const UsdValue order = value(prim, "xformOpOrder");
    if (order.kind != UsdValue::Kind::texts) return matrix;
    if (order.texts.size() > 1000) refuse(at(prim), "xformOpOrder: has more than 1000 operations");
    for (const std::string& said : order.texts) {
        if (said == "!resetXformStack!") {
            matrix = glm::dmat4(1);
            resets = true;
            continue;
        }
        const bool inverted = said.starts_with("!invert!");
        const std::string name = inverted ? said.substr(8) : said;
        if (!name.starts_with("xformOp:")) refuse(at(prim), "xformOpOrder: \"" + said.substr(0, 60) + "\" is no xformOp");
        const glm::dmat4 one = operation(prim, name);
        if (inverted && !(std::abs(glm::determinant(one)) > 1e-30)) refuse(at(prim), name + ": has no inverse");
        matrix *= inverted ? glm::inverse(one) : one;
    }
    return matrix;
}

glm::dmat4 UsdStage::world(const UsdPrim& prim) const {
    glm::dmat4 matrix(1);
    for (const UsdPrim* one = &prim; one && one->parent; one = one->parent) {
        bool resets = false;
        matrix = local(*one, resets) * matrix;
        if (resets) break;
    }
    return matrix;
}

}  // namespace scree::imports
