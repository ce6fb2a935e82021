// Processes of POSIX, and of Linux where it has more.
#include "host/system/processes.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <sstream>

extern char** environ;

namespace scree::host {

namespace {

constexpr int output_number = 3;  // of the file descriptor in the child

std::vector<char*> pointers_of(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

// In the child: only what is safe after fork().
[[noreturn]] void become_self(char* const* words, int errors) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive this process
    ::setpgid(0, 0);                     // the terminal's Ctrl-C reaches this process alone, which ends its children
    const int nothing = ::open("/dev/null", O_RDWR);
    ::dup2(nothing, 0), ::dup2(nothing, 1), ::dup2(errors >= 0 ? errors : nothing, 2);
    ::execv("/proc/self/exe", words);
    _exit(127);
}

ChildEnd end_of(int status) {
    if (WIFSIGNALED(status)) return {true, WTERMSIG(status)};
    return {false, WIFEXITED(status) ? WEXITSTATUS(status) : -1};
}

}  // namespace

ProcessId own_process() noexcept {
    return ::getpid();
}

bool is_gone(ProcessId process) {
    return ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}

void end_process(ProcessId process) noexcept {
    ::kill(static_cast<pid_t>(process), SIGKILL);
}

std::string child_output(const std::filesystem::path&) {
    return "/proc/self/fd/" + std::to_string(output_number);
}

ProcessId start_child(const std::filesystem::path& program, std::vector<std::string> words, const ChildFiles& files) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const auto give = [&](int number, int file, int otherwise) {
        if (file >= 0)
            posix_spawn_file_actions_adddup2(&actions, file, number);
        else
            posix_spawn_file_actions_addopen(&actions, number, "/dev/null", otherwise, 0);
    };
    give(0, files.input, O_RDONLY);
    give(1, -1, O_WRONLY);
    give(2, files.errors, O_WRONLY);
    if (!files.output.empty()) posix_spawn_file_actions_addopen(&actions, output_number, files.output.c_str(), O_RDWR, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setpgroup(&attributes, 0);  // the terminal's Ctrl-C reaches its foreground group
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    pid_t child = -1;
    const int error = posix_spawn(&child, program.c_str(), &actions, &attributes, pointers_of(words).data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    errno = error;
    return error == 0 ? child : -1;
}

ProcessId start_self(std::vector<std::string> words, const ChildFiles& files) {
    const std::vector<char*> pointers = pointers_of(words);
    const pid_t child = ::fork();
    if (child == 0) become_self(pointers.data(), files.errors);
    return child;
}

ChildEnd wait_for_child(ProcessId child) {
    int status = 0;
    while (::waitpid(static_cast<pid_t>(child), &status, 0) < 0 && errno == EINTR) {
    }
    return end_of(status);
}

std::optional<ChildEnd> end_of_child(ProcessId child) {
    int status = 0;
    if (::waitpid(static_cast<pid_t>(child), &status, WNOHANG) <= 0) return {};
    return end_of(status);
}

std::optional<std::filesystem::path> find_program(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::string candidate = (folder.empty() ? "." : folder) + "/" + name;
        if (::access(candidate.c_str(), X_OK) == 0) return candidate;
    }
    return {};
}

}  // namespace scree::host
