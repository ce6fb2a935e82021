// This machine and this process on it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace scree::host {

// The processor's name by its maker, empty where the system does not tell it.
std::string processor_name();
// Memory that this process can still have, bytes: the system's estimate, or less under a limit. Infinite where nobody tells.
double available_memory();
// The most memory that this process had, bytes; 0: not known.
std::size_t peak_memory();

// Where a user's caches lie; empty if that is not known.
std::filesystem::path cache_home();

std::filesystem::path own_program();
// The file that this code is in: a program, or a module of another.
std::filesystem::path own_file();
void set_environment(const char* name, const std::string& value);  // of this process
std::vector<std::string> own_words();                              // of the command line, in UTF-8

char** utf8_arguments(char** arguments);  // those of main, in UTF-8

// Standard streams of a program, first of all: bytes go through them untranslated, closed ones lead nowhere.
void prepare_streams();

// Tables that are freed from now on go back to the system: by itself a library may keep them.
void give_memory_back();

}  // namespace scree::host
