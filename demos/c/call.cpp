// Errors of the C interface, and what its calls give.
#include "demos/c/call.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>

#include "compute/checkpoint.h"
#include "compute/scene.h"
#include "compute/scene_file/import/import_scene.h"
#include "demos/program/exit_status.h"
#include "host/device_error.h"
#include "host/files/file.h"
#include "host/pictures/image.h"

namespace scree::c {

namespace {

struct ErrorOfThread {
    std::string message, place;
};
thread_local ErrorOfThread last_error;
thread_local std::vector<std::shared_ptr<void>> kept;

scree_result tell(scree_result kind, const char* message, const std::string& place = "") noexcept {
    try {
        last_error = {message, place};
    } catch (const std::bad_alloc&) {
        last_error.message.clear();
        last_error.place.clear();
    }
    return kind;
}

}  // namespace

void begin_call() noexcept {
    kept.clear();
}

void keep(std::shared_ptr<void> given) {
    kept.push_back(std::move(given));
}

const char* kept_text(std::string text) {
    const auto owned = std::make_shared<std::string>(std::move(text));
    keep(owned);
    return owned->c_str();
}

scree_result told_error() noexcept {
    try {
        throw;
    } catch (const Failure& error) {
        return tell(error.kind, error.what(), error.place);
    } catch (const SceneError& error) {
        return tell(SCREE_BAD_SCENE, error.what(), error.pointer);
    } catch (const ImportError& error) {
        return tell(SCREE_BAD_SCENE, error.what());
    } catch (const CheckpointError& error) {
        return tell(SCREE_BAD_CHECKPOINT, error.what());
    } catch (const host::DeviceError& error) {
        return tell(SCREE_DEVICE_ERROR, error.what());
    } catch (const host::FileError& error) {
        return tell(SCREE_FILE_ERROR, error.what());
    } catch (const host::ImageError& error) {
        return tell(SCREE_FILE_ERROR, error.what());
    } catch (const demos::UsageError& error) {
        return tell(SCREE_BAD_ARGUMENT, error.what());
    } catch (const std::out_of_range& error) {
        return tell(SCREE_BAD_INDEX, error.what());
    } catch (const std::bad_alloc&) {
        return tell(SCREE_NO_MEMORY, "there is not enough memory");
    } catch (const std::invalid_argument& error) {
        return tell(SCREE_BAD_ARGUMENT, error.what());
    } catch (const std::domain_error& error) {
        return tell(SCREE_BAD_ARGUMENT, error.what());
    } catch (const std::length_error& error) {
        return tell(SCREE_BAD_ARGUMENT, error.what());
    } catch (const nlohmann::json::exception& error) {
        return tell(SCREE_BAD_ARGUMENT, error.what());
    } catch (const std::exception& error) {
        return tell(SCREE_IMPOSSIBLE, error.what());
    } catch (...) {
        return tell(SCREE_IMPOSSIBLE, "an unknown error");
    }
}

std::string text_of(const char* text, const char* name) {
    std::string made = &given(text, name);
    if (std::none_of(made.begin(), made.end(), [](char c) { return static_cast<unsigned char>(c) > 0x7F; })) return made;
    try {
        (void)nlohmann::json(made).dump();
    } catch (const nlohmann::json::type_error&) {
        refuse(std::string(name) + ": is not UTF-8");
    }
    return made;
}

namespace {

// The caller's size of a struct, which is its first member.
std::size_t size_in(const void* of, const char* name) {
    std::size_t size = 0;
    if (of == nullptr) refuse(std::string(name) + ": is null");
    std::memcpy(&size, of, sizeof size);
    constexpr std::size_t most = 4096;  // more is a struct without SCREE_INIT
    // As that of every version of the struct, it ends with a member.
    if (size < sizeof size || size > most || size % alignof(std::size_t) != 0)
        refuse(std::string(name) + ": its size is " + std::to_string(size) + "; begin with SCREE_INIT");
    return size;
}

}  // namespace

void copy_sized(void* to, std::size_t size, const void* from, const char* name) {
    const std::size_t of_caller = size_in(from, name);
    std::memcpy(to, from, std::min(size, of_caller));
    const char* bytes = static_cast<const char*>(from);
    for (std::size_t i = size; i < of_caller; ++i)
        if (bytes[i] != 0) refuse(std::string(name) + ": has a member that this version of the library does not know");
}

void fill_sized(void* to, std::size_t size, const void* from, const char* name) {
    const std::size_t of_caller = size_in(to, name);
    const std::size_t begin = sizeof(std::size_t);
    std::memcpy(static_cast<char*>(to) + begin, static_cast<const char*>(from) + begin, std::min(size, of_caller) - begin);
}

}  // namespace scree::c

const char* scree_error_message(void) {
    return scree::c::last_error.message.c_str();
}
const char* scree_error_place(void) {
    return scree::c::last_error.place.c_str();
}
