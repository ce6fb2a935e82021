// What every call of the C interface goes through: errors become results, and what a call gives stays until the thread's next
// one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "demos/c/scree.h"

namespace scree::c {

// An error of a kind that no exception of the library has.
struct Failure : std::runtime_error {
    Failure(scree_result of, const std::string& reason, std::string at = "")
        : std::runtime_error(reason), kind(of), place(std::move(at)) {}
    scree_result kind;
    std::string place;  // JSON pointer
};
[[noreturn]] inline void refuse(const std::string& reason) {
    throw Failure(SCREE_BAD_ARGUMENT, reason);
}

void begin_call() noexcept;          // what earlier calls of this thread gave ends
scree_result told_error() noexcept;  // of the exception that is being handled

template <class Work>
scree_result called(Work&& work) noexcept {
    begin_call();
    try {
        work();
        return SCREE_OK;
    } catch (...) {
        return told_error();
    }
}

// Of calls that release, which end nothing else and tell nothing.
template <class Work>
void released(Work&& work) noexcept {
    try {
        work();
    } catch (...) {
    }
}

// Keeps an object until the thread's next call.
void keep(std::shared_ptr<void> given);
const char* kept_text(std::string text);

template <class Record>
scree_array kept_array(std::vector<Record> records) {
    const auto owned = std::make_shared<std::vector<Record>>(std::move(records));
    keep(owned);
    return {owned->data(), owned->size(), sizeof(Record)};
}

constexpr std::size_t most_rows = std::size_t{1} << (sizeof(std::size_t) > 4 ? 40 : 26);

// What the caller gives. All throw Failure, naming what is wrong.
template <class Value>
Value& given(Value* pointer, const char* name) {
    if (pointer == nullptr) refuse(std::string(name) + ": is null");
    return *pointer;
}
template <class Value>
Value* given_array(Value* pointer, std::size_t count, const char* name) {
    if (pointer == nullptr && count > 0) refuse(std::string(name) + ": is null, and has " + std::to_string(count) + " rows");
    if (count > most_rows)
        throw Failure(SCREE_NO_MEMORY, std::string(name) + ": " + std::to_string(count) + " rows are too many");
    return pointer;
}
std::string text_of(const char* text, const char* name);  // UTF-8
// Empty for null.
inline std::string text_or_none(const char* text, const char* name) {
    return text == nullptr ? "" : text_of(text, name);
}

// A struct that begins with its size, as this version knows it: what the caller's lacks is 0.
void copy_sized(void* to, std::size_t size, const void* from, const char* name);
template <class Options>
Options options_of(const Options* from) {
    Options options{};
    if (from != nullptr) copy_sized(&options, sizeof options, from, "options");
    return options;
}
// Fills as much of the caller's as it has.
void fill_sized(void* to, std::size_t size, const void* from, const char* name);
template <class Sized>
void fill(Sized* to, const Sized& from, const char* name) {
    fill_sized(to, sizeof from, &from, name);
}

}  // namespace scree::c
