// Window events, independent of the window system: pointer, buttons, keys, resizing.
#pragma once

#include <cstdint>
#include <string>

namespace scree::host {

enum class EventKind { moved, pressed, released, scrolled, key_pressed, key_released, resized, dropped };

enum class Button { left, right, middle };

// Key codes: upper-case ASCII for letters, digits and ' ' '.' ',' '+' '-' '/'; other keys from 256.
enum class Key : int {
    space = ' ',
    escape = 256,
    enter,
    tab,
    backspace,
    left,
    right,
    up,
    down,
    page_up,
    page_down,
    home,
    del,
    f1,
    other
};
constexpr Key key_of(char character) {
    return static_cast<Key>(character);
}

struct Event {
    EventKind kind = EventKind::moved;
    double x = 0, y = 0;  // moved, pressed, released, scrolled: pixels from the upper left corner; resized: the new size
    double amount = 0;    // scrolled: wheel clicks, > 0 away from the user
    Button button = Button::left;
    Key key = Key::other;
    bool shift = false, control = false;
    std::uint64_t order = 0;  // of what the keyboard sent, for Window::forget_text()
    std::string file{};       // dropped: a path
};

}  // namespace scree::host
