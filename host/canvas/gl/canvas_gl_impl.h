// Internals of the OpenGL ES canvas.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "host/canvas/draw_geometry.h"
#include "host/canvas/gl/canvas_gl.h"
#include "host/canvas/gl/gl_context.h"
#include "host/canvas/labels.h"

namespace scree::host {

struct GlCanvas::Impl {
    Impl(const ShapeInstances& shapes, const CanvasOptions& chosen);

    // A linked program with its uniform locations; -1: absent.
    struct Program {
        std::string_view vertex, fragment;
        GLuint name = 0;
        GLint pushed = -1, first_instance = -1;
    };
    struct Target {
        GLuint framebuffer = 0;
        int width = 0, height = 0;  // pixels
    };

    GlContext context;  // destroying the context destroys all objects in it
    const GlFunctions& gl;
    CanvasOptions options;
    Scenery scenery;
    std::vector<Draw> draws;
    std::vector<Program> programs;
    std::vector<std::size_t> program_of;  // program index of each draw
    std::array<GLuint, LOOKS.size()> looks{};
    BodyTables tables;
    mutable ColorBy by = ColorBy::momentum;  // of the last picture
    std::array<GLuint, BINDINGS> buffers{}, textures{};
    GLuint indices = 0;
    std::array<Target, 2> shadow_maps;  // sun, sky
    Target scene, target;               // the bodies with `samples` samples, the final picture
    bool half_depth = false;            // clip space depth is 0..w, as in Vulkan
    // Of labels, made when they are first asked for.
    Target labels;
    std::array<GLuint, 2> label_buffers{};  // labels, depth
    std::vector<Program> label_programs;    // one per draw of label_draws()

    bool has_labels() const;
    void make_labels(int width, int height);
    void draw_labels(const Frame& seen, bool pixels, bool with_covers) const;
    std::unique_ptr<Labels> label(const Camera& camera, const LabelRequest& request);

    void make_state();
    void make_buffers();
    void fill_scenery();
    void make_programs();
    GLuint shader(GLenum kind, std::string_view name) const;
    GLuint linked(const std::vector<GLuint>& parts, const std::string& what) const;
    Program linked(std::string_view vertex, std::string_view fragment) const;
    void make_shadow_maps();
    void make_picture();
    void make_glyphs();
    GLuint texture(GLenum format, int width, int height, GLint filter) const;
    GLuint renderbuffer(GLenum format, int samples) const;
    void require_complete() const;

    void fill(Binding binding, const void* data, std::size_t bytes) const;
    void fill_tables(ColorBy by) const;
    void look(PictureParts* parts = nullptr) const;
    void unite_light_bounds(PictureParts& parts) const;
    void begin(const Target& on) const;
    void set_state(const DrawState& state) const;
    void draw_all(Pass pass, std::uint32_t quad_count) const;
    void draw_shadows(std::size_t light) const;
    void draw_picture(std::uint32_t quad_count) const;
    void draw_bodies(std::uint32_t quad_count) const;
    // Fills the tables of a picture; returns its number of overlay quads.
    std::uint32_t prepare(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 low, vec3 high) const;
    Image read_picture() const;
    bool has_parts() const;
    std::vector<float> read_depths(const Target& of) const;
    void check(const char* what) const;
};

}  // namespace scree::host
