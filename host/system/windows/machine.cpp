// This machine, by Windows.
#include "host/system/machine.h"

#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "host/system/windows/windows.h"

#include <psapi.h>
#include <shellapi.h>

namespace scree::host {

namespace {

std::filesystem::path file_of(HMODULE module) {
    std::wstring name(32768, L'\0');
    name.resize(GetModuleFileNameW(module, name.data(), static_cast<DWORD>(name.size())));
    return name;
}

PROCESS_MEMORY_COUNTERS memory_of_this_process() {
    PROCESS_MEMORY_COUNTERS counters{};
    GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters);
    return counters;
}

UINT code_page_before = 0;

}  // namespace

std::string processor_name() {
    wchar_t name[256] = {};
    DWORD size = sizeof name;
    const LSTATUS error = RegGetValueW(HKEY_LOCAL_MACHINE, L"HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0",
                                       L"ProcessorNameString", RRF_RT_REG_SZ, nullptr, name, &size);
    std::string text = error == ERROR_SUCCESS ? narrow(name) : "";
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

double available_memory() {
    double bytes = std::numeric_limits<double>::infinity();
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    if (GlobalMemoryStatusEx(&status)) bytes = static_cast<double>(std::min(status.ullAvailPhys, status.ullAvailPageFile));
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    if (QueryInformationJobObject(nullptr, JobObjectExtendedLimitInformation, &limits, sizeof limits, nullptr) &&
        (limits.BasicLimitInformation.LimitFlags & JOB_OBJECT_LIMIT_PROCESS_MEMORY) != 0) {
        const auto used = static_cast<double>(memory_of_this_process().PagefileUsage);
        bytes = std::min(bytes, static_cast<double>(limits.ProcessMemoryLimit) - used);
    }
    return std::max(bytes, 0.0);
}

std::size_t peak_memory() {
    return memory_of_this_process().PeakWorkingSetSize;
}

std::filesystem::path cache_home() {
    const wchar_t* const folder = ::_wgetenv(L"LOCALAPPDATA");
    return folder ? std::filesystem::path(folder) : std::filesystem::path();
}

std::filesystem::path own_program() {
    return file_of(nullptr);
}

std::filesystem::path own_file() {
    HMODULE module = nullptr;
    GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
                       reinterpret_cast<LPCWSTR>(&own_file), &module);
    return file_of(module);
}

void set_environment(const char* name, const std::string& value) {
    ::_wputenv_s(wide(name).c_str(), wide(value).c_str());
}

std::vector<std::string> own_words() {
    int count = 0;
    wchar_t** const given = CommandLineToArgvW(GetCommandLineW(), &count);
    std::vector<std::string> words;
    for (int i = 0; given && i < count; ++i) words.push_back(narrow(given[i]));
    LocalFree(given);
    return words;
}

char** utf8_arguments(char** arguments) {
    static std::vector<std::string> words = own_words();
    static std::vector<char*> pointers;
    if (words.empty()) return arguments;
    pointers.clear();
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers.data();
}

void prepare_streams() {
    _fmode = _O_BINARY;  // of all files that streams open
    for (int stream = 0; stream < 3; ++stream) ::_setmode(stream, _O_BINARY);
    code_page_before = GetConsoleOutputCP();
    if (code_page_before == 0) return;  // no console
    SetConsoleOutputCP(CP_UTF8);
    std::atexit([] { SetConsoleOutputCP(code_page_before); });
    // The progress bar erases its line.
    const HANDLE errors = GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    if (GetConsoleMode(errors, &mode)) SetConsoleMode(errors, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

void give_memory_back() {}

}  // namespace scree::host
