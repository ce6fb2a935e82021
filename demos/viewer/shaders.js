// Shaders: shapes, ground, sky and lines for WebGL 2, with the light and the ground of the program's pictures.
import ground from '../../shaders/render/ground.h';
import shading from '../../shaders/render/shading.h';

const HEAD = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2DShadow;
uniform mat4 view_projection;    // from the eye
uniform vec4 forward;            // w: 1 if orthographic
uniform vec4 ray_corner, ray_right, ray_down;  // of the lower left pixel at 1 m; steps to the right and up
uniform vec3 eye;
uniform vec2 pixel;              // width of a pixel at 1 m (orthographic: everywhere), m; near plane, m
uniform vec2 screen;             // pixels
bool orthographic() { return forward.w > 0.5; }
vec3 sight_to(vec3 point) { return orthographic() ? forward.xyz : normalize(point); }
float pixel_at(vec3 point) { return orthographic() ? pixel.x : length(point) * pixel.x; }
vec3 turned(vec4 q, vec3 v) { vec3 u = cross(q.xyz, v) * 2.0; return v + q.w * u + cross(q.xyz, u); }
vec3 turned_back(vec4 q, vec3 v) { return turned(vec4(-q.xyz, q.w), v); }
`;

const LIGHT = `
struct Light { mat4 sun_map, sky_map; vec4 toward_sky, toward_sun, zenith, horizon, sun_light, bounce, ambient, eye, maps, pixel; };
uniform Light frame;  // of shaders/render/frame.h what light needs; sun_map and sky_map from the eye
uniform sampler2DShadow sun_depths;
uniform sampler2D sky_depths;
#define MAP_MARGIN -2.0
${shading}
float lit_at(vec2 at, float depth) { return texture(sun_depths, vec3(at, depth)); }
vec4 sky_depths_at(vec2 at) {
    ivec2 low = ivec2(floor(at / frame.maps.w - 0.5)), most = textureSize(sky_depths, 0) - 1;
    ivec2 a = clamp(low, ivec2(0), most), b = clamp(low + 1, ivec2(0), most);
    return vec4(texelFetch(sky_depths, ivec2(a.x, b.y), 0).r, texelFetch(sky_depths, b, 0).r,
                texelFetch(sky_depths, ivec2(b.x, a.y), 0).r, texelFetch(sky_depths, a, 0).r);
}
vec4 finished(vec3 color) {
    vec3 c = clamp(tone_mapped(color), 0.0, 1.0);
    return vec4(mix(12.92 * c, 1.055 * pow(max(c, vec3(1e-5)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)), 1.0);
}
`;

// Instances hold several bodies, for starting one costs software more than drawing a small body. What bodies are is in a texture.
const BODY_IN = `
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 corner_normal;
layout(location = 2) in vec3 corner_edge;  // z: which body of the instance
uniform highp usampler2D bodies;           // three texels each, 1024 a row
uniform ivec3 batch;                       // the first body of the draw, their number, bodies of an instance
uniform float inflated;                    // pixels
uniform vec3 light_view;                   // of maps: direction of the light; 0: seen from the eye
vec3 place, size;                          // from the eye, m
vec4 tint, turn_in;                        // square roots of linear red, green, blue; place on the scale
uint body;
bool fetch_body() {
    int which = gl_InstanceID * batch.z + int(corner_edge.z);
    if (which >= batch.y) return false;
    which += batch.x;
    ivec2 at = ivec2(3 * (which & 1023), which >> 10);
    uvec4 a = texelFetch(bodies, at, 0), b = texelFetch(bodies, at + ivec2(1, 0), 0), c = texelFetch(bodies, at + ivec2(2, 0), 0);
    place = uintBitsToFloat(a.xyz);
    tint = vec4((uvec4(a.w) >> uvec4(0, 8, 16, 24)) & 255u) / 255.0;
    turn_in = vec4(unpackSnorm2x16(b.x), unpackSnorm2x16(b.y));
    size = uintBitsToFloat(uvec3(b.zw, c.x));
    body = c.y;
    return true;
}
`;

// Per kind of shape: the corner and its normal in the body's frame.
const SHAPES = {
  ball: `void shape(vec4 q, out vec3 own, out vec3 normal) {
    own = corner * size;
    normal = normalize(corner / size);
  }`,
  capsule: `void shape(vec4 q, out vec3 own, out vec3 normal) {
    own = corner * size.x + vec3(0.0, size.y * corner_edge.x, 0.0);
    normal = corner;
  }`,
  box: `void shape(vec4 q, out vec3 own, out vec3 normal) {
    vec3 toward = light_view != vec3(0.0) ? turned_back(q, light_view)
                  : orthographic() ? turned_back(q, -forward.xyz) : turned_back(q, -place);
    vec3 near = vec3(toward.x < 0.0 ? -1.0 : 1.0, toward.y < 0.0 ? -1.0 : 1.0, toward.z < 0.0 ? -1.0 : 1.0);
    int bits = int(corner.x) + 1;
    own = size * near * vec3((bits & 1) != 0 ? 1.0 : -1.0, (bits & 2) != 0 ? 1.0 : -1.0, (bits & 4) != 0 ? 1.0 : -1.0);
    normal = normalize(own);
  }`,
  solid: `void shape(vec4 q, out vec3 own, out vec3 normal) {
    own = corner * size;
    normal = normalize(corner_normal / size);
  }`,
  mesh: `void shape(vec4 q, out vec3 own, out vec3 normal) {
    own = corner;
    normal = corner_normal;
  }`,
};

const BODY_VERTEX = (shape, wants = '') => wants ? LEAN_VERTEX(shape, wants) : `${HEAD}${BODY_IN}
out vec3 point, own, normal;
flat out vec3 extent;
flat out vec4 turn, color;
flat out uint id;
out vec2 edge;
${SHAPES[shape]}
void main() {
    own = normal = point = vec3(0.0);
    extent = vec3(1.0);
    turn = color = vec4(0.0);
    id = 0u;
    edge = vec2(0.0);
    gl_Position = vec4(0, 0, -2, 1);
    if (!fetch_body()) return;
    vec4 q = normalize(turn_in);
    shape(q, own, normal);
    point = place + turned(q, own);
    gl_Position = view_projection * vec4(point, 1.0);
    extent = size;
    turn = q;
    color = vec4(tint.rgb * tint.rgb, tint.a);
    id = body;
    edge = corner_edge.xy;
}`;

// For depths alone, for numbers of bodies, and for outlines.
const LEAN_VERTEX = (shape, wants) => `${HEAD}${BODY_IN}
${wants === 'id' ? 'flat out uint id;' : ''}
${SHAPES[shape]}
void main() {
    gl_Position = vec4(0, 0, -2, 1);
    ${wants === 'id' ? 'id = 0u;' : ''}
    if (!fetch_body()) return;
    vec4 q = normalize(turn_in);
    vec3 own, normal;
    shape(q, own, normal);
    vec3 point = place + turned(q, own);
    ${wants === 'outline' ? 'point += turned(q, normal) * (inflated * pixel_at(point));' : ''}
    gl_Position = view_projection * vec4(point, 1.0);
    ${wants === 'id' ? 'id = body;' : ''}
}`;

const BODY_OUT = `${HEAD}${LIGHT}
in vec3 point, own, normal;
flat in vec3 extent;
flat in vec4 turn, color;
flat in uint id;
in vec2 edge;
out vec4 out_color;
void done(float tone, vec3 n, float gloss) {
    vec3 shaded = lit(color.rgb * tone, point, n, sight_to(point), gloss) + color.rgb * (0.12 * color.a * color.a);
    out_color = finished(hazed(shaded, length(point)));
}
`;

const BODY_FRAGMENTS = {
  ball: `${BODY_OUT}
void main() {
    vec3 on = normalize(own / extent);
    float radius = min(extent.x, min(extent.y, extent.z));
    vec3 halves = clamp(on / (0.8 * pixel_at(point) / radius + 0.01), -1.0, 1.0);
    done(0.87 + 0.13 * halves.x * halves.y * halves.z, turned(turn, normalize(on / extent)), 0.9);
}`,
  capsule: `${BODY_OUT}
void main() {
    vec3 on = normalize(own - vec3(0.0, clamp(own.y, -extent.y, extent.y), 0.0));
    vec3 halves = clamp(on / (0.8 * pixel_at(point) / extent.x + 0.01), -1.0, 1.0);
    done(0.87 + 0.13 * halves.x * halves.y * halves.z, turned(turn, on), 0.9);
}`,
  box: `${BODY_OUT}
void main() {
    float width = pixel_at(point), smallest = min(extent.x, min(extent.y, extent.z));
    float natural = min(0.14 * smallest, 0.06);
    float bevel = min(max(natural, 1.2 * width), 0.5 * smallest);
    float shown = clamp(natural / (1.8 * width), 0.0, 1.0);
    shown *= shown;
    vec3 over = max(abs(own) - (extent - bevel), 0.0) * sign(own);
    vec3 out_by = abs(own) - extent;
    vec3 which = out_by.x > out_by.y ? (out_by.x > out_by.z ? vec3(1, 0, 0) : vec3(0, 0, 1)) : (out_by.y > out_by.z ? vec3(0, 1, 0) : vec3(0, 0, 1));
    vec3 face = which * sign(own);
    vec3 rounded = over - face * dot(over, face) + face * bevel;
    vec3 n = turned(turn, normalize(mix(face, normalize(rounded), shown)));
    float lift = shown * clamp(length(over - face * dot(over, face)) / bevel, 0.0, 1.0);
    float tone = dot(which, vec3(0.95, 1.0, 0.90)) * (1.0 + 0.22 * lift * lift);
    vec3 inside = extent - abs(own) + which * 1e9;
    float border = min(inside.x, min(inside.y, inside.z));
    tone *= 1.0 - seam_at(border, width, 2.0 * smallest) * (1.0 - 0.5 * shown);
    done(tone, n, 0.6);
}`,
  solid: `${BODY_OUT}
void main() {
    vec2 halves = clamp(own.xz / (0.02 * extent.x), -1.0, 1.0);
    done(0.9 + 0.1 * halves.x * halves.y, turned(turn, normalize(normal)), 0.7);
}`,
  mesh: `${BODY_OUT}
void main() {
    vec3 local = normalize(normal);
    float tone = 0.9 + 0.05 * local.x;
    if (edge.y > 0.0) {
        float width = pixel_at(point), bevel = max(edge.y, 1.2 * width), shown = clamp(edge.y / (1.8 * width), 0.0, 1.0);
        float lift = clamp(1.0 - edge.x / bevel, 0.0, 1.0);
        tone *= 1.0 + 0.22 * shown * shown * lift * lift;
        tone *= 1.0 - seam_at(edge.x, width, 14.0 * edge.y) * (1.0 - 0.5 * shown);
    }
    done(tone, turned(turn, local), 0.7);
}`,
};

const NOTHING = `#version 300 es
void main() {}`;
const ID = `#version 300 es
precision highp float;
precision highp int;
flat in uint id;
out vec4 out_color;
void main() { out_color = vec4(uvec4(id, id >> 8, id >> 16, id >> 24) & 255u) / 255.0; }`;
const OUTLINE = `#version 300 es
precision highp float;
uniform vec4 paint;
out vec4 out_color;
void main() { out_color = paint; }`;

const PLANE_VERTEX = `${HEAD}
uniform vec4 plane;  // unit normal; height of the eye above it, m
uniform vec3 axis_u, axis_v;
void main() {
    int corner = gl_VertexID % 3, quarter = gl_VertexID / 3 + (corner == 2 ? 1 : 0);
    float x = quarter == 0 || quarter == 3 || quarter == 4 ? 1.0 : -1.0, y = quarter % 4 < 2 ? 1.0 : -1.0;
    vec3 along = axis_u * x + axis_v * y;
    vec4 at = orthographic() ? vec4(along * 1e4 - plane.xyz * plane.w, 1.0) : vec4(along, 0.0);
    if (corner == 0) at = vec4(-plane.xyz * plane.w, 1.0);
    gl_Position = view_projection * at;
    gl_Position.z *= 0.999999;  // points at infinity are just before it
}`;
const PLANE_FRAGMENT = `${HEAD}${LIGHT}
uniform vec4 plane;
uniform vec3 axis_u, axis_v;
uniform vec2 origin;  // the eye's coordinates on the axes
out vec4 out_color;
${ground}
void main() {
    vec3 offset = ray_corner.xyz + ray_right.xyz * gl_FragCoord.x + ray_down.xyz * gl_FragCoord.y;
    vec3 start = orthographic() ? offset : vec3(0.0), ray = orthographic() ? forward.xyz : offset;
    float sinking = max(-dot(plane.xyz, ray), 1e-6);
    float t = (plane.w + dot(plane.xyz, start)) / sinking;
    vec3 at3 = start + ray * t;
    vec2 local = vec2(dot(axis_u, at3), dot(axis_v, at3)), at = origin + local;
    float spread = orthographic() ? 1.0 : t;
    vec3 to_right = (ray_right.xyz + ray * (dot(plane.xyz, ray_right.xyz) / sinking)) * spread;
    vec3 to_up = (ray_down.xyz + ray * (dot(plane.xyz, ray_down.xyz) / sinking)) * spread;
    vec2 w = max(vec2(abs(dot(axis_u, to_right)) + abs(dot(axis_u, to_up)), abs(dot(axis_v, to_right)) + abs(dot(axis_v, to_up))), 1e-6);
    out_color = finished(hazed(lit(ground_color(at, w), at3, plane.xyz, normalize(ray), 0.0), length(at3)));
}`;

const SKY_VERTEX = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.9999999, 1.0); }`;
const SKY_FRAGMENT = `${HEAD}${LIGHT}
out vec4 out_color;
void main() {
    vec3 offset = ray_corner.xyz + ray_right.xyz * gl_FragCoord.x + ray_down.xyz * gl_FragCoord.y;
    out_color = finished(sky_color(normalize(orthographic() ? forward.xyz : offset)));
}`;

// Lines with round ends, and discs where both ends are one: contacts, joints, velocities, hits. Before their own bodies by `lift`.
const LINE_VERTEX = `${HEAD}
layout(location = 0) in vec4 from;   // from the eye, m; half width, pixels
layout(location = 1) in vec4 to;     // w: lift, m
layout(location = 2) in vec4 paint;  // linear
out vec2 at;
flat out vec3 shape;
flat out vec4 color;
void main() {
    vec4 a = view_projection * vec4(from.xyz, 1.0), b = view_projection * vec4(to.xyz, 1.0);
    gl_Position = vec4(0, 0, -2, 1);
    color = paint;
    shape = vec3(0.0);
    at = vec2(0.0);
    if (!orthographic()) {
        float near = pixel.y;
        if (a.w < near && b.w < near) return;
        if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
        if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
    }
    vec2 pa = (a.xy / a.w * 0.5 + 0.5) * screen, pb = (b.xy / b.w * 0.5 + 0.5) * screen;
    float size = length(pb - pa), half_width = from.w, rim = clamp(0.6 * half_width, 0.6, 1.5);
    vec2 along = size > 1e-3 ? (pb - pa) / size : vec2(1, 0);
    float margin = half_width + rim + 1.0;
    vec2 side = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1) * 2.0 - 1.0);
    at = vec2(side.x < 0.5 ? -margin : size + margin, side.y * margin);
    shape = vec3(size, half_width, rim);
    vec2 where = pa + along * at.x + vec2(-along.y, along.x) * at.y;
    vec4 end = side.x < 0.5 ? a : b;
    // Depth of the end, nearer to the eye by the lift.
    float w = max(end.w - to.w, 0.5 * end.w);
    float depth = orthographic() ? end.z : 1.0 - 2.0 * pixel.y / w;
    gl_Position = vec4(where / screen * 2.0 - 1.0, clamp(depth, -1.0, 1.0), 1.0);
}`;
const LINE_FRAGMENT = `#version 300 es
precision highp float;
in vec2 at;
flat in vec3 shape;
flat in vec4 color;
uniform float strength;
out vec4 out_color;
void main() {
    float away = length(vec2(at.x - clamp(at.x, 0.0, shape.x), at.y)) - shape.y;
    float cover = clamp(shape.z + 0.5 - away, 0.0, 1.0), inner = clamp(0.5 - away, 0.0, 1.0);
    if (cover <= 0.0) discard;
    vec3 c = mix(vec3(0.01), color.rgb, inner);
    out_color = vec4(pow(c, vec3(1.0 / 2.2)), strength * color.a * cover * mix(0.75, 1.0, inner));
}`;

export const KINDS = Object.keys(SHAPES);
export function sources() {
  const all = {
    plane: [PLANE_VERTEX, PLANE_FRAGMENT], sky: [SKY_VERTEX, SKY_FRAGMENT], line: [LINE_VERTEX, LINE_FRAGMENT],
  };
  for (const kind of KINDS) {
    all[`${kind} color`] = [BODY_VERTEX(kind), BODY_FRAGMENTS[kind]];
    all[`${kind} depth`] = [BODY_VERTEX(kind, 'depth'), NOTHING];
    all[`${kind} id`] = [BODY_VERTEX(kind, 'id'), ID];
    all[`${kind} outline`] = [BODY_VERTEX(kind, 'outline'), OUTLINE];
  }
  return all;
}
