// Body colours from the selected quantity, computed once per body instead of per vertex.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/physics/sleep/sleep.h"
#include "shaders/render/bodies/coloring.h"

layout(local_size_x = 128) in;  // DETAIL_GROUP

layout(std430, set = 0, binding = 13) readonly buffer RunTable {
    BodyRun runs[];
};
layout(std430, set = 0, binding = 20) writeonly buffer TintTable {
    vec4 tints[];  // rgb: linear colour; a: position on the colour scale, 0..1
};
const vec3 STONE = vec3(0.40, 0.385, 0.36);
const vec3 KINEMATIC = vec3(0.30, 0.34, 0.40);
const vec3 PLAIN = vec3(0.62, 0.33, 0.13);
const vec3 UNCOLORED = vec3(0.55, 0.53, 0.50);

layout(std430, set = 0, binding = 12) readonly buffer ImpulseTable {
    vec4 impulses[];  // ContactImpulse
};
layout(std430, set = 0, binding = 16) readonly buffer SlotEndTable {
    uint slot_ends[];  // end of each body's slots, which is the begin of the next body's
};
layout(std430, set = 0, binding = 17) readonly buffer SlotSideTable {
    uint slot_sides[];  // 2 * contact + side, or a joint record with OF_JOINT
};
layout(std430, set = 0, binding = 18) readonly buffer RestTable {
    uint sleep_states[];
};
layout(std430, set = 0, binding = 22) readonly buffer IdTable {
    uint ids[];
};
layout(std430, set = 0, binding = 23) readonly buffer ColorTable {
    vec4 colors[];  // by id; w 0: none
};

bool sleeps(uint body) {
    uint steps = uint(frame.rest.x);
    return steps > 0u && has_slept(sleep_states[body], steps);
}

// Sum of the normal impulses of the body's contacts in a substep, N s.
float contact_impulse(uint body) {
    float sum = 0.0;
    for (uint k = body == 0u ? 0u : slot_ends[body - 1u]; k < slot_ends[body]; ++k) {
        if ((slot_sides[k] & OF_JOINT) != 0u) continue;
        vec4 push = impulses[push_of(slot_sides[k] >> 1)];
        sum += push.x + push.y + push.z + push.w;
    }
    return sum;
}

float contacts_on(uint body) {
    uint count = 0u;
    for (uint k = body == 0u ? 0u : slot_ends[body - 1u]; k < slot_ends[body]; ++k)
        if ((slot_sides[k] & OF_JOINT) == 0u) ++count;
    return float(count);
}

float quantity(uint by, uint body) {
    if (by == COLOR_BY_CONTACT_IMPULSE) return contact_impulse(body);
    if (by == COLOR_BY_CONTACTS) return contacts_on(body);
    if (by == COLOR_BY_REST) return sleeps(body) ? 1e30 : float(quiet_steps(sleep_states[body])) * frame.rest.y;
    BodyProperties t = properties[body];
    Velocity v = velocities[body];
    if (by == COLOR_BY_MOMENTUM) return length(v.linear) / t.inverse_mass;
    if (by == COLOR_BY_SPEED) return length(v.linear);
    if (by == COLOR_BY_SPIN) return length(v.angular);
    if (by == COLOR_BY_HEIGHT) return poses[body].position.y;
    // Angular momentum and kinetic energy in the principal frame.
    vec3 spin = turned_back(poses[body].orientation, v.angular);
    vec3 turning = spin * spin / max(t.inverse_inertia, vec3(1e-30));
    if (by == COLOR_BY_ANGULAR_MOMENTUM) return length(spin / max(t.inverse_inertia, vec3(1e-30)));
    return 0.5 * (dot(v.linear, v.linear) / t.inverse_mass + turning.x + turning.y + turning.z);
}

// Distinct colours for ids: hues spaced by the golden ratio, of similar lightness.
vec3 name_color(uint id) {
    float hue = fract(float(id % 4096u) * 0.61803399);
    vec3 c = 0.5 + 0.5 * cos(6.2831853 * (hue + vec3(0.0, 0.33, 0.67)));
    return mix(vec3(0.10), vec3(0.75), c * c);
}

// Index of the nearest material in the frame's list, by friction, restitution and log density.
uint material_of(uint body) {
    BodyProperties t = properties[body];
    vec3 own = vec3(t.friction, t.restitution, log(1.0 / (t.inverse_mass * volume_of(t.shape, t.size))));
    uint best = 0u;
    float least = 1e30;
    for (uint k = 0u; k < uint(frame.marks.z); ++k) {
        vec4 m = frame.materials[k];
        vec3 apart = own - vec3(m.x, m.y, log(m.z));
        if (dot(apart, apart) < least) {
            least = dot(apart, apart);
            best = k;
        }
    }
    return best;
}

vec4 full_color(uint body) {
    uint motion = properties[body].motion & 3u;
    if (uint(frame.scale.w) == COLOR_BY_OWN) {
        vec4 own = colors[ids[body]];
        if (own.w > 0.5) return vec4(own.rgb, 0.0);
    }
    if (motion == MOTION_FIXED) return vec4(STONE, 0.0);
    if (motion == MOTION_KINEMATIC) return vec4(KINEMATIC, 0.0);
    uint by = uint(frame.scale.w);
    if (by == COLOR_BY_NOTHING) return vec4(PLAIN, 0.0);
    if (by == COLOR_BY_BODY) return vec4(name_color(ids[body]), 0.0);
    if (by == COLOR_BY_OWN) return vec4(UNCOLORED, 0.0);
    if (by == COLOR_BY_MATERIAL) return vec4(name_color(material_of(body)), 0.0);
    float q = quantity(by, body);
    float x = frame.scale.z > 1.5 ? sqrt(max(q, 0.0)) : frame.scale.z > 0.5 ? log(max(q, 1e-30)) : q;
    float t = clamp((x - frame.scale.x) / (frame.scale.y - frame.scale.x), 0.0, 1.0);
    return vec4(map_color(t), t);
}

// rgb: linear colour; a: position on the colour scale, 0..1. Bodies are paler with contact marks; sleeping bodies are
// dull and blue with the sleep option.
vec4 body_color(uint body) {
    vec4 color = full_color(body);
    if (frame.marks.w > 0.5 && properties[body].motion == MOTION_DYNAMIC && sleeps(body)) {
        float light = dot(color.rgb, vec3(0.2126, 0.7152, 0.0722));
        color = vec4(mix(color.rgb, vec3(0.10, 0.16, 0.30) * (0.6 + light), 0.75), 0.0);
    }
    float grey = dot(color.rgb, vec3(0.2126, 0.7152, 0.0722));
    return vec4(mix(color.rgb, vec3(0.08 + 0.5 * grey), 0.45 * frame.marks.x), color.a * (1.0 - frame.marks.x));
}

void main() {
    uint place = gl_GlobalInvocationID.x;
    if (place >= runs[RUN_PLANES].first) return;
    uint body = instances[place];
    // Parts of a compound take the colour of their body.
    bool part = (properties[body].motion & MOTION_OF_PART) != 0u;
    tints[body] = body_color(part ? properties[body].owner : body);
}
