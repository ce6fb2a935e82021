// This machine, by Linux's files that tell of it.
#include "host/system/machine.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __EMSCRIPTEN__
#include <emscripten/heap.h>
#endif

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>

namespace scree::host {

namespace {

// What a resource limit leaves of the kind of memory that a line of /proc/self/status tells.
double left_of(decltype(RLIMIT_AS) resource, const std::string& line) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::numeric_limits<double>::infinity();
    std::ifstream status("/proc/self/status");
    double kilobytes = 0;
    for (std::string key; status >> key; std::getline(status, key))
        if (key == line && status >> kilobytes) break;
    return static_cast<double>(limit.rlim_cur) - kilobytes * 1024;
}

}  // namespace

std::string processor_name() {
#ifdef __EMSCRIPTEN__
    return "WebAssembly";
#endif
    std::ifstream list("/proc/cpuinfo");
    for (std::string line; std::getline(list, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != line.npos) return line.substr(colon + 2);
    }
    return "";
}

double available_memory() {
#ifdef __EMSCRIPTEN__  // what the module may still grow by
    return static_cast<double>(emscripten_get_heap_max()) - static_cast<double>(reinterpret_cast<std::uintptr_t>(sbrk(0)));
#endif
    double bytes = std::numeric_limits<double>::infinity();
    std::ifstream system("/proc/meminfo");
    for (std::string key, unit; system >> key;) {
        double kilobytes = 0;
        if (!(system >> kilobytes)) break;
        std::getline(system, unit);
        if (key == "MemAvailable:") bytes = kilobytes * 1024;
    }
    double limit = 0, used = 0;
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> limit && std::ifstream("/sys/fs/cgroup/memory.current") >> used) {
        bytes = std::min(bytes, limit - used);
    }
    bytes = std::min({bytes, left_of(RLIMIT_AS, "VmSize:"), left_of(RLIMIT_DATA, "VmData:")});
    return std::max(bytes, 0.0);
}

std::size_t peak_memory() {
    rusage usage{};
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux reports KiB
}

std::filesystem::path cache_home() {
    const char* base = std::getenv("XDG_CACHE_HOME");
    if (base && *base == '/') return base;
    const char* home = std::getenv("HOME");
    return home && *home == '/' ? std::filesystem::path(home) / ".cache" : std::filesystem::path();
}

std::filesystem::path own_program() {
    std::error_code failed;
    return std::filesystem::read_symlink("/proc/self/exe", failed);
}

std::filesystem::path own_file() {
    Dl_info found{};
    std::error_code none;
    const bool known = ::dladdr(reinterpret_cast<const void*>(&own_file), &found) != 0 && found.dli_fname != nullptr;
    const std::filesystem::path file = known ? found.dli_fname : "";
    return file.extension() == ".so" && std::filesystem::exists(file, none) ? file : "/proc/self/exe";
}

void set_environment(const char* name, const std::string& value) {
    ::setenv(name, value.c_str(), 1);
}

std::vector<std::string> own_words() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> words;
    for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
    return words;
}

char** utf8_arguments(char** arguments) {
    return arguments;
}

// Else the next opened file would get the descriptor of a closed stream, and its output.
void prepare_streams() {
    for (int stream = 0; stream < 3; ++stream) {
        if (::fcntl(stream, F_GETFD) < 0) (void)::open("/dev/null", O_RDONLY);
    }
}

// The C library keeps tables once they are larger than ever before.
void give_memory_back() {
#ifdef M_MMAP_THRESHOLD
    ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
}

}  // namespace scree::host
