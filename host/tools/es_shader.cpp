// Translation of SPIR-V shaders to OpenGL ES 3.1 GLSL, by SPIRV-Cross.
#include "host/tools/es_shader.h"

#include <spirv_cross/spirv_cross_c.h>

#include <memory>
#include <stdexcept>

namespace scree::host {
namespace {

class Translator {
public:
    explicit Translator(std::span<const std::uint32_t> words) {
        spvc_context made = nullptr;
        if (spvc_context_create(&made) != SPVC_SUCCESS) throw std::runtime_error("spirv-cross: no context");
        context_.reset(made);
        spvc_parsed_ir module = nullptr;
        check(spvc_context_parse_spirv(made, words.data(), words.size(), &module));
        check(spvc_context_create_compiler(made, SPVC_BACKEND_GLSL, module, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler_));
        set_options();
        name_push_constant();
    }
    std::string text() {
        const char* made = nullptr;
        check(spvc_compiler_compile(compiler_, &made));
        return made;
    }

private:
    void set_options() {
        spvc_compiler_options options = nullptr;
        check(spvc_compiler_create_compiler_options(compiler_, &options));
        check(spvc_compiler_options_set_uint(options, SPVC_COMPILER_OPTION_GLSL_VERSION, 310));
        check(spvc_compiler_options_set_bool(options, SPVC_COMPILER_OPTION_GLSL_ES, SPVC_TRUE));
        check(spvc_compiler_options_set_bool(options, SPVC_COMPILER_OPTION_GLSL_ES_DEFAULT_FLOAT_PRECISION_HIGHP, SPVC_TRUE));
        check(spvc_compiler_options_set_bool(options, SPVC_COMPILER_OPTION_FIXUP_DEPTH_CONVENTION, SPVC_TRUE));
        check(spvc_compiler_install_compiler_options(compiler_, options));
    }
    void name_push_constant() {
        spvc_resources resources = nullptr;
        check(spvc_compiler_create_shader_resources(compiler_, &resources));
        const spvc_reflected_resource* list = nullptr;
        std::size_t count = 0;
        check(spvc_resources_get_resource_list_for_type(resources, SPVC_RESOURCE_TYPE_PUSH_CONSTANT, &list, &count));
        if (count == 0) return;
        spvc_compiler_set_name(compiler_, list->id, "pushed");
        spvc_compiler_set_member_name(compiler_, list->base_type_id, 0, "value");
    }
    void check(spvc_result result) {
        if (result != SPVC_SUCCESS)
            throw std::runtime_error(std::string("spirv-cross: ") + spvc_context_get_last_error_string(context_.get()));
    }

    struct Destroy {
        void operator()(spvc_context context) const { spvc_context_destroy(context); }
    };
    std::unique_ptr<spvc_context_s, Destroy> context_;
    spvc_compiler compiler_ = nullptr;
};

// Makes SPIRV-Cross's line that maps clip space depth from 0..w to -w..w conditional on SCREE_WHOLE_DEPTH.
std::string with_depth_by_choice(std::string text) {
    const std::string line = "    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;\n";
    for (std::size_t at = 0; (at = text.find(line, at)) != std::string::npos;) {
        const std::string guarded = "#ifdef SCREE_WHOLE_DEPTH\n" + line + "#endif\n";
        text.replace(at, line.size(), guarded);
        at += guarded.size();
    }
    return text;
}

}  // namespace

std::string es_text_of(std::span<const std::uint32_t> words) {
    std::string text = with_depth_by_choice(Translator(words).text());
    if (text.find("gl_Position") != std::string::npos && text.find("SCREE_WHOLE_DEPTH") == std::string::npos)
        throw std::runtime_error("the depth of gl_Position is not moved as this tool expects; does spirv-cross spell it anew?");
    return text;
}

}  // namespace scree::host
