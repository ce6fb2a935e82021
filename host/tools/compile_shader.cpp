// Build tool: compiles a shader in all its variants, for embedding.
//     scree_compile_shader GLSLC FOLDER [-I FOLDER]... [--words] [--forbid-inexact] [--es] SOURCE (VARIANT
//     [-DMACRO[=VALUE]]...)...
//
// --words writes FOLDER/VARIANT.words: the optimised SPIR-V with NoContraction on all float arithmetic. --es writes
// FOLDER/VARIANT.es: OpenGL ES GLSL. Dependencies go to FOLDER/VARIANT.d of the first variant. One glslc process
// compiles all variants, since starting it takes longer than compiling a shader; the optimiser is linked in.
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <set>
#include <span>
#include <spirv-tools/optimizer.hpp>
#include <string>
#include <vector>

#include "host/files/file.h"
#include "host/spirv/spirv.h"
#include "host/tools/es_shader.h"

extern char** environ;

namespace {

using namespace scree::host;
namespace fs = std::filesystem;

struct Variant {
    std::string name;
    std::vector<std::string> definitions;  // "MACRO" or "MACRO=VALUE"
};

struct Task {
    std::string glslc;
    fs::path folder;
    std::vector<std::string> include_folders;
    bool words = false;
    bool forbid_inexact = false;
    bool es = false;
    fs::path source;
    std::vector<Variant> variants;
};

struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

Task task_of(const std::vector<std::string>& arguments) {
    if (arguments.size() < 2) throw UsageError("too few arguments");
    Task task{.glslc = arguments[0], .folder = fs::absolute(arguments[1]), .include_folders = {}, .source = {}, .variants = {}};
    for (std::size_t i = 2; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        if (argument == "-I" && i + 1 < arguments.size()) {
            task.include_folders.push_back(fs::absolute(arguments[++i]).string());
        } else if (argument == "--words") {
            task.words = true;
        } else if (argument == "--forbid-inexact") {
            task.forbid_inexact = true;
        } else if (argument == "--es") {
            task.es = true;
        } else if (task.source.empty()) {
            task.source = fs::absolute(argument);
        } else if (argument.starts_with("-D") && !task.variants.empty()) {
            task.variants.back().definitions.push_back(argument.substr(2));
        } else if (argument.starts_with("-")) {
            throw UsageError(argument + ": unknown");
        } else {
            task.variants.push_back({argument, {}});
        }
    }
    if (task.variants.empty()) throw UsageError("no source or no variant");
    return task;
}

// Optimiser passes that save drivers work at start-up: inlining, conversion to SSA, dead code elimination. No pass
// may fold float arithmetic, whose result must come from the device, nor merge equal expressions
// (--redundancy-elimination): with that, hull collisions differed from the CPU.
const std::vector<std::string> optimiser_passes = {
    "--merge-return",         "--inline-entry-points-exhaustive", "--eliminate-dead-functions",
    "--scalar-replacement=0", "--eliminate-local-single-block",   "--eliminate-local-single-store",
    "--ssa-rewrite",          "--eliminate-dead-code-aggressive", "--eliminate-dead-branches",
    "--merge-blocks",         "--eliminate-dead-code-aggressive"};

std::vector<std::uint32_t> optimized(const std::vector<std::uint32_t>& words) {
    spvtools::Optimizer optimizer(SPV_ENV_UNIVERSAL_1_6);
    std::string messages;
    optimizer.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
        messages += std::string(": ") + message;
    });
    if (!optimizer.RegisterPassesFromFlags(optimiser_passes)) throw SpirvError("the optimiser lacks a pass" + messages);
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    std::vector<std::uint32_t> made;
    if (!optimizer.Run(words.data(), words.size(), &made, options)) throw SpirvError("not optimised" + messages);
    return made;
}

// The source with the definitions after its #version, which must come first; #line keeps the line numbers of
// messages.
std::string text_of(const Variant& variant, const fs::path& source, const std::string& text) {
    const std::size_t version = text.starts_with("#version") ? 0 : text.find("\n#version");
    const std::size_t end = version == std::string::npos ? version : text.find('\n', version + 1);
    if (end == std::string::npos) throw std::runtime_error("has no line #version");
    std::string definitions = "#extension GL_GOOGLE_cpp_style_line_directive : require\n";
    for (std::string definition : variant.definitions) {
        const std::size_t equals = definition.find('=');
        definition = equals == std::string::npos ? definition + " 1" : definition.replace(equals, 1, " ");
        definitions += "#define " + definition + "\n";
    }
    const auto line = 2 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    return text.substr(0, end + 1) + definitions + "#line " + std::to_string(line) + " \"" + source.string() + "\"\n" +
           text.substr(end + 1);
}

// Runs in the current folder, where glslc -c writes its output.
void run(const std::vector<std::string>& command) {
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    pid_t child = 0;
    const int error = posix_spawnp(&child, words[0], nullptr, nullptr, words.data(), environ);
    if (error != 0) throw std::runtime_error(command[0] + ": " + std::strerror(error));
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("not compiled");
}

std::vector<std::uint32_t> read_words(const fs::path& path) {
    const std::string bytes = read_text(path);
    if (bytes.size() % 4 != 0) throw SpirvError("not a SPIR-V module: " + std::to_string(bytes.size()) + " bytes");
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

// Adds the files of a make rule "TARGET: FILE FILE...".
void add_files_of(const std::string& line, std::set<std::string>& files) {
    std::string file;
    for (std::size_t i = line.find(": ") + 2; i <= line.size(); ++i) {
        const bool escaped = i > 0 && line[i - 1] == '\\';
        if (i < line.size() && (escaped || !std::isspace(static_cast<unsigned char>(line[i])))) {
            file += line[i];
        } else if (!file.empty()) {
            files.insert(std::exchange(file, ""));
        }
    }
}

// A temporary folder for glslc's input and output, removed by the destructor.
class Workplace {
public:
    explicit Workplace(fs::path folder) : folder_(std::move(folder)) {
        fs::create_directories(folder_);
        fs::current_path(folder_);
    }
    ~Workplace() {
        std::error_code ignored;
        fs::current_path(folder_.parent_path(), ignored);
        fs::remove_all(folder_, ignored);
    }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;

private:
    fs::path folder_;
};

// Lines are stripped before optimising, which takes a quarter longer with them; messages about inexact instructions
// name lines, so a module that has any is optimised again with them.
bool embed_words(const Task& task, const Variant& variant, const std::vector<std::uint32_t>& compiled) {
    const std::vector<std::uint32_t> words = optimized(without_lines(compiled));
    const std::vector<std::uint32_t> ready = without_contraction(words);
    write_atomically(task.folder / (variant.name + ".words"), std::as_bytes(std::span(ready)));
    if (!task.forbid_inexact || inexact_instructions(words).empty()) return true;
    for (const std::string& instruction : inexact_instructions(optimized(compiled)))
        std::cerr << task.source.string() << ": " << instruction << ": its result differs between devices; spell it with + - *\n";
    return false;
}

int compile(const Task& task) {
    const std::string text = read_text(task.source), kind = task.source.extension().string();
    const Workplace workplace(task.folder / (task.variants[0].name + ".parts"));
    std::vector<std::string> command = {task.glslc, "--target-env=vulkan1.2", "-O0", "-g", "-MD", "-c"};
    for (const std::string& folder : task.include_folders) command.insert(command.end(), {"-I", folder});
    for (const Variant& variant : task.variants) {
        write_atomically(variant.name + kind, text_of(variant, task.source, text));
        command.push_back(variant.name + kind);
    }
    run(command);
    bool exact = true;
    std::set<std::string> files = {task.source.string()};
    for (const Variant& variant : task.variants) {
        const std::vector<std::uint32_t> compiled = read_words(variant.name + kind + ".spv");
        if (task.words) exact = embed_words(task, variant, compiled) && exact;
        if (task.es) write_atomically(task.folder / (variant.name + ".es"), es_text_of(compiled));
        add_files_of(read_text(variant.name + kind + ".spv.d"), files);
        files.erase(variant.name + kind);
    }
    const fs::path first = task.folder / task.variants[0].name;
    std::string dependencies = first.string() + (task.words ? ".words:" : ".es:");
    for (const std::string& file : files) dependencies += " " + file;
    write_atomically(first.string() + ".d", dependencies + "\n");
    return exact ? 0 : 1;
}

}  // namespace

int main(int count, char** values) {
    std::string source;
    try {
        const Task task = task_of({values + 1, values + count});
        source = task.source.string() + ": ";
        return compile(task);
    } catch (const UsageError& error) {
        std::cerr << "scree_compile_shader: " << error.what()
                  << "\nusage: scree_compile_shader GLSLC FOLDER [-I FOLDER]... [--words] [--forbid-inexact] [--es] SOURCE "
                     "(VARIANT [-DMACRO[=VALUE]]...)...\n";
        return 2;
    } catch (const std::exception& error) {
        std::cerr << source << error.what() << "\n";
        return 1;
    }
}
