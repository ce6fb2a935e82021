// A build tool: turns a compiled shader into GLSL of OpenGL ES 3.1, as a string in C++.
//     scree_embed_es_shader IN.spv OUT.cpp NAMESPACE SYMBOL SOURCE
//
// Bindings stay as they are. The push constant becomes the uniform `pushed`. Depth in clip space runs from 0 to w, as in Vulkan;
// for contexts where it runs from -w to w, SCREE_WHOLE_DEPTH is defined behind the first line.
#include <spirv_cross/spirv_cross_c.h>

#include <cstring>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/files/file.h"

namespace {

using namespace scree::host;

std::vector<SpvId> read_words(const std::string& path) {
    const std::string bytes = read_text(path);
    if (bytes.size() % 4 != 0) throw std::runtime_error("not a SPIR-V module: " + std::to_string(bytes.size()) + " bytes");
    std::vector<SpvId> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

class Translator {
public:
    explicit Translator(const std::vector<SpvId>& words) {
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

// The line that moves depth from 0..w to -w..w, only where it is asked for.
std::string with_depth_by_choice(std::string text) {
    const std::string line = "    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;\n";
    for (std::size_t at = 0; (at = text.find(line, at)) != std::string::npos;) {
        const std::string guarded = "#ifdef SCREE_WHOLE_DEPTH\n" + line + "#endif\n";
        text.replace(at, line.size(), guarded);
        at += guarded.size();
    }
    return text;
}

int embed(const std::vector<std::string>& arguments) {
    const std::string text = with_depth_by_choice(Translator(read_words(arguments[0])).text());
    if (text.find("gl_Position") != std::string::npos && text.find("SCREE_WHOLE_DEPTH") == std::string::npos)
        throw std::runtime_error("the depth of gl_Position is not moved as this tool expects; does spirv-cross spell it anew?");
    write_atomically(arguments[1], "// Made from " + arguments[4] + " when the project is built.\nnamespace " + arguments[2] +
                                       " {\nextern const char* const " + arguments[3] + ";\nconst char* const " + arguments[3] +
                                       " = R\"shader(" + text + ")shader\";\n}\n");
    return 0;
}

}  // namespace

int main(int count, char** values) {
    const std::vector<std::string> arguments(values + 1, values + count);
    if (arguments.size() != 5) {
        std::cerr << "usage: scree_embed_es_shader IN.spv OUT.cpp NAMESPACE SYMBOL SOURCE\n";
        return 2;
    }
    try {
        return embed(arguments);
    } catch (const std::exception& error) {
        std::cerr << arguments[4] << ": " << error.what() << "\n";
        return 1;
    }
}
