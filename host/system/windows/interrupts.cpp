// Ctrl-C and the like of Windows, which come on threads of their own.
#include "host/system/interrupts.h"

#include <cstring>

#include "host/system/windows/windows.h"

namespace scree::host {

namespace {

void (*on_wish)() = nullptr;
void (*on_deadline)() = nullptr;

BOOL WINAPI take(DWORD event) {
    on_wish();
    // The system ends the process when this returns, or some seconds later: the time is for what is being written.
    if (event == CTRL_CLOSE_EVENT || event == CTRL_LOGOFF_EVENT || event == CTRL_SHUTDOWN_EVENT) Sleep(INFINITE);
    return TRUE;
}

}  // namespace

void listen_to_signals(void (*wish)(), void (*deadline)()) {
    on_wish = wish;
    on_deadline = deadline;
    SetConsoleCtrlHandler(take, TRUE);
}

void set_deadline(int milliseconds) {
    const auto wait = [](void* time) -> DWORD {
        Sleep(static_cast<DWORD>(reinterpret_cast<std::uintptr_t>(time)));
        on_deadline();
        return 0;
    };
    const HANDLE thread =
        CreateThread(nullptr, 0, wait, reinterpret_cast<void*>(static_cast<std::uintptr_t>(milliseconds)), 0, nullptr);
    if (thread) CloseHandle(thread);
}

void tell_in_signal(const char* text) noexcept {
    DWORD written = 0;
    WriteFile(GetStdHandle(STD_ERROR_HANDLE), text, static_cast<DWORD>(std::strlen(text)), &written, nullptr);
}

}  // namespace scree::host
