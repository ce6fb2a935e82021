// Processes of Windows.
#include "host/system/processes.h"

#include <io.h>

#include <cerrno>
#include <map>
#include <mutex>
#include <sstream>

#include "host/system/machine.h"
#include "host/system/windows/windows.h"

namespace scree::host {

namespace {

std::mutex guard;
std::map<ProcessId, HANDLE>& children() {
    static std::map<ProcessId, HANDLE> all;
    return all;
}

// Children in it end with this process, since it then has no other owner.
HANDLE group_of_children() {
    static const HANDLE job = [] {
        const HANDLE made = CreateJobObjectW(nullptr, nullptr);
        JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
        limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
        SetInformationJobObject(made, JobObjectExtendedLimitInformation, &limits, sizeof limits);
        return made;
    }();
    return job;
}

// As the C library of a child takes its command line apart again.
std::wstring quoted(const std::wstring& word) {
    if (!word.empty() && word.find_first_of(L" \t\n\v\"") == word.npos) return word;
    std::wstring text = L"\"";
    std::size_t backslashes = 0;
    for (const wchar_t c : word) {
        if (c == L'\\') {
            ++backslashes;
            continue;
        }
        text.append(c == L'"' ? 2 * backslashes + 1 : backslashes, L'\\');
        text += c;
        backslashes = 0;
    }
    text.append(2 * backslashes, L'\\');
    return text + L'"';
}

// A handle that children inherit, of a descriptor or of what swallows all.
HANDLE inherited(int file) {
    HANDLE made = INVALID_HANDLE_VALUE;
    if (file >= 0) {
        DuplicateHandle(GetCurrentProcess(), reinterpret_cast<HANDLE>(::_get_osfhandle(file)), GetCurrentProcess(), &made, 0,
                        TRUE, DUPLICATE_SAME_ACCESS);
        return made;
    }
    SECURITY_ATTRIBUTES can_be_inherited{sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
    return CreateFileW(L"NUL", GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, &can_be_inherited, OPEN_EXISTING,
                       0, nullptr);
}

ChildEnd end_of(HANDLE process) {
    DWORD status = 0;
    GetExitCodeProcess(process, &status);
    return {status >= 0xC0000000u, static_cast<int>(status)};  // exceptions, as signals are elsewhere
}

std::optional<ChildEnd> waited(ProcessId child, DWORD milliseconds) {
    HANDLE process = nullptr;
    {
        const std::lock_guard lock(guard);
        const auto found = children().find(child);
        if (found == children().end()) return ChildEnd{false, -1};
        process = found->second;
    }
    if (WaitForSingleObject(process, milliseconds) != WAIT_OBJECT_0) return {};
    const ChildEnd end = end_of(process);
    const std::lock_guard lock(guard);
    children().erase(child);
    CloseHandle(process);
    return end;
}

}  // namespace

ProcessId own_process() noexcept {
    return static_cast<ProcessId>(GetCurrentProcessId());
}

bool is_gone(ProcessId process) {
    const HANDLE found = OpenProcess(SYNCHRONIZE, FALSE, static_cast<DWORD>(process));
    if (!found) return GetLastError() == ERROR_INVALID_PARAMETER;  // no such process
    const bool ended = WaitForSingleObject(found, 0) == WAIT_OBJECT_0;
    CloseHandle(found);
    return ended;
}

void end_process(ProcessId process) noexcept {
    const HANDLE found = OpenProcess(PROCESS_TERMINATE | SYNCHRONIZE, FALSE, static_cast<DWORD>(process));
    if (!found) return;
    TerminateProcess(found, 1);
    WaitForSingleObject(found, 5000);  // its files can be removed once it has let them go
    CloseHandle(found);
}

std::string child_output(const std::filesystem::path& output) {
    return std::filesystem::absolute(output).string();
}

ProcessId start_child(const std::filesystem::path& program, std::vector<std::string> words, const ChildFiles& files) {
    std::wstring line;
    for (const std::string& word : words) line += (line.empty() ? L"" : L" ") + quoted(wide(word));
    HANDLE streams[3] = {inherited(files.input), inherited(-1), inherited(files.errors)};
    // Of the handles that can be inherited the child gets these alone.
    SIZE_T size = 0;
    InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
    std::vector<std::byte> memory(size);
    const auto attributes = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(memory.data());
    InitializeProcThreadAttributeList(attributes, 1, 0, &size);
    UpdateProcThreadAttribute(attributes, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, streams, sizeof streams, nullptr, nullptr);
    STARTUPINFOEXW start{};
    start.StartupInfo.cb = sizeof start;
    start.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    start.StartupInfo.hStdInput = streams[0];
    start.StartupInfo.hStdOutput = streams[1];
    start.StartupInfo.hStdError = streams[2];
    start.lpAttributeList = attributes;
    PROCESS_INFORMATION made{};
    const bool started = CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE,
                                        EXTENDED_STARTUPINFO_PRESENT | CREATE_NEW_PROCESS_GROUP | CREATE_SUSPENDED, nullptr,
                                        nullptr, &start.StartupInfo, &made) != 0;
    const DWORD error = GetLastError();
    DeleteProcThreadAttributeList(attributes);
    for (const HANDLE stream : streams) CloseHandle(stream);
    if (!started) {
        errno = errno_of(error);
        return -1;
    }
    AssignProcessToJobObject(group_of_children(), made.hProcess);
    ResumeThread(made.hThread);
    CloseHandle(made.hThread);
    const auto child = static_cast<ProcessId>(made.dwProcessId);
    const std::lock_guard lock(guard);
    children()[child] = made.hProcess;
    return child;
}

ProcessId start_self(std::vector<std::string> words, const ChildFiles& files) {
    return start_child(own_program(), std::move(words), files);
}

ChildEnd wait_for_child(ProcessId child) {
    return waited(child, INFINITE).value_or(ChildEnd{false, -1});
}

std::optional<ChildEnd> end_of_child(ProcessId child) {
    return waited(child, 0);
}

std::optional<std::filesystem::path> find_program(const std::string& name) {
    const wchar_t* path = ::_wgetenv(L"PATH");
    std::wistringstream folders(path ? path : L"");
    for (std::wstring folder; std::getline(folders, folder, L';');) {
        if (folder.empty()) continue;
        const std::filesystem::path candidate = std::filesystem::path(folder) / (name + ".exe");
        std::error_code none;
        if (std::filesystem::is_regular_file(candidate, none)) return candidate;
    }
    return {};
}

}  // namespace scree::host
