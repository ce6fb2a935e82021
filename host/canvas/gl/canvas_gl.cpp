// The OpenGL ES canvas, which draws from tables in host memory.
#include "host/canvas/gl/canvas_gl.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "host/canvas/frame.h"
#include "host/canvas/gl/canvas_gl_impl.h"
#include "host/canvas/overlay.h"
#include "host/canvas/smoothing.h"

namespace scree::host {
namespace {

constexpr GLenum function_of(Compare compare) {
    switch (compare) {
        case Compare::less:
            return GL_LESS;
        case Compare::greater:
            return GL_GREATER;
        case Compare::greater_or_equal:
            return GL_GEQUAL;
        case Compare::always:
            break;
    }
    return GL_ALWAYS;
}

}  // namespace

void GlCanvas::Impl::fill(Binding binding, const void* data, std::size_t bytes) const {
    gl.glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[binding]);
    // Orphan the buffer to avoid waiting for the previous picture. At least 16 bytes, since shaders may be bound to
    // an empty table.
    gl.glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 16)), nullptr, GL_STREAM_DRAW);
    gl.glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
}

void GlCanvas::Impl::fill_tables(ColorBy by) const {
    GLint64 most = 0;
    gl.glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    for (std::uint32_t i = 0; i < BINDINGS; ++i) {
        const BindingInfo& info = binding_infos()[i];
        if (info.table == nullptr || !reads(i, options, by)) continue;
        const std::span<const std::byte> bytes = (tables.*info.table).bytes;
        if (static_cast<std::int64_t>(bytes.size()) > most) {
            throw DeviceError("canvas: a table of " + std::to_string(bytes.size()) + " bytes; " + context.renderer() +
                              " reads at most " + std::to_string(most));
        }
        fill(static_cast<Binding>(i), bytes.data(), bytes.size());
    }
}

// Computes body colours, frustum culling and level of detail.
void GlCanvas::Impl::look(PictureParts* parts) const {
    for (std::size_t i = 0; i < looks.size(); ++i) {
        if (scenery.bodies() > 0) {
            gl.glUseProgram(looks[i]);
            gl.glDispatchCompute(groups_of_look(i, scenery.bodies()), 1, 1);
            gl.glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
        }
        if (parts && std::string_view(LOOKS[i]) == "detail_count.comp") unite_light_bounds(*parts);
    }
}

// The light maps are about the bodies of all processes: the bounds of each workgroup's (detail_count.comp) become those of all.
void GlCanvas::Impl::unite_light_bounds(PictureParts& parts) const {
    std::vector<float> least(LIGHT_BOUNDS, 1e30f);
    const std::uint32_t groups = groups_of_look(0, scenery.bodies());
    float* words = nullptr;
    if (groups > 0) {
        gl.glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[GROUP_COUNTS]);
        words = static_cast<float*>(gl.glMapBufferRange(
            GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(std::size_t{groups} * GROUP_WORDS * sizeof(float)),
            GL_MAP_READ_BIT | GL_MAP_WRITE_BIT));
        if (words == nullptr) check("reading the bounds of shadows");
    }
    for (std::uint32_t group = 0; words != nullptr && group < groups; ++group)
        for (std::uint32_t k = 0; k < LIGHT_BOUNDS; ++k)
            least[k] = std::min(least[k], words[group * GROUP_WORDS + SEEN_RUNS + k]);
    parts.unite(least);
    if (words == nullptr) return;
    std::copy(least.begin(), least.end(), words + SEEN_RUNS);
    gl.glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
}

void GlCanvas::Impl::begin(const Target& on) const {
    gl.glBindFramebuffer(GL_FRAMEBUFFER, on.framebuffer);
    gl.glViewport(0, 0, on.width, on.height);
}

void GlCanvas::Impl::set_state(const DrawState& state) const {
    const auto set = [this](GLenum what, bool on) { on ? gl.glEnable(what) : gl.glDisable(what); };
    set(GL_CULL_FACE, state.cull != Cull::none);
    if (state.cull != Cull::none) gl.glCullFace(state.cull == Cull::back ? GL_BACK : GL_FRONT);
    set(GL_BLEND, state.blends);
    const GLboolean colors = state.fragment.empty() ? GL_FALSE : GL_TRUE;
    gl.glColorMask(colors, colors, colors, colors);
    gl.glDepthFunc(function_of(state.depth));
    gl.glDepthMask(state.writes_depth ? GL_TRUE : GL_FALSE);
}

void GlCanvas::Impl::draw_all(Pass pass, std::uint32_t quad_count) const {
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const Draw& draw = draws[i];
        Run items = scenery.items(draw.items, tables, quad_count);
        std::uint32_t corners = draw.corners;
        if (draw.items == Items::bodies) {
            const BodyRun& run = scenery.runs[draw.run];
            // The number of visible bodies is known on the device only; this is an upper bound.
            items = {0, draw.run < SEEN_RUNS ? scenery.bodies() : instances_of(run)};
            corners *= run.together;
        }
        if (draw.state.pass != pass || !draw.is_for(by) || items.count == 0) continue;
        const Program& program = programs[program_of[i]];
        set_state(draw.state);
        gl.glUseProgram(program.name);
        if (program.pushed >= 0) gl.glUniform1ui(program.pushed, draw.pushed);
        if (program.first_instance >= 0) gl.glUniform1i(program.first_instance, static_cast<GLint>(items.first));
        const GLenum kind = draw.state.strip ? GL_TRIANGLE_STRIP : GL_TRIANGLES;
        const auto instances = static_cast<GLsizei>(items.count);
        if (draw.mesh == Mesh::none) {
            gl.glDrawArraysInstanced(kind, 0, static_cast<GLsizei>(corners), instances);
        } else if (draw.run < SEEN_RUNS) {
            gl.glDrawElementsIndirect(kind, GL_UNSIGNED_INT, reinterpret_cast<const void*>(draw.run * sizeof(DrawArguments)));
        } else {
            const Run mesh = scenery.mesh(draw.mesh);
            gl.glDrawElementsInstanced(kind, static_cast<GLsizei>(mesh.count), GL_UNSIGNED_INT,
                                       reinterpret_cast<const void*>(std::size_t{mesh.first} * sizeof(std::uint32_t)), instances);
        }
    }
}

void GlCanvas::Impl::draw_shadows(std::size_t light) const {
    begin(shadow_maps[light]);
    gl.glDepthMask(GL_TRUE);
    gl.glClearDepthf(1);
    gl.glClear(GL_DEPTH_BUFFER_BIT);
    draw_all(light == 0 ? Pass::sun_map : Pass::sky_map, 0);
}

void GlCanvas::Impl::draw_bodies(std::uint32_t quad_count) const {
    begin(scene);
    gl.glDepthMask(GL_TRUE);
    gl.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);  // the maps of shadows ended it, for clearing, too
    gl.glClearDepthf(0);                                 // reversed depth: 0 is infinitely far
    gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_all(Pass::picture, quad_count);
}

void GlCanvas::Impl::draw_picture(std::uint32_t quad_count) const {
    draw_bodies(quad_count);
    if (smooths_on_device(options)) begin(target);
    draw_all(Pass::finish, quad_count);
    if (options.samples > 1) {
        gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
        gl.glBlitFramebuffer(0, 0, options.width, options.height, 0, 0, options.width, options.height, GL_COLOR_BUFFER_BIT,
                             GL_NEAREST);
        gl.glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    }
}

std::uint32_t GlCanvas::Impl::prepare(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 low,
                                      vec3 high) const {
    require_tables(tables, options, scale.by);
    by = scale.by;
    const Frame frame = make_frame(camera, scale, options, low, high);
    std::vector<OverlayQuad> quads = overlay_quads(options.width, options.height, options.legend, scale, caption);
    quads.resize(std::min<std::size_t>(quads.size(), MOST_QUADS));
    fill(FRAME, &frame, sizeof frame);
    fill(QUADS, quads.data(), quads.size() * sizeof(OverlayQuad));
    fill_tables(scale.by);
    return static_cast<std::uint32_t>(quads.size());
}

Image GlCanvas::Impl::read_picture() const {
    const bool direct = options.samples == 1 && !smooths_on_device(options);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, direct ? scene.framebuffer : target.framebuffer);
    Image image{options.width, options.height,
                std::vector<std::uint8_t>(std::size_t{4} * static_cast<std::size_t>(options.width) *
                                          static_cast<std::size_t>(options.height))};
    gl.glReadPixels(0, 0, options.width, options.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    check("reading a picture");
    return image;
}

bool GlCanvas::Impl::has_parts() const {
    const bool overlaid = options.marks || options.velocities || options.boxes || options.cells || options.joints;
    return options.samples == 1 && options.bits == 8 && options.background && !overlaid && !smooths_on_device(options) &&
           context.has("GL_NV_read_depth");
}

std::vector<float> GlCanvas::Impl::read_depths(const Target& of) const {
    std::vector<float> depths(static_cast<std::size_t>(of.width) * static_cast<std::size_t>(of.height));
    gl.glBindFramebuffer(GL_FRAMEBUFFER, of.framebuffer);
    gl.glReadPixels(0, 0, of.width, of.height, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    check("reading depths");
    return depths;
}

GlCanvas::GlCanvas(const ShapeInstances& instances, const CanvasOptions& options)
    : interior_(std::make_unique<Impl>(instances, options)) {}
GlCanvas::~GlCanvas() = default;

std::string GlCanvas::name() const {
    return interior_->context.version() + ", " + interior_->context.renderer();
}

void GlCanvas::set_tables(const BodyTables& tables) {
    require_tables(tables, interior_->options, ColorBy::momentum);
    for (const BindingInfo& info : binding_infos()) {
        if (info.table != nullptr && (tables.*info.table).buffer != nullptr)
            throw std::invalid_argument("canvas: OpenGL ES draws from host memory, and a table is a Vulkan buffer");
    }
    interior_->tables = tables;
}

void GlCanvas::begin(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low, vec3 scene_high) {
    const Impl& in = *interior_;
    const GlContext::Current current(in.context);
    const std::uint32_t quads = in.prepare(camera, scale, caption, scene_low, scene_high);
    in.look();
    in.draw_shadows(0);
    in.draw_shadows(1);
    in.draw_picture(quads);
    in.check("drawing a picture");
}

Image GlCanvas::finish() {
    const Impl& in = *interior_;
    const GlContext::Current current(in.context);
    Image image = in.read_picture();
    if (in.options.samples == 1 && in.options.background && !smooths_on_device(in.options))
        in.options.smooth ? smooth_edges(image) : make_opaque(image);
    return image;
}

bool GlCanvas::draws_parts() const {
    const GlContext::Current current(interior_->context);
    return interior_->has_parts();
}

void GlCanvas::set_bodies(const ShapeInstances& instances) {
    const GlContext::Current current(interior_->context);
    interior_->scenery = Scenery(instances);
    interior_->fill_scenery();
    interior_->check("taking bodies");
}

Image GlCanvas::draw_part(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low,
                          vec3 scene_high, PictureParts& parts) {
    const Impl& in = *interior_;
    const GlContext::Current current(in.context);
    if (!in.has_parts()) throw std::logic_error("canvas: it draws no parts of pictures");
    const std::uint32_t quads = in.prepare(camera, scale, caption, scene_low, scene_high);
    in.look(&parts);
    for (std::size_t light = 0; in.options.shadows && light < 2; ++light) {
        const Impl::Target& map = in.shadow_maps[light];
        in.draw_shadows(light);
        std::vector<float> depths = in.read_depths(map);
        parts.unite(depths);
        in.gl.glActiveTexture(GL_TEXTURE0 + (light == 0 ? SUN_MAP : SKY_MAP));
        in.gl.glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, map.width, map.height, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    }
    in.draw_bodies(quads);
    Image image = in.read_picture();
    std::vector<std::uint32_t> colors(image.rgba.size() / 4);
    std::memcpy(colors.data(), image.rgba.data(), image.rgba.size());
    parts.compose(colors, in.read_depths(in.scene));
    if (!parts.is_first()) return {};
    in.gl.glActiveTexture(GL_TEXTURE0 + SCENE);
    in.gl.glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, in.options.width, in.options.height, GL_RGBA, GL_UNSIGNED_BYTE, colors.data());
    in.begin(in.scene);
    in.draw_all(Pass::finish, quads);
    image = in.read_picture();
    in.options.smooth ? smooth_edges(image) : make_opaque(image);
    return image;
}

std::unique_ptr<Canvas> make_gl_canvas(const ShapeInstances& instances, const CanvasOptions& options) {
    return std::make_unique<GlCanvas>(instances, options);
}

}  // namespace scree::host
