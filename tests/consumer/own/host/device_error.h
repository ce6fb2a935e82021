// The program's own header, of the name of one of the library.
#pragma once
inline constexpr int own_errors = 4;
