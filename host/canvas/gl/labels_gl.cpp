// The OpenGL ES canvas: labels of pictures.
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "host/canvas/frame.h"
#include "host/canvas/gl/canvas_gl_impl.h"

namespace scree::host {

bool GlCanvas::Impl::has_labels() const {
    GLint of_fragment = 0;
    gl.glGetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &of_fragment);
    return of_fragment >= 2;
}

void GlCanvas::Impl::make_labels(int width, int height) {
    if (labels.width == width && labels.height == height) return;
    gl.glDeleteFramebuffers(1, &labels.framebuffer);
    gl.glDeleteRenderbuffers(static_cast<GLsizei>(label_buffers.size()), label_buffers.data());
    labels = {0, width, height};
    gl.glGenFramebuffers(1, &labels.framebuffer);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, labels.framebuffer);
    gl.glGenRenderbuffers(static_cast<GLsizei>(label_buffers.size()), label_buffers.data());
    const std::array<GLenum, 2> formats{GL_RGBA32UI, GL_DEPTH_COMPONENT32F};
    const std::array<GLenum, 2> places{GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
    for (std::size_t i = 0; i < formats.size(); ++i) {
        gl.glBindRenderbuffer(GL_RENDERBUFFER, label_buffers[i]);
        gl.glRenderbufferStorageMultisample(GL_RENDERBUFFER, 0, formats[i], width, height);
        gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER, places[i], GL_RENDERBUFFER, label_buffers[i]);
    }
    require_complete();
    for (const Draw& draw : label_draws())
        if (label_programs.size() < label_draws().size())
            label_programs.push_back(linked(draw.state.vertex, draw.state.fragment));
    check("making labels");
}

void GlCanvas::Impl::draw_labels(const Frame& seen, bool pixels, bool with_covers) const {
    fill(FRAME, &seen, sizeof seen);
    begin(labels);
    gl.glDepthMask(GL_TRUE);
    gl.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    const std::array<GLuint, 4> nothing{0, 0, std::bit_cast<GLuint>(std::numeric_limits<float>::infinity()), no_row};
    gl.glClearBufferuiv(GL_COLOR, 0, nothing.data());
    gl.glClearDepthf(0);  // reversed depth: 0 is infinitely far
    gl.glClear(GL_DEPTH_BUFFER_BIT);
    for (std::size_t i = 0; i < label_draws().size(); ++i) {
        const Draw& draw = label_draws()[i];
        const auto count = static_cast<GLsizei>(instances_of(draw, scenery));
        if (count == 0 || !(lists_covers(draw) ? with_covers : pixels)) continue;
        const Program& program = label_programs[i];
        set_state(draw.state);
        if (lists_covers(draw)) gl.glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        gl.glUseProgram(program.name);
        if (program.pushed >= 0) gl.glUniform1ui(program.pushed, draw.pushed);
        const bool planes = draw.mesh == Mesh::none;
        if (program.first_instance >= 0)
            gl.glUniform1i(program.first_instance, planes ? static_cast<GLint>(scenery.runs[RUN_PLANES].first) : 0);
        if (planes) {
            gl.glDrawArraysInstanced(GL_TRIANGLES, 0, static_cast<GLsizei>(draw.corners), count);
        } else {
            const Run mesh = scenery.mesh(draw.mesh);
            gl.glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(mesh.count), GL_UNSIGNED_INT,
                                       reinterpret_cast<const void*>(std::size_t{mesh.first} * sizeof(std::uint32_t)), count);
        }
    }
    gl.glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    check("drawing labels");
}

std::unique_ptr<Labels> GlCanvas::Impl::label(const Camera& camera, const LabelRequest& request) {
    if (!has_labels()) return nullptr;
    require_tables(tables, options, by);
    Frame seen = label_frame(camera, request.width, request.height, request.shift);
    make_labels(request.width, request.height);
    fill_tables(by);
    auto made = std::make_unique<Labels>();
    bool pixels = request.pixels;
    for (CoverBands bands(request.covers ? request.height : 1); !bands.done();) {
        const std::size_t bytes = sizeof(CoverHead) + bands.room() * sizeof(Cover);
        const CoverHead empty{0, bands.room()};
        if (request.covers) {
            gl.glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[COVERS]);
            gl.glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_READ);
            gl.glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof empty, &empty);
            seen.joints.z = static_cast<float>(bands.first());
            seen.joints.w = static_cast<float>(bands.end());
        }
        draw_labels(seen, pixels, request.covers);
        if (pixels) {
            made->pixels.resize(static_cast<std::size_t>(request.width) * static_cast<std::size_t>(request.height));
            gl.glReadPixels(0, 0, request.width, request.height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, made->pixels.data());
            check("reading labels");
            pixels = false;
        }
        if (!request.covers) break;
        gl.glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[COVERS]);
        const auto* const words = static_cast<const std::byte*>(
            gl.glMapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT));
        if (words == nullptr) throw DeviceError("OpenGL ES: what covers pixels cannot be read");
        CoverHead head;
        std::memcpy(&head, words, sizeof head);
        if (bands.take(head.count) && head.count > 0) {
            const std::size_t before = made->covers.size();
            made->covers.resize(before + head.count);
            std::memcpy(made->covers.data() + before, words + sizeof head, head.count * sizeof(Cover));
        }
        gl.glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
    }
    return made;
}

std::unique_ptr<Labels> GlCanvas::label(const Camera& camera, const LabelRequest& request) {
    const GlContext::Current current(interior_->context);
    return interior_->label(camera, request);
}

}  // namespace scree::host
