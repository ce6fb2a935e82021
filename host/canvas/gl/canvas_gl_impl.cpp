// Construction of the OpenGL ES canvas.
#include "host/canvas/gl/canvas_gl_impl.h"

#include <algorithm>
#include <sstream>

#include "host/canvas/frame.h"
#include "host/canvas/glyphs.h"
#include "shaders/embedded.h"

namespace scree::host {
namespace {

constexpr GLenum COLOR_FORMAT = GL_SRGB8_ALPHA8;  // encoded on write, so samples are averaged in linear light
constexpr GLenum DEPTH_FORMAT = GL_DEPTH_COMPONENT32F;

CanvasOptions checked(CanvasOptions options, const GlContext& context) {
    const GlContext::Current current(context);
    GLint texture = 0, renderbuffer = 0;
    context.gl().glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    context.gl().glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
    const int most = std::min(texture, renderbuffer);
    options = with_samples(options, most, context.is_processor());
    if (options.bits != 8) throw DeviceError("canvas: OpenGL ES draws 8 bits a channel here; more needs Vulkan");
    return options;
}

}  // namespace

GlCanvas::Impl::Impl(const ShapeInstances& shapes, const CanvasOptions& chosen)
    : gl(context.gl()), options(checked(chosen, context)), scenery(shapes), draws(draws_of(options, scenery.textured)) {
    const GlContext::Current current(context);
    make_state();
    make_buffers();
    make_programs();
    make_shadow_maps();
    make_picture();
    make_glyphs();
    check("making a canvas");
}

void GlCanvas::Impl::make_state() {
    GLint tables_of_vertex = 0, bindings = 0;
    gl.glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &tables_of_vertex);
    gl.glGetIntegerv(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, &bindings);
    if (tables_of_vertex < 8 || bindings < static_cast<GLint>(BINDINGS)) {
        throw DeviceError("the OpenGL ES driver of " + context.renderer() +
                          " lets vertex shaders read too few tables; LIBGL_ALWAYS_SOFTWARE=1 takes Mesa's software driver");
    }
    half_depth = gl.glClipControlEXT != nullptr && context.has("GL_EXT_clip_control");
    if (half_depth) gl.glClipControlEXT(GL_LOWER_LEFT_EXT, GL_ZERO_TO_ONE_EXT);
    GLuint corners = 0;  // an empty vertex array: vertices come from storage buffers
    gl.glGenVertexArrays(1, &corners);
    gl.glBindVertexArray(corners);
    // OpenGL's framebuffer origin is at the bottom, Vulkan's at the top; equal clip coordinates thus have the
    // opposite winding.
    gl.glFrontFace(GL_CW);
    gl.glEnable(GL_DEPTH_TEST);
    // Before a background keep the destination's alpha: blended geometry is antialiased already, and smooth.frag detects edges
    // in alpha.
    const bool covers = !options.background && !options.backdrop;
    gl.glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, covers ? GL_ONE : GL_ZERO,
                           covers ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
    const vec4 clear = clear_color(options);
    gl.glClearColor(clear.r, clear.g, clear.b, clear.a);
    gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

void GlCanvas::Impl::make_buffers() {
    gl.glGenBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
    for (std::uint32_t i = 0; i < BINDINGS; ++i) {
        if (binding_infos()[i].source != Source::image) gl.glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers[i]);
    }
    gl.glGenBuffers(1, &indices);
    gl.glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    gl.glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffers[ARGUMENTS]);
    fill_scenery();
}

void GlCanvas::Impl::fill_scenery() {
    fill(INSTANCES, scenery.instances.data(), std::span(scenery.instances).size_bytes());
    fill(RUN_TABLE, scenery.runs.data(), std::span(scenery.runs).size_bytes());
    const auto arguments = arguments_of(scenery, draws);
    fill(ARGUMENTS, arguments.data(), sizeof arguments);
    const std::vector<std::uint32_t> counts(std::size_t{groups_of_look(0, scenery.bodies())} * GROUP_WORDS);
    fill(GROUP_COUNTS, counts.data(), std::span(counts).size_bytes());
    const std::vector<vec4> tints(scenery.records);
    fill(TINTS, tints.data(), std::span(tints).size_bytes());
    fill(DIRECTIONS, scenery.directions.data(), std::span(scenery.directions).size_bytes());
    if (!scenery.texels.empty()) fill(TEXELS, scenery.texels.data(), std::span(scenery.texels).size_bytes());
    gl.glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(std::span(scenery.indices).size_bytes()),
                    scenery.indices.data(), GL_STATIC_DRAW);
}

GLuint GlCanvas::Impl::shader(GLenum kind, std::string_view name) const {
    const std::string_view text = name.empty() ? "#version 310 es\nvoid main() {}\n" : shaders::find_es(name);
    if (text.empty()) throw DeviceError("the program was built without the shader " + std::string(name));
    const std::size_t first_line = text.find('\n') + 1;
    const std::string_view depth = half_depth ? "" : "#define SCREE_WHOLE_DEPTH\n";
    const std::array<std::string_view, 3> parts{text.substr(0, first_line), depth, text.substr(first_line)};
    std::array<const GLchar*, 3> starts{};
    std::array<GLint, 3> lengths{};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        starts[i] = parts[i].data();
        lengths[i] = static_cast<GLint>(parts[i].size());
    }
    const GLuint made = gl.glCreateShader(kind);
    gl.glShaderSource(made, static_cast<GLsizei>(parts.size()), starts.data(), lengths.data());
    gl.glCompileShader(made);
    GLint done = GL_FALSE;
    gl.glGetShaderiv(made, GL_COMPILE_STATUS, &done);
    if (done) return made;
    std::array<GLchar, 1024> log{};
    gl.glGetShaderInfoLog(made, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw DeviceError("OpenGL ES: the shader " + std::string(name) + " does not compile: " + log.data());
}

GLuint GlCanvas::Impl::linked(const std::vector<GLuint>& parts, const std::string& what) const {
    const GLuint name = gl.glCreateProgram();
    for (const GLuint part : parts) {
        gl.glAttachShader(name, part);
        gl.glDeleteShader(part);  // deleted along with the program
    }
    gl.glLinkProgram(name);
    GLint done = GL_FALSE;
    gl.glGetProgramiv(name, GL_LINK_STATUS, &done);
    if (done) return name;
    std::array<GLchar, 1024> log{};
    gl.glGetProgramInfoLog(name, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw DeviceError("OpenGL ES: " + what + " does not link: " + log.data());
}

GlCanvas::Impl::Program GlCanvas::Impl::linked(std::string_view vertex, std::string_view fragment) const {
    Program program{vertex, fragment};
    program.name = linked({shader(GL_VERTEX_SHADER, vertex), shader(GL_FRAGMENT_SHADER, fragment)},
                          std::string(vertex) + " with " + std::string(fragment));
    // Uniform names given by scree_compile_shader and SPIRV-Cross.
    program.pushed = gl.glGetUniformLocation(program.name, "pushed.value");
    program.first_instance = gl.glGetUniformLocation(program.name, "SPIRV_Cross_BaseInstance");
    return program;
}

void GlCanvas::Impl::make_programs() {
    for (const Draw& draw : draws) {
        const auto alike = std::find_if(programs.begin(), programs.end(), [&](const Program& program) {
            return program.vertex == draw.state.vertex && program.fragment == draw.state.fragment;
        });
        program_of.push_back(static_cast<std::size_t>(alike - programs.begin()));
        if (alike == programs.end()) programs.push_back(linked(draw.state.vertex, draw.state.fragment));
    }
    for (std::size_t i = 0; i < looks.size(); ++i) looks[i] = linked({shader(GL_COMPUTE_SHADER, LOOKS[i])}, LOOKS[i]);
}

GLuint GlCanvas::Impl::texture(GLenum format, int width, int height, GLint filter) const {
    GLuint made = 0;
    gl.glGenTextures(1, &made);
    gl.glBindTexture(GL_TEXTURE_2D, made);
    gl.glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return made;
}

GLuint GlCanvas::Impl::renderbuffer(GLenum format, int samples) const {
    GLuint made = 0;
    gl.glGenRenderbuffers(1, &made);
    gl.glBindRenderbuffer(GL_RENDERBUFFER, made);
    gl.glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, options.width, options.height);
    return made;
}

void GlCanvas::Impl::require_complete() const {
    const GLenum status = gl.glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return;
    std::ostringstream message;
    message << "OpenGL ES: " << context.renderer() << " does not draw into this canvas (status 0x" << std::hex << status << ")";
    throw DeviceError(message.str());
}

void GlCanvas::Impl::make_shadow_maps() {
    for (std::size_t i = 0; i < shadow_maps.size(); ++i) {
        Target& map = shadow_maps[i];
        const std::uint32_t binding = i == 0 ? SUN_MAP : SKY_MAP;
        // Without shadows the maps are not read, but the samplers must be valid.
        map.width = map.height = !options.shadows ? 1 : i == 0 ? SUN_MAP_SIZE : SKY_MAP_SIZE;
        textures[binding] = texture(DEPTH_FORMAT, map.width, map.height, GL_NEAREST);
        // The border is unshadowed.
        const std::array<GLfloat, 4> far{1, 1, 1, 1};
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
        gl.glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, far.data());
        gl.glGenFramebuffers(1, &map.framebuffer);
        gl.glBindFramebuffer(GL_FRAMEBUFFER, map.framebuffer);
        gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, textures[binding], 0);
        require_complete();
    }
}

void GlCanvas::Impl::make_picture() {
    const bool smooths = options.samples == 1;
    scene = target = {0, options.width, options.height};
    gl.glGenFramebuffers(1, &scene.framebuffer);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, scene.framebuffer);
    if (smooths) {
        textures[SCENE] = texture(COLOR_FORMAT, options.width, options.height, GL_LINEAR);
        gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures[SCENE], 0);
    } else {
        gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                     renderbuffer(COLOR_FORMAT, options.samples));
    }
    gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                 renderbuffer(DEPTH_FORMAT, options.samples));
    require_complete();
    gl.glGenFramebuffers(1, &target.framebuffer);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderbuffer(COLOR_FORMAT, 1));
    require_complete();
}

void GlCanvas::Impl::make_glyphs() {
    const GlyphAtlas& atlas = glyph_atlas();
    textures[GLYPHS] = texture(GL_R8, atlas.width, atlas.height, GL_LINEAR);
    gl.glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, atlas.width, atlas.height, GL_RED, GL_UNSIGNED_BYTE, atlas.levels.data());
    for (std::uint32_t i = 0; i < BINDINGS; ++i) {
        gl.glActiveTexture(GL_TEXTURE0 + i);
        gl.glBindTexture(GL_TEXTURE_2D, textures[i]);
    }
}

void GlCanvas::Impl::check(const char* what) const {
    const GLenum error = gl.glGetError();
    if (error == GL_NO_ERROR) return;
    std::ostringstream message;
    message << "OpenGL ES: " << what << ": "
            << (error == GL_OUT_OF_MEMORY ? "the device has no memory left for it" : "the driver refused a call");
    message << " (error 0x" << std::hex << error << ", " << context.renderer() << ")";
    throw DeviceError(message.str());
}

}  // namespace scree::host
