// Frames of recordings: a second decoder, written from the page that documents the format, gets every pose within what is told.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "demos/film/pages/frame_encoder.h"

using namespace scree::demos;
using glm::vec3;
using glm::vec4;

namespace {

class Reading {
public:
    explicit Reading(std::string_view of) : bytes_(of) {}
    std::uint32_t u8() { return static_cast<unsigned char>(bytes_.at(at_++)); }
    std::uint64_t count() {
        std::uint64_t value = 0;
        for (int shift = 0;; shift += 7) {
            const std::uint64_t byte = u8();
            value |= (byte & 127u) << shift;
            if (byte < 128) return value;
        }
    }
    std::int32_t integer() {
        const auto bits = static_cast<std::uint32_t>(count());
        return static_cast<std::int32_t>(bits >> 1) ^ -static_cast<std::int32_t>(bits & 1u);
    }
    Reading part() {
        const std::size_t size = count();
        at_ += size;
        return Reading(bytes_.substr(at_ - size, size));
    }
    bool bit(std::size_t i) const { return (static_cast<unsigned char>(bytes_.at(i / 8)) >> (i % 8) & 1) != 0; }
    bool ended() const { return at_ == bytes_.size(); }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

struct Decoded {
    bool exists = false, asleep = false, falls = false;
    std::array<std::int32_t, 3> v{}, p{}, d{};
    std::array<double, 4> q{0, 0, 0, 1};
    std::int32_t force = 0;
};

class Decoder {
public:
    explicit Decoder(const FrameUnits& units) : units_(units) {}
    std::vector<Decoded> bodies;

    void decode(const std::string& bytes, bool whole) {
        Reading from(bytes);
        const std::size_t count = from.count();
        bodies.resize(count);
        if (whole)
            for (Decoded& body : bodies) body.exists = body.asleep = false, body.force = 0;
        std::vector<std::size_t> fresh;
        for (std::size_t left = from.count(), at = 0; left > 0; --left) {
            at += from.count();
            bodies.at(at).exists = !bodies.at(at).exists;
            if (bodies.at(at).exists) fresh.push_back(at);
        }
        for (std::size_t left = from.count(), at = 0; left > 0; --left) {
            at += from.count();
            bodies.at(at).asleep = !bodies.at(at).asleep;
        }
        read_whole(from, fresh);
        read_changes(from, fresh);
        const Reading changed = from.part();
        Reading levels = from.part();
        for (std::size_t i = 0; i < count; ++i)
            if (changed.bit(i)) bodies[i].force += levels.integer();
        REQUIRE(levels.ended());
        REQUIRE(from.ended());
    }

private:
    void read_whole(Reading& from, const std::vector<std::size_t>& fresh) {
        std::vector<Reading> columns;
        for (int i = 0; i < 13; ++i) columns.push_back(from.part());
        std::array<std::int32_t, 3> at{};
        for (const std::size_t i : fresh) {
            Decoded& body = bodies[i];
            for (std::size_t k = 0; k < 3; ++k) body.v[k] = columns[k].integer();
            for (std::size_t k = 0; k < 3; ++k) body.p[k] = FrameUnits::parts * (at[k] += columns[3 + k].integer());
            for (std::size_t k = 0; k < 3; ++k) body.d[k] = columns[6 + k].integer();
            const std::int32_t code = columns[9].integer();
            body.falls = (code & 1) != 0;
            std::array<double, 3> given{};
            for (std::size_t k = 0; k < 3; ++k) given[k] = columns[10 + k].integer() * FrameUnits::orientation;
            const double rest = std::sqrt(std::max(0.0, 1 - ((given[0] * given[0] + given[1] * given[1]) + given[2] * given[2])));
            std::size_t next = 0;
            for (std::size_t k = 0; k < 4; ++k) body.q[k] = static_cast<std::int32_t>(k) == code >> 1 ? rest : given[next++];
        }
    }
    void read_changes(Reading& from, const std::vector<std::size_t>& fresh) {
        const Reading changed = from.part();
        std::vector<Reading> columns;
        for (int i = 0; i < 9; ++i) columns.push_back(from.part());
        std::size_t bit = 0;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            Decoded& body = bodies[i];
            if (!body.exists || std::binary_search(fresh.begin(), fresh.end(), i)) continue;
            const bool differs = changed.bit(bit++);
            bool falls = units_.fall != std::array<std::int32_t, 3>{};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::int32_t before = body.v[k];
                body.v[k] += (body.falls ? units_.fall[k] : 0) + (differs ? columns[k].integer() : 0);
                body.p[k] += before + body.v[k] + (differs ? FrameUnits::parts * columns[3 + k].integer() : 0);
                body.d[k] += differs ? columns[6 + k].integer() : 0;
                falls = falls && std::abs(body.v[k] - before - units_.fall[k]) <= 2;
            }
            body.falls = falls;
            if (body.d == std::array<std::int32_t, 3>{}) continue;
            const auto [x, y, z, w] = body.q;
            const double a = body.d[0] * units_.turn, b = body.d[1] * units_.turn, c = body.d[2] * units_.turn;
            const std::array<double, 4> r{((w * a + x) + y * c) - z * b, ((w * b + y) + z * a) - x * c,
                                          ((w * c + z) + x * b) - y * a, ((w - x * a) - y * b) - z * c};
            const double size = std::sqrt(((r[0] * r[0] + r[1] * r[1]) + r[2] * r[2]) + r[3] * r[3]);
            for (std::size_t k = 0; k < 4; ++k) body.q[k] = r[k] / size;
        }
    }
    FrameUnits units_;
};

// How far a decoded body is from the true one, as parts of what is told.
struct Errors {
    double position = 0, velocity = 0, angle = 0, force = 0;
    void take(const FrameUnits& units, const BodyMoment& body, const Decoded& got, bool has_force) {
        double dot = 0;
        for (int k = 0; k < 3; ++k) {
            const auto i = static_cast<std::size_t>(k);
            position = std::max(position, std::abs(double{body.position[k]} - got.p[i] * units.part()) / units.position_error());
            velocity =
                std::max(velocity, std::abs(double{body.velocity[k]} - got.v[i] * units.velocity) / units.velocity_error());
        }
        for (int k = 0; k < 4; ++k) dot += double{body.orientation[k]} * got.q[static_cast<std::size_t>(k)];
        double away = 0;  // the chord of half the angle
        for (int k = 0; k < 4; ++k)
            away += std::pow(double{body.orientation[k]} * (dot < 0 ? -1 : 1) - got.q[static_cast<std::size_t>(k)], 2);
        angle = std::max(angle, 4 * std::asin(std::min(1.0, std::sqrt(away) / 2)) / units.angle_error());
        if (!has_force) return;
        if (double{body.force} >= units.force) {
            const double told = units.force * std::exp2((got.force - 1) / FrameUnits::levels_per_octave);
            force = std::max(force, std::abs(std::log2(told / double{body.force})) / std::log2(1 + FrameUnits::force_error()));
        } else {
            CHECK(got.force == 0);
        }
    }
};

vec4 turned(vec4 q, vec3 by) {  // by an angle along an axis
    const float angle = glm::length(by), s = angle > 0 ? std::sin(angle / 2) / angle : 0.5f;
    const vec4 r(by * s, std::cos(angle / 2));
    const vec3 a(q), b(r);
    return glm::normalize(vec4(q.w * b + r.w * a + glm::cross(b, a), q.w * r.w - glm::dot(a, b)));
}

// Bodies that fall, bounce, spin, rest, are put elsewhere, come and go.
struct Motions {
    explicit Motions(std::size_t count, std::uint32_t seed) : bodies(count), spins(count), random(seed) {
        for (std::size_t i = 0; i < count; ++i) {
            bodies[i].exists = i % 5 != 0;
            bodies[i].position = {number(-20, 20), number(0, 20), number(-20, 20)};
            bodies[i].orientation = turned({0, 0, 0, 1}, {number(-3, 3), number(-3, 3), number(-3, 3)});
            spins[i] = vec3(number(-9, 9), number(-9, 9), number(-9, 9)) * (i % 3 == 0 ? 10.0f : 1.0f);
        }
    }
    float number(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); }
    void step(float seconds) {
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            BodyMoment& body = bodies[i];
            if (number(0, 1) < 0.01f) body.exists = !body.exists;
            if (number(0, 1) < 0.01f) body.asleep = !body.asleep;
            if (number(0, 1) < 0.004f) body.position = {number(-500, 500), number(0, 20), number(-500, 500)};
            if (number(0, 1) < 0.004f) body.orientation = turned(body.orientation, {number(-3, 3), 0, 0});
            body.force = number(0, 1) < 0.3f ? 0 : std::exp(number(-12, 12));
            if (i % 7 == 1) continue;  // at rest
            const vec3 before = body.velocity;
            body.velocity.y -= 9.81f * seconds;
            body.position += 0.5f * (before + body.velocity) * seconds;
            if (body.position.y < 0.5f) {
                body.position.y = 0.5f;
                body.velocity = vec3(number(-3, 3), -0.6f * body.velocity.y, number(-3, 3));
                spins[i] = vec3(number(-9, 9), number(-9, 9), number(-9, 9));
            }
            body.orientation = turned(body.orientation, spins[i] * seconds);
        }
    }
    std::vector<BodyMoment> bodies;
    std::vector<vec3> spins;
    std::mt19937 random;
};

void check_same(const std::vector<Decoded>& a, const std::vector<Decoded>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        REQUIRE(a[i].exists == b[i].exists);
        REQUIRE(a[i].asleep == b[i].asleep);
        if (!a[i].exists) continue;
        REQUIRE(a[i].p == b[i].p);
        REQUIRE(a[i].q == b[i].q);
        REQUIRE(a[i].force == b[i].force);
    }
}

}  // namespace

TEST_CASE("recordings: every pose is within what is told, from the start and from any whole frame") {
    const float seconds = 1.0f / 30;
    const bool crowd = GENERATE(false, true);
    const FrameUnits units = FrameUnits::of(0.4, 30, double{seconds}, {0, -9.81, 0}, 1e-3, crowd);
    REQUIRE(units.position > 0.4 / 1024);
    REQUIRE(units.fall[1] < -10);
    FrameEncoder encoder(units);
    Decoder from_start(units);
    std::optional<Decoder> from_whole;
    Motions motions(300, 7);
    Errors errors;
    for (int frame = 0; frame < 200; ++frame) {
        if (frame == 90) motions.bodies.resize(320, motions.bodies[3]), motions.spins.resize(320, vec3(1));
        const bool whole = frame % 45 == 0;
        const auto turn = static_cast<std::size_t>(frame + 1) % FrameUnits::forces_apart;
        ChunkBytes bytes;
        encoder.set_short(crowd && frame % 7 > 2);
        encoder.encode(bytes, motions.bodies, whole);
        from_start.decode(bytes.bytes, whole);
        if (whole) from_whole.emplace(units);
        from_whole->decode(bytes.bytes, whole);
        check_same(from_start.bodies, from_whole->bodies);
        for (std::size_t i = 0; i < motions.bodies.size(); ++i) {
            REQUIRE(from_start.bodies[i].exists == motions.bodies[i].exists);
            if (!motions.bodies[i].exists) continue;
            REQUIRE(from_start.bodies[i].asleep == motions.bodies[i].asleep);
            // Short frames tell the forces of each eighth body, in turn.
            const bool has_force = whole || !encoder.is_short() || i % FrameUnits::forces_apart == turn;
            errors.take(units, motions.bodies[i], from_start.bodies[i], has_force);
        }
        motions.step(seconds);
    }
    // Floats of the true values have errors of their own.
    CHECK(errors.position < 1.001);
    CHECK(errors.velocity < 1.001);
    CHECK(errors.angle < 1.001);
    CHECK(errors.force < 1.001);
    CHECK(errors.position > 0.9);
    CHECK(errors.angle > 0.5);
}

TEST_CASE("recordings: bodies that rest or fly freely take next to nothing") {
    const float seconds = 1.0f / 30;
    const FrameUnits units = FrameUnits::of(0.4, 30, double{seconds}, {0, -9.81, 0}, 1e-3);
    FrameEncoder encoder(units);
    std::vector<BodyMoment> bodies(1000);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies[i].exists = true;
        bodies[i].position = vec3(0.1f * static_cast<float>(i), 30, 0.013f * static_cast<float>(i));
        bodies[i].velocity = i % 2 == 0 ? vec3(0) : vec3(1, 0, 0.37f);
    }
    std::size_t size = 0;
    for (int frame = 0; frame < 31; ++frame) {
        ChunkBytes bytes;
        encoder.encode(bytes, bodies, frame == 0);
        if (frame > 1) size += bytes.bytes.size();
        for (std::size_t i = 1; i < bodies.size(); i += 2) {
            bodies[i].position += bodies[i].velocity * seconds - vec3(0, 0.5f * 9.81f * seconds * seconds, 0);
            bodies[i].velocity.y -= 9.81f * seconds;
        }
    }
    CHECK(size / 29 < 800);  // a frame: 250 bytes of bits, and few of the 500 that fly
}

TEST_CASE("recordings: short frames of a crowd have the poses of others, in fewer bytes") {
    const double seconds = 1.0 / 30;
    const auto units_of = [&](bool crowd) { return FrameUnits::of(0.4, 30, seconds, {0, -9.81, 0}, 1e-3, crowd); };
    const FrameUnits plain = units_of(false), units = units_of(true);
    CHECK(units.position_error() == Approx(plain.position_error()).epsilon(0.05));
    CHECK(units.angle_error() == Approx(plain.angle_error()));
    CHECK(units.velocity_error() < 0.2);
    FrameEncoder exact(plain), coarse(units);
    coarse.set_short(true);
    // All collide all the time.
    std::mt19937 random(5);
    std::normal_distribution<float> push(0, 0.3f);
    std::vector<BodyMoment> bodies(500);
    for (BodyMoment& body : bodies) body.exists = true;
    std::map<std::int32_t, int> exact_numbers, coarse_numbers;
    const auto count_numbers = [&](const FrameEncoder& encoder, const std::vector<Follower>& before,
                                   std::map<std::int32_t, int>& to) {
        for (std::size_t i = 0; i < bodies.size(); ++i) ++to[encoder.followers()[i].velocity[0] - before[i].velocity[0]];
    };
    for (int frame = 0; frame < 40; ++frame) {
        const std::vector<Follower> a = exact.followers(), b = coarse.followers();
        ChunkBytes bytes, fewer;
        exact.encode(bytes, bodies, frame == 0);
        coarse.encode(fewer, bodies, frame == 0);
        if (frame > 0) count_numbers(exact, a, exact_numbers), count_numbers(coarse, b, coarse_numbers);
        for (std::size_t i = 0; i < bodies.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                REQUIRE(std::abs(coarse.followers()[i].position[k] * units.part() -
                                 double{bodies[i].position[static_cast<glm::length_t>(k)]}) < 1.001 * units.position_error());
        for (BodyMoment& body : bodies) {
            const vec3 before = body.velocity;
            body.velocity = 0.7f * before + vec3(push(random), push(random), push(random));
            body.position += 0.5f * (before + body.velocity) * static_cast<float>(seconds);
        }
    }
    CHECK(3 * coarse_numbers.size() < exact_numbers.size());
}

TEST_CASE("recordings: numbers that are none, or beyond all bounds, do no harm") {
    const bool crowd = GENERATE(false, true);
    const FrameUnits units = FrameUnits::of(1e-3, 1e6, 0.01, {0, -9.81, 0}, 0, crowd);
    FrameEncoder encoder(units);
    encoder.set_short(crowd);
    Decoder decoder(units);
    std::vector<BodyMoment> bodies(3);
    for (BodyMoment& body : bodies) body.exists = true;
    for (int frame = 0; frame < 4; ++frame) {
        if (frame == 2) {
            bodies[0].position = vec3(std::nanf(""), 1e30f, -1e30f);
            bodies[1].velocity = vec3(1e30f);
            bodies[1].force = std::numeric_limits<float>::infinity();
            bodies[2].orientation = vec4(std::nanf(""));
        }
        ChunkBytes bytes;
        encoder.encode(bytes, bodies, false);
        decoder.decode(bytes.bytes, false);
    }
    CHECK(decoder.bodies[0].p[1] > FrameUnits::most / 2);
    CHECK(decoder.bodies.size() == 3);
}
