// Windows' own functions, without the macros that its headers leave behind.
#pragma once

#undef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#undef NOMINMAX
#define NOMINMAX
#undef _WIN32_WINNT
#define _WIN32_WINNT 0x0A00
#include <windows.h>
#undef near
#undef far

#include <string>

namespace scree::host {

// The errno value of an error of Windows.
int errno_of(DWORD error);
void set_errno();  // to the last error's

std::wstring wide(const std::string& utf8);
std::string narrow(const std::wstring& wide);

}  // namespace scree::host
